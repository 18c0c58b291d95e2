#include "files/grasp_file.hpp"

#include <algorithm>
#include <cmath>

#include "files/degrees.hpp"
#include "files/field.hpp"
#include "files/grasp_document.hpp"
#include "files/gripper_field.hpp"
#include "files/inertia_field.hpp"
#include "files/load_field.hpp"
#include "files/mechanism_field.hpp"
#include "files/mesh_field.hpp"
#include "files/plausible.hpp"
#include "poise/grip.hpp"
#include "shape/number_text.hpp"

namespace poise {
namespace {

void check_version(const Field& root) {
  if (root.find("poise_result")) root.fail("is a result, must be the grasp file that it is of");
  const Field poise = root.get("poise", "1, the version of this format");
  const double version = poise.number();
  if (version > 1)
    poise.fail("is " + number_text(version) + ", this program reads 1: a newer one is needed");
  if (version != 1) poise.fail("is " + number_text(version) + ", must be 1");
}

int read_dimension(const Field& root) {
  const std::string expected = "2 (the plane) or 3 (space)";
  const Field dimension = root.get("dimension", expected);
  const double value = dimension.number();
  if (value != 2 && value != 3)
    dimension.fail("is " + number_text(value) + ", must be " + expected);
  return static_cast<int>(value);
}

/// A mapping with keys of both dimensions and of its own; those of the other are refused as such.
template <int Dim>
const Mapping& check_keys(const Field& field, Keys keys, const Keys& of_plane,
                          const Keys& of_space) {
  const Keys& own = Dim == 2 ? of_plane : of_space;
  keys.insert(keys.end(), own.begin(), own.end());
  return field.mapping(keys, Dim == 2 ? of_space : of_plane,
                       Dim == 2 ? "belongs to space (dimension 3), not to the plane"
                                : "belongs to the plane (dimension 2), not to space");
}

/// The length unit of the file [m].
double read_unit(const Field& root) {
  const auto unit = root.find("length_unit");
  if (!unit) return 1;
  const std::string& name = unit->word({"m", "cm", "mm", "in"});
  return name == "m" ? 1 : name == "cm" ? 0.01 : name == "mm" ? 0.001 : 0.0254;
}

/// The shape that a field with one key spells, in the unit of the file.
template <int Dim>
ShapeOf<Dim> read_kind(const Field& field);

template <>
Shape read_kind<2>(const Field& field) {
  if (const auto disk = field.find("disk")) {
    disk->mapping({"radius"});
    return Disk{disk->get("radius", "a length").number()};
  }
  if (const auto ellipse = field.find("ellipse")) {
    ellipse->mapping({"radii"});
    return Ellipse{ellipse->get("radii", "[a, b]").vector<2>()};
  }
  Polygon polygon;
  for (const Field& vertex : field.get("polygon", "a list of points").list())
    polygon.vertices.push_back(vertex.vector<2>());
  return polygon;
}

template <>
Solid read_kind<3>(const Field& field) {
  if (const auto box = field.find("box")) {
    box->mapping({"size"});
    return Box{box->get("size", "[x, y, z]").vector<3>()};
  }
  if (const auto cylinder = field.find("cylinder")) {
    cylinder->mapping({"radius", "height"});
    return Cylinder{cylinder->get("radius", "a length").number(),
                    cylinder->get("height", "a length").number()};
  }
  if (const auto sphere = field.find("sphere")) {
    sphere->mapping({"radius"});
    return Sphere{sphere->get("radius", "a length").number()};
  }
  const Field ellipsoid = field.get("ellipsoid", "a mapping");
  ellipsoid.mapping({"radii"});
  return Ellipsoid{ellipsoid.get("radii", "[a, b, c]").vector<3>()};
}

Shape scaled(Shape shape, double unit) {
  if (auto* disk = std::get_if<Disk>(&shape)) disk->radius *= unit;
  if (auto* ellipse = std::get_if<Ellipse>(&shape)) ellipse->radii *= unit;
  if (auto* polygon = std::get_if<Polygon>(&shape))
    for (auto& vertex : polygon->vertices) vertex *= unit;
  return shape;
}

Solid scaled(Solid solid, double unit) {
  if (auto* box = std::get_if<Box>(&solid)) box->size *= unit;
  if (auto* cylinder = std::get_if<Cylinder>(&solid)) {
    cylinder->radius *= unit;
    cylinder->height *= unit;
  }
  if (auto* sphere = std::get_if<Sphere>(&solid)) sphere->radius *= unit;
  if (auto* ellipsoid = std::get_if<Ellipsoid>(&solid)) ellipsoid->radii *= unit;
  return solid;
}

template <int Dim>
ShapeOf<Dim> read_shape(const Field& field, double unit, std::vector<std::string>& warnings) {
  const Mapping& kinds = check_keys<Dim>(field, {}, {"disk", "ellipse", "polygon"},
                                         {"box", "cylinder", "sphere", "ellipsoid", "mesh"});
  if (kinds.size() != 1)
    field.fail(
        "has " + std::to_string(kinds.size()) + " kinds, must have one: " +
        (Dim == 2 ? "disk, ellipse or polygon" : "box, cylinder, sphere, ellipsoid or mesh"));
  if constexpr (Dim == 3)
    if (const auto mesh = field.find("mesh")) return read_mesh_shape(*mesh, unit, warnings);
  const ShapeOf<Dim> shape = read_kind<Dim>(field);
  try {
    check(shape);
  } catch (const InvalidShape& error) {
    throw FileError(field.file(), field.follow(error.path()).place(),
                    field.path() + "." + error.path(), error.problem());
  }
  return scaled(shape, unit);
}

template <int Dim>
Keys contact_keys() {
  Keys keys;
  for_each_contact_field<Dim>([&](const char* name, auto) { keys.emplace_back(name); });
  return keys;
}

void read_into(double& value, const Field& field) { value = field.number(); }
void read_into(std::string& value, const Field& field) { value = field.text(); }
template <int Dim>
void read_into(Eigen::Matrix<double, Dim, 1>& value, const Field& field) {
  value = field.vector<Dim>();
}
void read_into(std::optional<Pad>& /*value*/, const Field& /*field*/) {}  // needs the normal

void check_torsion(const Field& torsion, double friction) {
  if (torsion.at_least_zero() > 0 && friction == 0)
    torsion.fail("is given for a frictionless contact, must be left out, or give friction above 0");
}

template <int Dim>
Contact<Dim> read_contact(const Field& field, double unit, bool outward,
                          const std::optional<ShapeOf<Dim>>& shape) {
  Keys of_plane = contact_keys<2>();
  of_plane.emplace_back("pad");
  of_plane.emplace_back("adhesion");
  Keys of_space = contact_keys<3>();
  of_space.emplace_back("adhesion");
  check_keys<Dim>(field, {}, of_plane, of_space);
  const Field position = field.get("position", coordinates<Dim>);
  field.get("friction", "a number");
  Contact<Dim> contact;
  for_each_contact_field<Dim>([&](const char* name, auto member) {
    if (const auto given = field.find(name)) read_into(contact.*member, *given);
  });
  contact.position *= unit;
  if (const auto torsion = field.find("torsion")) check_torsion(*torsion, contact.friction);
  contact.torsion *= unit;
  if (!shape) field.get("normal", std::string(coordinates<Dim>) + ", as there is no shape");
  if (outward) contact.normal = -contact.normal;
  if (const auto normal = field.find("normal")) {
    if (!(contact.normal.cwiseAbs().maxCoeff() > 0))
      normal->fail("has no length, must point from the finger inwards");
  } else {
    try {
      contact.normal = inward_normal(*shape, contact.position);
    } catch (const NoNormal& error) {
      position.fail(error.what());
    }
  }
  if constexpr (Dim == 3)
    if (const auto pad = field.find("pad")) {
      for (const char* key : {"torsion", "share"})
        if (const auto other = field.find(key))
          other->fail("is given for a pad, must be left out: its points resist the twist");
      contact.pad = read_pad(*pad, unit, contact.normal);
    }
  return contact;
}

/// In the plane a pad is two contacts at its ends.
std::vector<Contact<2>> ends_of_pad(const Field& pad, double unit, const Contact<2>& middle) {
  pad.mapping({"size"});
  if (std::isfinite(middle.max_normal) || middle.min_normal > 0)
    pad.fail("is given with limits of the normal force, must have max_force of the finger instead");
  const double half = unit * pad.get("size", "a length").above_zero() / 2;
  std::vector<Contact<2>> ends(2, middle);
  const Vector<2> n = middle.normal.stableNormalized(), tangent(-n.y(), n.x());
  for (std::size_t k = 0; k < 2; ++k) {
    ends[k].position += (k == 0 ? -half : half) * tangent;
    ends[k].share = middle.share / 2;
  }
  return ends;
}

/// A unit vector.
Vector<3> read_direction(const Field& field) {
  const Vector<3> direction = field.vector<3>();
  if (!(direction.stableNorm() > 0)) field.fail("has no length, must be a direction");
  return direction.stableNormalized();
}

Tilt read_tilt(const Field& field) {
  field.mapping({"max_deg", "from"});
  const Vector<3> from = read_direction(field.get("from", "[x, y, z]"));
  const Field most = field.get("max_deg", "an angle in degrees");
  if (const double degrees = most.number(); degrees >= 0 && degrees <= 90)
    return {from, radians(degrees)};
  most.fail("is " + number_text(most.number()) + ", must be from 0 to 90");
}

template <int Dim>
void read_head(const Field& root, CommonFile<Dim>& file) {
  check_keys<Dim>(root,
                  {"poise", "dimension", "name", "safety", "objective", "domain", "length_unit",
                   "normals", "object", "loads", "contacts", "fingers", "drives"},
                  {"angle_deg"}, {"up", "tilt", "gripper"});
  if (const auto name = root.find("name")) file.name = name->text();
  if (const auto safety = root.find("safety")) file.safety = safety->number();
  if (const auto objective = root.find("objective"))
    file.objective =
        objective->word({"grip", "effort"}) == "grip" ? Objective::grip : Objective::effort;
}

template <int Dim>
Field read_shape_of_object(const Field& root, double unit, CommonFile<Dim>& file) {
  const Field object = root.get("object", "a mapping");
  if (const auto scenarios = object.find("scenarios"))
    scenarios->fail(
        "is not known any more, must be `loads` of the file: a list of {name, mass, com}");
  check_keys<Dim>(object, {"weight", "mass", "com", "shape"}, {}, {"density", "inertial", "inertia"});
  if (const auto shape = object.find("shape"))
    file.shape = read_shape<Dim>(*shape, unit, file.warnings);
  return object;
}

/// The pull at a contact, if there is one. What limits the force of the finger limits what it
/// presses with less.
template <int Dim>
void read_adhesion(const Field& field, Contact<Dim>& contact, std::vector<Pull<Dim>>& pulls) {
  const auto adhesion = field.find("adhesion");
  if (!adhesion) return;
  const double force = adhesion->above_zero();
  contact.max_normal += force;
  if (contact.min_normal > 0) contact.min_normal += force;
  pulls.push_back({contact, force});
}

template <int Dim>
std::vector<Pull<Dim>> read_contacts(const Field& root, double unit, CommonFile<Dim>& file) {
  std::vector<Pull<Dim>> pulls;
  const auto normals = root.find("normals");
  const bool outward = normals && normals->word({"inward", "outward"}) == "outward";
  const std::vector<Field> list = root.get("contacts", "a list").list();
  // A planar pad makes two of one, and a pull adds one: then a finger's own name is the number of
  // the file's contact.
  const bool has_more = std::any_of(list.begin(), list.end(), [](const Field& contact) {
    return (Dim == 2 && contact.find("pad")) || contact.find("adhesion");
  });
  for (std::size_t i = 0; i < list.size(); ++i) {
    file.contacts.push_back(read_contact<Dim>(list[i], unit, outward, file.shape));
    if (std::string& finger = file.contacts.back().finger; has_more && finger.empty())
      finger = std::to_string(i);
    read_adhesion(list[i], file.contacts.back(), pulls);
    if constexpr (Dim == 2) {
      if (const auto pad = list[i].find("pad")) {
        const std::vector<Contact<2>> ends = ends_of_pad(*pad, unit, file.contacts.back());
        file.contacts.pop_back();
        file.contacts.insert(file.contacts.end(), ends.begin(), ends.end());
      }
    }
  }
  return pulls;
}

/// The contacts of a gripper that closes on the shape.
void close_gripper(const Field& root, const Field& gripper, double unit, SpatialFile& file) {
  if (const auto contacts = root.find("contacts"))
    contacts->fail("are given as well as a gripper, must be one of them");
  if (const auto drives = root.find("drives"); drives && !drives->is_text())
    if (const auto force = gripper.find("max_force"))
      force->fail("is given as well as a list of drives, must be max of a drive");
  if (!file.shape) gripper.fail("needs a shape to close on: give object.shape");
  file.gripper = read_gripper(gripper, unit);
  try {
    std::vector<std::string> notes;
    file.contacts = contacts(*file.gripper, Surface(*file.shape), &notes);
    for (const std::string& note : notes)
      file.warnings.push_back(located(gripper.file(), gripper.place(), gripper.path(), note));
  } catch (const MissedGrip& error) {
    gripper.fail(error.what());
  }
}

/// Where the file says what a grasp has at a path: several loads may come from one entry.
template <int Dim>
std::string path_in_file(const Field& root, const std::string& path) {
  if (!path.starts_with("loads[")) return path;
  const std::size_t end = path.find(']');
  const std::string entry = load_paths<Dim>(root)[std::stoul(path.substr(6, end - 6))];
  const std::string field = path.substr(end + 2);
  // What an entry does not say is as the object says.
  Keys keys;
  if (field == "weight") keys = {"weight", "mass", "density", "inertial"};
  if (field.starts_with("com")) keys = {"com", "inertial"};
  const Field own = root.follow(entry);
  const bool is_own =
      keys.empty() || std::any_of(keys.begin(), keys.end(),
                                  [&](std::string_view key) { return own.find(key).has_value(); });
  return (is_own ? entry : "object") + "." + field;
}

/// Checks the grasp, and adds what is doubtful in it to the warnings.
template <int Dim>
void check_grasp(const Field& root, CommonFile<Dim>& file) {
  try {
    const Grasp<Dim> grasp = file.grasp();
    try {
      if (file.objective == Objective::grip) grip_unit(grasp);
    } catch (const InvalidGrasp& error) {
      if (root.find("objective")) throw;
      file.objective = Objective::effort;
      file.warnings.push_back(located(root.file(), root.follow(error.path()).place(), error.path(),
                                      error.problem() + "; without it the least effort is asked "
                                                        "for, not the least grip"));
    }
    const std::vector<std::string> lines = doubts<Dim>(file, grasp, root);
    file.warnings.insert(file.warnings.end(), lines.begin(), lines.end());
  } catch (const InvalidGrasp& error) {
    const std::string path = path_in_file<Dim>(root, error.path());
    throw FileError(root.file(), root.follow(path).place(), path, error.problem());
  }
}

PlanarFile read_planar(const Field& root) {
  PlanarFile file;
  read_head<2>(root, file);
  if (const auto angle = root.find("angle_deg")) file.angle = radians(angle->number());
  if (const auto domain = root.find("domain"))
    file.domain = domain->word({"all", "pinching-up"}) == "all" ? Domain::all : Domain::pinching_up;
  const double unit = read_unit(root);
  const Field object = read_shape_of_object<2>(root, unit, file);
  file.loads = read_loads<2>(root, object, unit, file.shape);
  const std::vector<Pull<2>> pulls = read_contacts<2>(root, unit, file);
  file.mechanism = read_mechanism<2>(root, unit, file.contacts);
  add_pulls(pulls, file.contacts, file.mechanism);
  check_grasp<2>(root, file);
  return file;
}

SpatialFile read_spatial(const Field& root) {
  SpatialFile file;
  read_head<3>(root, file);
  if (const auto up = root.find("up")) file.up = read_direction(*up);
  if (const auto tilt = root.find("tilt")) file.tilt = read_tilt(*tilt);
  if (const auto domain = root.find("domain");
      domain && domain->word({"all", "pinching-up"}) != "all")
    domain->fail("pinching-up is for the plane, must be all: best_pinched is shown anyway");
  const double unit = read_unit(root);
  const Field object = read_shape_of_object<3>(root, unit, file);
  file.loads = read_loads<3>(root, object, unit, file.shape);
  file.inertia = read_inertia(object);
  std::vector<Pull<3>> pull;
  if (const auto gripper = root.find("gripper")) {
    close_gripper(root, *gripper, unit, file);
    pull = pulls(*file.gripper, file.contacts);
  } else {
    pull = read_contacts<3>(root, unit, file);
  }
  file.mechanism = read_mechanism<3>(root, unit, file.contacts,
                                     file.gripper ? mechanism(*file.gripper) : Mechanism<3>{});
  add_pulls(pull, file.contacts, file.mechanism);
  check_grasp<3>(root, file);
  return file;
}

}  // namespace

GraspFile grasp_from(const Document& document) {
  const Field root(document);
  if (std::holds_alternative<std::monostate>(document.root.data))
    throw FileError(document.file, {}, "", "is empty, must be a grasp file");
  check_version(root);
  if (read_dimension(root) == 2) return read_planar(root);
  return read_spatial(root);
}

GraspFile grasp_from_json(std::string text, const std::string& file) {
  return grasp_from(parse_json(std::move(text), file));
}

}  // namespace poise
