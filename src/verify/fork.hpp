// Whether a centre of mass lies in the fork of the fingers, from the contact points alone.
#pragma once

#include "verify/statics.hpp"

namespace poise::verify {

/// Unclear: within rounding.
enum class Fork { no, yes, unclear };

/// In the posture `up`.
Fork fork(const RealGrasp& grasp, const RealLoad& load, const Vec& up);

/// The planar postures of the fork, an open interval [rad]; none if it has no width.
struct Wedge {
  Real from{0}, to{0};
  bool unclear{false};

  bool empty() const { return !(to > from); }
};
Wedge wedge_of(const RealGrasp& grasp, const RealLoad& load);

}  // namespace poise::verify
