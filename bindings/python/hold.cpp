#include "poise/hold.hpp"

#include "module.hpp"
#include "parallel.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

using Ups = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// Holds in many postures, their numbers also as arrays.
struct Holds {
  std::size_t contacts;
  std::vector<Hold<2>> list;

  const Hold<2>& at(py::ssize_t index) const {
    const auto size = static_cast<py::ssize_t>(list.size());
    if (index < -size || index >= size) throw py::index_error("no such hold");
    return list[static_cast<std::size_t>(index < 0 ? index + size : index)];
  }
  /// One number of each hold.
  template <class T, class Get>
  py::array_t<T> numbers(Get get) const {
    py::array_t<T> result(static_cast<py::ssize_t>(list.size()));
    std::transform(list.begin(), list.end(), result.mutable_data(), get);
    return result;
  }
  /// One number of each force, a row for each hold; 0 where unholdable.
  py::array_t<double> table(double ContactForce<2>::*number) const {
    py::array_t<double> result({list.size(), contacts});
    double* out = result.mutable_data();
    for (const Hold<2>& hold : list)
      for (std::size_t i = 0; i < contacts; ++i)
        *out++ = hold.holdable ? hold.forces[i].*number : 0;
    return result;
  }
};

Hold<2> hold_posture(const Grasp<2>& grasp, const Vector<2>& up, double force_cap) {
  return hold<2>(grasp, unit(up), {.force_cap = checked_cap(force_cap)});
}

Hold<2> hold_load(const Grasp<2>& grasp, const Wrench<2>& load, const Twist<2>& y,
                  double force_cap) {
  if (!load.allFinite()) throw InvalidGrasp("load", "must be finite");
  if (!y.allFinite()) throw InvalidGrasp("y", "must be finite");
  return hold<2>(grasp, load, y, {.force_cap = checked_cap(force_cap)});
}

Holds hold_many(const Grasp<2>& grasp, const Ups& ups, double force_cap) {
  const HoldSettings settings{.force_cap = checked_cap(force_cap)};
  std::vector<Vector<2>> units;
  units.reserve(static_cast<std::size_t>(ups.rows()));
  for (Eigen::Index k = 0; k < ups.rows(); ++k)
    units.push_back(unit<2>(ups.row(k).transpose(), "ups[" + std::to_string(k) + "]"));
  Holds holds{grasp.contacts().size(), std::vector<Hold<2>>(units.size())};
  parallel(units.size(), 256,
           [&](std::size_t k) { holds.list[k] = hold<2>(grasp, units[k], settings); });
  return holds;
}

/// Forces of another grasp make no sense.
void check(const Grasp<2>& grasp, const Hold<2>& hold) {
  if (hold.holdable && hold.forces.size() != grasp.contacts().size())
    throw InvalidGrasp("hold", "is of another grasp");
}

