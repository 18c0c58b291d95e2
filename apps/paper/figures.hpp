// The figures of the paper, and those of what it misses, as gnuplot scripts.
#pragma once

#include <string>
#include <vector>

#include "apps/paper/paper_disks.hpp"

namespace poise::study {

/// Fig. 2: the range of pinching up, and the disk at its end.
std::string range_figure(const std::string& title, const HeldDisk& disk);
/// Figs. 3 and 4: the six bounds above V, one column for each disk.
std::string curves_figure(const std::vector<NamedDisk>& columns);
/// Figs. 5 and 6: the six bounds above V_1 ... V_6, and which of them counts.
std::string evaluation_figure(const NamedDisk& named);
/// V of several disks over the range.
std::string efforts_figure(const std::string& title, const std::vector<NamedDisk>& disks);
/// Fig. 7: the disk in the postures a, b and c.
std::string postures_figure(const std::string& title, const HeldDisk& disk);
/// Where b is a minimum, over (μ₁, μ₂), for some φ.
std::string minimum_figure(const std::vector<NamedDisk>& disks);
/// The errors of sampling by the number of samples.
std::string sampling_figure(const std::vector<NamedDisk>& disks);

}  // namespace poise::study
