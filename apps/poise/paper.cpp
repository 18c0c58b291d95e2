#include "paper.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "apps/paper/counts.hpp"
#include "apps/paper/exact.hpp"
#include "apps/paper/sampling.hpp"
#include "files/json_text.hpp"
#include "files/result.hpp"
#include "paper_figures.hpp"
#include "plot.hpp"
#include "poise/best_posture.hpp"

namespace poise {
namespace {

namespace fs = std::filesystem;
using study::HeldDisk;
using study::pi;

const double root3 = std::sqrt(3.0);
constexpr std::uint64_t seed = 1;

/// Whether b is a minimum between a and c.
bool has_b(const NamedDisk& named) {
  return named.disk.can_be_squeezed() && minima(named.disk).size() == 3;
}

/// The disks of the figures. In print phi is half of these angles: finding 2.
struct PaperDisks {
  NamedDisk fig3a, fig3b, fig3c, fig4a, fig4b, fig4c, fig4c_more, fig6;
  std::vector<NamedDisk> given{};  ///< by the user, or none

  explicit PaperDisks(const PaperArguments& arguments) {
    const auto disk = [&](const char* name, double phi, double mu1, double mu2) {
      return NamedDisk{name, {.phi = phi, .mu1 = mu1, .mu2 = mu2, .weight = arguments.weight}};
    };
    const double least = 1 / root3;
    fig3a = disk("Fig. 3(a)", pi / 3, root3, root3);
    fig3b = disk("Fig. 3(b)", pi / 3, 1, 1);
    fig3c = disk("Fig. 3(c)", pi / 3, least + 0.01, least + 0.01);
    fig4a = disk("Fig. 4(a)", 5 * pi / 12, 1, 1);
    fig4b = disk("Fig. 4(b)", pi / 3, 1, 1);
    fig4c = disk("Fig. 4(c)", pi / 4, 1, 1);
    fig4c_more = disk("Fig. 4(c), μ = 1.01", pi / 4, 1.01, 1.01);
    fig6 = disk("Fig. 6", 5 * pi / 12, 1, least);
    if (arguments.phi_deg || arguments.mu1 || arguments.mu2)
      given.push_back(disk("Given", arguments.phi_deg.value_or(75) * pi / 180,
                           arguments.mu1.value_or(1), arguments.mu2.value_or(least)));
  }

