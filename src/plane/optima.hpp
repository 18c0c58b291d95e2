// The minima and maxima of a posture curve. Not installed.
#pragma once

#include <vector>

#include "poise/posture_curve.hpp"

namespace poise {

/// Local minima and maxima over the closed holdable set, in the order of PostureCurve::optima.
std::vector<Optimum> optima(const PostureCurve& curve);

}  // namespace poise
