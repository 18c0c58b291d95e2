// The curve of several loads in the plane, with accelerations and fixed wrenches: against the holds
// of each load, forces found in force space, its own proof, and closed forms.
#include <gtest/gtest.h>

#include "poise/best_posture.hpp"
#include "poise/grip.hpp"
#include "random_grasps.hpp"
#include "second_sources.hpp"

namespace poise::test {
namespace {

/// Holds are not compared nearer than this [rad] to the limit of holding: rounding decides there.
constexpr double margin = 1e-7;
constexpr double infinity = std::numeric_limits<double>::infinity();

Grasp<2> random_grasp(const Recipe& recipe, int most_loads = 4) {
  const Held held = *grasps(recipe);
  return Grasp<2>(random_loads(most_loads), held.contacts);
}

RealWrench wrench_at(const Load<2>& load, double theta) {
  return load.at(up_at(theta)).cast<Real>();
}

/// The arc around a posture, at least `inset` from its ends.
const Arc* arc_at(const PostureCurve& curve, double theta, double inset) {
  for (const Arc& arc : curve.arcs)
    for (const double turn : {-2 * pi, 0.0, 2 * pi})
      if (theta + turn >= arc.from + inset && theta + turn <= arc.to - inset) return &arc;
  return nullptr;
}

/// How far the nearest end of a piece is.
double nearest_end(const PostureCurve& curve, double theta) {
  double nearest = pi;
  const auto consider = [&](const auto& piece) {
    for (const double end : {piece.from, piece.to})
      nearest = std::min(nearest, std::abs(std::remainder(theta - end, 2 * pi)));
  };
  for (const Interval& each : curve.holdable) consider(each);
  for (const UnholdableArc& each : curve.unholdable_arcs) consider(each);
  return nearest;
}

/// The greatest value of the loads' holds; infinite where one cannot be held.
double worst(const Grasp<2>& grasp, double theta, Objective objective) {
  double most = 0;
  for (const Load<2>& load : grasp.loads()) {
    const Hold<2> found = hold(grasp, load, up_at(theta), {.objective = objective});
    most = std::max(most, found.holdable ? found.value() : infinity);
  }
  return most;
}

double least_size(const Grasp<2>& grasp) {
  double least = infinity;
  for (const Load<2>& load : grasp.loads()) least = std::min(least, load.size(grasp.length()));
  return least;
}

void check_values(const Grasp<2>& grasp, const CurveSettings& settings) {
  const bool is_grip = settings.objective == Objective::grip;
  if (is_grip && !has_grip<2>(grasp)) return;
  const PostureCurve curve = posture_curve(grasp, settings);
  if (!curve.undecided.empty()) return;
  const double size = grasp.size(), unit = is_grip ? size : size * size;
  const double moderate = is_grip ? 100 * least_size(grasp) : std::pow(1000 * least_size(grasp), 2);
  const double width = curve.domain.to - curve.domain.from;
  for (int k = 0; k < 24; ++k) {
    const double theta = curve.domain.from + width * (k + real(0, 1)) / 24;
    if (nearest_end(curve, theta) < margin) continue;
    const double most = worst(grasp, theta, settings.objective);
    const Arc* const arc = arc_at(curve, theta, -1e-9);
    RC_ASSERT((arc != nullptr) == (most < infinity));
    if (!arc || most > moderate) continue;
    const Real slack = is_grip ? Real{1e-7} * (unit + most) : rounding(*arc) + 1e-9L * unit;
    RC_ASSERT(close(arc->value(theta), most, is_grip ? 1e-7L : 1e-9L, slack));
  }
}

CurveSettings random_settings() {
  return {.domain = one_in(4) ? Domain::pinching_up : Domain::all,
          .objective = one_in(2) ? Objective::grip : Objective::effort};
}

RC_GTEST_PROP(PlaneLoads, CurveIsTheGreatestValueOfTheLoads, ()) {
  check_values(random_grasp({.most_contacts = 6, .awkward = false}), random_settings());
}

RC_GTEST_PROP(PlaneLoads, CurveOfAwkwardGraspsToo, ()) {
  check_values(random_grasp({.most_contacts = 5}), {.objective = Objective::effort});
}

RC_GTEST_PROP(PlaneLoads, CurveIsThatOfForceSpace, ()) {
  const Grasp<2> grasp = random_grasp({.most_contacts = 3, .awkward = false}, 2);
  const PostureCurve curve = posture_curve(grasp);
  const double theta = random_angle();
  if (nearest_end(curve, theta) < margin) return;
  Real most = 0;
  for (const Load<2>& load : grasp.loads()) {
    const auto found = EveryFace(grasp, wrench_at(load, theta)).answer();
    most = std::max(most, found ? found->effort : std::numeric_limits<Real>::infinity());
  }
  const Arc* const arc = arc_at(curve, theta, -1e-9);
  if (most > 1e6 * grasp.size() * grasp.size()) return;
  RC_ASSERT(arc != nullptr);
  RC_ASSERT(close(arc->value(theta), most, 1e-8L, 1e-9L * grasp.size() * grasp.size()));
}

/// What stands in the curve suffices to believe it.
RC_GTEST_PROP(PlaneLoads, CurveProvesItself, ()) {
  const Grasp<2> grasp = random_grasp({.most_contacts = 5, .awkward = false});
  const PostureCurve curve = posture_curve(grasp);
  if (grasp.loads().size() == 1) RC_ASSERT(curve.loads.empty());
  for (const Arc& arc : curve.arcs)
    for (const double part : {0.0, 0.3, 0.7, 1.0}) {
      const double theta = arc.from + part * (arc.to - arc.from), V = arc.value(theta);
      if (V > std::pow(1000 * least_size(grasp), 2)) continue;
      const Twist<2> y(arc.y[0](theta), arc.y[1](theta), arc.y[2](theta));
      const Load<2>& load = grasp.loads()[arc.load];
      const Real slack = rounding(arc) + 1e-9L * grasp.size() * grasp.size();
      RC_ASSERT(close(dual_bound(grasp, wrench_at(load, theta), y), V, 1e-9L, slack));
      for (const PostureCurve& other : curve.loads) {  // its forces hold with no more
        const Arc* const held = arc_at(other, theta, -1e-8);
        RC_ASSERT(held != nullptr);
        RC_ASSERT(held->value(theta) <= V * (1 + 1e-8) + static_cast<double>(slack));
      }
    }
  for (const UnholdableArc& gap : curve.unholdable_arcs) {
    const Load<2>& load = grasp.loads()[gap.load];
    // How soon a y that rounding spoils proves something depends on how much of the load turns.
    const double inset = margin * std::max(1.0, grasp.size() / std::abs(load.turning()));
    if (!(gap.to - gap.from > 3 * inset)) continue;
    for (const double theta : {gap.from + inset, (gap.from + gap.to) / 2, gap.to - inset})
      RC_ASSERT(proves_unholdable(grasp, wrench_at(load, theta), gap.y));
  }
  for (std::size_t k = 0; k < curve.loads.size(); ++k) {
    for (const Arc& arc : curve.loads[k].arcs) RC_ASSERT(arc.load == k);
    for (const UnholdableArc& gap : curve.loads[k].unholdable_arcs) RC_ASSERT(gap.load == k);
  }
}

RC_GTEST_PROP(PlaneLoads, PiecesTileTheDomain, ()) {
  const CurveSettings settings = random_settings();
  const Grasp<2> grasp = random_grasp({.most_contacts = 5, .awkward = false});
  if (settings.objective == Objective::grip && !has_grip<2>(grasp)) return;
  const PostureCurve curve = posture_curve(grasp, settings);
  if (!curve.undecided.empty()) return;
  double sum = 0;
  std::size_t pieces = 0;
  const auto count = [&](const auto& piece) {
    RC_ASSERT(piece.from <= piece.to);
    sum += piece.to - piece.from;
    ++pieces;
  };
  for (const Arc& arc : curve.arcs) count(arc);
  for (const UnholdableArc& gap : curve.unholdable_arcs) count(gap);
  RC_ASSERT(curve.states.size() == curve.arcs.size() * grasp.contacts().size());
  RC_ASSERT(std::abs(sum - (curve.domain.to - curve.domain.from)) <=
            1.1e-8 * static_cast<double>(pieces));
}

RC_GTEST_PROP(PlaneLoads, BestIsNoWorseThanAnySample, ()) {
  const CurveSettings settings = random_settings();
  const bool is_grip = settings.objective == Objective::grip;
  const Grasp<2> grasp = random_grasp({.most_contacts = 4, .awkward = false});
  if (is_grip && !has_grip<2>(grasp)) return;
  const Best<2> best = best_posture(grasp, settings);
  const PostureCurve& curve = best.proof.curve;
  if (best.status == Status::gap) return;
  const double size = grasp.size(), unit = is_grip ? size : size * size;
  double least = infinity, most = 0;
  const double width = curve.domain.to - curve.domain.from;
  for (int k = 0; k < 60; ++k) {
    const double theta = curve.domain.from + width * (k + 0.3) / 60;
    if (nearest_end(curve, theta) < margin) continue;
    const double here = worst(grasp, theta, settings.objective);
    least = std::min(least, here);
    if (here < infinity) most = std::max(most, here);
  }
  if (!best.holdable()) {
    RC_ASSERT(least == infinity);
    return;
  }
  RC_ASSERT(best.status == Status::optimal);
  RC_ASSERT(best.best().holds.size() == grasp.loads().size());
  RC_ASSERT(best.best().holdable());
  const double value = best.best().value();
  RC_ASSERT(best.lower_bound <= value);
  RC_ASSERT(least >= best.lower_bound - 1e-7 * (unit + least));
  const double angle = best.best().optimum.angle;
  if (nearest_end(curve, angle) > margin)
    RC_ASSERT(close(value, worst(grasp, angle, settings.objective), 1e-7L, 1e-7L * unit));
  if (most > (is_grip ? 100 : 1e4) * unit) return;
  RC_ASSERT(best.proof.worst->value() >= most * (1 - 1e-6) - 1e-7 * unit);
}

/// With W (up + a / g) for W up: in a posture tilted by the acceleration, in a field so much
/// stronger.
RC_GTEST_PROP(PlaneLoads, AccelerationTiltsAndScalesGravity, ()) {
  Held held = *grasps({.most_contacts = 4, .limits = false, .awkward = false});
  const PostureCurve still = posture_curve(held.grasp());
  held.object.acceleration = {8 * coordinate(), 8 * coordinate()};
  held.object.lift = 9 * coordinate();
  const PostureCurve moved = posture_curve(held.grasp());
  for (int k = 0; k < 10; ++k) {
    const double theta = random_angle();
    const Vector<2> felt = (1 + held.object.lift / standard_gravity) * up_at(theta) +
                           held.object.acceleration / standard_gravity;
    const double tilted = angle_of(felt);
    if (felt.norm() < 1e-3 || nearest_end(still, tilted) < 1e-6 || nearest_end(moved, theta) < 1e-6)
      continue;
    const Arc *const a = arc_at(still, tilted, -1e-9), *const b = arc_at(moved, theta, -1e-9);
    RC_ASSERT((a != nullptr) == (b != nullptr));
    const double W = held.object.weight;
    if (!a || a->value(tilted) > 1e4 * W * W) continue;
    RC_ASSERT(close(b->value(theta), felt.squaredNorm() * a->value(tilted), 1e-8L,
                    1e-9L * W * W + rounding(*a) + rounding(*b)));
  }
}

/// A force alone is a weight elsewhere that does not turn.
RC_GTEST_PROP(PlaneLoads, ForceIsAWeightElsewhere, ()) {
  const Held held = *grasps({.most_contacts = 4, .awkward = false});
  const double theta = random_angle(), W = held.object.weight;
  const Load<2> force{.weight = 0, .fixed = held.object.at(up_at(theta))};
  const PostureCurve curve = posture_curve(Grasp<2>(force, held.contacts));
  const PostureCurve turning = posture_curve(held.grasp());
  if (nearest_end(turning, theta) < margin) return;
  const Arc* const arc = arc_at(turning, theta, -1e-9);
  RC_ASSERT(curve.arcs.size() == (arc ? 1U : 0U));
  if (!arc || arc->value(theta) > 1e6 * W * W) return;
  RC_ASSERT(close(curve.arcs[0].value(1.7), arc->value(theta), 1e-8L, rounding(*arc)));
  RC_ASSERT(curve.optima.size() == 2U);
  RC_ASSERT(curve.optima[0].from == -pi && curve.optima[0].to == pi);
}

RC_GTEST_PROP(PlaneLoads, CurveOfEqualLoadsIsThatOfOne, ()) {
  const Held held = *grasps();
  const Load<2> load = random_load();
  const PostureCurve one = posture_curve(Grasp<2>(load, held.contacts));
  const PostureCurve two = posture_curve(Grasp<2>(std::vector<Load<2>>{load, load}, held.contacts));
  for (const Arc& arc : one.arcs)  // some are so steep that their optima have few digits
    if (rounding(arc) > 1e-10L) return;
  RC_ASSERT(one.optima.size() == two.optima.size());
  for (std::size_t k = 0; k < one.optima.size(); ++k) {
    RC_ASSERT(close(one.optima[k].value, two.optima[k].value, 1e-9L));
    RC_ASSERT(std::abs(one.optima[k].angle - two.optima[k].angle) <= 1e-8);
    RC_ASSERT(one.optima[k].kind == two.optima[k].kind);
  }
  RC_ASSERT(one.holdable.size() == two.holdable.size());
  for (const Arc& arc : two.arcs) RC_ASSERT(arc.load == 0U);
}

/// Two jaws that press from the sides, at distance d from the middle.
Grasp<2> jaws(std::vector<Load<2>> loads, double friction, double d = 0.03) {
  return Grasp<2>(std::move(loads),
                  {contact({-d, 0}, {1, 0}, friction), contact({d, 0}, {-1, 0}, friction)});
}

TEST(PlaneLoads, LiftMakesHeavier) {
  const CurveSettings grip{.objective = Objective::grip};
  const Best<2> still = best_posture(jaws({{.weight = 10}}, 0.5), grip);
  const Best<2> lifted =
      best_posture(jaws({{.weight = 10, .lift = 0.3 * standard_gravity}}, 0.5), grip);
  EXPECT_NEAR(lifted.best().value(), 1.3 * still.best().value(), 1e-9);
  const PostureCurve curve = posture_curve(
      jaws({{.weight = 10}, {.weight = 10, .lift = 0.3 * standard_gravity}}, 0.5), grip);
  for (const Arc& arc : curve.arcs) EXPECT_EQ(arc.load, 1U);
}

/// What pushes with 5 N up and 0.06 N m, and then pulls with 2 N and 3 N, whatever the posture:
/// left and right press with 5.833333 N and 4.5 N.
TEST(PlaneLoads, WithoutWeightAreTheSameInEveryPosture) {
  const Grasp<2> grasp = jaws({{.weight = 0, .fixed = {0, 5, 0.06}, .name = "pushed"},
                               {.weight = 0, .fixed = {-2, -3, 0}, .name = "pulled"}},
                              0.6);
  for (const double present : {-3.0, 0.0, 1.3}) {
    const Best<2> best = best_posture(grasp, {.objective = Objective::grip, .present = present});
    ASSERT_EQ(best.status, Status::optimal);
    ASSERT_EQ(best.minima.size(), 1U);
    EXPECT_NEAR(best.best().value(), 35.0 / 6, 1e-9);
    EXPECT_EQ(best.best().decides, 0U);
    EXPECT_NEAR(best.best().holds[1].value(), 4.5, 1e-9);
    EXPECT_NEAR(best.best().optimum.angle, present, 1e-12);
    EXPECT_NEAR(best.lower_bound, 35.0 / 6, 1e-9);
  }
}

/// A force of 6 N along the line of the jaws needs 6 N in any posture; a weight of 4 N needs
/// 4 N / (2 * 0.8) where they are level, and less than 6 N far around there.
TEST(PlaneLoads, AWeightlessOneThatDecidesMakesAStretch) {
  const Load<2> weight{.weight = 4}, force{.weight = 0, .fixed = {6, 0, 0}};
  const PostureCurve curve =
      posture_curve(jaws({weight, force}, 0.8), {.objective = Objective::grip, .present = 0.2});
  ASSERT_FALSE(curve.optima.empty());
  EXPECT_NEAR(curve.optima[0].value, 6, 1e-12);
  EXPECT_NEAR(curve.optima[0].angle, 0.2, 1e-12);
  EXPECT_GT(curve.optima[0].to - curve.optima[0].from, 1);
}

/// Mirror images cross where the jaws are level; the best posture of each is on its own side.
TEST(PlaneLoads, BestOfMirrorImagesIsWhereTheyCross) {
  const CurveSettings grip{.objective = Objective::grip};
  const Load<2> right{.weight = 10, .com = {0.01, 0}, .acceleration = {4, 0}};
  const Load<2> left{.weight = 10, .com = {-0.01, 0}, .acceleration = {-4, 0}};
  const Best<2> best = best_posture(jaws({right, left}, 0.7), grip);
  ASSERT_EQ(best.status, Status::optimal);
  EXPECT_NEAR(best.best().optimum.angle, 0, 1e-9);
  const Posture<2>& posture = best.best();
  EXPECT_EQ(best.best().optimum.kind, Kind::kink);
  EXPECT_NEAR(posture.holds[0].value(), posture.holds[1].value(), 1e-9);
  EXPECT_FALSE(best.best().two_slipping);
}

}  // namespace
}  // namespace poise::test
