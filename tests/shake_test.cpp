// What is withstood besides the load, against a cone solver's answers, closed forms, holds in many
// directions, and its own proofs written out.
#include "poise/shake.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <optional>
#include <random>

#include "poise/posture.hpp"

namespace poise::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;
const Vector<3> upright(0, 0, 1);

Contact<3> finger(const Vector<3>& position, const Vector<3>& normal, double friction,
                  const std::string& name, double torsion = 0) {
  Contact<3> contact;
  contact.position = position;
  contact.normal = normal;
  contact.friction = friction;
  contact.finger = name;
  contact.torsion = torsion;
  return contact;
}

template <int Dim>
Mechanism<Dim> limited(std::size_t fingers, double max, DriveKind kind = DriveKind::each) {
  Mechanism<Dim> mechanism{.kind = kind};
  for (std::size_t k = 0; k < fingers; ++k)
    mechanism.fingers.push_back({.name = "f" + std::to_string(k), .max_force = max});
  return mechanism;
}

/// Grasps of 0.4 kg, drives of at most `max`.
Grasp<3> shaken(std::vector<Contact<3>> contacts, double max, DriveKind kind = DriveKind::each) {
  const Load<3> load{.weight = 0.4 * standard_gravity, .com = {0, 0.004, 0.006}};
  const std::size_t count = contacts.size();
  return {load, std::move(contacts), 1, limited<3>(count, max, kind)};
}

Grasp<3> two_soft(double max = 20) {
  return shaken({finger({0.035, 0, 0}, {-1, 0, 0}, 0.6, "f0", 0.005),
                 finger({-0.035, 0, 0}, {1, 0, 0}, 0.6, "f1", 0.005)},
                max);
}
Grasp<3> three_points(double max = 20) {
  return shaken(
      {finger({0.034637, 0.004263, -0.002671}, {-0.989615, -0.12181, 0.076323}, 0.5, "f0"),
       finger({-0.016538, 0.030723, -0.00276}, {0.472501, -0.877795, 0.078861}, 0.5, "f1"),
       finger({-0.015745, -0.031257, -0.000294}, {0.44986, 0.89306, 0.008409}, 0.5, "f2")},
      max);
}
Grasp<3> four_points(double max = 20) {
  return shaken(
      {finger({0.033635, 0.002517, -0.009346}, {-0.961, -0.071909, 0.267036}, 0.7, "f0"),
       finger({-0.00546, 0.034568, -0.000506}, {0.155999, -0.987651, 0.014463}, 0.7, "f1"),
       finger({-0.034912, -0.002379, -0.000717}, {0.997477, 0.067971, 0.020481}, 0.7, "f2"),
       finger({-0.001323, -0.034891, 0.002425}, {0.03781, 0.996879, -0.0693}, 0.7, "f3")},
      max);
}
Grasp<3> two_pads(double max = 20) {
  std::vector<Contact<3>> contacts = {finger({0.035, 0, 0}, {-1, 0, 0}, 0.5, "f0"),
                                      finger({-0.035, 0, 0}, {1, 0, 0}, 0.5, "f1")};
  for (Contact<3>& contact : contacts)
    contact.pad = rectangular_pad({0.02, 0.02}, {0, 0, 1}, contact.normal, 3);
  return shaken(std::move(contacts), max, DriveKind::coupled);
}

/// With what acts on the object changed.
template <int Dim, class Change>
Grasp<Dim> with_loads(const Grasp<Dim>& grasp, const Change& change) {
  std::vector<Load<Dim>> loads = grasp.loads();
  for (Load<Dim>& load : loads) change(load);
  return {std::move(loads), grasp.contacts(), 1, grasp.mechanism()};
}
/// By forces up to a million times the loads as they are.
template <int Dim>
bool is_held(const Grasp<Dim>& grasp, const Vector<Dim>& up, const Vector<Dim>& acceleration) {
  for (Load<Dim> load : grasp.loads()) {
    const double size = load.size(grasp.length());
    load.acceleration += acceleration;
    if (!hold<Dim>(grasp, load.at(up), size, Twist<Dim>(Twist<Dim>::Zero())).holdable) return false;
  }
  return true;
}

