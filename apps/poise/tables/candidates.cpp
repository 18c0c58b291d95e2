#include "tables/candidates.hpp"

#include <fmt/core.h>

#include <cmath>

#include "tables/parts.hpp"

namespace poise {

template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp, const Question& question,
                   const Candidates<Dim>& candidates,
                   const std::vector<RankedCandidate<Dim>>& ranked, const Style& style) {
  constexpr std::size_t most_rows = 20, most_columns = 4;
  const bool by_grip = question.objective.value_or(file.objective) == Objective::grip;
  const auto value = [&](double value) {
    return by_grip ? grip_text(grasp, value) : newtons(std::sqrt(value));
  };
  std::vector<std::string> headings{"rank",
                                    "row",
                                    Dim == 3 ? "<up" : "posture",
                                    by_grip ? "grip" : "force norm",
                                    "turn",
                                    "peak of the turn",
                                    "after"};
  const std::size_t columns = std::min(most_columns, candidates.others.size());
  for (std::size_t k = 0; k < columns; ++k) headings.push_back("<" + candidates.others[k]);
  Table table(headings);
  for (std::size_t k = 0; k < std::min(most_rows, ranked.size()); ++k) {
    const RankedCandidate<Dim>& each = ranked[k];
    const double own = by_grip ? each.grip.value_or(0) : each.effort;
    const bool is_held = std::isfinite(each.peak);
    std::vector<std::string> row{std::to_string(k + 1),
                                 std::to_string(each.candidate->row),
                                 posture_text(each.candidate->up),
                                 each.holdable ? value(own) : "cannot be held",
                                 degrees_text(each.turn),
                                 is_held ? value(each.peak) : "cannot be held",
                                 is_held ? degrees_text(std::abs(each.peak_at)) : ""};
    for (std::size_t c = 0; c < columns; ++c) row.push_back(each.candidate->others[c]);
    table.add(std::move(row));
  }
  std::string text = title(file.name, style) + table.text(style);
  if (ranked.size() > most_rows)
    text += fmt::format("\n{} more; --json prints all of them.\n", ranked.size() - most_rows);
  return text;
}

template std::string report(const PlanarFile&, const Grasp<2>&, const Question&,
                            const Candidates<2>&, const std::vector<RankedCandidate<2>>&,
                            const Style&);
template std::string report(const SpatialFile&, const Grasp<3>&, const Question&,
                            const Candidates<3>&, const std::vector<RankedCandidate<3>>&,
                            const Style&);

}  // namespace poise
