#include "tables/motion.hpp"

#include <fmt/core.h>

#include <cmath>

#include "tables/parts.hpp"

namespace poise {
namespace {

constexpr const char* term_words[] = {"its weight", "the acceleration of the frame",
                                      "the angular acceleration", "turning at a steady rate"};

std::string seconds(double time) { return plain(time) + " s"; }

/// "after 0.125 s (row 51)"
std::string place_text(const MotionReport& report, std::size_t state) {
  return fmt::format("at {} (row {})", seconds(report.states[state].time), state + 1);
}

std::string slip_text(const Grasp<3>& grasp, const Body& body, const MotionReport& report) {
  if (!report.motion.slip) return "It is held all the time.";
  const std::size_t slip = *report.motion.slip;
  const Wrench<3> load = motion_load(body, report.states[slip]).at();
  const double weight = body.mass * standard_gravity;
  const Hold<3> hold = poise::hold<3>(grasp, load, weight, Twist<3>::Zero(),
                                      {report.settings.force_cap, report.settings.objective});
  const std::string why = hold.holdable ? "" : ": " + reason(grasp, hold);
  return fmt::format("It slips, first {}{}.", place_text(report, slip), why);
}

std::string speed_text(const MotionReport& report) {
  const SpeedLimit& speed = report.speed;
  if (!speed.holdable)
    return "No speed holds it, however slow: " + place_text(report, speed.state) +
           " it cannot be held.";
  if (!std::isfinite(speed.bound))
    return fmt::format("It may run {} times as fast, or faster.", plain(speed.factor));
  return fmt::format("It {} run {} times as fast{}: then it is at the limit {}.",
                     speed.factor >= 1 ? "may" : "may only", plain(speed.factor),
                     speed.factor >= 1 ? ", no faster" : "", place_text(report, speed.state));
}

std::string offset_text(const Grasp<3>& grasp, const MotionReport& report) {
  const WristOffset& offset = *report.offset;
  const Objective objective = report.settings.objective;
  const Eigen::Quaterniond& q = offset.rotation;
  const Eigen::AngleAxisd turn(q);
  if (!std::isfinite(offset.value))
    return std::isfinite(offset.lower_bound)
               ? "No turn in the wrist was found with which it can be held."
               : "No turn in the wrist holds it.";
  std::string text =
      offset.value < offset.now
          ? fmt::format(
                "Turned in the wrist by {} about {} of the object (quaternion {:.6f}, "
                "{:.6f}, {:.6f}, {:.6f}) it needs at most {}",
                degrees_text(turn.angle()), posture_text(Vector<3>(turn.axis())), q.w(), q.x(),
                q.y(), q.z(), need_text(grasp, objective, offset.value))
          : "No turn in the wrist was found with which it needs less";
  return text + fmt::format("; {}no turn needs less than {}.",
                            offset.optimal ? "" : "this is not proven to be the best: ",
                            need_text(grasp, objective, offset.lower_bound));
}

}  // namespace

std::string need_text(const Grasp<3>& grasp, Objective objective, double value) {
  if (!std::isfinite(value)) return "cannot be held";
  return objective == Objective::grip ? grip_text(grasp, value) : newtons(std::sqrt(value));
}

std::string report(const std::string& name, const Grasp<3>& grasp, const Body& body,
                   const MotionReport& report, const Style& style) {
  const MotionAnswer& motion = report.motion;
  const Objective objective = report.settings.objective;
  const auto text = [&](double value) { return need_text(grasp, objective, value); };
  const std::string what = objective == Objective::grip ? "grip" : "force norm";
  std::string words =
      fmt::format("{} poses in {}; accelerations are {}. ", report.states.size(),
                  seconds(report.states.back().time - report.states.front().time),
                  report.accelerations_given
                      ? "those of the table, angular ones those of a spline through the poses"
                      : "those of a spline through the poses");
  const double most = motion.needs[motion.peak].value;
  words += std::isfinite(most)
               ? fmt::format("The greatest {} is {}, {}. ", what, style.bold(text(most)),
                             place_text(report, motion.peak))
               : "";
  std::string result = title(name, style) +
                       wrapped(words + slip_text(grasp, body, report) + " " + speed_text(report));
  Table table({"<" + place_text(report, motion.peak), what, "<"});
  table.add({"with all of its load", text(most), ""});
  for (std::size_t k = 0; k < motion.without.size(); ++k)
    table.add({std::string("without ") + term_words[k], text(motion.without[k]),
               motion.cause && static_cast<std::size_t>(*motion.cause) == k ? "decides" : ""});
  result += "\n" + table.text(style);
  if (report.offset) result += "\n" + wrapped(offset_text(grasp, report));
  return result;
}

}  // namespace poise
