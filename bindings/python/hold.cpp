#include "poise/hold.hpp"

#include "module.hpp"
#include "parallel.hpp"
#include "poise/grip.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

using Ups = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using AnyForce = Either<ContactForce>;
using AnyFinger = Either<FingerForce>;

/// Holds in many postures, their numbers also as arrays.
template <int Dim>
struct Holds {
  std::size_t contacts;
  std::vector<Hold<Dim>> list;
};
using AnyHolds = Either<Holds>;

AnyHold hold_at(const AnyHolds& any, py::ssize_t index) {
  return std::visit(
      [&](const auto& holds) {
        const auto size = static_cast<py::ssize_t>(holds.list.size());
        if (index < -size || index >= size) throw py::index_error("no such hold");
        return AnyHold{holds.list[static_cast<std::size_t>(index < 0 ? index + size : index)]};
      },
      any.of);
}

/// One number of each hold.
template <class T, class Get>
auto numbers(Get get) {
  return each<AnyHolds>([get](const auto& holds) {
    py::array_t<T> result(static_cast<py::ssize_t>(holds.list.size()));
    std::transform(holds.list.begin(), holds.list.end(), result.mutable_data(), get);
    return result;
  });
}

/// Numbers of each force, a row for each hold; 0 where unholdable.
template <int Dim, class Get>
py::array_t<double> table(const Holds<Dim>& holds, std::size_t width, Get get) {
  std::vector<std::size_t> shape{holds.list.size(), holds.contacts};
  if (width > 1) shape.push_back(width);
  py::array_t<double> result(shape);
  double* out = result.mutable_data();
  for (const Hold<Dim>& hold : holds.list)
    for (std::size_t i = 0; i < holds.contacts; ++i, out += width)
      if (hold.holdable)
        get(hold.forces[i], out);
      else
        std::fill_n(out, width, 0);
  return result;
}

py::array_t<double> normals(const AnyHolds& any) {
  return std::visit(
      [](const auto& holds) {
        return table(holds, 1, [](const auto& force, double* out) { *out = force.normal; });
      },
      any.of);
}

py::array_t<double> tangentials(const AnyHolds& any) {
  if (const auto* const planar = std::get_if<Holds<2>>(&any.of))
    return table(*planar, 1, [](const auto& force, double* out) { *out = force.tangential; });
  return table(std::get<Holds<3>>(any.of), 3, [](const auto& force, double* out) {
    Eigen::Map<Vector<3>>{out} = force.tangential;
  });
}

double torsion_moment(const ContactForce<2>&) { return 0; }
double torsion_moment(const ContactForce<3>& force) { return force.torsion_moment; }

py::array_t<double> torsion_moments(const AnyHolds& any) {
  return std::visit(
      [](const auto& holds) {
        return table(holds, 1,
                     [](const auto& force, double* out) { *out = torsion_moment(force); });
      },
      any.of);
}

AnyHold hold_posture(const AnyGrasp& any, const Eigen::VectorXd& up, double force_cap,
                     Objective objective) {
  const HoldSettings settings{.force_cap = checked_cap(force_cap), .objective = objective};
  return std::visit(
      [&]<int Dim>(const Grasp<Dim>& grasp) {
        return AnyHold{hold<Dim>(grasp, unit<Dim>(up), settings)};
      },
      any.of);
}

AnyHold hold_load(const AnyGrasp& any, const Eigen::VectorXd& load, const Eigen::VectorXd& y,
                  double force_cap, Objective objective) {
  if (!load.allFinite()) throw InvalidGrasp("load", "must be finite");
  if (!y.allFinite()) throw InvalidGrasp("y", "must be finite");
  const HoldSettings settings{.force_cap = checked_cap(force_cap), .objective = objective};
  return std::visit(
      [&]<int Dim>(const Grasp<Dim>& grasp) {
        constexpr int size = wrench_size<Dim>;
        return AnyHold{hold<Dim>(grasp, sized<size>(load, "load"), grasp.size(),
                                 sized<size>(y, "y"), settings)};
      },
      any.of);
}

