// What is withstood besides the load: docs/certificate.md, "capacity".
#include "verify/shake.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ask/document.hpp"
#include "poise/grip.hpp"
#include "verify/trig.hpp"

namespace poise::verify {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();
constexpr Real pi = std::numbers::pi_v<Real>;
constexpr Real of_hull = 1e-8L;  ///< of what points in a hull reach, from their digits
constexpr Real little_angle = 0.01L * pi / 180;
/// Beyond this part of the force cap [g] an acceleration is infinite.
constexpr Real part_of_cap = 1e-3L;

/// n . x <= b.
template <int Dim>
struct Side {
  Eigen::Matrix<Real, Dim, 1> n;
  Real b;
};

/// Calls visit(side) for the half-spaces of the hull of points: those by any Dim of them on whose
/// one side all others lie.
template <int Dim, class Visit>
void for_each_side(const std::vector<Eigen::Matrix<Real, Dim, 1>>& points, const Visit& visit) {
  using Point = Eigen::Matrix<Real, Dim, 1>;
  Real size = 0;
  for (const Point& x : points) size = std::max(size, x.norm());
  const auto look = [&](Point n, const Point& at) {
    if (!(n.norm() > 0)) return;
    n.normalize();
    for (const Real sign : {Real{1}, Real{-1}}) {
      const Real b = sign * n.dot(at) + 1e-13L * size;
      if (std::all_of(points.begin(), points.end(),
                      [&](const Point& x) { return sign * n.dot(x) <= b; }))
        visit(Side<Dim>{sign * n, b});
    }
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const Point along = points[j] - points[i];
      if constexpr (Dim == 2)
        look({along.y(), -along.x()}, points[i]);
      else
        for (std::size_t k = j + 1; k < points.size(); ++k)
          look(along.cross(points[k] - points[i]), points[i]);
    }
}

template <int Dim>
std::vector<Eigen::Matrix<Real, Dim, 1>> real_points(const std::vector<Vector<Dim>>& held) {
  std::vector<Eigen::Matrix<Real, Dim, 1>> points;
  for (const Vector<Dim>& x : held) points.push_back(x.template cast<Real>());
  return points;
}

/// Of the half-space n . x <= b in which y leaves the vectors x that are held, each x adding
/// `gain` x through the com to the load.
struct Left {
  Vec n;
  Real b{0};
};
template <int Dim>
Left left_by(const RealGrasp& grasp, const Vec& up, Real gain, const ShakeProofClaim<Dim>& proof,
             const std::vector<Real>& rates, Real cap) {
  const RealLoad& load = grasp.loads.front();
  const Vec y = real(proof.y);
  const Vec v = gain * velocity(y, load.com);
  const Real speed = v.norm(), rest = most_power(grasp, y, rates, cap) - y.dot(wrench(load, up));
  return speed > 0 ? Left{v / speed, rest / speed} : Left{Vec::Zero(Dim), rest};
}

/// What one load is checked with in one posture.
template <int Dim>
class Shaking {
 public:
  Shaking(Verdict& verdict, const Grasp<Dim>& one, const Vector<Dim>& up, Real cap)
      : verdict_(verdict),
        one_(one),
        real_(real_grasp(one)),
        load_(real_.loads.front()),
        given_up_(up),
        up_(real(up)),
        cap_(cap) {}

  void check_shake(const Path& place, const ShakeClaim<Dim>& claim) {
    const Real far = part_of_cap * cap_ * standard_gravity;
    const Real found = claim.acceleration ? Real{*claim.acceleration} : infinity;
    const Real bound = claim.bound ? Real{*claim.bound} : infinity;
    check_sides(place, found, bound, shake_gap * found + no_acceleration, claim.proven);
    const auto rates = real_rates(verdict_, place / "proof" / "rates", real_, claim.proof.rates);
    if (!rates) return;
    const Left left =
        left_by(real_, up_, load_.weight / standard_gravity, claim.proof, *rates, cap_);
    verdict_.check(place / "direction", "a direction is told where there is a bound above 0",
                   claim.direction.has_value() == (claim.bound && bound > 0));
    if (claim.direction) {
      verdict_.check(place / "direction", "direction is that of the dual",
                     left.n.isZero(0) ? 1 : (real(*claim.direction) - left.n).norm(), 1e-9L);
      verdict_.check(place / "bound", "no acceleration beyond the bound is held, by the dual",
                     std::abs(std::max(left.b, Real{0}) - bound),
                     follows * (bound + standard_gravity));
    } else {
      check_unheld(place, found == 0 && bound == 0, left, claim.proven);
    }
    if (found == 0) return;
    if (load_.weight == 0) return check_held(place, Vector<Dim>::Zero(), given_up_);
    check_reach(
        place, std::min(found, far), [](const Side<Dim>& side) { return side.b; },
        claim.proof.held);
    for (std::size_t k = 0; k < claim.proof.held.size(); ++k)
      check_held((place / "proof" / "held")[k], claim.proof.held[k], given_up_);
  }

