#include "paper_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "apps/paper/exact.hpp"
#include "apps/paper/sampling.hpp"
#include "files/result.hpp"
#include "scene.hpp"
#include "table.hpp"

namespace poise {
namespace {

using study::HeldDisk;
using study::pi;
using Line = std::vector<Vector<2>>;

constexpr const char* outside_colour = "#ececec";  // of the range

double radians(double degrees) { return degrees * pi / 180; }

/// The title above a picture.
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

/// A function of the posture over the circle or a part of it.
template <class Function>
Line sampled(double from, double to, Function value) {
  Line line;
  constexpr int steps = 360;
  for (int k = 0; k <= steps; ++k) {
    const double theta = from + (to - from) * k / steps;
    line.emplace_back(degrees(theta), value(theta));
  }
  return line;
}

// ---- The bounds and V (Figs. 3, 4, 6) --------------------------------------------------------

struct Bound {
  std::size_t index;  ///< into alphas()
  const char* name;
  const char* condition;
  const char* colour;
  int dash;
};
// Colour by condition, dashed for contact 2.
constexpr std::array<Bound, 5> bounds{{{0, "α₁", "N₁ > 0", limit_colour, 1},
                                       {1, "α₂", "N₂ > 0", limit_colour, 2},
                                       {2, "α₃ = α₄", "F₁, F₂ > 0", line_colour, 1},
                                       {4, "α₅", "μ₁N₁ > F₁", force_colour, 1},
                                       {5, "α₆", "μ₂N₂ > F₂", force_colour, 2}}};

/// The axis of the internal force; beyond ten weights it is stretched near 0.
struct AlphaAxis {
  double bottom, top, weight;
  bool stretched;

  double height(double alpha) const {  // 0 at the bottom, 1 at the top
    const auto map = [this](double a) { return stretched ? std::asinh(a / weight) : a; };
    return (map(alpha) - map(bottom)) / (map(top) - map(bottom));
  }
};

AlphaAxis alpha_axis(const HeldDisk& disk) {
  const double W = disk.weight;
  double top = 1.5 * W, deep = W;
  if (disk.can_be_squeezed())
    for (int k = -50; k <= 50; ++k)
      top = std::max(top, 1.2 * alpha_bar(disk, disk.range() * k / 50));
  deep = std::max(deep, std::min(1.1 * std::abs(alphas(disk, 0)[2]), 1.6 * top));
  const bool stretched = top > 10 * W;
  if (stretched) return {-top, 2 * top, W, true};
  return {-std::max(1.15 * deep, 0.87 * top), top, W, false};
}

/// Where each label is farthest from the other curves and labels: angle [deg], alpha.
std::array<std::optional<Vector<2>>, bounds.size()> label_places(const HeldDisk& disk,
                                                                 const AlphaAxis& axis) {
  std::array<std::optional<Vector<2>>, bounds.size()> places;
  std::vector<Vector<2>> taken;  // x and height as parts of the panel
  for (const study::Minimum& minimum : minima(disk))
    taken.emplace_back(minimum.theta / (2 * pi), axis.height(minimum.alpha));
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    double best = 0;
    Vector<2> part;
    for (int deg = -150; deg <= 150; deg += 3) {
      const auto all = alphas(disk, radians(deg));
      const double alpha = all[bounds[k].index], y = axis.height(alpha);
      if (!std::isfinite(alpha) || y < 0.06 || y > 0.94) continue;
      const Vector<2> here(deg / 360.0, y);
      double room = 0.16;
      for (const int beside : {-9, 0, 9}) {
        const auto there = alphas(disk, radians(deg + beside));
        for (const Bound& other : bounds)
          if (other.index != bounds[k].index && std::isfinite(there[other.index]))
            room = std::min(room, std::abs(axis.height(there[other.index]) - y));
      }
      for (const Vector<2>& point : taken) room = std::min(room, 0.8 * (point - here).norm());
      if (room > best) {
        best = room;
        part = here;
        places[k] = Vector<2>(deg, alpha);
      }
    }
    if (places[k]) taken.push_back(part);
  }
  return places;
}

/// a, b, c; and b, where it is no minimum, too.
std::vector<study::Minimum> marked_postures(const HeldDisk& disk) {
  std::vector<study::Minimum> marked = minima(disk);
  const double b = theta_b(disk);
  if (marked.size() == 2 && disk.can_be_squeezed())
    marked.insert(marked.begin() + 1, {'b', b, V(disk, b), alpha_bar(disk, b), Kind::kink});
  return marked;
}

void mark(Script& script, const HeldDisk& disk, bool effort) {
  const std::vector<study::Minimum> marked = marked_postures(disk);
  const bool b_is_minimum = minima(disk).size() == marked.size();
  Line points;
  for (const study::Minimum& minimum : marked) {
    points.emplace_back(degrees(minimum.theta), effort ? minimum.V : minimum.alpha);
    script.line("set label '{}{}' at {},{} {} offset {},0.7 front font 'sans-serif:Italic,17'",
                minimum.name, minimum.name == 'b' && !b_is_minimum ? " (no minimum)" : "",
                points.back().x(), points.back().y(),
                minimum.name == 'a'   ? "right"
                : minimum.name == 'c' ? "left"
                                      : "center",
                minimum.name == 'a'   ? -0.5
                : minimum.name == 'c' ? 0.5
                                      : 0.0);
  }
  script.data("marks", {points});
  script.layer("$marks with points pt 7 ps 0.9 lc rgb 'black' notitle");
}

void draw_bounds(Script& script, const HeldDisk& disk) {
  const AlphaAxis axis = alpha_axis(disk);
  posture_axis(script, disk);
  script.line("set ylabel 'internal force α [N]' offset 0.4,0\nset xtics format ''");
  if (axis.stretched)
    script.line("set nonlinear y via asinh(y/{0}) inverse {0}*sinh(y)", axis.weight);
  script.line("set yrange [{}:{}]", axis.bottom, axis.top);
  script.data("zero", {{{-180, 0}, {180, 0}}});
  script.layer("$zero with lines dt 3 lc rgb '{}' notitle", line_colour);
  if (axis.stretched) {
    script.line("set ytics ({})", [&] {
      std::string tics = "'0' 0";
      for (double tic = 1; tic <= axis.top; tic *= 10)
        if (tic >= axis.weight) tics += fmt::format(", '{0:g}' {0:g}, '−{0:g}' {1:g}", tic, -tic);
      return tics;
    }());
  }
  if (disk.can_be_squeezed()) {
    script.data("bar", {sampled(-disk.range(), disk.range(),
                                [&](double theta) { return alpha_bar(disk, theta); })});
    script.layer("$bar with lines lw 9 lc rgb '{}' title 'ᾱ, the largest'", cone_colour);
  }
  const auto places = label_places(disk, axis);
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    const Bound& bound = bounds[k];
    if (!places[k]) continue;
    script.data(fmt::format("bound{}", k),
                {sampled(-pi, pi, [&](double theta) { return alphas(disk, theta)[bound.index]; })});
    script.layer("$bound{} with lines lw 2 dt {} lc rgb '{}' title '{}: {}'", k, bound.dash,
                 bound.colour, bound.name, bound.condition);
    script.line("set label '{}' at {},{} center front boxed textcolor rgb '{}'", bound.name,
                places[k]->x(), places[k]->y(), bound.colour);
  }
  if (!disk.can_be_squeezed()) {
    std::string which = disk.d1() <= 0 ? "α₅" : "";
    if (disk.d2() <= 0) which += which.empty() ? "α₆" : " and α₆";
    script.line("set label '{} {} no finite value:' at graph 0.5,0.93 center front boxed", which,
                which.size() > 6 ? "have" : "has");
    script.line("set label 'μ sin φ − cos φ {} 0' at graph 0.5,0.86 center front boxed",
                std::min(disk.d1(), disk.d2()) < 0 ? "<" : "=");
  }
  mark(script, disk, false);
  script.plot();
  script.line("unset label\nunset object\nunset nonlinear y\nset ytics autofreq");
}

