// The hot loops of the solver in space: over all contacts, a lane at a time. Not installed.
#pragma once

#include "dual/cone_space.hpp"
#include "dual/dual.hpp"

namespace poise::dual {

/// Projects every contact's z to its forces; the sum of their wrenches, and phi(z).
template <bool limited, class T, class L>
void evaluate_lanes(const Cones<3, T>& cones, const SpaceTwist<L>& y, Screw<3, T>& wrench, T& phi,
                    Point<3, T>& point) {
  using N = LaneOf<T>;
  const N zero{}, one = zero + 1.0, half = zero + 0.5;
  N fx{}, fy{}, fz{}, mx{}, my{}, mz{}, power{};
  LaneForces<3, T>* forces = point.lanes.data();
  for (const ContactLane<3, T>& c : cones.lanes) {
    const SpaceVelocity<N> z = velocity(c, y);
    const SpaceForce<N> f = project<limited>(cones, c, z);
    const N fa = f.kept * z.a, fb = f.kept * z.b, fs = f.kept * z.turn;
    *forces++ = {{z.normal, z.a, z.b, z.turn}, {f.n, fa, fb, fs}, z.over};
    const N gx = f.n * c.n[0] + fa * c.a[0] + fb * c.b[0];
    const N gy = f.n * c.n[1] + fa * c.a[1] + fb * c.b[1];
    const N gz = f.n * c.n[2] + fa * c.a[2] + fb * c.b[2];
    const N moment = c.soft * fs;
    fx += gx;
    fy += gy;
    fz += gz;
    mx += c.r[1] * gz - c.r[2] * gy + moment * c.n[0];
    my += c.r[2] * gx - c.r[0] * gz + moment * c.n[1];
    mz += c.r[0] * gy - c.r[1] * gx + moment * c.n[2];
    power += f.n * (z.normal - half * f.n) + f.kept * (one - half * f.kept) * z.squared;
  }
  const N all_sums[8] = {fx, fy, fz, mx, my, mz, power, zero};
  const auto sums = sums_of(all_sums);
  for (int k = 0; k < 6; ++k) wrench[k] = sums[static_cast<std::size_t>(k)];
  phi = sums[6];
}

template <class T>
SpaceTwist<LaneOf<T>> twist_of_lane(const Screw<3, T>& y) {
  return {{broadcast(y[0]), broadcast(y[1]), broadcast(y[2])},
          {broadcast(y[3]), broadcast(y[4]), broadcast(y[5])}};
}
inline SpaceTwist<Twofold> twofold_twist(const Twist<3>& y, const Twist<3>& rest) {
  const auto number = [&](int k) { return Twofold{broadcast(y[k]), broadcast(rest[k])}; };
  return {{number(0), number(1), number(2)}, {number(3), number(4), number(5)}};
}

/// Where M(i, j) of the upper triangle is, stored row by row.
constexpr int upper(int i, int j) { return i * (11 - i) / 2 + j; }

template <bool limited, class T>
Square<3, T> curvature_lanes(const Cones<3, T>& cones, const Point<3, T>& point) {
  using L = LaneOf<T>;
  L M[24] = {};  // its upper triangle
  const LaneForces<3, T>* forces = point.lanes.data();
  for (const ContactLane<3, T>& c : cones.lanes) {
    const LaneForces<3, T>& at = *forces++;
    const L za = at.z[1], zb = at.z[2], zs = at.z[3], over = at.over;
    const SpaceDerivative<L> D =
        derivative<limited>(cones, c, L((za * za + zb * zb + zs * zs) * over), over, at.f[0]);
    const L da = za * over, db = zb * over, ds = zs * over * c.soft;
    // The columns of G for e_n and d.
    L g[6], h[6];
    for (int k = 0; k < 3; ++k) {
      g[k] = c.n[k];
      h[k] = da * c.a[k] + db * c.b[k];
    }
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      g[3 + k] = c.r[i] * g[j] - c.r[j] * g[i];
      h[3 + k] = c.r[i] * h[j] - c.r[j] * h[i] + ds * c.n[k];
    }
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) {
      const L left = D.nn * g[i] + D.nd * h[i], right = D.nd * g[i] + D.dd * h[i];
#pragma GCC unroll 6
      for (int j = i; j < 6; ++j) M[upper(i, j)] += left * g[j] + right * h[j];
    }
    // kappa G Gᵀ: forces F add kappa share (F + r x F) each, the moment about n adds to M's corner.
    const L weight = D.kappa * c.share, soft = D.kappa * c.soft * c.soft;
    const L r[3] = {weight * c.r[0], weight * c.r[1], weight * c.r[2]};
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      M[upper(k, k)] += weight;
      M[upper(i, 3 + j)] += r[k];
      M[upper(j, 3 + i)] -= r[k];
      M[upper(3 + k, 3 + k)] += r[i] * c.r[i] + r[j] * c.r[j] + soft * c.n[k] * c.n[k];
      const int first = i < j ? i : j, second = i < j ? j : i;
      M[upper(3 + first, 3 + second)] += soft * c.n[i] * c.n[j] - r[i] * c.r[j];
    }
  }
  const auto sums = sums_of(M);
  Square<3, T> result;
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i)
#pragma GCC unroll 6
    for (int j = i; j < 6; ++j) result(i, j) = sums[static_cast<std::size_t>(upper(i, j))];
  return result;
}

}  // namespace poise::dual
