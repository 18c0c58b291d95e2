#pragma once

#include <string>

#include "files/grasp_file.hpp"

namespace poise {

/// A planar grasp as a grasp file in JSON, in SI units; reading it gives the same grasp.
std::string grasp_document(const PlanarFile& file);

}  // namespace poise
