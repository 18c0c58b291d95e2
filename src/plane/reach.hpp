// How far the faces of an arc stay valid. Not installed.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace poise {

/// g(theta) = a + b cos theta + c sin theta around a posture where it is not negative: how far it
/// stays so on either side, as t = tan(turn / 2).
struct Reach {
  explicit Reach(double theta);

  /// Keeps to where g >= 0. What is nowhere negative but for rounding is no constraint.
  void keep(const Eigen::RowVector3d& g, double rounding);
  /// Keeps to this side of a posture.
  void stop(double angle);
  double from() const { return at + 2 * std::atan(least); }
  double to() const { return at + 2 * std::atan(most); }

  double at, cosine, sine;
  double least{-std::numeric_limits<double>::infinity()};
  double most{std::numeric_limits<double>::infinity()};
};

}  // namespace poise
