// The least grip against closed forms, published values, laws, and its certificate checked from the
// contacts alone.
#include "poise/grip.hpp"

#include <gtest/gtest.h>

#include "random_space_grasps.hpp"

namespace poise::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double standard = standard_gravity;

Contact<3> finger(const Vector<3>& position, const Vector<3>& normal, double friction,
                  const std::string& name = "") {
  return {.position = position, .normal = normal, .friction = friction, .finger = name};
}

Contact<3> square_pad(const Vector<3>& position, const Vector<3>& normal, double friction,
                      double side, const Vector<3>& axis, int grid = 4) {
  Contact<3> contact = finger(position, normal, friction);
  contact.pad = rectangular_pad({side, side}, axis, normal, grid);
  return contact;
}

template <int Dim>
double least(const Grasp<Dim>& grasp, const Vector<Dim>& up) {
  const Hold<Dim> hold = least_grip(grasp, up);
  return hold.holdable ? grip(grasp, hold) : infinity;
}

// Closed forms.

TEST(LeastGrip, OfTwoFingersIsTheWeightOverTwiceTheFriction) {
  const Grasp<3> grasp({.weight = 8 * 9.8}, {finger({-0.05, 0, 0}, {1, 0, 0}, 0.5),
                                             finger({0.05, 0, 0}, {-1, 0, 0}, 0.5)});
  EXPECT_NEAR(least<3>(grasp, {0, 0, 1}), 78.4, 78.4e-9);
}

TEST(LeastGrip, OfThreeFingersWithSafetyIsTheirShareOfTheWeight) {
  std::vector<Contact<3>> contacts;
  for (int k = 0; k < 3; ++k) {
    const Vector<2> out = direction(2 * pi * k / 3);
    contacts.push_back(finger({out.x(), out.y(), 0}, {-out.x(), -out.y(), 0}, 0.45));
  }
  const Grasp<3> grasp({.weight = 9.8}, contacts, 1.5);
  EXPECT_NEAR(least<3>(grasp, {0, 0, 1}), 9.8 * 1.5 / (3 * 0.45), 1e-8);
}

// Friction and torsion share one ellipse: F = S sqrt((W / 2 mu)^2 + (W e / 2 gamma)^2).
TEST(LeastGrip, OfSoftFingersWithAnOffsetComIsTheEllipse) {
  const double mu = 0.8, gamma = 0.01, e = 0.02, W = 19.62, S = 2;
  std::vector<Contact<3>> contacts = {finger({-0.025, 0, 0}, {1, 0, 0}, mu),
                                      finger({0.025, 0, 0}, {-1, 0, 0}, mu)};
  for (Contact<3>& contact : contacts) contact.torsion = gamma;
  const Grasp<3> grasp({.weight = W, .com = {0, e, 0}}, contacts, S);
  const double expected = S * std::hypot(W / (2 * mu), W * e / (2 * gamma));
  EXPECT_NEAR(least<3>(grasp, {0, 0, 1}), expected, 1e-9 * expected);
}

// The lower jaw carries the weight and the upper one's force, both at the ends of their reach;
// friction adds a couple over the thickness.
TEST(LeastGrip, OfASheetAtItsEdgeIsCarriedByTheCentresOfPressure) {
  const double mu = 0.5, reach = 0.01, com = 0.05, thick = 0.001;
  const std::vector<Contact<3>> contacts = {
      square_pad({0, 0, -thick / 2}, {0, 0, 1}, mu, 2 * reach, {1, 0, 0}),
      square_pad({0, 0, thick / 2}, {0, 0, -1}, mu, 2 * reach, {1, 0, 0})};
  const double upper = (com - reach) / (2 * reach + mu * thick);
  const Grasp<3> each({.weight = 1, .com = {com, 0, 0}}, contacts);
  EXPECT_NEAR(least<3>(each, {0, 0, 1}), 1 + upper, 5e-8);
  const Hold<3> hold = least_grip<3>(each, {0, 0, 1});
  EXPECT_NEAR(hold.forces[0].center_of_pressure.x(), reach, 1e-6);
  EXPECT_NEAR(hold.forces[1].center_of_pressure.x(), -reach, 1e-6);
  // Self-centring jaws: the mechanism carries half the weight.
  const Grasp<3> coupled({.weight = 1, .com = {com, 0, 0}}, contacts, 1,
                         {.kind = DriveKind::coupled});
  EXPECT_NEAR(least<3>(coupled, {0, 0, 1}), 0.5 + upper, 5e-8);
}

