#include "poise/best_posture.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "dual/dual.hpp"
#include "dual/twist.hpp"
#include "plane/arc.hpp"
#include "plane/harmonic.hpp"
#include "poise/grip.hpp"

namespace poise {
namespace {

using std::numbers::pi;

/// Edges of friction cones at a smaller sine are parallel.
constexpr double parallel = 1e-9;
/// The part of the value that rounding may hide of its proof.
constexpr double most_rounding = 1e-6;

/// Where the edges meet on which two contacts press; none if they are parallel.
std::optional<Vector<2>> meeting_point(const Grasp<2>& grasp, const Hold<2>& hold,
                                       const std::array<std::size_t, 2>& loaded) {
  Vector<2> edge[2], at[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const Contact<2>& contact = grasp.contacts()[loaded[k]];
    const ContactForce<2>& force = hold.forces[loaded[k]];
    const Vector<2> tangent(-contact.normal.y(), contact.normal.x());
    edge[k] = (force.normal * contact.normal + force.tangential * tangent).normalized();
    at[k] = contact.position;
  }
  const auto cross = [](const Vector<2>& a, const Vector<2>& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const double sine = cross(edge[0], edge[1]);
  if (std::abs(sine) < parallel) return std::nullopt;
  return at[0] + cross(at[1] - at[0], edge[1]) / sine * edge[0];
}

/// The least that y proves of the effort between two postures [weights^2]: 2 (y . w(theta) -
/// phi(G^T y)), less what its rounding may be.
double proven_between(const dual::Problem<2>& problem, const LoadCurve& load, const Twist<2>& y,
                      double from, double to) {
  dual::Point<2> point(problem.size);
  const double rounding = 1e-15 * y.cwiseAbs().sum();
  const auto at = [&](double theta) {
    const Wrench<2> w = load * Vector<3>(1, std::cos(theta), std::sin(theta));
    dual::evaluate<2, double>(problem, w, y, point);
    return 2 * (point.value - rounding);
  };
  const double least = std::min(at(from), at(to));
  // A sinusoid is least at its trough, if that is in between.
  const Eigen::RowVector3d drive = y.transpose() * load;
  const double trough = std::atan2(-drive[2], -drive[1]);
  const double from_middle = std::abs(std::remainder(trough - (from + to) / 2, 2 * pi));
  return 2 * from_middle < to - from ? std::min(least, at(trough)) : least;
}

/// What is proven of the effort of a load [N^2].
class ProvenEffort {
 public:
  ProvenEffort(const Hand<2>& hand, const Load<2>& load)
      : problem_(hand.scaled(), load.size(hand.length())),
        load_(load_curve(problem_.hand, problem_.weight, load)) {}

  double at(const Arc& arc, double theta) const {
    return between({arc.y[0](theta), arc.y[1](theta), arc.y[2](theta)}, theta, theta);
  }
  double at(const Hold<2>& hold, const Interval& gap) const {
    return between(hold.dual, gap.from, gap.to);
  }

 private:
  double between(const Twist<2>& y, double from, double to) const {
    return problem_.weight * problem_.weight *
           proven_between(problem_, load_, about_center(problem_.hand, problem_.weight, y), from,
                          to);
  }

  dual::Problem<2> problem_;
  LoadCurve load_;
};

/// What is proven of the grip of a load [grip_unit()].
class ProvenGrip {
 public:
  ProvenGrip(const Hand<2>& hand, const Load<2>& load, double force_cap)
      : hand_(hand), load_(load), cap_(force_cap * load.size(hand.length())) {}

  double at(const Arc& arc, double theta) const {
    SmallVector<double, 4> rates(arc.rates->size());
    std::copy(arc.rates->begin(), arc.rates->end(), rates.begin());
    return bound({arc.y[0].c0, arc.y[1].c0, arc.y[2].c0}, rates, theta);
  }
  /// y . w(theta) is least at an end, or at its trough.
  double at(const Hold<2>& hold, const Interval& gap) const {
    const auto at = [&](double theta) { return bound(hold.dual, hold.rates, theta); };
    const double quarter = pi / 2, start = at(0), side = at(quarter), back = at(pi);
    const double trough = std::atan2(side - (start + back) / 2, (start - back) / 2) + pi;
    const double middle = (gap.from + gap.to) / 2;
    const bool inside = 2 * std::abs(std::remainder(trough - middle, 2 * pi)) < gap.to - gap.from;
    const double ends = std::min(at(gap.from), at(gap.to));
    return inside ? std::min(ends, at(trough)) : ends;
  }

 private:
  double bound(const Twist<2>& y, const SmallVector<double, 4>& rates, double theta) const {
    return grip_bound<2>(hand_, load_.at(up_at(theta)), y, rates, cap_);
  }

  const Hand<2>& hand_;
  const Load<2>& load_;
  double cap_;
};

/// The least that the arcs' own y prove, and those of the postures that rounding left undecided.
/// @param proven  of each load
template <class Proven>
double proven_value(const Grasp<2>& grasp, const PostureCurve& curve, double force_cap,
                    const std::vector<Proven>& proven) {
  double least = std::numeric_limits<double>::infinity();
  for (const Arc& arc : curve.arcs) {
    // On an arc the value is least at its ends or where it is flat.
    const Proven& of = proven[arc.load];
    least = std::min({least, of.at(arc, arc.from), of.at(arc, arc.to)});
    for (const Root& root : sign_changes(derivative(arc.value), arc.from, arc.to))
      least = std::min(least, of.at(arc, root.at));
  }
  for (const Interval& gap : curve.undecided) {
    double most = 0;
    for (std::size_t k = 0; k < proven.size(); ++k) {
      const Vector<2> middle = up_at((gap.from + gap.to) / 2);
      const Hold<2> held = hold(grasp, grasp.loads()[k], middle, {force_cap, curve.objective});
      most = std::max(most, proven[k].at(held, gap));
    }
    least = std::min(least, most);
  }
  if (curve.arcs.empty() && curve.undecided.empty()) return 0;
  return std::max(least, 0.0);
}

double proven_value(const Grasp<2>& grasp, const PostureCurve& curve, double force_cap) {
  if (curve.objective == Objective::grip) {
    std::vector<ProvenGrip> proven;
    for (const Load<2>& load : grasp.loads()) proven.emplace_back(grasp, load, force_cap);
    return proven_value(grasp, curve, force_cap, proven);
  }
  std::vector<ProvenEffort> proven;
  for (const Load<2>& load : grasp.loads()) proven.emplace_back(grasp, load);
  return proven_value(grasp, curve, force_cap, proven);
}

}  // namespace

const char* to_string(Status status) {
  constexpr const char* names[] = {"optimal", "gap", "unholdable"};
  return names[static_cast<int>(status)];
}

Minimum<2> minimum_at(const Grasp<2>& grasp, const Optimum& optimum,
                      const CurveSettings& settings) {
  Minimum<2> minimum;
  minimum.optimum = optimum;
  const auto hold_at = [&](double angle) {
    static_cast<Posture<2>&>(minimum) =
        posture_at(grasp, up_at(angle), {settings.force_cap, settings.objective});
  };
  hold_at(optimum.angle);
  // An end of the holdable postures may miss them by rounding.
  for (const double off : {1e-9, -1e-9, 1e-8, -1e-8}) {
    if (minimum.holdable()) break;
    hold_at(optimum.angle + off);
    for (Hold<2>& hold : minimum.holds)
      hold.residual += std::abs(off);  // against the load as it is at the end
  }
  minimum.up = up_at(optimum.angle);
  if (minimum.holdable()) minimum.optimum.value = minimum.value();
  std::vector<std::size_t> loaded;
  bool slipping = true;
  const auto& forces = minimum.hold().forces;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (forces[i].state == ContactState::unloaded) continue;
    loaded.push_back(i);
    slipping = slipping && forces[i].state == ContactState::slipping;
  }
  const bool is_weight = grasp.loads()[minimum.decides].still().isZero(0);
  minimum.two_slipping = is_weight && optimum.kind == Kind::kink && loaded.size() == 2 && slipping;
  if (minimum.two_slipping)
    minimum.edges_meet = meeting_point(grasp, minimum.hold(), {loaded[0], loaded[1]});
  return minimum;
}

Best<2> best_posture(const Grasp<2>& grasp, const CurveSettings& settings) {
  Best<2> best;
  PostureCurve& curve = best.proof.curve;
  curve = posture_curve(grasp, settings);
  for (const Optimum& optimum : curve.optima) {
    if (optimum.maximum) {
      if (!best.proof.worst) best.proof.worst = minimum_at(grasp, optimum, settings);
      continue;
    }
    best.minima.push_back(minimum_at(grasp, optimum, settings));
    const bool pinched = best.minima.back().manner == Manner::pinched;
    if (!best.pinched && pinched && optimum.kind != Kind::boundary)
      best.pinched = best.minima.size() - 1;
  }
  best.lower_bound = proven_value(grasp, curve, settings.force_cap);
  if (!best.holdable()) {
    best.status = curve.undecided.empty() ? Status::unholdable : Status::gap;
    return best;
  }
  const double value = best.best().value();
  best.lower_bound = std::min(best.lower_bound, value);
  best.relative_gap = value > 0 ? (value - best.lower_bound) / value : 0;
  best.status = best.relative_gap <= most_rounding ? Status::optimal : Status::gap;
  return best;
}

}  // namespace poise
