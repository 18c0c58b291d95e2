#include "turn/values.hpp"

#include <algorithm>
#include <cmath>

namespace poise::turns {

namespace {

/// Nearer to the planes that motions without resistance leave is on them.
constexpr double on_thin = 1e-6;
/// The greatest force cap that there is [weights]. What is least in grip may need a force norm
/// above the cap: there the grip is what the cap limits.
constexpr double no_cap = 1e9;

}  // namespace

Arc arc_between(const Vector<3>& from, const Vector<3>& to, const Vector<3>& beside) {
  const Vector<3> part = to - from.dot(to) * from;
  const double sine = from.cross(to).norm();
  const double angle = std::atan2(sine, from.dot(to));
  if (sine > 1e-12) return {from, part.normalized(), angle};
  return {from, (beside - from.dot(beside) * from).normalized(), angle};
}

Arc arc_between(const Vector<3>& from, const Vector<3>& to) {
  return arc_between(from, to, tangents(from).col(0));
}

Values::Values(const Grasp<3>& grasp, const TurnSettings& settings)
    : grasp_(grasp),
      settings_(settings),
      loads_(search::scaled_loads(grasp, grasp.scaled(), settings.force_cap)),
      oracle_(grasp, loads_, settings.objective) {
  if (settings.tilt) domain_ = {settings.tilt->from.normalized(), settings.tilt->most};
}

Valued Values::at(const Vector<3>& x) {
  const std::vector<search::Plane>& thin = oracle_.thin;
  const bool is_on = !thin.empty() && std::all_of(thin.begin(), thin.end(), [&](const auto& plane) {
    return std::abs(plane.n.dot(x)) < on_thin;
  });
  const Vector<3> asked =
      is_on ? Vector<3>(search::OnPlanes(x, thin).load().normalized() * x.norm()) : x;
  const search::Aim aim{nullptr, infinity, infinity, oracle_.most, search::Digits::all};
  search::Answer answer = oracle_.evaluate(asked, aim);
  Valued valued{asked, std::sqrt(answer.value), std::move(answer.half_space)};
  // Where neither forces nor a proof that there are none were found a closer look may tell.
  if (!valued.holdable() && least_between(valued.half_space, asked, asked) < infinity &&
      std::abs(asked.squaredNorm() - 1) < 1e-9) {
    const Posture<3> closer = posture(asked);
    const bool is_grip = settings_.objective == Objective::grip;
    const double p = (is_grip ? closer.value() : std::sqrt(closer.value())) / oracle_.unit;
    if (closer.holdable() && p * p <= oracle_.most) valued.p = p;
  }
  return valued;
}

Valued Values::in_domain(const Vector<3>& up) {
  if (is_in_domain(up)) return at(up);
  return {up, infinity, {.origin = HalfSpace::Origin::domain, .normal = domain_->plane(up)}};
}

double Values::most_between(const Valued& a, const Valued& b) {
  const double most = std::max(a.p, b.p);
  if (!(most < infinity)) return infinity;
  const double cosine = std::clamp(a.x.dot(b.x), -1.0, 1.0), sine = a.x.cross(b.x).norm();
  if (!oracle_.scales) {
    const Vector<3> middle = a.x + b.x;
    if (!(middle.norm() > 1e-3)) return infinity;
    // Where the tangents meet: the arc lies in the triangle of a, b and this.
    return std::max(most, at(middle / (1 + cosine)).p);
  }
  if (!(sine > 1e-12)) return cosine > 0 ? most : infinity;
  // (sin(angle - t) p(a) + sin t p(b)) / sin angle, of which the greatest may lie inside.
  if (b.p <= a.p * cosine || a.p <= b.p * cosine) return most;
  const double between = std::hypot(a.p, (b.p - a.p * cosine) / sine);
  return between * between > oracle_.most ? infinity : between;
}

double Values::least_between(const HalfSpace& half_space, const Vector<3>& a,
                             const Vector<3>& b) const {
  const Vector<3>& n = half_space.normal;
  const double least = std::min(n.dot(a), n.dot(b));
  // Points of the arc are sums of its ends with parts that add up to at least 1, and at most this.
  const double longest = 2 / std::max((a + b).norm(), 1e-9);
  return std::sqrt(oracle_.value_proven(half_space, least < 0 ? least * longest : least));
}

double Values::least_within(const HalfSpace& half_space, const Vector<3>& a, const Vector<3>& b,
                            const Vector<3>& c) const {
  const Vector<3>& n = half_space.normal;
  const double least = std::min({n.dot(a), n.dot(b), n.dot(c)});
  if (least < 0) {  // as for arcs: the plane of the corners may pass near to the center
    const Vector<3> across = (b - a).cross(c - a);
    const double distance = std::abs(across.dot(a)) / std::max(across.norm(), 1e-300);
    return std::sqrt(oracle_.value_proven(half_space, least / std::max(distance, 1e-9)));
  }
  return std::sqrt(oracle_.value_proven(half_space, least));
}

double Values::value(double p) const {
  const double root = oracle_.unit * p;
  return settings_.objective == Objective::grip ? root : root * root;
}

double Values::gap_of_p(double gap) const {
  return settings_.objective == Objective::grip ? gap : 1 - std::sqrt(1 - gap);
}

Posture<3> Values::posture(const Vector<3>& up) const {
  const bool is_grip = settings_.objective == Objective::grip;
  return posture_at(grasp_, up, {is_grip ? no_cap : settings_.force_cap, settings_.objective});
}

void check_unit(const char* name, const Vector<3>& up) {
  if (!(std::abs(up.squaredNorm() - 1) <= 1e-6)) throw InvalidGrasp(name, "must be a unit vector");
}

}  // namespace poise::turns
