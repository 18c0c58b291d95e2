// The posture of an object: how it is turned against gravity.
#pragma once

#include <cmath>

#include "poise/grasp.hpp"

namespace poise {

/// The planar posture `up` = (sin theta, cos theta): the direction against gravity in the object
/// frame, when the object is turned counter-clockwise by theta [rad] (the paper's theta).
inline Vector<2> up_at(double theta) { return {std::sin(theta), std::cos(theta)}; }

/// The theta [rad], in (-pi, pi], of a planar posture.
inline double angle_of(const Vector<2>& up) { return std::atan2(up.x(), up.y()); }

/// Postures to choose from: all of them, or those where the object is not cradled.
enum class Domain { all, pinched };

/// An interval of planar postures [rad]: from <= to <= from + 2 pi, from in [-pi, pi).
/// The whole circle is [-pi, pi]; a single posture has from == to.
struct Interval {
  double from{0}, to{0};
};

/// The postures in which the centre of mass lies in the fork of the fingers: outside the hull of
/// the contact points (by more than 1e-9 L), and straight above some point of it. An open interval
/// of less than 180 degrees, by geometry alone; from == to where nothing is cradled.
Interval cradled_wedge(const Grasp<2>& grasp);

/// Whether in the posture `up` the centre of mass lies in the fork of the fingers: outside the hull
/// of the contact points (by more than 1e-9 L), and straight above some point of it, not only just.
bool cradled(const Grasp<3>& grasp, const Vector<3>& up);

/// How the object is held.
enum class Manner {
  resting,  ///< a finger carries nothing, or there is only one finger
  cradled,  ///< the centre of mass lies in the fork of the fingers
  pinched,  ///< neither: the fingers hold it by friction
};
/// The name of the value: "pinched".
const char* to_string(Manner manner);

}  // namespace poise
