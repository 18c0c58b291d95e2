// Cubic splines through points at rising times. Not installed.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace poise {

/// The derivatives of a spline at its points, one row each.
struct SplineDerivatives {
  Eigen::MatrixXd first, second;
};

/// Of the cubic spline through the rows of `points`, twice continuously differentiable, whose third
/// derivative is continuous at the second and the last but one; through three points a parabola,
/// through two a line, of one nothing moves.
SplineDerivatives spline(const std::vector<double>& times, const Eigen::MatrixXd& points);

}  // namespace poise
