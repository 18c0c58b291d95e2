// The best posture in space: its certificate by plain means, closed forms, and dense samples.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "poise/best_posture.hpp"
#include "poise/turn.hpp"
#include "random_space_grasps.hpp"
#include "space_checks.hpp"

namespace poise::test::space {
namespace {

/// Fingers round a ball, tilted a little: holdable in most postures.
Held random_hand(std::size_t contacts, bool soft) {
  Held held;
  held.object.com = 0.2 * Vector<3>(coordinate(), coordinate(), coordinate());
  for (std::size_t i = 0; i < contacts; ++i) {
    const Vector<3> at = random_direction(), off = 0.3 * random_direction();
    held.contacts.push_back(contact(at.cwiseProduct(Vector<3>(1, 1.5, 0.7)), -(at + off),
                                    real(0.3, 1), soft ? real(0.05, 0.2) : 0));
  }
  return held;
}

/// Worst effort over the loads; infinite where unholdable.
double effort_at(const std::vector<Grasp<3>>& cases, const Vector<3>& up) {
  double worst = 0;
  for (const Grasp<3>& grasp : cases) {
    const Hold<3> found = hold(grasp, up);
    if (!found.holdable) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, found.effort);
  }
  return worst;
}

/// One grasp with the loads of all of these.
Grasp<3> together(const std::vector<Grasp<3>>& cases) {
  std::vector<Load<3>> loads;
  for (const Grasp<3>& grasp : cases) loads.push_back(grasp.loads().front());
  return {loads, cases.front().contacts()};
}

struct Planes {
  std::vector<Real3> n;
  std::vector<Real> b;  ///< cut off: n . x > b
};

Planes planes_of(const std::vector<Grasp<3>>& cases, const std::vector<Cut>& cuts, Real t) {
  Planes planes;
  auto& [n, b] = planes;
  for (const Cut& c : cuts) {
    if (c.n) {
      n.emplace_back(c.n->cast<Real>());
      b.push_back(0);
    } else {
      const Grasp<3>& grasp = cases[c.load];
      const Real3 omega = c.y.tail<3>().cast<Real>();
      const Real3 v = c.y.head<3>().cast<Real>() + omega.cross(grasp.center().cast<Real>());
      n.emplace_back(Real{grasp.size()} * v);
      b.push_back(t / 2 + support(grasp, c.y));
    }
    const Real norm = n.back().norm();
    n.back() /= norm;
    b.back() /= norm;
  }
  return planes;
}

/// The certificate in a few lines that know nothing of polytopes: the farthest of all points where
/// three planes of the cuts meet and that satisfy all cuts. Slow: for few cuts.
Real farthest_of_all_corners(const Planes& planes) {
  const auto& [n, b] = planes;
  Real farthest = 0;
  for (std::size_t i = 0; i < n.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        Eigen::Matrix<Real, 3, 3> M;
        M << n[i].transpose(), n[j].transpose(), n[k].transpose();
        if (std::abs(M.determinant()) < 1e-9L) continue;
        const Real3 x = M.inverse() * Real3(b[i], b[j], b[k]);
        bool within = true;
        for (std::size_t l = 0; l < n.size() && within; ++l)
          within = n[l].dot(x) <= b[l] + 1e-10L * (1 + x.norm());
        if (within) farthest = std::max(farthest, x.norm());
      }
  return farthest;
}

/// What is wrong with an answer, or nothing: V is sampled all over the sphere.
std::string fault(const std::vector<Grasp<3>>& cases, const Best<3>& best,
                  const SpatialSettings& settings, int samples) {
  std::ostringstream words;
  words.precision(12);
  const double bound = best.lower_bound;
  if (best.status == Status::unholdable && best.holdable()) return "unholdable, but a best";
  if (best.holdable()) {
    const Minimum<3>& b = best.best();
    if (std::abs(b.up.norm() - 1) > 1e-12) return "up is not a unit vector";
    const std::string other = space::fault(cases[b.decides], b.up, b.hold());
    if (!other.empty()) return other;
    if (!(bound <= b.effort())) return "the bound is above the effort";
    if (std::abs(best.relative_gap - (b.effort() - bound) / b.effort()) > 1e-12) return "the gap";
    if ((best.status == Status::optimal) != (best.relative_gap <= settings.gap))
      return "the status";
    if (settings.tilt &&
        std::acos(std::min(1.0, b.up.dot(settings.tilt->from))) > settings.tilt->most + 1e-7)
      return "the best is tilted too much";
  }
  for (const Vector<3>& up : directions(samples)) {
    if (settings.tilt && std::acos(up.dot(settings.tilt->from)) > settings.tilt->most) continue;
    const double V = effort_at(cases, up);
    if (best.status == Status::unholdable && V < std::numeric_limits<double>::infinity())
      return "an unholdable grasp holds";
    if (V < bound * (1 - 1e-9)) {
      words << "V is " << V << " below the bound " << bound << " at " << up.transpose();
      return words.str();
    }
  }
  double shares = 0, weight = 0;
  for (const Contact<3>& contact : cases.front().contacts()) shares += contact.share;
  for (const Grasp<3>& grasp : cases) weight = std::max(weight, grasp.size());
  if (bound <= weight * weight / shares * (1 + 1e-12)) return "";  // forces add up to the weight
  const Planes planes = planes_of(cases, best.proof.cuts, bound);
  if (best.proof.cuts.size() <= 45 && farthest_of_all_corners(planes) <= 1 + 1e-7L) return "";
  // What the cuts leave may also lie outside: heavier loads that need less.
  for (const Vector<3>& up : directions(4000)) {
    bool left = true;
    for (std::size_t i = 0; i < planes.n.size() && left; ++i)
      left = planes.n[i].dot(up.cast<Real>()) <= planes.b[i] - 1e-7L;
    if (!left) continue;
    words << "the cuts leave " << up.transpose();
    return words.str();
  }
  return "";
}

RC_GTEST_PROP(SpaceBest, IsCertifiedForRandomHands, ()) {
  if (!one_in(10)) return;
  const bool soft = one_in(2);
  const Held held = random_hand(static_cast<std::size_t>(pick(3, 8)), soft);
  const std::vector<Grasp<3>> cases = {held.grasp()};
  SpatialSettings settings;
  settings.starts = 0;
  const Best<3> best = best_posture(together(cases), settings);
  RC_ASSERT(fault(cases, best, settings, 300) == "");
  if (best.holdable()) RC_ASSERT(best.status == Status::optimal || best.relative_gap < 1e-3);
}

RC_GTEST_PROP(SpaceBest, IsHonestForAnyGrasp, ()) {
  if (!one_in(10)) return;
  const Held held = *grasps({.most_contacts = 6});
  const std::vector<Grasp<3>> cases = {held.grasp()};
  SpatialSettings settings;
  settings.starts = 0;
  settings.max_holds = 200;
  if (one_in(3)) settings.tilt = Tilt{random_direction(), real(0, pi / 2)};
  const Best<3> best = best_posture(together(cases), settings);
  RC_ASSERT(fault(cases, best, settings, 200) == "");
}

TEST(SpaceBest, IsCertifiedWhereFingersMustPress) {
  int tried = 0;
  const bool all_right = rc::check([&] {
    if (!one_in(10)) return;
    Held held = random_hand(static_cast<std::size_t>(pick(3, 8)), one_in(2));
    for (Contact<3>& contact : held.contacts)
      if (one_in(2)) contact.min_normal = held.object.weight * real(0.1, 1);
    const std::vector<Grasp<3>> cases = {held.grasp()};
    SpatialSettings settings;
    settings.starts = 0;
    const Best<3> best = best_posture(together(cases), settings);
    RC_ASSERT(fault(cases, best, settings, 300) == "");
    RC_ASSERT(best.status != Status::gap);
    ++tried;
  });
  EXPECT_TRUE(all_right);
  EXPECT_GT(tried, 0);
}

RC_GTEST_PROP(SpaceBest, OfScenariosIsTheirWorstCase, ()) {
  if (!one_in(20)) return;
  const Held held = random_hand(static_cast<std::size_t>(pick(4, 6)), true);
  Held other = held;
  other.object.weight = real(0.3, 1);
  other.object.com += 0.2 * random_direction();
  const std::vector<Grasp<3>> cases = {held.grasp(), other.grasp()};
  SpatialSettings settings;
  settings.starts = 0;
  const Best<3> best = best_posture(together(cases), settings);
  RC_ASSERT(fault(cases, best, settings, 300) == "");
  if (!best.holdable()) return;
  RC_ASSERT(best.best().holds.size() == 2U);
  RC_ASSERT(close(effort_at(cases, best.best().up), best.best().effort(), 1e-9L));
}

RC_GTEST_PROP(SpaceBest, TurnsWithTheFrame, ()) {
  if (!one_in(20)) return;
  const Held held = random_hand(static_cast<std::size_t>(pick(3, 6)), true);
  const Held turned = moved(held, random_rotation(), {coordinate(), coordinate(), coordinate()});
  SpatialSettings settings;
  settings.starts = 0;
  const Best<3> a = best_posture(held.grasp(), settings);
  const Best<3> b = best_posture(turned.grasp(), settings);
  if (a.status == Status::optimal && b.status == Status::optimal)
    RC_ASSERT(close(a.best().effort(), b.best().effort(), 3e-6L));
}

TEST(SpaceBest, OfACylinderInThreeFingersIsFound) {
  // Three fingers round a cylinder, 10 N: the com 0.1 m above their plane.
  Held held{{10, {0, 0, 0.1}}, {}};
  for (int k = 0; k < 3; ++k) {
    const double at = 2 * pi * k / 3;
    const Vector<3> out(std::cos(at), std::sin(at), 0);
    held.contacts.push_back(contact(out, -out, 0.8));
  }
  const Best<3> best = best_posture(held.grasp());
  ASSERT_EQ(best.status, Status::optimal);
  EXPECT_LE(best.relative_gap, 1e-6);
  EXPECT_LT(best.proof.holds, 300);
  ASSERT_FALSE(best.minima.empty());
  EXPECT_NEAR(best.minima.front().effort(), best.best().effort(), 1e-6);
  for (std::size_t i = 1; i < best.minima.size(); ++i)
    EXPECT_GE(best.minima[i].effort(), best.best().effort() * (1 - 2e-6));
  for (const Minimum<3>& minimum : best.minima) {
    const auto across = tangents(minimum.up);
    for (int k = 0; k < 16; ++k)
      for (const double off : {1e-4, 1e-3}) {
        const Vector<3> beside =
            minimum.up + off * (across * Vector<2>(std::cos(k * pi / 8), std::sin(k * pi / 8)));
        EXPECT_GE(effort_at({held.grasp()}, beside.normalized()), minimum.effort() * (1 - 2e-6));
      }
  }
  if (const Minimum<3>* pinched = best.best_pinched()) {
    EXPECT_EQ(pinched->manner, Manner::pinched);
  }
}

TEST(SpaceBest, OfTwoSoftJawsOnTheAxisEndsInBoundedTime) {
  // A whole circle of equal V round the axis of the jaws; but along it one finger carries all.
  Held held{{10, {0, 0, 0}},
            {contact({1, 0, 0}, {-1, 0, 0}, 0.3, 0.05), contact({-1, 0, 0}, {1, 0, 0}, 0.3, 0.05)}};
  const Best<3> best = best_posture(held.grasp());
  ASSERT_TRUE(best.holdable());
  EXPECT_NEAR(std::abs(best.best().up.x()), 1, 1e-3);
  // With friction above 1 the circle is best: 2 (1 + 1 / mu^2) 5^2 < 10^2.
  for (Contact<3>& c : held.contacts) c.friction = 2;
  SpatialSettings settings;
  settings.max_holds = 300;
  const Best<3> circle = best_posture(held.grasp(), settings);
  ASSERT_TRUE(circle.holdable());
  EXPECT_LE(circle.proof.holds, 310);
  EXPECT_NEAR(circle.best().effort(), 62.5, 1e-2);
  EXPECT_GE(circle.best().effort(), 62.5 * (1 - 1e-9));
  EXPECT_LE(circle.lower_bound, 62.5 * (1 + 1e-9));
  EXPECT_GT(circle.lower_bound, 62);
}

TEST(SpaceBest, OfTwoHardJawsIsInThePlaneThatTheyLeave) {
  // The com is beside the line of the jaws: up must lie in the plane z = 0.
  const Held held{{10, {0.1, 0.2, 0}},
                  {contact({1, 0, 0}, {-1, 0, 0}, 2), contact({-1, 0, 0}, {1, 0, 0}, 2)}};
  std::vector<Contact<2>> flat(2);
  flat[0].position = {1, 0};
  flat[0].normal = {-1, 0};
  flat[1].position = {-1, 0};
  flat[1].normal = {1, 0};
  flat[0].friction = flat[1].friction = 2;
  const Grasp<2> plane({10, {0.1, 0.2}}, flat);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 200000; ++k) {
    const Hold<2> found = hold(plane, up_at(2 * pi * k / 200000));
    if (found.holdable) least = std::min(least, found.effort);
  }
  const Best<3> best = best_posture(held.grasp());
  ASSERT_TRUE(best.holdable());
  EXPECT_EQ(fault({held.grasp()}, best, {}, 2000), "");
  EXPECT_NEAR(best.best().up.z(), 0, 1e-9);
  EXPECT_NEAR(best.best().effort(), least, 1e-5 * least);
  EXPECT_EQ(best.status, Status::optimal);
}

