// From where doubles end to an answer: what the plane and space share. Not installed.
#pragma once

#include <algorithm>
#include <limits>

#include "dual/ascent.hpp"

namespace poise::dual {

/// Towards point.y from what can be balanced to w, as a proof that nothing holds.
bool separate(const Problem<2>& problem, const Wrench<2>& w, double force_cap, Point<2>& point);
bool separate(const Problem<3>& problem, const Wrench<3>& w, double force_cap, Point<3>& point);

/// Newton's method alone, from where it converges at once. False if it does not.
template <int Dim>
bool finish(const Cones<Dim, Wide>& cones, const Screw<Dim, Wide>& w, Point<Dim, Wide>& point) {
  evaluate<Dim, Wide>(cones, w, Screw<Dim, Wide>(point.y), point);
  Wide error = l1_norm(point.residual);
  for (int step = 0; step < 12; ++step) {
    if (error <= 1e-22 + 1e-29 * l1_norm(point.y)) return error <= 0.1 * delta;
    const Screw<Dim, Wide> y =
        point.y + newton_step(curvature<Dim, Wide>(cones, point), point.residual);
    evaluate<Dim, Wide>(cones, w, y, point);
    const Wide before = error;
    error = l1_norm(point.residual);
    if (!(error <= 0.5 * before)) break;
  }
  return error <= 1e-19;
}

template <int Dim>
bool decide(const Cones<Dim, Wide>& cones, const Wrench<Dim>& load, double force_cap,
            Point<Dim, Wide>& point) {
  const Screw<Dim, Wide> w = load.template cast<Wide>();
  const double cap = force_cap * force_cap;
  point.y.setZero();
  Wide last = std::numeric_limits<double>::infinity();
  // A pull towards y = 0 that fades away: y is bounded whether w can be held or not.
  for (double pull = first_pull; pull > last_pull;) {
    const Screw<Dim, Wide> before = point.y;
    ascend<Dim, Wide>(cones, w, before, {.pull = pull}, point);
    point.residual += Wide(pull) * point.y;
    point.value += pull / 2 * point.y.squaredNorm();
    const Wide missing = primal_norm<Dim, Wide>(point.residual);
    if (missing <= 0.95 * delta) {
      Point<Dim, Wide> finished = point;
      if (finish<Dim>(cones, w, finished)) point = finished;
      return squared_norm(point) <= cap;
    }
    if (lower_bound(point) > cap) return false;
    // What does not shrink is the distance of w from what can be balanced: y grows along it.
    if (missing > 0.9 * last) {
      const Screw<Dim, Wide> y = point.y;
      for (const Screw<Dim, Wide>& way : {Screw<Dim, Wide>(y - before), y})
        if (prove_along<Dim, Wide>(cones, w, way, force_cap, point)) return false;
    }
    pull *= std::clamp(static_cast<double>(0.5 * delta / missing), 1e-3, 0.1);
    last = missing;
  }
  // The dual rises ever more slowly, but above the cap: held only with ever greater forces.
  return ascend<Dim, Wide>(cones, w, Screw<Dim, Wide>(point.y), {.force_cap = force_cap}, point) &&
         squared_norm(point) <= cap;
}

/// A y from which it is worth starting: `start`, or a cold one.
template <int Dim>
Twist<Dim> start_from(const Problem<Dim>& problem, const Wrench<Dim>& w, const Twist<Dim>& start) {
  return l1_norm(start) < longest_start ? start : cold_start(problem, w);
}

/// What wide numbers found. Forces at y rounded, or beside tangents rounded, would be off by as
/// much as y is long.
template <int Dim>
void narrow(const Cones<Dim>& cones, const Wrench<Dim>& w, const Point<Dim, Wide>& wide,
            Point<Dim>& point) {
  point.y = wide.y.template cast<double>();
  point.residual = w;
  std::fill(point.lanes.begin(), point.lanes.end(), LaneForces<Dim, double>{});
  for (std::size_t i = 0; i < cones.size; ++i) {
    LaneForces<Dim, double>& lane = point.lanes[i / lane_size];
    for (std::size_t k = 0; k < static_cast<std::size_t>(contact_size<Dim>); ++k) {
      lane.z[k][i % lane_size] = static_cast<double>(wide.lanes[i].z[k]);
      lane.f[k][i % lane_size] = static_cast<double>(wide.lanes[i].f[k]);
    }
    if constexpr (Dim == 3) lane.over[i % lane_size] = static_cast<double>(wide.lanes[i].over);
    point.residual -= columns(cones, i) * point.f(i);
  }
}

template <int Dim>
bool maximise(const Problem<Dim>& problem, const Wrench<Dim>& w, const Twist<Dim>& start,
              double force_cap, Point<Dim>& point) {
  const Twist<Dim> from = start_from<Dim>(problem, w, start);
  if (ascend<Dim, double>(problem, w, from, {.force_cap = force_cap}, point)) return true;
  if (separate(problem, w, force_cap, point)) return false;
  if (lower_bound(point) > force_cap * force_cap) return false;
  Point<Dim, Wide> wide(problem.size);
  const bool holdable = decide<Dim>(Widened<Dim>(problem).cones(), w, force_cap, wide);
  if (holdable) {
    narrow<Dim>(problem, w, wide, point);
    point.value = value_in_wide_numbers<Dim>(problem, w, point.y);
  } else {
    evaluate<Dim, double>(problem, w, wide.y.template cast<double>(), point);
  }
  return holdable;
}

}  // namespace poise::dual
