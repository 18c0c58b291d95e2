// Local minima of the effort over the postures in space. Not installed.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "space/posture_search.hpp"


namespace poise::search {

/// Descends from `up` until it is the best of all postures within a little cone around it.
/// None where the domain has no posture near `up` that can be held.
std::optional<std::pair<Vector<3>, Row>> descend(const Grasp<3>& grasp,
                                                 const std::vector<Case>& cases,
                                                 const std::vector<Cone>& domain, Vector<3> up);

/// A minimum to all its digits, where the effort is smooth: the effort alone tells only half of
/// them, and a finger that carries nothing there would seem to press a little.
/// `row`: of a hold there.
Vector<3> settled(const Case& load, Vector<3> up, const Row& row);

/// Where to descend from: where steps down the slope lead from postures spread over the domain, and
/// no two that are nearly the same.
std::vector<Vector<3>> starts(Search& search, const std::vector<Cone>& domain, int count);

}  // namespace poise::search
