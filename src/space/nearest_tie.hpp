// Of the postures in space that are as good as the best, that of the least turn. Not installed.
#pragma once

#include <optional>

#include "poise/best_posture.hpp"

namespace poise {

/// The posture of the domain nearest to `present` that needs at most `most`, a little more than
/// `lowest`, the best there is; then the lowest around it on the way from `present`. None where
/// that is no nearer than `known` by a hundredth of a radian, or takes more than 400 holds to find.
std::optional<Vector<3>> nearest_tie(const Grasp<3>& grasp, const SpatialSettings& settings,
                                     const Vector<3>& present, const Vector<3>& known,
                                     double lowest, double most);

/// Whether a posture lies inside the domain and what can be held, with its neighbours.
bool is_interior(const Grasp<3>& grasp, const SpatialSettings& settings, const Vector<3>& up);

}  // namespace poise
