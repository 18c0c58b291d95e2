#include "poise/capacity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double delta = 1e-12;  // the balance tolerance
constexpr double wanted = 1e-7;  // between what is held and what is proven
constexpr double most_friction = 1e6;
constexpr int most_probes = 200;

// A force norm of a million weights makes rounding of doubles felt.
using Real = long double;

/// z of a contact: its velocity under y along the normal, and the length of what friction acts on.
struct Slide {
  Real normal, beside;
  /// The greatest power of a force with normal force 1.
  Real power(Real friction) const { return normal + friction * beside; }
};

Slide slide(const Contact<2>& contact, const Twist<2>& y) {
  const Real ux = y[0] - Real{y[2]} * contact.position.y();
  const Real uy = y[1] + Real{y[2]} * contact.position.x();
  const Real nx = contact.normal.x(), ny = contact.normal.y();
  return {nx * ux + ny * uy, std::abs(nx * uy - ny * ux)};
}

Slide slide(const Contact<3>& contact, const Twist<3>& y) {
  using Real3 = Eigen::Matrix<Real, 3, 1>;
  const Real3 n = contact.normal.cast<Real>(), omega = y.tail<3>().cast<Real>();
  const Real3 u = y.head<3>().cast<Real>() + omega.cross(contact.position.cast<Real>());
  const Real turn = contact.torsion > 0 ? omega.dot(n) * contact.torsion / contact.friction : 0;
  return {u.dot(n), std::hypot((u - u.dot(n) * n).norm(), turn)};
}

template <int Dim>
std::vector<Slide> slides(const Grasp<Dim>& grasp, const Twist<Dim>& y) {
  std::vector<Slide> result;
  for (const Contact<Dim>& contact : grasp.contacts()) result.push_back(slide(contact, y));
  return result;
}

/// What contact forces can do against y at most: `fixed` + `growing` times their force norm.
struct Power {
  Real fixed{0}, growing{0};
};

template <int Dim>
Power power(const Grasp<Dim>& grasp, const std::vector<Slide>& slides, double factor) {
  Power power;
  Real squared = 0;
  for (std::size_t i = 0; i < slides.size(); ++i) {
    const Contact<Dim>& contact = grasp.contacts()[i];
    const Slide& z = slides[i];
    const Real mu = Real{factor} * contact.friction, along = z.power(mu);
    if (std::isfinite(contact.max_normal)) {
      power.fixed += (along > 0 ? contact.max_normal : contact.min_normal) * along;
      continue;
    }
    // A cone cut at min_normal is that cut and the cone.
    power.fixed += contact.min_normal * along;
    if (along <= 0) continue;
    const bool inside = z.beside <= mu * z.normal;
    const Real projected = inside ? std::hypot(z.normal, z.beside) : along / std::sqrt(1 + mu * mu);
    squared += contact.share * projected * projected;
  }
  power.growing = std::sqrt(squared);
  return power;
}

/// What one newton of weight does against y at least, if the balance is off by the tolerance.
template <int Dim>
Real driven(const Grasp<Dim>& grasp, const Vector<Dim>& up, const Twist<Dim>& y) {
  Eigen::Matrix<Real, Dim, 1> v = y.template head<Dim>().template cast<Real>();  // of the com
  const Eigen::Matrix<Real, Dim, 1> com = grasp.object().com.template cast<Real>();
  if constexpr (Dim == 2)
    v += y[2] * Eigen::Matrix<Real, 2, 1>(-com.y(), com.x());
  else
    v += y.template tail<3>().template cast<Real>().cross(com);
  const Real omega = y.template tail<wrench_size<Dim> - Dim>().norm();
  return v.dot(up.template cast<Real>()) - delta * (v.norm() + grasp.radius() * omega);
}

/// y as a bound on the weight: weight * gain <= fixed.
struct Cut {
  Real gain, fixed;
};

template <int Dim>
Cut cut_by(const Grasp<Dim>& grasp, const Vector<Dim>& up, const Twist<Dim>& y, double force_cap) {
  const Power most = power(grasp, slides(grasp, y), 1);
  return {driven(grasp, up, y) - force_cap * most.growing, most.fixed};
}

/// The search for both ends: every y that proves something cuts the range.
template <int Dim>
class WeightSearch {
 public:
  WeightSearch(const Grasp<Dim>& grasp, const Vector<Dim>& up, const HoldSettings& settings)
      : grasp_(grasp), up_(up), settings_(settings) {
    range_.greatest.bound = infinity;
    for (const Contact<Dim>& contact : grasp.contacts()) {
      pressed_ = pressed_ || contact.min_normal > 0;
      if (std::isfinite(contact.max_normal)) strength_ += contact.max_normal;
    }
  }

  WeightRange<Dim> run() {
    bound_greatest();
    range_.holdable = !pressed_ || find_least();
    if (range_.holdable) find_greatest();
    return range_;
  }

