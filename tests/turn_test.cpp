// Turns in the plane: the peak read off the curve against dense samples, both ways round, gaps, the
// domain, and closed forms.
#include "poise/turn.hpp"

#include <gtest/gtest.h>

#include "poise/grip.hpp"
#include "random_grasps.hpp"

namespace poise::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double value(const Grasp<2>& grasp, double theta, Objective objective) {
  return posture_at(grasp, up_at(theta), {.objective = objective}).value();
}

/// How far the nearest end of a holdable interval is.
double nearest_end(const PostureCurve& curve, double theta) {
  double nearest = pi;
  for (const Interval& each : curve.holdable)
    for (const double end : {each.from, each.to})
      nearest = std::min(nearest, std::abs(std::remainder(theta - end, 2 * pi)));
  return nearest;
}

/// What is wrong with a peak, or nothing.
std::string fault(const Grasp<2>& grasp, double from, const TurnPeak<2>& found,
                  const CurveSettings& settings, int samples = 300) {
  std::ostringstream words;
  words.precision(12);
  CurveSettings whole = settings;
  whole.domain = Domain::all;
  const PostureCurve curve = posture_curve(grasp, whole);
  if (!curve.undecided.empty()) return "";
  if (found.peak != found.lower_bound) return "the bound";
  if (found.unholdable.empty() != (found.peak < infinity)) return "unholdable";
  if (found.at * found.angle < 0 || std::abs(found.at) > std::abs(found.angle)) return "at";
  if ((found.posture.up - up_at(from + found.at)).norm() > 1e-7) return "the posture";
  const double scale = grasp.size() * (settings.objective == Objective::effort ? grasp.size() : 1);
  const double rounding = 1e-7 * scale;
  if (found.peak < infinity && nearest_end(curve, from + found.at) > 1e-7 &&
      std::abs(found.posture.value() - found.peak) > 1e-6 * found.peak + rounding)
    return "the posture's value";
  double reached = 0;
  for (const auto& stretch : found.unholdable) {
    const double sign = found.angle < 0 ? -1 : 1;
    const bool is_in_order =
        reached <= sign * stretch.from && sign * stretch.from <= sign * stretch.at &&
        sign * stretch.at <= sign * stretch.to && sign * stretch.to <= sign * found.angle + 1e-12;
    if (!is_in_order) return "the order of stretches";
    reached = sign * stretch.to;
    const double width = std::abs(stretch.to - stretch.from);
    if (width > 1e-6 && stretch.posture.holdable()) return "what is said to be unholdable holds";
  }
  double most = 0;
  for (int k = 0; k <= samples; ++k) {
    const double at = found.angle * k / samples, theta = from + at;
    const double here = value(grasp, theta, settings.objective);
    if (nearest_end(curve, theta) < 1e-6) continue;
    if (here < infinity) most = std::max(most, here);
    bool is_inside = false, is_at_end = false;
    for (const auto& [a, b, middle, posture] : found.unholdable) {
      is_inside = is_inside || (at - a) * (at - b) < 0;
      is_at_end = is_at_end || std::min(std::abs(at - a), std::abs(at - b)) < 1e-6;
    }
    if (here < infinity && is_inside) words << "holds at " << at;
    if (!(here < infinity) && !is_inside && !is_at_end) words << "does not hold at " << at;
    if (!words.str().empty()) return words.str();
  }
  if (most > found.peak * (1 + 1e-6) + rounding) {
    words << "a sample needs " << most << ", more than " << found.peak;
    return words.str();
  }
  return "";
}

Objective either() { return one_in(2) ? Objective::effort : Objective::grip; }

/// Of its one weight, or of several loads.
Grasp<2> with_loads(const Held& held) {
  return one_in(2) ? held.grasp() : Grasp<2>(random_loads(3), held.contacts);
}

