// The grasp as the solver sees it. Not installed.
//
// Forces in weights W, lengths in radii L, moments about the centre of mass, and the force of a
// contact divided by sqrt(share), so that the effort is |f|^2 and the share appears nowhere else.
#pragma once

#include <type_traits>
#include <vector>

#include "poise/grasp.hpp"
#include "poise/small_vector.hpp"
#include "wide.hpp"

namespace poise {

/// Contacts are dealt with in lanes: of doubles two at a time, what GCC and Clang turn into SIMD
/// instructions on every machine; of other numbers one.
using Lane = double __attribute__((vector_size(16)));
template <class T>
using LaneOf = std::conditional_t<std::is_same_v<T, double>, Lane, T>;
template <class T>
inline constexpr std::size_t lane_size_of = std::is_same_v<T, double> ? 2 : 1;
inline constexpr std::size_t lane_size = lane_size_of<double>;

/// Element k of a lane.
inline double element(const Lane& lane, std::size_t k) { return lane[k]; }
template <class T>
T element(const T& lane, std::size_t /*only one*/) {
  return lane;
}

/// As many contacts as a lane holds; an odd last one is filled up by a contact that carries
/// nothing.
template <int Dim, class T = double>
struct ContactLane;

template <class T>
struct ContactLane<2, T> {
  LaneOf<T> nx, ny;  ///< inward normal, times sqrt(share)
  LaneOf<T> jx, jy;  ///< velocity of the contact point: the object turns about the com at 1 rad/s
  LaneOf<T> share;
  LaneOf<T> mu, edge;  ///< friction; 1 / (1 + mu^2), squared normal part of the cone's unit edge
  LaneOf<T> lo, hi;    ///< limits of the normal force
  LaneOf<T> unit;      ///< of its forces: W sqrt(share) [N]
};

/// In space the friction cone is round in (t1, t2, m / gamma'), with gamma' = gamma / (mu L).
template <class T>
struct ContactLane<3, T> {
  LaneOf<T> n[3], a[3], b[3];  ///< inward normal and tangents, times sqrt(share)
  LaneOf<T> r[3];              ///< from the com to the contact
  LaneOf<T> soft;              ///< gamma'; 0 for a hard finger
  LaneOf<T> share;
  LaneOf<T> mu, edge;  ///< as in the plane
  LaneOf<T> lo, hi;
  LaneOf<T> unit;
};

/// The contacts, in numbers of type T: the grasp matrix and the friction cones.
template <int Dim, class T = double>
struct Cones {
  std::size_t size;     ///< contacts
  bool limited{false};  ///< whether any contact has a force limit
  SmallVector<ContactLane<Dim, T>, 16 / lane_size_of<T>> lanes;
};

/// Two contacts in the plane have one internal force, along the line between them: how far it goes
/// until mu n - t (first) or mu n + t of a contact vanishes.
struct InternalForce {
  Lane per_margin[2];  ///< 1 / the rate at which it grows; 0 where it stays
  double square;       ///< of its length
};

template <int Dim>
struct ScaledGrasp : Cones<Dim> {
  explicit ScaledGrasp(const Grasp<Dim>& grasp);

  double length;      ///< L [m], or 1 where every contact is at the centre of mass
  double per_weight;  ///< 1 / W [1/N]
  /// Pseudo-inverse of G G^T: the dual of a load while no contact is at the border of its cone.
  Eigen::Matrix<double, wrench_size<Dim>, wrench_size<Dim>> inverse;
  InternalForce internal{};  ///< of two contacts in the plane
  /// Twists that no contact feels, an orthonormal basis: two hard fingers leave one in space.
  std::vector<Twist<Dim>> unfelt;
};

/// The same contacts in wider numbers.
Cones<2, Wide> widened(const Cones<2>& cones);
Cones<3, Wide> widened(const Cones<3>& cones);

}  // namespace poise
