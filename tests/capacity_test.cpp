// What a gripper can hold, against closed forms, a linear program solved by trying every basis,
// halving, and in long double what each proof says.
#include "poise/capacity.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "poise/grip.hpp"
#include "random_space_grasps.hpp"
#include "second_sources.hpp"
#include "space_checks.hpp"

namespace poise::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double cap = 1e6;
const Vector<2> upright(0, 1);

Contact<2> finger(const Vector<2>& position, const Vector<2>& normal, double friction,
                  double max_normal = infinity, double min_normal = 0) {
  Contact<2> result = contact(position, normal, friction, max_normal);
  result.min_normal = min_normal;
  return result;
}

/// A block between two fingers.
Grasp<2> vice(double friction, double max_normal, double weight = 10) {
  return {{weight, {0, 0}},
          {finger({-1, 0}, {1, 0}, friction, max_normal),
           finger({1, 0}, {-1, 0}, friction, max_normal)}};
}

/// Where the bracket between what is held and what is proven is as narrow as wanted.
/// The same contacts on an object of another weight [N].
template <int Dim>
Grasp<Dim> with_weight(const Grasp<Dim>& grasp, double weight) {
  return {Load<Dim>{.weight = weight, .com = grasp.center()}, grasp.contacts()};
}
template <int Dim, class Change>
Grasp<Dim> with_contacts(const Grasp<Dim>& grasp, const Change& change) {
  std::vector<Contact<Dim>> contacts = grasp.contacts();
  for (Contact<Dim>& contact : contacts) change(contact);
  return {grasp.loads().front(), std::move(contacts)};
}
/// With all frictions and torsions multiplied by a factor.
template <int Dim>
Grasp<Dim> with_friction(const Grasp<Dim>& grasp, double factor) {
  return with_contacts(grasp, [&](Contact<Dim>& contact) {
    contact.friction *= factor;
    contact.torsion *= factor;
  });
}
/// The contacts without max_normal alone: what these can hold once they can hold at any size.
template <int Dim>
Grasp<Dim> without_limits(const Grasp<Dim>& grasp) {
  return with_contacts(grasp, [](Contact<Dim>& contact) {
    contact.min_normal = 0;
    if (std::isfinite(contact.max_normal)) contact.max_normal = 0;
  });
}

testing::AssertionResult narrow(double held, double bound) {
  if (difference(held, bound) <= 1.01e-7) return testing::AssertionSuccess();
  return testing::AssertionFailure() << held << " and " << bound;
}

/// With the force cap reached y is 1e15 long: the forces balance all the same.
TEST(Capacity, OfForcesAtAHighForceCapIsBalanced) {
  std::vector<Contact<3>> contacts(5);
  const Vector<3> slanted(0.6087818949437428, -0.5842598186143455, 0.53667967051253);
  const Vector<3> at[] = {{1, 0, 0}, slanted, {0, 0, 1}, {0, 0, -1}, {0, 0, -1}};
  const double friction[] = {1.35115, 1.02492, 0.7004, 1.34469, 0.3432};
  for (std::size_t i = 0; i < 5; ++i) {
    contacts[i].position = at[i];
    contacts[i].normal = -at[i];
    contacts[i].friction = friction[i];
  }
  contacts[0].torsion = 0.001;
  contacts[1].torsion = 0.120152;
  contacts[0].share = 0.512555;
  contacts[1].share = 0.27173;
  contacts[4].share = 0.928465;
  const Grasp<3> grasp({.weight = 1, .com = {0.403, -0.17485, 0.0018}}, contacts);
  const Vector<3> up =
      Vector<3>(-0.10534405934228924, -0.09727810763320013, -0.9896664079055082).normalized();
  const double high_cap = 1e7;
  const LeastFriction<3> least =
      least_friction<3>(grasp, grasp.loads().front(), up, {.force_cap = high_cap});
  const Hold<3>& hold = least.posture.hold();
  ASSERT_TRUE(hold.holdable);
  const space::Real6 w = grasp.loads().front().at(up).cast<Real>();
  const Real norm = std::sqrt(hold.effort);
  EXPECT_GT(norm, 1e5);
  EXPECT_LE(space::imbalance(grasp, w, space::forces_of(hold)), 3e-11L + 1e-14L * norm * 5);
  EXPECT_EQ(least.proven, difference(least.factor, least.bound) <= 0.9e-5);
}

TEST(Capacity, OfTwoOpposedFingersIsTwiceTheirFriction) {
  const Grasp<2> grasp = vice(0.4, 25);
  const WeightRange<2> range = weight_range(grasp, grasp.loads().front(), upright);
  ASSERT_TRUE(range.holdable);
  EXPECT_EQ(range.least.weight, 0);
  EXPECT_TRUE(narrow(range.greatest.weight, range.greatest.bound));
  EXPECT_NEAR(range.greatest.bound, 2 * 0.4 * 25, 1e-9);
  EXPECT_NEAR(grip(grasp, range.greatest.posture.hold()), 25, 1e-5);
  for (const Deciding& contact : range.deciding) {
    EXPECT_TRUE(contact.slipping);
    EXPECT_NEAR(contact.per_newton, 0.4, 1e-9);
  }
  const LeastFriction<2> friction = least_friction(grasp, grasp.loads().front(), upright);
  EXPECT_TRUE(narrow(friction.factor, friction.bound));
  EXPECT_NEAR(0.4 * friction.bound, 10 / (2 * 25.0), 1e-9);
}

