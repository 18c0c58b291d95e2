// What is needed over a motion, as a curve over time.
#include "ask/motion.hpp"

#include <algorithm>
#include <cmath>

#include "pictures/pictures.hpp"
#include "pictures/plot.hpp"
#include "pictures/script.hpp"
#include "poise/grip.hpp"

namespace poise {
namespace {

/// Of more poses the least and the most of each so many are drawn: no picture has more columns.
constexpr std::size_t most_points = 4000;

double told(const MotionReport& report, double value) {
  return report.settings.objective == Objective::grip ? value : std::sqrt(value);
}

/// Stretches without a pose that nothing holds.
std::vector<std::vector<Vector<2>>> lines(const MotionReport& report) {
  std::vector<std::vector<Vector<2>>> groups(1);
  const std::size_t n = report.states.size(), each = 2 * n / most_points + 1;
  const auto add = [&](std::size_t k) {
    const double value = report.motion.needs[k].value;
    if (std::isfinite(value))
      groups.back().push_back({report.states[k].time, told(report, value)});
    else if (!groups.back().empty())
      groups.emplace_back();
  };
  const auto& needs = report.motion.needs;
  for (std::size_t from = 0; from < n; from += each) {
    const auto first = needs.begin() + static_cast<std::ptrdiff_t>(from);
    const auto last = needs.begin() + static_cast<std::ptrdiff_t>(std::min(from + each, n));
    const auto [low, high] = std::minmax_element(
        first, last, [](const auto& a, const auto& b) { return a.value < b.value; });
    const auto [one, other] = std::minmax({low - needs.begin(), high - needs.begin()});
    add(static_cast<std::size_t>(one));
    if (other != one) add(static_cast<std::size_t>(other));
  }
  if (groups.back().empty()) groups.pop_back();
  return groups;
}

/// Grey where it is not held.
void draw_slips(Script& script, const MotionReport& report) {
  const auto& needs = report.motion.needs;
  const auto& states = report.states;
  for (std::size_t k = 0; k < needs.size();) {
    if (needs[k++].held) continue;
    const std::size_t from = k - 1;
    while (k < needs.size() && !needs[k].held) ++k;
    script.line(
        "set object rectangle from {},graph 0 to {},graph 1 behind fs solid noborder fc rgb '{}'",
        states[from].time, states[k - 1].time, unholdable_colour);
  }
}

}  // namespace

void draw_motion(const std::string& name, const Grasp<3>& grasp, const MotionReport& report,
                 const std::string& path) {
  const bool by_grip = report.settings.objective == Objective::grip;
  const std::string unit = by_grip ? to_string(grip_unit(grasp)) : "N";
  const MotionAnswer& motion = report.motion;
  const double first = report.states.front().time, last = report.states.back().time;
  const double most = by_grip ? most_grip(grasp) : std::numeric_limits<double>::infinity();
  double top = 0;
  const auto groups = lines(report);
  for (const auto& group : groups)
    for (const Vector<2>& point : group) top = std::max(top, point.y());
  if (std::isfinite(most) && most < 5 * top) top = std::max(top, most);
  Script script;
  begin_picture(script, 900, 480);
  script.line("set lmargin at screen 0.1\nset rmargin at screen 0.97");
  script.line(
      "set tmargin at screen 0.8\nset bmargin at screen 0.17\nset key at screen 0.53,0.87 center "
      "maxrows 1");
  script.line("set label {} at screen 0.5,0.95 center font 'sans-serif,20'",
              quoted(name.empty() ? "held object" : name, 70));
  script.line("set xrange [{}:{}]\nset yrange [0:{}]", first, last > first ? last : first + 1,
              top > 0 ? 1.1 * top : 1);
  script.line("set grid lc rgb '#dddddd'\nset border 3 lc rgb '{}'\nset tics nomirror out",
              line_colour);
  script.line("set xlabel 'time [s]'\nset ylabel 'least {} [{}]'", by_grip ? "grip" : "force norm",
              unit);
  draw_slips(script, report);
  script.layer("NaN notitle");
  if (!groups.empty()) {
    script.data("need", groups);
    script.layer("$need with lines lw 2 lc rgb '{}' notitle", force_colour);
  }
  if (std::isfinite(most) && most <= top) {
    script.data("most", {{{first, most}, {last, most}}});
    script.layer("$most with lines dt 2 lw 2 lc rgb '{}' title 'what the drives give'",
                 limit_colour);
  }
  if (const double value = told(report, motion.needs[motion.peak].value); std::isfinite(value)) {
    script.data("peak", {{{report.states[motion.peak].time, value}}});
    script.layer("$peak with points pt 6 ps 1.8 lw 2 lc rgb '{}' title 'most{}'", best_colour,
                 motion.cause ? std::string(", by the ") +
                                    (*motion.cause == LoadTerm::weight    ? "weight"
                                     : *motion.cause == LoadTerm::linear  ? "acceleration"
                                     : *motion.cause == LoadTerm::angular ? "angular acceleration"
                                                                          : "turning")
                              : "");
  }
  if (motion.slip)
    script.layer("keyentry with boxes fs solid fc rgb '{}' title 'it slips'", unholdable_colour);
  script.plot();
  script.line("unset multiplot");
  draw(script.text(), path);
}

}  // namespace poise
