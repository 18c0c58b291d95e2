#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "files/grasp_file.hpp"

namespace poise {

/// A grasp as a grasp file in JSON, in SI units; reading it gives the same grasp.
std::string grasp_document(const PlanarFile& file);

/// A grasp in space as a grasp file in JSON, in SI units; reading it gives the same grasp. It has
/// the contacts, or instead of them the gripper if that is wanted and there is one. A mesh is
/// named as seen from the folder in which the file will be ("": the present one).
enum class WriteAs { contacts, gripper };
std::string grasp_document(const SpatialFile& file, WriteAs as = WriteAs::contacts,
                           const std::string& folder = "");

/// The mesh of a shape as {"points": [[x, y, z], ...], "triangles": [[i, j, k], ...]}, for drawing.
std::string mesh_document(const Mesh& mesh);

/// A shape as it is written in a grasp file, in metres.
nlohmann::ordered_json shape_value(const Shape& shape);
nlohmann::ordered_json shape_value(const Solid& solid);

/// The keys `drives` and `fingers` of a grasp file, as far as they are not as they would be anyway.
template <int Dim>
std::string mechanism_document(const Mechanism<Dim>& mechanism);

/// A tilt as it is written in a grasp file.
nlohmann::ordered_json tilt_value(const Tilt& tilt);

}  // namespace poise
