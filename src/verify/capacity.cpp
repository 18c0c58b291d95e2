#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "verify/checks.hpp"
#include "verify/trig.hpp"

namespace poise::verify {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();
constexpr Real loose = 1e-7L;    ///< a force cap of 1e6 weights makes rounding of doubles felt
constexpr Real follows = 1e-6L;  ///< the same, of weights where a dual gains little with them
constexpr Real near = 1e-5L;     ///< what is held and its bound
constexpr Real most_friction = 1e6L;
/// Beside such a weight what contacts must press is less than the balance may be off by.
constexpr Real out_of_proportion = 1e9L;
constexpr Real no_friction = 1e-9L;  ///< of the friction: where ever less is enough

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

/// What the load's fixed wrench is alone [N].
Real fixed_size(RealLoad load) {
  load.weight = 0;
  return load.size();
}

/// Of such a load its weight is nothing, however great.
bool falls_freely(const RealLoad& load) {
  return 1 + load.lift / standard_gravity == 0 && load.acceleration.isZero(0);
}

/// The contacts without max_normal alone, against the weight alone, beside which a fixed wrench is
/// nothing where it is great enough. Of drives with a max check_idle sees that they do nothing.
RealGrasp without_limits(RealGrasp grasp) {
  RealLoad& load = grasp.loads.front();
  if (falls_freely(load)) return grasp;
  load.fixed.setZero();
  if (load.weight == 0) load.weight = 1;
  for (RealContact& contact : grasp.contacts) {
    contact.least = 0;
    if (std::isfinite(contact.most)) contact.most = 0;
  }
  return grasp;
}

/// Those of a claim, where they can be rates of the grasp's drives.
std::optional<std::vector<Real>> rates_of(Verdict& verdict, const Path& place,
                                          const RealGrasp& grasp,
                                          const std::optional<std::vector<double>>& claim) {
  std::vector<Real> rates;
  if (claim) rates.assign(claim->begin(), claim->end());
  bool right = rates.empty() || rates.size() == grasp.drives.size();
  for (std::size_t a = 0; a < rates.size() && right; ++a)
    right = std::isfinite(rates[a]) && rates[a] >= 0 &&
            (rates[a] == 0 || std::isfinite(grasp.drives[a].max));
  verdict.check(place, "rates are of drives with a max, and at least 0", right);
  return right ? std::optional(rates) : std::nullopt;
}

/// Checks a hold at a limit of what can be held.
template <int Dim>
void check_at_limit(Verdict& verdict, const Path& place, const Case& given, const RealGrasp& grasp,
                    const std::optional<HoldClaim<Dim>>& hold) {
  verdict.check(place, "at a limit there is a hold", hold && hold->holdable);
  if (!hold) return;
  check_hold(verdict, place, grasp, *hold, given.cap);
  verdict.unchecked(place / "lower_bound", "at a limit of holding forces need not be the least");
  check_up(verdict, place, real(hold->up), given.up, "the hold is of the posture asked for");
}

/// Not even a weight of 0.
bool leaves_none(const WeightBound& proof) { return proof.gain >= 0 && proof.fixed < 0; }

/// Checks a bound on the weights that can be held. `sign`: of what its dual gains with the weight.
template <int Dim>
void check_bound(Verdict& verdict, const Path& place, const Case& given, const Twist<Dim>& dual,
                 const std::optional<std::vector<double>>& claimed_rates, Real bound, Real sign) {
  const auto rates = rates_of(verdict, place, given.grasp, claimed_rates);
  if (!rates) return;
  const WeightBound proof =
      weight_bound(given.grasp, given.load(), given.up, real(dual), *rates, given.cap);
  const bool none = sign > 0 && leaves_none(proof);
  const Real proven = none ? 0 : std::max(proof.fixed / proof.gain, Real{0});
  verdict.check(place, "no weight beyond the bound can be held, by its dual",
                none || sign * proof.gain > 0 ? std::abs(proven - bound) : infinity,
                follows * (bound + given.load().size()));
}

/// Checks which contacts decide, by the dual of the greatest weight.
template <int Dim>
void check_deciding(Verdict& verdict, const Path& place, const Case& given,
                    const WeightClaim<Dim>& claim) {
  const auto& contacts = given.grasp.contacts;
  const bool complete = claim.contacts.size() == (claim.greatest_bound ? contacts.size() : 0);
  verdict.check(place, "each contact decides or not, where there is a bound", complete);
  if (!claim.greatest_bound || !complete) return;
  const Vec y = real(claim.greatest_dual);
  const auto rates = rates_of(verdict, place, given.grasp, claim.greatest_rates);
  if (!rates) return;
  const Real gain = weight_bound(given.grasp, given.load(), given.up, y, *rates, given.cap).gain;
  const Real least = 1e-9L * std::abs(gain);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Path here = place[i];
    const Vec z = contacts[i].G.transpose() * against(given.grasp, contacts[i].finger, y, *rates);
    const Real beside = sliding(contacts[i], z), most = power(contacts[i], z);
    verdict.check(here, "finger is that of the grasp",
                  claim.contacts[i].finger == contacts[i].finger);
    const bool presses = std::isfinite(contacts[i].most) && most > least;
    const Real off = claim.contacts[i].per_newton - (presses ? most / gain : 0);
    verdict.check(here / "per_newton", "per_newton is what the contact can do, by the dual",
                  std::abs(off), 1e-9L + 1e-6L * std::abs(claim.contacts[i].per_newton));
    const bool slips = contacts[i].friction > 0 && beside > least && most > -least;
    const bool clear = !is_beside(beside, least, gain) && !is_beside(most, -least, gain);
    verdict.check(here / "slipping", "slipping follows from the dual",
                  !clear || claim.contacts[i].slipping == slips);
  }
}

