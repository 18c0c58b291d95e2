// The posture curve against hold, against its own proof, and the laws that it obeys.
#include "poise/posture_curve.hpp"

#include <gtest/gtest.h>

#include "random_grasps.hpp"
#include "second_sources.hpp"

namespace poise::test {
namespace {

/// Holds are not compared nearer than this [rad] to the limit of holding: rounding decides there.
constexpr double margin = 1e-7;

double turned_into(double angle, double from) {  // the same angle in [from, from + 2 pi)
  return angle - 2 * pi * std::floor((angle - from) / (2 * pi));
}

bool whole_circle(const PostureCurve& curve) {
  return curve.domain.to - curve.domain.from >= 2 * pi;
}

/// The angle as `piece` counts it, if it is inside by at least `inset`; 1e-9 outside is at its end.
template <class Piece>
std::optional<double> inside(const Piece& piece, double angle, double inset = -1e-9) {
  const double within = turned_into(angle, piece.from - 1e-8);
  if (within < piece.from + inset || within > piece.to - inset) return {};
  return within;
}

const Arc* arc_at(const PostureCurve& curve, double angle, double inset = -1e-9) {
  for (const Arc& arc : curve.arcs)
    if (inside(arc, angle, inset)) return &arc;
  return nullptr;
}

bool held_at(const PostureCurve& curve, double angle, double inset = -1e-9) {
  if (curve.holdable.size() == 1 && curve.holdable[0].to - curve.holdable[0].from >= 2 * pi)
    return true;
  return std::any_of(curve.holdable.begin(), curve.holdable.end(),
                     [&](const Interval& i) { return inside(i, angle, inset).has_value(); });
}

Twist<2> dual_at(const Arc& arc, double theta) {
  return {arc.y[0](theta), arc.y[1](theta), arc.y[2](theta)};
}

/// What is promised to nine digits.
bool moderate(const Grasp<2>& grasp, double effort) {
  return std::sqrt(effort) <= 1000 * grasp.size();
}

/// How far V(theta) is from `effort`, relative to it; 0 within rounding.
Real error(const Arc& arc, double theta, Real effort) {
  const Real off = std::abs(arc.value(theta) - effort);
  return off <= rounding(arc) ? 0 : off / effort;
}

CurveSettings random_settings() {
  return {.domain = one_in(4) ? Domain::pinching_up : Domain::all};
}

/// A posture of the domain.
double random_angle_of(const PostureCurve& curve) {
  if (whole_circle(curve)) return random_angle();
  return curve.domain.from + real(0, 1) * (curve.domain.to - curve.domain.from);
}

RC_GTEST_PROP(PostureCurve, IsTheEffortOfHold, ()) {
  const Held held = *grasps();
  const Grasp<2> grasp = held.grasp();
  const PostureCurve curve = posture_curve(grasp, random_settings());
  for (int i = 0; i < 10; ++i) {
    const double theta = random_angle_of(curve);
    const Hold<2> found = hold(grasp, up_at(theta));
    const Arc* arc = arc_at(curve, theta, margin);
    if (arc) {
      RC_ASSERT(found.holdable);
      if (moderate(grasp, found.effort)) RC_ASSERT(error(*arc, theta, found.effort) <= 1e-9L);
    } else if (!arc_at(curve, theta)) {
      RC_ASSERT(!found.holdable || held_at(curve, theta - margin) ||
                held_at(curve, theta + margin));
    }
  }
}

RC_GTEST_PROP(PostureCurve, OfTwoContactsClampsTheInternalForce, ()) {
  const Held held = *grasps({.least_contacts = 2, .most_contacts = 2});
  if ((held.contacts[0].position - held.contacts[1].position).norm() < 1e-3) return;
  const Grasp<2> grasp = held.grasp();
  const PostureCurve curve = posture_curve(grasp);
  for (int i = 0; i < 10; ++i) {
    const double theta = random_angle();
    const auto expected = decided(grasp, theta, clamped_internal_force);
    if (!expected) continue;
    RC_ASSERT(held_at(curve, theta) == expected->has_value());
    if (!*expected || !moderate(grasp, static_cast<double>((*expected)->effort))) continue;
    RC_ASSERT(error(*arc_at(curve, theta), theta, (*expected)->effort) <= 1e-9L);
  }
}

RC_GTEST_PROP(PostureCurve, OfNearlyUnholdableDisksGoesAllRound, ()) {
  const Grasp<2> grasp = (*nearly_unholdable()).grasp();
  const PostureCurve curve = posture_curve(grasp);
  RC_ASSERT(curve.unholdable_arcs.empty());
  RC_ASSERT(curve.holdable.size() == 1U);
  RC_ASSERT(curve.holdable[0].to - curve.holdable[0].from == 2 * pi);
  for (int i = 0; i < 5; ++i) {
    const double theta = random_angle();
    const Real effort = clamped_internal_force(grasp, load_at(grasp, theta))->effort;
    RC_ASSERT(arc_at(curve, theta) != nullptr);
    if (moderate(grasp, static_cast<double>(effort)))
      RC_ASSERT(error(*arc_at(curve, theta), theta, effort) <= 1e-9L);
  }
}

Contact<2> on_disk(double degrees, double friction) {
  Contact<2> contact;
  contact.position = direction(degrees * pi / 180);
  contact.normal = -contact.position;
  contact.friction = friction;
  return contact;
}

TEST(PostureCurve, OfForceClosuresThatAreAwkwardGoesAllRound) {
  Contact<2> left = on_disk(180, 0.001), right = on_disk(0, 0.001), tilted = on_disk(90, 0.001);
  for (Contact<2>* contact : {&left, &right}) {  // pressing outwards, close to the com
    contact->position *= 5e-5;
    contact->normal *= -1;
  }
  tilted.normal = direction(-pi / 3);
  const std::vector<Held> awkward{
      {{1, {0, 0}},
       {on_disk(0, 0.001), on_disk(180, 0.001), on_disk(210, 0), on_disk(330, 0),
        on_disk(270, 1.00136), on_disk(270, 1.00136)}},
      {{1, {0, 0}}, {on_disk(270, 0.1), on_disk(270, 0.1), left, right}},
      {{1, {0, 0}},
       {on_disk(270, 0.001), on_disk(210, 0), on_disk(0, 0.1), on_disk(210, 0),
        on_disk(90, 0.66734), tilted}}};
  for (const Held& held : awkward) {
    const PostureCurve curve = posture_curve(held.grasp());
    EXPECT_TRUE(curve.unholdable_arcs.empty()) << held;
    ASSERT_EQ(curve.holdable.size(), 1U) << held;
    EXPECT_EQ(curve.holdable[0].to - curve.holdable[0].from, 2 * pi) << held;
  }
}

RC_GTEST_PROP(PostureCurve, IsProvenByItsOwnDuals, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp, random_settings());
  for (const Arc& arc : curve.arcs)
    for (const double part : {0.0, 0.3, 0.7, 1.0}) {
      const double theta = arc.from + part * (arc.to - arc.from), V = arc.value(theta);
      if (!moderate(grasp, V)) continue;
      const RealWrench w = load_at(grasp, theta);
      const Real bound = dual_bound(grasp, w, dual_at(arc, theta));
      // What a balance within the tolerance may be worth to a long y.
      const Real doubt = bound - proven_effort(grasp, w, dual_at(arc, theta));
      RC_ASSERT(std::abs(bound - arc.value(theta)) <= 2 * doubt ||
                error(arc, theta, bound) <= 1e-9L);
    }
}

RC_GTEST_PROP(PostureCurve, ProvesThatItsUnholdableArcsAre, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp, random_settings());
  for (const UnholdableArc& arc : curve.unholdable_arcs) {
    const double inset = 1e-7, length = arc.to - arc.from;
    if (length < 3 * inset) continue;
    for (const double theta : {arc.from + inset, arc.from + real(0.01, 0.99) * length,
                               arc.from + length / 2, arc.to - inset})
      RC_ASSERT(proves_unholdable(grasp, load_at(grasp, theta), arc.y));
  }
}

