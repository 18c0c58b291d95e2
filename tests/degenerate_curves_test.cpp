// Posture curves of grasps in which something coincides, one by one, with known answers.
#include <gtest/gtest.h>

#include "poise/best_posture.hpp"
#include "random_grasps.hpp"

namespace poise::test {
namespace {

constexpr double degree = pi / 180;

/// Fingers on a disk of radius 1 round the com, at angles in degrees from +x; weight 1.
Grasp<2> ring(const std::vector<double>& angles, double friction,
              double max_normal = std::numeric_limits<double>::infinity()) {
  std::vector<Contact<2>> contacts;
  for (const double angle : angles)
    contacts.push_back(
        contact(direction(angle * degree), -direction(angle * degree), friction, max_normal));
  return Grasp<2>({1, {0, 0}}, contacts);
}

void expect_whole_circle(const PostureCurve& curve) {
  EXPECT_TRUE(curve.unholdable_arcs.empty());
  ASSERT_EQ(curve.holdable.size(), 1U);
  EXPECT_EQ(curve.holdable[0].from, -pi);
  EXPECT_EQ(curve.holdable[0].to, pi);
}

void expect_holdable(const PostureCurve& curve, const std::vector<Interval>& expected) {
  ASSERT_EQ(curve.holdable.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(curve.holdable[i].from, expected[i].from, 1e-9);
    EXPECT_NEAR(curve.holdable[i].to, expected[i].to, 1e-9);
  }
}

std::vector<Optimum> minima(const PostureCurve& curve) {
  std::vector<Optimum> found;
  for (const Optimum& optimum : curve.optima)
    if (!optimum.maximum) found.push_back(optimum);
  return found;
}

void expect_one_stretch(const PostureCurve& curve, double from, double to, double effort,
                        Kind kind) {
  ASSERT_EQ(minima(curve).size(), 1U);
  const Optimum& stretch = curve.optima[0];
  EXPECT_NEAR(stretch.from, from, 1e-9);
  EXPECT_NEAR(stretch.to, to, 1e-9);
  EXPECT_NEAR(std::remainder(stretch.angle - (from + to) / 2, 2 * pi), 0, 1e-9);
  EXPECT_NEAR(stretch.value, effort, 1e-12);
  EXPECT_EQ(stretch.kind, kind);
}

TEST(DegenerateCurve, OneFrictionlessFingerHoldsAtOnePosture) {
  const PostureCurve curve = posture_curve(Grasp<2>({1, {0, 1}}, {contact({0, 0}, {0, 1}, 0)}));
  expect_holdable(curve, {{0, 0}});
  ASSERT_EQ(minima(curve).size(), 1U);
  EXPECT_NEAR(curve.optima[0].angle, 0, 1e-9);
  EXPECT_NEAR(curve.optima[0].value, 1, 1e-9);
  EXPECT_EQ(curve.optima[0].kind, Kind::boundary);
}

TEST(DegenerateCurve, OneFingerWithFrictionHoldsWhereTheComIsAboveIt) {
  // The com is 30 degrees off the normal; the cone reaches 45.
  const Vector<2> com = up_at(30 * degree);
  expect_holdable(posture_curve(Grasp<2>({1, com}, {contact({0, 0}, {0, 1}, 1)})),
                  {{30 * degree, 30 * degree}});
  // Hanging from above would need the finger to pull.
  const PostureCurve beyond = posture_curve(Grasp<2>({1, com}, {contact({0, 0}, {0, 1}, 0.5)}));
  EXPECT_TRUE(beyond.holdable.empty());
  EXPECT_TRUE(beyond.optima.empty());
}

TEST(DegenerateCurve, NoPostureIsHeldWhereFingersAreTooWeak) {
  const PostureCurve curve = posture_curve(ring({0, 90, 180, 270}, 0.5, 0.2));
  EXPECT_TRUE(curve.holdable.empty());
  EXPECT_TRUE(curve.arcs.empty());
  EXPECT_TRUE(curve.optima.empty());
  EXPECT_FALSE(curve.unholdable_arcs.empty());
  EXPECT_FALSE(best_posture(ring({0, 90, 180, 270}, 0.5, 0.2)).holdable());
}

TEST(DegenerateCurve, FrictionlessFingersFromAboveAndBelowHoldAtTwoOppositePostures) {
  const PostureCurve curve = posture_curve(ring({90, 270}, 0));
  expect_holdable(curve, {{-pi, -pi}, {0, 0}});
  ASSERT_EQ(minima(curve).size(), 2U);
  EXPECT_NEAR(curve.optima[0].angle, 0, 1e-9);
  EXPECT_NEAR(std::abs(curve.optima[1].angle), pi, 1e-9);
  for (const Optimum& optimum : minima(curve)) EXPECT_NEAR(optimum.value, 1, 1e-9);
}

TEST(DegenerateCurve, TwoFrictionlessFingersHoldBetweenTheirNormals) {
  // Up is between the normals of the fingers at 210 and 330 degrees: at most 60 degrees off +y.
  const PostureCurve curve = posture_curve(ring({210, 330}, 0));
  expect_holdable(curve, {{-60 * degree, 60 * degree}});
  // Normal forces a, b: a + b = 2 cos theta, a - b = 2 sin theta / sqrt(3).
  for (const Arc& arc : curve.arcs)
    for (const double theta : {arc.from, arc.to})
      EXPECT_NEAR(arc.value(theta), (2 + 4 * std::cos(theta) * std::cos(theta)) / 3, 1e-12);
  ASSERT_EQ(curve.optima.size(), 3U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(curve.optima[i].angle, i == 0 ? 60 * degree : -60 * degree, 1e-9);
    EXPECT_NEAR(curve.optima[i].value, 1, 1e-9);
    EXPECT_EQ(curve.optima[i].kind, Kind::boundary);
  }
  EXPECT_NEAR(curve.optima[2].angle, 0, 1e-9);
  EXPECT_NEAR(curve.optima[2].value, 2, 1e-12);
}

TEST(DegenerateCurve, FrictionlessRingOfThreeHasKinksAboveItsFingers) {
  // V = 2/3 + 4/3 max(-n_i . up)^2: 1 where one finger carries all, 2 where two share it.
  const PostureCurve curve = posture_curve(ring({90, 210, 330}, 0));
  expect_whole_circle(curve);
  const std::vector<Optimum> found = minima(curve);
  ASSERT_EQ(found.size(), 3U);
  const double expected[] = {60 * degree, -60 * degree, pi};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::remainder(found[i].angle - expected[i], 2 * pi), 0, 1e-9);
    EXPECT_NEAR(found[i].value, 1, 1e-12);
    EXPECT_EQ(found[i].kind, Kind::kink);
  }
  ASSERT_EQ(curve.optima.size(), 6U);
  for (std::size_t i = 3; i < 6; ++i) {
    EXPECT_NEAR(curve.optima[i].value, 2, 1e-12);
    EXPECT_EQ(curve.optima[i].kind, Kind::smooth);
  }
}

