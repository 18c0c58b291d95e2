// Trigonometric polynomials of the angle theta of a planar posture, in long double.
#pragma once

#include <vector>

#include "poise/posture_curve.hpp"
#include "verify/statics.hpp"

namespace poise::verify {

inline constexpr Real pi = std::numbers::pi_v<Real>;
/// Pieces of the circle end where rounding puts them [rad].
inline constexpr Real end_slack = 2e-8L;
/// So much of the circle may be left to pieces too narrow to prove anything [rad].
inline constexpr Real most_narrow = 1e-7L;

using Vec3 = Eigen::Matrix<Real, 3, 1>;
using Mat3 = Eigen::Matrix<Real, 3, 3>;

Real radians_of(Real degrees);
/// The posture theta: (sin, cos).
Vec up_at(Real theta);

/// What everything on an arc is linear in: (1, cos, sin).
Vec3 harmonics(Real theta);

/// `angle` moved by whole turns into [start, start + 2 pi), or just below `start`.
Real unwound(Real angle, Real start);
/// Between two angles, from <= to, or so near to them.
bool within(Real angle, Real from, Real to, Real slack);
/// The shorter way from one angle to another [rad], at least 0.
Real angle_between(Real a, Real b);

/// The least value of g . harmonics(theta) in an interval.
Real least(const Vec3& g, Real from, Real to);
/// The greatest size of that value.
Real greatest_size(const Vec3& g, Real from, Real to);
/// How far wrenches, times harmonics(theta), are from 0 in an interval: as relative_size().
Real relative_size(const Mat3& wrenches, const RealLoad& load, Real from, Real to);

/// The load about the origin is this matrix times harmonics(theta).
Mat3 load_matrix(const RealLoad& load);

/// V or F: c0 + cos1 cos + sin1 sin + cos2 cos 2 theta + sin2 sin 2 theta
struct Effort {
  Real c0{0}, cos1{0}, sin1{0}, cos2{0}, sin2{0};

  Real operator()(Real theta) const;
  Real slope(Real theta) const;
  /// The sum of the sizes of its coefficients.
  Real scale() const;
  /// The ends of an interval and where it may be stationary between them, in order.
  std::vector<Real> turning_points(Real from, Real to) const;
  /// Its least and its greatest value in an interval.
  Real least(Real from, Real to) const;
  Real greatest(Real from, Real to) const;
};
/// Those of an answer.
Effort effort_of(const Harmonic2& V);
Effort effort_of(const Harmonic1& F);

}  // namespace poise::verify
