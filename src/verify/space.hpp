// What the best posture in space is checked by.
#pragma once

#include <optional>

#include "ask/claims.hpp"
#include "verify/statics.hpp"

namespace poise::verify {

using Vec3 = Eigen::Matrix<Real, 3, 1>;

/// Cuts off all x with a . x > b.
struct HalfSpace {
  Vec3 a;
  Real b;

  Real beyond(const Vec3& x) const { return a.dot(x) - b; }
};

/// Where a cut proves that up = x needs more than t, an effort or a grip. Without limits and with
/// the weight alone a longer or shorter y proves more, and the best length is known.
HalfSpace half_space(const RealGrasp& grasp, const RealLoad& load, const Cut& cut,
                     const OptionsClaim& options, Real t);
/// Checks the half-space of a cut: of a load, or of the domain, of which it cuts off nothing.
/// Nothing where a wrong one, or one that does not move the com, says nothing.
std::optional<HalfSpace> check_cut(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                                   const Cut& cut, const OptionsClaim& options, Real t);
/// The most that still counts as held: an effort or a grip.
Real most_held(const RealGrasp& grasp, const OptionsClaim& options);

/// Checks that by the cuts the effort, or the grip, is at least `least` in the whole domain (of the
/// greatest of the loads); `words` say so.
void check_cuts(Verdict& verdict, const RealGrasp& grasp, const std::vector<Cut>& cuts,
                const OptionsClaim& options, Real least, const std::string& words);

/// Whether it is plain that turns to all sides can be balanced too, if no contact presses harder
/// than before by `slack` [N].
bool holds_around(const RealGrasp& grasp, const RealLoad& load, Real slack);

}  // namespace poise::verify
