// Holds in space against closed forms and the plane, and the laws that they obey.
#include <gtest/gtest.h>

#include "poise/grip.hpp"
#include "random_space_grasps.hpp"
#include "space_checks.hpp"

namespace poise::test::space {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A box of 10 N and 2 m between two fingers at x = -1 and 1, at the height of its com.
Held squeezed(double friction, double torsion = 0) {
  return {{10, {0, 0, 0}},
          {contact({1, 0, 0}, {-1, 0, 0}, friction, torsion),
           contact({-1, 0, 0}, {1, 0, 0}, friction, torsion)}};
}

bool moderate(const Held& held, const Hold<3>& found) {
  return found.holdable && std::sqrt(found.effort) <= 1000 * held.object.weight;
}

/// Not within rounding of the limit of holding.
bool clearly(const Held& held, const Vector<3>& up, bool holdable) {
  for (const Vector<3>& off :
       {Vector<3>(0, 0, 0), Vector<3>(1, 2, 3), Vector<3>(-2, 1, -1), Vector<3>(1, -3, -2)})
    if (hold(held.grasp(), Vector<3>((up + 1e-7 * off).normalized())).holdable != holdable)
      return false;
  return true;
}

void same(const Held& a, const Vector<3>& up_a, const Held& b, const Vector<3>& up_b, Real times,
          Real relative = 1e-9L) {
  const Hold<3> one = hold(a.grasp(), up_a), other = hold(b.grasp(), up_b);
  if (clearly(a, up_a, one.holdable)) RC_ASSERT(one.holdable == other.holdable);
  if (moderate(a, one) && other.holdable)
    RC_ASSERT(close(times * one.effort, other.effort, relative));
}

RC_GTEST_PROP(SpaceHold, BalancesWithinTheConesAndProvesThatNothingLessDoes, ()) {
  const Held held = *grasps();
  const Vector<3> up = random_direction();
  const Grasp<3> grasp = held.grasp();
  RC_ASSERT(fault(grasp, up, hold(grasp, up)) == "");
}

RC_GTEST_PROP(SpaceHold, OfAnyWrenchFromAnyStartIsTheSame, ()) {
  const Held held = *grasps();
  const Grasp<3> grasp = held.grasp();
  const double weight = held.object.weight;
  Wrench<3> w;
  Twist<3> start;
  for (int k = 0; k < 6; ++k) {
    w[k] = weight * coordinate();
    start[k] = weight * coordinate();
  }
  const Hold<3> cold = hold<3>(grasp, w, grasp.size(), Twist<3>::Zero()),
                warm = hold<3>(grasp, w, grasp.size(), start);
  RC_ASSERT(fault(grasp, Real6(w.cast<Real>()), cold) == "");
  RC_ASSERT(fault(grasp, Real6(w.cast<Real>()), warm) == "");
  RC_ASSERT(warm.holdable == cold.holdable);
  if (moderate(held, cold)) RC_ASSERT(close(warm.effort, cold.effort, 1e-9L));
}

RC_GTEST_PROP(SpaceHold, MovingTheFrameLeavesTheEffort, ()) {
  const Held held = *grasps();
  const Vector<3> up = random_direction();
  const Eigen::Matrix3d R = random_rotation();
  const Held there = moved(held, R, {coordinate(), coordinate(), coordinate()});
  same(held, up, there, (R * up).normalized(), 1, 1e-8L);
}

RC_GTEST_PROP(SpaceHold, EffortGrowsWithTheSquareOfTheWeight, ()) {
  const Held held = *grasps({.limits = false});
  const Vector<3> up = random_direction();
  Held heavy = held;
  heavy.object.weight *= 7;
  same(held, up, heavy, up, 49);
}

RC_GTEST_PROP(SpaceHold, ScalingLengthsLeavesTheForces, ()) {
  const Held held = *grasps();
  const Vector<3> up = random_direction();
  same(held, up, enlarged(held, real(0.01, 100)), up, 1);
}

RC_GTEST_PROP(SpaceHold, MoreFrictionNeverCosts, ()) {
  Held held = *grasps();
  const Vector<3> up = random_direction();
  const Hold<3> before = hold(held.grasp(), up);
  for (Contact<3>& c : held.contacts) {
    const double times = one_in(2) ? real(1, 2) : 1;
    c.friction *= times;
    c.torsion *= times;  // or a moment would count for more in the effort
  }
  if (!moderate(held, before)) return;
  const Hold<3> after = hold(held.grasp(), up);
  RC_ASSERT(after.holdable);
  RC_ASSERT(after.effort <= before.effort * (1 + 1e-9));
}

RC_GTEST_PROP(SpaceHold, ShareMakesASplitContactNeutral, ()) {
  const Held held = *grasps();
  const Vector<3> up = random_direction();
  Held pad = held;
  const auto split = static_cast<std::size_t>(pick(0, static_cast<int>(held.contacts.size()) - 1));
  const int parts = pick(2, 5);
  Contact<3>& part = pad.contacts[split];
  part.share /= parts;
  part.min_normal /= parts;
  part.max_normal /= parts;
  pad.contacts.insert(pad.contacts.end(), static_cast<std::size_t>(parts - 1), Contact<3>(part));
  same(held, up, pad, up, 1);
}

/// A planar grasp in the plane z = 0, doubled: each contact at z = 0.3 and -0.3 with half the share
/// and limits. By symmetry and convexity there are least forces within the planes, and a contact's
/// two halves carry the same. What each costs is what the planar contact costs.
RC_GTEST_PROP(SpaceHold, OfAPlanarGraspIsThatOfThePlane, ()) {
  const poise::test::Held flat = *poise::test::grasps({.most_contacts = 5});
  Held held{{flat.object.weight, {flat.object.com.x(), flat.object.com.y(), 0}}, {}};
  for (const Contact<2>& c : flat.contacts) {
    for (const double z : {0.3, -0.3}) {
      Contact<3> half =
          contact({c.position.x(), c.position.y(), z}, {c.normal.x(), c.normal.y(), 0}, c.friction);
      half.share = c.share / 2;
      half.min_normal = c.min_normal / 2;
      half.max_normal = c.max_normal / 2;
      held.contacts.push_back(half);
    }
  }
  const double theta = random_angle();
  const Hold<2> planar = hold(flat.grasp(), up_at(theta));
  const Vector<3> up(up_at(theta).x(), up_at(theta).y(), 0);
  const Hold<3> found = hold(held.grasp(), up);
  RC_ASSERT(fault(held.grasp(), up, found) == "");
  for (const double nearby : {-1e-7, 1e-7})
    if (hold(flat.grasp(), up_at(theta + nearby)).holdable != planar.holdable) return;
  RC_ASSERT(found.holdable == planar.holdable);
  if (moderate(held, found)) RC_ASSERT(close(found.effort, planar.effort, 1e-9L));
}

TEST(SpaceHold, OfWhatCannotBeHeldIsANumber) {
  // Newton's method runs away here: a frictionless and a weak pair, each in two halves.
  Held held{{1, {0, 0, 0}}, {}};
  for (const double x : {-std::sqrt(0.75), std::sqrt(0.75)})
    for (const double z : {0.3, -0.3}) {
      Contact<3> half = contact({x, 0.5, z}, {-x, -0.5, 0}, 0);
      half.min_normal = 0.153;
      half.max_normal = 1.069;
      half.share = 0.498;
      held.contacts.push_back(half);
      half.friction = 0.232;
      half.min_normal = 0;
      half.max_normal = 0.054;
      half.share = 0.5;
      held.contacts.push_back(half);
    }
  const Grasp<3> grasp = held.grasp();
  for (int k = -3141; k <= 3141; ++k) {
    const Vector<3> up(std::sin(1e-3 * k), std::cos(1e-3 * k), 0);
    ASSERT_EQ(fault(grasp, up, hold(grasp, up)), "") << k;
  }
}

TEST(SpaceHold, OfASqueezedBoxIsKnown) {
  const Grasp<3> grasp = squeezed(0.5).grasp();
  const Vector<3> up(0, 0.6, 0.8);
  const Hold<3> found = hold(grasp, up);
  ASSERT_TRUE(found.holdable);
  EXPECT_EQ(fault(grasp, up, found), "");
  EXPECT_NEAR(found.effort, 2 * (100 + 25), 1e-9);
  EXPECT_NEAR((found.forces[0].tangential - 5 * up).norm(), 0, 1e-9);
  EXPECT_EQ(found.forces[0].state, ContactState::slipping);
  EXPECT_NEAR(grip(grasp, found), 10, 1e-9);
  EXPECT_EQ(manner(grasp, grasp.loads().front(), up, found), Manner::pinched);
}

TEST(SpaceHold, OfABoxBetweenSoftFingersIsKnown) {
  // The com is 0.2 m beside the line of the fingers: each resists half of 2 N m. With m the moment
  // and t = 5 N of each finger it presses with n = |(t / mu, m / gamma)|.
  Held held = squeezed(0.5, 0.1);
  held.object.com = {0, 0.2, 0};
  const Grasp<3> grasp = held.grasp();
  const Vector<3> up(0, 0, 1);
  const Hold<3> found = hold(grasp, up);
  ASSERT_TRUE(found.holdable);
  EXPECT_EQ(fault(grasp, up, found), "");
  const double n = std::hypot(5 / 0.5, 1 / 0.1), s = 1 * 0.5 / 0.1;
  EXPECT_NEAR(found.forces[0].normal, n, 1e-9);
  EXPECT_NEAR(std::abs(found.forces[0].torsion_moment), 1, 1e-9);
  EXPECT_NEAR(found.effort, 2 * (n * n + 25 + s * s), 1e-8);
  // Hard fingers cannot.
  for (Contact<3>& c : held.contacts) c.torsion = 0;
  const Hold<3> hard = hold(held.grasp(), up);
  EXPECT_EQ(fault(held.grasp(), up, hard), "");
  ASSERT_FALSE(hard.holdable);
  EXPECT_EQ(reason(held.grasp(), hard),
            "it would turn about the line through contacts 0 and 1, and no contact opposes it; "
            "point contacts on one line cannot resist that torque: a soft finger (torsion) can");
}

TEST(SpaceHold, WhatTheForceCapForbidsIsNotSaidToFindNoOpposition) {
  const Held held = squeezed(0.5);
  const Vector<3> up(0, 1, 0);
  const double needed = std::sqrt(hold(held.grasp(), up).effort) / held.object.weight;
  const Hold<3> found = hold(held.grasp(), up, {.force_cap = 0.9 * needed});
  ASSERT_FALSE(found.holdable);
  EXPECT_NE(reason(held.grasp(), found).find("would take a force norm of more than"),
            std::string::npos)
      << reason(held.grasp(), found);
}

TEST(SpaceHold, WithTheComBelowTheLineOfTwoPointsHolds) {
  Held held = squeezed(0.5);
  held.object.com = {0, 0.2, 0};
  EXPECT_TRUE(hold(held.grasp(), Vector<3>(0, 1, 0)).holdable);
  EXPECT_TRUE(hold(held.grasp(), Vector<3>(0, -1, 0)).holdable);
  const Vector<3> off(1e-7, 1, 1e-7);
  const Hold<3> beside = hold(held.grasp(), Vector<3>(off.normalized()));
  EXPECT_FALSE(beside.holdable);
  EXPECT_EQ(fault(held.grasp(), Vector<3>(off.normalized()), beside), "");
}

TEST(SpaceHold, OfWeaklyUnholdableFingersGrowsWithoutBound) {
  const double half = std::sqrt(0.5);
  const Held held{
      {1, {0, 0, 0}},
      {contact({1, 0, 0}, {-half, 0, half}, 1), contact({-1, 0, 0}, {half, 0, half}, 1)}};
  for (const double off : {1e-1, 1e-2, 1e-3, 4e-4, 1e-4, 1e-5, 1e-6, 4e-7}) {
    const Vector<3> up = Vector<3>(0, 1, off).normalized();
    const Hold<3> found = hold(held.grasp(), up);
    EXPECT_EQ(fault(held.grasp(), up, found), "") << off;
    ASSERT_TRUE(found.holdable) << off;
    // Near 0 it is 1 / (8 off^2).
    EXPECT_NEAR(found.effort * 8 * off * off, 1, 8 * off * off + 1e-6) << off;
  }
  for (const double off : {3e-7, 1e-7, 1e-9, 0.0, -1e-9, -0.1}) {
    const Vector<3> up = Vector<3>(0, 1, off).normalized();
    const Hold<3> found = hold(held.grasp(), up);
    EXPECT_FALSE(found.holdable) << off;
    EXPECT_EQ(fault(held.grasp(), up, found), "") << off;
  }
}

TEST(SpaceHold, NearTheLimitOfFrictionKeepsNineDigits) {
  // A disk between two fingers at +-phi from +y with friction just enough. In the plane the same
  // disk is known to its closed form; here the fingers are soft, so its moments out of the plane
  // vanish and the planar answer holds.
  for (const double phi : {pi / 3, 5 * pi / 12, 0.9}) {
    for (const double more : {1e-1, 1e-2, 1e-3, 1e-4}) {
      std::vector<Contact<2>> flat(2);
      Held held{{1, {0, 0, 0}}, {}};
      for (std::size_t k = 0; k < 2; ++k) {
        flat[k].position = up_at(k == 0 ? phi : -phi);
        flat[k].normal = -flat[k].position;
        flat[k].friction = 1 / std::tan(phi) + more;
        held.contacts.push_back(contact({flat[k].position.x(), flat[k].position.y(), 0},
                                        {flat[k].normal.x(), flat[k].normal.y(), 0},
                                        flat[k].friction, 0.1));
      }
      const Grasp<2> disk({1, {0, 0}}, flat);
      for (int step = 0; step < 40; ++step) {
        const double theta = -3 + 0.15 * step;
        const Vector<3> up(up_at(theta).x(), up_at(theta).y(), 0);
        const Hold<2> planar = hold(disk, up_at(theta));
        const Hold<3> found = hold(held.grasp(), up);
        ASSERT_EQ(fault(held.grasp(), up, found), "") << phi << ' ' << more << ' ' << theta;
        ASSERT_EQ(found.holdable, planar.holdable);
        if (planar.holdable && planar.effort < 1e6) {
          ASSERT_TRUE(close(found.effort, planar.effort, 1e-9L)) << phi << ' ' << more;
        }
      }
    }
  }
}

TEST(SpaceHold, OfThousandsOfContactsIsThatOfThePad) {
  // Two pads of 2000 contacts at one point each: as two fingers.
  Held held{{10, {0, 0, 0}}, {}};
  for (const Contact<3>& c : squeezed(0.5, 0.1).contacts)
    for (int k = 0; k < 2000; ++k) {
      held.contacts.push_back(c);
      held.contacts.back().share = 1.0 / 2000;
    }
  const Hold<3> found = hold(held.grasp(), Vector<3>(0, 0, 1));
  ASSERT_TRUE(found.holdable);
  EXPECT_NEAR(found.effort, 250, 1e-7);
}

TEST(SpaceHold, SaysWhichLimitAContactIsAt) {
  Held held = squeezed(0.5);
  held.contacts[0].max_normal = held.contacts[1].max_normal = 9.9;
  const Hold<3> weak = hold(held.grasp(), Vector<3>(0, 0, 1));
  EXPECT_FALSE(weak.holdable);
  EXPECT_EQ(fault(held.grasp(), Vector<3>(0, 0, 1), weak), "");
  EXPECT_NE(reason(held.grasp(), weak).find("max_normal"), std::string::npos)
      << reason(held.grasp(), weak);
  held.contacts[0].max_normal = infinity;
  held.contacts[0].min_normal = 3;
  held.contacts[1].max_normal = 20;
  const Hold<3> found = hold(held.grasp(), Vector<3>(1, 0, 0));
  ASSERT_TRUE(found.holdable);
  EXPECT_EQ(found.forces[0].limit, ForceLimit::min);
}

TEST(SpaceHold, WithoutFrictionIsCradledWithItPinchedByOneFingerResting) {
  Held held{{1, {0, 0, 1}}, {}};
  for (int k = 0; k < 3; ++k) {
    const double at = 2 * pi * k / 3;
    held.contacts.push_back(contact({std::cos(at), std::sin(at), 0}, {0, 0, 1}, 0.5));
  }
  const auto manner_of = [](const Held& each, const Vector<3>& up) {
    return posture_at(each.grasp(), up.normalized()).manner;
  };
  EXPECT_EQ(manner_of(held, {0, 0, 1}), Manner::cradled);
  // Level contacts give nothing sideways without friction.
  EXPECT_EQ(manner_of(held, {-0.3, 0, 1}), Manner::pinched);
  EXPECT_EQ(manner_of(squeezed(0.5), {0, 0, 1}), Manner::pinched);
  held.object.com = {1, 0, 1};  // above the first contact
  EXPECT_EQ(manner_of(held, {0, 0, 1}), Manner::resting);
}

TEST(SpaceHold, ForceClosureNeedsThreePointsOrSoftFingers) {
  EXPECT_FALSE(force_closure(squeezed(0.5).grasp()));
  EXPECT_TRUE(force_closure(squeezed(0.5, 0.1).grasp()));
}

TEST(SpaceHold, RefusesMisuse) {
  const Grasp<3> grasp = squeezed(0.5).grasp();
  EXPECT_THROW(hold(grasp, Vector<3>(0, 0, 2)), InvalidGrasp);
  EXPECT_THROW(hold(grasp, Vector<3>(0, 0, 1), {0}), InvalidGrasp);
  EXPECT_THROW(squeezed(0, 0.1).grasp(), InvalidGrasp);
  EXPECT_THROW(squeezed(0.5, -0.1).grasp(), InvalidGrasp);
  Contact<2> flat;
  flat.normal = {0, 1};
  flat.torsion = 0.1;
  EXPECT_THROW(Grasp<2>({1, {0, 0}}, {flat}), InvalidGrasp);
}

}  // namespace
}  // namespace poise::test::space
