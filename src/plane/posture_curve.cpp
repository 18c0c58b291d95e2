#include "poise/posture_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "plane/envelope.hpp"
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

/// An arc on which all is as in one hold.
Arc& add_constant(const Hold<2>& held, const Interval& at, PostureCurve& curve) {
  Arc arc;
  arc.from = at.from;
  arc.to = at.to;
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
  return curve.arcs.emplace_back(std::move(arc));
}

/// A posture that holds although its neighbours do not.
bool add_point(const Grasp<2>& grasp, double force_cap, double at, PostureCurve& curve) {
  std::optional<Hold<2>> most;
  std::size_t decides = 0;
  for (std::size_t k = 0; k < grasp.loads().size(); ++k) {
    Hold<2> held = hold(grasp, grasp.loads()[k], up_at(at), {force_cap, curve.objective});
    if (!held.holdable) return false;
    if (most && !(held.value() > most->value())) continue;
    most = std::move(held);
    decides = k;
  }
  add_constant(*most, {at, at}, curve).load = decides;
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

/// Puts pieces in order and finds the holdable postures.
void assemble(const Grasp<2>& grasp, double force_cap, PostureCurve& curve) {
  order(curve, curve.unholdable_arcs);
  add_points(grasp, force_cap, curve);
  order(curve, curve.arcs);
  curve.holdable.clear();
  drop_slivers(curve);
  join_arcs(curve);
}

/// Finds what follows from the arcs of a curve.
void complete(double present, PostureCurve& curve) {
  find_undecided(curve);
  curve.optima = optima(curve, present);
  for (Interval& interval : curve.holdable) {
    const double turns = 2 * pi * std::floor((interval.from + pi) / (2 * pi));
    interval.from -= turns;
    interval.to -= turns;
  }
}

/// The curve of effort of a load that does not turn with gravity.
PostureCurve constant_curve(const Grasp<2>& grasp, const Interval& domain, double force_cap) {
  PostureCurve curve{.domain = domain};
  const Hold<2> held = hold(grasp, up_at(domain.from), {force_cap});
  if (held.holdable)
    add_constant(held, domain, curve);
  else if (held.proven)
    curve.unholdable_arcs.push_back({domain.from, domain.to, held.dual});
  return curve;
}

/// Of a grasp with one load.
PostureCurve curve_of_one(const Grasp<2>& grasp, const Interval& domain,
                          const CurveSettings& settings) {
  // What holds at all, without the drives' max, is the same for both objectives.
  const Grasp<2> free = grasp.is_general() ? Grasp<2>(grasp.loads(), grasp.contacts()) : grasp;
  const bool turns = grasp.loads().front().turning() != 0;
  PostureCurve curve = turns ? trace(free, domain, settings.force_cap)
                             : constant_curve(free, domain, settings.force_cap);
  assemble(free, settings.force_cap, curve);
  if (settings.objective == Objective::grip) {
    curve.objective = Objective::grip;
    trace_grip(grasp, settings, curve);
    assemble(grasp, settings.force_cap, curve);
  }
  complete(settings.present, curve);
  return curve;
}

/// As they were given: those without a finger's label have none.
std::vector<Contact<2>> contacts_of(const Grasp<2>& grasp) {
  std::vector<Contact<2>> contacts = grasp.contacts();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    bool alone = true;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      alone = alone && (k == i || grasp.finger_of(k) != grasp.finger_of(i));
    if (alone && contacts[i].finger == std::to_string(i)) contacts[i].finger.clear();
  }
  return contacts;
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
  if (settings.objective == Objective::effort && grasp.is_general())
    throw InvalidGrasp("drives",
                       "have a max, which the curve of effort does not take into account: ask for "
                       "that of grip, leave it out, or give max_normal of the contacts");
  const Interval domain = domain_interval(grasp, settings.domain);
  if (grasp.loads().size() == 1) return curve_of_one(grasp, domain, settings);
  PostureCurve curve{.objective = settings.objective, .domain = domain};
  for (std::size_t k = 0; k < grasp.loads().size(); ++k) {
    // About the load's own com, which a turn need not move.
    const Load<2>& load = grasp.loads()[k];
    const Grasp<2> one(load, contacts_of(grasp), 1, grasp.mechanism());
    CurveSettings of_one = settings;
    of_one.force_cap = std::min(settings.force_cap * load.size(grasp.length()) / one.size(), 1e9);
    PostureCurve& own = curve.loads.emplace_back(curve_of_one(one, domain, of_one));
    for (Arc& arc : own.arcs) arc.load = k;
    for (UnholdableArc& gap : own.unholdable_arcs) gap.load = k;
  }
  trace_envelope(curve.loads, curve);
  assemble(grasp, settings.force_cap, curve);
  complete(settings.present, curve);
  return curve;
}

}  // namespace poise
