// The faces of a planar contact's friction cone, cut at its limits.
#pragma once

#include "verify/trig.hpp"

namespace poise::verify {

/// A face of the trapezoid {|t| <= mu n, least <= n <= most}: there the force is P z + f0, for all
/// z with every `side` at least 0.
struct Face {
  Eigen::Matrix<Real, 2, 2> P = Eigen::Matrix<Real, 2, 2>::Zero();
  Eigen::Matrix<Real, 2, 1> f0 = Eigen::Matrix<Real, 2, 1>::Zero();
  std::vector<Vec3> sides{};  ///< a + b z_n + c z_t
};

/// The face to which z is projected.
Face face_of(const RealContact& contact, const Eigen::Matrix<Real, 2, 1>& z);

}  // namespace poise::verify
