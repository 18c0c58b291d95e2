// From a maximised dual to a hold in newtons: what hold.cpp (the plane) and hold_space.cpp share.
// Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "dual/dual.hpp"
#include "dual/exact.hpp"
#include "dual/twist.hpp"
#include "hold/cone_hand.hpp"
#include "poise/hold.hpp"

namespace poise {

inline constexpr double at_limit = 1e-9;  // of the weight, and of the friction

/// The friction used and the state of one lane of contacts, without a branch: which of them are
/// loaded is hard to foresee.
struct LaneStates {
  Lane friction_used;
  decltype(Lane{} < Lane{}) state;

  /// `normal` in newtons, `share` the part of the friction that is used, or 0 / 0.
  LaneStates(const Lane& normal, const Lane& share, double weight) {
    const Lane zero{}, used = share < 1.0 ? share : zero + 1;
    const auto loaded = normal > at_limit * weight, slips = used >= 1 - at_limit;
    friction_used = loaded ? used : zero;
    state = loaded & (1 - slips);  // all bits of a true one are set
  }
  ContactState operator[](std::size_t k) const { return static_cast<ContactState>(state[k]); }
};

/// `least` and `most`: of the normal force.
inline ForceLimit limit_of(double normal, double least, double most, double near) {
  if (normal >= most - near) return ForceLimit::max;
  return least > 0 && normal <= least + near ? ForceLimit::min : ForceLimit::none;
}

/// For words: without the minus of a rounded zero.
inline double rounded(double value) { return std::abs(value) < 1e-9 ? 0 : value; }

/// What opposes -y (about the center), a motion that gravity drives. Contacts at a limit of their
/// normal force do, or even push; and so may others, which would need more than the force cap.
template <int Dim>
std::string opposition(const Hand<Dim>& hand, const Twist<Dim>& y, const Hold<Dim>& hold) {
  constexpr double next_to_nothing = 1e-7;  // of y: what rounding leaves of no force
  const ScaledHand<Dim>& scaled = hand.scaled();
  const Cones<Dim> in_newtons = scaled.cones(1);
  dual::Point<Dim> point(scaled.size);
  dual::evaluate<Dim, double>(in_newtons, Wrench<Dim>::Zero(), y, point);
  bool weak = false, strong = false;
  double free = 0;
  for (std::size_t i = 0; i < scaled.size; ++i) {
    const ContactLane<Dim>& c = scaled.lanes[i / lane_size];
    const auto f = point.f(i);
    const double n = f[0], lo = c.lo[i % lane_size], hi = c.hi[i % lane_size];
    if (!(n < hi))
      weak = weak || (hi > 0 && hi > lo);
    else if (!(n > lo))
      strong = strong || lo > 0;
    else
      free += f.squaredNorm();
  }
  if (std::sqrt(free) > next_to_nothing * dual::dual_norm<Dim, double>(y)) {
    std::ostringstream words;
    words.precision(4);
    words << ", and what opposes it would take a force norm of more than "
          << std::sqrt(hold.lower_bound) << " N";
    return words.str();
  }
  return weak     ? ", although the contacts that oppose it press with their max_normal"
         : strong ? ", since contacts must press with their min_normal"
                  : ", and no contact opposes it";
}

/// Where drives are too weak, the one that has most to do with it.
template <int Dim>
std::string weak_drives(const Hand<Dim>& hand, const Hold<Dim>& hold) {
  const std::vector<Drive<Dim>> drives = hand.drives();
  std::size_t most = drives.size();
  for (std::size_t a = 0; a < hold.rates.size(); ++a)
    if (hold.rates[a] > 0 && (most == drives.size() || hold.rates[a] > hold.rates[most])) most = a;
  if (most == drives.size() || hold.rates[most] < 1e-9 * hold.dual.cwiseAbs().maxCoeff()) return {};
  std::ostringstream words;
  words.precision(4);
  words << "the fingers would need more than their drives give: ";
  if (hold.objective == Objective::grip)
    words << "a grip of " << hold.lower_bound << ' ' << to_string(grip_unit(hand)) << ", where ";
  words << drives[most].name << " gives " << drives[most].max
        << (drives[most].turns ? " N m" : " N") << " at most";
  return words.str();
}

inline constexpr const char* unproven =
    "it is within rounding of the limit of holding, where neither forces nor a proof that there "
    "are none were found";

/// The forces of one lane of contacts in newtons, without their limits.
inline void write_forces(const dual::Problem<2>& problem, const ContactLane<2>& c,
                         const dual::LaneForces<2, double>& lane, ContactForce<2>* forces,
                         std::size_t count) {
  const Lane n = lane.f[0], t = lane.f[1], unit = problem.weight * c.root;
  const Lane normal = n * unit, tangential = t * unit;
  const LaneStates states(normal, magnitude(t) / (c.mu * n), problem.weight);
  for (std::size_t k = 0; k < count; ++k)
    forces[k] = {normal[k], tangential[k], states.friction_used[k], states[k], ForceLimit::none};
}
inline void write_forces(const dual::Problem<3>& problem, const ContactLane<3>& c,
                         const dual::LaneForces<3, double>& lane, ContactForce<3>* forces,
                         std::size_t count) {
  const Lane n = lane.f[0], a = lane.f[1], b = lane.f[2], s = lane.f[3];
  const Lane unit = problem.weight * c.root;
  const Lane normal = n * unit, moment = s * unit * c.soft * problem.hand.length;
  Lane tangential[3];
  for (int d = 0; d < 3; ++d) tangential[d] = problem.weight * (a * c.a[d] + b * c.b[d]);
  Lane beside = a * a + b * b + s * s;
  for (std::size_t k = 0; k < lane_size; ++k) beside[k] = std::sqrt(beside[k]);
  const LaneStates states(normal, beside / (c.mu * n), problem.weight);
  for (std::size_t k = 0; k < count; ++k)
    forces[k] = {normal[k],        {tangential[0][k], tangential[1][k], tangential[2][k]},
                 moment[k],        states.friction_used[k],
                 states[k],        ForceLimit::none,
                 Vector<3>::Zero()};
}

inline void check(const HoldSettings& settings) {
  if (!(settings.force_cap > 0) || !(settings.force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9 weights");
}
template <int Dim>
void check_up(const Vector<Dim>& up) {
  if (!(std::abs(up.squaredNorm() - 1) <= 1e-6)) throw InvalidGrasp("up", "must be a unit vector");
}

/// What was found of a load that can be held, but for what proves it.
template <int Dim>
void write_point(const dual::Problem<Dim>& problem, const dual::Point<Dim>& point,
                 Hold<Dim>& hold) {
  hold.holdable = true;
  const double weight = problem.weight;
  const double moment = point.residual.template tail<wrench_size<Dim> - Dim>().norm();
  hold.residual =
      std::max(point.residual.template head<Dim>().norm(), problem.hand.radius > 0 ? moment : 0);
  hold.forces.resize(problem.size);
  const dual::LaneForces<Dim, double>* lanes = point.lanes.begin();
  ContactForce<Dim>* forces = hold.forces.begin();
  for (std::size_t i = 0; i < problem.size; i += lane_size)
    write_forces(problem, problem.lanes[i / lane_size], *lanes++, forces + i,
                 std::min(lane_size, problem.size - i));
  if (problem.limited)
    for (std::size_t i = 0; i < problem.size; ++i) {
      const ContactLane<Dim>& c = problem.lanes[i / lane_size];
      const std::size_t k = i % lane_size;
      forces[i].limit =
          limit_of(forces[i].normal, c.lo[k] * c.root[k], c.hi[k] * c.root[k], at_limit * weight);
    }
  hold.effort = weight * weight * dual::squared_norm(point);
}

/// The point that proves that nothing holds.
template <int Dim>
void write_proof(const dual::Problem<Dim>& problem, const dual::Point<Dim>& point,
                 const HoldSettings& settings, Hold<Dim>& hold) {
  hold.dual = about_origin(problem.hand, problem.weight, point.y);
  hold.proven = dual::lower_bound(point) > settings.force_cap * settings.force_cap;
  // Finite for weights whose square nearly overflows, too.
  hold.lower_bound = std::min(problem.weight * problem.weight * dual::lower_bound(point),
                              std::numeric_limits<double>::max());
}

/// The hold of a load in the solver's units.
template <int Dim>
Hold<Dim> solve(const dual::Problem<Dim>& problem, const Wrench<Dim>& w, const Twist<Dim>& start,
                const HoldSettings& settings) {
  check(settings);
  dual::Point<Dim> point(problem.size);
  Hold<Dim> hold;
  if (!dual::maximise(problem, w, start, settings.force_cap, point)) {
    write_proof(problem, point, settings, hold);
    return hold;
  }
  write_point(problem, point, hold);
  hold.dual = about_origin(problem.hand, problem.weight, point.y);
  // A long y may ask more for the load itself than for one within the balance tolerance.
  hold.lower_bound = std::min(problem.weight * problem.weight * 2 * point.value, hold.effort);
  return hold;
}

/// What is claimed of a load that cannot be held, as who checks it will find it.
template <int Dim>
void write_exact_proof(const Hand<Dim>& hand, const Wrench<Dim>& load, double weight,
                       double force_cap, Hold<Dim>& hold, double friction_factor = 1) {
  if (hold.holdable) return;
  const double cap = force_cap * weight;
  hold.proven = hold.proven && dual::proves_none<Dim>(hand, load, weight, cap, hold.dual,
                                                      hold.rates, friction_factor);
  if (hold.proven) return;
  const dual::Exact bound =
      dual::effort_bound<Dim>(hand, load, hold.dual, hold.rates, friction_factor) -
      dual::effort_rounding<Dim>(hand, load, hold.dual, hold.rates, friction_factor);
  hold.lower_bound = std::clamp(static_cast<double>(bound), 0.0, cap * cap);
}

/// A y so long that its rounding may count [1 / weight].
inline constexpr double long_y = 1e4;

/// The hold of a load in the posture `up`, from cold. `contacts`: those of the hand, or with all
/// frictions multiplied by a factor.
template <int Dim>
Hold<Dim> solve(const Hand<Dim>& hand, const ScaledHand<Dim>& contacts, double friction_factor,
                const Load<Dim>& load, const Vector<Dim>& up, const HoldSettings& settings) {
  check_up<Dim>(up);
  const double unit = load.size(hand.length());
  if (hand.is_general())
    return general_hold(hand, friction_factor, load.at(up), unit, settings);
  const dual::Problem<Dim> problem(contacts, unit);
  const Wrench<Dim> w = scaled_load<Dim>(problem.hand, problem.weight, load, up);
  Hold<Dim> hold = solve(problem, w, dual::cold_start(problem, w), settings);
  write_exact_proof(hand, load.at(up), unit, settings.force_cap, hold, friction_factor);
  const double length = hold.dual.template head<Dim>().norm() / unit;
  if (hold.holdable && length * unit * unit > long_y * hold.effort)
    hold.lower_bound =
        std::min(static_cast<double>(dual::bound<Dim>(hand, load, up, hold.dual, friction_factor)),
                 hold.effort);
  return hold;
}

}  // namespace poise
