// Postures that a robot can reach, ranked by what the fingers need: docs/command-line.md.
#pragma once

#include <string>
#include <vector>

#include "ask/ask.hpp"

namespace poise {

/// A row of a table of candidates.
template <int Dim>
struct Candidate {
  std::size_t row{0};                               ///< from 1, without the header
  Vector<Dim> up;                                   ///< unit vector against gravity, object frame
  std::optional<double> angle_deg{};                ///< in the plane, where it was given
  std::optional<Eigen::Quaterniond> orientation{};  ///< in space, where it was given
  std::vector<std::string> others{};                ///< cells of further columns
};

template <int Dim>
struct Candidates {
  std::vector<std::string> others;  ///< names of further columns
  std::vector<Candidate<Dim>> list;
};

/// Reads a file with a header. In space rows are quaternions (columns w, x, y, z or qw, qx, qy, qz,
/// object to world) or ups (up_x, up_y, up_z); in the plane angle_deg, or up_x, up_y.
/// @throws FileError that names file, row and column
template <int Dim>
Candidates<Dim> read_candidates(const std::string& file);

/// What a candidate needs, and the straight turn to it.
template <int Dim>
struct RankedCandidate {
  const Candidate<Dim>* candidate;
  bool holdable{false};
  Manner manner{};
  std::optional<double> grip{};
  double effort{0};
  double turn{0};  ///< [rad]: of the posture; an orientation is reached by a turn about z after it
  double peak{0}, peak_lower_bound{0};  ///< V [N^2] or F; infinite where the turn cannot be held
  double peak_at{0};                    ///< [rad]
};

/// The candidates, those first that need least; of equal ones (within 1e-6) that with the lower
/// peak of the turn to it, then the shorter turn. Those that cannot be held are last. On all cores.
template <int Dim>
std::vector<RankedCandidate<Dim>> ranked(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                                         const Question& question,
                                         const Candidates<Dim>& candidates);

/// JSON Lines, one for each.
template <int Dim>
std::string lines_of(const Candidates<Dim>& candidates,
                     const std::vector<RankedCandidate<Dim>>& ranked);

}  // namespace poise
