// Twists between the solver's units and the object frame. Not installed.
#pragma once

#include <Eigen/Geometry>

#include "dual/scaled_grasp.hpp"

namespace poise {

/// A twist about the com in the solver's units, seen at the object frame's origin [N, N/m].
inline Twist<2> about_origin(const Grasp<2>& grasp, const Twist<2>& scaled) {
  const Vector<2>& com = grasp.object().com;
  const double omega = scaled[2] * grasp.scaled().per_length;
  return Twist<2>(scaled[0] + omega * com.y(), scaled[1] - omega * com.x(), omega) *
         grasp.object().weight;
}

/// The inverse of about_origin.
inline Twist<2> about_com(const Grasp<2>& grasp, const Twist<2>& y) {
  const Vector<2>& com = grasp.object().com;
  return Twist<2>(y[0] - y[2] * com.y(), y[1] + y[2] * com.x(), y[2] * grasp.scaled().length) *
         grasp.scaled().per_weight;
}

inline Twist<3> about_origin(const Grasp<3>& grasp, const Twist<3>& scaled) {
  const Vector<3> omega = scaled.tail<3>() * grasp.scaled().per_length;
  Twist<3> y;
  y << scaled.head<3>() - omega.cross(grasp.object().com), omega;
  return y * grasp.object().weight;
}

inline Twist<3> about_com(const Grasp<3>& grasp, const Twist<3>& y) {
  const Vector<3> omega = y.tail<3>();
  Twist<3> scaled;
  scaled << y.head<3>() + omega.cross(grasp.object().com), omega * grasp.scaled().length;
  return scaled * grasp.scaled().per_weight;
}

}  // namespace poise
