// A held object as it hangs: outline, friction cones, forces.
#pragma once

#include <optional>

#include "pictures/script.hpp"
#include "poise/best_posture.hpp"
#include "shape/shape.hpp"

namespace poise {

/// The held object, turned: its com at the origin, gravity along -y.
struct Scene {
  const Grasp<2>& grasp;
  double theta;
  const Hold<2>* hold;  ///< none where the object cannot be held
  /// Length of the force arrows [m/N]; otherwise the largest force is nearly half of the object.
  std::optional<double> scale{};
  std::size_t load{0};  ///< the one that is drawn

  Vector<2> com() const { return grasp.loads()[load].com; }
  Vector<2> turned(const Vector<2>& v) const {
    const double c = std::cos(theta), s = std::sin(theta);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
  }
  Vector<2> placed(const Vector<2>& point) const { return turned(point - com()); }
};

/// Adds a plot of the object with its cones, forces and, where two contacts slip, the meeting point
/// of their edges. `aspect` is the width of the plot over its height.
void draw_object(Script& script, const std::optional<Shape>& shape, const Scene& scene,
                 const Minimum<2>* posture, double aspect);

}  // namespace poise
