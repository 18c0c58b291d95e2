// Holds against second sources, and the laws that they obey.
#include "poise/hold.hpp"

#include <gtest/gtest.h>

#include "poise/grip.hpp"
#include "random_grasps.hpp"
#include "second_sources.hpp"

namespace poise::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two fingers on the sides of a square of 2 m, at the height of its com.
Held squeezed(double friction, double max_normal = infinity) {
  return {{10, {0, 0}},
          {contact({1, 0}, {-1, 0}, friction, max_normal),
           contact({-1, 0}, {1, 0}, friction, max_normal)}};
}

Hold<2> hold_at(const Held& held, double theta) { return hold(held.grasp(), up_at(theta)); }

/// A hold whose force norm is within what is promised to nine digits.
bool moderate(const Held& held, const Hold<2>& held_by) {
  return held_by.holdable && std::sqrt(held_by.effort) <= 1000 * held.object.weight;
}

/// Not within rounding of the limit of holding.
bool clearly(const Held& held, double theta, bool holdable) {
  for (const double nearby : {-1e-7, 0.0, 1e-7})
    if (hold_at(held, theta + nearby).holdable != holdable) return false;
  return true;
}

template <class Source>
void agree(const Held& held, double theta, const Source& source) {
  const Grasp<2> grasp = held.grasp();
  const auto expected = decided(grasp, theta, source);
  if (!expected) return;
  const Hold<2> found = hold(grasp, up_at(theta));
  RC_ASSERT(found.holdable == expected->has_value());
  if (!moderate(held, found)) return;
  const LeastForces& least = **expected;
  RC_ASSERT(difference(found.effort, least.effort) <= 1e-9L);
  for (std::size_t i = 0; i < least.forces.size(); ++i) {
    const RealVector force(found.forces[i].normal, found.forces[i].tangential);
    RC_ASSERT((force - least.forces[i]).norm() <=
              1e-9L * held.object.weight + 1e-9L * std::sqrt(least.effort));
  }
}

RC_GTEST_PROP(Hold, BalancesWithinTheConesAndProvesThatNothingLessDoes, ()) {
  const Held held = *grasps();
  const double theta = random_angle();
  const Grasp<2> grasp = held.grasp();
  RC_ASSERT(fault(grasp, theta, hold(grasp, up_at(theta))) == "");
}

RC_GTEST_PROP(Hold, OfTwoContactsClampsTheInternalForce, ()) {
  const Held held = *grasps({.least_contacts = 2, .most_contacts = 2});
  if ((held.contacts[0].position - held.contacts[1].position).norm() < 1e-3) return;
  for (int i = 0; i < 5; ++i) agree(held, random_angle(), clamped_internal_force);
}

RC_GTEST_PROP(Hold, OfNearlyUnholdableDisksKeepsNineDigits, ()) {
  const Held held = *nearly_unholdable();
  const double theta = random_angle();
  const Grasp<2> grasp = held.grasp();
  RC_ASSERT(fault(grasp, theta, hold(grasp, up_at(theta))) == "");
  agree(held, theta, clamped_internal_force);
}

RC_GTEST_PROP(Hold, IsTheBestOfAllFacesWithoutLimits, ()) {
  const Held held = *grasps({.most_contacts = 4, .limits = false});
  agree(held, random_angle(),
        [](const Grasp<2>& grasp, const RealWrench& w) { return EveryFace(grasp, w).answer(); });
}

RC_GTEST_PROP(Hold, IsTheBestOfAllFacesWithLimits, ()) {
  const Held held = *grasps({.most_contacts = 3});
  agree(held, random_angle(),
        [](const Grasp<2>& grasp, const RealWrench& w) { return EveryFace(grasp, w).answer(); });
}

