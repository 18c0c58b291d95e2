// The page on which a grasp can be taken hold of: web/.
#pragma once

#include <string>

#include "files/grasp_file.hpp"

namespace poise {

/// Writes the page with the grasp inside, and says so.
/// @throws OutputError if it cannot be written, or the page is neither installed nor built
std::string view(const PlanarFile& file, const std::string& page);

}  // namespace poise
