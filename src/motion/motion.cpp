#include "poise/motion.hpp"

#include <algorithm>
#include <cmath>

#include "motion/held_set.hpp"
#include "motion/needs.hpp"

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double speed_gap = 1e-6;  // of the square of the speed

void check_states(const std::vector<MotionState>& states) {
  if (states.empty()) throw InvalidGrasp("states", "must not be empty");
}

/// The state from which to start with speeds: that of the largest dynamic load.
std::size_t hardest(const HeldSet& set, const std::vector<MotionLoad>& loads) {
  const auto size = [&](const MotionLoad& load) { return set.size(load.dynamic()); };
  return static_cast<std::size_t>(
      std::max_element(loads.begin(), loads.end(),
                       [&](const auto& a, const auto& b) { return size(a) < size(b); }) -
      loads.begin());
}

}  // namespace

MotionAnswer motion(const Hand<3>& hand, const Body& body, const std::vector<MotionState>& states,
                    const MotionSettings& settings) {
  check_states(states);
  MotionAnswer answer;
  answer.needs.reserve(states.size());
  Needs needs(hand, body.mass * standard_gravity, settings);
  for (std::size_t k = 0; k < states.size(); ++k) {
    Hold<3> hold = needs.hold(motion_load(body, states[k]).at());
    answer.needs.push_back(needs.need(hold));
    const MotionNeed& need = answer.needs.back();
    if (!need.held && !answer.slip) answer.slip = k;
    if (k == 0 || need.value > answer.needs[answer.peak].value) {
      answer.peak = k;
      answer.hold = std::move(hold);
    }
  }
  const MotionLoad load = motion_load(body, states[answer.peak]);
  double least = answer.needs[answer.peak].value;
  for (std::size_t k = 0; k < load.terms.size(); ++k) {
    const double value = needs.need(needs.hold(load.at() - load.terms[k])).value;
    answer.without[k] = value;
    if (!(value < least)) continue;
    least = value;
    answer.cause = static_cast<LoadTerm>(k);
  }
  return answer;
}

SpeedLimit speed_limit(const Hand<3>& hand, const Body& body,
                       const std::vector<MotionState>& states, const MotionSettings& settings) {
  check_states(states);
  std::vector<MotionLoad> loads;
  loads.reserve(states.size());
  for (const MotionState& state : states) loads.push_back(motion_load(body, state));
  HeldSet set(hand, body.mass * standard_gravity, settings.force_cap);
  SpeedLimit limit;
  double top = most_speed * most_speed;  // of the square of the speed
  double bound = infinity;
  std::size_t k = hardest(set, loads);
  limit.state = k;
  for (std::size_t held = 0; held < loads.size(); k = (k + 1) % loads.size()) {
    if (set.holds(loads[k].at(std::sqrt(top)))) {
      ++held;
      continue;
    }
    const RayEnd end =
        ray_end(set, loads[k].weight(), loads[k].weight() + top * loads[k].dynamic(), speed_gap);
    limit.state = k;
    if (end.row) {
      bound = end.bound * top;
      limit.dual = end.row->y;
      limit.rates = end.row->rates;
    }
    top *= end.held;
    held = 1;
    if (!end.found || !(top > 0)) {
      limit.bound = bound < infinity ? std::sqrt(std::max(bound, 0.0)) : 0;
      return limit;
    }
  }
  limit.holdable = true;
  limit.factor = std::sqrt(top);
  limit.bound = std::sqrt(bound);
  return limit;
}

}  // namespace poise