/// Two hard jaws on the unit sphere, with the com beside the line of their points: they hold in one
/// plane of postures alone. `max`: of the one drive that presses both along the first's normal.
Grasp<3> hard_jaws(const Vector<3>& n, const Vector<3>& other, const Vector<3>& com,
                   double friction, double other_friction,
                   double max = std::numeric_limits<double>::infinity()) {
  std::vector<Contact<3>> contacts = {contact(-n, n, friction),
                                      contact(-other, other, other_friction)};
  contacts[0].finger = "left";
  contacts[1].finger = "right";
  Mechanism<3> mechanism;
  if (std::isfinite(max)) {
    Twist<3> along = Twist<3>::Zero();
    along.head<3>() = n;
    mechanism.kind = DriveKind::listed;
    mechanism.drives = {{"jaw", {{"left", along}, {"right", -along}}, max}};
  }
  return {Load<3>{.weight = 1, .com = com}, std::move(contacts), 1, std::move(mechanism)};
}

/// The least value in the plane of postures in which the weight does not turn them.
double least_in_the_plane(const Grasp<3>& grasp, Objective objective) {
  const Vector<3> point = grasp.contacts()[0].position;
  const Vector<3> line = grasp.contacts()[1].position - point, arm = grasp.center() - point;
  const Eigen::Matrix<double, 3, 2> plane = tangents(Vector<3>(line.cross(arm).normalized()));
  double least = std::numeric_limits<double>::infinity();
  constexpr int count = 3600;
  for (int k = 0; k < count; ++k) {
    const Vector<3> up = plane * up_at(2 * pi * k / count);
    const Hold<3> found = hold(grasp, Vector<3>(up.normalized()), {.objective = objective});
    if (found.holdable) least = std::min(least, found.value());
  }
  return least;
}