RC_GTEST_PROP(PostureCurve, PiecesTileTheDomain, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp, random_settings());
  std::vector<Interval> pieces;
  for (const Arc& arc : curve.arcs) pieces.push_back({arc.from, arc.to});
  for (const UnholdableArc& arc : curve.unholdable_arcs) pieces.push_back({arc.from, arc.to});
  RC_ASSERT(!pieces.empty());
  std::sort(pieces.begin(), pieces.end(),
            [](const Interval& a, const Interval& b) { return a.from + a.to < b.from + b.to; });
  const double slack = 1.1e-8;
  double sum = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    RC_ASSERT(pieces[i].from <= pieces[i].to);
    sum += pieces[i].to - pieces[i].from;
    if (i > 0) RC_ASSERT(std::abs(pieces[i].from - pieces[i - 1].to) <= slack);
  }
  if (whole_circle(curve)) {
    RC_ASSERT(std::abs(pieces.front().from + 2 * pi - pieces.back().to) <= slack);
  } else {
    RC_ASSERT(std::abs(pieces.front().from - curve.domain.from) <= slack);
    RC_ASSERT(std::abs(pieces.back().to - curve.domain.to) <= slack);
  }
  RC_ASSERT(std::abs(sum - (curve.domain.to - curve.domain.from)) <=
            slack * static_cast<double>(pieces.size()));
}

