#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/checks.hpp"
#include "verify/manner.hpp"
#include "verify/trig.hpp"

namespace poise::verify {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();

template <int Dim>
void check_posture(Verdict& verdict, const Path& place, const HoldClaim<Dim>& hold) {
  const Vec up = real(hold.up);
  verdict.check(place / "up", "up is a unit vector", std::abs(up.norm() - 1), rounding);
  if (Dim == 3) return;
  verdict.check(place / "angle_deg", "angle_deg is in (-180, 180]",
                hold.angle_deg > -180 && hold.angle_deg <= 180);
  verdict.check(place / "angle_deg", "angle_deg is the posture up",
                (up - up_at(radians_of(hold.angle_deg))).norm(), rounding);
}

/// What the forces of a finger's contacts add up to.
struct FingerSum {
  Real normal{0};
  Real size{0};  ///< of the forces, for what rounding leaves of them
  Vec force;
};

template <int Dim>
FingerSum finger_sum(const RealGrasp& grasp, const HoldClaim<Dim>& hold,
                     const std::string& finger) {
  FingerSum sum{0, 0, Vec::Zero(Dim)};
  for (std::size_t i = 0; i < hold.contacts.size(); ++i) {
    if (grasp.contacts[i].finger != finger) continue;
    const Vec force = real(hold.contacts[i].force);
    sum.normal += force.dot(grasp.contacts[i].normal);
    sum.force += force;
    sum.size += force.norm();
  }
  return sum;
}

/// Checks what the fingers do, and with it how the object is held.
template <int Dim>
void check_fingers(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                   const RealLoad& load, const HoldClaim<Dim>& hold) {
  const bool complete = hold.fingers.size() == grasp.fingers.size();
  verdict.check(place / "fingers", "there are as many fingers as the grasp has", complete);
  if (!complete) return;
  bool clear = true;
  std::size_t loaded = 0;
  for (std::size_t k = 0; k < hold.fingers.size(); ++k) {
    const FingerClaim<Dim>& finger = hold.fingers[k];
    const Path here = (place / "fingers")[k];
    verdict.check(here, "finger is that of the grasp", finger.finger == grasp.fingers[k]);
    const FingerSum sum = finger_sum(grasp, hold, grasp.fingers[k]);
    verdict.check(here / "normal_force", "normal_force is the sum of its contacts'",
                  std::abs(finger.normal_force - sum.normal), rounding * sum.size);
    verdict.check(here / "force", "force is the sum of its contacts'",
                  (real(finger.force) - sum.force).norm(), rounding * sum.size);
    const Vec& closing = grasp.closing[k];
    verdict.check(here / "pressing_force", "pressing_force is null without a closing direction",
                  finger.pressing_force.has_value() == !closing.isZero(0));
    verdict.check(here / "pressing_force", "pressing_force is that along the closing direction",
                  std::abs(finger.pressing_force.value_or(0) - sum.force.dot(closing)),
                  rounding * sum.size);
    if (is_beside(sum.normal, at_limit * load.size(), load.size())) clear = false;
    if (sum.normal > at_limit * load.size()) ++loaded;
  }
  verdict.check(place / "all_loaded", "all_loaded follows from the fingers",
                !clear || hold.all_loaded == (loaded == hold.fingers.size()));
  const Friction friction =
      loaded > 1 ? friction_for(grasp, load, real(hold.up)) : Friction::unclear;
  const bool known = clear && (loaded <= 1 || friction != Friction::unclear);
  if (!known) verdict.unchecked(place / "manner", "it is within rounding of another");
  verdict.check(place / "manner", "manner follows from the forces",
                !clear || (loaded <= 1                      ? hold.manner == Manner::resting
                           : friction == Friction::needless ? hold.manner == Manner::cradled
                           : friction == Friction::needed   ? hold.manner == Manner::pinched
                                                            : hold.manner != Manner::resting));
}

/// Checks what the drives do, and the grip.
template <int Dim>
void check_drives(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                  const HoldClaim<Dim>& hold, const std::vector<Vec>& forces) {
  const std::size_t count = grasp.drives.size();
  const bool complete = hold.drives.size() == count && hold.grip.has_value() == (count > 0);
  verdict.check(place / "drives", "there are as many drives as the grasp has, and their grip",
                complete);
  if (!complete || count == 0) return;
  Real grip = 0, size = 0;
  for (std::size_t a = 0; a < count; ++a) {
    const RealDrive& drive = grasp.drives[a];
    const DriveClaim& claim = hold.drives[a];
    const Path here = (place / "drives")[a];
    const Real length = drive.turns ? grasp.loads.front().length : 1;
    Real effort = 0, allowed = 0;
    for (std::size_t i = 0; i < hold.contacts.size(); ++i)
      for (const RealDrive::Moved& moved : drive.moves) {
        const RealContact& contact = grasp.contacts[i];
        if (moved.finger != contact.finger) continue;
        const Vec w = contact.G * forces[i];
        effort += moved.twist.dot(w);
        // What is left of a finger that does nothing is rounding of the load.
        allowed += moved.twist.norm() * (w.norm() + grasp.greatest_size());
      }
    verdict.check(here, "name is that of the drive", claim.name == drive.name);
    verdict.check(here / "effort", "effort is the power of the forces per unit of speed",
                  std::abs(claim.effort - effort),
                  rounding * allowed + 4e-15L * length * std::sqrt(Real{hold.effort}));
    const bool limited = std::isfinite(drive.max);
    verdict.check(here / "max", "max and part_of_max are told where there is a limit",
                  claim.max.has_value() == limited && claim.part_of_max.has_value() == limited);
    if (limited && claim.max && claim.part_of_max) {
      verdict.check(here / "max", "max is that of the drive", difference(*claim.max, drive.max), 0);
      verdict.check(here / "part_of_max", "part_of_max is effort / max",
                    std::abs(*claim.part_of_max - effort / drive.max),
                    rounding * allowed / drive.max);
      if (grasp.within_max)
        verdict.check(here / "effort", "effort is at most max", effort / drive.max, 1 + 1e-7L);
    }
    grip = std::max(grip, effort / grasp.unit(drive));
    size = std::max(size, allowed / grasp.unit(drive));
  }
  verdict.check(place / "grip", "grip is the greatest effort of a drive",
                std::abs(*hold.grip - grip), rounding * size);
}

/// Checks that (y, rates) prove the lower bound of the grip.
template <int Dim>
void check_grip_bound(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                      const RealLoad& load, const HoldClaim<Dim>& hold, Real force_cap) {
  const auto rates = real_rates(verdict, place, grasp, hold.rates);
  if (!rates) return;
  Real sum = 0;
  for (const Real rate : *rates) sum += rate;
  verdict.check(place / "rates", "rates add up to 1", std::abs(sum - 1), rounding);
  const Vec w = wrench(load, real(hold.up)), y = real(hold.dual);
  const Real proven = grip_bound(grasp, w, y, *rates, force_cap * load.size());
  const Real unit = std::max(Real{hold.lower_bound}, little(grasp, Objective::grip));
  verdict.check(place / "lower_bound", "lower_bound is what y and rates prove of the grip",
                (hold.lower_bound - std::max<Real>(proven, 0)) / unit, 1e-7L);
}

/// How many times less exactly than its forces a pad tells its moments: by its centre of pressure.
Real told_digits(const RealContact& contact) {
  Real times = 1;
  if (contact.pad)
    for (const RealPad::Tilt& tilt : contact.pad->tilts)
      if (tilt.reach > 0) times = std::max(times, contact.middle().norm() / tilt.gyration);
  return times;
}

/// What the balance may be off by, and a force outside of its cone [weights]: what finds grips, and
/// holds by pads and within limits of drives, ends earlier.
struct Allowed {
  Real balance, cone;
};
template <int Dim>
Allowed allowed_of(const RealGrasp& grasp, const HoldClaim<Dim>& hold) {
  const bool inside = hold.objective == Objective::grip || hold.rates ||
                      std::any_of(grasp.contacts.begin(), grasp.contacts.end(),
                                  [](const auto& contact) { return contact.pad.has_value(); });
  return inside ? Allowed{1e-8L, 1e-9L} : Allowed{3e-11L, 0};
}

template <int Dim>
void check_forces(Verdict& verdict, const Path& place, const RealGrasp& grasp, const RealLoad& load,
                  const HoldClaim<Dim>& hold) {
  const bool complete = hold.contacts.size() == grasp.contacts.size();
  verdict.check(place / "contacts", "there are as many contacts as the grasp has", complete);
  if (!complete) return;
  Real effort = 0;
  std::vector<Vec> forces;
  for (std::size_t i = 0; i < hold.contacts.size(); ++i) {
    forces.push_back(check_contact(verdict, (place / "contacts")[i], grasp.contacts[i], load.size(),
                                   hold.contacts[i]));
    effort += verify::effort(grasp.contacts[i], forces[i]);
  }
  verdict.check(place / "effort", "effort is that of the forces", difference(hold.effort, effort),
                1e-11L);
  verdict.check(place / "force_norm", "force_norm is the root of effort",
                difference(hold.force_norm, std::sqrt(Real{hold.effort})), rounding);

  const Allowed allowed = allowed_of(grasp, hold);
  // What the forces lose by their rounding [weights].
  const Real digits = 1e-14L * (1 + std::sqrt(effort) / load.size()) * Real(forces.size());
  Vec off = wrench(load, real(hold.up));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const RealContact& contact = grasp.contacts[i];
    off -= contact.G * forces[i];
    verdict.check(
        (place / "contacts")[i], "force is within the friction cone and its limits [weights]",
        outside(contact, forces[i]) / load.size(), allowed.cone + digits * told_digits(contact));
  }
  const Real residual = relative_size(off, load);
  verdict.check(place, "forces balance the load [weights]", residual, allowed.balance + digits);
  verdict.check(place / "residual", "residual is the error of the balance [weights]",
                std::abs(hold.residual - residual), 1e-11L + digits);
  check_fingers(verdict, place, grasp, load, hold);
  check_drives(verdict, place, grasp, hold, forces);
}

