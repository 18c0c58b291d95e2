// Figs. 2 and 7: the disk as it hangs.
#include <cmath>

#include "apps/paper/figure_parts.hpp"
#include "apps/paper/figures.hpp"
#include "pictures/scene.hpp"
#include "tables/table.hpp"

namespace poise::study {

std::string postures_figure(const std::string& title, const HeldDisk& disk) {
  const Grasp<2> grasp = grasp_of(disk);
  const std::vector<Minimum> marked = marked_postures(disk);
  const double count = static_cast<double>(marked.size()), width = 520 * count, height = 560;
  Script script;
  begin_picture(script, width, height);
  headline(script, title + ": " + parameters(disk), 0.955);
  script.line("set key at screen 0.5,0.04 center center\nunset border\nunset tics");
  for (std::size_t k = 0; k < marked.size(); ++k) {
    const Minimum& minimum = marked[k];
    const double left = static_cast<double>(k) / count;
    place(script, left, left + 1 / count, 0.09, 0.85);
    const poise::Minimum<2> posture =
        minimum_at(grasp, {.angle = minimum.theta,
                           .from = minimum.theta,
                           .to = minimum.theta,
                           .value = minimum.V,
                           .kind = minimum.name == 'b' ? Kind::kink : minimum.kind});
    script.line("set title '{}: θ = {}, force norm {}' offset 0,-1", minimum.name,
                degrees_text(minimum.theta), newtons(std::sqrt(minimum.V)));
    script.line("set key {}", minimum.name == 'b' || marked.size() == 2 ? "on" : "off");
    draw_object(script, Disk{disk.radius},
                {.grasp = grasp,
                 .theta = minimum.theta,
                 .hold = posture.holdable() ? &posture.hold() : nullptr,
                 .scale = arrow_scale(disk, marked)},
                &posture, width / count / (0.76 * height));
  }
  script.line("unset multiplot");
  return script.text();
}

namespace {

Vector<2> direction(double deg) { return up_at(deg * pi / 180); }

Line arc(double from, double to, double radius) {
  Line line;
  for (int k = 0; k <= 90; ++k) line.emplace_back(radius * direction(from + (to - from) * k / 90));
  return line;
}

Line sector(double from, double to, double radius) {
  Line line = arc(from, to, radius);
  line.insert(line.begin(), Vector<2>::Zero());
  line.emplace_back(Vector<2>::Zero());
  return line;
}

/// The range in the frame of the object.
void draw_range(Script& script, const HeldDisk& disk) {
  const double phi = degrees(disk.phi), range = 180 - phi;
  script.line("set title 'in the frame of the object'");
  script.line("set xrange [-1.75:1.75]\nset yrange [-1.5:1.6]");
  const auto label = [&](const std::string& text, const Vector<2>& at, const char* colour) {
    script.line("set label '{}' at {},{} center front textcolor rgb '{}'", text, at.x(), at.y(),
                colour);
  };
  script.data("disk", {arc(0, 360, 1)});
  script.data("range", {sector(-range, range, 1.3)});
  script.data("fork", {sector(range, 360 - range, 1.3)});
  std::vector<Line> through;
  for (const double side : {-1.0, 1.0}) {
    const Vector<2> contact = direction(side * phi), end = direction(side * range);
    through.push_back({1.0 * direction(side * (range - 180)), 1.3 * end});
    script.line("set arrow from {},{} to {},{} head filled size 0.1,20 front lw 3 lc rgb '{}'",
                1.3 * contact.x(), 1.3 * contact.y(), 1.02 * contact.x(), 1.02 * contact.y(),
                force_colour);
    label(fmt::format("contact {}", side > 0 ? 1 : 2), 1.4 * contact + Vector<2>(side * 0.02, 0.12),
          force_colour);
    label(fmt::format("{}{:g}°", side > 0 ? "" : "−", range),
          1.45 * end + Vector<2>(side * 0.03, 0), "black");
    label("φ", 0.55 * direction(side * phi / 2), line_colour);
  }
  script.data("angle", {arc(-phi, phi, 0.45)});
  script.data("through", through);
  script.data("upright", {{Vector<2>::Zero(), {0, 1.3}}});
  const Vector<2> up = direction(0.38 * phi);
  script.line("set arrow from 0,0 to {},{} head filled size 0.1,20 front lw 2.5 lc rgb '{}'",
              1.3 * up.x(), 1.3 * up.y(), weight_colour);
  label("up", 1.42 * up, weight_colour);
  label("θ", 1.14 * direction(0.19 * phi), weight_colour);
  script.data("theta", {arc(0, 0.38 * phi, 1.05)});
  label("+y", {0, 1.42}, line_colour);
  label("pinching up: |θ| < π − φ", {0, -0.22}, "black");
  label("fork: the object lies", {0, -1.05}, best_colour);
  label("on both fingers", {0, -1.19}, best_colour);
  script.layer("$range with filledcurves closed fc rgb '#eaf1f8' fs solid noborder notitle");
  script.layer("$fork with filledcurves closed fc rgb '{}' fs solid noborder notitle", fork_colour);
  script.layer("$disk with lines lw 1.5 lc rgb '{}' notitle", line_colour);
  script.layer("$through with lines dt 2 lc rgb '{}' notitle", line_colour);
  script.layer("$upright with lines dt 3 lc rgb '{}' notitle", line_colour);
  script.layer("$angle with lines lc rgb '{}' notitle", line_colour);
  script.layer("$theta with lines lc rgb '{}' notitle", weight_colour);
  script.plot();
  script.line("unset label\nunset arrow");
}

}  // namespace

std::string range_figure(const std::string& title, const HeldDisk& disk) {
  Script script;
  begin_picture(script, 1000, 540);
  headline(script, title, 0.96);
  script.line("unset border\nunset tics\nunset key");
  place(script, 0, 0.5, 0.02, 0.84);
  draw_range(script, disk);
  script.line("set title 'as it hangs at the end of the range, θ = π − φ'");
  place(script, 0.5, 1, 0.02, 0.84);
  const Grasp<2> grasp = grasp_of(disk);
  const Hold<2> resting = hold(grasp, up_at(disk.range()));
  draw_object(script, Disk{disk.radius},
              {.grasp = grasp,
               .theta = disk.range(),
               .hold = &resting,
               .scale = arrow_scale(disk, {minima(disk).back()})},
              nullptr, 500 / (0.82 * 540));
  script.line("unset multiplot");
  return script.text();
}

}  // namespace poise::study