RC_GTEST_PROP(Hold, OfAnyWrenchFromAnyStartIsTheSame, ()) {
  const Held held = *grasps();
  const Grasp<2> grasp = held.grasp();
  const double weight = held.object.weight;
  const Wrench<2> w = weight * Wrench<2>(coordinate(), coordinate(), coordinate());
  const Twist<2> start = weight * Twist<2>(coordinate(), coordinate(), coordinate());
  const Hold<2> cold = hold<2>(grasp, w, grasp.size(), Twist<2>::Zero()),
                warm = hold<2>(grasp, w, grasp.size(), start);
  RC_ASSERT(fault(grasp, RealWrench(w.cast<Real>()), cold) == "");
  RC_ASSERT(fault(grasp, RealWrench(w.cast<Real>()), warm) == "");
  RC_ASSERT(warm.holdable == cold.holdable);
  if (moderate(held, cold)) RC_ASSERT(difference(warm.effort, cold.effort) <= 1e-9L);
}

RC_GTEST_PROP(Hold, FromTheNeighboursDualIsTheSame, ()) {
  const Held held = *grasps();
  const Grasp<2> grasp = held.grasp();
  const double theta = random_angle();
  const Hold<2> neighbour = hold(grasp, up_at(theta + 0.01));
  const Hold<2> warm =
      hold<2>(grasp, grasp.loads().front().at(up_at(theta)), grasp.size(), neighbour.dual);
  RC_ASSERT(fault(grasp, theta, warm) == "");
  const Hold<2> cold = hold(grasp, up_at(theta));
  if (clearly(held, theta, cold.holdable)) RC_ASSERT(warm.holdable == cold.holdable);
  if (moderate(held, cold)) RC_ASSERT(difference(warm.effort, cold.effort) <= 1e-9L);
}

TEST(Hold, FromTheDualOfAnUnholdableLoadIsTheSame) {
  // In an unholdable posture y is a proof, and may be as long as 1e20.
  const Grasp<2> grasp({1, {0, 0}}, {contact({0, 0}, {0, 1}, 1), contact({1, 0}, {0, 1}, 1)});
  const Hold<2> neighbour = hold(grasp, up_at(pi / 4 + 0.01));
  ASSERT_FALSE(neighbour.holdable);
  const Hold<2> warm = hold<2>(grasp, grasp.loads().front().at(up_at(pi / 4 - 0.01)),
                               grasp.size(), neighbour.dual);
  ASSERT_TRUE(warm.holdable);
  EXPECT_EQ(fault(grasp, pi / 4 - 0.01, warm), "");
}

RC_GTEST_PROP(Hold, EffortGrowsWithTheSquareOfTheWeight, ()) {
  Held held = *grasps({.limits = false});
  const double theta = random_angle(), times = real(0.1, 100);
  const Hold<2> light = hold_at(held, theta);
  held.object.weight *= times;
  const Hold<2> heavy = hold_at(held, theta);
  if (clearly(held, theta, heavy.holdable)) RC_ASSERT(heavy.holdable == light.holdable);
  if (moderate(held, heavy))
    RC_ASSERT(difference(heavy.effort, times * times * light.effort) <= 1e-9L);
}

RC_GTEST_PROP(Hold, LimitsInWeightsScaleWithTheWeight, ()) {
  Held held = *grasps();
  const double theta = random_angle(), times = real(0.1, 100);
  const Hold<2> light = hold_at(held, theta);
  held.object.weight *= times;
  for (Contact<2>& c : held.contacts) {
    c.min_normal *= times;
    c.max_normal *= times;
  }
  const Hold<2> heavy = hold_at(held, theta);
  if (clearly(held, theta, heavy.holdable)) RC_ASSERT(heavy.holdable == light.holdable);
  if (moderate(held, heavy))
    RC_ASSERT(difference(heavy.effort, times * times * light.effort) <= 1e-9L);
}