/// What each load needs, and the key under which it is told.
template <int Dim>
const std::vector<std::optional<double>>& values_of(const HoldClaim<Dim>& hold) {
  static const std::vector<std::optional<double>> none;
  return hold.load_grips ? *hold.load_grips : hold.load_efforts ? *hold.load_efforts : none;
}
template <int Dim>
const char* key_of(const HoldClaim<Dim>& hold) {
  return hold.load_grips ? "load_grips" : "load_efforts";
}

/// Checks the hold of a load that does not decide: it can be held too, with less.
template <int Dim>
void check_other(Verdict& verdict, const Path& place, std::size_t k, const RealGrasp& grasp,
                 const HoldClaim<Dim>& hold, Real force_cap) {
  const auto& effort = values_of(hold)[k];
  const auto& other = hold.load_holds[k];
  const Path of_effort = (place / key_of(hold))[k], of_hold = (place / "load_holds")[k];
  const bool none = k == *hold.load || !effort;
  verdict.check(of_hold, "is null only where there is no other hold", !other == none);
  verdict.check(of_effort, "an effort is null only where the object cannot be held",
                effort || !hold.holdable);
  if (!effort && k != *hold.load)
    verdict.unchecked(of_effort, "that a load cannot be held is proven of the one that decides");
  if (effort && hold.holdable)
    verdict.check(of_effort, "no load needs more than the one that decides", *effort - value(hold),
                  1e-9L * value(hold));
  if (none || !other) return;
  const Real cap = force_cap * grasp.greatest_size() / grasp.loads[k].size();
  // In the best posture of all loads this one may be at the limit of what can be held.
  check_least_hold(verdict, of_hold, with_load(grasp, grasp.loads[k]), *other, cap, true);
  verdict.check(of_hold, "is a hold, in the same posture",
                other->holdable ? (real(other->up) - real(hold.up)).norm() : 1, rounding);
  verdict.check(of_hold / "objective", "objective is that in which loads are compared",
                (other->objective == Objective::grip) == hold.load_grips.has_value());
  verdict.check(of_effort, "what a load needs is that of its hold",
                difference(*effort, value(*other)), 1e-9L);
}

