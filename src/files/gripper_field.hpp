#pragma once

#include "files/field.hpp"
#include "gripper/gripper.hpp"

namespace poise {

/// `gripper: {type: parallel_jaw, ...}` or `{type: fingertips, ...}`; `unit` is that of the grasp
/// file [m].
/// @throws FileError
Gripper read_gripper(const Field& field, double unit);

}  // namespace poise
