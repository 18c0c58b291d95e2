// The inertia of the object of a grasp file: given, of a robot model, or of an even body.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "files/field.hpp"
#include "files/grasp_file.hpp"

namespace poise {

/// What the file says of it [kg m^2], about the com in the object frame, if it does.
std::optional<Eigen::Matrix3d> read_inertia(const Field& object);

/// What the file says, or that of its shape filled evenly.
/// @param name  of the file, for messages
/// @throws FileError that says why there is none
Eigen::Matrix3d inertia_of(const SpatialFile& file, const std::string& name);

}  // namespace poise
