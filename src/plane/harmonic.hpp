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

/// At most 4 in a turn, one more where it was cut in two.
class Roots {
 public:
  void push_back(const Root& root) { roots_[count_++] = root; }
  const Root* begin() const { return roots_.data(); }
  const Root* end() const { return roots_.data() + count_; }

 private:
  std::array<Root, 10> roots_;
  std::size_t count_{0};
};

/// The theta in (from, to), to - from <= 2 pi, where g changes its sign, ascending.
Roots sign_changes(const Harmonic2& g, double from, double to);

}  // namespace poise
