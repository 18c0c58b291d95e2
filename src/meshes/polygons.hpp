// Faces of any number of corners.
#pragma once

#include <cstddef>
#include <vector>

#include "shape/mesh.hpp"

namespace poise {

/// Vertices and faces in the order of a file, which may name vertices before they come.
class Polygons {
 public:
  /// @throws ReadError where there are too many
  void add_vertex(const Eigen::Vector3d& vertex);
  /// The next corner of the face that is being read: the index of a vertex, from 0.
  /// @throws ReadError where there are too many
  void add_corner(long long vertex);
  /// Ends the face; one of fewer than three corners bounds nothing and is left out.
  void end_face();
  /// Ends a strip: of its corners each three that follow each other are a triangle, every other
  /// one the other way round.
  void end_strip();

  std::size_t vertices() const { return vertices_.size(); }

  /// The faces cut into triangles that face the same way.
  /// @throws ReadError where a corner is no vertex
  Mesh triangles() &&;

 private:
  std::vector<Eigen::Vector3d> vertices_{};
  std::vector<int> corners_{};       ///< of all faces, one after the other
  std::vector<std::size_t> ends_{};  ///< of each in `corners`
};

}  // namespace poise
