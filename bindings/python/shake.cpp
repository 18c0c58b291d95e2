#include "poise/shake.hpp"

#include "module.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

using AnyCut = Either<ShakeCut>;
using AnyShake = Either<Shake>;
using AnyTilting = Either<Tilting>;
using AnySturdiest = Either<Sturdiest>;

/// What `f(grasp, up, settings)` finds of a grasp of either dimension in the posture `up`.
template <class R, class F>
R in_posture(const AnyGrasp& any, const Eigen::VectorXd& up, const ShakeSettings& settings, F f) {
  return std::visit(
      [&]<int Dim>(const Grasp<Dim>& grasp) { return R{f(grasp, unit<Dim>(up), settings)}; },
      any.of);
}

/// Vectors in rows, for each load.
template <int Dim>
std::vector<Eigen::MatrixXd> rows_of(const std::vector<std::vector<Vector<Dim>>>& held) {
  std::vector<Eigen::MatrixXd> result;
  for (const std::vector<Vector<Dim>>& points : held) {
    Eigen::MatrixXd& rows = result.emplace_back(static_cast<Eigen::Index>(points.size()), Dim);
    for (std::size_t k = 0; k < points.size(); ++k)
      rows.row(static_cast<Eigen::Index>(k)) = points[k];
  }
  return result;
}

/// What both answers have.
template <class E>
void add_common(Class<E>& answer) {
  answer.either("holdable", [](const auto& found) { return found.holdable; })
      .either("bound", [](const auto& found) { return found.bound; })
      .either(
          "cut", [](const auto& found) { return AnyCut{found.cut}; }, "What proves the bound.")
      .either("held", [](const auto& found) { return rows_of(found.held); })
      .either("proven", [](const auto& found) { return found.proven; })
      .either(
          "holds", [](const auto& found) { return found.holds; }, "Spent on it.");
}

void add_types(py::module_& module) {
  Class<AnyCut>(module, "ShakeCut")
      .either(
          "load", [](const auto& cut) { return cut.load; }, "Index of the load.")
      .either(
          "y", [](const auto& cut) -> Eigen::VectorXd { return cut.y; },
          "About the object frame's origin, (3,) or (6,): velocity, angular velocity.")
      .either("rates",
              [](const auto& cut) -> Eigen::VectorXd {
                return Eigen::Map<const Eigen::VectorXd>(
                    cut.rates.data(), static_cast<Eigen::Index>(cut.rates.size()));
              })
      .def("__repr__", each<AnyCut>([](const auto& cut) {
             return py::str("ShakeCut(y={}, load {})").format(shown(cut.y), cut.load);
           }));

  Class<AnyShake> shaken(module, "Shake");
  add_common(shaken);
  shaken.either("acceleration", [](const auto& found) { return found.acceleration; })
      .either("direction", [](const auto& found) -> Eigen::VectorXd { return found.direction; })
      .def("__repr__", each<AnyShake>([](const auto& found) {
             return found.holdable
                        ? py::str("Shake(acceleration={:.6g})").format(found.acceleration)
                        : py::str("Shake(unholdable)");
           }));

  Class<AnyTilting> tilted(module, "Tilting");
  add_common(tilted);
  tilted.either("angle", [](const auto& found) { return found.angle; })
      .either("up", [](const auto& found) -> Eigen::VectorXd { return found.up; })
      .def("__repr__", each<AnyTilting>([](const auto& found) {
             return found.holdable ? py::str("Tilting(angle={:.6g})").format(found.angle)
                                   : py::str("Tilting(unholdable)");
           }));
}