/// Checks that drives with a max have nothing to do.
template <int Dim>
void check_idle(Verdict& verdict, const Path& place, const Case& given,
                const std::optional<HoldClaim<Dim>>& hold) {
  if (!hold || hold->drives.size() != given.grasp.drives.size()) return;
  const Real length = given.load().radius > 0 ? given.load().radius : 1;
  for (std::size_t a = 0; a < hold->drives.size(); ++a)
    if (const RealDrive& drive = given.grasp.drives[a]; std::isfinite(drive.max))
      verdict.check(place[a] / "effort", "drives with a max do nothing where any weight is held",
                    hold->drives[a].effort / (given.load().size() * (drive.turns ? length : 1)),
                    1e-8L);
}

/// Checks which drives decide, by the rates.
template <int Dim>
void check_deciding_drives(Verdict& verdict, const Path& place, const Case& given,
                           const WeightClaim<Dim>& claim) {
  const auto& drives = given.grasp.drives;
  const auto rates = rates_of(verdict, place, given.grasp, claim.greatest_rates);
  if (!rates) return;
  if (!claim.greatest_bound)
    return verdict.check(place, "no drive decides where there is no bound", claim.drives.empty());
  if (drives.empty())
    return verdict.unchecked(place, "the closing directions of the fingers are not known");
  const bool complete = claim.drives.size() == drives.size();
  verdict.check(place, "each drive decides or not, where there is a bound", complete);
  if (!complete) return;
  const Real gain = weight_bound(given.grasp, given.load(), given.up, real(claim.greatest_dual),
                                 *rates, given.cap)
                        .gain;
  for (std::size_t a = 0; a < drives.size(); ++a) {
    verdict.check(place[a], "name is that of the drive", claim.drives[a].name == drives[a].name);
    const Real rate = rates->empty() ? 0 : (*rates)[a];
    verdict.check(place[a] / "per_newton", "per_newton is the rate of the drive, by the dual",
                  std::abs(claim.drives[a].per_newton - rate / gain),
                  1e-9L + 1e-6L * std::abs(claim.drives[a].per_newton));
  }
}

