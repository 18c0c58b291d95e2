#include "turn/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace poise::turns {
namespace {

/// Edges of the first triangles along the great circle are no longer [rad].
constexpr double first_edge = 1.1;
/// Shorter edges [rad] are not halved.
constexpr double shortest = 1e-6;

int next(int k) { return (k + 1) % 3; }
int index(const std::array<int, 3>& list, int item) {
  return static_cast<int>(std::find(list.begin(), list.end(), item) - list.begin());
}
int& at(std::array<int, 3>& list, int k) { return list[static_cast<std::size_t>(k)]; }
int at(const std::array<int, 3>& list, int k) { return list[static_cast<std::size_t>(k)]; }

}  // namespace

Mesh::Mesh(Values& values, const Vector<3>& a, const Vector<3>& b) : values_(values) {
  using std::numbers::pi;
  const Arc circle = arc_between(a, b);
  // The corners of the great circle, in the order in which they follow each other.
  std::vector<int> ring{add_corner(a)};
  const int last = add_corner(b);
  const auto add_between = [&](double from, double to) {
    const int parts = 1 + static_cast<int>((to - from) / first_edge);
    for (int k = 1; k < parts; ++k)
      ring.push_back(add_corner(circle.at(from + (to - from) * k / parts)));
  };
  add_between(0, circle.angle);
  ring.push_back(last);
  add_between(circle.angle, 2 * pi);
  const Vector<3> pole = circle.from.cross(circle.across);
  const int poles[] = {add_corner(pole), add_corner(-pole)};
  const int count = static_cast<int>(ring.size());
  const auto in_ring = [&](int k) { return ring[static_cast<std::size_t>(k % count)]; };
  for (int k = 0; k < count; ++k) {
    const int before = (k + count - 1) % count, after = (k + 1) % count;
    triangles_.push_back({{poles[0], in_ring(k), in_ring(k + 1)}, {count + k, after, before}});
  }
  for (int k = 0; k < count; ++k) {
    const int before = (k + count - 1) % count, after = (k + 1) % count;
    triangles_.push_back(
        {{poles[1], in_ring(k + 1), in_ring(k)}, {k, count + before, count + after}});
  }
  for (int t = 0; t < 2 * count; ++t) update_least(t);
}

int Mesh::add_corner(const Vector<3>& up) {
  corners_.push_back(values_.in_domain(up.normalized()));
  return static_cast<int>(corners_.size()) - 1;
}

/// Of equal ones that of the lowest corners, so that neighbours agree.
int Mesh::longest_edge(const Triangle& triangle) const {
  const auto rank = [&](int k) {
    const int a = at(triangle.corners, next(k)), b = at(triangle.corners, next(next(k)));
    return std::tuple((corner(a).x - corner(b).x).squaredNorm(), -std::min(a, b), -std::max(a, b));
  };
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if (rank(k) > rank(longest)) longest = k;
  return longest;
}

void Mesh::bisect(int t) {
  for (;;) {
    const int across = longest_edge(triangle(t));
    const int neighbour = at(triangle(t).neighbours, across);
    // The longest edges on the way get longer and longer: this ends.
    if (at(triangle(neighbour).neighbours, longest_edge(triangle(neighbour))) == t)
      return split(t, across);
    bisect(neighbour);
  }
}

/// (A, B, C) and (D, C, B), which share the edge BC, become four around its middle M.
void Mesh::split(int t, int across) {
  const Triangle one = triangle(t);
  const int u = at(one.neighbours, across);
  const Triangle two = triangle(u);
  const int across_two = index(two.neighbours, t);
  const int a = at(one.corners, across), b = at(one.corners, next(across));
  const int c = at(one.corners, next(next(across))), d = at(two.corners, across_two);
  const int beyond_ac = at(one.neighbours, next(across));
  const int beyond_ab = at(one.neighbours, next(next(across)));
  const int beyond_db = at(two.neighbours, next(across_two));
  const int beyond_dc = at(two.neighbours, next(next(across_two)));
  const int m = add_corner(corner(b).x + corner(c).x);
  const int t2 = static_cast<int>(triangles_.size()), u2 = t2 + 1;
  triangles_.resize(triangles_.size() + 2);
  const auto set = [&](int k, const std::array<int, 3>& corners, const std::array<int, 3>& beyond) {
    triangles_[static_cast<std::size_t>(k)] = {corners, beyond};
    update_least(k);
  };
  set(t, {a, b, m}, {u2, t2, beyond_ab});
  set(t2, {a, m, c}, {u, beyond_ac, t});
  set(u, {d, c, m}, {t2, u2, beyond_dc});
  set(u2, {d, m, b}, {t, beyond_db, u});
  const auto redirect = [&](int k, int from, int to) {
    auto& neighbours = triangles_[static_cast<std::size_t>(k)].neighbours;
    at(neighbours, index(neighbours, from)) = to;
  };
  redirect(beyond_ac, t, t2);
  redirect(beyond_db, u, u2);
}

double Mesh::most_on(int a, int b) {
  const auto [found, is_new] = most_on_edge_.try_emplace(std::minmax(a, b), 0);
  if (is_new) found->second = values_.most_between(corner(a), corner(b));
  return found->second;
}

double Mesh::most_around(int t) {
  const auto [a, b, c] = triangle(t).corners;
  const double at_corners = std::max({corner(a).p, corner(b).p, corner(c).p});
  return at_corners < infinity ? std::max({most_on(a, b), most_on(b, c), most_on(c, a)}) : infinity;
}

std::vector<std::vector<int>> Mesh::stars() const {
  std::vector<std::vector<int>> stars(corners_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const int k : triangles_[t].corners)
      stars[static_cast<std::size_t>(k)].push_back(static_cast<int>(t));
  return stars;
}

const HalfSpace& Mesh::strongest(int t) const {
  const auto& [a, b, c] = triangle(t).corners;
  const HalfSpace* strongest = nullptr;
  double most = -1;
  for (const int k : {a, b, c}) {
    const HalfSpace& each = corner(k).half_space;
    const double proven = values_.least_within(each, corner(a).x, corner(b).x, corner(c).x);
    if (proven > most) {
      most = proven;
      strongest = &each;
    }
  }
  return *strongest;
}

bool Mesh::is_finest(int t) const {
  const auto& [a, b, c] = triangle(t).corners;
  const double longest =
      std::max({(corner(a).x - corner(b).x).norm(), (corner(b).x - corner(c).x).norm(),
                (corner(c).x - corner(a).x).norm()});
  return longest < shortest;
}

void Mesh::update_least(int t) {
  const auto& [a, b, c] = triangle(t).corners;
  triangles_[static_cast<std::size_t>(t)].least =
      values_.least_within(strongest(t), corner(a).x, corner(b).x, corner(c).x);
}

}  // namespace poise::turns
