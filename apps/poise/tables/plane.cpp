// What `poise best` and `poise curve` say in the plane.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "files/degrees.hpp"
#include "tables/parts.hpp"
#include "tables/report.hpp"
#include "tables/turn.hpp"

namespace poise {
namespace {

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

enum class Types { left_out, shown };

std::string optima_text(const Grasp<2>& grasp, const std::vector<Minimum<2>>& optima, Types types,
                        const Style& style) {
  std::vector<OptimumRow> rows;
  for (const Minimum<2>& posture : optima) {
    const Optimum& optimum = posture.optimum;
    rows.push_back({posture_text(optimum),
                    grip_of<2>(grasp, posture),
                    posture.effort(),
                    {to_string(posture.manner), to_string(optimum.kind)}});
    if (types == Types::shown)
      rows.back().words.emplace_back(optimum.maximum ? "maximum" : "minimum");
  }
  std::vector<std::string> words{"manner", "kind"};
  if (types == Types::shown) words.emplace_back("type");
  return optima_table(grasp, rows, words, style);
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
std::string nowhere(const Grasp<2>& grasp, const PostureCurve& curve, const CurveSettings& settings,
                    const std::optional<Posture<2>>& example,
                    const std::optional<Posture<2>>& without_max = {}) {
  if (!curve.undecided.empty())
    return "Found no posture" + scope(settings) + " in which it can be held.\n" + doubt(curve);
  return "Cannot be held in any posture" + scope(settings) + ".\n" +
         why_nowhere<2>(grasp, example, without_max);
}

/// Along an arc nothing changes but the size of the forces.
std::string arcs_table(const Grasp<2>& grasp, const PostureCurve& curve, const Style& style) {
  constexpr std::size_t most_columns = 8;
  const std::size_t contacts = grasp.contacts().size();
  const bool is_grip = curve.objective == Objective::grip;
  const bool several = grasp.loads().size() > 1;
  std::vector<std::string> headings{"from", "to", is_grip ? "grip" : "force norm [N]",
                                    is_grip ? "to" : "to [N]"};
  if (several) headings.emplace_back("<load");
  if (!is_grip && contacts <= most_columns)
    for (std::size_t i = 0; i < contacts; ++i) headings.push_back("<" + grasp.contacts()[i].finger);
  Table table(headings);
  double largest = 0;
  for (const Arc& arc : curve.arcs)
    largest = std::max({largest, arc.value(arc.from), arc.value(arc.to)});
  const int decimals = decimals_for(std::sqrt(largest));
  const auto value = [&](const Arc& arc, double theta) {
    const double here = std::max(0.0, arc.value(theta));
    return is_grip ? grip_text(grasp, here) : fixed(std::sqrt(here), decimals);
  };
  for (const Arc& arc : curve.arcs) {
    std::vector<std::string> row{degrees_text(arc.from), degrees_text(arc.to), value(arc, arc.from),
                                 value(arc, arc.to)};
    if (several) row.push_back(load_name(grasp, arc.load));
    if (!is_grip && contacts <= most_columns)
      for (std::size_t i = 0; i < contacts; ++i) {
        const ArcState& state = curve.states[arc.first_state + i];
        row.push_back(
            std::string(to_string(state.state)) +
            (state.limit == ForceLimit::none ? "" : std::string(" at ") + to_string(state.limit)));
      }
    table.add(std::move(row));
  }
  return heading(is_grip ? "Arcs: on each one proof" : "Arcs: what each contact does", style) +
         table.text(style);
}

}  // namespace

std::string report(const PlanarFile& file, const Grasp<2>& grasp, const BestAnswer<2>& answer,
                   const Style& style) {
  const Best<2>& best = answer.best;
  const PostureCurve& curve = best.proof.curve;
  const CurveSettings& settings = answer.settings;
  std::string text = title(file.name, style);
  if (!best.holdable())
    return text + nowhere(grasp, curve, settings, answer.unholdable, answer.without_max);

  const Minimum<2>& lowest = best.best();
  const Minimum<2>* const pinched = best.best_pinched();
  std::vector<std::pair<std::string, const Minimum<2>*>> shown{{"best", &lowest}};
  const bool differ = pinched && !ties_with(*pinched, lowest);
  if (differ) shown.emplace_back("best pinched", pinched);
  Table summary({"<", "", "", "<", "<"});
  if (answer.now) add_posture(summary, "now", grasp, *answer.now, "");
  const auto turn = [&](const Minimum<2>& posture) {
    if (&posture == &lowest && answer.turn) return answer.turn->straight.angle;
    return std::remainder(posture.optimum.angle - *file.angle, 2 * std::numbers::pi);
  };
  for (const auto& [which, posture] : shown)
    add_posture<2>(summary, which, grasp, *posture,
                   !file.angle                        ? ""
                   : ties_with(*answer.now, *posture) ? "stay: it is as good"
                                                      : turn_text(turn(*posture)));
  text += summary.text(style);
  if (answer.now && answer.turn)
    text += "\n" + taken_text(grasp, *answer.now, lowest, *answer.turn, style);
  if (answer.now && answer.within_reach)
    text += "\n" + reach_text(grasp, *answer.now, *answer.within_reach);
  if (differ) text += "\n" + wrapped(why_pinching_costs<2>(grasp, lowest, *pinched));
  if (!pinched) text += "\nThere is no pinched minimum" + scope(settings) + ".\n";

  text += heading("Minima, lowest first", style) +
          optima_text(grasp, best.minima, Types::left_out, style);
  for (const auto& [which, posture] : shown)
    text += heading("Forces at " + degrees_text(posture->optimum.angle) + ", the " + which, style) +
            forces_table(grasp, posture->hold(), style);
  return text + "\nHoldable " + ranges_text(curve.holdable) + scope(settings) + ".\n" +
         doubt(curve);
}

std::string report(const PlanarFile& file, const Grasp<2>& grasp, const CurveAnswer& answer,
                   const Style& style) {
  const PostureCurve& curve = answer.curve;
  const std::string text = title(file.name, style);
  if (curve.holdable.empty())
    return text + nowhere(grasp, curve, answer.settings, answer.unholdable);
  return text + "Holdable " + ranges_text(curve.holdable) + scope(answer.settings) + ".\n" +
         doubt(curve) + heading("Minima, lowest first, then maxima, highest first", style) +
         optima_text(grasp, answer.optima, Types::shown, style) + arcs_table(grasp, curve, style);
}

}  // namespace poise
