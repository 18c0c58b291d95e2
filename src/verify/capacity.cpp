#include "verify/capacity.hpp"

#include <cmath>
#include <limits>

#include "verify/hold.hpp"

namespace poise::verify {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();
constexpr Real rounding = 1e-9L;  ///< a force cap of 1e6 weights makes that of doubles felt

/// The grasp in one scenario and posture.
struct Case {
  Held held;
  Vec up;
  Real cap;  ///< [weights]

  const Load& load() const { return held.loads.front(); }
};

Held of_weight(Held held, Real weight) {
  held.loads.front().weight = weight;
  return held;
}

/// The contacts without max_normal alone.
Held without_limits(Held held) {
  for (Touch& contact : held.contacts) {
    contact.lo = 0;
    if (std::isfinite(contact.hi)) contact.hi = 0;
  }
  return held;
}

void check_held(Claims& claims, const Case& in, const Held& held, const Field& field, bool least) {
  const HoldClaim hold = check_hold(claims, held, field, in.cap, least);
  claims.check(field, "the hold is of the posture asked for", (hold.up - in.up).norm(), 1e-12L);
  if (!least) claims.check(field, "at a limit there is a hold", hold.holdable);
}

/// One end of the weights.
Real check_bound(Claims& claims, const Case& in, const Field& weight, const std::string& end) {
  const Field bound = weight.get(end + "_bound", "a weight [N]");
  const bool greatest = end == "greatest";
  if (greatest && bound.is_null()) return infinity;
  const Real says = bound.finite();
  if (!greatest && says == 0) return 0;
  const Vec y = read_vector(weight.get(end + "_dual", "a twist"), in.held.wrench_size());
  const WeightBound by = weight_bound(in.held, in.load(), in.up, y, in.cap);
  const Real proven = by.fixed / by.gain;
  if (greatest)
    claims.check(bound, "no greater weight can be held, by its dual",
                 by.gain > 0 ? proven - says : infinity, rounding * (says + in.load().weight));
  else
    claims.check(bound, "no smaller weight can be held, by its dual",
                 by.gain < 0 ? says - proven : infinity, rounding * (says + in.load().weight));
  return says;
}

void check_weight(Claims& claims, const Case& in, const Field& weight) {
  const Field given = weight.get("given", "a weight [N]");
  claims.check(given, "given is the weight of the grasp",
               difference(given.finite(), in.load().weight), 1e-15L);
  const Real most = check_bound(claims, in, weight, "greatest");
  const Real least = check_bound(claims, in, weight, "least");
  const Field any = weight.get("any", "true or false");
  if (!weight.get("holdable", "true or false").truth()) {
    Real strength = in.load().weight;
    for (const Touch& contact : in.held.contacts)
      if (std::isfinite(contact.hi)) strength += contact.hi;
    if (most > rounding * strength && most >= least)
      claims.note("That no weight can be held is not proven for all weights.");
    return;
  }
  const Field hold = weight.get("greatest_hold", "a hold");
  if (any.truth()) {
    check_held(claims, in, without_limits(in.held), hold, false);
  } else {
    const Field greatest = weight.get("greatest", "a weight [N]");
    claims.check(greatest, "greatest is not above its bound", greatest.finite() / most,
                 1 + rounding);
    check_held(claims, in, of_weight(in.held, greatest.finite()), hold, false);
  }
  const Field lowest = weight.get("least", "a weight [N]");
  claims.check(lowest, "least is not below its bound", least - lowest.finite(), rounding * least);
  if (lowest.finite() > 0)
    check_held(claims, in, of_weight(in.held, lowest.finite()), weight.get("least_hold", "a hold"),
               false);
  claims.note("Which contacts decide is not checked.");
}

void check_friction(Claims& claims, const Case& in, const Field& friction) {
  const Field bound = friction.get("bound", "a factor"),
              factor = friction.get("factor", "a factor");
  const Real says = bound.finite();
  if (says > 0) {
    const Vec y = read_vector(friction.get("dual", "a twist"), in.held.wrench_size());
    const WeightBound by =
        weight_bound(with_friction(in.held, says * (1 - rounding)), in.load(), in.up, y, in.cap);
    claims.check(bound, "with less friction the weight cannot be held, by the dual",
                 by.fixed - in.load().weight * by.gain, rounding * worth(in.load(), y));
  }
  if (factor.is_null()) return;
  claims.check(factor, "factor is not below its bound", says - factor.finite(), rounding * says);
  // Rounding of the friction is felt where the forces are great.
  check_held(claims, in, with_friction(in.held, factor.finite() * (1 + 1e-12L)),
             friction.get("hold", "a hold"), false);
}

}  // namespace

void check_capacity(Claims& claims, const Held& held, const Field& root) {
  const Field options = root.get("options", "a mapping");
  const Real cap = options.get("force_cap", "a number of weights").finite();
  const Real safety = options.get("safety", "a factor").finite();
  const Field list = root.get("capacities", "a list of answers");
  for (const Field& field : list.list()) {
    Case in{held, read_vector(field.get("up", "the direction against gravity"), held.dim), cap};
    if (held.loads.size() > 1) {
      const Field scenario = field.get("scenario", "the number of a scenario");
      const Real number = scenario.finite();
      if (!(number >= 0 && number < static_cast<Real>(held.loads.size())) ||
          number != std::floor(number))
        scenario.fail("must be the number of a scenario");
      in.held.loads = {held.loads[static_cast<std::size_t>(number)]};
    }
    claims.check(field, "up is a unit vector", std::abs(in.up.norm() - 1), 1e-12L);
    check_weight(claims, in, field.get("weight", "the weights that can be held"));
    check_friction(claims, in, field.get("friction", "the least friction"));
    check_held(claims, in, with_friction(in.held, 1 / safety), field.get("command", "a hold"),
               true);
  }
  claims.note("That a posture is the best is not checked here: ask for best.");
}

}  // namespace poise::verify
