// Meshes of bodies whose volume and centroid are known.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

#include "shape/mesh.hpp"

namespace poise::test {

using Eigen::Vector3d;

/// Appends the triangles of another mesh.
inline Mesh together(Mesh a, const Mesh& b) {
  const int first = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles)
    a.triangles.push_back({first + i, first + j, first + k});
  return a;
}

inline Mesh moved(Mesh mesh, const Eigen::Affine3d& motion) {
  for (Vector3d& vertex : mesh.vertices) vertex = motion * vertex;
  return mesh;
}

inline Mesh inside_out(Mesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  return mesh;
}

/// Each triangle with three vertices of its own, as STL has them.
inline Mesh soup(const Mesh& mesh) {
  Mesh result;
  for (const auto& triangle : mesh.triangles) {
    const int first = static_cast<int>(result.vertices.size());
    for (const int i : triangle)
      result.vertices.push_back(mesh.vertices[static_cast<std::size_t>(i)]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

/// Edges from 0 to size along the axes.
inline Mesh box_mesh(const Vector3d& size) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(size.cwiseProduct(Vector3d(k & 1, (k >> 1) & 1, (k >> 2) & 1)));
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
        std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

/// A grid of points on a surface that closes in both directions, point(i, j) of rows x columns.
template <class Point>
Mesh ring_mesh(int rows, int columns, const Point& point) {
  Mesh mesh;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) mesh.vertices.push_back(point(i, j));
  const auto at = [&](int i, int j) { return (i % rows) * columns + j % columns; };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

inline double turn(int k, int of) { return 2 * std::acos(-1.0) * k / of; }

/// About the z axis: `big` from the axis to the middle of the tube, `small` its radius.
inline Mesh torus_mesh(double big, double small, int rows, int columns) {
  return ring_mesh(rows, columns, [&](int i, int j) {
    const double a = turn(i, rows), b = turn(j, columns), off = big + small * std::cos(b);
    return Vector3d(off * std::cos(a), off * std::sin(a), small * std::sin(b));
  });
}

/// A body of revolution about the z axis: points (r, z) from the lower end to the upper one, both
/// on the axis.
inline Mesh turned_mesh(const std::vector<Eigen::Vector2d>& profile, int sides) {
  Mesh mesh;
  mesh.vertices.emplace_back(0, 0, profile.front().y());
  for (std::size_t i = 1; i + 1 < profile.size(); ++i)
    for (int j = 0; j < sides; ++j)
      mesh.vertices.emplace_back(profile[i].x() * std::cos(turn(j, sides)),
                                 profile[i].x() * std::sin(turn(j, sides)), profile[i].y());
  mesh.vertices.emplace_back(0, 0, profile.back().y());
  const int rings = static_cast<int>(profile.size()) - 2, top = rings * sides + 1;
  const auto at = [&](int i, int j) { return 1 + i * sides + j % sides; };
  for (int j = 0; j < sides; ++j) {
    mesh.triangles.push_back({0, at(0, j + 1), at(0, j)});
    mesh.triangles.push_back({top, at(rings - 1, j), at(rings - 1, j + 1)});
    for (int i = 0; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

/// Its axis along z, centred at the origin.
inline Mesh cylinder_mesh(double radius, double height, int sides) {
  return turned_mesh(
      {{0, -height / 2}, {radius, -height / 2}, {radius, height / 2}, {0, height / 2}}, sides);
}

inline Mesh sphere_mesh(double radius, int rows, int sides) {
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= rows; ++i) {
    const double angle = turn(i, 2 * rows);
    profile.emplace_back(radius * std::sin(angle), -radius * std::cos(angle));
  }
  return turned_mesh(profile, sides);
}

/// As a Wavefront OBJ file, each number with all its digits.
inline void write_obj(const Mesh& mesh, const std::string& path) {
  std::ofstream out(path);
  out.precision(17);
  for (const Vector3d& v : mesh.vertices)
    out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const auto& [i, j, k] : mesh.triangles)
    out << "f " << i + 1 << ' ' << j + 1 << ' ' << k + 1 << '\n';
}

/// Its bytes as text, as glTF has them.
inline std::string base64(const std::string& bytes) {
  const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace poise::test
