#include "plane/optima.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/harmonic.hpp"

namespace poise {
namespace {

using std::numbers::pi;

/// An optimum this close to an end of its arc [rad] is at the end.
constexpr double near_end = 1e-9;
/// Longer intervals of optima [rad] are stretches of equal values.
constexpr double stretch = 1e-8;
/// Values that differ by less, in parts, are ties; slopes and angles [rad] are equal.
constexpr double tie = 1e-6, equal = 1e-9;
/// Parts of the coefficients of the value below which rounding hides what its slope does, and its
/// jumps.
constexpr double flat_slope = 1e-13, rounded_jump = 1e-14;

/// A part of an arc on which the value rises, falls, or does neither.
struct Segment {
  double from, to;
  int trend;  ///< 1, -1 or 0
  const Harmonic2* V;
};

double scale(const Harmonic2& V) {
  return std::abs(V.c0) + std::abs(V.cos1) + std::abs(V.sin1) + std::abs(V.cos2) + std::abs(V.sin2);
}

/// Splits an arc, moved by `turn`, where its slope changes sign.
void split(const Arc& arc, double turn, std::vector<Segment>& segments) {
  const double flat = flat_slope * scale(arc.value);
  const Harmonic2 slope = derivative(arc.value);
  double from = arc.from;
  int trend = 0;
  if (scale(slope) > flat) {
    for (const Root& root : sign_changes(slope, arc.from, arc.to)) {
      if (!(root.at - arc.from > near_end && arc.to - root.at > near_end)) continue;
      trend = root.rising ? 1 : -1;
      segments.push_back({from + turn, root.at + turn, -trend, &arc.value});
      from = root.at;
    }
    if (trend == 0) {
      const double middle = arc.value.slope((arc.from + arc.to) / 2);
      trend = std::abs(middle) <= flat ? 0 : middle > 0 ? 1 : -1;
    }
  }
  segments.push_back({from + turn, arc.to + turn, trend, &arc.value});
}

double wrapped(double angle) {
  if (angle > -pi && angle <= pi) return angle;
  const double a = std::remainder(angle, 2 * pi);
  return a <= -pi ? pi : a;
}

/// The optimum between the segments before and after it, which rise or fall and either of which may
/// be missing at an end; `flat` is there where neither rising nor falling segments lie between
/// them. Of a stretch it is the posture nearest to the present one.
Optimum between(const Segment* before, const Segment* flat, const Segment* after, double from,
                double to, bool maximum, bool boundary, double present) {
  Optimum optimum;
  optimum.maximum = maximum;
  optimum.kind = boundary ? Kind::boundary : Kind::smooth;
  const double middle = (from + to) / 2, off = std::remainder(present - middle, 2 * pi);
  optimum.angle = optimum.from = optimum.to =
      wrapped(to - from > stretch ? std::clamp(middle + off, from, to) : middle);
  const double c = std::cos(middle), s = std::sin(middle);
  optimum.value = (flat ? flat : after ? after : before)->V->at(c, s);
  if (to - from > stretch) {
    const double turns = 2 * pi * std::floor((from + pi) / (2 * pi));
    optimum.from = from - turns;
    optimum.to = to - turns;
  } else if (before && after && before->V != after->V && !boundary) {
    const double corner = after->V->slope_at(c, s) - before->V->slope_at(c, s);
    const double rounding = rounded_jump * std::max(scale(*before->V), scale(*after->V));
    if (corner > std::max(equal * optimum.value, rounding)) optimum.kind = Kind::kink;
  }
  return optimum;
}

/// Walks along the segments of one holdable interval, or once around the circle.
void find(const std::vector<Segment>& segments, bool circle, double present,
          std::vector<Optimum>& found) {
  const Segment* before = nullptr;  // the last that rises or falls
  const Segment* flat = nullptr;    // the next flat one
  double from = segments.front().from;
  for (const Segment& segment : segments) {
    if (segment.trend == 0) {
      if (!flat) flat = &segment;
      continue;
    }
    const bool end = !before;
    if (!(end && circle) && (end || segment.trend != before->trend))
      found.push_back(
          between(before, flat, &segment, from, segment.from, segment.trend < 0, end, present));
    before = &segment;
    flat = nullptr;
    from = segment.to;
  }
  const double to = segments.back().to;
  if (circle && before) return;
  if (before) {
    found.push_back(between(before, flat, nullptr, from, to, before->trend > 0, true, present));
  } else {  // it is the same everywhere
    const double start = circle ? -pi : from, stop = circle ? pi : to;
    for (const bool maximum : {false, true})
      found.push_back(between(nullptr, flat, nullptr, start, stop, maximum, !circle, present));
  }
}

bool better(const Optimum& a, const Optimum& b) {
  if (a.maximum != b.maximum) return b.maximum;
  return (a.value < b.value) != a.maximum && a.value != b.value;
}

/// Puts the least turn from the present posture first, then that counter-clockwise.
void order_ties(std::vector<Optimum>& found, double present) {
  const auto nearer = [&](const Optimum& a, const Optimum& b) {
    const double turn_a = std::remainder(a.angle - present, 2 * pi);
    const double turn_b = std::remainder(b.angle - present, 2 * pi);
    if (std::abs(std::abs(turn_a) - std::abs(turn_b)) > equal)
      return std::abs(turn_a) < std::abs(turn_b);
    return turn_a > turn_b;
  };
  for (auto first = found.begin(); first != found.end();) {
    const double room = tie * std::abs(first->value);
    const auto last = std::find_if(first, found.end(), [&](const Optimum& other) {
      return other.maximum != first->maximum || std::abs(other.value - first->value) > room;
    });
    std::stable_sort(first, last, nearer);
    first = last;
  }
}

}  // namespace

std::vector<Optimum> optima(const PostureCurve& curve, double present) {
  std::vector<Optimum> found;
  found.reserve(8);
  for (const Interval& interval : curve.holdable) {
    const bool circle = interval.to - interval.from >= 2 * pi;
    std::vector<Segment> segments;
    segments.reserve(2 * curve.arcs.size() + 4);
    for (const double turn : {0.0, 2 * pi})
      for (const Arc& arc : curve.arcs) {
        const bool inside = arc.from + turn >= interval.from && arc.to + turn <= interval.to;
        if (circle ? turn == 0 : inside) split(arc, turn, segments);
      }
    const auto start = std::find_if(segments.begin(), segments.end(),
                                    [](const Segment& s) { return s.trend != 0; });
    if (circle && start != segments.end()) {  // start there, and come back to it
      const auto turned = [](Segment s) {
        return Segment{s.from + 2 * pi, s.to + 2 * pi, s.trend, s.V};
      };
      std::transform(segments.begin(), start, segments.begin(), turned);
      std::rotate(segments.begin(), start, segments.end());
      segments.push_back(turned(segments.front()));
    }
    find(segments, circle, present, found);
  }
  std::stable_sort(found.begin(), found.end(), better);
  order_ties(found, present);
  return found;
}

}  // namespace poise
