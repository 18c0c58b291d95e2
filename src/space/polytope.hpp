// A polytope in space as the half-spaces that bound it and its vertices. Not installed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "poise/wrench.hpp"

namespace poise {

/// Cut out of a cube by half-spaces. Every vertex lies on three planes (where more meet, there are
/// several vertices at one point), so vertices and edges are the triangles and edges of a closed
/// surface whose corners are the planes; a cut replaces a patch of it by a fan.
class Polytope {
 public:
  using Planes = std::array<int, 3>;  ///< ids
  struct Vertex {
    Vector<3> x;
    double square;  ///< |x|^2
    Planes planes;
    std::array<std::size_t, 3> next;  ///< along the edge that leaves planes[k]
    bool alive;
  };

  static constexpr std::size_t cube_sides = 6;
  /// |x_k| <= half; the planes' ids are 0, 1 (x at half, -half), 2, 3 (y), 4, 5 (z).
  explicit Polytope(double half);

  /// Keeps n . x <= b, n of length 1, as plane `id`. `hint`: a vertex that it may cut off. False,
  /// and unchanged: it cuts off none by more than rounding, or rounding makes it ambiguous.
  bool cut(const Vector<3>& n, double b, int id, std::size_t hint);
  bool cut(const Vector<3>& n, double b, int id);

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// The vertex farthest from the origin; none if there is none.
  std::size_t farthest() const;
  /// Of those not passed over.
  std::size_t farthest_not_passed_over() const;
  void pass_over(std::size_t vertex) { squares_[vertex] = passed_over; }
  /// Its point nearest to the origin; must not be empty.
  Vector<3> nearest() const;
  bool empty() const { return farthest() == none; }
  /// A point of its inside: the mean of its vertices.
  Vector<3> middle() const;
  /// Whether the vertex is there still, at x.
  bool has(std::size_t vertex, const Vector<3>& x) const {
    return vertices_[vertex].alive && vertices_[vertex].x == x;
  }
  const Vertex& operator[](std::size_t i) const { return vertices_[i]; }
  std::size_t size() const { return vertices_.size(); }

 private:
  struct Edge {
    std::size_t from, leaves;  ///< a vertex, and the index of the plane that the edge leaves
  };

  /// The plane after the one that the edge leaves, or the second after it.
  int plane_of(const Edge& edge, std::size_t after) const {
    return vertices_[edge.from].planes[(edge.leaves + after) % 3];
  }
  bool find_patch(const Vector<3>& n, double b, std::size_t hint);
  bool order_edges();
  void add_fan(const Vector<3>& n, double b, int id);
  std::size_t add(const Vertex& vertex);
  void remove(std::size_t vertex);

  struct Plane {
    Vector<3> n = Vector<3>::Zero();
    double b{0};
  };

  static constexpr double passed_over = -1;
  double rounding_;
  std::vector<Plane> planes_;  ///< by id; n is 0 where none was kept
  std::vector<Vertex> vertices_;
  std::vector<double> squares_;  ///< of the vertices; passed_over, too, where not alive
  std::vector<std::size_t> free_, patch_, fan_;
  std::vector<char> in_patch_;
  std::vector<Edge> edges_;
};

}  // namespace poise
