#include "tables/parts.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "files/degrees.hpp"

namespace poise {
namespace {

/// The finger that presses hardest, as "finger left".
template <int Dim>
std::string strongest(const Grasp<Dim>& grasp, const Hold<Dim>& hold) {
  const auto fingers = finger_forces(grasp, hold);
  const auto most =
      std::max_element(fingers.begin(), fingers.end(),
                       [](const auto& a, const auto& b) { return a.normal < b.normal; });
  if (most == fingers.end()) return "one finger";
  return "finger " + grasp.fingers()[static_cast<std::size_t>(most - fingers.begin())];
}

/// More than the others' where all of a column would be shown as 0 without being rounding.
int decimals_of_column(int others, double largest, double whole) {
  return largest < std::pow(10, -others) && largest > 1e-9 * whole ? decimals_for(largest) : others;
}

std::string lowercase(std::string text) {
  text[0] = static_cast<char>(std::tolower(text[0]));
  return text;
}

}  // namespace

std::string title(const std::string& name, const Style& style) {
  return name.empty() ? "" : style.bold(name) + "\n\n";
}

std::string heading(const std::string& text, const Style& style) {
  return "\n" + style.bold(text) + "\n";
}

std::string posture_text(const Vector<2>& up) { return degrees_text(angle_of(up)); }
std::string posture_text(const Vector<3>& up) { return vector_text(up, 3); }
std::string place_text(const Vector<2>& up) { return "At " + posture_text(up); }
std::string place_text(const Vector<3>& up) { return "With " + posture_text(up) + " up"; }

std::string range_text(const Interval& interval) {
  constexpr double pi = std::numbers::pi;
  if (interval.from == interval.to) return "only at " + degrees_text(interval.from);
  if (interval.to - interval.from >= 2 * pi) return "in every posture";
  const std::string from = "from " + degrees_text(interval.from);
  if (interval.to <= pi) return from + " to " + degrees_text(interval.to);
  return from + " through 180° to " + degrees_text(interval.to - 2 * pi);
}

std::string tilt_text(const Tilt& tilt) {
  return "at most " + degrees_text(tilt.most) + " from " + posture_text(tilt.from);
}

template <int Dim>
std::string reason_text(const Grasp<Dim>& grasp, const Posture<Dim>& posture) {
  const std::string why = reason(grasp, posture.hold());
  return grasp.loads().size() == 1 ? why : fmt::format("against {} {}", load_name(grasp, posture.decides), why);
}

template <int Dim>
std::string why_nowhere(const Grasp<Dim>& grasp, const std::optional<Posture<Dim>>& example,
                        const std::optional<Posture<Dim>>& without_max) {
  if (without_max) {
    std::vector<std::string> asked;
    const Hold<Dim>& hold = without_max->hold();
    for (std::size_t i = 0; i < hold.forces.size(); ++i) {
      const Contact<Dim>& contact = grasp.contacts()[i];
      const double normal = hold.forces[i].normal;
      if (normal > contact.max_normal)
        asked.push_back(
            fmt::format("contact {} (finger {}) would have to press with {}, more than "
                        "its max_normal of {}",
                        i, contact.finger, newtons(normal), newtons(contact.max_normal)));
    }
    if (has_grip(grasp)) {
      const double needed = *grip_of(grasp, *without_max), most = most_grip(grasp);
      if (needed > most)
        asked.push_back(fmt::format("the drives would have to give {}, more than their max of {}",
                                    grip_text(grasp, needed), grip_text(grasp, most)));
    }
    if (!asked.empty())
      return wrapped(fmt::format("Only {} forbids it. The best posture without it: {}, where {}.",
                                 asked.back().starts_with("the drives") ? "a max" : "max_normal",
                                 lowercase(place_text(without_max->up)), fmt::join(asked, "; ")));
  }
  if (!example || example->holdable()) return {};
  return wrapped("For example " + lowercase(place_text(example->up)) + ": " +
                 reason_text(grasp, *example) + ".");
}

template <int Dim>
void add_posture(Table& table, const std::string& which, const Grasp<Dim>& grasp,
                 const Posture<Dim>& posture, const std::string& how) {
  const bool holdable = posture.holdable();
  table.add({which, posture_text(posture.up),
             !holdable ? "cannot be held" : least_text(grasp, posture),
             holdable ? to_string(posture.manner) : "", how});
}

template <int Dim>
std::string forces_table(const Grasp<Dim>& grasp, const Hold<Dim>& hold, const Style& style) {
  const auto fingers = finger_forces(grasp, hold);
  const std::vector<Contact<Dim>>& contacts = grasp.contacts();
  const auto is_pad = [](const Contact<Dim>& contact) {
    if constexpr (Dim == 3) return contact.pad.has_value();
    return false;
  };
  const auto twists = [&](const Contact<Dim>& contact) {
    return contact.torsion > 0 || is_pad(contact);
  };
  const bool any_pad = std::any_of(contacts.begin(), contacts.end(), is_pad);
  const bool any_soft = std::any_of(contacts.begin(), contacts.end(), twists);
  const Lengths lengths(grasp.radius());
  double grip = 0, tangential = 0, moment = 0;
  for (const FingerForce<Dim>& finger : fingers) grip = std::max(grip, finger.normal);
  for (const ContactForce<Dim>& force : hold.forces) {
    if constexpr (Dim == 2) {
      tangential = std::max(tangential, std::abs(force.tangential));
    } else {
      tangential = std::max(tangential, force.tangential.norm());
      moment = std::max(moment, lengths.per_metre * std::abs(force.torsion_moment));
    }
  }
  const int decimals = decimals_for(grip);
  const int across = decimals_of_column(decimals, tangential, grip);
  const int about = decimals_of_column(std::max(0, decimals + (lengths.per_metre > 1 ? -2 : 0)),
                                       moment, lengths.per_metre * grasp.radius() * grip);
  std::vector<std::string> headings{"<finger", "contact", "normal [N]", "tangential [N]"};
  if (any_soft) headings.push_back(fmt::format("torsion [N {}]", lengths.unit));
  for (const char* rest : {"friction used", "<state", "<limit"}) headings.emplace_back(rest);
  if (any_pad) headings.push_back(fmt::format("<centre of pressure [{}]", lengths.unit));
  Table table(headings);
  for (std::size_t k = 0; k < fingers.size(); ++k) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < hold.forces.size(); ++i) {
      if (grasp.finger_of(i) != k) continue;
      const ContactForce<Dim>& force = hold.forces[i];
      const bool loaded = force.state != ContactState::unloaded;
      std::vector<std::string> row{count++ == 0 ? grasp.fingers()[k] : "", std::to_string(i),
                                   fixed(force.normal, decimals)};
      if constexpr (Dim == 2) {
        row.push_back(fixed(force.tangential, across));
      } else {
        row.push_back(fixed(force.tangential.norm(), across));
        if (any_soft)
          row.push_back(twists(contacts[i]) ? fixed(lengths.per_metre * force.torsion_moment, about)
                                            : "");
      }
      row.push_back(loaded ? fixed(100 * force.friction_used, 1) + " %" : "");
      row.emplace_back(to_string(force.state));
      row.emplace_back(force.limit == ForceLimit::none  ? ""
                       : force.limit == ForceLimit::min ? "at min_normal"
                                                        : "at max_normal");
      if constexpr (Dim == 3)
        if (any_pad)
          row.push_back(
              is_pad(contacts[i]) && loaded
                  ? lengths.text(Vector<3>(contacts[i].position + force.center_of_pressure))
                  : "");
      table.add(std::move(row));
    }
    if (count > 1) table.add({"", "together", fixed(fingers[k].normal, decimals)});
  }
  return table.text(style);
}

