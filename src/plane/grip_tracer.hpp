// The pieces of the grip curve: docs/theory.md, "The grip curve". Not installed.
#pragma once

#include "poise/posture_curve.hpp"

namespace poise {

/// Puts in the place of the arcs of effort those of grip, in any order and by any whole turns, and
/// adds the unholdable arcs in which the drives would need more than their max. Single postures
/// are left out.
/// @throws InvalidGrasp as grip_unit()
void trace_grip(const Grasp<2>& grasp, const CurveSettings& settings, PostureCurve& curve);

}  // namespace poise
