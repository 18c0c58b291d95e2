// The hand within the settings of a question about shaking. Not installed.
#pragma once

#include "poise/shake.hpp"
#include "shake/body.hpp"

namespace poise {

/// What is as good as no acceleration [m/s^2].
inline constexpr double no_acceleration = 1e-9 * standard_gravity;

/// How the shake of one load is measured, of which no more than `enough` is of interest [m/s^2].
Wanted wanted_shake(const ShakeSettings& settings, double enough);

/// @throws InvalidGrasp for settings out of their ranges
void check_shake(const ShakeSettings& settings);

/// The hand with drives that give no more than the grip that was asked for.
template <int Dim>
Hand<Dim> limited_hand(const Hand<Dim>& hand, const ShakeSettings& settings);

}  // namespace poise
