// Triangles that cover the sphere of postures, finer where it matters. Not installed.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "turn/values.hpp"

namespace poise::turns {

struct Triangle {
  std::array<int, 3> corners;     ///< counter-clockwise, seen from outside
  std::array<int, 3> neighbours;  ///< each across from the corner of the same index
  double least{0};                ///< no posture of it has a lower p, as its corners prove
};

/// The triangles and their corners, with the values there.
class Mesh {
 public:
  /// A double pyramid over the great circle through two different postures. The first corner is
  /// `a`, the second `b`.
  Mesh(Values& values, const Vector<3>& a, const Vector<3>& b);

  const std::vector<Valued>& corners() const { return corners_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Valued& corner(int k) const { return corners_[static_cast<std::size_t>(k)]; }
  const Triangle& triangle(int k) const { return triangles_[static_cast<std::size_t>(k)]; }

  /// Cuts a triangle in two across its longest edge, and neighbours as far as that asks for.
  void bisect(int triangle);
  /// No posture of an edge has a higher p.
  double most_on(int a, int b);
  /// No posture of the edges of a triangle has a higher p.
  double most_around(int triangle);
  /// The triangles at each corner.
  std::vector<std::vector<int>> stars() const;
  /// The half-space of a corner that proves the most of a triangle.
  const HalfSpace& strongest(int triangle) const;
  /// The edge across from corner k of a triangle is too short to be halved.
  bool is_finest(int triangle) const;

 private:
  int add_corner(const Vector<3>& up);
  int longest_edge(const Triangle& triangle) const;
  void split(int t, int across);
  void update_least(int triangle);

  Values& values_;
  std::vector<Valued> corners_;
  std::vector<Triangle> triangles_;
  std::map<std::pair<int, int>, double> most_on_edge_;
};

}  // namespace poise::turns
