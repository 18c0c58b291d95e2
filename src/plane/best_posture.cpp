#include "poise/best_posture.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "dual/dual.hpp"
#include "dual/twist.hpp"
#include "plane/arc.hpp"
#include "plane/harmonic.hpp"

namespace poise {
namespace {

using std::numbers::pi;

/// Edges of friction cones at a smaller sine are parallel.
constexpr double parallel = 1e-9;
/// The part of the effort that rounding may hide of its proof.
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

/// The least that y proves between two postures [weights^2]: 2 (y . w(theta) - phi(G^T y)), less
/// what its rounding may be.
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

/// The least that the arcs' own y prove, and those of the postures that rounding left undecided.
double proven_effort(const Grasp<2>& grasp, const PostureCurve& curve, double force_cap) {
  const dual::Problem<2> problem(grasp.scaled(), grasp.weight());
  const LoadCurve load = load_curve(problem.hand, problem.weight, grasp.loads().front());
  const auto proven = [&](const Twist<2>& y, double from, double to) {
    return proven_between(problem, load, about_center(problem.hand, problem.weight, y), from, to);
  };
  double least = std::numeric_limits<double>::infinity();
  for (const Arc& arc : curve.arcs) {
    // V on an arc is least at its ends or where it is flat.
    const auto prove_at = [&](double theta) {
      const Twist<2> y(arc.y[0](theta), arc.y[1](theta), arc.y[2](theta));
      least = std::min(least, proven(y, theta, theta));
    };
    prove_at(arc.from);
    prove_at(arc.to);
    for (const Root& root : sign_changes(derivative(arc.V), arc.from, arc.to)) prove_at(root.at);
  }
  for (const Interval& gap : curve.undecided) {
    const Hold<2> middle = hold(grasp, up_at((gap.from + gap.to) / 2), {force_cap});
    least = std::min(least, proven(middle.dual, gap.from, gap.to));
  }
  if (curve.arcs.empty() && curve.undecided.empty()) return 0;
  return std::max(least, 0.0) * problem.weight * problem.weight;
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
    static_cast<Posture<2>&>(minimum) = posture_at(grasp, up_at(angle), {settings.force_cap});
  };
  hold_at(optimum.angle);
  // An end of the holdable postures may miss them by rounding.
  for (const double off : {1e-9, -1e-9, 1e-8, -1e-8}) {
    if (minimum.holdable()) break;
    hold_at(optimum.angle + off);
  }
  minimum.up = up_at(optimum.angle);
  if (minimum.holdable()) minimum.optimum.effort = minimum.effort();
  std::vector<std::size_t> loaded;
  bool slipping = true;
  const auto& forces = minimum.hold().forces;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (forces[i].state == ContactState::unloaded) continue;
    loaded.push_back(i);
    slipping = slipping && forces[i].state == ContactState::slipping;
  }
  minimum.two_slipping = optimum.kind == Kind::kink && loaded.size() == 2 && slipping;
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
  best.lower_bound = proven_effort(grasp, curve, settings.force_cap);
  if (!best.holdable()) {
    best.status = curve.undecided.empty() ? Status::unholdable : Status::gap;
    return best;
  }
  const double effort = best.best().hold().effort;
  best.lower_bound = std::min(best.lower_bound, effort);
  best.relative_gap = (effort - best.lower_bound) / effort;
  best.status = best.lower_bound >= (1 - most_rounding) * effort ? Status::optimal : Status::gap;
  return best;
}

}  // namespace poise