RC_GTEST_PROP(PostureCurve, IsContinuousFromArcToArc, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp);
  for (std::size_t i = 0; i < curve.arcs.size(); ++i) {
    const Arc& before = curve.arcs[i];
    const Arc& after = curve.arcs[(i + 1) % curve.arcs.size()];
    const double V = before.value(before.to), slope = std::abs(before.value.slope(before.to)),
                 slope_after = std::abs(after.value.slope(after.from));
    if (std::abs(std::remainder(after.from - before.to, 2 * pi)) > 1e-9 || !moderate(grasp, V))
      continue;
    RC_ASSERT(close(V, after.value(after.from), 1e-9L,
                    1e-9L * (slope + slope_after) + rounding(before) + rounding(after)));
  }
}

RC_GTEST_PROP(PostureCurve, StatesOfItsArcsAreThoseOfHold, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp);
  RC_ASSERT(curve.states.size() == curve.arcs.size() * grasp.contacts().size());
  for (const Arc& arc : curve.arcs) {
    const double theta = arc.from + 0.4 * (arc.to - arc.from);
    if (arc.to - arc.from < 1e-3 || !moderate(grasp, 100 * arc.value(theta))) continue;
    const Hold<2> found = hold(grasp, up_at(theta));
    for (std::size_t i = 0; i < found.forces.size(); ++i) {
      const ArcState& state = curve.states[arc.first_state + i];
      RC_ASSERT(std::string(to_string(state.state)) == to_string(found.forces[i].state));
      RC_ASSERT(std::string(to_string(state.limit)) == to_string(found.forces[i].limit));
    }
  }
}

RC_GTEST_PROP(PostureCurve, EndsWhereHoldingEnds, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp, random_settings());
  const auto holds = [&](double theta) { return hold(grasp, up_at(theta)).holdable; };
  if (curve.holdable.empty()) return;
  if (curve.holdable[0].to - curve.holdable[0].from >= 2 * pi) {
    RC_ASSERT(curve.holdable.size() == 1U);
    RC_ASSERT(curve.unholdable_arcs.empty());
    return;
  }
  for (std::size_t i = 0; i < curve.holdable.size(); ++i) {
    const Interval& now = curve.holdable[i];
    RC_ASSERT(now.from >= -pi && now.from < pi && now.from <= now.to);
    RC_ASSERT(now.to <= now.from + 2 * pi);
    if (now.to - now.from > 2 * margin) {
      RC_ASSERT(holds(now.from + margin));
      RC_ASSERT(holds(now.to - margin));
    }
    for (const double outside : {now.from - margin, now.to + margin}) {
      if (held_at(curve, outside)) continue;
      if (whole_circle(curve) || inside(curve.domain, outside)) RC_ASSERT(!holds(outside));
    }
  }
}

RC_GTEST_PROP(PostureCurve, HoldsBesideItsEndsAreProven, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp);
  for (const Arc& arc : curve.arcs)
    for (const double end : {arc.from, arc.to}) {
      if (!moderate(grasp, arc.value(end))) continue;
      for (const double step : {-1e-4, -1e-5, -1e-6, 1e-6, 1e-5, 1e-4}) {
        const Hold<2> beside = hold(grasp, up_at(end + step));
        // Too near for the digits of any y: then it is not claimed.
        if (!beside.proven && std::abs(step) <= 1e-6) continue;
        RC_ASSERT(fault(grasp, end + step, beside) == "");
      }
    }
}

