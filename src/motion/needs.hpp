// The least that holds one wrench after the other. Not installed.
#pragma once

#include "poise/grip.hpp"
#include "poise/motion.hpp"

namespace poise {

/// The least that holds wrenches, each found from the one before.
class Needs {
 public:
  Needs(const Hand<3>& hand, double weight, const MotionSettings& settings)
      : hand_(hand), weight_(weight), settings_(settings) {
    if (!(settings.force_cap > 0) || !(settings.force_cap <= 1e9))
      throw InvalidGrasp("force_cap", "must be above 0 and at most 1e9 weights");
    by_grip_ = settings.objective == Objective::grip;
    if (by_grip_) most_ = most_grip(hand);
  }

  Hold<3> hold(const Wrench<3>& w) {
    const Vector<3> force = w.head<3>();
    const double moment = (w - wrench_of<3>(force, hand_.center())).norm();
    const double unit = weight_ + force.norm() + moment / hand_.length();
    const HoldSettings within{settings_.force_cap * weight_ / unit, settings_.objective};
    Hold<3> found = by_grip_ ? least_grip<3>(hand_, w, unit, within)
                             : poise::hold<3>(hand_, w, unit, start_, within);
    if (found.holdable) start_ = found.dual;
    return found;
  }

  MotionNeed need(const Hold<3>& hold) const {
    MotionNeed need{.held = hold.holdable && !(by_grip_ && hold.lower_bound > most_),
                    .proven = hold.proven};
    if (hold.holdable) {
      need.value = hold.value();
      need.lower_bound = hold.lower_bound;
    }
    return need;
  }

 private:
  const Hand<3>& hand_;
  double weight_;
  MotionSettings settings_;
  bool by_grip_;
  double most_{std::numeric_limits<double>::infinity()};
  Twist<3> start_ = Twist<3>::Zero();
};

}  // namespace poise
