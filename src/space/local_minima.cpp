#include "space/local_minima.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "dual/dual.hpp"


namespace poise::search {
namespace {

/// Points spread over the directions at most an angle from an axis, on a spiral.
std::vector<Vector<3>> spiral(int count, const Cone& cone) {
  const Eigen::Matrix<double, 3, 2> across = tangents(cone.axis);
  const double height = 1 - std::cos(cone.most);
  std::vector<Vector<3>> points;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - height * (k + 0.5) / count, r = std::sqrt(1 - z * z);
    const double turn = k * pi * (3 - std::sqrt(5.0));
    points.emplace_back(across * Vector<2>(r * std::cos(turn), r * std::sin(turn)) + z * cone.axis);
  }
  return points;
}

/// The slope of the effort at a posture, along the sphere, and the y of its hold, from which others
/// nearby start; none where it cannot be held.
struct Slope {
  Vector<3> along;
  Twist<3> y;
};
std::optional<Slope> slope(const Case& load, const Vector<3>& up, const Twist<3>& start) {
  dual::Point<3> point(load.problem.size);
  if (!dual::maximise<3>(load.problem, load.at(up), start, load.cap, point)) return {};
  const Vector<3> v = load.velocity(point.y);
  return Slope{v - up.dot(v) * up, point.y};
}

}  // namespace

std::optional<std::pair<Vector<3>, Row>> descend(const Grasp<3>& grasp,
                                                 const std::vector<Case>& cases,
                                                 const std::vector<Cone>& domain, Vector<3> up) {
  constexpr double near = 0.1;
  std::optional<std::pair<Vector<3>, Row>> lowest;
  for (int step = 0; step < 60; ++step) {
    std::vector<Cone> cones = domain;
    cones.push_back({up, near});
    Search local(grasp, cases, cones, step == 0 ? 1e-3 : 1e-10, 150, true);
    local.run();
    if (!(local.best_V() < infinity)) break;
    const double moved = std::acos(std::clamp(up.dot(local.best_up()), -1.0, 1.0));
    up = local.best_up();
    lowest = {up, local.best_row()};
    if (step > 0 && moved < 0.99 * near) break;
  }
  return lowest;
}

Vector<3> settled(const Case& load, Vector<3> up, const Row& row) {
  constexpr double h = 1e-5;
  std::optional<Slope> here = slope(load, up, row.y);
  if (!here) return up;
  const Eigen::Matrix<double, 3, 2> across = tangents(up);
  Eigen::Matrix2d J;
  for (int k = 0; k < 2; ++k) {
    const auto beside = slope(load, (up + h * across.col(k)).normalized(), here->y);
    if (!beside) return up;
    J.col(k) = across.transpose() * (beside->along - here->along) / h;
  }
  if (!(J.determinant() > 0) || !(J.trace() > 0)) return up;
  for (int step = 0; step < 8; ++step) {
    const Vector<2> way = -J.inverse() * (across.transpose() * here->along);
    if (!(way.norm() < 1e-3)) return up;
    const Vector<3> next = (up + across * way).normalized();
    const auto there = slope(load, next, here->y);
    if (!there || !(there->along.norm() < 0.5 * here->along.norm())) return up;
    up = next;
    here = there;
    if (way.norm() < 1e-11) return up;
  }
  return up;
}

std::vector<Vector<3>> starts(Search& search, const std::vector<Cone>& domain, int count) {
  const Cone all = domain.empty() ? Cone{Vector<3>::UnitZ(), pi} : domain.front();
  std::vector<std::pair<double, Vector<3>>> low;
  for (const Vector<3>& start : spiral(count, all)) {
    Vector<3> up = OnPlanes(start, search.thin()).posture(start);
    Evaluation here = search.evaluate(up);
    if (!(here.V < infinity)) continue;
    double reach = 0.1;
    for (int step = 0; step < 30 && reach > 3e-3; ++step) {
      const Vector<3> slope = here.row.n - up.dot(here.row.n) * up;
      if (!(slope.norm() > 1e-9)) break;
      Vector<3> next = (up - reach * slope.normalized()).normalized();
      if (!domain.empty()) next = all.nearest(next);
      next = OnPlanes(next, search.thin()).posture(next);
      const Evaluation there = search.evaluate(next, &here.row);
      reach *= there.V < here.V ? 1.3 : 0.5;
      if (!(there.V < here.V)) continue;
      up = next;
      here = there;
    }
    low.emplace_back(here.V, up);
  }
  std::sort(low.begin(), low.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Vector<3>> lowest;
  for (const auto& [V, up] : low)
    if (std::none_of(lowest.begin(), lowest.end(),
                     [&, at = up](const Vector<3>& other) { return (other - at).norm() < 0.03; }))
      lowest.push_back(up);
  return lowest;
}

}  // namespace poise::search