void expect_best_of_the_plane(const Grasp<3>& grasp, Objective objective) {
  const double least = least_in_the_plane(grasp, objective);
  const Best<3> best = best_posture(grasp, {.objective = objective, .max_holds = 200, .starts = 0});
  ASSERT_TRUE(best.holdable());
  EXPECT_EQ(best.status, Status::optimal);
  EXPECT_LE(best.best().value(), least * (1 + 2e-6));
  EXPECT_GE(best.best().value(), least * (1 - 3e-3));  // between two samples
}

TEST(SpaceBest, OfTwoHardJawsThatAreNotParallelEndsCertified) {
  expect_best_of_the_plane(
      hard_jaws({0.7426724771606352, 0.5579788429195318, 0.3702663939952776},
                {-0.5674538035560766, -0.6756116343418677, -0.47068577668297185},
                {0.3144508361411539, 0.4006427739247358, 0.498262573964917}, 0.9588131553584072,
                0.6151757367637514),
      Objective::grip);
  expect_best_of_the_plane(
      hard_jaws({0.43929386368640611, 0.31457401649691707, 0.84146544163885106},
                {-0.75105511445065343, -0.20983497160612774, -0.62600758761261943},
                {0.55244583253254198, 0.0022018948834970722, 0.092014084973094157},
                1.7174249863970534, 0.93935758014151349),
      Objective::grip);
}

