// Forces that are claimed to hold, replayed in a simulator that knows nothing of how they were
// found.
#include <Eigen/QR>

#include "physics/scene.hpp"
#include "poise/grip.hpp"
#include "poise/hold.hpp"
#include "random_space_grasps.hpp"

namespace poise::test::physics {
namespace {

using space::contact;
using space::Held;

/// What falls freely for so long moves by 0.2 m; with friction 1 in 1000 too weak by about 0.2 mm.
constexpr double seconds = 0.2, slipped = 1e-4;

std::vector<double> normal_forces(const Hold<3>& hold) {
  std::vector<double> normal;
  for (const ContactForce<3>& force : hold.forces) normal.push_back(force.normal);
  return normal;
}

/// How far the object moves [m] if the fingers press with these normal forces.
double moved(const Held& held, const Vector<3>& up, double friction,
             const std::vector<double>& normal) {
  return Scene(held.grasp(), up, normal, friction).moved(seconds);
}

void expect_just_enough(const Held& held, const Vector<3>& up) {
  const Hold<3> found = hold(held.grasp(), up);
  ASSERT_TRUE(found.holdable);
  for (const ContactForce<3>& force : found.forces) EXPECT_EQ(force.state, ContactState::slipping);
  EXPECT_LT(moved(held, up, 1.01, normal_forces(found)), slipped / 10);
  EXPECT_GT(moved(held, up, 0.99, normal_forces(found)), slipped * 10);
}

/// 10 N between two fingers, in the middle.
Held jaws() {
  return {{10, {0, 0, 0}},
          {contact({0.1, 0, 0}, {-1, 0, 0}, 0.5), contact({-0.1, 0, 0}, {1, 0, 0}, 0.5)}};
}

/// The same 2 cm beside the middle, where only soft fingers hold it.
Held soft_jaws_beside() {
  Held held = jaws();
  for (Contact<3>& c : held.contacts) c.torsion = 0.01;
  held.object.com = {0, 0.02, 0};
  return held;
}

Held three_round_a_cylinder() {
  Held held{{20, {0, 0, -0.05}}, {}};
  for (int k = 0; k < 3; ++k) {
    const double at = 2 * pi * k / 3;
    const Vector<3> out(std::cos(at), std::sin(at), 0);
    held.contacts.push_back(contact(0.04 * out, -out, 0.4));
  }
  return held;
}

TEST(Replay, OfJawsIsJustEnough) {
  expect_just_enough(jaws(), {0, 0.6, 0.8});
  expect_just_enough(soft_jaws_beside(), {0, 0, 1});
}

TEST(Replay, OfThreeFingersRoundACylinderIsJustEnough) {
  expect_just_enough(three_round_a_cylinder(), {0, 0, 1});
}

/// Pressed with 1.01 of the least grip it stays, with 0.98 of it it slips.
void expect_grip_just_enough(const Held& held, const Vector<3>& up) {
  const Hold<3> found = least_grip(held.grasp(), up);
  ASSERT_TRUE(found.holdable);
  const auto pressed = [&](double part) {
    std::vector<double> normal = normal_forces(found);
    for (double& force : normal) force *= part;
    return moved(held, up, 1, normal);
  };
  EXPECT_LT(pressed(1.01), slipped / 10);
  EXPECT_GT(pressed(0.98), slipped * 10);
}

TEST(Replay, OfTheLeastGripIsJustEnough) {
  expect_grip_just_enough(jaws(), {0, 0.6, 0.8});
  expect_grip_just_enough(soft_jaws_beside(), {0, 0, 1});
  expect_grip_just_enough(soft_jaws_beside(), {0, 0.6, 0.8});
  expect_grip_just_enough(three_round_a_cylinder(), {0, 0, 1});
}

/// The grasp in which each contact presses with the claimed normal force, no more and no less.
Held pressed(Held held, const std::vector<double>& normal, double friction) {
  for (std::size_t k = 0; k < normal.size(); ++k) {
    held.contacts[k].min_normal = held.contacts[k].max_normal = normal[k];
    held.contacts[k].friction *= friction;
    held.contacts[k].torsion *= friction;
  }
  return held;
}

// The forces claimed are held by 1.01 of the friction. With less of it, the same normal forces hold
// in the simulator if friction can still make up the balance: a hold between limits that are equal.
RC_GTEST_PROP(Replay, OfAnyGraspHoldsAsClaimed, ()) {
  if (!one_in(40)) return;
  const Held held = *space::grasps({.least_contacts = 2, .awkward = false});
  const Vector<3> up = space::random_direction();
  const Grasp<3> grasp = held.grasp();
  const Hold<3> found = one_in(2) && has_grip<3>(grasp) ? least_grip(grasp, up) : hold(grasp, up);
  if (!found.holdable || std::sqrt(found.effort) > 30 * held.object.weight) return;
  const std::vector<double> normal = normal_forces(found);
  RC_ASSERT(moved(held, up, 1.01, normal) < slipped);
  const double less = real(0.5, 1);
  const auto holds = [&](double friction) {
    return hold(pressed(held, normal, friction).grasp(), up).holdable;
  };
  const bool clearly = holds(0.97 * less), nearly = holds(1.03 * less);
  if (clearly == nearly) RC_ASSERT((moved(held, up, less, normal) < slipped) == clearly);
}

// The paper's disk: radius 1, contacts at +-phi from +y, in the posture theta.
TEST(Replay, LeastInternalForceOfTheDiskIsThatOfTheSimulator) {
  struct Row {
    double phi, mu_1, mu_2, theta;
  };
  for (const Row& row : {Row{pi / 3, std::sqrt(3.0), std::sqrt(3.0), 0}, Row{pi / 3, 1, 1, 0},
                         Row{5 * pi / 12, 1, 1, 0}, Row{5 * pi / 12, 1, 1 / std::sqrt(3.0), pi / 6},
                         Row{5 * pi / 12, 1, 1 / std::sqrt(3.0), -0.3}}) {
    Held held{{10, {0, 0, 0}}, {}};
    for (const double side : {1.0, -1.0}) {
      const Vector<3> out(side * std::sin(row.phi), std::cos(row.phi), 0);
      held.contacts.push_back(contact(out, -out, side > 0 ? row.mu_1 : row.mu_2));
    }
    const Grasp<3> grasp = held.grasp();
    const Vector<3> up(std::sin(row.theta), std::cos(row.theta), 0);
    // F_T, the least forces without regard to friction, and F_N, along the line of the contacts.
    const auto G = grasp_matrix(grasp);
    Eigen::Matrix<double, 6, 6> forces;  // a hard finger has no moment
    forces << G.middleCols<3>(0), G.middleCols<3>(4);
    const Eigen::Matrix<double, 6, 1> F_T =
        forces.completeOrthogonalDecomposition().solve(grasp.loads().front().at(up));
    const double F_N = std::sin(row.phi) / std::sqrt(2.0);  // its normal part, the same at both
    const double claimed = std::sqrt(hold(grasp, up).effort - F_T.squaredNorm());
    double slips = 0.98 * claimed, holds = 1.02 * claimed;
    const auto stays = [&](double alpha) {
      return moved(held, up, 1, {F_T[0] + alpha * F_N, F_T[3] + alpha * F_N}) < slipped;
    };
    ASSERT_TRUE(stays(holds));
    ASSERT_FALSE(stays(slips));
    while (holds - slips > 3e-4 * claimed) {
      const double alpha = (slips + holds) / 2;
      (stays(alpha) ? holds : slips) = alpha;
    }
    EXPECT_NEAR(holds, claimed, 2e-3 * claimed);
  }
}

}  // namespace
}  // namespace poise::test::physics