TEST(Capacity, OfAFingerBelowIsItsGreatestForce) {
  const Grasp<2> grasp({1, {0, 0}}, {finger({0, -1}, {0, 1}, 0.5, 7, 3)});
  const WeightRange<2> range = weight_range(grasp, grasp.loads().front(), upright);
  ASSERT_TRUE(range.holdable);
  EXPECT_NEAR(range.greatest.bound, 7, 1e-8);
  EXPECT_NEAR(range.least.bound, 3, 1e-8);
  EXPECT_TRUE(narrow(range.greatest.weight, range.greatest.bound));
  EXPECT_TRUE(narrow(range.least.weight, range.least.bound));
  EXPECT_NEAR(range.deciding[0].per_newton, 1, 1e-9);
  EXPECT_FALSE(least_friction(grasp, grasp.loads().front(), upright)
                   .posture.hold()
                   .holdable);  // 1 N is too little for it
  EXPECT_EQ(
      least_friction(with_weight(grasp, 5), with_weight(grasp, 5).loads().front(), upright).factor,
      0);
}

TEST(Capacity, IsNothingWhereNothingHolds) {
  // Pressed sideways by one finger; above both fingers; with two that push the same way.
  for (const Grasp<2>& grasp : {Grasp<2>({1, {0, 0}}, {finger({-1, 0}, {1, 0}, 1, 7, 3)}),
                                Grasp<2>({1, {0, 0}}, {finger({0, 1}, {0, -1}, 0.1, 5)}),
                                Grasp<2>({1, {0, 0}}, {finger({-1, 0}, {0.6, -0.8}, 0.1, 5),
                                                       finger({1, 0}, {-0.6, -0.8}, 0.1, 5)})}) {
    const WeightRange<2> range = weight_range(grasp, grasp.loads().front(), upright);
    EXPECT_FALSE(range.holdable);
    EXPECT_TRUE(range.greatest.bound <= 1e-11 || range.greatest.bound < range.least.bound);
    EXPECT_EQ(range.greatest.weight, 0);
  }
  // Nor does any friction help a finger that is above the com with nothing below.
  const Grasp<2> above({1, {0, 0}}, {finger({0, 1}, {0, -1}, 0.1)});
  const LeastFriction<2> friction = least_friction(above, above.loads().front(), upright);
  EXPECT_EQ(friction.factor, infinity);
  EXPECT_GE(friction.bound, 1e6);
}

TEST(Capacity, HasNoEndWhereNothingLimitsTheFingers) {
  const WeightRange<2> range =
      weight_range(vice(0.4, infinity), vice(0.4, infinity).loads().front(), upright);
  EXPECT_TRUE(range.holdable);
  EXPECT_EQ(range.greatest.weight, infinity);
  EXPECT_EQ(range.greatest.bound, infinity);
  EXPECT_TRUE(range.greatest.posture.hold().holdable);
  // A finger from above is limited, but the others need it not.
  const Grasp<2> grasp({1, {0, 0}}, {finger({-0.5, -1}, {0, 1}, 0), finger({0.5, -1}, {0, 1}, 0),
                                     finger({0, 1}, {0, -1}, 0, 5, 1)});
  const WeightRange<2> pressed = weight_range(grasp, grasp.loads().front(), upright);
  EXPECT_TRUE(pressed.holdable);
  EXPECT_EQ(pressed.greatest.weight, infinity);
  EXPECT_EQ(pressed.least.weight, 0);
}

TEST(Capacity, LeastFrictionOfThePapersDiskIsTheTangentOfItsContacts) {
  for (const double phi : {pi / 3, 5 * pi / 12, 1.4}) {
    std::vector<Contact<2>> contacts;
    for (const double side : {1.0, -1.0}) {
      const Vector<2> at(side * std::sin(phi), std::cos(phi));
      contacts.push_back(finger(at, -at, 2));
    }
    const Grasp<2> grasp({10, {0, 0}}, contacts);
    const LeastFriction<2> friction = least_friction(grasp, grasp.loads().front(), upright);
    // The force grows without bound towards the limit, and the force cap ends it.
    EXPECT_NEAR(2 * friction.factor, 1 / std::tan(phi), 1e-5);
    EXPECT_GT(2 * friction.bound, 1 / std::tan(phi) - 1e-9);
    EXPECT_LT(difference(friction.factor, friction.bound), 1e-6);
  }
}

// ---- The plane, by every basis of a linear program
// -----------------------------------------------