TEST(SpaceBest, OfTwoHardJawsWithAMaxIsFound) {
  const auto jaws = [](double max) {
    return hard_jaws({-0.86203976219981104, -0.29510968644016244, -0.41206519066245095},
                     {0.91882607087987611, 0.11469956504286548, 0.37762767542968351},
                     {0.067113013371075822, 0.83872494039284851, -0.37824710861353067},
                     0.89133099476517763, 0.85369850748764009, max);
  };
  expect_best_of_the_plane(jaws(2), Objective::effort);
  expect_best_of_the_plane(jaws(2), Objective::grip);
  const Best<3> none = best_posture(jaws(1e-3), {.max_holds = 200, .starts = 0});
  EXPECT_EQ(none.status, Status::unholdable);
}

TEST(SpaceBest, OfAVerySoftFingerIsInThePlaneThatItLeaves) {
  // Both fingers at one point: only moments in the plane of their normals. In the solver's units
  // one of them has a friction 360 times as large about its normal as along the surface.
  const Vector<3> at(0.73, -0.47, 0.18), one = Vector<3>(0.16, -0.98, 0.09).normalized(),
                                         other = Vector<3>(0.37, 0.92, 0.13).normalized();
  const Held held{{10, {0.14, -0.3, 0.5}},
                  {contact(at, one, 0.58, 0.43), contact(at, other, 0.001, 0.36)}};
  const Vector<3> across = one.cross(other).cross(held.object.com - at).normalized();
  const Vector<3> u = across.unitOrthogonal(), v = across.cross(u);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 20000; ++k) {
    const double theta = 2 * pi * k / 20000;
    least = std::min(least, effort_at({held.grasp()}, std::cos(theta) * u + std::sin(theta) * v));
  }
  ASSERT_LT(least, 1e3);
  const Best<3> best = best_posture(held.grasp());
  ASSERT_TRUE(best.holdable());
  EXPECT_EQ(fault({held.grasp()}, best, {}, 2000), "");
  EXPECT_EQ(best.status, Status::optimal);
  EXPECT_NEAR(best.best().up.dot(across), 0, 1e-11);
  EXPECT_LE(best.best().effort(), least * (1 + 1e-6));
  EXPECT_GE(best.best().effort(), 0.999 * least);  // the best is between two samples, at a border
}

