// Which of equally good postures in space is named, against closed forms of two fingers.
#include <gtest/gtest.h>

#include "ask/ask.hpp"
#include "random_space_grasps.hpp"

namespace poise::test::space {
namespace {

constexpr double tie = 1e-6;

/// Two soft fingers that press on each other along d, the weight in the middle. With T the part of
/// the weight across d and A that along it, each finger carries T / 2, so that one presses with
/// n = T / 2 mu and the other with n + A: the grip is n + A, the effort n^2 + (n + A)^2 + T^2 / 2.
/// Both are concave between A = 0 and T = 0. So with mu > 0.5 (grip) and mu > 1 (effort) all
/// postures across d are best.
SpatialFile two_fingers(const Vector<3>& d, double friction) {
  SpatialFile file;
  file.loads = {{.weight = 10}};
  for (const double side : {1.0, -1.0})
    file.contacts.push_back(contact(0.04 * side * d, -side * d, friction, 0.005));
  return file;
}

BestAnswer<3> best(const SpatialFile& file, Objective objective) {
  const Question question{.command = Command::best, .objective = objective};
  return std::get<BestAnswer<3>>(ask(file, file.grasp(), question).of);
}

double angle(const Vector<3>& a, const Vector<3>& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Vector<3> horizontal(const Vector<3>& up, const Vector<3>& d) {
  return (up - d.dot(up) * d).normalized();
}

RC_GTEST_PROP(Tie, OfACircleTheLeastTurnIsNamed, ()) {
  if (!one_in(300)) return;
  const Vector<3> d = random_rotation() * Vector<3>::UnitX();
  const bool is_grip = one_in(2);
  const double mu = is_grip ? real(0.6, 0.9) : real(1.1, 1.5);
  SpatialFile file = two_fingers(d, mu);
  file.up = random_direction();
  const double off = std::abs(d.dot(*file.up));  // the sine of what there is to turn
  if (off > 0.99 || off < 0.02) return;
  const BestAnswer<3> answer = best(file, is_grip ? Objective::grip : Objective::effort);
  const Posture<3>& named = answer.best.best();
  const double least = is_grip ? 10 / (2 * mu) : 100 * (1 / (mu * mu) + 1) / 2;
  RC_ASSERT(named.value() <= least * (1 + 2 * tie));
  // A lone minimum that was found anyway is left for a turn that is less by a hundredth of a
  // radian.
  const bool is_alone = answer.best.minima.size() == 1 || !is_grip;
  RC_ASSERT(angle(named.up, *file.up) < std::asin(off) + (is_alone ? 0.0101 : 1e-5));
}

// With mu = 0.5 it costs as much to rest on one finger.
TEST(Tie, OfAllThatIsAsGoodTheLeastTurnIsNamed) {
  const Vector<3> d = Vector<3>(2, 1, 3).normalized();
  const Vector<3> across = horizontal({0, 0, 1}, d);
  for (const double degrees : {20.0, 40.0, 50.0, 70.0, 110.0, 160.0}) {
    SpatialFile file = two_fingers(d, 0.5);
    const double at = degrees * pi / 180;
    file.up = std::cos(at) * d + std::sin(at) * across;
    const BestAnswer<3> answer = best(file, Objective::grip);
    const Posture<3>& named = answer.best.best();
    EXPECT_NEAR(named.value(), 10, 10 * tie);
    const double turn = std::min({degrees, std::abs(90 - degrees), 180 - degrees});
    EXPECT_NEAR(angle(named.up, *file.up) * 180 / pi, turn, 0.01) << degrees;
  }
}

TEST(Tie, ThePresentPostureStays) {
  const Vector<3> d = Vector<3>(2, -1, 1).normalized();
  SpatialFile file = two_fingers(d, 0.8);
  file.up = horizontal({0.3, 0.5, 0.1}, d);
  EXPECT_LT(angle(best(file, Objective::grip).best.best().up, *file.up), 1e-12);
}

// What may be chosen ends on the circle, 30 degrees from the middle of the domain.
TEST(Tie, OfADomainTheNearestPostureIsNamed) {
  const Vector<3> d(1, 0, 0), middle(0, 0, 1);
  SpatialFile file = two_fingers(d, 0.8);
  file.tilt = Tilt{middle, pi / 6};
  for (const double degrees : {10.0, -20.0, 60.0, -100.0}) {
    const double at = degrees * pi / 180, end = std::clamp(at, -pi / 6, pi / 6);
    file.up = Vector<3>(0.4, std::sin(at), std::cos(at)).normalized();
    const Posture<3> named = best(file, Objective::grip).best.best();
    EXPECT_NEAR(angle(named.up, {0, std::sin(end), std::cos(end)}), 0, 2e-3) << degrees;
  }
}

// A lone minimum is named as it is, however near the present posture.
RC_GTEST_PROP(Tie, ALoneMinimumIsNotLeft, ()) {
  if (!one_in(100)) return;
  SpatialFile file;
  file.loads = {{.weight = 10, .com = Vector<3>(0.2, 0.1, -0.3)}};
  for (int k = 0; k < 3; ++k) {
    const Vector<3> out(std::cos(2 * pi * k / 3), std::sin(2 * pi * k / 3), 0.1 * k);
    file.contacts.push_back(contact(out, -out, real(0.4, 0.9), 0.1));
  }
  const Grasp<3> grasp = file.grasp();
  const Objective objective = one_in(2) ? Objective::grip : Objective::effort;
  const Best<3> found = best_posture(grasp, {.objective = objective, .starts = 0});
  file.up = (found.best().up + real(0.03, 1) * random_direction()).normalized();
  const BestAnswer<3> answer = best(file, objective);
  if (answer.now->value() <= found.best().value() * (1 + tie)) return;
  RC_ASSERT(angle(answer.best.best().up, found.best().up) < 1e-3);
}

}  // namespace
}  // namespace poise::test::space
