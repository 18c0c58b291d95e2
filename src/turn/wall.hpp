// Walls of postures that need too much, which no way gets past. Not installed.
#pragma once

#include <vector>

#include "turn/levels.hpp"

namespace poise::turns {

/// A part of a wall: on the arc to the next part's posture the half-space proves at least its
/// level.
struct Stone {
  Vector<3> up;
  HalfSpace half_space;
};

/// Whether a closed curve of arcs separates two postures: whether it crosses the arc between them
/// an odd number of times.
bool separates(const std::vector<Stone>& wall, const Vector<3>& a, const Vector<3>& b);

/// The wall of triangles that need at least the level, around what can be reached from corner 0
/// below it, towards corner 1.
std::vector<Stone> wall_of(const Values& values, const Mesh& mesh, double level);

}  // namespace poise::turns
