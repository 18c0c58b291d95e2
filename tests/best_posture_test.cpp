// The best posture against scans of holds, and its proof.
#include "poise/best_posture.hpp"

#include <gtest/gtest.h>

#include "checks.hpp"
#include "random_grasps.hpp"

namespace poise::test {
namespace {

CurveSettings random_settings() {
  return {.domain = one_in(3) ? Domain::pinching_up : Domain::all};
}

bool moderate(const Grasp<2>& grasp, double effort) {
  return std::sqrt(effort) <= 1000 * grasp.size();
}

/// Of the effort of an optimum. At the end of the holdable set V may be as steep as it likes, so
/// its holds say less about it.
Real tolerance(const PostureCurve& curve, const Optimum& optimum) {
  return (optimum.kind == Kind::boundary ? 1e-6L : 1e-9L) * optimum.value +
         rounding(curve, optimum.angle);
}

RC_GTEST_PROP(BestPosture, NoPostureOfTheDomainNeedsLess, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const Best<2> best = best_posture(grasp, random_settings());
  const Interval domain = best.proof.curve.domain;
  for (int i = 0; i < 50; ++i) {
    const Hold<2> sampled =
        hold(grasp, up_at(domain.from + (domain.to - domain.from) * real(0, 1)));
    if (!sampled.holdable) continue;
    RC_ASSERT(best.holdable());
    const Optimum& least = best.best().optimum;
    RC_ASSERT(sampled.effort >= least.value - tolerance(best.proof.curve, least));
    RC_ASSERT(best.proof.worst.has_value());
    const Optimum& most = best.proof.worst->optimum;
    if (moderate(grasp, sampled.effort))
      RC_ASSERT(sampled.effort <= most.value + tolerance(best.proof.curve, most));
  }
}

RC_GTEST_PROP(BestPosture, LowerBoundIsWhatItsArcsProve, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const Best<2> best = best_posture(grasp, random_settings());
  if (!best.holdable()) {
    RC_ASSERT(best.lower_bound == 0);
    return;
  }
  const double effort = best.best().optimum.value;
  RC_ASSERT(best.lower_bound <= effort * (1 + 1e-9));
  RC_ASSERT(best.lower_bound >= effort * (1 - 1.1e-6));
  for (const Arc& arc : best.proof.curve.arcs) {
    const double theta = arc.from + real(0, 1) * (arc.to - arc.from);
    const Twist<2> y(arc.y[0](theta), arc.y[1](theta), arc.y[2](theta));
    RC_ASSERT(dual_bound(grasp, load_at(grasp, theta), y) >= best.lower_bound * (1 - 1e-9));
  }
}

RC_GTEST_PROP(BestPosture, HoldsAreThoseOfItsPostures, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const Best<2> best = best_posture(grasp, random_settings());
  RC_ASSERT(best.holdable() == !best.proof.curve.holdable.empty());
  for (const Minimum<2>& minimum : best.minima) {
    const double theta = minimum.optimum.angle;
    if (!moderate(grasp, minimum.optimum.value)) continue;
    RC_ASSERT(minimum.hold().holdable);
    RC_ASSERT(fault(grasp, theta, minimum.hold()) == "");
    RC_ASSERT(std::abs(minimum.hold().effort - minimum.optimum.value) <=
              tolerance(best.proof.curve, minimum.optimum));
    RC_ASSERT(minimum.manner == manner(grasp, grasp.loads().front(), up_at(theta), minimum.hold()));
  }
}

RC_GTEST_PROP(BestPosture, MinimaAndWorstAreTheCurvesOptima, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const Best<2> best = best_posture(grasp, random_settings());
  const auto maximum = std::find_if(best.proof.curve.optima.begin(), best.proof.curve.optima.end(),
                                    [](const Optimum& o) { return o.maximum; });
  RC_ASSERT(best.minima.size() ==
            static_cast<std::size_t>(maximum - best.proof.curve.optima.begin()));
  for (std::size_t i = 0; i < best.minima.size(); ++i)
    RC_ASSERT(best.minima[i].optimum.angle == best.proof.curve.optima[i].angle);
  RC_ASSERT(best.proof.worst.has_value() == (maximum != best.proof.curve.optima.end()));
  if (best.proof.worst) RC_ASSERT(best.proof.worst->optimum.angle == maximum->angle);
}

RC_GTEST_PROP(BestPosture, PinchedIsTheLowestInteriorMinimumThatIs, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const Best<2> best = best_posture(grasp, random_settings());
  const Minimum<2>* expected = nullptr;
  for (const Minimum<2>& minimum : best.minima)
    if (!expected && minimum.manner == Manner::pinched && minimum.optimum.kind != Kind::boundary)
      expected = &minimum;
  RC_ASSERT(best.best_pinched() == expected);
}

RC_GTEST_PROP(BestPosture, EdgesMeetOnTheVerticalThroughTheCom, ()) {
  const Held held = *grasps({.most_contacts = 3, .awkward = false});
  const Grasp<2> grasp = held.grasp();
  for (const Minimum<2>& minimum : best_posture(grasp).minima) {
    RC_ASSERT(!minimum.edges_meet || minimum.two_slipping);
    if (!minimum.edges_meet || !moderate(grasp, minimum.optimum.value)) continue;
    RC_ASSERT(minimum.optimum.kind == Kind::kink);
    const Vector<2> arm = *minimum.edges_meet - held.object.com, up = up_at(minimum.optimum.angle);
    const double lost = 1 + arm.norm();  // a far point is only as exact as the edges' directions
    RC_ASSERT(std::abs(arm.x() * up.y() - arm.y() * up.x()) <= 1e-6 * lost * lost);
  }
}

TEST(BestPosture, OfNothingHoldableIsEmpty) {
  Contact<2> pulling;
  pulling.position = {1, 0};
  pulling.normal = {0, 1};
  const Best<2> best = best_posture(Grasp<2>({1, {0, 0}}, {pulling}));
  EXPECT_FALSE(best.holdable());
  EXPECT_FALSE(best.proof.worst);
  EXPECT_FALSE(best.best_pinched());
  EXPECT_FALSE(best.proof.curve.unholdable_arcs.empty());
}

TEST(BestPosture, EdgesThatAreParallelDoNotMeet) {
  // Two forks of equal cones, both slipping along +y on the same side.
  Contact<2> left, right;
  left.position = {-1, 0};
  right.position = {1, 0};
  left.normal = right.normal = {0, 1};
  left.friction = right.friction = 0.5;
  for (const Minimum<2>& minimum : best_posture(Grasp<2>({1, {0, 0}}, {left, right})).minima)
    EXPECT_FALSE(minimum.edges_meet);
}

}  // namespace
}  // namespace poise::test
