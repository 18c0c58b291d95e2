// The dual of holding, maximised: docs/theory.md, "One posture". Not installed.
//
//   minimise ½|f|²  subject to  G f = w,  f in K        (K: the product of the friction cones)
//   maximise  yᵀw − φ(Gᵀy),  φ(z) = sup { zᵀf − ½|f|² : f in K },  attained at f = Π_K(z)
//
// Everything here is in the units of contact_lane.hpp.
#pragma once

#include <algorithm>

#include "dual/scaled_hand.hpp"
#include "dual/tolerances.hpp"
#include "poise/small_vector.hpp"

namespace poise::dual {

/// A hand with the unit of force: what is solved, but for the load.
template <int Dim>
struct Problem : Cones<Dim> {
  Problem(const ScaledHand<Dim>& of, double unit)
      : Cones<Dim>(of.cones(unit)), hand(of), weight(unit) {}
  const ScaledHand<Dim>& hand;
  double weight;  ///< [N]
};

/// The dual function at y.
template <int Dim, class T = double>
struct Point {
  static constexpr std::size_t lane = lane_size_of<T>;

  explicit Point(std::size_t contacts) : lanes((contacts + lane - 1) / lane) {}

  static constexpr int rows = contact_size<Dim>;
  Eigen::Matrix<T, rows, 1> z(std::size_t i) const { return at(i, lanes[i / lane].z); }
  Eigen::Matrix<T, rows, 1> f(std::size_t i) const { return at(i, lanes[i / lane].f); }

  Screw<Dim, T> y;
  SmallVector<LaneForces<Dim, T>, 16 / lane> lanes;
  T value;                 ///< yᵀw − φ(Gᵀy): half a lower bound on the effort
  Screw<Dim, T> residual;  ///< w − G f: the gradient

 private:
  static Eigen::Matrix<T, rows, 1> at(std::size_t i, const LaneOf<T> (&of)[rows]) {
    Eigen::Matrix<T, rows, 1> v;
    for (int k = 0; k < rows; ++k) v[k] = element(of[k], i % lane);
    return v;
  }
};

/// |f|^2: the effort.
template <int Dim, class T>
T squared_norm(const Point<Dim, T>& point) {
  LaneOf<T> sum_{};
  for (const LaneForces<Dim, T>& lane : point.lanes)
    for (int k = 0; k < contact_size<Dim>; ++k) sum_ += lane.f[k] * lane.f[k];
  return sum(sum_);
}

/// The larger of the force and the moment of a scaled wrench.
template <int Dim, class T>
T primal_norm(const Screw<Dim, T>& w) {
  return std::max<T>(w.template head<Dim>().norm(),
                     w.template tail<wrench_size<Dim> - Dim>().norm());
}

/// Dual to primal_norm: |v| + |omega|.
template <int Dim, class T>
T dual_norm(const Screw<Dim, T>& y) {
  return y.template head<Dim>().norm() + y.template tail<wrench_size<Dim> - Dim>().norm();
}

/// For comparisons: the cheapest.
template <class V>
auto l1_norm(const V& y) {
  return y.cwiseAbs().sum();
}

/// 2 (value − delta (|v| + |omega|)): what any force that balances w within delta must cost.
template <int Dim, class T>
T lower_bound(const Point<Dim, T>& point) {
  return 2 * (point.value - delta * dual_norm<Dim, T>(point.y));
}

/// Evaluates the dual function of load w at y.
template <int Dim, class T>
void evaluate(const Cones<Dim, T>& cones, const Screw<Dim, T>& w, const Screw<Dim, T>& y,
              Point<Dim, T>& point);

/// G DΠ_K Gᵀ, upper triangle: minus the generalised Hessian of the dual function.
template <int Dim, class T>
Square<Dim, T> curvature(const Cones<Dim, T>& cones, const Point<Dim, T>& point);

/// Whether the cold start is the end, too, but for rare cases.
inline bool in_closed_form(const Cones<2>& cones) { return cones.size == 2 && !cones.limited; }

/// Where to start without a y of a load nearby.
Twist<2> cold_start(const Problem<2>& problem, const Wrench<2>& w);
Twist<3> cold_start(const Problem<3>& problem, const Wrench<3>& w);

/// Maximises from `start`. True: point.f is the hold of least effort, point.y its proof. False: it
/// cannot be held, lower_bound(point) > force_cap^2, by the y that best separates w from what can
/// be balanced.
template <int Dim>
bool maximise(const Problem<Dim>& problem, const Wrench<Dim>& w, const Twist<Dim>& start,
              double force_cap, Point<Dim>& point);

/// The same as far as doubles come: true where point.f balances w but for their rounding. False:
/// point.y may prove that it cannot be held, or nothing.
bool approach(const Problem<3>& problem, const Wrench<3>& w, const Twist<3>& start,
              double force_cap, Point<3>& point);

/// The same in wider numbers, for where rounding of doubles leaves it open: True: point.f balances
/// w with at most the force cap. False: it cannot be held, and point.y tells w from what can be
/// balanced.
template <int Dim>
bool decide(const Cones<Dim, Wide>& cones, const Wrench<Dim>& w, double force_cap,
            Point<Dim, Wide>& point);

}  // namespace poise::dual
