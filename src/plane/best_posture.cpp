#include "poise/best_posture.hpp"

#include <algorithm>
#include <limits>

#include "dual/dual.hpp"
#include "plane/harmonic.hpp"
#include "dual/twist.hpp"

namespace poise {
namespace {

constexpr double pi = 3.14159265358979323846;

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
  if (std::abs(sine) < 1e-9) return std::nullopt;
  return at[0] + cross(at[1] - at[0], edge[1]) / sine * edge[0];
}

/// The least that y proves between two postures [weights^2]: 2 (y . w(theta) - phi(G^T y)), less
/// what its rounding may be.
double proven_between(const ScaledGrasp<2>& scaled, const Twist<2>& y, double from, double to) {
  dual::Point<2> point(scaled.size);
  const double rounding = 1e-15 * y.cwiseAbs().sum();
  const auto at = [&](double theta) {
    const Vector<2> up = up_at(theta);
    dual::evaluate<2, double>(scaled, Wrench<2>(up.x(), up.y(), 0), y, point);
    return 2 * (point.value - rounding);
  };
  const double least = std::min(at(from), at(to));
  // A sinusoid is least at its trough, if that is in between.
  const double trough = std::atan2(-y[0], -y[1]);
  return std::remainder(trough - (from + to) / 2, 2 * pi) * 2 < to - from &&
                 std::remainder((from + to) / 2 - trough, 2 * pi) * 2 < to - from
             ? std::min(least, at(trough))
             : least;
}

/// The least that the arcs' own y prove, and those of the postures that rounding left undecided.
double lower_bound(const Grasp<2>& grasp, const PostureCurve& curve, double force_cap) {
  const ScaledGrasp<2>& scaled = grasp.scaled();
  double least = std::numeric_limits<double>::infinity();
  for (const Arc& arc : curve.arcs) {
    // V on an arc is least at its ends or where it is flat.
    const auto prove_at = [&](double theta) {
      const Twist<2> y(arc.y[0](theta), arc.y[1](theta), arc.y[2](theta));
      least = std::min(least, proven_between(scaled, about_com(grasp, y), theta, theta));
    };
    prove_at(arc.from);
    prove_at(arc.to);
    for (const Root& root : sign_changes(derivative(arc.V), arc.from, arc.to)) prove_at(root.at);
  }
  for (const Interval& gap : curve.undecided) {
    const Hold<2> middle = hold(grasp, up_at((gap.from + gap.to) / 2), {force_cap});
    least =
        std::min(least, proven_between(scaled, about_com(grasp, middle.dual), gap.from, gap.to));
  }
  if (curve.arcs.empty() && curve.undecided.empty()) return 0;
  return std::max(least, 0.0) * grasp.object().weight * grasp.object().weight;
}

}  // namespace

PlanarPosture posture_at(const Grasp<2>& grasp, const Optimum& optimum,
                         const CurveSettings& settings) {
  PlanarPosture posture;
  posture.optimum = optimum;
  Vector<2> up = up_at(optimum.angle);
  posture.hold = hold(grasp, up, {settings.force_cap});
  // An end of the holdable postures may miss them by rounding.
  for (const double off : {1e-9, -1e-9, 1e-8, -1e-8}) {
    if (posture.hold.holdable) break;
    up = up_at(optimum.angle + off);
    posture.hold = hold(grasp, up, {settings.force_cap});
  }
  if (posture.hold.holdable) posture.optimum.effort = posture.hold.effort;
  posture.manner = manner(grasp, up, posture.hold);
  std::vector<std::size_t> loaded;
  bool slipping = true;
  for (std::size_t i = 0; i < posture.hold.forces.size(); ++i) {
    if (posture.hold.forces[i].state == ContactState::unloaded) continue;
    loaded.push_back(i);
    slipping = slipping && posture.hold.forces[i].state == ContactState::slipping;
  }
  posture.two_slipping = optimum.kind == Kind::kink && loaded.size() == 2 && slipping;
  if (posture.two_slipping)
    posture.edges_meet = meeting_point(grasp, posture.hold, {loaded[0], loaded[1]});
  return posture;
}

BestPosture best_posture(const Grasp<2>& grasp, const CurveSettings& settings) {
  BestPosture best;
  best.curve = posture_curve(grasp, settings);
  for (const Optimum& optimum : best.curve.optima) {
    if (optimum.maximum) {
      if (!best.worst) best.worst = posture_at(grasp, optimum, settings);
      continue;
    }
    best.minima.push_back(posture_at(grasp, optimum, settings));
    const bool pinched = best.minima.back().manner == Manner::pinched;
    if (!best.pinched && pinched && optimum.kind != Kind::boundary)
      best.pinched = best.minima.size() - 1;
  }
  best.lower_bound = lower_bound(grasp, best.curve, settings.force_cap);
  if (best.holdable()) best.lower_bound = std::min(best.lower_bound, best.best().hold.effort);
  return best;
}

}  // namespace poise
