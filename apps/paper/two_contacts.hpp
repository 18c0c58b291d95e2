// Any planar object between two fingers: what the authors' papers say beyond the disk.
#pragma once

#include <vector>

#include "poise/posture.hpp"

namespace poise::study {

/// The previous analysis, which asks for balance alone (alpha = 0): the effort |F_T|^2 of two
/// contacts in the posture theta, whatever their friction and normals [N^2].
double effort_without_friction(const Grasp<2>& grasp, double theta);

/// Its best posture [rad]: the midpoint of the contacts straight above the centre of mass. Straight
/// below is as good; if they coincide every posture is.
double best_without_friction(const Grasp<2>& grasp);

/// A posture in which both contacts slip: the edges of their cones meet on the vertical through the
/// centre of mass, since three forces in balance pass through one point.
struct BothSlip {
  double theta{0};   ///< [rad]
  Vector<2> meet;    ///< where the edges meet [m, object frame]
  double effort{0};  ///< [N^2]
};

/// All such postures of two contacts, from geometry alone: each pair of edges has a meeting point,
/// and the vertical through it fixes the posture and the forces. Parallel edges are left out.
std::vector<BothSlip> both_slip(const Grasp<2>& grasp);

}  // namespace poise::study
