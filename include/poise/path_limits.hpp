// What a grasp allows along a path, for planners of time-optimal motions: docs/theory.md, "Motion".
#pragma once

#include <vector>

#include "poise/motion.hpp"

namespace poise {

/// A point of a path q(s), with derivatives by s in the world frame.
struct PathPoint {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< object to world, length 1
  Vector<3> velocity = Vector<3>::Zero();                           ///< of the frame's origin, by s
  Vector<3> acceleration = Vector<3>::Zero();                       ///< and once more by s
  Vector<3> angular_velocity = Vector<3>::Zero();                   ///< by s
  Vector<3> angular_acceleration = Vector<3>::Zero();               ///< and once more by s
};

/// a s'' + b s'^2 <= most.
struct PathRow {
  double a, b;
  double most;       ///< whatever satisfies all rows is held
  double necessary;  ///< whatever is held satisfies this; infinite: nothing is known beyond `most`
};

/// What is held at a point of a path.
struct PathLimits {
  bool holdable{false};                  ///< whether anything is, with s'^2 >= 0
  std::vector<PathRow> rows;             ///< bound a polygon; empty where nothing is held
  Vector<2> inside = Vector<2>::Zero();  ///< an (s'', s'^2) that is held, well within
  /// The rows' polygon is the necessary one shrunk to so much about `inside`: 0.99 or more, but
  /// where 60 rows were not enough.
  double shrunk{0};
};

/// The (s'', s'^2) with which a body is held within the limits of contacts and drives at a point of
/// a path: a convex set of the plane, between two polygons. As a rule 5 to 25 rows. Nothing is
/// looked for beyond loads of 1e7 weights.
/// @throws InvalidGrasp where a number is not finite, or nothing moves
PathLimits path_limits(const Hand<3>& hand, const Body& body, const PathPoint& point,
                       const MotionSettings& settings = {});

}  // namespace poise