TEST(DegenerateCurve, FrictionlessRingOfFourIsTheSameInEveryPosture) {
  const PostureCurve curve = posture_curve(ring({0, 90, 180, 270}, 0));
  expect_whole_circle(curve);
  expect_one_stretch(curve, -pi, pi, 1, Kind::smooth);
  EXPECT_EQ(curve.optima[0].angle, 0);
  ASSERT_EQ(curve.optima.size(), 2U);
  EXPECT_TRUE(curve.optima[1].maximum);
  EXPECT_NEAR(curve.optima[1].value, 1, 1e-12);
}

TEST(DegenerateCurve, WeakFrictionlessRingOfFourHoldsOnFourArcs) {
  // |sin theta| and |cos theta| at most 0.8.
  const PostureCurve curve = posture_curve(ring({0, 90, 180, 270}, 0, 0.8));
  const double low = std::asin(0.6), high = std::asin(0.8);
  expect_holdable(curve,
                  {{-pi + low, -pi + high}, {-high, -low}, {low, high}, {pi - high, pi - low}});
  const std::vector<Optimum> found = minima(curve);
  ASSERT_EQ(found.size(), 4U);
  for (const Optimum& optimum : found) {
    EXPECT_NEAR(optimum.value, 1, 1e-12);
    EXPECT_EQ(optimum.kind, Kind::boundary);
    EXPECT_NEAR(optimum.to - optimum.from, high - low, 1e-9);
  }
  EXPECT_NEAR(found[0].angle, low, 1e-9);  // the nearest to the present posture
  EXPECT_NEAR(found[1].angle, -low, 1e-9);
}

