#include "picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "files/result.hpp"
#include "files/text.hpp"
#include "table.hpp"

namespace poise {
namespace {

constexpr double pi = 3.14159265358979323846;

// Few colours, each with one meaning.
constexpr const char* force_colour = "#0b5394";
constexpr const char* cone_colour = "#b9d5ec";
constexpr const char* weight_colour = "#a61c00";
constexpr const char* limit_colour = "#e69138";
constexpr const char* object_colour = "#f1efe9";
constexpr const char* unholdable_colour = "#d4d4d4";
constexpr const char* cradled_colour = "#e4f0db";
constexpr const char* line_colour = "#555555";
constexpr const char* best_colour = "#38761d";

// The picture [pixels].
constexpr double picture_width = 1200, picture_height = 580;
constexpr double object_width = 0.42 * picture_width, object_height = 0.72 * picture_height;

/// A gnuplot script in the making.
class Script {
 public:
  template <class... Parts>
  void line(fmt::format_string<Parts...> format, Parts&&... parts) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Parts>(parts)...);
    text_ += '\n';
  }

  /// Names rows of numbers, or of groups of rows with an empty line between them.
  void data(const std::string& name, const std::vector<std::vector<Vector<2>>>& groups) {
    line("${} << end", name);
    for (const auto& group : groups) {
      for (const Vector<2>& point : group) line("{} {}", point.x(), point.y());
      line("");
    }
    line("end");
  }

  /// Adds a part of the next plot command.
  template <class... Parts>
  void layer(fmt::format_string<Parts...> format, Parts&&... parts) {
    layers_ += (layers_.empty() ? "plot " : ", \\\n  ") +
               fmt::format(format, std::forward<Parts>(parts)...);
  }
  void plot() {
    line("{}", layers_);
    layers_.clear();
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_{}, layers_{};
};

/// A string of gnuplot that means just these characters, of which at most `longest` are kept.
std::string quoted(const std::string& text, std::size_t longest) {
  std::string result = "'";
  std::size_t at = 0;
  for (std::size_t k = 0; at < text.size() && k < longest; ++k) {
    const std::size_t size = std::max<std::size_t>(character_size(text, at), 1);
    result += is_control(text, at) ? " " : text[at] == '\'' ? "''" : text.substr(at, size);
    at += size;
  }
  return result + (at < text.size() ? "…'" : "'");
}

// ---- The object as it hangs ------------------------------------------------------------------

/// The held object, turned: its com at the origin, gravity along -y.
struct Scene {
  const Grasp<2>& grasp;
  double theta;
  const Hold<2>* hold;  ///< none where the object cannot be held

