// The pieces of the posture curve: docs/theory.md, "The posture curve". Not installed.
#pragma once

#include "poise/posture_curve.hpp"

namespace poise {

/// Postures closer than this [rad] are one: below it lies the rounding of where arcs end.
inline constexpr double same_angle = 1e-11;
/// Within this [rad] of the limit of holding, rounding may decide: no piece need be found there.
inline constexpr double undecidable = 1e-8;

/// The curve of effort of a grasp with one load, which must turn: with the arcs and unholdable arcs
/// of the domain, in any order and by any whole turns.
PostureCurve trace(const Grasp<2>& grasp, const Interval& domain, double force_cap);

}  // namespace poise