TEST(DegenerateCurve, OneFingerAtTheComCarriesTheSameAllOverItsCone) {
  const PostureCurve curve = posture_curve(Grasp<2>({2, {3, 4}}, {contact({3, 4}, {0, 1}, 1)}));
  expect_holdable(curve, {{-45 * degree, 45 * degree}});
  expect_one_stretch(curve, -45 * degree, 45 * degree, 4, Kind::boundary);
}

TEST(DegenerateCurve, TwoOppositeFingersAtTheComHaveAStretchEach) {
  const Grasp<2> grasp({1, {0, 0}}, {contact({0, 0}, {1, 0}, 0.2), contact({0, 0}, {-1, 0}, 0.2)});
  const PostureCurve curve = posture_curve(grasp);
  expect_whole_circle(curve);
  const std::vector<Optimum> found = minima(curve);
  ASSERT_EQ(found.size(), 2U);  // within either cone one finger carries all
  const double half = std::atan(0.2);
  for (const Optimum& optimum : found) {
    EXPECT_NEAR(optimum.value, 1, 1e-12);
    EXPECT_NEAR(optimum.to - optimum.from, 2 * half, 1e-9);
    EXPECT_NEAR(std::abs(optimum.angle), pi / 2 - half, 1e-9);  // the nearest to the present
    EXPECT_EQ(optimum.kind, Kind::smooth);
  }
  ASSERT_EQ(curve.optima.size(), 4U);
  // Straight between the cones each finger presses with half of the weight / 0.2.
  for (std::size_t i = 2; i < 4; ++i) EXPECT_NEAR(curve.optima[i].value, 2 * (6.25 + 0.25), 1e-9);
}

TEST(DegenerateCurve, EverythingAtTheComWithRightAngledConesIsFlat) {
  const Grasp<2> grasp({1, {0, 0}}, {contact({0, 0}, {1, 0}, 1), contact({0, 0}, {-1, 0}, 1)});
  const PostureCurve curve = posture_curve(grasp);
  expect_whole_circle(curve);
  expect_one_stretch(curve, -pi, pi, 1, Kind::smooth);
}

TEST(DegenerateCurve, ThreeLimitsMeetingLeaveOnePosture) {
  // Three frictionless fingers at the com, each at its limit, carry just the weight.
  const Contact<2> third = contact({0, 0}, {0, 1}, 0, 1 / 3.0);
  const PostureCurve curve = posture_curve(Grasp<2>({1, {0, 0}}, {third, third, third}));
  expect_holdable(curve, {{0, 0}});
  ASSERT_EQ(minima(curve).size(), 1U);
  EXPECT_NEAR(curve.optima[0].value, 1 / 3.0, 1e-9);
}

TEST(DegenerateCurve, ThreeFacesChangingAtOncePassTheirPosture) {
  // Symmetric: at 0 the two upper fingers start or stop together, and the lower one sticks.
  const PostureCurve curve = posture_curve(ring({270, 30, 150}, 0.5));
  expect_whole_circle(curve);
  for (const Arc& arc : curve.arcs) EXPECT_GT(arc.to - arc.from, 1e-6);
  // The grasp is its own mirror image and its own third of a turn.
  const std::vector<Optimum> found = minima(curve);
  EXPECT_EQ(found.size() % 3, 0U);
  for (const Optimum& optimum : found) {
    const auto count = std::count_if(found.begin(), found.end(), [&](const Optimum& other) {
      return std::abs(optimum.value - other.value) < 1e-9;
    });
    EXPECT_EQ(count % 3, 0);
  }
}