AnyHolds hold_many(const AnyGrasp& any, const Ups& ups, double force_cap, Objective objective) {
  const HoldSettings settings{.force_cap = checked_cap(force_cap), .objective = objective};
  return std::visit(
      [&]<int Dim>(const Grasp<Dim>& grasp) {
        std::vector<Vector<Dim>> units;
        units.reserve(static_cast<std::size_t>(ups.rows()));
        for (Eigen::Index k = 0; k < ups.rows(); ++k)
          units.push_back(unit<Dim>(ups.row(k).transpose(), "ups[" + std::to_string(k) + "]"));
        Holds<Dim> holds{grasp.contacts().size(), std::vector<Hold<Dim>>(units.size())};
        parallel(units.size(), 256,
                 [&](std::size_t k) { holds.list[k] = hold<Dim>(grasp, units[k], settings); });
        return AnyHolds{std::move(holds)};
      },
      any.of);
}

std::vector<AnyFinger> fingers(const AnyGrasp& any, const AnyHold& hold) {
  return each(any, hold, [](const auto& grasp, const auto& own) {
    std::vector<AnyFinger> list;
    for (const auto& finger : finger_forces(grasp, own)) list.push_back({finger});
    return list;
  });
}

Manner manner_of(const AnyGrasp& any, const Eigen::VectorXd& up, const AnyHold& hold,
                 std::optional<std::size_t> load) {
  return each(any, hold, [&]<int Dim>(const Grasp<Dim>& grasp, const Hold<Dim>& own) {
    return manner(grasp, load_of(grasp, load), unit<Dim>(up), own);
  });
}

std::vector<AnyForce> forces(const AnyHold& any) {
  return std::visit(
      [](const auto& hold) {
        std::vector<AnyForce> list;
        for (const auto& force : hold.forces) list.push_back({force});
        return list;
      },
      any.of);
}

void add_forces(py::module_& module) {
  Class<AnyForce>(module, "ContactForce")
      .either("normal", [](const auto& force) { return force.normal; })
      .either(
          "tangential", [](const auto& force) { return py::cast(force.tangential); },
          "In the plane along the normal turned by +90 degrees [N]; in space (3,), tangent to the\n"
          "contact, object frame [N].")
      .either(
          "torsion_moment", [](const auto& force) { return torsion_moment(force); },
          "Of a soft finger, about the inward normal [N m]; 0 in the plane.")
      .either(
          "friction_used", [](const auto& force) { return force.friction_used; },
          "tangential / (friction * normal), 0 to 1; 1 for a loaded frictionless contact,\n"
          "0 for an unloaded one. Of a soft finger the same with the moment: sqrt(|tangential|^2 "
          "+\n"
          "(torsion_moment friction / torsion)^2) / (friction * normal).")
      .either("state", [](const auto& force) { return force.state; })
      .either("limit", [](const auto& force) { return force.limit; })
      .def("__repr__", each<AnyForce>([](const auto& force) {
             std::string tangential;
             if constexpr (std::is_same_v<decltype(force.tangential), double>)
               tangential = py::str("{:.6g}").format(force.tangential);
             else
               tangential = shown(force.tangential);
             return py::str("ContactForce(normal={:.6g} N, tangential={} N, {})")
                 .format(force.normal, tangential, to_string(force.state));
           }));

  Class<AnyFinger>(module, "FingerForce")
      .either("normal", [](const auto& finger) { return finger.normal; })
      .either("force", [](const auto& finger) -> Eigen::VectorXd { return finger.force; })
      .def("__repr__", each<AnyFinger>([](const auto& finger) {
             return py::str("FingerForce(normal={:.6g} N, force={} N)")
                 .format(finger.normal, shown(finger.force));
           }));
}

