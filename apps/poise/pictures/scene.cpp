#include "pictures/scene.hpp"

#include <algorithm>
#include <cmath>

#include "pictures/other_load.hpp"
#include "tables/table.hpp"

namespace poise {
namespace {

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

/// A line from a point, and how far.
using Arrows = std::vector<std::vector<Vector<2>>>;

/// How far from a finger its label hides no arrow. A label is about so large beside an object of
/// half the size 1.
double free_distance(const Arrows& arrows, const Vector<2>& place, const Vector<2>& outward,
                     double size) {
  const Vector<2> half = Vector<2>(0.25, 0.14) * size;
  for (double distance = 0.2 * size; distance < size; distance += 0.1 * size) {
    Vector<2> middle = place + distance * outward;
    if (std::abs(outward.x()) > 0.5) middle.x() += std::copysign(half.x(), outward.x());
    const Eigen::AlignedBox2d label(middle - half, middle + half);
    constexpr int steps = 50;
    bool free = true;
    for (const auto& arrow : arrows)
      for (int k = 0; k <= steps; ++k)
        free = free && !label.contains(Vector<2>(arrow[0] + arrow[1] * k / steps));
    if (free) return distance;
  }
  return 0.2 * size;
}

/// A finger's name and how hard it presses, outside the object.
void label_fingers(Script& script, const Scene& scene, const Arrows& arrows, double size) {
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
    const Vector<2> at =
        place / count + free_distance(arrows, place / count, outward, size) * outward;
    const char* const where = outward.x() > 0.5 ? "left" : outward.x() < -0.5 ? "right" : "center";
    const double middle = outward.y() > 0.5 ? 0.9 : outward.y() < -0.5 ? -0.5 : 0.1;
    label(script, quoted(scene.grasp.fingers()[k], 10), at, where, middle + 0.5, "black");
    const double force = fingers[k].force.norm();
    const bool loaded = force > 1e-9 * scene.grasp.size();
    if (scene.hold)
      label(script, quoted(newtons(loaded ? force : 0), 20), at, where, middle - 0.5, force_colour);
  }
}

/// The arrow of what acts besides the weight, dashed, with its label where it ends.
void draw_other(Script& script, const OtherLoad<2>& other, const std::vector<Vector<2>>& arrow,
                const Vector<2>& middle, double size) {
  const Vector<2> tip = arrow.back();
  const Vector<2> before = tip + 0.05 * (arrow[arrow.size() - 2] - tip);
  script.data("other", {arrow});
  script.layer("$other with lines lw 3 dt (4,2) lc rgb '{}' title '{}'", weight_colour,
               other_load_title);
  script.line("$othertip << end\n{} {} {} {}\nend", before.x(), before.y(), tip.x() - before.x(),
              tip.y() - before.y());
  script.layer(
      "$othertip with vectors head filled size graph 0.03,20 fixed lw 0.1 lc rgb '{}' notitle",
      weight_colour);
  // On the side away from where it begins, or from the middle of a round one.
  const double side = tip.x() < middle.x() - 0.01 * size ? -1 : 1;
  for (const std::string& words : other.words())
    label(script, quoted(words, 20), tip + Vector<2>(0.07 * side * size, 0),
          side < 0 ? "right" : "left", 0, weight_colour);
}

}  // namespace

void draw_object(Script& script, const std::optional<Shape>& shape, const Scene& scene,
                 const Minimum<2>* posture, double aspect) {
  const auto& contacts = scene.grasp.contacts();
  const Load<2>& load = scene.grasp.loads()[scene.load];
  const OtherLoad<2> other(scene.grasp, load, up_at(scene.theta));
  std::vector<Vector<2>> line;
  if (shape)
    for (const Vector<2>& point : outline(*shape)) line.push_back(scene.placed(point));

  // The view: room around the object for fingers and their labels.
  Vector<2> lower = Vector<2>::Zero(), upper = Vector<2>::Zero();
  const auto include = [&](const Vector<2>& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  };
  for (const Vector<2>& point : line) include(point);
  for (const Contact<2>& contact : contacts) include(scene.placed(contact.position));
  if (other.is_there()) include(scene.placed(other.from));
  const Vector<2> centre = (lower + upper) / 2;
  double size = (upper - lower).maxCoeff() / 2;
  if (!(size > 0)) size = 1;

  // Forces to one scale; the weight stays visible beside forces much larger than it.
  double largest = std::max(load.weight, other.force.norm());
  if (scene.hold)
    for (std::size_t i = 0; i < contacts.size(); ++i)
      largest = std::max(largest, force_vector(contacts[i], scene.hold->forces[i]).norm());
  const double scale = scene.scale.value_or(0.9 * size / largest);
  std::vector<Vector<2>> other_arrow;
  if (other.pushes) {
    const Vector<2> from = scene.placed(other.from);
    other_arrow = {from, from + scale * scene.turned(other.force)};
  } else if (other.turns) {
    const Vector<2> a(0, 0.45 * size), b(other.moment[0] > 0 ? -a.y() : a.y(), 0);
    other_arrow = round_arrow<2>(scene.placed(other.from), a, b);
  }
  double half = 1.55 * size;
  for (const Vector<2>& point : other_arrow) {
    const Vector<2> away = (point - centre).cwiseAbs();
    half = std::max({half, away.y() + 0.25 * size, (away.x() + 0.4 * size) / aspect});
  }
  const Vector<2> view(half * aspect, half);
  script.line("set xrange [{}:{}]\nset yrange [{}:{}]", centre.x() - view.x(),
              centre.x() + view.x(), centre.y() - view.y(), centre.y() + view.y());

  std::vector<std::vector<Vector<2>>> free, limited, cones, pads;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    cones.push_back(cone(scene, contacts[i], 0.75 * size));
    pads.push_back(pad(scene, contacts[i], 0.09 * size));
    if (!scene.hold || scene.hold->forces[i].state == ContactState::unloaded) continue;
    const Vector<2> force = scene.turned(force_vector(contacts[i], scene.hold->forces[i]));
    (scene.hold->forces[i].limit == ForceLimit::none ? free : limited)
        .push_back({scene.placed(contacts[i].position), scale * force});
  }
  const Vector<2> gravity(0, -std::max(scale * load.weight, 0.2 * size));

  line.push_back(line.empty() ? Vector<2>::Zero().eval() : line.front());
  script.data("outline", {line});
  script.data("cones", cones);
  script.data("pads", pads);
  script.data("com", {{Vector<2>::Zero()}});
  script.data("vertical", {{{0, centre.y() - 1.3 * size}, {0, centre.y() + 1.3 * size}}});
  if (shape)
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
      if (posture->hold().forces[i].state == ContactState::slipping)
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
  if (load.weight > 0) arrows("weight", {{Vector<2>::Zero(), gravity}}, weight_colour, "weight");
  if (!other_arrow.empty()) draw_other(script, other, other_arrow, scene.placed(other.from), size);
  script.layer("$com with points pt 7 ps 0.8 lc rgb '{}' notitle", weight_colour);
  if (load.weight > 0)
    label(script, quoted(newtons(load.weight), 20), gravity, "center", -0.8, weight_colour);
  free.insert(free.end(), limited.begin(), limited.end());
  if (!other_arrow.empty()) free.push_back({other_arrow[0], other_arrow.back() - other_arrow[0]});
  label_fingers(script, scene, free, size);
  script.plot();
  script.line("unset label");
}

}  // namespace poise
