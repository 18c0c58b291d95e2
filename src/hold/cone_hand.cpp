#include "hold/cone_hand.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dual/cone_pad.hpp"
#include "dual/exact.hpp"
#include "dual/twist.hpp"
#include "hold/solve.hpp"

namespace poise {
namespace {

using dual::ConeContact;
using dual::ConeHand;
using dual::ConePart;
using dual::PartForce;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// A contact that may press this little more than it must is given this much room [weights]: the
/// interior has to have a size.
constexpr double least_room = 1e-9;
/// Of what is told as a hold: of its balance, limits and value, in parts.
constexpr double most_error = 1e-8;

/// Wrenches in the solver's units.
template <int Dim>
struct Arm {
  const ScaledHand<Dim>& scaled;

  Wrench<Dim> force(const Vector<Dim>& force, const Vector<Dim>& at) const {
    const Vector<Dim> r = (at - scaled.center) * scaled.per_length;
    Wrench<Dim> w;
    if constexpr (Dim == 2)
      w << force, r.x() * force.y() - r.y() * force.x();
    else
      w << force, r.cross(force);
    return w;
  }
  Wrench<3> moment(const Vector<3>& moment) const {
    Wrench<3> w;
    w << Vector<3>::Zero(), moment * scaled.per_length;
    return w;
  }
};

void add_parts(const Contact<2>& contact, double factor, const Arm<2>& arm, ConeHand<2>& cones) {
  const double mu = contact.friction * factor;
  if (mu == 0) return;
  const Vector<2> tangent(-contact.normal.y(), contact.normal.x());
  cones.parts.push_back({mu, 1 / contact.share, arm.force(tangent, contact.position)});
}

void add_parts(const Contact<3>& contact, double factor, const Arm<3>& arm, ConeHand<3>& cones) {
  const double mu = contact.friction * factor;
  const Eigen::Matrix<double, 3, 2> tangent = tangents(contact.normal);
  const auto add = [&](const Vector<3>& at, double part) {
    if (mu == 0) return;
    ConePart<3> cone{mu * part, 1 / (part * contact.share), {}};
    cone.G << arm.force(tangent.col(0), at), arm.force(tangent.col(1), at), Wrench<3>::Zero();
    cones.parts.push_back(cone);
  };
  if (!contact.pad) {
    add(contact.position, 1);
    if (mu > 0 && contact.torsion > 0)
      cones.parts.back().G.col(2) = arm.moment(contact.torsion / contact.friction * contact.normal);
    return;
  }
  const dual::PadFrame frame(contact);
  for (std::size_t k = 0; k < contact.pad->points.size(); ++k)
    add(contact.position + contact.pad->points[k], contact.pad->shares[k]);
  for (std::size_t c = 0; c < 2; ++c) {
    if (!(frame.reach[c] > 0)) continue;
    ConePart<3> cone{frame.reach[c] / frame.gyration[c], 1, {}};
    cone.G << arm.moment(frame.gyration[c] * frame.axes[c]), Wrench<3>::Zero(), Wrench<3>::Zero();
    cones.parts.push_back(cone);
  }
}

/// Where the normal force acts.
template <int Dim>
Vector<Dim> middle(const Contact<Dim>& contact) {
  if constexpr (Dim == 3)
    if (contact.pad) return contact.position + dual::PadFrame(contact).mean;
  return contact.position;
}

/// What effort a unit of the scaled grip is to a drive [N, or N m].
template <int Dim>
double drive_unit(const Hand<Dim>& hand, const typename Driven<Dim>::Limit& drive, GripUnit unit,
                  double weight) {
  return unit == GripUnit::part_of_max ? drive.max
         : drive.turns                 ? weight * hand.scaled().length
                                       : weight;
}

/// The unit of grip, or any where the effort is asked for: then drives may be of all kinds.
template <int Dim>
GripUnit unit_for(const Hand<Dim>& hand, dual::Wanted wanted) {
  return wanted == dual::Wanted::grip ? grip_unit(hand) : GripUnit::newton;
}

void write_contact(const Contact<2>& contact, double mu, double normal, const PartForce<2>* parts,
                   std::size_t count, double weight, ContactForce<2>& force,
                   std::vector<Vector<3>>&) {
  force.normal = normal;
  force.tangential = count == 0 ? 0 : weight * parts[0][0];
  force.friction_used = std::abs(force.tangential) / (mu * normal);
}

void write_contact(const Contact<3>& contact, double mu, double normal, const PartForce<3>* parts,
                   std::size_t count, double weight, ContactForce<3>& force,
                   std::vector<Vector<3>>& pad_forces) {
  const Eigen::Matrix<double, 3, 2> tangent = tangents(contact.normal);
  const auto tangential = [&](std::size_t k) -> Vector<3> {
    return weight * tangent * parts[k].head<2>();
  };
  force.normal = normal;
  force.tangential.setZero();
  force.torsion_moment = 0;
  force.center_of_pressure.setZero();
  if (!contact.pad) {
    if (count == 0) return;
    force.tangential = tangential(0);
    if (contact.torsion > 0)
      force.torsion_moment = weight * parts[0][2] * contact.torsion / contact.friction;
    force.friction_used = weight * parts[0].norm() / (mu * normal);
    return;
  }
  const dual::PadFrame frame(contact);
  std::size_t k = 0;
  double used = 0;
  for (const Vector<3>& point : contact.pad->points) {
    const Vector<3> t = mu > 0 ? tangential(k++) : Vector<3>::Zero();
    pad_forces.push_back(t);
    force.tangential += t;
    force.torsion_moment += contact.normal.dot(point.cross(t));
    used += t.norm();
  }
  force.friction_used = used / (mu * normal);
  force.center_of_pressure = frame.mean;
  for (std::size_t c = 0; c < 2; ++c) {
    if (!(frame.reach[c] > 0)) continue;
    // A moment about an axis moves the pressure across it: m = r x N n.
    const Vector<3> moment = weight * frame.gyration[c] * parts[k++][0] * frame.axes[c];
    if (normal > 0) force.center_of_pressure += contact.normal.cross(moment) / normal;
  }
}

}  // namespace

template <int Dim>
dual::ConeHand<Dim> cone_hand(const Hand<Dim>& hand, double weight, dual::Wanted wanted,
                              double factor) {
  const ScaledHand<Dim>& scaled = hand.scaled();
  const Arm<Dim> arm{scaled};
  ConeHand<Dim> cones{hand.fingers().size(), {}, {}, {}};
  for (std::size_t i = 0; i < hand.contacts().size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    const double lo = contact.min_normal / weight, hi = contact.max_normal / weight;
    const std::size_t first = cones.parts.size();
    add_parts(contact, factor, arm, cones);
    cones.contacts.push_back({arm.force(contact.normal, middle(contact)), 1 / contact.share, lo,
                              std::max(hi, lo + least_room), first, cones.parts.size(),
                              hand.finger_of(i)});
  }
  const GripUnit unit = unit_for(hand, wanted);
  const Driven<Dim>& driven = hand.driven();
  auto moved = driven.moved.begin();
  for (std::size_t a = 0; a < driven.drives.size(); ++a) {
    const auto& drive = driven.drives[a];
    const double scale = weight / drive_unit(hand, drive, unit, weight);
    dual::ConeDrive<Dim> moves{{}, drive.max * scale / weight};
    for (; moved != driven.moved.end() && moved->drive == a; ++moved)
      moves.moved.push_back({moved->finger, scale * about_center(scaled, 1, moved->twist)});
    if (wanted == dual::Wanted::grip || std::isfinite(drive.max))
      cones.drives.push_back(std::move(moves));
  }
  return cones;
}

template <int Dim>
double scaled_grip(const Hand<Dim>& hand, double weight) {
  switch (grip_unit(hand)) {
    case GripUnit::newton:
      return weight;
    case GripUnit::newton_metre:
      return weight * hand.scaled().length;
    case GripUnit::part_of_max:
      break;
  }
  return 1;
}

template <int Dim>
void write_balance(const Hand<Dim>& hand, double weight, const dual::ConeHand<Dim>& cones,
                   const dual::Balance<Dim>& balance, Hold<Dim>& hold, double friction_factor) {
  const double moment = balance.residual.template tail<wrench_size<Dim> - Dim>().norm();
  hold.residual =
      std::max(balance.residual.template head<Dim>().norm(), hand.radius() > 0 ? moment : 0);
  hold.forces.resize(hand.contacts().size());
  hold.pad_forces.clear();
  double square = 0;
  for (std::size_t i = 0; i < hand.contacts().size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    const ConeContact<Dim>& cone = cones.contacts[i];
    ContactForce<Dim>& force = hold.forces[i];
    const double normal = balance.normals[i];
    square += cone.weight * normal * normal;
    for (std::size_t k = cone.first; k < cone.last; ++k)
      square += cones.parts[k].weight * balance.tangentials[k].squaredNorm();
    const double mu = contact.friction * friction_factor;
    write_contact(contact, mu, weight * normal, balance.tangentials.data() + cone.first,
                  cone.last - cone.first, weight, force, hold.pad_forces);
    const bool loaded = normal > at_limit, frictionless = mu == 0;
    if (!loaded || frictionless) force.friction_used = loaded ? 1 : 0;
    force.friction_used = std::min(force.friction_used, 1.0);
    force.state = !loaded                               ? ContactState::unloaded
                  : force.friction_used >= 1 - at_limit ? ContactState::slipping
                                                        : ContactState::sticking;
    force.limit = limit_of(force.normal, contact.min_normal, contact.max_normal, at_limit * weight);
  }
  hold.effort = weight * weight * square;
}

template <int Dim>
Hold<Dim> general_hold(const Hand<Dim>& hand, double friction_factor, const Wrench<Dim>& load,
                       double weight, const HoldSettings& settings) {
  const ScaledHand<Dim>& scaled = hand.scaled();
  const dual::ConeHand<Dim> cones = cone_hand(hand, weight, dual::Wanted::effort, friction_factor);
  const dual::Balance<Dim> found =
      dual::balance(cones, scaled_wrench(scaled, weight, load), dual::Wanted::effort);
  using State = typename dual::Balance<Dim>::State;
  Hold<Dim> hold;
  const double cap = settings.force_cap * weight;
  hold.dual = about_origin(scaled, weight, found.y);
  const auto& drives = hand.driven().drives;
  hold.rates.resize(drives.size());
  std::size_t limited = 0;
  for (std::size_t a = 0; a < drives.size(); ++a) {
    hold.rates[a] = 0;
    if (std::isfinite(drives[a].max))
      hold.rates[a] = weight * found.rates[limited++] *
                      (weight / drive_unit(hand, drives[a], GripUnit::newton, weight));
  }
  hold.holdable = found.state != State::not_held && found.error <= most_error &&
                  2 * found.value <= settings.force_cap * settings.force_cap;
  if (hold.holdable) {
    write_balance(hand, weight, cones, found, hold, friction_factor);
    hold.holdable = hold.residual <= most_error;
  }
  if (!hold.holdable) {
    hold.forces.resize(0);
    hold.pad_forces.clear();
    hold.effort = 0;
    // As long as a bound above the cap needs: the dual rises by 1 for each length of y, in the
    // solver's units.
    const double times = settings.force_cap * settings.force_cap;
    hold.dual *= times;
    for (double& rate : hold.rates) rate *= times;
  }
  const auto proven = static_cast<double>(
      dual::effort_bound<Dim>(hand, load, hold.dual, hold.rates, friction_factor));
  hold.lower_bound = hold.holdable ? std::min(proven, hold.effort)
                                   : std::min(proven, std::numeric_limits<double>::max());
  hold.proven = hold.holdable || proven > cap * cap;
  write_exact_proof(hand, load, weight, settings.force_cap, hold, friction_factor);
  return hold;
}

template <int Dim>
PartHand<Dim> part_hand(const Hand<Dim>& hand, double friction_factor, double weight) {
  const dual::ConeHand<Dim> given = cone_hand(hand, weight, dual::Wanted::effort, friction_factor);
  dual::ConeHand<Dim> cones{given.fingers, {}, {}, given.drives};
  double least_max = infinity;
  for (const dual::ConeDrive<Dim>& drive : given.drives) least_max = std::min(least_max, drive.max);
  for (const Contact<Dim>& contact : hand.contacts())
    if (contact.max_normal > 0) least_max = std::min(least_max, contact.max_normal / weight);
  for (dual::ConeDrive<Dim>& drive : cones.drives)
    for (auto& moved : drive.moved) moved.twist *= least_max / drive.max;
  for (std::size_t i = 0; i < given.contacts.size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    if (contact.max_normal == 0) continue;
    ConeContact<Dim> cone = given.contacts[i];
    const auto parts = given.parts.begin();
    cones.parts.insert(cones.parts.end(), parts + static_cast<std::ptrdiff_t>(cone.first),
                       parts + static_cast<std::ptrdiff_t>(cone.last));
    cone.first = cones.parts.size() - (cone.last - cone.first);
    cone.last = cones.parts.size();
    cone.hi = infinity;
    if (std::isfinite(contact.max_normal)) {
      for (dual::ConeDrive<Dim>& drive : cones.drives)
        for (std::size_t k = drive.moved.size(); k-- > 0;)
          if (drive.moved[k].finger == cone.finger)
            drive.moved.push_back({cones.fingers, drive.moved[k].twist});
      cone.finger = cones.fingers++;
      Twist<Dim> along = Twist<Dim>::Zero();
      along.template head<Dim>() = least_max * weight / contact.max_normal * contact.normal;
      cones.drives.push_back({{{cone.finger, along}}, 0});
    }
    cones.contacts.push_back(cone);
  }
  return {std::move(cones), least_max};
}

template <int Dim>
LeastPart<Dim> least_part(const Hand<Dim>& hand, double friction_factor, const Wrench<Dim>& load,
                          double weight) {
  const ScaledHand<Dim>& scaled = hand.scaled();
  const PartHand<Dim> parts = part_hand(hand, friction_factor, weight);
  const dual::Balance<Dim> found =
      dual::balance(parts.cones, scaled_wrench(scaled, weight, load), dual::Wanted::grip);
  LeastPart<Dim> least{
      found.state, found.value / parts.unit, about_origin(scaled, 1 / weight, found.y), {}};
  const std::vector<Drive<Dim>> drives = hand.drives();
  least.rates.resize(drives.size());
  std::size_t limited = 0;
  for (std::size_t a = 0; a < drives.size(); ++a) {
    const bool is_limited = std::isfinite(drives[a].max);
    const double rate = is_limited ? found.rates[limited++] * parts.unit / drives[a].max : 0;
    least.rates[a] = found.state == dual::Balance<Dim>::State::not_held ? 0 : rate;
  }
  return least;
}

#define POISE_INSTANTIATE(Dim)                                                              \
  template dual::ConeHand<Dim> cone_hand(const Hand<Dim>&, double, dual::Wanted, double);   \
  template double scaled_grip(const Hand<Dim>&, double);                                    \
  template void write_balance(const Hand<Dim>&, double, const dual::ConeHand<Dim>&,         \
                              const dual::Balance<Dim>&, Hold<Dim>&, double);               \
  template PartHand<Dim> part_hand(const Hand<Dim>&, double, double);                       \
  template LeastPart<Dim> least_part(const Hand<Dim>&, double, const Wrench<Dim>&, double); \
  template Hold<Dim> general_hold(const Hand<Dim>&, double, const Wrench<Dim>&, double,     \
                                  const HoldSettings&);
POISE_INSTANTIATE(2)
POISE_INSTANTIATE(3)
#undef POISE_INSTANTIATE

}  // namespace poise
