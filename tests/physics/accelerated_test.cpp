// Objects that accelerate: the grip of motion() and the ends of shake(), tried in a simulator in
// the frame of the object, where inertia is a load.
//
// Two soft fingers that face each other, closed by one drive: there both models are the same, the
// simulator's contacts of condim 4 with elliptic cones and the soft fingers of Poise. Pressing
// harder never lets go, so the grip alone says what is held, and the difference of the two normal
// forces is the load along the jaws.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "held.hpp"
#include "physics/scene.hpp"
#include "poise/grip.hpp"
#include "poise/motion.hpp"
#include "poise/shake.hpp"

namespace poise::test::physics {
namespace {

/// What falls freely for so long moves by 0.2 m. What holds moves by less than a micrometre.
constexpr double seconds = 0.2, stayed = 1e-5, slipped = 1e-4;

class Random {
 public:
  explicit Random(unsigned seed) : numbers_(seed) {}
  double real(double lo, double hi) { return std::uniform_real_distribution(lo, hi)(numbers_); }
  Vector<3> direction() {
    std::normal_distribution<double> normal;
    return Vector<3>(normal(numbers_), normal(numbers_), normal(numbers_)).normalized();
  }

 private:
  std::mt19937 numbers_;
};

/// Two soft fingers that close along x, near the centre of mass.
Hand<3> jaws(Random& random, const Vector<3>& com,
             double max_force = std::numeric_limits<double>::infinity()) {
  const double half = random.real(0.02, 0.04);
  const Vector<3> middle = com + Vector<3>(random.real(-0.5, 0.5) * half, random.real(-0.01, 0.01),
                                           random.real(-0.01, 0.01));
  std::vector<Contact<3>> contacts;
  Mechanism<3> mechanism{.kind = DriveKind::coupled};
  for (const double side : {-1.0, 1.0}) {
    contacts.push_back(space::contact(middle + Vector<3>(side * half, 0, 0), {-side, 0, 0},
                                      random.real(0.4, 1), random.real(0.004, 0.015)));
    contacts.back().finger = side < 0 ? "left" : "right";
    mechanism.fingers.push_back({.name = contacts.back().finger, .max_force = max_force});
  }
  return Hand<3>(contacts, com, 1, mechanism);
}

/// How far an object moves [m] against a load if the drive of its jaws gives a grip. The left one
/// pushes along +x.
double moved(const Hand<3>& hand, double weight, const Wrench<3>& load, double grip) {
  return Scene(hand, weight, load, {grip + load[0] / 2, grip - load[0] / 2}, 1).moved(seconds);
}
/// Whether both jaws press by far.
bool both_press(const Wrench<3>& load, double grip) { return grip > 0.6 * std::abs(load[0]); }

/// Swings in all directions about a point that is not the centre of mass.
class Swing {
 public:
  explicit Swing(Random& random)
      : turn_axis_(random.direction()), spin_axis_(random.direction()), spin_(random.real(1, 5)) {
    for (std::size_t k = 0; k < 4; ++k) {
      rate_[k] = random.real(4, 9);
      phase_[k] = random.real(0, 2 * std::numbers::pi);
    }
    for (int k = 0; k < 3; ++k) far_[k] = random.real(0.02, 0.15);
  }
  Vector<3> position(double t) const {
    Vector<3> p;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      p[k] = far_[k] * std::sin(rate_[i] * t + phase_[i]);
    }
    return p;
  }
  Eigen::Quaterniond orientation(double t) const {
    return Eigen::Quaterniond(
        Eigen::AngleAxisd(0.8 * std::sin(rate_[3] * t + phase_[3]), turn_axis_) *
        Eigen::AngleAxisd(spin_ * t, spin_axis_));
  }

 private:
  Vector<3> turn_axis_, spin_axis_, far_;
  double spin_;
  std::array<double, 4> rate_, phase_;
};

/// What a body needs to move so, about the object frame's origin, by the simulator's inverse
/// dynamics and its own differences of poses: nothing of it is of Poise.
class Dynamics {
 public:
  explicit Dynamics(const Body& body) {
    std::ostringstream xml;
    xml.precision(17);
    const Eigen::Matrix3d& I = body.inertia;
    xml << "<mujoco><option gravity='0 0 " << -standard_gravity
        << "'/><worldbody><body><freejoint/><inertial mass='" << body.mass << "' pos='"
        << text(body.com) << "' fullinertia='" << I(0, 0) << ' ' << I(1, 1) << ' ' << I(2, 2) << ' '
        << I(0, 1) << ' ' << I(0, 2) << ' ' << I(1, 2) << "'/></body></worldbody></mujoco>";
    model_ = model_of(xml.str());
    data_.reset(mj_makeData(model_.get()));
  }
  Wrench<3> load(const Swing& swing, double t) {
    const double h = 1e-4;
    std::array<std::array<mjtNum, 7>, 3> pose;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = t + h * (static_cast<double>(k) - 1);
      const Vector<3> p = swing.position(at);
      const Eigen::Quaterniond q = swing.orientation(at);
      pose[k] = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
    }
    std::array<std::array<mjtNum, 6>, 2> velocity;
    for (std::size_t k = 0; k < 2; ++k)
      mj_differentiatePos(model_.get(), velocity[k].data(), h, pose[k].data(), pose[k + 1].data());
    std::copy(pose[1].begin(), pose[1].end(), data_->qpos);
    for (std::size_t k = 0; k < 6; ++k) {
      data_->qvel[k] = (velocity[0][k] + velocity[1][k]) / 2;
      data_->qacc[k] = (velocity[1][k] - velocity[0][k]) / h;
    }
    mj_inverse(model_.get(), data_.get());
    Wrench<3> load;  // forces are in the world's frame, moments in the body's
    load << swing.orientation(t).conjugate() * Vector<3>(data_->qfrc_inverse),
        Vector<3>(data_->qfrc_inverse + 3);
    return load;
  }

