// The disks of the paper's figures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/paper/disk.hpp"

namespace poise::study {

/// A disk under the name that it has in the paper: "Fig. 3(a)".
struct NamedDisk {
  std::string name;
  HeldDisk disk;
};

/// Whether b is a minimum between a and c.
bool has_b(const NamedDisk& named);

/// "φ = 60°, μ₁ = μ₂ = 1.732"
std::string parameters(const HeldDisk& disk);

/// A disk beside those of the paper; what is not given is that of Fig. 6.
struct GivenDisk {
  std::optional<double> phi_deg, mu1, mu2;
  double weight{10};  ///< of all disks [N]
};

/// The disks of the figures. In print phi is half of these angles: finding 2.
struct PaperDisks {
  NamedDisk fig3a, fig3b, fig3c, fig4a, fig4b, fig4c, fig4c_more, fig5, fig6;
  std::optional<NamedDisk> given{};

  explicit PaperDisks(const GivenDisk& asked);

  /// Each set of parameters once.
  std::vector<NamedDisk> all() const;
  std::vector<NamedDisk> with_b() const;
};

}  // namespace poise::study
