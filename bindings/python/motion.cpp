#include <pybind11/numpy.h>

#include <cmath>

#include "module.hpp"
#include "poise/path_limits.hpp"
#include "poise/wrist_offset.hpp"
#include "values.hpp"

namespace poise::python {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A motion with what is known of its grasp.
struct Moved {
  MotionAnswer answer;
  SpeedLimit speed;
  std::vector<MotionState> states;
};

/// The object of a grasp of one load as a body.
Body body_of(const Grasp<3>& grasp, const std::optional<Eigen::Matrix3d>& inertia) {
  if (grasp.loads().size() != 1)
    throw InvalidGrasp("grasp", "has several loads, must have one: the weight that is moved");
  const Load<3>& load = grasp.loads().front();
  Body body{.mass = load.weight / standard_gravity, .com = load.com};
  if (!inertia) return body;
  body.inertia = *inertia;
  if (const std::string problem = inertia_problem(body.inertia); !problem.empty())
    throw InvalidGrasp("inertia", problem);
  return body;
}

void check_size(const Rows& rows, Eigen::Index count, Eigen::Index width, const std::string& name) {
  if (rows.rows() != count || rows.cols() != width)
    throw InvalidGrasp(
        name, "must have the shape (" + std::to_string(count) + ", " + std::to_string(width) + ")");
}

Trajectory trajectory_of(const Eigen::VectorXd& times, const Rows& positions,
                         const Rows& orientations, const std::optional<Rows>& accelerations) {
  check_size(positions, times.size(), 3, "positions");
  check_size(orientations, times.size(), 4, "orientations");
  if (accelerations) check_size(*accelerations, times.size(), 3, "accelerations");
  Trajectory trajectory;
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    trajectory.times.push_back(times[k]);
    trajectory.positions.emplace_back(positions.row(k));
    trajectory.orientations.emplace_back(orientations(k, 0), orientations(k, 1), orientations(k, 2),
                                         orientations(k, 3));
    if (accelerations) trajectory.accelerations.emplace_back(accelerations->row(k));
  }
  return trajectory;
}

Moved move(const AnyGrasp& any, const Eigen::VectorXd& times, const Rows& positions,
           const Rows& orientations, const std::optional<Rows>& accelerations,
           const std::optional<Eigen::Matrix3d>& inertia, Objective objective, double force_cap) {
  const Grasp<3>& grasp = only<3>(any);
  const Body body = body_of(grasp, inertia);
  const MotionSettings settings{objective, checked_cap(force_cap)};
  Moved moved;
  moved.states = motion_through(trajectory_of(times, positions, orientations, accelerations));
  moved.answer = motion(grasp, body, moved.states, settings);
  moved.speed = speed_limit(grasp, body, moved.states, settings);
  return moved;
}

WristOffset offset(const AnyGrasp& any, const Eigen::VectorXd& times, const Rows& positions,
                   const Rows& orientations, const std::optional<Rows>& accelerations,
                   const std::optional<Eigen::Matrix3d>& inertia, Objective objective,
                   double force_cap, double gap, int max_cells) {
  const Grasp<3>& grasp = only<3>(any);
  const std::vector<MotionState> states =
      motion_through(trajectory_of(times, positions, orientations, accelerations));
  return best_offset(grasp, body_of(grasp, inertia), states,
                     {objective, checked_cap(force_cap), gap, max_cells});
}

std::vector<PathLimits> limits(const AnyGrasp& any, const Rows& poses, const Array& derivatives,
                               const std::optional<Eigen::Matrix3d>& inertia, double force_cap) {
  const Grasp<3>& grasp = only<3>(any);
  const Body body = body_of(grasp, inertia);
  const MotionSettings settings{.force_cap = checked_cap(force_cap)};
  check_size(poses, poses.rows(), 7, "poses");
  if (derivatives.ndim() != 3 || derivatives.shape(0) != poses.rows() ||
      derivatives.shape(1) != 2 || derivatives.shape(2) != 6)
    throw InvalidGrasp("derivatives",
                       "must have the shape (" + std::to_string(poses.rows()) + ", 2, 6)");
  const double* d = derivatives.data();
  const py::gil_scoped_release unlocked;
  std::vector<PathLimits> result;
  for (Eigen::Index k = 0; k < poses.rows(); ++k, d += 12) {
    const Eigen::Quaterniond q(poses(k, 3), poses(k, 4), poses(k, 5), poses(k, 6));
    if (!(q.norm() > 0) || !std::isfinite(q.norm()))
      throw InvalidGrasp("poses[" + std::to_string(k) + "]", "must have a quaternion w, x, y, z");
    result.push_back(path_limits(
        grasp, body,
        {q.normalized(), Vector<3>(d), Vector<3>(d + 6), Vector<3>(d + 3), Vector<3>(d + 9)},
        settings));
  }
  return result;
}

