// The paper's disk in closed form, against the general solver and against plain search.
#include <gtest/gtest.h>

#include <random>

#include "apps/paper/counts.hpp"
#include "apps/paper/exact.hpp"
#include "apps/paper/two_contacts.hpp"
#include "paper_disks.hpp"
#include "poise/best_posture.hpp"

namespace poise::study {
namespace {

using test::paper_table;
using test::root3;

struct Random {
  std::mt19937_64 bits{20};
  double operator()(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(bits);
  }
  /// Friction above the limit cot(phi), by 0.001 up to 10.
  double enough(double phi) { return 1 / std::tan(phi) + std::pow(10, (*this)(-3, 1)); }
  HeldDisk squeezed() {
    HeldDisk disk{.phi = (*this)(0.3, pi / 2)};
    disk.mu1 = enough(disk.phi);
    disk.mu2 = enough(disk.phi);
    return disk;
  }
  /// One friction in three is too little to squeeze.
  HeldDisk any() {
    HeldDisk disk = squeezed();
    for (double* const mu : {&disk.mu1, &disk.mu2})
      if ((*this)(0, 3) < 1) *mu = (*this)(0, 1) / std::tan(disk.phi);
    return disk;
  }
};

TEST(PaperExact, MinimaOfTheSixParameterSets) {
  for (const test::PaperRow& row : paper_table) {
    const std::vector<Minimum> found = minima(row.disk);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].theta, -row.disk.range());
    EXPECT_NEAR(found[0].V, 100, 1e-12);
    EXPECT_EQ(found[1].name, 'b');
    EXPECT_EQ(found[1].kind, Kind::kink);
    EXPECT_NEAR(found[1].theta * 180 / pi, row.theta_b_deg, 1e-12);
    EXPECT_NEAR(found[1].V, row.V_b, row.rounding);
    EXPECT_NEAR(alpha_bar(row.disk, found[1].theta), row.alpha_b, 5e-5);
    EXPECT_EQ(found[2].theta, row.disk.range());
    EXPECT_NEAR(found[2].V, 100, 1e-12);
  }
}

// Finding 2: with the paper's 2 phi = pi/3 its frictions could not squeeze the disk.
TEST(PaperExact, TheLimitOfFrictionFitsPhiAndNotTwicePhi) {
  const HeldDisk as_drawn{.phi = pi / 3, .mu1 = 1 / root3, .mu2 = 1 / root3};
  EXPECT_EQ(as_drawn.d1(), 0);  // so 1/sqrt(3) + 0.01 is just enough
  for (const double mu : {root3, 1.0, 1 / root3 + 0.01}) {
    const HeldDisk as_written{.phi = pi / 6, .mu1 = mu, .mu2 = mu};
    EXPECT_FALSE(as_written.can_be_squeezed());
    EXPECT_EQ(minima(as_written).size(), 2U);
  }
}

// Figs. 2 and 7: who carries what in a, b and c.
TEST(PaperExact, ForcesInTheThreePostures) {
  const HeldDisk& disk = paper_table[5].disk;
  const std::vector<Minimum> found = minima(disk);
  const auto at = [&](std::size_t k) { return forces(disk, found[k].theta, found[k].alpha); };
  // a and c: the contact under the centre of mass carries all.
  for (const auto& [k, loaded] : {std::pair(0, 0), std::pair(2, 2)}) {
    Eigen::Vector4d expected = Eigen::Vector4d::Zero();
    expected[loaded] = disk.weight;
    EXPECT_NEAR((at(static_cast<std::size_t>(k)).vector() - expected).norm(), 0, 1e-13);
  }
  // b: both slip. Contact 1, at 45 degrees, pushes level; contact 2, at 105, with root 2 as much.
  const Forces b = at(1);
  EXPECT_NEAR(b.F1, disk.mu1 * b.N1, 1e-13);
  EXPECT_NEAR(b.F2, disk.mu2 * b.N2, 1e-13);
  EXPECT_NEAR(std::hypot(b.N1, b.F1), 10, 1e-13);
  EXPECT_NEAR(std::hypot(b.N2, b.F2), 10 * std::sqrt(2.0), 1e-13);
  // So the edges meet straight above the centre of mass, as high as contact 1.
  const Vector<2> meet = edges_meet(disk);
  EXPECT_NEAR((meet - std::cos(pi / 4) * up_at(pi / 6)).norm(), 0, 1e-13);
}

