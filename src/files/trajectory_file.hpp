// Trajectories as tables: docs/command-line.md, "motion".
#pragma once

#include <string>
#include <vector>

#include "poise/motion.hpp"

namespace poise {

/// A trajectory, read and checked.
struct TrajectoryFile {
  Trajectory trajectory;
  std::vector<int> lines;               ///< of the rows in the file, from 1
  std::vector<std::string> warnings{};  ///< whole lines, "FILE:LINE:COLUMN: row, column: words"
};

/// Reads a table with the columns t [s], x, y, z [m], qw, qx, qy, qz (object to world) and, if it
/// has them, ax, ay, az [m/s^2]; "-" is standard input. Other columns are passed over.
/// @throws FileError that names file, row and column
TrajectoryFile read_trajectory(const std::string& file);

/// What looks like another unit than metres and seconds in how it moves, in whole lines.
std::vector<std::string> doubts(const TrajectoryFile& read, const std::vector<MotionState>& states,
                                const std::string& file);

}  // namespace poise