/// Checks which load decides: the one that needs most.
template <int Dim>
void check_loads(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                 const HoldClaim<Dim>& hold, Real force_cap) {
  const std::size_t count = grasp.loads.size();
  const Path of_load = place / "load";
  if (count == 1)
    return verdict.check(of_load, "is told only where there are several",
                         !hold.load && !hold.load_grips && !hold.load_efforts);
  const bool is_grip = hold.load_grips.has_value();
  const bool complete = hold.load && *hold.load < count && is_grip != !!hold.load_efforts &&
                        (!hold.holdable || is_grip == (hold.objective == Objective::grip)) &&
                        values_of(hold).size() == count && hold.load_holds.size() == count;
  verdict.check(of_load, "each of the grasp's loads has its number and its hold", complete);
  if (!complete) return;
  const auto& decides = values_of(hold)[*hold.load];
  verdict.check(of_load, "the load decides", decides.has_value() == hold.holdable);
  for (std::size_t k = 0; k < count; ++k) check_other(verdict, place, k, grasp, hold, force_cap);
  if (decides && hold.holdable)
    verdict.check((place / key_of(hold))[*hold.load], "its effort is that of the hold",
                  difference(*decides, value(hold)), rounding);
}

/// What y proves of the effort, and how far rounding may take that.
struct DualValue {
  Real bound{0}, rounding{0};
};

