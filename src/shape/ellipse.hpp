#pragma once

#include "shape/shape.hpp"

namespace poise {

/// The point of an ellipse's boundary nearest to a point.
Vector<2> nearest_point(const Ellipse& ellipse, const Vector<2>& point);

}  // namespace poise
