// The convex hull of points in space, by Qhull.
#pragma once

#include <optional>
#include <vector>

#include "verify/statics.hpp"

namespace poise::verify {

/// normal . x + offset <= 0 for all points of the hull; the normal has length 1.
struct Facet {
  Vec normal;
  Real offset{0};
};

/// None where the points lie in a plane, or there are fewer than four.
std::optional<std::vector<Facet>> hull(const std::vector<Vec>& points);

}  // namespace poise::verify
