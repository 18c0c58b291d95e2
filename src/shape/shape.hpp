// The outline of an object in the plane: where it ends, and which way is in.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "poise/object.hpp"

namespace poise {

/// Centred at the object frame's origin.
struct Disk {
  double radius{1};  ///< [m]
};

/// Centred at the object frame's origin, its axes along x and y.
struct Ellipse {
  Vector<2> radii = Vector<2>::Ones();  ///< semi-axes along x and y [m]
};

/// Edge i leads from vertex i to vertex i + 1, the last one back to vertex 0.
struct Polygon {
  std::vector<Vector<2>> vertices;  ///< [m], in either orientation, not repeating the first
};

using Shape = std::variant<Disk, Ellipse, Polygon>;

/// A shape that has no meaning: which field is wrong, and what would be right.
class InvalidShape : public std::invalid_argument {
 public:
  InvalidShape(const std::string& path, const std::string& problem)
      : std::invalid_argument(path + ": " + problem), path_(path), problem_(problem) {}
  const std::string& path() const noexcept { return path_; }        ///< "disk.radius"
  const std::string& problem() const noexcept { return problem_; }  ///< "is -1, must be above 0"

 private:
  std::string path_, problem_;
};

/// A point at which a shape has no single inward normal; what() says why.
class NoNormal : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Throws InvalidShape unless every size is finite and above 0, and a polygon is simple: its edges
/// have a length and meet only where one ends and the next begins. The functions below want such a
/// shape.
void check(const Shape& shape);

double area(const Shape& shape);  ///< [m^2]
Vector<2> centroid(const Shape& shape);

/// The scale of a shape [m]: its larger radius, or half the diagonal of its bounding box.
double size(const Shape& shape);

/// A point counts as on the boundary within this part of the shape's size.
inline constexpr double boundary_tolerance = 1e-4;

/// The boundary as seen from a point.
struct Boundary {
  double distance{0};                    ///< to its nearest point [m]
  Vector<2> normal = Vector<2>::Zero();  ///< inward unit normal there
  /// Two edges of a polygon that are both within the tolerance, with normals more than one degree
  /// apart: there is a corner, and no single normal.
  std::optional<std::pair<std::size_t, std::size_t>> corner{};
};
Boundary boundary(const Shape& shape, const Vector<2>& point);

/// The inward unit normal at a point on the boundary.
/// @throws NoNormal for a point off the boundary, or at a corner.
Vector<2> inward_normal(const Shape& shape, const Vector<2>& point);

/// The boundary as a closed line for drawing, without repeating the first point: a polygon's
/// vertices, or `points` points of a curve.
std::vector<Vector<2>> outline(const Shape& shape, std::size_t points = 180);

}  // namespace poise
