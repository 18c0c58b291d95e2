// What Poise answers: complete, so that who writes, draws or checks it solves nothing.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "poise/best_posture.hpp"
#include "poise/capacity.hpp"
#include "poise/shake.hpp"
#include "poise/turn.hpp"

namespace poise {

/// How the grasp is understood.
template <int Dim>
struct CheckAnswer {
  bool force_closure{false};
  Interval fork{};  ///< in the plane, fork_wedge()
};

/// The posture that was asked for, as it was given, an angle in (-180, 180]; nothing where the
/// file's was taken.
struct PostureOption {
  std::optional<double> angle_deg{};  ///< in the plane
  std::vector<double> up{};
};

template <int Dim>
struct HoldAnswer {
  PostureOption option;
  HoldSettings settings;
  Posture<Dim> posture;
  /// theta in the plane [rad], where it is known better than from posture.up.
  std::optional<double> angle{};
};

/// What a turn takes.
template <int Dim>
struct TurnTaken;
template <>
struct TurnTaken<2> {
  TurnPeak<2> straight;                ///< the shorter way round
  std::optional<TurnPeak<2>> other{};  ///< the other one, where it stays in the domain
};
template <>
struct TurnTaken<3> {
  Turn turn;  ///< the straight one
  TurnPeak<3> straight;
  std::optional<Way> way{};  ///< that of least peak, where both ends are held
};

/// A turn to a posture that was asked for.
template <int Dim>
struct TurnAnswer;
template <>
struct TurnAnswer<2> {
  PostureOption option;
  CurveSettings settings;
  Posture<2> now, then;
  TurnTaken<2> taken;
};
template <>
struct TurnAnswer<3> {
  PostureOption option;
  TurnSettings settings;
  Eigen::Quaterniond orientation{Eigen::Quaterniond::Identity()};  ///< the present one
  Posture<3> now, then;
  TurnTaken<3> taken;
};

template <int Dim>
struct BestAnswer;
template <>
struct BestAnswer<2> {
  CurveSettings settings;
  Best<2> best;
  std::optional<Posture<2>> now{};     ///< as it is held now, where the file says so
  std::optional<TurnTaken<2>> turn{};  ///< from the present posture, or upright, to the best
  std::optional<Reachable<2>> within_reach{};  ///< where the best is not, without pressing harder
  /// Where nothing in the domain holds: a posture of it, to show why.
  std::optional<Posture<2>> unholdable{};
  std::optional<Posture<2>>
      without_max{};  ///< then the best, where max_normal or a drive's max forbids it
};
template <>
struct BestAnswer<3> {
  SpatialSettings settings;
  Best<3> best;
  std::optional<Posture<3>> now{};     ///< as it is held now, where somebody said so
  std::optional<TurnTaken<3>> turn{};  ///< from the present posture, or upright, to the best
  std::optional<Reachable<3>> within_reach{};  ///< where the best is not, without pressing harder
  std::optional<Posture<3>> unholdable{};  ///< where proven: a posture of the domain, to show why
  std::optional<Posture<3>>
      without_max{};  ///< then the best, where max_normal or a drive's max forbids it
  Eigen::Quaterniond orientation{Eigen::Quaterniond::Identity()};  ///< the present one
};

struct CurveAnswer {
  CurveSettings settings;
  PostureCurve curve;
  std::vector<Minimum<2>> optima;          ///< one for each of the curve's, maxima too
  std::optional<Posture<2>> unholdable{};  ///< where nothing holds: a posture, to show why
};

/// What a gripper can hold in a posture, against one load.
template <int Dim>
struct CapacityAt {
  std::string posture{};  ///< which one: given, now, best or upright
  Vector<Dim> up;
  std::size_t load{0};
  Capacity<Dim> capacity;
  Shake<Dim> shake;
  Tilting<Dim> tilting;
};

template <int Dim>
struct CapacityAnswer {
  PostureOption option;
  double force_cap{1e6}, safety{1.5};
  std::optional<double> grip{};  ///< that shake and tilting are within [grip_unit()]
  std::vector<CapacityAt<Dim>> capacities;
};

/// The posture that withstands most.
template <int Dim>
struct SturdyAnswer {
  ShakeSettings settings;
  Domain domain{};             ///< in the plane
  std::optional<Tilt> tilt{};  ///< in space
  Sturdiest<Dim> found;
  Eigen::Quaterniond orientation{Eigen::Quaterniond::Identity()};  ///< in space, the present one
  Vector<Dim> now_up = Vector<Dim>::Zero();
  std::optional<Shake<Dim>> now{};  ///< as it is held now, where somebody said so
};

template <int Dim>
struct AnswerTo;
template <>
struct AnswerTo<2> {
  std::variant<CheckAnswer<2>, HoldAnswer<2>, BestAnswer<2>, TurnAnswer<2>, CurveAnswer,
               CapacityAnswer<2>, SturdyAnswer<2>>
      of;
};
template <>
struct AnswerTo<3> {
  std::variant<CheckAnswer<3>, HoldAnswer<3>, BestAnswer<3>, TurnAnswer<3>, CapacityAnswer<3>,
               SturdyAnswer<3>>
      of;
};

}  // namespace poise
