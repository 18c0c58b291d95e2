// How a hand turns the object from one posture to another, and what that takes on the way:
// docs/theory.md, "The turn".
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "poise/best_posture.hpp"

namespace poise {

/// The smallest rotation, in the world frame, that takes an object from its orientation (object to
/// world) to one in which `up` (unit vector, object frame) points along the world's +z. w >= 0.
/// Where `up` points straight down now, the axis is the world's x.
Eigen::Quaterniond smallest_turn(const Eigen::Quaterniond& orientation, const Vector<3>& up);

/// Where the rotation of a hand leads, in the world frame, whose +z is up.
struct Turn {
  Eigen::Quaterniond rotation;     ///< w >= 0
  Eigen::Quaterniond orientation;  ///< that results, object to world; w >= 0
  double angle;                    ///< of the rotation [rad], 0 to pi
  Vector<3> axis;                  ///< unit vector
};

/// The smallest turn from an orientation (object to world) to the posture `up`.
Turn turn_to(const Eigen::Quaterniond& orientation, const Vector<3>& up);

/// An orientation (object to world) in which `up` is up. Which one is not told by `up`: the one
/// nearest to the world frame.
Eigen::Quaterniond orientation_of(const Vector<3>& up);

/// Postures of a turn in which the object cannot be held, and one of them, to show why.
template <int Dim>
struct UnholdableStretch {
  double from{0}, to{0};  ///< [rad] from the start of the turn
  double at{0};           ///< of `posture`
  Posture<Dim> posture;
};

/// The most that the fingers need on a turn, between two bounds.
template <int Dim>
struct TurnPeak {
  double angle{0};        ///< of the whole turn [rad]; in the plane counter-clockwise positive
  double peak{0};         ///< V [N^2] or F: no posture needs more; infinite where one is unholdable
  double lower_bound{0};  ///< one posture needs at least so much
  double at{0};           ///< where [rad] from the start, like `angle`
  Posture<Dim> posture;   ///< there
  std::vector<UnholdableStretch<Dim>> unholdable;  ///< in their order
};

/// The peak of a planar turn from the posture `from` [rad] by `angle` [rad], counter-clockwise
/// positive and at most a whole turn: read off the posture curve, exactly. The domain of the
/// settings does not matter.
/// @throws InvalidGrasp as posture_curve(), and where `angle` is out of its range
TurnPeak<2> turn_peak(const Grasp<2>& grasp, double from, double angle,
                      const CurveSettings& settings = {});

/// The two ways round from a planar posture to another [rad], the one of the lower peak first; of
/// ties the shorter, then that counter-clockwise. Where both postures lie in the domain, a way that
/// leaves it is left out. Empty where they are the same.
/// @throws InvalidGrasp as posture_curve()
std::vector<TurnPeak<2>> ways_round(const Grasp<2>& grasp, double from, double to,
                                    const CurveSettings& settings = {});

/// What to enclose in space, and how closely.
struct TurnSettings {
  Objective objective{Objective::effort};  ///< of which the peak is
  double gap{1e-3};                        ///< wanted: (peak - lower_bound) / peak, > 0 and < 1
  int max_holds{5000};                     ///< holds to spend, >= 1
  double force_cap{1e6};                   ///< in weights of the heaviest load
  std::optional<Tilt> tilt{};              ///< where ways stay, if they start and end there
};

/// The peak of the straight turn, the smallest from the orientation `from` (object to world) to the
/// posture `to` (unit vector, object frame): that of smallest_turn(). The tilt does not matter.
/// @throws InvalidGrasp for settings out of their ranges, or where `to` is no unit vector
TurnPeak<3> turn_peak(const Grasp<3>& grasp, const Eigen::Quaterniond& from, const Vector<3>& to,
                      const TurnSettings& settings = {});
/// The same from the orientation_of() a posture.
TurnPeak<3> turn_peak(const Grasp<3>& grasp, const Vector<3>& from, const Vector<3>& to,
                      const TurnSettings& settings = {});

/// A part of a wall: on the great circle from `up` to the next part's (after the last comes the
/// first) `cut` proves that every posture needs at least what the wall does, or is outside of the
/// domain.
struct WallPart {
  Vector<3> up;  ///< unit vector, object frame
  Cut cut;
};

/// A turn through postures, each step the smallest turn, and the proof that no other takes less.
struct Way {
  /// optimal: the peak is within the wanted gap. unholdable: proven that there is no way.
  Status status{Status::gap};
  /// V [N^2] or F: no posture of the way needs more; infinite where no way was found.
  double peak{std::numeric_limits<double>::infinity()};
  double lower_bound{0};       ///< no way in the domain has a lower peak
  std::vector<Vector<3>> ups;  ///< from the start to the end; empty where no way was found
  /// A closed curve that separates start from end. Empty where the start or the end themselves need
  /// lower_bound.
  std::vector<WallPart> wall;
  int holds{0};  ///< spent on it
};

/// The way of least peak from a posture to another (unit vectors, object frame).
/// @throws InvalidGrasp for settings out of their ranges, or where `from` or `to` is no unit vector
Way least_peak_way(const Grasp<3>& grasp, const Vector<3>& from, const Vector<3>& to,
                   const TurnSettings& settings = {});

/// The best posture among those that can be reached without ever needing more than now.
template <int Dim>
struct Reachable;
template <>
struct Reachable<2> {
  Posture<2> posture;
  double angle{0};  ///< how far to turn there [rad], counter-clockwise positive
  /// How far the connected stretch of postures goes that need no more than now, clockwise (at most
  /// 0) and counter-clockwise [rad]; a whole turn where there is no end.
  double least_angle{0}, most_angle{0};
};
template <>
struct Reachable<3> {
  Posture<3> posture;
  double lower_bound{0};  ///< V [N^2] or F: no posture that can be reached needs less
  /// To it, by which at most 1 / (1 - gap) of what is needed now is needed. optimal: the posture is
  /// within the wanted gap of the bound.
  Way way;
};

/// Of the connected postures around `from` [rad] that need no more than it, and lie in the domain
/// if it does, the one that needs least; of ties the least turn. `from` must be holdable.
/// @throws InvalidGrasp as posture_curve(), and where `from` cannot be held
Reachable<2> best_reachable(const Grasp<2>& grasp, double from, const CurveSettings& settings = {});

/// The same in space. `towards` (unit vector, object frame): the best posture of all, where to look
/// first.
/// @throws InvalidGrasp as least_peak_way(), and where `from` cannot be held
Reachable<3> best_reachable(const Grasp<3>& grasp, const Vector<3>& from, const Vector<3>& towards,
                            const TurnSettings& settings = {});

}  // namespace poise