void add_holds(py::module_& module) {
  Class<AnyHold>(module, "Hold")
      .either("holdable", [](const auto& hold) { return hold.holdable; })
      .either("proven", [](const auto& hold) { return hold.proven; })
      .either("effort", [](const auto& hold) { return hold.effort; })
      .either("dual", [](const auto& hold) -> Eigen::VectorXd { return hold.dual; })
      .either("lower_bound", [](const auto& hold) { return hold.lower_bound; })
      .either("residual", [](const auto& hold) { return hold.residual; })
      .either("objective", [](const auto& hold) { return hold.objective; })
      .either("grip", [](const auto& hold) { return hold.grip; })
      .either("rates",
              [](const auto& hold) -> Eigen::VectorXd {
                return Eigen::Map<const Eigen::VectorXd>(
                    hold.rates.data(), static_cast<Eigen::Index>(hold.rates.size()));
              })
      .attribute("forces", &forces)
      .def("__repr__", [](const AnyHold& any) {
        return std::visit(
            [&](const auto& hold) {
              if (!hold.holdable) return py::str("Hold(unholdable)");
              return py::str("Hold(effort={:.6g} N^2, forces={})").format(hold.effort, forces(any));
            },
            any.of);
      });

  Class<AnyHolds>(module, "Holds",
                  "The holds of hold_many, in order: a sequence of k Hold, its numbers also "
                  "as arrays.")
      .attribute("holdable", numbers<bool>([](const auto& hold) { return hold.holdable; }),
                 "(k,) bool")
      .attribute("effort", numbers<double>([](const auto& hold) {
                   return hold.holdable ? hold.effort : std::numeric_limits<double>::infinity();
                 }),
                 "(k,) [N^2]; inf where unholdable")
      .attribute("lower_bound", numbers<double>([](const auto& hold) { return hold.lower_bound; }),
                 "(k,) [N^2]")
      .attribute("normal", &normals, "(k, n) for n contacts [N]; 0 where unholdable")
      .attribute("tangential", &tangentials,
                 "(k, n) for n contacts, in space (k, n, 3) [N]; 0 where unholdable")
      .attribute("torsion_moment", &torsion_moments,
                 "(k, n) for n contacts [N m]; 0 where unholdable")
      .def("__len__", each<AnyHolds>([](const auto& holds) { return holds.list.size(); }))
      .def("__iter__",
           [](const py::object& self) {
             return py::reinterpret_steal<py::iterator>(PySeqIter_New(self.ptr()));
           })
      .def("__getitem__", &hold_at, py::arg("index"))
      .def("__repr__", each<AnyHolds>([](const auto& holds) {
             const auto held = std::count_if(holds.list.begin(), holds.list.end(),
                                             [](const auto& hold) { return hold.holdable; });
             return py::str("Holds({} postures, {} holdable)").format(holds.list.size(), held);
           }));
}

}  // namespace

