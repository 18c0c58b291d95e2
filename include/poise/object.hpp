// What is held: a rigid body of which only the weight and the centre of mass matter.
#pragma once

#include <Eigen/Core>

namespace poise {

/// A point, direction or force in the object frame: Dim rows.
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

/// Rows of a wrench: 3 in the plane (force, moment), 6 in space (force, moment).
template <int Dim>
inline constexpr int wrench_size = Dim == 2 ? 3 : 6;

/// Force [N] over moment [N m], in the object frame, about its origin unless said otherwise.
template <int Dim>
using Wrench = Eigen::Matrix<double, wrench_size<Dim>, 1>;

/// Velocity over angular velocity: what a wrench does power on. Moves from point to point as one.
template <int Dim>
using Twist = Eigen::Matrix<double, wrench_size<Dim>, 1>;

/// Standard gravity [m/s^2]: weight = mass * standard_gravity.
inline constexpr double standard_gravity = 9.80665;

/// A rigid body of which only the weight and the centre of mass matter.
template <int Dim>
struct Object {
  double weight{1};                       ///< [N], > 0
  Vector<Dim> com = Vector<Dim>::Zero();  ///< centre of mass [m], object frame
};

}  // namespace poise
