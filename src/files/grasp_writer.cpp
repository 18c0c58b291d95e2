#include "files/grasp_writer.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "files/json_text.hpp"
#include "files/result.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

template <class Numbers>
Json list(const Numbers& numbers) {
  Json result = Json::array();
  for (const double value : numbers) result.push_back(value);
  return result;
}

template <int Dim>
Json contact_values(const CommonFile<Dim>& file) {
  Json result = Json::array();
  for (const Contact<Dim>& contact : file.contacts) {
    Json entry = {{"position", list(contact.position)},
                  {"normal", list(contact.normal)},
                  {"friction", contact.friction}};
    if (contact.torsion != 0) entry["torsion"] = contact.torsion;
    if (contact.min_normal != 0) entry["min_normal"] = contact.min_normal;
    if (std::isfinite(contact.max_normal)) entry["max_normal"] = contact.max_normal;
    if (contact.share != 1) entry["share"] = contact.share;
    if (!contact.finger.empty()) entry["finger"] = contact.finger;
    result.push_back(std::move(entry));
  }
  return result;
}

template <int Dim>
Json head(const CommonFile<Dim>& file) {
  Json result = {{"poise", 1}, {"dimension", Dim}};
  if (!file.name.empty()) result["name"] = file.name;
  if (file.safety != 1) result["safety"] = file.safety;
  return result;
}

template <int Dim>
Json object_value(const Object<Dim>& object) {
  return {{"weight", object.weight}, {"com", list(object.com)}};
}

template <int Dim>
std::string finished(Json result, const CommonFile<Dim>& file) {
  if (file.shape) result["object"]["shape"] = shape_value(*file.shape);
  result["contacts"] = contact_values(file);
  return json_text(result);
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

Json shape_value(const Solid& solid) {
  if (const auto* box = std::get_if<Box>(&solid)) return {{"box", {{"size", list(box->size)}}}};
  if (const auto* cylinder = std::get_if<Cylinder>(&solid))
    return {{"cylinder", {{"radius", cylinder->radius}, {"height", cylinder->height}}}};
  if (const auto* sphere = std::get_if<Sphere>(&solid))
    return {{"sphere", {{"radius", sphere->radius}}}};
  return {{"ellipsoid", {{"radii", list(std::get<Ellipsoid>(solid).radii)}}}};
}

Json tilt_value(const Tilt& tilt) {
  return {{"from", list(tilt.from)}, {"max_deg", degrees(tilt.most)}};
}

std::string grasp_document(const PlanarFile& file) {
  Json result = head(file);
  if (file.angle) result["angle_deg"] = degrees(*file.angle);
  if (file.domain == Domain::pinched) result["domain"] = "pinched";
  result["object"] = object_value(file.object);
  return finished(std::move(result), file);
}

std::string grasp_document(const SpatialFile& file) {
  Json result = head(file);
  if (file.up) result["up"] = list(*file.up);
  if (file.tilt) result["tilt"] = tilt_value(*file.tilt);
  if (file.scenarios.size() == 1) {
    result["object"] = object_value(file.scenarios.front());
  } else {
    result["object"]["scenarios"] = Json::array();
    for (const Object<3>& scenario : file.scenarios)
      result["object"]["scenarios"].push_back(object_value(scenario));
  }
  return finished(std::move(result), file);
}

}  // namespace poise