template <int Dim>
Vector<Dim> random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vector<Dim> v;
  do
    for (int k = 0; k < Dim; ++k) v[k] = normal(random);
  while (!(v.norm() > 0.1));
  return v.normalized();
}

/// By how much (y, rates) show that a wrench is not held, in parts of its power: the forces'
/// greatest power written out for points, soft fingers and pads with limits.
template <int Dim>
double excess(const Grasp<Dim>& grasp, const ShakeCut<Dim>& cut, const Wrench<Dim>& w) {
  const std::vector<Drive<Dim>> drives = grasp.drives();
  double most = 0, squares = 0;
  for (std::size_t a = 0; a < cut.rates.size(); ++a) {
    EXPECT_GE(cut.rates[a], 0);
    if (cut.rates[a] > 0) most += cut.rates[a] * drives[a].max;
  }
  for (const Contact<Dim>& contact : grasp.contacts()) {
    Twist<Dim> z = cut.y;
    for (std::size_t a = 0; a < cut.rates.size(); ++a)
      for (const auto& moved : drives[a].moves)
        if (moved.finger == contact.finger) z -= cut.rates[a] * moved.twist;
    const auto at = [&](const Vector<Dim>& r) {
      Vector<Dim> v = z.template head<Dim>();
      if constexpr (Dim == 2)
        v += z[2] * Vector<2>(-r.y(), r.x());
      else
        v += Vector<3>(z.template tail<3>()).cross(r);
      return v;
    };
    const auto tangential = [&](const Vector<Dim>& v) -> Vector<Dim> {
      return v - contact.normal.dot(v) * contact.normal;
    };
    double power = 0;
    if constexpr (Dim == 3) {
      if (contact.pad) {
        Vector<3> mean = Vector<3>::Zero();
        for (std::size_t k = 0; k < contact.pad->points.size(); ++k) {
          const Vector<3> r = contact.position + contact.pad->points[k];
          mean += contact.pad->shares[k] * r;
          power += contact.friction * contact.pad->shares[k] * tangential(at(r)).norm();
        }
        const Vector<3> a = tangential(contact.pad->axis).normalized(), b = contact.normal.cross(a);
        const Vector<3> omega = z.template tail<3>();
        power += contact.normal.dot(at(mean)) + contact.pad->reach[0] * std::abs(omega.dot(b)) +
                 contact.pad->reach[1] * std::abs(omega.dot(a));
      } else {
        const double spin = contact.torsion * z.template tail<3>().dot(contact.normal);
        power = contact.normal.dot(at(contact.position)) +
                std::hypot(contact.friction * tangential(at(contact.position)).norm(), spin);
      }
    } else {
      power = contact.normal.dot(at(contact.position)) +
              contact.friction * tangential(at(contact.position)).norm();
    }
    if (power > 0 && contact.max_normal == infinity)  // of forces as long as the force cap
      squares += power * power / (1 + contact.friction * contact.friction);
    most += power *
            (power > 0 && contact.max_normal < infinity ? contact.max_normal : contact.min_normal);
  }
  return cut.y.dot(w) - most - std::sqrt(squares) * 1e6 * grasp.size();
}

