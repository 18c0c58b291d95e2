// What a grasp refuses, what it prepares, and whether it closes.
#include "poise/grasp.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>

#include "checks.hpp"
#include "random_grasps.hpp"

namespace poise::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::nan("");

Held two_fingers() {
  Held held{{10, {0, 0}}, {}};
  held.contacts.resize(2);
  held.contacts[0].position = {1, 0};
  held.contacts[0].normal = {-2, 0};
  held.contacts[1].position = {-1, 0};
  held.contacts[1].normal = {0.5, 0};
  for (Contact<2>& contact : held.contacts) contact.friction = 0.5;
  return held;
}

struct Mistake {
  std::string path;
  std::function<void(Held&)> make;
};

const std::vector<Mistake> mistakes{
    {"loads[0].weight", [](Held& h) { h.object.weight = 0; }},
    {"loads[0].weight", [](Held& h) { h.object.weight = -1; }},
    {"loads[0].weight", [](Held& h) { h.object.weight = not_a_number; }},
    {"loads[0].weight", [](Held& h) { h.object.weight = infinity; }},
    {"loads[0].weight", [](Held& h) { h.object.weight = 1e200; }},
    {"loads[0].com[0]", [](Held& h) { h.object.com.x() = not_a_number; }},
    {"loads[0].com[1]", [](Held& h) { h.object.com.y() = infinity; }},
    {"contacts", [](Held& h) { h.contacts.clear(); }},
    {"contacts[1].position[0]", [](Held& h) { h.contacts[1].position.x() = -infinity; }},
    {"contacts[1].position[1]", [](Held& h) { h.contacts[1].position.y() = 1e160; }},
    {"contacts[0].normal",
     [](Held& h) {
       h.contacts[0].normal = {0, 0};
     }},
    {"contacts[0].normal[1]", [](Held& h) { h.contacts[0].normal.y() = not_a_number; }},
    {"contacts[1].friction", [](Held& h) { h.contacts[1].friction = -0.1; }},
    {"contacts[1].friction", [](Held& h) { h.contacts[1].friction = infinity; }},
    {"contacts[0].min_normal", [](Held& h) { h.contacts[0].min_normal = -1; }},
    {"contacts[0].min_normal", [](Held& h) { h.contacts[0].min_normal = infinity; }},
    {"contacts[0].max_normal", [](Held& h) { h.contacts[0].max_normal = -1; }},
    {"contacts[0].max_normal", [](Held& h) { h.contacts[0].max_normal = not_a_number; }},
    {"contacts[0].max_normal",
     [](Held& h) {
       h.contacts[0].min_normal = 2;
       h.contacts[0].max_normal = 1;
     }},
    {"contacts[1].share", [](Held& h) { h.contacts[1].share = 0; }},
    {"contacts[1].share", [](Held& h) { h.contacts[1].share = 1.1; }},
    {"contacts[1].share", [](Held& h) { h.contacts[1].share = not_a_number; }},
};

TEST(Grasp, RefusesWhatHasNoMeaningAndSaysWhere) {
  for (const Mistake& mistake : mistakes) {
    Held held = two_fingers();
    mistake.make(held);
    try {
      held.grasp();
      ADD_FAILURE() << mistake.path << " was accepted";
    } catch (const InvalidGrasp& error) {
      EXPECT_EQ(error.path(), mistake.path);
      EXPECT_FALSE(error.problem().empty());
      EXPECT_EQ(std::string(error.what()), error.path() + ": " + error.problem());
    }
  }
}

TEST(Grasp, RefusesASafetyBelowOne) {
  const Held held = two_fingers();
  for (const double safety : {0.999, 0.0, -1.0, not_a_number, infinity}) {
    try {
      Grasp<2>(held.object, held.contacts, safety);
      ADD_FAILURE() << safety << " was accepted";
    } catch (const InvalidGrasp& error) {
      EXPECT_EQ(error.path(), "safety");
    }
  }
}

