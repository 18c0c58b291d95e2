// Twists between the solver's units and the object frame. Not installed.
#pragma once

#include "scaled_grasp.hpp"

namespace poise {

/// A twist about the com in the solver's units, seen at the object frame's origin [N, N/m].
inline Twist<2> about_origin(const Grasp<2>& grasp, const Twist<2>& scaled) {
  const Vector<2>& com = grasp.object().com;
  const double omega = scaled[2] / grasp.scaled().length;
  return Twist<2>(scaled[0] + omega * com.y(), scaled[1] - omega * com.x(), omega) *
         grasp.object().weight;
}

/// The inverse of about_origin.
inline Twist<2> about_com(const Grasp<2>& grasp, const Twist<2>& y) {
  const Vector<2>& com = grasp.object().com;
  return Twist<2>(y[0] - y[2] * com.y(), y[1] + y[2] * com.x(), y[2] * grasp.scaled().length) *
         grasp.scaled().per_weight;
}

}  // namespace poise
