#include "poise/posture.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace poise {
namespace {

/// Distance of the com (the origin) from the hull of the contact points, given that it is outside.
double distance_to_hull(const std::vector<Vector<2>>& arms) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Vector<2>& a : arms) {
    distance = std::min(distance, a.norm());
    for (const Vector<2>& b : arms) {
      const Vector<2> ab = b - a;
      const double s = -a.dot(ab);
      if (s > 0 && s < ab.squaredNorm())
        distance = std::min(distance, std::abs(a.x() * b.y() - a.y() * b.x()) / ab.norm());
    }
  }
  return distance;
}

}  // namespace

const char* to_string(Manner manner) {
  constexpr const char* names[] = {"resting", "cradled", "pinched"};
  return names[static_cast<int>(manner)];
}

// Straight down from the com meets the hull of the contacts where it points into the cone that they
// span, seen from the com. From outside the hull they span less than 180 degrees, so one of the
// gaps between neighbouring directions is wider than that.
Interval cradled_wedge(const Grasp<2>& grasp) {
  const double near = 1e-9 * grasp.radius();
  std::vector<Vector<2>> arms;
  for (const Contact<2>& contact : grasp.contacts()) {
    arms.emplace_back(contact.position - grasp.object().com);
    if (arms.back().norm() <= near) return {};
  }
  std::sort(arms.begin(), arms.end(), [](const Vector<2>& a, const Vector<2>& b) {
    return std::atan2(a.y(), a.x()) < std::atan2(b.y(), b.x());
  });
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const Vector<2>&last = arms[i], &first = arms[(i + 1) % arms.size()];  // counter-clockwise
    const double turn = std::atan2(last.x() * first.y() - last.y() * first.x(), last.dot(first));
    const double width =
        -turn;  // of the cone from `first` to `last`, where the gap is the wide one
    if (!(width > 1e-12)) continue;
    const Vector<2> middle = (first.normalized() + last.normalized()).normalized();
    const bool clear = std::all_of(arms.begin(), arms.end(),
                                   [&](const Vector<2>& arm) { return arm.dot(middle) > near; });
    if (!clear && distance_to_hull(arms) <= near) return {};
    // Down turns counter-clockwise from `first` to `last` while theta falls.
    double from = angle_of(-last);
    if (from >= 3.141592653589793) from = -3.141592653589793;
    return {from, from + width};
  }
  return {};
}

}  // namespace poise
