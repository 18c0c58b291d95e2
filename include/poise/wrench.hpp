// Vectors, wrenches and twists: the quantities in which everything is told.
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

}  // namespace poise