RC_GTEST_PROP(Hold, ScalingLengthsLeavesTheForces, ()) {
  Held held = *grasps();
  const double theta = random_angle(), times = real(0.001, 1000);
  const Hold<2> small = hold_at(held, theta);
  held.object.com *= times;
  for (Contact<2>& c : held.contacts) c.position *= times;
  const Hold<2> large = hold_at(held, theta);
  if (clearly(held, theta, large.holdable)) RC_ASSERT(large.holdable == small.holdable);
  if (moderate(held, large)) RC_ASSERT(difference(large.effort, small.effort) <= 1e-9L);
}

RC_GTEST_PROP(Hold, MovingTheFrameLeavesTheForces, ()) {
  Held held = *grasps();
  const double theta = random_angle();
  const Hold<2> here = hold_at(held, theta);
  const Vector<2> by(10 * coordinate(), 10 * coordinate());
  held.object.com += by;
  for (Contact<2>& c : held.contacts) c.position += by;
  const Hold<2> there = hold_at(held, theta);
  if (clearly(held, theta, there.holdable)) RC_ASSERT(there.holdable == here.holdable);
  // Coordinates ten times as long have a digit less.
  if (moderate(held, there)) RC_ASSERT(difference(there.effort, here.effort) <= 1e-8L);
}

RC_GTEST_PROP(Hold, MoreFrictionNeverCosts, ()) {
  Held held = *grasps();
  const double theta = random_angle();
  const Hold<2> before = hold_at(held, theta);
  for (Contact<2>& c : held.contacts) c.friction += one_in(2) ? real(0, 1) : 0;
  const Hold<2> after = hold_at(held, theta);
  if (!moderate(held, before)) return;
  RC_ASSERT(after.holdable);
  RC_ASSERT(after.effort <= before.effort * (1 + 1e-9));
}

RC_GTEST_PROP(Hold, WiderLimitsNeverCost, ()) {
  Held held = *grasps();
  const double theta = random_angle();
  const Hold<2> before = hold_at(held, theta);
  for (Contact<2>& c : held.contacts) {
    c.min_normal *= real(1, 0);
    c.max_normal *= real(1, 3);
  }
  const Hold<2> after = hold_at(held, theta);
  if (!moderate(held, before)) return;
  RC_ASSERT(after.holdable);
  RC_ASSERT(after.effort <= before.effort * (1 + 1e-9));
}

RC_GTEST_PROP(Hold, ShareMakesASplitContactNeutral, ()) {
  Held held = *grasps();
  const double theta = random_angle();
  const Hold<2> whole = hold_at(held, theta);
  const auto split = static_cast<std::size_t>(pick(0, static_cast<int>(held.contacts.size()) - 1));
  const int parts = pick(2, 5);
  Contact<2>& part = held.contacts[split];
  part.share /= parts;
  part.min_normal /= parts;
  part.max_normal /= parts;
  held.contacts.insert(held.contacts.end(), static_cast<std::size_t>(parts - 1),
                       Contact<2>(held.contacts[split]));
  const Hold<2> pad = hold_at(held, theta);
  if (clearly(held, theta, pad.holdable)) RC_ASSERT(pad.holdable == whole.holdable);
  if (!moderate(held, pad)) return;
  RC_ASSERT(difference(pad.effort, whole.effort) <= 1e-9L);
  const double all = parts * pad.forces[split].normal;
  RC_ASSERT(close(all, whole.forces[split].normal, 1e-9L, 1e-9L * std::sqrt(whole.effort)));
}

RC_GTEST_PROP(Hold, ThinConesNeverCrash, ()) {
  Held held = *grasps();
  for (Contact<2>& c : held.contacts) c.friction *= 1e-5;
  for (int i = 0; i < 10; ++i) {
    const Hold<2> thin = hold_at(held, random_angle());
    RC_ASSERT(std::isfinite(thin.effort));
    RC_ASSERT(thin.dual.allFinite());
  }
}

