#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "verify/checks.hpp"
#include "verify/curve.hpp"

namespace poise::verify {
namespace {

/// How V or F runs around an optimum; slopes are per radian, of it.
struct Surroundings {
  Real off{1};       ///< how far the optimum's value is from that of the nearest arc
  Real value{0};     ///< that
  Real steep{0};     ///< how steeply it falls away from a minimum, or rises from a maximum
  Real jump{0};      ///< of the slope from one side to the other
  Real differs{0};   ///< how far it leaves the optimum's value along the stretch
  Real flattest{1};  ///< the least slope of an arc there
  Real rounding{0};  ///< of the value
  bool at_end{false}, fits{false};
};

/// Where an optimum lies, seen from an arc.
struct Stretch {
  Real from, to, value;
  Real little;  ///< what is little beside any value

  Real off(Real other) const { return difference(other, value, little); }
  Real slope(const RealArc& arc, Real theta) const {
    return arc.value.slope(theta) / (std::max(value, little) + 1e-4L * arc.value.scale());
  }
};

/// One-sided slopes, of the arcs that reach the ends of the stretch.
struct Slopes {
  std::optional<Real> before, after;
};

void look_at(const RealArc& arc, const Stretch& stretch, Slopes& slopes, Surroundings& around) {
  const Real from = std::clamp(stretch.from, arc.from, arc.to);
  const Real to = std::clamp(stretch.to, arc.from, arc.to);
  if (std::abs(from - stretch.from) <= end_slack && arc.to - stretch.from >= -end_slack) {
    if (stretch.off(arc.value(from)) < around.off) {
      around.off = stretch.off(arc.value(from));
      around.value = arc.value(from);
    }
    around.flattest = std::min(around.flattest, std::abs(stretch.slope(arc, from)));
    around.rounding = std::max(around.rounding, 1e-13L * arc.value.scale());
  }
  if (arc.is_sliver()) return;
  if (stretch.from > arc.from + end_slack && stretch.from <= arc.to + 2 * end_slack &&
      arc.to > arc.from)
    slopes.before = stretch.slope(arc, from);
  if (stretch.to >= arc.from - 2 * end_slack && stretch.to < arc.to - end_slack)
    slopes.after = stretch.slope(arc, to);
  const Real first = std::max(stretch.from, arc.from), last = std::min(stretch.to, arc.to);
  if (first < last)
    for (const Real theta : {first, last})
      around.differs = std::max(around.differs, stretch.off(arc.value(theta)));
}

Surroundings surroundings(const RealOptimum& optimum, const std::vector<Chain>& chains,
                          Extremum type, Real little) {
  const Real sign = type == Extremum::max ? -1 : 1;
  Surroundings around;
  for (const Chain& chain : chains) {
    const Real start = chain.from();
    const Real here = unwound(optimum.from, start), last = here + optimum.to - optimum.from;
    const Real beyond = std::max(start - here, last - chain.to());
    if (!chain.circle && beyond > end_slack) continue;
    around.fits = true;
    around.at_end =
        !chain.circle && (here - start <= 2 * end_slack || chain.to() - last <= 2 * end_slack);
    Slopes slopes;
    for (const RealArc& arc : chain.arcs)
      for (const Real turn : {Real{0}, -2 * pi, 2 * pi})  // where a circle is closed
        look_at(arc, {here - turn, last - turn, value(optimum.claim), little}, slopes, around);
    if (slopes.before) around.steep = std::max(around.steep, sign * *slopes.before);
    if (slopes.after) around.steep = std::max(around.steep, -sign * *slopes.after);
    if (slopes.before && slopes.after) around.jump = *slopes.after - *slopes.before;
  }
  return around;
}

bool is_kind(Kind kind, const Surroundings& around, bool stretch) {
  if (kind == Kind::boundary) return around.at_end;
  // A kink may be as near to the end as an arc is narrow.
  if (kind == Kind::kink) return !stretch && around.jump > 1e-12L;
  return !around.at_end && (stretch || around.jump < 1e-6L || around.flattest < 1e-5L);
}

Real cross(const Vec& a, const Vec& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The edges along which two contacts press, and the vertical through the com, meet in one point.
void check_meeting(Verdict& verdict, const RealGrasp& grasp, const RealOptimum& optimum) {
  const OptimumClaim& claim = optimum.claim;
  std::vector<std::size_t> loaded;
  bool slipping = claim.kind == Kind::kink;
  for (std::size_t i = 0; i < claim.contacts.size(); ++i) {
    if (claim.contacts[i].state == ContactState::unloaded) continue;
    slipping = slipping && claim.contacts[i].state == ContactState::slipping;
    loaded.push_back(i);
  }
  if (claim.contacts.size() != grasp.contacts.size()) return;
  const Path place = optimum.place / "edges_meet";
  const std::size_t named = claim.load.value_or(0);
  const RealLoad& load = grasp.loads[named < grasp.loads.size() ? named : 0];
  const bool meets = slipping && loaded.size() == 2 && load.still().isZero(0);
  verdict.check(place,
                "edges_meet is told of a kink of two slipping contacts against a weight alone, and "
                "of no other",
                claim.edges_meet.has_value() == meets);
  if (!claim.edges_meet || loaded.size() != 2) return;
  std::array<Vec, 2> edges;
  for (std::size_t k = 0; k < 2; ++k) edges[k] = real(claim.contacts[loaded[k]].force).normalized();
  const Real sine = std::abs(cross(edges[0], edges[1]));
  if (!*claim.edges_meet) return verdict.check(place, "edges are parallel", sine, 1.1e-9L);
  const Vec point = real(**claim.edges_meet);
  const Real extent = (point - load.com).norm() + load.radius, size = extent > 0 ? extent : 1;
  for (std::size_t k = 0; k < 2; ++k)
    verdict.check(place, "edges_meet is on the edges of the cones [of its distance]",
                  std::abs(cross(point - grasp.contacts[loaded[k]].position, edges[k])) / size,
                  1e-9L);
  verdict.check(place, "edges_meet is on the vertical through the com [of its distance]",
                std::abs(cross(point - load.com, real(claim.up))) / size,
                1e-9L / std::max(sine, Real{1e-6L}));
}

/// Postures, next to each other, that are as low (or, turned round, as high) as any around.
struct Valley {
  Real from, to;
};

/// A point of the curve, with what rounding leaves of its value.
struct CurvePoint {
  Real theta, value, rounding;
};

/// All ends and turning points along a chain of sign * its value.
std::vector<CurvePoint> points_of(const Chain& chain, Real sign) {
  std::vector<CurvePoint> points;
  for (int round = 0; round < (chain.circle ? 2 : 1); ++round)  // twice around: none is at an end
    for (const RealArc& arc : chain.arcs)
      for (const Real theta : arc.value.turning_points(arc.from, arc.to))
        points.push_back({theta + 2 * pi * round, sign * arc.value(theta),
                          1e-9L * std::abs(arc.value(theta)) + 1e-12L * arc.value.scale()});
  return points;
}

/// The neighbours of a point that are as low.
Valley valley_around(const std::vector<CurvePoint>& points, std::size_t k) {
  const Real level = points[k].value + points[k].rounding;
  std::size_t first = k, last = k;
  while (first > 0 && points[first - 1].value <= level) --first;
  while (last + 1 < points.size() && points[last + 1].value <= level) ++last;
  return {points[first].theta, points[last].theta};
}

/// The local minima of sign * its value along a chain that are deeper than rounding.
std::vector<Valley> valleys(const Chain& chain, Real sign) {
  const std::vector<CurvePoint> points = points_of(chain, sign);
  std::vector<Valley> found;
  std::size_t lowest = 0, highest = 0;  // since the last turn
  bool falling = !chain.circle;         // may the way down be the end
  for (std::size_t k = 0; k < points.size(); ++k) {
    const CurvePoint& p = points[k];
    if (falling) {
      if (p.value < points[lowest].value) lowest = k;
      if (p.value <= points[lowest].value + p.rounding + points[lowest].rounding) continue;
      found.push_back(valley_around(points, lowest));
      falling = false;
      highest = k;
    } else {
      if (p.value > points[highest].value) highest = k;
      if (p.value >= points[highest].value - p.rounding - points[highest].rounding) continue;
      falling = true;
      lowest = k;
    }
  }
  if (falling && !chain.circle) found.push_back(valley_around(points, lowest));
  if (chain.circle && found.empty())
    found.push_back({points.front().theta, points.front().theta + 2 * pi});
  return found;
}

/// Of ties the least turn from the present posture is first, then that counter-clockwise.
void check_turns(Verdict& verdict, const RealOptimum& a, const RealOptimum& b, Real present) {
  const Real turn_a = std::remainder(a.angle - present, 2 * pi);
  const Real turn_b = std::remainder(b.angle - present, 2 * pi);
  const Real more = std::abs(turn_b) - std::abs(turn_a);
  const bool either_way = std::abs(more) > 0.9e-9L || std::abs(turn_b) > pi - 1e-9L;
  verdict.check(b.place, "of ties that of the least turn from the present is first",
                more > -1.1e-9L && (either_way || turn_b < turn_a + 1e-9L));
}

/// Checks the order of sign * value: ties are those within a part of 1e-6 of the lowest that is
/// left.
void check_order(Verdict& verdict, const std::vector<RealOptimum>& optima, Real sign,
                 Real present) {
  constexpr Real tie = 1e-6L;
  for (std::size_t first = 0; first < optima.size();) {
    const auto low = std::min_element(
        optima.begin() + static_cast<std::ptrdiff_t>(first), optima.end(),
        [&](const auto& a, const auto& b) { return sign * a.value < sign * b.value; });
    const auto beyond = [&](const RealOptimum& optimum) {
      return std::abs(optimum.value - low->value) - tie * std::abs(low->value);
    };
    const auto rounding = [&](const RealOptimum& optimum) {
      return 1e-12L * std::abs(low->value) + low->rounding + optimum.rounding;
    };
    std::size_t last = first + 1;
    for (std::size_t k = last; k < optima.size(); ++k) {
      if (std::abs(beyond(optima[k])) <= rounding(optima[k])) return;  // either is right
      if (beyond(optima[k]) < 0) last = k + 1;
    }
    for (std::size_t k = first; k < last; ++k) {
      verdict.check(optima[k].place, "optima are in the order of their values", beyond(optima[k]),
                    rounding(optima[k]));
      if (k > first) check_turns(verdict, optima[k - 1], optima[k], present);
    }
    first = last;
  }
}

}  // namespace

RealOptimum check_optimum(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                          const OptimumClaim& claim, const std::vector<Chain>& chains,
                          Extremum type, const OptionsClaim& options) {
  check_least_hold<2>(verdict, place, grasp, claim, options.force_cap,
                      claim.kind == Kind::boundary);
  verdict.check(place / "objective", "objective is that of the options",
                claim.objective == options.objective);
  const Real theta = radians_of(claim.angle_deg);
  RealOptimum optimum{place, claim, theta, theta, theta};
  verdict.check(place, "an optimum is holdable", claim.holdable);
  if (!claim.holdable) return optimum;
  verdict.check(place, "a stretch has both its ends",
                claim.from_deg.has_value() == claim.to_deg.has_value());
  if (claim.from_deg && claim.to_deg) {
    optimum.from = radians_of(*claim.from_deg);
    optimum.to = radians_of(*claim.to_deg);
    const Real present = radians_of(options.present_deg.value_or(0));
    const Real turn =
        std::min(angle_between(present, optimum.from), angle_between(present, optimum.to));
    verdict.check(place, "the posture lies in its stretch",
                  within(theta, optimum.from, optimum.to, 1e-9L));
    verdict.check(
        place, "of its stretch the posture is the nearest to the present [rad]",
        angle_between(theta, present) - (within(present, optimum.from, optimum.to, 0) ? 0 : turn),
        1e-9L);
  }
  const Real little = verify::little(grasp, claim.objective);
  const Surroundings around = surroundings(optimum, chains, type, little);
  optimum.value = around.value;
  optimum.rounding = around.rounding;
  verdict.check(place, "the posture lies in a holdable interval", around.fits);
  verdict.check(place, "its value is that of its arc", around.off,
                1e-7L + around.rounding / std::max(value(claim), little));
  verdict.check(place, "V or F rises from a minimum and falls from a maximum [of it, per rad]",
                around.steep, 1e-5L);
  const Real width = optimum.to - optimum.from;
  if (width > 0)
    verdict.check(place, "V or F is the same along the stretch", around.differs,
                  1e-7L + around.rounding / std::max(value(claim), little));
  verdict.check(place / "kind", "kind follows from the arcs",
                is_kind(claim.kind, around, width > 1e-8L));
  check_meeting(verdict, grasp, optimum);
  return optimum;
}

void check_complete(Verdict& verdict, const Path& list, const std::vector<RealOptimum>& optima,
                    const std::vector<Chain>& chains, Extremum type, Real present) {
  const bool maxima = type == Extremum::max;
  const std::string words = maxima ? "maxima" : "minima";
  for (const Chain& chain : chains)
    for (const Valley& valley : valleys(chain, maxima ? -1 : 1)) {
      const auto inside = [&](const RealOptimum& optimum) {
        return within(optimum.angle, valley.from, valley.to, 2 * end_slack) ||
               within(valley.from, optimum.from, optimum.to, 2 * end_slack);
      };
      verdict.check(list, "all " + words + " of the arcs are in the list",
                    std::any_of(optima.begin(), optima.end(), inside));
    }
  for (std::size_t i = 0; i < optima.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      verdict.check(optima[i].place, words + " are listed once",
                    angle_between(optima[i].angle, optima[k].angle) > 1e-9L);
  check_order(verdict, optima, maxima ? -1 : 1, present);
}

}  // namespace poise::verify
