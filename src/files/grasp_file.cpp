#include "files/grasp_file.hpp"

#include <cmath>

#include "files/field.hpp"
#include "files/grasp_document.hpp"
#include "files/plausible.hpp"
#include "shape/number_text.hpp"

namespace poise {
namespace {

/// In (-pi, pi].
double radians(double degrees) {
  const double turned = std::remainder(degrees, 360);
  return (turned > -180 ? turned : 180) * 3.14159265358979323846 / 180;
}

void check_version(const Field& root) {
  const Field poise = root.get("poise", "1, the version of this format");
  const double version = poise.number();
  if (version > 1)
    poise.fail("is " + number_text(version) + ", this program reads 1: a newer one is needed");
  if (version != 1) poise.fail("is " + number_text(version) + ", must be 1");
}

int read_dimension(const Field& root) {
  const Field dimension = root.get("dimension", "2 (the plane)");
  const double value = dimension.number();
  if (value == 3) dimension.fail("is 3, this version reads the plane only, must be 2");
  if (value != 2) dimension.fail("is " + number_text(value) + ", must be 2 (the plane)");
  return 2;
}

/// The length unit of the file [m].
double read_unit(const Field& root) {
  const auto unit = root.find("length_unit");
  if (!unit) return 1;
  const std::string& name = unit->word({"m", "cm", "mm", "in"});
  return name == "m" ? 1 : name == "cm" ? 0.01 : name == "mm" ? 0.001 : 0.0254;
}

/// The shape in the unit of the file.
Shape read_shape(const Field& field) {
  const Mapping& kinds = field.mapping({"disk", "ellipse", "polygon"},
                                       {"mesh", "box", "cylinder", "sphere", "ellipsoid"});
  if (kinds.size() != 1)
    field.fail("has " + std::to_string(kinds.size()) +
               " kinds, must have one: disk, ellipse or polygon");
  Shape shape;
  if (const auto disk = field.find("disk")) {
    disk->mapping({"radius"});
    shape = Disk{disk->get("radius", "a length").number()};
  } else if (const auto ellipse = field.find("ellipse")) {
    ellipse->mapping({"radii"});
    shape = Ellipse{ellipse->get("radii", "[a, b]").vector<2>()};
  } else {
    Polygon polygon;
    for (const Field& vertex : field.get("polygon", "a list of points").list())
      polygon.vertices.push_back(vertex.vector<2>());
    shape = std::move(polygon);
  }
  try {
    check(shape);
  } catch (const InvalidShape& error) {
    throw FileError(field.file(), field.follow(error.path()).place(),
                    field.path() + "." + error.path(), error.problem());
  }
  return shape;
}

Shape scaled(Shape shape, double unit) {
  if (auto* disk = std::get_if<Disk>(&shape)) disk->radius *= unit;
  if (auto* ellipse = std::get_if<Ellipse>(&shape)) ellipse->radii *= unit;
  if (auto* polygon = std::get_if<Polygon>(&shape))
    for (auto& vertex : polygon->vertices) vertex *= unit;
  return shape;
}

double read_weight(const Field& object) {
  const auto weight = object.find("weight"), mass = object.find("mass");
  if (weight && mass) mass->fail("is given as well as weight, must be one of them");
  if (!mass) return object.get("weight", "a force [N], or give mass [kg]").number();
  if (const double kilograms = mass->number(); kilograms > 0) return kilograms * standard_gravity;
  mass->fail("is " + number_text(mass->number()) + ", must be above 0");
}

Contact<2> read_contact(const Field& field, double unit, bool outward,
                        const std::optional<Shape>& shape) {
  field.mapping({"position", "normal", "friction", "min_normal", "max_normal", "share", "finger"},
                {"torsion"});
  Contact<2> contact;
  const Field position = field.get("position", "[x, y]");
  contact.position = unit * position.vector<2>();
  contact.friction = field.get("friction", "a number").number();
  if (const auto least = field.find("min_normal")) contact.min_normal = least->number();
  if (const auto most = field.find("max_normal")) contact.max_normal = most->number();
  if (const auto share = field.find("share")) contact.share = share->number();
  if (const auto finger = field.find("finger")) contact.finger = finger->text();
  if (shape && !field.find("normal")) {
    try {
      contact.normal = inward_normal(*shape, contact.position);
    } catch (const NoNormal& error) {
      position.fail(error.what());
    }
  } else {
    const Vector<2> normal = field.get("normal", "[x, y], as there is no shape").vector<2>();
    contact.normal = outward ? -normal : normal;
  }
  return contact;
}

}  // namespace

GraspFile grasp_from(const Document& document) {
  const Field root(document);
  if (std::holds_alternative<std::monostate>(document.root.data))
    throw FileError(document.file, {}, "", "is empty, must be a grasp file");
  check_version(root);
  GraspFile file;
  file.dimension = read_dimension(root);
  root.mapping({"poise", "dimension", "name", "safety", "angle_deg", "domain", "length_unit",
                "normals", "object", "contacts"},
               {"up", "tilt"});
  if (const auto name = root.find("name")) file.name = name->text();
  if (const auto safety = root.find("safety")) file.safety = safety->number();
  if (const auto angle = root.find("angle_deg")) file.angle = radians(angle->number());
  if (const auto domain = root.find("domain"))
    file.domain = domain->word({"all", "pinched"}) == "all" ? Domain::all : Domain::pinched;
  const double unit = read_unit(root);
  const auto normals = root.find("normals");
  const bool outward = normals && normals->word({"inward", "outward"}) == "outward";

  const Field object = root.get("object", "a mapping");
  object.mapping({"weight", "mass", "com", "shape"}, {"scenarios"});
  file.object.weight = read_weight(object);
  if (const auto shape = object.find("shape")) file.shape = scaled(read_shape(*shape), unit);
  if (const auto com = object.find("com"); com || !file.shape)
    file.object.com = unit * object.get("com", "[x, y], as there is no shape").vector<2>();
  else
    file.object.com = centroid(*file.shape);

  for (const Field& contact : root.get("contacts", "a list").list())
    file.contacts.push_back(read_contact(contact, unit, outward, file.shape));

  try {
    file.warnings = doubts(file, file.grasp(), root);
  } catch (const InvalidGrasp& error) {
    throw FileError(document.file, root.follow(error.path()).place(), error.path(),
                    error.problem());
  }
  return file;
}

GraspFile grasp_from_json(std::string text, const std::string& file) {
  return grasp_from(parse_json(std::move(text), file));
}

}  // namespace poise
