// What `poise capacity` says.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tables/parts.hpp"
#include "tables/report.hpp"
#include "tables/shake.hpp"

namespace poise {
namespace {

/// "a", "a and b", "a, b and c"
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

/// Some contacts, counted by finger, and what they do, in the singular or the plural.
template <int Dim>
std::string who_does(const Grasp<Dim>& grasp, const std::vector<bool>& chosen,
                     const std::string& does, const std::string& they_do) {
  std::vector<std::string> parts;
  bool single = true;
  for (std::size_t k = 0; k < grasp.fingers().size(); ++k) {
    int some = 0, all = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (grasp.finger_of(i) != k) continue;
      ++all;
      some += chosen[i] ? 1 : 0;
    }
    if (some == 0) continue;
    const std::string& finger = grasp.fingers()[k];
    single = parts.empty() && some == 1;
    parts.push_back(all == 1      ? finger
                    : some == all ? fmt::format("all {} contacts of {}", all, finger)
                                  : fmt::format("{} of the {} contacts of {}", some, all, finger));
  }
  return parts.empty() ? "" : listed(parts) + (single ? does : they_do);
}

std::string weight_text(double weight) {
  return fmt::format("{} ({} kg)", newtons(weight), plain(weight / standard_gravity));
}

const char* which_text(const std::string& which) {
  return which == "now"       ? ", as it is held now"
         : which == "best"    ? ", the best for the given weight"
         : which == "upright" ? ", since no posture is given and the given weight is held in none"
                              : "";
}

template <int Dim>
std::string greatest_text(const WeightRange<Dim>& range, double given) {
  if (!range.holdable)
    return range.proven ? "none: no weight can be held in this posture"
                        : "none found, nor a proof that there is none";
  if (std::isinf(range.greatest.weight)) return "any: nothing limits the fingers that hold it";
  const double bound = range.greatest.bound;
  const std::string more =
      range.proven ? ""
      : std::isinf(bound)
          ? "; that no more is held is not proven"
          : "; that no more is held is proven only of more than " + weight_text(bound);
  return fmt::format("{}, {} times the given", weight_text(range.greatest.weight),
                     plain(range.greatest.weight / given)) +
         more;
}

/// Which contacts decide the greatest weight.
template <int Dim>
std::string why_no_more(const Grasp<Dim>& grasp, const WeightRange<Dim>& range) {
  if (!range.holdable || range.deciding.empty() || !range.proven) return {};
  const auto& forces = range.greatest.posture.hold().forces;
  std::vector<bool> pressing, slipping;
  for (std::size_t i = 0; i < range.deciding.size(); ++i) {
    const Deciding& contact = range.deciding[i];
    pressing.push_back(contact.per_newton > 1e-6);
    slipping.push_back(contact.slipping && forces[i].state != ContactState::unloaded);
  }
  std::vector<std::string> limits;
  if (const std::string press =
          who_does(grasp, pressing, " presses as hard as its max_normal allows",
                   " press as hard as their max_normal allows");
      !press.empty())
    limits.push_back(press);
  std::vector<std::string> drives;
  for (std::size_t a = 0; a < range.deciding_drives.size(); ++a)
    if (range.deciding_drives[a] > 1e-6) drives.push_back(grasp.drives()[a].name);
  if (grasp.mechanism().kind == DriveKind::coupled && !drives.empty())
    limits.emplace_back("the drive of all fingers gives its max");
  else if (!drives.empty())
    limits.push_back(drives.size() == 1 ? "the drive of " + drives[0] + " gives its max"
                                        : "the drives of " + listed(drives) + " give their max");
  const std::string slip =
      who_does(grasp, slipping, " uses all its friction", " use all their friction");
  if (limits.empty()) return {};
  return "\n" + wrapped("At the greatest weight " + listed(limits) +
                        (slip.empty() ? "" : "; " + slip) + ".");
}

/// The least friction of each of the different frictions.
template <int Dim>
std::string friction_text(const Grasp<Dim>& grasp, const LeastFriction<Dim>& least, double safety) {
  if (std::isinf(least.factor))
    return least.proven ? "none is enough" : "none found that is enough, nor a proof that none is";
  if (least.factor == 0) return "none is needed";
  if (least.factor < 1e-4) return "ever less, the harder the fingers press: nothing limits them";
  std::set<double> frictions;
  for (const Contact<Dim>& contact : grasp.contacts())
    if (contact.friction > 0) frictions.insert(contact.friction);
  std::vector<std::string> parts;
  for (const double friction : frictions)
    parts.push_back(
        fmt::format("{} instead of {}", plain(least.factor * friction), plain(safety * friction)));
  const double left = safety / least.factor;
  const std::string factor = left >= 1 ? fmt::format(": a safety factor of {}", plain(left))
                                       : fmt::format(": {} times as much", plain(1 / left));
  return listed(parts) + factor +
         (least.proven ? ""
                       : fmt::format("; that less is too little is proven only below {} of that",
                                     plain(least.bound / least.factor)));
}

/// What `measure` finds greatest in.
template <class List, class Measure>
const auto& most(const List& list, const Measure& measure) {
  return **std::max_element(list.begin(), list.end(), [&](const auto* a, const auto* b) {
    return measure(*a) < measure(*b);
  });
}

/// The grip to command, and whether the gripper gives it.
template <int Dim>
std::string command_text(const Grasp<Dim>& grasp, const Hold<Dim>& hold) {
  const double most = most_grip<Dim>(grasp);
  const std::string text = grip_text(grasp, grip<Dim>(grasp, hold));
  if (!(hold.grip > most * (1 + 1e-7))) return text;
  const GripUnit unit = grip_unit(grasp);
  return text + " (more than the gripper gives" +
         (unit == GripUnit::part_of_max ? ")" : ": " + plain(most) + " " + to_string(unit) + ")");
}

template <int Dim>
std::string tilt_text(const Tilting<Dim>& found) {
  if (!found.holdable) return "nothing: the posture itself is not held";
  if (found.angle >= std::numbers::pi) return "any way up";
  return fmt::format("{}° in any direction{}", plain(found.angle * 180 / std::numbers::pi),
                     found.proven
                         ? ""
                         : fmt::format("; that it is no more is proven only of more than {}°",
                                       plain(found.bound * 180 / std::numbers::pi)));
}

/// One posture, against all loads: what decides is the load that leaves least.
template <int Dim>
std::string posture_report(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                           const std::vector<const CapacityAt<Dim>*>& loads,
                           const CapacityAnswer<Dim>& answer, const Style& style) {
  const auto given = [&](const CapacityAt<Dim>& at) { return grasp.loads()[at.load].weight; };
  const auto part = [&](const CapacityAt<Dim>& at, double weight) {
    return given(at) > 0 ? weight / given(at) : weight;
  };
  const auto force = [&](const CapacityAt<Dim>& at) {
    const Posture<Dim>& safe = at.capacity.safe;
    return safe.holdable() ? grip_of<Dim>(grasp, safe).value_or(0) : HUGE_VAL;
  };
  const CapacityAt<Dim>& heaviest = most(loads, [&](const CapacityAt<Dim>& at) {
    const WeightRange<Dim>& range = at.capacity.weights;
    return range.holdable ? -part(at, range.greatest.weight) : 1;
  });
  const CapacityAt<Dim>& slippery =
      most(loads, [](const CapacityAt<Dim>& at) { return at.capacity.friction.factor; });
  const CapacityAt<Dim>& hardest = most(loads, force);

  const CapacityAt<Dim>& first = *loads.front();
  Table table({"<", "<"});
  const WeightRange<Dim>& range = heaviest.capacity.weights;
  table.add(
      {"greatest weight", greatest_text(range, given(heaviest)) + load_text(grasp, heaviest.load)});
  if (range.holdable && range.least.weight > 0)
    table.add({"least weight", weight_text(range.least.weight) + load_text(grasp, heaviest.load)});
  table.add({"least friction", friction_text(grasp, slippery.capacity.friction, file.safety) +
                                   load_text(grasp, slippery.load)});
  const std::string on_friction = fmt::format(
      "with a safety factor of {} on the friction{}", plain(answer.safety),
      file.safety == 1 ? "" : fmt::format(", on top of the file's {}", plain(file.safety)));
  const bool grips = has_grip(grasp);
  const std::string command = std::isinf(force(hardest)) ? "none: it cannot be held "
                              : grips ? command_text(grasp, hardest.capacity.safe.hold()) + ", "
                                      : newtons(force(hardest)) + ", ";
  table.add({grips ? "grip to command" : "force to command",
             command + on_friction + load_text(grasp, hardest.load)});
  const CapacityAt<Dim>& shaky =
      most(loads, [](const CapacityAt<Dim>& at) { return -at.shake.acceleration; });
  const CapacityAt<Dim>& tilty =
      most(loads, [](const CapacityAt<Dim>& at) { return -at.tilting.angle; });
  const std::string within =
      answer.grip ? ", with a grip of " + grip_text(grasp, *answer.grip) : "";
  table.add({"shake", shake_text(shaky.shake) + load_text(grasp, shaky.load) + within});
  table.add({"tilt", tilt_text(tilty.tilting) + load_text(grasp, tilty.load) + within});
  return heading(place_text(first.up) + which_text(first.posture), style) + table.text(style) +
         why_no_more(grasp, range);
}

}  // namespace

template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                   const CapacityAnswer<Dim>& answer, const Style& style) {
  std::vector<std::string> weights;
  for (const Load<Dim>& load : grasp.loads())
    if (const std::string text = weight_text(load.weight);
        std::find(weights.begin(), weights.end(), text) == weights.end())
      weights.push_back(text);
  std::string text = title(file.name, style) + "The given weight is " + listed(weights) + ".\n";
  const std::size_t count = grasp.loads().size();
  for (std::size_t begin = 0; begin < answer.capacities.size(); begin += count) {
    std::vector<const CapacityAt<Dim>*> loads;
    for (std::size_t k = 0; k < count; ++k) loads.push_back(&answer.capacities[begin + k]);
    text += posture_report<Dim>(file, grasp, loads, answer, style);
  }
  return text;
}

template std::string report(const PlanarFile&, const Grasp<2>&, const CapacityAnswer<2>&,
                            const Style&);
template std::string report(const SpatialFile&, const Grasp<3>&, const CapacityAnswer<3>&,
                            const Style&);

}  // namespace poise