TEST(LeastGrip, OfVJawsIsAtMostTheRuleOfThumb) {
  std::vector<Contact<3>> contacts;
  for (const double side : {-1.0, 1.0})
    for (const double up : {-1.0, 1.0})
      contacts.push_back(finger(Vector<3>(side, up, 0) * 0.01414214, Vector<3>(-side, -up, 0), 0.2,
                                side < 0 ? "left" : "right"));
  const Grasp<3> grasp({.weight = standard}, contacts, 2);
  const double rule = standard * 2 * std::sin(pi / 4) / (2 * 0.2),
               least_force = least<3>(grasp, {0, 0, 1});
  EXPECT_LE(least_force, rule);
  EXPECT_NEAR(least_force, 34.49794, 1e-4);  // a cone solver that shares no code
  EXPECT_NEAR((grasp.closing(0) - Vector<3>(1, 0, 0)).norm(), 0, 1e-15);
}

// Princeton Library of Nonlinear Programming Models, grasp (Lobo, Vandenberghe, Boyd, Lebret 1998).
TEST(LeastGrip, OfANoseConeInFiveFingersIsThePublishedOne) {
  std::vector<Contact<3>> contacts;
  for (int k = 0; k < 5; ++k) {
    // On z = x^2 + y^2, round the axis x = 0.3 of the fingers.
    const Vector<2> at = Vector<2>(0.3, 0) + direction(2 * pi * (k + 1) / 5);
    contacts.push_back(
        finger({at.x(), at.y(), at.squaredNorm()}, {-2 * at.x(), -2 * at.y(), 1}, 0.3));
  }
  const Grasp<3> grasp({.weight = 1}, contacts);
  EXPECT_NEAR(least<3>(grasp, {0, 0, 1}), 0.49108896, 2e-8);
}

// Two fingers on pins, by virtual work: each presses with W / 2 mu and carries half the weight.
TEST(LeastGrip, OfJointsIsATorque) {
  const std::vector<Contact<2>> contacts = {
      {.position = {-0.03, 0}, .normal = {1, 0}, .friction = 0.6, .finger = "left"},
      {.position = {0.03, 0}, .normal = {-1, 0}, .friction = 0.6, .finger = "right"}};
  Mechanism<2> pins{.kind = DriveKind::listed};
  for (const double side : {-1.0, 1.0}) {
    // About (side 0.02, -0.06), closing inwards: v = -omega x through.
    const double omega = side;
    pins.drives.push_back(
        {side < 0 ? "left pin" : "right pin",
         {{side < 0 ? "left" : "right", {-omega * 0.06, -omega * side * 0.02, omega}}},
         2,
         true});
  }
  const Grasp<2> grasp({.weight = 10}, contacts, 1, pins);
  EXPECT_EQ(grip_unit(grasp), GripUnit::newton_metre);
  EXPECT_EQ(most_grip(grasp), 2);
  const double expected = 10 / (2 * 0.6) * 0.06 + 10.0 / 2 * 0.01;
  EXPECT_NEAR(least<2>(grasp, {0, 1}), expected, 1e-9);
}

