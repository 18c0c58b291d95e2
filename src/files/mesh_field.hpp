// What a grasp file takes from other files: they are named as seen from its folder.
#pragma once

#include <string>
#include <vector>

#include "files/field.hpp"
#include "readers/readers.hpp"
#include "shape/shape.hpp"

namespace poise {

/// A mesh of which `scale` metres are one unit, mended. `notes` gets what was mended and what is
/// wrong, lines that follow the name of the file: "was inside out, and was turned".
/// @throws ReadError
MeshShape mesh_shape(const std::string& file, double scale, std::vector<std::string>& notes);

/// `mesh: FILE` or `mesh: {file: FILE, scale: s}`: the mesh, mended, in metres; `unit` is that of
/// the grasp file [m], which counts where there is no scale. What was mended is warned of.
/// @throws FileError
MeshShape read_mesh_shape(const Field& field, double unit, std::vector<std::string>& warnings);

/// `inertial: {urdf: FILE, link: NAME}`.
/// @throws FileError
Inertial read_inertial(const Field& field);

}  // namespace poise
