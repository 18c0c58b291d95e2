#include "turn/peak.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "space/search.hpp"

namespace poise {
namespace turns {
namespace {

/// The border between postures that hold and others is looked for this closely [rad].
constexpr double border = 1e-7;
/// Arcs are cut so short [rad] at first.
constexpr double first_length = 1.1;

/// A posture of the arc.
struct Node {
  double t;
  Valued at;
};

/// Between two neighbours.
struct Part {
  Node from, to;
  double most;  ///< of p

  bool operator<(const Part& other) const { return most < other.most; }
};

/// The enclosure of one arc on the way to it.
struct Search {
  Values& values;
  const Arc& arc;
  Enclosure found{};
  std::priority_queue<Part> open{};
  std::vector<Part> unholdable{};  ///< found to be so, or too short to tell

  Node node(double t) {
    Node node{t, values.at(arc.at(t))};
    if (node.at.p >= found.least) {
      found.least = node.at.p;
      found.at = t;
      found.posture = node.at;
    }
    return node;
  }

  void add(const Node& from, const Node& to) {
    Part part{from, to, values.most_between(from.at, to.at)};
    const bool is_short = to.t - from.t < border;
    if (is_short && from.at.holdable() && to.at.holdable())
      part.most = std::max(from.at.p, to.at.p);
    const auto refutes = [&](const Valued& end) {
      return !end.holdable() &&
             !(values.least_between(end.half_space, from.at.x, to.at.x) < infinity);
    };
    if (part.most < infinity)
      open.push(std::move(part));
    else if (refutes(from.at) || refutes(to.at) || is_short)
      unholdable.push_back(std::move(part));
    else
      open.push(std::move(part));
  }

  void halve_widest() {
    const Part part = open.top();
    open.pop();
    const Node middle = node((part.from.t + part.to.t) / 2);
    add(part.from, middle);
    add(middle, part.to);
  }

  /// Neighbouring parts as one stretch, as long as no posture between them holds.
  void join_unholdable() {
    std::sort(unholdable.begin(), unholdable.end(),
              [](const Part& a, const Part& b) { return a.from.t < b.from.t; });
    std::vector<std::vector<double>> inside;
    for (const Part& part : unholdable) {
      auto& stretches = found.unholdable;
      if (stretches.empty() || part.from.at.holdable() || stretches.back().to < part.from.t) {
        stretches.push_back({part.from.t, part.to.t, 0});
        inside.emplace_back();
      }
      stretches.back().to = part.to.t;
      for (const Node* end : {&part.from, &part.to})
        if (!end->at.holdable()) inside.back().push_back(end->t);
    }
    for (std::size_t k = 0; k < inside.size(); ++k) {
      Enclosure::Stretch& stretch = found.unholdable[k];
      const double middle = (stretch.from + stretch.to) / 2;
      stretch.at = *std::min_element(inside[k].begin(), inside[k].end(), [&](double a, double b) {
        return std::abs(a - middle) < std::abs(b - middle);
      });
    }
  }
};

}  // namespace

Enclosure peak_of(Values& values, const Arc& arc, double gap, double enough, int max_holds) {
  Search search{values, arc};
  const int parts = 1 + static_cast<int>(arc.angle / first_length);
  const int last = values.holds() + max_holds;
  Node before = search.node(0);
  for (int k = 1; k <= parts; ++k) {
    const Node next = search.node(arc.angle * k / parts);
    search.add(before, next);
    before = next;
  }
  Enclosure& found = search.found;
  const bool is_thorough = !(enough < infinity);
  const auto is_done = [&] {
    if (search.open.empty()) return true;
    const double most = search.open.top().most;
    if (!is_thorough && (found.least > enough || most <= enough)) return true;
    // Where something is unholdable, only how far matters.
    return most < infinity &&
           (!(found.least < infinity) || most - found.least <= gap * most || most <= nothing);
  };
  while (!is_done() && values.holds() < last) search.halve_widest();
  found.most = search.open.empty() ? found.least : std::max(found.least, search.open.top().most);
  if (!search.unholdable.empty()) found.most = infinity;
  search.join_unholdable();
  return found;
}

}  // namespace turns

namespace {

TurnPeak<3> peak_along(const Grasp<3>& grasp, const turns::Arc& arc, const TurnSettings& settings) {
  search::check_search(settings);
  turns::Values values(grasp, settings);
  const turns::Enclosure found = turns::peak_of(values, arc, values.gap_of_p(settings.gap),
                                                turns::infinity, settings.max_holds);
  TurnPeak<3> result{arc.angle, values.value(found.most),        values.value(found.least),
                     found.at,  values.posture(found.posture.x), {}};
  for (const auto& stretch : found.unholdable)
    result.unholdable.push_back(
        {stretch.from, stretch.to, stretch.at, values.unholdable(arc.at(stretch.at))});
  return result;
}

}  // namespace

TurnPeak<3> turn_peak(const Grasp<3>& grasp, const Eigen::Quaterniond& from, const Vector<3>& to,
                      const TurnSettings& settings) {
  turns::check_unit("to", to);
  if (!(from.norm() > 1e-9) || !std::isfinite(from.norm()))
    throw InvalidGrasp("from", "must be a rotation");
  // Where `to` points straight down, the axis is the world's x: on the way the world's y is up.
  const Eigen::Quaterniond back = from.normalized().conjugate();
  return peak_along(
      grasp,
      turns::arc_between(back * Vector<3>::UnitZ(), to.normalized(), back * Vector<3>::UnitY()),
      settings);
}

TurnPeak<3> turn_peak(const Grasp<3>& grasp, const Vector<3>& from, const Vector<3>& to,
                      const TurnSettings& settings) {
  turns::check_unit("from", from);
  return turn_peak(grasp, orientation_of(from.normalized()), to, settings);
}

}  // namespace poise
