// What answers in space need beside the library: a hold of all scenarios, and turns.
#pragma once

#include <vector>

#include "poise/best_spatial_posture.hpp"

namespace poise {

/// The least forces in the posture `up` (unit vector, object frame) in each scenario. The one that
/// decides is the first that cannot be held, whose effort is infinite, or that of the greatest.
SpatialPosture hold_all(const std::vector<Grasp<3>>& scenarios, const Vector<3>& up,
                        const HoldSettings& settings = {});

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
