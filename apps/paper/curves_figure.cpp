// Figs. 3 to 6: the bounds on the internal force, and what they cost.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "apps/paper/figure_parts.hpp"
#include "apps/paper/figures.hpp"

namespace poise::study {
namespace {

/// One of the six, by the paper's number.
struct Bound {
  std::size_t index;   ///< into alphas()
  const char* number;  ///< "₁"
  const char* condition;
  const char* colour;
  int dash;
};
// Colour by condition, dashed for contact 2. The third and the fourth are the same.
constexpr std::array<Bound, 5> bounds{{{0, "₁", "N₁ > 0", limit_colour, 1},
                                       {1, "₂", "N₂ > 0", limit_colour, 2},
                                       {2, "₃", "F₁, F₂ > 0", line_colour, 1},
                                       {4, "₅", "μ₁N₁ > F₁", force_colour, 1},
                                       {5, "₆", "μ₂N₂ > F₂", force_colour, 2}}};

/// A panel with a curve for each bound.
struct Panel {
  const HeldDisk& disk;
  std::string data;    ///< name of its data: "alpha"
  std::string letter;  ///< of its curves: "α"
  std::function<double(double theta, const Bound&)> value;
  std::function<double(double value)> height;  ///< 0 at the bottom, 1 at the top
  std::vector<Vector<2>> marked{};             ///< angle [deg] and value of a, b and c