template <int Dim>
DualValue dual_value(const RealGrasp& grasp, const RealLoad& load, const HoldClaim<Dim>& hold) {
  const Vec w = wrench(load, real(hold.up)), y = real(hold.dual);
  std::vector<Real> rates;
  if (hold.rates && hold.rates->size() == grasp.drives.size())
    rates.assign(hold.rates->begin(), hold.rates->end());
  return {bound(grasp, w, y, rates), bound_rounding(grasp, w, y, rates)};
}

template <int Dim>
const RealLoad& deciding_load(const RealGrasp& grasp, const HoldClaim<Dim>& hold) {
  const std::size_t k = hold.load.value_or(0);
  return grasp.loads[k < grasp.loads.size() ? k : 0];
}

}  // namespace

Real little(const RealGrasp& grasp, std::optional<Objective> objective) {
  if (objective != Objective::grip) return 0;
  Real least = infinity;
  for (const RealDrive& drive : grasp.drives) {
    const Real length = drive.turns ? grasp.loads.front().radius : 1;
    least = std::min(least, grasp.greatest_size() * length / grasp.unit(drive));
  }
  return 1e-3L * least;
}

Real difference(Real a, Real b, Real little) {
  return a == b ? 0 : std::abs(a - b) / std::max({std::abs(a), std::abs(b), little});
}

std::optional<std::vector<Real>> real_rates(Verdict& verdict, const Path& place,
                                            const RealGrasp& grasp,
                                            const std::optional<std::vector<double>>& given) {
  std::vector<Real> rates;
  if (given) rates.assign(given->begin(), given->end());
  bool right = rates.empty() || rates.size() == grasp.drives.size();
  for (const Real rate : rates) right = right && rate >= 0 && std::isfinite(rate);
  verdict.check(place / "rates", "rates are of the drives, and at least 0", right);
  return right ? std::optional(rates) : std::nullopt;
}

const RealLoad& load_of(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                        std::size_t load) {
  const bool known = load < grasp.loads.size();
  verdict.check(place, "load is one of the grasp's", known);
  return grasp.loads[known ? load : 0];
}

