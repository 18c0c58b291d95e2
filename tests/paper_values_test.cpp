// The disk between two fingers of Ito et al.: closed forms and values, DESIGN 2.1.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "checks.hpp"
#include "poise/best_posture.hpp"
#include "random_grasps.hpp"

namespace poise::test {
namespace {

/// Radius 1; contact 1 at +phi from +y, so on the right, contact 2 at -phi.
struct Disk {
  double phi, mu1, mu2, weight{10};

  double s() const { return std::sin(phi); }
  double c() const { return std::cos(phi); }
  double d1() const { return mu1 * s() - c(); }
  double d2() const { return mu2 * s() - c(); }

  Grasp<2> grasp() const {
    Contact<2> right, left;
    right.position = {s(), c()};
    left.position = {-s(), c()};
    right.normal = -right.position;
    left.normal = -left.position;
    right.friction = mu1;
    left.friction = mu2;
    return Grasp<2>({weight, {0, 0}}, {right, left});
  }

  /// The least squared force without internal force.
  double particular(double theta) const {
    const double x = std::sin(theta), y = std::cos(theta), cot = c() / s();
    return weight * weight / 2 * (x * x + y * y + cot * cot * x * x);
  }
  /// The bounds on the internal force from the friction of contact 1 and of contact 2.
  double alpha5(double theta) const {
    const double x = std::sin(theta), y = std::cos(theta);
    return weight / std::sqrt(2) * (x + (y + x * c() / s()) * (s() + mu1 * c()) / d1());
  }
  double alpha6(double theta) const {
    const double x = std::sin(theta), y = std::cos(theta);
    return weight / std::sqrt(2) * (-x + (y - x * c() / s()) * (s() + mu2 * c()) / d2());
  }
  double alpha(double theta) const { return std::max(alpha5(theta), alpha6(theta)); }
  double V(double theta) const { return particular(theta) + alpha(theta) * alpha(theta); }