  /// "α₁", "α₃ = α₄"
  std::string name(const Bound& bound) const {
    return letter + bound.number + (bound.index == 2 ? " = " + letter + "₄" : "");
  }
};

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

/// Where the label of a curve has most room beside the other curves and the labels that `taken`
/// are: angle [deg] and value.
std::optional<Vector<2>> label_place(const Panel& panel, const Bound& bound,
                                     const std::vector<Vector<2>>& taken) {
  const auto part = [&](double deg, double value) {  // of the panel
    return Vector<2>(deg / 360, panel.height(value));
  };
  double most = 0;
  std::optional<Vector<2>> place;
  for (int deg = -150; deg <= 150; deg += 3) {
    const double value = panel.value(radians(deg), bound), y = panel.height(value);
    if (!std::isfinite(value) || y < 0.06 || y > 0.94) continue;
    double room = 0.16;
    for (const int beside : {-9, 0, 9})
      for (const Bound& other : bounds) {
        const double there = panel.value(radians(deg + beside), other);
        if (other.index != bound.index && std::isfinite(there))
          room = std::min(room, std::abs(panel.height(there) - y));
      }
    for (const Vector<2>& other : taken)
      room = std::min(room, 0.8 * (part(other.x(), other.y()) - part(deg, value)).norm());
    if (room > most) {
      most = room;
      place = Vector<2>(deg, value);
    }
  }
  return place;
}

enum class Titles { none, conditions };

/// The curves of all bounds, each with its name beside it.
void draw_curves(Script& script, const Panel& panel, Titles titles) {
  std::vector<Vector<2>> taken = panel.marked;
  for (const Bound& bound : bounds) {
    const auto place = label_place(panel, bound, taken);
    if (!place) continue;
    taken.push_back(*place);
    script.data(fmt::format("{}{}", panel.data, bound.index),
                {sampled(-pi, pi, [&](double theta) { return panel.value(theta, bound); })});
    script.layer("${}{} with lines lw 2 dt {} lc rgb '{}' {}", panel.data, bound.index, bound.dash,
                 bound.colour,
                 titles == Titles::none
                     ? "notitle"
                     : fmt::format("title '{}: {}'", panel.name(bound), bound.condition));
    script.line("set label '{}' at {},{} center front boxed textcolor rgb '{}'", panel.name(bound),
                place->x(), place->y(), bound.colour);
  }
}

/// The values of a, b and c, for which `of` is `&Minimum::V` or `&Minimum::alpha`.
std::vector<Vector<2>> marks(const HeldDisk& disk, double Minimum::*of) {
  std::vector<Vector<2>> points;
  for (const Minimum& minimum : marked_postures(disk))
    points.emplace_back(degrees(minimum.theta), minimum.*of);
  return points;
}

/// A broad line under the curves, over the range: what counts.
void draw_band(Script& script, const std::string& name, const std::vector<Line>& lines,
               const std::string& title) {
  script.data(name, lines);
  script.layer("${} with lines lw 9 lc rgb '{}' {}", name, cone_colour,
               title.empty() ? "notitle" : "title '" + title + "'");
}

void mark(Script& script, const HeldDisk& disk, const std::vector<Vector<2>>& points) {
  const std::vector<Minimum> marked = marked_postures(disk);
  const bool b_is_minimum = minima(disk).size() == marked.size();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const char name = marked[k].name;
    script.line("set label '{}{}' at {},{} {} offset {},{} front font 'sans-serif:Italic,17'", name,
                name == 'b' && !b_is_minimum ? " (no minimum)" : "", points[k].x(), points[k].y(),
                name == 'a'   ? "right"
                : name == 'c' ? "left"
                              : "center",
                name == 'a'   ? -0.5
                : name == 'c' ? 0.5
                              : 0.0,
                name == 'b' ? 1.0 : 0.7);
  }
  script.data("marks", {points});
  script.layer("$marks with points pt 7 ps 0.9 lc rgb 'black' notitle");
}

/// Says which bounds are infinite, and why.
void say_infinite(Script& script, const HeldDisk& disk) {
  std::string which = disk.d1() <= 0 ? "α₅" : "";
  if (disk.d2() <= 0) which += which.empty() ? "α₆" : " and α₆";
  script.line("set label '{} {} no finite value:' at graph 0.5,0.93 center front boxed", which,
              which.size() > 6 ? "have" : "has");
  script.line("set label 'μ sin φ − cos φ {} 0' at graph 0.5,0.86 center front boxed",
              std::min(disk.d1(), disk.d2()) < 0 ? "<" : "=");
}

void draw_bounds(Script& script, const HeldDisk& disk, const std::string& band) {
  const AlphaAxis axis = alpha_axis(disk);
  posture_axis(script, disk);
  script.line("set ylabel 'internal force α [N]' offset 0.4,0\nset xtics format ''");
  if (axis.stretched)
    script.line("set nonlinear y via asinh(y/{0}) inverse {0}*sinh(y)", axis.weight);
  script.line("set yrange [{}:{}]", axis.bottom, axis.top);
  script.data("zero", {{{-180, 0}, {180, 0}}});
  script.layer("$zero with lines dt 3 lc rgb '{}' notitle", line_colour);
  if (axis.stretched) {
    std::string tics = "'0' 0";
    for (double tic = 1; tic <= axis.top; tic *= 10)
      if (tic >= axis.weight) tics += fmt::format(", '{0:g}' {0:g}, '−{0:g}' {1:g}", tic, -tic);
    script.line("set ytics ({})", tics);
  }
  const auto largest = [&](double theta) { return alpha_bar(disk, theta); };
  if (disk.can_be_squeezed())
    draw_band(script, "bar", {sampled(-disk.range(), disk.range(), largest)}, band);
  else
    say_infinite(script, disk);
  const std::vector<Vector<2>> marked = marks(disk, &Minimum::alpha);
  draw_curves(
      script,
      {.disk = disk,
       .data = "alpha",
       .letter = "α",
       .value = [&](double theta, const Bound& bound) { return alphas(disk, theta)[bound.index]; },
       .height = [&](double alpha) { return axis.height(alpha); },
       .marked = marked},
      Titles::conditions);
  mark(script, disk, marked);
  script.plot();
  script.line("unset label\nunset object\nunset nonlinear y\nset ytics autofreq");
}

/// Begins a panel of V; its axis reaches so many times the largest V of the range.
/// @return the top of the axis
double begin_efforts(Script& script, const HeldDisk& disk, const std::vector<Line>& lines) {
  posture_axis(script, disk);
  const double least = disk.weight * disk.weight;
  double most = 2 * least;
  for (const Line& line : lines)
    for (const Vector<2>& point : line) most = std::max(most, point.y());
  const bool log = most > 30 * least;
  const double top = (log ? 4 : 1.25) * most;
  script.line(
      "set xlabel 'object turned counter-clockwise by θ'\nset ylabel 'V [N²]' offset 0.7,0");
  if (log) script.line("set logscale y\nset ytics format '10^{{%L}}'");
  script.line("set yrange [{}:{}]", log ? 0.5 * least : 0, top);
  return top;
}

void end_efforts(Script& script, const HeldDisk& disk) {
  mark(script, disk, marks(disk, &Minimum::V));
  script.plot();
  script.line("unset label\nunset object\nunset logscale\nset ytics format '%g'\nunset xlabel");
}

void draw_effort(Script& script, const HeldDisk& disk) {
  const std::vector<Line> lines = effort_lines(disk);
  begin_efforts(script, disk, lines);
  if (!lines.empty()) {
    script.data("effort", lines);
    script.layer("$effort with lines lw 2.5 lc rgb '{}' notitle", force_colour);
  }
  if (disk.d1() <= 0 && disk.d2() <= 0)
    script.line("set label 'nothing between a and c can be held' at graph 0.5,0.4 center front");
  end_efforts(script, disk);
}

/// V_k, the effort with each of the bounds for the internal force.
void draw_evaluations(Script& script, const HeldDisk& disk) {
  const std::vector<Line> lines = effort_lines(disk);
  const double top = begin_efforts(script, disk, lines);
  draw_band(script, "effort", lines, "");
  draw_curves(script,
              {.disk = disk,
               .data = "V",
               .letter = "V",
               .value =
                   [&](double theta, const Bound& bound) {
                     return V(disk, theta, alphas(disk, theta)[bound.index]);
                   },
               .height = [top](double effort) { return effort / top; },
               .marked = marks(disk, &Minimum::V)},
              Titles::none);
  end_efforts(script, disk);
}

}  // namespace

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
    draw_bounds(script, disk, "ᾱ, the largest");
    script.line("unset title");
    place(script, from, to, 0.195, 0.45);
    draw_effort(script, disk);
  }
  script.line("unset multiplot");
  return script.text();
}

std::string evaluation_figure(const NamedDisk& named) {
  Script script;
  begin_picture(script, 770, 960, true);
  script.line("set key at screen 0.5,0.04 center center width -1 maxrows 3");
  script.line("set title '{}: {}' offset 0,-0.5 font 'sans-serif,18'", named.name,
              parameters(named.disk));
  place(script, 0.137, 0.96, 0.555, 0.945);
  draw_bounds(script, named.disk, "what counts: ᾱ, and V with it");
  script.line("unset title");
  place(script, 0.137, 0.96, 0.165, 0.52);
  draw_evaluations(script, named.disk);
  script.line("unset multiplot");
  return script.text();
}

}  // namespace poise::study
