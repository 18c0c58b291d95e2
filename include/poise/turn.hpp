// How a hand turns the object from one posture to another.
#pragma once

#include <Eigen/Geometry>

#include "poise/wrench.hpp"

namespace poise {

/// The smallest rotation, in the world frame, that takes an object from its orientation (object to
/// world) to one in which `up` (unit vector, object frame) points along the world's +z. w >= 0.
/// Where `up` points straight down now, the axis is the world's x.
Eigen::Quaterniond smallest_turn(const Eigen::Quaterniond& orientation, const Vector<3>& up);

/// Where the rotation of a hand leads, in the world frame, whose +z is up.
struct Turn {
  Eigen::Quaterniond rotation;     ///< w >= 0
  Eigen::Quaterniond orientation;  ///< that results, object to world; w >= 0
  double angle;                    ///< of the rotation [rad], 0 to pi
  Vector<3> axis;                  ///< unit vector
};

/// The smallest turn from an orientation (object to world) to the posture `up`.
Turn turn_to(const Eigen::Quaterniond& orientation, const Vector<3>& up);

/// An orientation (object to world) in which `up` is up. Which one is not told by `up`: the one
/// nearest to the world frame.
Eigen::Quaterniond orientation_of(const Vector<3>& up);

}  // namespace poise
