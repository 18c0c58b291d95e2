// The dual of holding, maximised: docs/theory.md, "One posture". Not installed.
//
//   minimise ½|f|²  subject to  G f = w,  f in K        (K: the product of the friction cones)
//   maximise  yᵀw − φ(Gᵀy),  φ(z) = sup { zᵀf − ½|f|² : f in K },  attained at f = Π_K(z)
//
// Everything here is in the units of Hand::Scaled.
#pragma once

#include "poise/small_vector.hpp"
#include "dual/scaled_hand.hpp"

namespace poise::dual {

/// The balance tolerance: force / W and moment / (W L).
inline constexpr double delta = 1e-12;

/// A hand with the unit of force: what is solved, but for the load.
template <int Dim>
struct Problem : Cones<Dim> {
  Problem(const ScaledHand<Dim>& of, double unit)
      : Cones<Dim>(of.cones(unit)), hand(of), weight(unit) {}
  const ScaledHand<Dim>& hand;
  double weight;  ///< [N]
};

/// A wrench or a twist: a screw.
template <int Dim, class T>
using Screw = Eigen::Matrix<T, wrench_size<Dim>, 1>;
template <int Dim, class T>
using Square = Eigen::Matrix<T, wrench_size<Dim>, wrench_size<Dim>>;

/// z = Gᵀy and f = Π_K(z) of the contacts of one lane.
template <int Dim, class T>
struct LaneForces;

template <class T>
struct alignas(sizeof(LaneOf<T>)) LaneForces<2, T> {
  LaneOf<T> z[2], f[2];
};

template <class T>
struct alignas(sizeof(LaneOf<T>)) LaneForces<3, T> {
  LaneOf<T> z[4], f[4];
  LaneOf<T> over;  ///< 1 / |z's tangential part|, or any number where that is 0
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

/// The part of a contact's cone to which z projects: f = P z + f0 nearby.
/// The planar cone {(n, t): |t| <= mu n, lo <= n <= hi} is a trapezoid; z projects to its inside,
/// to an edge or to a corner.
template <class T = double>
struct Face {
  Eigen::Matrix<T, 2, 2> P;
  Eigen::Matrix<T, 2, 1> f0;
  bool edge;          ///< of the friction cone: |t| = mu n
  bool at_lo, at_hi;  ///< at a limit of the normal force; the apex is edge and at_lo
  double sign;        ///< of the edge: t = sign mu n
};
/// The contact's columns of G, as the solver scales them.
template <class T>
Eigen::Matrix<T, 3, 2> columns(const Cones<2, T>& cones, std::size_t contact);
/// edge: 1 / (1 + mu^2).
template <class T>
Face<T> face(const T& mu, const T& edge, const T& lo, const T& hi, const Eigen::Matrix<T, 2, 1>& z);
template <class T>
Face<T> face(const Cones<2, T>& cones, std::size_t contact, const Eigen::Matrix<T, 2, 1>& z) {
  const ContactLane<2, T>& c = cones.lanes[contact / lane_size_of<T>];
  const std::size_t k = contact % lane_size_of<T>;
  return face<T>(element(c.mu, k), element(c.edge, k), cones.scaled(element(c.lo, k)),
                 cones.scaled(element(c.hi, k)), z);
}

/// Evaluates the dual function of load w at y.
template <int Dim, class T>
void evaluate(const Cones<Dim, T>& cones, const Screw<Dim, T>& w, const Screw<Dim, T>& y,
              Point<Dim, T>& point);

template <>
void evaluate(const Cones<3>& cones, const Wrench<3>& w, const Twist<3>& y, Point<3>& point);
template <>
void evaluate(const Cones<3, Wide>& cones, const Screw<3, Wide>& w, const Screw<3, Wide>& y,
              Point<3, Wide>& point);

/// 2 (value − delta (|v| + |omega|)): what any force that balances w within delta must cost.
template <int Dim, class T>
T lower_bound(const Point<Dim, T>& point);

/// Whether the cold start is the end, too, but for rare cases.
inline bool in_closed_form(const Cones<2>& cones) { return cones.size == 2 && !cones.limited; }

/// Where to start without a y of a load nearby.
template <int Dim>
Twist<Dim> cold_start(const Problem<Dim>& problem, const Wrench<Dim>& w);
template <>
Twist<2> cold_start(const Problem<2>& problem, const Wrench<2>& w);
template <>
Twist<3> cold_start(const Problem<3>& problem, const Wrench<3>& w);

/// Maximises from `start`. True: point.f is the hold of least effort, point.y its proof. False: it
/// cannot be held, lower_bound(point) > force_cap^2, by the y that tells w best from what can be
/// balanced.
template <int Dim>
bool maximise(const Problem<Dim>& problem, const Wrench<Dim>& w, const Twist<Dim>& start,
              double force_cap, Point<Dim>& point);
template <>
bool maximise(const Problem<2>& problem, const Wrench<2>& w, const Twist<2>& start,
              double force_cap, Point<2>& point);
template <>
bool maximise(const Problem<3>& problem, const Wrench<3>& w, const Twist<3>& start,
              double force_cap, Point<3>& point);

/// The same as far as doubles come: true where point.f balances w but for their rounding. False:
/// point.y may prove that it cannot be held, or nothing.
bool approach(const Problem<3>& problem, const Wrench<3>& w, const Twist<3>& start,
              double force_cap, Point<3>& point);

/// The same in wider numbers, for where rounding of doubles leaves it open: True: point.f balances
/// w with at most the force cap. False: it cannot be held, and point.y tells w from what can be
/// balanced.
bool decide(const Cones<2, Wide>& cones, const Wrench<2>& w, double force_cap,
            Point<2, Wide>& point);

}  // namespace poise::dual
