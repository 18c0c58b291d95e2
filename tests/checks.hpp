// What makes a hold right, in plain arithmetic: nothing here knows how it was found.
#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "poise/posture_curve.hpp"

namespace poise::test {

using Real = long double;
using RealVector = Eigen::Matrix<Real, 2, 1>;
using RealWrench = Eigen::Matrix<Real, 3, 1>;

inline constexpr Real balance_tolerance = 1e-12L;

inline Real cross(const RealVector& a, const RealVector& b) {
  return a.x() * b.y() - a.y() * b.x();
}
inline RealVector tangent(const Contact<2>& contact) {
  return {-contact.normal.y(), contact.normal.x()};
}
/// The part of a velocity or force along the normal, and along the tangent.
inline RealVector in_contact_frame(const Contact<2>& contact, const RealVector& v) {
  return {v.dot(contact.normal.cast<Real>()), v.dot(tangent(contact))};
}
inline RealVector in_object_frame(const Contact<2>& contact, const RealVector& force) {
  return force.x() * contact.normal.cast<Real>() + force.y() * tangent(contact);
}

/// The load in the posture theta, about the origin.
inline RealWrench load_at(const Grasp<2>& grasp, double theta) {
  const RealVector force =
      Real{grasp.size()} * RealVector(std::sin(Real{theta}), std::cos(Real{theta}));
  return {force.x(), force.y(), cross(grasp.center().cast<Real>(), force)};
}

/// By how much a contact force (normal, tangential) is outside of its friction cone and limits.
inline Real outside(const Contact<2>& contact, const RealVector& force) {
  return std::max({Real{0}, contact.min_normal - force.x(), force.x() - contact.max_normal,
                   std::abs(force.y()) - contact.friction * force.x()});
}

/// The nearest point of the friction cone, cut at its limits: of its inside and its sides.
inline RealVector project(const Contact<2>& contact, const RealVector& z) {
  if (outside(contact, z) == 0) return z;
  const Real mu = contact.friction, lo = contact.min_normal, hi = contact.max_normal;
  std::vector<RealVector> sides;
  for (const Real slope : {mu, -mu}) {
    const Real n = std::clamp((z.x() + slope * z.y()) / (1 + mu * mu), lo, hi);
    sides.emplace_back(n, slope * n);
  }
  for (const Real n : {lo, hi})
    if (std::isfinite(n)) sides.emplace_back(n, std::clamp(z.y(), -mu * n, mu * n));
  const auto nearness = [&](const RealVector& f) { return 2 * z.dot(f) - f.squaredNorm(); };
  return *std::max_element(
      sides.begin(), sides.end(),
      [&](const RealVector& a, const RealVector& b) { return nearness(a) < nearness(b); });
}

/// The contact's entries of transpose(G) y.
inline RealVector contact_velocity(const Contact<2>& contact, const Twist<2>& y) {
  const RealVector r = contact.position.cast<Real>();
  return in_contact_frame(contact, {y[0] - y[2] * r.y(), y[1] + y[2] * r.x()});
}

/// The forces that maximise y . G f - effort / 2.
inline std::vector<RealVector> forces_of(const Grasp<2>& grasp, const Twist<2>& y) {
  std::vector<RealVector> forces;
  for (const Contact<2>& contact : grasp.contacts())
    forces.push_back(project(contact, contact.share * contact_velocity(contact, y)));
  return forces;
}

/// 2 (y . w - phi(transpose(G) y)): no forces that balance w have less effort.
inline Real dual_bound(const Grasp<2>& grasp, const RealWrench& w, const Twist<2>& y) {
  Real bound = 2 * y.cast<Real>().dot(w);
  const std::vector<RealVector> forces = forces_of(grasp, y);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Contact<2>& contact = grasp.contacts()[i];
    bound -=
        2 * contact_velocity(contact, y).dot(forces[i]) - forces[i].squaredNorm() / contact.share;
  }
  return bound;
}

