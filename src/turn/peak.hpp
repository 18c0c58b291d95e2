// The peak of turns along great circles, enclosed. Not installed.
#pragma once

#include <vector>

#include "turn/values.hpp"

namespace poise::turns {

/// What an arc needs at most, and a posture of it that needs at least `least`.
struct Enclosure {
  double most{0}, least{0};  ///< of p; both infinite where a posture of it is unholdable
  double at{0};              ///< where [rad] `least` is needed
  Valued posture;
  struct Stretch {
    double from, to;  ///< the nearest postures that hold, or the ends of the arc
    double at;        ///< in the middle of those found unholdable
  };
  std::vector<Stretch> unholdable;
};

/// Encloses the peak until most - least <= gap most, or until it is known whether it is above
/// `enough`. With `enough` infinite all unholdable stretches are found.
Enclosure peak_of(Values& values, const Arc& arc, double gap, double enough, int max_holds);

}  // namespace poise::turns
