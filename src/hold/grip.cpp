#include "poise/grip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "dual/exact.hpp"
#include "dual/grip_ascent.hpp"
#include "dual/twist.hpp"
#include "hold/cone_hand.hpp"
#include "hold/solve.hpp"

namespace poise {
namespace {

/// The forces shown may need so much more of the grip than the least: room for the least effort.
constexpr double room = 1e-8;
/// Of forces that are as good as balanced, and of a value as good as proven.
constexpr double most_error = 1e-6;
/// An imbalance [weights] that is as good as none, and one that is not.
constexpr double fair = 1e-10, balanced = 1e-9;

/// Those of the fingers, about the object frame's origin [N, N m].
template <int Dim>
SmallVector<Wrench<Dim>, 8> finger_wrenches(const Hand<Dim>& hand, const Hold<Dim>& hold) {
  SmallVector<Wrench<Dim>, 8> wrenches(hand.fingers().size());
  for (Wrench<Dim>& wrench : wrenches) wrench.setZero();
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    const ContactForce<Dim>& force = hold.forces[i];
    const Vector<Dim> f = force_vector(contact, force), r = contact.position;
    Wrench<Dim>& wrench = wrenches[hand.finger_of(i)];
    wrench.template head<Dim>() += f;
    if constexpr (Dim == 2) {
      wrench[2] += r.x() * f.y() - r.y() * f.x();
    } else {
      wrench.template tail<3>() += r.cross(f) + force.torsion_moment * contact.normal +
                                   force.center_of_pressure.cross(force.normal * contact.normal);
    }
  }
  return wrenches;
}

/// Why a hand has no grip.
template <int Dim>
InvalidGrasp problem_of(const Hand<Dim>& hand) {
  if (!hand.driven().closing)
    for (std::size_t k = 0; k < hand.fingers().size(); ++k)
      if (hand.closing(k).isZero(0))
        return InvalidGrasp("fingers." + hand.fingers()[k] + ".closing",
                            "must be given: the normals of its contacts cancel each other");
  const std::vector<Drive<Dim>> drives = hand.drives();
  const auto a = std::find_if(drives.begin(), drives.end(),
                              [](const Drive<Dim>& drive) { return !std::isfinite(drive.max); });
  return hand.mechanism().kind == DriveKind::listed
             ? InvalidGrasp("drives[" + std::to_string(a - drives.begin()) + "].max",
                            "must be given: the drives are of different kinds, or have "
                            "different max")
             : InvalidGrasp("fingers." + a->name + ".max_force",
                            "must be given, as another finger has one: the grip is counted in "
                            "parts of them");
}

/// Whether forces balance the load within their limits.
template <int Dim>
bool is_fair(const Hand<Dim>& hand, double weight, const Hold<Dim>& hold) {
  bool fair = hold.residual <= balanced;
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const double normal = hold.forces[i].normal, near = balanced * (weight + std::abs(normal));
    fair = fair && normal >= hand.contacts()[i].min_normal - near &&
           normal <= hand.contacts()[i].max_normal + near;
  }
  return fair;
}

/// What (y, rates) of a hold prove.
template <int Dim>
void write_grip(const Hand<Dim>& hand, const Wrench<Dim>& load, double cap, Hold<Dim>& hold) {
  hold.objective = Objective::grip;
  hold.grip = grip(hand, hold);
  hold.lower_bound = std::clamp(grip_bound(hand, load, hold.dual, hold.rates, cap), 0.0, hold.grip);
}

/// Whether it can be held at all, where the grip's search ended without an answer to all digits.
template <int Dim>
Hold<Dim> unlimited_hold(const Hand<Dim>& hand, const Wrench<Dim>& load, double weight,
                         const dual::Balance<Dim>& ended, const HoldSettings& settings) {
  if (!hand.is_general())
    return hold<Dim>(hand, load, weight, Twist<Dim>(Twist<Dim>::Zero()),
                     {.force_cap = settings.force_cap});
  Hold<Dim> none;
  none.holdable = ended.state == dual::Balance<Dim>::State::open && ended.error < most_error;
  const double cap = settings.force_cap * weight;
  none.dual = about_origin(hand.scaled(), weight, ended.y);
  // In the solver's units the dual rises by 1 for each length of y.
  none.dual *= settings.force_cap * settings.force_cap;
  none.lower_bound =
      std::min(static_cast<double>(dual::effort_bound<Dim>(hand, load, none.dual, {}, 1)),
               std::numeric_limits<double>::max());
  none.proven = none.lower_bound > cap * cap;
  write_exact_proof(hand, load, weight, settings.force_cap, none);
  return none;
}

