#include "curve_settings.hpp"
#include "each_load.hpp"
#include "files/degrees.hpp"
#include "module.hpp"
#include "parallel.hpp"
#include "poise/best_posture.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

using AnyBest = Either<Best>;

const SpatialSettings spatial;  // the defaults

/// The settings of both dimensions.
struct Settings {
  CurveSettings curve;
  SpatialSettings space;
};

Settings settings(Domain domain, double force_cap, double gap, int max_holds,
                  const py::object& tilt, int starts, Objective objective) {
  Settings result{.curve = curve_settings(domain, force_cap, objective),
                  .space = {.objective = objective,
                            .gap = gap,
                            .max_holds = max_holds,
                            .force_cap = checked_cap(force_cap),
                            .starts = starts}};
  result.space.tilt = read_tilt(tilt);
  return result;
}

AnyBest best_in_space(const Grasp<3>& grasp, const Settings& settings) {
  if (settings.curve.domain != Domain::all)
    throw InvalidGrasp("domain", "must be all in space, where best_pinched is found anyway");
  return {best_posture(grasp, settings.space)};
}

AnyBest best_of(const AnyGrasp& grasp, const Settings& settings) {
  const auto* const planar = std::get_if<Grasp<2>>(&grasp.of);
  if (!planar) return best_in_space(only<3>(grasp), settings);
  if (settings.space.tilt) throw InvalidGrasp("tilt", "is for space, the grasp is in the plane");
  return {best_posture(*planar, settings.curve)};
}

/// As a class of its own in each dimension.
py::object write(const AnyBest& best) {
  return std::visit([](const auto& own) { return py::cast(own); }, best.of);
}

py::object best_asked(const AnyGrasp& grasp, Domain domain, double force_cap, double gap,
                      int max_holds, const py::object& tilt, int starts, Objective objective) {
  const Settings all = settings(domain, force_cap, gap, max_holds, tilt, starts, objective);
  return write([&] {
    const py::gil_scoped_release unlocked;
    return best_of(grasp, all);
  }());
}

py::list best_many(const std::vector<GraspPointer>& many, Domain domain, double force_cap,
                   double gap, int max_holds, const py::object& tilt, int starts,
                   Objective objective) {
  const Settings all = settings(domain, force_cap, gap, max_holds, tilt, starts, objective);
  std::vector<AnyBest> best(many.size());
  {
    const py::gil_scoped_release unlocked;
    parallel(many.size(), 1, [&](std::size_t k) { best[k] = best_of(*many[k], all); });
  }
  py::list list;
  for (const AnyBest& each : best) list.append(write(each));
  return list;
}

void add_planar(py::module_& module) {
  Class<Minimum<2>> posture(module, "PlanarPosture",
                            "A posture worth knowing: an optimum of the curve with its hold.",
                            "Minimum");
  posture.attribute("optimum", &Minimum<2>::optimum)
      .attribute("hold", [](const Minimum<2>& posture) { return AnyHold{posture.hold()}; })
      .attribute("manner", &Minimum<2>::manner)
      .attribute("edges_meet", &Minimum<2>::edges_meet)
      .attribute("two_slipping", &Minimum<2>::two_slipping)
      .def("__repr__", [](const Minimum<2>& posture) {
        return py::str("PlanarPosture({:.2f} deg, value={:.6g}, {}, {})")
            .format(degrees(posture.optimum.angle), posture.optimum.value,
                    to_string(posture.manner), to_string(posture.optimum.kind));
      });
  add_loads(posture);

  Class<Best<2>>(module, "BestPosture",
                 "The best posture of a planar grasp, the other minima, and their proof.", "Best")
      .attribute(
          "curve", [](const Best<2>& best) { return &best.proof.curve; },
          "With the proof: its arcs and unholdable arcs.")
      .attribute("minima", &Best<2>::minima)
      .attribute(
          "worst", [](const Best<2>& best) { return best.proof.worst; },
          "The posture of the domain that needs most, or None.")
      .attribute("pinched", &Best<2>::pinched)
      .attribute("lower_bound", &Best<2>::lower_bound)
      .attribute(
          "optimal", [](const Best<2>& best) { return best.status != Status::gap; },
          "Whether no posture of the domain needs less than the best, as "
          "lower_bound proves, or,\nwhere there is none, none holds: False only "
          "where rounding hid what is there.")
      .attribute("holdable", &Best<2>::holdable)
      .attribute("best",
                 [](const Best<2>& best) { return best.holdable() ? &best.best() : nullptr; })
      .attribute("best_pinched", &Best<2>::best_pinched)
      .def("__repr__", [](const Best<2>& best) {
        if (!best.holdable()) return py::str("BestPosture(unholdable)");
        return py::str("BestPosture(minima={})").format(best.minima);
      });
}

