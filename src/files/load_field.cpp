#include "files/load_field.hpp"

#include <cmath>
#include <numbers>

#include "files/mesh_field.hpp"
#include "readers/readers.hpp"
#include "shape/number_text.hpp"

namespace poise {
namespace {

/// Each is solved by itself, in every posture that is looked at.
constexpr std::size_t most_loads = 1000;

/// Why a shape has neither volume nor centroid, or nothing.
template <int Dim>
std::string without_volume(const std::optional<ShapeOf<Dim>>& shape) {
  if (!shape) return "there is no shape";
  if constexpr (Dim == 3)
    if (const auto* mesh = std::get_if<MeshShape>(&*shape); mesh && !mesh->defect.empty())
      return "the mesh " + mesh->defect;
  return "";
}

/// [N], which may come out as too large.
template <int Dim>
double read_weight(const Field& object, const std::optional<ShapeOf<Dim>>& shape) {
  const auto weight = object.find("weight"), mass = object.find("mass");
  if (weight && mass) mass->fail("is given as well as weight, must be one of them");
  if constexpr (Dim == 3)
    if (const auto density = object.find("density")) {
      if (weight || mass)
        density->fail("is given as well as " + std::string(weight ? "weight" : "mass") +
                      ", must be one of them");
      if (const std::string why = without_volume<3>(shape); !why.empty())
        density->fail("needs a volume, but " + why + ": give weight or mass");
      return density->above_zero() * volume(*shape) * standard_gravity;
    }
  return mass ? mass->at_least_zero() * standard_gravity : weight->number();
}

/// What loads take from the object where they do not say it themselves.
template <int Dim>
struct Body {
  std::optional<double> weight{};  ///< [N]
  std::optional<Vector<Dim>> com{};
};

template <int Dim>
std::optional<double> find_weight(const Field& field, const std::optional<ShapeOf<Dim>>& shape) {
  if (!field.find("weight") && !field.find("mass") && !field.find("density")) return {};
  return read_weight<Dim>(field, shape);
}

/// As far as it is said; the com may be the shape's centroid.
template <int Dim>
Body<Dim> read_body(const Field& field, double unit, const std::optional<ShapeOf<Dim>>& shape) {
  Body<Dim> body;
  if constexpr (Dim == 3)
    if (const auto inertial = field.find("inertial")) {
      for (const char* key : {"weight", "mass", "density", "com"})
        if (const auto other = field.find(key))
          other->fail("is given as well as inertial, must be one of them");
      const Inertial link = read_inertial(*inertial);
      body = {link.mass * standard_gravity, link.com};
    }
  if (!body.weight) body.weight = find_weight<Dim>(field, shape);
  if (body.weight && (!(*body.weight >= 0) || !std::isfinite(*body.weight * *body.weight)))
    throw FileError(field.file(), field.follow("weight").place(), field.path() + ".weight",
                    "is " + number_text(*body.weight) + ", must be at least 0");
  if (const auto com = field.find("com")) body.com = unit * com->template vector<Dim>();
  return body;
}

/// The body of an entry, or of the object where there are no entries, with what the object says.
template <int Dim>
Load<Dim> complete(const Field& field, const Body<Dim>& body, const Body<Dim>& object,
                   const std::optional<ShapeOf<Dim>>& shape) {
  Load<Dim> load;
  if (const auto weight = body.weight ? body.weight : object.weight)
    load.weight = *weight;
  else
    field.get("weight", "a force [N], or give mass [kg]");
  const std::string why = without_volume<Dim>(shape);
  if (const auto com = body.com ? body.com : object.com)
    load.com = *com;
  else if (why.empty())
    load.com = centroid(*shape);
  else
    field.get("com", std::string(coordinates<Dim>) + ", as " + why);
  return load;
}

/// The vertices of a regular polygon of 16 corners around the unit circle: 1.97 % outside of it at
/// most.
std::vector<Vector<2>> around_ball(Vector<2>) {
  constexpr int corners = 16;
  constexpr double step = 2 * std::numbers::pi / corners;
  std::vector<Vector<2>> vertices;
  for (int k = 0; k < corners; ++k)
    vertices.push_back(Vector<2>(std::cos(k * step), std::sin(k * step)) / std::cos(step / 2));
  return vertices;
}

/// Those of a dodecahedron and of an icosahedron together, which are 32: the polytope that they
/// span lies around the unit ball, 8.39 % outside of it at most.
std::vector<Vector<3>> around_ball(Vector<3>) {
  constexpr double outside = 1.0838907667, golden = std::numbers::phi;
  std::vector<Vector<3>> vertices;
  const auto add = [&](double x, double y, double z) {
    vertices.push_back(outside * Vector<3>(x, y, z).normalized());
  };
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      for (const double c : {-1.0, 1.0}) add(a, b, c);
      add(a / golden, 0, b * golden);
      add(0, a * golden, b / golden);
      add(a * golden, b / golden, 0);
      add(0, a, b * golden);
      add(a, b * golden, 0);
      add(b * golden, 0, a);
    }
  return vertices;
}

/// Reads the accelerations of an entry. Returns the one in any direction [m/s2], or 0.
template <int Dim>
double read_acceleration(const Field& field, Load<Dim>& load) {
  if (field.is_list()) {
    load.acceleration = field.vector<Dim>();
    return 0;
  }
  field.mapping({"up", "any", "fixed"});
  const auto up = field.find("up"), any = field.find("any"), fixed = field.find("fixed");
  if (!up && !any && !fixed)
    field.fail("is empty, must have up, any or fixed [m/s2], or be " +
               std::string(coordinates<Dim>));
  if (up) load.lift = up->number();
  if (fixed) load.acceleration = fixed->vector<Dim>();
  return any ? any->above_zero() : 0;
}

/// What a force on the object and a moment ask of the contacts.
template <int Dim>
Wrench<Dim> read_wrench(const Field& entry, double unit) {
  Vector<Dim> force = Vector<Dim>::Zero(), at = Vector<Dim>::Zero();
  const auto given = entry.find("force"), point = entry.find("at");
  if (given) force = given->template vector<Dim>();
  if (point && !given) point->fail("is given without a force, must be left out");
  if (point) at = unit * point->template vector<Dim>();
  Wrench<Dim> wrench = wrench_of<Dim>(force, at);
  if (const auto moment = entry.find("moment")) {
    if constexpr (Dim == 2)
      wrench[2] += moment->number();
    else
      wrench.template tail<3>() += moment->template vector<3>();
  }
  return -wrench;
}

template <int Dim>
void add_entry(const Field& entry, double unit, const std::optional<ShapeOf<Dim>>& shape,
               const Body<Dim>& object, std::vector<Load<Dim>>& loads) {
  Keys keys{"name", "weight", "mass", "com", "acceleration", "force", "moment", "at"};
  if (Dim == 3) keys.insert(keys.end(), {"density", "inertial"});
  entry.mapping(keys);
  Load<Dim> load = complete<Dim>(entry, read_body<Dim>(entry, unit, shape), object, shape);
  if (const auto name = entry.find("name")) load.name = name->text();
  load.fixed = read_wrench<Dim>(entry, unit);
  double any = 0;
  if (const auto field = entry.find("acceleration")) any = read_acceleration<Dim>(*field, load);
  if (any == 0) return loads.push_back(load);
  if (load.weight == 0)
    entry.get("acceleration", "").fail("is of an object without mass, must be left out");
  const Load<Dim> given = load;
  std::size_t k = 0;
  for (const Vector<Dim>& vertex : around_ball(Vector<Dim>())) {
    load.acceleration = given.acceleration + any * vertex;
    load.name = (given.name.empty() ? "any" : given.name) + " " + std::to_string(++k);
    loads.push_back(load);
  }
}

}  // namespace