/// V on its branches, over the range.
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

void draw_effort(Script& script, const HeldDisk& disk) {
  posture_axis(script, disk);
  const double least = disk.weight * disk.weight;
  double most = 2 * least;
  const std::vector<Line> lines = effort_lines(disk);
  for (const Line& line : lines)
    for (const Vector<2>& point : line) most = std::max(most, point.y());
  const bool log = most > 30 * least;
  script.line(
      "set xlabel 'object turned counter-clockwise by θ'\nset ylabel 'V [N²]' offset 0.7,0");
  if (log) script.line("set logscale y\nset ytics format '10^{{%L}}'");
  script.line("set yrange [{}:{}]", log ? 0.5 * least : 0, (log ? 4 : 1.25) * most);
  if (!lines.empty()) {
    script.data("effort", lines);
    script.layer("$effort with lines lw 2.5 lc rgb '{}' notitle", force_colour);
  }
  if (disk.d1() <= 0 && disk.d2() <= 0)
    script.line("set label 'nothing between a and c can be held' at graph 0.5,0.4 center front");
  mark(script, disk, true);
  script.plot();
  script.line("unset label\nunset object\nunset logscale\nset ytics format '%g'\nunset xlabel");
}

/// One length of arrows for all postures, in metres to a newton, such that those of a finger and of
/// the weight on one line do not meet; by posture where the forces differ too much.
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

}  // namespace

std::string parameters(const HeldDisk& disk) {
  const std::string phi = fmt::format("φ = {:.6g}°", degrees(disk.phi));
  return disk.mu1 == disk.mu2
             ? fmt::format("{}, μ₁ = μ₂ = {:.4g}", phi, disk.mu1)
             : fmt::format("{}, μ₁ = {:.4g}, μ₂ = {:.4g}", phi, disk.mu1, disk.mu2);
}

