#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "files/grasp_file.hpp"

namespace poise {

/// A planar grasp as a grasp file in JSON, in SI units; reading it gives the same grasp.
std::string grasp_document(const PlanarFile& file);

/// A shape as it is written in a grasp file, in metres.
nlohmann::ordered_json shape_value(const Shape& shape);

}  // namespace poise
