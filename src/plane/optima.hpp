// The minima and maxima of a posture curve. Not installed.
#pragma once

#include <vector>

#include "poise/posture_curve.hpp"

namespace poise {

/// Local minima and maxima over the closed holdable set, in the order of PostureCurve::optima.
/// `present` [rad]: of ties the least turn from it comes first.
std::vector<Optimum> optima(const PostureCurve& curve, double present);

}  // namespace poise