/// The velocity of the com, and that of the farthest contact round it.
inline Real size(const Grasp<2>& grasp, const Twist<2>& y) {
  const RealVector com = grasp.center().cast<Real>();
  const RealVector velocity(y[0] - y[2] * com.y(), y[1] + y[2] * com.x());
  return velocity.norm() + grasp.radius() * std::abs(Real{y[2]});
}

/// The same for forces that balance w within the tolerance.
inline Real proven_effort(const Grasp<2>& grasp, const RealWrench& w, const Twist<2>& y) {
  return dual_bound(grasp, w, y) - 2 * balance_tolerance * grasp.size() * size(grasp, y);
}

inline Real squared_cap(const Grasp<2>& grasp, double force_cap) {
  const Real cap = Real{force_cap} * grasp.size();
  return cap * cap;
}

/// Whether y, made as long or as short as is best for it, proves that w cannot be held.
inline bool proves_unholdable(const Grasp<2>& grasp, const RealWrench& w, const Twist<2>& y,
                              double force_cap = 1e6) {
  for (int exponent = -60; exponent < 60; exponent += 2)
    if (proven_effort(grasp, w, std::ldexp(1.0, exponent) * y) > squared_cap(grasp, force_cap))
      return true;
  return false;
}

inline Real effort_of(const Grasp<2>& grasp, const std::vector<RealVector>& forces) {
  Real effort = 0;
  for (std::size_t i = 0; i < forces.size(); ++i)
    effort += forces[i].squaredNorm() / grasp.contacts()[i].share;
  return effort;
}

/// The larger of force / W and moment / (W L) that is left over, the moment about the com.
inline Real imbalance(const Grasp<2>& grasp, const RealWrench& w,
                      const std::vector<RealVector>& forces) {
  const RealVector com = grasp.center().cast<Real>();
  RealVector force = w.head<2>();
  Real moment = w[2] - cross(com, force);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Contact<2>& contact = grasp.contacts()[i];
    const RealVector f = in_object_frame(contact, forces[i]);
    force -= f;
    moment -= cross(contact.position.cast<Real>() - com, f);
  }
  const Real weight = grasp.size(), length = grasp.radius();
  return std::max(force.norm() / weight,
                  length > 0 ? std::abs(moment) / (weight * length) : Real{0});
}

inline std::vector<RealVector> forces_of(const Hold<2>& hold) {
  std::vector<RealVector> forces;
  for (const ContactForce<2>& f : hold.forces) forces.emplace_back(f.normal, f.tangential);
  return forces;
}

/// Relative to the larger.
inline Real difference(Real a, Real b) {
  return a == b ? 0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b));
}
inline bool close(Real a, Real b, Real relative, Real absolute = 0) {
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b)) + absolute;
}

/// What is wrong with one contact force as it is reported, or nothing.
inline std::string fault(const Grasp<2>& grasp, std::size_t i, const ContactForce<2>& f) {
  const Contact<2>& contact = grasp.contacts()[i];
  const double weight = grasp.size(), most = contact.friction * f.normal;
  const bool loaded = f.normal > 1e-9 * weight;
  const double used = !loaded ? 0 : most > 0 ? std::min(1.0, std::abs(f.tangential) / most) : 1;
  const ContactState state = !loaded            ? ContactState::unloaded
                             : used >= 1 - 1e-9 ? ContactState::slipping
                                                : ContactState::sticking;
  if (!close(f.friction_used, used, 1e-12L)) return "friction_used";
  if (f.state != state) return "state";
  const bool at_max = f.normal >= contact.max_normal - 1e-9 * weight;
  const bool at_min = contact.min_normal > 0 && f.normal <= contact.min_normal + 1e-9 * weight;
  const ForceLimit limit = at_max ? ForceLimit::max : at_min ? ForceLimit::min : ForceLimit::none;
  return f.limit == limit ? "" : "limit";
}