TEST(LeastGrip, IsNothingWhereFixedFingersCarryTheObject) {
  const std::vector<Contact<3>> contacts = {
      finger({0.1, 0, 0}, {0, 0, 1}, 0.5, "fork"), finger({-0.1, 0.1, 0}, {0, 0, 1}, 0.5, "fork"),
      finger({-0.1, -0.1, 0}, {0, 0, 1}, 0.5, "fork"), finger({0, 0, 0.1}, {0, 0, -1}, 0.5, "jaw")};
  Mechanism<3> jaw{.kind = DriveKind::listed};
  Twist<3> down = Twist<3>::Zero();
  down[2] = -1;
  jaw.drives.push_back({"jaw", {{"jaw", down}}});
  EXPECT_NEAR(least<3>(Grasp<3>({.weight = 5}, contacts, 1, jaw), {0, 0, 1}), 0, 1e-8);
}

// Even pressure over a pad that turns about its middle by friction alone: the sum over ever finer
// cells goes to the integral of |r| over the square, mu N a (sqrt 2 + asinh 1) / 6.
TEST(Pad, OfFinerCellsComesNearTheContinuumFromAbove) {
  const double side = 0.02, mu = 0.5, W = 10;
  const double mean = side * (std::sqrt(2) + std::asinh(1)) / 6;
  double last = infinity;
  for (const int grid : {2, 4, 8, 16, 32}) {
    const Contact<3> contact = square_pad({0, 0, 0}, {1, 0, 0}, mu, side, {0, 1, 0}, grid);
    double sum = 0;
    for (std::size_t k = 0; k < contact.pad->points.size(); ++k)
      sum += contact.pad->shares[k] * contact.pad->points[k].norm();
    EXPECT_LT(std::abs(sum / mean - 1), 0.4 / (grid * grid)) << grid;
    // The com beside the pads: halving the cells never needs more (Jensen).
    const Grasp<3> grasp({.weight = W, .com = {0, 0.01, 0}},
                         {square_pad({-0.01, 0, 0}, {1, 0, 0}, mu, side, {0, 1, 0}, grid),
                          square_pad({0.01, 0, 0}, {-1, 0, 0}, mu, side, {0, 1, 0}, grid)});
    const double now = least<3>(grasp, {0, 0, 1});
    EXPECT_LE(now, last * (1 + 1e-9));
    if (grid == 4) EXPECT_NEAR(now, 17.688, 5e-4);  // as docs/theory.md says
    last = now;
  }
  EXPECT_NEAR(last, 17.410, 0.006);  // even pressure integrated: found by bisection, not by cells
}

TEST(Pad, OfOnePointWithoutReachIsAPointContact) {
  std::vector<Contact<3>> points, pads;
  for (int k = 0; k < 3; ++k) {
    const Vector<2> out = direction(2 * pi * k / 3 + 0.2);
    points.push_back(finger({out.x(), out.y(), 0.1 * k}, {-out.x(), -out.y(), 0.1}, 0.6));
    pads.push_back(points.back());
    pads.back().pad = Pad{.points = {Vector<3>::Zero()}, .shares = {1}, .axis = {0, 0, 1}};
  }
  const Load<3> load{.weight = 3, .com = {0.1, 0.05, -0.1}};
  const Grasp<3> as_points(load, points), as_pads(load, pads);
  for (const Vector<3>& up : {Vector<3>(0, 0, 1), Vector<3>(0.6, 0, 0.8), Vector<3>(0, -1, 0)}) {
    // Forces of the least effort may take so much more of the grip.
    EXPECT_NEAR(least(as_points, up), least(as_pads, up), 1.1e-8 * least(as_points, up));
    EXPECT_NEAR(hold(as_points, up).effort, hold(as_pads, up).effort, 1e-7);
  }
}