  /// Each set of parameters once.
  std::vector<NamedDisk> all() const {
    std::vector<NamedDisk> disks{fig3a, fig3b, fig3c, fig4a, fig4c, fig4c_more, fig6};
    disks[1].name += ", 4(b)";
    disks.insert(disks.end(), given.begin(), given.end());
    return disks;
  }
  std::vector<NamedDisk> with_b() const {
    std::vector<NamedDisk> disks = all();
    std::erase_if(disks, [](const NamedDisk& named) { return !has_b(named); });
    return disks;
  }
};

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
    for (const study::Minimum& minimum : minima(named.disk)) {
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

std::string minima_document(const PaperArguments& arguments, const std::vector<NamedDisk>& disks) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  Json result = {{"poise_result", 1},
                 {"command", "paper"},
                 {"options",
                  {{"out", arguments.out},
                   {"phi_deg", or_null(arguments.phi_deg)},
                   {"mu1", or_null(arguments.mu1)},
                   {"mu2", or_null(arguments.mu2)},
                   {"weight", arguments.weight}}},
                 {"disks", Json::array()}};
  for (const NamedDisk& named : disks) {
    Json list = Json::array();
    for (const study::Minimum& minimum : minima(named.disk))
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

// ---- Findings ----------------------------------------------------------------------------------

/// A page of markdown in the making.
class Page {
 public:
  template <class... Parts>
  void line(fmt::format_string<Parts...> format, Parts&&... parts) {
    text_ += fmt::format(format, std::forward<Parts>(parts)...) + "\n";
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_{};
};

/// Where alpha_5 = alpha_6, by halving the range.
double crossing(const HeldDisk& disk) {
  double low = -disk.range(), high = disk.range();
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    const auto all = alphas(disk, middle);
    (all[4] > all[5] ? high : low) = middle;
  }
  return (low + high) / 2;
}

/// The largest difference between the branches in closed form and (13), relative.
double largest_difference(const HeldDisk& disk) {
  const double b = theta_b(disk), scale = V(disk, b);
  double largest = 0;
  for (int k = 1; k < 1000; ++k) {
    const double theta = disk.range() * (k - 500) / 500;
    const double closed = (theta > b ? V_5(disk) : V_6(disk))(theta);
    largest = std::max(largest, std::abs(closed - V(disk, theta)) / scale);
  }
  return largest;
}

std::string of(std::size_t part, std::size_t whole) {
  return fmt::format("{} of {} ({:.1f} %)", part, whole,
                     100 * static_cast<double>(part) / static_cast<double>(whole));
}

void write_findings_on_the_paper(Page& page, const PaperDisks& disks) {
  const HeldDisk& a = disks.fig4a.disk;
  const double corrected = alphas(a, 0)[2];
  page.line("## 1. (22) and (23) lack a minus sign\n");
  page.line(
      "The conditions F₁ > 0 and F₂ > 0 begin at α = −Mg sin φ cos θ / (√2 cos φ). {} at θ = 0: "
      "with α = {} N it is F₁ = {} N, with α = {} N as printed F₁ = {} N.\n",
      disks.fig4a.name, fixed(corrected, 4), fixed(forces(a, 0, corrected).F1, 4),
      fixed(-corrected, 4), fixed(forces(a, 0, -corrected).F1, 4));

  page.line("## 2. The figures are drawn for φ, not 2φ, as given\n");
  page.line(
      "Squeezing helps only where μ > cot φ. For φ = 60° that limit is {:.6f} = 1/√3, and Fig. "
      "3(c) "
      "with μ = 1/√3 + 0.01 lies just above it. For 2φ = 60° it would be {:.6f}: none of the "
      "frictions of Fig. 3 is above it.\n",
      1 / std::tan(pi / 3), 1 / std::tan(pi / 6));

  const HeldDisk &limit = disks.fig4c.disk, &more = disks.fig4c_more.disk;
  page.line("## 3. Fig. 4(c) has no finite value\n");
  page.line(
      "For φ = 45° and μ = 1 it is μ sin φ − cos φ = {:g}: α₅ and α₆ are infinite, and only the "
      "ends "
      "of the range, ±{}, can be held ({} minima in the case list). With μ = 1.01 b costs V = {} "
      "N².\n",
      limit.d1(), degrees_text(limit.range()), minima(limit).size(), fixed(V(more, 0), 1));

  page.line("## 4. b has a closed form\n");
  page.line("tan θ_b = sin φ (μ₁ − μ₂) / (2 μ₁ μ₂ sin φ − (μ₁ + μ₂) cos φ).\n");
  page.line("| disk | θ_b, closed form | where α₅ = α₆, by bisection |\n|---|---|---|");
  for (const NamedDisk& named : disks.with_b())
    page.line("| {} | {:.10f}° | {:.10f}° |", named.name, degrees(theta_b(named.disk)),
              degrees(crossing(named.disk)) + 0.0);

  page.line("\n## 5. V is c₀ + c₁ cos 2θ + c₂ sin 2θ on each branch\n");
  page.line("| disk | branch | c₀ | c₁ | c₂ | largest difference to (13), relative to V(b) |");
  page.line("|---|---|---|---|---|---|");
  for (const NamedDisk& named : disks.with_b()) {
    const Harmonic2 left = V_6(named.disk), right = V_5(named.disk);
    page.line("| {} | θ < θ_b, α₆ | {:.4f} | {:.4f} | {:.4f} | {:.1e} |", named.name, left.c0,
              left.cos2, left.sin2, largest_difference(named.disk));
    page.line("| | θ > θ_b, α₅ | {:.4f} | {:.4f} | {:.4f} | |", right.c0, right.cos2, right.sin2);
  }

  const study::DiskCounts counts = study::count_disks(20000, seed);
  page.line("\n## 6. b is not always a minimum\n");
  page.line(
      "Of random disks (φ ∈ [0.3, π/2], μᵢ = cot φ + 10ᵘ, u ∈ [−3, 1], seed {}) V falls through b, "
      "and there is no minimum between a and c, in {}. A smooth minimum there is never.\n",
      seed, of(counts.b_is_no_minimum, counts.disks));

  page.line("b is a minimum where each friction is above a bound that the other one sets:\n");
  page.line("| disk | μ₁ | bound | μ₂ | bound |\n|---|---|---|---|---|");
  for (const NamedDisk& named : disks.all()) {
    const HeldDisk& disk = named.disk;
    if (!disk.can_be_squeezed()) continue;
    const auto bound = [&](double other) {
      return std::max(study::least_other_friction(disk.phi, other), 1 / std::tan(disk.phi));
    };
    page.line("| {} | {:.6f} | {:.6f} | {:.6f} | {:.6f} |", named.name, disk.mu1, bound(disk.mu2),
              disk.mu2, bound(disk.mu1));
  }
  page.line("");

  page.line("## 7. Outside its range the disk is held with less\n");
  page.line("The best of all postures, over the whole circle:\n");
  page.line("| disk | posture | | V [N²] | V at a and c | V at b |\n|---|---|---|---|---|---|");
  for (const NamedDisk& named : disks.all()) {
    const std::vector<study::Minimum> in_range = minima(named.disk);
    const BestPosture best = best_posture(grasp_of(named.disk));
    page.line("| {} | {} | {} | {:.4f} | {:.4f} | {} |", named.name,
              degrees_text(best.best().optimum.angle), to_string(best.best().manner),
              best.best().optimum.effort, in_range.front().V,
              in_range.size() == 3 ? fixed(in_range[1].V, 4) : "–");
  }
  page.line("");
}

void write_findings_beyond_the_disk(Page& page) {
  const study::EllipseCounts centred = study::count_ellipses(20000, 0, seed);
  const study::EllipseCounts off = study::count_ellipses(20000, 0.5, seed);
  page.line("## Beyond the disk: how often the meeting point is best\n");
  page.line(
      "Random ellipses in two contacts: semi-axes 1 and [0.3, 1], contacts anywhere on the "
      "boundary, "
      "one friction in [0.1, 1.5] for both, seed {}; the centre of mass in the centre, or off it "
      "by up "
      "to half of each semi-axis. The best of all postures is\n",
      seed);
  page.line("| | in the centre | off it |\n|---|---|---|");
  const auto row = [&](const char* what, auto part, auto whole) {
    page.line("| {} | {} | {} |", what, of(part(centred), whole(centred)),
              of(part(off), whole(off)));
  };
  const auto held = [](const study::EllipseCounts& c) { return c.ellipses - c.unholdable; };
  row(
      "a kink, where two cone edges meet on the vertical", [](auto& c) { return c.kink; }, held);
  row(
      "– of these pinched, not in the fork", [](auto& c) { return c.kink_pinched; }, held);
  row(
      "the end of what can be held, where two edges meet, too", [](auto& c) { return c.end; },
      held);
  row(
      "resting on one finger", [](auto& c) { return c.resting; }, held);
  row(
      "smooth", [](auto& c) { return c.smooth; }, held);
  row(
      "held in no posture", [](auto& c) { return c.unholdable; },
      [](auto& c) { return c.ellipses; });
  row(
      "the best *pinched* posture, where there is one, is where two edges meet",
      [](auto& c) { return c.pinched_where_edges_meet; }, [](auto& c) { return c.pinched; });
  page.line("");
}

void write_sampling(Page& page, const PaperDisks& disks) {
  page.line("## How many samples the paper's way needs\n");
  page.line("From so many samples on, evenly over the range, the error stays below\n");
  page.line("| disk | 1e-3 in V | 1e-6 in V | 1e-3 rad | 1e-6 rad |\n|---|---|---|---|---|");
  for (const NamedDisk& named : disks.with_b()) {
    const study::SamplesNeeded coarse = samples_needed(named.disk, 1e-3);
    const study::SamplesNeeded fine = samples_needed(named.disk, 1e-6);
    page.line("| {} | {} | {} | {} | {} |", named.name, coarse.V, fine.V, coarse.theta, fine.theta);
  }
}

std::string findings(const PaperDisks& disks) {
  Page page;
  page.line("# What checking the paper showed\n");
  page.line("Written by `poise paper`; every number is computed. docs/paper.md tells the story.\n");
  write_findings_on_the_paper(page, disks);
  write_findings_beyond_the_disk(page);
  write_sampling(page, disks);
  page.line("\n## All minima in the range |θ| ≤ π − φ\n");
  page.line("```text\n{}```", minima_table(disks.all(), {}));
  return page.text();
}

void make_directory(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw OutputError(path + ": cannot be made a directory: " + error.message());
}

}  // namespace

std::string paper(const PaperArguments& arguments, bool json, const Style& style) {
  const PaperDisks disks(arguments);
  make_directory(arguments.out);
  std::vector<std::string> written;
  const auto file = [&](const std::string& name) {
    written.push_back(name);
    return (fs::path(arguments.out) / name).string();
  };

  const std::vector<NamedDisk> all = disks.all();
  write_file(minima_table(all, {}), file("minima.txt"));
  const auto range = [](NamedDisk disk, const std::string& title) {
    disk.name = title;
    return range_figure(disk);
  };
  draw(range(disks.fig4a, "Fig. 2: the range of pinching up"), file("figure-2.svg"));
  draw(curves_figure({disks.fig3a}), file("figure-3a.svg"));
  draw(curves_figure({disks.fig3b}), file("figure-3b.svg"));
  draw(curves_figure({disks.fig3c}), file("figure-3c.svg"));
  draw(curves_figure({disks.fig4a}), file("figure-4a.svg"));
  draw(curves_figure({disks.fig4b}), file("figure-4b.svg"));
  draw(curves_figure({disks.fig4c, disks.fig4c_more}), file("figure-4c.svg"));
  draw(efforts_figure("Fig. 5: V for equal frictions",
                      {disks.fig3a, disks.fig3b, disks.fig3c, disks.fig4a, disks.fig4c_more}),
       file("figure-5.svg"));
  draw(curves_figure({disks.fig6}), file("figure-6.svg"));
  draw(postures_figure({"Fig. 7: the postures a, b and c", disks.fig6.disk}), file("figure-7.svg"));
  for (const NamedDisk& given : disks.given) {
    draw(range(given, "The range of pinching up"), file("given-range.svg"));
    draw(curves_figure({given}), file("given-curves.svg"));
    draw(postures_figure(given), file("given-postures.svg"));
  }
  std::vector<NamedDisk> mapped{disks.fig4c_more, disks.fig3a, disks.fig3b,
                                disks.fig3c,      disks.fig4a, disks.fig6};
  mapped.insert(mapped.end(), disks.given.begin(), disks.given.end());
  draw(minimum_figure(mapped), file("when-b-is-a-minimum.svg"));
  std::vector<NamedDisk> to_sample{disks.fig3c, disks.fig6};
  for (const NamedDisk& given : disks.given)
    if (has_b(given)) to_sample.push_back(given);
  draw(sampling_figure(to_sample), file("sampling.svg"));
  write_file(findings(disks), file("findings.md"));

  if (json) return minima_document(arguments, all);
  std::string names;
  for (const std::string& name : written) names += (names.empty() ? "" : ", ") + name;
  return style.bold("Minima in the range of pinching up") + "\n" + minima_table(all, style) + "\n" +
         wrapped("Wrote " + names + " to " + arguments.out + ".");
}

}  // namespace poise