  /// Where alpha5 and alpha6 are equal: b.
  double theta_b() const {
    const double A = s() * (s() + mu1 * c()) / d1() - s() * (s() + mu2 * c()) / d2();
    const double B = mu1 / d1() + mu2 / d2();
    return std::atan2(-A, B);
  }
};

const Optimum* minimum_at(const PostureCurve& curve, double theta) {
  for (const Optimum& optimum : curve.optima)
    if (!optimum.maximum && std::abs(std::remainder(optimum.angle - theta, 2 * pi)) < 1e-9)
      return &optimum;
  return nullptr;
}

struct Row {
  Disk disk;
  double theta_b_deg, alpha_b, V_b;
  int digits_of_V;
};

const double root3 = std::sqrt(3);
const std::vector<Row> table{
    {{pi / 3, root3, root3}, 0, 12.2474, 200, 10},
    {{pi / 3, 1, 1}, 0, 26.3896, 746.4102, 4},
    {{pi / 3, 1 / root3 + 0.01, 1 / root3 + 0.01}, 0, 946.8915, 896653.56, 2},
    {{5 * pi / 12, 1, 1}, 0, 12.2474, 200, 10},
    {{pi / 4, 1.01, 1.01}, 0, 1421.2846, 2020100, 2},
    {{5 * pi / 12, 1, 1 / root3}, 30, 15.7830, 300, 10},
};

TEST(Paper, TableOfOptimaIsReproduced) {
  for (const Row& row : table) {
    const Disk& disk = row.disk;
    const double theta_b = row.theta_b_deg * pi / 180, end = pi - disk.phi;
    EXPECT_NEAR(disk.theta_b(), theta_b, 1e-12);
    EXPECT_NEAR(disk.alpha(theta_b), row.alpha_b, 5e-5);

    const BestPosture best = best_posture(disk.grasp(), {.domain = Domain::pinched});
    ASSERT_EQ(best.minima.size(), 3U);
    for (const double at : {-end, end}) {  // a and c
      const Optimum* optimum = minimum_at(best.curve, at);
      ASSERT_TRUE(optimum);
      EXPECT_NEAR(optimum->effort, 100, 1e-7);
      EXPECT_EQ(optimum->kind, Kind::boundary);
    }
    const Optimum* b = minimum_at(best.curve, theta_b);
    ASSERT_TRUE(b);
    EXPECT_NEAR(b->effort, row.V_b, 0.5 * std::pow(10, -row.digits_of_V) + 1e-9 * row.V_b);
    EXPECT_EQ(b->kind, Kind::kink);

    ASSERT_TRUE(best.best_pinched());
    const PlanarPosture& pinched = *best.best_pinched();
    EXPECT_NEAR(pinched.optimum.angle, theta_b, 1e-9);
    EXPECT_EQ(pinched.manner, Manner::pinched);
    // The internal force is the part of the forces along F_N: along +x at the left contact.
    const auto fingers = finger_forces(disk.grasp(), pinched.hold);
    EXPECT_NEAR((fingers[1].force.x() - fingers[0].force.x()) / std::sqrt(2), row.alpha_b, 5e-5);
  }
}

TEST(Paper, OrderOfEqualMinimaIsPositiveFirst) {
  const BestPosture best = best_posture(table[5].disk.grasp(), {.domain = Domain::pinched});
  EXPECT_NEAR(best.best().optimum.angle, 105 * pi / 180, 1e-12);
  EXPECT_NEAR(best.minima[1].optimum.angle, -105 * pi / 180, 1e-12);
}

TEST(Paper, EndsOfTheRangeRestOnOneFinger) {
  const BestPosture best = best_posture(table[5].disk.grasp(), {.domain = Domain::pinched});
  EXPECT_EQ(best.best().manner, Manner::resting);
  EXPECT_FALSE(all_loaded(table[5].disk.grasp(), best.best().hold));
}

TEST(Paper, ConeEdgesMeetOnTheVerticalThroughTheComAtB) {
  for (const Row& row : table) {
    const BestPosture best = best_posture(row.disk.grasp(), {.domain = Domain::pinched});
    ASSERT_TRUE(best.best_pinched() && best.best_pinched()->edges_meet);
    const Vector<2> point = *best.best_pinched()->edges_meet;
    EXPECT_NEAR(std::atan2(point.x(), point.y()), row.theta_b_deg * pi / 180, 1e-8);
    // For equal friction, by similar triangles: cos phi + sin phi (s mu - c) / (s + mu c).
    const Disk& d = row.disk;
    if (d.mu1 == d.mu2) {
      EXPECT_NEAR(point.y(), d.c() + d.s() * d.d1() / (d.s() + d.mu1 * d.c()), 1e-8);
    }
  }
}

// Finding 3.
TEST(Paper, Figure4cIsHeldAtTwoPosturesOnly) {
  const Grasp<2> grasp = Disk{pi / 4, 1, 1}.grasp();
  const BestPosture best = best_posture(grasp, {.domain = Domain::pinched});
  ASSERT_EQ(best.minima.size(), 2U);
  EXPECT_NEAR(best.minima[0].optimum.angle, 0.75 * pi, 1e-12);
  EXPECT_NEAR(best.minima[1].optimum.angle, -0.75 * pi, 1e-12);
  for (const PlanarPosture& minimum : best.minima) {
    EXPECT_NEAR(minimum.optimum.effort, 100, 1e-9);
    EXPECT_EQ(minimum.optimum.kind, Kind::boundary);
    EXPECT_EQ(minimum.manner, Manner::resting);
  }
  EXPECT_FALSE(best.best_pinched());
  ASSERT_EQ(best.curve.holdable.size(), 2U);
  for (const Interval& point : best.curve.holdable) EXPECT_EQ(point.from, point.to);
  EXPECT_FALSE(hold(grasp, up_at(pi / 9)).holdable);
}

// Finding 7.
TEST(Paper, Figure6IsHeldWithLessInTheForkOfTheFingers) {
  const BestPosture best = best_posture(table[5].disk.grasp());
  EXPECT_NEAR(best.best().optimum.angle, 165 * pi / 180, 1e-12);
  EXPECT_NEAR(best.best().optimum.effort, 80.3848, 5e-5);
  EXPECT_EQ(best.best().manner, Manner::cradled);
  EXPECT_NE(best.best().optimum.kind, Kind::boundary);
  ASSERT_TRUE(best.best_pinched());
  EXPECT_NEAR(best.best_pinched()->optimum.angle, pi / 6, 1e-12);
  EXPECT_NEAR(best.best_pinched()->optimum.effort, 300, 1e-9);
}

// Finding 1: with the minus sign that (22) and (23) lack, F1 and F2 vanish.
TEST(Paper, TangentialForcesVanishAtTheCorrectedBounds) {
  const Disk disk{5 * pi / 12, 1, 1};
  const auto G = grasp_matrix(disk.grasp());
  for (const double theta : {-0.5, 0.0, 0.8}) {
    const Eigen::VectorXd w = disk.grasp().load(up_at(theta));
    const Eigen::VectorXd least = G.transpose() * (G * G.transpose()).inverse() * w;
    Eigen::VectorXd internal(4);  // each contact pushed towards the other: (-x, +x) / sqrt(2)
    internal << disk.s(), -disk.c(), disk.s(), disk.c();
    internal /= std::sqrt(2);
    EXPECT_NEAR((G * internal).norm(), 0, 1e-15);
    const double alpha3 = -disk.weight * disk.s() * std::cos(theta) / (std::sqrt(2) * disk.c());
    const Eigen::VectorXd forces = least + alpha3 * internal;
    EXPECT_NEAR(forces[1], 0, 1e-12);
    EXPECT_NEAR(forces[3], 0, 1e-12);
  }
}

/// Friction above the limit cot phi by a factor of ten thousand up to ten.
Disk random_disk() {
  Disk disk{real(0.3, pi / 2), 0, 0};
  const double least = disk.c() / disk.s();
  disk.mu1 = least + std::pow(10, real(1, -2));
  disk.mu2 = least + std::pow(10, real(1, -2));
  return disk;
}

RC_GTEST_PROP(Paper, CurveOfThePinchingRangeIsTheClosedForm, ()) {
  const Disk disk = random_disk();
  const PostureCurve curve = posture_curve(disk.grasp(), {.domain = Domain::pinched});
  RC_ASSERT(std::abs(curve.domain.to - (pi - disk.phi)) < 1e-12);
  for (int i = 0; i < 5; ++i) {
    const double theta = (pi - disk.phi) * 0.999 * coordinate();
    if (disk.V(theta) > 1e6 * disk.weight * disk.weight) continue;
    const auto arc = std::find_if(curve.arcs.begin(), curve.arcs.end(),
                                  [&](const Arc& a) { return a.from <= theta && theta <= a.to; });
    RC_ASSERT(arc != curve.arcs.end());
    RC_ASSERT(close(arc->V(theta), disk.V(theta), 1e-9L, rounding(*arc)));
  }
}

// Findings 4 and 6.
RC_GTEST_PROP(Paper, BIsAMinimumWhereTheSlopesDifferInSign, ()) {
  const Disk disk = random_disk();
  const double b = disk.theta_b(), step = 1e-6;
  RC_ASSERT(std::abs(disk.alpha5(b) - disk.alpha6(b)) <= 1e-9 * (disk.alpha(b) + disk.weight));
  const PostureCurve curve = posture_curve(disk.grasp(), {.domain = Domain::pinched});
  const double before = disk.V(b) - disk.V(b - step), after = disk.V(b + step) - disk.V(b);
  if (std::abs(before) < 1e-3 * step * disk.V(b) || std::abs(after) < 1e-3 * step * disk.V(b))
    return;  // flat: the optimum may be smooth, nearby
  const Optimum* optimum = minimum_at(curve, b);
  RC_ASSERT((optimum != nullptr) == (before < 0 && after > 0));
  if (!optimum) return;
  RC_ASSERT(optimum->kind == Kind::kink);
  RC_ASSERT(close(optimum->effort, disk.V(b), 1e-9L, rounding(curve, b)));
}

}  // namespace
}  // namespace poise::test
