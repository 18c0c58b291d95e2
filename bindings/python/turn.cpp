#include "poise/turn.hpp"

#include <numbers>

#include "ask/turn.hpp"
#include "curve_settings.hpp"
#include "each_load.hpp"
#include "files/degrees.hpp"
#include "module.hpp"
#include "turned.hpp"

namespace poise::python {
namespace {

using AnyPosture = Either<Posture>;
/// A posture or an orientation: an angle, or the numbers of a direction or of a quaternion.
using Given = std::variant<double, Eigen::VectorXd>;

const TurnSettings in_space;  // the defaults

/// A way with the orientation from which it leads.
struct WayFrom : Way {
  Eigen::Quaterniond start;
};

struct ReachableFrom : Reachable<3> {
  Eigen::Quaterniond start;
};

/// The settings of both dimensions.
struct Settings {
  CurveSettings curve;
  TurnSettings space;
};

Settings settings(Domain domain, double force_cap, double gap, int max_holds,
                  const py::object& tilt, Objective objective) {
  return {.curve = curve_settings(domain, force_cap, objective),
          .space = {.objective = objective,
                    .gap = gap,
                    .max_holds = max_holds,
                    .force_cap = checked_cap(force_cap),
                    .tilt = read_tilt(tilt)}};
}

void refuse_spatial(const Settings& settings) {
  if (settings.space.tilt) throw InvalidGrasp("tilt", "is for space, the grasp is in the plane");
}

void refuse_planar(const Settings& settings) {
  if (settings.curve.domain != Domain::all)
    throw InvalidGrasp("domain", "must be all in space, where a tilt says which postures");
}

/// An angle in (-pi, pi].
double read_angle(const Given& given, const std::string& path) {
  if (const auto* const up = std::get_if<Eigen::VectorXd>(&given))
    return angle_of(unit<2>(*up, path));
  const double angle = std::get<double>(given);
  if (!std::isfinite(angle)) throw InvalidGrasp(path, "must be finite");
  const double turned = std::remainder(angle, 2 * std::numbers::pi);
  return turned > -std::numbers::pi ? turned : std::numbers::pi;
}

const Eigen::VectorXd& read_numbers(const Given& given, const std::string& path) {
  if (const auto* const numbers = std::get_if<Eigen::VectorXd>(&given)) return *numbers;
  throw InvalidGrasp(path, "is an angle, must be a direction: the grasp is in space");
}

Eigen::Quaterniond read_quaternion(const Eigen::VectorXd& numbers, const std::string& path) {
  const Eigen::Vector4d given = sized<4>(numbers, path);
  if (!given.allFinite() || given.isZero(0))
    throw InvalidGrasp(path, "must be a rotation: a quaternion w, x, y, z");
  const Eigen::Vector4d wxyz = given.stableNormalized();
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

Eigen::Quaterniond read_orientation(const Given& given, const std::string& path) {
  const Eigen::VectorXd& numbers = read_numbers(given, path);
  if (numbers.size() != 3 && numbers.size() != 4)
    throw InvalidGrasp(path, "has " + std::to_string(numbers.size()) +
                                 " numbers, must have 3 (up) or 4 (a quaternion w, x, y, z)");
  return numbers.size() == 4 ? read_quaternion(numbers, path)
                             : orientation_of(unit<3>(numbers, path));
}

Eigen::Vector4d write(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

Vector<3> up_in(const Eigen::Quaterniond& orientation) {
  return orientation.conjugate() * Vector<3>::UnitZ();
}

Turned<2> turn_in_plane(const GraspPointer& pointer, double from, double to,
                        const Settings& settings) {
  refuse_spatial(settings);
  const Grasp<2>& grasp = only<2>(*pointer);
  CurveSettings own = settings.curve;
  own.present = from;
  const HoldSettings of_hold{own.force_cap, own.objective};
  return {pointer,
          {{.angle_deg = degrees(to)},
           own,
           posture_at(grasp, up_at(from), of_hold),
           posture_at(grasp, up_at(to), of_hold),
           turn_taken(grasp, from, to, own)}};
}

Turned<3> turn_in_space(const GraspPointer& pointer, const Eigen::Quaterniond& from,
                        const Vector<3>& to, const Settings& settings) {
  refuse_planar(settings);
  const Grasp<3>& grasp = only<3>(*pointer);
  const TurnSettings& own = settings.space;
  const HoldSettings of_hold{own.force_cap, own.objective};
  TurnAnswer<3> answer{
      {.up = {to.x(), to.y(), to.z()}}, own, from, posture_at(grasp, up_in(from), of_hold),
      posture_at(grasp, to, of_hold),   {}};
  answer.taken = turn_taken(grasp, from, answer.now, answer.then, own);
  return {pointer, std::move(answer)};
}

/// What `work` makes without the interpreter's lock.
template <class Work>
py::object unlocked(const Work& work) {
  return py::cast([&] {
    const py::gil_scoped_release released;
    return work();
  }());
}

py::object turn(const GraspPointer& grasp, const Given& to, const std::optional<Given>& from,
                Domain domain, double force_cap, double gap, int max_holds, const py::object& tilt,
                Objective objective) {
  const Settings all = settings(domain, force_cap, gap, max_holds, tilt, objective);
  if (std::holds_alternative<Grasp<2>>(grasp->of)) {
    const double start = from ? read_angle(*from, "from_") : 0, end = read_angle(to, "to");
    return unlocked([&] { return turn_in_plane(grasp, start, end, all); });
  }
  const Eigen::Quaterniond start =
      from ? read_orientation(*from, "from_") : Eigen::Quaterniond::Identity();
  const Vector<3> end = unit<3>(read_numbers(to, "to"), "to");
  return unlocked([&] { return turn_in_space(grasp, start, end, all); });
}

Reachable<2> reachable_in_plane(const Grasp<2>& grasp, double from, const Settings& settings) {
  refuse_spatial(settings);
  return best_reachable(grasp, from, settings.curve);
}

ReachableFrom reachable_in_space(const Grasp<3>& grasp, const Eigen::Quaterniond& from,
                                 const Vector<3>& towards, const Settings& settings) {
  refuse_planar(settings);
  return {best_reachable(grasp, up_in(from), towards, settings.space), from};
}

py::object reachable(const GraspPointer& grasp, const Given& from,
                     const std::optional<Given>& towards, const Settings& all) {
  if (const auto* const planar = std::get_if<Grasp<2>>(&grasp->of)) {
    if (towards) throw InvalidGrasp("towards", "is for space, the grasp is in the plane");
    const double start = read_angle(from, "from_");
    return unlocked([&] { return reachable_in_plane(*planar, start, all); });
  }
  if (!towards) throw InvalidGrasp("towards", "is needed in space: the best posture of all");
  const Eigen::Quaterniond start = read_orientation(from, "from_");
  const Vector<3> end = unit<3>(read_numbers(*towards, "towards"), "towards");
  return unlocked([&] { return reachable_in_space(only<3>(*grasp), start, end, all); });
}

py::object reachable_asked(const GraspPointer& grasp, const Given& from,
                           const std::optional<Given>& towards, Domain domain, double force_cap,
                           double gap, int max_holds, const py::object& tilt, Objective objective) {
  try {
    return reachable(grasp, from, towards,
                     settings(domain, force_cap, gap, max_holds, tilt, objective));
  } catch (const InvalidGrasp& error) {
    if (error.path() == "from") throw InvalidGrasp("from_", error.problem());
    throw;
  }
}

/// The orientation to which each posture of a way leads, a row for each.
Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> orientations(const WayFrom& way) {
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> rows(way.ups.size(), 4);
  Eigen::Quaterniond orientation = way.start;
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    orientation = turn_to(orientation, way.ups[static_cast<std::size_t>(k)]).orientation;
    rows.row(k) = write(orientation);
  }
  return rows;
}

Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> ups(const WayFrom& way) {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows(way.ups.size(), 3);
  for (Eigen::Index k = 0; k < rows.rows(); ++k) rows.row(k) = way.ups[static_cast<std::size_t>(k)];
  return rows;
}

py::str shown_peak(const auto& peak) {
  if (!peak.unholdable.empty()) return py::str("unholdable");
  return py::str("peak={:.6g} at {:.2f} deg").format(peak.peak, degrees(peak.at));
}

std::string shown_status(Status status, double peak) {
  if (std::isinf(peak)) return to_string(status);
  return py::str("{}, peak={:.6g}").format(to_string(status), peak);
}

void add_parts(py::module_& module) {
  Class<AnyPosture> any_posture(module, "Posture", "A posture, with the holds of all loads.");
  any_posture.either("up", [](const auto& posture) -> Eigen::VectorXd { return posture.up; })
      .either("hold", [](const auto& posture) { return AnyHold{posture.hold()}; })
      .either("holdable", [](const auto& posture) { return posture.holdable(); })
      .either("manner", [](const auto& posture) { return posture.manner; })
      .either("value", [](const auto& posture) { return posture.value(); })
      .def("__repr__", each<AnyPosture>([](const auto& posture) {
             if (!posture.holdable())
               return py::str("Posture(up={}, unholdable)").format(shown(posture.up));
             return py::str("Posture(up={}, value={:.6g}, {})")
                 .format(shown(posture.up), posture.value(), to_string(posture.manner));
           }));
  add_loads(any_posture);

  Class<AnyStretch>(module, "UnholdableStretch")
      .either(
          "from_", [](const auto& stretch) { return stretch.from; },
          "[rad] from the start of the turn.")
      .either(
          "to", [](const auto& stretch) { return stretch.to; }, "[rad] from the start of the turn.")
      .either("at", [](const auto& stretch) { return stretch.at; })
      .either(
          "posture",
          []<int Dim>(const Stretch<Dim>& stretch) { return AnyPosture{stretch.posture}; },
          "One of the stretch, which cannot be held.")
      .either(
          "reason",
          []<int Dim>(const Stretch<Dim>& stretch) {
            return reason(only<Dim>(*stretch.grasp), stretch.posture.hold());
          },
          "Why it cannot be held, in words.")
      .def("__repr__", each<AnyStretch>([](const auto& stretch) {
             return py::str("UnholdableStretch({:.2f} to {:.2f} deg)")
                 .format(degrees(stretch.from), degrees(stretch.to));
           }));

  Class<AnyPeak>(module, "TurnPeak")
      .either("angle", [](const auto& peak) { return peak.angle; })
      .either("peak", [](const auto& peak) { return peak.peak; })
      .either("lower_bound", [](const auto& peak) { return peak.lower_bound; })
      .either("at", [](const auto& peak) { return peak.at; })
      .either(
          "posture", []<int Dim>(const Peak<Dim>& peak) { return AnyPosture{peak.posture}; },
          "There; where not all of the turn can be held, one that cannot.")
      .either(
          "unholdable",
          []<int Dim>(const Peak<Dim>& peak) {
            std::vector<AnyStretch> list;
            for (const UnholdableStretch<Dim>& stretch : peak.unholdable)
              list.push_back({Stretch<Dim>{stretch, peak.grasp}});
            return list;
          },
          "The stretches that cannot be held, in their order.")
      .def("__repr__", each<AnyPeak>([](const auto& peak) {
             return py::str("TurnPeak({:.2f} deg, {})")
                 .format(degrees(peak.angle), shown_peak(peak));
           }));
}

void add_ways(py::module_& module) {
  Class<WallPart>(module, "WallPart")
      .attribute("up", &WallPart::up)
      .attribute("cut", &WallPart::cut)
      .def("__repr__", [](const WallPart& part) {
        return py::str("WallPart(up={}, {})").format(shown(part.up), py::cast(part.cut));
      });

  Class<WayFrom>(module, "Way")
      .attribute("status", [](const WayFrom& way) { return way.status; })
      .attribute("peak", [](const WayFrom& way) { return way.peak; })
      .attribute("lower_bound", [](const WayFrom& way) { return way.lower_bound; })
      .attribute("ups", &ups, "(n, 3), from the start to the end; none where no way was found.")
      .attribute("orientations", &orientations,
                 "(n, 4): that to which each of the ups leads, object to world, as quaternions w, "
                 "x, y, z.")
      .attribute("wall", [](const WayFrom& way) { return way.wall; })
      .attribute("holds", [](const WayFrom& way) { return way.holds; })
      .def("__repr__", [](const WayFrom& way) {
        return py::str("Way({}, {} postures)")
            .format(shown_status(way.status, way.peak), way.ups.size());
      });
}

/// What turns of either dimension have.
template <int Dim>
auto add_turned(py::module_& module, const char* name, const char* words) {
  return Class<Turned<Dim>, AnyPeak>(module, name, words)
      .attribute("grasp", &Turned<Dim>::grasp, "What is turned.")
      .attribute(
          "objective", [](const Turned<Dim>& turn) { return turn.answer.settings.objective; },
          "Of which the peak is.")
      .attribute(
          "force_cap", [](const Turned<Dim>& turn) { return turn.answer.settings.force_cap; },
          "[weights]")
      .attribute(
          "now", [](const Turned<Dim>& turn) { return AnyPosture{turn.answer.now}; },
          "The posture at the start.")
      .attribute(
          "then", [](const Turned<Dim>& turn) { return AnyPosture{turn.answer.then}; },
          "The posture at the end.");
}

void add_turns(py::module_& module) {
  add_turned<2>(module, "PlanarTurn",
                "A turn in the plane: the shorter way round, and the other one.")
      .attribute(
          "from_", [](const Turned<2>& turn) { return turn.answer.settings.present; },
          "The posture at the start [rad], in (-pi, pi].")
      .attribute(
          "other",
          [](const Turned<2>& turn) -> std::optional<AnyPeak> {
            if (!turn.answer.taken.other) return {};
            return AnyPeak{Peak<2>{*turn.answer.taken.other, turn.grasp}};
          },
          "The other way round; None where it leaves the domain.")
      .def("__repr__", [](const Turned<2>& turn) {
        const TurnTaken<2>& taken = turn.answer.taken;
        const py::str other = taken.other ? shown_peak(*taken.other) : py::str("None");
        return py::str("PlanarTurn({:.2f} deg, {}; other: {})")
            .format(degrees(taken.straight.angle), shown_peak(taken.straight), other);
      });

  add_turned<3>(module, "SpatialTurn",
                "A turn in space: the straight one, which is the smallest, and the way of least "
                "peak. Quaternions\n(4,) are w, x, y, z.")
      .attribute(
          "from_", [](const Turned<3>& turn) { return write(turn.answer.orientation); },
          "The orientation at the start, object to world.")
      .attribute(
          "rotation", [](const Turned<3>& turn) { return write(turn.answer.taken.turn.rotation); },
          "The straight turn, in the world frame.")
      .attribute(
          "orientation",
          [](const Turned<3>& turn) { return write(turn.answer.taken.turn.orientation); },
          "To which it leads, object to world.")
      .attribute(
          "way",
          [](const Turned<3>& turn) -> std::optional<WayFrom> {
            if (!turn.answer.taken.way) return {};
            return WayFrom{*turn.answer.taken.way, turn.answer.orientation};
          },
          "The way of least peak; None where the start or the end cannot be held.")
      .def("__repr__", [](const Turned<3>& turn) {
        const TurnTaken<3>& taken = turn.answer.taken;
        return py::str("SpatialTurn({:.2f} deg, {}; way: {})")
            .format(degrees(taken.straight.angle), shown_peak(taken.straight),
                    taken.way ? shown_status(taken.way->status, taken.way->peak) : "None");
      });
}

void add_reachable(py::module_& module) {
  Class<Reachable<2>>(module, "PlanarReachable",
                      "The best posture that can be reached in the plane without ever needing more "
                      "than now.",
                      "Reachable")
      .attribute(
          "posture", [](const Reachable<2>& reachable) { return AnyPosture{reachable.posture}; },
          "The best one.")
      .attribute("angle", &Reachable<2>::angle,
                 "How far to turn there [rad], counter-clockwise positive.")
      .attribute("least_angle", &Reachable<2>::least_angle,
                 "How far no posture clockwise needs more than now [rad], at most 0.")
      .attribute("most_angle", &Reachable<2>::most_angle,
                 "How far none counter-clockwise does [rad]; a whole turn where there is no end.")
      .def("__repr__", [](const Reachable<2>& reachable) {
        return py::str("PlanarReachable({:.2f} deg, {})")
            .format(degrees(reachable.angle), AnyPosture{reachable.posture});
      });

  Class<ReachableFrom>(module, "SpatialReachable",
                       "The best posture that can be reached in space without ever needing more "
                       "than now.",
                       "Reachable")
      .attribute(
          "posture", [](const ReachableFrom& reachable) { return AnyPosture{reachable.posture}; },
          "The best one.")
      .attribute(
          "lower_bound", [](const ReachableFrom& reachable) { return reachable.lower_bound; },
          "V [N^2] or F: no posture that can be reached needs less.")
      .attribute(
          "way",
          [](const ReachableFrom& reachable) {
            return WayFrom{reachable.way, reachable.start};
          },
          "To it, by which at most 1 / (1 - gap) of what is needed now is needed. optimal: the "
          "posture is\nwithin the wanted gap of the bound.")
      .def("__repr__", [](const ReachableFrom& reachable) {
        return py::str("SpatialReachable({}, {})")
            .format(to_string(reachable.way.status), AnyPosture{reachable.posture});
      });
}

}  // namespace

void add_turn(py::module_& module) {
  add_parts(module);
  module.def(
      "posture_at",
      [](const AnyGrasp& any, const Eigen::VectorXd& up, double force_cap, Objective objective) {
        const HoldSettings settings{.force_cap = checked_cap(force_cap), .objective = objective};
        return std::visit(
            [&]<int Dim>(const Grasp<Dim>& grasp) {
              return AnyPosture{posture_at(grasp, unit<Dim>(up), settings)};
            },
            any.of);
      },
      py::arg("grasp"), py::arg("up"), py::kw_only(), py::arg("force_cap") = 1e6,
      py::arg("objective") = Objective::effort, py::call_guard<py::gil_scoped_release>(),
      "The least forces in the posture up (2,) or (3,) against each of the loads.");
  add_ways(module);
  add_turns(module);
  add_reachable(module);
  module.def(
      "turn", &turn, py::arg("grasp"), py::arg("to"), py::arg("from_") = py::none(), py::kw_only(),
      py::arg("domain") = Domain::all, py::arg("force_cap") = 1e6, py::arg("gap") = in_space.gap,
      py::arg("max_holds") = in_space.max_holds, py::arg("tilt") = py::none(),
      py::arg("objective") = Objective::effort,
      "What it takes to turn to another posture. In the plane both ways round, exactly: a\n"
      "PlanarTurn. In space the straight turn and the way of least peak, each between two bounds: "
      "a\n"
      "SpatialTurn.\n\n"
      "to: the posture at the end; in the plane an angle [rad] or up (2,), in space up (3,)\n"
      "from_: that at the start; in space also an orientation, object to world: a quaternion (4,) "
      "w,\nx, y, z. Left out, the object is as its frame is: 0, or (1, 0, 0, 0)\n"
      "domain: where both ends lie in it, a way round that leaves it is left out\n"
      "tilt: where both ends lie in it, the way of least peak stays in it\n"
      "gap, max_holds: in space, of the peak of the straight turn and of the way each\n"
      "Raises InvalidGrasp for settings out of their ranges.");
  module.def(
      "best_reachable", &reachable_asked, py::arg("grasp"), py::arg("from_"),
      py::arg("towards") = py::none(), py::kw_only(), py::arg("domain") = Domain::all,
      py::arg("force_cap") = 1e6, py::arg("gap") = in_space.gap,
      py::arg("max_holds") = in_space.max_holds, py::arg("tilt") = py::none(),
      py::arg("objective") = Objective::effort,
      "The best posture among those that can be reached from from_ without ever needing more than\n"
      "there: a PlanarReachable or a SpatialReachable. Arguments as of turn.\n\n"
      "towards: in space, up (3,) of the best posture of all, where to look first\n"
      "Raises InvalidGrasp for settings out of their ranges, and where from_ cannot be held.");
  module.def(
      "smallest_turn",
      [](const Eigen::VectorXd& orientation, const Eigen::VectorXd& up) {
        return write(smallest_turn(read_quaternion(orientation, "orientation"), unit<3>(up)));
      },
      py::arg("orientation"), py::arg("up"),
      "The smallest rotation, in the world frame, that takes an object from its orientation\n"
      "(object to world) to one in which up (3,) points along the world's +z. Quaternions "
      "(4,):\nw, x, y, z; that which is returned has w >= 0.");
}

}  // namespace poise::python