RC_GTEST_PROP(PostureCurve, WithoutLimitsHoldsOneConvexConeOfLoads, ()) {
  const Grasp<2> grasp = (*grasps({.limits = false})).grasp();
  const PostureCurve curve = posture_curve(grasp);
  const std::vector<Interval>& holdable = curve.holdable;
  for (const Arc& arc : curve.arcs)  // what the force cap takes away is not a cone
    if (std::max(arc.value(arc.from), arc.value(arc.to)) > squared_cap(grasp, 1e5)) return;
  RC_ASSERT(holdable.size() <= 2U);
  if (holdable.size() == 2) {  // two opposite points
    for (const Interval& point : holdable) RC_ASSERT(point.to - point.from <= 1e-8);
    RC_ASSERT(std::abs(std::abs(holdable[0].from - holdable[1].from) - pi) <= 1e-8);
  } else if (holdable.size() == 1) {
    const double length = holdable[0].to - holdable[0].from;
    RC_ASSERT(length <= pi + 1e-8 || length == 2 * pi);
  }
}

/// The same optima, whatever their order.
void expect_same(const std::vector<Optimum>& a, std::vector<Optimum> b) {
  RC_ASSERT(a.size() == b.size());
  const auto matches = [](const Optimum& x, const Optimum& y) {
    // Where V is flat it says little about where its optimum is.
    const double nearness = x.kind == Kind::smooth ? 1e-4 : 1e-7;
    return x.maximum == y.maximum && x.kind == y.kind && close(x.value, y.value, 1e-8L) &&
           std::abs(std::remainder(x.angle - y.angle, 2 * pi)) < nearness;
  };
  for (const Optimum& x : a) {
    const auto same =
        std::find_if(b.begin(), b.end(), [&](const auto& y) { return matches(x, y); });
    RC_ASSERT(same != b.end());
    b.erase(same);
  }
}

/// Without arcs so steep that their optima have few digits, and without stretches to match.
bool modest(const PostureCurve& curve) {
  return std::all_of(curve.arcs.begin(), curve.arcs.end(),
                     [](const Arc& arc) { return rounding(arc) < 1e-10L; }) &&
         std::all_of(curve.optima.begin(), curve.optima.end(),
                     [](const Optimum& o) { return o.from == o.to; });
}

RC_GTEST_PROP(PostureCurve, TurnsWithTheGrasp, ()) {
  Held held = *grasps({.awkward = false});
  const PostureCurve curve = posture_curve(held.grasp());
  std::vector<Optimum> before = curve.optima;
  const double turn = pi * coordinate();
  Eigen::Matrix2d rotation;
  rotation << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
  held.object.com = rotation * held.object.com;
  for (Contact<2>& c : held.contacts) {
    c.position = rotation * c.position;
    c.normal = rotation * c.normal;
  }
  if (!modest(curve)) return;
  for (Optimum& optimum : before) optimum.angle -= turn;
  expect_same(before, posture_curve(held.grasp()).optima);
}

RC_GTEST_PROP(PostureCurve, MirrorsWithTheGrasp, ()) {
  Held held = *grasps({.awkward = false});
  const PostureCurve curve = posture_curve(held.grasp());
  std::vector<Optimum> before = curve.optima;
  held.object.com.x() *= -1;
  for (Contact<2>& c : held.contacts) {
    c.position.x() *= -1;
    c.normal.x() *= -1;
  }
  if (!modest(curve)) return;
  for (Optimum& optimum : before) optimum.angle *= -1;
  expect_same(before, posture_curve(held.grasp()).optima);
}

RC_GTEST_PROP(PostureCurve, MirroredGraspsHaveMirroredCurves, ()) {
  Held held = *grasps({.most_contacts = 4});
  held.object.com.x() = 0;
  const std::size_t half = held.contacts.size();
  for (std::size_t i = 0; i < half; ++i) {
    Contact<2> twin = held.contacts[i];
    twin.position.x() *= -1;
    twin.normal.x() *= -1;
    held.contacts.push_back(twin);
  }
  const Grasp<2> grasp = held.grasp();
  const PostureCurve curve = posture_curve(grasp);
  for (int i = 0; i < 5; ++i) {
    const double theta = random_angle();
    const Arc *here = arc_at(curve, theta, margin), *there = arc_at(curve, -theta, margin);
    if (!here || !there || !moderate(grasp, here->value(theta))) continue;
    RC_ASSERT(
        close(here->value(theta), there->value(-theta), 1e-9L, rounding(*here) + rounding(*there)));
  }
}

