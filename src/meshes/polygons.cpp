#include "meshes/polygons.hpp"

#include <limits>
#include <span>
#include <string>

#include "meshes/formats.hpp"

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

[[noreturn]] void refuse_size() {
  throw ReadError("has more than " + std::to_string(most_triangles) +
                  " triangles or vertices, the most that is read");
}

/// Twice the signed area of a triangle.
double area(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Cuts faces into triangles.
class Cutter {
 public:
  explicit Cutter(Mesh& mesh) : mesh_(mesh) {}

  void cut(std::span<const int> face) {
    if (face.size() == 3 || !project(face) || is_fan())
      fan(face);
    else
      cut_ears(face);
  }

 private:
  const Vector3d& vertex(int index) const {
    return mesh_.vertices[static_cast<std::size_t>(index)];
  }

  void add(std::span<const int> face, std::size_t a, std::size_t b, std::size_t c) {
    mesh_.triangles.push_back({face[a], face[b], face[c]});
  }

  void fan(std::span<const int> face) {
    for (std::size_t k = 2; k < face.size(); ++k) add(face, 0, k - 1, k);
  }

  /// Its corners in the plane, counter-clockwise; false where it has no area.
  bool project(std::span<const int> face) {
    Vector3d normal = Vector3d::Zero();  // Newell
    const Vector3d& origin = vertex(face[0]);
    for (std::size_t k = 2; k < face.size(); ++k)
      normal += (vertex(face[k - 1]) - origin).cross(vertex(face[k]) - origin);
    Eigen::Index axis = 0;
    if (!(normal.cwiseAbs().maxCoeff(&axis) > 0)) return false;
    Eigen::Index x = (axis + 1) % 3, y = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(x, y);
    points_.clear();
    for (const int corner : face) {
      const Vector3d from = vertex(corner) - origin;
      points_.emplace_back(from[x], from[y]);
    }
    return true;
  }

  bool is_fan() const {
    for (std::size_t k = 2; k < points_.size(); ++k)
      if (area(points_[0], points_[k - 1], points_[k]) < 0) return false;
    return true;
  }

  /// One ear after the other (Meisters 1975): a corner is one if the triangle that it makes with
  /// its neighbours has no other corner in it.
  void cut_ears(std::span<const int> face) {
    const std::size_t count = face.size();
    before_.resize(count);
    after_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      before_[k] = k == 0 ? count - 1 : k - 1;
      after_[k] = k + 1 == count ? 0 : k + 1;
    }
    std::size_t at = 0, left = count, passed = 0;
    while (left > 3) {
      // Where no corner is an ear the face crosses itself, and any will do.
      if (passed < left && !is_ear(at)) {
        ++passed;
        at = after_[at];
        continue;
      }
      add(face, before_[at], at, after_[at]);
      after_[before_[at]] = after_[at];
      before_[after_[at]] = before_[at];
      at = before_[at];
      --left;
      passed = 0;
    }
    add(face, before_[at], at, after_[at]);
  }

  bool is_ear(std::size_t at) {
    const Vector2d &a = points_[before_[at]], &b = points_[at], &c = points_[after_[at]];
    const double size = area(a, b, c);
    if (size <= 0) return size == 0;
    for (std::size_t k = after_[after_[at]]; k != before_[at]; k = after_[k]) {
      if (++looked_ > most_looks)
        throw ReadError(
            "has faces that are not convex with too many corners: cut them into triangles");
      const Vector2d& p = points_[k];
      if (p == a || p == b || p == c) continue;
      if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
  }

  static constexpr std::size_t most_looks = 200'000'000;  // in all faces: a second or two

  Mesh& mesh_;
  std::vector<Vector2d> points_{};
  std::vector<std::size_t> before_{}, after_{};
  std::size_t looked_{0};
};

}  // namespace

void Polygons::add_vertex(const Vector3d& vertex) {
  if (vertices_.size() == most_triangles) refuse_size();
  vertices_.push_back(vertex);
}

void Polygons::add_corner(long long vertex) {
  if (vertex < 0 || vertex > std::numeric_limits<int>::max())
    throw ReadError("has a face that names a vertex that is not there");
  if (corners_.size() == 3 * most_triangles) refuse_size();
  corners_.push_back(static_cast<int>(vertex));
}

void Polygons::end_face() {
  const std::size_t begin = ends_.empty() ? 0 : ends_.back();
  if (corners_.size() - begin < 3)
    corners_.resize(begin);
  else
    ends_.push_back(corners_.size());
}

void Polygons::end_strip() {
  const std::size_t begin = ends_.empty() ? 0 : ends_.back();
  const std::vector<int> strip(corners_.begin() + static_cast<std::ptrdiff_t>(begin),
                               corners_.end());
  corners_.resize(begin);
  for (std::size_t k = 2; k < strip.size(); ++k) {
    add_corner(strip[k - (k % 2 == 0 ? 2 : 1)]);
    add_corner(strip[k - (k % 2 == 0 ? 1 : 2)]);
    add_corner(strip[k]);
    end_face();
  }
}

Mesh Polygons::triangles() && {
  Mesh mesh{std::move(vertices_), {}};
  for (const int corner : corners_)
    if (static_cast<std::size_t>(corner) >= mesh.vertices.size())
      throw ReadError("has a face that names a vertex that is not there");
  if (corners_.size() - 2 * ends_.size() > most_triangles) refuse_size();
  Cutter cutter(mesh);
  std::size_t begin = 0;
  for (const std::size_t end : ends_) {
    cutter.cut(std::span(corners_).subspan(begin, end - begin));
    begin = end;
  }
  return mesh;
}

}  // namespace poise
