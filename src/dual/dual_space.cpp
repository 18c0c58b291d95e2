// The dual of holding in space: docs/theory.md, "Space".
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "dual/ascend.hpp"

namespace poise::dual {
namespace {

[[gnu::always_inline]] inline Lane root(Lane x) {
  for (std::size_t k = 0; k < lane_size; ++k) x[k] = std::sqrt(x[k]);
  return x;
}
Wide root(const Wide& x) { return sqrt(x); }

/// 1 / |z's tangential part|, or any number where that is 0.
template <class L>
[[gnu::always_inline]] inline L inverse_length(const L& squared) {
  const L tiny = L{} + 1e-280;
  return 1.0 / root(squared > tiny ? squared : tiny);
}
Wide inverse_length(const Wide& squared) {
  return 1 / root(squared > 1e-280 ? squared : Wide(1e-280));
}

/// Projects every contact's z = (normal, three that are round) and adds up, without a branch: in
/// the half-plane of the normal and z's tangential part this is the projection of the plane.
template <bool limited, class T>
void evaluate_space(const Cones<3, T>& cones, const Screw<3, T>& w, const Screw<3, T>& y,
                    Point<3, T>& point) {
  using L = LaneOf<T>;
  const L zero{}, one = all(T(1)), half = all(T(0.5));
  const L vx = all(y[0]), vy = all(y[1]), vz = all(y[2]);
  const L ox = all(y[3]), oy = all(y[4]), oz = all(y[5]);
  L fx{}, fy{}, fz{}, mx{}, my{}, mz{}, phi{};
  for (std::size_t p = 0; p < cones.lanes.size(); ++p) {
    const ContactLane<3, T>& c = cones.lanes[p];
    const L ux = vx + (oy * c.r[2] - oz * c.r[1]), uy = vy + (oz * c.r[0] - ox * c.r[2]),
            uz = vz + (ox * c.r[1] - oy * c.r[0]);
    const L zn = c.n[0] * ux + c.n[1] * uy + c.n[2] * uz;
    const L za = c.a[0] * ux + c.a[1] * uy + c.a[2] * uz;
    const L zb = c.b[0] * ux + c.b[1] * uy + c.b[2] * uz;
    const L zs = c.soft * (c.n[0] * ox + c.n[1] * oy + c.n[2] * oz);
    const L squared = za * za + zb * zb + zs * zs, over = inverse_length(squared);
    const L beside = squared * over;
    const L along = (zn + c.mu * beside) * c.edge;
    L within = zn;
    L lo{}, hi{};
    if constexpr (limited) {
      lo = cones.scaled(c.lo);
      hi = cones.scaled(c.hi);
      within = zn < lo ? lo : zn > hi ? hi : zn;
    }
    const auto inside = beside < c.mu * within;
    L n = inside ? zn : along;
    if constexpr (limited)
      n = n < lo ? lo : n > hi ? hi : n;
    else
      n = n > zero ? n : zero;
    const L kept = inside ? one : c.mu * n * over;  // of the tangential part
    const L fa = kept * za, fb = kept * zb, fs = kept * zs;
    point.lanes[p] = {{zn, za, zb, zs}, {n, fa, fb, fs}, over};
    const L gx = n * c.n[0] + fa * c.a[0] + fb * c.b[0];
    const L gy = n * c.n[1] + fa * c.a[1] + fb * c.b[1];
    const L gz = n * c.n[2] + fa * c.a[2] + fb * c.b[2];
    const L moment = c.soft * fs;
    fx += gx;
    fy += gy;
    fz += gz;
    mx += c.r[1] * gz - c.r[2] * gy + moment * c.n[0];
    my += c.r[2] * gx - c.r[0] * gz + moment * c.n[1];
    mz += c.r[0] * gy - c.r[1] * gx + moment * c.n[2];
    phi += n * (zn - half * n) + kept * (one - half * kept) * squared;
  }
  const L all_sums[8] = {fx, fy, fz, mx, my, mz, phi, zero};
  const auto sums = sums_of(all_sums);
  point.y = y;
  for (int k = 0; k < 6; ++k) point.residual[k] = w[k] - sums[static_cast<std::size_t>(k)];
  point.value = y.dot(w) - sums[6];
}

/// DΠ of a contact is kappa I + [e_n d] S [e_n d]ᵀ, with d the direction of z's tangential part:
/// inside kappa = 1; beside the cone kappa = |t| / |z_t|, the curvature of the round cone, and
/// along its edge 1.
template <bool limited, class T>
Square<3, T> curvature_space(const Cones<3, T>& cones, const Point<3, T>& point) {
  using L = LaneOf<T>;
  const L zero{}, one = all(T(1));
  L sums[24] = {};  // the upper triangle, row by row
  for (std::size_t p = 0; p < cones.lanes.size(); ++p) {
    const ContactLane<3, T>& c = cones.lanes[p];
    const LaneForces<3, T>& at = point.lanes[p];
    const L za = at.z[1], zb = at.z[2], zs = at.z[3], n = at.f[0];
    const L over = at.over, most = c.mu * n;
    const auto inside = (za * za + zb * zb + zs * zs) * over < most;
    L free = n > zero ? one : zero;  // neither at its least nor at its greatest
    if constexpr (limited)
      free = n > cones.scaled(c.lo) ? (n < cones.scaled(c.hi) ? one : zero) : zero;
    const L kappa = inside ? one : most * over;
    const L edge = free * c.edge;
    L nn = edge - kappa, nd = edge * c.mu, dd = edge * c.mu * c.mu - kappa;
    nn = inside ? (limited ? free - one : zero) : nn;
    nd = inside ? zero : nd;
    dd = inside ? zero : dd;
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
    int at_sum = 0;
#pragma GCC unroll 6
    for (int row = 0; row < 6; ++row) {
      const L left = nn * g[row] + nd * h[row], right = nd * g[row] + dd * h[row];
#pragma GCC unroll 6
      for (int column = row; column < 6; ++column)
        sums[at_sum++] += left * g[column] + right * h[column];
    }
    // kappa G Gᵀ.
    const L weight = kappa * c.share, soft = kappa * c.soft * c.soft;
    const L wx = weight * c.r[0], wy = weight * c.r[1], wz = weight * c.r[2];
    const L sx = soft * c.n[0], sy = soft * c.n[1];
    sums[0] += weight;
    sums[6] += weight;
    sums[11] += weight;
    sums[4] += wz;
    sums[5] -= wy;
    sums[8] -= wz;
    sums[10] += wx;
    sums[12] += wy;
    sums[13] -= wx;
    sums[15] += wy * c.r[1] + wz * c.r[2] + sx * c.n[0];
    sums[16] += sx * c.n[1] - wx * c.r[1];
    sums[17] += sx * c.n[2] - wx * c.r[2];
    sums[18] += wx * c.r[0] + wz * c.r[2] + sy * c.n[1];
    sums[19] += sy * c.n[2] - wy * c.r[2];
    sums[20] += wx * c.r[0] + wy * c.r[1] + soft * c.n[2] * c.n[2];
  }
  const auto of_all = sums_of(sums);
  Square<3, T> M;
  std::size_t at_sum = 0;
#pragma GCC unroll 6
  for (int row = 0; row < 6; ++row)
#pragma GCC unroll 6
    for (int column = row; column < 6; ++column) M(row, column) = of_all[at_sum++];
  return M;
}

template <class T>
void evaluate_any(const Cones<3, T>& cones, const Screw<3, T>& w, const Screw<3, T>& y,
                  Point<3, T>& point) {
  if (cones.limited)
    evaluate_space<true>(cones, w, y, point);
  else
    evaluate_space<false>(cones, w, y, point);
}

/// The wide point's forces, rounded, with the error of their balance.
void round_to(const Cones<3>& cones, const Wrench<3>& w, const Point<3, Wide>& wide,
              Point<3>& point) {
  point.y = wide.y.cast<double>();
  point.residual = w;
  for (std::size_t i = 0; i < cones.size; ++i) {
    LaneForces<3, double>& lane = point.lanes[i / lane_size];
    const ContactLane<3>& c = cones.lanes[i / lane_size];
    const std::size_t k = i % lane_size;
    const Eigen::Vector4d f = wide.f(i).cast<double>(), z = wide.z(i).cast<double>();
    Vector<3> force, moment, r;
    for (int d = 0; d < 4; ++d) {
      lane.f[d][k] = f[d];
      lane.z[d][k] = z[d];
    }
    for (int d = 0; d < 3; ++d) {
      force[d] = f[0] * c.n[d][k] + f[1] * c.a[d][k] + f[2] * c.b[d][k];
      moment[d] = c.soft[k] * f[3] * c.n[d][k];
      r[d] = c.r[d][k];
    }
    point.residual.head<3>() -= force;
    point.residual.tail<3>() -= r.cross(force) + moment;
  }
  // The reported y is the rounded one, and so is its proof.
  Point<3, Wide> proof(cones.size);
  evaluate<3, Wide>(Widened<3>(cones).cones(), w.cast<Wide>(), point.y.cast<Wide>(), proof);
  point.value = static_cast<double>(proof.value);
}

/// Newton's method alone, from where it converges at once. False if it does not.
bool finish(const Cones<3, Wide>& cones, const Screw<3, Wide>& w, Point<3, Wide>& point) {
  evaluate<3, Wide>(cones, w, Screw<3, Wide>(point.y), point);
  Wide error = span(point.residual);
  for (int step = 0; step < 12; ++step) {
    if (error <= 1e-22 + 1e-29 * span(point.y)) return error <= 0.1 * delta;
    const Screw<3, Wide> y = point.y + newton_step(curvature(cones, point), point.residual);
    evaluate<3, Wide>(cones, w, y, point);
    const Wide before = error;
    error = span(point.residual);
    if (!(error <= 0.5 * before)) return error <= 1e-19;
  }
  return error <= 1e-19;
}

/// The same as prove() from 0, as far as is best: where d is known to few digits, less far proves
/// more.
template <class T>
bool prove_along(const Cones<3, T>& cones, const Screw<3, T>& w, const Screw<3, T>& d,
                 double force_cap, Point<3, T>& point) {
  Point<3, T> far = point;
  const double cap = force_cap * force_cap;
  for (double reach = 2e-3 / rounding_of<T>; reach > force_cap; reach *= 1e-2) {
    evaluate<3, T>(cones, w, T(reach) * d, far);
    const T rise = far.residual.dot(d) - delta;
    if (rise <= 0) continue;
    evaluate<3, T>(cones, w, T(0.55 * cap / rise) * d, far);
    const T rounding = rounding_of<T> * length<3, T>(far.y);
    if (!(lower_bound(far) - rounding * rounding * static_cast<double>(cones.size) > cap)) continue;
    point = far;
    return true;
  }
  return false;
}

/// maximise() in wide numbers: for where rounding of doubles leaves it open.
bool decide(const Cones<3, Wide>& cones, const Screw<3, Wide>& w, double force_cap,
            Point<3, Wide>& point) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double cap = force_cap * force_cap;
  point.y.setZero();
  Wide last = infinity;
  // A pull towards y = 0 that fades away: y is bounded whether w can be held or not.
  for (double rho = 1e-6; rho > 1e-25;) {
    const Screw<3, Wide> before = point.y;
    ascend<3, Wide>(cones, w, before, infinity, rho, point);
    point.residual += Wide(rho) * point.y;
    point.value += rho / 2 * point.y.squaredNorm();
    const Wide missing = size<3, Wide>(point.residual);
    if (missing <= 0.95 * delta) {
      Point<3, Wide> finished = point;
      if (finish(cones, w, finished)) point = finished;
      return squared_norm(point) <= cap;
    }
    if (lower_bound(point) > cap) return false;
    // What does not shrink is the distance of w from what can be balanced: y grows along it.
    if (missing > 0.9 * last) {
      const Screw<3, Wide> y = point.y;
      for (const Screw<3, Wide>& way : {Screw<3, Wide>(y - before), y})
        if (prove_along(cones, w, Screw<3, Wide>(way / length<3, Wide>(way)), force_cap, point))
          return false;
    }
    rho *= std::clamp(static_cast<double>(0.5 * delta / missing), 1e-3, 0.1);
    last = missing;
  }
  // The dual rises ever more slowly, but above the cap: held only with ever greater forces.
  if (ascend<3, Wide>(cones, w, Screw<3, Wide>(point.y), force_cap, 0, point))
    return squared_norm(point) <= cap;
  return false;
}

}  // namespace

