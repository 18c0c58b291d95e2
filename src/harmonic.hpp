// Where a trigonometric polynomial vanishes. Not installed.
#pragma once

#include <array>
#include <cstddef>

#include "poise/posture_curve.hpp"

namespace poise {

/// d/dtheta.
Harmonic2 derivative(const Harmonic2& g);

/// At most 4 in a turn, one more where it was cut in two.
class Roots {
 public:
  void push_back(double theta) { theta_[count_++] = theta; }
  const double* begin() const { return theta_.data(); }
  const double* end() const { return theta_.data() + count_; }

 private:
  std::array<double, 10> theta_;
  std::size_t count_{0};
};

/// The theta in (from, to), to - from <= 2 pi, where g changes its sign, ascending.
Roots sign_changes(const Harmonic2& g, double from, double to);

}  // namespace poise