TEST(Grasp, RefusesAMechanismThatHasNoMeaningAndSaysWhere) {
  const Held held = two_fingers();
  using Moves = std::vector<Drive<2>::Moved>;
  const auto listed = [](std::vector<Drive<2>> drives) {
    return Mechanism<2>{DriveKind::listed, {}, std::move(drives)};
  };
  const auto fingers = [](std::vector<Finger<2>> given) {
    return Mechanism<2>{DriveKind::each, std::move(given), {}};
  };
  const Twist<2> left(-1, 0, 0), right(1, 0, 0);
  const Drive<2> jaw{"jaw", Moves{{"0", left}}};
  for (const auto& [path, mechanism] : std::vector<std::pair<std::string, Mechanism<2>>>{
           {"drives", listed({})},
           {"drives[0].moves", listed({{"jaw", {}}})},
           {"drives[0].moves[0]", listed({{"jaw", Moves{{"thumb", left}}}})},
           {"drives[0].moves[1]", listed({{"jaw", Moves{{"0", left}, {"0", right}}}})},
           {"drives[0].moves[1]", listed({{"jaw", Moves{{"0", left}, {"1", Twist<2>::Zero()}}}})},
           {"drives[0].moves[0]", listed({{"jaw", Moves{{"0", {not_a_number, 0, 0}}}}})},
           {"drives[0].max", listed({{"jaw", Moves{{"0", left}}, not_a_number}})},
           {"drives[1].name", listed({jaw, {"jaw", Moves{{"1", right}}}})},
           {"fingers.thumb", fingers({{.name = "thumb"}})},
           {"fingers.0", fingers({{.name = "0"}, {.name = "1"}, {.name = "0"}})},
           {"fingers.0.closing", fingers({{.name = "0", .closing = {not_a_number, 0}}})},
           {"fingers.0.closing", fingers({{.name = "0", .closing = {1, 0}}})},
           {"fingers.0.max_force", fingers({{.name = "0", .max_force = not_a_number}})}}) {
    try {
      Grasp<2>(held.object, held.contacts, 1, mechanism);
      ADD_FAILURE() << path << " was accepted";
    } catch (const InvalidGrasp& error) {
      EXPECT_EQ(error.path(), path);
    }
  }
}

TEST(Grasp, SaysWhichLoadHasNoMeaning) {
  const Held held = two_fingers();
  for (const auto& [path, load] : std::vector<std::pair<std::string, Load<2>>>{
           {"loads[1].weight", {.weight = -1}},
           {"loads[1].com[0]", {.com = {infinity, 0}}},
           {"loads[1].fixed", {.fixed = {0, 0, not_a_number}}},
           {"loads[1].lift", {.lift = not_a_number}},
           {"loads[1].acceleration[1]", {.acceleration = {0, not_a_number}}},
           {"loads[1].weight", {.lift = -standard_gravity}}}) {
    try {
      Grasp<2>(std::vector{held.object, load}, held.contacts);
      ADD_FAILURE() << path << " was accepted";
    } catch (const InvalidGrasp& error) {
      EXPECT_EQ(error.path(), path);
    }
  }
}

TEST(Grasp, AcceptsTheLimitsOfWhatHasMeaning) {
  Held held = two_fingers();
  held.contacts[0].friction = 0;
  held.contacts[0].max_normal = 0;
  held.contacts[1].min_normal = held.contacts[1].max_normal = 3;
  held.contacts[1].normal = {1e-200, 0};
  EXPECT_NO_THROW(held.grasp());
  EXPECT_EQ(held.grasp().contacts()[1].normal, Vector<2>(1, 0));
}

TEST(Grasp, NormalisesNormalsAndDividesFrictionBySafety) {
  const Held held = two_fingers();
  const Grasp<2> grasp(held.object, held.contacts, 2);
  EXPECT_EQ(grasp.contacts()[0].normal, Vector<2>(-1, 0));
  EXPECT_EQ(grasp.contacts()[1].normal, Vector<2>(1, 0));
  EXPECT_EQ(grasp.contacts()[0].friction, 0.25);
}

TEST(Grasp, NamesFingersInTheOrderOfTheirFirstContact) {
  Held held = two_fingers();
  held.contacts.resize(5, held.contacts[1]);
  held.contacts[1].finger = "thumb";
  held.contacts[2].finger = "index";
  held.contacts[4].finger = "thumb";
  const Grasp<2> grasp = held.grasp();
  EXPECT_EQ(grasp.fingers(), (std::vector<std::string>{"0", "thumb", "index", "3"}));
  EXPECT_EQ(grasp.finger_of(4), 1U);
  EXPECT_EQ(grasp.finger_of(3), 3U);
  EXPECT_EQ(grasp.contacts()[0].finger, "0");
}

TEST(Grasp, KeepsAFingerCalledLikeAnIndexApart) {
  Held held = two_fingers();
  held.contacts[0].finger = "1";
  EXPECT_EQ(held.grasp().fingers().size(), 2U);
}

TEST(Grasp, RadiusIsTheDistanceOfTheFarthestContactFromTheCom) {
  Held held = two_fingers();
  held.object.com = {0.5, 0};
  EXPECT_EQ(held.grasp().radius(), 1.5);
}

RC_GTEST_PROP(Grasp, MatrixTurnsContactForcesIntoTheWrench, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const auto G = grasp_matrix(grasp);
  const std::size_t n = grasp.contacts().size();
  RC_ASSERT(G.cols() == static_cast<Eigen::Index>(2 * n));
  Eigen::VectorXd forces(G.cols());
  RealWrench wrench = RealWrench::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const RealVector force(coordinate(), coordinate());
    forces.segment<2>(static_cast<Eigen::Index>(2 * i)) = force.cast<double>();
    const Contact<2>& contact = grasp.contacts()[i];
    const RealVector f = in_object_frame(contact, force);
    wrench += RealWrench(f.x(), f.y(), cross(contact.position.cast<Real>(), f));
  }
  RC_ASSERT(((G * forces).cast<Real>() - wrench).norm() <= 1e-14L);
}

