#include "files/grasp_writer.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "files/json_text.hpp"
#include "files/result.hpp"
#include "readers/readers.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

/// Numbers without the sign of zero.
template <class Numbers>
Json list(const Numbers& numbers) {
  Json result = Json::array();
  for (const double value : numbers) result.push_back(value == 0 ? 0 : value);
  return result;
}

template <int Dim>
Json contact_value(const Contact<Dim>& contact) {
  Json result = {{"position", list(contact.position)},
                 {"normal", list(contact.normal)},
                 {"friction", contact.friction}};
  if (contact.torsion != 0) result["torsion"] = contact.torsion;
  if (contact.min_normal != 0) result["min_normal"] = contact.min_normal;
  if (std::isfinite(contact.max_normal)) result["max_normal"] = contact.max_normal;
  if (contact.share != 1) result["share"] = contact.share;
  if (!contact.finger.empty()) result["finger"] = contact.finger;
  return result;
}

template <int Dim>
Json contact_values(const std::vector<Contact<Dim>>& contacts) {
  Json result = Json::array();
  for (const Contact<Dim>& contact : contacts) result.push_back(contact_value(contact));
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

Json pose_value(const char* type, const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  return {{"type", type},
          {"position", list(pose.position)},
          {"quaternion", {q.w(), q.x(), q.y(), q.z()}}};
}

template <class Gripper>
Json with_forces(Json value, const Gripper& gripper) {
  value["friction"] = gripper.friction;
  if (gripper.torsion != 0) value["torsion"] = gripper.torsion;
  if (std::isfinite(gripper.max_force)) value["max_force"] = gripper.max_force;
  return value;
}

Json gripper_value(const ParallelJaw& jaw) {
  Json value = pose_value("parallel_jaw", jaw.pose);
  value["opening"] = jaw.opening;
  value["pad"] = {{"width", jaw.width}, {"height", jaw.height}, {"depth", jaw.depth}};
  value["samples"] = jaw.samples;
  return with_forces(std::move(value), jaw);
}

Json gripper_value(const Fingertips& hand) {
  Json value = pose_value("fingertips", hand.pose);
  value["rays"] = Json::array();
  for (const Fingertip& finger : hand.rays) {
    value["rays"].push_back(
        {{"origin", list(finger.origin)}, {"direction", list(finger.direction)}});
    if (!finger.finger.empty()) value["rays"].back()["finger"] = finger.finger;
  }
  return with_forces(std::move(value), hand);
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
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&solid))
    return {{"ellipsoid", {{"radii", list(ellipsoid->radii)}}}};
  const auto& mesh = std::get<MeshShape>(solid);
  return {{"mesh", {{"file", mesh.file}, {"scale", mesh.scale}}}};
}

Json tilt_value(const Tilt& tilt) {
  return {{"from", list(tilt.from)}, {"max_deg", degrees(tilt.most)}};
}

std::string grasp_document(const SpatialFile& file, Held held, const std::string& folder) {
  Json result = head(file);
  if (file.up) result["up"] = list(*file.up);
  if (file.tilt) result["tilt"] = tilt_value(*file.tilt);
  if (file.scenarios.size() == 1) {
    result["object"] = object_value(file.scenarios.front());
  } else {
    result["object"]["scenarios"] = Json::array();
    for (const Object<3>& object : file.scenarios)
      result["object"]["scenarios"].push_back(object_value(object));
  }
  if (file.shape) {
    Solid shape = *file.shape;
    if (auto* mesh = std::get_if<MeshShape>(&shape); mesh && !folder.empty())
      mesh->file = path_from(folder, mesh->file);
    result["object"]["shape"] = shape_value(shape);
  }
  if (held == Held::by_gripper && file.gripper)
    result["gripper"] = std::visit([](const auto& g) { return gripper_value(g); }, *file.gripper);
  else
    result["contacts"] = contact_values(file.contacts);
  return json_text(result);
}

std::string mesh_document(const Mesh& mesh) {
  Json points = Json::array();
  for (const Vector<3>& point : mesh.vertices) points.push_back(list(point));
  return Json{{"points", std::move(points)}, {"triangles", mesh.triangles}}.dump();
}

std::string grasp_document(const PlanarFile& file) {
  Json result = head(file);
  if (file.angle) result["angle_deg"] = degrees(*file.angle);
  if (file.domain == Domain::pinched) result["domain"] = "pinched";
  result["object"] = object_value(file.object);
  if (file.shape) result["object"]["shape"] = shape_value(*file.shape);
  result["contacts"] = contact_values(file.contacts);
  return json_text(result);
}

}  // namespace poise
