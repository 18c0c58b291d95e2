#include "apps/paper/figure_parts.hpp"

#include <algorithm>
#include <cmath>

namespace poise::study {
namespace {

constexpr const char* outside_colour = "#ececec";  // of the range

}  // namespace

void headline(Script& script, const std::string& text, double height) {
  script.line("set label 1000 {} at screen 0.5,{} center font 'sans-serif,18'", quoted(text, 120),
              height);
}

void place(Script& script, double left, double right, double bottom, double top) {
  script.line("set lmargin at screen {}\nset rmargin at screen {}", left, right);
  script.line("set bmargin at screen {}\nset tmargin at screen {}", bottom, top);
}

void posture_axis(Script& script, const HeldDisk& disk) {
  script.line("set border 3 lc rgb '{}'\nset tics nomirror out", line_colour);
  script.line("set xrange [-180:180]\nset xtics 45 format '%.0f°'\nset minussign");
  const double range = degrees(disk.range());
  for (const double side : {-1.0, 1.0})
    script.line(
        "set object rectangle from {},graph 0 to {},graph 1 fc rgb '{}' fs solid noborder behind",
        side * range, side * 180, outside_colour);
}

std::vector<Line> effort_lines(const HeldDisk& disk) {
  const double b = theta_b(disk), end = disk.range();
  std::vector<Line> lines;
  if (disk.d2() > 0 && b > -end) lines.push_back(sampled(-end, std::min(b, end), V_6(disk)));
  if (disk.d1() > 0 && b < end) {
    Line line = sampled(std::max(b, -end), end, V_5(disk));
    if (disk.can_be_squeezed())
      lines.back().insert(lines.back().end(), line.begin(), line.end());
    else
      lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<study::Minimum> marked_postures(const HeldDisk& disk) {
  std::vector<study::Minimum> marked = minima(disk);
  const double b = theta_b(disk);
  if (marked.size() == 2 && disk.can_be_squeezed())
    marked.insert(marked.begin() + 1, {'b', b, V(disk, b), alpha_bar(disk, b), Kind::kink});
  return marked;
}

std::optional<double> arrow_scale(const HeldDisk& disk,
                                  const std::vector<study::Minimum>& postures) {
  double largest = disk.weight;
  for (const study::Minimum& posture : postures) {
    const study::Forces f = forces(disk, posture.theta, posture.alpha);
    largest = std::max({largest, std::hypot(f.N1, f.F1), std::hypot(f.N2, f.F2)});
  }
  if (largest > 3 * disk.weight) return {};
  return 0.34 * disk.radius / disk.weight;
}

}  // namespace poise::study
