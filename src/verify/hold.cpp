#include "verify/hold.hpp"

#include <algorithm>
#include <cmath>

#include "verify/plane.hpp"
#include "verify/space.hpp"

namespace poise::verify {
namespace {

constexpr Real rounding = 1e-12L;  ///< of a number that follows from others in the file
constexpr Real at_limit = 1e-9L;   ///< of the weight, and of the friction
constexpr Real unsure = 1e-12L;    ///< beside those limits

bool near(Real a, Real b, Real by) { return std::abs(a - b) <= by; }

/// What one contact does, as the file has it.
struct ContactClaim {
  Vec force;       ///< in the contact frame, like a column of G
  Vec vector;      ///< in the object frame
  Real moment{0};  ///< of a soft finger, about the normal
};

ContactClaim check_contact(Claims& claims, const Touch& contact, const Field& field,
                           const Load& load, HoldClaim& hold, std::size_t index) {
  const auto dim = contact.position.size();
  claims.check(field, "finger is that of the grasp",
               field.get("finger", "a label").text() == contact.finger);
  const Field normal = field.get("normal_force", "a force [N]");
  const Field tangential = field.get("tangential_force", "a force [N]");
  const Field vector = field.get("force", "a force [N]");
  ContactClaim claim;
  claim.vector = read_vector(vector, dim);
  const Real n = normal.finite(), t = tangential.finite();
  const Real size = claim.vector.norm();
  claim.force = contact.G.topRows(dim).transpose() * claim.vector;
  Real along = claim.force.tail(claim.force.size() - 1).norm();
  if (dim == 2) along = claim.force[1];
  claims.check(normal, "normal_force is that of force", std::abs(claim.force[0] - n),
               rounding * size);
  claims.check(tangential, "tangential_force is that of force", std::abs(along - t),
               rounding * size);
  if (contact.torsion > 0) {
    claim.moment = field.get("torsion_moment", "a moment [N m]").finite();
    claim.force[3] = claim.moment * contact.friction / contact.torsion;
  }
  Real sideways = t * t;
  if (contact.torsion > 0) sideways += claim.force[3] * claim.force[3];
  sideways = std::sqrt(sideways);

  const Real W = load.weight;
  const bool loaded = n > at_limit * W, clear = !near(n, at_limit * W, unsure * W);
  const Real used =
      contact.friction * n > 0 ? std::min(Real{1}, sideways / (contact.friction * n)) : 1;
  const Field friction_used = field.get("friction_used", "a number");
  const Field state = field.get("state", "unloaded, sticking or slipping");
  const Field limit = field.get("limit", "none, min or max");
  const Real says = friction_used.finite();
  const std::string &is = state.word({"unloaded", "sticking", "slipping"}),
                    &at = limit.word({"none", "min", "max"});
  const bool pressing = clear ? loaded : is != "unloaded";
  claims.check(friction_used, "friction_used is tangential / (friction * normal)",
               std::abs(says - (pressing ? used : 0)), 1e-11L * std::max(says, Real{1e-3L}));
  const bool slips = near(used, 1 - at_limit, unsure) ? is == "slipping" : used > 1 - at_limit;
  claims.check(state, "state follows from the forces",
               is == (!pressing ? "unloaded"
                      : slips   ? "slipping"
                                : "sticking"));
  const bool max = n >= contact.hi - at_limit * W;
  const bool min = contact.lo > 0 && n <= contact.lo + at_limit * W;
  const bool close = near(n, contact.hi - at_limit * W, unsure * W) ||
                     near(n, contact.lo + at_limit * W, unsure * W);
  claims.check(limit, "limit follows from normal_force",
               close || at == (max   ? "max"
                               : min ? "min"
                                     : "none"));
  if (pressing) {
    hold.loaded.push_back(index);
    hold.slipping = hold.slipping && is == "slipping";
  }
  return claim;
}

void check_fingers(Claims& claims, const Held& held, const Field& hold, const Load& load,
                   const std::vector<ContactClaim>& contacts, bool& all_loaded, bool& clear) {
  const Field list = hold.get("fingers", "a list of fingers");
  const auto fingers = list.list();
  if (fingers.size() != held.fingers.size())
    list.fail("must have " + std::to_string(held.fingers.size()) + " fingers, as the grasp has");
  Real most = 0;
  for (std::size_t k = 0; k < fingers.size(); ++k) {
    const Field& field = fingers[k];
    claims.check(field, "finger is that of the grasp",
                 field.get("finger", "a label").text() == held.fingers[k]);
    Real normal = 0, size = 0;
    Vec force = Vec::Zero(held.dim);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (held.contacts[i].finger != held.fingers[k]) continue;
      normal += contacts[i].force[0];
      force += contacts[i].vector;
      size += contacts[i].vector.norm();
    }
    const Field n = field.get("normal_force", "a force [N]"), f = field.get("force", "a force [N]");
    claims.check(n, "normal_force is the sum of its contacts'", std::abs(n.finite() - normal),
                 rounding * size);
    claims.check(f, "force is the sum of its contacts'", (read_vector(f, held.dim) - force).norm(),
                 rounding * size);
    most = std::max(most, normal);
    if (near(normal, at_limit * load.weight, unsure * load.weight)) clear = false;
    all_loaded = all_loaded && normal > at_limit * load.weight;
  }
  const Field grip = hold.get("grip_force", "a force [N]");
  claims.check(grip, "grip_force is the largest finger's normal force",
               difference(grip.finite(), most), rounding);
  const Field all = hold.get("all_loaded", "true or false");
  claims.check(all, "all_loaded follows from the fingers", !clear || all.truth() == all_loaded);
}

void check_forces(Claims& claims, const Held& held, const Field& hold, const Load& load,
                  const Vec& w, HoldClaim& claim) {
  const Field list = hold.get("contacts", "a list of contacts");
  const auto fields = list.list();
  if (fields.size() != held.contacts.size())
    list.fail("must have " + std::to_string(held.contacts.size()) + " contacts, as the grasp has");
  const Real W = load.weight;
  std::vector<ContactClaim> contacts;
  Real effort = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    contacts.push_back(check_contact(claims, held.contacts[i], fields[i], load, claim, i));
    effort += contacts[i].force.squaredNorm() / held.contacts[i].share;
  }
  const Real norm = std::sqrt(effort) / W, count = static_cast<Real>(fields.size());
  const Real digits = 2e-15L * (1 + norm) * count;  // what the forces lose by their rounding [W]