 private:
  void cut(Twist<Dim> y) {
    const double size = y.template lpNorm<Eigen::Infinity>();
    if (!(size > 0)) return;
    y /= size;
    const Cut by = cut_by(grasp_, up_, y, settings_.force_cap);
    const auto weight = static_cast<double>(by.fixed / by.gain);
    WeightEnd<Dim>&least = range_.least, &greatest = range_.greatest;
    if (by.gain >= 0 && weight < greatest.bound) {
      greatest.bound = std::max(weight, 0.0);
      greatest.dual = y;
    } else if (by.gain < 0 && weight > least.bound && !from_zero_) {
      least.bound = weight;
      least.dual = y;
    }
  }

  bool empty() const {
    return range_.greatest.bound <= delta * strength_ || range_.greatest.bound < range_.least.bound;
  }

  bool probe(WeightEnd<Dim>& end, double weight) {
    end.hold = hold<Dim>(with_weight(grasp_, weight), up_, settings_);
    if (end.hold.holdable)
      end.weight = weight;
    else
      cut(end.hold.dual);
    return end.hold.holdable;
  }

  void bound_greatest() {
    WeightEnd<Dim>& end = range_.greatest;
    end.hold = hold<Dim>(without_limits(grasp_), up_, settings_);
    if (end.hold.holdable) {
      end.weight = infinity;
      return;
    }
    cut(end.hold.dual);
    Twist<Dim> y = Twist<Dim>::Zero();
    y.template head<Dim>() = up_;
    cut(y);
  }

  bool find_least() {
    WeightEnd<Dim>& end = range_.least;
    end.hold = hold<Dim>(grasp_, Wrench<Dim>(Wrench<Dim>::Zero()), Twist<Dim>::Zero(), settings_);
    from_zero_ = end.hold.holdable;
    if (from_zero_) {
      end.bound = 0;
      end.dual.setZero();
      return true;
    }
    cut(end.hold.dual);
    double step = wanted;
    for (int k = 0; k < most_probes && end.bound > 0 && step < 1 && !empty(); ++k) {
      const double weight = end.bound * (1 + step);
      if (probe(end, weight)) return true;
      if (end.bound <= weight) step *= 8;
    }
    return false;
  }

  /// A little below the bound there is a hold, or a lower bound.
  void find_greatest() {
    WeightEnd<Dim>& end = range_.greatest;
    if (end.weight == infinity) return;
    const auto nothing_beside_least = [&] {
      range_.holdable = range_.least.weight > 0;
      if (!range_.holdable) return;
      end.weight = range_.least.weight;
      end.hold = range_.least.hold;
    };
    if (end.bound == infinity) {  // rounding hid it
      if (!probe(end, grasp_.object().weight)) nothing_beside_least();
      return;
    }
    double step = wanted;
    for (int k = 0; k < most_probes && step < 1 && !empty(); ++k) {
      const double weight = end.bound * (1 - step);
      if (probe(end, weight)) return;
      if (end.bound >= weight) step *= 8;
    }
    nothing_beside_least();
  }

  const Grasp<Dim>& grasp_;
  const Vector<Dim>& up_;
  const HoldSettings& settings_;
  bool pressed_{false};    ///< contacts must press even where there is no weight
  bool from_zero_{false};  ///< they can do so without any weight
  double strength_{0};     ///< of all contacts with max_normal [N]
  WeightRange<Dim> range_;
};

/// The search for the least friction: every y that proves something raises the bound.
template <int Dim>
class FrictionSearch {
 public:
  FrictionSearch(const Grasp<Dim>& grasp, const Vector<Dim>& up, const HoldSettings& settings)
      : grasp_(grasp), up_(up), settings_(settings) {
    found_.factor = infinity;
  }

  LeastFriction<Dim> run() {
    probe(1);
    if (probe(0)) return found_;
    double step = wanted;
    for (int k = 0; k < most_probes && found_.bound < most_friction; ++k) {
      const double bound = found_.bound, gap = found_.factor - bound;
      if (gap < infinity && gap <= wanted * found_.factor) break;
      const double near = bound * (1 + step);
      if (near > 0 && near < found_.factor) {
        probe(near);
        if (found_.bound <= near) step *= 8;
      }
      // Where proofs reach not far, halving does.
      if (!(found_.factor - found_.bound <= gap / 2))
        probe(gap < infinity ? bound + gap / 2 : 2 * std::max(bound, 1.0));
      if (found_.bound == bound && found_.factor - bound == gap) break;  // rounding leaves it open
    }
    return found_;
  }

 private:
  bool probe(double factor) {
    if (!(factor < found_.factor)) return true;
    Hold<Dim> there = hold<Dim>(with_friction(grasp_, factor), up_, settings_);
    if (!there.holdable) {
      cut(there.dual);
      return false;
    }
    found_.factor = factor;
    found_.hold = std::move(there);
    return true;
  }