// Findings 4 and 5.
TEST(PaperExact, ClosedFormsAreTheEquations) {
  Random random;
  for (int k = 0; k < 20000; ++k) {
    const HeldDisk disk = random.squeezed();
    const double b = theta_b(disk), most = alpha_bar(disk, b);
    const auto at_b = alphas(disk, b);
    EXPECT_NEAR(at_b[4] / at_b[5], 1, 1e-9);
    // The formula of docs/theory.md.
    const double s = disk.s(), c = disk.c(), mu1 = disk.mu1, mu2 = disk.mu2;
    const double A = s * (s + mu1 * c) / disk.d1() - s * (s + mu2 * c) / disk.d2();
    const double B = mu1 / disk.d1() + mu2 / disk.d2();
    EXPECT_NEAR(b, std::atan2(-A, B), 1e-9);
    const Vector<2> meet = edges_meet(disk);
    EXPECT_NEAR(angle_of(meet), b, 1e-9);
    for (int j = 0; j < 3; ++j) {
      const double theta = disk.range() * random(-1, 1);
      const double branch = theta > b ? V_5(disk)(theta) : V_6(disk)(theta);
      EXPECT_NEAR(branch, V(disk, theta), 1e-10 * (branch + most * most));
    }
  }
}

// Finding 6, and that nothing between a and c is ever a smooth minimum.
TEST(PaperExact, BIsAMinimumWhereTheQuadraticSaysSo) {
  Random random;
  for (int k = 0; k < 20000; ++k) {
    const HeldDisk disk = random.squeezed();
    const double b = theta_b(disk);
    const double after = V_5(disk).slope(b), before = V_6(disk).slope(b);
    const double steep = std::abs(after) + std::abs(before);
    if (std::min(std::abs(after), std::abs(before)) < 1e-9 * steep) continue;
    EXPECT_EQ(after > 0, rise_beyond_b(disk.phi, disk.mu1, disk.mu2) > 0);
    EXPECT_EQ(before<0, rise_beyond_b(disk.phi, disk.mu2, disk.mu1)> 0);
    EXPECT_EQ(after > 0, disk.mu2 > least_other_friction(disk.phi, disk.mu1));
    EXPECT_GT(rise_beyond_b(disk.phi, std::min(disk.mu1, disk.mu2), std::max(disk.mu1, disk.mu2)),
              0);
  }
}

TEST(PaperExact, SlopeVanishesOnTheBoundaryOfFinding6) {
  int inside = 0;
  for (const double phi : {pi / 3, 5 * pi / 12, 1.5})
    for (double u = -3; u <= 3; u += 0.01) {
      HeldDisk disk{.phi = phi, .mu1 = 1 / std::tan(phi) + std::pow(10, u)};
      disk.mu2 = least_other_friction(phi, disk.mu1);
      if (!disk.can_be_squeezed()) continue;
      ++inside;
      const Harmonic2 V = V_5(disk);
      EXPECT_NEAR(V.slope(theta_b(disk)) / (std::abs(V.cos2) + std::abs(V.sin2)), 0, 1e-9);
    }
  EXPECT_GT(inside, 300);
}

// For phi up to 45 degrees b is always a minimum.
TEST(PaperExact, NarrowGripsAlwaysHaveB) {
  Random random;
  for (int k = 0; k < 20000; ++k) {
    HeldDisk disk{.phi = random(0.05, pi / 4)};
    disk.mu1 = random.enough(disk.phi);
    disk.mu2 = random.enough(disk.phi);
    EXPECT_EQ(minima(disk).size(), 3U);
  }
}

