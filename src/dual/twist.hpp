// Twists and wrenches between the solver's units and the object frame. Not installed.
#pragma once

#include <Eigen/Geometry>

#include "dual/scaled_hand.hpp"
#include "poise/load.hpp"

namespace poise {

/// A twist about the hand's center in the solver's units, seen at the object frame's origin [N,
/// N/m].
inline Twist<2> about_origin(const ScaledHand<2>& hand, double weight, const Twist<2>& scaled) {
  const double omega = scaled[2] * hand.per_length;
  return Twist<2>(scaled[0] + omega * hand.center.y(), scaled[1] - omega * hand.center.x(), omega) *
         weight;
}
inline Twist<3> about_origin(const ScaledHand<3>& hand, double weight, const Twist<3>& scaled) {
  const Vector<3> omega = scaled.tail<3>() * hand.per_length;
  Twist<3> y;
  y << scaled.head<3>() - omega.cross(hand.center), omega;
  return y * weight;
}

/// The inverse of about_origin.
inline Twist<2> about_center(const ScaledHand<2>& hand, double weight, const Twist<2>& y) {
  return Twist<2>(y[0] - y[2] * hand.center.y(), y[1] + y[2] * hand.center.x(),
                  y[2] * hand.length) *
         (1 / weight);
}
inline Twist<3> about_center(const ScaledHand<3>& hand, double weight, const Twist<3>& y) {
  const Vector<3> omega = y.tail<3>();
  Twist<3> scaled;
  scaled << y.head<3>() + omega.cross(hand.center), omega * hand.length;
  return scaled * (1 / weight);
}

/// A wrench about the object frame's origin [N, N m] in the solver's units.
inline Wrench<2> scaled_wrench(const ScaledHand<2>& hand, double weight, const Wrench<2>& w) {
  const double moment = w[2] - (hand.center.x() * w[1] - hand.center.y() * w[0]);
  return Wrench<2>(w[0], w[1], moment * hand.per_length) * (1 / weight);
}
inline Wrench<3> scaled_wrench(const ScaledHand<3>& hand, double weight, const Wrench<3>& w) {
  const Vector<3> force = w.head<3>();
  Wrench<3> scaled;
  scaled << force, (w.tail<3>() - hand.center.cross(force)) * hand.per_length;
  return scaled * (1 / weight);
}

/// A load in the solver's units in the posture `up`.
template <int Dim>
Wrench<Dim> scaled_load(const ScaledHand<Dim>& hand, double weight, const Load<Dim>& load,
                        const Vector<Dim>& up) {
  const double part = load.turning() / weight;
  const Vector<Dim> arm = (load.com - hand.center) * hand.per_length, force = part * up;
  Wrench<Dim> w = scaled_wrench(hand, weight, load.still());
  w.template head<Dim>() += force;
  if constexpr (Dim == 2)
    w[2] += arm.x() * force.y() - arm.y() * force.x();
  else
    w.template tail<3>() += arm.cross(force);
  return w;
}

}  // namespace poise