/// Checks the greatest weight.
template <int Dim>
void check_greatest(Verdict& verdict, const Path& place, const Case& given,
                    const WeightClaim<Dim>& claim) {
  verdict.check(place / "greatest", "there is a greatest weight, unless any is held",
                claim.greatest.has_value() != claim.any);
  verdict.check(place / "greatest_bound", "there is a bound, unless any weight is held",
                claim.any ? !claim.greatest_bound : claim.greatest_bound || claim.proven);
  if (claim.any) {
    if (!falls_freely(given.load()))
      check_idle(verdict, place / "greatest_hold" / "drives", given, claim.greatest_hold);
    return check_at_limit(verdict, place / "greatest_hold", given, without_limits(given.grasp),
                          claim.greatest_hold);
  }
  if (!claim.greatest) return;
  if (claim.proven) {
    const Real most = claim.greatest_bound ? Real{*claim.greatest_bound} : infinity;
    verdict.check(place / "greatest", "greatest is not above its bound", *claim.greatest / most,
                  1 + near);
    verdict.unchecked(place / "greatest", "it is said that more may be held, up to the bound");
  } else if (claim.greatest_bound) {
    verdict.check(place / "greatest", "greatest is its bound, but for a part of 1e-5",
                  difference(*claim.greatest, *claim.greatest_bound), near);
  }
  check_at_limit(verdict, place / "greatest_hold", given, with_weight(given.grasp, *claim.greatest),
                 claim.greatest_hold);
}

/// Checks the least weight.
template <int Dim>
void check_least(Verdict& verdict, const Path& place, const Case& given,
                 const WeightClaim<Dim>& claim) {
  verdict.check(place / "least", "there is a least weight", claim.least.has_value());
  if (!claim.least) return;
  if (claim.proven) {
    verdict.check(place / "least", "least is not below its bound", claim.least_bound - *claim.least,
                  near * claim.least_bound);
    verdict.unchecked(place / "least", "it is said that less may be held, down to the bound");
  } else {
    verdict.check(place / "least", "least is its bound, but for a part of 1e-5",
                  difference(*claim.least, claim.least_bound), near);
  }
  const bool none = *claim.least <= 0;
  verdict.check(place / "least_hold", "of a least weight there is a hold",
                claim.least_hold.has_value() != none);
  if (!none)
    return check_at_limit(verdict, place / "least_hold", given,
                          with_weight(given.grasp, *claim.least), claim.least_hold);
  const auto must_press = [](const RealContact& contact) { return contact.least > 0; };
  if (fixed_size(given.load()) > 0 ||
      std::any_of(given.grasp.contacts.begin(), given.grasp.contacts.end(), must_press))
    verdict.unchecked(place / "least", "of no weight there is no hold to check");
}

/// Whether both weights are their bounds.
template <int Dim>
bool is_closed(const WeightClaim<Dim>& claim) {
  const bool greatest =
      claim.any || (claim.greatest && claim.greatest_bound &&
                    difference(*claim.greatest, *claim.greatest_bound) <= near / 2);
  return greatest && claim.least && difference(*claim.least, claim.least_bound) <= near / 2;
}

