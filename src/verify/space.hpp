// The best posture in space: the cuts that prove it, and the turn that leads there.
#pragma once

#include "verify/hold.hpp"

namespace poise::verify {

Fork fork_in_space(const Held& held, const Load& load, const Vec& up);

void check_best_in_space(Claims& claims, const Held& held, const Field& root);

}  // namespace poise::verify
