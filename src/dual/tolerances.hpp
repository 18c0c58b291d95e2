// What the solver takes for nothing, and why. Not installed.
#pragma once

#include <type_traits>

namespace poise::dual {

/// The balance tolerance: force / W and moment / (W L). A load that is so near to one that can be
/// held counts as held: less than any model of a grasp is right by, more than rounding adds up to.
inline constexpr double delta = 1e-12;

/// The distance from 1 to the next number.
template <class T>
constexpr double rounding_of = std::is_same_v<T, double> ? 2.2e-16 : 4.9e-32;

/// A y above this was a proof that a neighbour cannot be held: too long to start from.
inline constexpr double longest_start = 1e8;

/// No y of a load that can be held within the greatest force cap is as long as this.
inline constexpr double longest = 1e100;

/// Forces along y and their pull are told apart as long as rounding of G^T y, this far out, stays
/// below a few thousandths of a weight.
template <class T>
constexpr double far_out = 2e-3 / rounding_of<T>;

/// The pulls towards y = 0 by which the direction is found in which nothing balances: so weak that
/// the shortest distance to what can be balanced shows, and not so weak that rounding does.
inline constexpr double weak_pull = 1e-7;
/// Where rounding may ask for a very long y, this pull takes less than the balance tolerance.
inline constexpr double faint_pull = 1e-13;

/// In wide numbers the pull fades from the first to the last, where it is below all rounding.
inline constexpr double first_pull = 1e-6, last_pull = 1e-25;

/// How the ascent goes. In the plane the dual function is piecewise quadratic: on a face one step
/// is exact, so that it pays to find where a line ends, and to ask for more digits than promised.
template <int Dim>
struct Schedule;
template <>
struct Schedule<2> {
  static constexpr double balance = 0.1 * delta;  ///< of each component: no digit is missing
  static constexpr double gap = 1e-12;            ///< between effort and bound, of the effort
  static constexpr double flat = 1e-9;  ///< a slope along a line that is none, of the first
  static constexpr bool half_is_enough = false;   ///< of the slope, on a way that rises
  static constexpr bool waits_for_stall = false;  ///< before polishing
};
/// In space the cones are round: lines bend, and each further step is worth more than what it finds
/// along one.
template <>
struct Schedule<3> {
  static constexpr double balance = 0.5 * delta;
  static constexpr double gap = 1e-11;
  static constexpr double flat = 1e-2;
  static constexpr bool half_is_enough = true;
  static constexpr bool waits_for_stall = true;
};

}  // namespace poise::dual
