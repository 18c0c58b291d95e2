#include "turn/levels.hpp"

#include <algorithm>
#include <deque>
#include <queue>

namespace poise::turns {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// Corners by the level at which they are reached, lowest first. `spread(corner, reach)` calls
/// reach(next, level of the step).
template <class Spread>
Levels spread_from(std::size_t count, int from, double first, const Spread& spread) {
  Levels levels{std::vector<double>(count, infinity), std::vector<int>(count, -1)};
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  levels.p[at(from)] = first;
  open.push({first, from});
  while (!open.empty()) {
    const auto [level, corner] = open.top();
    open.pop();
    if (level > levels.to(corner)) continue;
    spread(corner, [&, here = corner, so_far = level](int next, double step) {
      const double then = std::max(so_far, step);
      if (!(then < levels.to(next))) return;
      levels.p[at(next)] = then;
      levels.before[at(next)] = here;
      open.push({then, next});
    });
  }
  return levels;
}

}  // namespace

std::vector<int> Levels::way(int corner) const {
  std::vector<int> corners;
  for (int k = corner; k >= 0; k = before[at(k)]) corners.push_back(k);
  std::reverse(corners.begin(), corners.end());
  return corners;
}

Levels levels_proven(const Mesh& mesh, int from, double most) {
  const auto stars = mesh.stars();
  return spread_from(mesh.corners().size(), from, 0, [&](int corner, const auto& reach) {
    for (const int t : stars[at(corner)])
      if (const Triangle& triangle = mesh.triangle(t); triangle.least < most)
        for (const int next : triangle.corners) reach(next, triangle.least);
  });
}

Levels levels_reached(Mesh& mesh, int from) {
  const auto stars = mesh.stars();
  return spread_from(mesh.corners().size(), from, mesh.corner(from).p,
                     [&](int corner, const auto& reach) {
                       for (const int t : stars[at(corner)])
                         for (const int next : mesh.triangle(t).corners)
                           if (next != corner && mesh.corner(next).holdable())
                             reach(next, mesh.most_on(corner, next));
                     });
}

std::vector<int> doubtful_on_way(Mesh& mesh, int from, const std::vector<int>& to, double level) {
  const auto stars = mesh.stars();
  const std::size_t count = mesh.corners().size();
  std::vector<int> doubts(count, -1), before(count, -1), by(count, -1);
  std::deque<int> open{from};
  doubts[at(from)] = 0;
  std::vector<char> done(count, 0);
  while (!open.empty()) {
    const int corner = open.front();
    open.pop_front();
    if (std::exchange(done[at(corner)], 1) != 0) continue;
    for (const int t : stars[at(corner)]) {
      const double least = mesh.triangle(t).least;
      if (!(least < infinity) || least > level) continue;
      const bool is_sure = mesh.most_around(t) <= level;
      for (const int next : mesh.triangle(t).corners) {
        const int then = doubts[at(corner)] + (is_sure ? 0 : 1);
        if (doubts[at(next)] >= 0 && doubts[at(next)] <= then) continue;
        doubts[at(next)] = then;
        before[at(next)] = corner;
        by[at(next)] = is_sure ? -1 : t;
        is_sure ? open.push_front(next) : open.push_back(next);
      }
    }
  }
  int end = -1;
  for (const int corner : to)
    if (doubts[at(corner)] >= 0 && (end < 0 || doubts[at(corner)] < doubts[at(end)])) end = corner;
  std::vector<int> found;
  for (int k = end; k >= 0; k = before[at(k)])
    if (by[at(k)] >= 0) found.push_back(by[at(k)]);
  return found;
}

bool refine(Mesh& mesh, const std::vector<int>& triangles) {
  bool any = false;
  for (const int t : triangles) {
    if (mesh.is_finest(t)) continue;
    mesh.bisect(t);
    any = true;
  }
  return any;
}

}  // namespace poise::turns
