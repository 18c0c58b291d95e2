// What a grasp file takes from other files: they are named as seen from its folder.
#pragma once

#include <string>
#include <vector>

#include "files/field.hpp"
#include "readers/readers.hpp"
#include "shape/shape.hpp"

namespace poise {

/// `mesh: FILE` or `mesh: {file: FILE, scale: s}`: the mesh, mended, in metres; `unit` is that of
/// the grasp file [m], which counts where there is no scale. What was mended is warned of.
/// @throws FileError
MeshShape read_mesh_shape(const Field& field, double unit, std::vector<std::string>& warnings);

/// `inertial: {urdf: FILE, link: NAME}`.
/// @throws FileError
Inertial read_inertial(const Field& field);

}  // namespace poise
