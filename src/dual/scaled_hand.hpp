// The hand as the solver sees it. Not installed.
//
// Forces in weights W of the load, lengths in radii L, moments about the hand's center, and the force
// of a contact divided by sqrt(share), so that the effort is |f|^2 and the share appears nowhere
// else. The hand itself knows no W: limits of force are in newtons here, and Cones has 1 / W.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "poise/grasp.hpp"
#include "poise/small_vector.hpp"
#include "dual/wide.hpp"

namespace poise {

/// Contacts are dealt with in lanes: of doubles four at a time on machines of which most have SIMD
/// instructions for four, two elsewhere; of other numbers one.
#ifdef __x86_64__
inline constexpr std::size_t lane_size = 4;
#else
inline constexpr std::size_t lane_size = 2;
#endif
using Lane = double __attribute__((vector_size(8 * lane_size)));
template <class T>
using LaneOf = std::conditional_t<std::is_same_v<T, double>, Lane, T>;
template <class T>
inline constexpr std::size_t lane_size_of = std::is_same_v<T, double> ? lane_size : 1;

/// The sums of the elements of as many lanes as a lane has elements.
[[gnu::always_inline]] inline void sum_each(const Lane* lanes, Lane& sums) {
#ifdef __x86_64__
  const Lane ab = __builtin_shufflevector(lanes[0], lanes[1], 0, 4, 2, 6) +
                  __builtin_shufflevector(lanes[0], lanes[1], 1, 5, 3, 7);
  const Lane cd = __builtin_shufflevector(lanes[2], lanes[3], 0, 4, 2, 6) +
                  __builtin_shufflevector(lanes[2], lanes[3], 1, 5, 3, 7);
  sums = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
#else
  sums = Lane{lanes[0][0] + lanes[0][1], lanes[1][0] + lanes[1][1]};
#endif
}
/// The sums of each of n lanes.
template <std::size_t n>
[[gnu::always_inline]] inline std::array<double, n> sums_of(const Lane (&lanes)[n]) {
  static_assert(n % lane_size == 0);
  std::array<double, n> sums;
#pragma GCC unroll 16
  for (std::size_t i = 0; i < n; i += lane_size) {
    Lane some;
    sum_each(lanes + i, some);
#pragma GCC unroll 4
    for (std::size_t k = 0; k < lane_size; ++k) sums[i + k] = some[k];
  }
  return sums;
}
template <std::size_t n>
std::array<Wide, n> sums_of(const Wide (&of_one)[n]) {
  std::array<Wide, n> sums;
  std::copy_n(of_one, n, sums.begin());
  return sums;
}
/// The sum of a lane's elements.
inline double sum(const Lane& x) {
  double all_of_it = x[0] + x[1];
  for (std::size_t k = 2; k < lane_size; k += 2) all_of_it += x[k] + x[k + 1];
  return all_of_it;
}
inline Wide sum(const Wide& x) { return x; }

/// Element k of a lane.
inline double element(const Lane& lane, std::size_t k) { return lane[k]; }
template <class T>
T element(const T& lane, std::size_t /*only one*/) {
  return lane;
}

/// As many contacts as a lane holds; an odd last one is filled up by a contact that carries
/// nothing. Aligned for what works on all of a lane at once.
template <int Dim, class T = double>
struct ContactLane;

template <class T>
struct alignas(sizeof(LaneOf<T>)) ContactLane<2, T> {
  LaneOf<T> nx, ny;  ///< inward normal, times sqrt(share)
  LaneOf<T> jx, jy;  ///< velocity of the contact point: the object turns about the center at 1 rad/s
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
  std::size_t size;       ///< contacts
  bool limited;           ///< whether any contact has a force limit
  double per_weight;      ///< 1 / W [1/N]
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

/// Of two contacts.
using Pair = double __attribute__((vector_size(16)));

/// Two contacts in the plane have one internal force, along the line between them: how far it goes
/// until mu n - t (first) or mu n + t of a contact vanishes.
struct InternalForce {
  Pair per_margin[2];  ///< 1 / the rate at which it grows; 0 where it stays
  double square;       ///< of its length
};

template <int Dim>
struct Hand<Dim>::Scaled {
  Scaled(const std::vector<Contact<Dim>>& contacts, const Vector<Dim>& center, double radius);

  /// The contacts in a unit of force [N].
  Cones<Dim> cones(double weight) const {
    return {size, limited, 1 / weight, {lanes.data(), lanes.size()}};
  }
  /// The same hand with all frictions and torsions multiplied by a factor >= 0.
  Scaled with_friction(double factor) const;
  /// The contacts without max_normal alone, the others made to press with nothing, none with a
  /// min_normal: what these can hold once they can hold at any size.
  Scaled without_limits() const;
  Scaled without_max_normal() const;

  std::size_t size;
  bool limited{false};
  SmallVector<ContactLane<Dim>, 16 / lane_size> lanes;
  Vector<Dim> center;
  double radius;      ///< L [m]; may be 0
  double length;      ///< L [m], or 1 where every contact is at the center
  double per_length;  ///< 1 / length [1/m]
  /// Pseudo-inverse of G G^T: the dual of a load while no contact is at the border of its cone.
  Eigen::Matrix<double, wrench_size<Dim>, wrench_size<Dim>> inverse;
  InternalForce internal{};  ///< of two contacts in the plane
  /// Twists that no contact feels, an orthonormal basis: two hard fingers leave one in space.
  /// There a frictionless contact feels what moves it along its normal alone.
  std::vector<Twist<Dim>> unfelt;

 private:
  void prepare();  ///< what follows from the lanes: inverse, internal, unfelt
};

template <int Dim>
using ScaledHand = typename Hand<Dim>::Scaled;

/// The same contacts in wider numbers, with limits in the unit of force.
template <int Dim>
struct Widened {
  explicit Widened(const Cones<Dim>& cones);
  Cones<Dim, Wide> cones() const { return {lanes.size(), limited, 1, {lanes.data(), lanes.size()}}; }

  bool limited;
  SmallVector<ContactLane<Dim, Wide>, 16> lanes;
};

}  // namespace poise
