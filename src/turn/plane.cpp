#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/harmonic.hpp"
#include "poise/turn.hpp"

namespace poise {
namespace {

using std::numbers::pi;

/// Narrower gaps between holdable postures [rad] are rounding, see UnholdableArc.
constexpr double rounding = 1e-8;
/// Postures nearer to each other [rad] are one.
constexpr double same_posture = 1e-12;
/// Peaks are equal within this part.
constexpr double tie = 1e-9;

/// Calls f(from, to, item) with the parts of the items, which repeat with every turn, between lo
/// and hi.
template <class Items, class F>
void each_between(const Items& items, double lo, double hi, const F& f) {
  for (const auto& item : items)
    for (double turn = std::floor((lo - item.to) / (2 * pi)) * 2 * pi; item.from + turn <= hi;
         turn += 2 * pi) {
      const double from = std::max(lo, item.from + turn), to = std::min(hi, item.to + turn);
      if (from <= to) f(from, to, item);
    }
}

/// The angle at which an arc needs most between two others, and how much.
std::pair<double, double> greatest(const Arc& arc, double from, double to) {
  std::pair<double, double> most{from, arc.value(from)};
  const auto consider = [&](double at) {
    if (const double value = arc.value(at); value > most.second) most = {at, value};
  };
  consider(to);
  for (const Root& root : sign_changes(derivative(arc.value), from, to)) consider(root.at);
  return most;
}

/// The gaps that the holdable postures leave between lo and hi, ascending.
std::vector<Interval> gaps(const PostureCurve& curve, double lo, double hi) {
  std::vector<Interval> held;
  each_between(curve.holdable, lo, hi, [&](double from, double to, const Interval&) {
    held.push_back({from, to});
  });
  std::sort(held.begin(), held.end(),
            [](const Interval& a, const Interval& b) { return a.from < b.from; });
  std::vector<Interval> open;
  double reached = lo;
  for (const Interval& each : held) {
    if (each.from > reached + rounding) open.push_back({reached, each.from});
    reached = std::max(reached, each.to);
  }
  const bool none = held.empty();
  if (none || hi > reached + rounding) open.push_back({reached, hi});
  return open;
}

TurnPeak<2> peak_on(const Grasp<2>& grasp, const PostureCurve& curve, double start, double angle,
                    const CurveSettings& settings) {
  const double lo = std::min(start, start + angle), hi = std::max(start, start + angle);
  TurnPeak<2> result;
  result.angle = angle;
  double value = -1, theta = start;
  each_between(curve.arcs, lo, hi, [&](double from, double to, const Arc& arc) {
    const auto [at, most] = greatest(arc, from, to);
    // Of equal ones the first on the way.
    if (most > value * (1 + tie) ||
        (most >= value * (1 - tie) && std::abs(at - start) < std::abs(theta - start))) {
      value = std::max(value, most);
      theta = at;
    }
  });
  const HoldSettings hold_settings{settings.force_cap, settings.objective};
  for (const Interval& gap : gaps(curve, lo, hi)) {
    const double middle = (gap.from + gap.to) / 2;
    UnholdableStretch<2> stretch{gap.from - start, gap.to - start, middle - start,
                                 posture_at(grasp, up_at(middle), hold_settings)};
    if (angle < 0) std::swap(stretch.from, stretch.to);
    result.unholdable.push_back(std::move(stretch));
  }
  if (angle < 0) std::reverse(result.unholdable.begin(), result.unholdable.end());
  if (result.unholdable.empty()) {
    const Optimum peak{.angle = theta, .from = theta, .to = theta, .value = value};
    result.peak = result.lower_bound = value;
    result.at = std::clamp(theta - start, std::min(0.0, angle), std::max(0.0, angle));
    result.posture = minimum_at(grasp, peak, settings);
  } else {
    result.peak = result.lower_bound = std::numeric_limits<double>::infinity();
    result.at = result.unholdable.front().at;
    result.posture = result.unholdable.front().posture;
  }
  return result;
}

/// The curve of all postures, whatever the domain.
PostureCurve whole_curve(const Grasp<2>& grasp, CurveSettings settings) {
  settings.domain = Domain::all;
  return posture_curve(grasp, settings);
}

/// How far from a posture, one way round, the curve stays at or below a level.
double stretch_below(const PostureCurve& curve, double start, double side, double level) {
  const double lo = side < 0 ? start - 2 * pi : start, hi = lo + 2 * pi;
  double reached = 2 * pi;
  const auto stop = [&](double at) { reached = std::min(reached, std::abs(at - start)); };
  for (const Interval& gap : gaps(curve, lo, hi)) stop(side < 0 ? gap.to : gap.from);
  each_between(curve.arcs, lo, hi, [&](double from, double to, const Arc& arc) {
    Harmonic2 above = arc.value;
    above.c0 -= level;
    const double nearer = side < 0 ? to : from;
    if (above(nearer) > 0) stop(nearer);
    for (const Root& root : sign_changes(above, from, to))
      if (root.rising == (side > 0)) stop(root.at);
  });
  return reached;
}

bool is_within(const Interval& domain, double lo, double hi) {
  const double turn = std::ceil((domain.from - rounding - lo) / (2 * pi)) * 2 * pi;
  return hi + turn <= domain.to + rounding;
}

}  // namespace

TurnPeak<2> turn_peak(const Grasp<2>& grasp, double from, double angle,
                      const CurveSettings& settings) {
  if (!std::isfinite(from)) throw InvalidGrasp("from", "must be finite");
  if (!(std::abs(angle) <= 2 * pi)) throw InvalidGrasp("angle", "must be at most a whole turn");
  return peak_on(grasp, whole_curve(grasp, settings), from, angle, settings);
}

std::vector<TurnPeak<2>> ways_round(const Grasp<2>& grasp, double from, double to,
                                    const CurveSettings& settings) {
  if (!std::isfinite(from)) throw InvalidGrasp("from", "must be finite");
  if (!std::isfinite(to)) throw InvalidGrasp("to", "must be finite");
  double angle = std::remainder(to - from, 2 * pi);
  if (angle == -pi) angle = pi;
  if (std::abs(angle) < same_posture) return {};
  const PostureCurve curve = whole_curve(grasp, settings);
  const Interval domain = domain_interval(grasp, settings.domain);
  const bool stays =
      settings.domain != Domain::all && is_within(domain, from, from) && is_within(domain, to, to);
  std::vector<TurnPeak<2>> ways;
  for (const double way : {angle, angle - std::copysign(2 * pi, angle)})
    if (!stays || is_within(domain, std::min(from, from + way), std::max(from, from + way)))
      ways.push_back(peak_on(grasp, curve, from, way, settings));
  if (ways.size() == 2 && ways[1].peak < ways[0].peak * (1 - tie)) std::swap(ways[0], ways[1]);
  return ways;
}

Reachable<2> best_reachable(const Grasp<2>& grasp, double from, const CurveSettings& settings) {
  if (!std::isfinite(from)) throw InvalidGrasp("from", "must be finite");
  const Interval domain = domain_interval(grasp, settings.domain);
  CurveSettings within = settings;
  if (!is_within(domain, from, from)) within.domain = Domain::all;
  within.present = from;
  const PostureCurve curve = posture_curve(grasp, within);
  const Posture<2> now = posture_at(grasp, up_at(from), {settings.force_cap, settings.objective});
  if (!now.holdable()) throw InvalidGrasp("from", "cannot be held");
  const double level = now.value() * (1 + tie);
  Reachable<2> found{.posture = now,
                     .least_angle = -stretch_below(curve, from, -1, level),
                     .most_angle = stretch_below(curve, from, 1, level)};
  double least = now.value();
  const auto consider = [&](double angle, double value) {
    if (value > least * (1 + tie) || angle < found.least_angle || angle > found.most_angle) return;
    if (value >= least * (1 - tie) && std::abs(angle) >= std::abs(found.angle)) return;
    least = std::min(least, value);
    found.angle = angle;
  };
  for (const Optimum& optimum : curve.optima) {
    const double near = std::remainder(optimum.angle - from, 2 * pi);
    for (const double angle : {near, near - std::copysign(2 * pi, near)})
      if (!optimum.maximum) consider(angle, optimum.value);
  }
  const Optimum best{.angle = from + found.angle, .value = least};
  if (found.angle != 0) found.posture = minimum_at(grasp, best, within);
  return found;
}

}  // namespace poise