TEST(Drives, LimitTheEffort) {
  // Two fingers press with 5 N each or more; a limit below is too weak, a limit above is not felt.
  const std::vector<Contact<3>> contacts = {finger({-1, 0, 0}, {1, 0, 0}, 1, "left"),
                                            finger({1, 0, 0}, {-1, 0, 0}, 1, "right")};
  const auto with = [&](double most) {
    return Grasp<3>({.weight = 10}, contacts, 1,
                    {.fingers = {{.name = "left", .max_force = most}, {.name = "right"}}});
  };
  // A limit that is exactly met holds, by either objective.
  const Grasp<3> exact(
      {.weight = 10}, contacts, 1,
      {.fingers = {{.name = "left", .max_force = 5}, {.name = "right", .max_force = 5}}});
  EXPECT_TRUE(hold<3>(exact, {0, 0, 1}).holdable);
  EXPECT_TRUE(hold<3>(exact, {0, 0, 1}, {.objective = Objective::grip}).holdable);
  const Hold<3> weak = hold<3>(with(4.99), {0, 0, 1}), strong = hold<3>(with(5.01), {0, 0, 1});
  EXPECT_FALSE(weak.holdable);
  EXPECT_TRUE(weak.proven);
  EXPECT_NE(reason(with(4.99), weak).find("left gives 4.99 N at most"), std::string::npos);
  ASSERT_TRUE(strong.holdable);
  EXPECT_NEAR(strong.effort, 4 * 25, 1e-6);
  EXPECT_NEAR(strong.lower_bound, strong.effort, 1e-7 * strong.effort);
}

// The certificate, from the contacts alone.

template <int Dim>
Twist<Dim> felt_by(const Grasp<Dim>& grasp, std::size_t finger, const Hold<Dim>& hold) {
  Twist<Dim> felt = hold.dual;
  const std::vector<Drive<Dim>> drives = grasp.drives();
  for (std::size_t a = 0; a < drives.size(); ++a)
    for (const auto& moved : drives[a].moves)
      if (moved.finger == grasp.fingers()[finger]) felt -= hold.rates[a] * moved.twist;
  return felt;
}

double power(const Contact<2>& c, const Twist<2>& y) {
  const Vector<2> u(y[0] - y[2] * c.position.y(), y[1] + y[2] * c.position.x());
  return u.dot(c.normal) + c.friction * std::abs(c.normal.x() * u.y() - c.normal.y() * u.x());
}
double power(const Contact<3>& c, const Twist<3>& y) {
  const Vector<3> omega = y.tail<3>();
  const Vector<3> u = y.head<3>() + omega.cross(c.position);
  const double n = u.dot(c.normal), turn = omega.dot(c.normal) * c.torsion;
  return n + std::hypot(c.friction * (u - n * c.normal).norm(), turn);
}

/// What the certificate proves: (10) with limits.
template <int Dim>
double proven(const Grasp<Dim>& grasp, const Hold<Dim>& hold, const Wrench<Dim>& load) {
  double bound = hold.dual.dot(load);
  for (std::size_t i = 0; i < grasp.contacts().size(); ++i) {
    const Contact<Dim>& contact = grasp.contacts()[i];
    const double e = power(contact, felt_by(grasp, grasp.finger_of(i), hold));
    if (e <= 0)
      bound -= e * contact.min_normal;
    else if (std::isfinite(contact.max_normal))
      bound -= e * contact.max_normal;
    else
      RC_ASSERT(e <= 1e-10 * (1 + hold.dual.cwiseAbs().sum()));
  }
  return bound;
}

template <int Dim>
bool has_closings(const Grasp<Dim>& grasp) {
  for (std::size_t k = 0; k < grasp.fingers().size(); ++k)
    if (grasp.closing(k).isZero(0)) return false;
  return true;
}