  void cut(Twist<Dim> y) {
    y /= std::max(y.template lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min());
    const std::vector<Slide> z = slides(grasp_, y);
    const Real weight = grasp_.object().weight, needed = weight * driven(grasp_, up_, y);
    const auto proves = [&](double factor) {  // less and less the more friction there is
      const Power most = power(grasp_, z, factor);
      return needed > most.fixed + settings_.force_cap * weight * most.growing;
    };
    if (!proves(found_.bound)) return;
    double from = found_.bound, to = most_friction;
    if (proves(to)) from = to;
    for (double middle = 0; from < to; (proves(middle) ? from : to) = middle) {
      middle = from + (to - from) / 2;
      if (middle <= from || middle >= to) break;
    }
    found_.bound = from;
    found_.dual = y;
  }

  const Grasp<Dim>& grasp_;
  const Vector<Dim>& up_;
  const HoldSettings& settings_;
  LeastFriction<Dim> found_;
};

template <int Dim, class Change>
Grasp<Dim> changed(const Grasp<Dim>& grasp, const Change& change) {
  Object<Dim> object = grasp.object();
  std::vector<Contact<Dim>> contacts = grasp.contacts();
  change(object, contacts);
  return {object, std::move(contacts)};
}

}  // namespace

template <int Dim>
WeightRange<Dim> weight_range(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                              const HoldSettings& settings) {
  return WeightSearch<Dim>(grasp, up, settings).run();
}

template <int Dim>
LeastFriction<Dim> least_friction(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                                  const HoldSettings& settings) {
  return FrictionSearch<Dim>(grasp, up, settings).run();
}

template <int Dim>
std::vector<Deciding> deciding(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                               const Twist<Dim>& dual, const HoldSettings& settings) {
  const Real gain = cut_by(grasp, up, dual, settings.force_cap).gain;
  const Real least = 1e-9 * std::abs(gain);
  std::vector<Deciding> result;
  const std::vector<Slide> all = slides(grasp, dual);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Contact<Dim>& contact = grasp.contacts()[i];
    const Real along = all[i].power(contact.friction);
    const bool pressing = std::isfinite(contact.max_normal) && along > least;
    result.push_back({pressing ? static_cast<double>(along / gain) : 0,
                      contact.friction > 0 && all[i].beside > least && along > -least});
  }
  return result;
}

template <int Dim>
Capacity<Dim> capacity(const Grasp<Dim>& grasp, const Vector<Dim>& up, double safety,
                       const HoldSettings& settings) {
  if (!(safety >= 1) || !std::isfinite(safety)) throw InvalidGrasp("safety", "must be at least 1");
  return {weight_range(grasp, up, settings), least_friction(grasp, up, settings),
          hold<Dim>(with_friction(grasp, 1 / safety), up, settings)};
}

template <int Dim>
Grasp<Dim> with_weight(const Grasp<Dim>& grasp, double weight) {
  return changed(grasp, [&](Object<Dim>& object, auto&) { object.weight = weight; });
}

template <int Dim>
Grasp<Dim> with_friction(const Grasp<Dim>& grasp, double factor) {
  return changed(grasp, [&](auto&, std::vector<Contact<Dim>>& contacts) {
    for (Contact<Dim>& contact : contacts) {
      contact.friction *= factor;
      contact.torsion *= factor;
    }
  });
}

template <int Dim>
Grasp<Dim> without_limits(const Grasp<Dim>& grasp) {
  return changed(grasp, [&](auto&, std::vector<Contact<Dim>>& contacts) {
    for (Contact<Dim>& contact : contacts) {
      contact.min_normal = 0;
      if (std::isfinite(contact.max_normal)) contact.max_normal = 0;
    }
  });
}

template WeightRange<2> weight_range<2>(const Grasp<2>&, const Vector<2>&, const HoldSettings&);
template WeightRange<3> weight_range<3>(const Grasp<3>&, const Vector<3>&, const HoldSettings&);
template LeastFriction<2> least_friction<2>(const Grasp<2>&, const Vector<2>&, const HoldSettings&);
template LeastFriction<3> least_friction<3>(const Grasp<3>&, const Vector<3>&, const HoldSettings&);
template std::vector<Deciding> deciding<2>(const Grasp<2>&, const Vector<2>&, const Twist<2>&,
                                           const HoldSettings&);
template std::vector<Deciding> deciding<3>(const Grasp<3>&, const Vector<3>&, const Twist<3>&,
                                           const HoldSettings&);
template Capacity<2> capacity<2>(const Grasp<2>&, const Vector<2>&, double, const HoldSettings&);
template Capacity<3> capacity<3>(const Grasp<3>&, const Vector<3>&, double, const HoldSettings&);
template Grasp<2> with_weight<2>(const Grasp<2>&, double);
template Grasp<3> with_weight<3>(const Grasp<3>&, double);
template Grasp<2> with_friction<2>(const Grasp<2>&, double);
template Grasp<3> with_friction<3>(const Grasp<3>&, double);
template Grasp<2> without_limits<2>(const Grasp<2>&);
template Grasp<3> without_limits<3>(const Grasp<3>&);

}  // namespace poise