template <int Dim>
std::vector<std::string> load_paths(const Field& root) {
  const auto list = root.find("loads");
  if (!list) return {"object"};
  std::vector<std::string> paths;
  for (const Field& entry : list->list()) {
    const Field acceleration = entry.follow("acceleration");
    const bool is_any = acceleration.path() != entry.path() && !acceleration.is_list() &&
                        acceleration.find("any").has_value();
    paths.insert(paths.end(), is_any ? around_ball(Vector<Dim>()).size() : 1, entry.path());
  }
  return paths;
}

template <int Dim>
std::vector<Load<Dim>> read_loads(const Field& root, const Field& object, double unit,
                                  const std::optional<ShapeOf<Dim>>& shape) {
  const Body<Dim> own = read_body<Dim>(object, unit, shape);
  const auto list = root.find("loads");
  if (!list) return {complete<Dim>(object, own, {}, shape)};
  std::vector<Load<Dim>> loads;
  for (const Field& entry : list->list()) {
    add_entry(entry, unit, shape, own, loads);
    if (loads.size() > most_loads)
      list->fail("has more than " + std::to_string(most_loads) +
                 " loads, an acceleration in any direction counted as " +
                 std::to_string(around_ball(Vector<Dim>()).size()) + ": must have fewer");
  }
  if (loads.empty()) list->fail("is empty, must hold at least one load");
  return loads;
}

template std::vector<std::string> load_paths<2>(const Field&);
template std::vector<std::string> load_paths<3>(const Field&);
template std::vector<Load<2>> read_loads(const Field&, const Field&, double,
                                         const std::optional<Shape>&);
template std::vector<Load<3>> read_loads(const Field&, const Field&, double,
                                         const std::optional<Solid>&);

}  // namespace poise
