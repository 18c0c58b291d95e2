// A contact in the plane: its columns of G, and its cone {(n, t): |t| <= mu n, lo <= n <= hi}, a
// trapezoid. docs/theory.md, "One posture". Not installed.
#pragma once

#include <algorithm>
#include <cmath>

#include "dual/contact_lane.hpp"

namespace poise::dual {

/// A twist, each number for all contacts of a lane: plain or Twofold.
template <class L>
struct PlaneTwist {
  L vx, vy, omega;
};

/// z of the contacts of a lane, with the power of a force on the cone's edge.
template <class L>
struct PlaneVelocity {
  L normal, tangential, power;
};

/// Where z is large and the force small, the power has lost digits, but not of Twofold numbers.
template <class C, class L>
[[gnu::always_inline]] inline auto velocity(const C& c, const PlaneTwist<L>& y) {
  const L ux = y.vx + c.jx * y.omega, uy = y.vy + c.jy * y.omega;
  const L normal = c.nx * ux + c.ny * uy, tangential = c.nx * uy - c.ny * ux;
  const L power = normal + c.mu * magnitude(tangential);
  using Narrow = std::remove_cvref_t<decltype(narrow(power))>;
  return PlaneVelocity<Narrow>{narrow(normal), narrow(tangential), narrow(power)};
}

template <class L>
struct PlaneForce {
  L n, t;
};

/// Π_K(z), without a branch: where z is inside the cone, its projection to the edge presses less.
template <bool limited, class T, class L>
[[gnu::always_inline]] inline PlaneForce<L> project(const Cones<2, T>& cones,
                                                    const ContactLane<2, T>& c,
                                                    const PlaneVelocity<L>& z) {
  L n = larger(z.normal, L(z.power * c.edge));
  if constexpr (limited)
    n = smaller(larger(n, cones.scaled(c.lo)), cones.scaled(c.hi));
  else
    n = larger(n, L{});
  return {n, with_sign_of(z.tangential, smaller(magnitude(z.tangential), L(c.mu * n)))};
}

/// DΠ_K at z. Inside the cone it is the identity, at a limit less e_n e_nᵀ; on its edge `edge`
/// times the outer product of (1, mu), with mu's sign that of t. Each is 0 elsewhere.
template <class L>
struct PlaneDerivative {
  L inside, at_limit, edge, mu;
};
template <bool limited, class T, class L>
[[gnu::always_inline]] inline PlaneDerivative<L> derivative(const Cones<2, T>& cones,
                                                            const ContactLane<2, T>& c,
                                                            const L& tangential, const L& n) {
  const L zero{}, one = zero + 1.0;
  const auto inside = magnitude(tangential) < c.mu * n;
  L free = c.edge;  // neither at its least nor at its greatest
  if constexpr (limited)
    free = n > cones.scaled(c.lo) ? (n < cones.scaled(c.hi) ? free : zero) : zero;
  else
    free = n > zero ? free : zero;
  const L held = free > zero ? zero : one;
  return {inside ? one : zero, inside ? held : zero, inside ? zero : free,
          with_sign_of(tangential, c.mu)};
}

/// The part of a contact's cone to which z projects: f = P z + f0 nearby. The inside, an edge or a
/// corner.
template <class T = double>
struct Face {
  Eigen::Matrix<T, 2, 2> P;
  Eigen::Matrix<T, 2, 1> f0;
  bool edge;          ///< of the friction cone: |t| = mu n
  bool at_lo, at_hi;  ///< at a limit of the normal force; the apex is edge and at_lo
  double sign;        ///< of the edge: t = sign mu n
};
/// edge: 1 / (1 + mu^2).
template <class T>
Face<T> face(const T& mu, const T& edge, const T& lo, const T& hi,
             const Eigen::Matrix<T, 2, 1>& z) {
  const T beside = z[1] < 0 ? -z[1] : z[1], zero = 0, one = 1;
  Face<T> face{};
  face.sign = z[1] < 0 ? -1 : 1;
  face.edge = !(beside < mu * std::clamp(z[0], lo, hi));
  const T n = face.edge ? (z[0] + mu * beside) * edge : z[0];
  face.at_lo = !(n > lo);
  face.at_hi = !face.at_lo && !(n < hi);
  const bool free = !face.at_lo && !face.at_hi;
  const T held = face.at_lo ? lo : hi;
  const Eigen::Matrix<T, 2, 1> along(one, face.sign * mu);
  if (face.edge) {
    face.P = (free ? edge : zero) * along * along.transpose();
    face.f0 = (free ? zero : held) * along;
  } else {
    face.P << (free ? one : zero), zero, zero, one;
    face.f0 << (free ? zero : held), zero;
  }
  return face;
}
template <class T>
Face<T> face(const Cones<2, T>& cones, std::size_t contact, const Eigen::Matrix<T, 2, 1>& z) {
  const ContactLane<2, T>& c = cones.lanes[contact / lane_size_of<T>];
  const std::size_t k = contact % lane_size_of<T>;
  return face<T>(element(c.mu, k), element(c.edge, k), cones.scaled(element(c.lo, k)),
                 cones.scaled(element(c.hi, k)), z);
}

/// The contact's columns of G, as the solver scales them.
template <class T>
Eigen::Matrix<T, 3, 2> columns(const Cones<2, T>& cones, std::size_t contact) {
  const ContactLane<2, T>& c = cones.lanes[contact / lane_size_of<T>];
  const std::size_t k = contact % lane_size_of<T>;
  const T nx = element(c.nx, k), ny = element(c.ny, k), jx = element(c.jx, k),
          jy = element(c.jy, k);
  Eigen::Matrix<T, 3, 2> G;
  G << nx, -ny, ny, nx, nx * jx + ny * jy, nx * jy - ny * jx;
  return G;
}

/// z of a contact in the object frame, under a twist about its origin.
template <class Real>
Slide<Real> slide(const Contact<2>& contact, const Twist<2>& y) {
  const Real ux = y[0] - Real{y[2]} * contact.position.y();
  const Real uy = y[1] + Real{y[2]} * contact.position.x();
  const Real nx = contact.normal.x(), ny = contact.normal.y();
  return {nx * ux + ny * uy, std::abs(nx * uy - ny * ux)};
}

/// Whether a force (normal, tangential) is in the contact's cone.
inline bool contains(const Contact<2>& contact, const Vector<2>& force) {
  return std::abs(force[1]) <= contact.friction * force[0] && force[0] >= contact.min_normal &&
         force[0] <= contact.max_normal;
}

}  // namespace poise::dual
