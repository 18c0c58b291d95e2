// How an object is best turned in the wrist for a motion: docs/theory.md, "Motion".
#pragma once

#include <vector>

#include "poise/motion.hpp"

namespace poise {

/// What is asked.
struct OffsetSettings {
  Objective objective{Objective::grip};  ///< of which the greatest over the motion is to be least
  double force_cap{1e6};                 ///< [weights of the body]
  double gap{1e-2};                      ///< wanted: (value - lower_bound) / value, > 0 and < 1
  int max_cells{20000};                  ///< parts of all rotations to look at, >= 1
};

/// The rotation Q with which the motion needs least where orientations are R(t) Q instead of R(t):
/// object and hand are turned in the wrist, about the object frame's origin, which moves as before.
struct WristOffset {
  bool optimal{false};  ///< value and lower_bound are within the wanted gap
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< w >= 0
  /// The greatest V [N^2] or F over the motion with it, where drives have no max; infinite where no
  /// rotation was found that holds it.
  double value{std::numeric_limits<double>::infinity()};
  /// No rotation needs less, by weak duality of holds over a cover of all rotations; infinite where
  /// none holds it.
  double lower_bound{0};
  double now{std::numeric_limits<double>::infinity()};  ///< without it
  std::size_t state{0};                                 ///< that needs most with it
  int cells{0};                                         ///< looked at
};

/// Branch and bound over the rotations. Where `gap` is not reached the bound holds all the same.
/// Of ties within 1e-6 no rotation wins.
/// @throws InvalidGrasp as motion(), and for settings out of their ranges
WristOffset best_offset(const Hand<3>& hand, const Body& body,
                        const std::vector<MotionState>& states,
                        const OffsetSettings& settings = {});

}  // namespace poise
