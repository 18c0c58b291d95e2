#include "report_parts.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "files/result.hpp"

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

/// The shape in words.
std::string shape_text(const Shape& shape, const Lengths& lengths) {
  if (const auto* disk = std::get_if<Disk>(&shape))
    return "disk, radius " + lengths.text(disk->radius) + " " + lengths.unit;
  if (const auto* ellipse = std::get_if<Ellipse>(&shape))
    return "ellipse, radii " + lengths.text(ellipse->radii.x()) + " and " +
           lengths.text(ellipse->radii.y()) + " " + lengths.unit;
  return fmt::format("polygon of {} vertices", std::get<Polygon>(shape).vertices.size());
}

std::string shape_text(const Solid& solid, const Lengths& lengths) {
  const std::string unit = " " + lengths.unit;
  const auto product = [&](const Vector<3>& v) {
    return lengths.text(v.x()) + " × " + lengths.text(v.y()) + " × " + lengths.text(v.z()) + unit;
  };
  if (const auto* box = std::get_if<Box>(&solid)) return "box, " + product(box->size);
  if (const auto* cylinder = std::get_if<Cylinder>(&solid))
    return "cylinder, radius " + lengths.text(cylinder->radius) + " and height " +
           lengths.text(cylinder->height) + unit;
  if (const auto* sphere = std::get_if<Sphere>(&solid))
    return "sphere, radius " + lengths.text(sphere->radius) + unit;
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&solid))
    return "ellipsoid, radii " + product(ellipsoid->radii);
  const auto& mesh = std::get<MeshShape>(solid);
  return fmt::format("mesh of {} triangles, {}", mesh.mesh->triangles.size(),
                     product(bounds(solid).sizes()));
}

template <int Dim>
std::string limits_text(const Contact<Dim>& contact) {
  const bool capped = std::isfinite(contact.max_normal);
  if (contact.min_normal == 0) return capped ? "at most " + plain(contact.max_normal) : "";
  return plain(contact.min_normal) + (capped ? " to " + plain(contact.max_normal) : " or more");
}

template <int Dim>
bool soft(const Contact<Dim>& contact) {
  return Dim == 3 && contact.torsion > 0;
}

template <int Dim>
std::string contacts_table(const Grasp<Dim>& grasp, const Lengths& lengths, const Style& style) {
  const std::vector<Contact<Dim>>& contacts = grasp.contacts();
  const bool any_soft = std::any_of(contacts.begin(), contacts.end(), soft<Dim>);
  std::vector<std::string> headings{
      "<finger",       "contact",  fmt::format("position [{}]", lengths.unit),
      "inward normal", "friction", "cone"};
  if (any_soft) headings.push_back(fmt::format("torsion [{}]", lengths.unit));
  headings.emplace_back("<normal force [N]");
  Table table(headings);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact<Dim>& contact = contacts[i];
    std::vector<std::string> row{contact.finger,
                                 std::to_string(i),
                                 lengths.text(contact.position),
                                 vector_text(contact.normal, 4),
                                 plain(contact.friction),
                                 "± " + fixed(degrees(std::atan(contact.friction)), 1) + "°"};
    if (any_soft)
      row.push_back(soft(contact) ? plain(lengths.per_metre * contact.torsion) : "hard");
    row.push_back(limits_text(contact));
    table.add(std::move(row));
  }
  return table.text(style);
}

}  // namespace

std::string title(const std::string& name, const Style& style) {
  return name.empty() ? "" : style.bold(name) + "\n\n";
}

std::string heading(const std::string& text, const Style& style) {
  return "\n" + style.bold(text) + "\n";
}

template <int Dim>
std::string forces_table(const Grasp<Dim>& grasp, const Hold<Dim>& hold, const Style& style) {
  const auto fingers = finger_forces(grasp, hold);
  const std::vector<Contact<Dim>>& contacts = grasp.contacts();
  const bool any_soft = std::any_of(contacts.begin(), contacts.end(), soft<Dim>);
  const int decimals = decimals_for(grip_force(grasp, hold));
  const Lengths lengths(grasp.radius());
  std::vector<std::string> headings{"<finger", "contact", "normal [N]", "tangential [N]"};
  if (any_soft) headings.push_back(fmt::format("torsion [N {}]", lengths.unit));
  for (const char* rest : {"friction used", "<state", "<limit"}) headings.emplace_back(rest);
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
        row.push_back(fixed(force.tangential, decimals));
      } else {
        row.push_back(fixed(force.tangential.norm(), decimals));
        if (any_soft)
          row.push_back(soft(contacts[i])
                            ? fixed(lengths.per_metre * force.torsion_moment,
                                    std::max(0, decimals + (lengths.per_metre > 1 ? -2 : 0)))
                            : "");
      }
      row.push_back(loaded ? fixed(100 * force.friction_used, 1) + " %" : "");
      row.emplace_back(to_string(force.state));
      row.emplace_back(force.limit == ForceLimit::none  ? ""
                       : force.limit == ForceLimit::min ? "at min_normal"
                                                        : "at max_normal");
      table.add(std::move(row));
    }
    if (count > 1) table.add({"", "together", fixed(fingers[k].normal, decimals)});
  }
  return table.text(style);
}

