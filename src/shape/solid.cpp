// Bodies in space.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "shape/mesh_shape.hpp"
#include "shape/shape.hpp"
#include "shape/sizes.hpp"

namespace poise {
namespace {

using std::numbers::pi;

// Up to here a point within the tolerance of one side is never within that of the opposite one.
constexpr double most_slender = 5000;

/// A flat or round part of a surface, seen from a point.
struct Part {
  std::string name;
  double distance;
  Vector<3> outward;
};

/// The nearest of the parts; where others are within the tolerance, too, an edge or a corner.
Boundary<3> nearest_of(const std::vector<Part>& parts, double size, const std::string& solid) {
  const Part& nearest =
      *std::min_element(parts.begin(), parts.end(),
                        [](const Part& a, const Part& b) { return a.distance < b.distance; });
  Boundary<3> result{nearest.distance, -nearest.outward};
  std::vector<std::string> names;
  for (const Part& part : parts)
    if (part.distance <= boundary_tolerance * size) names.push_back(part.name);
  if (names.size() < 2) return result;
  result.corner = (names.size() == 2 ? "on the edge between " : "at the corner between ");
  for (std::size_t i = 0; i < names.size(); ++i)
    result.corner += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  result.corner += " of the " + solid;
  return result;
}

/// How far a coordinate is outside of [-half, half].
double excess(double coordinate, double half) { return std::max(std::abs(coordinate) - half, 0.0); }

Boundary<3> boundary_of(const Box& box, const Vector<3>& point) {
  std::vector<Part> faces;
  for (int k = 0; k < 3; ++k)
    for (const double side : {1.0, -1.0}) {
      Vector<3> away;
      for (int j = 0; j < 3; ++j)
        away[j] = j == k ? point[j] - side * box.size[j] / 2 : excess(point[j], box.size[j] / 2);
      faces.push_back({std::string("face ") + (side > 0 ? '+' : '-') + "xyz"[k], away.stableNorm(),
                       side * Vector<3>::Unit(k)});
    }
  return nearest_of(faces, size(box), "box");
}

Boundary<3> boundary_of(const Cylinder& cylinder, const Vector<3>& point) {
  const double radius = cylinder.radius, half = cylinder.height / 2;
  const double off_axis = point.head<2>().stableNorm();
  Vector<3> outward = Vector<3>::UnitX();  // on the axis every direction is as good
  if (off_axis > 0) outward << point.head<2>().stableNormalized(), 0;
  std::vector<Part> parts{
      {"the side", std::hypot(off_axis - radius, excess(point.z(), half)), outward}};
  for (const double side : {1.0, -1.0})
    parts.push_back({side > 0 ? "the end +z" : "the end -z",
                     std::hypot(point.z() - side * half, excess(off_axis, radius)),
                     side * Vector<3>::UnitZ()});
  return nearest_of(parts, size(cylinder), "cylinder");
}

}  // namespace

void check(const Solid& solid) {
  std::visit(Overloaded{
                 [](const Box& box) { check_sizes<3>(box.size, "box.size", most_slender, "5000"); },
                 [](const Cylinder& cylinder) {
                   check_size(cylinder.radius, "cylinder.radius");
                   check_size(cylinder.height, "cylinder.height");
                   if (const double slender = cylinder.height / (2 * cylinder.radius);
                       slender > most_slender || slender < 1 / most_slender)
                     throw InvalidShape("cylinder", "has a height of " + number_text(slender) +
                                                        " diameters, must be from " +
                                                        number_text(1 / most_slender) + " to " +
                                                        number_text(most_slender));
                 },
                 [](const Sphere& sphere) { check_size(sphere.radius, "sphere.radius"); },
                 [](const Ellipsoid& ellipsoid) {
                   check_sizes<3>(ellipsoid.radii, "ellipsoid.radii", most_slender, "5000");
                 },
                 [](const MeshShape& /*checked when it was mended*/) {},
             },
             solid);
}

double volume(const Solid& solid) {
  return std::visit(
      Overloaded{
          [](const Box& box) { return box.size.prod(); },
          [](const Cylinder& c) { return pi * c.radius * c.radius * c.height; },
          [](const Sphere& sphere) { return 4 * pi / 3 * std::pow(sphere.radius, 3); },
          [](const Ellipsoid& ellipsoid) { return 4 * pi / 3 * ellipsoid.radii.prod(); },
          [](const MeshShape& shape) { return volume(*shape.mesh); },
      },
      solid);
}

Vector<3> centroid(const Solid& solid) {
  const auto* shape = std::get_if<MeshShape>(&solid);
  return shape ? centroid(*shape->mesh) : Vector<3>(Vector<3>::Zero());
}

Eigen::Matrix3d inertia(const Solid& solid) {
  // The integrals of x^2, y^2 and z^2 over the volume.
  const auto moments = Overloaded{
      [](const Box& box) -> Vector<3> { return box.size.cwiseAbs2() / 12; },
      [](const Cylinder& c) -> Vector<3> {
        return {c.radius * c.radius / 4, c.radius * c.radius / 4, c.height * c.height / 12};
      },
      [](const Sphere& sphere) -> Vector<3> {
        return Vector<3>::Constant(sphere.radius * sphere.radius / 5);
      },
      [](const Ellipsoid& ellipsoid) -> Vector<3> { return ellipsoid.radii.cwiseAbs2() / 5; },
      [](const MeshShape& /*below*/) -> Vector<3> { return Vector<3>::Zero(); },
  };
  Eigen::Matrix3d second = (volume(solid) * std::visit(moments, solid)).asDiagonal();
  if (const auto* shape = std::get_if<MeshShape>(&solid)) second = second_moments(*shape->mesh);
  return second.trace() * Eigen::Matrix3d::Identity() - second;
}

double size(const Solid& solid) {
  return std::visit(
      Overloaded{
          [](const Box& box) { return box.size.norm() / 2; },
          [](const Cylinder& cylinder) {
            return std::hypot(cylinder.radius, cylinder.radius, cylinder.height / 2);
          },
          [](const Sphere& sphere) { return sphere.radius; },
          [](const Ellipsoid& ellipsoid) { return ellipsoid.radii.maxCoeff(); },
          [](const MeshShape& shape) { return bounds(*shape.mesh).diagonal().norm() / 2; },
      },
      solid);
}

Eigen::AlignedBox3d bounds(const Solid& solid) {
  if (const auto* shape = std::get_if<MeshShape>(&solid)) return bounds(*shape->mesh);
  const Vector<3> half = std::visit(
      Overloaded{
          [](const Box& box) -> Vector<3> { return box.size / 2; },
          [](const Cylinder& cylinder) -> Vector<3> {
            return {cylinder.radius, cylinder.radius, cylinder.height / 2};
          },
          [](const Sphere& sphere) -> Vector<3> { return Vector<3>::Constant(sphere.radius); },
          [](const Ellipsoid& ellipsoid) { return ellipsoid.radii; },
          [](const MeshShape& /*above*/) -> Vector<3> { return Vector<3>::Zero(); },
      },
      solid);
  return {-half, half};
}

Boundary<3> boundary(const Solid& solid, const Vector<3>& point) {
  return std::visit(
      Overloaded{
          [&](const Box& box) { return boundary_of(box, point); },
          [&](const Cylinder& cylinder) { return boundary_of(cylinder, point); },
          [&](const Sphere& sphere) { return boundary_of_ball<3>(sphere.radius, point); },
          [&](const Ellipsoid& e) { return boundary_of_ellipsoid<3>(e.radii, point); },
          [&](const MeshShape& shape) {
            return boundary_of(shape, point, boundary_tolerance * size(solid));
          },
      },
      solid);
}

Vector<3> inward_normal(const Solid& solid, const Vector<3>& point) {
  return normal_at(boundary(solid, point), size(solid));
}

}  // namespace poise
