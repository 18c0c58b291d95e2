// The constant turn in the wrist: against closed forms and dense sampling of rotations.
#include "poise/wrist_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "poise/grip.hpp"

namespace poise {
namespace {

constexpr double g = standard_gravity;

/// A soft finger on either side and one below.
Hand<3> three_fingers() {
  std::vector<Contact<3>> contacts(3);
  contacts[0].position = {-0.04, 0, 0};
  contacts[1].position = {0.04, 0, 0};
  contacts[2].position = {0, 0.01, -0.04};
  contacts[0].normal = {1, 0, 0};
  contacts[1].normal = {-1, 0, 0};
  contacts[2].normal = {0, 0, 1};
  for (Contact<3>& contact : contacts) {
    contact.friction = 0.4;
    contact.torsion = 0.01;
  }
  return Hand<3>(contacts, Vector<3>::Zero());
}

double need(const Hand<3>& hand, const Body& body, std::vector<MotionState> states,
            const Eigen::Quaterniond& turn) {
  for (MotionState& state : states) state.orientation = state.orientation * turn;
  const MotionAnswer answer = motion(hand, body, states);
  return answer.needs[answer.peak].value;
}

std::vector<MotionState> shaken(const Vector<3>& along, double most) {
  std::vector<MotionState> states;
  for (int k = 0; k < 8; ++k) {
    MotionState state;
    state.time = k;
    state.acceleration = most * std::cos(k * 0.9) * along;
    state.angular_velocity = {0, 0, 2 * std::sin(k)};
    state.angular_acceleration = {std::cos(k), 0, 3};
    states.push_back(state);
  }
  return states;
}

TEST(WristOffset, IsNotBeatenByDenseSamplesAndItsBoundHoldsForAllOfThem) {
  const Hand<3> hand = three_fingers();
  const Body body{0.4, {0.002, 0, 0.003}, Eigen::Vector3d(3e-4, 2e-4, 4e-4).asDiagonal()};
  const std::vector<MotionState> states = shaken({1, 0.4, 0}, 8);
  const WristOffset found = best_offset(hand, body, states, {.gap = 0.05, .max_cells = 4000});
  EXPECT_NEAR(need(hand, body, states, found.rotation), found.value, 1e-6 * found.value);
  EXPECT_NEAR(need(hand, body, states, Eigen::Quaterniond::Identity()), found.now,
              1e-6 * found.now);
  EXPECT_LE(found.lower_bound, found.value);
  EXPECT_LT(found.value, found.now);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 3000; ++k) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
            .normalized();
    const double value = need(hand, body, states, turn);
    EXPECT_GE(value, found.lower_bound * (1 - 1e-7));
    if (found.optimal) {
      EXPECT_GE(value, found.value * 0.95);
    }
  }
}

TEST(WristOffset, OfAnObjectAtRestIsAPostureInWhichOneFingerCarriesIt) {
  // Two fingers along x with a friction of 0.5, each with a drive: the least grip of all postures
  // is where both carry half by friction alone, m g / (2 friction), or one carries all of it, m g.
  std::vector<Contact<3>> contacts(2);
  for (int k = 0; k < 2; ++k) {
    contacts[static_cast<std::size_t>(k)].position = {k == 0 ? -0.04 : 0.04, 0, 0};
    contacts[static_cast<std::size_t>(k)].normal = {k == 0 ? 1.0 : -1.0, 0, 0};
    contacts[static_cast<std::size_t>(k)].friction = 0.25;
    contacts[static_cast<std::size_t>(k)].torsion = 0.01;
  }
  const Body body{1, Vector<3>::Zero(), Eigen::Matrix3d::Zero()};
  const WristOffset found =
      best_offset(Hand<3>(contacts, Vector<3>::Zero()), body, {MotionState{}}, {.gap = 0.02});
  EXPECT_NEAR(found.now, g / 0.5, 1e-6);
  EXPECT_TRUE(found.optimal);
  EXPECT_GE(found.value, g * (1 - 1e-9));
  EXPECT_LE(found.value, g * 1.021);
  EXPECT_GE(found.lower_bound, 0.98 * found.value);
}

TEST(WristOffset, StaysWhereNothingIsBetter) {
  // A single finger below carries the weight: no posture needs less than the weight.
  std::vector<Contact<3>> contacts(1);
  contacts[0].position = {0, 0, -0.04};
  contacts[0].normal = {0, 0, 1};
  contacts[0].friction = 0.5;
  contacts[0].torsion = 0.01;
  const WristOffset found =
      best_offset(Hand<3>(contacts, Vector<3>::Zero()),
                  {1, Vector<3>::Zero(), Eigen::Matrix3d::Zero()}, {MotionState{}}, {.gap = 0.05});
  EXPECT_NEAR(found.value, g, 1e-6);
  EXPECT_EQ(found.rotation.w(), 1);
  EXPECT_TRUE(found.optimal);
}

}  // namespace
}  // namespace poise
