// A closed surface of triangles: its volume, its centroid, and what can be mended in one.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

namespace poise {

/// A closed surface of triangles, their corners counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// By the divergence theorem, a sum of tetrahedra from one point: negative for a mesh that is
/// inside out. Of a mesh that is not closed it means nothing.
double volume(const Mesh& mesh);

/// The same, of a mesh that has a volume.
Eigen::Vector3d centroid(const Mesh& mesh);

/// The integral of r r^T over it, r from its centroid [m^5]; of a mesh that has a volume.
Eigen::Matrix3d second_moments(const Mesh& mesh);

Eigen::AlignedBox3d bounds(const Mesh& mesh);

/// A mesh as files have them, made a closed surface where that is safe.
struct MendedMesh {
  Mesh mesh;
  std::vector<std::string>
      repairs{};  ///< what was done, each a line in words: "was inside out ..."
  /// Why it bounds no volume, in words: "is not closed: ..."; empty where it does. Then `mesh` is
  /// the surface as it was given, with equal vertices made one.
  std::string defect{};
};

/// Makes vertices one that are equal, or within up to 1e-5 of the size of the mesh where that
/// closes it; of triangles that stand twice keeps one, or none where that closes it; turns
/// triangles so that neighbours agree, and each part so that its volume is positive. Parts must not
/// overlap: their bounding boxes do not. What a surface that crosses itself encloses twice counts
/// twice; that is said where a look beneath up to 64 of its triangles shows it.
MendedMesh mended(const Mesh& mesh);

}  // namespace poise
