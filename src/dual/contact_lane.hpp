// Contacts as the solver sees them, a lane of them at a time. Not installed.
//
// Forces in weights W of the load, lengths in radii L, moments about the hand's center, and the
// force of a contact divided by sqrt(share), so that the effort is |f|^2 and the share appears
// nowhere else. Limits of force are in newtons; Cones has 1 / W.
#pragma once

#include <span>

#include "dual/lane.hpp"
#include "poise/contact.hpp"

namespace poise {

/// As many contacts as a lane holds; an odd last one is filled up by a contact that carries
/// nothing. Aligned for what works on all of a lane at once.
template <int Dim, class T = double>
struct ContactLane;

template <class T>
struct alignas(sizeof(LaneOf<T>)) ContactLane<2, T> {
  LaneOf<T> nx, ny;  ///< inward normal, times sqrt(share)
  LaneOf<T> jx,
      jy;  ///< velocity of the contact point: the object turns about the center at 1 rad/s
  LaneOf<T> share, root;  ///< and sqrt(share)
  LaneOf<T> mu, edge;     ///< friction; 1 / (1 + mu^2), squared normal part of the cone's unit edge
  LaneOf<T> lo, hi;       ///< limits of the normal force, over sqrt(share) [N]
};

/// In space the friction cone is round in (t1, t2, m / gamma'), with gamma' = gamma / (mu L).
template <class T>
struct alignas(sizeof(LaneOf<T>)) ContactLane<3, T> {
  LaneOf<T> n[3], a[3], b[3];  ///< inward normal and tangents, times sqrt(share)
  LaneOf<T> r[3];              ///< from the center to the contact
  LaneOf<T> soft;              ///< gamma'; 0 for a hard finger
  LaneOf<T> share, root;       ///< as in the plane, like those below
  LaneOf<T> mu, edge;
  LaneOf<T> lo, hi;
};

/// The contacts of a hand, in numbers of type T, with the unit of force: a view.
template <int Dim, class T = double>
struct Cones {
  std::size_t size;   ///< contacts
  bool limited;       ///< whether any contact has a force limit
  double per_weight;  ///< 1 / W [1/N]
  std::span<const ContactLane<Dim, T>> lanes;

  /// A limit of a contact's normal force, in the solver's units. Wide lanes have it so already: an
  /// infinite one must not be multiplied there.
  template <class Limit>
  [[gnu::always_inline]] Limit scaled(const Limit& limit) const {
    if constexpr (std::is_same_v<T, double>)
      return limit * per_weight;
    else
      return limit;
  }
};

namespace dual {

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

/// z of a contact in the half-plane in which its cone is the angle |t| <= mu n: along the normal,
/// and the length of what friction acts on.
template <class Real>
struct Slide {
  Real normal, beside;
};
/// The greatest power of a force with normal force 1: the cone's support function.
template <class Real>
Real power(const Slide<Real>& z, const Real& mu) {
  return z.normal + mu * z.beside;
}
/// Whether z is in the polar cone: no force does power on it.
template <class Real>
bool is_polar(const Slide<Real>& z, const Real& mu) {
  return power(z, mu) <= 0;
}

}  // namespace dual
}  // namespace poise