std::string effort_text(double effort) {
  return fmt::format("\nForce norm {}, effort {} N².\n", newtons(std::sqrt(effort)), plain(effort));
}

std::string optima_table(const std::vector<OptimumRow>& rows, const std::vector<std::string>& words,
                         const Style& style) {
  // Four digits of the least number in a column.
  double grip = 0, effort = 0;
  for (const OptimumRow& row : rows) {
    grip = grip == 0 ? row.grip_force : std::min(grip, row.grip_force);
    effort = effort == 0 ? row.effort : std::min(effort, row.effort);
  }
  std::vector<std::string> headings{"posture", "grip force [N]", "force norm [N]", "effort [N²]"};
  for (const std::string& word : words) headings.push_back("<" + word);
  Table table(headings);
  for (const OptimumRow& row : rows) {
    std::vector<std::string> cells{row.posture, fixed(row.grip_force, decimals_for(grip)),
                                   fixed(std::sqrt(row.effort), decimals_for(std::sqrt(effort))),
                                   fixed(row.effort, decimals_for(effort))};
    cells.insert(cells.end(), row.words.begin(), row.words.end());
    table.add(std::move(cells));
  }
  return table.text(style);
}

template <int Dim>
std::string why_pinching_costs(const Grasp<Dim>& grasp, const Hold<Dim>& best, Manner manner,
                               const Hold<Dim>& pinched) {
  const double factor = pinched.effort / best.effort;
  const std::string cost = fmt::format(
      "Pinched it costs {} times the force norm ({} times the effort): ", plain(std::sqrt(factor)),
      plain(factor));
  const std::string squeeze =
      ", whereas pinched the fingers have to squeeze, so that friction carries the weight.";
  if (manner == Manner::resting)
    return cost + "at the best posture it rests on " + strongest(grasp, best) + squeeze;
  if (manner == Manner::cradled)
    return cost + "at the best posture it lies in the fork of the fingers" + squeeze;
  return cost + (Dim == 2 ? "the best posture is at an end of those in which it can be held."
                          : "the best posture is at the border of those in which it can be held.");
}

template <int Dim>
std::string check_text(const CommonFile<Dim>& file, const std::vector<Grasp<Dim>>& grasps,
                       const std::vector<std::vector<std::string>>& facts, const Style& style) {
  const Grasp<Dim>& first = grasps.front();
  const Lengths lengths(first.radius());
  Table table({"<", "<"});
  for (std::size_t k = 0; k < grasps.size(); ++k) {
    const Object<Dim>& object = grasps[k].object();
    const std::string of = grasps.size() == 1 ? "" : fmt::format(" {}", k);
    table.add({"weight" + of, newtons(object.weight)});
    table.add({"centre of mass" + of, lengths.text(object.com) + " " + lengths.unit});
  }
  if (file.shape) table.add({"shape", shape_text(*file.shape, lengths)});
  if (file.safety != 1)
    table.add({"safety", (Dim == 2 ? "friction" : "friction and torsion") +
                             std::string(" divided by ") + plain(file.safety) +
                             " (below: after that)"});
  table.add({"fingers",
             fmt::format("{}, with {} contacts", first.fingers().size(), first.contacts().size())});
  table.add({"force closure", force_closure(first) ? "yes, any load can be balanced"
                                                   : "no, not every load can be balanced"});
  for (const auto& fact : facts) table.add(fact);

  std::string text = title(file.name, style) + table.text(style) + heading("Contacts", style) +
                     contacts_table(first, lengths, style);
  text += file.warnings.empty() ? "\nNo warnings.\n"
                                : heading(fmt::format("Warnings: {}", file.warnings.size()), style);
  for (const std::string& warning : file.warnings) text += "  " + warning + "\n";
  return text;
}

template std::string forces_table<2>(const Grasp<2>&, const Hold<2>&, const Style&);
template std::string forces_table<3>(const Grasp<3>&, const Hold<3>&, const Style&);
template std::string why_pinching_costs<2>(const Grasp<2>&, const Hold<2>&, Manner, const Hold<2>&);
template std::string why_pinching_costs<3>(const Grasp<3>&, const Hold<3>&, Manner, const Hold<3>&);
template std::string check_text<2>(const CommonFile<2>&, const std::vector<Grasp<2>>&,
                                   const std::vector<std::vector<std::string>>&, const Style&);
template std::string check_text<3>(const CommonFile<3>&, const std::vector<Grasp<3>>&,
                                   const std::vector<std::vector<std::string>>&, const Style&);

}  // namespace poise