template <class Get>
Eigen::VectorXd each_need(const Moved& moved, Get get) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(moved.answer.needs.size()));
  for (std::size_t k = 0; k < moved.answer.needs.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = get(moved.answer.needs[k]);
  return values;
}

Eigen::VectorXd vector_of(const SmallVector<double, 4>& rates) {
  return Eigen::Map<const Eigen::VectorXd>(rates.data(), static_cast<Eigen::Index>(rates.size()));
}

void add_types(py::module_& module) {
  py::class_<SpeedLimit>(module, "SpeedLimit", "How many times as fast a motion may run.")
      .def_readonly("holdable", &SpeedLimit::holdable, "Whether it is held at any speed.")
      .def_readonly("factor", &SpeedLimit::factor, "Every pose is held so many times as fast.")
      .def_readonly("bound", &SpeedLimit::bound,
                    "No factor above this holds the pose `state`; inf where 1000 is held.")
      .def_readonly("state", &SpeedLimit::state, "The pose that decides.")
      .def_property_readonly(
          "dual", [](const SpeedLimit& limit) -> Eigen::VectorXd { return limit.dual; },
          "What proves the bound, with the rates: a twist (6,), as of WeightEnd.")
      .def_property_readonly(
          "rates", [](const SpeedLimit& limit) { return vector_of(limit.rates); },
          "Of the drives, >= 0; empty: 0.")
      .def("__repr__", [](const SpeedLimit& limit) {
        return limit.holdable ? py::str("SpeedLimit(factor={:.6g})").format(limit.factor)
                              : py::str("SpeedLimit(unholdable)");
      });
  py::class_<Moved>(module, "Motion", "What the fingers need over a motion.")
      .def_property_readonly(
          "values",
          [](const Moved& moved) {
            return each_need(moved, [](const MotionNeed& need) { return need.value; });
          },
          "The least grip, or effort [N^2], of each pose (n,), where drives have no max; inf where "
          "no\nforces balance the load.")
      .def_property_readonly(
          "lower_bounds",
          [](const Moved& moved) {
            return each_need(moved, [](const MotionNeed& need) { return need.lower_bound; });
          },
          "On the values (n,), by the duals of the holds.")
      .def_property_readonly(
          "held",
          [](const Moved& moved) -> Eigen::Array<bool, Eigen::Dynamic, 1> {
            return each_need(moved, [](const MotionNeed& need) {
                     return need.held ? 1 : 0;
                   }).array() > 0;
          },
          "Whether each pose is held within the limits (n,).")
      .def_property_readonly(
          "accelerations",
          [](const Moved& moved) {
            Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows(
                static_cast<Eigen::Index>(moved.states.size()), 3);
            for (std::size_t k = 0; k < moved.states.size(); ++k)
              rows.row(static_cast<Eigen::Index>(k)) = moved.states[k].acceleration;
            return rows;
          },
          "Of the object frame's origin, world frame (n, 3): given, or of the spline.")
      .def_property_readonly(
          "slip", [](const Moved& moved) { return moved.answer.slip; },
          "The first pose that is not held, or None.")
      .def_property_readonly(
          "peak", [](const Moved& moved) { return moved.answer.peak; }, "The pose that needs most.")
      .def_property_readonly(
          "hold", [](const Moved& moved) { return AnyHold{moved.answer.hold}; }, "Its hold.")
      .def_property_readonly(
          "without",
          [](const Moved& moved) {
            py::dict values;
            for (std::size_t k = 0; k < moved.answer.without.size(); ++k)
              values[to_string(static_cast<LoadTerm>(k))] = moved.answer.without[k];
            return values;
          },
          "Its value without each term of the load: weight, linear, angular, centripetal.")
      .def_property_readonly(
          "cause",
          [](const Moved& moved) -> std::optional<std::string> {
            if (!moved.answer.cause) return {};
            return to_string(*moved.answer.cause);
          },
          "The term without which least is needed there; None where leaving out none helps.")
      .def_readonly("speed", &Moved::speed, "How many times as fast it may run.")
      .def("__repr__", [](const Moved& moved) {
        return py::str("Motion(peak {:.6g} at {})")
            .format(moved.answer.needs[moved.answer.peak].value, moved.answer.peak);
      });
  py::class_<WristOffset>(module, "WristOffset",
                          "The constant rotation in the wrist with which a motion needs least.")
      .def_readonly("optimal", &WristOffset::optimal,
                    "Whether value and lower_bound are within the wanted gap.")
      .def_property_readonly(
          "rotation",
          [](const WristOffset& found) {
            const Eigen::Quaterniond& q = found.rotation;
            return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
          },
          "A quaternion w, x, y, z (4,): orientations become R(t) Q.")
      .def_readonly("value", &WristOffset::value, "The greatest need over the motion with it.")
      .def_readonly("lower_bound", &WristOffset::lower_bound, "No rotation needs less.")
      .def_readonly("now", &WristOffset::now, "What is needed without it.")
      .def_readonly("state", &WristOffset::state, "The pose that needs most with it.")
      .def("__repr__", [](const WristOffset& found) {
        return py::str("WristOffset({:.6g}, now {:.6g})").format(found.value, found.now);
      });
  py::class_<PathLimits>(module, "PathLimits", "What is held at a point of a path.")
      .def_readonly("holdable", &PathLimits::holdable, "Whether anything is.")
      .def_property_readonly(
          "rows",
          [](const PathLimits& limits) {
            Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows(
                static_cast<Eigen::Index>(limits.rows.size()), 3);
            for (std::size_t k = 0; k < limits.rows.size(); ++k)
              rows.row(static_cast<Eigen::Index>(k)) << limits.rows[k].a, limits.rows[k].b,
                  limits.rows[k].most;
            return rows;
          },
          "(m, 3): a, b, c. What satisfies a s'' + b s'^2 <= c in all rows is held.")
      .def_property_readonly(
          "necessary",
          [](const PathLimits& limits) {
            Eigen::VectorXd values(static_cast<Eigen::Index>(limits.rows.size()));
            for (std::size_t k = 0; k < limits.rows.size(); ++k)
              values[static_cast<Eigen::Index>(k)] = limits.rows[k].necessary;
            return values;
          },
          "(m,): c of rows that all that is held satisfies.")
      .def_readonly("inside", &PathLimits::inside, "An (s'', s'^2) that is held, well within (2,).")
      .def_readonly("shrunk", &PathLimits::shrunk,
                    "To which part the rows shrink the necessary ones about inside: 0.99 or more "
                    "as a rule.")
      .def("__repr__", [](const PathLimits& limits) {
        return py::str("PathLimits({} rows)").format(limits.rows.size());
      });
}

}  // namespace