RC_GTEST_PROP(Turn, PeakIsThatOfDenseSamples, ()) {
  if (!one_in(10)) return;
  const Held held = *grasps({.most_contacts = 5, .awkward = false});
  const Grasp<2> grasp = with_loads(held);
  const CurveSettings settings{.objective = either()};
  if (settings.objective == Objective::grip && !has_grip<2>(grasp)) return;
  const double from = random_angle(), angle = 2 * pi * coordinate();
  const TurnPeak<2> found = turn_peak(grasp, from, angle, settings);
  RC_ASSERT(found.angle == angle);
  RC_ASSERT(fault(grasp, from, found, settings) == "");
}

RC_GTEST_PROP(Turn, PeakOfAwkwardGraspsToo, ()) {
  if (!one_in(10)) return;
  const Held held = *grasps({.most_contacts = 4});
  const Grasp<2> grasp = with_loads(held);
  const double from = random_angle();
  RC_ASSERT(fault(grasp, from, turn_peak(grasp, from, 2 * pi * coordinate()), {}) == "");
}

RC_GTEST_PROP(Turn, WaysRoundAreBothTheLowerPeakFirst, ()) {
  if (!one_in(10)) return;
  const Held held = *grasps({.most_contacts = 5, .awkward = false});
  const Grasp<2> grasp = with_loads(held);
  const CurveSettings settings{.domain = one_in(2) ? Domain::all : Domain::pinching_up,
                               .objective = either()};
  if (settings.objective == Objective::grip && !has_grip<2>(grasp)) return;
  const double from = random_angle(), to = random_angle();
  const std::vector<TurnPeak<2>> ways = ways_round(grasp, from, to, settings);
  if (std::abs(std::remainder(from - to, 2 * pi)) < 1e-9) {
    RC_ASSERT(ways.empty());
    return;
  }
  const Interval domain = domain_interval(grasp, settings.domain);
  const auto is_inside = [&](double theta) {
    const double past = theta - domain.from;
    return past - 2 * pi * std::floor(past / (2 * pi)) <= domain.to - domain.from;
  };
  const bool stays = is_inside(from) && is_inside(to);
  for (const TurnPeak<2>& way : ways) {
    RC_ASSERT(std::abs(std::remainder(from + way.angle - to, 2 * pi)) < 1e-12);
    RC_ASSERT(fault(grasp, from, way, settings) == "");
    for (int k = 1; k < 50; ++k) RC_ASSERT(!stays || is_inside(from + way.angle * k / 50));
  }
  if (ways.size() == 2) {
    RC_ASSERT(ways[0].peak <= ways[1].peak * (1 + 1e-9));
    RC_ASSERT(std::abs(std::abs(ways[0].angle - ways[1].angle) - 2 * pi) < 1e-12);
    RC_ASSERT(ways[0].angle * ways[1].angle < 0);
  } else {
    RC_ASSERT(ways.size() == 1U && stays && settings.domain == Domain::pinching_up);
  }
}

/// Two fingers on a line through the com, one on each side, of friction mu: with up at an angle a
/// from the line, the effort is (W cos a)^2 + what friction asks for.
Grasp<2> jaws(double friction, double most = infinity) {
  return {{.weight = 10},
          {contact({-1, 0}, {1, 0}, friction, most), contact({1, 0}, {-1, 0}, friction, most)}};
}