/// What is wrong with a hold of the load w, or nothing: balance, cones, limits, effort, and the
/// proof that no forces have less effort or that there are none.
inline std::string fault(const Grasp<2>& grasp, const RealWrench& w, const Hold<2>& hold,
                         double force_cap = 1e6) {
  std::ostringstream words;
  const auto wrong = [&](const std::string& what, Real value, Real expected) {
    words << what << " is " << static_cast<double>(value) << ", not "
          << static_cast<double>(expected);
    return words.str();
  };
  const Real weight = grasp.size();
  if (!hold.holdable) {
    if (!hold.forces.empty() || hold.effort != 0) return "an unholdable load has forces";
    const Real proven = proven_effort(grasp, w, hold.dual), cap = squared_cap(grasp, force_cap);
    if (!(proven > cap)) return wrong("the effort of the unholdable, as proven,", proven, cap);
    if (!(hold.lower_bound > cap)) return wrong("lower_bound", hold.lower_bound, cap);
    return "";
  }
  if (hold.forces.size() != grasp.contacts().size()) return "forces are missing";
  const std::vector<RealVector> forces = forces_of(hold), best = forces_of(grasp, hold.dual);
  const Real effort = effort_of(grasp, forces);
  const Real norm = std::sqrt(effort) / weight;  // [weights]
  const Real rounding = 1e-15L * (1 + norm) * static_cast<Real>(forces.size());
  if (!(norm <= force_cap * (1 + 1e-9L))) return wrong("the force norm", norm, force_cap);
  if (!close(effort, hold.effort, 1e-12L)) return wrong("effort", hold.effort, effort);
  const Real error = imbalance(grasp, w, forces);
  if (error > balance_tolerance + rounding) return wrong("the imbalance", error, 0);
  if (!close(hold.residual, error, 0.01L, rounding)) return wrong("residual", hold.residual, error);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Real slip = outside(grasp.contacts()[i], forces[i]) / weight;
    if (slip > rounding) return wrong("outside of its cone a force", slip, 0);
    const std::string other = fault(grasp, i, hold.forces[i]);
    if (!other.empty()) return other + " of contact " + std::to_string(i);
  }
  // The proof: its y loses as many digits as it is longer than the weight.
  const Real lost = std::max(Real{1}, norm / 1000);
  // And what a balance within the tolerance may be worth to it.
  const Real bound = dual_bound(grasp, w, hold.dual);
  const Real small = 1e-15L * weight * weight + 2 * (bound - proven_effort(grasp, w, hold.dual));
  if (bound > effort * (1 + 1e-10L * lost) + small) return wrong("the dual bound", bound, effort);
  if (bound < effort * (1 - 1e-9L * lost) - small) return wrong("the dual bound", bound, effort);
  if (!close(bound, hold.lower_bound, 1e-10L * lost, small))
    return wrong("lower_bound", hold.lower_bound, bound);
  // Forces follow from y no better than to the root of what the bound leaves open.
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Real off = (forces[i] - best[i]).norm() / weight;
    if (off > 1e-5L * (1 + norm)) return wrong("a force is off what the dual says, that", off, 0);
  }
  return "";
}

inline std::string fault(const Grasp<2>& grasp, double theta, const Hold<2>& hold,
                         double force_cap = 1e6) {
  return fault(grasp, load_at(grasp, theta), hold, force_cap);
}

/// V of an arc has no digits beyond those of its coefficients, which are far larger than V where
/// the arc is steep.
inline Real rounding(const Arc& arc) {
  const Harmonic2& V = arc.value;
  return 1e-13L * (std::abs(V.c0) + std::hypot(V.cos1, V.sin1) + std::hypot(V.cos2, V.sin2));
}

/// The same of all arcs around a posture.
inline Real rounding(const PostureCurve& curve, double theta) {
  constexpr double turn = 6.283185307179586;
  Real most = 0;
  for (const Arc& arc : curve.arcs) {
    const double near = 1e-6, start = arc.from - near;
    const double within = theta - turn * std::floor((theta - start) / turn);
    if (within <= arc.to + near) most = std::max(most, rounding(arc));
  }
  return most;
}

}  // namespace poise::test