  Vector<2> turned(const Vector<2>& v) const {
    const double c = std::cos(theta), s = std::sin(theta);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
  }
  Vector<2> placed(const Vector<2>& point) const { return turned(point - grasp.object().com); }
};

Vector<2> left_of(const Vector<2>& v) { return {-v.y(), v.x()}; }

/// The part of the friction cone within `length` of the contact.
std::vector<Vector<2>> cone(const Scene& scene, const Contact<2>& contact, double length) {
  const Vector<2> tip = scene.placed(contact.position), n = scene.turned(contact.normal);
  const double half = std::atan(contact.friction);
  std::vector<Vector<2>> line{tip};
  constexpr int steps = 24;
  for (int k = -steps; k <= steps; ++k) {
    const double angle = half * k / steps;
    line.emplace_back(tip + length * (std::cos(angle) * n + std::sin(angle) * left_of(n)));
  }
  line.push_back(tip);
  return line;
}

/// A finger tip outside the object.
std::vector<Vector<2>> pad(const Scene& scene, const Contact<2>& contact, double size) {
  const Vector<2> tip = scene.placed(contact.position), n = scene.turned(contact.normal);
  const Vector<2> side = 1.3 * size * left_of(n), back = size * n;
  return {tip - side, tip + side, tip + side - back, tip - side - back, tip - side};
}

void label(Script& script, const std::string& text, const Vector<2>& at, const char* where,
           double line, const char* colour) {
  script.line("set label {} at {},{} {} offset 0,{} textcolor rgb '{}' front boxed", text, at.x(),
              at.y(), where, line, colour);
}

/// A finger's name and how hard it presses, outside the object.
void label_fingers(Script& script, const Scene& scene, double distance) {
  const auto& contacts = scene.grasp.contacts();
  const auto fingers = scene.hold ? finger_forces(scene.grasp, *scene.hold)
                                  : std::vector<FingerForce<2>>(scene.grasp.fingers().size());
  if (fingers.size() > 8) return;  // no room
  for (std::size_t k = 0; k < fingers.size(); ++k) {
    Vector<2> place = Vector<2>::Zero(), outward = Vector<2>::Zero();
    double count = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (scene.grasp.finger_of(i) != k) continue;
      place += scene.placed(contacts[i].position);
      outward -= scene.turned(contacts[i].normal);
      ++count;
    }
    outward.normalize();
    const Vector<2> at = place / count + distance * outward;
    const char* const where = outward.x() > 0.5 ? "left" : outward.x() < -0.5 ? "right" : "center";
    const double middle = outward.y() > 0.5 ? 0.9 : outward.y() < -0.5 ? -0.5 : 0.1;
    label(script, quoted(scene.grasp.fingers()[k], 10), at, where, middle + 0.5, "black");
    if (scene.hold)
      label(script, quoted(newtons(fingers[k].force.norm()), 20), at, where, middle - 0.5,
            force_colour);
  }
}

void draw_object(Script& script, const GraspFile& file, const Scene& scene,
                 const PlanarPosture* posture) {
  const auto& contacts = scene.grasp.contacts();
  const double weight = scene.grasp.object().weight;
  std::vector<Vector<2>> line;
  if (file.shape)
    for (const Vector<2>& point : outline(*file.shape)) line.push_back(scene.placed(point));

  // The view: room around the object for fingers and their labels.
  Vector<2> lower = Vector<2>::Zero(), upper = Vector<2>::Zero();
  const auto include = [&](const Vector<2>& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  };
  for (const Vector<2>& point : line) include(point);
  for (const Contact<2>& contact : contacts) include(scene.placed(contact.position));
  const Vector<2> centre = (lower + upper) / 2;
  double size = (upper - lower).maxCoeff() / 2;
  if (!(size > 0)) size = 1;
  const Vector<2> view(1.55 * size * object_width / object_height, 1.55 * size);
  script.line("set xrange [{}:{}]\nset yrange [{}:{}]", centre.x() - view.x(),
              centre.x() + view.x(), centre.y() - view.y(), centre.y() + view.y());

  // Forces to one scale; the weight stays visible beside forces much larger than it.
  double largest = weight;
  if (scene.hold)
    for (std::size_t i = 0; i < contacts.size(); ++i)
      largest = std::max(largest, force_vector(contacts[i], scene.hold->forces[i]).norm());
  const double scale = 0.9 * size / largest;
  std::vector<std::vector<Vector<2>>> free, limited, cones, pads;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    cones.push_back(cone(scene, contacts[i], 0.75 * size));
    pads.push_back(pad(scene, contacts[i], 0.09 * size));
    if (!scene.hold || scene.hold->forces[i].state == ContactState::unloaded) continue;
    const Vector<2> force = scene.turned(force_vector(contacts[i], scene.hold->forces[i]));
    (scene.hold->forces[i].limit == ForceLimit::none ? free : limited)
        .push_back({scene.placed(contacts[i].position), scale * force});
  }
  const Vector<2> gravity(0, -std::max(scale * weight, 0.2 * size));

  line.push_back(line.empty() ? Vector<2>::Zero().eval() : line.front());
  script.data("outline", {line});
  script.data("cones", cones);
  script.data("pads", pads);
  script.data("com", {{Vector<2>::Zero()}});
  script.data("vertical", {{{0, centre.y() - 1.3 * size}, {0, centre.y() + 1.3 * size}}});
  if (file.shape)
    script.layer(
        "$outline with filledcurves closed fc rgb '{}' fs solid border lc rgb '{}' notitle",
        object_colour, line_colour);
  script.layer(
      "$cones with filledcurves closed fc rgb '{}' fs transparent solid 0.6 noborder title "
      "'friction cone'",
      cone_colour);
  script.layer("$vertical with lines lc rgb '{}' dt 3 notitle", line_colour);
  script.layer("$pads with filledcurves closed fc rgb '{}' fs solid noborder notitle", line_colour);

  if (posture && posture->edges_meet &&
      (scene.placed(*posture->edges_meet) - centre).cwiseAbs().maxCoeff() < view.y()) {
    const Vector<2> meet = scene.placed(*posture->edges_meet);
    std::vector<std::vector<Vector<2>>> edges;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (posture->hold.forces[i].state == ContactState::slipping)
        edges.push_back({scene.placed(contacts[i].position), meet});
    script.data("edges", edges);
    script.data("meet", {{meet}});
    script.layer("$edges with lines lc rgb '{}' dt 2 notitle", force_colour);
    script.layer("$meet with points pt 6 ps 1.2 lw 2 lc rgb '{}' title 'cone edges meet'",
                 force_colour);
  }

  const auto arrows = [&](const char* name, const std::vector<std::vector<Vector<2>>>& forces,
                          const char* colour, const char* meaning) {
    if (forces.empty()) return;
    script.line("${} << end", name);
    for (const auto& force : forces)
      script.line("{} {} {} {}", force[0].x(), force[0].y(), force[1].x(), force[1].y());
    script.line("end");
    script.layer("${} with vectors head filled size graph 0.03,20 lw 3 lc rgb '{}' title '{}'",
                 name, colour, meaning);
  };
  arrows("forces", free, force_colour, "finger force");
  arrows("limited", limited, limit_colour, "at its force limit");
  arrows("weight", {{Vector<2>::Zero(), gravity}}, weight_colour, "weight");
  script.layer("$com with points pt 7 ps 0.8 lc rgb '{}' notitle", weight_colour);
  label(script, quoted(newtons(weight), 20), gravity, "center", -0.8, weight_colour);
  label_fingers(script, scene, 0.2 * size);
  script.plot();
  script.line("unset label");
}

