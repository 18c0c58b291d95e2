#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "files/grasp_file.hpp"

namespace poise {

/// A grasp as a grasp file in JSON, in SI units; reading it gives the same grasp.
std::string grasp_document(const PlanarFile& file);
std::string grasp_document(const SpatialFile& file);

/// A shape as it is written in a grasp file, in metres.
nlohmann::ordered_json shape_value(const Shape& shape);
nlohmann::ordered_json shape_value(const Solid& solid);

/// A tilt as it is written in a grasp file.
nlohmann::ordered_json tilt_value(const Tilt& tilt);

}  // namespace poise
