// Convex polygons cut by half-planes. Not installed.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "poise/wrench.hpp"

namespace poise {

/// A half-plane normal . p <= most.
struct HalfPlane {
  Vector<2> normal;
  double most;
};

/// The corners of a convex polygon, counter-clockwise.
using Corners = std::vector<Vector<2>>;

/// What a half-plane leaves of it.
inline Corners cut(const Corners& corners, const HalfPlane& by) {
  Corners left;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector<2>&a = corners[k], &b = corners[(k + 1) % corners.size()];
    const double over_a = by.normal.dot(a) - by.most, over_b = by.normal.dot(b) - by.most;
    if (over_a <= 0) left.push_back(a);
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0))
      left.push_back(a + over_a / (over_a - over_b) * (b - a));
  }
  return left;
}

inline double cross(const Vector<2>& a, const Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The middle of its area; of its corners where it has none.
inline Vector<2> centroid(const Corners& corners) {
  Vector<2> sum = Vector<2>::Zero(), mean = Vector<2>::Zero();
  double twice = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector<2> a = corners[k] - corners[0], b = corners[(k + 1) % corners.size()] - corners[0];
    const double part = cross(a, b);
    twice += part;
    sum += part / 3 * (a + b);
    mean += (corners[k] - corners[0]) / static_cast<double>(corners.size());
  }
  return corners[0] + (twice > 0 ? Vector<2>(sum / twice) : mean);
}

/// The hull of points, counter-clockwise (Andrew 1979).
Corners hull(std::vector<Vector<2>> points);

/// The part of the way from `inside` to `point` that lies in a convex polygon around `inside`; at
/// most 1.
double part_inside(const Corners& corners, const Vector<2>& inside, const Vector<2>& point);

}  // namespace poise
