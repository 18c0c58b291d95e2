// What `poise check` says.
#include <fmt/core.h>

#include <cmath>

#include "files/degrees.hpp"
#include "tables/parts.hpp"
#include "tables/report.hpp"

namespace poise {
namespace {

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
std::string contacts_table(const Grasp<Dim>& grasp, const Lengths& lengths, const Style& style) {
  const std::vector<Contact<Dim>>& contacts = grasp.contacts();
  const bool any_soft = std::any_of(contacts.begin(), contacts.end(),
                                    [](const auto& contact) { return contact.torsion > 0; });
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
      row.push_back(contact.torsion > 0 ? plain(lengths.per_metre * contact.torsion) : "hard");
    row.push_back(limits_text(contact));
    table.add(std::move(row));
  }
  return table.text(style);
}

/// What the plane and space have each for itself.
std::vector<std::vector<std::string>> own_facts(const PlanarFile& file,
                                                const CheckAnswer<2>& answer) {
  const Interval& fork = answer.fork;
  return {{"held now", file.angle ? "turned to " + degrees_text(*file.angle) : "not given"},
          {"in the fork of the fingers", fork.from < fork.to ? range_text(fork) : "nowhere"}};
}

std::vector<std::vector<std::string>> own_facts(const SpatialFile& file, const CheckAnswer<3>&) {
  return {{"held now", file.up ? "with " + posture_text(*file.up) + " up" : "not given"},
          {"allowed", file.tilt ? tilt_text(*file.tilt) : "every posture"}};
}

/// The weight where it is all, else the first of the loads.
template <int Dim>
void add_loads(Table& table, const Grasp<Dim>& grasp, const Lengths& lengths) {
  constexpr std::size_t most = 12;
  const auto& loads = grasp.loads();
  const auto com = [&](const Load<Dim>& load) {
    return lengths.text(load.com) + " " + lengths.unit;
  };
  if (loads.size() == 1) {
    table.add({"weight", newtons(loads.front().weight)});
    table.add({"centre of mass", com(loads.front())});
    if (const std::string acting = acting_text(loads.front()); !acting.empty())
      table.add({loads.front().name.empty() ? "and" : loads.front().name, acting});
    return;
  }
  for (std::size_t k = 0; k < std::min(most, loads.size()); ++k) {
    const std::string acting = acting_text(loads[k]);
    table.add({load_name(grasp, k), newtons(loads[k].weight) + " at " + com(loads[k]) +
                                        (acting.empty() ? "" : ", " + acting)});
  }
  if (loads.size() > most) table.add({"", fmt::format("and {} more", loads.size() - most)});
}

}  // namespace

template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp, const CheckAnswer<Dim>& answer,
                   const Style& style) {
  const Lengths lengths(grasp.radius());
  Table table({"<", "<"});
  add_loads(table, grasp, lengths);
  if (file.shape) table.add({"shape", shape_text(*file.shape, lengths)});
  if (file.safety != 1)
    table.add({"safety", (Dim == 2 ? "friction" : "friction and torsion") +
                             std::string(" divided by ") + plain(file.safety) +
                             " (below: after that)"});
  table.add({"fingers",
             fmt::format("{}, with {} contacts", grasp.fingers().size(), grasp.contacts().size())});
  table.add({"force closure", answer.force_closure ? "yes, any load can be balanced"
                                                   : "no, not every load can be balanced"});
  for (const auto& fact : own_facts(file, answer)) table.add(fact);

  std::string text = title(file.name, style) + table.text(style) + heading("Contacts", style) +
                     contacts_table(grasp, lengths, style);
  text += file.warnings.empty() ? "\nNo warnings.\n"
                                : heading(fmt::format("Warnings: {}", file.warnings.size()), style);
  for (const std::string& warning : file.warnings) text += "  " + warning + "\n";
  return text;
}

template std::string report(const PlanarFile&, const Grasp<2>&, const CheckAnswer<2>&,
                            const Style&);
template std::string report(const SpatialFile&, const Grasp<3>&, const CheckAnswer<3>&,
                            const Style&);

}  // namespace poise
