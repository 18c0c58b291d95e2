// The hot loops of the solver in the plane: over all contacts, a lane at a time. Not installed.
#pragma once

#include "dual/cone_plane.hpp"
#include "dual/dual.hpp"

namespace poise::dual {

/// Projects every contact's z to its forces; the sum of their wrenches, and phi(z).
template <bool limited, class T, class L>
void evaluate_lanes(const Cones<2, T>& cones, const PlaneTwist<L>& y, Screw<2, T>& wrench, T& phi,
                    Point<2, T>& point) {
  using N = LaneOf<T>;
  N fx{}, fy{}, fm{}, power{};
  LaneForces<2, T>* forces = point.lanes.data();
  for (const ContactLane<2, T>& c : cones.lanes) {
    const PlaneVelocity<N> z = velocity(c, y);
    const PlaneForce<N> f = project<limited>(cones, c, z);
    *forces++ = {{z.normal, z.tangential}, {f.n, f.t}};
    const N gx = f.n * c.nx - f.t * c.ny, gy = f.n * c.ny + f.t * c.nx;
    fx += gx;
    fy += gy;
    fm += gx * c.jx + gy * c.jy;
    if constexpr (limited)
      power += f.n * (z.normal - 0.5 * f.n) + f.t * (z.tangential - 0.5 * f.t);
    else
      power += f.n * f.n + f.t * f.t;  // f and z - f are perpendicular
  }
  if constexpr (!limited) power *= broadcast(T(0.5));
  wrench = Screw<2, T>(sum(fx), sum(fy), sum(fm));
  phi = sum(power);
}

template <class T>
PlaneTwist<LaneOf<T>> twist_of_lane(const Screw<2, T>& y) {
  return {broadcast(y[0]), broadcast(y[1]), broadcast(y[2])};
}
inline PlaneTwist<Twofold> twofold_twist(const Twist<2>& y, const Twist<2>& rest) {
  const auto number = [&](int k) { return Twofold{broadcast(y[k]), broadcast(rest[k])}; };
  return {number(0), number(1), number(2)};
}

template <bool limited, class T>
Square<2, T> curvature_lanes(const Cones<2, T>& cones, const Point<2, T>& point) {
  using L = LaneOf<T>;
  L Mxx{}, Mxy{}, Myy{}, Mxm{}, Mym{}, Mmm{};
  // Adds e times the outer product of the wrench of a force at the contact.
  const auto add = [&](const ContactLane<2, T>& c, const L& e, const L& x, const L& y) {
    const L m = x * c.jx + y * c.jy, ex = e * x, ey = e * y;
    Mxx += ex * x;
    Mxy += ex * y;
    Myy += ey * y;
    Mxm += ex * m;
    Mym += ey * m;
    Mmm += e * m * m;
  };
  const LaneForces<2, T>* forces = point.lanes.data();
  for (const ContactLane<2, T>& c : cones.lanes) {
    const PlaneDerivative<L> d = derivative<limited>(cones, c, forces->z[1], forces->f[0]);
    ++forces;
    // Inside, forces along x and y.
    const L share = d.inside * c.share, sx = share * c.jx, sy = share * c.jy;
    Mxx += share;
    Myy += share;
    Mxm += sx;
    Mym += sy;
    Mmm += sx * c.jx + sy * c.jy;
    add(c, d.edge, c.nx - d.mu * c.ny, c.ny + d.mu * c.nx);
    if constexpr (limited) add(c, -d.at_limit, c.nx, c.ny);
  }
  Square<2, T> M;
  M << sum(Mxx), sum(Mxy), sum(Mxm), T(0), sum(Myy), sum(Mym), T(0), T(0), sum(Mmm);
  return M;
}

}  // namespace poise::dual
