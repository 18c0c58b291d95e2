// What `poise best` says in space.
#include <fmt/core.h>

#include "poise/turn.hpp"
#include "tables/parts.hpp"
#include "tables/report.hpp"
#include "tables/turn.hpp"

namespace poise {
namespace {

/// Postures to choose from, in a sentence.
std::string scope(const SpatialSettings& settings) {
  return settings.tilt ? " " + tilt_text(*settings.tilt) : "";
}

std::string optima_text(const Grasp<3>& grasp, const std::vector<Minimum<3>>& optima,
                        const Style& style) {
  const bool several = grasp.loads().size() > 1;
  std::vector<OptimumRow> rows;
  for (const Minimum<3>& posture : optima) {
    rows.push_back({posture_text(posture.up),
                    grip_of<3>(grasp, posture),
                    posture.effort(),
                    {to_string(posture.manner)}});
    if (several) rows.back().words.push_back(load_name(grasp, posture.decides));
  }
  std::vector<std::string> words{"manner"};
  if (several) words.emplace_back("load");
  return optima_table(grasp, rows, words, style);
}

/// Where something is not proven: whether more holds are of use.
const char* what_may_tell(const Best<3>& best, const SpatialSettings& settings) {
  return best.proof.holds < settings.max_holds ? "rounding leaves that open."
                                               : "more holds (--max-holds) may tell.";
}

/// How sure the best is.
std::string proof_text(const Best<3>& best, const SpatialSettings& settings) {
  const bool is_grip = settings.objective == Objective::grip;
  if (best.status == Status::optimal)
    return fmt::format(
        "Proven with {} holds: the {} of no posture{} is lower by more than a part of {:.1g}.",
        best.proof.holds, to_string(settings.objective), scope(settings),
        std::max(best.relative_gap, 1e-12));
  return fmt::format(
      "Not proven: a gap of {:.2g} was wanted, after {} holds it is {:.2g}. A posture{} may exist "
      "that needs {} of only {}{}; {}",
      settings.gap, best.proof.holds, best.relative_gap, scope(settings),
      is_grip ? "a grip" : "an effort", plain(best.lower_bound), is_grip ? "" : " N²",
      what_may_tell(best, settings));
}

/// Why no posture is shown.
std::string nowhere(const Grasp<3>& grasp, const BestAnswer<3>& answer) {
  if (answer.best.status == Status::gap)
    return wrapped(fmt::format(
        "Found no posture{} in which it can be held, in {} holds. That there is none is not "
        "proven; {}",
        scope(answer.settings), answer.best.proof.holds,
        what_may_tell(answer.best, answer.settings)));
  return wrapped("Cannot be held in any posture" + scope(answer.settings) + ".") +
         why_nowhere<3>(grasp, answer.unholdable, answer.without_max);
}

}  // namespace

std::string report(const SpatialFile& file, const Grasp<3>& grasp, const BestAnswer<3>& answer,
                   const Style& style) {
  const Best<3>& best = answer.best;
  std::string text = title(file.name, style);
  if (!best.holdable()) return text + nowhere(grasp, answer);

  const Minimum<3>& lowest = best.best();
  const Minimum<3>* const pinched = best.best_pinched();
  const bool differ = pinched && !ties_with(*pinched, lowest);
  std::vector<std::pair<std::string, const Minimum<3>*>> shown{{"best", &lowest}};
  if (differ) shown.emplace_back("best pinched", pinched);

  Table summary({"<", "up", "", "<", "<"}), rotations({"<", "w", "x", "y", "z"});
  if (answer.now) add_posture(summary, "now", grasp, *answer.now, "");
  for (const auto& [which, posture] : shown) {
    const Turn turn = turn_to(answer.orientation, posture->up);
    add_posture<3>(
        summary, which, grasp, *posture,
        answer.now && ties_with(*answer.now, *posture) ? "stay: it is as good" : turn_text(turn));
    std::vector<std::string> row{which};
    for (const double part :
         {turn.rotation.w(), turn.rotation.x(), turn.rotation.y(), turn.rotation.z()})
      row.push_back(fixed(part, 6));
    rotations.add(std::move(row));
  }
  text += summary.text(style) + "\n" + wrapped(proof_text(best, answer.settings));
  if (answer.now && answer.turn)
    text += "\n" + taken_text(grasp, answer.orientation, *answer.now, lowest, *answer.turn, style);
  if (answer.now && answer.within_reach)
    text += "\n" + reach_text(grasp, answer.orientation, *answer.now, *answer.within_reach, style);
  if (differ) text += "\n" + wrapped(why_pinching_costs<3>(grasp, lowest, *pinched));
  if (!pinched)
    text += "\n" + wrapped(lowest.manner == Manner::pinched
                               ? "All pinched minima that were found are at the border of the "
                                 "postures that are allowed or can be held."
                               : "No pinched minimum was found inside the postures that are "
                                 "allowed and can be held.");

  text += heading("The turn as a quaternion, in the world frame with +z up", style) +
          rotations.text(style);
  for (const auto& [which, posture] : shown)
    text += heading("Forces at the " + which + load_text(grasp, posture->decides), style) +
            forces_table(grasp, posture->hold(), style);
  return text + loads_table<3>(grasp, lowest, style) +
         heading("Minima found, lowest first; there may be others", style) +
         optima_text(grasp, best.minima, style);
}

}  // namespace poise
