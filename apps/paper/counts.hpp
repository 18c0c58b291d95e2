// How often b is what the paper takes it for: counts over random grasps, the same in every run.
#pragma once

#include <cstddef>
#include <cstdint>

namespace poise::study {

/// Disks with phi in [0.3, pi/2] and frictions cot(phi) + 10^u, u in [-3, 1], all uniform.
struct DiskCounts {
  std::size_t disks{0};
  std::size_t b_is_no_minimum{0};
};
DiskCounts count_disks(std::size_t disks, std::uint64_t seed);

/// Ellipses with semi-axes 1 and [0.3, 1], two contacts anywhere on the boundary, one friction in
/// [0.1, 1.5] for both, the centre of mass off the centre by up to `off_centre` of each semi-axis,
/// all uniform: what the best of all postures is (found by the library).
struct EllipseCounts {
  std::size_t ellipses{0};
  std::size_t unholdable{0};    ///< in every posture
  std::size_t kink{0};          ///< a kink: both slip, the edges meet on the vertical
  std::size_t kink_pinched{0};  ///< of these, not in the fork of the fingers
  std::size_t end{0};           ///< both slip where the holdable postures end
  std::size_t resting{0};       ///< one finger carries all
  std::size_t smooth{0};        ///< both carry, and V has a smooth minimum
  /// Ellipses with a best posture in which they are pinched up, and those where the edges meet
  /// there.
  std::size_t pinched{0}, pinched_where_edges_meet{0};
};
EllipseCounts count_ellipses(std::size_t ellipses, double off_centre, std::uint64_t seed);

}  // namespace poise::study
