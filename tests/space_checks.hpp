// What makes a hold in space right, in plain arithmetic: nothing here knows how it was found.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "poise/hold.hpp"

namespace poise::test::space {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;
using Real6 = Eigen::Matrix<Real, 6, 1>;

inline constexpr Real balance_tolerance = 1e-12L;

/// Directions spread evenly over the sphere.
inline std::vector<Vector<3>> directions(int count) {
  std::vector<Vector<3>> points;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z), turn = 2.399963 * k;
    points.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return points;
}

/// A force on the object, in the object frame, and a moment about the contact's normal.
struct Force {
  Real normal{0};
  Real3 tangential = Real3::Zero();
  Real moment{0};
};

inline Real3 normal_of(const Contact<3>& contact) { return contact.normal.cast<Real>(); }
inline Real3 force_vector(const Contact<3>& contact, const Force& f) {
  return f.normal * normal_of(contact) + f.tangential;
}

inline Real6 load_at(const Grasp<3>& grasp, const Vector<3>& up) {
  const Real3 force = Real{grasp.size()} * up.cast<Real>();
  Real6 load;
  load << force, grasp.center().cast<Real>().cross(force);
  return load;
}

/// What a moment counts as in effort and cone: a force.
inline Real moment_as_force(const Contact<3>& contact, Real moment) {
  return contact.torsion > 0 ? moment * contact.friction / contact.torsion : 0;
}
inline Real beside(const Contact<3>& contact, const Force& f) {
  const Real s = moment_as_force(contact, f.moment);
  return std::sqrt(f.tangential.squaredNorm() + s * s);
}

/// By how much a contact force is outside of its friction cone and limits.
inline Real outside(const Contact<3>& contact, const Force& f) {
  return std::max({Real{0}, contact.min_normal - f.normal, f.normal - contact.max_normal,
                   beside(contact, f) - contact.friction * f.normal,
                   contact.torsion > 0 ? 0 : std::abs(f.moment),
                   std::abs(f.tangential.dot(normal_of(contact))) / 10});
}

inline Real cost(const Contact<3>& contact, const Force& f) {
  const Real s = beside(contact, f);
  return (f.normal * f.normal + s * s) / contact.share;
}

/// The force that maximises its power on the twist y less half its cost.
inline Force answer_to(const Contact<3>& contact, const Twist<3>& y) {
  const Real3 n = normal_of(contact), omega = y.tail<3>().cast<Real>();
  const Real3 u = y.head<3>().cast<Real>() + omega.cross(contact.position.cast<Real>());
  const Real share = contact.share, mu = contact.friction;
  const Real ratio = contact.torsion > 0 ? contact.torsion / mu : 0;
  const Real zn = share * u.dot(n), zs = share * ratio * omega.dot(n);
  const Real3 zt = share * (u - u.dot(n) * n);
  const Real side = std::sqrt(zt.squaredNorm() + zs * zs);
  const Real lo = contact.min_normal, hi = contact.max_normal;
  // Of the inside, the cut and the edge in the half-plane (normal, side) the nearest.
  Real best_n = std::clamp((zn + mu * side) / (1 + mu * mu), lo, hi), best_t = mu * best_n;
  for (const Real n_cut : {std::clamp(zn, lo, hi), lo, hi}) {
    if (!std::isfinite(n_cut)) continue;
    const Real t = std::min(side, mu * n_cut);
    const auto nearness = [&](Real a, Real b) { return a * (2 * zn - a) + b * (2 * side - b); };
    if (nearness(n_cut, t) > nearness(best_n, best_t)) {
      best_n = n_cut;
      best_t = t;
    }
  }
  const Real kept = side > 0 ? best_t / side : 0;
  return {best_n, kept * zt, kept * zs * ratio};
}

inline Real power(const Contact<3>& contact, const Force& f, const Twist<3>& y) {
  const Real3 omega = y.tail<3>().cast<Real>();
  const Real3 u = y.head<3>().cast<Real>() + omega.cross(contact.position.cast<Real>());
  return u.dot(force_vector(contact, f)) + omega.dot(normal_of(contact)) * f.moment;
}

/// phi(G^T y).
inline Real support(const Grasp<3>& grasp, const Twist<3>& y) {
  Real phi = 0;
  for (const Contact<3>& contact : grasp.contacts()) {
    const Force f = answer_to(contact, y);
    phi += power(contact, f, y) - cost(contact, f) / 2;
  }
  return phi;
}

/// No forces that balance w have less effort.
inline Real dual_bound(const Grasp<3>& grasp, const Real6& w, const Twist<3>& y) {
  return 2 * (y.cast<Real>().dot(w) - support(grasp, y));
}

/// The same for forces that balance w within the tolerance.
inline Real proven_effort(const Grasp<3>& grasp, const Real6& w, const Twist<3>& y) {
  const Real3 omega = y.tail<3>().cast<Real>();
  const Real3 v = y.head<3>().cast<Real>() + omega.cross(grasp.center().cast<Real>());
  const Real size = v.norm() + grasp.radius() * omega.norm();
  return dual_bound(grasp, w, y) - 2 * balance_tolerance * grasp.size() * size;
}

