// What acts on the object in one case, and what the contacts must supply against it:
// docs/theory.md, "Loads".
#pragma once

#include <string>

#include "poise/wrench.hpp"

namespace poise {

/// Standard gravity g [m/s^2]: weight = mass * standard_gravity.
inline constexpr double standard_gravity = 9.80665;

/// A weight through a centre of mass, the accelerations of the object, and a fixed wrench.
template <int Dim>
struct Load {
  double weight{1};                       ///< W [N], >= 0
  Vector<Dim> com = Vector<Dim>::Zero();  ///< centre of mass [m], object frame
  /// What the contacts must supply besides, about the object frame's origin, whatever the posture
  /// [N, N m, object frame]. A tool that pushes the object with a force F asks for -F here.
  Wrench<Dim> fixed = Wrench<Dim>::Zero();
  double lift{0};  ///< acceleration of the object against gravity [m/s^2]
  /// Of the com, in a fixed direction of the object frame [m/s^2].
  Vector<Dim> acceleration = Vector<Dim>::Zero();
  std::string name{};  ///< what people call it

  /// The wrench that the contacts must supply in the posture `up` (unit vector, object frame),
  /// about the object frame's origin [N, N m]: B (turning() up) + still(), where B is that of a
  /// force at the com.
  Wrench<Dim> at(const Vector<Dim>& up) const;
  /// The force that turns with gravity, W (1 + lift / g) [N].
  double turning() const { return weight * (1 + lift / standard_gravity); }
  /// What does not turn with gravity: B (W acceleration / g) + fixed.
  Wrench<Dim> still() const;
  /// How large the load is [N]: |turning()| + |force| + |moment about the com| / length of still().
  /// Force caps and tolerances are parts of it.
  /// @param length  Hand::length() of who holds it [m]
  double size(double length) const;

  bool operator==(const Load&) const = default;  ///< field by field
};

/// The wrench of a force at a point, about the object frame's origin [N, N m].
template <int Dim>
Wrench<Dim> wrench_of(const Vector<Dim>& force, const Vector<Dim>& at);

}  // namespace poise
