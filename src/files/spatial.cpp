#include "files/spatial.hpp"

#include <cmath>
#include <limits>

namespace poise {

SpatialPosture hold_all(const std::vector<Grasp<3>>& scenarios, const Vector<3>& up,
                        const HoldSettings& settings) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  SpatialPosture posture;
  posture.up = up;
  for (std::size_t k = 0; k < scenarios.size(); ++k) {
    Hold<3> hold = poise::hold<3>(scenarios[k], up, settings);
    posture.scenario_efforts.push_back(hold.holdable ? hold.effort : infinity);
    if (k > 0 && posture.scenario_efforts[k] <= posture.scenario_efforts[posture.scenario])
      continue;
    posture.scenario = k;
    posture.hold = std::move(hold);
  }
  if (posture.hold.holdable) posture.manner = manner(scenarios[posture.scenario], up, posture.hold);
  return posture;
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
