// The hand within the settings of a question about shaking. Not installed.
#pragma once

#include "poise/shake.hpp"

namespace poise {

/// @throws InvalidGrasp for settings out of their ranges
void check_shake(const ShakeSettings& settings);

/// The hand with drives that give no more than the grip that was asked for.
template <int Dim>
Hand<Dim> limited_hand(const Hand<Dim>& hand, const ShakeSettings& settings);

}  // namespace poise
