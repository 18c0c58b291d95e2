#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "report.hpp"
#include "report_parts.hpp"

namespace poise {
namespace {

/// "a", "a and b", "a, b and c"
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

/// Some contacts, counted by finger, and what they do: `one` does, `more` do.
template <int Dim>
std::string who_does(const Grasp<Dim>& grasp, const std::vector<bool>& those,
                     const std::string& one, const std::string& more) {
  std::vector<std::string> parts;
  bool single = true;
  for (std::size_t k = 0; k < grasp.fingers().size(); ++k) {
    int some = 0, all = 0;
    for (std::size_t i = 0; i < those.size(); ++i) {
      if (grasp.finger_of(i) != k) continue;
      ++all;
      some += those[i] ? 1 : 0;
    }
    if (some == 0) continue;
    const std::string& finger = grasp.fingers()[k];
    single = parts.empty() && some == 1;
    parts.push_back(all == 1      ? finger
                    : some == all ? fmt::format("all {} contacts of {}", all, finger)
                                  : fmt::format("{} of the {} contacts of {}", some, all, finger));
  }
  return parts.empty() ? "" : listed(parts) + (single ? one : more);
}

std::string weight_text(double weight) {
  return fmt::format("{} ({} kg)", newtons(weight), plain(weight / standard_gravity));
}

std::string posture_text(const CapacityAt<2>& answer) {
  return "At " + degrees_text(angle_of(answer.up));
}
std::string posture_text(const CapacityAt<3>& answer) {
  return "With " + vector_text(answer.up, 3) + " up";
}

const char* which_text(const std::string& which) {
  return which == "now"       ? ", as it is held now"
         : which == "best"    ? ", the best for the given weight"
         : which == "upright" ? ", since no posture is given and the given weight is held in none"
                              : "";
}

template <int Dim>
std::string greatest_text(const WeightRange<Dim>& range, double given) {
  if (!range.holdable) return "none: no weight can be held in this posture";
  if (std::isinf(range.greatest.weight))
    return "any: no max_normal limits the fingers that hold it";
  return fmt::format("{}, {} times the given", weight_text(range.greatest.weight),
                     plain(range.greatest.weight / given));
}

/// Which contacts decide the greatest weight.
template <int Dim>
std::string why_no_more(const Grasp<Dim>& grasp, const CapacityAt<Dim>& answer,
                        const HoldSettings& settings) {
  const WeightRange<Dim>& range = answer.capacity.weights;
  if (!range.holdable || std::isinf(range.greatest.weight)) return {};
  const std::vector<Deciding> decide = deciding(grasp, answer.up, range.greatest.dual, settings);
  std::vector<bool> pressing, slipping;
  for (std::size_t i = 0; i < decide.size(); ++i) {
    pressing.push_back(decide[i].per_newton > 1e-6);
    slipping.push_back(decide[i].slipping &&
                       range.greatest.hold.forces[i].state != ContactState::unloaded);
  }
  const std::string press = who_does(grasp, pressing, " presses as hard as its max_normal allows",
                                     " press as hard as their max_normal allows");
  const std::string slip =
      who_does(grasp, slipping, " uses all its friction", " use all their friction");
  return press.empty()
             ? ""
             : "At the greatest weight " + press + (slip.empty() ? "" : "; " + slip) + ".";
}

/// The least friction of each of the different frictions.
template <int Dim>
std::string friction_text(const Grasp<Dim>& grasp, const LeastFriction<Dim>& least, double safety) {
  if (std::isinf(least.factor)) return "none is enough";
  if (least.factor == 0) return "none is needed";
  if (least.factor < 1e-4)
    return "ever less, the harder the fingers press: no max_normal limits them";
  std::set<double> frictions;
  for (const Contact<Dim>& contact : grasp.contacts())
    if (contact.friction > 0) frictions.insert(contact.friction);
  std::vector<std::string> parts;
  for (const double friction : frictions)
    parts.push_back(
        fmt::format("{} instead of {}", plain(least.factor * friction), plain(safety * friction)));
  const double left = safety / least.factor;
  return listed(parts) + (left >= 1 ? fmt::format(": a safety factor of {}", plain(left))
                                    : fmt::format(": {} times as much", plain(1 / left)));
}

/// The hold that asks most of the scenarios, by some measure.
template <class Answers, class Measure>
const auto& most(const Answers& answers, const Measure& measure) {
  return **std::max_element(answers.begin(), answers.end(), [&](const auto* a, const auto* b) {
    return measure(*a) < measure(*b);
  });
}

template <int Dim>
std::string posture_report(const CommonFile<Dim>& file, const std::vector<Grasp<Dim>>& grasps,
                           const std::vector<const CapacityAt<Dim>*>& scenarios,
                           const CapacityOptions& options, const Style& style) {
  const HoldSettings settings{.force_cap = options.force_cap};
  const auto of = [&](const CapacityAt<Dim>& answer) -> const Grasp<Dim>& {
    return grasps[answer.scenario];
  };
  const auto in = [&](const CapacityAt<Dim>& answer) {
    return grasps.size() == 1 ? "" : fmt::format(", in scenario {}", answer.scenario);
  };
  // What decides is the scenario that leaves least.
  const CapacityAt<Dim>& heaviest = most(scenarios, [&](const CapacityAt<Dim>& answer) {
    const WeightRange<Dim>& range = answer.capacity.weights;
    return range.holdable ? -range.greatest.weight / of(answer).object().weight : 1;
  });
  const CapacityAt<Dim>& slippery = most(
      scenarios, [](const CapacityAt<Dim>& answer) { return answer.capacity.friction.factor; });
  const auto grip = [&](const CapacityAt<Dim>& answer) {
    return answer.capacity.safe.holdable ? grip_force(of(answer), answer.capacity.safe) : HUGE_VAL;
  };
  const CapacityAt<Dim>& hardest = most(scenarios, grip);

  const CapacityAt<Dim>& first = *scenarios.front();
  std::string text = heading(posture_text(first) + which_text(first.posture), style);
  Table table({"<", "<"});
  const WeightRange<Dim>& range = heaviest.capacity.weights;
  table.add({"greatest weight", greatest_text(range, of(heaviest).object().weight) + in(heaviest)});
  if (range.holdable && range.least.weight > 0)
    table.add({"least weight", weight_text(range.least.weight) + in(heaviest)});
  table.add({"least friction",
             friction_text(of(slippery), slippery.capacity.friction, file.safety) + in(slippery)});
  const std::string safety = fmt::format(
      "with a safety factor of {} on the friction{}", plain(options.safety),
      file.safety == 1 ? "" : fmt::format(", on top of the file's {}", plain(file.safety)));
  const double force = grip(hardest);
  table.add({"force to command",
             (std::isinf(force) ? "none: it cannot be held " : newtons(force) + ", ") + safety +
                 in(hardest)});
  text += table.text(style);
  const std::string why = why_no_more(of(heaviest), heaviest, settings);
  return text + (why.empty() ? "" : "\n" + wrapped(why));
}

}  // namespace

template <int Dim>
std::string capacity_report(const CommonFile<Dim>& file, const std::vector<Grasp<Dim>>& grasps,
                            const std::vector<CapacityAt<Dim>>& answers,
                            const CapacityOptions& options, const Style& style) {
  std::string text = title(file.name, style);
  std::vector<std::string> weights;
  for (const Grasp<Dim>& grasp : grasps) weights.push_back(weight_text(grasp.object().weight));
  text += "The given weight is " + listed(weights) + ".\n";
  for (std::size_t first = 0; first < answers.size(); first += grasps.size()) {
    std::vector<const CapacityAt<Dim>*> scenarios;
    for (std::size_t k = 0; k < grasps.size(); ++k) scenarios.push_back(&answers[first + k]);
    text += posture_report(file, grasps, scenarios, options, style);
  }
  return text;
}

template std::string capacity_report<2>(const CommonFile<2>&, const std::vector<Grasp<2>>&,
                                        const std::vector<CapacityAt<2>>&, const CapacityOptions&,
                                        const Style&);
template std::string capacity_report<3>(const CommonFile<3>&, const std::vector<Grasp<3>>&,
                                        const std::vector<CapacityAt<3>>&, const CapacityOptions&,
                                        const Style&);

}  // namespace poise
