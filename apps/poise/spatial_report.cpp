#include <fmt/core.h>

#include <cmath>

#include "files/result.hpp"
#include "files/spatial.hpp"
#include "report.hpp"
#include "report_parts.hpp"

namespace poise {
namespace {

std::string direction_text(const Vector<3>& v) { return vector_text(v, 3); }

std::string tilt_text(const Tilt& tilt) {
  return "at most " + degrees_text(tilt.most) + " from " + direction_text(tilt.from);
}

/// Postures to choose from, in a sentence.
std::string scope(const SpatialSettings& settings) {
  return settings.tilt ? " " + tilt_text(*settings.tilt) : "";
}

/// "turn by 30.00° about (0.000, 1.000, 0.000)"
std::string turn_text(const Turn& turn) {
  const std::string angle = degrees_text(turn.angle);
  if (angle == degrees_text(0)) return "stay";
  return "turn by " + angle + " about " + direction_text(turn.axis);
}

/// "reason", and in which scenario.
std::string reason_text(const std::vector<Grasp<3>>& grasps, const SpatialPosture& posture) {
  const std::string why = reason(grasps[posture.scenario], posture.hold);
  return grasps.size() == 1 ? why : fmt::format("in scenario {} {}", posture.scenario, why);
}

/// How hard the hardest pressing finger presses in any scenario [N]; none where one cannot be held.
std::optional<double> grip_of_all(const std::vector<Grasp<3>>& grasps, const Vector<3>& up,
                                  const HoldSettings& settings) {
  double most = 0;
  for (const Grasp<3>& grasp : grasps) {
    const Hold<3> there = hold<3>(grasp, up, settings);
    if (!there.holdable) return {};
    most = std::max(most, grip_force(grasp, there));
  }
  return most;
}

/// What each scenario needs in a posture; nothing where there is but one.
std::string scenarios_table(const std::vector<Grasp<3>>& grasps, const SpatialPosture& posture,
                            const HoldSettings& settings, const Style& style) {
  if (grasps.size() == 1) return {};
  std::vector<Hold<3>> holds;
  double effort = 0, grip = 0;  // the largest
  for (const Grasp<3>& grasp : grasps) {
    holds.push_back(hold<3>(grasp, posture.up, settings));
    effort = std::max(effort, holds.back().effort);
    grip = std::max(grip, grip_force(grasp, holds.back()));
  }
  const Lengths lengths(grasps.front().radius());
  Table table({"scenario", "weight [N]", fmt::format("centre of mass [{}]", lengths.unit),
               "grip force [N]", "force norm [N]", "effort [N²]", "<"});
  for (std::size_t k = 0; k < grasps.size(); ++k) {
    const Object<3>& object = grasps[k].object();
    std::vector<std::string> row{std::to_string(k), plain(object.weight), lengths.text(object.com)};
    if (holds[k].holdable)
      row.insert(row.end(), {fixed(grip_force(grasps[k], holds[k]), decimals_for(grip)),
                             fixed(std::sqrt(holds[k].effort), decimals_for(std::sqrt(effort))),
                             fixed(holds[k].effort, decimals_for(effort)),
                             k == posture.scenario ? "decides" : ""});
    else
      row.insert(row.end(), {"", "", "", "cannot be held"});
    table.add(std::move(row));
  }
  return heading("Scenarios", style) + table.text(style);
}

std::string of_scenario(const std::vector<Grasp<3>>& grasps, const SpatialPosture& posture) {
  return grasps.size() == 1 ? "" : fmt::format(", in scenario {}", posture.scenario);
}

void add_posture(Table& table, const std::string& which, const std::vector<Grasp<3>>& grasps,
                 const SpatialPosture& posture, const HoldSettings& settings,
                 const std::string& how) {
  const auto grip = grip_of_all(grasps, posture.up, settings);
  table.add({which, direction_text(posture.up),
             grip ? "grip force " + newtons(*grip) : "cannot be held",
             grip ? to_string(posture.manner) : "", how});
}

std::string optima_text(const std::vector<Grasp<3>>& grasps,
                        const std::vector<SpatialPosture>& optima, const HoldSettings& settings,
                        const Style& style) {
  std::vector<OptimumRow> rows;
  for (const SpatialPosture& posture : optima) {
    rows.push_back({direction_text(posture.up),
                    grip_of_all(grasps, posture.up, settings).value_or(0),
                    posture.effort(),
                    {to_string(posture.manner)}});
    if (grasps.size() > 1) rows.back().words.push_back(std::to_string(posture.scenario));
  }
  std::vector<std::string> words{"manner"};
  if (grasps.size() > 1) words.emplace_back("scenario");
  return optima_table(rows, words, style);
}

/// How sure the best is.
std::string proof_text(const BestSpatialPosture& best, const SpatialSettings& settings) {
  if (best.status == Status::optimal)
    return fmt::format(
        "Proven with {} holds: the effort of no posture{} is lower by more than a part of {:.1g}.",
        best.holds, scope(settings), std::max(best.relative_gap, 1e-12));
  return fmt::format(
      "Not proven: a gap of {:.2g} was wanted, after {} holds it is {:.2g}. A posture{} may exist "
      "that needs an effort of only {} N²; more holds (--max-holds) may tell.",
      settings.gap, best.holds, best.relative_gap, scope(settings), plain(best.lower_bound));
}

/// Why no posture is shown.
std::string nowhere(const std::vector<Grasp<3>>& grasps, const BestSpatialPosture& best,
                    const SpatialSettings& settings, const Vector<3>& present) {
  if (best.status == Status::gap)
    return wrapped(fmt::format(
        "Found no posture{} in which it can be held, in {} holds. That there is none is not "
        "proven; more holds (--max-holds) may tell.",
        scope(settings), best.holds));
  std::string text = wrapped("Cannot be held in any posture" + scope(settings) + ".");
  const Vector<3> up = settings.tilt ? settings.tilt->from : present;
  const SpatialPosture there = hold_all(grasps, up, {settings.force_cap});
  if (!there.hold.holdable)
    text += wrapped("With " + direction_text(up) + " up: " + reason_text(grasps, there) + ".");
  return text;
}

}  // namespace

std::string check_report(const SpatialFile& file, const std::vector<Grasp<3>>& grasps,
                         const Style& style) {
  return check_text<3>(
      file, grasps,
      {{"held now", file.up ? "with " + direction_text(*file.up) + " up" : "not given"},
       {"allowed", file.tilt ? tilt_text(*file.tilt) : "every posture"}},
      style);
}

std::string hold_report(const SpatialFile& file, const std::vector<Grasp<3>>& grasps,
                        const SpatialPosture& posture, const HoldSettings& settings,
                        const Style& style) {
  const Grasp<3>& grasp = grasps[posture.scenario];
  const std::string at = "With " + direction_text(posture.up) + " up";
  const std::string scenarios = scenarios_table(grasps, posture, settings, style);
  if (!posture.hold.holdable)
    return title(file.name, style) +
           wrapped(at + " it cannot be held: " + reason_text(grasps, posture) + ".") + scenarios;
  return title(file.name, style) +
         fmt::format("{}: grip force {}, {}\n", at,
                     style.bold(newtons(grip_of_all(grasps, posture.up, settings).value_or(0))),
                     to_string(posture.manner)) +
         heading("Forces" + of_scenario(grasps, posture), style) +
         forces_table(grasp, posture.hold, style) + effort_text(posture.effort()) + scenarios;
}

std::string best_report(const SpatialFile& file, const std::vector<Grasp<3>>& grasps,
                        const BestSpatialPosture& best, const SpatialSettings& settings,
                        const Present& present, const Style& style) {
  std::string text = title(file.name, style);
  const Vector<3> now = present.orientation.conjugate() * Vector<3>::UnitZ();
  if (!best.best) return text + nowhere(grasps, best, settings, now);

  const HoldSettings forces{settings.force_cap};
  const SpatialPosture& lowest = *best.best;
  const SpatialPosture* const pinched = best.best_pinched();
  // The best comes first among the minima.
  const bool differ = pinched && pinched != &best.minima.front();
  std::vector<std::pair<std::string, const SpatialPosture*>> shown{{"best", &lowest}};
  if (differ) shown.emplace_back("best pinched", pinched);

  Table summary({"<", "up", "", "<", "<"}), rotations({"<", "w", "x", "y", "z"});
  if (present.known) add_posture(summary, "now", grasps, hold_all(grasps, now, forces), forces, "");
  for (const auto& [which, posture] : shown) {
    const Turn turn = turn_to(present.orientation, posture->up);
    add_posture(summary, which, grasps, *posture, forces, turn_text(turn));
    std::vector<std::string> row{which};
    for (const double part :
         {turn.rotation.w(), turn.rotation.x(), turn.rotation.y(), turn.rotation.z()})
      row.push_back(fixed(part, 6));
    rotations.add(std::move(row));
  }
  text += summary.text(style);
  text += "\n" + wrapped(proof_text(best, settings));
  if (differ)
    text += "\n" + wrapped(why_pinching_costs(grasps[lowest.scenario], lowest.hold, lowest.manner,
                                              pinched->hold));
  if (!pinched)
    text += "\n" + wrapped(lowest.manner == Manner::pinched
                               ? "All pinched minima that were found are at the border of the "
                                 "postures that are allowed or can be held."
                               : "No pinched minimum was found inside the postures that are "
                                 "allowed and can be held.");

  text += heading("The turn as a quaternion, in the world frame with +z up", style) +
          rotations.text(style);
  for (const auto& [which, posture] : shown)
    text += heading("Forces at the " + which + of_scenario(grasps, *posture), style) +
            forces_table(grasps[posture->scenario], posture->hold, style);
  text += scenarios_table(grasps, lowest, forces, style);
  return text + heading("Minima found, lowest first; there may be others", style) +
         optima_text(grasps, best.minima, forces, style);
}

}  // namespace poise
