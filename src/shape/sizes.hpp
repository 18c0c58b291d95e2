// What shapes in the plane and in space have in common.
#pragma once

#include <cmath>
#include <string>

#include "shape/ellipse.hpp"
#include "shape/number_text.hpp"
#include "shape/shape.hpp"

namespace poise {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

inline void check_size(double value, const std::string& path) {
  if (!(value > 0)) throw InvalidShape(path, "is " + number_text(value) + ", must be above 0");
  if (!std::isnormal(value * value))
    throw InvalidShape(path, "is " + number_text(value) + ", too " +
                                 (value < 1 ? "small" : "large") + " to compute with");
}

/// The largest must be at most `most` times the smallest; in words `most_text`.
template <int Dim>
void check_sizes(const Vector<Dim>& sizes, const std::string& path, double most,
                 const std::string& most_text) {
  std::string list;
  for (int k = 0; k < Dim; ++k) {
    check_size(sizes[k], path + "[" + std::to_string(k) + "]");
    list += (k == 0 ? "" : k + 1 < Dim ? ", " : " and ") + number_text(sizes[k]);
  }
  if (sizes.maxCoeff() > most * sizes.minCoeff())
    throw InvalidShape(path,
                       "are " + list + ", one must be at most " + most_text + " times the other");
}

/// Of a disk or a sphere.
template <int Dim>
Boundary<Dim> boundary_of_ball(double radius, const Vector<Dim>& point) {
  const double distance = point.stableNorm();
  // At the centre every direction is as good.
  const Vector<Dim> outward =
      distance > 0 ? Vector<Dim>(point.stableNormalized()) : Vector<Dim>(Vector<Dim>::UnitX());
  return {std::abs(distance - radius), -outward};
}

/// Of an ellipse or an ellipsoid.
template <int Dim>
Boundary<Dim> boundary_of_ellipsoid(const Vector<Dim>& radii, const Vector<Dim>& point) {
  const Vector<Dim> nearest = nearest_point<Dim>(radii, point);
  const Vector<Dim> outward = nearest.cwiseQuotient(radii).cwiseQuotient(radii / radii.maxCoeff());
  return {(point - nearest).stableNorm(), -outward.stableNormalized()};
}

/// @throws NoNormal
template <int Dim>
Vector<Dim> normal_at(const Boundary<Dim>& boundary, double size) {
  const double tolerance = boundary_tolerance * size;
  if (!(boundary.distance <= tolerance))
    throw NoNormal("is " + number_text(boundary.distance, 3) +
                   " m from the boundary of the shape, must be within " +
                   number_text(tolerance, 3) + " m of it, or give the normal");
  if (!boundary.corner.empty()) throw NoNormal("is " + boundary.corner + ", give the normal");
  return boundary.normal;
}

}  // namespace poise
