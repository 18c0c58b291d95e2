// What a gripper can hold in one posture: the greatest weight, the least friction. docs/theory.md,
// "What a gripper can hold".
#pragma once

#include <vector>

#include "poise/hold.hpp"

namespace poise {

/// One end of the weights that can be held in a posture: found from both sides.
template <int Dim>
struct WeightEnd {
  double weight{0};  ///< can be held, by `hold` [N]
  double bound{0};   ///< no weight beyond this can be held, by `dual` [N]
  Hold<Dim> hold;
  /// A twist y about the object frame's origin. For every weight that is held with a force norm of
  /// at most force_cap weights
  ///   weight (y . w(1 N) - force_cap |P(y)|) <= greatest y . G f of contacts with max_normal,
  /// where P(y) is what contacts without max_normal can do against y. Zero where there is no bound.
  Twist<Dim> dual = Twist<Dim>::Zero();
};

/// All weights that can be held in a posture: an interval, since forces that hold two weights mix.
template <int Dim>
struct WeightRange {
  bool holdable{false};     ///< whether there are any
  WeightEnd<Dim> least;     ///< above 0 only where contacts have a min_normal
  WeightEnd<Dim> greatest;  ///< infinite where contacts without max_normal can hold any weight:
                            ///< then `hold` is of the grasp's own weight, by these alone
};

/// The weights that can be held with up = `up` (unit vector, object frame), whatever the grasp's
/// own; weight and bound differ by a part of 1e-7, or by what rounding leaves open.
template <int Dim>
WeightRange<Dim> weight_range(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                              const HoldSettings& settings = {});

/// What a contact has to do with an end, in every hold at that end.
struct Deciding {
  /// How many newtons more can be held at most for each newton more of max_normal; 0 where the
  /// contact does not have to press as hard as it may.
  double per_newton{0};
  bool slipping{false};  ///< uses all its friction, if it presses at all
};

/// Of each contact, read off the proof of an end.
template <int Dim>
std::vector<Deciding> deciding(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                               const Twist<Dim>& dual, const HoldSettings& settings = {});

/// The least common factor on all frictions and torsions with which the weight is still held.
/// 1 / factor is the greatest safety.
template <int Dim>
struct LeastFriction {
  /// The weight is held with it, by `hold`. Infinite where even a million times the friction is too
  /// little.
  double factor{0};
  double bound{0};  ///< with less it is not, by `dual`
  Hold<Dim> hold;
  /// As in WeightEnd, with the grasp's weight and `bound` times its friction.
  Twist<Dim> dual = Twist<Dim>::Zero();
};

/// The least friction for the grasp's weight with up = `up` (unit vector, object frame). Factor and
/// bound differ by a part of 1e-7, or by what rounding leaves open.
template <int Dim>
LeastFriction<Dim> least_friction(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                                  const HoldSettings& settings = {});

/// What people ask about a gripper in one posture.
template <int Dim>
struct Capacity {
  WeightRange<Dim> weights;
  LeastFriction<Dim> friction;
  Hold<Dim> safe;  ///< of the grasp's weight, with all frictions and torsions divided by the safety
};

/// The greatest weight, the least friction, and the forces to command, with up = `up` (unit vector,
/// object frame).
/// @param safety  at least 1, on top of the one that the grasp was made with
template <int Dim>
Capacity<Dim> capacity(const Grasp<Dim>& grasp, const Vector<Dim>& up, double safety,
                       const HoldSettings& settings = {});

/// The same contacts on an object of another weight [N].
template <int Dim>
Grasp<Dim> with_weight(const Grasp<Dim>& grasp, double weight);
/// The same grasp with all frictions and torsions multiplied by a factor >= 0.
template <int Dim>
Grasp<Dim> with_friction(const Grasp<Dim>& grasp, double factor);
/// The contacts without max_normal alone, the others made to press with nothing, none with a
/// min_normal: what these can hold once they can hold at any size.
template <int Dim>
Grasp<Dim> without_limits(const Grasp<Dim>& grasp);

}  // namespace poise
