// What the best posture in space is checked by.
#pragma once

#include <optional>

#include "ask/claims.hpp"
#include "verify/statics.hpp"

namespace poise::verify {

using Vec3 = Eigen::Matrix<Real, 3, 1>;

/// Checks that by the cuts the effort, or the grip, is at least `least` in the whole domain (of the
/// greatest of the loads); `words` say so.
void check_cuts(Verdict& verdict, const RealGrasp& grasp, const std::vector<Cut>& cuts,
                const OptionsClaim& options, Real least, const std::string& words);

/// Whether it is plain that turns to all sides can be balanced too, if no contact presses harder
/// than before by `slack` [N].
bool holds_around(const RealGrasp& grasp, const RealLoad& load, Real slack);

}  // namespace poise::verify
