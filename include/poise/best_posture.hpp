// The posture in which the fingers press least, in the plane and in space, with its proof:
// docs/theory.md, "The posture curve" and "Space".
#pragma once

#include <optional>
#include <vector>

#include "poise/posture_curve.hpp"

namespace poise {

/// How sure the best posture is.
enum class Status {
  optimal,     ///< the best posture is within the wanted gap
  gap,         ///< it is not, or nothing holdable was found and that nothing is was not proven
  unholdable,  ///< proven: no posture of the domain can be held
};
/// The name of the value: "optimal".
const char* to_string(Status status);

/// Postures in space to choose from: `up` at most an angle away from a given direction.
struct Tilt {
  Vector<3> from;  ///< unit vector, object frame
  double most{0};  ///< [rad], 0 to pi/2
};

/// What to search in space, and how far.
struct SpatialSettings {
  Objective objective{Objective::effort};  ///< what the best posture needs least of
  double gap{1e-6};            ///< wanted: (value - lower_bound) / value of the best, > 0
  int max_holds{2000};         ///< holds to spend on the certificate
  double force_cap{1e6};       ///< in weights of the heaviest load
  std::optional<Tilt> tilt{};  ///< none: all postures
  /// Postures, spread over the domain, from which local minima are sought. 0: none are sought, and
  /// `minima` holds only the best.
  int starts{64};
};

/// Cuts off postures in space: by the y of a load, or a plane of the tilt.
struct Cut {
  /// A twist about the object frame's origin [N, N/m]: for every x in R^3, the load with x for the
  /// unit vector `up` needs an effort of at least 2 (y . w(x) - phi(G^T y)).
  Twist<3> y = Twist<3>::Zero();
  std::size_t load{0};
  std::optional<Vector<3>> n;  ///< n . x <= 0 in the whole domain; then y and load say nothing
  /// Of the drives, >= 0, where they say something. For effort they and their max are taken into
  /// account; for grip (sum of rates) F >= y . w(x) - what contacts with limits can do.
  std::optional<std::vector<double>> rates{};
};

/// A minimum of the effort over the postures of the plane: an optimum of the curve with its holds.
template <int Dim>
struct Minimum : Posture<Dim> {};
template <>
struct Minimum<2> : Posture<2> {
  Optimum optimum;
  /// At a kink with exactly two loaded contacts, both slipping against nothing but a weight: where
  /// the edges of their friction cones meet [m, object frame], on the vertical through the centre
  /// of mass. None if parallel.
  std::optional<Vector<2>> edges_meet;
  bool two_slipping{false};  ///< whether edges_meet was asked for
};

/// What proves that no posture needs less: in the plane the curve, in space cuts.
template <int Dim>
struct Proof;
template <>
struct Proof<2> {
  PostureCurve curve;               ///< with its arcs and unholdable arcs
  std::optional<Minimum<2>> worst;  ///< the posture of the domain that needs most
};
template <>
struct Proof<3> {
  /// No unit vector x satisfies all cuts with 2 (y . w(x) - phi(G^T y)) <= lower_bound, or
  /// lower_bound is no more than the square of the greatest weight over the sum of shares.
  std::vector<Cut> cuts;
  int holds{0};  ///< spent on it
};

/// The best posture, the other minima, and the proof.
template <int Dim>
struct Best {
  Status status{Status::gap};
  /// Best first. In the plane all there are; in space those found by descent from many starts.
  std::vector<Minimum<Dim>> minima;
  /// The lowest of the minima that is pinched, and inside the domain and the holdable postures.
  std::optional<std::size_t> pinched;
  /// On the effort [N^2] or the grip in the whole domain, by the proof. Where unholdable in space,
  /// above what counts as held.
  double lower_bound{0};
  double relative_gap{0};  ///< (value - lower_bound) / value; 0 where nothing holds
  Proof<Dim> proof;

  /// Whether a posture was found in which all loads can be held.
  bool holdable() const { return !minima.empty(); }
  /// The first of the minima. Only where holdable().
  const Minimum<Dim>& best() const { return minima.front(); }
  /// The lowest of the minima that is pinched; null where there is none.
  const Minimum<Dim>* best_pinched() const { return pinched ? &minima[*pinched] : nullptr; }
};

/// The best posture of a planar grasp, exactly: the one whose worst load needs least.
/// @throws InvalidGrasp for settings out of their ranges
Best<2> best_posture(const Grasp<2>& grasp, const CurveSettings& settings = {});

/// The best posture of a spatial grasp, certified: the one whose worst load needs least.
/// @throws InvalidGrasp for settings out of their ranges
Best<3> best_posture(const Grasp<3>& grasp, const SpatialSettings& settings = {});

/// An optimum of a curve, with its hold, manner and meeting point.
Minimum<2> minimum_at(const Grasp<2>& grasp, const Optimum& optimum,
                      const CurveSettings& settings = {});

}  // namespace poise
