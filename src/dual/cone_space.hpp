// A contact in space: its columns of G, and its cone, round about the normal; of a soft finger in
// (t1, t2, m mu / gamma), where the moment's part is as long as a force. docs/theory.md, "Space".
// Not installed.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "dual/contact_lane.hpp"

namespace poise::dual {

/// A twist, each number for all contacts of a lane: plain or Twofold.
template <class L>
struct SpaceTwist {
  L v[3], omega[3];
};

/// z of the contacts of a lane: normal, along the tangents, and the turn that a soft finger feels.
template <class L>
struct SpaceVelocity {
  L normal, a, b, turn;
  L squared, over;  ///< of the tangential part: its square, and 1 / its length or any number if 0
  L power;          ///< of a force on the cone's edge, per normal force
};

/// The contact point's own velocity.
template <class C, class L>
[[gnu::always_inline]] inline void move_point(const C& c, const SpaceTwist<L>& y, L (&u)[3]) {
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    u[k] = y.v[k] + (c.r[j] * y.omega[i] - c.r[i] * y.omega[j]);
  }
}
template <class N, class L>
[[gnu::always_inline]] inline L along(const N (&n)[3], const L (&u)[3]) {
  return n[0] * u[0] + n[1] * u[1] + n[2] * u[2];
}

template <class C, class L>
[[gnu::always_inline]] inline SpaceVelocity<L> velocity(const C& c, const SpaceTwist<L>& y) {
  L u[3];
  move_point(c, y, u);
  SpaceVelocity<L> z;
  z.normal = along(c.n, u);
  z.a = along(c.a, u);
  z.b = along(c.b, u);
  z.turn = c.soft * along(c.n, y.omega);
  z.squared = z.a * z.a + z.b * z.b + z.turn * z.turn;
  z.over = inverse_root(z.squared);
  z.power = z.normal + c.mu * (z.squared * z.over);
  return z;
}

/// Where z is large and the force small, the power keeps its digits in Twofold numbers. The
/// tangents, which are perpendicular to the normal but for rounding, have no say in it.
[[gnu::always_inline]] inline SpaceVelocity<Lane> velocity(const ContactLane<3>& c,
                                                           const SpaceTwist<Twofold>& y) {
  Twofold u[3];
  move_point(c, y, u);
  const Twofold normal = along(c.n, u), turn = c.soft * along(c.n, y.omega);
  Twofold squared = turn * turn;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Twofold across = c.n[i] * u[j] - c.n[j] * u[i];
    squared = squared + across * across;
  }
  const Lane moved[3] = {narrow(u[0]), narrow(u[1]), narrow(u[2])};
  SpaceVelocity<Lane> z;
  z.normal = narrow(normal);
  z.a = along(c.a, moved);
  z.b = along(c.b, moved);
  z.turn = narrow(turn);
  z.squared = narrow(squared);
  z.over = inverse_root(z.squared);
  // A Newton step takes the root to all digits.
  const Lane root = z.squared * z.over;
  const Twofold missing = squared - exact_product(root, root);
  z.power = narrow(normal + c.mu * exact_sum(root, Lane(0.5 * narrow(missing) * z.over)));
  return z;
}

/// f = (n, kept times z's tangential part).
template <class L>
struct SpaceForce {
  L n, kept;
};

/// Π_K(z), without a branch: in the half-plane of the normal and z's tangential part this is the
/// projection of the plane.
template <bool limited, class T, class L>
[[gnu::always_inline]] inline SpaceForce<L> project(const Cones<3, T>& cones,
                                                    const ContactLane<3, T>& c,
                                                    const SpaceVelocity<L>& z) {
  const L zero{}, one = zero + 1.0, edge = z.power * c.edge;
  L within = z.normal, lo{}, hi{};
  if constexpr (limited) {
    lo = cones.scaled(c.lo);
    hi = cones.scaled(c.hi);
    within = z.normal < lo ? lo : z.normal > hi ? hi : z.normal;
  }
  const auto inside = z.squared * z.over < c.mu * within;
  L n = inside ? z.normal : edge;
  if constexpr (limited)
    n = n < lo ? lo : n > hi ? hi : n;
  else
    n = n > zero ? n : zero;
  return {n, inside ? one : L(c.mu * n * z.over)};
}