// ---- The curve -------------------------------------------------------------------------------

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

/// The force norm along the arcs, sharp at their ends, broken where nothing holds.
std::vector<std::vector<Vector<2>>> curve_lines(const PostureCurve& curve) {
  std::vector<std::vector<Vector<2>>> lines;
  for (const Arc& arc : curve.arcs)
    for (const Interval& part : on_axis({arc.from, arc.to})) {
      const double length = part.to - part.from;
      const int steps = std::max(8, static_cast<int>(std::ceil(length / (pi / 360))));
      std::vector<Vector<2>> line;
      for (int k = 0; k <= steps; ++k) {
        const double theta = part.from + length * k / steps;
        line.emplace_back(degrees(theta), std::sqrt(std::max(0.0, arc.V(theta))));
      }
      if (!lines.empty() && lines.back().back().x() == line.front().x())
        lines.back().insert(lines.back().end(), line.begin(), line.end());
      else
        lines.push_back(std::move(line));
    }
  return lines;
}

Vector<2> marker(const Optimum& optimum) {
  return {degrees(optimum.angle), std::sqrt(optimum.effort)};
}

void draw_optima(Script& script, const std::vector<Optimum>& optima) {
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
    for (const Optimum& optimum : optima)
      if (optimum.maximum == sort.maximum && optimum.kind == sort.kind)
        points[0].push_back(marker(optimum));
    if (points[0].empty()) continue;
    const std::string name = fmt::format("optima{}", sort.symbol);
    script.data(name, points);
    script.layer("${} with points pt {} ps 1.3 lw 1.5 lc rgb '{}' title '{}'", name, sort.symbol,
                 force_colour, sort.name);
  }
}