template <int Dim>
void check_least_grip(const Grasp<Dim>& grasp, const Vector<Dim>& up) {
  const Load<Dim>& load = grasp.loads().front();
  const Hold<Dim> plain = hold(grasp, up), tight = least_grip(grasp, up);
  RC_ASSERT(tight.holdable == plain.holdable);
  if (!tight.holdable) return;
  const double F = grip(grasp, tight), scale = std::max(F, 1e-6 * load.weight);
  RC_ASSERT(tight.residual <= 1e-9);
  for (std::size_t i = 0; i < tight.forces.size(); ++i) {
    RC_ASSERT(tight.forces[i].normal >= grasp.contacts()[i].min_normal - 1e-8 * load.weight);
    RC_ASSERT(tight.forces[i].normal <= grasp.contacts()[i].max_normal + 1e-8 * load.weight);
    RC_ASSERT(tight.forces[i].friction_used <= 1);
  }
  RC_ASSERT(F <= grip(grasp, plain) + 1e-7 * scale);
  double sum = 0;
  for (const double rate : tight.rates) sum += rate;
  RC_ASSERT(std::abs(sum - 1) <= 1e-12);
  const double bound = proven(grasp, tight, load.at(up));
  RC_ASSERT(tight.lower_bound <= std::max(bound, 0.0) + 1e-9 * scale);
  // Near the limit of holding, where the grip is many times the weight, digits are lost.
  RC_ASSERT(F - tight.lower_bound <= (F < 100 * load.weight ? 1e-7 : 1e-6) * scale);
}

RC_GTEST_PROP(LeastGrip, OfRandomPlanarGraspsIsProven, ()) {
  const Held held = *grasps({.most_contacts = 5, .awkward = false});
  check_least_grip<2>(held.grasp(), up_at(random_angle()));
}

RC_GTEST_PROP(LeastGrip, OfRandomSpatialGraspsIsProven, ()) {
  const space::Held held =
      *space::grasps({.least_contacts = 2, .most_contacts = 6, .awkward = false});
  check_least_grip<3>(held.grasp(), space::random_direction());
}

/// Thin cones, frictionless contacts in space: what holds may be known to fewer digits, not
/// wrongly.
RC_GTEST_PROP(LeastGrip, OfAwkwardGraspsIsNeverBelowItsBound, ()) {
  const space::Held held = *space::grasps();
  const Grasp<3> grasp = held.grasp();
  const Vector<3> up = space::random_direction();
  const Hold<3> tight = least_grip(grasp, up);
  RC_ASSERT(tight.holdable || hold(grasp, up).holdable == false);
  if (!tight.holdable) return;
  RC_ASSERT(tight.residual <= 1e-9);
  const double F = grip(grasp, tight), W = held.object.weight;
  RC_ASSERT(tight.lower_bound <= F);
  for (std::size_t i = 0; i < tight.forces.size(); ++i) {
    RC_ASSERT(tight.forces[i].normal >= held.contacts[i].min_normal - 1e-7 * (W + F));
    RC_ASSERT(tight.forces[i].normal <= held.contacts[i].max_normal + 1e-7 * (W + F));
  }
}

RC_GTEST_PROP(LeastGrip, NearTheLimitOfHoldingIsProven, ()) {
  const space::Held held = *space::nearly_unholdable();
  check_least_grip<3>(held.grasp(), space::random_direction());
}

/// Points are solved by ascent, pads by the interior-point method.
RC_GTEST_PROP(LeastGrip, ByAscentIsThatOfTheInteriorPointMethod, ()) {
  space::Held held = *space::grasps({.least_contacts = 2, .most_contacts = 6, .awkward = false});
  for (Contact<3>& contact : held.contacts) {
    contact.torsion = 0;
    contact.share = 1;
  }
  const Grasp<3> as_points = held.grasp();
  for (Contact<3>& contact : held.contacts)
    contact.pad = Pad{.points = {Vector<3>::Zero()},
                      .shares = {1},
                      .axis = Vector<3>(tangents(contact.normal.normalized()).col(0))};
  const Grasp<3> as_pads = held.grasp();
  const Vector<3> up = space::random_direction();
  const double points = least(as_points, up), pads = least(as_pads, up), W = held.object.weight;
  RC_ASSERT((points < infinity) == (pads < infinity));
  if (points < infinity)
    RC_ASSERT(std::abs(points - pads) <= (points < 100 * W ? 1e-7 : 1e-6) * (1e-6 * W + points));
}