template <int Dim>
void check_weight(Verdict& verdict, const Path& place, const Case& given,
                  const WeightClaim<Dim>& claim) {
  verdict.check(place / "given", "given is the weight of the grasp",
                difference(claim.given, given.load().weight), 1e-15L);
  if (claim.greatest_bound)
    check_bound<Dim>(verdict, place / "greatest_bound", given, claim.greatest_dual,
                     claim.greatest_rates, *claim.greatest_bound, 1);
  if (claim.least_bound != 0)
    check_bound<Dim>(verdict, place / "least_bound", given, claim.least_dual, claim.least_rates,
                     claim.least_bound, -1);
  verdict.check(place / "greatest_dual", "without a bound there is no dual",
                claim.greatest_bound || (claim.greatest_dual.isZero(0) && !claim.greatest_rates));
  verdict.check(place / "least_dual", "without a bound there is no dual",
                claim.least_bound != 0 || (claim.least_dual.isZero(0) && !claim.least_rates));
  verdict.check(place / "proven", "proven is told where it is false",
                !claim.proven.value_or(false));
  if (claim.holdable) {
    if (claim.proven)
      verdict.check(place / "proven", "proven is false only where a weight is not its bound",
                    !is_closed(claim));
    check_greatest(verdict, place, given, claim);
    check_least(verdict, place, given, claim);
    check_deciding(verdict, place / "contacts", given, claim);
    return check_deciding_drives(verdict, place / "drives", given, claim);
  }
  const Real fixed = fixed_size(given.load());
  Real strength = 0, pressing = fixed;
  for (const RealContact& contact : given.grasp.contacts) {
    if (std::isfinite(contact.most)) strength += contact.most;
    pressing += contact.least;
  }
  const Real length = given.load().radius > 0 ? given.load().radius : 1;
  for (const RealDrive& drive : given.grasp.drives)
    if (std::isfinite(drive.max)) strength += drive.turns ? drive.max / length : drive.max;
  const Real most = claim.greatest_bound ? Real{*claim.greatest_bound} : infinity;
  const auto rates = rates_of(verdict, place, given.grasp, claim.greatest_rates);
  const bool none = claim.greatest_bound && rates &&
                    leaves_none(weight_bound(given.grasp, given.load(), given.up,
                                             real(claim.greatest_dual), *rates, given.cap));
  if (claim.proven)
    verdict.unchecked(place / "holdable", "it is said that weights may be held: none was found");
  else
    verdict.check(place / "holdable", "that no weight can be held follows from its bounds",
                  none || most < claim.least_bound || (fixed == 0 && most <= loose * strength) ||
                      claim.least_bound > out_of_proportion * pressing);
  for (const auto& [key, null] :
       {std::pair{"any", !claim.any}, {"greatest", !claim.greatest}, {"least", !claim.least}})
    verdict.check(place / key, "is null where no weight can be held", null);
}

template <int Dim>
void check_friction(Verdict& verdict, const Path& place, const Case& given,
                    const FrictionClaim<Dim>& claim) {
  const Real bound = claim.bound;
  const Vec y = real(claim.dual);
  const auto rates = rates_of(verdict, place / "rates", given.grasp, claim.rates);
  if (!rates) return;
  // What is missing against y with some friction.
  const auto missing = [&](Real friction) {
    const WeightBound proof = weight_bound(with_friction(given.grasp, friction), given.load(),
                                           given.up, y, *rates, given.cap);
    return given.load().weight * proof.gain - proof.fixed;
  };
  verdict.check(place / "bound", "bound is from 0 to a million",
                bound >= 0 && bound <= most_friction);
  verdict.check(place / "dual", "without a bound there is no dual",
                bound != 0 || (y.isZero(0) && !claim.rates));
  if (bound > 0)
    verdict.check(place / "bound", "with less friction the weight cannot be held, by the dual",
                  missing(bound * (1 - loose)) > 0);
  verdict.check(place / "proven", "proven is told where it is false",
                !claim.proven.value_or(false));
  if (claim.proven)
    verdict.unchecked(place / "factor", "it is said that less may be enough, down to the bound");
  verdict.check(place / "factor", "factor is null where a million times the friction is not enough",
                claim.factor || claim.proven || bound >= most_friction * (1 - near));
  if (!claim.factor)
    return verdict.check(place / "hold", "is null where there is none", !claim.hold);
  const Real factor = *claim.factor;
  if (claim.proven) {
    verdict.check(place / "factor", "factor is not below its bound", bound - factor, near * bound);
    verdict.check(place / "proven", "proven is false only where the factor is not its bound",
                  difference(factor, bound, no_friction) > near / 2);
  } else {
    verdict.check(place / "factor", "factor is its bound, but for a part of 1e-5",
                  difference(factor, bound, no_friction), near);
  }
  check_at_limit(verdict, place / "hold", given, with_friction(given.grasp, factor), claim.hold);
}

