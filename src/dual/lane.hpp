// Numbers of several contacts at once: a SIMD word of doubles, or one number of a wider type. Not
// installed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

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

/// The same number for all contacts of a lane.
template <class T>
[[gnu::always_inline]] inline LaneOf<T> broadcast(const T& x) {
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

[[gnu::always_inline]] inline Lane square_root(Lane x) {
  for (std::size_t k = 0; k < lane_size; ++k) x[k] = std::sqrt(x[k]);
  return x;
}
inline Wide square_root(const Wide& x) { return sqrt(x); }

/// 1 / sqrt(x), or any number where x is 0.
template <class L>
[[gnu::always_inline]] inline L inverse_root(const L& x) {
  const L tiny = L{} + 1e-280;
  return 1.0 / square_root(larger(x, tiny));
}

/// The unevaluated sum of two lanes, for what cancels: sums and products know about 106 bits of
/// their largest part. Algorithms 4 and 5 of Ogita, Rump, Oishi, Accurate sum and dot product
/// (2005).
struct Twofold {
  Lane high, low;
};

[[gnu::always_inline]] inline Twofold exact_sum(const Lane& a, const Lane& b) {
  const Lane sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}
[[gnu::always_inline]] inline Twofold exact_product(const Lane& a, const Lane& b) {
  const Lane product = a * b;
  Lane rest;
  for (std::size_t k = 0; k < lane_size; ++k) rest[k] = std::fma(a[k], b[k], -product[k]);
  return {product, rest};
}
[[gnu::always_inline]] inline Twofold operator+(const Twofold& a, const Twofold& b) {
  const Twofold sum = exact_sum(a.high, b.high);
  return {sum.high, sum.low + (a.low + b.low)};
}
[[gnu::always_inline]] inline Twofold operator-(const Twofold& a, const Twofold& b) {
  return a + Twofold{-b.high, -b.low};
}
[[gnu::always_inline]] inline Twofold operator*(const Lane& a, const Twofold& b) {
  const Twofold product = exact_product(a, b.high);
  return {product.high, product.low + a * b.low};
}
[[gnu::always_inline]] inline Twofold operator*(const Twofold& a, const Twofold& b) {
  const Twofold product = exact_product(a.high, b.high);
  return {product.high, product.low + (a.high * b.low + a.low * b.high)};
}
[[gnu::always_inline]] inline Twofold magnitude(const Twofold& x) {
  const LaneBits sign = (LaneBits)(x.high + x.low) & sign_bit;
  return {(Lane)((LaneBits)x.high ^ sign), (Lane)((LaneBits)x.low ^ sign)};
}

/// The nearest lane of plain numbers.
template <class L>
[[gnu::always_inline]] inline const L& narrow(const L& x) {
  return x;
}
[[gnu::always_inline]] inline Lane narrow(const Twofold& x) { return x.high + x.low; }

/// Calls with the SIMD instructions that this machine has: what is called is compiled twice.
#ifdef __x86_64__
template <class Call>
[[gnu::target("avx2,fma"), gnu::flatten, gnu::noinline]] auto with_avx2(const Call& call) {
  return call();
}
#endif
template <class Call>
auto with_simd(const Call& call) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return with_avx2(call);
#endif
  return call();
}

}  // namespace poise