template <int Dim>
std::string grip_text(const Grasp<Dim>& grasp, double grip) {
  switch (grip_unit(grasp)) {
    case GripUnit::newton:
      return newtons(grip);
    case GripUnit::newton_metre:
      return newtons(grip) + " m";
    case GripUnit::part_of_max:
      break;
  }
  return fixed(100 * grip, 1) + " % of max";
}

template <int Dim>
std::string least_text(const Grasp<Dim>& grasp, const Posture<Dim>& posture) {
  const std::optional<double> grip = grip_of(grasp, posture);
  return grip ? "grip " + grip_text(grasp, *grip)
              : "force norm " + newtons(std::sqrt(posture.effort()));
}

template <int Dim>
std::string drives_table(const Grasp<Dim>& grasp, const Hold<Dim>& hold, const Style& style) {
  if (grasp.mechanism() == Mechanism<Dim>{} || !has_grip(grasp)) return {};
  const std::vector<Drive<Dim>> drives = grasp.drives();
  const std::vector<DriveEffort> efforts = drive_efforts(grasp, hold);
  double most = 0;
  for (const DriveEffort& each : efforts) most = std::max(most, std::abs(each.effort));
  Table table({"<drive", "effort", "<", "max", "used", "<"});
  for (std::size_t a = 0; a < drives.size(); ++a) {
    const bool limited = std::isfinite(drives[a].max);
    table.add({drives[a].name, fixed(efforts[a].effort, decimals_for(most)),
               drives[a].turns ? "N m" : "N", limited ? plain(drives[a].max) : "",
               limited ? fixed(100 * efforts[a].part_of_max, 1) + " %" : "",
               efforts[a].part_of_max >= 1 - 1e-6 ? "at max" : ""});
  }
  return heading("Drives", style) + table.text(style);
}

