#include "apps/paper/minima.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/paper/exact.hpp"
#include "files/degrees.hpp"
#include "files/json_text.hpp"

namespace poise::study {

std::string minima_table(const std::vector<NamedDisk>& disks, const Style& style) {
  Table table({"<disk", "φ", "μ₁", "μ₂", "<", "θ", "internal force [N]", "V [N²]", "force norm [N]",
               "<kind"});
  // Six digits of the weight and of its square.
  const double magnitude = std::floor(std::log10(disks.front().disk.weight));
  const auto digits = [&](double power) {
    return static_cast<int>(std::clamp(4 + power * (1 - magnitude), 0.0, 15.0));
  };
  for (const NamedDisk& named : disks) {
    bool first = true;
    for (const Minimum& minimum : minima(named.disk)) {
      const HeldDisk& disk = named.disk;
      std::vector<std::string> row{"", "", "", ""};
      if (first)
        row = {named.name, fmt::format("{:.6g}°", degrees(disk.phi)),
               fmt::format("{:.5g}", disk.mu1), fmt::format("{:.5g}", disk.mu2)};
      first = false;
      for (std::string cell :
           {std::string(1, minimum.name), degrees_text(minimum.theta),
            fixed(minimum.alpha, digits(1)), fixed(minimum.V, digits(2)),
            fixed(std::sqrt(minimum.V), digits(1)), std::string(to_string(minimum.kind))})
        row.push_back(std::move(cell));
      table.add(std::move(row));
    }
  }
  return table.text(style);
}

std::string minima_document(const std::string& out, const GivenDisk& asked,
                            const std::vector<NamedDisk>& disks) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  Json result = {{"poise_result", 1},
                 {"command", "paper"},
                 {"options",
                  {{"out", out},
                   {"phi_deg", or_null(asked.phi_deg)},
                   {"mu1", or_null(asked.mu1)},
                   {"mu2", or_null(asked.mu2)},
                   {"weight", asked.weight}}},
                 {"disks", Json::array()}};
  for (const NamedDisk& named : disks) {
    Json list = Json::array();
    for (const Minimum& minimum : minima(named.disk))
      list.push_back({{"name", std::string(1, minimum.name)},
                      {"angle_deg", degrees(minimum.theta)},
                      {"effort", minimum.V},
                      {"force_norm", std::sqrt(minimum.V)},
                      {"internal_force", minimum.alpha},
                      {"kind", to_string(minimum.kind)}});
    result["disks"].push_back({{"name", named.name},
                               {"phi_deg", degrees(named.disk.phi)},
                               {"mu1", named.disk.mu1},
                               {"mu2", named.disk.mu2},
                               {"weight", named.disk.weight},
                               {"minima", std::move(list)}});
  }
  return json_text(result);
}

}  // namespace poise::study
