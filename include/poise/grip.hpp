// The least grip: the number to command. docs/theory.md, "The least grip".
#pragma once

#include <vector>

#include "poise/hold.hpp"

namespace poise {

/// In what a grip is told.
enum class GripUnit {
  newton,        ///< all drives push, with the same max or without one
  newton_metre,  ///< all drives turn, with the same max or without one
  part_of_max,   ///< the greatest part of `max` that any drive uses
};
/// The unit's symbol: "N", "N m", "of max".
const char* to_string(GripUnit unit);

/// Whether a hand has a grip: every finger that a drive closes has a closing direction, and the
/// drives can be compared.
template <int Dim>
bool has_grip(const Hand<Dim>& hand);

/// In what the grip of a hand is told.
/// @throws InvalidGrasp where drives are of different kinds, or of different max, and one has none;
///         or a finger that a drive closes has no closing direction
template <int Dim>
GripUnit grip_unit(const Hand<Dim>& hand);
/// The greatest grip that the drives give, in its unit; infinite where nothing limits it.
template <int Dim>
double most_grip(const Hand<Dim>& hand);

/// What a drive does.
struct DriveEffort {
  double effort{0};       ///< the power of the fingers' forces per unit of speed [N, or N m]
  double part_of_max{0};  ///< 0 without max
};

/// What the drives do, in the order of hand.drives(), with the forces of a hold. Empty where
/// unholdable.
template <int Dim>
std::vector<DriveEffort> drive_efforts(const Hand<Dim>& hand, const Hold<Dim>& hold);

/// The grip F of the forces of a hold: the greatest effort of its drives, in grip_unit(); at least
/// 0. docs/theory.md, "The least grip".
template <int Dim>
double grip(const Hand<Dim>& hand, const Hold<Dim>& hold);

/// What (y, rates) prove of the grip [grip_unit()], with y about the object frame's origin
/// [1, 1/m] and the rates of the drives, >= 0, sum 1: F >= y . load - what contacts can do against
/// them. Equation (10) of docs/theory.md.
/// @param force_norm  of the forces that are looked at [N]: what rounding may make out
template <int Dim>
double grip_bound(const Hand<Dim>& hand, const Wrench<Dim>& load, const Twist<Dim>& y,
                  const SmallVector<double, 4>& rates, double force_norm);

/// The hold of least grip, and of least effort among those, against a wrench about the object
/// frame's origin [N, N m]. The limits of contacts count, those of the drives do not: where the
/// grip is above most_grip(), they cannot hold it. `dual` and `rates` of the hold prove
/// lower_bound, on the grip.
/// @param weight  the unit of the force cap and of the balance tolerance [N], > 0
/// @throws InvalidGrasp as grip_unit(), or where a number is not finite
template <int Dim>
Hold<Dim> least_grip(const Hand<Dim>& hand, const Wrench<Dim>& load, double weight,
                     const HoldSettings& settings = {});

/// The same against a load in the posture `up` (unit vector against gravity, object frame).
template <int Dim>
Hold<Dim> least_grip(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                     const HoldSettings& settings = {});

/// The same against the load that needs most.
template <int Dim>
Hold<Dim> least_grip(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                     const HoldSettings& settings = {});

}  // namespace poise
