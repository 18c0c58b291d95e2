#include "ask/motion.hpp"

#include <algorithm>
#include <cmath>

#include "files/grasp_file.hpp"
#include "files/inertia_field.hpp"
#include "files/json_text.hpp"
#include "files/json_value.hpp"
#include "poise/grip.hpp"

namespace poise {
namespace {

/// [rad/s, rad/s^2]: what rounding leaves of an object that is not turned.
constexpr double still = 1e-9;

/// F, or the force norm.
double told(const MotionReport& report, double value) {
  return report.settings.objective == Objective::grip ? value : std::sqrt(value);
}

const char* name_of(Objective objective) {
  return objective == Objective::grip ? "grip" : "force_norm";
}

Json place(const MotionReport& report, std::size_t state) {
  return {{"row", state + 1}, {"t", json_value(report.states[state].time)}};
}

Json peak(const MotionReport& report) {
  const MotionAnswer& motion = report.motion;
  const MotionNeed& need = motion.needs[motion.peak];
  Json result = place(report, motion.peak);
  result[name_of(report.settings.objective)] = json_value(told(report, need.value));
  result["lower_bound"] = json_value(told(report, need.lower_bound));
  result["cause"] = motion.cause ? Json(to_string(*motion.cause)) : Json();
  for (std::size_t k = 0; k < motion.without.size(); ++k)
    result["without"][to_string(static_cast<LoadTerm>(k))] =
        json_value(told(report, motion.without[k]));
  return result;
}

Json speed(const MotionReport& report) {
  const SpeedLimit& speed = report.speed;
  Json result = {{"factor", speed.holdable ? json_value(speed.factor) : Json()},
                 {"bound", json_value(speed.bound)}};
  result.update(place(report, speed.state));
  result["y"] = json_value(speed.dual);
  result["rates"] = std::vector<double>(speed.rates.begin(), speed.rates.end());
  return result;
}

Json offset(const MotionReport& report) {
  const WristOffset& offset = *report.offset;
  const Eigen::Quaterniond& q = offset.rotation;
  Json result = {{"rotation", {{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}}},
                 {name_of(report.settings.objective), json_value(told(report, offset.value))},
                 {"lower_bound", json_value(told(report, offset.lower_bound))},
                 {"optimal", offset.optimal}};
  result.update(place(report, offset.state));
  return result;
}

}  // namespace

Body body_of(const SpatialFile& file, const std::string& name,
             const std::vector<MotionState>& states) {
  const Load<3>& load = file.loads.front();
  if (!(load.weight > 0))
    throw FileError(name, {}, "object", "has no mass, must have one to be moved");
  Body body{.mass = load.weight / standard_gravity, .com = load.com};
  if (std::any_of(states.begin(), states.end(), [](const MotionState& state) {
        return state.angular_velocity.norm() > still || state.angular_acceleration.norm() > still;
      }))
    body.inertia = inertia_of(file, name);
  return body;
}

MotionReport move(const Grasp<3>& grasp, const Body& body, const Trajectory& trajectory,
                  const MotionSettings& settings) {
  MotionReport report{.settings = settings,
                      .states = motion_through(trajectory),
                      .accelerations_given = !trajectory.accelerations.empty()};
  report.motion = motion(grasp, body, report.states, settings);
  report.speed = speed_limit(grasp, body, report.states, settings);
  return report;
}

std::string document(const Grasp<3>& grasp, const MotionReport& report) {
  const MotionAnswer& motion = report.motion;
  const Objective objective = report.settings.objective;
  Json result = {{"poise_result", 1},
                 {"command", "motion"},
                 {"objective", to_string(objective)},
                 {"unit", objective == Objective::grip ? to_string(grip_unit(grasp)) : "N"},
                 {"poses", report.states.size()},
                 {"accelerations", report.accelerations_given ? "given" : "spline"},
                 {"holdable", !motion.slip},
                 {"slip", motion.slip ? place(report, *motion.slip) : Json()},
                 {"peak", peak(report)},
                 {"speed", speed(report)}};
  if (report.offset) result["offset"] = offset(report);
  return json_text(result);
}

std::string csv_of(const MotionReport& report) {
  std::string text = std::string("t,") + name_of(report.settings.objective) + ",lower_bound,held\n";
  const auto add = [&](double value) {
    if (std::isfinite(value)) text += json_value(value).dump();
    text += ',';
  };
  for (std::size_t k = 0; k < report.states.size(); ++k) {
    const MotionNeed& need = report.motion.needs[k];
    const bool balanced = std::isfinite(need.value);
    add(report.states[k].time);
    add(told(report, need.value));
    add(balanced ? told(report, need.lower_bound) : need.value);
    text += need.held ? "1\n" : "0\n";
  }
  return text;
}

}  // namespace poise