/// What a shake says of itself, and holds in many directions.
template <int Dim>
void check(const Grasp<Dim>& grasp, const Vector<Dim>& up, const Shake<Dim>& found,
           std::mt19937& random, int directions) {
  const Load<Dim>& load = grasp.loads()[found.cut.load];
  const double scale = found.cut.y.norm() * load.size(grasp.length());
  if (!found.holdable) {
    EXPECT_FALSE(hold(grasp, up).holdable);
    EXPECT_EQ(found.acceleration, 0);
    EXPECT_EQ(found.bound, 0);
    if (found.proven) EXPECT_GT(excess(grasp, found.cut, load.at(up)), -1e-9 * scale);
    return;
  }
  EXPECT_TRUE(hold(grasp, up).holdable);
  EXPECT_LE(found.acceleration, found.bound * (1 + 1e-9) + 1e-9);
  if (found.bound == infinity) return;
  if (found.proven) EXPECT_LE(found.bound, found.acceleration * 1.001 + 1e-7);
  Load<Dim> beyond = load;
  beyond.acceleration += found.bound * (1 + 1e-6) * found.direction;
  EXPECT_GT(excess(grasp, found.cut, beyond.at(up)), -1e-9 * scale);
  EXPECT_FALSE(is_held<Dim>(grasp, up, (found.bound * 1.001 + 1e-5) * found.direction));
  if (!(found.acceleration > 1e-6)) return;
  for (std::size_t k = 0; k < found.held.size(); ++k) {
    const Grasp<Dim> one(grasp.loads()[k], grasp.contacts(), 1, grasp.mechanism());
    for (const Vector<Dim>& x : found.held[k])
      EXPECT_TRUE(is_held<Dim>(one, up, x * (1 - 1e-6))) << x.transpose();
  }
  for (int k = 0; k < directions; ++k) {
    const Vector<Dim> n = random_direction<Dim>(random);
    EXPECT_TRUE(is_held<Dim>(grasp, up, 0.9999 * found.acceleration * n)) << n.transpose();
    for (const auto& held : found.held) {
      double most = 0;
      for (const Vector<Dim>& x : held) most = std::max(most, x.dot(n));
      EXPECT_GE(most, found.acceleration * (1 - 1e-9));
    }
  }
}

template <int Dim>
void check(const Grasp<Dim>& grasp, const Vector<Dim>& up, const Tilting<Dim>& found,
           std::mt19937& random, int directions) {
  EXPECT_EQ(found.holdable, hold(grasp, up).holdable);
  if (!found.holdable) return;
  EXPECT_LE(found.angle, found.bound * (1 + 1e-9) + 1e-9);
  if (found.proven) EXPECT_LE(found.bound, found.angle * 1.001 + 0.01001 * degree);
  for (int k = 0; k < directions; ++k) {
    const Vector<Dim> n = random_direction<Dim>(random);
    const Vector<Dim> across = (n - up.dot(n) * up).normalized();
    const double angle = found.angle * 0.9999;
    EXPECT_TRUE(
        hold<Dim>(grasp, Vector<Dim>(std::cos(angle) * up + std::sin(angle) * across)).holdable);
  }
  if (found.bound >= pi) return;
  EXPECT_NEAR(std::acos(std::clamp(found.up.dot(up), -1.0, 1.0)), found.bound, 1e-6);
  const Vector<Dim> away = (found.up - up.dot(found.up) * up).normalized();
  const double beyond = std::min(found.bound * 1.001 + 1e-3, pi);
  EXPECT_FALSE(
      hold<Dim>(grasp, Vector<Dim>(std::cos(beyond) * up + std::sin(beyond) * away)).holdable);
}

TEST(Shake, OfFourGraspsIsThatOfAConeSolver) {
  std::mt19937 random(1);
  const struct {
    Grasp<3> grasp;
    double acceleration, along_axes;
    Vector<3> direction;
  } cases[] = {{two_soft(), 34.4964, 44.2847, {0.7409, -0.3184, 0.5913}},
               {three_points(), 43.2559, 48.974, {0.3745, 0.7612, -0.5294}},
               {four_points(), 90.3649, 101.305, {-0.8617, -0.3788, -0.3377}},
               {two_pads(), 26.5874, 31.7948, {0, -0.7536, 0.6573}}};
  for (const auto& each : cases) {
    const Shake<3> found = shake<3>(each.grasp, upright);
    ASSERT_TRUE(found.holdable && found.proven);
    EXPECT_NEAR(found.acceleration, each.acceleration, 1e-3 * each.acceleration);
    EXPECT_NEAR(found.bound, each.acceleration, 1e-3 * each.acceleration);
    EXPECT_GE(found.bound, each.acceleration * (1 - 1e-5));
    EXPECT_LE(found.acceleration, each.acceleration * (1 + 1e-5));
    const Vector<3> mirrored(-found.direction.x(), found.direction.y(), found.direction.z());
    EXPECT_GT(std::max(found.direction.dot(each.direction), mirrored.dot(each.direction)), 0.99);
    EXPECT_LE(found.holds, 100);
    check<3>(each.grasp, upright, found, random, 40);
    // The six axes alone would say that more is withstood.
    double least = infinity;
    for (int k = 0; k < 6; ++k) {
      const Vector<3> axis = (k % 2 == 0 ? 1 : -1) * Vector<3>::Unit(k / 2);
      double from = 0, to = 200;
      while (to - from > 1e-4) {
        const double middle = (from + to) / 2;
        (is_held<3>(each.grasp, upright, middle * axis) ? from : to) = middle;
      }
      least = std::min(least, from);
    }
    EXPECT_NEAR(least, each.along_axes, 1e-3 * each.along_axes);
    EXPECT_GT(least, 1.1 * found.bound);
  }
}

