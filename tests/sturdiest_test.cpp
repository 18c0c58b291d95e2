// The posture that withstands most: closed forms, what many other postures withstand, and proofs
// checked by code that shares nothing with the search.
#include <gtest/gtest.h>

#include "ask/document.hpp"
#include "poise/shake.hpp"
#include "random_space_grasps.hpp"
#include "verify/verify.hpp"

namespace poise::test {
namespace {

constexpr double g = standard_gravity;
constexpr double infinity = std::numeric_limits<double>::infinity();

template <int Dim>
Vector<Dim> any_direction() {
  if constexpr (Dim == 2)
    return direction(random_angle());
  else
    return space::random_direction();
}

/// Pushers without friction along all axes, through the centre of mass.
template <int Dim>
Grasp<Dim> pushers(double weight, double max) {
  std::vector<Contact<Dim>> contacts;
  for (int k = 0; k < Dim; ++k)
    for (const double side : {-1.0, 1.0})
      contacts.push_back({.position = 0.1 * side * Vector<Dim>::Unit(k),
                          .normal = -side * Vector<Dim>::Unit(k),
                          .friction = 0,
                          .max_normal = max});
  return {{.weight = weight}, contacts};
}

/// They supply a box of accelerations, and (0, 0, g) is farthest from its faces along a diagonal.
template <int Dim>
void pushers_are_sturdiest_along_a_diagonal() {
  for (const double max : {12.0, 40.0}) {
    const Grasp<Dim> grasp = pushers<Dim>(10, max);
    const double expected = max / 10 * g - g / std::sqrt(Dim);
    const Sturdiest<Dim> found = sturdiest_posture(grasp);
    ASSERT_EQ(found.status, Status::optimal);
    EXPECT_NEAR(found.acceleration, expected, 1e-3 * expected);
    EXPECT_NEAR(found.bound, expected, 1e-3 * expected);
    EXPECT_LE(found.acceleration, expected * (1 + 1e-9));
    EXPECT_GE(found.bound, expected * (1 - 1e-9));
    EXPECT_NEAR(found.up.cwiseAbs().minCoeff(), 1 / std::sqrt(Dim), 0.01);
  }
  // Too weak along an axis, strong enough along a diagonal; or too weak anywhere.
  EXPECT_EQ(sturdiest_posture(pushers<Dim>(10, 9)).status, Status::optimal);
  const Sturdiest<Dim> none = sturdiest_posture(pushers<Dim>(10, 5));
  EXPECT_EQ(none.status, Status::unholdable);
  EXPECT_EQ(none.bound, 0);
  EXPECT_TRUE(none.shakes.empty());
}
TEST(Sturdiest, PushersAreAlongADiagonal) {
  pushers_are_sturdiest_along_a_diagonal<2>();
  pushers_are_sturdiest_along_a_diagonal<3>();
}

/// Two fingers supply |z_y| + 2 mu |z_x| <= 2 mu F / m: what presses is left over from pushing.
TEST(Sturdiest, TwoOpposedFingersHoldByFrictionOrStandUpright) {
  for (const double mu : {0.2, 0.4, 0.6, 1.0}) {
    const Contact<2> left{.position = {-1, 0}, .normal = {1, 0}, .friction = mu, .max_normal = 80};
    const Contact<2> right{.position = {1, 0}, .normal = {-1, 0}, .friction = mu, .max_normal = 80};
    const Grasp<2> grasp({.weight = 2 * g}, {left, right});
    const double expected =
        (2 * mu * 80 / 2 - g * std::min(1.0, 2 * mu)) / std::sqrt(1 + 4 * mu * mu);
    const Sturdiest<2> found = sturdiest_posture(grasp);
    ASSERT_EQ(found.status, Status::optimal);
    EXPECT_NEAR(found.acceleration, expected, 1e-3 * expected);
    EXPECT_NEAR(found.bound, expected, 1e-3 * expected);
    EXPECT_NEAR(std::abs(found.up[mu < 0.5 ? 0 : 1]), 1, 1e-2);
  }
}

/// With a limit nearly always, as else nothing limits what is withstood.
template <int Dim>
Grasp<Dim> random_grasp() {
  const auto held = [] {
    if constexpr (Dim == 2)
      return *grasps({.least_contacts = 2, .most_contacts = 5, .awkward = one_in(4)});
    else
      return *space::grasps({.least_contacts = 2, .most_contacts = 6, .awkward = one_in(4)});
  }();
  std::vector<Contact<Dim>> contacts = held.contacts;
  for (Contact<Dim>& contact : contacts) contact.min_normal = 0;
  if (!one_in(8))
    for (Contact<Dim>& contact : contacts) contact.max_normal = held.object.weight * real(0.5, 5);
  std::vector<Load<Dim>> loads{held.object};
  if (one_in(3)) {
    Load<Dim> other = held.object;
    other.weight *= real(0.3, 1.5);
    other.com += 0.1 * any_direction<Dim>();
    if (one_in(2))
      other.fixed = wrench_of<Dim>(real(0, 0.5) * other.weight * any_direction<Dim>(),
                                   0.2 * any_direction<Dim>());
    loads.push_back(other);
  }
  return {loads, contacts};
}

template <int Dim>
void no_posture_withstands_more() {
  if (!one_in(3)) return;
  const Grasp<Dim> grasp = random_grasp<Dim>();
  SturdyAnswer<Dim> answer;
  double most = std::numbers::pi;
  Vector<Dim> from = any_direction<Dim>();
  if constexpr (Dim == 2) {
    if (one_in(4)) answer.domain = Domain::pinching_up;
    answer.found = sturdiest_posture(grasp, answer.domain, answer.settings);
  } else {
    if (one_in(3)) answer.tilt = Tilt{from, most = real(0, std::numbers::pi / 2)};
    answer.found = sturdiest_posture(grasp, answer.tilt, answer.settings);
  }
  const Sturdiest<Dim>& found = answer.found;
  RC_LOG() << document(grasp, answer);
  if (found.status == Status::optimal && found.bound < infinity)
    RC_ASSERT(found.bound <= found.acceleration * 1.001 + 1e-8);
  if (!found.shakes.empty()) {
    const Shake<Dim> own = shake<Dim>(grasp, found.up);
    RC_ASSERT(own.bound >= found.acceleration * (1 - 1e-6) - 1e-7);
    RC_ASSERT(own.acceleration <= found.bound * (1 + 1e-6) + 1e-7);
  }
  for (int k = 0; k < 12; ++k) {
    Vector<Dim> up = any_direction<Dim>();
    if constexpr (Dim == 3)
      if (std::acos(std::clamp(up.dot(from), -1.0, 1.0)) > most) up = from;
    if constexpr (Dim == 2)
      if (answer.domain == Domain::pinching_up) {
        const Interval domain = domain_interval(grasp, answer.domain);
        up = up_at(domain.from + real(0, domain.to - domain.from));
      }
    const Shake<Dim> other = shake<Dim>(grasp, up);
    if (!other.holdable) continue;
    RC_ASSERT(!(other.acceleration > found.bound * (1 + 1e-6) + 1e-7));
    RC_ASSERT(found.status != Status::unholdable || other.acceleration < 1e-7);
  }
  RC_ASSERT(verify::refutations_text(verify::verify(grasp, answer)) == "");
}
RC_GTEST_PROP(Sturdiest, NoPostureOfThePlaneWithstandsMore, ()) { no_posture_withstands_more<2>(); }
RC_GTEST_PROP(Sturdiest, NoPostureOfSpaceWithstandsMore, ()) { no_posture_withstands_more<3>(); }

TEST(Sturdiest, IsThePresentPostureWhereNothingIsBetter) {
  const Contact<3> left{
      .position = {-1, 0, 0}, .normal = {1, 0, 0}, .friction = 0.5, .torsion = 0.1};
  Contact<3> right = left;
  right.position *= -1;
  right.normal *= -1;
  const Vector<3> present = Vector<3>(1, 2, 2) / 3;
  const Sturdiest<3> free =
      sturdiest_posture(Grasp<3>({.weight = 1}, {left, right}), {}, {}, present);
  EXPECT_EQ(free.up, present);
  EXPECT_EQ(free.acceleration, infinity);
  EXPECT_EQ(free.bound, infinity);
  // A box is as sturdy along each of its diagonals.
  const Vector<3> diagonal = Vector<3>(-1, 1, -1) / std::sqrt(3);
  const Sturdiest<3> box = sturdiest_posture(pushers<3>(10, 20), {}, {}, diagonal);
  EXPECT_LT((box.up - diagonal).norm(), 1e-12);
  EXPECT_EQ(box.status, Status::optimal);
}

TEST(Sturdiest, RefusesWhatIsNone) {
  const Grasp<3> grasp = pushers<3>(10, 20);
  EXPECT_THROW(sturdiest_posture(grasp, Tilt{{0, 0, 2}, 1}), InvalidGrasp);
  EXPECT_THROW(sturdiest_posture(grasp, Tilt{{0, 0, 1}, 2}), InvalidGrasp);
  EXPECT_THROW(sturdiest_posture(grasp, {}, {.gap = 0}), InvalidGrasp);
  EXPECT_THROW(sturdiest_posture(grasp, {}, {}, {0, 0, 2}), InvalidGrasp);
}

}  // namespace
}  // namespace poise::test
