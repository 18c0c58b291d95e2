#include "turn/wall.hpp"

#include <algorithm>
#include <map>

namespace poise::turns {
namespace {

/// An edge between a triangle that is reached and one of the wall.
struct Edge {
  int from, to;
  int wall;  ///< the triangle
};

/// Rotates about the end of an edge through triangles of the wall to the next edge.
Edge next_edge(const Mesh& mesh, const std::vector<char>& is_reached, const Edge& edge) {
  int t = edge.wall, from = edge.from;
  for (;;) {
    // t = (edge.to, from, w), counter-clockwise.
    const Triangle& triangle = mesh.triangle(t);
    std::size_t k = 0;
    while (triangle.corners[k] != from) ++k;
    const int w = triangle.corners[(k + 1) % 3], beyond = triangle.neighbours[k];
    if (is_reached[static_cast<std::size_t>(beyond)] != 0) return {edge.to, w, t};
    t = beyond;
    from = w;
  }
}

/// Leaves out what is not needed: a half-space proves as far as it does.
std::vector<Stone> shortened(const Values& values, std::vector<Stone> wall, double level) {
  const std::size_t count = wall.size();
  std::vector<Stone> result;
  for (std::size_t k = 0; k < count;) {
    const Stone& stone = wall[k];
    std::size_t next = k + 1;
    const auto up = [&](std::size_t i) -> const Vector<3>& { return wall[i % count].up; };
    const auto proves = [&](const Vector<3>& a, const Vector<3>& b) {
      return values.least_between(stone.half_space, a, b) >= level;
    };
    while (next < count && proves(up(next), up(next + 1)) && proves(stone.up, up(next + 1))) ++next;
    result.push_back(stone);
    k = next;
  }
  return result;
}

}  // namespace

bool separates(const std::vector<Stone>& wall, const Vector<3>& a, const Vector<3>& b) {
  const Vector<3> n = arc_between(a, b).from.cross(arc_between(a, b).across);
  bool is_odd = false;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    const Vector<3>&p = wall[k].up, &q = wall[(k + 1) % wall.size()].up;
    const double before = n.dot(p), after = n.dot(q);
    if ((before >= 0) == (after >= 0)) continue;
    const Vector<3> crossing = p * std::abs(after) + q * std::abs(before);
    // Between a and b on the arc.
    if (n.dot(a.cross(crossing)) > 0 && n.dot(crossing.cross(b)) > 0) is_odd = !is_odd;
  }
  return is_odd;
}

std::vector<Stone> wall_of(const Values& values, const Mesh& mesh, double level) {
  const Levels reached = levels_proven(mesh, 0, level);
  const auto is_near = [&](int corner) { return reached.to(corner) < level; };
  std::vector<char> is_reached(mesh.triangles().size(), 0);
  for (std::size_t t = 0; t < is_reached.size(); ++t) {
    const Triangle& triangle = mesh.triangles()[t];
    is_reached[t] = triangle.least < level && is_near(triangle.corners[0]) ? 1 : 0;
  }
  std::map<std::pair<int, int>, Edge> edges;
  for (std::size_t t = 0; t < is_reached.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& triangle = mesh.triangles()[t];
      const int beyond = triangle.neighbours[k];
      if (is_reached[t] == 0 || is_reached[static_cast<std::size_t>(beyond)] != 0) continue;
      const Edge edge{triangle.corners[(k + 1) % 3], triangle.corners[(k + 2) % 3], beyond};
      edges[{edge.from, edge.to}] = edge;
    }
  while (!edges.empty()) {
    const Edge first = edges.begin()->second;
    std::vector<Stone> wall;
    Edge edge = first;
    do {
      wall.push_back({mesh.corner(edge.from).x, mesh.strongest(edge.wall)});
      edges.erase({edge.from, edge.to});
      edge = next_edge(mesh, is_reached, edge);
    } while (edge.from != first.from || edge.to != first.to);
    if (separates(wall, mesh.corner(0).x, mesh.corner(1).x))
      return shortened(values, std::move(wall), level);
  }
  return {};
}

}  // namespace poise::turns