void add_types(py::module_& module) {
  py::class_<ContactForce<2>>(module, "ContactForce",
                              "The force of a finger on the object at one contact, in the contact "
                              "frame.")
      .def_readonly("normal", &ContactForce<2>::normal, "Along the inward normal [N], >= 0.")
      .def_readonly("tangential", &ContactForce<2>::tangential,
                    "Along the normal turned by +90 degrees [N].")
      .def_readonly("friction_used", &ContactForce<2>::friction_used,
                    "tangential / (friction * normal), 0 to 1; 1 for a loaded frictionless "
                    "contact,\n0 for an unloaded one.")
      .def_readonly("state", &ContactForce<2>::state)
      .def_readonly("limit", &ContactForce<2>::limit)
      .def("__repr__", [](const ContactForce<2>& force) {
        return py::str("ContactForce(normal={:.6g} N, tangential={:.6g} N, {})")
            .format(force.normal, force.tangential, to_string(force.state));
      });

  py::class_<FingerForce<2>>(module, "FingerForce", "What one finger does with all its contacts.")
      .def_readonly("normal", &FingerForce<2>::normal, "Sum of the normal forces [N].")
      .def_readonly("force", &FingerForce<2>::force, "On the object, in the object frame (2,) [N].")
      .def("__repr__", [](const FingerForce<2>& finger) {
        return py::str("FingerForce(normal={:.6g} N, force=[{:.6g}, {:.6g}] N)")
            .format(finger.normal, finger.force.x(), finger.force.y());
      });

  py::class_<Hold<2>>(module, "Hold",
                      "The least contact forces in one posture, or the proof that the object "
                      "cannot be held.")
      .def_readonly("holdable", &Hold<2>::holdable)
      .def_readonly("proven", &Hold<2>::proven,
                    "Where unholdable: whether lower_bound is above the cap. Within rounding of "
                    "the limit\nof holding there may be neither forces nor a proof.")
      .def_readonly("effort", &Hold<2>::effort,
                    "V = sum |f_i|^2 / share_i [N^2]; 0 where unholdable.")
      .def_readonly("dual", &Hold<2>::dual,
                    "Optimal dual y, a twist about the object frame's origin (3,) [N, N, N/m].\n"
                    "Proof: V >= lower_bound = 2 (y . w - phi(G^T y)) for every force that "
                    "balances w.")
      .def_readonly("lower_bound", &Hold<2>::lower_bound, "On the effort, by dual [N^2].")
      .def_readonly("residual", &Hold<2>::residual,
                    "Balance error: the larger of force / W and moment / (W L).")
      .def_property_readonly(
          "forces",
          [](const Hold<2>& hold) {
            return std::vector<ContactForce<2>>(hold.forces.begin(), hold.forces.end());
          },
          "A ContactForce for each contact; empty where unholdable.")
      .def("__repr__", [](const Hold<2>& hold) {
        if (!hold.holdable) return py::str("Hold(unholdable)");
        return py::str("Hold(effort={:.6g} N^2, forces={})").format(hold.effort, [&] {
          py::list list;
          for (const ContactForce<2>& force : hold.forces) list.append(force);
          return list;
        }());
      });

  py::class_<Holds>(module, "Holds",
                    "The holds of hold_many, in order: a sequence of k Hold, its numbers also as "
                    "arrays.")
      .def("__len__", [](const Holds& holds) { return holds.list.size(); })
      .def(
          "__iter__",
          [](const Holds& holds) {
            return py::make_iterator(holds.list.begin(), holds.list.end());
          },
          py::keep_alive<0, 1>())
      .def("__getitem__", &Holds::at, py::arg("index"), py::return_value_policy::reference_internal)
      .def_property_readonly(
          "holdable",
          [](const Holds& holds) {
            return holds.numbers<bool>([](const Hold<2>& hold) { return hold.holdable; });
          },
          "(k,) bool")
      .def_property_readonly(
          "effort",
          [](const Holds& holds) {
            return holds.numbers<double>([](const Hold<2>& hold) {
              return hold.holdable ? hold.effort : std::numeric_limits<double>::infinity();
            });
          },
          "(k,) [N^2]; inf where unholdable")
      .def_property_readonly(
          "lower_bound",
          [](const Holds& holds) {
            return holds.numbers<double>([](const Hold<2>& hold) { return hold.lower_bound; });
          },
          "(k,) [N^2]")
      .def_property_readonly(
          "normal", [](const Holds& holds) { return holds.table(&ContactForce<2>::normal); },
          "(k, n) for n contacts [N]; 0 where unholdable")
      .def_property_readonly(
          "tangential",
          [](const Holds& holds) { return holds.table(&ContactForce<2>::tangential); },
          "(k, n) for n contacts [N]; 0 where unholdable")
      .def("__repr__", [](const Holds& holds) {
        const auto held = std::count_if(holds.list.begin(), holds.list.end(),
                                        [](const Hold<2>& hold) { return hold.holdable; });
        return py::str("Holds({} postures, {} holdable)").format(holds.list.size(), held);
      });
}

}  // namespace

void add_hold(py::module_& module) {
  add_types(module);
  const py::call_guard<py::gil_scoped_release> unlocked;

  module.def("hold", &hold_posture, py::arg("grasp"), py::arg("up"), py::kw_only(),
             py::arg("force_cap") = 1e6, unlocked,
             "The hold of least effort in the posture up (2,), the direction against gravity in "
             "the\nobject frame, of any length. A load that needs a force norm above force_cap "
             "[weights]\nis unholdable.");
  module.def("hold", &hold_load, py::arg("grasp"), py::arg("load"), py::arg("y"), py::kw_only(),
             py::arg("force_cap") = 1e6, unlocked,
             "The same for any load (3,) [N, N, N m], about the object frame's origin, started at "
             "a\ntwist y (3,) [N, N, N/m] that was optimal for a load nearby.");
  module.def("hold_many", &hold_many, py::arg("grasp"), py::arg("ups"), py::kw_only(),
             py::arg("force_cap") = 1e6, unlocked,
             "The holds in many postures ups (k, 2), in their order, on all cores.");
  module.def(
      "finger_forces",
      [](const Grasp<2>& grasp, const Hold<2>& hold) {
        check(grasp, hold);
        return finger_forces(grasp, hold);
      },
      py::arg("grasp"), py::arg("hold"),
      "A FingerForce for each of grasp.fingers. Empty where unholdable.");
  module.def(
      "grip_force",
      [](const Grasp<2>& grasp, const Hold<2>& hold) {
        check(grasp, hold);
        return grip_force(grasp, hold);
      },
      py::arg("grasp"), py::arg("hold"),
      "How hard the hardest pressing finger presses: the largest normal force of a finger [N].");
  module.def(
      "all_loaded",
      [](const Grasp<2>& grasp, const Hold<2>& hold) {
        check(grasp, hold);
        return all_loaded(grasp, hold);
      },
      py::arg("grasp"), py::arg("hold"),
      "Whether every finger's normal force is above 1e-9 of the weight.");
  module.def(
      "manner",
      [](const Grasp<2>& grasp, const Vector<2>& up, const Hold<2>& hold) {
        check(grasp, hold);
        return manner(grasp, unit(up), hold);
      },
      py::arg("grasp"), py::arg("up"), py::arg("hold"),
      "How the object is held in the posture up (2,) by these forces.");
  module.def(
      "reason",
      [](const Grasp<2>& grasp, const Hold<2>& hold) {
        check(grasp, hold);
        return reason(grasp, hold);
      },
      py::arg("grasp"), py::arg("hold"),
      "Why an unholdable load cannot be held, in words: the motion that it drives and no contact\n"
      "opposes.");
}

}  // namespace poise::python
