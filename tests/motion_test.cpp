// Motions: the dynamics against finite differences and energy, the least grip against closed forms,
// the greatest speed against bisection.
#include "poise/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "poise/grasp.hpp"
#include "poise/grip.hpp"
#include "poise/path_limits.hpp"

namespace poise {
namespace {

constexpr double g = standard_gravity, pi = std::numbers::pi;

Contact<3> contact(const Vector<3>& position, const Vector<3>& normal, double friction,
                   double torsion, const std::string& finger) {
  Contact<3> result;
  result.position = position;
  result.normal = normal;
  result.friction = friction;
  result.torsion = torsion;
  result.finger = finger;
  return result;
}

/// Two soft fingers on the x axis, closed by one drive.
Hand<3> jaws(double friction, double max_force = std::numeric_limits<double>::infinity()) {
  Mechanism<3> mechanism{.kind = DriveKind::coupled};
  for (const char* name : {"left", "right"})
    mechanism.fingers.push_back({.name = name, .max_force = max_force});
  return Hand<3>({contact({-0.04, 0, 0}, {1, 0, 0}, friction, 0.01, "left"),
                  contact({0.04, 0, 0}, {-1, 0, 0}, friction, 0.01, "right")},
                 Vector<3>::Zero(), 1, mechanism);
}

/// The mug of a simulator's example: one finger moves, the other is fixed.
Hand<3> mug_jaw(double max) {
  Drive<3> jaw{.name = "jaw", .max = max};
  Twist<3> along = Twist<3>::Zero();
  along[0] = 1;
  jaw.moves.push_back({"moving", along});
  return Hand<3>({contact({-0.04, 0, 0}, {1, 0, 0}, 0.947368, 0.0132632, "moving"),
                  contact({0.04, 0, 0}, {-1, 0, 0}, 0.947368, 0.0132632, "fixed")},
                 Vector<3>(0, 0.01, 0), 1, {.kind = DriveKind::listed, .drives = {jaw}});
}

/// Poses of a motion at even times.
template <class Pose>
Trajectory sampled(double until, int steps, const Pose& pose) {
  Trajectory trajectory;
  for (int k = 0; k <= steps; ++k) {
    const double t = until * k / steps;
    const auto [position, orientation] = pose(t);
    trajectory.times.push_back(t);
    trajectory.positions.push_back(position);
    trajectory.orientations.push_back(orientation);
  }
  return trajectory;
}

using Pose = std::pair<Vector<3>, Eigen::Quaterniond>;

Eigen::Quaterniond about(const Vector<3>& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

TEST(MotionThrough, FollowsACubicExactly) {
  Trajectory given = sampled(2, 9, [](double t) {
    return Pose{Vector<3>(t * t * t, 1 - 2 * t * t, 3 * t), Eigen::Quaterniond::Identity()};
  });
  given.times[3] += 0.05;  // uneven
  const double t3 = given.times[3];
  given.positions[3] = {t3 * t3 * t3, 1 - 2 * t3 * t3, 3 * t3};
  for (const MotionState& state : motion_through(given)) {
    EXPECT_LT((state.acceleration - Vector<3>(6 * state.time, -4, 0)).norm(), 1e-9);
    EXPECT_LT(state.angular_velocity.norm(), 1e-12);
  }
}

TEST(MotionThrough, ThreePosesMakeAParabolaTwoALineAndOneRests) {
  const auto fall = [](double t) {
    return Pose{Vector<3>(0, 0, -g / 2 * t * t), Eigen::Quaterniond::Identity()};
  };
  for (const MotionState& state : motion_through(sampled(1, 2, fall)))
    EXPECT_NEAR(state.acceleration.z(), -g, 1e-9);
  for (const MotionState& state : motion_through(sampled(1, 1, fall)))
    EXPECT_EQ(state.acceleration.norm(), 0);
  EXPECT_EQ(motion_through({{0}, {{1, 2, 3}}, {Eigen::Quaterniond::Identity()}})
                .front()
                .acceleration.norm(),
            0);
}

TEST(MotionThrough, TurnsAtAConstantRateWhateverTheSignOfTheQuaternion) {
  const Vector<3> omega(0.3, -1.2, 2);
  Trajectory given = sampled(3, 300, [&](double t) {
    return Pose{Vector<3>::Zero(), about(omega, omega.norm() * t) * about({1, 1, 0}, 0.7)};
  });
  for (std::size_t k = 0; k < given.orientations.size(); k += 3)
    given.orientations[k].coeffs() *= -2;
  for (const MotionState& state : motion_through(given)) {
    EXPECT_LT((state.angular_velocity - omega).norm(), 1e-5);
    EXPECT_LT(state.angular_acceleration.norm(), 2e-3);
  }
}

TEST(MotionThrough, APendulumSwingsAsItsLawSays) {
  const Vector<3> axis(0, 1, 0);
  const double rate = 3, most = 0.6;
  for (const MotionState& state : motion_through(sampled(2, 800, [&](double t) {
         return Pose{Vector<3>::Zero(), about(axis, most * std::sin(rate * t))};
       }))) {
    const double at = rate * state.time;
    EXPECT_LT((state.angular_velocity - most * rate * std::cos(at) * axis).norm(), 1e-5);
    EXPECT_LT((state.angular_acceleration + most * rate * rate * std::sin(at) * axis).norm(), 2e-3);
  }
}

TEST(MotionThrough, RefusesWhatIsNoMotion) {
  const auto refused = [](Trajectory given, const std::string& path) {
    try {
      motion_through(given);
      return false;
    } catch (const InvalidGrasp& error) {
      return error.path() == path;
    }
  };
  const Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  const Vector<3> o = Vector<3>::Zero();
  EXPECT_TRUE(refused({{0, 1, 1}, {o, o, o}, {q, q, q}}, "times[2]"));
  EXPECT_TRUE(refused({{0, 1}, {o}, {q, q}}, "positions"));
  EXPECT_TRUE(refused({{0, 1}, {o, o}, {q, Eigen::Quaterniond(0, 0, 0, 0)}}, "orientations[1]"));
  EXPECT_TRUE(refused({{0, 1}, {o, o}, {q, q}, {o}}, "accelerations"));
}

/// A cloud of points that moves rigidly obeys Newton's law point by point: no formula of a rigid
/// body is used.
TEST(MotionLoad, IsWhatTheBodysPointsTakeByNewtonsLaw) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  const auto vector = [&] { return Vector<3>(part(random), part(random), part(random)); };
  struct Point {
    double mass;
    Vector<3> at;
  };
  std::vector<Point> cloud;
  Body body{.mass = 0};
  for (int k = 0; k < 12; ++k) cloud.push_back({1 + part(random) / 2, vector() / 5});
  for (const Point& point : cloud) {
    body.mass += point.mass;
    body.com += point.mass * point.at;
  }
  body.com /= body.mass;
  for (const Point& point : cloud) {
    const Vector<3> r = point.at - body.com;
    body.inertia +=
        point.mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  EXPECT_EQ(inertia_problem(body.inertia), "");
  const MotionState state{0,           vector(), about(vector(), 1.3), 5 * vector(), 4 * vector(),
                          9 * vector()};
  // Positions near the time 0, to the third order.
  const auto world = [&](const Vector<3>& at, double t) {
    const Vector<3> turn = t * state.angular_velocity + t * t / 2 * state.angular_acceleration;
    return Vector<3>(t * t / 2 * state.acceleration +
                     about(turn, turn.norm()) * (state.orientation * at));
  };
  Wrench<3> taken = Wrench<3>::Zero();
  const double h = 1e-4;
  for (const Point& point : cloud) {
    const Vector<3> a =
        (world(point.at, h) - 2 * world(point.at, 0) + world(point.at, -h)) / (h * h);
    const Vector<3> force =
        state.orientation.conjugate() * (point.mass * (a + g * Vector<3>::UnitZ()));
    taken += wrench_of<3>(force, point.at);
  }
  EXPECT_LT((motion_load(body, state).at() - taken).norm(), 1e-5 * taken.norm());
}

TEST(MotionLoad, DoesThePowerByWhichTheEnergyRises) {
  const Body body{2, {0.1, -0.2, 0.05}, Eigen::Vector3d(0.02, 0.03, 0.04).asDiagonal()};
  const auto pose = [](double t) {
    return Pose{Vector<3>(std::sin(t), t * t, std::cos(2 * t)),
                about({1, 0, 0}, std::sin(t)) * about({0, 1, 1}, t * t)};
  };
  const std::vector<MotionState> states = motion_through(sampled(2, 2000, pose));
  const double h = states[1].time;
  const auto velocity = [&](std::size_t k) {  // of the origin, world
    return Vector<3>((states[k + 1].position - states[k - 1].position) / (2 * h));
  };
  const auto energy = [&](std::size_t k) {
    const MotionState& state = states[k];
    const Vector<3> com = state.orientation * body.com;
    const Vector<3> v = velocity(k) + state.angular_velocity.cross(com);
    const Vector<3> omega = state.orientation.conjugate() * state.angular_velocity;
    return body.mass * (v.squaredNorm() / 2 + g * (state.position + com).z()) +
           omega.dot(body.inertia * omega) / 2;
  };
  for (std::size_t k = 10; k + 10 < states.size(); k += 37) {
    const double rise = (energy(k + 1) - energy(k - 1)) / (2 * h);
    Twist<3> twist;
    twist << states[k].orientation.conjugate() * velocity(k),
        states[k].orientation.conjugate() * states[k].angular_velocity;
    EXPECT_NEAR(twist.dot(motion_load(body, states[k]).at()), rise, 1e-3 * (1 + std::abs(rise)));
  }
}

TEST(Inertia, OfNoBodyIsTold) {
  EXPECT_EQ(inertia_problem(Eigen::Vector3d(1, 2, 3).asDiagonal()), "");
  EXPECT_EQ(inertia_problem(Eigen::Matrix3d::Zero()), "");
  EXPECT_NE(inertia_problem(Eigen::Vector3d(1, 2, 3.1).asDiagonal()), "");
  EXPECT_NE(inertia_problem(Eigen::Vector3d(-1, 2, 2).asDiagonal()), "");
  Eigen::Matrix3d skew = Eigen::Matrix3d::Identity();
  skew(0, 1) = 0.1;
  EXPECT_NE(inertia_problem(skew), "");
}

TEST(Motion, AShakenMugIsHeldByTheFixedFingerMoreOrLess) {
  // 2 Hz, 150 mm: 23.687 m/s^2 where it turns back. The jaw gives 10 N.
  const double rate = 2 * 2 * pi, most = 0.15 * rate * rate;
  EXPECT_NEAR(most, 23.687, 1e-3);
  const std::vector<MotionState> states = motion_through(sampled(0.5, 4000, [&](double t) {
    return Pose{Vector<3>(0.15 * std::cos(rate * t), 0, 0), Eigen::Quaterniond::Identity()};
  }));
  const Body body{0.094, {0, 0.01, 0}, Eigen::Matrix3d::Zero()};
  const MotionAnswer answer = motion(mug_jaw(10), body, states);
  EXPECT_FALSE(answer.slip);
  // The mug is pushed by the moving finger: 2.79492 N, of a cone solver.
  EXPECT_NEAR(answer.needs[answer.peak].value, 2.79492, 2e-4);
  EXPECT_NEAR(std::abs(states[answer.peak].acceleration.x()), most, 1e-3);
  EXPECT_EQ(answer.cause, LoadTerm::linear);
  // The fixed finger carries what the moving one presses less what accelerates the mug.
  const double fixed = answer.hold.forces[1].normal, moving = answer.hold.forces[0].normal;
  EXPECT_NEAR(moving - fixed, 0.094 * states[answer.peak].acceleration.x(), 1e-6);
}

TEST(Motion, LiftingIsHeavierByTheAccelerationAndSlipsWhereTheJawGivesNoMore) {
  const double mass = 0.5, friction = 0.5;
  const std::vector<MotionState> states = motion_through(sampled(1, 400, [](double t) {
    return Pose{Vector<3>(0, 0, t * t * t / 3), Eigen::Quaterniond::Identity()};  // a = 2 t
  }));
  const Body body{mass, Vector<3>::Zero(), Eigen::Matrix3d::Zero()};
  const double max = mass * (g + 1.001) / (2 * friction);  // reached at t = 0.5005
  const MotionAnswer answer = motion(jaws(friction, max), body, states);
  for (std::size_t k = 0; k < states.size(); ++k)
    EXPECT_NEAR(answer.needs[k].value, mass * (g + 2 * states[k].time) / (2 * friction), 1e-6);
  EXPECT_EQ(answer.peak, states.size() - 1);
  EXPECT_EQ(answer.cause, LoadTerm::weight);
  ASSERT_TRUE(answer.slip);
  EXPECT_NEAR(states[*answer.slip].time, 0.5025, 1e-9);
  const SpeedLimit limit = speed_limit(jaws(friction, max), body, states);
  ASSERT_TRUE(limit.holdable);
  EXPECT_NEAR(limit.factor, std::sqrt(1.001 / 2), 1e-6);  // g + 2 s = g + 1.001
  EXPECT_NEAR(limit.bound, std::sqrt(1.001 / 2), 1e-6);
  EXPECT_EQ(limit.state, states.size() - 1);
}

TEST(Motion, OnACircleTheCentripetalForceAddsAtRightAngles) {
  // The frame's origin is the centre and stands still: all of the force is of the term centripetal.
  const double radius = 0.3, rate = 6, friction = 0.6;
  const Vector<3> com(0, radius, 0);
  const std::vector<MotionState> states = motion_through(sampled(2, 2000, [&](double t) {
    return Pose{Vector<3>::Zero(), about({0, 0, 1}, rate * t)};
  }));
  std::vector<Contact<3>> contacts = jaws(friction).contacts();
  for (Contact<3>& contact : contacts) contact.position += com;
  Mechanism<3> coupled{.kind = DriveKind::coupled};
  const Hand<3> hand(contacts, com, 1, coupled);
  const MotionAnswer answer = motion(hand, {1, com, Eigen::Matrix3d::Zero()}, states);
  const double needed = std::hypot(g, radius * rate * rate) / (2 * friction);
  for (const MotionNeed& need : answer.needs) EXPECT_NEAR(need.value, needed, 1e-3);
  EXPECT_EQ(answer.cause, LoadTerm::centripetal);
}

TEST(Motion, ASpinningBodyThatIsNotTurnedAboutAPrincipalAxisAsksForTheGyroscopicMoment) {
  const double rate = 20;
  const Eigen::Quaterniond tilted = about({1, 0, 0}, pi / 4);
  const std::vector<MotionState> states = motion_through(sampled(0.2, 2000, [&](double t) {
    return Pose{Vector<3>::Zero(), about({0, 0, 1}, rate * t) * tilted};
  }));
  const Eigen::Vector3d moments(0.002, 0.003, 0.001);
  const Body body{1, Vector<3>::Zero(), moments.asDiagonal()};
  // In the object frame omega = rate (0, 1, 1) / sqrt 2: omega x I omega along x.
  const double moment = rate * rate / 2 * (moments.z() - moments.y());
  const Wrench<3> load = motion_load(body, states[1000]).terms[3];
  EXPECT_LT((load.tail<3>() - Vector<3>(moment, 0, 0)).norm(), 1e-4);
  EXPECT_LT(load.head<3>().norm(), 1e-9);
}

TEST(SpeedLimit, IsWhereBisectionWithHoldsEnds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  const auto vector = [&] { return Vector<3>(part(random), part(random), part(random)); };
  int finite = 0;
  for (int n = 0; n < 12; ++n) {
    const Vector<3> a = vector(), b = vector();
    const std::vector<MotionState> states = motion_through(sampled(1, 20, [&](double t) {
      return Pose{a * std::sin(2 * t) / 5 + b * t * t / 5, about(b, std::sin(t))};
    }));
    const Body body{0.3, vector() / 100, Eigen::Vector3d(2e-4, 3e-4, 3e-4).asDiagonal()};
    const Hand<3> hand = jaws(0.9, 30);
    const auto all_held = [&](double factor) {
      for (const MotionState& state : states) {
        const Hold<3> hold =
            least_grip<3>(hand, motion_load(body, state).at(factor), body.mass * g * 10);
        if (!hold.holdable || hold.grip > 30) return false;
      }
      return true;
    };
    const SpeedLimit limit = speed_limit(hand, body, states);
    if (!all_held(1e-3)) continue;
    double held = 1e-3, failed = most_speed;
    while (failed - held > 1e-7 * failed) {
      const double middle = (held + failed) / 2;
      (all_held(middle) ? held : failed) = middle;
    }
    ++finite;
    ASSERT_TRUE(limit.holdable);
    EXPECT_NEAR(limit.factor, held, 2e-6 * held);
    EXPECT_GE(limit.bound, held * (1 - 1e-7));
    EXPECT_LE(limit.bound, limit.factor * (1 + 2e-6));
  }
  EXPECT_GT(finite, 6);
}

TEST(SpeedLimit, OfABucketThatHoldsOnlyWhereItSwingsFastEnoughIsFoundToo) {
  // A finger below alone, upside down: held where it is thrown outwards by more than g.
  const Hand<3> tray({contact({0, 0, 0}, {0, 0, 1}, 0.5, 0.01, "tray")}, Vector<3>::Zero());
  MotionState state;
  state.orientation = about({1, 0, 0}, pi);
  state.acceleration = {0, 0, -2 * g};
  const Body body{1, Vector<3>::Zero(), Eigen::Matrix3d::Zero()};
  const MotionSettings within{.objective = Objective::effort, .force_cap = 5};
  const SpeedLimit limit = speed_limit(tray, body, {state}, within);
  ASSERT_TRUE(limit.holdable);
  EXPECT_NEAR(limit.factor, std::sqrt(3), 1e-5);  // 2 s - 1 = 5
  state.acceleration = {0, 0, 0};
  EXPECT_FALSE(speed_limit(tray, body, {state}, within).holdable);
}

TEST(SpeedLimit, HasNoEndWhereNothingMoves) {
  const SpeedLimit limit =
      speed_limit(jaws(0.5, 30), {0.3, Vector<3>::Zero(), Eigen::Matrix3d::Zero()}, {{}});
  EXPECT_TRUE(limit.holdable);
  EXPECT_EQ(limit.factor, most_speed);
  EXPECT_TRUE(std::isinf(limit.bound));
}

/// Rays to all sides from the inside: what is held lies between the two polygons.
TEST(PathLimits, LieWithinAPercentOfWhatBruteForceHolds) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(-1, 1);
  const auto vector = [&] { return Vector<3>(part(random), part(random), part(random)); };
  std::size_t most_rows = 0;
  int points = 0;
  for (int n = 0; n < 12; ++n) {
    const Body body{0.3, vector() / 200, Eigen::Vector3d(2e-4, 3e-4, 3e-4).asDiagonal()};
    const Hand<3> hand = jaws(0.9, 30);
    const PathPoint point{about(vector(), n), vector(), vector(), 3 * vector(), 3 * vector()};
    const auto held = [&](const Vector<2>& p) {
      const MotionState state{.orientation = point.orientation,
                              .acceleration = p[0] * point.velocity + p[1] * point.acceleration,
                              .angular_velocity = std::sqrt(p[1]) * point.angular_velocity,
                              .angular_acceleration = p[0] * point.angular_velocity +
                                                      p[1] * point.angular_acceleration};
      const Hold<3> hold = least_grip<3>(hand, motion_load(body, state).at(), body.mass * g * 10);
      return hold.holdable && hold.grip <= 30 * (1 + 1e-7);
    };
    const PathLimits limits = path_limits(hand, body, point);
    if (!limits.holdable) continue;
    ++points;
    EXPECT_GE(limits.shrunk, 0.99);
    EXPECT_TRUE(held(limits.inside));
    most_rows = std::max(most_rows, limits.rows.size());
    for (int k = 0; k < 64; ++k) {
      const double angle = 2 * pi * k / 64;
      // The way to the border of either polygon.
      Vector<2> way(std::cos(angle), std::sin(angle));
      way = way.cwiseProduct(limits.inside.cwiseAbs() + Vector<2>::Ones());
      double safe = 1e9, necessary = 1e9;
      for (const PathRow& row : limits.rows) {
        const double speed = row.a * way[0] + row.b * way[1];
        const double here = row.a * limits.inside[0] + row.b * limits.inside[1];
        if (!(speed > 0)) continue;
        safe = std::min(safe, (row.most - here) / speed);
        necessary = std::min(necessary, (row.necessary - here) / speed);
      }
      if (way[1] < 0 && !(safe < 1e9)) continue;  // ended by s'^2 >= 0
      ASSERT_LT(safe, 1e9);
      const auto in_range = [&](double length) { return limits.inside[1] + length * way[1] >= 0; };
      if (in_range(safe)) {
        EXPECT_TRUE(held(limits.inside + safe * (1 - 1e-9) * way)) << n << " " << k;
      }
      if (in_range(necessary * 1.0001)) {
        EXPECT_FALSE(held(limits.inside + 1.0001 * necessary * way)) << n << " " << k;
      }
      EXPECT_GE(safe, 0.98999 * necessary);
    }
  }
  EXPECT_GT(points, 6);
  EXPECT_LE(most_rows, 30U);
}

TEST(PathLimits, AreTheClosedFormOfALift) {
  // Straight up at s'' alone: 0 <= m (g + s'') <= 2 friction F; downwards friction holds it back.
  const double mass = 0.5, friction = 0.5, max = 10;
  const PathLimits limits =
      path_limits(jaws(friction, max), {mass, Vector<3>::Zero(), Eigen::Matrix3d::Zero()},
                  {.velocity = {0, 0, 1}});
  ASSERT_TRUE(limits.holdable);
  const double up = 2 * friction * max / mass - g, down = -2 * friction * max / mass - g;
  double least = -1e9, most = 1e9;
  for (const PathRow& row : limits.rows) {
    if (std::abs(row.b) > 1e-9 * std::abs(row.a)) continue;
    if (row.a > 0) most = std::min(most, row.necessary / row.a);
    if (row.a < 0) least = std::max(least, row.necessary / row.a);
  }
  EXPECT_NEAR(most, up, 2e-2 * (up - down) / 2);
  EXPECT_NEAR(least, down, 2e-2 * (up - down) / 2);
}

TEST(PathLimits, OfWhatCannotBeHeldOrDoesNotMoveSaySo) {
  const Body heavy{10, Vector<3>::Zero(), Eigen::Matrix3d::Zero()};
  const PathPoint sideways{.velocity = {0, 1, 0}};
  EXPECT_FALSE(path_limits(jaws(0.5, 10), heavy, sideways).holdable);
  EXPECT_THROW(path_limits(jaws(0.5, 10), heavy, {}), InvalidGrasp);
}

}  // namespace
}  // namespace poise
