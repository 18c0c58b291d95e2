// Loads besides the weight: closed forms, and other grasps that must need the same.
#include <gtest/gtest.h>

#include "ask/ask.hpp"
#include "poise/capacity.hpp"
#include "poise/grip.hpp"
#include "random_space_grasps.hpp"
#include "verify/verify.hpp"

namespace poise::test {
namespace {

constexpr double g = standard_gravity;

template <int Dim>
Vector<Dim> any_direction();
template <>
Vector<2> any_direction() {
  return direction(random_angle());
}
template <>
Vector<3> any_direction() {
  return space::random_direction();
}

/// Both, as far as they can be held and need no more than a thousand times the weight.
template <int Dim>
void same(const Hold<Dim>& one, const Hold<Dim>& other, double weight, double rounding = 1e-7) {
  if (one.holdable != other.holdable || !one.holdable) {
    // At the limit of holding either may be told.
    RC_PRE(one.holdable == other.holdable);
    return;
  }
  if (std::sqrt(one.effort) > 1000 * weight) return;
  RC_ASSERT(std::abs(one.value() - other.value()) <=
            rounding * (std::abs(one.value()) +
                        (one.objective == Objective::grip ? weight : weight * weight)));
}

template <int Dim>
void accelerations_are_another_gravity(const Hand<Dim>& hand, const Load<Dim>& plain) {
  const Vector<Dim> up = any_direction<Dim>(), a = real(0, 3 * g) * any_direction<Dim>();
  Load<Dim> load = plain;
  load.lift = real(-0.5 * g, g);
  load.acceleration = a;
  const Vector<Dim> felt = (g + load.lift) * up + a;
  RC_PRE(felt.norm() > 1);
  Load<Dim> other = plain;
  other.weight = plain.weight * felt.norm() / g;
  same(hold<Dim>(hand, load, up), hold<Dim>(hand, other, felt.normalized()), other.weight);
  if (!has_grip(hand)) return;
  same(least_grip<Dim>(hand, load, up), least_grip<Dim>(hand, other, felt.normalized()),
       other.weight, 1e-6);
}

RC_GTEST_PROP(Loads, AccelerationsAreAnotherGravityInThePlane, ()) {
  const Held held = *grasps();
  accelerations_are_another_gravity<2>(held.grasp(), held.object);
}
RC_GTEST_PROP(Loads, AccelerationsAreAnotherGravityInSpace, ()) {
  if (!one_in(3)) return;
  const space::Held held = *space::grasps({.awkward = false});
  accelerations_are_another_gravity<3>(held.grasp(), held.object);
}

/// Two weights are one where their centre of mass is.
RC_GTEST_PROP(Loads, AForceMayBeTheWeightOfAnotherPart, ()) {
  if (!one_in(3)) return;
  const space::Held held = *space::grasps({.awkward = false});
  const Grasp<3> grasp = held.grasp();
  const Vector<3> up = any_direction<3>(), at = 0.5 * any_direction<3>();
  const double added = held.object.weight * real(0.1, 3);
  Load<3> load = held.object;
  load.fixed = wrench_of<3>(added * up, at);
  Load<3> both = held.object;
  both.weight += added;
  both.com = (held.object.weight * held.object.com + added * at) / both.weight;
  same(hold<3>(grasp, load, up), hold<3>(grasp, both, up), both.weight);
  if (has_grip(grasp)) {
    same(least_grip<3>(grasp, load, up), least_grip<3>(grasp, both, up), both.weight, 1e-6);
  }
}

/// Two soft fingers on a line, of friction 0.5, 60 mm apart.
std::vector<Contact<3>> two_fingers(double max = std::numeric_limits<double>::infinity()) {
  std::vector<Contact<3>> contacts;
  for (const double side : {-1.0, 1.0}) {
    Contact<3> contact{{0.03 * side, 0, 0}, {-side, 0, 0}, 0.5};
    contact.torsion = 0.003;
    contact.max_normal = max;
    contact.finger = side < 0 ? "left" : "right";
    contacts.push_back(contact);
  }
  return contacts;
}

TEST(Loads, NeedWhatNewtonsLawSays) {
  const Hand<3> hand(two_fingers(), {0, 0, 0});
  const Vector<3> up(0, 0, 1);
  const Load<3> lifted{.weight = 10, .lift = 3};
  EXPECT_NEAR(least_grip<3>(hand, lifted, up).grip, 10 * (1 + 3 / g), 1e-7);
  // A tool that is pushed up with 15 N.
  const Load<3> pushed{.weight = 0.5, .fixed = wrench_of<3>({0, 0, -15}, {0, 0, -0.02})};
  EXPECT_NEAR(least_grip<3>(hand, pushed, up).grip, 14.5, 1e-7);
  // Falling freely nothing needs to be held, falling faster the object is pushed down.
  const Load<3> falling{.weight = 10, .lift = -2 * g};
  EXPECT_NEAR(least_grip<3>(hand, falling, up).grip, 10, 1e-7);
}

TEST(Loads, OfAWeightlessObjectAreTheSameInEveryPosture) {
  std::vector<Load<3>> loads(2);
  loads[0] = {.weight = 0, .fixed = wrench_of<3>({0, 3, 4}, {0, 0, 0})};
  loads[1] = {.weight = 0, .fixed = wrench_of<3>({0, 0, 2}, {0, 0, 0})};
  const Grasp<3> grasp(loads, two_fingers());
  for (const Objective objective : {Objective::grip, Objective::effort}) {
    const Best<3> best = best_posture(grasp, {.objective = objective, .starts = 0});
    ASSERT_EQ(best.status, Status::optimal);
    EXPECT_EQ(best.best().decides, 0U);
    // Each finger presses with 5 N and drags 2.5 N.
    EXPECT_NEAR(best.best().value(), objective == Objective::grip ? 5 : 2 * 31.25, 1e-6);
    EXPECT_NEAR(best.lower_bound, best.best().value(), 1e-4);
  }
  EXPECT_THROW(Grasp<3>(Load<3>{.weight = 0}, two_fingers()), InvalidGrasp);
  EXPECT_THROW(Grasp<3>(Load<3>{.weight = 1, .lift = -g}, two_fingers()), InvalidGrasp);
}

TEST(Loads, ThatNoFingerCanHoldAreProvenInEveryPosture) {
  // A moment about the line of two hard fingers.
  std::vector<Contact<3>> contacts = two_fingers();
  for (Contact<3>& contact : contacts) contact.torsion = 0;
  Load<3> twisted{.weight = 0};
  twisted.fixed[3] = 1;
  const Best<3> best = best_posture(Grasp<3>(twisted, contacts), SpatialSettings{});
  EXPECT_EQ(best.status, Status::unholdable);
}

TEST(Loads, MoveTheRangeOfWeights) {
  const Vector<3> up(0, 0, 1);
  const Hand<3> hand(two_fingers(20), {0, 0, 0});  // which carries 20 N
  const auto range = [&](const Load<3>& load) { return weight_range<3>(hand, load, up); };
  const WeightRange<3> lifted = range({.weight = 1, .lift = 3});
  EXPECT_NEAR(lifted.greatest.weight, 20 / (1 + 3 / g), 1e-5);
  EXPECT_NEAR(lifted.greatest.bound, 20 / (1 + 3 / g), 1e-5);
  const WeightRange<3> shaken = range({.weight = 1, .acceleration = {0, g, 0}});
  EXPECT_NEAR(shaken.greatest.weight, 20 / std::sqrt(2), 1e-5);
  const WeightRange<3> pulled = range({.weight = 1, .fixed = wrench_of<3>({0, 0, 5}, {0, 0, 0})});
  EXPECT_NEAR(pulled.greatest.weight, 15, 1e-5);
  EXPECT_NEAR(pulled.greatest.bound, 15, 1e-5);
  EXPECT_EQ(pulled.least.weight, 0);
  // Pushed up with 30 N, the weight must help.
  const WeightRange<3> pushed = range({.weight = 1, .fixed = wrench_of<3>({0, 0, -30}, {0, 0, 0})});
  EXPECT_NEAR(pushed.least.weight, 10, 1e-5);
  EXPECT_NEAR(pushed.greatest.weight, 50, 1e-4);
  const LeastFriction<3> friction =
      least_friction<3>(hand, {.weight = 4, .fixed = wrench_of<3>({0, 0, 6}, {0, 0, 0})}, up);
  EXPECT_NEAR(friction.factor, 0.5, 1e-6);
  EXPECT_NEAR(friction.bound, 0.5, 1e-6);
}

TEST(Loads, OfWhichNoWeightIsHeldAreProven) {
  const Vector<3> up(0, 0, 1);
  const Hand<3> hand(two_fingers(20), {0, 0, 0});  // which carries 20 N
  const auto range = [&](const Load<3>& load) { return weight_range<3>(hand, load, up); };
  // Pulled down with more than they carry, or along a line that they do not resist.
  const WeightRange<3> pulled = range({.weight = 1, .fixed = wrench_of<3>({0, 0, 25}, {0, 0, 0})});
  EXPECT_FALSE(pulled.holdable);
  EXPECT_TRUE(pulled.proven);
  EXPECT_EQ(pulled.greatest.bound, 0);
  // Whoever falls freely weighs nothing: only what pulls counts.
  const auto falling = [&](double pull) {
    return range({.weight = 1, .fixed = wrench_of<3>({0, 0, pull}, {0, 0, 0}), .lift = -g});
  };
  EXPECT_TRUE(falling(19).holdable && falling(19).proven);
  EXPECT_EQ(falling(19).greatest.weight, std::numeric_limits<double>::infinity());
  EXPECT_EQ(falling(19).least.weight, 0);
  EXPECT_FALSE(falling(21).holdable);
  EXPECT_TRUE(falling(21).proven);
}

TEST(Loads, AreMeasuredOverTheFarthestPointOfAPad) {
  std::vector<Contact<3>> contacts = two_fingers();
  for (Contact<3>& contact : contacts) {
    contact.torsion = 0;
    contact.pad = rectangular_pad({0.06, 0.02}, {0, 0, 1}, contact.normal, 2);
  }
  const Hand<3> hand(contacts, {0, 0, 0});
  const double corner = contacts[0].pad->points[0].norm(), length = std::hypot(0.03, corner);
  EXPECT_NEAR(hand.length(), length, 1e-15);
  Load<3> turned{.weight = 0, .fixed = wrench_of<3>({0, 0, 40}, {0, 0, 0})};
  turned.fixed[5] = 2;
  // Both press as hard as the force cap allows and drag half of the force; where they press gives
  // the moment.
  const double cap = 1e6, most = cap * (40 + 2 / length) / std::sqrt(2);
  const LeastFriction<3> friction = least_friction<3>(hand, turned, {0, 0, 1}, {.force_cap = cap});
  EXPECT_NEAR(friction.factor, 40 / (2 * 0.5) / most, 1e-6 * friction.factor);
  EXPECT_NEAR(friction.bound, friction.factor, 1e-6 * friction.factor);
}

Load<3> random_load(const Load<3>& plain) {
  Load<3> load = plain;
  if (one_in(2)) load.lift = real(-3, 5);
  if (one_in(2)) load.acceleration = real(0, 8) * any_direction<3>();
  if (one_in(2)) load.fixed.head<3>() = real(0, 1) * load.weight * any_direction<3>();
  if (one_in(3)) load.fixed.tail<3>() = real(0, 0.2) * load.weight * any_direction<3>();
  return load;
}

RC_GTEST_PROP(Loads, NoPostureNeedsLessThanTheBest, ()) {
  if (!one_in(25)) return;
  const space::Held held =
      *space::grasps({.least_contacts = 3, .most_contacts = 5, .awkward = false});
  SpatialFile file;
  file.contacts = held.contacts;
  for (int count = pick(1, 3); count > 0; --count) file.loads.push_back(random_load(held.object));
  const Grasp<3> grasp = file.grasp();
  Question question{.command = Command::best};
  question.objective = has_grip(grasp) && one_in(2) ? Objective::grip : Objective::effort;
  question.max_holds = 400;
  question.with_turn = false;
  const AnswerTo<3> answer = ask(file, grasp, question);
  const Best<3>& best = std::get<BestAnswer<3>>(answer.of).best;
  for (int k = 0; k < 100; ++k) {
    const Vector<3> up = any_direction<3>();
    double most = 0;
    for (const Load<3>& load : file.loads) {
      const Hold<3> hold = poise::hold<3>(grasp, load, up, {.objective = *question.objective});
      most = std::max(most, hold.holdable ? hold.value() : std::numeric_limits<double>::infinity());
    }
    RC_ASSERT(best.lower_bound <= most * (1 + 1e-7) + 1e-9);
    if (best.status == Status::unholdable) RC_ASSERT(std::isinf(most));
    if (best.status == Status::optimal)
      RC_ASSERT(best.best().value() <= most * (1 + 2e-6) + 1e-7 * grasp.size());
  }
  const verify::Verdict verdict = verify::verify<3>(grasp, std::get<BestAnswer<3>>(answer.of));
  RC_ASSERT(verify::refutations_text(verdict) == "");
}

/// Fixed wrenches and accelerations, also beside no weight or one that does not turn with gravity.
template <int Dim>
Load<Dim> any_load(double weight) {
  Load<Dim> load{.weight = one_in(5) ? 0 : weight, .com = 0.3 * any_direction<Dim>()};
  if (one_in(3)) load.lift = one_in(4) ? -g : real(-3, 8);
  if (one_in(2)) load.acceleration = real(0, 8) * any_direction<Dim>();
  if (one_in(2) || load.weight == 0 || load.lift == -g) {
    load.fixed = wrench_of<Dim>(real(0.1, 3) * weight * any_direction<Dim>(), any_direction<Dim>());
    if (one_in(3))
      load.fixed.template tail<wrench_size<Dim> - Dim>().array() += weight * real(0, 1);
  }
  return load;
}

/// At times between two pads alone, where little friction is enough.
std::vector<Contact<3>> with_pads(std::vector<Contact<3>> contacts) {
  for (Contact<3>& contact : contacts) {
    if (!one_in(2)) continue;
    const Vector<3> along = space::random_direction();
    if (along.cross(contact.normal.normalized()).norm() < 0.1) continue;
    contact.torsion = 0;
    contact.share = 1;
    contact.pad = rectangular_pad({real(0.05, 0.6), real(0.05, 0.6)}, along, contact.normal, 2);
  }
  return contacts;
}
std::vector<Contact<2>> with_pads(std::vector<Contact<2>> contacts) { return contacts; }

/// Every claim of a capacity document is proven by mathematics that share nothing with it.
template <int Dim>
void capacities_are_confirmed(int rarely) {
  if (!one_in(rarely)) return;
  const bool awkward = one_in(4);
  const auto held = [&] {
    if constexpr (Dim == 2)
      return *grasps({.most_contacts = 5, .awkward = awkward});
    else
      return *space::grasps({.least_contacts = 2, .most_contacts = 5, .awkward = awkward});
  }();
  FileOf<Dim> file;
  file.contacts = with_pads(held.contacts);
  for (int count = pick(1, 2); count > 0; --count)
    file.loads.push_back(any_load<Dim>(held.object.weight));
  if (one_in(3)) file.mechanism.kind = DriveKind::coupled;
  const Grasp<Dim> grasp = file.grasp();
  const Vector<Dim> up = any_direction<Dim>();
  Question question{.command = Command::capacity, .up = {up.data(), up.data() + Dim}};
  if (one_in(4)) question.force_cap = std::pow(10, pick(1, 7));
  const AnswerTo<Dim> answer = ask(file, grasp, question);
  const auto& capacity = std::get<CapacityAnswer<Dim>>(answer.of);
  const verify::Verdict verdict = verify::verify<Dim>(grasp, capacity);
  if (!verdict.confirmed()) RC_LOG() << document(grasp, capacity);
  RC_ASSERT(verify::refutations_text(verdict) == "");
}
RC_GTEST_PROP(Loads, CapacitiesAreConfirmedInThePlane, ()) { capacities_are_confirmed<2>(4); }
RC_GTEST_PROP(Loads, CapacitiesAreConfirmedInSpace, ()) { capacities_are_confirmed<3>(10); }

}  // namespace
}  // namespace poise::test
