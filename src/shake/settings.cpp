#include "shake/settings.hpp"

#include <algorithm>
#include <cmath>

namespace poise {
namespace {

/// Of the force cap: forces are at least as great as the load, and some weights in the mean.
constexpr double part_of_cap = 1e-3;

}  // namespace

Wanted wanted_shake(const ShakeSettings& settings, double enough) {
  const double far = part_of_cap * settings.force_cap * standard_gravity;
  return {.gap = settings.gap,
          .little = no_acceleration,
          .far = far,
          .horizon = 4 * far,
          .enough = enough,
          .needed = 0,
          .max_holds = settings.max_holds};
}

void check_shake(const ShakeSettings& settings) {
  if (!(settings.gap > 0) || !(settings.gap < 1))
    throw InvalidGrasp("gap", "must be above 0 and below 1");
  if (!(settings.force_cap > 0) || !(settings.force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9 sizes of the load");
  if (settings.max_holds < 1) throw InvalidGrasp("max_holds", "must be at least 1");
  if (settings.most_grip && (!(*settings.most_grip > 0) || !std::isfinite(*settings.most_grip)))
    throw InvalidGrasp("most_grip", "must be above 0 and finite");
}

template <int Dim>
Hand<Dim> limited_hand(const Hand<Dim>& hand, const ShakeSettings& settings) {
  if (!settings.most_grip) return hand;
  const double most = *settings.most_grip;
  const bool in_parts = grip_unit(hand) == GripUnit::part_of_max;
  const auto limit = [&](double& max) { max = std::min(max, in_parts ? most * max : most); };
  Mechanism<Dim> mechanism = hand.mechanism();
  for (Drive<Dim>& drive : mechanism.drives) limit(drive.max);
  if (mechanism.kind != DriveKind::listed)
    for (const std::string& name : hand.fingers()) {
      auto& fingers = mechanism.fingers;
      auto finger = std::find_if(fingers.begin(), fingers.end(),
                                 [&](const Finger<Dim>& each) { return each.name == name; });
      if (finger == fingers.end()) {
        fingers.push_back({.name = name});
        finger = fingers.end() - 1;
      }
      limit(finger->max_force);
    }
  return {hand.contacts(), hand.center(), 1, std::move(mechanism)};
}

template Hand<2> limited_hand(const Hand<2>&, const ShakeSettings&);
template Hand<3> limited_hand(const Hand<3>&, const ShakeSettings&);

}  // namespace poise
