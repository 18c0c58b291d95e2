// The formula on which every proof rests, (2) of docs/theory.md, from the contacts themselves and
// in more digits than the solver has: a long y is worth less than its rounding. Not installed.
#pragma once

#include <algorithm>

#include "dual/cone_plane.hpp"
#include "dual/cone_space.hpp"
#include "poise/grasp.hpp"

namespace poise::dual {

using Exact = long double;

/// The velocity of a point of the object under a twist about its frame's origin.
template <int Dim>
Eigen::Matrix<Exact, Dim, 1> velocity(const Twist<Dim>& y, const Vector<Dim>& point) {
  Eigen::Matrix<Exact, Dim, 1> v = y.template head<Dim>().template cast<Exact>();
  const Eigen::Matrix<Exact, Dim, 1> r = point.template cast<Exact>();
  if constexpr (Dim == 2)
    v += Exact{y[2]} * Eigen::Matrix<Exact, 2, 1>(-r.y(), r.x());
  else
    v += y.template tail<3>().template cast<Exact>().cross(r);
  return v;
}

/// phi(G^T y), with all frictions and torsions multiplied by a factor: of each contact the greatest
/// z . f - |f|^2 / (2 share).
template <int Dim>
Exact phi(const Hand<Dim>& hand, const Twist<Dim>& y, double friction_factor = 1) {
  Exact sum = 0;
  for (const Contact<Dim>& contact : hand.contacts()) {
    const Slide<Exact> z = slide<Exact>(contact, y);
    const Exact mu = Exact{contact.friction} * friction_factor, share = contact.share;
    // Where z is inside the cone, its projection to the edge presses less.
    const Exact edge = (z.normal + mu * z.beside) / (1 + mu * mu);
    const Exact n =
        std::clamp<Exact>(share * std::max(z.normal, edge), contact.min_normal, contact.max_normal);
    const Exact t = std::min(share * z.beside, mu * n);
    sum += n * z.normal + t * z.beside - (n * n + t * t) / (2 * share);
  }
  return sum;
}

/// What y proves of the effort in the posture `up`: 2 (y . w - phi(G^T y)) [N^2].
template <int Dim>
Exact bound(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
            const Twist<Dim>& y, double friction_factor) {
  const Exact power = load.weight * velocity<Dim>(y, load.com).dot(up.template cast<Exact>()) +
                      y.template cast<Exact>().dot(load.fixed.template cast<Exact>());
  return 2 * (power - phi(hand, y, friction_factor));
}

}  // namespace poise::dual