TEST(DegenerateCurve, CoincidingFingersShareAsOne) {
  const std::vector<double> once{80, 200, 330}, twice{80, 80, 200, 200, 330, 330};
  const PostureCurve one = posture_curve(ring(once, 0.4)), two = posture_curve(ring(twice, 0.4));
  ASSERT_EQ(one.optima.size(), two.optima.size());
  for (std::size_t i = 0; i < one.optima.size(); ++i) {
    EXPECT_NEAR(one.optima[i].angle, two.optima[i].angle, 1e-7);
    EXPECT_NEAR(one.optima[i].value, 2 * two.optima[i].value, 1e-9);
    EXPECT_EQ(one.optima[i].kind, two.optima[i].kind);
  }
}

TEST(DegenerateCurve, PressedDiskIsPushedWhereItRests) {
  // A fixture that must press with 1 N from above never leaves the lower finger unloaded.
  Contact<2> above = contact({0, 1}, {0, -1}, 0);
  above.min_normal = 1;
  const PostureCurve curve =
      posture_curve(Grasp<2>({1, {0, 0}}, {above, contact({0, -1}, {0, 1}, 0)}));
  expect_holdable(curve, {{-pi, -pi}, {0, 0}});
  const std::vector<Optimum> found = minima(curve);
  ASSERT_EQ(found.size(), 2U);
  // Upside down "above" carries the weight and 0 N more: it is at 1 N.
  EXPECT_NEAR(std::abs(found[0].angle), pi, 1e-9);
  EXPECT_NEAR(found[0].value, 1, 1e-9);
  EXPECT_NEAR(found[1].angle, 0, 1e-9);
  EXPECT_NEAR(found[1].value, 5, 1e-9);
}

TEST(DegenerateCurve, ForceCapEndsArcs) {
  // Two fingers press from the sides: N = 1 / (2 mu) at 0. With a cap below that norm there is
  // nothing at 0, and an arc each way round where the lower finger carries.
  const Grasp<2> grasp = ring({0, 180}, 0.01);
  expect_whole_circle(posture_curve(grasp));
  const PostureCurve capped = posture_curve(grasp, {.force_cap = 50});
  ASSERT_EQ(capped.holdable.size(), 2U);
  for (const Interval& arc : capped.holdable)
    for (const double end : {arc.from, arc.to}) {
      const Hold<2> held = hold(grasp, up_at(end));  // without the cap
      EXPECT_NEAR(std::sqrt(held.effort), 50, 1e-6);
    }
}

TEST(DegenerateCurve, EndsOfThePinchedDomainAreBoundaries) {
  const Grasp<2> grasp = ring({45, 135}, 2);
  const PostureCurve curve = posture_curve(grasp, {.domain = Domain::pinching_up});
  EXPECT_NEAR(curve.domain.from, -0.75 * pi, 1e-12);
  EXPECT_NEAR(curve.domain.to, 0.75 * pi, 1e-12);
  for (const double end : {curve.domain.from, curve.domain.to})
    EXPECT_TRUE(std::any_of(curve.optima.begin(), curve.optima.end(), [&](const Optimum& optimum) {
      return std::abs(optimum.angle - end) < 1e-9 && optimum.kind == Kind::boundary;
    }));
}

/// No posture that holds is called unholdable, and none needs less than the lower bound.
void expect_nothing_claimed_too_much(const Grasp<2>& grasp, const CurveSettings& settings) {
  const Best<2> best = best_posture(grasp, settings);
  const double slack = 1e-9 * best.lower_bound;
  for (int k = 0; k < 2000; ++k) {
    const double theta = -pi + 2 * pi * k / 2000;
    const Hold<2> here = hold(grasp, up_at(theta), {settings.force_cap});
    if (!here.holdable) continue;
    EXPECT_GE(here.effort, best.lower_bound - slack) << theta;
    for (const UnholdableArc& gap : best.proof.curve.unholdable_arcs)
      for (const double turn : {-2 * pi, 0.0, 2 * pi})
        EXPECT_FALSE(theta + turn > gap.from + 1e-7 && theta + turn < gap.to - 1e-7) << theta;
  }
  if (best.holdable()) {
    EXPECT_LE(best.lower_bound, best.best().hold().effort * (1 + 1e-9));
  }
}