/// The hold of least grip with its proof, by ascent. False where that leaves it open.
template <int Dim>
bool ascend(const Hand<Dim>& hand, const Wrench<Dim>& load, double weight,
            const HoldSettings& settings, Hold<Dim>& hold) {
  const Driven<Dim>& driven = hand.driven();
  if (!driven.apart) return false;
  const dual::Problem<Dim> problem(hand.scaled(), weight);
  const Wrench<Dim> w = scaled_wrench(problem.hand, weight, load);
  dual::Point<Dim> held(problem.size);
  if (!dual::maximise(problem, w, dual::cold_start(problem, w), settings.force_cap, held)) {
    write_proof(problem, held, settings, hold);
    write_exact_proof(hand, load, weight, settings.force_cap, hold);
    return true;
  }
  dual::LeastGrip<Dim> found(problem.size);
  if (!dual::least_grip(problem, driven, w, held, found)) return false;
  write_point(problem, found.point, hold);
  hold.dual = about_origin(problem.hand, scaled_grip(hand, weight) / weight, found.y);
  hold.rates.resize(found.rates.size());
  std::copy(found.rates.begin(), found.rates.end(), hold.rates.begin());
  write_grip(hand, load, settings.force_cap * weight, hold);
  return true;
}

}  // namespace

const char* to_string(GripUnit unit) {
  constexpr const char* names[] = {"N", "N m", "of max"};
  return names[static_cast<int>(unit)];
}

const char* to_string(Objective objective) {
  constexpr const char* names[] = {"grip", "effort"};
  return names[static_cast<int>(objective)];
}

template <int Dim>
bool has_grip(const Hand<Dim>& hand) {
  return hand.driven().has_grip();
}

template <int Dim>
GripUnit grip_unit(const Hand<Dim>& hand) {
  const Driven<Dim>& driven = hand.driven();
  if (!driven.has_grip()) throw problem_of(hand);
  if (!driven.alike) return GripUnit::part_of_max;
  return driven.drives[0].turns ? GripUnit::newton_metre : GripUnit::newton;
}

template <int Dim>
double most_grip(const Hand<Dim>& hand) {
  return grip_unit(hand) == GripUnit::part_of_max ? 1 : hand.driven().drives[0].max;
}

template <int Dim>
std::vector<DriveEffort> drive_efforts(const Hand<Dim>& hand, const Hold<Dim>& hold) {
  if (!hold.holdable) return {};
  const Driven<Dim>& driven = hand.driven();
  std::vector<DriveEffort> efforts(driven.drives.size());
  const auto wrenches = finger_wrenches(hand, hold);
  for (const auto& moved : driven.moved)
    efforts[moved.drive].effort += moved.twist.dot(wrenches[moved.finger]);
  // What rounding leaves of drives that do nothing.
  const double nothing = 1e-15 * std::sqrt(hold.effort);
  for (std::size_t a = 0; a < efforts.size(); ++a) {
    double& effort = efforts[a].effort;
    const double length = driven.drives[a].turns ? hand.scaled().length : 1;
    if (std::abs(effort) <= nothing * length) effort = 0;
    if (const double max = driven.drives[a].max; std::isfinite(max))
      efforts[a].part_of_max = effort / max;
  }
  return efforts;
}

template <int Dim>
double grip(const Hand<Dim>& hand, const Hold<Dim>& hold) {
  const bool in_parts = grip_unit(hand) == GripUnit::part_of_max;
  double most = 0;
  for (const DriveEffort& drive : drive_efforts(hand, hold))
    most = std::max(most, in_parts ? drive.part_of_max : drive.effort);
  return most;
}

template <int Dim>
double grip_bound(const Hand<Dim>& hand, const Wrench<Dim>& load, const Twist<Dim>& y,
                  const SmallVector<double, 4>& rates, double force_norm) {
  return static_cast<double>(dual::grip_bound<Dim>(
      hand, load, y, rates, grip_unit(hand) == GripUnit::part_of_max, force_norm));
}