  void check_tilt(const Path& place, const TiltClaim<Dim>& claim, Real found) {
    const Real bound = claim.bound;
    check_sides(place, found, bound, shake_gap * found + little_angle, claim.proven);
    const auto rates = real_rates(verdict_, place / "proof" / "rates", real_, claim.proof.rates);
    if (!rates) return;
    const Left left = left_by(real_, up_, load_.turning(), claim.proof, *rates, cap_);
    verdict_.check(place / "weakest", "a weakest posture is told where there is a dual",
                   claim.weakest.has_value() == !claim.proof.y.isZero(0));
    if (bound == 0) {
      check_unheld(place, found == 0, left, claim.proven);
      if (claim.weakest)
        verdict_.unchecked(place / "weakest", "where no posture is held, none is the weakest");
    } else if (bound < pi - follows) {
      check_weakest(place / "weakest", claim.weakest, left, bound);
      verdict_.check(place / "bound_deg", "a posture so far away is not held, by the dual [rad]",
                     std::abs(angle_of(left.n, left.b) - bound), follows);
    } else if (claim.weakest) {
      verdict_.unchecked(place / "weakest", "where all postures are held, none is the weakest");
    }
    if (found == 0) return;
    if (load_.turning() == 0) return check_held(place, Vector<Dim>::Zero(), given_up_);
    check_reach(
        place, found, [&](const Side<Dim>& side) { return angle_of(Vec(side.n), side.b); },
        from_up(claim.proof.held));
    for (std::size_t k = 0; k < claim.proof.held.size(); ++k)
      check_held((place / "proof" / "held")[k], Vector<Dim>::Zero(), claim.proof.held[k]);
  }

 private:
  /// How far the posture may be tilted in n . (x - up) <= b; infinite where it may be turned over.
  Real angle_of(const Vec& n, Real b) const {
    if (n.isZero(0)) return infinity;
    const Real along = n.dot(up_), height = along + b;
    if (height >= 1) return infinity;
    const Real to = std::atan2((n - along * up_).norm(), along);
    return std::max(to - std::acos(std::max(height, Real{-1})), Real{0});
  }

  std::vector<Vector<Dim>> from_up(const std::vector<Vector<Dim>>& held) const {
    std::vector<Vector<Dim>> moved;
    for (const Vector<Dim>& x : held) moved.push_back(x - given_up_);
    return moved;
  }

  void check_sides(const Path& place, Real found, Real bound, Real wanted,
                   const std::optional<bool>& proven) {
    verdict_.check(place / "proven", "proven is told where it is false", !proven.value_or(false));
    verdict_.check(place / "bound", "what is withstood is not above the bound",
                   found == bound ? 0 : found - bound, found < infinity ? of_hull * found : 0);
    if (proven) {
      verdict_.check(place / "proven", "proven is false only where the gap is open",
                     found == bound || bound - found > wanted / 2);
      verdict_.unchecked(place, "it is said that more may be withstood, up to the bound");
    } else {
      verdict_.check(place / "bound", "what is withstood is the bound, but for the gap",
                     found == bound ? 0 : bound - found, wanted * (1 + of_hull));
    }
  }

  /// The posture at the bound, on the plane of the half-space.
  void check_weakest(const Path& place, const std::optional<Vector<Dim>>& claim, const Left& left,
                     Real bound) {
    if (!claim) return verdict_.check(place, "a bound has a dual", false);
    const Vec weakest = real(*claim);
    const Real along = weakest.dot(up_);
    verdict_.check(place, "it is so far away from the posture [rad]",
                   std::abs(std::atan2((weakest - along * up_).norm(), along) - bound) +
                       std::abs(weakest.norm() - 1),
                   follows);
    verdict_.check(place, "it is at the border of what the dual leaves",
                   std::abs(left.n.dot(weakest - up_) - left.b), follows);
  }

  void check_unheld(const Path& place, bool nothing, const Left& left,
                    const std::optional<bool>& proven) {
    if (!nothing || proven) return;
    verdict_.check(place / "proof", "nothing is withstood, by the dual", left.b,
                   follows * standard_gravity);
  }

  /// The hull of what is held, from the posture.
  template <class Reach>
  void check_reach(const Path& place, Real claimed, const Reach& reach,
                   const std::vector<Vector<Dim>>& held) {
    const auto points = real_points<Dim>(held);
    Real least = infinity;
    std::size_t sides = 0;
    for_each_side<Dim>(points, [&](const Side<Dim>& side) {
      ++sides;
      least = std::min(least, side.b > 0 ? reach(side) : Real{0});
    });
    verdict_.check(place / "proof" / "held", "the hull of what is held has a size", sides > Dim);
    if (claimed < infinity)
      verdict_.check(place, "it contains what is withstood", claimed - least,
                     of_hull * claimed + 1e-9L);
  }

