#pragma once

#include "poise/wrench.hpp"

namespace poise {

/// The point nearest to a point on the ellipse or ellipsoid with these semi-axes along the axes.
template <int Dim>
Vector<Dim> nearest_point(const Vector<Dim>& radii, const Vector<Dim>& point);

}  // namespace poise