 private:
  Model model_;
  Data data_;
};

Eigen::Matrix3d random_inertia(Random& random, double mass) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(random.real(0, 3), random.direction()).toRotationMatrix();
  const Vector<3> squares =
      mass * Vector<3>(random.real(1e-3, 5e-3), random.real(1e-4, 2e-3), random.real(1e-4, 2e-3));
  return turn * Vector<3>(squares.sum() * Vector<3>::Ones() - squares).asDiagonal() *
         turn.transpose();
}

TEST(Accelerated, MotionsAreHeldJustAboveTheirGripAndSlipJustBelow) {
  int at_rest = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    const double mass = random.real(0.1, 0.8);
    const Body body{mass, 0.06 * random.direction(), random_inertia(random, mass)};
    const Hand<3> hand = jaws(random, body.com);
    const Swing swing(random);
    Trajectory trajectory;
    for (int k = 0; k <= 200; ++k) {
      const double t = k / 200.0;
      trajectory.times.push_back(t);
      trajectory.positions.push_back(swing.position(t));
      trajectory.orientations.push_back(swing.orientation(t));
    }
    const MotionAnswer answer = motion(hand, body, motion_through(trajectory));
    ASSERT_FALSE(answer.slip);
    Dynamics dynamics(body);
    int tried = 0;
    const auto replay = [&](std::size_t k) {
      SCOPED_TRACE(testing::Message() << "pose " << k << " of motion " << seed);
      const Wrench<3> load = dynamics.load(swing, trajectory.times[k]);
      const double weight = mass * standard_gravity, grip = answer.needs[k].value;
      if (!both_press(load, grip)) return;
      ++tried;
      EXPECT_LT(moved(hand, weight, load, 1.02 * grip), stayed);
      EXPECT_GT(moved(hand, weight, load, 0.97 * grip), slipped);
    };
    replay(answer.peak);
    EXPECT_EQ(tried, 1) << "the peak of motion " << seed;
    for (std::size_t k = 10; k < 200; k += 40) replay(k);
    EXPECT_GE(tried, 4);
    // What holds the object there at rest lets go of it.
    const Vector<3> up =
        swing.orientation(trajectory.times[answer.peak]).conjugate() * Vector<3>::UnitZ();
    const Load<3> rest{.weight = mass * standard_gravity, .com = body.com};
    const double grip = least_grip<3>(hand, rest, up).grip;
    const Wrench<3> load = dynamics.load(swing, trajectory.times[answer.peak]);
    if (!both_press(load, grip) || grip > 0.9 * answer.needs[answer.peak].value) continue;
    ++at_rest;
    EXPECT_GT(moved(hand, rest.weight, load, grip), slipped);
  }
  EXPECT_GE(at_rest, 3);
}

TEST(Accelerated, ShakingIsHeldJustBelowItsLimitAndSlipsJustAbove) {
  int tried = 0;
  for (unsigned seed = 1; tried < 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    ASSERT_LT(seed, 100U);
    Random random(seed);
    const Vector<3> com = 0.06 * random.direction(), up = random.direction();
    const double mass = random.real(0.1, 0.8), weight = mass * standard_gravity;
    const double max = random.real(10, 60);
    const Hand<3> hand = jaws(random, com, max);
    const Grasp<3> grasp({.weight = weight, .com = com}, hand.contacts(), 1, hand.mechanism());
    const Shake<3> found = shake<3>(grasp, up);
    if (!found.holdable || found.acceleration < 1) continue;
    ASSERT_TRUE(found.proven);
    const auto at = [&](double acceleration, const Vector<3>& direction) {
      Load<3> load = grasp.loads().front();
      load.acceleration = acceleration * direction;
      const Wrench<3> w = load.at(up);
      EXPECT_TRUE(both_press(w, max));
      return moved(hand, weight, w, max);
    };
    ++tried;
    EXPECT_LT(at(0.99 * found.acceleration, found.direction), stayed);
    EXPECT_GT(at(1.01 * found.bound, found.direction), slipped);
    for (int k = 0; k < 4; ++k)
      EXPECT_LT(at(0.99 * found.acceleration, random.direction()), stayed);
  }
}

}  // namespace
}  // namespace poise::test::physics
