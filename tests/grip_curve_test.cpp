// The curve of the least grip in the plane, against the interior-point method, balance of forces
// along arcs, the theorem that minima are kinks and ends, and dense samples.
#include <gtest/gtest.h>

#include "poise/best_posture.hpp"
#include "poise/grip.hpp"
#include "random_grasps.hpp"

namespace poise::test {
namespace {

constexpr CurveSettings for_grip{.objective = Objective::grip};

double at(const Harmonic1& g, double theta) { return g(theta); }

/// Of some theta in an arc, from the arc's forces alone: they balance, keep to the cones and the
/// limits, and their drives do F at most.
void check_forces(const Grasp<2>& grasp, const Arc& arc, double theta) {
  const double F = arc.value(theta), W = grasp.size(), scale = W + F;
  Hold<2> hold;
  hold.holdable = true;
  hold.forces.resize(grasp.contacts().size());
  Wrench<2> left = grasp.loads().front().at(up_at(theta));
  double size = scale;
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const Contact<2>& contact = grasp.contacts()[i];
    ContactForce<2>& force = hold.forces[i];
    force.normal = at(arc.forces[i].normal, theta);
    force.tangential = at(arc.forces[i].tangential, theta);
    size = std::max(size, force.normal);
    const Vector<2> f = force_vector(contact, force), r = contact.position;
    left -= Wrench<2>(f.x(), f.y(), r.x() * f.y() - r.y() * f.x());
  }
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const Contact<2>& contact = grasp.contacts()[i];
    const ContactForce<2>& force = hold.forces[i];
    RC_ASSERT(force.normal >= contact.min_normal - 1e-9 * size);
    RC_ASSERT(force.normal <= contact.max_normal + 1e-8 * size);
    RC_ASSERT(std::abs(force.tangential) <= contact.friction * force.normal + 1e-9 * size);
  }
  RC_ASSERT(left.head<2>().norm() <= 1e-9 * size);
  RC_ASSERT(std::abs(left[2]) <= 1e-9 * size * std::max(1.0, grasp.radius()));
  RC_ASSERT(grip(grasp, hold) <= F + 1e-9 * size);
}

const Arc* arc_around(const PostureCurve& curve, double theta) {
  for (const Arc& arc : curve.arcs)
    for (const double turn : {-2 * pi, 0.0, 2 * pi})
      if (theta + turn >= arc.from && theta + turn <= arc.to) return &arc;
  return nullptr;
}

void check_curve(const Held& held, const Mechanism<2>& mechanism) {
  const Grasp<2> grasp(held.object, held.contacts, 1, mechanism);
  if (!has_grip<2>(grasp)) return;
  const PostureCurve curve = posture_curve(grasp, for_grip);
  const double W = grasp.size(), most = most_grip<2>(grasp);
  for (int k = 0; k < 8; ++k) {
    const double theta = random_angle();
    const Hold<2> least = least_grip(grasp, up_at(theta));
    const Arc* const arc = arc_around(curve, theta);
    if (!arc) {
      const bool above = least.holdable && least.grip >= most * (1 - 1e-6);
      const bool near_cap = least.holdable && least.effort > 1e11 * W * W;
      RC_ASSERT(!least.holdable || above || near_cap || !curve.undecided.empty());
      continue;
    }
    if (!least.holdable) continue;  // rounding, at an end
    const double F = arc->value(theta), scale = std::max(least.grip, 1e-6 * W);
    const double digits = least.grip < 100 * W ? 1e-7 : 1e-6;
    RC_ASSERT(F <= least.grip + digits * scale);
    RC_ASSERT(F >= least.lower_bound - digits * scale);
    check_forces(grasp, *arc, theta);
    const Wrench<2> w = grasp.loads().front().at(up_at(theta));
    SmallVector<double, 4> rates(arc->rates->size());
    std::copy(arc->rates->begin(), arc->rates->end(), rates.begin());
    const Twist<2> y(arc->y[0].c0, arc->y[1].c0, arc->y[2].c0);
    RC_ASSERT(std::abs(grip_bound<2>(grasp, w, y, rates, 1e6 * W) - F) <= 1e-7 * scale);
  }
}

RC_GTEST_PROP(GripCurve, AgreesWithTheInteriorPointMethod, ()) {
  check_curve(*grasps({.most_contacts = 6, .awkward = false}), {});
}

RC_GTEST_PROP(GripCurve, OfCoupledFingersAgreesToo, ()) {
  check_curve(*grasps({.most_contacts = 5, .awkward = false}), {.kind = DriveKind::coupled});
}

RC_GTEST_PROP(GripCurve, EndsWhereADriveIsAtItsMax, ()) {
  const Held held = *grasps({.most_contacts = 4, .limits = false, .awkward = false});
  Mechanism<2> mechanism;
  const Grasp<2> free(held.object, held.contacts);
  for (const std::string& name : free.fingers())
    mechanism.fingers.push_back({.name = name, .max_force = held.object.weight * real(0.2, 3)});
  check_curve(held, mechanism);
}

