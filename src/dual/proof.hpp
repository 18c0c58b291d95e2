// Proofs that a load cannot be held: y that go far in a direction along which the dual rises for
// ever. Not installed.
#pragma once

#include "dual/evaluate.hpp"

namespace poise::dual {

/// Whether it is a proof for those, too, who round G^T y otherwise.
template <int Dim, class T>
bool proves(const Cones<Dim, T>& cones, const Point<Dim, T>& far, double force_cap) {
  const T rounding = rounding_of<T> * dual_norm<Dim, T>(far.y);
  return lower_bound(far) - rounding * rounding * static_cast<double>(cones.size) >
         force_cap * force_cap;
}

enum class Rise { none, some, proof };

/// Goes from y along d, of length 1, as far as a proof that nothing holds needs: `far` is it, if it
/// is one. `reach` tells how fast the dual rises in the end.
template <int Dim, class T>
[[gnu::noinline]] Rise prove(const Cones<Dim, T>& cones, const Screw<Dim, T>& w,
                             const Screw<Dim, T>& y, const Screw<Dim, T>& d, double force_cap,
                             Point<Dim, T>& far, double reach = far_out<T>) {
  evaluate<Dim, T>(cones, w, T(reach) * d, far);
  const T rise = far.residual.dot(d) - delta;
  if (rise <= 0) return Rise::none;
  evaluate<Dim, T>(cones, w, y + 0.55 * force_cap * force_cap / rise * d, far);
  return proves(cones, far, force_cap) ? Rise::proof : Rise::some;
}

/// The same from 0, but tries a shorter reach where d is known to few digits: that proves more.
template <int Dim, class T>
bool prove_along(const Cones<Dim, T>& cones, const Screw<Dim, T>& w, const Screw<Dim, T>& way,
                 double force_cap, Point<Dim, T>& point) {
  const T norm = dual_norm<Dim, T>(way);
  if (!(norm > 0)) return false;
  const Screw<Dim, T> zero = Screw<Dim, T>::Zero(), d = way / norm;
  Point<Dim, T> far = point;
  for (double reach = far_out<T>; reach > force_cap; reach *= 1e-2) {
    if (prove<Dim, T>(cones, w, zero, d, force_cap, far, reach) != Rise::proof) continue;
    point = far;
    return true;
  }
  return false;
}

}  // namespace poise::dual
