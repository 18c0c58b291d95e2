#include "shape/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/ellipse.hpp"
#include "shape/number_text.hpp"
#include "shape/polygon.hpp"

namespace poise {
namespace {

constexpr double pi = 3.14159265358979323846;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

void check_size(double value, const std::string& path) {
  if (!(value > 0)) throw InvalidShape(path, "is " + number_text(value) + ", must be above 0");
  if (!std::isnormal(value * value))
    throw InvalidShape(path, "is " + number_text(value) + ", too " +
                                 (value < 1 ? "small" : "large") + " to compute with");
}

}  // namespace

void check(const Shape& shape) {
  std::visit(Overloaded{
                 [](const Disk& disk) { check_size(disk.radius, "disk.radius"); },
                 [](const Ellipse& ellipse) {
                   const Vector<2>& r = ellipse.radii;
                   for (int k = 0; k < 2; ++k)
                     check_size(r[k], "ellipse.radii[" + std::to_string(k) + "]");
                   if (r.maxCoeff() > 1e6 * r.minCoeff())
                     throw InvalidShape("ellipse.radii",
                                        "are " + number_text(r[0]) + " and " + number_text(r[1]) +
                                            ", one must be at most 1e6 times the other");
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

Boundary boundary(const Shape& shape, const Vector<2>& point) {
  return std::visit(
      Overloaded{
          [&](const Disk& disk) {
            const double distance = point.stableNorm();
            // At the centre every direction is as good.
            const Vector<2> outward =
                distance > 0 ? point.stableNormalized() : Vector<2>(Vector<2>::UnitX());
            return Boundary{std::abs(distance - disk.radius), -outward};
          },
          [&](const Ellipse& ellipse) {
            const Vector<2> nearest = nearest_point(ellipse, point);
            const Vector<2> outward = nearest.cwiseQuotient(ellipse.radii)
                                          .cwiseQuotient(ellipse.radii / ellipse.radii.maxCoeff());
            return Boundary{(point - nearest).stableNorm(), -outward.stableNormalized()};
          },
          [&](const Polygon& polygon) { return boundary_of(polygon, point); },
      },
      shape);
}

Vector<2> inward_normal(const Shape& shape, const Vector<2>& point) {
  const Boundary b = boundary(shape, point);
  const double tolerance = boundary_tolerance * size(shape);
  if (!(b.distance <= tolerance))
    throw NoNormal("is " + number_text(b.distance, 3) +
                   " m from the boundary of the shape, must be within " +
                   number_text(tolerance, 3) + " m of it, or give the normal");
  if (b.corner)
    throw NoNormal("is at the corner between edges " + std::to_string(b.corner->first) + " and " +
                   std::to_string(b.corner->second) + " of the polygon, give the normal");
  return b.normal;
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
