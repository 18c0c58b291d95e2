#include "poise/capacity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "dual/cone_plane.hpp"
#include "dual/cone_space.hpp"
#include "hold/solve.hpp"

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double wanted = 1e-7;  // between what is held and what is proven
constexpr double most_friction = 1e6;
constexpr int most_probes = 200;

using Real = dual::Exact;  // a force norm of a million weights makes rounding of doubles felt

using Slide = dual::Slide<Real>;

template <int Dim>
std::vector<Slide> slides(const Hand<Dim>& hand, const Twist<Dim>& y) {
  std::vector<Slide> result;
  for (const Contact<Dim>& contact : hand.contacts())
    result.push_back(dual::slide<Real>(contact, y));
  return result;
}

/// What contact forces can do against y at most: `fixed` + `growing` times their force norm.
struct Power {
  Real fixed{0}, growing{0};
};

template <int Dim>
Power power(const Hand<Dim>& hand, const std::vector<Slide>& slides, double factor) {
  Power power;
  Real squared = 0;
  for (std::size_t i = 0; i < slides.size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    const Slide& z = slides[i];
    const Real mu = Real{factor} * contact.friction, along = dual::power(z, mu);
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

/// What is asked: a weight through the load's com, in a posture. Equation (8) of docs/theory.md.
template <int Dim>
struct Question {
  const Hand<Dim>& hand;
  const Load<Dim>& load;
  const Vector<Dim>& up;
  const HoldSettings& settings;

  /// What one newton of weight does against y at least, if the balance is off by the tolerance.
  Real driven(const Twist<Dim>& y) const {
    const Eigen::Matrix<Real, Dim, 1> v = dual::velocity<Dim>(y, load.com);
    const Real omega = y.template tail<wrench_size<Dim> - Dim>().norm();
    return v.dot(up.template cast<Real>()) - dual::delta * (v.norm() + hand.radius() * omega);
  }
  /// The hold of another weight [N] by the same contacts, or by changed ones.
  Hold<Dim> hold(const ScaledHand<Dim>& contacts, double weight, double friction_factor = 1) const {
    const Load<Dim> probed{.weight = weight, .com = load.com};
    return solve<Dim>(hand, contacts, friction_factor, probed, up, settings);
  }
  /// With a hold that was found.
  Posture<Dim> posture(Hold<Dim> hold, double weight) const {
    Posture<Dim> posture{.up = up, .holds = {std::move(hold)}};
    if (!posture.holdable()) return posture;
    const Load<Dim> probed{.weight = weight, .com = load.com};
    posture.manner = poise::manner(hand, probed, up, posture.hold());
    return posture;
  }
};

/// y as a bound on the weight: weight * gain <= fixed.
struct Cut {
  Real gain, fixed;
};

template <int Dim>
Cut cut_by(const Question<Dim>& asked, const Twist<Dim>& y) {
  const Power most = power(asked.hand, slides(asked.hand, y), 1);
  return {asked.driven(y) - asked.settings.force_cap * most.growing, most.fixed};
}

/// Equation (8) knows neither pads nor drives.
template <int Dim>
void check_plain(const Hand<Dim>& hand) {
  for (std::size_t i = 0; i < hand.contacts().size(); ++i)
    if (hand.contacts()[i].pad)
      throw InvalidGrasp("contacts[" + std::to_string(i) + "].pad",
                         "is not taken into account by capacity: give points with shares");
  if (hand.is_general())
    throw InvalidGrasp("drives",
                       "have a max, which capacity does not take into account: leave it "
                       "out, or give max_normal of the contacts");
}

/// In every hold of the greatest weight (8) is an equation.
template <int Dim>
std::vector<Deciding> deciding_by(const Question<Dim>& asked, const Twist<Dim>& y) {
  const Real gain = cut_by(asked, y).gain, least = 1e-9 * std::abs(gain);
  const std::vector<Slide> all = slides(asked.hand, y);
  std::vector<Deciding> result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Contact<Dim>& contact = asked.hand.contacts()[i];
    const Real along = dual::power(all[i], Real{contact.friction});
    const bool pressing = std::isfinite(contact.max_normal) && along > least;
    result.push_back({pressing ? static_cast<double>(along / gain) : 0,
                      contact.friction > 0 && all[i].beside > least && along > -least});
  }
  return result;
}

/// The search for both ends: every y that proves something cuts the range.
template <int Dim>
class WeightSearch {
 public:
  explicit WeightSearch(const Question<Dim>& asked) : asked_(asked) {
    range_.greatest.bound = infinity;
    for (const Contact<Dim>& contact : asked.hand.contacts()) {
      pressed_ = pressed_ || contact.min_normal > 0;
      if (std::isfinite(contact.max_normal)) strength_ += contact.max_normal;
    }
  }

  WeightRange<Dim> run() {
    bound_greatest();
    range_.holdable = !pressed_ || find_least();
    if (range_.holdable) find_greatest();
    if (!range_.holdable) try_given();
    complete(range_.least, least_);
    complete(range_.greatest, greatest_);
    if (range_.holdable && range_.greatest.weight < infinity)
      range_.deciding = deciding_by(asked_, range_.greatest.dual);
    return std::move(range_);
  }

 private:
  void cut(Twist<Dim> y) {
    const double size = y.template lpNorm<Eigen::Infinity>();
    if (!(size > 0)) return;
    y /= size;
    const Cut row = cut_by(asked_, y);
    const auto weight = static_cast<double>(row.fixed / row.gain);
    WeightEnd<Dim>& least = range_.least;
    WeightEnd<Dim>& greatest = range_.greatest;
    if (row.gain >= 0 && weight < greatest.bound) {
      greatest.bound = std::max(weight, 0.0);
      greatest.dual = y;
    } else if (row.gain < 0 && weight > least.bound && !from_zero_) {
      least.bound = weight;
      least.dual = y;
    }
  }

  bool empty() const {
    return range_.greatest.bound <= dual::delta * strength_ ||
           range_.greatest.bound < range_.least.bound;
  }

  bool probe(WeightEnd<Dim>& end, Hold<Dim>& hold, double weight) {
    hold = asked_.hold(asked_.hand.scaled(), weight);
    if (hold.holdable)
      end.weight = weight;
    else
      cut(hold.dual);
    return hold.holdable;
  }

  void bound_greatest() {
    greatest_ = asked_.hold(asked_.hand.scaled().without_limits(), asked_.load.weight);
    if (greatest_.holdable) {
      range_.greatest.weight = infinity;
      return;
    }
    cut(greatest_.dual);
    Twist<Dim> y = Twist<Dim>::Zero();
    y.template head<Dim>() = asked_.up;
    cut(y);
  }

  bool find_least() {
    WeightEnd<Dim>& end = range_.least;
    least_ = poise::hold<Dim>(asked_.hand, Wrench<Dim>(Wrench<Dim>::Zero()), asked_.load.weight,
                              Twist<Dim>::Zero(), asked_.settings);
    from_zero_ = least_.holdable;
    if (from_zero_) {
      end.bound = 0;
      end.dual.setZero();
      return true;
    }
    cut(least_.dual);
    double step = wanted;
    for (int k = 0; k < most_probes && end.bound > 0 && step < 1 && !empty(); ++k) {
      const double weight = end.bound * (1 + step);
      if (probe(end, least_, weight)) return true;
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
      greatest_ = least_;
    };
    if (end.bound == infinity) {  // rounding hid it
      if (!probe(end, greatest_, asked_.load.weight)) nothing_beside_least();
      return;
    }
    double step = wanted;
    for (int k = 0; k < most_probes && step < 1 && !empty(); ++k) {
      const double weight = end.bound * (1 - step);
      if (probe(end, greatest_, weight)) return;
      if (end.bound >= weight) step *= 8;
    }
    nothing_beside_least();
  }

  /// What is held is held, also where the ends are lost in rounding.
  void try_given() {
    Hold<Dim> hold = asked_.hold(asked_.hand.scaled(), asked_.load.weight);
    range_.holdable = hold.holdable;
    if (!hold.holdable) return;
    range_.least.weight = range_.greatest.weight = asked_.load.weight;
    least_ = greatest_ = std::move(hold);
  }

  /// What is held at an end; where any weight is held, the given one.
  void complete(WeightEnd<Dim>& end, Hold<Dim>& hold) const {
    const bool any = end.weight == infinity;
    end.posture = asked_.posture(std::move(hold), any ? asked_.load.weight : end.weight);
  }

  const Question<Dim>& asked_;
  bool pressed_{false};    ///< contacts must press even where there is no weight
  bool from_zero_{false};  ///< they can do so without any weight
  double strength_{0};     ///< of all contacts with max_normal [N]
  WeightRange<Dim> range_;
  Hold<Dim> least_, greatest_;
};

/// The search for the least friction: every y that proves something raises the bound.
template <int Dim>
class FrictionSearch {
 public:
  explicit FrictionSearch(const Question<Dim>& asked) : asked_(asked) { found_.factor = infinity; }

  LeastFriction<Dim> run() {
    probe(1);
    if (!probe(0)) narrow();
    found_.posture = asked_.posture(std::move(hold_), asked_.load.weight);
    return std::move(found_);
  }

 private:
  void narrow() {
    double step = wanted;
    for (int k = 0; k < most_probes && !found(); ++k) {
      const double failed = failed_, factor = found_.factor, near = found_.bound * (1 + step);
      if (near > failed) {
        probe(near);
        if (found_.bound <= near) step *= 8;
      }
      if (found_.factor == infinity) {
        if (!(failed_ < most_friction)) break;
        probe(std::min(2 * std::max(failed_, 1.0), most_friction));
      } else if (!(found_.factor - failed_ <= (factor - failed) / 2)) {
        probe(failed_ + (found_.factor - failed_) / 2);  // where proofs reach not far, halving does
      }
      if (failed_ == failed && found_.factor == factor) break;  // rounding leaves it open
    }
  }

  bool found() const {
    return found_.factor < infinity && found_.factor - failed_ <= wanted * found_.factor;
  }

  bool probe(double factor) {
    if (!(factor < found_.factor)) return true;
    Hold<Dim> there =
        asked_.hold(asked_.hand.scaled().with_friction(factor), asked_.load.weight, factor);
    if (!there.holdable) {
      cut(there.dual);
      failed_ = std::max({failed_, factor, found_.bound});
      return false;
    }
    found_.factor = factor;
    hold_ = std::move(there);
    return true;
  }

  void cut(Twist<Dim> y) {
    y /= std::max(y.template lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min());
    const std::vector<Slide> z = slides(asked_.hand, y);
    const Real weight = asked_.load.weight, needed = weight * asked_.driven(y);
    const auto proves = [&](double factor) {  // less and less the more friction there is
      const Power most = power(asked_.hand, z, factor);
      return needed > most.fixed + asked_.settings.force_cap * weight * most.growing;
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

  const Question<Dim>& asked_;
  LeastFriction<Dim> found_;
  double failed_{0};  ///< the greatest factor that was too little, proven or not
  Hold<Dim> hold_;
};

}  // namespace

template <int Dim>
WeightRange<Dim> weight_range(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                              const HoldSettings& settings) {
  check_plain(hand);
  const Question<Dim> asked{hand, load, up, settings};
  return WeightSearch<Dim>(asked).run();
}

template <int Dim>
std::vector<Deciding> deciding(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                               const Twist<Dim>& dual, const HoldSettings& settings) {
  return deciding_by(Question<Dim>{hand, load, up, settings}, dual);
}

template <int Dim>
LeastFriction<Dim> least_friction(const Hand<Dim>& hand, const Load<Dim>& load,
                                  const Vector<Dim>& up, const HoldSettings& settings) {
  check_plain(hand);
  const Question<Dim> asked{hand, load, up, settings};
  return FrictionSearch<Dim>(asked).run();
}

template <int Dim>
Capacity<Dim> capacity(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                       double safety, const HoldSettings& settings) {
  if (!(safety >= 1) || !std::isfinite(safety)) throw InvalidGrasp("safety", "must be at least 1");
  check_plain(hand);
  const Question<Dim> asked{hand, load, up, settings};
  Hold<Dim> safe = asked.hold(hand.scaled().with_friction(1 / safety), load.weight, 1 / safety);
  return {weight_range(hand, load, up, settings), least_friction(hand, load, up, settings),
          asked.posture(std::move(safe), load.weight)};
}

#define POISE_INSTANTIATE(Dim)                                                                    \
  template WeightRange<Dim> weight_range(const Hand<Dim>&, const Load<Dim>&, const Vector<Dim>&,  \
                                         const HoldSettings&);                                    \
  template std::vector<Deciding> deciding(const Hand<Dim>&, const Load<Dim>&, const Vector<Dim>&, \
                                          const Twist<Dim>&, const HoldSettings&);                \
  template LeastFriction<Dim> least_friction(const Hand<Dim>&, const Load<Dim>&,                  \
                                             const Vector<Dim>&, const HoldSettings&);            \
  template Capacity<Dim> capacity(const Hand<Dim>&, const Load<Dim>&, const Vector<Dim>&, double, \
                                  const HoldSettings&);
POISE_INSTANTIATE(2)
POISE_INSTANTIATE(3)
#undef POISE_INSTANTIATE

}  // namespace poise