TEST(PaperExact, CaseListIsTheGeneralSolver) {
  Random random;
  int undecided = 0;
  std::array<int, 3> cases{};
  for (int k = 0; k < 100000; ++k) {
    const HeldDisk disk = random.any();
    const Best<2> best = best_posture(grasp_of(disk), {.domain = Domain::pinching_up});
    std::vector<Optimum> found;
    for (const poise::Minimum<2>& posture : best.minima) found.push_back(posture.optimum);
    std::sort(found.begin(), found.end(),
              [](const Optimum& one, const Optimum& two) { return one.angle < two.angle; });
    const std::vector<Minimum> expected = minima(disk);
    // Where a slope beside b vanishes rounding decides whether b is a minimum.
    const double b = theta_b(disk);
    const Harmonic2 right = V_5(disk), left = V_6(disk);
    if ((disk.d1() > 0 && std::abs(right.slope(b)) < 1e-7 * right(b)) ||
        (disk.d2() > 0 && std::abs(left.slope(b)) < 1e-7 * left(b))) {
      ++undecided;
      continue;
    }
    ++cases[static_cast<std::size_t>(disk.d1() > 0) + static_cast<std::size_t>(disk.d2() > 0)];
    ASSERT_EQ(found.size(), expected.size())
        << "phi " << disk.phi << " mu " << disk.mu1 << " " << disk.mu2;
    for (std::size_t i = 0; i < found.size(); ++i) {
      // Where V is steep it is no more exact than the angle.
      const double at = expected[i].theta;
      const double steep = std::max(disk.d1() > 0 ? std::abs(right.slope(at)) : 0,
                                    disk.d2() > 0 ? std::abs(left.slope(at)) : 0);
      const double off = std::abs(found[i].angle - at);
      ASSERT_LT(off, 1e-8);
      ASSERT_NEAR(found[i].value, expected[i].V, 1e-9 * expected[i].V + (2 * off + 1e-12) * steep);
      ASSERT_EQ(found[i].kind, expected[i].kind);
    }
  }
  EXPECT_LT(undecided, 10);
  for (const int count : cases) EXPECT_GT(count, 5000);
}

// The theorem beyond the disk: a kink where both slip is one of the meeting points.
TEST(PaperTheorem, EveryKinkWithBothSlippingIsWhereEdgesMeet) {
  Random random;
  int kinks = 0;
  for (int k = 0; k < 3000; ++k) {
    const auto contact = [&] {
      Contact<2> result;
      result.position = {random(-1, 1), random(-1, 1)};
      result.normal = up_at(random(-pi, pi));
      result.friction = random(0.05, 2);
      return result;
    };
    const Contact<2> one = contact(), two = contact();
    const Grasp<2> grasp({1, {random(-1, 1), random(-1, 1)}}, {one, two});
    const std::vector<BothSlip> meetings = both_slip(grasp);
    for (const poise::Minimum<2>& minimum : best_posture(grasp).minima) {
      if (minimum.optimum.kind != Kind::kink || !minimum.two_slipping) continue;
      if (minimum.optimum.value > 1e6) continue;  // nearly parallel edges
      ++kinks;
      double nearest = 1;
      for (const BothSlip& meeting : meetings)
        nearest = std::min(nearest,
                           std::abs(std::remainder(meeting.theta - minimum.optimum.angle, 2 * pi)) +
                               std::abs(meeting.effort / minimum.optimum.value - 1));
      EXPECT_LT(nearest, 1e-6);
    }
  }
  EXPECT_GT(kinks, 500);
}

TEST(PaperCounts, AreTheSameInEveryRun) {
  const DiskCounts disks = count_disks(2000, 1);
  EXPECT_EQ(disks.b_is_no_minimum, count_disks(2000, 1).b_is_no_minimum);
  // Of 20,000 about 36 percent.
  EXPECT_NEAR(static_cast<double>(disks.b_is_no_minimum) / 2000, 0.36, 0.04);
  const EllipseCounts counts = count_ellipses(300, 0, 1);
  EXPECT_EQ(counts.unholdable + counts.kink + counts.end + counts.resting + counts.smooth, 300U);
  // The meeting point is not in general the best of all postures, but the best pinched one.
  EXPECT_LT(counts.kink, (300 - counts.unholdable) / 2);
  EXPECT_EQ(counts.pinched_where_edges_meet, counts.pinched);
}

}  // namespace
}  // namespace poise::study