RC_GTEST_PROP(Hold, FingersAddUpTheirContacts, ()) {
  Held held = *grasps();
  for (Contact<2>& c : held.contacts)
    if (one_in(2)) c.finger = one_in(2) ? "thumb" : "index";
  const Grasp<2> grasp = held.grasp();
  const Vector<2> up = up_at(random_angle());
  const Hold<2> found = hold(grasp, up);
  const auto fingers = finger_forces(grasp, found);
  if (!found.holdable) {
    RC_ASSERT(fingers.empty());
    return;
  }
  RC_ASSERT(fingers.size() == grasp.fingers().size());
  Vector<2> sum = Vector<2>::Zero();
  for (std::size_t k = 0; k < fingers.size(); ++k) {
    double own = 0;
    for (std::size_t i = 0; i < found.forces.size(); ++i)
      if (grasp.finger_of(i) == k) own += found.forces[i].normal;
    RC_ASSERT(close(fingers[k].normal, own, 1e-12L));
    sum += fingers[k].force;
  }
  const double norm = std::sqrt(found.effort);
  RC_ASSERT((sum - held.object.weight * up).norm() <= 1e-11 * held.object.weight + 1e-13 * norm);
}

TEST(Hold, OfASqueezedSquareIsKnown) {
  // Each finger carries half of the weight by friction, so presses with 5 N / 0.5.
  const Hold<2> found = hold_at(squeezed(0.5), 0);
  ASSERT_TRUE(found.holdable);
  EXPECT_NEAR(found.effort, 2 * (100 + 25), 1e-9);
  for (const ContactForce<2>& force : found.forces) {
    EXPECT_NEAR(force.normal, 10, 1e-9);
    EXPECT_NEAR(std::abs(force.tangential), 5, 1e-9);
    EXPECT_NEAR(force.friction_used, 1, 1e-9);
    EXPECT_EQ(force.state, ContactState::slipping);
    EXPECT_EQ(force.limit, ForceLimit::none);
  }
  // Along n turned by +90 degrees: down at the right finger's n = -x.
  EXPECT_LT(found.forces[0].tangential, 0);
  EXPECT_GT(found.forces[1].tangential, 0);
  EXPECT_NEAR(grip<2>(squeezed(0.5).grasp(), found), 10, 1e-9);
}

TEST(Hold, OnOneFingerLeavesTheOtherUnloaded) {
  // Turned by 90 degrees, up is +x: the finger at -x carries all.
  const Grasp<2> grasp = squeezed(0.5).grasp();
  const Hold<2> found = hold(grasp, up_at(pi / 2));
  ASSERT_TRUE(found.holdable);
  EXPECT_NEAR(found.effort, 100, 1e-9);
  EXPECT_EQ(found.forces[0].state, ContactState::unloaded);
  EXPECT_EQ(found.forces[0].friction_used, 0);
  EXPECT_EQ(found.forces[1].state, ContactState::sticking);
  EXPECT_FALSE(all_loaded(grasp, found, grasp.size()));
  EXPECT_EQ(manner(grasp, grasp.loads().front(), up_at(pi / 2), found), Manner::resting);
}

TEST(Hold, OfOneFingerRests) {
  const Grasp<2> grasp({10, {0, 1}}, {contact({0, 0}, {0, 1}, 0.5)});
  const Hold<2> found = hold(grasp, up_at(0));
  ASSERT_TRUE(found.holdable);
  EXPECT_NEAR(found.effort, 100, 1e-9);
  EXPECT_EQ(manner(grasp, grasp.loads().front(), up_at(0), found), Manner::resting);
  EXPECT_FALSE(hold(grasp, up_at(0.01)).holdable);
}

