// How hard the fingers must press while the object moves: docs/theory.md, "Motion".
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "poise/hold.hpp"

namespace poise {

/// A rigid body that is held.
struct Body {
  double mass{1};                                     ///< [kg], > 0
  Vector<3> com = Vector<3>::Zero();                  ///< centre of mass [m], object frame
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the com, object frame [kg m^2]
};

/// Why no body has this inertia (about its com [kg m^2]), in words; empty where one has. It must be
/// symmetric, its principal moments at least 0 and none above the sum of the others.
std::string inertia_problem(const Eigen::Matrix3d& inertia);

/// How the object frame moves at one time, seen from the world, whose +z is up.
struct MotionState {
  double time{0};                          ///< [s]
  Vector<3> position = Vector<3>::Zero();  ///< of the frame's origin [m]
  /// Object to world, of length 1.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vector<3> acceleration = Vector<3>::Zero();          ///< of the frame's origin [m/s^2]
  Vector<3> angular_velocity = Vector<3>::Zero();      ///< [rad/s], in the world frame
  Vector<3> angular_acceleration = Vector<3>::Zero();  ///< [rad/s^2], in the world frame
};

/// Poses of the object frame in the world at times.
struct Trajectory {
  std::vector<double> times;                     ///< rising [s]
  std::vector<Vector<3>> positions;              ///< of the frame's origin [m]
  std::vector<Eigen::Quaterniond> orientations;  ///< object to world; made of length 1
  std::vector<Vector<3>> accelerations{};        ///< of the frame's origin; empty: not known
};

/// The motion through all poses. Positions and the components of the quaternions (of q and -q the
/// one nearer to that before) follow cubic splines, twice continuously differentiable, with the
/// third derivative continuous at the second and the last but one pose ("not a knot"); orientations
/// are the normalised quaternions. Accelerations that are given are taken instead. Of one pose: at
/// rest.
/// @throws InvalidGrasp where times do not rise, a number is not finite, or lists differ in length
std::vector<MotionState> motion_through(const Trajectory& trajectory);

/// The terms of what the contacts must supply.
enum class LoadTerm {
  weight,       ///< against gravity
  linear,       ///< acceleration of the frame's origin
  angular,      ///< angular acceleration
  centripetal,  ///< what turning takes at a steady rate: centripetal forces, gyroscopic moments
};
/// The name of the value: "linear".
const char* to_string(LoadTerm term);

/// What the contacts must supply while a body moves, about the object frame's origin [N, N m].
struct MotionLoad {
  std::array<Wrench<3>, 4> terms;  ///< in the order of LoadTerm

  /// What gravity asks for.
  const Wrench<3>& weight() const { return terms[0]; }
  /// What the motion asks for.
  Wrench<3> dynamic() const { return terms[1] + terms[2] + terms[3]; }
  /// Of a motion `speed` times as fast: weight + speed^2 dynamic.
  Wrench<3> at(double speed = 1) const { return weight() + speed * speed * dynamic(); }
};

/// @throws InvalidGrasp where a mass is not above 0, or a number is not finite
MotionLoad motion_load(const Body& body, const MotionState& state);

/// What is asked of a motion.
struct MotionSettings {
  Objective objective{Objective::grip};  ///< what the forces are to be least in
  double force_cap{1e6};  ///< [weights of the body]: greater force norms do not count as a hold
};

/// What the fingers need at one time.
struct MotionNeed {
  bool held{false};   ///< within the limits of contacts and drives
  bool proven{true};  ///< that it is not
  /// The least V [N^2] or F, where drives have no max; infinite where no forces balance the load.
  double value{std::numeric_limits<double>::infinity()};
  double lower_bound{0};  ///< on it, by the dual of the hold
};

/// What the fingers need over a motion.
struct MotionAnswer {
  std::vector<MotionNeed> needs;    ///< of each state
  std::optional<std::size_t> slip;  ///< the first state that is not held
  std::size_t peak{0};              ///< the state that needs most
  Hold<3> hold;                     ///< there
  /// The value there without each term of the load, in the order of LoadTerm.
  std::array<double, 4> without{};
  /// The term without which the least is needed there; none where leaving out none helps.
  std::optional<LoadTerm> cause;
};

/// Each state is held by forces of its own, found from those before.
/// @throws InvalidGrasp where there is no state; as least_grip(), for objective grip
MotionAnswer motion(const Hand<3>& hand, const Body& body, const std::vector<MotionState>& states,
                    const MotionSettings& settings = {});

/// How many times as fast a motion may run.
struct SpeedLimit {
  bool holdable{false};  ///< whether it is held at any speed
  double factor{0};      ///< every state is held so many times as fast
  /// No factor above this holds `state`, by `dual` and `rates`: the proof is as in WeightEnd, of
  /// weight + s dynamic instead of a weight. Infinite where most_speed is held.
  double bound{std::numeric_limits<double>::infinity()};
  std::size_t state{0};  ///< the one that decides
  Twist<3> dual = Twist<3>::Zero();
  SmallVector<double, 4> rates;  ///< of the drives, >= 0; empty: 0
};
/// How much faster speed_limit() looks.
inline constexpr double most_speed = 1000;

/// The greatest factor on the speed with which every state is held: loads are affine in its square,
/// so what is held of each is an interval. Factor and bound differ by a part of 1e-6, or by what
/// rounding leaves open. Not holdable: some state is not held at all, or none of the speeds that
/// hold it is slow enough for all others.
/// @throws InvalidGrasp where there is no state
SpeedLimit speed_limit(const Hand<3>& hand, const Body& body,
                       const std::vector<MotionState>& states, const MotionSettings& settings = {});

}  // namespace poise