/// The greatest weight by linear programming: edge forces a, b >= 0 of each contact, which press
/// with a + b, slack s >= 0 and the weight: G f = weight w, a + b + s = max - min (all from min).
/// Tries every basis. -1 where none is feasible.
Real greatest_by_bases(const Grasp<2>& grasp, double theta) {
  const auto& contacts = grasp.contacts();
  const int n = static_cast<int>(contacts.size()), rows = 3 + n, columns = 3 * n + 1;
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> A =
      Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>::Zero(rows, columns);
  Eigen::Matrix<Real, Eigen::Dynamic, 1> b = Eigen::Matrix<Real, Eigen::Dynamic, 1>::Zero(rows);
  const RealVector com = grasp.center().cast<Real>();
  for (int i = 0; i < n; ++i) {
    const Contact<2>& contact = contacts[static_cast<std::size_t>(i)];
    const RealVector r = contact.position.cast<Real>() - com;
    for (const int k : {0, 1}) {
      const Real slope = (k == 0 ? 1 : -1) * Real{contact.friction};
      const RealVector f = in_object_frame(contact, {1, slope});
      A.col(3 * i + k).head<3>() = RealWrench(f.x(), f.y(), cross(r, f));
      A(3 + i, 3 * i + k) = 1;
    }
    A(3 + i, 3 * i + 2) = 1;
    b[3 + i] = contact.max_normal;
  }
  A.col(columns - 1).head<3>() = RealWrench(-std::sin(Real{theta}), -std::cos(Real{theta}), 0);
  Real greatest = -1;
  std::vector<int> basis;
  const auto choose = [&](const auto& self, int from) -> void {
    if (static_cast<int>(basis.size()) == rows) {
      Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> B(rows, rows);
      for (int k = 0; k < rows; ++k) B.col(k) = A.col(basis[static_cast<std::size_t>(k)]);
      const Eigen::FullPivLU<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>> lu(B);
      if (!lu.isInvertible()) return;
      const Eigen::Matrix<Real, Eigen::Dynamic, 1> x = lu.solve(b);
      if (x.minCoeff() < -1e-15L * b.maxCoeff()) return;
      const Real weight = basis.back() == columns - 1 ? x[rows - 1] : 0;
      greatest = std::max(greatest, weight);
      return;
    }
    if (from == columns) return;
    basis.push_back(from);
    self(self, from + 1);
    basis.pop_back();
    if (columns - from - 1 >= rows - static_cast<int>(basis.size())) self(self, from + 1);
  };
  choose(choose, 0);
  return greatest;
}

RC_GTEST_PROP(Capacity, IsThatOfALinearProgramInThePlane, ()) {
  Held held = *grasps({.least_contacts = 2, .most_contacts = 3, .limits = false, .awkward = false});
  for (Contact<2>& contact : held.contacts) contact.max_normal = 10 * real(1, 0.01);
  const double theta = random_angle();
  const Grasp<2> grasp = held.grasp();
  const WeightRange<2> range = weight_range(grasp, grasp.loads().front(), up_at(theta));
  const Real greatest = greatest_by_bases(grasp, theta);
  RC_ASSERT(std::abs(range.greatest.bound - greatest) <= 1e-9L * greatest + 1e-8L);
  RC_ASSERT(std::abs(range.greatest.weight - greatest) <= 1.01e-7L * greatest + 1e-8L);
}

// ---- Proofs, in long double
// ----------------------------------------------------------------------

struct Push {
  Real normal, beside;  ///< of the contact's velocity
};
Push push(const Contact<2>& contact, const Twist<2>& y) {
  const RealVector z = contact_velocity(contact, y);
  return {z.x(), std::abs(z.y())};
}
Push push(const Contact<3>& contact, const Twist<3>& y) {
  const space::Real3 n = space::normal_of(contact), omega = y.tail<3>().cast<Real>();
  const space::Real3 u = y.head<3>().cast<Real>() + omega.cross(contact.position.cast<Real>());
  const Real turn = contact.torsion > 0 ? omega.dot(n) * contact.torsion / contact.friction : 0;
  return {u.dot(n), std::hypot((u - u.dot(n) * n).norm(), turn)};
}

template <int Dim>
Eigen::Matrix<Real, wrench_size<Dim>, 1> load_of(const Grasp<Dim>& grasp, const Vector<Dim>& up) {
  if constexpr (Dim == 2)
    return load_at(grasp, angle_of(up));
  else
    return space::load_at(grasp, up);
}

/// Whether y proves that the grasp's weight cannot be held with up = `up`: for all contact forces
/// with a force norm of `cap` weights y . G f is less than y . w.
template <int Dim>
bool excludes(const Grasp<Dim>& grasp, const Vector<Dim>& up, const Twist<Dim>& y) {
  Real most = 0, squared = 0;
  for (const Contact<Dim>& contact : grasp.contacts()) {
    const Push z = push(contact, y);
    const Real mu = contact.friction, along = z.normal + mu * z.beside;
    if (std::isfinite(contact.max_normal)) {
      most += std::max(contact.max_normal * along, contact.min_normal * along);
      continue;
    }
    most += contact.min_normal * along;
    if (along <= 0) continue;
    const bool inside = z.beside <= mu * z.normal;
    const Real nearest = inside ? std::hypot(z.normal, z.beside) : along / std::sqrt(1 + mu * mu);
    squared += contact.share * nearest * nearest;
  }
  const Real weight = grasp.size();
  return y.template cast<Real>().dot(load_of(grasp, up)) > most + cap * weight * std::sqrt(squared);
}

/// Forces that balance the load within their cones: at a limit they need not be the least.
template <int Dim, class Load>
bool balances(const Grasp<Dim>& grasp, const Load& load, const Hold<Dim>& hold) {
  using namespace space;
  const auto forces = forces_of(hold);
  const Real digits = 1e-12L * (1 + std::sqrt(effort_of(grasp, forces)) / grasp.size());
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (outside(grasp.contacts()[i], forces[i]) > digits * grasp.size()) return false;
  return hold.holdable && forces.size() == grasp.contacts().size() &&
         imbalance(grasp, load, forces) <= 2e-12L + digits;
}