/// Directions over all of the sphere; from any other one of them is less than 0.06 away.
std::vector<Vector<3>> dense_directions() {
  const int count = 2000;
  std::vector<Vector<3>> directions;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, turn = 2 * pi * k / std::numbers::phi;
    const double radius = std::sqrt(1 - z * z);
    directions.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
  }
  return directions;
}

/// How far is held in the weakest of many directions: what is held is convex, so that where all
/// directions hold, all that lies between does, but for the cosine of half of their distance.
double least_end(const Grasp<3>& grasp, double start) {
  double least = start;
  for (const Vector<3>& n : dense_directions()) {
    if (is_held<3>(grasp, upright, least * n)) continue;
    double from = 0;
    while (least - from > 1e-5 * start) {
      const double middle = (from + least) / 2;
      (is_held<3>(grasp, upright, middle * n) ? from : least) = middle;
    }
  }
  return least;
}

TEST(Shake, IsTheLeastOfManyDirections) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Grasp<3>> grasps = {two_soft(), three_points(), four_points(), two_pads()};
  while (grasps.size() < 8) {  // with another com, fixed wrenches and drives
    const Grasp<3> grasp = with_loads(grasps[grasps.size() - 4], [&](Load<3>& load) {
      load.com += 0.01 * random_direction<3>(random);
      load.fixed = wrench_of<3>(part(random) * random_direction<3>(random), load.com);
      load.acceleration = part(random) * random_direction<3>(random);
    });
    grasps.push_back(grasp);
  }
  for (const Grasp<3>& grasp : grasps) {
    const Shake<3> found = shake<3>(grasp, upright);
    ASSERT_TRUE(found.holdable && found.proven);
    const double least = least_end(grasp, 1.1 * found.bound);
    EXPECT_GE(least, found.acceleration * (1 - 1e-6));
    EXPECT_LE(least, found.bound / std::cos(0.06) + 1e-5 * found.bound);
  }
}

/// A block between two fingers: what presses is left over from pushing sideways.
TEST(Shake, OfTwoOpposedFingersIsADistanceFromADiamond) {
  for (const double mu : {0.2, 0.5, 1.0}) {
    Contact<2> left{.position = {-1, 0}, .normal = {1, 0}, .friction = mu, .finger = "f0"};
    Contact<2> right{.position = {1, 0}, .normal = {-1, 0}, .friction = mu, .finger = "f1"};
    const double mass = 2, weight = mass * standard_gravity, max = 80;
    const Grasp<2> grasp({.weight = weight}, {left, right}, 1, limited<2>(2, max));
    const double expected = (2 * mu * max - weight) / std::sqrt(1 + 4 * mu * mu) / mass;
    const Shake<2> found = shake<2>(grasp, {0, 1});
    EXPECT_NEAR(found.bound, expected, 1e-3 * expected);
    EXPECT_LE(found.acceleration, expected * (1 + 1e-9));
    EXPECT_GE(found.bound, expected * (1 - 1e-9));
    std::mt19937 random(2);
    check<2>(grasp, {0, 1}, found, random, 50);
    // Contacts that are limited instead of drives, or a grip that is asked for, say the same.
    left.max_normal = right.max_normal = max;
    EXPECT_NEAR(shake<2>(Grasp<2>({.weight = weight}, {left, right}), {0, 1}).bound, expected,
                1e-3 * expected);
    left.max_normal = right.max_normal = infinity;
    const Grasp<2> free({.weight = weight}, {left, right});
    EXPECT_NEAR(shake<2>(free, {0, 1}, {.most_grip = max}).bound, expected, 1e-3 * expected);
    // Its sphere of postures lies in the diamond.
    const Tilting<2> tilted = tilting<2>(grasp, {0, 1});
    check<2>(grasp, {0, 1}, tilted, random, 20);
    EXPECT_EQ(tilted.bound, pi);
  }
}

