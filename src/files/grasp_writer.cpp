#include "files/grasp_writer.hpp"

#include <cmath>

#include "files/degrees.hpp"
#include "files/json_text.hpp"
#include "files/json_value.hpp"
#include "readers/readers.hpp"

namespace poise {
namespace {

template <int Dim>
Json contact_value(const Contact<Dim>& contact) {
  const Contact<Dim> plain;
  Json result = Json::object();
  for_each_contact_field<Dim>([&](const std::string& name, auto member) {
    const bool needed = name == "position" || name == "normal" || name == "friction";
    if (needed || contact.*member != plain.*member) result[name] = json_value(contact.*member);
  });
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
  if (file.objective != CommonFile<Dim>{}.objective)
    result["objective"] = to_string(file.objective);
  return result;
}

template <int Dim>
Json drive_value(const Drive<Dim>& drive) {
  Json value = {{"name", drive.name}, {"moves", Json::array()}};
  for (const auto& moved : drive.moves) value["moves"].push_back(moved.finger);
  const Twist<Dim>& twist = drive.moves.front().twist;
  if (!drive.turns) {
    value["along"] = json_value(Vector<Dim>(twist.template head<Dim>()));
  } else {
    // The point of the axis that is nearest to the origin: omega x v.
    Vector<3> omega = Vector<3>::UnitZ(), v = Vector<3>::Zero();
    v.template head<Dim>() = twist.template head<Dim>();
    if constexpr (Dim == 2)
      omega *= twist[2];
    else
      omega = twist.template tail<3>();
    const Vector<Dim> through = omega.cross(v).template head<Dim>();
    value["about"] = {{"axis", json_value(omega)}, {"through", json_value(through)}};
  }
  if (std::isfinite(drive.max)) value["max"] = drive.max;
  return value;
}

/// What is not as it is anyway.
template <int Dim>
void add_mechanism(Json& result, const Mechanism<Dim>& mechanism,
                   const Mechanism<Dim>& otherwise = {}) {
  if (mechanism.kind == DriveKind::listed) {
    result["drives"] = Json::array();
    for (const Drive<Dim>& drive : mechanism.drives) result["drives"].push_back(drive_value(drive));
  } else if (mechanism.kind != otherwise.kind) {
    result["drives"] = to_string(mechanism.kind);
  }
  for (const Finger<Dim>& finger : mechanism.fingers) {
    Finger<Dim> plain;
    for (const Finger<Dim>& other : otherwise.fingers)
      if (other.name == finger.name) plain = other;
    Json value = Json::object();
    if (finger.closing != plain.closing) value["closing"] = json_value(finger.closing);
    if (finger.max_force != plain.max_force) value["max_force"] = finger.max_force;
    if (!value.empty()) result["fingers"][finger.name] = std::move(value);
  }
}

/// The object of the first load, and what each load has that it has not.
template <int Dim>
void add_loads(Json& result, const std::vector<Load<Dim>>& loads) {
  const Load<Dim>& first = loads.front();
  result["object"] = {{"weight", first.weight}, {"com", json_value(first.com)}};
  const Load<Dim> weight{.weight = first.weight, .com = first.com};
  if (loads.size() == 1 && first == weight) return;
  result["loads"] = Json::array();
  for (const Load<Dim>& load : loads) {
    Json entry = Json::object();
    if (!load.name.empty()) entry["name"] = load.name;
    if (load.weight != first.weight) entry["weight"] = load.weight;
    if (load.com != first.com) entry["com"] = json_value(load.com);
    if (load.lift != 0) entry["acceleration"]["up"] = load.lift;
    if (!load.acceleration.isZero(0))
      entry["acceleration"]["fixed"] = json_value(load.acceleration);
    if (!load.fixed.isZero(0)) {
      entry["force"] = json_value(Vector<Dim>(-load.fixed.template head<Dim>()));
      if constexpr (Dim == 2)
        entry["moment"] = -load.fixed[2];
      else
        entry["moment"] = json_value(Vector<3>(-load.fixed.template tail<3>()));
    }
    result["loads"].push_back(std::move(entry));
  }
}

Json pose_value(const char* type, const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  return {{"type", type},
          {"position", json_value(pose.position)},
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
  if (jaw.contact == JawContact::facets) value["contact"] = "facets";
  value["samples"] = jaw.samples;
  return with_forces(std::move(value), jaw);
}

Json gripper_value(const Suction& suction) {
  Json value = pose_value("suction", suction.pose);
  value["direction"] = json_value(suction.direction);
  value["cups"] = Json::array();
  for (const Vector<3>& cup : suction.cups) value["cups"].push_back(json_value(cup));
  value["diameter"] = suction.diameter;
  value["adhesion"] = suction.adhesion;
  value["friction"] = suction.friction;
  return value;
}

Json gripper_value(const Fingertips& hand) {
  Json value = pose_value("fingertips", hand.pose);
  value["rays"] = Json::array();
  for (const Fingertip& finger : hand.rays) {
    value["rays"].push_back(
        {{"origin", json_value(finger.origin)}, {"direction", json_value(finger.direction)}});
    if (!finger.finger.empty()) value["rays"].back()["finger"] = finger.finger;
  }
  return with_forces(std::move(value), hand);
}

}  // namespace

Json shape_value(const Shape& shape) {
  if (const auto* disk = std::get_if<Disk>(&shape)) return {{"disk", {{"radius", disk->radius}}}};
  if (const auto* ellipse = std::get_if<Ellipse>(&shape))
    return {{"ellipse", {{"radii", json_value(ellipse->radii)}}}};
  Json vertices = Json::array();
  for (const Vector<2>& vertex : std::get<Polygon>(shape).vertices)
    vertices.push_back(json_value(vertex));
  return {{"polygon", std::move(vertices)}};
}

Json shape_value(const Solid& solid) {
  if (const auto* box = std::get_if<Box>(&solid))
    return {{"box", {{"size", json_value(box->size)}}}};
  if (const auto* cylinder = std::get_if<Cylinder>(&solid))
    return {{"cylinder", {{"radius", cylinder->radius}, {"height", cylinder->height}}}};
  if (const auto* sphere = std::get_if<Sphere>(&solid))
    return {{"sphere", {{"radius", sphere->radius}}}};
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&solid))
    return {{"ellipsoid", {{"radii", json_value(ellipsoid->radii)}}}};
  const auto& mesh = std::get<MeshShape>(solid);
  return {{"mesh", {{"file", mesh.file}, {"scale", mesh.scale}}}};
}