/// Holds and proofs of both ends say what they claim.
template <int Dim>
void check_range(const Grasp<Dim>& grasp, const Vector<Dim>& up) {
  const WeightRange<Dim> range = weight_range(grasp, grasp.loads().front(), up);
  const double greatest = range.greatest.bound, least = range.least.bound;
  double all_pushes = 0;
  for (const Contact<Dim>& contact : grasp.contacts()) all_pushes += contact.min_normal;
  // A push that nothing balances is within the tolerance of a far greater weight alone: holds keep
  // clear of the tolerance, proofs go up to it.
  const bool hidden = least > 1e3 * all_pushes;
  if (greatest < infinity && greatest > 1e-5)
    RC_ASSERT(excludes(with_weight(grasp, greatest * (1 + 1e-6)), up, range.greatest.dual));
  if (least > 0) RC_ASSERT(excludes(with_weight(grasp, least * (1 - 1e-6)), up, range.least.dual));
  if (!range.holdable) {
    RC_ASSERT(greatest <= 1e-5 || greatest < least * (1 + 1e-8) || hidden);
    return;
  }
  if (range.greatest.weight < infinity) {
    RC_ASSERT(difference(range.greatest.weight, greatest) <= 1e-3);
    RC_ASSERT(balances(with_weight(grasp, range.greatest.weight),
                       load_of(with_weight(grasp, range.greatest.weight), up),
                       range.greatest.posture.hold()));
  } else {
    RC_ASSERT(balances(without_limits(grasp), load_of(without_limits(grasp), up),
                       range.greatest.posture.hold()));
    RC_ASSERT(hold<Dim>(with_weight(grasp, 1e6 * (1 + range.least.weight)), up).holdable);
  }
  if (range.least.weight > 0) {
    RC_ASSERT(difference(range.least.weight, least) <= (hidden ? 0.7 : 1e-3));
    RC_ASSERT(balances(with_weight(grasp, range.least.weight),
                       load_of(with_weight(grasp, range.least.weight), up),
                       range.least.posture.hold()));
  }
}

template <int Dim>
void check_friction(const Grasp<Dim>& grasp, const Vector<Dim>& up) {
  const LeastFriction<Dim> least = least_friction(grasp, grasp.loads().front(), up);
  if (least.bound > 2e-6)
    RC_ASSERT(excludes(with_friction(grasp, least.bound * (1 - 1e-6) - 1e-6), up, least.dual));
  if (least.factor == infinity) {
    RC_ASSERT(!hold<Dim>(grasp, up).holdable);
    return;
  }
  RC_ASSERT(balances(with_friction(grasp, least.factor),
                     load_of(with_friction(grasp, least.factor), up), least.posture.hold()));
  // Beyond a thousand weights holds are found as far as rounding lets them.
  const bool large = std::sqrt(least.posture.hold().effort) > 1e3 * grasp.size();
  RC_ASSERT(large || least.factor - least.bound <= 2e-6 * (1 + least.factor));
}

RC_GTEST_PROP(Capacity, HoldsAndProvesWhatItSays, ()) {
  const Held held = *grasps();
  check_range(held.grasp(), up_at(random_angle()));
}
RC_GTEST_PROP(Capacity, LeastFrictionHoldsAndProvesWhatItSays, ()) {
  const Held held = *grasps();
  check_friction(held.grasp(), up_at(random_angle()));
}
RC_GTEST_PROP(CapacityInSpace, HoldsAndProvesWhatItSays, ()) {
  const space::Held held = *space::grasps();
  if (one_in(5)) check_range(held.grasp(), space::random_direction());
}
RC_GTEST_PROP(CapacityInSpace, LeastFrictionHoldsAndProvesWhatItSays, ()) {
  const space::Held held = *space::grasps();
  if (one_in(20)) check_friction(held.grasp(), space::random_direction());
}

TEST(Capacity, LeastFrictionOfACrateOnARampThatIsPushed) {
  // P = 100 N along the level: what is left of the pull along the ramp is mu times the pressure.
  const double s = 0.5, c = std::sqrt(0.75), W = 490.5, P = 100, mu = 0.25;
  const Vector<2> up_the_ramp(c, s), normal(-s, c);
  const Grasp<2> grasp({W, {0, 0}}, {finger(0.3 * up_the_ramp - 0.3 * normal, normal, mu),
                                     finger(-0.3 * up_the_ramp - 0.3 * normal, normal, mu),
                                     finger({-0.3464, 0}, {1, 0}, 0, P)});
  const LeastFriction<2> friction = least_friction(grasp, grasp.loads().front(), upright);
  const double least = (W * s - P * c) / (W * c + P * s);
  EXPECT_NEAR(mu * friction.factor, least, 1e-6);
  EXPECT_NEAR(mu * friction.bound, least, 1e-6);
}

/// More friction never harms, so holding tells on which side of the least it is.
template <int Dim>
void check_friction_by_holding(Grasp<Dim> grasp, const Vector<Dim>& up) {
  grasp = with_contacts(grasp, [](Contact<Dim>& contact) {
    if (one_in(2)) contact.max_normal = contact.min_normal + real(0.5, 4);
  });
  const LeastFriction<Dim> least = least_friction(grasp, grasp.loads().front(), up);
  for (double factor = 1e-3; factor < 1e5; factor *= real(1.5, 4)) {
    const bool held = hold<Dim>(with_friction(grasp, factor), up).holdable;
    RC_ASSERT(!held || factor >= least.bound * (1 - 1e-9));
    RC_ASSERT(held || factor <= least.factor * (1 + 1e-5));
  }
}

