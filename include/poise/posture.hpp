// The posture of an object: how it is turned against gravity, and how it is held there.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "poise/hold.hpp"

namespace poise {

/// The planar posture `up` = (sin theta, cos theta): the direction against gravity in the object
/// frame, when the object is turned counter-clockwise by theta [rad] (the paper's theta).
inline Vector<2> up_at(double theta) { return {std::sin(theta), std::cos(theta)}; }

/// The theta [rad], in (-pi, pi], of a planar posture.
inline double angle_of(const Vector<2>& up) {
  const double theta = std::atan2(up.x(), up.y());
  return theta > -std::numbers::pi ? theta : std::numbers::pi;  // atan2(-1e-17, -1) is -pi
}

/// An interval of planar postures [rad]: from <= to <= from + 2 pi, from in [-pi, pi).
/// The whole circle is [-pi, pi]; a single posture has from == to.
struct Interval {
  double from{0}, to{0};
};

/// The postures in which a centre of mass lies in the fork of the fingers: outside the hull of
/// the contact points (by more than 1e-9 L), and straight above some point of it. An open interval
/// of less than 180 degrees, by geometry alone; from == to where there is none. The other postures
/// are the paper's range of pinching up.
Interval fork_wedge(const Hand<2>& hand, const Vector<2>& com);

/// How the object is held, by its forces: the first that applies.
enum class Manner {
  resting,  ///< one finger carries everything
  cradled,  ///< it would be held without any friction
  pinched,  ///< friction carries
};
/// The name of the value: "pinched".
const char* to_string(Manner manner);

/// How the object is held in the posture `up` by these forces against this load. Where more than
/// one finger presses, it looks for a hold without friction.
template <int Dim>
Manner manner(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
              const Hold<Dim>& hold);

/// A posture with the holds of all loads.
template <int Dim>
struct Posture {
  Vector<Dim> up = Vector<Dim>::Zero();  ///< unit vector against gravity, object frame
  std::vector<Hold<Dim>> holds;          ///< one for each load
  /// Index of the load that decides: the first that cannot be held, else the one that needs most.
  std::size_t decides{0};
  Manner manner{Manner::resting};  ///< against the load that decides; resting where unholdable

  /// The hold of the load that decides.
  const Hold<Dim>& hold() const { return holds[decides]; }
  /// Whether all loads are held.
  bool holdable() const { return hold().holdable; }
  /// V or F of the hold that decides; infinite where unholdable.
  double value() const {
    return holdable() ? hold().value() : std::numeric_limits<double>::infinity();
  }
  /// V of the hold that decides [N^2]; infinite where unholdable.
  double effort() const {
    return holdable() ? hold().effort : std::numeric_limits<double>::infinity();
  }
};

/// The least forces in the posture `up` (unit vector, object frame) against each of the loads.
template <int Dim>
Posture<Dim> posture_at(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                        const HoldSettings& settings = {});

/// A posture of which the holds are known, one for each load.
template <int Dim>
Posture<Dim> posture_of(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                        std::vector<Hold<Dim>> holds);

}  // namespace poise
