#include <pybind11/numpy.h>

#include "curve_settings.hpp"
#include "module.hpp"
#include "poise/posture_curve.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

void add_types(py::module_& module) {
  py::class_<Interval>(module, "Interval",
                       "An interval of planar postures [rad]: from_ <= to <= from_ + 2 pi, from_ "
                       "in [-pi, pi).\nThe whole circle is [-pi, pi]; a single posture has from_ "
                       "== to.")
      .def_readonly("from_", &Interval::from)
      .def_readonly("to", &Interval::to)
      .def("__repr__", [](const Interval& interval) {
        return py::str("Interval({:.6g} to {:.6g})").format(interval.from, interval.to);
      });

  py::class_<Harmonic1>(module, "Harmonic1", "c0 + cos1 cos(theta) + sin1 sin(theta)")
      .def_readonly("c0", &Harmonic1::c0)
      .def_readonly("cos1", &Harmonic1::cos1)
      .def_readonly("sin1", &Harmonic1::sin1)
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

  py::class_<Harmonic2>(module, "Harmonic2", "Harmonic1 + cos2 cos(2 theta) + sin2 sin(2 theta)")
      .def_readonly("c0", &Harmonic2::c0)
      .def_readonly("cos1", &Harmonic2::cos1)
      .def_readonly("sin1", &Harmonic2::sin1)
      .def_readonly("cos2", &Harmonic2::cos2)
      .def_readonly("sin2", &Harmonic2::sin2)
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

  py::class_<ArcState>(module, "ArcState", "What one contact does all along an arc.")
      .def_readonly("state", &ArcState::state)
      .def_readonly("limit", &ArcState::limit)
      .def("__repr__", [](const ArcState& state) {
        return py::str("ArcState({}, limit {})")
            .format(to_string(state.state), to_string(state.limit));
      });

  py::class_<Arc>(module, "Arc",
                  "Postures in which every contact keeps its part of the friction cone: there the "
                  "forces and\ny are affine in (cos theta, sin theta), and the effort is a "
                  "trigonometric polynomial of degree 2.")
      .def_readonly("from_", &Arc::from, "[rad], closed")
      .def_readonly("to", &Arc::to, "[rad], closed")
      .def_readonly("V", &Arc::V, "Effort [N^2].")
      .def_readonly("y", &Arc::y,
                    "Optimal dual, about the object frame's origin: three Harmonic1 [N, N, N/m].")
      .def_readonly("first_state", &Arc::first_state,
                    "First index into PostureCurve.states; the arc has one state for each contact "
                    "from\nthere on.")
      .def("__repr__", [](const Arc& arc) {
        return py::str("Arc({:.6g} to {:.6g}, V={})").format(arc.from, arc.to, arc.V);
      });

  py::class_<UnholdableArc>(module, "UnholdableArc",
                            "Postures in which the object cannot be held, and one y that proves it "
                            "inside (see Hold.dual),\nup to about 1e-8 rad from ends where the "
                            "object can be held.")
      .def_readonly("from_", &UnholdableArc::from, "[rad], open")
      .def_readonly("to", &UnholdableArc::to, "[rad], open")
      .def_readonly("y", &UnholdableArc::y, "(3,) [N, N, N/m]")
      .def("__repr__", [](const UnholdableArc& arc) {
        return py::str("UnholdableArc({:.6g} to {:.6g})").format(arc.from, arc.to);
      });

  py::class_<Optimum>(module, "Optimum",
                      "A local minimum or maximum of V over the domain's holdable postures.")
      .def_readonly("angle", &Optimum::angle,
                    "[rad], in (-pi, pi]; of a stretch of equal V its middle")
      .def_readonly("from_", &Optimum::from,
                    "The stretch [rad]; from_ and to are angle where the optimum is one posture.")
      .def_readonly("to", &Optimum::to)
      .def_readonly("effort", &Optimum::effort, "V [N^2]")
      .def_readonly("kind", &Optimum::kind)
      .def_readonly("maximum", &Optimum::maximum)
      .def("__repr__", [](const Optimum& optimum) {
        return py::str("Optimum({} at {:.6g} rad, effort={:.6g} N^2, {})")
            .format(optimum.maximum ? "maximum" : "minimum", optimum.angle, optimum.effort,
                    to_string(optimum.kind));
      });

  py::class_<PostureCurve>(module, "PostureCurve",
                           "The whole answer in the plane. Angles of arcs run from the domain's "
                           "start upwards.")
      .def_readonly("domain", &PostureCurve::domain)
      .def_readonly("arcs", &PostureCurve::arcs)
      .def_readonly("states", &PostureCurve::states,
                    "Of all arcs, contact by contact; see Arc.first_state.")
      .def_readonly("unholdable_arcs", &PostureCurve::unholdable_arcs)
      .def_readonly("holdable", &PostureCurve::holdable, "Closed intervals.")
      .def_readonly("undecided", &PostureCurve::undecided,
                    "Where rounding left more than 1e-8 rad undecided: neither an arc nor proven "
                    "unholdable.\nEmpty unless the grasp is nearly degenerate.")
      .def_readonly("optima", &PostureCurve::optima,
                    "Minima by effort, lowest first, then maxima by effort, highest first.")
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
      [](const AnyGrasp& grasp, Domain domain, double force_cap) {
        const CurveSettings settings = curve_settings(domain, force_cap);
        const py::gil_scoped_release unlocked;
        return posture_curve(only<2>(grasp), settings);
      },
      py::arg("grasp"), py::kw_only(), py::arg("domain") = Domain::all, py::arg("force_cap") = 1e6,
      "V(theta) of every posture of the domain, with its minima and maxima, without sampling.\n"
      "Postures that need a force norm above force_cap [weights] are unholdable.");
  module.def(
      "domain_interval",
      [](const AnyGrasp& grasp, Domain domain) { return domain_interval(only<2>(grasp), domain); },
      py::arg("grasp"), py::arg("domain"),
      "The postures to choose from: the whole circle, or the closed rest of the cradled "
      "wedge.");
  module.def(
      "cradled_wedge",
      [](const AnyGrasp& grasp) {
        const Grasp<2>& planar = only<2>(grasp);
        return cradled_wedge(planar, planar.loads().front().com);
      },
      py::arg("grasp"),
      "The postures in which the centre of mass lies in the fork of the fingers: an open "
      "interval\nof less than 180 degrees; from_ == to where nothing is cradled.");
}

}  // namespace poise::python