void add_motion(py::module_& module) {
  add_types(module);
  const py::call_guard<py::gil_scoped_release> unlocked;
  module.def("motion", &move, py::arg("grasp"), py::arg("times"), py::arg("positions"),
             py::arg("orientations"), py::kw_only(), py::arg("accelerations") = py::none(),
             py::arg("inertia") = py::none(), py::arg("objective") = Objective::grip,
             py::arg("force_cap") = 1e6, unlocked,
             "What the fingers need while the object moves through poses of its frame in the world:"
             " times\n(n,) [s], positions (n, 3) [m], orientations (n, 4), quaternions w, x, y, z."
             " Accelerations (n, 3)\nof the frame's origin are those of a spline where they are not"
             " given. inertia (3, 3) [kg m^2]:\nabout the com, object frame; None: a point mass.");
  module.def("best_offset", &offset, py::arg("grasp"), py::arg("times"), py::arg("positions"),
             py::arg("orientations"), py::kw_only(), py::arg("accelerations") = py::none(),
             py::arg("inertia") = py::none(), py::arg("objective") = Objective::grip,
             py::arg("force_cap") = 1e6, py::arg("gap") = 1e-2, py::arg("max_cells") = 20000,
             unlocked,
             "The constant rotation Q in the wrist (orientations R Q) with which the motion needs "
             "least,\nand a bound below which none does.");
  module.def(
      "path_limits", &limits, py::arg("grasp"), py::arg("poses"), py::arg("derivatives"),
      py::kw_only(), py::arg("inertia") = py::none(), py::arg("force_cap") = 1e6,
      "What is held at points of a path q(s): poses (n, 7), x, y, z and a quaternion w, x, y,"
      " z;\nderivatives (n, 2, 6) once and twice by s, linear and angular, in the world "
      "frame. For each point\nrows on (s'', s'^2), as planners of time-optimal motions take "
      "them.");
}

}  // namespace poise::python
