#include "apps/paper/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "apps/paper/exact.hpp"

namespace poise::study {

std::optional<Sampled> sampled_minimum(const HeldDisk& disk, std::size_t samples) {
  if (samples < 3) return {};
  const double end = disk.range(), step = 2 * end / static_cast<double>(samples - 1);
  const auto at = [&](std::size_t k) { return -end + step * static_cast<double>(k); };
  std::optional<Sampled> lowest;
  double before = V(disk, at(0)), here = V(disk, at(1));
  for (std::size_t k = 1; k + 1 < samples; ++k) {
    const double after = V(disk, at(k + 1));
    if (here <= before && here <= after && (!lowest || here < lowest->V)) lowest = {at(k), here};
    before = here;
    here = after;
  }
  return lowest;
}

namespace {

/// The two samples beside b: V_6 holds before it, V_5 after it.
class BesideB {
 public:
  explicit BesideB(const HeldDisk& disk)
      : b_(theta_b(disk)), end_(disk.range()), before_(V_6(disk)), after_(V_5(disk)) {}

  SamplingError error(std::size_t samples) const {
    const double step = 2 * end_ / static_cast<double>(samples - 1);
    const double below = -end_ + step * std::floor((b_ + end_) / step), above = below + step;
    const double V_below = before_(below), V_above = after_(above);
    return {.theta = std::abs((V_below <= V_above ? below : above) - b_),
            .V = std::max(0.0, std::min(V_below, V_above) / after_(b_) - 1)};
  }
  /// So many samples are at most a step apart.
  std::size_t samples(double step) const { return static_cast<std::size_t>(2 * end_ / step) + 2; }
  /// Beyond so many samples the error in V is within a tolerance: one of them is within half a
  /// step.
  std::size_t enough_for_V(double tolerance) const {
    double step = end_;
    while (std::max(before_(b_ - step / 2), after_(b_ + step / 2)) / after_(b_) - 1 > tolerance)
      step *= 0.99;
    return samples(step);
  }

 private:
  double b_, end_;
  Harmonic2 before_, after_;
};

}  // namespace

SamplingError sampling_error(const HeldDisk& disk, std::size_t samples) {
  return BesideB(disk).error(samples);
}

SamplesNeeded samples_needed(const HeldDisk& disk, double tolerance) {
  const BesideB beside(disk);
  const auto last_above = [&](std::size_t enough, double SamplingError::*error) {
    std::size_t samples = enough;
    while (samples > 3 && beside.error(samples).*error <= tolerance) --samples;
    return samples + 1;
  };
  return {.theta = last_above(beside.samples(tolerance), &SamplingError::theta),
          .V = last_above(beside.enough_for_V(tolerance), &SamplingError::V)};
}

}  // namespace poise::study