void add_spatial(py::module_& module) {
  Class<Minimum<3>> posture(module, "SpatialPosture", "A posture in space, with its hold.",
                            "Posture");
  posture.attribute("up", &Minimum<3>::up)
      .attribute("hold", [](const Minimum<3>& posture) { return AnyHold{posture.hold()}; })
      .attribute("manner", &Minimum<3>::manner)
      .attribute("effort", &Minimum<3>::effort)
      .def("__repr__", [](const Minimum<3>& posture) {
        return py::str("SpatialPosture(up={}, effort={:.6g} N^2, {})")
            .format(shown(posture.up), posture.effort(), to_string(posture.manner));
      });
  add_loads(posture);

  Class<Cut>(module, "Cut")
      .attribute("y", &Cut::y,
                 "A twist about the object frame's origin (6,) [N, N/m]: for every x in R^3, the "
                 "load with x\nfor the unit vector up needs an effort of at least\n"
                 "2 (y . w(x) - phi(G^T y)).")
      .attribute("load", &Cut::load, "Index of the load.")
      .attribute("n", &Cut::n)
      .def("__repr__", [](const Cut& cut) {
        return cut.n ? py::str("Cut(n={})").format(shown(*cut.n))
                     : py::str("Cut(y={}, load {})").format(shown(cut.y), cut.load);
      });

  Class<Best<3>>(
      module, "BestSpatialPosture",
      "The best posture of a spatial grasp, the other minima that were found, and its certificate.",
      "Best")
      .attribute("status", &Best<3>::status)
      .attribute("best",
                 [](const Best<3>& best) { return best.holdable() ? &best.best() : nullptr; })
      .attribute("minima", &Best<3>::minima)
      .attribute("pinched", &Best<3>::pinched)
      .attribute("best_pinched", &Best<3>::best_pinched)
      .attribute("lower_bound", &Best<3>::lower_bound)
      .attribute("relative_gap", &Best<3>::relative_gap)
      .attribute(
          "cuts", [](const Best<3>& best) { return best.proof.cuts; }, "The certificate.")
      .attribute(
          "holds", [](const Best<3>& best) { return best.proof.holds; },
          "Spent on the certificate.")
      .def("__repr__", [](const Best<3>& best) {
        if (!best.holdable())
          return py::str("BestSpatialPosture({})").format(to_string(best.status));
        return py::str("BestSpatialPosture({}, best={})")
            .format(to_string(best.status), py::cast(best.best()));
      });
}

}  // namespace

void add_best(py::module_& module) {
  add_planar(module);
  add_spatial(module);
  module.def(
      "best_posture", &best_asked, py::arg("grasp"), py::kw_only(), py::arg("domain") = Domain::all,
      py::arg("force_cap") = 1e6, py::arg("gap") = spatial.gap,
      py::arg("max_holds") = spatial.max_holds, py::arg("tilt") = py::none(),
      py::arg("starts") = spatial.starts, py::arg("objective") = Objective::effort,
      "The best posture of a grasp. In the plane exactly, within the domain: BestPosture.\n\n"
      "In space with a certificate, a BestSpatialPosture: until (effort - lower_bound) / effort "
      "is\n"
      "at most gap, or max_holds are spent; with a Tilt only postures near one direction. Local "
      "minima\nare sought from so many starts; 0: none are sought.\n\n"
      "Of several loads that decides which needs most. Raises InvalidGrasp for settings out of "
      "their\nranges.");
  module.def("best_many", &best_many, py::arg("grasps"), py::kw_only(),
             py::arg("domain") = Domain::all, py::arg("force_cap") = 1e6,
             py::arg("gap") = spatial.gap, py::arg("max_holds") = spatial.max_holds,
             py::arg("tilt") = py::none(), py::arg("starts") = spatial.starts,
             py::arg("objective") = Objective::effort,
             "The best postures of many grasps, in their order, on all cores; see best_posture.");
  module.def(
      "minimum_at",
      [](const AnyGrasp& grasp, const Optimum& optimum, Domain domain, double force_cap,
         Objective objective) {
        return minimum_at(only<2>(grasp), optimum, curve_settings(domain, force_cap, objective));
      },
      py::arg("grasp"), py::arg("optimum"), py::kw_only(), py::arg("domain") = Domain::all,
      py::arg("force_cap") = 1e6, py::arg("objective") = Objective::effort,
      "An optimum of a curve, with its hold, manner and meeting point.");
}

}  // namespace poise::python
