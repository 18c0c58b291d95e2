// The dual of holding, maximised: docs/theory.md, "One posture". Not installed.
//
//   minimise ½|f|²  subject to  G f = w,  f in K        (K: the product of the friction cones)
//   maximise  yᵀw − φ(Gᵀy),  φ(z) = sup { zᵀf − ½|f|² : f in K },  attained at f = Π_K(z)
//
// Everything here is in the units of ScaledGrasp.
#pragma once

#include "poise/small_vector.hpp"
#include "scaled_grasp.hpp"

namespace poise::dual {

/// The balance tolerance: force / W and moment / (W L).
inline constexpr double delta = 1e-12;

template <int Dim>
using Square = Eigen::Matrix<double, wrench_size<Dim>, wrench_size<Dim>>;

/// z = Gᵀy and f = Π_K(z) of the contacts of one lane.
template <int Dim>
struct LaneForces {
  Lane z[Dim], f[Dim];
};

/// The dual function at y.
template <int Dim>
struct Point {
  explicit Point(std::size_t contacts) : lanes((contacts + lane_size - 1) / lane_size) {}

  Vector<Dim> z(std::size_t i) const { return at(i, lanes[i / lane_size].z); }
  Vector<Dim> f(std::size_t i) const { return at(i, lanes[i / lane_size].f); }

  Twist<Dim> y;
  SmallVector<LaneForces<Dim>, 16 / lane_size> lanes;
  double value;          ///< yᵀw − φ(Gᵀy): half a lower bound on the effort
  Wrench<Dim> residual;  ///< w − G f: the gradient

 private:
  static Vector<Dim> at(std::size_t i, const Lane (&lane)[Dim]) {
    Vector<Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = lane[k][i % lane_size];
    return v;
  }
};

/// The part of a contact's cone to which z projects: f = P z + f0 nearby.
/// The planar cone {(n, t): |t| <= mu n, lo <= n <= hi} is a trapezoid; z projects to its inside,
/// to an edge or to a corner.
struct Face {
  Eigen::Matrix2d P;
  Vector<2> f0;
  bool edge;          ///< of the friction cone: |t| = mu n
  bool at_lo, at_hi;  ///< at a limit of the normal force; the apex is edge and at_lo
  double sign;        ///< of the edge: t = sign mu n
};
/// The contact's columns of G, as the solver scales them.
Eigen::Matrix<double, 3, 2> columns(const ScaledGrasp<2>& grasp, std::size_t contact);
Face face(const ScaledGrasp<2>& grasp, std::size_t contact, const Vector<2>& z);

/// Evaluates the dual function of load w at y.
template <int Dim>
void evaluate(const ScaledGrasp<Dim>& grasp, const Wrench<Dim>& w, const Twist<Dim>& y,
              Point<Dim>& point);

/// 2 (value − delta (|v| + |omega|)): what any force that balances w within delta must cost.
template <int Dim>
double lower_bound(const Point<Dim>& point);

/// Where to start without a y of a load nearby.
template <int Dim>
Twist<Dim> cold_start(const ScaledGrasp<Dim>& grasp, const Wrench<Dim>& w);

/// Maximises from `start`. True: point.f is the hold of least effort, point.y its proof. False: it
/// cannot be held, lower_bound(point) > force_cap^2, by the y that tells w best from what can be
/// balanced.
template <int Dim>
bool maximise(const ScaledGrasp<Dim>& grasp, const Wrench<Dim>& w, const Twist<Dim>& start,
              double force_cap, Point<Dim>& point);

}  // namespace poise::dual