RC_GTEST_PROP(Capacity, LeastFrictionIsWhereHoldingBegins, ()) {
  const Held held = *grasps({.awkward = false});
  check_friction_by_holding(held.grasp(), up_at(random_angle()));
}

RC_GTEST_PROP(CapacityInSpace, LeastFrictionIsWhereHoldingBegins, ()) {
  const space::Held held = *space::grasps({.most_contacts = 6, .awkward = false});
  if (one_in(20)) check_friction_by_holding(held.grasp(), space::random_direction());
}

// ---- Drives and pads
// ---------------------------------------------------------------------------------

Contact<3> jaw(const Vector<3>& position, const Vector<3>& normal, double friction,
               const std::string& name) {
  return {.position = position, .normal = normal, .friction = friction, .finger = name};
}
std::vector<Contact<3>> two_jaws(double friction) {
  return {jaw({-0.02, 0, 0}, {1, 0, 0}, friction, "left"),
          jaw({0.02, 0, 0}, {-1, 0, 0}, friction, "right")};
}
std::vector<Contact<3>> two_pads(double friction) {
  std::vector<Contact<3>> jaws = two_jaws(friction);
  for (Contact<3>& contact : jaws)
    contact.pad = rectangular_pad({0.02, 0.01}, {0, 1, 0}, contact.normal);
  return jaws;
}
Mechanism<3> limited(DriveKind kind, double left, double right) {
  return {.kind = kind,
          .fingers = {{.name = "left", .max_force = left}, {.name = "right", .max_force = right}}};
}
const Vector<3> z_up(0, 0, 1);

template <int Dim>
WeightRange<Dim> weights(const Grasp<Dim>& grasp, const Vector<Dim>& up) {
  return weight_range(grasp, grasp.loads().front(), up);
}

TEST(CapacityOfDrives, OfTwoJawsIsTwiceTheFrictionOfTheWeaker) {
  for (const double other : {40.0, 30.0}) {
    const Grasp<3> grasp({.weight = 7}, two_jaws(0.3), 1, limited(DriveKind::each, 30, other));
    const WeightRange<3> range = weights(grasp, z_up);
    ASSERT_TRUE(range.holdable);
    EXPECT_NEAR(range.greatest.bound, 2 * 0.3 * 30, 1e-8);
    EXPECT_TRUE(narrow(range.greatest.weight, range.greatest.bound));
    EXPECT_EQ(range.least.weight, 0);
    // Both give the same force: the weaker decides, or both together.
    ASSERT_EQ(range.deciding_drives.size(), 2U);
    EXPECT_NEAR(range.deciding_drives[0] + range.deciding_drives[1], 2 * 0.3, 1e-7);
    if (other > 30) EXPECT_NEAR(range.deciding_drives[0], 2 * 0.3, 1e-7);
    for (const Deciding& contact : range.deciding) {
      EXPECT_EQ(contact.per_newton, 0);
      EXPECT_TRUE(contact.slipping);
    }
    const LeastFriction<3> friction = least_friction(grasp, grasp.loads().front(), z_up);
    EXPECT_NEAR(0.3 * friction.bound, 7 / (2 * 30.0), 1e-9);
    EXPECT_TRUE(narrow(friction.factor, friction.bound));
  }
}

// A vendor's rule for a gripper of which the fingers move together: W = 2 F C / S.
TEST(CapacityOfDrives, OfAGripperIsTheVendorsRule) {
  const double F = 130, C = 0.3, S = 2.4;
  const Grasp<3> grasp({.weight = 13}, two_jaws(C), S, limited(DriveKind::coupled, F, infinity));
  const WeightRange<3> range = weights(grasp, z_up);
  EXPECT_NEAR(range.greatest.bound, 2 * F * C / S, 1e-8);
  EXPECT_TRUE(narrow(range.greatest.weight, range.greatest.bound));
  ASSERT_EQ(range.deciding_drives.size(), 1U);
  EXPECT_NEAR(range.deciding_drives[0], 2 * C / S, 1e-8);
}

TEST(CapacityOfDrives, OfThreeFingersIsThatOfAll) {
  std::vector<Contact<3>> contacts;
  Mechanism<3> mechanism;
  for (int k = 0; k < 3; ++k) {
    const Vector<2> out = direction(2 * pi * k / 3);
    contacts.push_back(
        jaw({out.x(), out.y(), 0}, {-out.x(), -out.y(), 0}, 0.45, std::to_string(k)));
    mechanism.fingers.push_back({.name = std::to_string(k), .max_force = 20});
  }
  const Grasp<3> grasp({.weight = 9.8}, contacts, 1.5, mechanism);
  const WeightRange<3> range = weights(grasp, z_up);
  EXPECT_NEAR(range.greatest.bound, 20 * 3 * 0.45 / 1.5, 1e-7);
  EXPECT_TRUE(narrow(range.greatest.weight, range.greatest.bound));
}

// In one finger all contacts share what the drive gives; own limits count too.
TEST(CapacityOfDrives, CountsLimitsOfContactsAsWell) {
  std::vector<Contact<3>> contacts = {jaw({-0.02, 0, 0.01}, {1, 0, 0}, 0.5, "left"),
                                      jaw({0.02, 0, 0}, {-1, 0, 0}, 0.5, "right"),
                                      jaw({-0.02, 0, -0.01}, {1, 0, 0}, 0.5, "left")};
  for (Contact<3>& contact : contacts) contact.max_normal = 8;
  contacts[1].max_normal = infinity;
  const auto greatest = [&](double most) {
    return weights(Grasp<3>({.weight = 1}, contacts, 1, limited(DriveKind::each, most, most)), z_up)
        .greatest;
  };
  EXPECT_NEAR(greatest(12).bound, 12, 1e-8);  // the drives decide
  EXPECT_NEAR(greatest(50).bound, 16, 1e-8);  // the two contacts of 8 N
  EXPECT_TRUE(narrow(greatest(50).weight, greatest(50).bound));
}