void add_hold(py::module_& module) {
  add_forces(module);
  add_holds(module);
  const py::call_guard<py::gil_scoped_release> unlocked;

  module.def("hold", &hold_posture, py::arg("grasp"), py::arg("up"), py::kw_only(),
             py::arg("force_cap") = 1e6, py::arg("objective") = Objective::effort, unlocked,
             "The hold of least effort, or of least grip within what the drives give, in the "
             "posture up\n(2,) or (3,), the direction against gravity in the object frame, of any "
             "length: against the\nload that needs most; posture_at has those of all. A load that "
             "needs a force norm above\nforce_cap [weights] is unholdable.");
  module.def("hold", &hold_load, py::arg("grasp"), py::arg("load"), py::arg("y"), py::kw_only(),
             py::arg("force_cap") = 1e6, py::arg("objective") = Objective::effort, unlocked,
             "The same for any wrench (3,) or (6,): force [N], moment [N m], about the object "
             "frame's\norigin, started at a twist y of that shape that was optimal for one "
             "nearby.");
  module.def(
      "phi",
      [](const AnyGrasp& any, const Eigen::VectorXd& y) {
        return std::visit(
            [&]<int Dim>(const Grasp<Dim>& grasp) {
              return phi<Dim>(grasp, sized<wrench_size<Dim>>(y, "y"));
            },
            any.of);
      },
      py::arg("grasp"), py::arg("y"),
      "phi(G^T y) [N^2] of a twist y (3,) or (6,) about the object frame's origin [N, N/m]: the\n"
      "greatest value of f . G^T y - |f|^2 / 2 over all f in the cones.");
  module.def(
      "bound",
      [](const AnyGrasp& any, const Eigen::VectorXd& load, const Eigen::VectorXd& y) {
        return std::visit(
            [&]<int Dim>(const Grasp<Dim>& grasp) {
              constexpr int size = wrench_size<Dim>;
              return bound<Dim>(grasp, sized<size>(load, "load"), sized<size>(y, "y"));
            },
            any.of);
      },
      py::arg("grasp"), py::arg("load"), py::arg("y"),
      "What a twist y (3,) or (6,) proves of a load of that shape, both about the object frame's\n"
      "origin: its effort is at least 2 (y . load - phi(G^T y)) [N^2], whatever y is.");
  module.def("hold_many", &hold_many, py::arg("grasp"), py::arg("ups"), py::kw_only(),
             py::arg("force_cap") = 1e6, py::arg("objective") = Objective::effort, unlocked,
             "The holds in many postures ups (k, 2) or (k, 3), in their order, on all cores.");
  module.def("finger_forces", &fingers, py::arg("grasp"), py::arg("hold"),
             "A FingerForce for each of grasp.fingers. Empty where unholdable.");
  module.def(
      "grip",
      [](const AnyGrasp& any, const AnyHold& hold) {
        return each(any, hold, [](const auto& grasp, const auto& own) { return grip(grasp, own); });
      },
      py::arg("grasp"), py::arg("hold"),
      "The grip of the forces of a hold: the greatest effort of the drives [N], of joints [N m], "
      "or\n"
      "the greatest part of max where drives are of different kinds.");
  module.def(
      "drive_efforts",
      [](const AnyGrasp& any, const AnyHold& hold) {
        return each(any, hold, [](const auto& grasp, const auto& own) {
          std::vector<double> efforts;
          for (const DriveEffort& drive : drive_efforts(grasp, own))
            efforts.push_back(drive.effort);
          return efforts;
        });
      },
      py::arg("grasp"), py::arg("hold"), "What the drives do [N, or N m]. Empty where unholdable.");
  module.def(
      "least_grip",
      [](const AnyGrasp& any, const Eigen::VectorXd& up, double force_cap) {
        const HoldSettings settings{.force_cap = checked_cap(force_cap)};
        return std::visit(
            [&]<int Dim>(const Grasp<Dim>& grasp) {
              return AnyHold{least_grip<Dim>(grasp, unit<Dim>(up), settings)};
            },
            any.of);
      },
      py::arg("grasp"), py::arg("up"), py::kw_only(), py::arg("force_cap") = 1e6, unlocked,
      "The hold of least grip, and of least effort among those, in the posture up (2,) or (3,),\n"
      "whatever the drives give.");
  module.def(
      "all_loaded",
      [](const AnyGrasp& any, const AnyHold& hold) {
        return each(any, hold, [](const auto& grasp, const auto& own) {
          return all_loaded(grasp, own, grasp.size());
        });
      },
      py::arg("grasp"), py::arg("hold"),
      "Whether every finger's normal force is above 1e-9 of the weight.");
  module.def("manner", &manner_of, py::arg("grasp"), py::arg("up"), py::arg("hold"), py::kw_only(),
             py::arg("load") = py::none(),
             "How the object is held in the posture up (2,) or (3,) by these forces. load: against "
             "which,\nan index, where there are several.");
  module.def(
      "reason",
      [](const AnyGrasp& any, const AnyHold& hold) {
        return each(any, hold,
                    [](const auto& grasp, const auto& own) { return reason(grasp, own); });
      },
      py::arg("grasp"), py::arg("hold"),
      "Why an unholdable load cannot be held, in words: the motion that it drives and no contact\n"
      "opposes.");
}

}  // namespace poise::python
