// What a motion asks of a grasp: docs/command-line.md, "motion". Here program and Python meet the
// solver.
#pragma once

#include <string>
#include <vector>

#include "ask/question.hpp"
#include "files/trajectory_file.hpp"
#include "poise/wrist_offset.hpp"

namespace poise {

struct SpatialFile;
template <int Dim>
class Grasp;

/// What moves, how, and what that takes.
struct MotionReport {
  MotionSettings settings;
  std::vector<MotionState> states;
  bool accelerations_given{false};  ///< else the second derivatives of the spline
  MotionAnswer motion;
  SpeedLimit speed;
  std::optional<WristOffset> offset{};
};

/// The object of a grasp file as a body: weight and com of its first load, and its inertia where
/// the motion turns it.
/// @param name  of the file, for messages
/// @throws FileError where the object has no mass, or an inertia is missing
Body body_of(const SpatialFile& file, const std::string& name,
             const std::vector<MotionState>& states);

/// Objective and force cap of the question count; an objective that it does not give is that of the
/// file.
/// @throws as motion()
MotionReport move(const Grasp<3>& grasp, const Body& body, const Trajectory& trajectory,
                  const MotionSettings& settings);

/// The JSON document: what is needed where it is most, and how fast it may run.
std::string document(const Grasp<3>& grasp, const MotionReport& report);
/// A row for each pose: t, grip or force_norm, lower_bound, held. Empty cells: no forces hold it.
std::string csv_of(const MotionReport& report);

}  // namespace poise
