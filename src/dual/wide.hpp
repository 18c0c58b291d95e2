// Numbers of 106 bits, as the unevaluated sum of two doubles: for the few loads where rounding
// would decide between holdable and not. Not installed.
//
// Dekker, A floating-point technique for extending the available precision (1971); Joldes, Muller,
// Popescu, Tight and rigorous error bounds for basic building blocks of double-word arithmetic
// (2017), algorithms 6 (sum), 12 (product) and 17 (quotient).
#pragma once

#include <Eigen/Core>
#include <cmath>

// The page with the core in it is loaded from the web: there an operation is a call, not a copy.
#ifdef __wasm__
#define POISE_WIDE_CALL [[gnu::noinline]]
#else
#define POISE_WIDE_CALL
#endif

namespace poise {

class Wide {
 public:
  Wide(double value = 0) : high_(value), low_(0) {}

  explicit operator double() const { return high_; }

  POISE_WIDE_CALL friend Wide operator+(const Wide& a, const Wide& b) {
    const Wide s = two_sum(a.high_, b.high_), t = two_sum(a.low_, b.low_);
    const Wide v = fast_two_sum(s.high_, s.low_ + t.high_);
    return fast_two_sum(v.high_, t.low_ + v.low_);
  }
  POISE_WIDE_CALL friend Wide operator*(const Wide& a, const Wide& b) {
    const double product = a.high_ * b.high_;
    const double rest = std::fma(a.high_, b.high_, -product);
    return fast_two_sum(product, rest + (a.high_ * b.low_ + a.low_ * b.high_));
  }
  POISE_WIDE_CALL friend Wide operator/(const Wide& a, const Wide& b) {
    const double quotient = a.high_ / b.high_;
    if (!std::isfinite(quotient) || std::isinf(b.high_)) return quotient;
    const Wide rest = a - b * quotient;
    return fast_two_sum(quotient, rest.high_ / b.high_);
  }
  Wide operator-() const { return Wide(-high_, -low_); }
  POISE_WIDE_CALL friend Wide operator-(const Wide& a, const Wide& b) { return a + -b; }
  Wide& operator+=(const Wide& b) { return *this = *this + b; }
  Wide& operator-=(const Wide& b) { return *this = *this - b; }
  Wide& operator*=(const Wide& b) { return *this = *this * b; }
  Wide& operator/=(const Wide& b) { return *this = *this / b; }

  friend bool operator<(const Wide& a, const Wide& b) {
    return a.high_ < b.high_ || (a.high_ == b.high_ && a.low_ < b.low_);
  }
  friend bool operator>(const Wide& a, const Wide& b) { return b < a; }
  friend bool operator<=(const Wide& a, const Wide& b) { return a < b || a == b; }
  friend bool operator>=(const Wide& a, const Wide& b) { return b <= a; }
  friend bool operator==(const Wide& a, const Wide& b) {
    return a.high_ == b.high_ && a.low_ == b.low_;
  }
  friend bool operator!=(const Wide& a, const Wide& b) { return !(a == b); }

  friend Wide abs(const Wide& a) { return a.high_ < 0 ? -a : a; }
  /// One Newton step from the root of the high part.
  POISE_WIDE_CALL friend Wide sqrt(const Wide& a) {
    if (!(a.high_ > 0)) return a.high_ < 0 ? 0 : a.high_;
    const double root = std::sqrt(a.high_);
    return Wide(root) + (a - Wide(root) * root) / (2 * root);
  }

 private:
  Wide(double high, double low) : high_(high), low_(low) {}

  static Wide two_sum(double a, double b) {
    const double sum = a + b;
    if (!std::isfinite(sum)) return sum;
    const double part = sum - a;
    return Wide(sum, (a - (sum - part)) + (b - part));
  }
  /// Where |a| >= |b|.
  static Wide fast_two_sum(double a, double b) {
    const double sum = a + b;
    if (!std::isfinite(sum)) return sum;
    return Wide(sum, b - (sum - a));
  }

  double high_, low_;
};

}  // namespace poise

namespace Eigen {

template <>
struct NumTraits<poise::Wide> : GenericNumTraits<poise::Wide> {
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 20,
    MulCost = 10
  };
  static poise::Wide epsilon() { return 4.93038065763132e-32; }
  static poise::Wide dummy_precision() { return 1e-28; }
};

}  // namespace Eigen
