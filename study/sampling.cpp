#include "study/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/exact.hpp"

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

SamplingError sampling_error(const HeldDisk& disk, std::size_t samples) {
  const double b = theta_b(disk), least = V(disk, b), end = disk.range();
  const double step = 2 * end / static_cast<double>(samples - 1);
  const double before = -end + step * std::floor((b + end) / step), after = before + step;
  const double V_before = V(disk, before), V_after = V(disk, after);
  return {.theta = std::abs((V_before <= V_after ? before : after) - b),
          .V = std::max(0.0, std::min(V_before, V_after) / least - 1)};
}

SamplesNeeded samples_needed(const HeldDisk& disk, double tolerance) {
  const double b = theta_b(disk), least = V(disk, b), end = disk.range();
  const auto last_above = [&](std::size_t from, auto error) {
    std::size_t samples = from;
    while (samples > 3 && error(sampling_error(disk, samples)) <= tolerance) --samples;
    return samples + 1;
  };
  // Beyond these the errors are small enough: a sample is within half a step of b in V, and the one
  // that is found within a step in theta.
  double step = end;
  while (std::max(V(disk, b - step / 2), V(disk, b + step / 2)) / least - 1 > tolerance)
    step *= 0.99;
  const auto enough = [&](double h) { return static_cast<std::size_t>(2 * end / h) + 2; };
  return {.theta = last_above(enough(tolerance), [](const SamplingError& e) { return e.theta; }),
          .V = last_above(enough(step), [](const SamplingError& e) { return e.V; })};
}

}  // namespace poise::study
