#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ask/document.hpp"
#include "verify/checks.hpp"
#include "verify/space.hpp"
#include "verify/trig.hpp"

namespace poise::verify {
namespace {

using Quaternion = Eigen::Quaternion<Real>;

/// Postures on each step of a turn, at which it is checked what is needed.
constexpr int samples = 48;
/// What rounding may make out in what a posture needs, and in angles [rad].
constexpr Real of_value = 1e-6L, of_angle = 1e-9L;

Quaternion quaternion(const RotationClaim& q) { return {q.w, q.x, q.y, q.z}; }
RotationClaim start_of(const OptionsClaim& options) {
  return options.orientation.value_or(RotationClaim{});
}
Vec3 up_in(const Quaternion& orientation) {
  return orientation.normalized().conjugate() * Vec3(Vec3::UnitZ());
}
Real angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// What turns are checked with.
template <int Dim>
struct Turning {
  Verdict& verdict;
  const Grasp<Dim>& given;
  const RealGrasp& grasp;
  const OptionsClaim& options;

  /// A hold in a posture of which the document does not tell the forces. Whoever finds them, they
  /// are checked like a claim.
  HoldClaim<Dim> witness(const Path& place, const Vec& up) const {
    HoldAnswer<Dim> answer;
    const Objective objective = options.objective.value_or(Objective::effort);
    // Of turns the cap limits the grip, where that is least, and the force norm where that is.
    const double cap = objective == Objective::grip ? 1e9 : options.force_cap;
    answer.settings = {cap, objective};
    const Vector<Dim> rounded = up.template cast<double>().normalized();
    try {
      answer.posture = posture_at(given, rounded, answer.settings);
    } catch (const InvalidGrasp&) {  // options or orientations that make no sense
      verdict.check(place, "a posture can be asked for", false);
      return {};
    }
    const HoldClaim<Dim> claim = claims_of(given, answer);
    if (claim.holdable) {
      Verdict own;
      check_hold<Dim>(own, place, grasp, claim, cap);
      verdict.check(place, "forces found for it are right", own.confirmed());
    }
    return claim;
  }

  Real needed(const Path& place, const Vec& up) const {
    const HoldClaim<Dim> claim = witness(place, up);
    return claim.holdable ? value(claim) : std::numeric_limits<Real>::infinity();
  }

  /// At most `peak`, relative to it.
  void check_most(const Path& place, const Vec& up, Real peak, const std::string& words) const {
    const Real slack = of_value * little(grasp, options.objective);
    verdict.check(place, words, (needed(place, up) - peak) / std::max(peak, slack), of_value);
  }

  /// `up_at` of the angle from the start.
  template <class UpAt>
  void check_peak(const Path& place, const PeakClaim<Dim>& claim, const UpAt& up_at,
                  Real gap) const {
    const Real whole = radians_of(claim.turn_deg);
    const bool told = claim.peak && claim.lower_bound && claim.peak_at;
    verdict.check(place / "peak",
                  "a turn has a peak with its place, or postures that cannot be held",
                  told == claim.unholdable.empty() && told == claim.peak.has_value() &&
                      told == claim.lower_bound.has_value() && told == claim.peak_at.has_value());
    for (std::size_t k = 0; k < claim.unholdable.size(); ++k)
      check_stretch((place / "unholdable")[k], claim.unholdable[k], whole, up_at);
    if (!claim.unholdable.empty())
      verdict.unchecked(place / "unholdable",
                        "where each begins and ends, and that there are no others");
    if (!told) return;
    const Real peak = *claim.peak, bound = *claim.lower_bound;
    const TurnPostureClaim<Dim>& at = *claim.peak_at;
    check_on_turn(place / "peak_at", at, whole, up_at);
    verdict.check(place / "peak_at", "the peak is held", at.holdable);
    verdict.check(place / "lower_bound", "the posture at the peak needs at least lower_bound",
                  (bound - value(at)) / std::max(peak, little(grasp, options.objective)), of_value);
    verdict.check(place / "peak", "lower_bound is within the gap of the peak",
                  (peak - bound) / std::max(peak, little(grasp, options.objective)),
                  gap + of_value);
    for (int k = 0; k <= samples; ++k)
      check_most(place / "peak", up_at(whole * k / samples), peak,
                 "no posture of the turn needs more than the peak");
  }

