// What the interior-point method moves: numbers and vectors in their cones, with their multipliers.
// Not installed.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace poise::dual::interior {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// s >= 0 and its multiplier u: a limit of N, the effort that a drive has left, F.
template <class T>
struct Ray {
  T s, u;
  T ds, du;
  T d;  ///< the step's aim: ds + (s / u) du = d

  T curvature() const { return u / s; }
  T product() const { return s * u; }
  void aim() { d = -s; }
  void aim(const T& center, const T& second) { d = -s + (center - second * ds * du) / u; }
  void step(const T& change) {
    ds = change;
    du = curvature() * (d - ds);
  }
  T way() const {
    return std::min<T>(ds < 0 ? T(-s / ds) : T(infinity), du < 0 ? T(-u / du) : T(infinity));
  }
  void go(const T& length) {
    s += length * ds;
    u += length * du;
  }
};

/// A head and a tail.
template <int D, class T>
struct Spin {
  T head;
  Eigen::Matrix<T, D, 1> tail;

  T dot(const Spin& other) const { return head * other.head + tail.dot(other.tail); }
  /// Lorentz length, squared.
  T square() const {
    const T t = tail.norm();
    return (head - t) * (head + t);
  }
};

/// s in the cone |tail| <= head and its multiplier u, scaled by W after Nesterov and Todd:
/// W = scale [w0 w1ᵀ; w1 I + w1 w1ᵀ/(1 + w0)], W u = W⁻¹ s = lambda.
template <int D, class T>
struct Cone {
  using Tail = Eigen::Matrix<T, D, 1>;
  Spin<D, T> s, u;
  Spin<D, T> ds, du;
  Spin<D, T> d;  ///< the step's aim: ds + W² du = d
  T scale, w0;
  Tail w1;
  Spin<D, T> lambda;

  T product() const { return s.dot(u); }
  void rescale() {
    using std::sqrt;
    const T least = std::numeric_limits<double>::min();
    const T ls = sqrt(std::max<T>(s.square(), least)), lu = sqrt(std::max<T>(u.square(), least));
    const Tail s1 = s.tail / ls, u1 = u.tail / lu;
    w1 = (s1 - u1) / sqrt(2 * (1 + s.head / ls * (u.head / lu) + s1.dot(u1)));
    w0 = sqrt(1 + w1.squaredNorm());
    scale = sqrt(ls / lu);
    lambda = times(u);
  }
  Spin<D, T> times(const Spin<D, T>& x) const {
    const T along = w1.dot(x.tail);
    return {scale * (w0 * x.head + along), scale * (x.tail + (x.head + along / (1 + w0)) * w1)};
  }
  Spin<D, T> over(const Spin<D, T>& x) const {
    const T along = w1.dot(x.tail);
    return {(w0 * x.head - along) / scale, (x.tail - (x.head - along / (1 + w0)) * w1) / scale};
  }
  void aim() { d = {-s.head, -s.tail}; }
  void aim(const T& center, const T& second) {
    const Spin<D, T> a = over(ds), b = times(du);
    const T head = center - lambda.dot(lambda) - second * a.dot(b);
    const Tail tail = -2 * lambda.head * lambda.tail - second * (a.head * b.tail + b.head * a.tail);
    const T first = (lambda.head * head - lambda.tail.dot(tail)) / lambda.square();
    d = times({first, (tail - first * lambda.tail) / lambda.head});
  }
  /// The tail of du is known without the rounding of W⁻²; the head of W² du = d - ds gives its
  /// head.
  void step(const Spin<D, T>& change, const Tail& tail) {
    ds = change;
    const T left = (d.head - ds.head) / (scale * scale);
    du = {(left - 2 * w0 * w1.dot(tail)) / (1 + 2 * w1.squaredNorm()), tail};
  }
  /// The least t > 0 with x + t dx on the border.
  static T way(const Spin<D, T>& x, const Spin<D, T>& dx) {
    const T a = dx.square(), b = x.head * dx.head - x.tail.dot(dx.tail), c = x.square();
    if (a >= 0 && b >= 0) return infinity;
    // Whoever goes back in a timelike direction meets the border: the root is real.
    using std::sqrt;
    const T root = sqrt(std::max<T>(b * b - a * c, 0));
    return b < 0 ? c / (root - b) : (b + root) / -a;
  }
  T way() const { return std::min<T>(way(s, ds), way(u, du)); }
  void go(const T& length) {
    s.head += length * ds.head;
    s.tail += length * ds.tail;
    u.head += length * du.head;
    u.tail += length * du.tail;
  }
};

}  // namespace poise::dual::interior