template <>
void evaluate(const Cones<3>& cones, const Wrench<3>& w, const Twist<3>& y, Point<3>& point) {
  evaluate_any(cones, w, y, point);
}

template <>
void evaluate(const Cones<3, Wide>& cones, const Screw<3, Wide>& w, const Screw<3, Wide>& y,
              Point<3, Wide>& point) {
  evaluate_any(cones, w, y, point);
}

template <class T>
Square<3, T> curvature(const Cones<3, T>& cones, const Point<3, T>& point) {
  return cones.limited ? curvature_space<true>(cones, point) : curvature_space<false>(cones, point);
}

/// By M = LDLᵀ. A pivot is known to within rounding of its own diagonal entry.
template <class T>
Screw<3, T> newton_step(const Square<3, T>& M, const Screw<3, T>& r) {
  constexpr double rounding = 4.5 * rounding_of<T>, least = rounding * rounding;
  T A[6][7], over[6];  // what is left of M and r, row by row
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
#pragma GCC unroll 6
    for (int j = i; j < 6; ++j) A[i][j] = M(i, j);
    A[i][6] = r[i];
  }
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    const T pivot = std::max<T>(A[j][j], rounding * M(j, j) + least);
    over[j] = 1 / pivot;
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) {
      const T part = A[j][i] * over[j];
#pragma GCC unroll 7
      for (int k = i; k < 7; ++k) A[i][k] -= part * A[j][k];
    }
  }
  Screw<3, T> x;