inline Real squared_cap(const Grasp<3>& grasp, double force_cap) {
  const Real cap = Real{force_cap} * grasp.size();
  return cap * cap;
}

inline std::vector<Force> forces_of(const Hold<3>& hold) {
  std::vector<Force> forces;
  for (const ContactForce<3>& f : hold.forces)
    forces.push_back({f.normal, f.tangential.cast<Real>(), f.torsion_moment});
  return forces;
}

inline Real effort_of(const Grasp<3>& grasp, const std::vector<Force>& forces) {
  Real effort = 0;
  for (std::size_t i = 0; i < forces.size(); ++i) effort += cost(grasp.contacts()[i], forces[i]);
  return effort;
}

/// The larger of force / W and moment / (W L) that is left over, the moment about the com.
inline Real imbalance(const Grasp<3>& grasp, const Real6& w, const std::vector<Force>& forces) {
  const Real3 com = grasp.center().cast<Real>();
  Real3 force = w.head<3>(), moment = w.tail<3>() - com.cross(force);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Contact<3>& contact = grasp.contacts()[i];
    const Real3 f = force_vector(contact, forces[i]);
    force -= f;
    moment -=
        (contact.position.cast<Real>() - com).cross(f) + forces[i].moment * normal_of(contact);
  }
  const Real weight = grasp.size(), length = grasp.radius();
  return std::max(force.norm() / weight, length > 0 ? moment.norm() / (weight * length) : Real{0});
}

inline bool close(Real a, Real b, Real relative, Real absolute = 0) {
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b)) + absolute;
}

/// What is wrong with one contact force as it is reported, or nothing.
inline std::string fault(const Grasp<3>& grasp, std::size_t i, const ContactForce<3>& f) {
  const Contact<3>& contact = grasp.contacts()[i];
  const double weight = grasp.size();
  const Real most = contact.friction * Real{f.normal};
  const Real side = beside(contact, {f.normal, f.tangential.cast<Real>(), f.torsion_moment});
  const bool loaded = f.normal > 1e-9 * weight;
  const Real used = !loaded ? 0 : most > 0 ? std::min(Real{1}, side / most) : 1;
  if (!close(f.friction_used, used, 1e-12L)) return "friction_used";
  const bool slips = f.state == ContactState::slipping;
  if ((f.state == ContactState::unloaded) == loaded) return "state";
  if (loaded && slips != (used >= 1 - 1e-9L) && std::abs(used - (1 - 1e-9L)) > 1e-13L)
    return "state";
  const bool at_max = f.normal >= contact.max_normal - 1e-9 * weight;
  const bool at_min = contact.min_normal > 0 && f.normal <= contact.min_normal + 1e-9 * weight;
  const ForceLimit limit = at_max ? ForceLimit::max : at_min ? ForceLimit::min : ForceLimit::none;
  return f.limit == limit ? "" : "limit";
}

/// What is wrong with a hold of the load w, or nothing: balance, cones, limits, effort, and the
/// proof that no forces have less effort or that there are none.
inline std::string fault(const Grasp<3>& grasp, const Real6& w, const Hold<3>& hold,
                         double force_cap = 1e6) {
  std::ostringstream words;
  words.precision(15);
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
    if (!hold.proven) return "an unholdable load is not said to be proven";
    if (!(hold.lower_bound > cap)) return wrong("lower_bound", hold.lower_bound, cap);
    return "";
  }
  if (hold.forces.size() != grasp.contacts().size()) return "forces are missing";
  const std::vector<Force> forces = forces_of(hold);
  const Real effort = effort_of(grasp, forces), norm = std::sqrt(effort) / weight;  // [weights]
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
  // The proof: with y ~ norm^3 at worst the rounding of normals, times y, makes itself felt in f.
  const Real lost = std::max(Real{1}, 4e-6L * norm * norm);
  // And what a balance within the tolerance may be worth to it.
  const Real bound = dual_bound(grasp, w, hold.dual);
  const Real small = 1e-15L * weight * weight + 2 * (bound - proven_effort(grasp, w, hold.dual));
  if (bound > effort * (1 + 1e-9L * lost) + small) return wrong("the dual bound", bound, effort);
  if (bound < effort * (1 - 1e-9L * lost) - small) return wrong("the dual bound", bound, effort);
  if (!close(bound, hold.lower_bound, 1e-9L * lost, small))
    return wrong("lower_bound", hold.lower_bound, bound);
  return "";
}

inline std::string fault(const Grasp<3>& grasp, const Vector<3>& up, const Hold<3>& hold,
                         double force_cap = 1e6) {
  return fault(grasp, load_at(grasp, up), hold, force_cap);
}

}  // namespace poise::test::space
