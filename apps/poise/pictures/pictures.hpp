// Pictures of what was answered. Nothing is solved here.
#pragma once

#include <string>

#include "ask/answer.hpp"
#include "ask/motion.hpp"
#include "files/grasp_file.hpp"

namespace poise {

/// Draws the object as it hangs in its best pinched posture (or the best one) beside the curve of
/// the force norm over all postures into a file, as SVG.
/// @throws OutputError
void draw_curve(const PlanarFile& file, const Grasp<2>& grasp, const BestAnswer<2>& answer,
                const std::string& path);

/// Draws the object as it hangs in one posture, with its contacts, their friction cones and forces
/// against the load that decides, its weight and the vertical through its com, into a file, whose
/// name ends with .svg or .png.
/// @param words  what stands below the name: which posture it is, and how hard the fingers press
/// @throws OutputError
void draw_posture(const PlanarFile& file, const Grasp<2>& grasp, const Posture<2>& posture,
                  const std::string& words, const std::string& path);
void draw_posture(const SpatialFile& file, const Grasp<3>& grasp, const Posture<3>& posture,
                  const std::string& words, const std::string& path);

/// Draws what is needed over time, its peak, the most that the drives give, and where it slips, into
/// a file, as SVG.
/// @throws OutputError
void draw_motion(const std::string& name, const Grasp<3>& grasp, const MotionReport& report,
                 const std::string& path);

}  // namespace poise
