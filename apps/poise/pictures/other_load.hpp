// What acts on a held object besides its weight.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "poise/grasp.hpp"
#include "tables/table.hpp"

namespace poise {

/// Inertia, and what pushes: a force, or a moment alone.
template <int Dim>
struct OtherLoad {
  using Moment = Eigen::Matrix<double, wrench_size<Dim> - Dim, 1>;

  Vector<Dim> from;  ///< where its force acts, as near to the com as its line passes
  Vector<Dim> force;
  Moment moment;  ///< what is left about `from`: in the plane nothing, unless there is no force
  bool pushes, turns;

  /// Against the load of a grasp that decides, in the posture `up`.
  OtherLoad(const Grasp<Dim>& grasp, const Load<Dim>& load, const Vector<Dim>& up)
      : from(load.com) {
    const Twist<Dim> still = load.still();
    force = -still.template head<Dim>() - load.weight * load.lift / standard_gravity * up;
    const Vector<Dim> fixed = still.template head<Dim>();
    moment = -(still - wrench_of<Dim>(fixed, load.com)).template tail<Moment::SizeAtCompileTime>();
    pushes = !force.isZero(1e-9 * grasp.size());
    if (pushes) {
      const double square = force.squaredNorm();
      if constexpr (Dim == 2) {
        from += moment[0] / square * Vector<2>(force.y(), -force.x());
        moment.setZero();
      } else {
        from += force.cross(moment) / square;
        moment = (force.dot(moment) / square * force).eval();
      }
    }
    turns = moment.norm() > 1e-6 * grasp.size() * grasp.radius();
  }

  bool is_there() const { return pushes || turns; }
  /// "40 N", "0.5 N m", or both.
  std::vector<std::string> words() const {
    std::vector<std::string> lines;
    if (pushes) lines.push_back(newtons(force.norm()));
    if (turns) lines.push_back(plain(moment.norm()) + " N m");
    return lines;
  }
};

inline constexpr const char* other_load_title = "other load";

/// Points of the arrow of a moment: three quarters of a circle from `a` towards `b`, which are at
/// right angles to each other and as long as its radius.
template <int Dim>
std::vector<Vector<Dim>> round_arrow(const Vector<Dim>& middle, const Vector<Dim>& a,
                                     const Vector<Dim>& b) {
  constexpr int steps = 36;
  std::vector<Vector<Dim>> points;
  for (int k = 0; k <= steps; ++k) {
    const double angle = 4.71238898038469 * k / steps;
    points.push_back(middle + std::cos(angle) * a + std::sin(angle) * b);
  }
  return points;
}

}  // namespace poise