RC_GTEST_PROP(PostureCurve, DomainKeepsTheCurve, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve all = posture_curve(grasp);
  const PostureCurve pinched = posture_curve(grasp, {.domain = Domain::pinching_up});
  for (int i = 0; i < 5; ++i) {
    const double theta = random_angle_of(pinched);
    const Arc *a = arc_at(all, theta, margin), *b = arc_at(pinched, theta, margin);
    if (a && b && moderate(grasp, a->value(theta)))
      RC_ASSERT(close(a->value(theta), b->value(theta), 1e-9L, rounding(*a) + rounding(*b)));
  }
}

// Optima.

RC_GTEST_PROP(Optima, AreHeldWithTheirEffort, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp, random_settings());
  RC_ASSERT(curve.optima.empty() == curve.holdable.empty());
  for (const Optimum& optimum : curve.optima) {
    RC_ASSERT(optimum.angle > -pi && optimum.angle <= pi);
    if (!moderate(grasp, optimum.value)) continue;
    Hold<2> found = hold(grasp, up_at(optimum.angle));
    for (const double off : {1e-9, -1e-9})  // an end may be missed by rounding
      if (!found.holdable && optimum.kind == Kind::boundary)
        found = hold(grasp, up_at(optimum.angle + off));
    RC_ASSERT(found.holdable);
    // At the end of the holdable set V may be as steep as it likes.
    RC_ASSERT(close(found.effort, optimum.value, optimum.kind == Kind::boundary ? 1e-6L : 1e-9L,
                    rounding(curve, optimum.angle)));
  }
}

RC_GTEST_PROP(Optima, AreInOrder, ()) {
  const PostureCurve curve = posture_curve((*grasps()).grasp(), random_settings());
  for (std::size_t i = 1; i < curve.optima.size(); ++i) {
    const Optimum &a = curve.optima[i - 1], &b = curve.optima[i];
    RC_ASSERT(a.maximum <= b.maximum);
    if (a.maximum != b.maximum) continue;
    const bool tie = close(a.value, b.value, 1e-9L);
    if (!close(a.value, b.value, 1e-6L)) RC_ASSERT((a.value < b.value) != a.maximum);
    if (tie) RC_ASSERT(std::abs(a.angle) <= std::abs(b.angle) + 1e-8);
  }
}

RC_GTEST_PROP(Optima, OfMaximaNoneIsAKink, ()) {
  const PostureCurve curve = posture_curve((*grasps()).grasp(), random_settings());
  for (const Optimum& optimum : curve.optima)
    if (optimum.maximum) RC_ASSERT(optimum.kind != Kind::kink);
}

RC_GTEST_PROP(Optima, AreOnTheBoundaryOnlyAtAnEnd, ()) {
  const PostureCurve curve = posture_curve((*grasps()).grasp(), random_settings());
  for (const Optimum& optimum : curve.optima) {
    double distance = 2 * pi;
    for (const Interval& i : curve.holdable)
      for (const double end : {i.from, i.to})
        for (const double own : {optimum.from, optimum.to, optimum.angle})
          if (i.to - i.from < 2 * pi)
            distance = std::min(distance, std::abs(std::remainder(own - end, 2 * pi)));
    RC_ASSERT((distance <= 1e-8) == (optimum.kind == Kind::boundary));
  }
}

RC_GTEST_PROP(Optima, AreLocal, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp, random_settings());
  for (const Optimum& optimum : curve.optima) {
    if (!moderate(grasp, optimum.value)) continue;
    for (const double step : {-1e-6, -1e-8, 1e-8, 1e-6}) {
      const double end = step < 0 ? optimum.from : optimum.to;
      const bool stays = whole_circle(curve) || inside(curve.domain, end + step);
      // Another optimum within the step would be one that it may pass.
      const bool alone = std::none_of(curve.optima.begin(), curve.optima.end(), [&](auto& other) {
        return &other != &optimum &&
               std::abs(std::remainder(other.angle - optimum.angle, 2 * pi)) < 2e-6;
      });
      const Hold<2> beside = hold(grasp, up_at(end + step));
      if (!stays || !alone || !beside.holdable || !held_at(curve, end + step, 1e-9)) continue;
      const double better = (optimum.value - beside.effort) * (optimum.maximum ? -1 : 1);
      RC_ASSERT(better <= 1e-9 * optimum.value + rounding(curve, end));
    }
  }
}

