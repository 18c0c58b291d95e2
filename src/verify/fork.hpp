// Where the centre of mass lies in the fork of the fingers, from the contact points alone.
#pragma once

#include "verify/statics.hpp"

namespace poise::verify {

/// The planar postures of the fork, an open interval [rad]; none if it has no width.
struct Wedge {
  Real from{0}, to{0};

  bool empty() const { return !(to > from); }
};
Wedge wedge_of(const RealGrasp& grasp, const RealLoad& load);

}  // namespace poise::verify