/// On a tray it slides, or falls over, whichever comes first.
TEST(Shake, OfABlockOnATrayIsThatOfItsCone) {
  for (const double mu : {0.2, 0.5, 1.5}) {
    const double half = 0.4, height = 0.5, steep = std::min(mu, half / height);
    const Grasp<2> grasp({.weight = 3, .com = {0, height}},
                         {{.position = {-half, 0}, .normal = {0, 1}, .friction = mu},
                          {.position = {half, 0}, .normal = {0, 1}, .friction = mu}});
    const double expected = standard_gravity * steep / std::sqrt(1 + steep * steep);
    const Shake<2> found = shake<2>(grasp, {0, 1});
    ASSERT_TRUE(found.holdable && found.proven);
    EXPECT_NEAR(found.bound, expected, 1e-3 * expected);
    EXPECT_LE(found.acceleration, expected * (1 + 1e-6));
    EXPECT_GE(found.bound, expected * (1 - 1e-9));
    const Tilting<2> tilted = tilting<2>(grasp, {0, 1});
    ASSERT_TRUE(tilted.proven);
    EXPECT_NEAR(tilted.bound, std::atan(steep), 1e-3 * std::atan(steep) + 0.01 * degree);
    EXPECT_LE(tilted.angle, std::atan(steep) + 1e-6);
    EXPECT_GE(tilted.bound, std::atan(steep) - 1e-9);
  }
  // In space with the com between four feet: a round cone.
  std::vector<Contact<3>> feet;
  for (const Vector<3>& at :
       {Vector<3>(1, 1, 0), Vector<3>(1, -1, 0), Vector<3>(-1, 1, 0), Vector<3>(-1, -1, 0)})
    feet.push_back(finger(at, upright, 0.4, ""));
  const Grasp<3> grasp({.weight = 5}, feet);
  const double slope = std::atan(0.4);
  const Shake<3> found = shake<3>(grasp, upright);
  ASSERT_TRUE(found.proven);
  EXPECT_NEAR(found.bound, standard_gravity * std::sin(slope), 2e-3 * found.bound);
  EXPECT_LE(found.acceleration, standard_gravity * std::sin(slope) * (1 + 1e-6));
  EXPECT_GE(found.bound, standard_gravity * std::sin(slope) * (1 - 1e-9));
  const Tilting<3> tilted = tilting<3>(grasp, upright);
  ASSERT_TRUE(tilted.proven);
  EXPECT_LE(tilted.angle, slope + 1e-6);
  EXPECT_GE(tilted.bound, slope - 1e-9);
  std::mt19937 random(3);
  check<3>(grasp, upright, tilted, random, 40);
}

TEST(Shake, IsInfiniteWhereNothingLimitsAHandThatHoldsAnyWrench) {
  const Grasp<2> grasp({.weight = 1}, {{.position = {-1, 0}, .normal = {1, 0}, .friction = 0.5},
                                       {.position = {1, 0}, .normal = {-1, 0}, .friction = 0.5}});
  const Shake<2> planar = shake<2>(grasp, {0, 1});
  EXPECT_TRUE(planar.holdable && planar.proven);
  EXPECT_EQ(planar.acceleration, infinity);
  EXPECT_EQ(planar.bound, infinity);
  EXPECT_EQ(tilting<2>(grasp, {0, 1}).angle, pi);
  const Grasp<3> soft({.weight = 1}, {finger({1, 0, 0}, {-1, 0, 0}, 0.5, "", 0.1),
                                      finger({-1, 0, 0}, {1, 0, 0}, 0.5, "", 0.1)});
  EXPECT_EQ(shake<3>(soft, upright).acceleration, infinity);
  EXPECT_EQ(tilting<3>(soft, upright).angle, pi);
}

