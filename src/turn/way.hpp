// Ways of few steps. Not installed.
#pragma once

#include <vector>

#include "turn/peak.hpp"

namespace poise::turns {

/// The fewest of these postures, first and last included, between which straight turns stay at or
/// below `most`, where each and its neighbour do. As few as a search from the start finds.
std::vector<Vector<3>> fewest_steps(Values& values, const std::vector<Vector<3>>& ups, double most);

/// What the steps of a way need at most, and at least.
Enclosure peak_along(Values& values, const std::vector<Vector<3>>& ups, double gap);

/// The most holds to spend on one step.
inline constexpr int holds_per_step = 2000;

}  // namespace poise::turns