/// In a single plane of postures nothing has an inside: wide numbers end with more errors than
/// doubles, and must not make out that nothing holds.
TEST(LeastGrip, InTheOnlyPlaneOfPosturesIsFoundInDoubles) {
  const Vector<3> n(-0.90148937780592486, -0.31744579706232418, -0.29418543069049502);
  const Vector<3> other(0.43425585786165893, 0.84953496861175148, -0.29951992758189749);
  Twist<3> along = Twist<3>::Zero();
  along.head<3>() = n;
  Mechanism<3> jaw{.kind = DriveKind::listed};
  jaw.drives = {{"jaw", {{"left", along}, {"right", -along}}, 2}};
  const Grasp<3> grasp(
      {.weight = 1, .com = {-0.68538623099546492, 0.39948490023083166, 0.69116291622930193}},
      {finger(-n, n, 0.50123498908615216, "left"),
       finger(-other, other, 1.7233769821303719, "right")},
      1, jaw);
  const Vector<3> up(-0.22444508732868576, 0.92724548448790878, 0.29973357214500035);
  ASSERT_TRUE(hold(grasp, up).holdable);
  const Hold<3> held = least_grip(grasp, up);
  ASSERT_TRUE(held.holdable);
  EXPECT_LE(grip(grasp, held), grip(grasp, hold(grasp, up)) * (1 + 1e-6));
  EXPECT_NEAR(held.lower_bound, held.grip, 2e-5 * held.grip);
}

RC_GTEST_PROP(LeastGrip, GrowsWithTheLoad, ()) {
  const space::Held held = *space::grasps({.least_contacts = 2, .limits = false, .awkward = false});
  const Grasp<3> grasp = held.grasp();
  const Wrench<3> w = grasp.loads().front().at(space::random_direction());
  const Hold<3> once = least_grip<3>(grasp, w, grasp.size());
  const Hold<3> thrice = least_grip<3>(grasp, Wrench<3>(3 * w), grasp.size());
  RC_ASSERT(once.holdable == thrice.holdable);
  if (once.holdable)
    RC_ASSERT(std::abs(grip(grasp, thrice) - 3 * grip(grasp, once)) <=
              1e-7 * (grasp.size() + grip(grasp, thrice)));
}

void expect_proven(const Grasp<3>& grasp, const Vector<3>& up, double F) {
  const Hold<3> hold = least_grip(grasp, up);
  ASSERT_TRUE(hold.holdable);
  EXPECT_NEAR(hold.grip, F, 1e-7 * F);
  EXPECT_NEAR(hold.lower_bound, F, 1e-7 * F);
}

// Two fingers press down on a wedge from either side; friction is just enough to lift it:
// F (mu c - s) = W / 2.
TEST(LeastGrip, OfAWedgeThatIsLiftedByItsSlopesIsProven) {
  const double c = 0.5457426531835383, s = std::sqrt(1 - c * c), mu = s / c + 1e-4;
  const Vector<3> right(c, 0, s), left(-c, 0, s);
  std::vector<Contact<3>> contacts = {finger(right, -right, mu), finger(left, -left, mu)};
  for (Contact<3>& contact : contacts) contact.torsion = 0.3;
  expect_proven(Grasp<3>({.weight = 1}, contacts), {0, 0, 1}, 0.5 / (mu * c - s));
}

// Four frictionless fingers in a cone above the com, two of them pads: their normals alone carry.
TEST(Pad, WithoutFrictionCarriesByItsNormalForce) {
  std::vector<Contact<3>> contacts;
  for (int k = 0; k < 4; ++k) {
    const double at = pi / 2 * k, c = 0.5, s = std::sqrt(0.75);
    const Vector<3> out(c * std::cos(at), c * std::sin(at), s);
    contacts.push_back(finger(out, -out, 0));
    if (k < 2) contacts.back().pad = rectangular_pad({0.05, 0.05}, {0, 0, 1}, -out, 2);
  }
  const Grasp<3> grasp({.weight = 1}, contacts);
  const Vector<3> down(0, 0, -1);
  expect_proven(grasp, down, 1 / (4 * std::sqrt(0.75)));
  EXPECT_NEAR(hold(grasp, down).effort, 4 / (16 * 0.75), 1e-9);
}