Json tilt_value(const Tilt& tilt) {
  return {{"from", json_value(tilt.from)}, {"max_deg", degrees(tilt.most)}};
}

std::string grasp_document(const SpatialFile& file, WriteAs as, const std::string& folder) {
  Json result = head(file);
  if (file.up) result["up"] = json_value(*file.up);
  if (file.tilt) result["tilt"] = tilt_value(*file.tilt);
  add_loads(result, file.loads);
  if (file.shape) {
    Solid shape = *file.shape;
    if (auto* mesh = std::get_if<MeshShape>(&shape); mesh && !folder.empty())
      mesh->file = path_from(folder, mesh->file);
    result["object"]["shape"] = shape_value(shape);
  }
  if (as == WriteAs::gripper && file.gripper)
    result["gripper"] = std::visit([](const auto& g) { return gripper_value(g); }, *file.gripper);
  else
    result["contacts"] = contact_values(file.contacts);
  Mechanism<3> otherwise;
  if (result.contains("gripper")) {
    std::vector<Contact<3>> touching = file.contacts;
    const auto is_pull = [&](const Contact<3>& contact) { return !contact.pad; };
    if (std::holds_alternative<Suction>(*file.gripper)) std::erase_if(touching, is_pull);
    otherwise = mechanism(*file.gripper);
    add_pulls(pulls(*file.gripper, touching), touching, otherwise);
  }
  if (file.mechanism != otherwise) add_mechanism(result, file.mechanism, otherwise);
  return json_text(result);
}

template <int Dim>
std::string mechanism_document(const Mechanism<Dim>& mechanism) {
  Json result = Json::object();
  add_mechanism(result, mechanism);
  return result.dump();
}
template std::string mechanism_document(const Mechanism<2>&);
template std::string mechanism_document(const Mechanism<3>&);

std::string mesh_document(const Mesh& mesh) {
  Json points = Json::array();
  for (const Vector<3>& point : mesh.vertices) points.push_back(json_value(point));
  return Json{{"points", std::move(points)}, {"triangles", mesh.triangles}}.dump();
}

std::string grasp_document(const PlanarFile& file) {
  Json result = head(file);
  if (file.angle) result["angle_deg"] = degrees(*file.angle);
  if (file.domain == Domain::pinching_up) result["domain"] = "pinching-up";
  add_loads(result, file.loads);
  if (file.shape) result["object"]["shape"] = shape_value(*file.shape);
  result["contacts"] = contact_values(file.contacts);
  add_mechanism(result, file.mechanism);
  return json_text(result);
}

}  // namespace poise
