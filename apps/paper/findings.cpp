#include "apps/paper/findings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "apps/paper/counts.hpp"
#include "apps/paper/exact.hpp"
#include "apps/paper/minima.hpp"
#include "apps/paper/sampling.hpp"
#include "files/degrees.hpp"
#include "poise/best_posture.hpp"

namespace poise::study {
namespace {

constexpr std::uint64_t seed = 1;

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

/// Findings 1 to 3: what is printed.
void write_misprints(Page& page, const PaperDisks& disks) {
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
      "3(c) with μ = 1/√3 + 0.01 lies just above it. For 2φ = 60° it would be {:.6f}: none of the "
      "frictions of Fig. 3 is above it.\n",
      1 / std::tan(pi / 3), 1 / std::tan(pi / 6));

  const HeldDisk& limit = disks.fig4c.disk;
  const HeldDisk& more = disks.fig4c_more.disk;
  page.line("## 3. Fig. 4(c) has no finite value\n");
  page.line(
      "For φ = 45° and μ = 1 it is μ sin φ − cos φ = {:g}: α₅ and α₆ are infinite, and only the "
      "ends of the range, ±{}, can be held ({} minima in the case list). With μ = 1.01 b costs V = "
      "{} N².\n",
      limit.d1(), degrees_text(limit.range()), minima(limit).size(), fixed(V(more, 0), 1));
}

/// Findings 4 and 5: closed forms.
void write_closed_forms(Page& page, const PaperDisks& disks) {
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
}

/// Findings 6 and 7: whether b is a minimum, and the best.
void write_whether_b_is_best(Page& page, const PaperDisks& disks) {
  const DiskCounts counts = count_disks(20000, seed);
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
      return std::max(least_other_friction(disk.phi, other), 1 / std::tan(disk.phi));
    };
    page.line("| {} | {:.6f} | {:.6f} | {:.6f} | {:.6f} |", named.name, disk.mu1, bound(disk.mu2),
              disk.mu2, bound(disk.mu1));
  }
  page.line("");

  page.line("## 7. Outside its range the disk is held with less\n");
  page.line("The best of all postures, over the whole circle:\n");
  page.line("| disk | posture | | V [N²] | V at a and c | V at b |\n|---|---|---|---|---|---|");
  for (const NamedDisk& named : disks.all()) {
    const std::vector<Minimum> in_range = minima(named.disk);
    const Best<2> best = best_posture(grasp_of(named.disk));
    page.line("| {} | {} | {} | {:.4f} | {:.4f} | {} |", named.name,
              degrees_text(best.best().optimum.angle), to_string(best.best().manner),
              best.best().optimum.value, in_range.front().V,
              in_range.size() == 3 ? fixed(in_range[1].V, 4) : "–");
  }
  page.line("");
}

void write_findings_beyond_the_disk(Page& page) {
  const EllipseCounts centred = count_ellipses(20000, 0, seed);
  const EllipseCounts off = count_ellipses(20000, 0.5, seed);
  page.line("## Beyond the disk: how often the meeting point is best\n");
  page.line(
      "Random ellipses in two contacts: semi-axes 1 and [0.3, 1], contacts anywhere on the "
      "boundary, one friction in [0.1, 1.5] for both, seed {}; the centre of mass in the centre, "
      "or off it "
      "by up to half of each semi-axis. The best of all postures is\n",
      seed);
  page.line("| | in the centre | off it |\n|---|---|---|");
  const auto row = [&](const char* what, auto part, auto whole) {
    page.line("| {} | {} | {} |", what, of(part(centred), whole(centred)),
              of(part(off), whole(off)));
  };
  const auto held = [](const EllipseCounts& c) { return c.ellipses - c.unholdable; };
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
    const SamplesNeeded coarse = samples_needed(named.disk, 1e-3);
    const SamplesNeeded fine = samples_needed(named.disk, 1e-6);
    page.line("| {} | {} | {} | {} | {} |", named.name, coarse.V, fine.V, coarse.theta, fine.theta);
  }
}

}  // namespace

std::string findings(const PaperDisks& disks) {
  Page page;
  page.line("# What checking the paper showed\n");
  page.line("Written by `build/paper`; every number is computed. docs/paper.md tells the story.\n");
  write_misprints(page, disks);
  write_closed_forms(page, disks);
  write_whether_b_is_best(page, disks);
  write_findings_beyond_the_disk(page);
  write_sampling(page, disks);
  page.line("\n## All minima in the range |θ| ≤ π − φ\n");
  page.line("```text\n{}```", minima_table(disks.all(), {}));
  return page.text();
}

}  // namespace poise::study
