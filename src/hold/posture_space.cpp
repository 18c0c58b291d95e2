#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "poise/posture.hpp"

namespace poise {
namespace {

/// Of the hull of at most four points the one nearest to the origin. Keeps the points that span it.
Vector<3> nearest_of(std::vector<Vector<3>>& points) {
  Vector<3> nearest = points.front();
  std::vector<Vector<3>> kept = {nearest};
  for (unsigned subset = 1; subset < 1U << points.size(); ++subset) {
    std::vector<Vector<3>> chosen;
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((subset >> i & 1) != 0) chosen.push_back(points[i]);
    Vector<3> point = chosen[0];
    if (const auto edges = static_cast<Eigen::Index>(chosen.size()) - 1; edges > 0) {
      Eigen::Matrix<double, 3, Eigen::Dynamic> span(3, edges);
      for (Eigen::Index k = 0; k < edges; ++k)
        span.col(k) = chosen[static_cast<std::size_t>(k) + 1] - chosen[0];
      const Eigen::MatrixXd square = span.transpose() * span;
      const Eigen::FullPivLU<Eigen::MatrixXd> lu(square);
      if (!lu.isInvertible()) continue;
      const Eigen::VectorXd part = lu.solve(-span.transpose() * chosen[0]);
      if (part.minCoeff() < 0 || part.sum() > 1) continue;
      point += span * part;
    }
    if (!(point.norm() < nearest.norm())) continue;
    nearest = point;
    kept = std::move(chosen);
  }
  points = std::move(kept);
  return nearest;
}

/// The point of the hull that is nearest to the origin, to one part in a thousand, or one within
/// 1e-10 of it.
Vector<3> nearest_in_hull(const std::vector<Vector<3>>& points) {
  std::vector<Vector<3>> active = {points.front()};
  Vector<3> nearest = active.front();
  for (int step = 0; step < 1000 && nearest.norm() > 1e-10; ++step) {
    const Vector<3>& farthest = *std::min_element(
        points.begin(), points.end(),
        [&](const Vector<3>& a, const Vector<3>& b) { return a.dot(nearest) < b.dot(nearest); });
    if (farthest.dot(nearest) >= 0.999 * nearest.squaredNorm() || active.size() > 3) break;
    active.push_back(farthest);
    nearest = nearest_of(active);
  }
  return nearest;
}

}  // namespace

// From a com outside the hull all contacts lie on one side. Seen from it, on a screen on that side,
// straight down is inside the hull of the contacts if no half-plane beside it is empty of them.
bool cradled(const Hand<3>& hand, const Vector<3>& com, const Vector<3>& up) {
  std::vector<Vector<3>> arms;
  double radius = 0;
  for (const Contact<3>& contact : hand.contacts()) {
    arms.emplace_back(contact.position - com);
    radius = std::max(radius, arms.back().norm());
  }
  if (!(radius > 0)) return false;
  for (Vector<3>& arm : arms) arm /= radius;
  const Vector<3> side = nearest_in_hull(arms);
  if (!(side.norm() > 1e-9) || !(side.dot(up) < 0)) return false;
  const Vector<3> down = -up / -up.dot(side);
  const Eigen::Matrix<double, 3, 2> screen = tangents(side.normalized());
  std::vector<double> angles;
  for (const Vector<3>& arm : arms) {
    if (!(arm.dot(side) > 0)) return false;
    const Vector<2> beside = screen.transpose() * (arm / arm.dot(side) - down);
    if (beside.norm() > 1e-12 * down.norm()) angles.push_back(std::atan2(beside.y(), beside.x()));
  }
  if (angles.empty()) return false;
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest < std::numbers::pi - 1e-9;
}

}  // namespace poise
