// Where a trigonometric polynomial vanishes. Not installed.
#pragma once

#include <array>
#include <cstddef>

#include "poise/posture_curve.hpp"

namespace poise {

/// d/dtheta.
Harmonic2 derivative(const Harmonic2& g);

/// Where a function changes its sign.
struct Root {
  double at;
  bool rising;
};

/// Where to cut an interval in two: off its middle, where symmetric curves have kinks and roots.
inline constexpr double off_middle = 0.4871;

/// At most 4 in each of the at most 3 parts into which a turn is cut.
class Roots {
 public:
  void push_back(const Root& root) { roots_[count_++] = root; }
  const Root* begin() const { return roots_.data(); }
  const Root* end() const { return roots_.data() + count_; }

 private:
  std::array<Root, 12> roots_;
  std::size_t count_{0};
};

/// The theta in (from, to), to - from <= 2 pi, where g changes its sign, ascending.
Roots sign_changes(const Harmonic2& g, double from, double to);

}  // namespace poise
