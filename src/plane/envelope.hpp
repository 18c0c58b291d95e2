// The curve of several loads from the curves of each. Not installed.
#pragma once

#include <vector>

#include "poise/posture_curve.hpp"

namespace poise {

/// What is unholdable for any of the loads, and elsewhere the greatest of their values: pieces of
/// curves that tile one domain, with their states. Where rounding left a load undecided there is
/// none. Of equal ones the first load's. docs/theory.md, "Several loads".
void trace_envelope(const std::vector<PostureCurve>& loads, PostureCurve& envelope);

}  // namespace poise
