#include "poise/turn.hpp"

#include <cmath>

namespace poise {

Eigen::Quaterniond smallest_turn(const Eigen::Quaterniond& orientation, const Vector<3>& up) {
  const Vector<3> now = (orientation.normalized() * up).normalized();
  // From `now` to z: by half the angle, w = cos and the axis times sin.
  const Vector<3> axis = now.cross(Vector<3>::UnitZ());
  const double across = axis.norm(), angle = std::atan2(across, now.z());
  if (!(across > 1e-15))
    return now.z() > 0 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(0, 1, 0, 0);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis / across));
}

Turn turn_to(const Eigen::Quaterniond& orientation, const Vector<3>& up) {
  const Eigen::Quaterniond rotation = smallest_turn(orientation, up);
  Eigen::Quaterniond result = (rotation * orientation).normalized();
  if (result.w() < 0) result.coeffs() = -result.coeffs();
  const double sine = rotation.vec().norm();
  return {rotation, result, 2 * std::atan2(sine, rotation.w()),
          sine > 0 ? Vector<3>(rotation.vec() / sine) : Vector<3>(Vector<3>::UnitX())};
}

Eigen::Quaterniond orientation_of(const Vector<3>& up) {
  return smallest_turn(Eigen::Quaterniond::Identity(), up);
}

}  // namespace poise
