// The page on which a grasp can be taken hold of: web/.
#pragma once

#include <string>

namespace poise {

/// Writes the page with a grasp (a grasp file in JSON) inside, and with a mesh to draw (its points
/// and triangles in JSON, or null), and says so.
/// @throws OutputError if it cannot be written, or the page is neither installed nor built
std::string view(const std::string& grasp, const std::string& page,
                 const std::string& mesh = "null");

}  // namespace poise