TEST(Hold, InTheForkOfTheFingersIsCradled) {
  const Grasp<2> grasp({10, {0, 0}}, {contact({0.6, -0.8}, {-0.6, 0.8}, 0.5),
                                      contact({-0.6, -0.8}, {0.6, 0.8}, 0.5)});
  EXPECT_EQ(manner(grasp, grasp.loads().front(), up_at(0), hold(grasp, up_at(0))), Manner::cradled);
  const Grasp<2> square = squeezed(0.5).grasp();
  EXPECT_EQ(manner(square, square.loads().front(), up_at(0), hold(square, up_at(0))),
            Manner::pinched);
}

TEST(Hold, SaysWhichLimitAContactIsAt) {
  Held held = squeezed(0.5, 10);
  held.contacts[1].max_normal = infinity;
  EXPECT_EQ(hold_at(held, 0).forces[0].limit, ForceLimit::max);
  EXPECT_EQ(hold_at(held, 0).forces[1].limit, ForceLimit::none);
  held.contacts[0].min_normal = held.contacts[0].max_normal = 20;
  EXPECT_EQ(hold_at(held, 0).forces[0].limit, ForceLimit::max);
  held.contacts[0].max_normal = infinity;
  EXPECT_EQ(hold_at(held, 0).forces[0].limit, ForceLimit::min);
  EXPECT_EQ(hold_at(held, 0).forces[0].state, ContactState::sticking);
}

TEST(Hold, WithTooWeakFingersIsUnholdable) {
  const Held strong = squeezed(0.5, 10.000001), weak = squeezed(0.5, 9.999999);
  EXPECT_TRUE(hold_at(strong, 0).holdable);
  const Hold<2> found = hold_at(weak, 0);
  EXPECT_FALSE(found.holdable);
  EXPECT_EQ(fault(weak.grasp(), 0.0, found), "");
  EXPECT_NE(reason(weak.grasp(), found).find("max_normal"), std::string::npos);
}

TEST(Hold, WithExactlyEnoughForceHolds) {
  const Held held = squeezed(0.5, 10);
  const Hold<2> found = hold_at(held, 0);
  ASSERT_TRUE(found.holdable);
  EXPECT_EQ(fault(held.grasp(), 0.0, found), "");
  EXPECT_NEAR(found.effort, 250, 1e-6);
}

TEST(Hold, WithoutAnyForceAllowedIsUnholdable) {
  const Held held = squeezed(0.5, 0);
  EXPECT_EQ(fault(held.grasp(), 0.0, hold_at(held, 0)), "");
  EXPECT_FALSE(hold_at(held, 0).holdable);
}

TEST(Hold, OfNoLoadNeedsNoForce) {
  const Grasp<2> grasp = squeezed(0.5).grasp();
  const Hold<2> found = hold<2>(grasp, Wrench<2>::Zero(), grasp.size(), Twist<2>::Zero());
  ASSERT_TRUE(found.holdable);
  EXPECT_EQ(found.effort, 0);
  EXPECT_EQ(found.forces[0].state, ContactState::unloaded);
}

TEST(Hold, OfNoLoadStillPressesWithMinNormal) {
  Held held = squeezed(0.5);
  for (Contact<2>& c : held.contacts) c.min_normal = 3;
  const Hold<2> found =
      hold<2>(held.grasp(), Wrench<2>::Zero(), held.grasp().size(), Twist<2>::Zero());
  ASSERT_TRUE(found.holdable);
  EXPECT_NEAR(found.effort, 18, 1e-9);
  EXPECT_EQ(found.forces[0].limit, ForceLimit::min);
}

TEST(Hold, ForceCapDecidesWhatIsUnholdable) {
  const Grasp<2> grasp = squeezed(0.001).grasp();  // needs 2 fingers of 5000 N, 707.1 weights
  EXPECT_TRUE(hold(grasp, up_at(0), {708}).holdable);
  const Hold<2> found = hold(grasp, up_at(0), {707});
  EXPECT_FALSE(found.holdable);
  EXPECT_EQ(fault(grasp, 0.0, found, 707), "");
}