TEST(Shake, IsNothingWhereThePostureIsNotHeld) {
  const Grasp<3> grasp = two_soft(2);
  ASSERT_FALSE(hold<3>(grasp, upright).holdable);
  const Shake<3> found = shake<3>(grasp, upright);
  EXPECT_FALSE(found.holdable);
  EXPECT_TRUE(found.proven);
  EXPECT_EQ(found.acceleration, 0);
  EXPECT_EQ(found.bound, 0);
  EXPECT_GT(excess(grasp, found.cut, grasp.loads()[0].at(upright)), 0);
  EXPECT_FALSE(tilting<3>(grasp, upright).holdable);
  EXPECT_EQ(tilting<3>(grasp, upright).angle, 0);
  // By friction alone: one finger at the side of a block.
  const Grasp<2> side({.weight = 1}, {{.position = {-1, 0}, .normal = {1, 0}, .friction = 0.5}});
  EXPECT_FALSE(shake<2>(side, {0, 1}).holdable);
  EXPECT_EQ(shake<2>(side, {0, 1}).acceleration, 0);
}

/// The rim of a light mug between drives that could hold 500 times as much: friction ends a few
/// m/s^2 away on one side, the drives a few thousand on the other.
Grasp<3> light_mug(std::mt19937& random) {
  Contact<3> left = finger({-0.038, -0.0012, 0.127}, {0.973, 0.229, 0}, 1, "f0");
  left.pad = Pad{.points = {{0, 0, 0}},
                 .shares = {1},
                 .axis = {0.205, -0.869, -0.45},
                 .reach = {0.0034, 0.0028}};
  Contact<3> right = finger({-0.0341, 0.0071, 0.1443}, {-0.978, 0.208, 0}, 1, "f1");
  right.pad = Pad{
      .points = {{-0.0008, -0.0039, 0.0066}, {-0.0002, -0.001, 0.0015}, {0.001, 0.0049, -0.0081}},
      .shares = {1.0 / 3, 1.0 / 3, 1.0 / 3},
      .axis = {0.183, 0.859, -0.477},
      .reach = {0.0129, 0.0048}};
  for (Contact<3>* contact : {&left, &right}) {
    contact->position += 0.003 * random_direction<3>(random);
    contact->normal += 0.05 * random_direction<3>(random);
  }
  const Load<3> load{.weight = 0.128, .com = {0, -0.0021, 0.0939}};
  return {load, {left, right}, 1, limited<3>(2, 70, DriveKind::coupled)};
}

TEST(Shake, OfALightObjectBetweenStrongDrivesIsFound) {
  std::mt19937 random(8);
  int shaken = 0, unproven = 0;
  for (int k = 0; k < 100; ++k) {
    const Grasp<3> grasp = light_mug(random);
    const Shake<3> found = shake<3>(grasp, upright);
    if (!found.holdable) continue;
    // Rounding at the border of friction may leave more than the gap.
    EXPECT_LE(found.bound, 1.02 * found.acceleration + 1e-6) << k;
    unproven += found.proven ? 0 : 1;
    shaken += found.acceleration > 0.1 ? 1 : 0;
    check<3>(grasp, upright, found, random, 10);
  }
  EXPECT_GT(shaken, 50);
  EXPECT_LE(unproven, 10);
}

/// Hard fingers do not resist a turn about the line between them: only in one plane is there
/// anything to gain, and that has no size.
TEST(Shake, OfTwoHardFingersBesideTheCentreIsNothing) {
  const Grasp<3> grasp(
      {.weight = 1, .com = {0, 0, -0.1}},
      {finger({1, 0, 0}, {-1, 0, 0}, 0.8, "f0"), finger({-1, 0, 0}, {1, 0, 0}, 0.8, "f1")}, 1,
      limited<3>(2, 10));
  ASSERT_TRUE(hold<3>(grasp, upright).holdable);
  const Shake<3> found = shake<3>(grasp, upright);
  EXPECT_TRUE(found.holdable);
  EXPECT_LE(found.acceleration, 1e-6);
  EXPECT_LE(found.bound, 1e-6);
  const Tilting<3> tilted = tilting<3>(grasp, upright);
  EXPECT_LE(tilted.bound, 0.02 * degree);
}

