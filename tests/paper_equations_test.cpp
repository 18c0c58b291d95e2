// The paper's equations, against plain linear algebra and against the solver: docs/paper.md.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "apps/paper/disk.hpp"
#include "apps/paper/sampling.hpp"
#include "apps/paper/two_contacts.hpp"
#include "paper_disks.hpp"
#include "poise/hold.hpp"

namespace poise::study {
namespace {

const double root2 = std::sqrt(2.0);
const std::vector<HeldDisk> disks = [] {
  std::vector<HeldDisk> list;
  for (const test::PaperRow& row : test::paper_table) list.push_back(row.disk);
  list.back().radius = 0.2;  // no force depends on it
  return list;
}();
const std::vector<double> postures{-1.7, -1, -0.3, 0, 0.2, 0.9, 1.8};

/// The paper's forces as the library counts them: normal, tangential of contact 1, then of 2.
Eigen::Vector4d in_library_signs(const Forces& f) { return {f.N1, -f.F1, f.N2, f.F2}; }

TEST(PaperEquations, GraspMatrixAndLoadAreTheLibrarys) {
  for (const HeldDisk& disk : disks) {
    const auto G = poise::grasp_matrix(grasp_of(disk));
    const Forces f{.N1 = 1, .F1 = 2, .N2 = 3, .F2 = 5};
    EXPECT_NEAR((grasp_matrix(disk) * f.vector() - G * in_library_signs(f)).norm(), 0, 1e-14);
    for (const double theta : postures)
      EXPECT_NEAR((load(disk, theta) - grasp_of(disk).loads().front().at(up_at(theta))).norm(), 0,
                  1e-13);
  }
}

TEST(PaperEquations, LeastNormAndInternalForces) {
  for (const HeldDisk& disk : disks) {
    const auto G = grasp_matrix(disk);
    const Eigen::Matrix3d GGt = G * G.transpose();
    const Eigen::Vector4d N = F_N(disk).vector();
    EXPECT_NEAR((G * N).norm(), 0, 1e-15);
    EXPECT_NEAR(N.norm(), 1, 1e-15);
    for (const double theta : postures) {
      const Eigen::Vector4d T = F_T(disk, theta).vector();
      const Eigen::Vector4d least = G.transpose() * (GGt.inverse() * load(disk, theta));
      EXPECT_NEAR((T - least).norm(), 0, 1e-12);
      EXPECT_NEAR(T.dot(N), 0, 1e-13);
      const Eigen::Vector4d F = forces(disk, theta, 7).vector();
      EXPECT_NEAR((G * F - load(disk, theta)).norm(), 0, 1e-13);
      EXPECT_NEAR(F.squaredNorm(), V(disk, theta, 7), 1e-12);
    }
  }
}

TEST(PaperEquations, EachBoundIsWhereItsConditionBegins) {
  for (const HeldDisk& disk : disks)
    for (const double theta : postures) {
      const std::array<double, 6> bounds = alphas(disk, theta);
      for (std::size_t k = 0; k < 6; ++k) {
        const double rounding = 1e-13 * (10 + std::abs(bounds[k]));
        EXPECT_NEAR(conditions(disk, forces(disk, theta, bounds[k]))[k], 0, rounding);
        EXPECT_GT(conditions(disk, forces(disk, theta, bounds[k] + 1))[k], 0);
        EXPECT_LT(conditions(disk, forces(disk, theta, bounds[k] - 1))[k], 0);
      }
    }
}

// Finding 1: (22) and (23) as they are printed, without the minus sign, leave F1 = F2 = Mg s cos.
TEST(PaperEquations, PrintedBoundsOfTheTangentialForcesLackASign) {
  const HeldDisk& disk = disks[3];
  const double printed = disk.weight * disk.s() / (root2 * disk.c());
  EXPECT_NEAR(alphas(disk, 0)[2], -printed, 1e-12);
  EXPECT_NEAR(forces(disk, 0, -printed).F1, 0, 1e-12);
  EXPECT_NEAR(forces(disk, 0, printed).F1, 10 * std::sin(5 * pi / 12), 1e-12);
}

TEST(PaperEquations, InTheRangeTheFrictionBoundsDecideAndAreNotNegative) {
  for (const HeldDisk& disk : disks)
    for (int k = -99; k <= 99; ++k) {
      const double theta = disk.range() * k / 100;
      const std::array<double, 6> bounds = alphas(disk, theta);
      EXPECT_EQ(alpha_bar(disk, theta), std::max(bounds[4], bounds[5]));
      EXPECT_GE(alpha_bar(disk, theta), 0);
    }
}

TEST(PaperEquations, ForcesAreTheSolversInTheRange) {
  for (const HeldDisk& disk : disks)
    for (const double theta : postures) {
      if (std::abs(theta) > disk.range()) continue;
      const Hold<2> least = hold(grasp_of(disk), up_at(theta));
      ASSERT_TRUE(least.holdable);
      EXPECT_NEAR(least.effort / V(disk, theta), 1, 1e-9);
      const Eigen::Vector4d F = in_library_signs(forces(disk, theta, alpha_bar(disk, theta)));
      const double rounding = 1e-9 * F.norm();
      EXPECT_NEAR(least.forces[0].normal, F[0], rounding);
      EXPECT_NEAR(least.forces[0].tangential, F[1], rounding);
      EXPECT_NEAR(least.forces[1].normal, F[2], rounding);
      EXPECT_NEAR(least.forces[1].tangential, F[3], rounding);
    }
}

// The data of Figs. 3 to 6: equal frictions mirror each other, exchanged frictions the curves.
TEST(PaperEquations, ExchangingTheContactsMirrorsTheCurves) {
  for (const HeldDisk& disk : disks) {
    HeldDisk mirrored = disk;
    std::swap(mirrored.mu1, mirrored.mu2);
    for (const double theta : postures) {
      const auto here = alphas(disk, theta), there = alphas(mirrored, -theta);
      for (const std::size_t k : {0U, 2U, 4U}) EXPECT_NEAR(here[k], there[k + 1], 1e-10);
      for (const std::size_t k : {1U, 3U, 5U}) EXPECT_NEAR(here[k], there[k - 1], 1e-10);
    }
  }
}

// Finding 3, Fig. 4(c): no finite value at any posture; a little more friction has one.
TEST(PaperEquations, Figure4cHasNoFiniteBound) {
  const HeldDisk disk{.phi = pi / 4, .mu1 = 1, .mu2 = 1};
  EXPECT_EQ(disk.d1(), 0);
  for (const double theta : postures) EXPECT_TRUE(std::isinf(alpha_bar(disk, theta)));
  EXPECT_NEAR(alpha_bar(disks[4], 0), 1421.2846, 5e-5);
}

/// Any two contacts on any object.
struct Random {
  std::mt19937_64 bits{20};
  double operator()(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(bits);
  }
  Grasp<2> grasp() {
    const auto contact = [this] {
      Contact<2> result;
      result.position = {(*this)(-1, 1), (*this)(-1, 1)};
      result.normal = up_at((*this)(-pi, pi));
      result.friction = (*this)(0.05, 2);
      return result;
    };
    const Contact<2> one = contact(), two = contact();
    return Grasp<2>({(*this)(1, 20), {(*this)(-1, 1), (*this)(-1, 1)}}, {one, two});
  }
};

// The previous analysis, for any planar object as the authors claim.
TEST(PreviousAnalysis, BestIsTheMidpointOnTheVerticalThroughTheCom) {
  Random random;
  for (int k = 0; k < 2000; ++k) {
    const Grasp<2> grasp = random.grasp();
    const double W = grasp.size(), best = best_without_friction(grasp);
    // By hand: V = W^2/2 (1 + (offset / half distance)^2), offset of the midpoint to the vertical.
    const Vector<2> p1 = grasp.contacts()[0].position, p2 = grasp.contacts()[1].position;
    const Vector<2> arm = (p1 + p2) / 2 - grasp.center();
    const double half = (p2 - p1).norm() / 2, least = effort_without_friction(grasp, best);
    EXPECT_NEAR(least / (W * W), 0.5, 1e-9);
    EXPECT_NEAR(effort_without_friction(grasp, best + pi) / (W * W), 0.5, 1e-9);
    for (int j = 0; j < 20; ++j) {
      const double theta = random(-pi, pi);
      const double offset = arm.dot(Vector<2>(std::cos(theta), -std::sin(theta)));
      const double by_hand = W * W / 2 * (1 + offset * offset / (half * half));
      EXPECT_NEAR(effort_without_friction(grasp, theta) / by_hand, 1, 1e-9);
      EXPECT_GE(effort_without_friction(grasp, theta), least * (1 - 1e-12));
    }
  }
}

TEST(PreviousAnalysis, IsThePapersForTheDisk) {
  for (const HeldDisk& disk : disks) {
    EXPECT_NEAR(best_without_friction(grasp_of(disk)), 0, 1e-15);
    for (const double theta : postures)
      EXPECT_NEAR(effort_without_friction(grasp_of(disk), theta), V(disk, theta, 0), 1e-11);
  }
}

// Where both contacts slip: balance and cones, checked without asking how it was found.
TEST(TwoContacts, BothSlipWhereTheEdgesMeetOnTheVertical) {
  Random random;
  int found = 0;
  for (int k = 0; k < 2000; ++k) {
    const Grasp<2> grasp = random.grasp();
    for (const BothSlip& posture : both_slip(grasp)) {
      ++found;
      const Vector<2> up = up_at(posture.theta), arm = posture.meet - grasp.center();
      EXPECT_NEAR(arm.x() * up.y() - arm.y() * up.x(), 0, 1e-9 * arm.norm());
      const Hold<2> least = hold(grasp, up);
      ASSERT_TRUE(least.holdable || !least.proven);
      if (least.holdable) {
        EXPECT_LE(least.effort, posture.effort * (1 + 1e-9));
      }
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(Sampling, TheTwoSamplesBesideBAreWhatAllSamplesFind) {
  const HeldDisk& disk = disks[5];
  for (std::size_t n = 40; n < 1000; n += 7) {
    const auto found = sampled_minimum(disk, n);
    ASSERT_TRUE(found);
    const SamplingError error = sampling_error(disk, n);
    EXPECT_NEAR(std::abs(found->theta - pi / 6), error.theta, 1e-12);
    EXPECT_NEAR(found->V / 300 - 1, error.V, 1e-12);
  }
}

TEST(Sampling, ToleranceIsKeptFromTheNumberOfSamplesOn) {
  for (const HeldDisk& disk : disks) {
    const double tolerance = 1e-3;
    const SamplesNeeded needed = samples_needed(disk, tolerance);
    EXPECT_GT(sampling_error(disk, needed.theta - 1).theta, tolerance);
    EXPECT_GT(sampling_error(disk, needed.V - 1).V, tolerance);
    for (std::size_t n = needed.theta; n < 3 * needed.theta; ++n)
      ASSERT_LE(sampling_error(disk, n).theta, tolerance);
    for (std::size_t n = needed.V; n < 3 * needed.V; ++n)
      ASSERT_LE(sampling_error(disk, n).V, tolerance);
    // At a kink the error falls no faster than the step.
    const SamplesNeeded finer = samples_needed(disk, tolerance / 1000);
    EXPECT_NEAR(static_cast<double>(finer.V) / static_cast<double>(needed.V), 1000, 60);
  }
}

}  // namespace
}  // namespace poise::study
