#include "report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "files/result.hpp"
#include "report_parts.hpp"

namespace poise {
namespace {

constexpr double pi = 3.14159265358979323846;

std::string range_text(const Interval& interval) {
  if (interval.from == interval.to) return "only at " + degrees_text(interval.from);
  if (interval.to - interval.from >= 2 * pi) return "in every posture";
  const std::string from = "from " + degrees_text(interval.from);
  if (interval.to <= pi) return from + " to " + degrees_text(interval.to);
  return from + " through 180° to " + degrees_text(interval.to - 2 * pi);
}

std::string ranges_text(const std::vector<Interval>& intervals) {
  if (intervals.empty()) return "in no posture";
  std::string text;
  for (const Interval& interval : intervals)
    text += (text.empty() ? "" : ", ") + range_text(interval);
  return text;
}

/// The posture of an optimum, and the stretch that is as good.
std::string posture_text(const Optimum& optimum) {
  const std::string angle = degrees_text(optimum.angle);
  if (optimum.from == optimum.to) return angle;
  const std::string stretch = range_text({optimum.from, optimum.to});
  return angle + " (the same " + stretch + ")";
}

std::string optima_text(const Grasp<2>& grasp, const std::vector<PlanarPosture>& optima,
                        bool with_type, const Style& style) {
  std::vector<OptimumRow> rows;
  for (const PlanarPosture& posture : optima) {
    const Optimum& optimum = posture.optimum;
    rows.push_back({posture_text(optimum),
                    grip_force(grasp, posture.hold),
                    optimum.effort,
                    {to_string(posture.manner), to_string(optimum.kind)}});
    if (with_type) rows.back().words.emplace_back(optimum.maximum ? "maximum" : "minimum");
  }
  std::vector<std::string> words{"manner", "kind"};
  if (with_type) words.emplace_back("type");
  return optima_table(rows, words, style);
}

/// "turn by 30.00° counter-clockwise"
std::string turn_text(double from, double to) {
  const double turn = std::remainder(to - from, 2 * pi);
  const std::string size = degrees_text(std::abs(turn));
  if (size == degrees_text(0)) return "stay";
  return "turn by " + size + (turn < 0 ? " clockwise" : " counter-clockwise");
}

/// One line of the summary: which posture, its angle, the forces, and how to get there.
void add_posture(Table& table, const std::string& which, const Grasp<2>& grasp, double theta,
                 const Hold<2>& hold, const std::string& how) {
  table.add({which, degrees_text(theta),
             hold.holdable ? "grip force " + newtons(grip_force(grasp, hold)) : "cannot be held",
             hold.holdable ? to_string(manner(grasp, up_at(theta), hold)) : "", how});
}

std::string scope(const CurveSettings& settings) {
  return settings.domain == Domain::all ? "" : " outside the fork of the fingers";
}

/// What the answer does not know, if anything.
std::string doubt(const PostureCurve& curve) {
  if (curve.undecided.empty()) return {};
  double sum = 0;
  for (const Interval& part : curve.undecided) sum += part.to - part.from;
  return "\n" + wrapped(fmt::format(
                    "Not all is proven: rounding left {:.2g}° of postures undecided, near {}.",
                    degrees(sum), degrees_text(curve.undecided.front().from)));
}

/// Why nothing in the domain can be held, in words.
std::string nowhere(const Grasp<2>& grasp, const PostureCurve& curve,
                    const CurveSettings& settings) {
  if (!curve.undecided.empty())
    return "Found no posture" + scope(settings) + " in which it can be held.\n" + doubt(curve);
  const Interval domain = domain_interval(grasp, settings.domain);
  const double middle = (domain.from + domain.to) / 2;
  const Hold<2> there = hold(grasp, up_at(middle), {.force_cap = settings.force_cap});
  std::string text = "Cannot be held in any posture" + scope(settings) + ".\n";
  if (!there.holdable)
    text += wrapped("At " + degrees_text(middle) + ": " + reason(grasp, there) + ".");
  return text;
}

}  // namespace

std::string check_report(const PlanarFile& file, const Grasp<2>& grasp, const Style& style) {
  const Interval cradled = cradled_wedge(grasp);
  return check_text<2>(
      file, {grasp},
      {{"held now", file.angle ? "turned to " + degrees_text(*file.angle) : "not given"},
       {"cradled", cradled.from < cradled.to ? range_text(cradled) + ", in the fork of the fingers"
                                             : "nowhere"}},
      style);
}

std::string hold_report(const PlanarFile& file, const Grasp<2>& grasp, double theta,
                        const Hold<2>& hold, const Style& style) {
  const std::string at = "At " + degrees_text(theta);
  if (!hold.holdable)
    return title(file.name, style) +
           wrapped(at + " it cannot be held: " + reason(grasp, hold) + ".");
  return title(file.name, style) +
         fmt::format("{}: grip force {}, {}\n", at, style.bold(newtons(grip_force(grasp, hold))),
                     to_string(manner(grasp, up_at(theta), hold))) +
         heading("Forces", style) + forces_table(grasp, hold, style) + effort_text(hold.effort);
}

std::string best_report(const PlanarFile& file, const Grasp<2>& grasp, const BestPosture& best,
                        const CurveSettings& settings, const Style& style) {
  std::string text = title(file.name, style);
  if (!best.holdable()) return text + nowhere(grasp, best.curve, settings);

  const PlanarPosture& lowest = best.best();
  const PlanarPosture* const pinched = best.best_pinched();
  const bool differ = pinched && pinched != &lowest;
  const double from = file.angle.value_or(0);
  Table summary({"<", "", "", "<", "<"});
  if (file.angle)
    add_posture(summary, "now", grasp, from,
                hold(grasp, up_at(from), {.force_cap = settings.force_cap}), "");
  const auto turn = [&](double to) { return file.angle ? turn_text(from, to) : std::string(); };
  add_posture(summary, "best", grasp, lowest.optimum.angle, lowest.hold,
              turn(lowest.optimum.angle));
  if (differ)
    add_posture(summary, "best pinched", grasp, pinched->optimum.angle, pinched->hold,
                turn(pinched->optimum.angle));
  text += summary.text(style);
  if (differ)
    text += "\n" + wrapped(why_pinching_costs(grasp, lowest.hold, lowest.manner, pinched->hold));
  if (!pinched) text += "\nThere is no pinched minimum" + scope(settings) + ".\n";

  text += heading("Minima, lowest first", style) + optima_text(grasp, best.minima, false, style);
  text += heading("Forces at " + degrees_text(lowest.optimum.angle) + ", the best", style) +
          forces_table(grasp, lowest.hold, style);
  if (differ)
    text +=
        heading("Forces at " + degrees_text(pinched->optimum.angle) + ", the best pinched", style) +
        forces_table(grasp, pinched->hold, style);
  return text + "\nHoldable " + ranges_text(best.curve.holdable) + scope(settings) + ".\n" +
         doubt(best.curve);
}

std::string curve_report(const PlanarFile& file, const Grasp<2>& grasp, const PostureCurve& curve,
                         const CurveSettings& settings, const Style& style) {
  std::string text = title(file.name, style);
  if (curve.holdable.empty()) return text + nowhere(grasp, curve, settings);
  std::vector<PlanarPosture> optima;
  for (const Optimum& optimum : curve.optima)
    optima.push_back(posture_at(grasp, optimum, settings));
  text += "Holdable " + ranges_text(curve.holdable) + scope(settings) + ".\n" + doubt(curve);
  text += heading("Minima, lowest first, then maxima, highest first", style) +
          optima_text(grasp, optima, true, style);

  // Along an arc nothing changes but the size of the forces.
  constexpr std::size_t most_columns = 8;
  const std::size_t contacts = grasp.contacts().size();
  std::vector<std::string> headings{"from", "to", "force norm [N]", "to [N]"};
  if (contacts <= most_columns)
    for (std::size_t i = 0; i < contacts; ++i) headings.push_back("<" + grasp.contacts()[i].finger);
  Table table(headings);
  double largest = 0;
  for (const Arc& arc : curve.arcs) largest = std::max({largest, arc.V(arc.from), arc.V(arc.to)});
  const int decimals = decimals_for(std::sqrt(largest));
  const auto norm = [](const Arc& arc, double theta) {
    return std::sqrt(std::max(0.0, arc.V(theta)));
  };
  for (const Arc& arc : curve.arcs) {
    std::vector<std::string> row{degrees_text(arc.from), degrees_text(arc.to),
                                 fixed(norm(arc, arc.from), decimals),
                                 fixed(norm(arc, arc.to), decimals)};
    if (contacts <= most_columns)
      for (std::size_t i = 0; i < contacts; ++i) {
        const ArcState& state = curve.states[arc.first_state + i];
        row.push_back(
            std::string(to_string(state.state)) +
            (state.limit == ForceLimit::none ? "" : std::string(" at ") + to_string(state.limit)));
      }
    table.add(std::move(row));
  }
  return text + heading("Arcs: what each contact does", style) + table.text(style);
}

}  // namespace poise
