#pragma once

#include "shape/shape.hpp"

namespace poise {

/// Triangles within the tolerance whose normals differ by more than a degree are a corner.
Boundary<3> boundary_of(const MeshShape& shape, const Vector<3>& point, double tolerance);

}  // namespace poise
