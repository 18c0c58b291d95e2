#include "poise/posture_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/grip_tracer.hpp"
#include "plane/optima.hpp"
#include "plane/tracer.hpp"

namespace poise {
namespace {

using std::numbers::pi;

bool is_circle(const PostureCurve& curve) { return curve.domain.to - curve.domain.from >= 2 * pi; }

/// By where they begin; of a circle within one turn from its start.
template <class Piece>
void order(const PostureCurve& curve, std::vector<Piece>& pieces) {
  const double start = curve.domain.from;
  for (Piece& piece : pieces) {
    const double turns =
        is_circle(curve) ? 2 * pi * std::floor((piece.from - start) / (2 * pi)) : 0;
    piece.from -= turns;
    piece.to -= turns;
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.from < b.from; });
}

/// A posture that holds although its neighbours do not.
bool add_point(const Grasp<2>& grasp, double force_cap, double at, PostureCurve& curve) {
  const Hold<2> held = hold(grasp, up_at(at), {force_cap, curve.objective});
  if (!held.holdable) return false;
  Arc arc;
  arc.from = arc.to = at;
  arc.value.c0 = held.value();
  if (curve.objective == Objective::grip) {
    arc.rates.emplace(held.rates.begin(), held.rates.end());
    for (const ContactForce<2>& force : held.forces)
      arc.forces.push_back({{force.normal, 0, 0}, {force.tangential, 0, 0}});
  }
  for (std::size_t k = 0; k < 3; ++k) arc.y[k].c0 = held.dual[static_cast<int>(k)];
  arc.first_state = curve.states.size();
  for (const ContactForce<2>& force : held.forces)
    curve.states.push_back({force.state, force.limit});
  curve.arcs.push_back(arc);
  return true;
}

/// Single postures hold, if any, where unholdable arcs meet or the domain ends.
void add_points(const Grasp<2>& grasp, double force_cap, PostureCurve& curve) {
  const auto add = [&](double at) { return add_point(grasp, force_cap, at, curve); };
  const std::vector<UnholdableArc>& gaps = curve.unholdable_arcs;
  const bool circle = is_circle(curve);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const bool last = i + 1 == gaps.size();
    if (!circle && gaps[i].from - curve.domain.from <= same_angle) add(curve.domain.from);
    const double next = !last ? gaps[i + 1].from : circle ? gaps[0].from + 2 * pi : curve.domain.to;
    if (next - gaps[i].to > undecidable) continue;
    if (last && !circle) {
      add(curve.domain.to);
    } else if (!add(gaps[i].to) && next != gaps[i].to) {
      add(next);
    }
  }
}

/// Where an arc gives way to unholdable postures, rounding may find slivers in between.
void drop_slivers(PostureCurve& curve) {
  const auto is_sliver = [](const Arc& arc) { return arc.to - arc.from <= undecidable; };
  const auto is_same = [](double a, double b) {
    return std::abs(std::remainder(a - b, 2 * pi)) <= undecidable;
  };
  const auto is_between = [&](const Arc& sliver) {
    const auto touches = [&](const auto& piece) {
      return is_same(piece.from, sliver.to) || is_same(piece.to, sliver.from);
    };
    return std::any_of(curve.unholdable_arcs.begin(), curve.unholdable_arcs.end(), touches) &&
           std::any_of(curve.arcs.begin(), curve.arcs.end(),
                       [&](const Arc& arc) { return !is_sliver(arc) && touches(arc); });
  };
  const auto is_dropped = [&](const Arc& arc) { return is_sliver(arc) && is_between(arc); };
  if (std::none_of(curve.arcs.begin(), curve.arcs.end(), is_dropped)) return;
  const std::size_t contacts = curve.states.size() / curve.arcs.size();
  std::vector<Arc> kept;
  std::vector<ArcState> states;
  for (Arc arc : curve.arcs) {
    if (is_dropped(arc)) continue;
    const ArcState* first = &curve.states[arc.first_state];
    arc.first_state = states.size();
    states.insert(states.end(), first, first + contacts);
    kept.push_back(arc);
  }
  curve.arcs = std::move(kept);
  curve.states = std::move(states);
}