TEST(UndecidedPostures, AreNamedWhereSizesDifferTooMuch) {
  Load<2> object;
  object.com = {0, -3};
  const Grasp<2> grasp(object, {contact({1e13, 0}, {0, 1}, 0), contact({0, 0}, {-1, 0}, 1)});
  EXPECT_EQ(best_posture(grasp).status, Status::gap);
  expect_nothing_claimed_too_much(grasp, {});
}

TEST(UndecidedPostures, AreNamedWhereTheCapIsTheForceNeeded) {
  const Grasp<2> grasp({}, {contact({0, 0}, {0, 1}, 1), contact({1, 0}, {0, 1}, 1)});
  const CurveSettings settings{Domain::all, 0.99999999994548672};
  EXPECT_EQ(best_posture(grasp, settings).status, Status::gap);  // each y proves 1e-5 rad
  expect_nothing_claimed_too_much(grasp, settings);
}

// Frictionless fingers against each other, next to one of friction 0.001: it takes 10^5 weights.
TEST(UndecidedPostures, AreNoneWhereTheForcesAreHuge) {
  const double inf = std::numeric_limits<double>::infinity(), c = 0.86602540378443837;
  std::vector<Contact<2>> contacts{
      contact({0, 1}, {0, -1}, 1.7327427834180247), contact({c, -0.5}, {-c, 0.5}, 0),
      contact({-0.5, -c}, {0.5, c}, 0), contact({-c, 0.5}, {c, -0.5}, 0.001)};
  contacts[1].min_normal = 0.33473076361674464;
  contacts[2].max_normal = 0.90704878384236032;
  contacts[3].min_normal = 0.13924058723372326;
  contacts[3].max_normal = inf;
  const Grasp<2> grasp({}, contacts);
  const PostureCurve curve = posture_curve(grasp);
  EXPECT_TRUE(curve.undecided.empty());
  double largest = 0;
  for (const Arc& arc : curve.arcs) {
    const double middle = (arc.from + arc.to) / 2;
    const Hold<2> held = hold(grasp, up_at(middle));
    ASSERT_TRUE(held.holdable);
    EXPECT_NEAR(arc.value(middle) / held.effort, 1, 1e-6);
    largest = std::max(largest, std::sqrt(held.effort));
  }
  EXPECT_GT(largest, 1e5);
}

TEST(UndecidedPostures, AreNoneOfAnOrdinaryGrasp) {
  const Grasp<2> grasp({}, {contact({1, 0}, {-1, 0}, 0.5), contact({-1, 0}, {1, 0}, 0.4)});
  EXPECT_TRUE(best_posture(grasp).proof.curve.undecided.empty());
  EXPECT_EQ(best_posture(grasp).status, Status::optimal);
}

TEST(LowerBound, OfASinglePostureWithALongDualIsNotAboveTheEffort) {
  Load<2> object;
  object.weight = 1e6;
  const Grasp<2> grasp(object, {contact({0.70710678118654746, 0.70710678118654757}, {0, 1}, 0),
                                contact({0.86602540378443871, -0.49999999999999978},
                                        {0.86602540378443871, -0.49999999999999978}, 0)});
  expect_nothing_claimed_too_much(grasp, {});
}

TEST(UnholdablePosture, SaysSoWhereNothingIsProven) {
  const Grasp<2> grasp(
      {}, {contact({0, 0}, {0, 1}, 0, 0), contact({0, 0}, {-0.75, 0.74999999964187003}, 0)});
  const Hold<2> here = hold(grasp, up_at(-pi / 4));
  ASSERT_FALSE(here.holdable);
  EXPECT_EQ(here.proven, here.lower_bound > 1e12);
  EXPECT_EQ(here.proven, reason(grasp, here).find("rounding") == std::string::npos);
}

}  // namespace
}  // namespace poise::test