/// Each jaw carries half of the tangential load W |cos theta|; the least normal forces differ by
/// W sin theta and are at least W |cos theta| / (2 mu): the grip is their greater.
TEST(Turn, OfTwoJawsHasAPeakInClosedForm) {
  const double mu = 0.5, W = 10;
  const Grasp<2> grasp = jaws(mu);
  const auto grip = [&](double theta) {
    return W * std::abs(std::cos(theta)) / (2 * mu) + W * std::abs(std::sin(theta));
  };
  const CurveSettings settings{.objective = Objective::grip};
  const TurnPeak<2> found = turn_peak(grasp, 0, pi / 2, settings);
  EXPECT_NEAR(found.peak, W * std::hypot(1 / (2 * mu), 1), 1e-9);
  EXPECT_NEAR(found.at, std::atan(2 * mu), 1e-7);
  EXPECT_NEAR(found.posture.value(), found.peak, 1e-7);
  for (const double to : {0.1, -0.1, 0.5, -1.2}) {
    const TurnPeak<2> part = turn_peak(grasp, 0.0, to, settings);
    const double top = std::min(std::abs(to), std::atan(2 * mu));
    EXPECT_NEAR(part.peak, grip(top), 1e-8) << to;
    EXPECT_NEAR(part.at, std::copysign(top, to), 1e-6) << to;
  }
  // Of equal peaks the shorter way comes first, then that counter-clockwise.
  const std::vector<TurnPeak<2>> ways = ways_round(grasp, 0, pi, settings);
  ASSERT_EQ(ways.size(), 2U);
  EXPECT_DOUBLE_EQ(ways[0].angle, pi);
  EXPECT_DOUBLE_EQ(ways[1].angle, -pi);
  EXPECT_NEAR(ways[0].peak, ways[1].peak, 1e-9);
  // The first of equal peaks on the way is told.
  EXPECT_NEAR(ways[0].at, std::atan(2 * mu), 1e-7);
  EXPECT_NEAR(ways[1].at, -std::atan(2 * mu), 1e-7);
  const std::vector<TurnPeak<2>> quarter = ways_round(grasp, -0.5, pi / 2, settings);
  ASSERT_EQ(quarter.size(), 2U);
  EXPECT_NEAR(quarter[0].angle, pi / 2 + 0.5, 1e-12);
}

/// Jaws that may not press hard hold only near to the line between them and across it.
TEST(Turn, NamesTheStretchesThatCannotBeHeld) {
  // 20 |cos| + 10 |sin| <= 21: not where it is more, up to sqrt(500) at atan 0.5.
  const double mu = 0.25, most = 21, W = 10;
  const Grasp<2> grasp = jaws(mu, most);
  const double top = std::atan(0.5), wide = std::acos(most / std::sqrt(500.0));
  const CurveSettings settings{.objective = Objective::grip};
  for (const double start : {0.0, -0.2})
    for (const double sign : {1.0, -1.0}) {
      const TurnPeak<2> found = turn_peak(grasp, sign * start, sign * (1.5 - start), settings);
      EXPECT_EQ(found.peak, infinity);
      ASSERT_EQ(found.unholdable.size(), start < 0 ? 2U : 1U);
      const auto& last = found.unholdable.back();
      EXPECT_NEAR(last.from, sign * (top - wide - start), 1e-7);
      EXPECT_NEAR(last.to, sign * (top + wide - start), 1e-7);
      EXPECT_FALSE(last.posture.holdable());
      EXPECT_NE(reason(grasp, last.posture.hold()), "");
    }
  const TurnPeak<2> whole = turn_peak(grasp, 0, 2 * pi, settings);
  EXPECT_EQ(whole.unholdable.size(), 4U);
  const TurnPeak<2> near = turn_peak(grasp, 0, top - wide - 1e-6, settings);
  EXPECT_NEAR(near.peak, most, 1e-3);
  // From inside of a stretch.
  const TurnPeak<2> inside = turn_peak(grasp, top, 0.5 * pi, settings);
  ASSERT_FALSE(inside.unholdable.empty());
  EXPECT_EQ(inside.unholdable.front().from, 0);
  EXPECT_NEAR(inside.unholdable.front().to, wide, 1e-7);
  EXPECT_GT(W, 0);
}

TEST(Turn, OfOneFrictionlessFingerHoldsOnePosture) {
  const Grasp<2> grasp({.weight = 2, .com = {0, 1}}, {contact({0, 0}, {0, 1}, 0)});
  const TurnPeak<2> none = turn_peak(grasp, 0, 0);
  EXPECT_NEAR(none.peak, 4, 1e-9);
  EXPECT_TRUE(none.unholdable.empty());
  const TurnPeak<2> away = turn_peak(grasp, 0, 1);
  EXPECT_EQ(away.peak, infinity);
  ASSERT_EQ(away.unholdable.size(), 1U);
  EXPECT_NEAR(away.unholdable[0].from, 0, 1e-9);
  EXPECT_NEAR(away.unholdable[0].to, 1, 1e-9);
  const TurnPeak<2> across = turn_peak(grasp, -0.5, 1);
  ASSERT_EQ(across.unholdable.size(), 2U);
  EXPECT_NEAR(across.unholdable[0].to, 0.5, 1e-9);
  EXPECT_NEAR(across.unholdable[1].from, 0.5, 1e-9);
}

