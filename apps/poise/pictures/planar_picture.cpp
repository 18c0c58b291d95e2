#include <algorithm>
#include <cmath>
#include <numbers>

#include "files/degrees.hpp"
#include "pictures/pictures.hpp"
#include "pictures/plot.hpp"
#include "pictures/scene.hpp"
#include "poise/grip.hpp"
#include "tables/parts.hpp"
#include "tables/table.hpp"

namespace poise {
namespace {

using std::numbers::pi;

// The picture [pixels].
constexpr double picture_width = 1200, picture_height = 580;
constexpr double object_width = 0.42 * picture_width, object_height = 0.72 * picture_height;

/// The parts of an interval of postures within [-180, 180] degrees.
std::vector<Interval> on_axis(const Interval& interval) {
  std::vector<Interval> parts;
  for (const double turn : {-2 * pi, 0.0, 2 * pi}) {
    const Interval part{std::max(interval.from + turn, -pi), std::min(interval.to + turn, pi)};
    if (part.from < part.to) parts.push_back(part);
  }
  return parts;
}

void shade(Script& script, const Interval& interval, const char* colour) {
  for (const Interval& part : on_axis(interval))
    script.line(
        "set object rectangle from {},graph 0 to {},graph 1 fc rgb '{}' fs solid noborder behind",
        degrees(part.from), degrees(part.to), colour);
}

/// What is drawn of a value of the curve: the grip, or the force norm √V.
double height(const PostureCurve& curve, double value) {
  const double least = std::max(0.0, value);
  return curve.objective == Objective::grip ? least : std::sqrt(least);
}

/// "grip to command [N]"
std::string axis_text(const Grasp<2>& grasp, const PostureCurve& curve) {
  return curve.objective == Objective::grip
             ? fmt::format("grip to command [{}]", to_string(grip_unit(grasp)))
             : "force norm √V [N]";
}

/// "grip 1.184 N"
std::string value_text(const Grasp<2>& grasp, const Posture<2>& posture) {
  return posture.hold().objective == Objective::grip
             ? "grip " + grip_text(grasp, posture.hold().grip)
             : "force norm " + newtons(std::sqrt(posture.effort()));
}

/// Along the arcs, sharp at their ends, broken where nothing holds.
std::vector<std::vector<Vector<2>>> curve_lines(const PostureCurve& curve) {
  std::vector<std::vector<Vector<2>>> lines;
  for (const Arc& arc : curve.arcs)
    for (const Interval& part : on_axis({arc.from, arc.to})) {
      const double length = part.to - part.from;
      const int steps = std::max(8, static_cast<int>(std::ceil(length / (pi / 360))));
      std::vector<Vector<2>> line;
      for (int k = 0; k <= steps; ++k) {
        const double theta = part.from + length * k / steps;
        line.emplace_back(degrees(theta), height(curve, arc.value(theta)));
      }
      if (!lines.empty() && lines.back().back().x() == line.front().x())
        lines.back().insert(lines.back().end(), line.begin(), line.end());
      else
        lines.push_back(std::move(line));
    }
  return lines;
}

Vector<2> marker(const PostureCurve& curve, const Optimum& optimum) {
  return {degrees(optimum.angle), height(curve, optimum.value)};
}

void draw_optima(Script& script, const PostureCurve& curve) {
  const struct {
    bool maximum;
    Kind kind;
    int symbol;
    const char* name;
  } sorts[] = {{false, Kind::kink, 13, "minimum: kink"},
               {false, Kind::smooth, 7, "minimum: smooth"},
               {false, Kind::boundary, 5, "minimum: boundary"},
               {true, Kind::kink, 12, "maximum: kink"},
               {true, Kind::smooth, 6, "maximum: smooth"},
               {true, Kind::boundary, 4, "maximum: boundary"}};
  for (const auto& sort : sorts) {
    std::vector<std::vector<Vector<2>>> points(1);
    for (const Optimum& optimum : curve.optima)
      if (optimum.maximum == sort.maximum && optimum.kind == sort.kind)
        points[0].push_back(marker(curve, optimum));
    if (points[0].empty()) continue;
    const std::string name = fmt::format("optima{}", sort.symbol);
    script.data(name, points);
    script.layer("${} with points pt {} ps 1.3 lw 1.5 lc rgb '{}' title '{}'", name, sort.symbol,
                 force_colour, sort.name);
  }
}

void plot_curve(Script& script, const PlanarFile& file, const Grasp<2>& grasp,
                const BestAnswer<2>& answer) {
  const Best<2>& best = answer.best;
  const PostureCurve& curve = best.proof.curve;
  const auto lines = curve_lines(curve);
  const Interval fork = fork_wedge(grasp, grasp.loads().front().com);
  if (fork.from < fork.to) shade(script, fork, fork_colour);
  for (const UnholdableArc& arc : curve.unholdable_arcs)
    shade(script, {arc.from, arc.to}, unholdable_colour);

  // From nothing, or by factors of ten where the curve climbs far above its lowest point. Beyond a
  // thousand times that, or the last minimum, there is nothing to be seen.
  double low = 0, high = 1, highest_minimum = 0;
  if (best.holdable()) {
    low = high = height(curve, best.best().optimum.value);
    for (const Minimum<2>& minimum : best.minima)
      highest_minimum = std::max(highest_minimum, height(curve, minimum.optimum.value));
    for (const auto& line : lines)
      for (const Vector<2>& point : line) high = std::max(high, point.y());
    high = std::min(high, std::max(1000 * low, 3 * highest_minimum));
  }
  const bool log = low > 0 && high > 20 * low;
  const double bottom = log ? 0.7 * low : 0, top = (log ? 1.6 : 1.1) * high;
  if (log) script.line("set logscale y");
  script.line("set xrange [-180:180]\nset yrange [{}:{}]", bottom, top);
  script.line("set xtics 45 format '%.0f°'\nset ytics autofreq\nset grid lc rgb '#dddddd'");
  script.line("set border 3 lc rgb '{}'\nset tics nomirror out", line_colour);
  script.line("set xlabel 'object turned counter-clockwise'\nset ylabel '{}'",
              axis_text(grasp, curve));
  if (!best.holdable()) {
    script.layer("NaN notitle");
    script.line("unset ytics");
    script.line("set label 'cannot be held in any posture' at graph 0.5,0.5 center front");
  }
  if (!lines.empty()) {
    script.data("curve", lines);
    script.layer("$curve with lines lw 2.5 lc rgb '{}' notitle", force_colour);
  }
  draw_optima(script, curve);
  const auto ring = [&](const char* name, const Minimum<2>& posture, int symbol,
                        const char* meaning) {
    script.data(name, {{marker(curve, posture.optimum)}});
    script.layer("${} with points pt {} ps 1.8 lw 2 lc rgb '{}' title '{} {}'", name, symbol,
                 best_colour, meaning, degrees_text(posture.optimum.angle));
  };
  if (best.holdable()) ring("best", best.best(), 6, "best");
  if (best.pinched && *best.pinched != 0) ring("pinched", *best.best_pinched(), 4, "best pinched");
  if (file.angle) {
    const double now = degrees(*file.angle);
    script.data("now", {{{now, bottom}, {now, top}}});
    script.layer("$now with lines dt 2 lc rgb '{}' title 'now {}'", line_colour,
                 degrees_text(*file.angle));
  }
  if (!curve.unholdable_arcs.empty())
    script.layer("keyentry with boxes fs solid fc rgb '{}' title 'cannot be held'",
                 unholdable_colour);
  if (fork.from < fork.to)
    script.layer("keyentry with boxes fs solid fc rgb '{}' title 'in the fork{}'", fork_colour,
                 answer.settings.domain == Domain::pinching_up ? " (left out)" : "");
  script.plot();
}

}  // namespace

void draw_curve(const PlanarFile& file, const Grasp<2>& grasp, const BestAnswer<2>& answer,
                const std::string& path) {
  const Best<2>& best = answer.best;
  const Minimum<2>* posture = best.best_pinched();
  if (!posture && best.holdable()) posture = &best.best();
  const Scene scene{.grasp = grasp,
                    .theta = posture ? posture->optimum.angle : file.angle.value_or(0),
                    .hold = posture && posture->holdable() ? &posture->hold() : nullptr,
                    .load = posture ? posture->decides : 0};
  std::string posture_title = "cannot be held";
  if (posture)
    posture_title = fmt::format("{} posture: {}, {}", best.pinched ? "best pinched" : "best",
                                degrees_text(scene.theta), value_text(grasp, *posture));

  Script script;
  begin_picture(script, picture_width, picture_height);

  constexpr double top = 0.85;
  script.line("set tmargin at screen {}\nset bmargin at screen {}", top,
              top - object_height / picture_height);
  script.line("set lmargin at screen 0\nset rmargin at screen {}", object_width / picture_width);
  script.line("set label {} at screen 0.5,0.96 center font 'sans-serif,20'",
              quoted(file.name.empty() ? "held object" : file.name, 70));
  script.line("unset border\nunset tics\nset title '{}'", posture_title);
  draw_object(script, file.shape, scene, posture, object_width / object_height);

  script.line("set lmargin at screen 0.49\nset rmargin at screen 0.98\nset bmargin at screen 0.32");
  script.line("set key width -1\nset title 'least {} by posture'",
              answer.best.proof.curve.objective == Objective::grip ? "grip" : "force norm");
  plot_curve(script, file, grasp, answer);
  script.line("unset multiplot");
  draw(script.text(), path);
}

void draw_posture(const PlanarFile& file, const Grasp<2>& grasp, const Posture<2>& posture,
                  const std::string& words, const std::string& path) {
  const bool svg = has_ending(path, ".svg");
  constexpr double width = 700, height = 640, top = 0.86, bottom = 0.08;
  Script script;
  if (svg)
    begin_picture(script, width, height);
  else
    begin_png(script, width, height);
  script.line("set lmargin at screen 0\nset rmargin at screen 1");
  script.line("set tmargin at screen {}\nset bmargin at screen {}", top, bottom);
  script.line("set label {} at screen 0.5,0.96 center font 'sans-serif,{}'",
              quoted(file.name.empty() ? "held object" : file.name, 50), svg ? 20 : 15);
  script.line("unset border\nunset tics\nset title {}", quoted(words, 80));
  const Scene scene{.grasp = grasp,
                    .theta = angle_of(posture.up),
                    .hold = posture.holdable() ? &posture.hold() : nullptr,
                    .load = posture.decides};
  draw_object(script, file.shape, scene, nullptr, width / ((top - bottom) * height));
  script.line("unset multiplot");
  draw(script.text(), path);
}

}  // namespace poise