TEST(Hold, OfAFrictionlessFingerIsExactlyAlongItsNormal) {
  const Grasp<2> grasp({1, {0, 0}}, {contact({0, -1}, {0, 1}, 0), contact({1, 0}, {-1, 0}, 0)});
  const Hold<2> found = hold(grasp, up_at(-pi / 6));  // up = (-1/2, sqrt(3)/2)
  ASSERT_TRUE(found.holdable);
  EXPECT_NEAR(found.forces[0].normal, std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(found.forces[1].normal, 0.5, 1e-12);
  EXPECT_EQ(found.forces[0].tangential, 0);
  EXPECT_EQ(found.forces[0].friction_used, 1);
  EXPECT_EQ(found.forces[0].state, ContactState::slipping);
  EXPECT_FALSE(hold(grasp, up_at(pi / 6)).holdable);
}

TEST(Hold, OfCoincidingContactsIsThatOfOne) {
  const Held twice{{1, {0, 1}}, {contact({0, 0}, {0, 1}, 0.5), contact({0, 0}, {0, 1}, 0.5)}};
  const Hold<2> found = hold_at(twice, 0);
  ASSERT_TRUE(found.holdable);
  EXPECT_NEAR(found.effort, 0.5, 1e-12);
  EXPECT_FALSE(hold_at(twice, 0.1).holdable);
}

TEST(Hold, OfContactsAtTheComIgnoresMoments) {
  const Held held{{1, {2, 3}}, {contact({2, 3}, {0, 1}, 1), contact({2, 3}, {0, -2}, 1)}};
  for (const double theta : {-0.7, 0.0, 0.3, 3.0}) {
    const Hold<2> found = hold_at(held, theta);
    ASSERT_TRUE(found.holdable);
    EXPECT_NEAR(found.effort, 1, 1e-12);
    EXPECT_EQ(fault(held.grasp(), theta, found), "");
  }
  EXPECT_NEAR(hold_at(held, pi / 2).effort, 1, 1e-12);
}

TEST(Hold, OnTheEdgeOfTheOnlyConeHolds) {
  const Held held{{1, {0, 0}}, {contact({0, 0}, {0, 1}, 1)}};
  EXPECT_TRUE(hold_at(held, pi / 4).holdable);
  EXPECT_TRUE(hold_at(held, -pi / 4).holdable);
  EXPECT_FALSE(hold_at(held, pi / 4 + 1e-7).holdable);
  EXPECT_TRUE(hold_at(held, pi / 4 - 1e-7).holdable);
}

TEST(Hold, ReasonNamesTheMotion) {
  const Grasp<2> grasp({10, {1, 0}}, {contact({0, -1}, {0, 1}, 2)});
  const Hold<2> found = hold(grasp, up_at(0));
  ASSERT_FALSE(found.holdable);
  EXPECT_NE(reason(grasp, found).find("turn clockwise"), std::string::npos) << reason(grasp, found);
  EXPECT_EQ(reason(grasp, hold(grasp, up_at(pi / 4))), "");
}

TEST(Hold, RefusesMisuse) {
  const Grasp<2> grasp = squeezed(0.5).grasp();
  EXPECT_THROW(hold(grasp, Vector<2>(0, 2)), InvalidGrasp);
  EXPECT_THROW(hold(grasp, Vector<2>(0, std::nan(""))), InvalidGrasp);
  EXPECT_THROW(hold(grasp, up_at(0), {0}), InvalidGrasp);
  EXPECT_THROW(hold(grasp, up_at(0), {std::nan("")}), InvalidGrasp);
  EXPECT_THROW(hold<2>(grasp, Wrench<2>(0, infinity, 0), grasp.size(), Twist<2>::Zero()),
               InvalidGrasp);
  EXPECT_THROW(hold<2>(grasp, Wrench<2>::Zero(), grasp.size(), Twist<2>(0, std::nan(""), 0)),
               InvalidGrasp);
}

}  // namespace
}  // namespace poise::test