TEST(Shake, GrowsWithTheDrivesAndFallsWithTheLoad) {
  double before = 0;
  for (const double max : {5.0, 8.0, 12.0, 20.0, 40.0}) {
    const double found = shake<3>(three_points(max), upright, {.gap = 1e-4}).acceleration;
    EXPECT_GT(found, before);
    before = found;
  }
  const Grasp<3> grasp = four_points();
  const double light = shake<3>(grasp, upright).acceleration;
  const Grasp<3> heavy = with_loads(grasp, [](Load<3>& load) { load.weight *= 2; });
  EXPECT_LT(shake<3>(heavy, upright).bound, light);
  // Twice the mass and twice the force are the same.
  Grasp<3> both({.weight = 0.8 * standard_gravity, .com = {0, 0.004, 0.006}}, grasp.contacts(), 1,
                limited<3>(4, 40));
  EXPECT_NEAR(shake<3>(both, upright).acceleration, light, 1.1e-3 * light);
  // A wrench besides the weight that is as much as an acceleration leaves what that leaves.
  const Vector<3> push(1, 2, -3);
  const Grasp<3> moved = with_loads(grasp, [&](Load<3>& load) { load.acceleration = push; });
  const Grasp<3> pushed = with_loads(grasp, [&](Load<3>& load) {
    load.fixed = wrench_of<3>(load.weight / standard_gravity * push, load.com);
  });
  EXPECT_NEAR(shake<3>(moved, upright).bound, shake<3>(pushed, upright).bound, 0.1);
  EXPECT_GE(shake<3>(moved, upright).bound, light - push.norm());
}

TEST(Shake, OfSeveralLoadsIsTheLeast) {
  const Grasp<3> one = four_points();
  std::vector<Load<3>> loads(3, one.loads().front());
  loads[1].weight *= 1.5;
  loads[1].com = {0.002, 0, 0};
  loads[2].lift = 3;
  const Grasp<3> all(loads, one.contacts(), 1, one.mechanism());
  double least = infinity, most = infinity;
  for (const Load<3>& load : loads) {
    const Shake<3> found = shake<3>(Grasp<3>(load, one.contacts(), 1, one.mechanism()), upright);
    least = std::min(least, found.acceleration);
    most = std::min(most, found.bound);
  }
  const Shake<3> found = shake<3>(all, upright);
  EXPECT_TRUE(found.proven);
  EXPECT_NEAR(found.acceleration, least, 1.1e-3 * least);
  EXPECT_NEAR(found.bound, most, 1.1e-3 * most);
  std::mt19937 random(4);
  check<3>(all, upright, found, random, 30);
  check<3>(all, upright, tilting<3>(all, upright), random, 30);
}

TEST(Shake, KnowsNothingOfLoadsWithoutWeight) {
  const Grasp<3> grasp = with_loads(four_points(), [](Load<3>& load) {
    load.weight = 0;
    load.fixed << 1, 0, 0, 0, 0, 0;
  });
  const Shake<3> found = shake<3>(grasp, upright);
  EXPECT_TRUE(found.holdable);
  EXPECT_EQ(found.acceleration, infinity);
  EXPECT_EQ(tilting<3>(grasp, upright).angle, pi);
}

TEST(Shake, RefusesSettingsOutOfTheirRanges) {
  const Grasp<3> grasp = four_points();
  EXPECT_THROW(shake<3>(grasp, upright, {.gap = 0}), InvalidGrasp);
  EXPECT_THROW(shake<3>(grasp, upright, {.force_cap = -1}), InvalidGrasp);
  EXPECT_THROW(shake<3>(grasp, upright, {.most_grip = 0.0}), InvalidGrasp);
  EXPECT_THROW(shake<3>(grasp, Vector<3>(0, 0, 2)), InvalidGrasp);
  EXPECT_THROW(tilting<3>(grasp, upright, {.max_holds = 0}), InvalidGrasp);
}

