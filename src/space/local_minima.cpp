#include "space/local_minima.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "space/search.hpp"

namespace poise::search {
namespace {

using std::numbers::pi;

/// Descents go on in cones of this angle [rad], by searches of so many holds.
constexpr double near = 0.1;
constexpr int most_descents = 60, holds_per_descent = 150;
/// The gap of the first search, which only leads to the next; and that of the others.
constexpr double first_gap = 1e-3, last_gap = 1e-10;
/// Steps down the slope begin with this length [rad], and end with this.
constexpr double first_reach = 0.1, last_reach = 3e-3;
/// Postures to descend from that are closer than this [rad] are one.
constexpr double same_start = 0.03;

/// Points spread over the directions at most an angle from an axis, on a spiral.
std::vector<Vector<3>> spiral(int count, const TiltCone& cone) {
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
std::optional<Slope> slope(const ScaledLoad& load, const Vector<3>& up, const Twist<3>& start) {
  dual::Point<3> point(load.problem.size);
  if (!dual::maximise<3>(load.problem, load.at(up), start, load.cap, point)) return {};
  const Vector<3> v = load.velocity(point.y);
  return Slope{v - up.dot(v) * up, point.y};
}

/// Steps down the slope of the worst load as long as they lead lower.
std::optional<std::pair<double, Vector<3>>> slide(SearchState& state, const TiltCone* tilt,
                                                  Vector<3> up) {
  up = OnPlanes(up, state.oracle.thin).posture(up);
  Answer here = state.evaluate(up);
  if (!(here.value < infinity)) return {};
  double reach = first_reach;
  for (int step = 0; step < 30 && reach > last_reach; ++step) {
    const Vector<3>& n = here.half_space.normal;
    const Vector<3> slope = n - up.dot(n) * up;
    if (!(slope.norm() > 1e-9)) break;
    Vector<3> next = (up - reach * slope.normalized()).normalized();
    if (tilt != nullptr) next = tilt->nearest(next);
    next = OnPlanes(next, state.oracle.thin).posture(next);
    const Answer answer = state.evaluate(next, &here.half_space);
    const bool is_lower = answer.value < here.value;
    reach *= is_lower ? 1.3 : 0.5;
    if (!is_lower) continue;
    up = next;
    here = answer;
  }
  return std::pair{here.value, up};
}

}  // namespace

std::optional<HalfSpace> descend(const Grasp<3>& grasp, const std::vector<ScaledLoad>& loads,
                                 const std::vector<TiltCone>& domain, Objective objective,
                                 Vector<3> up) {
  std::optional<HalfSpace> lowest;
  for (int step = 0; step < most_descents; ++step) {
    std::vector<TiltCone> cones = domain;
    cones.push_back({up, near});
    SearchState local(Oracle(grasp, loads, objective), std::move(cones),
                      step == 0 ? first_gap : last_gap, Digits::rough);
    minimise(local, holds_per_descent);
    if (!(local.best_value < infinity)) break;
    const double moved = std::acos(std::clamp(up.dot(local.best.x), -1.0, 1.0));
    up = local.best.x;
    lowest = local.best;
    if (step > 0 && moved < 0.99 * near) break;  // inside of the cone
  }
  return lowest;
}

Vector<3> polished_minimum(const ScaledLoad& load, const HalfSpace& found) {
  constexpr double h = 1e-5;  // of differences
  Vector<3> up = found.x;
  std::optional<Slope> here = slope(load, up, found.y);
  if (!here) return up;
  const Eigen::Matrix<double, 3, 2> across = tangents(up);
  Eigen::Matrix2d J;
  for (int k = 0; k < 2; ++k) {
    const auto neighbour = slope(load, (up + h * across.col(k)).normalized(), here->y);
    if (!neighbour) return up;
    J.col(k) = across.transpose() * (neighbour->along - here->along) / h;
  }
  if (!(J.determinant() > 0) || !(J.trace() > 0)) return up;
  for (int step = 0; step < 8; ++step) {  // of Newton's method, while it converges
    const Vector<2> way = -J.inverse() * (across.transpose() * here->along);
    if (!(way.norm() < 1e-3)) return up;
    const Vector<3> next = (up + across * way).normalized();
    const auto after = slope(load, next, here->y);
    if (!after || !(after->along.norm() < 0.5 * here->along.norm())) return up;
    up = next;
    here = after;
    if (way.norm() < 1e-11) return up;
  }
  return up;
}

std::vector<Vector<3>> starts(SearchState& state, int count) {
  const TiltCone* tilt = state.domain.empty() ? nullptr : &state.domain.front();
  std::vector<std::pair<double, Vector<3>>> low;
  for (const Vector<3>& start : spiral(count, tilt ? *tilt : TiltCone{Vector<3>::UnitZ(), pi}))
    if (const auto end = slide(state, tilt, start)) low.push_back(*end);
  std::sort(low.begin(), low.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Vector<3>> lowest;
  for (const auto& [value, up] : low)
    if (std::none_of(lowest.begin(), lowest.end(), [&, at = up](const Vector<3>& other) {
          return (other - at).norm() < same_start;
        }))
      lowest.push_back(up);
  return lowest;
}

}  // namespace poise::search