 private:
  template <class UpAt>
  void check_on_turn(const Path& place, const TurnPostureClaim<Dim>& claim, Real whole,
                     const UpAt& up_at) const {
    check_least_hold<Dim>(verdict, place, grasp, claim, options.force_cap);
    const Real turn = radians_of(claim.turn_deg);
    verdict.check(place / "turn_deg", "the posture is one of the turn [rad]",
                  std::max(std::abs(turn) - std::abs(whole), -turn * (whole < 0 ? -1 : 1)),
                  of_angle);
    verdict.check(place / "up", "up is that after so much of the turn",
                  (real(claim.up) - Vec(up_at(turn))).norm(), of_angle);
  }

  template <class UpAt>
  void check_stretch(const Path& place, const StretchClaim<Dim>& claim, Real whole,
                     const UpAt& up_at) const {
    check_on_turn(place / "posture", claim.posture, whole, up_at);
    verdict.check(place / "posture", "it cannot be held", !claim.posture.holdable);
    const Real side = whole < 0 ? -1 : 1, turn = side * radians_of(claim.posture.turn_deg);
    const Real from = side * radians_of(claim.from_deg), to = side * radians_of(claim.to_deg);
    verdict.check(place, "the posture lies in the stretch, and this on the turn [rad]",
                  std::max({from - turn, turn - to, -from, to - side * whole}), of_angle);
  }
};

Vec planar_up(Real theta) {
  Vec up(2);
  up << std::sin(theta), std::cos(theta);
  return up;
}

/// Of ways round from the present posture by as much as each says.
void check_turn(Verdict& verdict, const Path& place, const Grasp<2>& given, const RealGrasp& grasp,
                const OptionsClaim& options, const TurnClaim<2>& turn, Real from, Real to) {
  const Turning<2> turning{verdict, given, grasp, options};
  const auto up_at = [&](Real angle) { return planar_up(from + angle); };
  const auto check_way = [&](const Path& way, const PeakClaim<2>& claim) {
    verdict.check(way / "turn_deg", "the turn leads from the one posture to the other [rad]",
                  std::abs(std::remainder(from + radians_of(claim.turn_deg) - to,
                                          2 * std::numbers::pi_v<Real>)),
                  of_angle);
    turning.check_peak(way, claim, up_at, 0);
  };
  const bool is_all = options.domain.value_or(Domain::all) == Domain::all;
  verdict.check(place / "turn_deg", "the turn is the shorter way round in the domain [degrees]",
                std::abs(turn.turn_deg) - (is_all ? 180 : 360), of_angle);
  verdict.check(place / "other_way", "in all postures there is another way round",
                !is_all || turn.other_way || turn.turn_deg == 0);
  check_way(place, turn);
  if (!turn.other_way) return;
  check_way(place / "other_way", *turn.other_way);
  verdict.check(place / "other_way", "the ways round make a whole turn [degrees]",
                std::abs(std::abs(turn.turn_deg - turn.other_way->turn_deg) - 360), 1e-7L);
}

/// Checks the turn from an orientation to a posture, in the world frame.
void check_rotation(Verdict& verdict, const Path& top, const OptionsClaim& options,
                    const TurnClaim<3>& claim, const Vec3& to) {
  const Path place = top / "rotation";
  const Quaternion before = quaternion(start_of(options)).normalized();
  const Quaternion turn = quaternion(claim.rotation);
  verdict.check(place, "rotation has length 1", std::abs(turn.norm() - 1), 1e-12L);
  verdict.check(place, "rotation has w >= 0", turn.w() >= 0);
  const Vec3 world = before * to;
  verdict.check(place, "rotation takes up to the world's +z", (turn * world - Vec3::UnitZ()).norm(),
                1e-11L);
  // A turn takes no longer way than the angle between the two directions.
  const Real angle = std::atan2(world.head<2>().norm(), world[2]);
  const Real taken = 2 * std::atan2(turn.vec().norm(), turn.w());
  verdict.check(place, "rotation is the smallest [rad]", std::abs(taken - angle), 1e-7L);
  verdict.check(place / "angle_deg", "angle_deg is that of rotation [rad]",
                std::abs(radians_of(claim.rotation.angle_deg.value_or(-1)) - taken), 1e-11L);
  verdict.check(top / "turn_deg", "turn_deg is that of rotation [rad]",
                std::abs(radians_of(claim.turn_deg) - taken), 1e-7L);
  const Quaternion after = quaternion(claim.orientation), expected = turn * before;
  verdict.check(top / "orientation", "orientation is that after the rotation",
                std::min((after.coeffs() - expected.coeffs()).norm(),
                         (after.coeffs() + expected.coeffs()).norm()),
                1e-11L);
}

/// Where the straight turn leads after an angle: the axis is fixed in the world.
Vec3 up_after(const Quaternion& before, const Quaternion& rotation, Real angle) {
  const Real sine = rotation.vec().norm();
  const Vec3 axis = sine > 0 ? Vec3(rotation.vec() / sine) : Vec3(Vec3::UnitX());
  return up_in(Quaternion(Eigen::AngleAxis<Real>(angle, axis)) * before);
}

/// Checks that a list of orientations leads from the present one to a posture by smallest turns, on
/// which nothing needs more than the peak.
void check_steps(const Turning<3>& turning, const Path& place,
                 const std::vector<RotationClaim>& orientations, const Vec3& to, Real peak) {
  Verdict& verdict = turning.verdict;
  const Path list = place / "orientations";
  verdict.check(list, "there are orientations", !orientations.empty());
  if (orientations.empty()) return;
  const Quaternion start = quaternion(start_of(turning.options)).normalized();
  const auto apart = [](const Quaternion& a, const Quaternion& b) {
    return std::min((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm());
  };
  verdict.check(list, "the first orientation is the present one",
                apart(quaternion(orientations.front()), start), of_angle);
  verdict.check(list, "the last orientation has the posture's up",
                (up_in(quaternion(orientations.back())) - to).norm(), of_angle);
  for (std::size_t k = 0; k + 1 < orientations.size(); ++k) {
    const Quaternion before = quaternion(orientations[k]), after = quaternion(orientations[k + 1]);
    verdict.check(list[k + 1], "orientations have length 1",
                  std::abs(after.norm() - 1) + std::abs(before.norm() - 1), of_angle);
    Quaternion step = after * before.conjugate();
    if (step.w() < 0) step.coeffs() = -step.coeffs();
    const Real taken = 2 * std::atan2(step.vec().norm(), step.w());
    verdict.check(list[k + 1], "no step of a way is none", taken > 0);
    verdict.check(list[k + 1], "each step is the smallest turn between postures [rad]",
                  taken - angle_between(up_in(before), up_in(after)), 1e-7L);
    for (int i = 0; i <= samples; ++i)
      turning.check_most(list[k + 1], up_after(before, step, taken * i / samples), peak,
                         "no posture of the way needs more than its peak");
  }
}

/// The least a . x on the shorter arc between unit vectors.
Real least_on_arc(const Vec3& a, const Vec3& p, const Vec3& q) {
  const Real angle = angle_between(p, q);
  if (!(angle > 1e-15L)) return std::min(a.dot(p), a.dot(q));
  const Vec3 across = (q - p.dot(q) * p).normalized();
  // a . (cos t p + sin t across) is least where the direction points against a.
  const Real t = std::atan2(-a.dot(across), -a.dot(p));
  if (t > 0 && t < angle) return -std::hypot(a.dot(p), a.dot(across));
  return std::min(a.dot(p), a.dot(q));
}

/// Whether a closed curve of arcs crosses the arc between two postures an odd number of times.
bool is_between(const std::vector<WallClaim>& wall, const Vec3& from, const Vec3& to) {
  // Of opposite postures any half of a great circle between them will do.
  const Vec3 n = from.cross(to).norm() > 1e-9L ? Vec3(from.cross(to)) : from.unitOrthogonal();
  int crossings = 0;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    const Vec3 p = wall[k].up.cast<Real>(), q = wall[(k + 1) % wall.size()].up.cast<Real>();
    const Real before = n.dot(p), after = n.dot(q);
    if ((before >= 0) == (after >= 0)) continue;
    const Vec3 at = std::abs(after) * p + std::abs(before) * q;
    if (from.cross(at).dot(n) > 0 && at.cross(to).dot(n) > 0) ++crossings;
  }
  return crossings % 2 == 1;
}

/// Checks that no way from a posture to another gets past a wall at or above the level.
void check_wall(const Turning<3>& turning, const Path& place, const std::vector<WallClaim>& wall,
                const Vec3& from, const Vec3& to, Real level) {
  Verdict& verdict = turning.verdict;
  verdict.check(place, "the wall separates the postures", is_between(wall, from, to));
  for (std::size_t k = 0; k < wall.size(); ++k) {
    const Vec3 p = wall[k].up.cast<Real>(), q = wall[(k + 1) % wall.size()].up.cast<Real>();
    verdict.check(place[k] / "up", "up has length 1", std::abs(p.norm() - 1), of_angle);
    verdict.check(place[k] / "up", "parts of a wall are no longer than half a turn",
                  angle_between(p, q) < 3.1L);
    const auto half =
        check_cut(verdict, place[k], turning.grasp, wall[k].cut, turning.options, level);
    verdict.check(
        place[k], "the part's cut proves the bound all along it",
        half ? (half->b - least_on_arc(half->a, p, q)) / std::max(std::abs(half->b), 1e-3L) : 1,
        of_value);
  }
}

void check_way(const Turning<3>& turning, const Path& place, const WayClaim& way, const Vec3& from,
               const Vec3& to, Real gap) {
  Verdict& verdict = turning.verdict;
  verdict.unchecked(place / "holds", "how many holds the proof took");
  const bool is_none = way.status == Status::unholdable;
  verdict.check(place / "peak", "there is a peak where there is a way",
                way.peak.has_value() == !way.orientations.empty() && !(way.peak && is_none));
  if (way.peak) check_steps(turning, place, way.orientations, to, *way.peak);
  const Real bound = way.lower_bound.value_or(0);
  verdict.check(place / "lower_bound", "the bound is null only where there is no way",
                way.lower_bound.has_value() == !is_none);
  if (way.status == Status::optimal)
    verdict.check(
        place / "status", "an optimal way is within the gap of its bound",
        way.peak ? (*way.peak - bound) /
                       std::max(Real{*way.peak}, little(turning.grasp, turning.options.objective))
                 : 1,
        gap + of_value);
  if (!way.wall.empty())
    return check_wall(turning, place / "wall", way.wall, from, to,
                      is_none ? most_held(turning.grasp, turning.options) : bound);
  const Real ends = std::max(turning.needed(place, from), turning.needed(place, to));
  verdict.check(
      place / "lower_bound", "without a wall an end of the way needs the bound",
      is_none ? (ends < std::numeric_limits<Real>::infinity() ? 1 : 0)
              : (bound - ends) / std::max(bound, little(turning.grasp, turning.options.objective)),
      of_value);
}

void check_turn(const Turning<3>& turning, const Path& place, const TurnClaim<3>& turn,
                const Vec3& to, Real gap) {
  const OptionsClaim& options = turning.options;
  check_rotation(turning.verdict, place, options, turn, to);
  const Quaternion before = quaternion(start_of(options)).normalized();
  const Quaternion rotation = quaternion(turn.rotation);
  turning.check_peak(
      place, turn, [&](Real angle) { return up_after(before, rotation, angle); }, gap);
  if (turn.way) check_way(turning, place / "way", *turn.way, up_in(before), to, gap);
}

}  // namespace

void check_turns(Verdict& verdict, const Grasp<2>& given, const RealGrasp& grasp,
                 const BestDocument<2>& best) {
  const Real from = radians_of(best.options.present_deg.value_or(0));
  if (best.turn && best.best)
    check_turn(verdict, Path() / "turn", given, grasp, best.options, *best.turn, from,
               radians_of(best.best->angle_deg));
  if (!best.without_pressing_harder) return;
  const ReachableClaim<2>& near = *best.without_pressing_harder;
  const Path place = Path() / "without_pressing_harder";
  const Turning<2> turning{verdict, given, grasp, best.options};
  check_least_hold<2>(verdict, place, grasp, near, best.options.force_cap);
  verdict.check(place, "it is held", near.holdable);
  // What is needed between the ends, and where.
  const Real least = radians_of(near.least_turn_deg), most = radians_of(near.most_turn_deg);
  const Real turn = radians_of(near.turn_deg), now = turning.needed(place, planar_up(from));
  verdict.check(place / "turn_deg", "the turn lies between its ends [rad]",
                std::max({least - turn, turn - most, least, -most}), of_angle);
  verdict.check(place / "up", "up is that after the turn",
                (real(near.up) - planar_up(from + turn)).norm(), of_angle);
  for (int k = 0; k <= samples; ++k) {
    const Real angle = least + (most - least) * k / samples;
    const Vec up = planar_up(from + std::clamp(angle, least + 1e-8L, most - 1e-8L));
    if (most - least < 1e-7L) break;
    turning.check_most(place, up, now, "no posture between the ends needs more than now");
    verdict.check(place, "no posture between the ends needs less",
                  (value(near) - turning.needed(place, up)) /
                      std::max(value(near), little(grasp, best.options.objective)),
                  of_value);
  }
  verdict.unchecked(place, "that what is beyond the ends needs more than now");
}

void check_turns(Verdict& verdict, const Grasp<3>& given, const RealGrasp& grasp,
                 const BestDocument<3>& best) {
  OptionsClaim options = best.options;
  const Turning<3> turning{verdict, given, grasp, options};
  const Real gap = TurnSettings{}.gap;
  if (best.turn && best.best)
    check_turn(turning, Path() / "turn", *best.turn, Vec3(best.best->up.cast<Real>()), gap);
  if (!best.without_pressing_harder) return;
  const ReachableClaim<3>& near = *best.without_pressing_harder;
  const Path place = Path() / "without_pressing_harder";
  check_least_hold<3>(verdict, place, grasp, near, options.force_cap);
  verdict.check(place, "it is held", near.holdable);
  const Vec3 from = up_in(quaternion(start_of(options)));
  const Real now = turning.needed(place, from);
  verdict.check(place / "peak", "the way there needs no more than now, but for the gap",
                near.peak / (now / (1 - gap)) - 1, of_value);
  if (near.orientations.size() > 1)
    check_steps(turning, place, near.orientations, Vec3(near.up.cast<Real>()), near.peak);
  const Real reached = (value(near) - near.reachable_bound) /
                       std::max(value(near), little(grasp, options.objective));
  verdict.check(place / "status", "status is optimal where the gap is the wanted one, else gap",
                near.status == Status::optimal ? reached - gap
                : near.status == Status::gap   ? gap - reached
                                               : 1,
                of_value);
  verdict.unchecked(place / "reachable_bound", "that no posture that can be reached needs less");
  verdict.unchecked(place / "holds", "how many holds it took");
}

void check_turn_document(Verdict& verdict, const Grasp<2>& given, const RealGrasp& grasp,
                         const TurnDocument<2>& turn) {
  check_options(verdict, 2, turn.options, {"domain", "present_deg", "objective"},
                {"angle_deg", "up"});
  const Real from = radians_of(turn.options.present_deg.value_or(0));
  check_least_hold(verdict, Path() / "now", grasp, turn.now, turn.options.force_cap);
  check_least_hold(verdict, Path() / "then", grasp, turn.then, turn.options.force_cap);
  check_up(verdict, Path() / "now", real(turn.now.up), planar_up(from),
           "now is the present posture");
  if (const auto up = asked_up(turn.options))
    check_up(verdict, Path() / "then", real(turn.then.up), *up, "then is the posture asked for");
  check_turn(verdict, Path() / "turn", given, grasp, turn.options, turn.turn, from,
             radians_of(turn.then.angle_deg));
}

void check_turn_document(Verdict& verdict, const Grasp<3>& given, const RealGrasp& grasp,
                         const TurnDocument<3>& turn) {
  check_options(verdict, 3, turn.options, {"gap", "max_holds", "objective", "orientation", "up"},
                {"tilt"});
  check_least_hold(verdict, Path() / "now", grasp, turn.now, turn.options.force_cap);
  check_least_hold(verdict, Path() / "then", grasp, turn.then, turn.options.force_cap);
  check_up(verdict, Path() / "now", real(turn.now.up), up_in(quaternion(start_of(turn.options))),
           "now is the present posture");
  if (const auto up = asked_up(turn.options))
    check_up(verdict, Path() / "then", real(turn.then.up), *up, "then is the posture asked for");
  check_turn({verdict, given, grasp, turn.options}, Path() / "turn", turn.turn,
             Vec3(turn.then.up.cast<Real>()), turn.options.gap.value_or(TurnSettings{}.gap));
}

}  // namespace poise::verify