/// Neighbouring arcs end at one posture; what is closer than rounding touches.
void join_arcs(PostureCurve& curve) {
  std::vector<Arc>& arcs = curve.arcs;
  std::vector<Interval>& holdable = curve.holdable;
  const auto has_gap = [&](double from, double to) {
    return std::any_of(curve.unholdable_arcs.begin(), curve.unholdable_arcs.end(),
                       [&](const UnholdableArc& gap) {
                         return gap.from < to && gap.to > from && gap.to - gap.from > same_angle;
                       });
  };
  for (Arc& arc : arcs) {
    const bool joins = !holdable.empty() && arc.from - holdable.back().to <= undecidable &&
                       !has_gap(holdable.back().to, arc.from);
    if (joins) {
      arc.from = holdable.back().to;
      arc.to = std::max(arc.from, arc.to);
      holdable.back().to = arc.to;
    } else {
      holdable.push_back({arc.from, arc.to});
    }
  }
  if (!is_circle(curve) || holdable.empty()) return;
  Interval& first = holdable.front();
  Interval& last = holdable.back();
  if (first.from + 2 * pi - last.to > undecidable) return;
  arcs.back().to = first.from + 2 * pi;  // the last arc runs into the first
  if (holdable.size() == 1) {
    first = {-pi, pi};
  } else {
    last.to = first.to + 2 * pi;
    holdable.erase(holdable.begin());
  }
}

/// What of the domain is in no piece.
void find_undecided(PostureCurve& curve) {
  double covered = 0;  // pieces do not overlap
  for (const Arc& arc : curve.arcs) covered += arc.to - arc.from;
  for (const UnholdableArc& gap : curve.unholdable_arcs) covered += gap.to - gap.from;
  if (covered >= curve.domain.to - curve.domain.from - undecidable) return;
  std::vector<Interval> pieces;
  for (const Arc& arc : curve.arcs) pieces.push_back({arc.from, arc.to});
  for (const UnholdableArc& gap : curve.unholdable_arcs) pieces.push_back({gap.from, gap.to});
  std::sort(pieces.begin(), pieces.end(),
            [](const Interval& a, const Interval& b) { return a.from < b.from; });
  double reached = curve.domain.from, end = curve.domain.to;
  if (is_circle(curve) && !pieces.empty()) {  // once around from the first piece to itself
    reached = pieces.front().from;
    end = reached + 2 * pi;
  }
  pieces.push_back({end, end});
  for (const Interval& piece : pieces) {
    if (piece.from - reached > undecidable) curve.undecided.push_back({reached, piece.from});
    reached = std::max(reached, piece.to);
  }
}

}  // namespace

const char* to_string(Kind kind) {
  constexpr const char* names[] = {"boundary", "kink", "smooth"};
  return names[static_cast<int>(kind)];
}

Interval domain_interval(const Grasp<2>& grasp, Domain domain) {
  if (domain == Domain::all) return {-pi, pi};
  const Interval wedge = fork_wedge(grasp, grasp.loads().front().com);
  if (!(wedge.to > wedge.from)) return {-pi, pi};
  return wedge.to < pi ? Interval{wedge.to, wedge.from + 2 * pi}
                       : Interval{wedge.to - 2 * pi, wedge.from};
}

PostureCurve posture_curve(const Grasp<2>& grasp, const CurveSettings& settings) {
  if (grasp.loads().size() > 1)
    throw InvalidGrasp("loads", "must be one: the grasp is in the plane");
  const bool is_grip = settings.objective == Objective::grip;
  if (!is_grip && grasp.is_general())
    throw InvalidGrasp("drives",
                       "have a max, which the curve of effort does not take into account: ask for "
                       "that of grip, leave it out, or give max_normal of the contacts");
  // What holds at all, without the drives' max, is the same for both.
  const Grasp<2> free = grasp.is_general() ? Grasp<2>(grasp.loads(), grasp.contacts()) : grasp;
  PostureCurve curve = trace(free, settings);
  order(curve, curve.unholdable_arcs);
  add_points(free, settings.force_cap, curve);
  order(curve, curve.arcs);
  drop_slivers(curve);
  join_arcs(curve);
  if (is_grip) {
    curve.objective = Objective::grip;
    trace_grip(grasp, settings, curve);
    order(curve, curve.unholdable_arcs);
    add_points(grasp, settings.force_cap, curve);
    order(curve, curve.arcs);
    curve.holdable.clear();
    drop_slivers(curve);
    join_arcs(curve);
  }
  find_undecided(curve);
  curve.optima = optima(curve, settings.present);
  for (Interval& interval : curve.holdable) {
    const double turns = 2 * pi * std::floor((interval.from + pi) / (2 * pi));
    interval.from -= turns;
    interval.to -= turns;
  }
  return curve;
}

}  // namespace poise