/// Efforts on a fine grid over the domain; infinite where unholdable.
struct Scan {
  Scan(const Grasp<2>& grasp, const PostureCurve& curve) {
    const double length = curve.domain.to - curve.domain.from;
    step = length / count;
    for (int i = 0; i <= count; ++i) {
      angles.push_back(curve.domain.from + step * i);
      const Hold<2> found = hold(grasp, up_at(angles.back()));
      efforts.push_back(found.holdable ? found.effort : std::numeric_limits<double>::infinity());
    }
    if (whole_circle(curve)) {
      angles.pop_back();
      efforts.pop_back();
    }
  }

  static constexpr int count = 1440;
  double step;
  std::vector<double> angles, efforts;
};

double distance(const Optimum& optimum, double angle) {
  if (inside(optimum, angle)) return 0;
  return std::min(std::abs(std::remainder(optimum.from - angle, 2 * pi)),
                  std::abs(std::remainder(optimum.to - angle, 2 * pi)));
}

RC_GTEST_PROP(Optima, AreThoseThatAFineScanFinds, ()) {
  if (!one_in(5)) return;
  const Grasp<2> grasp = (*grasps()).grasp();
  const PostureCurve curve = posture_curve(grasp, random_settings());
  const Scan scan(grasp, curve);
  const bool circle = whole_circle(curve);
  const std::size_t n = scan.efforts.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    const double V = scan.efforts[i];
    least = std::min(least, V);
    if (!std::isfinite(V)) continue;
    const double infinite = std::numeric_limits<double>::infinity();
    const double before = i > 0 || circle ? scan.efforts[(i + n - 1) % n] : infinite;
    const double after = i + 1 < n || circle ? scan.efforts[(i + 1) % n] : infinite;
    if (!(V < before * (1 - 1e-9) && V < after * (1 - 1e-9))) continue;
    // The scan has a minimum here, so there is one within a step.
    RC_ASSERT(std::any_of(curve.optima.begin(), curve.optima.end(), [&](const Optimum& o) {
      return !o.maximum && o.value <= V * (1 + 1e-9) + rounding(curve, o.angle) &&
             distance(o, scan.angles[i]) <= 1.001 * scan.step;
    }));
  }
  if (!std::isfinite(least)) return;
  RC_ASSERT(!curve.optima.empty());
  const Optimum& best = curve.optima.front();
  RC_ASSERT(best.value <= least * (1 + 1e-9) + rounding(curve, best.angle));

  // The other way round: between a minimum and the next maxima V rises, as the scan must see.
  for (const Optimum& optimum : curve.optima) {
    if (optimum.maximum || !moderate(grasp, optimum.value)) continue;
    const bool alone = std::none_of(curve.optima.begin(), curve.optima.end(), [&](auto& other) {
      return &other != &optimum &&
             distance(other, optimum.from) < 5 * scan.step + (optimum.to - optimum.from);
    });
    if (!alone) continue;
    for (std::size_t i = 0; i < n; ++i)
      if (distance(optimum, scan.angles[i]) <= 4 * scan.step)
        RC_ASSERT(scan.efforts[i] >= optimum.value * (1 - 1e-9) - rounding(curve, optimum.angle));
  }
}

RC_GTEST_PROP(Optima, MinimaAndMaximaAlternate, ()) {
  const PostureCurve curve = posture_curve((*grasps()).grasp(), random_settings());
  for (const Interval& interval : curve.holdable) {
    std::vector<std::pair<double, bool>> along;
    for (const Optimum& optimum : curve.optima)
      if (const auto at = inside(interval, optimum.angle, -1e-8))
        along.emplace_back(*at, optimum.maximum);
    RC_ASSERT(!along.empty());
    std::sort(along.begin(), along.end());
    const bool constant = along.size() == 2 && along[0].first == along[1].first;
    const bool point = interval.to - interval.from <= 1e-8;
    if (constant || point) continue;
    for (std::size_t i = 1; i < along.size(); ++i)
      RC_ASSERT(along[i].second != along[i - 1].second);
    if (interval.to - interval.from >= 2 * pi) RC_ASSERT(along.size() % 2 == 0U);
  }
}

}  // namespace
}  // namespace poise::test