void add_sturdiest(py::module_& module) {
  Class<AnySturdiest>(module, "Sturdiest")
      .either("status", [](const auto& found) { return found.status; })
      .either("up", [](const auto& found) -> Eigen::VectorXd { return found.up; })
      .either("acceleration", [](const auto& found) { return found.acceleration; })
      .either("bound", [](const auto& found) { return found.bound; })
      .either("shakes",
              []<int Dim>(const Sturdiest<Dim>& found) {
                return std::vector<AnyShake>(found.shakes.begin(), found.shakes.end());
              })
      .either("cuts",
              []<int Dim>(const Sturdiest<Dim>& found) {
                return std::vector<AnyCut>(found.cuts.begin(), found.cuts.end());
              })
      .either("holds", [](const auto& found) { return found.holds; })
      .def("__repr__", each<AnySturdiest>([](const auto& found) {
             return py::str("Sturdiest({}, acceleration={:.6g})")
                 .format(to_string(found.status), found.acceleration);
           }));
  module.def(
      "sturdiest_posture",
      [](const AnyGrasp& grasp, Domain domain, const py::object& tilt, double gap, double force_cap,
         std::optional<double> most_grip, int max_holds,
         const std::optional<Eigen::VectorXd>& present) {
        const ShakeSettings settings{gap, checked_cap(force_cap), most_grip, max_holds};
        const std::optional<Tilt> near = read_tilt(tilt);
        const bool planar = std::holds_alternative<Grasp<2>>(grasp.of);
        if (planar && near) throw InvalidGrasp("tilt", "is for space, the grasp is in the plane");
        if (!planar && domain != Domain::all) throw InvalidGrasp("domain", "must be all in space");
        const auto now = [&]<int Dim>(const Grasp<Dim>&) -> Vector<Dim> {
          return present ? unit<Dim>(*present, "present") : Vector<Dim>(Vector<Dim>::Unit(Dim - 1));
        };
        const py::gil_scoped_release unlocked;
        if (planar) {
          const auto& own = std::get<Grasp<2>>(grasp.of);
          return AnySturdiest{sturdiest_posture(own, domain, settings, now(own))};
        }
        const auto& own = std::get<Grasp<3>>(grasp.of);
        return AnySturdiest{sturdiest_posture(own, near, settings, now(own))};
      },
      py::arg("grasp"), py::kw_only(), py::arg("domain") = Domain::all,
      py::arg("tilt") = py::none(), py::arg("gap") = ShakeSettings().gap,
      py::arg("force_cap") = ShakeSettings().force_cap, py::arg("most_grip") = py::none(),
      py::arg("max_holds") = ShakeSettings().max_holds, py::arg("present") = py::none(),
      "The posture of which shake() is greatest, with a bound on that of all others.\n\n"
      "present: (2,) or (3,), where nothing is better; upright unless given\n"
      "max_holds: to spend on each load of a posture, and ten times as many on the search");
}

/// A function of a grasp and a posture, with settings by keywords.
template <class R, class F>
void define(py::module_& module, const char* name, F f, const std::string& words) {
  module.def(
      name,
      [f](const AnyGrasp& grasp, const Eigen::VectorXd& up, double gap, double force_cap,
          std::optional<double> most_grip, int max_holds) {
        return in_posture<R>(grasp, up, {gap, checked_cap(force_cap), most_grip, max_holds}, f);
      },
      py::arg("grasp"), py::arg("up"), py::kw_only(), py::arg("gap") = ShakeSettings().gap,
      py::arg("force_cap") = ShakeSettings().force_cap, py::arg("most_grip") = py::none(),
      py::arg("max_holds") = ShakeSettings().max_holds, py::call_guard<py::gil_scoped_release>(),
      (words + "\n\ngap: wanted, (bound - found) / found\n"
               "most_grip: of the drives, besides their own limits\n"
               "max_holds: to spend on each load")
          .c_str());
}

}  // namespace

void add_shake(py::module_& module) {
  add_types(module);
  add_sturdiest(module);
  define<AnyShake>(
      module, "shake", [](const auto&... all) { return shake(all...); },
      "The greatest acceleration [m/s^2] that is withstood in every direction in the posture up "
      "(2,)\nor (3,), besides what the loads say, within the limits of contacts and drives.");
  define<AnyTilting>(
      module, "tilting", [](const auto&... all) { return tilting(all...); },
      "The greatest angle [rad] such that every posture within it of up (2,) or (3,) is held.");
}

}  // namespace poise::python