/// DΠ_K = kappa I + [e_n d] S [e_n d]ᵀ, with d the direction of z's tangential part: inside kappa =
/// 1; beside the cone kappa = |t| / |z_t|, the curvature of the round cone, and along its edge 1.
template <class L>
struct SpaceDerivative {
  L kappa, nn, nd, dd;
};
template <bool limited, class T, class L>
[[gnu::always_inline]] inline SpaceDerivative<L> derivative(const Cones<3, T>& cones,
                                                            const ContactLane<3, T>& c,
                                                            const L& beside, const L& over,
                                                            const L& n) {
  const L zero{}, one = zero + 1.0, most = c.mu * n;
  const auto inside = beside < most;
  L free = n > zero ? one : zero;  // neither at its least nor at its greatest
  if constexpr (limited)
    free = n > cones.scaled(c.lo) ? (n < cones.scaled(c.hi) ? one : zero) : zero;
  const L kappa = inside ? one : most * over, edge = free * c.edge;
  const L nn = edge - kappa, nd = edge * c.mu, dd = edge * c.mu * c.mu - kappa;
  return {kappa, inside ? (limited ? free - one : zero) : nn, inside ? zero : nd,
          inside ? zero : dd};
}

/// The contact's columns of G, as the solver scales them: those of forces that it can pass on.
inline Eigen::Matrix<double, 6, 4> columns(const ContactLane<3>& lane, std::size_t k) {
  Eigen::Matrix<double, 6, 4> G = Eigen::Matrix<double, 6, 4>::Zero();
  Vector<3> r;
  for (int d = 0; d < 3; ++d) {
    r[d] = lane.r[d][k];
    G(d, 0) = lane.n[d][k];
    if (lane.mu[k] == 0) continue;
    G(d, 1) = lane.a[d][k];
    G(d, 2) = lane.b[d][k];
  }
  for (int column = 0; column < 3; ++column)
    G.col(column).tail<3>() = r.cross(G.col(column).head<3>());
  G.col(3).tail<3>() = lane.soft[k] * G.col(0).head<3>();
  return G;
}

inline Eigen::Matrix<double, 6, 4> columns(const Cones<3>& cones, std::size_t contact) {
  return columns(cones.lanes[contact / lane_size], contact % lane_size);
}

/// z of a contact in the object frame, under a twist about its origin.
template <class Real>
Slide<Real> slide(const Contact<3>& contact, const Twist<3>& y) {
  using Real3 = Eigen::Matrix<Real, 3, 1>;
  const Real3 n = contact.normal.cast<Real>(), omega = y.tail<3>().cast<Real>();
  const Real3 u = y.head<3>().cast<Real>() + omega.cross(contact.position.cast<Real>());
  const Real turn = contact.torsion > 0 ? omega.dot(n) * contact.torsion / contact.friction : 0;
  const Real along = u.dot(n);
  return {along, std::sqrt((u - along * n).squaredNorm() + turn * turn)};
}

/// Whether a force, and the moment about the normal, are in the contact's cone.
inline bool contains(const Contact<3>& contact, const Vector<3>& force, double moment) {
  const double normal = contact.normal.dot(force);
  const double turn = contact.torsion > 0 ? moment * contact.friction / contact.torsion : 0;
  const double beside = std::hypot((force - normal * contact.normal).norm(), turn);
  return beside <= contact.friction * normal && normal >= contact.min_normal &&
         normal <= contact.max_normal && (contact.torsion > 0 || moment == 0);
}

}  // namespace poise::dual