TEST(CapacityOfDrives, IsAnyWhereFixedFingersCarryTheObject) {
  const std::vector<Contact<3>> contacts = {
      jaw({0.1, 0, 0}, {0, 0, 1}, 0.5, "fork"), jaw({-0.1, 0.1, 0}, {0, 0, 1}, 0.5, "fork"),
      jaw({-0.1, -0.1, 0}, {0, 0, 1}, 0.5, "fork"), jaw({0, 0, 0.1}, {0, 0, -1}, 0.5, "jaw")};
  Mechanism<3> mechanism{.kind = DriveKind::listed};
  Twist<3> down = Twist<3>::Zero();
  down[2] = -1;
  mechanism.drives.push_back({"jaw", {{"jaw", down}}, 5});
  const Grasp<3> grasp({.weight = 5}, contacts, 1, mechanism);
  const WeightRange<3> range = weights(grasp, z_up);
  EXPECT_EQ(range.greatest.weight, infinity);
  ASSERT_TRUE(range.greatest.posture.hold().holdable);
  EXPECT_NEAR(range.greatest.posture.hold().forces[3].normal, 0, 1e-8);
  // Upside down the jaw carries it.
  const WeightRange<3> hanging = weights(grasp, Vector<3>(0, 0, -1));
  EXPECT_NEAR(hanging.greatest.bound, 5, 1e-8);
  EXPECT_TRUE(narrow(hanging.greatest.weight, hanging.greatest.bound));
  EXPECT_NEAR(hanging.deciding_drives[0], 1, 1e-8);
}

TEST(CapacityOfDrives, HasALeastWeightWhereAFingerMustPress) {
  // Pushed from below with 12 N or more, between jaws that carry up to 0.3 * 5 N each.
  std::vector<Contact<3>> contacts = two_jaws(0.3);
  contacts.push_back(jaw({0, 0, -0.02}, {0, 0, 1}, 0.3, "floor"));
  contacts.back().min_normal = 12;
  Mechanism<3> mechanism = limited(DriveKind::each, 5, 5);
  mechanism.fingers.push_back({.name = "floor", .max_force = 20});
  const Grasp<3> grasp({.weight = 10}, contacts, 1, mechanism);
  const WeightRange<3> range = weights(grasp, z_up);
  ASSERT_TRUE(range.holdable);
  EXPECT_NEAR(range.least.bound, 12 - 2 * 0.3 * 5, 1e-6);
  EXPECT_NEAR(range.greatest.bound, 20 + 2 * 0.3 * 5, 1e-6);
  EXPECT_TRUE(narrow(range.greatest.weight, range.greatest.bound));
  EXPECT_TRUE(narrow(range.least.weight, range.least.bound));
}

TEST(CapacityOfPads, IsTheLimitOverTheGripOfANewton) {
  for (const DriveKind kind : {DriveKind::each, DriveKind::coupled}) {
    const Load<3> load{.weight = 3, .com = {0, 0.015, 0.004}};
    const double F = least_grip(Grasp<3>(load, two_pads(0.4), 1, {.kind = kind}), z_up).grip;
    const Grasp<3> grasp(load, two_pads(0.4), 1, limited(kind, 25, 25));
    const WeightRange<3> range = weights(grasp, z_up);
    EXPECT_NEAR(range.greatest.bound, 25 * 3 / F, 1e-6);
    EXPECT_TRUE(narrow(range.greatest.weight, range.greatest.bound));
    // Without limits any weight; with those of the pads instead of the drives the same.
    EXPECT_EQ(weights(Grasp<3>(load, two_pads(0.4)), z_up).greatest.weight, infinity);
    std::vector<Contact<3>> pads = two_pads(0.4);
    for (Contact<3>& contact : pads) contact.max_normal = 25;
    const WeightRange<3> by_pads = weights(Grasp<3>(load, pads), z_up);
    EXPECT_NEAR(by_pads.greatest.bound, 25 * 3 / F, 1e-6);
    EXPECT_NEAR(by_pads.deciding[0].per_newton + by_pads.deciding[1].per_newton, 3 / F, 1e-6);
  }
}

TEST(CapacityOfPads, LeastFrictionIsWhereHoldingBegins) {
  const Load<3> load{.weight = 3, .com = {0, 0.015, 0.004}};
  const Grasp<3> grasp(load, two_pads(0.8), 1, limited(DriveKind::coupled, 25, 25));
  const LeastFriction<3> friction = least_friction(grasp, load, z_up);
  ASSERT_LT(friction.factor, 1);
  EXPECT_TRUE(narrow(friction.factor, friction.bound));
  const auto holds = [&](double factor) {
    return hold(Grasp<3>(load, two_pads(0.8 * factor), 1, grasp.mechanism()), z_up).holdable;
  };
  EXPECT_TRUE(holds(friction.factor * (1 + 1e-6)));
  EXPECT_FALSE(holds(friction.bound * (1 - 1e-6)));
}