/// Some contacts are pads.
Grasp<3> random_pads() {
  space::Held held =
      *space::grasps({.least_contacts = 2, .most_contacts = 4, .limits = false, .awkward = false});
  for (Contact<3>& contact : held.contacts) {
    if (one_in(3)) continue;
    contact.torsion = 0;
    contact.share = 1;
    const Vector<3> normal = contact.normal.normalized();
    contact.pad = rectangular_pad({real(0.05, 0.5), real(0.05, 0.5)}, tangents(normal).col(0),
                                  normal, pick(1, 3));
  }
  return held.grasp();
}

Wrench<3> random_wrench() {
  Wrench<3> wrench;
  wrench << space::random_direction(), space::random_direction();
  return wrench;
}

/// V is smooth in the load, 2 y its gradient.
RC_GTEST_PROP(Pad, TheDualIsTheGradientOfTheEffort, ()) {
  const Grasp<3> grasp = random_pads();
  const double W = grasp.size(), step = 1e-4 * W;
  const Wrench<3> w = grasp.loads().front().at(space::random_direction()), d = random_wrench();
  const auto at = [&](double length) {
    return hold<3>(grasp, Wrench<3>(w + length * d), W, Twist<3>::Zero());
  };
  const Hold<3> here = at(0), before = at(-step), after = at(step);
  if (!here.holdable || !before.holdable || !after.holdable) return;
  if (here.effort > 100 * W * W) return;  // near the limit of holding it bends much
  const double slope = (after.effort - before.effort) / (2 * step);
  RC_ASSERT(std::abs(slope - 2 * here.dual.dot(d)) <= 1e-3 * here.dual.norm());
}

/// F is convex in the load: what y proves of one load it proves of all.
RC_GTEST_PROP(Pad, TheDualIsASubgradientOfTheGrip, ()) {
  const Grasp<3> grasp = random_pads();
  if (!has_grip<3>(grasp)) return;
  const double W = grasp.size();
  const Wrench<3> w = grasp.loads().front().at(space::random_direction());
  const Wrench<3> other = w + W * real(0, 1) * random_wrench();
  const Hold<3> here = least_grip<3>(grasp, w, W), there = least_grip<3>(grasp, other, W);
  if (!here.holdable || !there.holdable) return;
  RC_ASSERT(there.grip >= here.lower_bound + here.dual.dot(other - w) - 1e-7 * (W + there.grip));
}

RC_GTEST_PROP(LeastGrip, OfCoupledFingersIsNoMoreThanOfEach, ()) {
  const space::Held held = *space::grasps({.least_contacts = 2, .limits = false, .awkward = false});
  const Grasp<3> each = held.grasp();
  const Grasp<3> coupled(each.loads().front(), held.contacts, 1, {.kind = DriveKind::coupled});
  const Vector<3> up = space::random_direction();
  const double most = least(each, up);
  if (most < infinity) RC_ASSERT(least(coupled, up) <= most + 1e-7 * (1 + most));
}

RC_GTEST_PROP(LeastGrip, StaysWhenTheFrameMoves, ()) {
  const space::Held held = *space::grasps({.awkward = false});
  const Eigen::Matrix3d R = space::random_rotation();
  const Vector<3> up = space::random_direction();
  const space::Held other = space::moved(held, R, {coordinate(), coordinate(), coordinate()});
  const double here = least<3>(held.grasp(), up), there = least<3>(other.grasp(), R * up);
  if (here < infinity && there < infinity)
    RC_ASSERT(std::abs(here - there) <= 1e-6 * (held.object.weight + here));
}

}  // namespace
}  // namespace poise::test
