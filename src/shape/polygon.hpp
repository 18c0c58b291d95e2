#pragma once

#include "shape/shape.hpp"

namespace poise {

/// Throws InvalidShape unless the polygon is simple.
void check_simple(const Polygon& polygon);

/// The area is positive where the vertices run counter-clockwise.
struct AreaAndCentroid {
  double signed_area{0};
  Vector<2> centroid = Vector<2>::Zero();
};
AreaAndCentroid area_and_centroid(const Polygon& polygon);

/// Half the diagonal of the bounding box.
double half_diagonal(const Polygon& polygon);

Boundary<2> boundary_of(const Polygon& polygon, const Vector<2>& point);

}  // namespace poise
