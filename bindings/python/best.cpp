#include "curve_settings.hpp"
#include "module.hpp"
#include "parallel.hpp"
#include "poise/best_posture.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

std::vector<BestPosture> best_many(const std::vector<std::shared_ptr<Grasp<2>>>& grasps,
                                   Domain domain, double force_cap) {
  const CurveSettings settings = curve_settings(domain, force_cap);
  const py::gil_scoped_release unlocked;
  std::vector<BestPosture> best(grasps.size());
  parallel(grasps.size(), 1, [&](std::size_t k) { best[k] = best_posture(*grasps[k], settings); });
  return best;
}

void add_types(py::module_& module) {
  py::class_<PlanarPosture>(module, "PlanarPosture",
                            "A posture worth knowing: an optimum of the curve with its hold.")
      .def_readonly("optimum", &PlanarPosture::optimum)
      .def_readonly("hold", &PlanarPosture::hold)
      .def_readonly("manner", &PlanarPosture::manner)
      .def_readonly("edges_meet", &PlanarPosture::edges_meet,
                    "At a kink with exactly two loaded contacts, both slipping: where the edges of "
                    "their friction\ncones meet (2,) [m, object frame], on the vertical through "
                    "the centre of mass. None if parallel.")
      .def_readonly("two_slipping", &PlanarPosture::two_slipping,
                    "Whether edges_meet was asked for.")
      .def("__repr__", [](const PlanarPosture& posture) {
        return py::str("PlanarPosture({:.2f} deg, effort={:.6g} N^2, {}, {})")
            .format(posture.optimum.angle / degree, posture.optimum.effort,
                    to_string(posture.manner), to_string(posture.optimum.kind));
      });

  py::class_<BestPosture>(module, "BestPosture", "The posture in which the fingers press least.")
      .def_readonly("curve", &BestPosture::curve, "With the proof: its arcs and unholdable arcs.")
      .def_readonly("minima", &BestPosture::minima,
                    "In the order of the curve; the first is the best.")
      .def_readonly("worst", &BestPosture::worst,
                    "The posture of the domain that needs most, or None.")
      .def_readonly("pinched", &BestPosture::pinched,
                    "Index into minima of the lowest interior minimum that is pinched, or None.")
      .def_readonly("lower_bound", &BestPosture::lower_bound,
                    "On the effort in the whole domain, by the arcs' y [N^2].")
      .def_property_readonly("optimal", &BestPosture::optimal,
                             "Whether no posture of the domain needs less than the best, or, where "
                             "there is none, none\nholds: False only where rounding left postures "
                             "undecided that might.")
      .def_property_readonly("holdable", &BestPosture::holdable)
      .def_property_readonly(
          "best", [](const BestPosture& best) { return best.holdable() ? &best.best() : nullptr; },
          py::return_value_policy::reference_internal, "The best posture; None where unholdable.")
      .def_property_readonly("best_pinched", &BestPosture::best_pinched,
                             py::return_value_policy::reference_internal,
                             "The lowest interior minimum that is pinched, or None.")
      .def("__repr__", [](const BestPosture& best) {
        if (!best.holdable()) return py::str("BestPosture(unholdable)");
        return py::str("BestPosture(minima={})").format(best.minima);
      });
}

}  // namespace

void add_best(py::module_& module) {
  add_types(module);
  module.def(
      "best_posture",
      [](const Grasp<2>& grasp, Domain domain, double force_cap) {
        const CurveSettings settings = curve_settings(domain, force_cap);
        const py::gil_scoped_release unlocked;
        return best_posture(grasp, settings);
      },
      py::arg("grasp"), py::kw_only(), py::arg("domain") = Domain::all, py::arg("force_cap") = 1e6,
      "The best posture of a planar grasp, exactly.");
  module.def("best_many", &best_many, py::arg("grasps"), py::kw_only(),
             py::arg("domain") = Domain::all, py::arg("force_cap") = 1e6,
             "The best postures of many grasps, in their order, on all cores.");
  module.def(
      "posture_at",
      [](const Grasp<2>& grasp, const Optimum& optimum, Domain domain, double force_cap) {
        return posture_at(grasp, optimum, curve_settings(domain, force_cap));
      },
      py::arg("grasp"), py::arg("optimum"), py::kw_only(), py::arg("domain") = Domain::all,
      py::arg("force_cap") = 1e6,
      "An optimum of a curve, with its hold, manner and meeting point.");
}

}  // namespace poise::python
