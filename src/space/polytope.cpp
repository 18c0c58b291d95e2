#include "space/polytope.hpp"

#include <algorithm>
#include <limits>

namespace poise {

Polytope::Polytope(double half) : rounding_(2e-15 * half) {
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Vertex v{};
    std::size_t negative = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t side = corner >> d & 1;
      negative += side;
      v.x[static_cast<Eigen::Index>(d)] = side == 1 ? -half : half;
      v.planes[d] = static_cast<int>(2 * d + side);
      v.next[d] = corner ^ (std::size_t{1} << d);
    }
    if (negative % 2 == 1) {  // all turn the same way
      std::swap(v.planes[1], v.planes[2]);
      std::swap(v.next[1], v.next[2]);
    }
    v.square = v.x.squaredNorm();
    v.alive = true;
    add(v);
  }
  for (int id = 0; id < static_cast<int>(cube_sides); ++id)
    planes_.push_back({(id % 2 == 0 ? 1 : -1) * Vector<3>::Unit(id / 2), half});
}

std::size_t Polytope::add(const Vertex& vertex) {
  if (free_.empty()) {
    vertices_.push_back(vertex);
    squares_.push_back(vertex.square);
    in_patch_.push_back(0);
    return vertices_.size() - 1;
  }
  const std::size_t i = free_.back();
  free_.pop_back();
  vertices_[i] = vertex;
  squares_[i] = vertex.square;
  return i;
}

void Polytope::remove(std::size_t vertex) {
  vertices_[vertex].alive = false;
  squares_[vertex] = passed_over;
}

bool Polytope::cut(const Vector<3>& n, double b, int id) {
  std::size_t hint = none;
  double most = b + rounding_;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (!vertices_[i].alive || !(n.dot(vertices_[i].x) > most)) continue;
    most = n.dot(vertices_[i].x);
    hint = i;
  }
  if (hint == none) return false;
  // Where rounding makes it ambiguous, a little less may do.
  for (const double less : {0.0, 8.0, 64.0, 512.0})
    if (cut(n, b + less * rounding_, id, hint)) return true;
  return false;
}

bool Polytope::cut(const Vector<3>& n, double b, int id, std::size_t hint) {
  if (!find_patch(n, b, hint)) return false;
  if (!edges_.empty()) {  // else nothing is left
    if (!order_edges()) return false;
    if (planes_.size() <= static_cast<std::size_t>(id))
      planes_.resize(static_cast<std::size_t>(id) + 1);
    planes_[static_cast<std::size_t>(id)] = {n, b};
    add_fan(n, b, id);
  }
  for (const std::size_t i : patch_) {
    remove(i);
    free_.push_back(i);
  }
  return true;
}

/// The patch of vertices that are cut off, and the edges that lead out of it. False: there are
/// none.
bool Polytope::find_patch(const Vector<3>& n, double b, std::size_t hint) {
  const auto is_beyond = [&](std::size_t i) { return n.dot(vertices_[i].x) > b + rounding_; };
  if (!is_beyond(hint)) return false;
  patch_.assign(1, hint);
  in_patch_[hint] = 1;
  for (std::size_t k = 0; k < patch_.size(); ++k)
    for (const std::size_t i : vertices_[patch_[k]].next)
      if (in_patch_[i] == 0 && is_beyond(i)) {
        in_patch_[i] = 1;
        patch_.push_back(i);
      }
  edges_.clear();
  for (const std::size_t i : patch_)
    for (std::size_t e = 0; e < 3; ++e)
      if (in_patch_[vertices_[i].next[e]] == 0) edges_.push_back({i, e});
  for (const std::size_t i : patch_) in_patch_[i] = 0;
  return true;
}

/// The edges lead once round the patch, from plane to plane. False: rounding has made it no disk.
bool Polytope::order_edges() {
  for (std::size_t k = 0; k + 1 < edges_.size(); ++k) {
    std::size_t follower = k + 1;
    while (follower < edges_.size() && plane_of(edges_[follower], 1) != plane_of(edges_[k], 2))
      ++follower;
    if (follower == edges_.size()) return false;
    std::swap(edges_[k + 1], edges_[follower]);
  }
  return edges_.size() >= 3 && plane_of(edges_.front(), 1) == plane_of(edges_.back(), 2);
}

