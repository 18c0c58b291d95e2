// The two searches for the posture of least effort: docs/theory.md, "The farthest point of a convex
// body". And what they prove. Not installed.
#pragma once

#include <cmath>
#include <numbers>

#include "space/search_state.hpp"

namespace poise::search {

/// @throws InvalidGrasp for one out of its range
inline void check_tilt(const Tilt& tilt) {
  if (!(std::abs(tilt.from.squaredNorm() - 1) <= 1e-6))
    throw InvalidGrasp("tilt.from", "must be a unit vector");
  if (!(tilt.most >= 0) || !(tilt.most <= std::numbers::pi / 2 + 1e-12))
    throw InvalidGrasp("tilt.most", "must be at least 0 and at most 90 degrees");
}

/// @throws InvalidGrasp for settings of a search out of their ranges
template <class Settings>
void check_search(const Settings& settings) {
  if (!(settings.gap > 0) || !(settings.gap < 1))
    throw InvalidGrasp("gap", "must be above 0 and below 1");
  if (settings.max_holds < 1) throw InvalidGrasp("max_holds", "must be at least 1");
  if (!(settings.force_cap > 0) || !(settings.force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9 weights");
  if (settings.tilt) check_tilt(*settings.tilt);
}

/// Where the root of the value is a gauge: the posture is the direction of the point of the
/// sublevel set {x : value(x) <= 1} farthest from the origin. Cuts off the farthest vertex of the
/// polytope again and again.
void farthest_point(SearchState& state, int max_holds);

/// For any value: whether the sublevel set of the target, a convex set, meets the unit sphere. Cuts
/// it out from outside, and where longer x need less from inside of the sphere, too; the target
/// falls with the best value.
void level_set(SearchState& state, int max_holds);

/// Whichever is right, after postures that are worth a visit in any case.
void minimise(SearchState& state, int max_holds);

/// What the half-spaces prove of the values in the domain. Sets the target to what was proven.
double lower_bound(SearchState& state);

/// The half-spaces that are needed for a bound t, as cuts.
std::vector<Cut> certificate(const SearchState& state, double t);

/// What the cuts prove, whatever rounding made the search believe: at most `claimed` [squared units
/// of the oracle], at least its `least`, which needs no cut.
double proven_bound(const Grasp<3>& grasp, const std::vector<Cut>& cuts, const Oracle& oracle,
                    const SpatialSettings& settings, double claimed);

/// Calls `step` while it returns true, holds are left to spend, and better values may exist.
template <class Step>
void repeat(const SearchState& state, int max_holds, const Step& step) {
  constexpr long steps_per_hold = 20;  // some ask for no hold
  for (long k = 0; k < steps_per_hold * max_holds && state.oracle.holds < max_holds; ++k)
    if ((1 - state.gap) * state.best_value <= state.oracle.least || !step()) return;
}

}  // namespace poise::search