/// The postures that are asked about, each against every load.
template <int Dim>
void check_postures(Verdict& verdict, const RealGrasp& grasp, const CapacityDocument<Dim>& document,
                    const Present& present) {
  const Path list = Path() / "capacities";
  const auto& claims = document.capacities;
  const std::size_t loads = grasp.loads.size();
  std::vector<std::string> names;
  for (std::size_t k = 0; k < claims.size(); ++k) {
    const CapacityClaim<Dim>& claim = claims[k];
    const Vec up = real(claim.up);
    check_up(verdict, list[k], up, real(claims[k - k % loads].up), "up is one against all loads");
    if (Dim == 2)
      verdict.check(list[k] / "angle_deg", "angle_deg is the posture up",
                    (up - up_at(radians_of(claim.angle_deg))).norm(), rounding);
    verdict.check(list[k] / "load", "the loads follow each other",
                  loads == 1 ? !claim.load : claim.load == k % loads);
    if (k % loads == 0)
      names.push_back(claim.posture);
    else
      verdict.check(list[k] / "posture", "posture is one against all loads",
                    claim.posture == names.back());
    if (claim.posture == "given")
      check_up(verdict, list[k], up, asked_up(document.options).value_or(Vec()),
               "up is the posture asked for");
    else if (claim.posture == "upright")
      check_up(verdict, list[k], up, upright(Dim), "up is upright");
    else if (claim.posture == "now" && present.known)
      check_up(verdict, list[k], up, present.up.value_or(Vec()), "up is the posture of the file");
    else
      verdict.unchecked(list[k] / "up", "whether that is the posture meant: ask for best");
  }
  verdict.check(list, "each posture has all the loads", claims.size() == names.size() * loads);
  using Names = std::vector<std::string>;
  const bool now = present.known ? present.up.has_value() : names.front() == "now";
  const bool right = asked_up(document.options) ? names == Names{"given"}
                     : now ? names == Names{"now"} || names == Names{"now", "best"}
                           : names == Names{"best"} || names == Names{"upright"};
  verdict.check(list, "the postures are those asked for", right);
  if (names.back() == "now" || names.back() == "upright")
    verdict.unchecked(list, "whether there is a best posture: ask for best");
}

}  // namespace

template <int Dim>
void check_capacity(Verdict& verdict, const RealGrasp& grasp, const CapacityDocument<Dim>& capacity,
                    const Present& present) {
  check_options(verdict, Dim, capacity.options, {"safety"}, {"grip", "angle_deg", "up"});
  const Real cap = capacity.options.force_cap, safety = capacity.options.safety.value_or(1);
  verdict.check(Path() / "capacities", "there are some", !capacity.capacities.empty());
  if (capacity.capacities.empty()) return;
  check_postures(verdict, grasp, capacity, present);
  for (std::size_t k = 0; k < capacity.capacities.size(); ++k) {
    const CapacityClaim<Dim>& claim = capacity.capacities[k];
    const Path place = (Path() / "capacities")[k];
    const RealLoad& load = load_of(verdict, place / "load", grasp, claim.load.value_or(0));
    const Case given{with_load(grasp, load), real(claim.up), cap};
    verdict.check(place / "up", "up is a unit vector", std::abs(given.up.norm() - 1), rounding);
    check_weight(verdict, place / "weight", given, claim.weight);
    check_friction(verdict, place / "friction", given, claim.friction);
    RealGrasp safe = with_friction(given.grasp, 1 / safety);
    safe.within_max = false;  // what to command may be more than the gripper gives
    verdict.check(place / "command" / "objective", "the command is the least grip, if there is one",
                  !claim.command.holdable ||
                      (claim.command.objective == Objective::grip) == !safe.drives.empty());
    check_least_hold(verdict, place / "command", safe, claim.command, cap);
    check_up(verdict, place / "command", real(claim.command.up), given.up,
             "the hold is of the posture asked for");
  }
}

template void check_capacity(Verdict&, const RealGrasp&, const CapacityDocument<2>&,
                             const Present&);
template void check_capacity(Verdict&, const RealGrasp&, const CapacityDocument<3>&,
                             const Present&);

}  // namespace poise::verify