/// Any fingers round a ball, of any kind, with limits of any kind.
template <int Dim>
Grasp<Dim> random_grasp(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1);
  const auto one_in = [&](int n) { return part(random) * n < 1; };
  Load<Dim> load{.weight = 1 + 9 * part(random)};
  load.com = 0.3 * part(random) * random_direction<Dim>(random);
  if (one_in(3)) load.lift = 10 * part(random) - 3;
  if (one_in(3)) load.acceleration = 3 * part(random) * random_direction<Dim>(random);
  if (one_in(3))
    load.fixed = wrench_of<Dim>(2 * part(random) * random_direction<Dim>(random),
                                random_direction<Dim>(random));
  std::vector<Contact<Dim>> contacts;
  const std::size_t count = 2 + static_cast<std::size_t>(4 * part(random));
  for (std::size_t k = 0; k < count; ++k) {
    Contact<Dim> contact;
    contact.position = random_direction<Dim>(random);
    contact.normal = (-contact.position + 0.2 * random_direction<Dim>(random)).normalized();
    contact.friction = 0.2 + part(random);
    contact.finger = "f" + std::to_string(k);
    if (one_in(4)) contact.max_normal = 5 + 30 * part(random);
    if (one_in(6)) contact.min_normal = part(random);
    if constexpr (Dim == 3) {
      if (one_in(2))
        contact.torsion = 0.02 + 0.3 * part(random);
      else if (one_in(3))
        contact.pad = rectangular_pad({0.3, 0.2}, {0.3, 0.5, 0.8}, contact.normal, 2);
    }
    contacts.push_back(std::move(contact));
  }
  const DriveKind kind = one_in(3) ? DriveKind::coupled : DriveKind::each;
  const double max = one_in(5) ? infinity : 10 + 40 * part(random);
  return {load, std::move(contacts), 1, limited<Dim>(count, max, kind)};
}

template <int Dim>
void try_random_grasps(unsigned seed, int count) {
  std::mt19937 random(seed);
  int shaken = 0, unproven = 0;
  for (int k = 0; k < count; ++k) {
    SCOPED_TRACE(testing::Message() << "grasp " << k << " of seed " << seed);
    const Grasp<Dim> grasp = random_grasp<Dim>(random);
    const Vector<Dim> up = random_direction<Dim>(random);
    const Shake<Dim> found = shake<Dim>(grasp, up);
    check<Dim>(grasp, up, found, random, 15);
    const Tilting<Dim> tilted = tilting<Dim>(grasp, up);
    check<Dim>(grasp, up, tilted, random, 15);
    shaken += found.acceleration > 0.1 ? 1 : 0;
    unproven += found.proven && tilted.proven ? 0 : 1;
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(shaken, count / 8);
  EXPECT_LE(unproven, count / 50);
}
TEST(Shake, OfRandomGraspsInThePlaneIsWhatHoldsSay) { try_random_grasps<2>(5, 200); }
TEST(Shake, OfRandomGraspsInSpaceIsWhatHoldsSay) { try_random_grasps<3>(6, 150); }

/// Of this grasp one border point of what is held has no forces of its own.
TEST(Shake, TiltingIsToldALittleNearerWhereRoundingDecides) {
  std::mt19937 random(1006);
  std::optional<Grasp<3>> grasp;
  Vector<3> up;
  for (int k = 0; k <= 23; ++k) {
    grasp.emplace(random_grasp<3>(random));
    up = random_direction<3>(random);
  }
  const Tilting<3> tilted = tilting<3>(*grasp, up);
  check<3>(*grasp, up, tilted, random, 200);
  EXPECT_NEAR(tilted.bound, 0.8826, 1e-3);
  EXPECT_GT(tilted.angle, 0.98 * tilted.bound);
  // All that is told is held, and the cap lies in the hull of it.
  for (const Vector<3>& x : tilted.held[0]) {
    Load<3> load = grasp->loads()[0];
    load.lift = x.norm() * (standard_gravity + load.lift) - standard_gravity;
    EXPECT_TRUE(hold<3>(*grasp, load, Vector<3>(x.normalized())).holdable);
  }
  for (int k = 0; k < 500; ++k) {
    const Vector<3> n = random_direction<3>(random);
    double most = -infinity;
    for (const Vector<3>& x : tilted.held[0]) most = std::max(most, n.dot(x));
    const double away = std::acos(std::clamp(n.dot(up), -1.0, 1.0));
    EXPECT_GE(most, std::cos(std::max(away - tilted.angle, 0.0)) * (1 - 1e-9));
  }
}

}  // namespace
}  // namespace poise::test
