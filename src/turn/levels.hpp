// What the triangles of the sphere say of ways from corner to corner. Not installed.
#pragma once

#include <vector>

#include "turn/mesh.hpp"

namespace poise::turns {

/// For each corner the least level at which ways from a corner to it may pass, or do.
struct Levels {
  std::vector<double> p;
  std::vector<int> before;  ///< the corner before on such a way; -1 where there is none

  double to(int corner) const { return p[static_cast<std::size_t>(corner)]; }
  /// The corners of the way, both ends included.
  std::vector<int> way(int corner) const;
};

/// No way to a corner has a lower peak: through triangles, of which each has a least p. Not through
/// those that have `most` or more.
Levels levels_proven(const Mesh& mesh, int from, double most = infinity);
/// Ways along edges have no higher peak than this.
Levels levels_reached(Mesh& mesh, int from);

/// Of the triangles through which a way at this level may lead, those of which it is not sure, on a
/// way to one of the corners `to` that meets as few of them as possible. Empty where it is sure.
std::vector<int> doubtful_on_way(Mesh& mesh, int from, const std::vector<int>& to, double level);

/// Cuts triangles in two. False where all are as small as they get.
bool refine(Mesh& mesh, const std::vector<int>& triangles);

}  // namespace poise::turns