void draw_curve(Script& script, const GraspFile& file, const Grasp<2>& grasp,
                const BestPosture& best, const CurveSettings& settings) {
  const PostureCurve& curve = best.curve;
  const auto lines = curve_lines(curve);
  const Interval cradled = cradled_wedge(grasp);
  if (cradled.from < cradled.to) shade(script, cradled, cradled_colour);
  for (const UnholdableArc& arc : curve.unholdable_arcs)
    shade(script, {arc.from, arc.to}, unholdable_colour);

  // From nothing, or by factors of ten where the curve climbs far above its lowest point. Beyond a
  // thousand times that, or the last minimum, there is nothing to be seen.
  double low = 0, high = 1, highest_minimum = 0;
  if (best.holdable()) {
    low = high = std::sqrt(best.best().optimum.effort);
    for (const PlanarPosture& minimum : best.minima)
      highest_minimum = std::max(highest_minimum, std::sqrt(minimum.optimum.effort));
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
  script.line("set xlabel 'object turned counter-clockwise'\nset ylabel 'force norm √V [N]'");
  if (!best.holdable()) {
    script.layer("NaN notitle");
    script.line("unset ytics");
    script.line("set label 'cannot be held in any posture' at graph 0.5,0.5 center front");
  }
  if (!lines.empty()) {
    script.data("curve", lines);
    script.layer("$curve with lines lw 2.5 lc rgb '{}' notitle", force_colour);
  }
  draw_optima(script, curve.optima);
  const auto ring = [&](const char* name, const PlanarPosture& posture, int symbol,
                        const char* meaning) {
    script.data(name, {{marker(posture.optimum)}});
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
  if (cradled.from < cradled.to)
    script.layer("keyentry with boxes fs solid fc rgb '{}' title 'cradled{}'", cradled_colour,
                 settings.domain == Domain::pinched ? " (left out)" : "");
  script.plot();
}

}  // namespace

std::string picture(const GraspFile& file, const Grasp<2>& grasp, const BestPosture& best,
                    const CurveSettings& settings) {
  const PlanarPosture* posture = best.best_pinched();
  if (!posture && best.holdable()) posture = &best.best();
  const Scene scene{.grasp = grasp,
                    .theta = posture ? posture->optimum.angle : file.angle.value_or(0),
                    .hold = posture && posture->hold.holdable ? &posture->hold : nullptr};
  std::string posture_title = "cannot be held";
  if (posture)
    posture_title =
        fmt::format("{} posture: {}, grip force {}", best.pinched ? "best pinched" : "best",
                    degrees_text(scene.theta), newtons(grip_force(grasp, posture->hold)));

  Script script;
  script.line("set terminal svg size {},{} noenhanced font 'sans-serif,15' background '#ffffff'",
              picture_width, picture_height);
  script.line("set encoding utf8\nset multiplot");
  script.line("set key bmargin center horizontal Left reverse samplen 1.3 spacing 1.2 font ',13'");
  script.line("set style textbox opaque fc rgb '#aaffffff' noborder margins 0.1,0.1");

  constexpr double top = 0.85;
  script.line("set tmargin at screen {}\nset bmargin at screen {}", top,
              top - object_height / picture_height);
  script.line("set lmargin at screen 0\nset rmargin at screen {}", object_width / picture_width);
  script.line("set label {} at screen 0.5,0.96 center font 'sans-serif,20'",
              quoted(file.name.empty() ? "held object" : file.name, 70));
  script.line("unset border\nunset tics\nset title '{}'", posture_title);
  draw_object(script, file, scene, posture);

  script.line("set lmargin at screen 0.49\nset rmargin at screen 0.98\nset bmargin at screen 0.32");
  script.line("set key width -2.4\nset title 'least force norm by posture'");
  draw_curve(script, file, grasp, best, settings);
  script.line("unset multiplot");
  return script.text();
}

}  // namespace poise