  const Field effort_field = hold.get("effort", "a number [N^2]");
  const Field norm_field = hold.get("force_norm", "a force [N]");
  claim.effort = effort_field.finite();
  claims.check(effort_field, "effort is that of the forces", difference(claim.effort, effort),
               1e-11L);
  claims.check(norm_field, "force_norm is the root of effort",
               difference(norm_field.finite(), std::sqrt(claim.effort)), rounding);

  Vec off = w;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const Touch& contact = held.contacts[i];
    off -= wrench(contacts[i].vector, contact.position);
    if (contact.torsion > 0) off.tail(3) -= contacts[i].moment * contact.normal;
    claims.check(fields[i], "force is within the friction cone and its limits [weights]",
                 outside(contact, contacts[i].force) / W, digits);
  }
  const Vec force = off.head(held.dim);
  const Vec moment = (off - wrench(force, load.com)).tail(off.size() - held.dim);
  Real error = force.norm() / W;
  if (load.radius > 0) error = std::max(error, moment.norm() / (W * load.radius));
  claims.check(hold, "forces balance the load [weights]", error, 2 * delta + digits);

  bool all_loaded = true, clear = true;
  check_fingers(claims, held, hold, load, contacts, all_loaded, clear);
  const Field manner = hold.get("manner", "resting, cradled or pinched");
  claim.manner = manner.word({"resting", "cradled", "pinched"});
  const Fork cradled = fork(held, load, claim.up);
  const bool resting = held.fingers.size() == 1 || !all_loaded;
  claims.check(manner, "manner follows from forces and posture",
               !clear || (resting                ? claim.manner == "resting"
                          : cradled == Fork::yes ? claim.manner == "cradled"
                          : cradled == Fork::no  ? claim.manner == "pinched"
                                                 : claim.manner != "resting"));
}

void check_posture(Claims& claims, const Held& held, const Field& hold, HoldClaim& claim) {
  const Field up = hold.get("up", "the direction against gravity");
  claim.up = read_vector(up, held.dim);
  claims.check(up, "up is a unit vector", std::abs(claim.up.norm() - 1), rounding);
  if (held.dim == 3) return;
  const Field angle = hold.get("angle_deg", "an angle in degrees");
  const Real degrees = angle.finite();
  claim.angle = radians(degrees);
  claims.check(angle, "angle_deg is in (-180, 180]", degrees > -180 && degrees <= 180);
  claims.check(angle, "angle_deg is the posture up", (claim.up - up_at(claim.angle)).norm(),
               rounding);
}