TEST(CapacityOfDrives, CommandsTheGripWithItsSafety) {
  for (const bool pads : {false, true}) {
    const Grasp<3> grasp({.weight = 9}, pads ? two_pads(0.3) : two_jaws(0.3), 1,
                         limited(DriveKind::coupled, 20, 20));
    const Posture<3> safe = capacity(grasp, grasp.loads().front(), z_up, 1.5).safe;
    ASSERT_TRUE(safe.holdable());
    EXPECT_EQ(safe.hold().objective, Objective::grip);
    EXPECT_NEAR(safe.hold().grip, 1.5 * 9 / (2 * 0.3), 1e-6);  // more than the 20 N of the gripper
  }
}

/// What (y, rates) prove, from the contacts alone: whether more than the grasp's weight is needed.
template <int Dim>
bool excludes(const Grasp<Dim>& grasp, const Vector<Dim>& up, const WeightEnd<Dim>& end) {
  const std::vector<Drive<Dim>> drives = grasp.drives();
  Real most = 0;
  for (std::size_t a = 0; a < end.rates.size(); ++a)
    if (end.rates[a] > 0) most += Real{end.rates[a]} * drives[a].max;
  Real squared = 0;
  for (const Contact<Dim>& contact : grasp.contacts()) {
    Twist<Dim> felt = end.dual;
    for (std::size_t a = 0; a < end.rates.size(); ++a)
      for (const auto& moved : drives[a].moves)
        if (moved.finger == contact.finger) felt -= end.rates[a] * moved.twist;
    const Push z = push(contact, felt);
    const Real mu = contact.friction, along = z.normal + mu * z.beside;
    if (std::isfinite(contact.max_normal)) {
      most += std::max(contact.max_normal * along, contact.min_normal * along);
      continue;
    }
    most += contact.min_normal * along;
    if (along > 0) squared += along * along;  // no less than the projection
  }
  return end.dual.template cast<Real>().dot(load_of(grasp, up)) >
         most + cap * grasp.size() * std::sqrt(squared);
}

/// Held on one side of a limit, not on the other.
template <class Holds>
void changes_at(const Holds& holds, double held, double not_held) {
  RC_ASSERT(holds(held));
  RC_ASSERT(!holds(not_held));
}

#ifndef __wasm__  // near a limit of drives these need wide numbers, which the page does without
template <int Dim, class Recipe>
void check_drives(const Recipe& held, const Vector<Dim>& up) {
  Mechanism<Dim> mechanism;
  mechanism.kind = one_in(3) ? DriveKind::coupled : DriveKind::each;
  const Hand<Dim> hand = held.grasp();
  for (const std::string& name : hand.fingers())
    mechanism.fingers.push_back({.name = name, .max_force = real(1, 40)});
  for (std::size_t k = 0; k < hand.fingers().size(); ++k)
    if (hand.closing(k).isZero(0)) return;
  const Load<Dim> load = held.grasp().loads().front();
  const Grasp<Dim> grasp(load, held.contacts, 1, mechanism);
  const WeightRange<Dim> range = weights(grasp, up);
  if (!range.holdable || range.greatest.weight == infinity) return;
  const double greatest = range.greatest.bound;
  if (greatest < 1e-3) return;
  RC_ASSERT(difference(range.greatest.weight, greatest) <= 1e-6);
  const auto at = [&](double weight) {
    return Grasp<Dim>({.weight = weight, .com = load.com}, held.contacts, 1, mechanism);
  };
  RC_ASSERT(excludes(at(greatest * (1 + 1e-6)), up, range.greatest));
  RC_ASSERT(hold(at(range.greatest.weight * (1 - 1e-6)), up).holdable);
  RC_ASSERT(!hold(at(greatest * (1 + 1e-6)), up).holdable);
  const Hold<Dim>& held_there = range.greatest.posture.hold();
  for (const DriveEffort& drive : drive_efforts(grasp, held_there))
    RC_ASSERT(drive.part_of_max <= 1 + 1e-7);
  if (range.least.weight > 1e-3) {
    RC_ASSERT(excludes(at(range.least.bound * (1 - 1e-6)), up, range.least));
    RC_ASSERT(difference(range.least.weight, range.least.bound) <= 1e-6);
  }
  const bool pressed = std::any_of(held.contacts.begin(), held.contacts.end(),
                                   [](const auto& contact) { return contact.min_normal > 0; });
  if (pressed) return;
  // The same by the least grip: all limits in the same parts, those of contacts as they are.
  bool own = false;
  for (const Contact<Dim>& contact : held.contacts) own = own || std::isfinite(contact.max_normal);
  const Hold<Dim> grip = least_grip(at(1), up);
  if (!own && grip.holdable && grip.grip > 1e-6)
    RC_ASSERT(difference(most_grip<Dim>(grasp) / grip.grip, greatest) <= 1e-6);
}

RC_GTEST_PROP(CapacityOfDrives, IsProvenAndIsTheLimitOverTheLeastGripInThePlane, ()) {
  if (!one_in(4)) return;
  const Held held = *grasps({.most_contacts = 5, .limits = one_in(2), .awkward = false});
  check_drives<2>(held, up_at(random_angle()));
}
RC_GTEST_PROP(CapacityOfDrives, IsProvenAndIsTheLimitOverTheLeastGripInSpace, ()) {
  if (!one_in(4)) return;
  const space::Held held = *space::grasps(
      {.least_contacts = 2, .most_contacts = 6, .limits = one_in(2), .awkward = false});
  check_drives<3>(held, space::random_direction());
}