template <int Dim>
void check_hold(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                const HoldClaim<Dim>& hold, Real force_cap) {
  check_posture(verdict, place, hold);
  check_loads(verdict, place, grasp, hold, force_cap);
  const RealLoad& load = deciding_load(grasp, hold);
  verdict.check(place / "proven", "proven is told where it is false, of what is not holdable",
                !hold.proven || (!*hold.proven && !hold.holdable));
  if (hold.holdable) {
    check_forces(verdict, place, grasp, load, hold);
    // The cap is one of the least effort: forces of least grip may need more.
    if (hold.objective != Objective::grip)
      verdict.check(place, "force_norm is within the force cap",
                    std::sqrt(Real{hold.effort}) / (force_cap * grasp.greatest_size()), 1 + 1e-6L);
    return;
  }
  if (hold.objective == Objective::grip && hold.rates) {
    Real most = infinity;
    for (const RealDrive& drive : grasp.drives)
      most = std::min(most, drive.max / grasp.unit(drive));
    verdict.check(place / "lower_bound", "lower_bound is above what the drives give: max / bound",
                  hold.lower_bound > 0 ? most / hold.lower_bound : 2, 1);
    check_grip_bound(verdict, place, grasp, load, hold, force_cap);
    verdict.unchecked(place / "reason", "is in words");
    return;
  }
  const auto rates = real_rates(verdict, place, grasp, hold.rates);
  if (!rates) return;
  // The cap is not enough for any load within the tolerance of the balance. A dual so long that its
  // own rounding keeps it from proving that may be shorter.
  const auto proof = [&](Real length) {
    const Vec w = wrench(load, real(hold.up)), y = length * real(hold.dual);
    std::vector<Real> speeds = *rates;
    for (Real& speed : speeds) speed *= length;
    return bound(grasp, w, y, speeds) - bound_rounding(grasp, w, y, speeds) -
           2 * delta * imbalance_power(load, y);
  };
  const Real cap = force_cap * load.size();
  if (hold.proven) {
    const DualValue dual = dual_value(grasp, load, hold);
    verdict.check(place / "lower_bound", "lower_bound is what dual proves [of it]",
                  hold.lower_bound > 0
                      ? (hold.lower_bound - dual.bound + dual.rounding) / hold.lower_bound
                      : 0,
                  1e-6L);
    verdict.check(place / "proven", "proven is false only where lower_bound is within the cap",
                  hold.lower_bound / (cap * cap), 1 + 1e-9L);
    verdict.unchecked(place / "lower_bound", "how much more dual proves");
    verdict.unchecked(place / "reason", "is in words");
    return;
  }
  Real proven = proof(1);
  for (int exponent = -2; exponent >= -80 && !(proven > cap * cap); exponent -= 2)
    proven = std::max(proven, proof(std::ldexp(Real{1}, exponent)));
  verdict.check(place / "lower_bound", "lower_bound is above the square of the force cap",
                hold.lower_bound > cap * cap);
  verdict.unchecked(place / "lower_bound", "by how much the force cap is not enough");
  verdict.check(place, "dual proves that the force cap is not enough: cap^2 / bound",
                proven > 0 ? cap * cap / proven : 2, 1);
  verdict.unchecked(place / "reason", "is in words");
}

template <int Dim>
void check_least_hold(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                      const HoldClaim<Dim>& hold, Real force_cap, bool at_limit) {
  check_hold(verdict, place, grasp, hold, force_cap);
  if (!hold.holdable) return;
  if (hold.objective == Objective::grip) {
    check_grip_bound(verdict, place, grasp, deciding_load(grasp, hold), hold, force_cap);
    const Real grip = hold.grip.value_or(0);
    verdict.check(place / "lower_bound", "grip is the least: it is the lower_bound [of grip]",
                  difference(grip, hold.lower_bound, little(grasp, Objective::grip)), 1e-6L);
    return;
  }
  if (!real_rates(verdict, place, grasp, hold.rates)) return;
  const DualValue dual = dual_value(grasp, deciding_load(grasp, hold), hold);
  const Path of_bound = place / "lower_bound";
  const Real above = hold.lower_bound - dual.bound;
  verdict.check(of_bound, "lower_bound is what dual proves [of effort]",
                ((at_limit ? above : std::abs(above)) + dual.rounding) / hold.effort, 1e-6L);
  verdict.check(of_bound, "effort is the least: it is the lower_bound [of effort]",
                std::abs(Real{hold.effort} - hold.lower_bound) / hold.effort, 1e-6L);
}

template void check_hold(Verdict&, const Path&, const RealGrasp&, const HoldClaim<2>&, Real);
template void check_hold(Verdict&, const Path&, const RealGrasp&, const HoldClaim<3>&, Real);
template void check_least_hold(Verdict&, const Path&, const RealGrasp&, const HoldClaim<2>&, Real,
                               bool);
template void check_least_hold(Verdict&, const Path&, const RealGrasp&, const HoldClaim<3>&, Real,
                               bool);

}  // namespace poise::verify
