// The solver on the paper's disk, against the paper's formulas and values: docs/paper.md.
#include <gtest/gtest.h>

#include "apps/paper/exact.hpp"
#include "checks.hpp"
#include "paper_disks.hpp"
#include "poise/best_posture.hpp"
#include "random_grasps.hpp"

namespace poise::test {
namespace {

using study::grasp_of;
using study::HeldDisk;

const Optimum* minimum_at(const PostureCurve& curve, double theta) {
  for (const Optimum& optimum : curve.optima)
    if (!optimum.maximum && std::abs(std::remainder(optimum.angle - theta, 2 * pi)) < 1e-9)
      return &optimum;
  return nullptr;
}

TEST(Paper, TableOfOptimaIsReproduced) {
  for (const PaperRow& row : paper_table) {
    const HeldDisk& disk = row.disk;
    const double theta_b = row.theta_b_deg * pi / 180, end = disk.range();
    EXPECT_NEAR(study::theta_b(disk), theta_b, 1e-12);
    EXPECT_NEAR(alpha_bar(disk, theta_b), row.alpha_b, 5e-5);

    const Best<2> best = best_posture(grasp_of(disk), {.domain = Domain::pinching_up});
    ASSERT_EQ(best.minima.size(), 3U);
    for (const double at : {-end, end}) {  // a and c
      const Optimum* optimum = minimum_at(best.proof.curve, at);
      ASSERT_TRUE(optimum);
      EXPECT_NEAR(optimum->value, 100, 1e-7);
      EXPECT_EQ(optimum->kind, Kind::boundary);
    }
    const Optimum* b = minimum_at(best.proof.curve, theta_b);
    ASSERT_TRUE(b);
    EXPECT_NEAR(b->value, row.V_b, row.rounding + 1e-9 * row.V_b);
    EXPECT_EQ(b->kind, Kind::kink);

    ASSERT_TRUE(best.best_pinched());
    const Minimum<2>& pinched = *best.best_pinched();
    EXPECT_NEAR(pinched.optimum.angle, theta_b, 1e-9);
    EXPECT_EQ(pinched.manner, Manner::pinched);
    // The internal force is the part of the forces along F_N: along +x at the left contact.
    const auto fingers = finger_forces(grasp_of(disk), pinched.hold());
    EXPECT_NEAR((fingers[1].force.x() - fingers[0].force.x()) / std::sqrt(2), row.alpha_b, 5e-5);
  }
}

TEST(Paper, OrderOfEqualMinimaIsPositiveFirst) {
  const Best<2> best = best_posture(grasp_of(paper_table[5].disk), {.domain = Domain::pinching_up});
  EXPECT_NEAR(best.best().optimum.angle, 105 * pi / 180, 1e-12);
  EXPECT_NEAR(best.minima[1].optimum.angle, -105 * pi / 180, 1e-12);
}

TEST(Paper, EndsOfTheRangeRestOnOneFinger) {
  const Best<2> best = best_posture(grasp_of(paper_table[5].disk), {.domain = Domain::pinching_up});
  EXPECT_EQ(best.best().manner, Manner::resting);
  EXPECT_FALSE(all_loaded(grasp_of(paper_table[5].disk), best.best().hold(),
                          grasp_of(paper_table[5].disk).size()));
}

TEST(Paper, ConeEdgesMeetOnTheVerticalThroughTheComAtB) {
  for (const PaperRow& row : paper_table) {
    const Best<2> best = best_posture(grasp_of(row.disk), {.domain = Domain::pinching_up});
    ASSERT_TRUE(best.best_pinched() && best.best_pinched()->edges_meet);
    const Vector<2> point = *best.best_pinched()->edges_meet;
    EXPECT_NEAR(std::atan2(point.x(), point.y()), row.theta_b_deg * pi / 180, 1e-8);
    // For equal friction, by similar triangles: cos phi + sin phi (s mu - c) / (s + mu c).
    const HeldDisk& d = row.disk;
    if (d.mu1 == d.mu2) {
      EXPECT_NEAR(point.y(), d.c() + d.s() * d.d1() / (d.s() + d.mu1 * d.c()), 1e-8);
    }
  }
}

// Finding 3.
TEST(Paper, Figure4cIsHeldAtTwoPosturesOnly) {
  const Grasp<2> grasp = grasp_of({.phi = pi / 4, .mu1 = 1, .mu2 = 1});
  const Best<2> best = best_posture(grasp, {.domain = Domain::pinching_up});
  ASSERT_EQ(best.minima.size(), 2U);
  EXPECT_NEAR(best.minima[0].optimum.angle, 0.75 * pi, 1e-12);
  EXPECT_NEAR(best.minima[1].optimum.angle, -0.75 * pi, 1e-12);
  for (const Minimum<2>& minimum : best.minima) {
    EXPECT_NEAR(minimum.optimum.value, 100, 1e-9);
    EXPECT_EQ(minimum.optimum.kind, Kind::boundary);
    EXPECT_EQ(minimum.manner, Manner::resting);
  }
  EXPECT_FALSE(best.best_pinched());
  ASSERT_EQ(best.proof.curve.holdable.size(), 2U);
  for (const Interval& point : best.proof.curve.holdable) EXPECT_EQ(point.from, point.to);
  EXPECT_FALSE(hold(grasp, up_at(pi / 9)).holdable);
}

// Finding 7.
TEST(Paper, Figure6IsHeldWithLessInTheForkOfTheFingers) {
  const Best<2> best = best_posture(grasp_of(paper_table[5].disk));
  EXPECT_NEAR(best.best().optimum.angle, 165 * pi / 180, 1e-12);
  EXPECT_NEAR(best.best().optimum.value, 80.3848, 5e-5);
  EXPECT_EQ(best.best().manner, Manner::cradled);
  EXPECT_NE(best.best().optimum.kind, Kind::boundary);
  ASSERT_TRUE(best.best_pinched());
  EXPECT_NEAR(best.best_pinched()->optimum.angle, pi / 6, 1e-12);
  EXPECT_NEAR(best.best_pinched()->optimum.value, 300, 1e-9);
}

/// Friction above the limit cot phi by a factor of ten thousand up to ten.
HeldDisk random_disk() {
  HeldDisk disk{.phi = real(0.3, pi / 2)};
  const double least = disk.c() / disk.s();
  disk.mu1 = least + std::pow(10, real(1, -2));
  disk.mu2 = least + std::pow(10, real(1, -2));
  return disk;
}

RC_GTEST_PROP(Paper, CurveOfThePinchingRangeIsTheClosedForm, ()) {
  const HeldDisk disk = random_disk();
  const PostureCurve curve = posture_curve(grasp_of(disk), {.domain = Domain::pinching_up});
  RC_ASSERT(std::abs(curve.domain.to - (pi - disk.phi)) < 1e-12);
  for (int i = 0; i < 5; ++i) {
    const double theta = (pi - disk.phi) * 0.999 * coordinate();
    if (V(disk, theta) > 1e6 * disk.weight * disk.weight) continue;
    const auto arc = std::find_if(curve.arcs.begin(), curve.arcs.end(),
                                  [&](const Arc& a) { return a.from <= theta && theta <= a.to; });
    RC_ASSERT(arc != curve.arcs.end());
    RC_ASSERT(close(arc->value(theta), V(disk, theta), 1e-9L, rounding(*arc)));
  }
}

// Findings 4 and 6.
RC_GTEST_PROP(Paper, BIsAMinimumWhereTheSlopesDifferInSign, ()) {
  const HeldDisk disk = random_disk();
  const double b = theta_b(disk), step = 1e-6;
  RC_ASSERT(std::abs(alphas(disk, b)[4] - alphas(disk, b)[5]) <=
            1e-9 * (alpha_bar(disk, b) + disk.weight));
  const PostureCurve curve = posture_curve(grasp_of(disk), {.domain = Domain::pinching_up});
  const double before = V(disk, b) - V(disk, b - step), after = V(disk, b + step) - V(disk, b);
  if (std::abs(before) < 1e-3 * step * V(disk, b) || std::abs(after) < 1e-3 * step * V(disk, b))
    return;  // flat: the optimum may be smooth, nearby
  const Optimum* optimum = minimum_at(curve, b);
  RC_ASSERT((optimum != nullptr) == (before < 0 && after > 0));
  if (!optimum) return;
  RC_ASSERT(optimum->kind == Kind::kink);
  RC_ASSERT(close(optimum->value, V(disk, b), 1e-9L, rounding(curve, b)));
}

}  // namespace
}  // namespace poise::test
