// The shape of an object: where it ends, and which way is in.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "poise/wrench.hpp"
#include "shape/mesh.hpp"

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

/// An outline in the plane.
using Shape = std::variant<Disk, Ellipse, Polygon>;

/// Centred at the object frame's origin, its edges along the axes.
struct Box {
  Vector<3> size = Vector<3>::Ones();  ///< lengths of its edges along x, y and z [m]
};

/// Centred at the object frame's origin, its axis along z.
struct Cylinder {
  double radius{1}, height{1};  ///< [m]
};

/// Centred at the object frame's origin.
struct Sphere {
  double radius{1};  ///< [m]
};

/// Centred at the object frame's origin, its axes along x, y and z.
struct Ellipsoid {
  Vector<3> radii = Vector<3>::Ones();  ///< semi-axes along x, y and z [m]
};

/// A body bounded by a mesh that was read from a file.
struct MeshShape {
  std::shared_ptr<const Mesh> mesh{};  ///< [m], in the object frame
  std::string defect{};                ///< why it has no volume and no inside; empty where it has
  std::string file{};
  double scale{1};  ///< of the mesh in the file: metres for one of its units
};

/// A body in space.
using Solid = std::variant<Box, Cylinder, Sphere, Ellipsoid, MeshShape>;

template <int Dim>
using ShapeOf = std::conditional_t<Dim == 2, Shape, Solid>;

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

/// Throws InvalidShape unless every size is finite and above 0 and none is out of all proportion,
/// and a polygon is simple: its edges have a length and meet only where one ends and the next
/// begins. The functions below want such a shape.
void check(const Shape& shape);
void check(const Solid& solid);

double area(const Shape& shape);    ///< [m^2]
double volume(const Solid& solid);  ///< [m^3]; of a mesh, one without defect
Vector<2> centroid(const Shape& shape);
Vector<3> centroid(const Solid& solid);  ///< of a mesh, one without defect

/// About the centroid, of a density of 1 kg/m^3 [m^5]; of a mesh, one without defect.
Eigen::Matrix3d inertia(const Solid& solid);

/// The scale of a shape [m]: its larger radius, or half the diagonal of its bounding box.
double size(const Shape& shape);
double size(const Solid& solid);

/// The bounding box [m].
Eigen::AlignedBox2d bounds(const Shape& shape);
Eigen::AlignedBox3d bounds(const Solid& solid);

/// A point counts as on the boundary within this part of the shape's size.
inline constexpr double boundary_tolerance = 1e-4;

/// The boundary as seen from a point.
template <int Dim>
struct Boundary {
  double distance{0};                        ///< to its nearest point [m]
  Vector<Dim> normal = Vector<Dim>::Zero();  ///< inward unit normal there
  /// Where parts of the boundary with different normals are all within the tolerance, so that there
  /// is no single normal: which they are, in words ("at the corner between edges 0 and 1 of ...").
  std::string corner{};
};
Boundary<2> boundary(const Shape& shape, const Vector<2>& point);
Boundary<3> boundary(const Solid& solid, const Vector<3>& point);

/// The inward unit normal at a point on the boundary.
/// @throws NoNormal for a point off the boundary, or at a corner or an edge.
Vector<2> inward_normal(const Shape& shape, const Vector<2>& point);
Vector<3> inward_normal(const Solid& solid, const Vector<3>& point);

/// The boundary as a closed line for drawing, without repeating the first point: a polygon's
/// vertices, or `points` points of a curve.
std::vector<Vector<2>> outline(const Shape& shape, std::size_t points = 180);

}  // namespace poise
