// Space: the posture in which the fingers press least, with its certificate: docs/theory.md,
// "Space".
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "poise/hold.hpp"

namespace poise {

/// Postures to choose from: `up` at most an angle away from a given direction.
struct Tilt {
  Vector<3> from;  ///< unit vector, object frame
  double most{0};  ///< [rad], 0 to pi/2
};

/// What to search, and how far.
struct SpatialSettings {
  double gap{1e-6};            ///< wanted: (effort - lower_bound) / effort of the best, > 0
  int max_holds{2000};         ///< holds to spend on the certificate
  double force_cap{1e6};       ///< in weights of the heaviest scenario
  std::optional<Tilt> tilt{};  ///< none: all postures
  /// Postures, spread over the domain, from which local minima are sought. 0: none are sought, and
  /// `minima` holds only the best.
  int starts{64};
};

/// How sure the best posture is.
enum class Status {
  optimal,     ///< the best posture is within the wanted gap
  gap,         ///< it is not, or nothing holdable was found and that nothing is was not proven
  unholdable,  ///< proven: no posture of the domain can be held
};
/// The name of the value: "optimal".
const char* to_string(Status status);

/// A posture in space, with its hold.
struct SpatialPosture {
  Vector<3> up;  ///< unit vector, object frame
  Hold<3> hold;  ///< of the scenario that decides
  Manner manner{Manner::resting};
  std::size_t scenario{0};               ///< the one that needs the greatest effort
  std::vector<double> scenario_efforts;  ///< [N^2]
  /// V of the hold [N^2].
  double effort() const { return hold.effort; }
};

/// Cuts off postures: by the y of a scenario, or a plane of the tilt.
struct Cut {
  /// A twist about the object frame's origin [N, N/m]: for every x in R^3, weight x through the
  /// com of the scenario needs an effort of at least 2 (y . w(x) - phi(G^T y)).
  Twist<3> y = Twist<3>::Zero();
  std::size_t scenario{0};
  std::optional<Vector<3>> n;  ///< n . x <= 0 in the whole domain; then y and scenario say nothing
};

/// The best posture of a spatial grasp, the other minima that were found, and its certificate.
struct BestSpatialPosture {
  Status status{Status::gap};
  std::optional<SpatialPosture> best;
  /// Local minima over the domain, best first, found by descent from many starts: not proven
  /// complete.
  std::vector<SpatialPosture> minima;
  /// The lowest of the minima that is pinched and inside the domain and the holdable set; null
  /// where there is none.
  const SpatialPosture* best_pinched() const { return pinched ? &minima[*pinched] : nullptr; }
  std::optional<std::size_t> pinched;
  /// On the effort in the whole domain [N^2]: no unit vector x satisfies all cuts with
  /// 2 (y . w(x) - phi(G^T y)) <= lower_bound, or it is no more than the square of the greatest
  /// weight over the sum of shares. Where unholdable, above the square of the force cap.
  double lower_bound{0};
  double relative_gap{0};  ///< (effort - lower_bound) / effort; 0 where there is no best
  std::vector<Cut> cuts;   ///< the certificate
  int holds{0};            ///< spent on the certificate
};

/// The best posture of a spatial grasp, certified.
/// @throws InvalidGrasp for settings out of their ranges.
BestSpatialPosture best_posture(const Grasp<3>& grasp, const SpatialSettings& settings = {});

/// The posture whose worst scenario needs least. Scenarios are grasps with the same contacts and
/// their own weights and centres of mass; each finds its own forces.
/// @throws InvalidGrasp also where there are no scenarios or their contacts differ.
BestSpatialPosture best_posture(const std::vector<Grasp<3>>& scenarios,
                                const SpatialSettings& settings = {});

/// The smallest rotation, in the world frame, that takes an object from its orientation (object to
/// world) to one in which `up` (unit vector, object frame) points along the world's +z. w >= 0.
/// Where `up` points straight down now, the axis is the world's x.
Eigen::Quaterniond smallest_turn(const Eigen::Quaterniond& orientation, const Vector<3>& up);

}  // namespace poise