/// On each edge a new vertex, opposite to the new plane.
void Polytope::add_fan(const Vector<3>& n, double b, int id) {
  fan_.clear();
  for (const Edge& edge : edges_) {
    const Vertex& from = vertices_[edge.from];
    const std::size_t outside = from.next[edge.leaves];
    const Vertex& to = vertices_[outside];
    const double above = n.dot(from.x) - b, below = b - n.dot(to.x);
    const double part = below > 0 ? above / (above + below) : 1;
    Vertex v{};
    v.x = from.x + part * (to.x - from.x);
    v.square = v.x.squaredNorm();
    v.planes = {plane_of(edge, 1), plane_of(edge, 2), id};
    v.next = {none, none, outside};
    v.alive = true;
    fan_.push_back(add(v));
  }
  for (std::size_t k = 0; k < fan_.size(); ++k) {
    const std::size_t i = fan_[k], j = fan_[(k + 1) % fan_.size()];
    vertices_[i].next[0] = j;  // leaves its first plane: shares the second and the new one
    vertices_[j].next[1] = i;
    // The edge's other end knew it by the vertex that goes.
    const Planes& planes = vertices_[i].planes;
    Vertex& to = vertices_[vertices_[i].next[2]];
    for (std::size_t e = 0; e < 3; ++e)
      if (to.planes[e] != planes[0] && to.planes[e] != planes[1]) to.next[e] = i;
  }
}

std::size_t Polytope::farthest() const {
  std::size_t best = none;
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (vertices_[i].alive && (best == none || vertices_[i].square > vertices_[best].square))
      best = i;
  return best;
}

std::size_t Polytope::farthest_not_passed_over() const {
  // Of each lane, so that compilers use SIMD instructions.
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> of_lane;
  of_lane.fill(passed_over);
  std::size_t i = 0;
  for (; i + lanes <= squares_.size(); i += lanes)
    for (std::size_t k = 0; k < lanes; ++k)
      of_lane[k] = squares_[i + k] > of_lane[k] ? squares_[i + k] : of_lane[k];
  double most = *std::max_element(of_lane.begin(), of_lane.end());
  for (; i < squares_.size(); ++i) most = std::max(most, squares_[i]);
  if (!(most > passed_over)) return none;
  return static_cast<std::size_t>(std::find(squares_.begin(), squares_.end(), most) -
                                  squares_.begin());
}

Vector<3> Polytope::nearest() const {
  Vector<3> best = Vector<3>::Zero();
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](const Vector<3>& x) {
    if (!(x.squaredNorm() < least)) return;
    least = x.squaredNorm();
    best = x;
  };
  // On a face, if the point of its plane is in all half-spaces; else on an edge or at a vertex.
  bool inside = true;
  for (const Plane& plane : planes_) {
    if (!(plane.b < 0)) continue;
    inside = false;
    const Vector<3> x = plane.b * plane.n;
    if (std::all_of(planes_.begin(), planes_.end(),
                    [&](const Plane& other) { return other.n.dot(x) <= other.b + rounding_; }))
      take(x);
  }
  if (inside) return best;
  for (const Vertex& v : vertices_) {
    if (!v.alive) continue;
    take(v.x);
    for (const std::size_t i : v.next) {
      const Vector<3> along = vertices_[i].x - v.x;
      const double part = -v.x.dot(along);
      if (part > 0 && part < along.squaredNorm()) take(v.x + part / along.squaredNorm() * along);
    }
  }
  return best;
}

Vector<3> Polytope::middle() const {
  Vector<3> sum = Vector<3>::Zero();
  double count = 0;
  for (const Vertex& v : vertices_)
    if (v.alive) {
      sum += v.x;
      ++count;
    }
  return count > 0 ? Vector<3>(sum / count) : sum;
}

}  // namespace poise
