// How much a hold withstands besides the load: accelerations in any direction, and tilting; and the
// posture that withstands most.
// docs/theory.md, "Shake".
#pragma once

#include <optional>
#include <vector>

#include "poise/best_posture.hpp"
#include "poise/grip.hpp"

namespace poise {

/// What limits the forces, and how near both sides are to come.
struct ShakeSettings {
  double gap{1e-3};  ///< wanted: (bound - found) / found, > 0
  /// Force norms [sizes of the load] that count as held, where nothing else limits them. What is
  /// withstood up to a thousandth of it [g] is infinite.
  double force_cap{1e6};
  /// The greatest grip of the drives [grip_unit()], besides their own limits.
  std::optional<double> most_grip{};
  int max_holds{2000};  ///< holds to spend on each load; ten times as many on sturdiest_posture()
};

/// Proves that no more is withstood, by one half-space: for the load and every acceleration x of
/// its com that is held besides, with y about the object frame's origin,
///   y . (load.at(up) + W x / g through the com) <= sum of rates . max + what contacts can do,
/// equation (8) of docs/theory.md.
template <int Dim>
struct ShakeCut {
  std::size_t load{0};
  Twist<Dim> y = Twist<Dim>::Zero();
  SmallVector<double, 4> rates;  ///< of the drives, >= 0
};

/// The greatest acceleration that is withstood in every direction.
template <int Dim>
struct Shake {
  bool holdable{false};  ///< whether the posture itself is held
  /// Every acceleration of the com up to this is held [m/s^2]; the hull of `held` contains them. 0
  /// where the posture itself is not held, infinite where nothing limits it.
  double acceleration{0};
  double bound{0};  ///< one of this size is not [m/s^2], by `cut`; infinite where none was found
  /// In which that is, object frame: the acceleration that the object undergoes.
  Vector<Dim> direction = Vector<Dim>::Zero();
  ShakeCut<Dim> cut;
  /// For each load accelerations that are held besides [m/s^2]; empty where nothing is shaken.
  std::vector<std::vector<Vector<Dim>>> held;
  /// Whether both are as near as was wanted, or that the posture is not held is proven.
  bool proven{true};
  int holds{0};  ///< spent on it
};

/// How far a posture may be tilted, in any direction.
template <int Dim>
struct Tilting {
  bool holdable{false};  ///< whether the posture itself is held
  double angle{0};       ///< every posture up to this away from `up` is held [rad], 0 to pi
  double bound{0};       ///< one this far away is not [rad], by `cut`; pi where all are held
  Vector<Dim> up = Vector<Dim>::Zero();  ///< that one
  ShakeCut<Dim> cut;
  /// For each load vectors x in place of `up` that are held: their hull contains the postures.
  std::vector<std::vector<Vector<Dim>>> held;
  bool proven{true};  ///< as in Shake; or both are within 0.01 degrees
  int holds{0};       ///< spent on it
};

/// The posture that withstands the greatest acceleration in every direction.
template <int Dim>
struct Sturdiest {
  Status status{Status::unholdable};
  Vector<Dim> up = Vector<Dim>::Zero();  ///< unit vector, object frame; 0 where none was found
  /// In it: of each load, as if it were the only one.
  std::vector<Shake<Dim>> shakes;
  /// The least of theirs [m/s^2].
  double acceleration{0};
  /// No posture of the domain withstands more, by `cuts` [m/s^2]; infinite where nothing limits it,
  /// and 0 where none is held.
  double bound{0};
  std::vector<ShakeCut<Dim>> cuts;
  int holds{0};  ///< spent on it
};

/// The greatest r such that every acceleration of the com up to r, in any direction, is withstood
/// with up = `up` (unit vector, object frame), besides what the loads say already: within the
/// limits of contacts and drives, and the given grip. Of loads without weight none has an effect.
/// @throws InvalidGrasp for settings out of their ranges, or a given grip without grip_unit()
template <int Dim>
Shake<Dim> shake(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                 const ShakeSettings& settings = {});

/// The greatest angle such that every posture within it of `up` (unit vector, object frame) is
/// held.
/// @throws InvalidGrasp as shake()
template <int Dim>
Tilting<Dim> tilting(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                     const ShakeSettings& settings = {});

/// The posture of a domain, in space of all where there is no tilt, of which shake() is greatest,
/// with a bound on that of all others: docs/theory.md, "Shake". Where no other withstands more, by
/// a part of 1e-6, it is the present one (unit vector, object frame).
/// @throws InvalidGrasp as shake(), or for a tilt out of its range
Sturdiest<2> sturdiest_posture(const Grasp<2>& grasp, Domain domain = Domain::all,
                               const ShakeSettings& settings = {},
                               const Vector<2>& present = Vector<2>::UnitY());
Sturdiest<3> sturdiest_posture(const Grasp<3>& grasp, const std::optional<Tilt>& tilt = {},
                               const ShakeSettings& settings = {},
                               const Vector<3>& present = Vector<3>::UnitZ());

}  // namespace poise
