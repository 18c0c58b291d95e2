// Local minima of the effort over the postures in space. Not installed.
#pragma once

#include <optional>
#include <vector>

#include "space/search_state.hpp"

namespace poise::search {

/// Descends from `up` until it is the best of all postures within a little cone around it: the
/// half-space that touches there. None where the domain has no posture near `up` that can be
/// held.
std::optional<HalfSpace> descend(const Grasp<3>& grasp, const std::vector<ScaledLoad>& loads,
                                 const std::vector<TiltCone>& domain, Objective objective,
                                 Vector<3> up);

/// A minimum to all its digits, where the effort is smooth: the effort alone tells only half of
/// them, and a finger that carries nothing there would seem to press a little.
Vector<3> polished_minimum(const ScaledLoad& load, const HalfSpace& found);

/// Where to descend from: where steps down the slope lead from postures spread over the domain, and
/// no two that are nearly the same.
std::vector<Vector<3>> starts(SearchState& state, int count);

}  // namespace poise::search
