#include "poise/grasp.hpp"

#include "module.hpp"
#include "values.hpp"

namespace poise::python {

void add_grasp(py::module_& module) {
  py::class_<Grasp<2>, std::shared_ptr<Grasp<2>>>(
      module, "Grasp",
      "An object and its contacts, checked and prepared. Immutable.\n\n"
      "safety: every friction is divided by it, >= 1\n"
      "Raises InvalidGrasp where a number is not finite or out of its range, a normal has no\n"
      "length, or there are no contacts.")
      .def(py::init([](const py::object& object, const py::iterable& contacts, double safety) {
             return std::make_shared<Grasp<2>>(read_object<2>(object), read_contacts<2>(contacts),
                                               safety);
           }),
           py::arg("object"), py::arg("contacts"), py::arg("safety") = 1.0)
      .def_property_readonly(
          "dimension", [](const Grasp<2>&) { return 2; }, "2: the plane")
      .def_property_readonly(
          "object", [](const Grasp<2>& grasp) { return write(grasp.object()); }, "Object")
      .def_property_readonly(
          "contacts", [](const Grasp<2>& grasp) { return write(grasp.contacts()); },
          "The contacts with unit normals, friction already divided by the safety factor, fingers\n"
          "named.")
      .def_property_readonly("fingers", &Grasp<2>::fingers,
                             "The fingers' labels in the order of their first contact.")
      .def(
          "finger_of",
          [](const Grasp<2>& grasp, std::size_t contact) {
            if (contact >= grasp.contacts().size()) throw py::index_error("no such contact");
            return grasp.finger_of(contact);
          },
          py::arg("contact"), "Index into fingers of a contact.")
      .def_property_readonly("radius", &Grasp<2>::radius,
                             "L [m], the distance of the farthest contact from the centre of mass.")
      .def(
          "load", [](const Grasp<2>& grasp, const Vector<2>& up) { return grasp.load(unit(up)); },
          py::arg("up"),
          "The wrench that the contacts must supply in the posture up (2,): weight * up through\n"
          "the centre of mass, about the origin. (3,): force [N], moment [N m]")
      .def("__repr__", [](const Grasp<2>& grasp) {
        return py::str("Grasp(weight={:g} N, {} contacts, fingers={})")
            .format(grasp.object().weight, grasp.contacts().size(), grasp.fingers());
      });

  module.def("grasp_matrix", &grasp_matrix<2>, py::arg("grasp"),
             "G: stacked contact forces (normal, tangential; contact by contact) to the wrench on\n"
             "the object about the object frame's origin. (3, 2 n) for n contacts");
  module.def("force_closure", &force_closure<2>, py::arg("grasp"),
             "Whether the contacts, without force limits, can balance any wrench at all.");
  module.def("up_at", &up_at, py::arg("theta"),
             "The planar posture (sin theta, cos theta), shape (2,): the direction against gravity "
             "in\nthe object frame, when the object is turned counter-clockwise by theta [rad].");
  module.def("angle_of", &angle_of, py::arg("up"),
             "The theta [rad], in (-pi, pi], of a planar posture (2,).");
}

}  // namespace poise::python
