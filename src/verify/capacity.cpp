#include <cmath>
#include <limits>

#include "verify/checks.hpp"

namespace poise::verify {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();
constexpr Real loose = 1e-9L;  ///< a force cap of 1e6 weights makes that of doubles felt

/// The grasp with one load, in one posture.
struct Case {
  RealGrasp grasp;
  Vec up;
  Real cap;  ///< [weights]

  const RealLoad& load() const { return grasp.loads.front(); }
};

RealGrasp with_weight(RealGrasp grasp, Real weight) {
  grasp.loads.front().weight = weight;
  return grasp;
}

/// The contacts without max_normal alone.
RealGrasp without_limits(RealGrasp grasp) {
  for (RealContact& contact : grasp.contacts) {
    contact.least = 0;
    if (std::isfinite(contact.most)) contact.most = 0;
  }
  return grasp;
}

/// Checks a hold at a limit of what can be held: how little effort it takes loose leaves open.
template <int Dim>
void check_at_limit(Verdict& verdict, const Path& place, const Case& given, const RealGrasp& grasp,
                    const std::optional<HoldClaim<Dim>>& hold) {
  verdict.check(place, "at a limit there is a hold", hold && hold->holdable);
  if (!hold) return;
  check_hold(verdict, place, grasp, *hold, given.cap);
  verdict.check(place, "the hold is of the posture asked for", (real(hold->up) - given.up).norm(),
                1e-12L);
}

/// Checks the bounds of the weights that can be held, by their duals.
template <int Dim>
void check_bounds(Verdict& verdict, const Path& place, const Case& given,
                  const WeightClaim<Dim>& claim) {
  const auto proven = [&](const Twist<Dim>& dual) {
    return weight_bound(given.grasp, given.load(), given.up, real(dual), given.cap);
  };
  if (claim.greatest_bound) {
    const Real bound = *claim.greatest_bound;
    const WeightBound proof = proven(claim.greatest_dual);
    verdict.check(place / "greatest_bound", "no greater weight can be held, by its dual",
                  proof.gain > 0 ? proof.fixed / proof.gain - bound : infinity,
                  loose * (bound + given.load().weight));
  }
  if (claim.least_bound != 0) {
    const Real bound = claim.least_bound;
    const WeightBound proof = proven(claim.least_dual);
    verdict.check(place / "least_bound", "no smaller weight can be held, by its dual",
                  proof.gain < 0 ? bound - proof.fixed / proof.gain : infinity,
                  loose * (bound + given.load().weight));
  }
}

template <int Dim>
void check_weight(Verdict& verdict, const Path& place, const Case& given,
                  const WeightClaim<Dim>& claim) {
  verdict.check(place / "given", "given is the weight of the grasp",
                difference(claim.given, given.load().weight), 1e-15L);
  check_bounds(verdict, place, given, claim);
  const Real most = claim.greatest_bound ? Real{*claim.greatest_bound} : infinity;
  const Real least = claim.least_bound;
  if (!claim.holdable) {
    Real strength = given.load().weight;
    for (const RealContact& contact : given.grasp.contacts)
      if (std::isfinite(contact.most)) strength += contact.most;
    if (most > loose * strength && most >= least)
      verdict.note("That no weight can be held is not proven for all weights.");
    return;
  }
  const bool told = claim.least && (claim.any || claim.greatest);
  verdict.check(place, "where weights can be held there is a least and a greatest", told);
  if (!told) return;
  if (claim.any) {
    check_at_limit(verdict, place / "greatest_hold", given, without_limits(given.grasp),
                   claim.greatest_hold);
  } else {
    verdict.check(place / "greatest", "greatest is not above its bound", *claim.greatest / most,
                  1 + loose);
    check_at_limit(verdict, place / "greatest_hold", given,
                   with_weight(given.grasp, *claim.greatest), claim.greatest_hold);
  }
  verdict.check(place / "least", "least is not below its bound", least - *claim.least,
                loose * least);
  if (*claim.least > 0)
    check_at_limit(verdict, place / "least_hold", given, with_weight(given.grasp, *claim.least),
                   claim.least_hold);
  verdict.note("Which contacts decide is not checked.");
}

template <int Dim>
void check_friction(Verdict& verdict, const Path& place, const Case& given,
                    const FrictionClaim<Dim>& claim) {
  const Real bound = claim.bound;
  if (bound > 0) {
    const Vec y = real(claim.dual);
    const WeightBound proof = weight_bound(with_friction(given.grasp, bound * (1 - loose)),
                                           given.load(), given.up, y, given.cap);
    verdict.check(place / "bound", "with less friction the weight cannot be held, by the dual",
                  proof.fixed - given.load().weight * proof.gain,
                  loose * imbalance_power(given.load(), y));
  }
  if (!claim.factor) return;
  const Real factor = *claim.factor;
  verdict.check(place / "factor", "factor is not below its bound", bound - factor, loose * bound);
  // Rounding of the friction is felt where the forces are great.
  check_at_limit(verdict, place / "hold", given, with_friction(given.grasp, factor * (1 + 1e-12L)),
                 claim.hold);
}

}  // namespace

template <int Dim>
void check_capacity(Verdict& verdict, const RealGrasp& grasp,
                    const CapacityDocument<Dim>& capacity) {
  const Real cap = capacity.options.force_cap, safety = capacity.options.safety.value_or(1);
  for (std::size_t k = 0; k < capacity.capacities.size(); ++k) {
    const CapacityClaim<Dim>& claim = capacity.capacities[k];
    const Path place = (Path() / "capacities")[k];
    const RealLoad& load = load_of(verdict, place / "scenario", grasp, claim.scenario.value_or(0));
    const Case given{with_load(grasp, load), real(claim.up), cap};
    verdict.check(place, "up is a unit vector", std::abs(given.up.norm() - 1), 1e-12L);
    check_weight(verdict, place / "weight", given, claim.weight);
    check_friction(verdict, place / "friction", given, claim.friction);
    check_least_hold(verdict, place / "command", with_friction(given.grasp, 1 / safety),
                     claim.command, cap);
    verdict.check(place / "command", "the hold is of the posture asked for",
                  (real(claim.command.up) - given.up).norm(), 1e-12L);
  }
  verdict.note("That a posture is the best is not checked here: ask for best.");
}

template void check_capacity(Verdict&, const RealGrasp&, const CapacityDocument<2>&);
template void check_capacity(Verdict&, const RealGrasp&, const CapacityDocument<3>&);

}  // namespace poise::verify