#pragma GCC unroll 6
  for (int j = 5; j >= 0; --j) {
    T sum = A[j][6];  // the newest x is needed last
#pragma GCC unroll 6
    for (int k = 5; k > j; --k) sum -= A[j][k] * x[k];
    x[j] = sum * over[j];
  }
  return x;
}

template <class T>
T quadratic(const Square<3, T>& M, const Screw<3, T>& x) {
  T all_rows = 0;
  for (int i = 0; i < 6; ++i) {
    T row = T(0.5) * M(i, i) * x[i];
    for (int j = i + 1; j < 6; ++j) row += M(i, j) * x[j];
    all_rows += 2 * x[i] * row;
  }
  return all_rows;
}

/// A few steps in wide numbers.
bool polish(const Cones<3>& cones, const Wrench<3>& w, double /*tolerance*/, Point<3>& point) {
  const Widened<3> wide_cones(cones);
  Point<3, Wide> wide(cones.size);
  wide.y = point.y.cast<Wide>();
  if (!finish(wide_cones.cones(), w.cast<Wide>(), wide)) return false;
  round_to(cones, w, wide, point);
  return true;
}

template <>
Twist<3> cold_start<3>(const Problem<3>& problem, const Wrench<3>& w) {
  return problem.hand.inverse * w;
}