namespace {

/// "(0, 0, -40)"
template <int Dim>
std::string plain_text(const Eigen::Matrix<double, Dim, 1>& vector) {
  std::vector<std::string> parts;
  for (const double part : vector) parts.push_back(plain(part));
  return fmt::format("({})", fmt::join(parts, ", "));
}

/// Those that need most, as many as a table shows, in their order.
template <int Dim>
std::vector<std::size_t> loads_to_show(const Posture<Dim>& posture) {
  constexpr std::size_t most = 12;
  const auto value = [&](std::size_t k) {
    const Hold<Dim>& hold = posture.holds[k];
    return hold.holdable ? hold.value() : std::numeric_limits<double>::infinity();
  };
  std::vector<std::size_t> loads(posture.holds.size());
  std::iota(loads.begin(), loads.end(), std::size_t{0});
  if (loads.size() <= most) return loads;
  std::stable_sort(loads.begin(), loads.end(),
                   [&](std::size_t a, std::size_t b) { return value(a) > value(b); });
  loads.resize(most);
  std::sort(loads.begin(), loads.end());
  return loads;
}

}  // namespace

template <int Dim>
std::string acting_text(const Load<Dim>& load) {
  std::vector<std::string> parts;
  if (load.lift != 0) parts.push_back(fmt::format("lift {} m/s²", plain(load.lift)));
  if (!load.acceleration.isZero(0))
    parts.push_back(fmt::format("acceleration {} m/s²", plain_text(load.acceleration)));
  // Of the file it is what acts on the object; its moment is about the origin.
  const Vector<Dim> force = -load.fixed.template head<Dim>();
  if (!force.isZero(0)) parts.push_back(fmt::format("force {} N", plain_text(force)));
  if constexpr (Dim == 2) {
    if (load.fixed[2] != 0) parts.push_back(fmt::format("moment {} N m", plain(-load.fixed[2])));
  } else {
    const Vector<3> moment = -load.fixed.template tail<3>();
    if (!moment.isZero(0)) parts.push_back(fmt::format("moment {} N m", plain_text(moment)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

template <int Dim>
std::string loads_table(const Grasp<Dim>& grasp, const Posture<Dim>& posture, const Style& style) {
  if (grasp.loads().size() == 1) return {};
  double effort = 0;
  for (const Hold<Dim>& hold : posture.holds) effort = std::max(effort, hold.effort);
  const std::optional<double> grip = grip_of(grasp, posture);
  const Lengths lengths(grasp.radius());
  const auto& loads = grasp.loads();
  const bool acts = std::any_of(loads.begin(), loads.end(),
                                [](const Load<Dim>& load) { return !acting_text(load).empty(); });
  std::vector<std::string> headings{"load", "weight [N]",
                                    fmt::format("centre of mass [{}]", lengths.unit)};
  if (acts) headings.emplace_back("<and");
  if (grip) headings.emplace_back("grip");
  headings.insert(headings.end(), {"force norm [N]", "effort [N²]", "<"});
  Table table(headings);
  const std::vector<std::size_t> shown = loads_to_show(posture);
  for (const std::size_t k : shown) {
    const Load<Dim>& load = loads[k];
    const Hold<Dim>& hold = posture.holds[k];
    std::vector<std::string> row{load.name.empty() ? std::to_string(k) : load.name,
                                 plain(load.weight), lengths.text(load.com)};
    if (acts) row.push_back(acting_text(load));
    if (grip) row.push_back(hold.holdable ? grip_text(grasp, poise::grip(grasp, hold)) : "");
    if (hold.holdable)
      row.insert(row.end(),
                 {fixed(std::sqrt(hold.effort), decimals_for(std::sqrt(effort))),
                  fixed(hold.effort, decimals_for(effort)), k == posture.decides ? "decides" : ""});
    else
      row.insert(row.end(), {"", "", "cannot be held"});
    table.add(std::move(row));
  }
  std::string text = heading("Loads", style) + table.text(style);
  if (const std::size_t rest = loads.size() - shown.size(); rest > 0)
    text += fmt::format("And {} loads that need no more.\n", rest);
  return text;
}

template <int Dim>
std::string optima_table(const Grasp<Dim>& grasp, const std::vector<OptimumRow>& rows,
                         const std::vector<std::string>& words, const Style& style) {
  // Four digits of the least number in a column.
  double effort = 0;
  for (const OptimumRow& row : rows)
    effort = effort == 0 ? row.effort : std::min(effort, row.effort);
  const bool any_grip = !rows.empty() && rows.front().grip;
  std::vector<std::string> headings{"posture"};
  if (any_grip) headings.emplace_back("grip");
  headings.insert(headings.end(), {"force norm [N]", "effort [N²]"});
  for (const std::string& word : words) headings.push_back("<" + word);
  Table table(headings);
  for (const OptimumRow& row : rows) {
    std::vector<std::string> cells{row.posture};
    if (any_grip) cells.push_back(grip_text(grasp, row.grip.value_or(0)));
    cells.push_back(fixed(std::sqrt(row.effort), decimals_for(std::sqrt(effort))));
    cells.push_back(fixed(row.effort, decimals_for(effort)));
    cells.insert(cells.end(), row.words.begin(), row.words.end());
    table.add(std::move(cells));
  }
  return table.text(style);
}

template <int Dim>
std::string why_pinching_costs(const Grasp<Dim>& grasp, const Posture<Dim>& best,
                               const Posture<Dim>& pinched) {
  if (best.hold().objective == Objective::grip)
    return fmt::format("Pinched it costs {} times the grip.",
                       plain(pinched.value() / best.value()));
  const double factor = pinched.effort() / best.effort();
  const std::string cost = fmt::format(
      "Pinched it costs {} times the force norm ({} times the effort): ", plain(std::sqrt(factor)),
      plain(factor));
  const std::string squeeze =
      ", whereas pinched the fingers have to squeeze, so that friction carries the weight.";
  if (best.manner == Manner::resting)
    return cost + "at the best posture it rests on " + strongest(grasp, best.hold()) + squeeze;
  if (best.manner == Manner::cradled)
    return cost + "at the best posture it would lie in the fingers without any friction" + squeeze;
  return cost + (Dim == 2 ? "the best posture is at an end of those in which it can be held."
                          : "the best posture is at the border of those in which it can be held.");
}

template std::string reason_text(const Grasp<2>&, const Posture<2>&);
template std::string why_nowhere(const Grasp<2>&, const std::optional<Posture<2>>&,
                                 const std::optional<Posture<2>>&);
template std::string why_nowhere(const Grasp<3>&, const std::optional<Posture<3>>&,
                                 const std::optional<Posture<3>>&);
template void add_posture(Table&, const std::string&, const Grasp<2>&, const Posture<2>&,
                          const std::string&);
template std::string forces_table(const Grasp<2>&, const Hold<2>&, const Style&);
template std::string least_text(const Grasp<2>&, const Posture<2>&);
template std::string least_text(const Grasp<3>&, const Posture<3>&);
template std::string grip_text(const Grasp<2>&, double);
template std::string grip_text(const Grasp<3>&, double);
template std::string optima_table(const Grasp<2>&, const std::vector<OptimumRow>&,
                                  const std::vector<std::string>&, const Style&);
template std::string optima_table(const Grasp<3>&, const std::vector<OptimumRow>&,
                                  const std::vector<std::string>&, const Style&);
template std::string drives_table(const Grasp<2>&, const Hold<2>&, const Style&);
template std::string drives_table(const Grasp<3>&, const Hold<3>&, const Style&);
template std::string acting_text(const Load<2>&);
template std::string acting_text(const Load<3>&);
template std::string loads_table(const Grasp<2>&, const Posture<2>&, const Style&);
template std::string why_pinching_costs(const Grasp<2>&, const Posture<2>&, const Posture<2>&);
template std::string reason_text(const Grasp<3>&, const Posture<3>&);
template void add_posture(Table&, const std::string&, const Grasp<3>&, const Posture<3>&,
                          const std::string&);
template std::string forces_table(const Grasp<3>&, const Hold<3>&, const Style&);
template std::string loads_table(const Grasp<3>&, const Posture<3>&, const Style&);
template std::string why_pinching_costs(const Grasp<3>&, const Posture<3>&, const Posture<3>&);

}  // namespace poise
