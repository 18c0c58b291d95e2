#include "shape/mesh_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace poise {
namespace {

const double least_cosine = std::cos(std::numbers::pi / 180);  // of what is one side

/// The distance from a point to a segment.
double to_segment(const Vector<3>& point, const Vector<3>& a, const Vector<3>& b) {
  const Vector<3> side = b - a;
  const double length = side.squaredNorm();
  const double along = length > 0 ? std::clamp((point - a).dot(side) / length, 0.0, 1.0) : 0;
  return (point - a - along * side).norm();
}

/// The distance from a point to a triangle.
double to_triangle(const Vector<3>& point, const Vector<3>& a, const Vector<3>& b,
                   const Vector<3>& c) {
  const Vector<3> normal = (b - a).cross(c - a);
  const auto inside = [&](const Vector<3>& from, const Vector<3>& to) {
    return (to - from).cross(point - from).dot(normal) >= 0;
  };
  if (normal.squaredNorm() > 0 && inside(a, b) && inside(b, c) && inside(c, a))
    return std::abs((point - a).dot(normal)) / normal.norm();
  return std::min({to_segment(point, a, b), to_segment(point, b, c), to_segment(point, c, a)});
}

}  // namespace

Boundary<3> boundary_of(const MeshShape& shape, const Vector<3>& point, double tolerance) {
  struct Near {
    std::size_t triangle;
    double distance;
    Vector<3> outward;
  };
  std::vector<Near> near;  // within the tolerance, or the nearest of all
  double least = std::numeric_limits<double>::infinity();
  const Mesh& mesh = *shape.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    const Vector<3>&a = mesh.vertices[static_cast<std::size_t>(i)],
          &b = mesh.vertices[static_cast<std::size_t>(j)],
          &c = mesh.vertices[static_cast<std::size_t>(k)];
    // Most triangles are farther away than their box says.
    const double reach = std::max(least, tolerance);
    const Vector<3> low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    if ((low - point).cwiseMax(point - high).maxCoeff() > reach) continue;
    const Vector<3> outward = (b - a).cross(c - a).stableNormalized();
    if (!(outward.norm() > 0.5)) continue;  // a line: its neighbours have its sides
    const double distance = to_triangle(point, a, b, c);
    if (distance > reach) continue;
    least = std::min(least, distance);
    near.push_back({t, distance, outward});
  }
  if (near.empty()) return {std::numeric_limits<double>::quiet_NaN()};  // of a point that is none
  const Near& nearest =
      *std::min_element(near.begin(), near.end(),
                        [](const Near& a, const Near& b) { return a.distance < b.distance; });
  Boundary<3> result{nearest.distance, -nearest.outward};
  if (!shape.defect.empty()) {
    result.corner = "on a mesh that is not closed, so that no side is in";
    return result;
  }
  for (const Near& other : near)
    if (other.distance <= tolerance && other.outward.dot(nearest.outward) < least_cosine) {
      result.corner = "on the edge between triangles " +
                      std::to_string(std::min(nearest.triangle, other.triangle)) + " and " +
                      std::to_string(std::max(nearest.triangle, other.triangle)) + " of the mesh";
      return result;
    }
  return result;
}

}  // namespace poise