namespace {

/// Towards point.y from what can be balanced to w, as a proof that nothing holds.
bool sharpen(const Problem<3>& problem, const Wrench<3>& w, double force_cap, Point<3>& point) {
  // A weak pull towards y = 0 gives the direction, but for what else y has to do. A pull that is
  // ten times weaker makes only the direction ten times longer.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point<3> pulled(problem.size);
  climb<3>(problem, w, Twist<3>::Zero(), infinity, 1e-7, pulled);
  const Twist<3> first = pulled.y;
  climb<3>(problem, w, Twist<3>(10 * first), infinity, 1e-8, pulled);
  for (const Twist<3>& y : {Twist<3>(pulled.y - first), pulled.y}) {
    const double all_of_it = length<3, double>(y);
    if (!(all_of_it > 0) || !prove_along<double>(problem, w, y / all_of_it, force_cap, pulled))
      continue;
    point = pulled;
    return true;
  }
  return false;
}

/// A proof that a neighbour cannot be held is too long to start from.
Twist<3> start_from(const Problem<3>& problem, const Wrench<3>& w, const Twist<3>& start) {
  return span(start) < 1e8 ? start : cold_start<3>(problem, w);
}

}  // namespace

bool approach(const Problem<3>& problem, const Wrench<3>& w, const Twist<3>& start,
              double force_cap, Point<3>& point) {
  if (climb<3>(problem, w, start_from(problem, w, start), force_cap, 0, point, true)) {
    if (span(point.y) < 1e4 * (1 + point.value)) return true;
    // Rounding of a load at the border of what can be held may ask for a very long y.
    constexpr double rho = 1e-13;
    Point<3> pulled(problem.size);
    climb<3>(problem, w, cold_start<3>(problem, w), std::numeric_limits<double>::infinity(), rho,
             pulled);
    pulled.residual += rho * pulled.y;
    if (size<3, double>(pulled.residual) <= 0.4 * delta) {
      pulled.value =
          pulled.y.dot(w) - pulled.y.dot(w - pulled.residual) + 0.5 * squared_norm(pulled);
      point = pulled;
    }
    return true;
  }
  sharpen(problem, w, force_cap, point);
  return false;
}

template <>
bool maximise<3>(const Problem<3>& problem, const Wrench<3>& w, const Twist<3>& start,
                 double force_cap, Point<3>& point) {
  if (climb<3>(problem, w, start_from(problem, w, start), force_cap, 0, point)) return true;
  if (sharpen(problem, w, force_cap, point)) return false;
  if (lower_bound(point) > force_cap * force_cap) return false;
  Point<3, Wide> wide(problem.size);
  const bool holdable = decide(Widened<3>(problem).cones(), w.cast<Wide>(), force_cap, wide);
  if (holdable)
    round_to(problem, w, wide, point);
  else
    evaluate<3, double>(problem, w, wide.y.cast<double>(), point);
  return holdable;
}

template double lower_bound(const Point<3>&);
template Square<3, double> curvature(const Cones<3>&, const Point<3>&);
template Twist<3> newton_step(const Square<3, double>&, const Twist<3>&);

}  // namespace poise::dual
