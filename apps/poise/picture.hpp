// A held object beside its posture curve.
#pragma once

#include <string>

#include "files/grasp_file.hpp"
#include "poise/best_posture.hpp"

namespace poise {

/// A gnuplot script that draws, as SVG on its standard output, the object as it hangs in its best
/// pinched posture (or the best one) beside the curve of the force norm over all postures.
std::string picture(const PlanarFile& file, const Grasp<2>& grasp, const BestPosture& best,
                    const CurveSettings& settings);

/// A gnuplot script that draws the object alone as it hangs in one posture, as SVG or PNG.
/// @param words  what stands below the name: which posture it is, and how hard the fingers press
std::string planar_picture(const PlanarFile& file, const Grasp<2>& grasp, const Vector<2>& up,
                           const Hold<2>& hold, const std::string& words, bool svg);

}  // namespace poise
