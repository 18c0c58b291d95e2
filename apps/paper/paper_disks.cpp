#include "apps/paper/paper_disks.hpp"

#include <fmt/core.h>

#include <cmath>

#include "apps/paper/exact.hpp"
#include "files/degrees.hpp"

namespace poise::study {

bool has_b(const NamedDisk& named) {
  return named.disk.can_be_squeezed() && minima(named.disk).size() == 3;
}

std::string parameters(const HeldDisk& disk) {
  const std::string phi = fmt::format("φ = {:.6g}°", degrees(disk.phi));
  return disk.mu1 == disk.mu2
             ? fmt::format("{}, μ₁ = μ₂ = {:.4g}", phi, disk.mu1)
             : fmt::format("{}, μ₁ = {:.4g}, μ₂ = {:.4g}", phi, disk.mu1, disk.mu2);
}

PaperDisks::PaperDisks(const GivenDisk& asked) {
  const auto disk = [&](const char* name, double phi, double mu1, double mu2) {
    return NamedDisk{name, {.phi = phi, .mu1 = mu1, .mu2 = mu2, .weight = asked.weight}};
  };
  const double root3 = std::sqrt(3.0), least = 1 / root3;
  fig3a = disk("Fig. 3(a)", pi / 3, root3, root3);
  fig3b = disk("Fig. 3(b)", pi / 3, 1, 1);
  fig3c = disk("Fig. 3(c)", pi / 3, least + 0.01, least + 0.01);
  fig4a = disk("Fig. 4(a)", 5 * pi / 12, 1, 1);
  fig4b = disk("Fig. 4(b)", pi / 3, 1, 1);
  fig4c = disk("Fig. 4(c)", pi / 4, 1, 1);
  fig4c_more = disk("Fig. 4(c), μ = 1.01", pi / 4, 1.01, 1.01);
  fig5 = disk("Fig. 5", pi / 3, 1, 1);
  fig6 = disk("Fig. 6", 5 * pi / 12, 1, least);
  if (asked.phi_deg || asked.mu1 || asked.mu2)
    given = disk("Given", asked.phi_deg.value_or(75) * pi / 180, asked.mu1.value_or(1),
                 asked.mu2.value_or(least));
}

std::vector<NamedDisk> PaperDisks::all() const {
  std::vector<NamedDisk> disks{fig3a, fig3b, fig3c, fig4a, fig4c, fig4c_more, fig6};
  disks[1].name += ", 4(b), 5";
  if (given) disks.push_back(*given);
  return disks;
}

std::vector<NamedDisk> PaperDisks::with_b() const {
  std::vector<NamedDisk> disks = all();
  std::erase_if(disks, [](const NamedDisk& named) { return !has_b(named); });
  return disks;
}

}  // namespace poise::study
