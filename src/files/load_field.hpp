// The object's weight and the loads of a grasp file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/field.hpp"
#include "poise/load.hpp"
#include "shape/shape.hpp"

namespace poise {

/// The loads of a file: those of its list `loads`, or the object's weight alone. An acceleration in
/// any direction becomes one load for each vertex of a polytope around the ball.
/// @param unit  the length unit [m]
template <int Dim>
std::vector<Load<Dim>> read_loads(const Field& root, const Field& object, double unit,
                                  const std::optional<ShapeOf<Dim>>& shape);

/// Where the loads of a file are written, one for each: "loads[1]", or "object".
template <int Dim>
std::vector<std::string> load_paths(const Field& root);

}  // namespace poise