/// Which scenario decides: the one that needs most.
void check_scenarios(Claims& claims, const Held& held, const Field& hold, HoldClaim& claim) {
  if (held.loads.size() == 1) return;
  const Field scenario = hold.get("scenario", "the number of a scenario");
  const Real number = scenario.finite();
  for (std::size_t k = 0; k < held.loads.size(); ++k)
    if (number == static_cast<Real>(k)) claim.scenario = k;
  claims.check(scenario, "scenario is one of the grasp's",
               number == static_cast<Real>(claim.scenario));
  const Field list = hold.get("scenario_efforts", "a list of efforts");
  const auto efforts = list.list();
  if (efforts.size() != held.loads.size())
    list.fail("must have " + std::to_string(held.loads.size()) + " efforts, one for each scenario");
  const auto decides = [&](const Field& effort) { return effort.is_null() == !claim.holdable; };
  claims.check(scenario, "the scenario decides", decides(efforts[claim.scenario]));
  if (!claim.holdable) return;
  const Real most = hold.get("effort", "a number [N^2]").finite();
  for (std::size_t k = 0; k < efforts.size(); ++k)
    claims.check(efforts[k], "no scenario needs more than the one that decides",
                 efforts[k].finite() / most, 1 + 1e-9L);
  claims.check(efforts[claim.scenario], "its effort is that of the hold",
               difference(efforts[claim.scenario].finite(), most), rounding);
  claims.note("The efforts of the scenarios that do not decide are not checked.");
}

}  // namespace

Vec read_vector(const Field& field, Eigen::Index size) {
  const auto parts = field.list();
  if (static_cast<Eigen::Index>(parts.size()) != size)
    field.fail("has " + std::to_string(parts.size()) + " numbers, must have " +
               std::to_string(size));
  Vec result(size);
  for (Eigen::Index k = 0; k < size; ++k) result[k] = parts[static_cast<std::size_t>(k)].finite();
  return result;
}

HoldClaim check_hold(Claims& claims, const Held& held, const Field& hold, Real force_cap,
                     bool least) {
  HoldClaim claim;
  claim.holdable = hold.get("holdable", "true or false").truth();
  check_posture(claims, held, hold, claim);
  claim.dual = read_vector(hold.get("dual", "a twist"), held.wrench_size());
  const Field lower = hold.get("lower_bound", "a number [N^2]");
  const Real says = lower.finite();
  check_scenarios(claims, held, hold, claim);
  const Load& load = held.loads[claim.scenario];
  const Real W = load.weight, cap = force_cap * W;
  const Vec w = wrench(load, claim.up);
  const Real best = bound(held, w, claim.dual);
  const Real slack = 2 * delta * worth(load, claim.dual);

  if (!claim.holdable) {
    hold.get("reason", "words").text();
    claims.check(lower, "lower_bound follows from dual",
                 std::max(Real{0}, says / (best - slack) - 1), 1e-6L);
    claims.check(hold, "dual proves that the force cap is not enough: cap^2 / bound",
                 best > slack ? cap * cap / (best - slack) : 2, 1);
    if (says <= cap * cap)
      claims.note("A hold says itself that it is not proven: its lower_bound is below the cap.");
    return claim;
  }
  check_forces(claims, held, hold, load, w, claim);
  const Real norm = std::sqrt(claim.effort) / W;
  claims.check(hold, "force_norm is within the force cap",
               std::sqrt(claim.effort) / (force_cap * held.heaviest()), 1 + 1e-9L);
  if (!least) return claim;
  // y loses as many digits as it is longer than the weight.
  const Real lost = std::max(Real{1}, norm / 1000), small = 1e-15L * W * W + slack;
  claims.check(lower, "lower_bound follows from dual [of effort]",
               std::max(Real{0}, says - best) / claim.effort, 1e-10L * lost + small / claim.effort);
  claims.check(lower, "effort is the least: it is the lower_bound [of effort]",
               std::abs(claim.effort - says) / claim.effort, 1e-9L * lost + small / claim.effort);
  return claim;
}

Fork fork(const Held& held, const Load& load, const Vec& up) {
  return held.dim == 2 ? fork_in_plane(held, load, up) : fork_in_space(held, load, up);
}

}  // namespace poise::verify
