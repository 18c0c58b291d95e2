// What the paper has no figures of: where b is a minimum, errors of sampling, V of many disks.
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/paper/figure_parts.hpp"
#include "apps/paper/figures.hpp"
#include "apps/paper/sampling.hpp"

namespace poise::study {

std::string minimum_figure(const std::vector<NamedDisk>& disks) {
  std::vector<double> angles;
  for (const NamedDisk& named : disks) angles.push_back(named.disk.phi);
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end(),
                           [](double one, double two) { return std::abs(one - two) < 1e-9; }),
               angles.end());
  const double count = static_cast<double>(angles.size()), width = 420 * count;
  constexpr double low = 1e-3, high = 100;  // of the friction beyond cot(phi)
  Script script;
  begin_picture(script, width, 560, true);
  headline(script, "Is b a minimum of V?", 0.95);
  script.line("set key at screen 0.5,0.035 center center width 2");
  script.line("set border 3 lc rgb '{}'\nset tics nomirror out\nset logscale xy", line_colour);
  script.line("set xrange [{0}:{1}]\nset yrange [{0}:{1}]", low, high);
  script.line("set tics format '10^{{%L}}'");
  script.line("set xlabel 'μ₁ − cot φ'\nset ylabel 'μ₂ − cot φ' offset 0.6,0");
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double phi = angles[k], least = 1 / std::tan(phi);
    const double left = static_cast<double>(k) / count;
    place(script, left + 85 / width, left + 1 / count - 15 / width, 0.25, 0.85);
    script.line("set title 'φ = {:.6g}°' offset 0,-0.5", degrees(phi));
    Line below, beside;  // its mirror image
    constexpr int steps = 300;
    for (int j = 0; j <= steps; ++j) {
      const double excess = low * std::pow(high / low, static_cast<double>(j) / steps);
      const double other = least_other_friction(phi, least + excess) - least;
      below.emplace_back(excess, std::max(other, low));
      beside.emplace_back(std::max(other, low), excess);
    }
    below.emplace_back(high, low);
    beside.emplace_back(low, high);
    script.data("below", {below});
    script.data("beside", {beside});
    script.layer(
        "$below with filledcurves closed fc rgb '{0}' fs solid border lc rgb '{1}' title "
        "'no: V falls on through b'",
        unholdable_colour, line_colour);
    script.layer("$beside with filledcurves closed fc rgb '{}' fs solid border lc rgb '{}' notitle",
                 unholdable_colour, line_colour);
    const auto answer = [&](const char* word, double x, double y) {
      script.line("set label '{}' at {},{} center front font 'sans-serif:Bold,16'", word, x, y);
    };
    answer("yes", 20, 20);
    if (below[steps / 3].y() > 4 * low) {
      answer("no", 0.05, 0.003);
      answer("no", 0.003, 0.05);
    }
    Line points;
    for (const NamedDisk& named : disks)
      if (std::abs(named.disk.phi - phi) < 1e-9 && named.disk.can_be_squeezed()) {
        points.emplace_back(named.disk.mu1 - least, named.disk.mu2 - least);
        script.line("set label '{}' at {},{} left offset 0.7,-0.2 front font ',12'", named.name,
                    points.back().x(), points.back().y());
      }
    if (!points.empty()) {
      script.data("sets", {points});
      script.layer(
          "$sets with points pt 7 ps 0.8 lc rgb 'black' title 'parameters of the figures'");
    }
    script.plot();
    script.line("unset label\nunset ylabel\nset key off");
  }
  script.line("unset multiplot");
  return script.text();
}

std::string sampling_figure(const std::vector<NamedDisk>& disks) {
  Script script;
  begin_picture(script, 1100, 520, true);
  headline(script, "The error of sampling θ evenly", 0.95);
  script.line("set key at screen 0.5,0.04 center center");
  script.line("set border 3 lc rgb '{}'\nset tics nomirror out\nset logscale xy", line_colour);
  script.line("set xrange [10:1e7]\nset yrange [1e-8:1]\nset tics format '10^{{%L}}'");
  script.line("set grid ytics lc rgb '#dddddd'\nset xlabel 'samples over the range'");
  constexpr std::array<const char*, 6> colours{"#0b5394", "#e69138", "#38761d",
                                               "#a61c00", "#3d85c6", "#9fc5e8"};
  for (const bool in_V : {true, false}) {
    place(script, in_V ? 0.08 : 0.57, in_V ? 0.49 : 0.98, 0.24, 0.85);
    script.line("set title '{}' offset 0,-0.5",
                in_V ? "in V(b), relative" : "in the posture b, radians");
    for (std::size_t k = 0; k < disks.size(); ++k) {
      Line line;
      std::size_t last = 0;
      for (double n = 10; n < 1e7; n *= 1.06) {
        const auto samples = static_cast<std::size_t>(n);
        if (samples == last) continue;
        last = samples;
        const SamplingError error = sampling_error(disks[k].disk, samples);
        const double shown = in_V ? error.V : error.theta;
        if (shown > 1e-9) line.emplace_back(n, shown);
      }
      script.data(fmt::format("error{}{}", k, in_V ? 'V' : 't'), {line});
      script.layer("$error{}{} with points pt 7 ps 0.35 lc rgb '{}' title '{}: {}'", k,
                   in_V ? 'V' : 't', colours[k % 6], disks[k].name, parameters(disks[k].disk));
    }
    script.plot();
    script.line("set key off\nunset label");
  }
  script.line("unset multiplot");
  return script.text();
}

std::string efforts_figure(const std::string& title, const std::vector<NamedDisk>& disks) {
  Script script;
  begin_picture(script, 900, 560, true);
  place(script, 0.1, 0.73, 0.16, 0.92);
  script.line("set key at screen 0.745,0.9 left top vertical width 0");
  script.line("set title '{}' offset 0,-0.5", title);
  script.line("set border 3 lc rgb '{}'\nset tics nomirror out", line_colour);
  script.line("set xrange [-180:180]\nset xtics 45 format '%.0f°'\nset minussign\nset logscale y");
  script.line("set ytics format '10^{{%L}}'\nset yrange [{}:]",
              disks.front().disk.weight * disks.front().disk.weight / 2);
  script.line("set xlabel 'object turned counter-clockwise by θ'\nset ylabel 'V [N²]'");
  constexpr std::array<const char*, 6> colours{"#0b5394", "#3d85c6", "#9fc5e8",
                                               "#38761d", "#e69138", "#a61c00"};
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const HeldDisk& disk = disks[k].disk;
    script.data(fmt::format("effort{}", k), effort_lines(disk));
    script.layer("$effort{} with lines lw 2.5 lc rgb '{}' title '{}'", k, colours[k % 6],
                 parameters(disk));
    Line points;
    for (const Minimum& minimum : minima(disk))
      points.emplace_back(degrees(minimum.theta), minimum.V);
    script.data(fmt::format("minima{}", k), {points});
    script.layer("$minima{} with points pt 7 ps 0.8 lc rgb '{}' notitle", k, colours[k % 6]);
  }
  script.plot();
  script.line("unset multiplot");
  return script.text();
}

}  // namespace poise::study
