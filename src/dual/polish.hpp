// Forces to all digits of doubles where y is long. Not installed.
#pragma once

#include <cmath>

#include "dual/evaluate.hpp"
#include "dual/newton.hpp"

namespace poise::dual {

/// The value at y in wide numbers.
template <int Dim>
[[gnu::noinline]] double value_in_wide_numbers(const Cones<Dim>& cones, const Wrench<Dim>& w,
                                               const Twist<Dim>& y) {
  Point<Dim, Wide> proof(cones.size);
  evaluate<Dim, Wide>(Widened<Dim>(cones).cones(), w.template cast<Wide>(), y.template cast<Wide>(),
                      proof);
  return static_cast<double>(proof.value);
}

/// Near the limit of friction |z| is about |f|², and Π_K(z) has lost digits. Newton's method on,
/// with z in Twofold numbers and steps in doubles. False if it has not come near enough to
/// converge.
template <int Dim>
[[gnu::noinline]] bool polish(const Cones<Dim>& cones, const Wrench<Dim>& w, Point<Dim>& point) {
  return with_simd([&] {
    Point<Dim> trial(cones.size);
    Screw<Dim, Wide> y = point.y.template cast<Wide>();
    double error = std::numeric_limits<double>::infinity();
    for (int step = 0;; ++step) {
      evaluate_twofold<Dim>(cones, w, y, trial);
      const double before = error;
      error = l1_norm(trial.residual);
      // What rounding of the forces leaves of the balance.
      const double left = 4 * rounding_of<double> * (1 + std::sqrt(squared_norm(trial)));
      if (error <= left) break;
      if (step == 12 || !(error <= 0.5 * before)) {
        // An imbalance beyond rounding shows in the effort where y is long.
        if (!(error <= std::max(2 * left, 0.1 * delta))) return false;
        break;
      }
      const Twist<Dim> dy = newton_step(curvature<Dim, double>(cones, trial), trial.residual);
      y += dy.template cast<Wide>();
    }
    // Rounding of y costs the bound about the square of what it changes in z.
    const double changed = rounding_of<double> * l1_norm(trial.y), effort = squared_norm(trial);
    trial.value = changed * changed * static_cast<double>(cones.size) <= 1e-16 * effort
                      ? 0.5 * effort
                      : value_in_wide_numbers<Dim>(cones, w, trial.y);
    point = trial;
    return true;
  });
}

}  // namespace poise::dual
