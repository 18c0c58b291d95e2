// Conventions of angles, and the cradled wedge.
#include "poise/posture.hpp"

#include <gtest/gtest.h>

#include "poise/posture_curve.hpp"
#include "random_grasps.hpp"

namespace poise::test {
namespace {

Grasp<2> at_points(const Vector<2>& com, const std::vector<Vector<2>>& points) {
  Held held{{1, com}, {}};
  for (const Vector<2>& point : points) {
    Contact<2> contact;
    contact.position = point;
    contact.normal = {0, 1};
    contact.friction = 1;
    held.contacts.push_back(contact);
  }
  return held.grasp();
}

TEST(Posture, CountsFromTheObjectsYClockwise) {
  EXPECT_EQ(up_at(0), Vector<2>(0, 1));
  EXPECT_NEAR((up_at(pi / 2) - Vector<2>(1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR(angle_of({1, 0}), pi / 2, 1e-15);
  EXPECT_NEAR(angle_of({-1, 0}), -pi / 2, 1e-15);
  EXPECT_NEAR(angle_of({0, -1}), pi, 1e-15);
}

RC_GTEST_PROP(Posture, AngleIsThatOfUp, ()) {
  const double theta = random_angle();
  RC_ASSERT(std::abs(std::remainder(angle_of(up_at(theta)) - theta, 2 * pi)) < 1e-15);
}

TEST(CradledWedge, OfADiskIsBetweenItsFingers) {
  const double phi = 5 * pi / 12;
  const Grasp<2> grasp =
      at_points({0, 0}, {{std::sin(phi), std::cos(phi)}, {-std::sin(phi), std::cos(phi)}});
  const Interval wedge = fork_wedge(grasp, grasp.center());
  EXPECT_NEAR(wedge.from, pi - phi, 1e-14);
  EXPECT_NEAR(wedge.to, pi + phi, 1e-14);
  const Interval rest = domain_interval(grasp, Domain::pinching_up);
  EXPECT_NEAR(rest.from, -(pi - phi), 1e-14);
  EXPECT_NEAR(rest.to, pi - phi, 1e-14);
}

TEST(CradledWedge, IsAboveTheContactsWhereTheComIs) {
  const Grasp<2> grasp = at_points({0, 1}, {{1, 0}, {0, -3}, {-1, 0}});
  const Interval wedge = fork_wedge(grasp, grasp.center());
  EXPECT_NEAR(wedge.from, -pi / 4, 1e-14);
  EXPECT_NEAR(wedge.to, pi / 4, 1e-14);
}

TEST(CradledWedge, IsEmptyWhereNothingIsCradled) {
  const std::vector<Grasp<2>> without{
      at_points({0, 0}, {{1, 0}}),                           // one contact
      at_points({0, 0}, {{0, 0}}),                           // at the com
      at_points({0, 0}, {{1, 0}, {-1, 0}}),                  // the com between two
      at_points({0, 0}, {{1, 0}, {2, 0}}),                   // on one line with the com
      at_points({0, 0}, {{1, 1}, {1, 1}}),                   // at one point
      at_points({0, 0.1}, {{1, 0}, {-1, 0}, {0, 1}}),        // the com in the hull
      at_points({0, 0}, {{1, 0}, {-1, 0}, {0, 1}}),          // on its edge
      at_points({0, 0}, {{1, 1e-11}, {-1, 1e-11}, {0, 1}}),  // within 1e-9 L of its edge
      at_points({0, 0}, {{1, 0}, {-1, 0}, {0, 1}, {0, 0}}),  // at its corner
  };
  for (const Grasp<2>& grasp : without) {
    const Interval wedge = fork_wedge(grasp, grasp.center());
    EXPECT_EQ(wedge.from, wedge.to);
    const Interval all = domain_interval(grasp, Domain::pinching_up);
    EXPECT_EQ(all.from, -pi);
    EXPECT_EQ(all.to, pi);
  }
}

TEST(CradledWedge, IsNearlyHalfTheCircleJustOutsideOfTheHull) {
  const Grasp<2> grasp = at_points({0, 0}, {{1, -1e-8}, {-1, -1e-8}, {0, -1}});
  const Interval wedge = fork_wedge(grasp, grasp.center());
  EXPECT_NEAR(wedge.from, -pi / 2, 1e-7);
  EXPECT_NEAR(wedge.to, pi / 2, 1e-7);
  EXPECT_LT(wedge.to - wedge.from, pi);
}

double cross(const Vector<2>& a, const Vector<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Whether the line straight down from the com meets the segment between two contacts.
bool below(const Vector<2>& down, const Vector<2>& a, const Vector<2>& b) {
  const double side_a = cross(down, a), side_b = cross(down, b);
  if ((side_a > 0) == (side_b > 0)) return false;
  return down.dot(a + side_a / (side_a - side_b) * (b - a)) > 0;
}

/// Outside of the hull of the contacts is where one of them, seen from the com, has all the others
/// to its left.
bool outside_of_hull(const std::vector<Vector<2>>& arms) {
  return std::any_of(arms.begin(), arms.end(), [&](const Vector<2>& a) {
    return std::all_of(arms.begin(), arms.end(),
                       [&](const Vector<2>& b) { return &a == &b || cross(a, b) > 0; });
  });
}

RC_GTEST_PROP(CradledWedge, IsWhereTheHullIsStraightBelowTheComOutside, ()) {
  const Held held = *grasps({.least_contacts = 2, .awkward = false});
  const Grasp<2> grasp = held.grasp();
  std::vector<Vector<2>> arms;
  for (const Contact<2>& contact : held.contacts)
    arms.emplace_back(contact.position - held.object.com);
  for (const Vector<2>& a : arms)
    for (const Vector<2>& b : arms)
      if (&a != &b && std::abs(cross(a, b)) < 1e-6) return;  // on one line with the com
  const Interval wedge = fork_wedge(grasp, grasp.center());
  RC_ASSERT(wedge.from >= -pi && wedge.from < pi);
  RC_ASSERT(wedge.from <= wedge.to && wedge.to - wedge.from < pi);
  for (int i = 0; i < 10; ++i) {
    const double theta = pi * coordinate();
    const Vector<2> down = -up_at(theta);
    double nearest = 1;
    bool meets = false;
    for (const Vector<2>& a : arms) {
      nearest = std::min(nearest, std::abs(cross(down, a)) / a.norm());
      for (const Vector<2>& b : arms) meets = meets || below(down, a, b);
    }
    if (nearest < 1e-6) continue;  // at an end of the wedge, perhaps
    const double within = theta < wedge.from ? theta + 2 * pi : theta;
    RC_ASSERT((within > wedge.from && within < wedge.to) == (meets && outside_of_hull(arms)));
  }
}

RC_GTEST_PROP(CradledWedge, AndThePinchedDomainAreTheWholeCircle, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const Interval wedge = fork_wedge(grasp, grasp.center()),
                 rest = domain_interval(grasp, Domain::pinching_up);
  RC_ASSERT(rest.from >= -pi && rest.from < pi && rest.to <= rest.from + 2 * pi);
  RC_ASSERT(std::abs(rest.to - rest.from + wedge.to - wedge.from - 2 * pi) < 1e-14);
  if (wedge.to > wedge.from)
    RC_ASSERT(std::abs(std::remainder(rest.from - wedge.to, 2 * pi)) < 1e-14);
}

}  // namespace
}  // namespace poise::test
