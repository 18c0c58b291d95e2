// Numbers and contacts out of any bytes, extreme and degenerate ones on purpose.
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "poise/grasp.hpp"

namespace poise {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

class Decoder {
 public:
  Decoder(const std::uint8_t* bytes, std::size_t size)
      : data_(bytes, size), extreme_(data_.ConsumeIntegralInRange(0, 3) == 0) {}

  /// Whether there may be numbers like 1e-300.
  bool extreme() const { return extreme_; }

  int pick(int from, int to) { return data_.ConsumeIntegralInRange(from, to); }
  bool coin() { return data_.ConsumeBool(); }
  bool one_in(int n) { return pick(1, n) == n; }

  double angle() {
    return coin() ? pi / 12 * pick(-12, 12) : data_.ConsumeFloatingPointInRange(-pi, pi);
  }

  double positive() {
    constexpr double sizes[] = {1e-300, 1e-150, 1e-100, 1e-50, 1e-20, 1e-14,   1e-13, 1e-12,
                                1e-9,   1e-6,   1e6,    1e9,   1e12,  1e13,    1e14,  1e20,
                                1e50,   1e100,  1e150,  1e153, 1e300, infinity};
    constexpr double plain[] = {1, 2, 3, 0.5, 0.25, 0.75, 10, 0.1};
    const auto any = [&](const auto& list) {
      return list[data_.ConsumeIntegralInRange<std::size_t>(0, std::size(list) - 1)];
    };
    switch (pick(0, extreme_ ? 5 : 3)) {
      case 0:
      case 1:
        return any(plain);
      case 2:
        return data_.ConsumeFloatingPointInRange(1e-3, 10.0);
      case 3:  // nearly a plain one
        return any(plain) * (1 + data_.ConsumeFloatingPointInRange(-1e-9, 1e-9));
      default:
        return any(sizes);
    }
  }

  double coordinate() {
    if (one_in(8)) return 0;
    return coin() ? positive() : -positive();
  }

  template <int Dim>
  Vector<Dim> point() {
    Vector<Dim> result;
    for (double& x : result) x = coordinate();
    return result;
  }

  template <int Dim>
  Load<Dim> object() {
    Load<Dim> result;
    result.weight = positive();
    if (coin()) result.com = point<Dim>();
    return result;
  }

  /// Up to `most` contacts; `round` makes a point on a circle or a sphere.
  template <int Dim, class Round>
  std::vector<Contact<Dim>> contacts(const Load<Dim>& object, int most, const Round& round) {
    std::vector<Contact<Dim>> result;
    const auto count = static_cast<std::size_t>(pick(1, most));
    while (result.size() < count) result.push_back(contact(object, result, round));
    return result;
  }

 private:
  template <int Dim, class Round>
  Contact<Dim> contact(const Load<Dim>& object, const std::vector<Contact<Dim>>& others,
                       const Round& round) {
    Contact<Dim> c;
    if (!others.empty() && one_in(8)) c = others.back();  // the same again
    switch (pick(0, 5)) {
      case 0:
        c.position = object.com;
        c.normal = point<Dim>();
        break;
      case 1:  // mirrored
        if (!others.empty()) c = others.back();
        c.position.x() *= -1;
        c.normal.x() *= -1;
        break;
      case 2:
        c.position = point<Dim>();
        c.normal = point<Dim>();
        break;
      default:
        c.position = round();
        c.normal = -c.position;
    }
    if (one_in(8)) c.normal = -c.normal;
    if (!one_in(4)) c.friction = positive();
    if (one_in(4)) c.min_normal = object.weight * positive();
    if (one_in(4)) c.max_normal = c.min_normal + object.weight * (one_in(4) ? 0 : positive());
    if (one_in(4)) c.share = std::min(1.0, positive());
    if (one_in(4)) c.finger = coin() ? "a" : "b";
    return c;
  }

  FuzzedDataProvider data_;
  bool extreme_;
};

}  // namespace poise
