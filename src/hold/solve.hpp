// From a maximised dual to a hold in newtons: what hold.cpp (the plane) and hold_space.cpp share.
// Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "dual/dual.hpp"
#include "poise/hold.hpp"
#include "dual/twist.hpp"

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

template <int Dim>
ForceLimit limit_of(const Contact<Dim>& contact, double normal, double near) {
  if (normal >= contact.max_normal - near) return ForceLimit::max;
  return contact.min_normal > 0 && normal <= contact.min_normal + near ? ForceLimit::min
                                                                       : ForceLimit::none;
}

/// For words: without the minus of a rounded zero.
inline double rounded(double value) { return std::abs(value) < 1e-9 ? 0 : value; }

/// The hold of a load in the solver's units. `write_forces` writes those of one lane in newtons.
template <int Dim, class Write>
Hold<Dim> solve(const Grasp<Dim>& grasp, const Wrench<Dim>& w, const Twist<Dim>& start,
                const HoldSettings& settings, const Write& write_forces) {
  if (!(settings.force_cap > 0) || !(settings.force_cap <= 1e9))
    throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9 weights");
  const ScaledGrasp<Dim>& scaled = grasp.scaled();
  dual::Point<Dim> point(scaled.size);
  Hold<Dim> hold;
  hold.holdable = dual::maximise(scaled, w, start, settings.force_cap, point);
  const double weight = grasp.object().weight, square = weight * weight;
  hold.dual = about_origin(grasp, point.y);
  if (!hold.holdable) {
    hold.proven = dual::lower_bound(point) > settings.force_cap * settings.force_cap;
    // Finite for weights whose square nearly overflows, too.
    hold.lower_bound =
        std::min(square * dual::lower_bound(point), std::numeric_limits<double>::max());
    return hold;
  }
  const double moment = point.residual.template tail<wrench_size<Dim> - Dim>().norm();
  hold.residual =
      std::max(point.residual.template head<Dim>().norm(), grasp.radius() > 0 ? moment : 0);
  hold.forces.resize(scaled.size);
  const ContactLane<Dim>* contacts = scaled.lanes.begin();
  const dual::LaneForces<Dim, double>* lanes = point.lanes.begin();
  ContactForce<Dim>* forces = hold.forces.begin();
  for (std::size_t i = 0; i < scaled.size; i += lane_size)
    write_forces(*contacts++, *lanes++, forces + i, std::min(lane_size, scaled.size - i));
  if (scaled.limited)
    for (std::size_t i = 0; i < scaled.size; ++i)
      forces[i].limit = limit_of(grasp.contacts()[i], forces[i].normal, at_limit * weight);
  hold.effort = square * dual::squared_norm(point);
  // A long y may ask more for the load itself than for one within the balance tolerance.
  hold.lower_bound = std::min(square * 2 * point.value, hold.effort);
  return hold;
}

}  // namespace poise
