#include "poise/posture.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "hold/solve.hpp"

namespace poise {
namespace {

/// Distance of the com (the origin) from the hull of the contact points, given that it is outside.
double distance_to_hull(const std::vector<Vector<2>>& arms) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Vector<2>& a : arms) {
    distance = std::min(distance, a.norm());
    for (const Vector<2>& b : arms) {
      const Vector<2> ab = b - a;
      const double s = -a.dot(ab);
      if (s > 0 && s < ab.squaredNorm())
        distance = std::min(distance, std::abs(a.x() * b.y() - a.y() * b.x()) / ab.norm());
    }
  }
  return distance;
}

}  // namespace

const char* to_string(Manner manner) {
  constexpr const char* names[] = {"resting", "cradled", "pinched"};
  return names[static_cast<int>(manner)];
}

// Straight down from the com meets the hull of the contacts where it points into the cone that they
// span, seen from the com. From outside the hull they span less than 180 degrees, so one of the
// gaps between neighbouring directions is wider than that.
Interval fork_wedge(const Hand<2>& hand, const Vector<2>& com) {
  std::vector<Vector<2>> arms;
  double farthest = 0, nearest = std::numeric_limits<double>::infinity();
  for (const Contact<2>& contact : hand.contacts()) {
    arms.emplace_back(contact.position - com);
    farthest = std::max(farthest, arms.back().norm());
    nearest = std::min(nearest, arms.back().norm());
  }
  const double near = 1e-9 * farthest;
  if (nearest <= near) return {};
  std::sort(arms.begin(), arms.end(), [](const Vector<2>& a, const Vector<2>& b) {
    return std::atan2(a.y(), a.x()) < std::atan2(b.y(), b.x());
  });
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const Vector<2>& last = arms[i];
    const Vector<2>& first = arms[(i + 1) % arms.size()];  // counter-clockwise
    const double turn = std::atan2(last.x() * first.y() - last.y() * first.x(), last.dot(first));
    const double width = -turn;  // of the cone from `first` to `last`, if the gap is the wide one
    if (!(width > 1e-12)) continue;
    const Vector<2> middle = (first.normalized() + last.normalized()).normalized();
    const bool clear = std::all_of(arms.begin(), arms.end(),
                                   [&](const Vector<2>& arm) { return arm.dot(middle) > near; });
    if (!clear && distance_to_hull(arms) <= near) return {};
    // Down turns counter-clockwise from `first` to `last` while theta falls.
    double from = angle_of(-last);
    if (from >= std::numbers::pi) from = -std::numbers::pi;
    return {from, from + width};
  }
  return {};
}

template <int Dim>
Manner manner(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
              const Hold<Dim>& hold) {
  const std::vector<FingerForce<Dim>> fingers = finger_forces(hand, hold);
  const auto loaded = std::count_if(fingers.begin(), fingers.end(), [&](const auto& finger) {
    return finger.normal > at_limit * load.size(hand.length());
  });
  if (loaded <= 1) return Manner::resting;
  const bool needs_no_friction =
      solve<Dim>(hand, hand.scaled().with_friction(0), 0, load, up, {}).holdable;
  return needs_no_friction ? Manner::cradled : Manner::pinched;
}

template <int Dim>
Posture<Dim> posture_of(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                        std::vector<Hold<Dim>> holds) {
  Posture<Dim> posture{.up = up, .holds = std::move(holds)};
  const auto value = [&](std::size_t k) {
    const Hold<Dim>& hold = posture.holds[k];
    return hold.holdable ? hold.value() : std::numeric_limits<double>::infinity();
  };
  for (std::size_t k = 1; k < posture.holds.size(); ++k)
    if (value(k) > value(posture.decides)) posture.decides = k;
  if (!posture.holdable()) return posture;
  posture.manner = manner(grasp, grasp.loads()[posture.decides], up, posture.hold());
  return posture;
}

template <int Dim>
Posture<Dim> posture_at(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                        const HoldSettings& settings) {
  std::vector<Hold<Dim>> holds;
  holds.reserve(grasp.loads().size());
  for (const Load<Dim>& load : grasp.loads()) holds.push_back(hold(grasp, load, up, settings));
  return posture_of(grasp, up, std::move(holds));
}

template Manner manner(const Hand<2>&, const Load<2>&, const Vector<2>&, const Hold<2>&);
template Manner manner(const Hand<3>&, const Load<3>&, const Vector<3>&, const Hold<3>&);
template Posture<2> posture_of(const Grasp<2>&, const Vector<2>&, std::vector<Hold<2>>);
template Posture<3> posture_of(const Grasp<3>&, const Vector<3>&, std::vector<Hold<3>>);
template Posture<2> posture_at(const Grasp<2>&, const Vector<2>&, const HoldSettings&);
template Posture<3> posture_at(const Grasp<3>&, const Vector<3>&, const HoldSettings&);

}  // namespace poise
