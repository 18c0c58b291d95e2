// A held object in space as it hangs.
#pragma once

#include <string>

#include "files/grasp_file.hpp"

namespace poise {

/// The object with world's +z up, its contacts with friction cones and forces, its weight and the
/// vertical through its com: an SVG or a PNG.
/// @param grasp  that of the scenario that decides
/// @param words  what stands below the name: which posture it is, and how hard the fingers press
std::string spatial_picture(const SpatialFile& file, const Grasp<3>& grasp,
                            const SpatialPosture& posture, const std::string& words, bool svg);

}  // namespace poise
