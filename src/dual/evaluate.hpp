// The dual function and its curvature, from the hot loops. Not installed.
#pragma once

#include "dual/kernel_plane.hpp"
#include "dual/kernel_space.hpp"

namespace poise::dual {

template <int Dim, class T>
void evaluate(const Cones<Dim, T>& cones, const Screw<Dim, T>& w, const Screw<Dim, T>& y,
              Point<Dim, T>& point) {
  Screw<Dim, T> wrench;
  T phi;
  const auto twist = twist_of_lane<T>(y);
  if (cones.limited)
    evaluate_lanes<true>(cones, twist, wrench, phi, point);
  else
    evaluate_lanes<false>(cones, twist, wrench, phi, point);
  point.y = y;
  point.residual = w - wrench;
  point.value = y.dot(w) - phi;
}

/// Forces of a y of 106 bits, to all digits of doubles. Sets no value.
template <int Dim>
void evaluate_twofold(const Cones<Dim>& cones, const Wrench<Dim>& w, const Screw<Dim, Wide>& y,
                      Point<Dim>& point) {
  point.y = y.template cast<double>();
  const Twist<Dim> rest = (y - point.y.template cast<Wide>()).template cast<double>();
  Wrench<Dim> wrench;
  double phi;
  const auto twist = twofold_twist(point.y, rest);
  if (cones.limited)
    evaluate_lanes<true>(cones, twist, wrench, phi, point);
  else
    evaluate_lanes<false>(cones, twist, wrench, phi, point);
  point.residual = w - wrench;
}

template <int Dim, class T>
Square<Dim, T> curvature(const Cones<Dim, T>& cones, const Point<Dim, T>& point) {
  return cones.limited ? curvature_lanes<true>(cones, point) : curvature_lanes<false>(cones, point);
}

}  // namespace poise::dual