RC_GTEST_PROP(Grasp, LoadIsTheWeightThroughTheCom, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  const double theta = random_angle();
  const Wrench<2> load = grasp.loads().front().at(up_at(theta));
  RC_ASSERT((load.cast<Real>() - load_at(grasp, theta)).norm() <= 1e-15L * grasp.size());
}

/// Wrenches along the edges of the cones, about the com and in radii.
std::vector<Eigen::Vector3d> primitive_wrenches(const Grasp<2>& grasp) {
  std::vector<Eigen::Vector3d> wrenches;
  for (const Contact<2>& contact : grasp.contacts()) {
    const Vector<2> r = (contact.position - grasp.center()) / grasp.radius();
    const Vector<2> n = contact.normal, t(-n.y(), n.x());
    for (const double slope : {contact.friction, -contact.friction}) {
      const Vector<2> f = (n + slope * t).normalized();
      wrenches.emplace_back(f.x(), f.y(), r.x() * f.y() - r.y() * f.x());
    }
  }
  return wrenches;
}

/// Wrenches span everything, pushing only, unless a plane through two of them has all the others on
/// one side. None where rounding decides.
std::optional<bool> positively_span(const std::vector<Eigen::Vector3d>& wrenches) {
  bool span = false;
  for (const Eigen::Vector3d& a : wrenches)
    for (const Eigen::Vector3d& b : wrenches) {
      const Eigen::Vector3d normal = a.cross(b);
      if (normal.norm() > 1e-12 && normal.norm() < 1e-6) return {};
      if (normal.norm() <= 1e-12) continue;
      double lowest = 0, highest = 0;
      for (const Eigen::Vector3d& w : wrenches) {
        lowest = std::min(lowest, normal.normalized().dot(w));
        highest = std::max(highest, normal.normalized().dot(w));
      }
      if (lowest < -1e-12 && lowest > -1e-6) return {};
      if (lowest >= -1e-12) return false;
      span = true;
    }
  return span;
}

RC_GTEST_PROP(ForceClosure, IsThatNoPlaneHasAllPrimitiveWrenchesOnOneSide, ()) {
  const Grasp<2> grasp = (*grasps()).grasp();
  if (grasp.radius() == 0) {
    RC_ASSERT(!force_closure(grasp));
    return;
  }
  const std::optional<bool> expected = positively_span(primitive_wrenches(grasp));
  if (expected) RC_ASSERT(force_closure(grasp) == *expected);
}

TEST(ForceClosure, NeedsEachContactToSeeTheOther) {
  // Nguyen: two contacts with friction close where their line lies strictly inside both cones.
  Held held = two_fingers();
  EXPECT_TRUE(force_closure(held.grasp()));
  held.contacts[0].normal = {-1, 0.49};
  EXPECT_TRUE(force_closure(held.grasp()));
  held.contacts[0].normal = {-1, 0.51};
  EXPECT_FALSE(force_closure(held.grasp()));
  held.contacts[0].normal = {1, 0};
  EXPECT_FALSE(force_closure(held.grasp()));
}

TEST(ForceClosure, IsBeyondFrictionlessFingersOnADisk) {
  Held held{{1, {0, 0}}, {}};
  for (const double at : {0.0, 2.0, 4.0}) {
    Contact<2> contact;
    contact.position = direction(at);
    contact.normal = -direction(at);
    held.contacts.push_back(contact);
  }
  EXPECT_FALSE(force_closure(held.grasp()));
  held.contacts[0].friction = 0.1;
  EXPECT_TRUE(force_closure(held.grasp()));
}

TEST(ForceClosure, OfFrictionlessFingersNeedsFour) {
  // Round a square, each pair a couple: turning both ways.
  Held held{{1, {0, 0}}, {}};
  for (int side = 0; side < 4; ++side) {
    Contact<2> contact;
    const Vector<2> outwards = direction(pi / 2 * side), along(-outwards.y(), outwards.x());
    contact.position = outwards + (side % 2 == 0 ? 0.5 : -0.5) * along;
    contact.normal = -outwards;
    held.contacts.push_back(contact);
  }
  EXPECT_TRUE(force_closure(held.grasp()));
  held.contacts.pop_back();
  EXPECT_FALSE(force_closure(held.grasp()));
}

TEST(ForceClosure, IgnoresForceLimits) {
  Held held = two_fingers();
  for (Contact<2>& contact : held.contacts) contact.max_normal = 0;
  EXPECT_TRUE(force_closure(held.grasp()));
  for (Contact<2>& contact : held.contacts) contact.min_normal = contact.max_normal = 7;
  EXPECT_TRUE(force_closure(held.grasp()));
}

}  // namespace
}  // namespace poise::test