RC_GTEST_PROP(CapacityOfDrives, LeastFrictionIsWhereHoldingBegins, ()) {
  if (!one_in(3)) return;
  const space::Held held =
      *space::grasps({.least_contacts = 3, .most_contacts = 6, .limits = false, .awkward = false});
  Mechanism<3> mechanism;
  for (std::size_t k = 0; k < held.contacts.size(); ++k)
    mechanism.fingers.push_back({.name = std::to_string(k), .max_force = real(1, 40)});
  const Load<3> load = held.grasp().loads().front();
  const Grasp<3> grasp(load, held.contacts, 1, mechanism);
  const Vector<3> up = space::random_direction();
  const LeastFriction<3> friction = least_friction(grasp, load, up);
  if (!(friction.factor < 1e3) || friction.bound < 1e-3) return;
  RC_ASSERT(difference(friction.factor, friction.bound) <= 3e-6);
  const auto holds = [&](double factor) {
    const Grasp<3> other = with_friction(held.grasp(), factor);
    return hold(Grasp<3>(load, other.contacts(), 1, mechanism), up).holdable;
  };
  changes_at(holds, friction.factor * (1 + 1e-6), friction.bound * (1 - 1e-6));
}

#endif

// ---- Space
// ---------------------------------------------------------------------------------------

TEST(CapacityInSpace, OfSoftJawsBesideTheComIsThatOfTheirEllipse) {
  // Each jaw carries half of the weight and half of its moment about the line between them.
  const double mu = 0.6, gamma = 0.01, max = 40, arm = 0.03;
  Contact<3> left, right;
  left.position = {-0.02, 0, 0};
  left.normal = {1, 0, 0};
  left.friction = mu;
  left.torsion = gamma;
  left.max_normal = max;
  right = left;
  right.position.x() = 0.02;
  right.normal.x() = -1;
  const Vector<3> up(0, 0, 1);
  const Grasp<3> grasp({5, {0, arm, 0}}, {left, right});
  const WeightRange<3> range = weight_range(grasp, grasp.loads().front(), up);
  const double weight = 2 * max / std::hypot(1 / mu, arm / gamma);
  EXPECT_NEAR(range.greatest.bound, weight, 1e-8 * weight);
  EXPECT_TRUE(narrow(range.greatest.weight, range.greatest.bound));
  const LeastFriction<3> friction = least_friction(grasp, grasp.loads().front(), up);
  EXPECT_NEAR(friction.bound, 5 / weight, 1e-8);
  // Hard ones cannot resist the moment, whatever they press.
  left.torsion = right.torsion = 0;
  const Grasp<3> hard({5, {0, arm, 0}}, {left, right});
  EXPECT_FALSE(weight_range(hard, hard.loads().front(), up).holdable);
  EXPECT_EQ(least_friction(hard, hard.loads().front(), up).factor, infinity);
}

RC_GTEST_PROP(CapacityInSpace, IsWhereHoldingEnds, ()) {
  if (!one_in(5)) return;
  space::Held held = *space::grasps({.least_contacts = 3, .most_contacts = 6, .awkward = false});
  for (Contact<3>& contact : held.contacts)
    if (contact.max_normal == infinity) contact.max_normal = contact.min_normal + 10 * real(1, 0.1);
  const Grasp<3> grasp = held.grasp();
  const Vector<3> up = space::random_direction();
  const auto holds = [&](double weight) { return hold(with_weight(grasp, weight), up).holdable; };
  const WeightRange<3> range = weight_range(grasp, grasp.loads().front(), up);
  if (!range.holdable || range.greatest.weight < 1e-3) return;
  RC_ASSERT(narrow(range.greatest.weight, range.greatest.bound));
  changes_at(holds, range.greatest.weight * (1 - 1e-6), range.greatest.bound * (1 + 1e-6));
  if (range.least.weight > 1e-3)
    changes_at(holds, range.least.weight * (1 + 1e-6), range.least.bound * (1 - 1e-6));
  const LeastFriction<3> friction = least_friction(grasp, grasp.loads().front(), up);
  if (friction.factor < 1e3 && friction.bound > 1e-3)
    changes_at([&](double factor) { return hold(with_friction(grasp, factor), up).holdable; },
               friction.factor * (1 + 1e-6), friction.bound * (1 - 1e-6));
}

RC_GTEST_PROP(CapacityInSpace, GrowsWithTheLimitsAndNotWithTheWeight, ()) {
  if (!one_in(5)) return;
  const space::Held held =
      *space::grasps({.least_contacts = 3, .most_contacts = 6, .awkward = false});
  const Vector<3> up = space::random_direction();
  const WeightRange<3> one = weight_range(held.grasp(), held.grasp().loads().front(), up);
  if (!one.holdable || one.greatest.bound < 1e-3 || one.greatest.bound == infinity) return;
  space::Held strong = held;
  const double times = real(1, 8);
  for (Contact<3>& contact : strong.contacts) {
    contact.min_normal *= times;
    contact.max_normal *= times;
  }
  strong.object.weight *= 3;
  const WeightRange<3> other = weight_range(strong.grasp(), strong.grasp().loads().front(), up);
  RC_ASSERT(close(times * one.greatest.bound, other.greatest.bound, 1e-6L, 1e-6L));
  RC_ASSERT(close(times * one.least.bound, other.least.bound, 1e-6L, 1e-6L));
}

}  // namespace
}  // namespace poise::test
