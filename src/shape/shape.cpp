#include "shape/shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape/number_text.hpp"
#include "shape/polygon.hpp"
#include "shape/sizes.hpp"

namespace poise {
namespace {

using std::numbers::pi;

}  // namespace

void check(const Shape& shape) {
  std::visit(Overloaded{
                 [](const Disk& disk) { check_size(disk.radius, "disk.radius"); },
                 [](const Ellipse& ellipse) {
                   check_sizes<2>(ellipse.radii, "ellipse.radii", 1e6, "1e6");
                 },
                 [](const Polygon& polygon) { check_simple(polygon); },
             },
             shape);
}

double area(const Shape& shape) {
  return std::visit(
      Overloaded{
          [](const Disk& disk) { return pi * disk.radius * disk.radius; },
          [](const Ellipse& ellipse) { return pi * ellipse.radii.prod(); },
          [](const Polygon& polygon) { return std::abs(area_and_centroid(polygon).signed_area); },
      },
      shape);
}

Vector<2> centroid(const Shape& shape) {
  const auto* polygon = std::get_if<Polygon>(&shape);
  return polygon ? area_and_centroid(*polygon).centroid : Vector<2>::Zero();
}

double size(const Shape& shape) {
  return std::visit(Overloaded{
                        [](const Disk& disk) { return disk.radius; },
                        [](const Ellipse& ellipse) { return ellipse.radii.maxCoeff(); },
                        [](const Polygon& polygon) { return half_diagonal(polygon); },
                    },
                    shape);
}

Eigen::AlignedBox2d bounds(const Shape& shape) {
  Eigen::AlignedBox2d box;
  for (const Vector<2>& point : outline(shape)) box.extend(point);
  return box;
}

Boundary<2> boundary(const Shape& shape, const Vector<2>& point) {
  return std::visit(
      Overloaded{
          [&](const Disk& disk) { return boundary_of_ball<2>(disk.radius, point); },
          [&](const Ellipse& ellipse) { return boundary_of_ellipsoid<2>(ellipse.radii, point); },
          [&](const Polygon& polygon) { return boundary_of(polygon, point); },
      },
      shape);
}

Vector<2> inward_normal(const Shape& shape, const Vector<2>& point) {
  return normal_at(boundary(shape, point), size(shape));
}

std::vector<Vector<2>> outline(const Shape& shape, std::size_t points) {
  if (const auto* polygon = std::get_if<Polygon>(&shape)) return polygon->vertices;
  const auto* disk = std::get_if<Disk>(&shape);
  const Vector<2> radii =
      disk ? Vector<2>::Constant(disk->radius).eval() : std::get<Ellipse>(shape).radii;
  std::vector<Vector<2>> line(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(points);
    line[i] = radii.cwiseProduct(Vector<2>(std::cos(angle), std::sin(angle)));
  }
  return line;
}

}  // namespace poise
