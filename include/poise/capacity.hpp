// What a gripper can hold in one posture: the greatest weight, the least friction. docs/theory.md,
// "What a gripper can hold".
#pragma once

#include <vector>

#include "poise/posture.hpp"

namespace poise {

/// One end of the weights that can be held in a posture: found from both sides.
template <int Dim>
struct WeightEnd {
  double weight{0};      ///< can be held, in `posture` [N]
  double bound{0};       ///< no weight beyond this can be held, by `dual` [N]
  Posture<Dim> posture;  ///< with the hold of `weight` alone
  /// A twist y about the object frame's origin. For every weight that is held with a force norm of
  /// at most force_cap weights
  ///   weight (y . w(1 N) - force_cap |P(z)|) <= sum of rates . max + greatest z . f of contacts
  /// with max_normal, where z is y against the fingers that move with the rates, and P(z) what
  /// contacts without max_normal can do against it. Zero where there is no bound.
  Twist<Dim> dual = Twist<Dim>::Zero();
  SmallVector<double, 4> rates;  ///< of the drives, >= 0, where any has a max: equation (8)
};

/// What a contact has to do with the greatest weight, in every hold of it.
struct Deciding {
  /// How many newtons more can be held at most for each newton more of max_normal; 0 where the
  /// contact does not have to press as hard as it may.
  double per_newton{0};
  bool slipping{false};  ///< uses all its friction, if it presses at all
};

/// All weights that can be held in a posture: an interval, since forces that hold two weights mix.
/// A load's accelerations go with its weight; its fixed wrench stays as it is.
template <int Dim>
struct WeightRange {
  bool holdable{false};  ///< whether there are any
  /// Whether weights and bounds are the same but for a part of 1e-5, or that there are none is
  /// proven. Within rounding of the limit of holding more may be held than was found.
  bool proven{true};
  WeightEnd<Dim> least;  ///< above 0 only where contacts have a min_normal
  /// Infinite where contacts without max_normal can hold any weight and drives with a max have
  /// nothing to do for it: then its hold is of the given weight, by these alone. Also where the
  /// weight is nothing since it falls freely: then its hold is of the load as it is.
  WeightEnd<Dim> greatest;
  /// Of each contact, read off the proof of the greatest weight; empty where that is infinite or
  /// nothing can be held.
  std::vector<Deciding> deciding;
  /// Of each drive: how many newtons more can be held at most for each newton, or newton metre,
  /// more of its max; 0 where it does not have to give all of it. Empty as `deciding`.
  std::vector<double> deciding_drives;
};

/// The weights that can be held through the load's com with up = `up` (unit vector, object frame),
/// whatever the load's own; weight and bound differ by a part of 1e-7, or by what rounding leaves
/// open.
template <int Dim>
WeightRange<Dim> weight_range(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                              const HoldSettings& settings = {});

/// Which contacts decide, read off any (y, rates) that prove an end of the weights.
template <int Dim>
std::vector<Deciding> deciding(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                               const Twist<Dim>& dual, const SmallVector<double, 4>& rates,
                               const HoldSettings& settings = {});
/// And which drives.
template <int Dim>
std::vector<double> deciding_drives(const Hand<Dim>& hand, const Load<Dim>& load,
                                    const Vector<Dim>& up, const Twist<Dim>& dual,
                                    const SmallVector<double, 4>& rates,
                                    const HoldSettings& settings = {});

/// The least common factor on all frictions and torsions with which the weight is still held.
/// 1 / factor is the greatest safety.
template <int Dim>
struct LeastFriction {
  /// The weight is held with it, in `posture`. Infinite where even a million times the friction is
  /// too little.
  double factor{0};
  double bound{0};       ///< with less it is not, by `dual`
  bool proven{true};     ///< whether both are the same but for a part of 1e-5
  Posture<Dim> posture;  ///< with `factor` times the friction
  /// As in WeightEnd, with the load's weight and `bound` times its friction.
  Twist<Dim> dual = Twist<Dim>::Zero();
  SmallVector<double, 4> rates;  ///< of the drives, >= 0, where any has a max
};

/// The least friction for the load with up = `up` (unit vector, object frame). Factor and bound
/// differ by a part of 1e-7, or by what rounding leaves open.
template <int Dim>
LeastFriction<Dim> least_friction(const Hand<Dim>& hand, const Load<Dim>& load,
                                  const Vector<Dim>& up, const HoldSettings& settings = {});

/// What people ask about a gripper in one posture.
template <int Dim>
struct Capacity {
  WeightRange<Dim> weights;
  LeastFriction<Dim> friction;
  /// With all frictions and torsions divided by the safety: the hold of least grip, which is what
  /// to command; its grip may be above most_grip(). Of a hand without a grip that of least effort.
  Posture<Dim> safe;
};

/// The greatest weight, the least friction, and the grip to command, with up = `up` (unit vector,
/// object frame).
/// @param safety  at least 1, on top of the one that the hand was made with
template <int Dim>
Capacity<Dim> capacity(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                       double safety, const HoldSettings& settings = {});

}  // namespace poise
