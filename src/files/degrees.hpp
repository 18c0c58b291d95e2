// Angles as people write them.
#pragma once

#include <cmath>
#include <numbers>

namespace poise {

/// An angle in degrees, never -0.
inline double degrees(double radians) {
  const double value = radians / (std::numbers::pi / 180);
  return value == 0 ? 0 : value;
}

/// The same angle [degrees] in (-180, 180].
inline double in_circle(double degrees) {
  const double turned = std::remainder(degrees, 360);
  return turned > -180 ? turned : 180;
}

/// An angle in (-pi, pi].
inline double radians(double degrees) { return in_circle(degrees) * std::numbers::pi / 180; }

}  // namespace poise
