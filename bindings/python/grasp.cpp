#include "poise/grasp.hpp"

#include "files/grasp_document.hpp"
#include "files/grasp_writer.hpp"
#include "files/mechanism_field.hpp"
#include "module.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

/// What `drives` and `fingers` of a grasp file would say.
template <int Dim>
Mechanism<Dim> read_mechanism(const py::object& drives, const py::object& fingers,
                              const std::vector<Contact<Dim>>& contacts) {
  py::dict keys;
  if (!drives.is_none()) keys["drives"] = drives;
  if (!fingers.is_none()) keys["fingers"] = fingers;
  if (keys.empty()) return {};
  const py::object json = py::module_::import("json");
  const py::object plain = py::module_::import("poise._files").attr("_plain");
  const std::string text = py::str(json.attr("dumps")(keys, py::arg("default") = plain));
  try {
    const Document document = parse_json(text, "");
    return poise::read_mechanism<Dim>(Field(document), 1, contacts);
  } catch (const FileError& error) {
    throw InvalidGrasp(error.path(), error.problem());
  }
}

/// The same the other way round: (drives, fingers), None where there is nothing to say.
py::tuple write_mechanism(const auto& mechanism) {
  const py::dict keys = py::module_::import("json").attr("loads")(mechanism_document(mechanism));
  return py::make_tuple(keys.attr("get")("drives"), keys.attr("get")("fingers"));
}

GraspPointer make_grasp(const py::object& loads, const py::iterable& contacts, double safety,
                        const py::object& drives, const py::object& fingers) {
  const py::list list(contacts);
  if (list.empty()) throw InvalidGrasp("contacts", "is empty, must hold at least one contact");
  const bool space = list[0].attr("position").cast<Eigen::VectorXd>().size() == 3;
  const auto make = [&]<int Dim>(std::integral_constant<int, Dim>) {
    std::vector<Contact<Dim>> all = read_contacts<Dim>(list);
    Mechanism<Dim> mechanism = read_mechanism<Dim>(drives, fingers, all);
    return std::make_shared<AnyGrasp>(
        AnyGrasp{Grasp<Dim>(read_loads<Dim>(loads), std::move(all), safety, std::move(mechanism))});
  };
  return space ? make(std::integral_constant<int, 3>()) : make(std::integral_constant<int, 2>());
}

std::size_t finger_of(const AnyGrasp& any, std::size_t contact) {
  return std::visit(
      [&](const auto& grasp) {
        if (contact >= grasp.contacts().size()) throw py::index_error("no such contact");
        return grasp.finger_of(contact);
      },
      any.of);
}

Eigen::VectorXd load(const AnyGrasp& any, const Eigen::VectorXd& up,
                     std::optional<std::size_t> index) {
  return std::visit(
      [&]<int Dim>(const Grasp<Dim>& grasp) -> Eigen::VectorXd {
        return load_of(grasp, index).at(unit<Dim>(up));
      },
      any.of);
}

/// "load of 10 N", or "2 loads up to 10 N".
std::string shown_loads(std::size_t count, double size) {
  if (count == 1) return py::str("load of {:g} N").format(size);
  return py::str("{} loads up to {:g} N").format(count, size);
}

}  // namespace