TEST(SpaceBest, OfAFrictionlessFingerBesideOthersAtOnePointIsOnTheLineThroughThem) {
  // The frictionless finger has a moment about the point that nothing balances.
  const Vector<3> at(0.9, -0.5, 0.6), com(-0.1, -0.3, 0.1), arm = (com - at).normalized();
  const Held held{{1, com},
                  {contact(at, {0.6, 0.5, -0.6}, 1.4), contact(at, {0.4, -0.8, -0.5}, 1),
                   contact({0.8, -0.4, 0.6}, {0, -0.8, 0.6}, 0)}};
  const double least =
      std::min(effort_at({held.grasp()}, arm), effort_at({held.grasp()}, Vector<3>(-arm)));
  ASSERT_LT(least, 1e3);
  const Best<3> best = best_posture(held.grasp());
  ASSERT_TRUE(best.holdable());
  EXPECT_EQ(fault({held.grasp()}, best, {}, 2000), "");
  EXPECT_EQ(best.status, Status::optimal);
  EXPECT_NEAR(best.best().effort(), least, 1e-9 * least);
}

TEST(SpaceBest, OfOneFingerAtTheComThatMayNotPressHardIsBesideItsNormal) {
  // All postures that hold need the same: those where the normal force is from W / sqrt(1 + mu^2)
  // to max_normal, a band round the normal.
  const double weight = 10, mu = 2;
  for (const double most : {4.5, 5.0, 7.0, 9.9}) {
    Held held{{weight, {0.1, 0.2, 0.3}}, {contact({0.1, 0.2, 0.3}, {0, 0.6, 0.8}, mu)}};
    held.contacts[0].max_normal = most;
    held.contacts[0].share = 0.5;
    const Best<3> best = best_posture(held.grasp());
    ASSERT_TRUE(best.holdable()) << most;
    EXPECT_NEAR(best.best().effort(), weight * weight / 0.5, 1e-9 * weight * weight) << most;
    EXPECT_LE(weight * best.best().up.dot(Vector<3>(0, 0.6, 0.8)), most * (1 + 1e-9)) << most;
    EXPECT_LE(best.proof.holds, 2010) << most;
  }
}

