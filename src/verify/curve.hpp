// The posture curve: arcs, how they follow each other, their optima, and what they prove.
#pragma once

#include "ask/claims.hpp"
#include "verify/trig.hpp"

namespace poise::verify {

/// An arc that is claimed, and where. On it all contacts keep to their faces.
struct RealArc {
  Path place;
  Real from{0}, to{0};
  Effort value;               ///< V or F
  Mat3 y;                     ///< times harmonics(theta)
  std::vector<Real> rates{};  ///< of grip
  std::size_t load{0};        ///< against which it is

  /// Within rounding of where arcs end; a single posture is not.
  bool is_sliver() const;
};

/// A grasp with each of its loads alone.
using EachLoad = std::vector<RealGrasp>;
EachLoad each_load(const RealGrasp& grasp);

/// Checks that the y of each arc gives forces that balance its load all along it, at an effort of
/// V: then it also proves that no others have less. Of grip that its forces balance, and that y and
/// the rates prove their grip.
std::vector<RealArc> check_arcs(Verdict& verdict, const Path& list, const EachLoad& grasps,
                                const std::vector<ArcClaim>& arcs, const OptionsClaim& options);
/// Checks the load that is named where there are several, and returns it.
std::size_t check_named_load(Verdict& verdict, const Path& place, const EachLoad& grasps,
                             const std::optional<std::size_t>& load);

/// Checks that along each arc every load is held with no more, by its own curve.
void check_envelope(Verdict& verdict, const EachLoad& grasps, const std::vector<RealArc>& arcs,
                    const std::vector<std::vector<RealArc>>& curves, const OptionsClaim& options);

/// Checks an arc of the grip curve.
void check_grip_arc(Verdict& verdict, const RealGrasp& grasp, const RealArc& arc,
                    const ArcClaim& claim, Real force_cap);
/// Checks what an arc says a contact does, by its force in the middle.
void check_arc_state(Verdict& verdict, const Path& place, const RealContact& contact, Real weight,
                     const Vec& force, const ArcState& claim);

/// What y and rates prove of the grip in all postures, times harmonics(theta).
Vec3 grip_proof(const RealGrasp& grasp, const Vec& y, const std::vector<Real>& rates,
                Real force_cap);

/// The planar postures to choose from [rad]: from <= to <= from + 2 pi.
struct RealDomain {
  Real from{0}, to{0};
  bool circle{false};  ///< all postures
};
RealDomain domain_of(const RealGrasp& grasp, Domain domain);

/// Arcs that follow each other without a break.
struct Chain {
  std::vector<RealArc> arcs;  ///< unwound
  bool circle{false};
  Real from() const { return arcs.front().from; }
  Real to() const { return arcs.back().to; }
};

/// Checks that the arcs tile the holdable intervals, a list, and keep to the domain.
std::vector<Chain> check_tiling(Verdict& verdict, const Path& list,
                                const std::vector<RealArc>& arcs,
                                const std::vector<Interval>& holdable, const RealDomain& domain);

/// An optimum that is claimed, and where.
struct RealOptimum {
  Path place;
  OptimumClaim claim;
  Real angle{0};        ///< theta [rad]
  Real from{0}, to{0};  ///< the stretch
  Real value{0};        ///< that of its arc
  Real rounding{0};     ///< of that value: arcs are steep
};

/// Checks an optimum by itself and where it lies on the arcs.
RealOptimum check_optimum(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                          const OptimumClaim& claim, const std::vector<Chain>& chains,
                          Extremum type, const OptionsClaim& options);

/// Checks that a list holds every minimum or maximum of the arcs, each once, and in their order.
void check_complete(Verdict& verdict, const Path& list, const std::vector<RealOptimum>& optima,
                    const std::vector<Chain>& chains, Extremum type, Real present);

/// Checks that the y of each unholdable arc proves all its postures. A longer or shorter y is as
/// good.
void check_unholdable(Verdict& verdict, const EachLoad& grasps,
                      const std::vector<UnholdableClaim>& unholdable, Real force_cap);

/// Checks that arcs and unholdable arcs cover the domain, if `status` says so, and returns the
/// least value that is proven there.
Real check_cover(Verdict& verdict, const EachLoad& grasps, const std::vector<RealArc>& arcs,
                 const std::vector<UnholdableClaim>& unholdable, const RealDomain& domain,
                 Status status, const OptionsClaim& options);

}  // namespace poise::verify
