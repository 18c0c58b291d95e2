// Results in the plane: the arcs of the posture curve, its optima, and the best posture.
#pragma once

#include "verify/hold.hpp"

namespace poise::verify {

Real radians(Real degrees);
/// (sin theta, cos theta)
Vec up_at(Real theta);

Fork fork_in_plane(const Held& held, const Load& load, const Vec& up);

void check_curve(Claims& claims, const Held& held, const Field& root);
void check_best_in_plane(Claims& claims, const Held& held, const Field& root);

}  // namespace poise::verify