  /// Whoever finds forces, they are checked like a claim.
  void check_held(const Path& place, const Vector<Dim>& acceleration, const Vector<Dim>& x) {
    Load<Dim> load = one_.loads().front();
    load.acceleration += acceleration;
    if (const double length = x.norm(); load.turning() != 0 && acceleration.isZero(0)) {
      // Another vector in place of up is another lift.
      load.lift = length * (standard_gravity + load.lift) - standard_gravity;
    }
    const Vector<Dim> up = x.norm() > 0 ? Vector<Dim>(x.normalized()) : given_up_;
    const Grasp<Dim> shaken(load, one_.contacts(), 1, one_.mechanism());
    HoldAnswer<Dim> answer;
    answer.settings = {static_cast<double>(cap_), Objective::effort};
    try {
      answer.posture = posture_at(shaken, up, answer.settings);
    } catch (const InvalidGrasp&) {
      return verdict_.check(place, "it can be asked for", false);
    }
    if (!answer.posture.holdable() && !answer.posture.hold().proven)
      return verdict_.unchecked(place, "neither forces for it were found, nor that there are none");
    const HoldClaim<Dim> hold = claims_of(shaken, answer);
    Verdict own;
    if (hold.holdable) check_hold<Dim>(own, place, real_grasp(shaken), hold, cap_);
    verdict_.check(place, "it is held: forces found for it are right",
                   hold.holdable && own.confirmed());
  }

  Verdict& verdict_;
  const Grasp<Dim>& one_;
  RealGrasp real_;
  const RealLoad& load_;
  Vector<Dim> given_up_;
  Vec up_;
  Real cap_;
};

}  // namespace

Real most_power(const RealGrasp& grasp, const Vec& y, const std::vector<Real>& rates, Real cap) {
  const RealLoad& load = grasp.loads.front();
  const PowerBound power = power_bound(grasp, y, rates);
  return power.limited + power.per_norm * cap * load.size() + delta * imbalance_power(load, y);
}

template <int Dim>
void check_shake(Verdict& verdict, const Path& place, const Grasp<Dim>& one, const Vector<Dim>& up,
                 const ShakeClaim<Dim>& claim, Real cap) {
  Shaking<Dim>(verdict, one, up, cap).check_shake(place, claim);
}

template void check_shake(Verdict&, const Path&, const Grasp<2>&, const Vector<2>&,
                          const ShakeClaim<2>&, Real);
template void check_shake(Verdict&, const Path&, const Grasp<3>&, const Vector<3>&,
                          const ShakeClaim<3>&, Real);

namespace {

/// The grasp with one load, and drives that give no more than a grip.
template <int Dim>
Grasp<Dim> with_grip(const Grasp<Dim>& given, std::size_t load, const std::optional<double>& grip) {
  Mechanism<Dim> mechanism = given.mechanism();
  if (grip) {
    const bool in_parts = grip_unit(given) == GripUnit::part_of_max;
    const auto limit = [&](double& max) { max = in_parts ? *grip * max : std::min(max, *grip); };
    for (Drive<Dim>& drive : mechanism.drives) limit(drive.max);
    if (mechanism.kind != DriveKind::listed)
      for (const std::string& name : given.fingers()) {
        const auto is_it = [&](const Finger<Dim>& finger) { return finger.name == name; };
        auto& fingers = mechanism.fingers;
        if (std::none_of(fingers.begin(), fingers.end(), is_it)) fingers.push_back({.name = name});
        limit(std::find_if(fingers.begin(), fingers.end(), is_it)->max_force);
      }
  }
  return {given.loads()[load], given.contacts(), 1, std::move(mechanism)};
}

}  // namespace

template <int Dim>
void check_shakes(Verdict& verdict, const Grasp<Dim>& given,
                  const CapacityDocument<Dim>& capacity) {
  const auto& grip = capacity.options.grip;
  const bool possible = !grip || (has_grip(given) && *grip > 0 && std::isfinite(*grip));
  verdict.check(Path() / "options" / "grip", "grip is one that the hand has", possible);
  if (!possible) return;
  for (std::size_t k = 0; k < capacity.capacities.size(); ++k) {
    const CapacityClaim<Dim>& claim = capacity.capacities[k];
    const std::size_t load = claim.load.value_or(0);
    if (load >= given.loads().size()) continue;  // refused already
    const Grasp<Dim> one = with_grip(given, load, capacity.options.grip);
    Shaking<Dim> shaking(verdict, one, claim.up, capacity.options.force_cap);
    const Path place = (Path() / "capacities")[k];
    shaking.check_shake(place / "shake", claim.shake);
    shaking.check_tilt(place / "tilt", claim.tilt, claim.tilted);
  }
}

template void check_shakes(Verdict&, const Grasp<2>&, const CapacityDocument<2>&);
template void check_shakes(Verdict&, const Grasp<3>&, const CapacityDocument<3>&);

}  // namespace poise::verify
