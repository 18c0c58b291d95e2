// Domains of postures: cones of directions, and planes through what can be held. Not installed.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "poise/grasp.hpp"

namespace poise::search {

/// Postures at most an angle away from a direction.
struct TiltCone {
  Vector<3> axis;
  double most;

  /// By how much x is outside [rad].
  double excess(const Vector<3>& x) const {
    return std::atan2(axis.cross(x).norm(), axis.dot(x)) - most;
  }
  /// The unit vector across the axis towards x.
  Vector<3> across(const Vector<3>& x) const {
    const Vector<3> part = x - axis.dot(x) * axis;
    return part.norm() > 1e-12 * x.norm() ? Vector<3>(part.normalized())
                                          : Vector<3>(tangents(axis).col(0));
  }
  /// A plane n . x <= 0 of the cone: the one that touches it on x's side. Far behind x is cut
  /// deeper by the plane across the axis.
  Vector<3> plane(const Vector<3>& x) const {
    if (most >= std::numbers::pi / 2 || axis.dot(x) < -0.7 * x.norm()) return -axis;
    return std::cos(most) * across(x) - std::sin(most) * axis;
  }
  Vector<3> nearest(const Vector<3>& x) const {
    if (!(excess(x) > 0)) return x.normalized();
    return std::cos(most) * axis + std::sin(most) * across(x);
  }
};

struct Plane {
  Vector<3> n;  ///< of length 1
  double b;     ///< n . x = b
};

/// The point nearest to x on these planes, as the sum of what they fix and what they leave; x
/// itself where they have no more than a point in common.
struct OnPlanes {
  OnPlanes(const Vector<3>& x, const std::vector<Plane>& planes) : along(x) {
    std::vector<Plane> basis;
    for (Plane plane : planes) {
      for (const Plane& other : basis) {
        const double part = other.n.dot(plane.n);
        plane.n -= part * other.n;
        plane.b -= part * other.b;
      }
      const double left = plane.n.norm();
      if (left > 1e-4) basis.push_back({plane.n / left, plane.b / left});
    }
    if (basis.size() > 2) return;
    for (const Plane& plane : basis) {
      along -= plane.n.dot(along) * plane.n;
      fixed += plane.b * plane.n;
    }
  }
  Vector<3> load() const { return fixed + along; }
  /// The posture in this direction; `up` if there is none.
  Vector<3> posture(const Vector<3>& up) const {
    const double rest = 1 - fixed.squaredNorm();
    if (!(along.norm() > 1e-3) || !(rest > 0)) return up;
    return (fixed + std::sqrt(rest) * along.normalized()).normalized();
  }
  Vector<3> fixed = Vector<3>::Zero(), along;
};

/// Postures in which one contact may carry all: it is right under the com, or above it.
inline std::vector<Vector<3>> on_one_contact(const Grasp<3>& grasp) {
  constexpr double rounding = 1e-9;  // of the radius, and of the friction
  std::vector<Vector<3>> ups;
  for (const Load<3>& load : grasp.loads())
    for (const Contact<3>& contact : grasp.contacts()) {
      const Vector<3> arm = load.com - contact.position;
      const bool at_com = arm.norm() <= rounding * grasp.radius();
      const Vector<3> along = at_com ? contact.normal : Vector<3>(arm.normalized());
      const double normal = contact.normal.dot(along);
      const double tangential = (along - normal * contact.normal).norm();
      if (tangential <= contact.friction * std::abs(normal) + rounding)
        ups.push_back(normal > 0 ? along : -along);
    }
  return ups;
}

/// Postures in which fingers that no drive moves may carry all: then there is nothing to command.
inline std::vector<Vector<3>> on_fixed_fingers(const Grasp<3>& grasp) {
  std::vector<Vector<3>> ups;
  Vector<3> sum = Vector<3>::Zero();
  for (std::size_t i = 0; i < grasp.contacts().size(); ++i) {
    const auto& moved = grasp.driven().moved;
    if (std::any_of(moved.begin(), moved.end(),
                    [&](const auto& each) { return each.finger == grasp.finger_of(i); }))
      continue;
    const Vector<3>& normal = grasp.contacts()[i].normal;
    if (std::find(ups.begin(), ups.end(), normal) == ups.end()) ups.push_back(normal);
    sum += normal;
  }
  if (ups.size() > 1 && sum.norm() > 1e-3) ups.push_back(sum.normalized());
  return ups;
}

}  // namespace poise::search