template <int Dim>
Hold<Dim> least_grip(const Hand<Dim>& hand, const Wrench<Dim>& load, double weight,
                     const HoldSettings& settings) {
  check(settings);
  if (!load.allFinite()) throw InvalidGrasp("load", "must be finite");
  if (!(weight > 0)) throw InvalidGrasp("weight", "must be above 0");
  using State = typename dual::Balance<Dim>::State;
  const double unit = scaled_grip(hand, weight), cap = settings.force_cap * weight;
  if (Hold<Dim> hold; ascend(hand, load, weight, settings, hold)) return hold;
  const ScaledHand<Dim>& scaled = hand.scaled();
  const Wrench<Dim> w = scaled_wrench(scaled, weight, load);
  dual::ConeHand<Dim> cones = cone_hand(hand, weight, dual::Wanted::grip);
  const dual::Balance<Dim> least = dual::balance(cones, w, dual::Wanted::grip);
  if (least.state != State::held) {
    Hold<Dim> hold = unlimited_hold(hand, load, weight, least, settings);
    if (!hold.holdable) return hold;
  }

  // Of the forces of this grip those of least effort, but for digits that nobody needs.
  for (dual::ConeDrive<Dim>& drive : cones.drives) drive.max = least.value * (1 + room) + 1e-12;
  const dual::Balance<Dim> found = dual::quick_balance(cones, w, dual::Wanted::effort);
  Hold<Dim> hold;
  hold.holdable = true;
  write_balance(hand, weight, cones, least, hold);
  if (found.state != State::not_held && found.error <= most_error &&
      found.residual.norm() <= std::max(least.residual.norm(), fair)) {
    Hold<Dim> easier = hold;
    write_balance(hand, weight, cones, found, easier);
    if (grip(hand, easier) <= grip(hand, hold) * (1 + 4 * room) + 1e-12 * unit)
      hold = std::move(easier);
  }
  // Where nothing has an inside the least effort decides; what the cap allows it says, too.
  const bool fair = is_fair(hand, weight, hold);
  if (hold.effort > cap * cap || !fair) {
    Hold<Dim> easiest = poise::hold(hand, load, weight, Twist<Dim>(Twist<Dim>::Zero()),
                                    {.force_cap = settings.force_cap});
    if (!fair || !easiest.holdable) hold = std::move(easiest);
    if (!hold.holdable) return hold;
  }

  const dual::GripCut<Dim> cut = dual::grip_cut(cones, least, settings.force_cap);
  hold.rates.resize(cut.rates.size());
  for (std::size_t a = 0; a < cut.rates.size(); ++a) hold.rates[a] = cut.rates[a] / cut.rate_sum;
  hold.dual = about_origin(scaled, unit / weight / cut.rate_sum, cut.y);
  write_grip(hand, load, cap, hold);
  return hold;
}

template <int Dim>
Hold<Dim> least_grip(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                     const HoldSettings& settings) {
  check_up<Dim>(up);
  return least_grip(hand, load.at(up), load.size(hand.length()), settings);
}

template <int Dim>
Hold<Dim> least_grip(const Grasp<Dim>& grasp, const Vector<Dim>& up, const HoldSettings& settings) {
  Hold<Dim> most = least_grip(grasp, grasp.loads().front(), up, settings);
  for (std::size_t k = 1; k < grasp.loads().size() && most.holdable; ++k) {
    Hold<Dim> other = least_grip(grasp, grasp.loads()[k], up, settings);
    if (!other.holdable || other.grip > most.grip) most = std::move(other);
  }
  return most;
}

#define POISE_INSTANTIATE(Dim)                                                          \
  template bool has_grip(const Hand<Dim>&);                                             \
  template GripUnit grip_unit(const Hand<Dim>&);                                        \
  template double most_grip(const Hand<Dim>&);                                          \
  template std::vector<DriveEffort> drive_efforts(const Hand<Dim>&, const Hold<Dim>&);  \
  template double grip(const Hand<Dim>&, const Hold<Dim>&);                             \
  template double grip_bound(const Hand<Dim>&, const Wrench<Dim>&, const Twist<Dim>&,   \
                             const SmallVector<double, 4>&, double);                    \
  template Hold<Dim> least_grip(const Hand<Dim>&, const Wrench<Dim>&, double,           \
                                const HoldSettings&);                                   \
  template Hold<Dim> least_grip(const Hand<Dim>&, const Load<Dim>&, const Vector<Dim>&, \
                                const HoldSettings&);                                   \
  template Hold<Dim> least_grip(const Grasp<Dim>&, const Vector<Dim>&, const HoldSettings&);
POISE_INSTANTIATE(2)
POISE_INSTANTIATE(3)
#undef POISE_INSTANTIATE

}  // namespace poise