/// Where one finger carries all of it, just within its max.
TEST(GripCurve, HoldsAPostureThatMeetsAMaxExactly) {
  Mechanism<2> mechanism;
  for (const char* name : {"a", "b"}) mechanism.fingers.push_back({.name = name, .max_force = 10});
  const Grasp<2> grasp({.weight = 10},
                       {{.position = {-1, 0}, .normal = {1, 0}, .friction = 0.4, .finger = "a"},
                        {.position = {1, 0}, .normal = {-1, 0}, .friction = 0.4, .finger = "b"}},
                       1, mechanism);
  const Best<2> best = best_posture(grasp, for_grip);
  ASSERT_EQ(best.minima.size(), 2U);
  EXPECT_NEAR(best.best().value(), 10, 1e-7);
  EXPECT_NEAR(std::abs(best.best().optimum.angle), pi / 2, 1e-7);
}

/// On an arc F'' = -F < 0.
RC_GTEST_PROP(GripCurve, WithoutLimitsIsLeastAtKinksAndEnds, ()) {
  const Held held = *grasps({.most_contacts = 6, .limits = false, .awkward = false});
  const Grasp<2> grasp = held.grasp();
  if (!has_grip<2>(grasp)) return;
  for (const Optimum& optimum : posture_curve(grasp, for_grip).optima)
    if (!optimum.maximum && optimum.value > 1e-9 * grasp.size())
      RC_ASSERT(optimum.kind != Kind::smooth);
}

RC_GTEST_PROP(GripCurve, HasNoPostureBelowItsBest, ()) {
  const Held held = *grasps({.most_contacts = 4, .awkward = false});
  const Grasp<2> grasp = held.grasp();
  if (!has_grip<2>(grasp)) return;
  const Best<2> best = best_posture(grasp, for_grip);
  const double W = grasp.size();
  if (best.holdable()) {
    RC_ASSERT(best.status == Status::optimal);
    RC_ASSERT(best.lower_bound <= best.best().value());
    RC_ASSERT(std::abs(best.best().optimum.value - best.best().value()) <=
              1e-7 * (W + best.best().value()));
  }
  for (int k = 0; k < 24; ++k) {
    const Hold<2> hold = least_grip(grasp, up_at(2 * pi * (k + 0.3) / 24));
    if (!hold.holdable) continue;
    RC_ASSERT(best.holdable() || best.status == Status::gap);
    if (best.holdable()) RC_ASSERT(hold.grip >= best.lower_bound - 1e-7 * (W + best.lower_bound));
  }
}

/// The posture of least effort never presses less.
RC_GTEST_PROP(GripCurve, IsNoMoreThanTheGripOfLeastEffort, ()) {
  const Held held = *grasps({.most_contacts = 4, .awkward = false});
  const Grasp<2> grasp = held.grasp();
  if (!has_grip<2>(grasp)) return;
  const Best<2> effort = best_posture(grasp), grip_best = best_posture(grasp, for_grip);
  if (!effort.holdable() || !grip_best.holdable()) return;
  const double pressed = grip<2>(grasp, effort.best().hold());
  RC_ASSERT(grip_best.best().value() <= pressed + 1e-6 * (grasp.size() + pressed));
}

/// Two fingers below the com: where the inner edges of their cones meet on the vertical through the
/// com, both slip. The paper's posture b.
TEST(GripCurve, OfTwoFingersIsLeastWhereConeEdgesMeetBelowTheCom) {
  const double alpha = pi / 3, mu = 0.3;
  const Grasp<2> grasp({.weight = 10}, {{.position = {std::cos(alpha), -std::sin(alpha)},
                                         .normal = {-std::cos(alpha), std::sin(alpha)},
                                         .friction = mu},
                                        {.position = {-1, 0}, .normal = {1, 0}, .friction = mu}});
  const Best<2> best = best_posture(grasp, for_grip);
  ASSERT_TRUE(best.holdable());
  for (const Minimum<2>& minimum : best.minima) {
    if (!minimum.edges_meet) continue;
    const Vector<2> up = minimum.up;
    EXPECT_NEAR(minimum.edges_meet->x() * up.y() - minimum.edges_meet->y() * up.x(), 0, 1e-6);
  }
}

/// Of a stretch of equal grips the posture nearest to the present one comes first.
TEST(GripCurve, StaysWhereItIsInAStretchOfEqualGrips) {
  // One frictionless finger more than is needed: a round object in a ring of fingers at F = W.
  const Grasp<2> grasp({.weight = 1}, {{.position = {0, 0}, .normal = {0, 1}, .friction = 10},
                                       {.position = {0, 0}, .normal = {0, -1}, .friction = 10}});
  for (const double present : {-2.0, 0.3, 1.5}) {
    const Best<2> best = best_posture(grasp, {.objective = Objective::grip, .present = present});
    ASSERT_TRUE(best.holdable());
    for (const Minimum<2>& minimum : best.minima) {
      const double here = std::abs(std::remainder(minimum.optimum.angle - present, 2 * pi));
      const double there = std::abs(std::remainder(best.best().optimum.angle - present, 2 * pi));
      if (minimum.value() <= best.best().value() * (1 + 1e-9)) EXPECT_GE(here, there - 1e-9);
    }
  }
}

}  // namespace
}  // namespace poise::test