std::string curves_figure(const std::vector<NamedDisk>& columns) {
  const double count = static_cast<double>(columns.size()), width = 200 + 570 * count;
  Script script;
  begin_picture(script, width, 820, true);
  headline(script, columns.front().name, 0.97);
  script.line("set key at screen 0.5,0.047 center center width -1 maxrows 3");
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const HeldDisk& disk = columns[k].disk;
    const double share = 1 / count, left = share * static_cast<double>(k);
    const double from = left + 105 / width, to = left + share - 30 / width;
    script.line("set title '{}' offset 0,-0.5", parameters(disk));
    place(script, from, to, 0.49, 0.91);
    script.line("set key {}", k + 1 == columns.size() ? "on" : "off");
    draw_bounds(script, disk);
    script.line("unset title");
    place(script, from, to, 0.195, 0.45);
    draw_effort(script, disk);
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
    for (const study::Minimum& minimum : minima(disk))
      points.emplace_back(degrees(minimum.theta), minimum.V);
    script.data(fmt::format("minima{}", k), {points});
    script.layer("$minima{} with points pt 7 ps 0.8 lc rgb '{}' notitle", k, colours[k % 6]);
  }
  script.plot();
  script.line("unset multiplot");
  return script.text();
}

std::string postures_figure(const NamedDisk& named) {
  const HeldDisk& disk = named.disk;
  const Grasp<2> grasp = grasp_of(disk);
  const std::vector<study::Minimum> marked = marked_postures(disk);
  const double count = static_cast<double>(marked.size()), width = 520 * count, height = 560;
  Script script;
  begin_picture(script, width, height);
  headline(script, named.name + ": " + parameters(disk), 0.955);
  script.line("set key at screen 0.5,0.04 center center\nunset border\nunset tics");
  for (std::size_t k = 0; k < marked.size(); ++k) {
    const study::Minimum& minimum = marked[k];
    const double left = static_cast<double>(k) / count;
    place(script, left, left + 1 / count, 0.09, 0.85);
    const PlanarPosture posture =
        posture_at(grasp, {.angle = minimum.theta,
                           .from = minimum.theta,
                           .to = minimum.theta,
                           .effort = minimum.V,
                           .kind = minimum.name == 'b' ? Kind::kink : minimum.kind});
    script.line("set title '{}: θ = {}, force norm {}' offset 0,-1", minimum.name,
                degrees_text(minimum.theta), newtons(std::sqrt(minimum.V)));
    script.line("set key {}", minimum.name == 'b' || marked.size() == 2 ? "on" : "off");
    draw_object(script, Disk{disk.radius},
                {.grasp = grasp,
                 .theta = minimum.theta,
                 .hold = posture.hold.holdable ? &posture.hold : nullptr,
                 .scale = arrow_scale(disk, marked)},
                &posture, width / count / (0.76 * height));
  }
  script.line("unset multiplot");
  return script.text();
}

std::string range_figure(const NamedDisk& named) {
  const HeldDisk& disk = named.disk;
  const double phi = degrees(disk.phi), range = 180 - phi;
  Script script;
  begin_picture(script, 1000, 540);
  headline(script, named.name, 0.96);
  script.line("unset border\nunset tics\nunset key\nset title 'in the frame of the object'");
  place(script, 0, 0.5, 0.02, 0.84);
  script.line("set xrange [-1.75:1.75]\nset yrange [-1.5:1.6]");
  const auto direction = [](double theta) { return up_at(radians(theta)); };
  const auto arc = [&](double from, double to, double radius) {
    Line line;
    for (int k = 0; k <= 90; ++k)
      line.emplace_back(radius * direction(from + (to - from) * k / 90));
    return line;
  };
  const auto sector = [&](double from, double to, double radius) {
    Line line = arc(from, to, radius);
    line.insert(line.begin(), Vector<2>::Zero());
    line.emplace_back(Vector<2>::Zero());
    return line;
  };
  const auto label = [&](const std::string& text, const Vector<2>& at, const char* colour) {
    script.line("set label '{}' at {},{} center front textcolor rgb '{}'", text, at.x(), at.y(),
                colour);
  };
  script.data("disk", {arc(0, 360, 1)});
  script.data("range", {sector(-range, range, 1.3)});
  script.data("fork", {sector(range, 360 - range, 1.3)});
  Line axes;
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
  script.layer("$fork with filledcurves closed fc rgb '{}' fs solid noborder notitle",
               cradled_colour);
  script.layer("$disk with lines lw 1.5 lc rgb '{}' notitle", line_colour);
  script.layer("$through with lines dt 2 lc rgb '{}' notitle", line_colour);
  script.layer("$upright with lines dt 3 lc rgb '{}' notitle", line_colour);
  script.layer("$angle with lines lc rgb '{}' notitle", line_colour);
  script.layer("$theta with lines lc rgb '{}' notitle", weight_colour);
  script.plot();
  script.line("unset label\nunset arrow");
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
      const double other = study::least_other_friction(phi, least + excess) - least;
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
        const study::SamplingError error = study::sampling_error(disks[k].disk, samples);
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

}  // namespace poise
