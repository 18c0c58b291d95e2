// Whether friction carries, decided from the contacts alone.
#pragma once

#include "verify/statics.hpp"

namespace poise::verify {

/// Unclear: near the limit.
enum class Friction { needless, needed, unclear };

/// Whether a load is held without any friction, within the contacts' limits, in the posture `up`.
/// Of a pad the normal force may act anywhere within its reach.
Friction friction_for(const RealGrasp& grasp, const RealLoad& load, const Vec& up);

}  // namespace poise::verify
