// What of accelerations is checked: docs/certificate.md, "capacity" and "sturdiest".
#pragma once

#include "verify/checks.hpp"

namespace poise::verify {

/// What is as good as no acceleration [m/s^2], and how near the two sides of a shake are.
inline constexpr Real no_acceleration = 1e-8L, shake_gap = 1e-3L;
inline constexpr Real follows = 1e-6L;  ///< of a bound, from its dual

/// What (y, rates) leave of one load's wrenches: y . w at most this.
Real most_power(const RealGrasp& grasp, const Vec& y, const std::vector<Real>& rates, Real cap);

/// Checks what one load, the only one of the grasp, withstands with `up`.
template <int Dim>
void check_shake(Verdict& verdict, const Path& place, const Grasp<Dim>& one, const Vector<Dim>& up,
                 const ShakeClaim<Dim>& claim, Real cap);

}  // namespace poise::verify
