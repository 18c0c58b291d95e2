// The paper's numerical way: sample theta, take alpha-bar, compare V.
#pragma once

#include <cstddef>
#include <optional>

#include "apps/paper/disk.hpp"

namespace poise::study {

/// Where the paper's way sees a minimum between the ends of the range.
struct Sampled {
  double theta{0};  ///< [rad]
  double V{0};      ///< [N^2]
};

/// The lowest of `samples` postures, evenly over the closed range, that has no lower neighbour; the
/// ends do not count. None if there is no such posture.
std::optional<Sampled> sampled_minimum(const HeldDisk& disk, std::size_t samples);

/// How far that is from b.
struct SamplingError {
  double theta{0};  ///< [rad]
  double V{0};      ///< relative
};

/// Of the paper's way, for a disk whose b is a minimum: only the two samples beside b are looked
/// at, the lower of which it finds.
SamplingError sampling_error(const HeldDisk& disk, std::size_t samples);

/// From how many samples on the errors stay within a tolerance, whatever number is taken.
struct SamplesNeeded {
  std::size_t theta{0}, V{0};
};
SamplesNeeded samples_needed(const HeldDisk& disk, double tolerance);

}  // namespace poise::study