TEST(SpaceBest, IsFoundWhereFewPosturesHold) {
  // Less than a hundredth of the sphere, between fingers that must press and may not press hard.
  Held held{{1, {0.4, -0.47, -0.45}},
            {contact({0.4, -0.47, -0.45}, {-0.65, 0.44, -0.62}, 0),
             contact({0.13, -0.02, 0.16}, {-0.12, 0.76, -0.64}, 0.18, 0.22),
             contact({-0.21, 0.1, 0.05}, {0.15, 0.75, 0.65}, 1, 0.48),
             contact({0.7, -0.28, 0.17}, {0.08, 0.84, 0.53}, 0.35)}};
  held.contacts[0].min_normal = 0.27;
  held.contacts[0].max_normal = 1.9;
  held.contacts[3].min_normal = 0.43;
  held.contacts[3].max_normal = 0.69;
  int held_in = 0;
  for (const Vector<3>& up : directions(20000))
    held_in += effort_at({held.grasp()}, up) < std::numeric_limits<double>::infinity() ? 1 : 0;
  ASSERT_GT(held_in, 0);
  ASSERT_LT(held_in, 200);
  const Best<3> best = best_posture(held.grasp());
  ASSERT_TRUE(best.holdable());
  EXPECT_EQ(fault({held.grasp()}, best, {}, 20000), "");
  EXPECT_EQ(best.status, Status::optimal);
}

TEST(SpaceBest, OfOneFrictionlessFingerIsUprightOnIt) {
  const Held held{{2, {0, 0, 1}}, {contact({0, 0, 0}, {0, 0, 1}, 0)}};
  const Best<3> best = best_posture(held.grasp());
  ASSERT_TRUE(best.holdable());
  EXPECT_NEAR((best.best().up - Vector<3>(0, 0, 1)).norm(), 0, 1e-9);
  EXPECT_NEAR(best.best().effort(), 4, 1e-9);
}

TEST(SpaceBest, OfWhatCannotBeHeldIsProven) {
  // A frictionless contact whose line misses the com.
  const Held held{{2, {0.1, 0, 1}}, {contact({0, 0, 0}, {0, 0, 1}, 0)}};
  const Best<3> best = best_posture(held.grasp());
  EXPECT_EQ(best.status, Status::unholdable);
  EXPECT_FALSE(best.holdable());
  EXPECT_GT(best.lower_bound, 4e12);
  EXPECT_FALSE(best.proof.cuts.empty());
}

TEST(SpaceBest, OfATiltedTrayStaysWithinTheTilt) {
  Held held{{1, {0.2, 0.1, 0.5}}, {}};
  for (int k = 0; k < 3; ++k) {
    const double at = 2 * pi * k / 3;
    held.contacts.push_back(contact({std::cos(at), std::sin(at), 0}, {0, 0, 1}, 0.5));
  }
  SpatialSettings free, tilted;
  const std::vector<Grasp<3>> cases = {held.grasp()};
  const Best<3> any = best_posture(together(cases), free);
  ASSERT_TRUE(any.holdable());
  tilted.tilt = Tilt{Vector<3>(0.3, 0, 1).normalized(), 0.1};
  const Best<3> within = best_posture(together(cases), tilted);
  ASSERT_TRUE(within.holdable());
  EXPECT_EQ(within.status, Status::optimal);
  EXPECT_EQ(fault(cases, within, tilted, 5000), "");
  EXPECT_GE(within.best().effort(), any.best().effort() * (1 - 1e-9));
  tilted.tilt->most = 0;
  const Best<3> fixed = best_posture(together(cases), tilted);
  ASSERT_TRUE(fixed.holdable());
  EXPECT_NEAR((fixed.best().up - tilted.tilt->from).norm(), 0, 1e-9);
  EXPECT_EQ(fixed.status, Status::optimal);
}

TEST(SpaceBest, WithinANarrowTiltIsCertifiedForTwoScenarios) {
  // Four fingers with little friction to spare. Vertices of the polytope lie square to the tilt.
  Held held{{1, {0, 0, 0}}, {}};
  for (int k = 0; k < 4; ++k) {
    const Vector<3> at(0.84786042376442106 * std::cos(pi / 2 * k),
                       0.84786042376442106 * std::sin(pi / 2 * k), 0.53021948456654855);
    held.contacts.push_back(contact(at, -at, 0.72536175731899788));
  }
  Held other = held;
  other.object.weight = 0.755;
  other.object.com = {-0.14781867822573522, 0.12623062379304392, 0.047068758050489976};
  const std::vector<Grasp<3>> cases = {held.grasp(), other.grasp()};
  SpatialSettings settings;
  settings.tilt = Tilt{Vector<3>(0.88603639958247582, -0.21625453505887518, 0.41008959348097718),
                       3.312 * pi / 180};
  const Best<3> best = best_posture(together(cases), settings);
  EXPECT_EQ(best.status, Status::optimal);
  EXPECT_EQ(fault(cases, best, settings, 2000), "");
  for (const Minimum<3>& minimum : best.minima)
    EXPECT_LE(std::acos(minimum.up.dot(settings.tilt->from)), settings.tilt->most + 1e-8);
}

