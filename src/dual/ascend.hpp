// How the dual of holding is maximised, in any dimension and numbers of any type: what dual.cpp
// (the plane) and dual_space.cpp share. Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "dual/dual.hpp"

namespace poise::dual {

/// G DΠ_K Gᵀ, upper triangle: minus the generalised Hessian of the dual function.
template <class T>
Square<2, T> curvature(const Cones<2, T>& cones, const Point<2, T>& point);
template <class T>
Square<3, T> curvature(const Cones<3, T>& cones, const Point<3, T>& point);

/// x = M⁻¹ r for positive semidefinite M (upper triangle). Directions in which M vanishes get very
/// long steps, not none.
template <class T>
Screw<2, T> newton_step(const Square<2, T>& M, const Screw<2, T>& r);
template <class T>
Screw<3, T> newton_step(const Square<3, T>& M, const Screw<3, T>& r);

/// xᵀ M x for M given by its upper triangle.
template <class T>
T quadratic(const Square<2, T>& M, const Screw<2, T>& x);
template <class T>
T quadratic(const Square<3, T>& M, const Screw<3, T>& x);

/// Near the limit of friction |z| is about |f|², and Π_K(z) has lost digits. Gives the forces back
/// the digits that they have. False if Newton's method has not come near enough for that.
[[gnu::noinline]] bool polish(const Cones<2>& cones, const Wrench<2>& w, double tolerance,
                              Point<2>& point);
[[gnu::noinline]] bool polish(const Cones<3>& cones, const Wrench<3>& w, double tolerance,
                              Point<3>& point);

/// The same number for all contacts of a lane.
template <class T>
[[gnu::always_inline]] inline LaneOf<T> all(const T& x) {
  if constexpr (std::is_same_v<T, double>)
    return x - Lane{};
  else
    return x;
}

/// Of each element, without a branch.
template <class L>
[[gnu::always_inline]] inline L larger(const L& a, const L& b) {
  return a > b ? a : b;
}
template <class L>
[[gnu::always_inline]] inline L smaller(const L& a, const L& b) {
  return a < b ? a : b;
}
using LaneBits = long long __attribute__((vector_size(sizeof(Lane))));
inline constexpr long long sign_bit = std::numeric_limits<long long>::min();
[[gnu::always_inline]] inline Lane magnitude(const Lane& x) {
  return (Lane)((LaneBits)x & ~sign_bit);
}
inline Wide magnitude(const Wide& x) { return abs(x); }
/// x >= 0, where z is negative -x.
[[gnu::always_inline]] inline Lane with_sign_of(const Lane& z, const Lane& x) {
  return (Lane)(((LaneBits)z & sign_bit) | (LaneBits)x);
}
inline Wide with_sign_of(const Wide& z, const Wide& x) { return z < 0 ? -x : x; }

/// The distance from 1 to the next number.
template <class T>
constexpr double rounding_of = std::is_same_v<T, double> ? 2.2e-16 : 4.9e-32;

/// The larger of the force and the moment of a scaled wrench.
template <int Dim, class T>
T size(const Screw<Dim, T>& w) {
  return std::max<T>(w.template head<Dim>().norm(),
                     w.template tail<wrench_size<Dim> - Dim>().norm());
}

/// Dual to `size`: |v| + |omega|.
template <int Dim, class T>
T length(const Screw<Dim, T>& y) {
  return y.template head<Dim>().norm() + y.template tail<wrench_size<Dim> - Dim>().norm();
}

/// A length for comparisons.
template <class V>
auto span(const V& y) {
  return y.cwiseAbs().sum();
}

template <int Dim, class T>
T lower_bound(const Point<Dim, T>& point) {
  return 2 * (point.value - delta * length<Dim, T>(point.y));
}

enum class Rise { none, some, proof };

/// Goes from y along d, of length 1, as far as a proof that nothing holds needs: `far` is it, if it
/// is one.
template <int Dim, class T>
[[gnu::noinline]] Rise prove(const Cones<Dim, T>& cones, const Screw<Dim, T>& w,
                             const Screw<Dim, T>& y, const Screw<Dim, T>& d, double force_cap,
                             Point<Dim, T>& far) {
  // Far out, but not so far that rounding in G^T d makes itself felt as a force.
  evaluate<Dim, T>(cones, w, T(2e-3 / rounding_of<T>) * d, far);
  const T rise = far.residual.dot(d) - delta;
  if (rise <= 0) return Rise::none;
  evaluate<Dim, T>(cones, w, y + 0.55 * force_cap * force_cap / rise * d, far);
  // Others may round G^T y otherwise: then it must still be a proof.
  const T rounding = rounding_of<T> * length<Dim, T>(far.y);
  const T doubt = rounding * rounding * static_cast<double>(cones.size);
  return lower_bound(far) - doubt > force_cap * force_cap ? Rise::proof : Rise::some;
}

/// maximise() with a y of its own in the unholdable case: any that proves it. With rho > 0 it
/// maximises value − ½ rho |y|² instead, whose y is bounded: (w − G f) / rho. `rough`: without the
/// digits that polishing gives.
template <int Dim, class T>
bool ascend(const Cones<Dim, T>& cones, const Screw<Dim, T>& w, const Screw<Dim, T>& start,
            double force_cap, double rho, Point<Dim, T>& point,
            [[maybe_unused]] bool rough = false) {
  constexpr double rounding = rounding_of<T>;
  const double unholdable = force_cap * force_cap;
  const auto above_cap = [&] {
    return 2 * point.value > unholdable && lower_bound(point) > unholdable;
  };
  bool settled = false, unbounded = false;
  int cuts = 0;  // steps in a row that changing faces cut short
  const auto evaluate_at = [&](const Screw<Dim, T>& y) {
    evaluate<Dim, T>(cones, w, y, point);
    if (rho == 0) return;
    point.value -= rho / 2 * y.squaredNorm();
    point.residual -= T(rho) * y;
  };
  const auto curvature_here = [&] {
    Square<Dim, T> M = curvature(cones, point);
    if (rho > 0) M.diagonal().array() += T(rho);
    return M;
  };
  // Within the step dy from y stops where the slope vanishes, or in space has fallen by half on a
  // way that rises: it falls with a, in the plane piecewise linearly. Starts at its end, of which
  // it tells `slope_there`. Whether it cuts the step short.
  const auto stop_within = [&](const Screw<Dim, T>& y, const Screw<Dim, T>& dy, const T& before,
                               const T& slope, T& slope_there) {
    using std::abs;
    T least = 0, most = 1, a = 1;
    for (int trial = 1; trial < 60; ++trial) {
      if (abs(slope_there) <= (Dim == 2 ? 1e-9 : 1e-2) * slope ||
          (Dim == 3 && abs(slope_there) <= 0.5 * slope && point.value > before) ||
          most - least <= 4.5 * rounding * most)
        break;
      (slope_there > 0 ? least : most) = a;
      a += slope_there / quadratic(curvature_here(), dy);
      if (!(a > least && a < most)) a = (least + most) / 2;
      evaluate_at(y + a * dy);
      slope_there = point.residual.dot(dy);
    }
    return a < 1;
  };
  evaluate_at(start);
  // Where steps are cut short again and again, the next heeds the faces passed before: else
  // it zigzags between them near the limit of holding.
  Square<Dim, T> passed = Square<Dim, T>::Zero();
  T error = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 100; ++step) {
    [[maybe_unused]] const T last_error = error;
    error = point.residual.cwiseAbs().maxCoeff();
    const T distance = span(point.y);
    if (above_cap() || !(distance < 1e100)) return false;
    if (rho > 0 || !std::is_same_v<T, double>) {
      if (error <= 4500 * rounding + 45 * rounding * distance)
        return rho > 0 || size<Dim, T>(point.residual) <= 0.5 * delta;
    } else if constexpr (std::is_same_v<T, double>) {
      // In space there are no faces to polish on cheaply, so less has to do.
      constexpr double near = Dim == 2 ? 1e-13 : 0.5 * delta, off = Dim == 2 ? 1e-12 : 1e-11;
      if (error <= near && std::abs(point.y.dot(point.residual)) <= off * std::abs(point.value))
        return true;
      const bool stalled = Dim == 2 || error > 0.1 * last_error;
      if (((settled && stalled) || error <= delta / 2 + 1e-14 * distance) &&
          (rough || polish(cones, w, 1e-13, point)))
        return !above_cap();
      if (unbounded && error <= 0.5 * delta) return true;
    }

    Square<Dim, T> M = curvature_here();
    if (cuts > 1) M += T(0.5) * passed;
    Screw<Dim, T> dy = newton_step(M, point.residual);
    const T reach = (step < 4 ? 3 : 100) * (1 + distance), stretch = span(dy);
    if (stretch > reach) {
      M.diagonal().array() += point.residual.norm() / reach;
      dy = newton_step(M, point.residual);
    }
    const T before = point.value, slope = point.residual.dot(dy);
    const Screw<Dim, T> y = point.y;
    using std::abs;
    if constexpr (!std::is_same_v<T, double>) {
      // Near the apex of a round cone the way up is bent: a part of the step, and a correction
      // across it.
      bool rises = false;
      for (T part = 1; part > 1e-3 && !rises; part *= 0.25) {
        const T enough = before + 0.1 * part * slope;
        evaluate_at(y + part * dy);
        for (int k = 0; k < 2 && point.value < enough; ++k) {
          Square<Dim, T> across = curvature_here();
          across.diagonal().array() += 30 * slope / dy.squaredNorm();
          evaluate_at(point.y + newton_step(across, point.residual));
        }
        rises = point.value >= enough;
      }
      if (rises) continue;
    }
    evaluate_at(y + dy);
    T slope_there = point.residual.dot(dy);
    // The full step will do if it rises as it should, or by less than rounding shows.
    const bool cut = !(point.value - before >= 0.1 * slope) && slope > 4 * rounding * abs(before) &&
                     stop_within(y, dy, before, slope, slope_there);
    settled = !cut && abs(slope_there) <= 1e-6 * slope;
    // Still rising where every step is long: does it rise for ever?
    if (rho == 0 && stretch > reach && slope_there > 0.5 * slope) {
      Point<Dim, T> far = point;
      const T one = length<Dim, T>(dy);
      const Rise rise = prove<Dim, T>(cones, w, point.y, dy / one, force_cap, far);
      if (rise == Rise::proof) {
        point = far;
        return false;
      }
      unbounded = rise == Rise::none;
    }
    cuts = cut ? cuts + 1 : 0;
    if (cuts > 1) passed = M;
  }
  return size<Dim, T>(point.residual) <= 0.5 * delta;
}

#ifdef __x86_64__
template <int Dim>
[[gnu::target("avx2,fma"), gnu::flatten]] bool climb_by_avx2(const Cones<Dim>& cones,
                                                             const Wrench<Dim>& w,
                                                             const Twist<Dim>& start,
                                                             double force_cap, double rho,
                                                             Point<Dim>& point, bool rough) {
  return ascend<Dim, double>(cones, w, start, force_cap, rho, point, rough);
}
#endif

/// ascend() in doubles, with the SIMD instructions that this machine has.
template <int Dim>
bool climb(const Cones<Dim>& cones, const Wrench<Dim>& w, const Twist<Dim>& start, double force_cap,
           double rho, Point<Dim>& point, bool rough = false) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return climb_by_avx2<Dim>(cones, w, start, force_cap, rho, point, rough);
#endif
  return ascend<Dim, double>(cones, w, start, force_cap, rho, point, rough);
}

}  // namespace poise::dual
