#include "files/grasp_writer.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "files/json_text.hpp"
#include "files/result.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

Json list(const Vector<2>& v) { return {v.x(), v.y()}; }

Json contact_value(const Contact<2>& contact) {
  Json result = {{"position", list(contact.position)},
                 {"normal", list(contact.normal)},
                 {"friction", contact.friction}};
  if (contact.min_normal != 0) result["min_normal"] = contact.min_normal;
  if (std::isfinite(contact.max_normal)) result["max_normal"] = contact.max_normal;
  if (contact.share != 1) result["share"] = contact.share;
  if (!contact.finger.empty()) result["finger"] = contact.finger;
  return result;
}

}  // namespace

Json shape_value(const Shape& shape) {
  if (const auto* disk = std::get_if<Disk>(&shape)) return {{"disk", {{"radius", disk->radius}}}};
  if (const auto* ellipse = std::get_if<Ellipse>(&shape))
    return {{"ellipse", {{"radii", list(ellipse->radii)}}}};
  Json vertices = Json::array();
  for (const Vector<2>& vertex : std::get<Polygon>(shape).vertices)
    vertices.push_back(list(vertex));
  return {{"polygon", std::move(vertices)}};
}

std::string grasp_document(const PlanarFile& file) {
  Json result = {{"poise", 1}, {"dimension", 2}};
  if (!file.name.empty()) result["name"] = file.name;
  if (file.safety != 1) result["safety"] = file.safety;
  if (file.angle) result["angle_deg"] = degrees(*file.angle);
  if (file.domain == Domain::pinched) result["domain"] = "pinched";
  result["object"] = {{"weight", file.object.weight}, {"com", list(file.object.com)}};
  if (file.shape) result["object"]["shape"] = shape_value(*file.shape);
  result["contacts"] = Json::array();
  for (const Contact<2>& contact : file.contacts)
    result["contacts"].push_back(contact_value(contact));
  return json_text(result);
}

}  // namespace poise