TEST(SpaceBest, WhereStepsOverflowIsAPosture) {
  Held held{{1, {-0.20995, 0.1141, 0.356}},
            {contact({-0.20995, 0.1141, 0.356},
                     {0.69265955353338593, -0.69990724952400019, -0.17421993273641057}, 0.28164,
                     0.109274),
             contact({-0.64794251138847647, 0.4038358455319061, 0.64582281765134664},
                     {0.64794251138847647, -0.4038358455319061, -0.64582281765134664}, 0.001)}};
  held.contacts[0].min_normal = 0.49175;
  SpatialSettings settings;
  settings.max_holds = 300;
  const Best<3> best = best_posture(held.grasp(), settings);
  ASSERT_TRUE(best.holdable());
  EXPECT_EQ(fault({held.grasp()}, best, settings, 300), "");
}

TEST(SpaceBest, WithLimitsIsHonest) {
  for (int round = 0; round < 10; ++round) {
    Held held{{1, {0.1, 0, 0.02 * round}}, {}};
    for (int k = 0; k < 5; ++k) {
      const double at = 2 * pi * k / 5 + 0.3 * round;
      const Vector<3> out = Vector<3>(std::cos(at), std::sin(at), 0.3 * (k % 2) - 0.1).normalized();
      held.contacts.push_back(contact(out, -out, 0.6));
      held.contacts.back().max_normal = 0.8 + 0.1 * k;
      if (round % 2 == 1 && k < 2) held.contacts.back().min_normal = 0.2;
    }
    const std::vector<Grasp<3>> cases = {held.grasp()};
    SpatialSettings settings;
    settings.starts = 0;
    const Best<3> best = best_posture(together(cases), settings);
    EXPECT_EQ(fault(cases, best, settings, 2000), "") << round;
    if (round % 2 == 0) {
      EXPECT_NE(best.status, Status::gap) << round << ' ' << best.relative_gap;
    }
  }
}

TEST(SpaceBest, SmallestTurnTakesUpToTheTop) {
  for (const Vector<3>& up : directions(50))
    for (const Vector<3>& axis : directions(7)) {
      const Eigen::Quaterniond orientation(Eigen::AngleAxisd(1.3, axis));
      const Eigen::Quaterniond turn = smallest_turn(orientation, up);
      EXPECT_GE(turn.w(), 0);
      EXPECT_NEAR(turn.norm(), 1, 1e-12);
      EXPECT_NEAR((turn * (orientation * up) - Vector<3>::UnitZ()).norm(), 0, 1e-12);
      const double angle = std::acos(std::clamp((orientation * up).z(), -1.0, 1.0));
      EXPECT_NEAR(2 * std::acos(std::min(1.0, turn.w())), angle, 1e-7);
    }
  const Eigen::Quaterniond none = Eigen::Quaterniond::Identity();
  EXPECT_TRUE(smallest_turn(none, Vector<3>::UnitZ()).isApprox(none));
  EXPECT_TRUE(smallest_turn(none, -Vector<3>::UnitZ()).isApprox(Eigen::Quaterniond(0, 1, 0, 0)));
}

TEST(SpaceBest, RefusesMisuse) {
  const Held held{{2, {0, 0, 1}}, {contact({0, 0, 0}, {0, 0, 1}, 0)}};
  SpatialSettings settings;
  EXPECT_THROW(Grasp<3>(std::vector<Load<3>>{}, held.contacts), InvalidGrasp);
  settings.gap = 0;
  EXPECT_THROW(best_posture(held.grasp(), settings), InvalidGrasp);
  settings.gap = 1e-6;
  settings.tilt = Tilt{Vector<3>(0, 0, 1), 2};
  EXPECT_THROW(best_posture(held.grasp(), settings), InvalidGrasp);
}

}  // namespace
}  // namespace poise::test::space