/// Where the load needs no grip at all.
TEST(Turn, OfWhatNeedsNothingHasThePeakZero) {
  Mechanism<2> mechanism{.kind = DriveKind::listed};
  mechanism.drives.push_back({.name = "jaw", .moves = {{"above", {0, -1, 0}}}});
  std::vector<Contact<2>> contacts{contact({-1, -1}, {0, 1}, 1), contact({1, -1}, {0, 1}, 1),
                                   contact({0, 1}, {0, -1}, 1)};
  contacts[0].finger = contacts[1].finger = "tray";
  contacts[2].finger = "above";
  const Grasp<2> grasp({.weight = 1}, contacts, 1, mechanism);
  const CurveSettings settings{.objective = Objective::grip};
  const TurnPeak<2> found = turn_peak(grasp, -0.3, 0.6, settings);
  EXPECT_NEAR(found.peak, 0, 1e-9);
  EXPECT_TRUE(found.unholdable.empty());
  const auto ways = ways_round(grasp, -0.3, 0.3, settings);
  ASSERT_EQ(ways.size(), 2U);
  EXPECT_NEAR(ways[0].angle, 0.6, 1e-12);
}

RC_GTEST_PROP(Turn, BestReachableIsThatOfDenseSamples, ()) {
  if (!one_in(10)) return;
  const Held held = *grasps({.most_contacts = 5, .awkward = false});
  const Grasp<2> grasp = with_loads(held);
  const CurveSettings settings{.domain = one_in(2) ? Domain::all : Domain::pinching_up,
                               .objective = either()};
  if (settings.objective == Objective::grip && !has_grip<2>(grasp)) return;
  const double from = random_angle(), now = value(grasp, from, settings.objective);
  if (!(now < infinity)) return;
  const Reachable<2> found = best_reachable(grasp, from, settings);
  const double least = found.posture.value();
  RC_ASSERT(least <= now * (1 + 1e-7));
  RC_ASSERT(found.least_angle <= 0 && found.most_angle >= 0);
  RC_ASSERT(found.angle >= found.least_angle - 1e-9 && found.angle <= found.most_angle + 1e-9);
  RC_ASSERT((found.posture.up - up_at(from + found.angle)).norm() < 1e-7);
  for (const double end : {found.least_angle, found.most_angle})
    for (int k = 0; k <= 100; ++k) {
      const double theta = from + end * k / 100;
      const double here = value(grasp, theta, settings.objective);
      if (here < infinity) RC_ASSERT(here <= now * (1 + 1e-6));
      if (settings.domain == Domain::all && here < infinity)
        RC_ASSERT(here >= least * (1 - 1e-6) - 1e-7 * grasp.size());
    }
}

TEST(Turn, RefusesMisuse) {
  const Grasp<2> grasp = jaws(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(turn_peak(grasp, nan, 1), InvalidGrasp);
  EXPECT_THROW(turn_peak(grasp, 0, nan), InvalidGrasp);
  EXPECT_THROW(turn_peak(grasp, 0, 7), InvalidGrasp);
  EXPECT_THROW(ways_round(grasp, nan, 0), InvalidGrasp);
  EXPECT_THROW(ways_round(grasp, 0, infinity), InvalidGrasp);
  EXPECT_THROW(best_reachable(grasp, nan), InvalidGrasp);
  EXPECT_TRUE(ways_round(grasp, 1, 1 + 2 * pi).empty());
}

}  // namespace
}  // namespace poise::test
