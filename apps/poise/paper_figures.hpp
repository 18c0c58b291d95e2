// The figures of the paper, and those of what it misses, as gnuplot scripts.
#pragma once

#include <string>
#include <vector>

#include "apps/paper/disk.hpp"

namespace poise {

/// A disk under the name that it has in the paper: "Fig. 3(a)".
struct NamedDisk {
  std::string name;
  study::HeldDisk disk;
};

/// "φ = 60°, μ₁ = μ₂ = 1.732"
std::string parameters(const study::HeldDisk& disk);

/// Fig. 2: the range of pinching up, and the disk at its end.
std::string range_figure(const NamedDisk& named);
/// Figs. 3, 4 and 6: the six bounds above V, one column for each disk.
std::string curves_figure(const std::vector<NamedDisk>& columns);
/// V of several disks over the range.
std::string efforts_figure(const std::string& title, const std::vector<NamedDisk>& disks);
/// Fig. 7: the disk in the postures a, b and c.
std::string postures_figure(const NamedDisk& named);
/// Where b is a minimum, over (μ₁, μ₂), for some φ.
std::string minimum_figure(const std::vector<NamedDisk>& disks);
/// The errors of sampling by the number of samples.
std::string sampling_figure(const std::vector<NamedDisk>& disks);

}  // namespace poise
