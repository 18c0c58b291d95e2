#include <pybind11/numpy.h>

#include "curve_settings.hpp"
#include "module.hpp"
#include "poise/posture_curve.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

void add_types(py::module_& module) {
  Class<Interval>(module, "Interval")
      .attribute("from_", &Interval::from)
      .attribute("to", &Interval::to)
      .def("__repr__", [](const Interval& interval) {
        return py::str("Interval({:.6g} to {:.6g})").format(interval.from, interval.to);
      });

  Class<Harmonic1>(module, "Harmonic1")
      .attribute("c0", &Harmonic1::c0)
      .attribute("cos1", &Harmonic1::cos1)
      .attribute("sin1", &Harmonic1::sin1)
      .def(
          "__call__",
          [](const Harmonic1& f, const py::array_t<double>& theta) {
            return py::vectorize([&f](double each) { return f(each); })(theta);
          },
          py::arg("theta"), "Its values at theta [rad], of any shape.")
      .def("__repr__", [](const Harmonic1& f) {
        return py::str("Harmonic1(c0={:.6g}, cos1={:.6g}, sin1={:.6g})")
            .format(f.c0, f.cos1, f.sin1);
      });

  Class<Harmonic2>(module, "Harmonic2")
      .attribute("c0", &Harmonic2::c0)
      .attribute("cos1", &Harmonic2::cos1)
      .attribute("sin1", &Harmonic2::sin1)
      .attribute("cos2", &Harmonic2::cos2)
      .attribute("sin2", &Harmonic2::sin2)
      .def(
          "__call__",
          [](const Harmonic2& f, const py::array_t<double>& theta) {
            return py::vectorize([&f](double each) { return f(each); })(theta);
          },
          py::arg("theta"), "Its values at theta [rad], of any shape.")
      .def(
          "slope",
          [](const Harmonic2& f, const py::array_t<double>& theta) {
            return py::vectorize([&f](double each) { return f.slope(each); })(theta);
          },
          py::arg("theta"), "Its derivatives at theta [rad], of any shape.")
      .def("__repr__", [](const Harmonic2& f) {
        return py::str("Harmonic2(c0={:.6g}, cos1={:.6g}, sin1={:.6g}, cos2={:.6g}, sin2={:.6g})")
            .format(f.c0, f.cos1, f.sin1, f.cos2, f.sin2);
      });

  Class<ArcState>(module, "ArcState")
      .attribute("state", &ArcState::state)
      .attribute("limit", &ArcState::limit)
      .def("__repr__", [](const ArcState& state) {
        return py::str("ArcState({}, limit {})")
            .format(to_string(state.state), to_string(state.limit));
      });

  Class<ArcForce>(module, "ArcForce")
      .attribute("normal", &ArcForce::normal)
      .attribute("tangential", &ArcForce::tangential)
      .def("__repr__", [](const ArcForce& force) {
        return py::str("ArcForce(normal={}, tangential={})").format(force.normal, force.tangential);
      });

  Class<Arc>(module, "Arc")
      .attribute("from_", &Arc::from)
      .attribute("to", &Arc::to)
      .attribute("value", &Arc::value)
      .attribute("y", &Arc::y,
                 "Optimal dual, about the object frame's origin: three Harmonic1 [N, N, N/m].")
      .attribute("first_state", &Arc::first_state)
      .attribute("rates", &Arc::rates)
      .attribute("forces", &Arc::forces)
      .attribute("load", &Arc::load)
      .def("__repr__", [](const Arc& arc) {
        return py::str("Arc({:.6g} to {:.6g}, value={})").format(arc.from, arc.to, arc.value);
      });

  Class<UnholdableArc>(module, "UnholdableArc")
      .attribute("from_", &UnholdableArc::from)
      .attribute("to", &UnholdableArc::to)
      .attribute("y", &UnholdableArc::y, "(3,) [N, N, N/m]")
      .attribute("rates", &UnholdableArc::rates)
      .attribute("load", &UnholdableArc::load)
      .def("__repr__", [](const UnholdableArc& arc) {
        return py::str("UnholdableArc({:.6g} to {:.6g})").format(arc.from, arc.to);
      });

  Class<Optimum>(module, "Optimum")
      .attribute("angle", &Optimum::angle)
      .attribute("from_", &Optimum::from)
      .attribute("to", &Optimum::to)
      .attribute("value", &Optimum::value)
      .attribute("kind", &Optimum::kind)
      .attribute("maximum", &Optimum::maximum)
      .def("__repr__", [](const Optimum& optimum) {
        return py::str("Optimum({} at {:.6g} rad, value={:.6g}, {})")
            .format(optimum.maximum ? "maximum" : "minimum", optimum.angle, optimum.value,
                    to_string(optimum.kind));
      });

  Class<PostureCurve>(module, "PostureCurve")
      .attribute("objective", &PostureCurve::objective)
      .attribute("domain", &PostureCurve::domain)
      .attribute("arcs", &PostureCurve::arcs)
      .attribute("states", &PostureCurve::states)
      .attribute("unholdable_arcs", &PostureCurve::unholdable_arcs)
      .attribute("holdable", &PostureCurve::holdable)
      .attribute("undecided", &PostureCurve::undecided)
      .attribute("optima", &PostureCurve::optima)
      .attribute("loads", &PostureCurve::loads)
      .def("__repr__", [](const PostureCurve& curve) {
        return py::str("PostureCurve({} arcs, holdable={}, optima={})")
            .format(curve.arcs.size(), curve.holdable, curve.optima);
      });
}

}  // namespace

void add_curve(py::module_& module) {
  add_types(module);
  module.def(
      "posture_curve",
      [](const AnyGrasp& grasp, Domain domain, double force_cap, Objective objective) {
        const CurveSettings settings = curve_settings(domain, force_cap, objective);
        const py::gil_scoped_release unlocked;
        return posture_curve(only<2>(grasp), settings);
      },
      py::arg("grasp"), py::kw_only(), py::arg("domain") = Domain::all, py::arg("force_cap") = 1e6,
      py::arg("objective") = Objective::effort,
      "V(theta) or F*(theta) of every posture of the domain, with its minima and maxima, without\n"
      "sampling.\n"
      "Postures that need a force norm above force_cap [weights] are unholdable.");
  module.def(
      "domain_interval",
      [](const AnyGrasp& grasp, Domain domain) { return domain_interval(only<2>(grasp), domain); },
      py::arg("grasp"), py::arg("domain"),
      "The postures to choose from: the whole circle, or the closed rest of the "
      "fork.");
  module.def(
      "fork_wedge",
      [](const AnyGrasp& grasp) {
        const Grasp<2>& planar = only<2>(grasp);
        return fork_wedge(planar, planar.loads().front().com);
      },
      py::arg("grasp"),
      "The postures in which the centre of mass lies in the fork of the fingers: an open "
      "interval\nof less than 180 degrees; from_ == to where there is none.");
}

}  // namespace poise::python
