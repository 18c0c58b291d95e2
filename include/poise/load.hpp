// What acts on the object in one case, and what the contacts must supply against it.
#pragma once

#include "poise/wrench.hpp"

namespace poise {

/// Standard gravity [m/s^2]: weight = mass * standard_gravity.
inline constexpr double standard_gravity = 9.80665;

/// A weight through a centre of mass, and a fixed wrench.
template <int Dim>
struct Load {
  double weight{1};                       ///< W [N], > 0
  Vector<Dim> com = Vector<Dim>::Zero();  ///< centre of mass [m], object frame
  /// The part of the wrench that does not turn with gravity [N, N m], about the object frame's
  /// origin: what the contacts must supply beside the weight.
  Wrench<Dim> fixed = Wrench<Dim>::Zero();

  /// The wrench that the contacts must supply in the posture `up` (unit vector, object frame),
  /// about the object frame's origin [N, N m]: w = W (up, com x up) + fixed.
  Wrench<Dim> at(const Vector<Dim>& up) const;

  bool operator==(const Load&) const = default;  ///< field by field
};

}  // namespace poise
