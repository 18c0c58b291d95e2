// The posture in which the fingers press least.
#pragma once

#include <optional>

#include "poise/posture_curve.hpp"

namespace poise {

/// A posture worth knowing: an optimum of the curve with its hold.
struct PlanarPosture {
  Optimum optimum;
  Hold<2> hold;
  Manner manner{Manner::resting};
  /// At a kink with exactly two loaded contacts, both slipping: where the edges of their friction
  /// cones meet [m, object frame], on the vertical through the centre of mass. None if parallel.
  std::optional<Vector<2>> edges_meet;
  bool two_slipping{false};  ///< whether edges_meet was asked for
};

/// The best posture of a planar grasp, the other minima, and their proof.
struct BestPosture {
  PostureCurve curve;                  ///< with the proof: its arcs and unholdable arcs
  std::vector<PlanarPosture> minima;   ///< in the order of the curve; the first is the best
  std::optional<PlanarPosture> worst;  ///< the posture of the domain that needs most
  std::optional<std::size_t> pinched;  ///< the lowest interior minimum that is pinched
  double lower_bound{0};               ///< on the effort in the whole domain, by the arcs' y [N^2]

  /// Whether no posture of the domain needs less than the best, as lower_bound proves, or, where
  /// there is none, none holds: false only where rounding hid what is there.
  bool optimal() const {
    return holdable() ? lower_bound >= (1 - 1e-6) * best().hold.effort : curve.undecided.empty();
  }
  /// Whether the object can be held in any posture of the domain.
  bool holdable() const { return !minima.empty(); }
  /// The first of the minima. Only where holdable().
  const PlanarPosture& best() const { return minima.front(); }
  /// The lowest interior minimum that is pinched; null where there is none.
  const PlanarPosture* best_pinched() const { return pinched ? &minima[*pinched] : nullptr; }
};

/// The best posture of a planar grasp, exactly.
BestPosture best_posture(const Grasp<2>& grasp, const CurveSettings& settings = {});

/// An optimum of a curve, with its hold, manner and meeting point.
PlanarPosture posture_at(const Grasp<2>& grasp, const Optimum& optimum,
                         const CurveSettings& settings = {});

}  // namespace poise
