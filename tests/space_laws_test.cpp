// Laws that the least forces and the best posture in space obey, and the sphere searched by brute
// force. An answer is an interval, from its bound to its effort: laws hold for all that it leaves.
#include <gtest/gtest.h>

#include "poise/best_posture.hpp"
#include "random_space_grasps.hpp"
#include "space_checks.hpp"

namespace poise::test::space {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Without the list of minima, and few holds, so that the awkward end soon: with a gap.
SpatialSettings quick() { return {.max_holds = 200, .starts = 0}; }

Best<3> best(const Held& held) { return best_posture(held.grasp(), quick()); }

double effort_of(const Best<3>& answer) {
  return answer.holdable() ? answer.best().effort() : infinity;
}

/// The answer leaves open that the least effort is at most `effort`.
void at_most(const Best<3>& answer, double effort) {
  RC_ASSERT(answer.lower_bound <= effort * (1 + 1e-9));
  if (answer.status == Status::optimal) RC_ASSERT(effort_of(answer) <= effort * (1 + 1.01e-6));
}
void at_least(const Best<3>& answer, double effort) {
  RC_ASSERT(effort_of(answer) >= effort * (1 - 1e-9));
}
/// Both may be true, the first `times` as large.
void agree(const Best<3>& a, const Best<3>& b, double times = 1) {
  at_most(b, times * effort_of(a));
  at_least(b, times * a.lower_bound);
  if (a.status == Status::optimal) RC_ASSERT(b.status != Status::unholdable);
}

RC_GTEST_PROP(SpaceLaws, BestEffortGrowsWithTheSquareOfTheWeight, ()) {
  if (!one_in(20)) return;
  const Held held = *grasps({.limits = false});
  Held heavy = held;
  heavy.object.weight *= 7;
  agree(best(held), best(heavy), 49);
}

RC_GTEST_PROP(SpaceLaws, MovingTheFrameLeavesTheBestEffort, ()) {
  if (!one_in(20)) return;
  const Held held = *grasps();
  agree(best(held),
        best(moved(held, random_rotation(), {coordinate(), coordinate(), coordinate()})));
}

RC_GTEST_PROP(SpaceLaws, MirroringLeavesTheBestEffort, ()) {
  if (!one_in(20)) return;
  const Held held = *grasps();
  const Eigen::Matrix3d mirror = Vector<3>(-1, 1, 1).asDiagonal();
  agree(best(held), best(moved(held, mirror, {0, 0, 0})));
}

RC_GTEST_PROP(SpaceLaws, ScalingLengthsLeavesTheBestEffort, ()) {
  if (!one_in(20)) return;
  const Held held = *grasps();
  agree(best(held), best(enlarged(held, real(0.01, 100))));
}

RC_GTEST_PROP(SpaceLaws, ShareMakesASplitContactNeutralToTheBest, ()) {
  if (!one_in(20)) return;
  const Held held = *grasps();
  Held pad = held;
  Contact<3>& part =
      pad.contacts[static_cast<std::size_t>(pick(0, static_cast<int>(held.contacts.size()) - 1))];
  part.share /= 2;
  part.min_normal /= 2;
  part.max_normal /= 2;
  const Contact<3> other_half = part;
  pad.contacts.push_back(other_half);
  agree(best(held), best(pad));
}

RC_GTEST_PROP(SpaceLaws, MoreFrictionNeverCostsTheBest, ()) {
  if (!one_in(20)) return;
  Held held = *grasps();
  const Best<3> before = best(held);
  for (Contact<3>& c : held.contacts) {
    const double times = one_in(2) ? real(1, 2) : 1;
    c.friction *= times;
    c.torsion *= times;  // or a moment would count for more in the effort
  }
  at_most(best(held), effort_of(before));
}

RC_GTEST_PROP(SpaceLaws, WiderLimitsNeverCost, ()) {
  Held held = *grasps();
  const Vector<3> up = random_direction();
  const Hold<3> before = hold(held.grasp(), up);
  const bool also_best = one_in(20);
  const Best<3> best_before = also_best ? best(held) : Best<3>{};
  for (Contact<3>& c : held.contacts) {
    if (one_in(2)) c.min_normal *= real(0, 1);
    if (one_in(2)) c.max_normal *= real(1, 3);
  }
  if (also_best) at_most(best(held), effort_of(best_before));
  if (!before.holdable || std::sqrt(before.effort) > 1000 * held.object.weight) return;
  const Hold<3> after = hold(held.grasp(), up);
  RC_ASSERT(after.holdable);
  RC_ASSERT(after.effort <= before.effort * (1 + 1e-9));
}

// Forces for two loads, halved and added, balance the load between.
RC_GTEST_PROP(SpaceLaws, EffortIsConvexInTheLoad, ()) {
  const Held held = *grasps();
  const Grasp<3> grasp = held.grasp();
  Wrench<3> a, b;
  for (int k = 0; k < 6; ++k) {
    a[k] = held.object.weight * coordinate();
    b[k] = held.object.weight * coordinate();
  }
  const auto at = [&](const Wrench<3>& w) {
    return hold<3>(grasp, w, grasp.size(), Twist<3>::Zero());
  };
  const Hold<3> one = at(a), other = at(b);
  if (!one.holdable || !other.holdable) return;
  if (std::sqrt(one.effort + other.effort) > 1000 * held.object.weight) return;
  const Hold<3> between = at((a + b) / 2);
  RC_ASSERT(between.holdable);
  RC_ASSERT(between.effort <= (one.effort + other.effort) / 2 * (1 + 1e-9));
}

// What can be held without limits is a convex cone. Unless it is all, a plane through the origin
// has it on one side: if any, one through two of its rays.
RC_GTEST_PROP(SpaceLaws, WithoutLimitsHoldsAllOrInAHalfSphere, ()) {
  if (!one_in(10)) return;
  const Held held = *grasps({.limits = false});
  std::vector<Vector<3>> held_ups;
  bool all = true;
  for (const Vector<3>& up : directions(60)) {
    const Hold<3> found = hold(held.grasp(), up);
    all = all && found.holdable;
    if (!found.holdable) continue;
    // What the force cap takes away is no cone.
    if (std::sqrt(found.effort) > 1e5 * held.object.weight) return;
    held_ups.push_back(up);
  }
  if (all || held_ups.size() < 2) return;
  bool on_one_side = false;
  for (const Vector<3>& a : held_ups)
    for (const Vector<3>& b : held_ups) {
      const Vector<3> n = a.cross(b);
      on_one_side =
          on_one_side || (n.norm() > 1e-6 &&
                          std::all_of(held_ups.begin(), held_ups.end(), [&](const Vector<3>& up) {
                            return n.normalized().dot(up) >= -1e-7;
                          }));
    }
  RC_ASSERT(on_one_side);
}

/// The least effort found by asking many postures, and walking down from the lowest.
double least_found(const Grasp<3>& grasp) {
  const auto effort = [&](const Vector<3>& up) {
    const Hold<3> found = hold(grasp, up);
    if (!found.holdable) return infinity;
    return found.effort;
  };
  std::vector<std::pair<double, Vector<3>>> lowest;
  for (const Vector<3>& up : directions(400)) lowest.emplace_back(effort(up), up);
  std::partial_sort(lowest.begin(), lowest.begin() + 4, lowest.end(),
                    [](const auto& a, const auto& b) { return a.first < b.first; });
  lowest.resize(4);
  double least = infinity;
  for (auto [V, up] : lowest) {
    for (double step = 0.1; step > 1e-6;) {
      const auto across = tangents(up);
      bool lower = false;
      for (int k = 0; k < 12 && !lower; ++k) {
        const Vector<2> way(std::cos(pi / 6 * k), std::sin(pi / 6 * k));
        const Vector<3> beside = (up + step * (across * way)).normalized();
        const double there = effort(beside);
        lower = there < V;
        if (lower) {
          V = there;
          up = beside;
        }
      }
      if (!lower) step /= 2;
    }
    least = std::min(least, V);
  }
  return least;
}

RC_GTEST_PROP(SpaceLaws, NoPostureThatIsFoundNeedsLessThanTheBound, ()) {
  if (!one_in(50)) return;
  const Held held = *grasps({.awkward = one_in(4)});
  at_most(best(held), least_found(held.grasp()));
}

/// A planar grasp in the plane z = 0. Across it only the two contacts with friction can push; they
/// are not on a line with the com, so they cannot balance a weight across the plane. What is left
/// are the postures and forces of the plane.
RC_GTEST_PROP(SpaceLaws, OfAPlanarGraspIsThatOfThePlane, ()) {
  if (!one_in(4)) return;
  poise::test::Held flat = *poise::test::grasps({.least_contacts = 2, .most_contacts = 5});
  for (std::size_t k = 2; k < flat.contacts.size(); ++k) flat.contacts[k].friction = 0;
  const Vector<2> line = flat.contacts[1].position - flat.contacts[0].position,
                  to_com = flat.object.com - flat.contacts[0].position;
  if (std::abs(line.x() * to_com.y() - line.y() * to_com.x()) < 0.1) return;
  Held held{{flat.object.weight, {flat.object.com.x(), flat.object.com.y(), 0}}, {}};
  for (const Contact<2>& c : flat.contacts) {
    Contact<3> contact;
    contact.position = {c.position.x(), c.position.y(), 0};
    contact.normal = {c.normal.x(), c.normal.y(), 0};
    contact.friction = c.friction;
    contact.min_normal = c.min_normal;
    contact.max_normal = c.max_normal;
    contact.share = c.share;
    held.contacts.push_back(contact);
  }
  const Best<2> plane = best_posture(flat.grasp());
  const Best<3> space = best(held);
  if (!plane.holdable()) {
    RC_ASSERT(!space.holdable());
    return;
  }
  const double effort = plane.best().hold().effort;
  if (std::sqrt(effort) > 1000 * held.object.weight) return;
  at_most(space, effort);
  at_least(space, effort);
}

}  // namespace
}  // namespace poise::test::space
