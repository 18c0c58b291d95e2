#include "motion/polygon.hpp"

#include <algorithm>

namespace poise {

Corners hull(std::vector<Vector<2>> points) {
  std::sort(points.begin(), points.end(), [](const Vector<2>& a, const Vector<2>& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Corners corners;
  const auto add = [&](const Vector<2>& point, std::size_t first) {
    while (corners.size() > first + 1 &&
           cross(corners.back() - corners[corners.size() - 2], point - corners.back()) <= 0)
      corners.pop_back();
    corners.push_back(point);
  };
  for (const Vector<2>& point : points) add(point, 0);
  const std::size_t first = corners.empty() ? 0 : corners.size() - 1;
  for (std::size_t k = points.size(); k-- > 0;) add(points[k], first);
  if (corners.size() > 1) corners.pop_back();
  return corners;
}

double part_inside(const Corners& corners, const Vector<2>& inside, const Vector<2>& point) {
  const Vector<2> way = point - inside;
  double part = corners.size() > 2 ? 1 : 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector<2>& a = corners[k];
    const Vector<2> edge = corners[(k + 1) % corners.size()] - a;
    const Vector<2> outward(edge.y(), -edge.x());
    const double speed = outward.dot(way), room = std::max(outward.dot(a - inside), 0.0);
    if (speed > 0) part = std::min(part, room / speed);
  }
  return part;
}

}  // namespace poise