void add_grasp(py::module_& module) {
  py::class_<AnyGrasp, GraspPointer>(
      module, "Grasp",
      "Contacts and what they must hold, checked and prepared. Immutable. In the plane or in "
      "space,\n"
      "as the positions of the contacts have two or three numbers.\n\n"
      "loads: a Load, or a list of them, of which each must be held, with forces of its own\n"
      "safety: every friction and torsion is divided by it, >= 1\n"
      "drives, fingers: as in a grasp file, in SI units: \"each\", \"coupled\" or a list of "
      "drives;\n"
      "{label: {\"closing\": direction, \"max_force\": N}}\n"
      "Raises InvalidGrasp where a number is not finite or out of its range, a normal has no\n"
      "length, or there are no contacts or no loads.")
      .def(py::init(&make_grasp), py::arg("loads"), py::arg("contacts"), py::arg("safety") = 1.0,
           py::arg("drives") = py::none(), py::arg("fingers") = py::none())
      .def_property_readonly("mechanism", each<AnyGrasp>([](const auto& grasp) {
                               return write_mechanism(grasp.mechanism());
                             }),
                             "(drives, fingers) as they were given; None where nothing was.")
      .def_property_readonly("dimension",
                             each<AnyGrasp>([]<int Dim>(const Grasp<Dim>&) { return Dim; }),
                             "2: the plane, 3: space")
      .def_property_readonly("loads",
                             each<AnyGrasp>([](const auto& grasp) { return write(grasp.loads()); }),
                             "A list, also of one Load.")
      .def_property_readonly(
          "contacts", each<AnyGrasp>([](const auto& grasp) { return write(grasp.contacts()); }),
          "The contacts with unit normals, friction and torsion already divided by the safety\n"
          "factor, fingers named.")
      .def_property_readonly("fingers",
                             each<AnyGrasp>([](const auto& grasp) { return grasp.fingers(); }),
                             "The fingers' labels in the order of their first contact.")
      .def("finger_of", &finger_of, py::arg("contact"), "Index into fingers of a contact.")
      .def_property_readonly(
          "radius", each<AnyGrasp>([](const auto& grasp) { return grasp.radius(); }),
          "L [m], the distance of the farthest contact, or point of a pad, from the centre of mass "
          "of the\nfirst load.")
      .def("load", &load, py::arg("up"), py::arg("load") = py::none(),
           "The wrench that the contacts must supply in the posture up (2,) or (3,), about the "
           "object\nframe's origin: (3,) or (6,), force [N], moment [N m].\n\n"
           "load: an index into loads, which may be left out where there is one")
      .def(py::pickle(each<AnyGrasp>([](const auto& grasp) {
                        const py::tuple mechanism = write_mechanism(grasp.mechanism());
                        return py::make_tuple(write(grasp.loads()), write(given_contacts(grasp)),
                                              mechanism[0], mechanism[1]);
                      }),
                      [](const py::tuple& state) {
                        return make_grasp(state[0], state[1], 1, state[2], state[3]);
                      }))
      .def("__repr__", each<AnyGrasp>([](const auto& grasp) {
             return py::str("Grasp({}, {} contacts, fingers={})")
                 .format(shown_loads(grasp.loads().size(), grasp.size()), grasp.contacts().size(),
                         grasp.fingers());
           }));

  module.def(
      "grasp_matrix",
      each<AnyGrasp>([](const auto& grasp) -> Eigen::MatrixXd { return grasp_matrix(grasp); }),
      py::arg("grasp"),
      "G: stacked contact forces to the wrench on the object about the object frame's origin.\n"
      "In the plane (3, 2 n) for n contacts: normal, tangential, contact by contact. In space\n"
      "(6, 4 n): forces along the normal and along tangents(normal) [N], and the moment about the\n"
      "normal [N m].");
  module.def(
      "wrench_of",
      [](const Eigen::VectorXd& force, const Eigen::VectorXd& at) -> Eigen::VectorXd {
        if (force.size() == 2) return wrench_of<2>(force, sized<2>(at, "at"));
        return wrench_of<3>(sized<3>(force, "force"), sized<3>(at, "at"));
      },
      py::arg("force"), py::arg("at"),
      "The wrench (3,) or (6,) of a force (2,) or (3,) at a point, about the object frame's "
      "origin\n[N, N m].");
  module.def("force_closure",
             each<AnyGrasp>([](const auto& grasp) { return force_closure(grasp); }),
             py::arg("grasp"),
             "Whether the contacts, without force limits, can balance any wrench at all.");
  module.def("up_at", &up_at, py::arg("theta"),
             "The planar posture (sin theta, cos theta), shape (2,): the direction against gravity "
             "in\nthe object frame, when the object is turned counter-clockwise by theta [rad].");
  module.def("angle_of", &angle_of, py::arg("up"),
             "The theta [rad], in (-pi, pi], of a planar posture (2,).");
  module.def(
      "rectangular_pad",
      [](const Eigen::VectorXd& size, const Eigen::VectorXd& axis, const Eigen::VectorXd& normal,
         int grid) {
        if (grid < 1 || grid > 64) throw InvalidGrasp("grid", "must be from 1 to 64");
        return write(std::optional(rectangular_pad(sized<2>(size, "size"), unit<3>(axis, "axis"),
                                                   unit<3>(normal, "normal"), grid)));
      },
      py::arg("size"), py::arg("axis"), py::arg("normal"), py::arg("grid") = 4,
      "A rectangle around the contact's position, size (2,) along the axis and across it [m], "
      "with\n"
      "even pressure: grid x grid equal cells, a point in the middle of each. normal: of the "
      "contact;\n"
      "the axis is turned into the plane across it.");
  module.def(
      "tangents", [](const Eigen::VectorXd& normal) { return tangents(unit<3>(normal, "normal")); },
      py::arg("normal"),
      "Two unit vectors a, b in the columns (3, 2) that make (normal, a, b) a right-handed frame;\n"
      "normal (3,) of any length but 0.");
}

}  // namespace poise::python
