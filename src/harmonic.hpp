// Where a trigonometric polynomial vanishes. Not installed.
#pragma once

#include <vector>

#include "poise/posture_curve.hpp"

namespace poise {

/// d/dtheta.
Harmonic2 derivative(const Harmonic2& g);

/// The theta in (from, to), to - from <= 2 pi, where g changes its sign, ascending.
std::vector<double> sign_changes(const Harmonic2& g, double from, double to);

}  // namespace poise
