// What `poise turn` says, and `poise best` of turns.
#include "tables/turn.hpp"

#include <fmt/core.h>

#include <cmath>

#include "tables/parts.hpp"
#include "tables/report.hpp"

namespace poise {
namespace {

/// Ways are told where they need less than the straight turn by more than this part.
constexpr double worth_a_way = 0.01;
/// A peak above what both ends need by no more than this part is none.
constexpr double no_peak = 1e-3;

/// "a grip of 2.125 N", "a force norm of 8.97 N": of V [N^2] or F.
template <int Dim>
std::string value_text(const Grasp<Dim>& grasp, Objective objective, double value) {
  return objective == Objective::grip ? "a grip of " + grip_text(grasp, value)
                                      : "a force norm of " + newtons(std::sqrt(value));
}

template <int Dim>
Objective objective_of(const Posture<Dim>& posture) {
  return posture.hold().objective;
}

/// What is needed on a turn; `whole` names it.
template <int Dim>
std::string peak_text(const Grasp<Dim>& grasp, const std::string& whole, const TurnPeak<Dim>& peak,
                      const Posture<Dim>& now, const Posture<Dim>& then) {
  if (!peak.unholdable.empty()) {
    std::string text;
    for (const UnholdableStretch<Dim>& stretch : peak.unholdable) {
      const bool is_single = std::abs(stretch.to - stretch.from) < 1e-4;
      text +=
          fmt::format("{} it cannot be held {} of the turn: {}. ", text.empty() ? whole : "And",
                      is_single ? fmt::format("after {}", degrees_text(std::abs(stretch.at)))
                                : fmt::format("from {} to {}", degrees_text(std::abs(stretch.from)),
                                              degrees_text(std::abs(stretch.to))),
                      reason_text(grasp, stretch.posture));
    }
    text.pop_back();
    return text;
  }
  const Objective objective = objective_of(peak.posture);
  const double ends = std::max(now.value(), then.value());
  if (peak.peak <= (1 + no_peak) * ends)
    return fmt::format("{} it needs no more than at its {}: {}.", whole,
                       now.value() >= then.value() ? "start" : "end",
                       value_text(grasp, objective, ends));
  return fmt::format("{} it needs up to {}, after {} of {}.", whole,
                     value_text(grasp, objective, peak.peak), degrees_text(std::abs(peak.at)),
                     degrees_text(std::abs(peak.angle)));
}

/// The steps of a way as a table.
std::string steps_table(const Eigen::Quaterniond& start, const std::vector<Vector<3>>& ups,
                        const Style& style) {
  Table table({"step", "<", "<up", "w", "x", "y", "z"});
  Eigen::Quaterniond orientation = start;
  for (std::size_t k = 1; k < ups.size(); ++k) {
    const Turn turn = turn_to(orientation, ups[k]);
    orientation = turn.orientation;
    std::vector<std::string> row{std::to_string(k), turn_text(turn), posture_text(ups[k])};
    for (const double part : {orientation.w(), orientation.x(), orientation.y(), orientation.z()})
      row.push_back(fixed(part, 6));
    table.add(std::move(row));
  }
  return heading("The way, with the orientation after each step (object to world)", style) +
         table.text(style);
}

}  // namespace

std::string turn_text(double angle) {
  const std::string size = degrees_text(std::abs(angle));
  if (size == degrees_text(0)) return "stay";
  return "turn by " + size + (angle < 0 ? " clockwise" : " counter-clockwise");
}

std::string turn_text(const Turn& turn) {
  const std::string angle = degrees_text(turn.angle);
  if (angle == degrees_text(0)) return "stay";
  return "turn by " + angle + " about " + posture_text(turn.axis);
}

std::string taken_text(const Grasp<2>& grasp, const Posture<2>& now, const Posture<2>& then,
                       const TurnTaken<2>& taken, const Style& /*style*/) {
  if (degrees_text(std::abs(taken.straight.angle)) == degrees_text(0)) return {};
  std::string text = peak_text<2>(grasp, "On this turn", taken.straight, now, then);
  if (taken.other && taken.other->peak < (1 - worth_a_way) * taken.straight.peak)
    text +=
        " " + peak_text<2>(grasp,
                           fmt::format("The other way round, by {} {},",
                                       degrees_text(std::abs(taken.other->angle)),
                                       taken.other->angle < 0 ? "clockwise" : "counter-clockwise"),
                           *taken.other, now, then);
  return wrapped(text);
}

std::string taken_text(const Grasp<3>& grasp, const Eigen::Quaterniond& start,
                       const Posture<3>& now, const Posture<3>& then, const TurnTaken<3>& taken,
                       const Style& style) {
  if (degrees_text(taken.turn.angle) == degrees_text(0)) return {};
  std::string text = peak_text<3>(grasp, "On this turn", taken.straight, now, then);
  const std::optional<Way>& way = taken.way;
  if (!way) return wrapped(text);
  const Objective objective = objective_of(now);
  if (way->status == Status::unholdable)
    return wrapped(text +
                   " No way leads there: a closed curve of postures that cannot be held lies "
                   "between.");
  const bool is_better = way->peak < (1 - worth_a_way) * taken.straight.peak;
  if (is_better)
    text += fmt::format(" A way of {} steps needs only {}", way->ups.size() - 1,
                        value_text(grasp, objective, way->peak));
  if (way->status == Status::optimal && is_better)
    text +=
        fmt::format("; no way needs less than {}.", value_text(grasp, objective, way->lower_bound));
  else if (way->status == Status::gap)
    text += fmt::format("{} That no way needs less is not proven: one may need only {}.",
                        is_better ? "." : "", value_text(grasp, objective, way->lower_bound));
  return wrapped(text) + (is_better ? steps_table(start, way->ups, style) : "");
}

std::string reach_text(const Grasp<2>& grasp, const Posture<2>& now, const Reachable<2>& reach) {
  if (degrees_text(std::abs(reach.angle)) == degrees_text(0))
    return wrapped("Without pressing harder than now no better posture can be reached.");
  return wrapped(fmt::format("Without pressing harder than now ({}): {}, to {}.",
                             least_text(grasp, now), turn_text(reach.angle),
                             least_text(grasp, reach.posture)));
}

std::string reach_text(const Grasp<3>& grasp, const Eigen::Quaterniond& start,
                       const Posture<3>& now, const Reachable<3>& reach, const Style& style) {
  const Turn turn = turn_to(start, reach.posture.up);
  if (degrees_text(turn.angle) == degrees_text(0))
    return wrapped("Without pressing harder than now no better posture can be reached.");
  const bool is_straight = reach.way.ups.size() <= 2;
  const std::string how =
      is_straight ? turn_text(turn) : fmt::format("in {} steps", reach.way.ups.size() - 1);
  return wrapped(fmt::format("Without pressing harder than now ({}): {}, to {}.",
                             least_text(grasp, now), how, least_text(grasp, reach.posture))) +
         (is_straight ? "" : steps_table(start, reach.way.ups, style));
}

std::string report(const PlanarFile& file, const Grasp<2>& grasp, const TurnAnswer<2>& answer,
                   const Style& style) {
  Table summary({"<", "", "", "<", "<"});
  add_posture<2>(summary, "now", grasp, answer.now, "");
  add_posture<2>(summary, "then", grasp, answer.then, turn_text(answer.taken.straight.angle));
  return title(file.name, style) + summary.text(style) + "\n" +
         taken_text(grasp, answer.now, answer.then, answer.taken, style);
}

std::string report(const SpatialFile& file, const Grasp<3>& grasp, const TurnAnswer<3>& answer,
                   const Style& style) {
  Table summary({"<", "up", "", "<", "<"});
  add_posture<3>(summary, "now", grasp, answer.now, "");
  add_posture<3>(summary, "then", grasp, answer.then, turn_text(answer.taken.turn));
  return title(file.name, style) + summary.text(style) + "\n" +
         taken_text(grasp, answer.orientation, answer.now, answer.then, answer.taken, style);
}

}  // namespace poise
