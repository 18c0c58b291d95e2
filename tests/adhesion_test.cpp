// Vacuum and magnets: a vendor's numbers, closed forms, and grippers read from files.
#include <gtest/gtest.h>

#include "files/grasp_file.hpp"
#include "poise/adhesion.hpp"
#include "poise/best_posture.hpp"
#include "poise/capacity.hpp"
#include "poise/grip.hpp"

namespace poise::test {
namespace {

SpatialFile read(const std::string& text) {
  return std::get<SpatialFile>(grasp_from_yaml("poise: 1\ndimension: 3\n" + text, "f.yaml"));
}

/// A sheet of 1.6 m by 0.6 m under six cups, each of which pulls with 500 N.
std::string sheet(const std::string& more = "", double weight = 601.44) {
  std::string text = "object: {weight: " + std::to_string(weight) + ", com: [0, 0, 0]}\ncontacts:\n";
  for (const double x : {-0.8, 0.0, 0.8})
    for (const double y : {-0.3, 0.3})
      text += "  - {position: [" + std::to_string(x) + ", " + std::to_string(y) +
              ", 0], normal: [0, 0, -1], friction: 0.5, adhesion: 500, "
              "pad: {size: [0.12, 0.12], axis: [1, 0, 0], grid: 3}}\n";
  return text + more;
}

// As vendors reckon: six cups of 500 N and friction 0.5 hold 3000 N hanging, and 1500 N
// upright.
TEST(Adhesion, HoldsWhatTheCatalogueSays) {
  const SpatialFile file = read(sheet());
  const Grasp<3> grasp = file.grasp();
  ASSERT_EQ(grasp.drives().size(), 6U);
  EXPECT_EQ(grasp.drives()[2].name, "2 vacuum");
  const Load<3>& load = grasp.loads().front();
  for (const auto& [up, most] : {std::pair(Vector<3>(0, 0, 1), 3000.0), {{0, 1, 0}, 1500.0}}) {
    const WeightRange<3> weights = weight_range<3>(grasp, load, up);
    EXPECT_NEAR(weights.greatest.weight, most, 1e-3);
    EXPECT_NEAR(weights.greatest.bound, most, 1e-3);
    // The least grip is the vacuum that is needed of each cup.
    EXPECT_NEAR(least_grip<3>(grasp, load, up).grip, 500 * 601.44 / most, 1e-4);
  }
  // Lying on the cups it needs no vacuum.
  EXPECT_NEAR(least_grip<3>(grasp, load, {0, 0, -1}).grip, 0, 1e-6);
  EXPECT_FALSE(hold<3>(grasp, Load<3>{.weight = 3001}, {0, 0, 1}).holdable);
  EXPECT_TRUE(hold<3>(grasp, Load<3>{.weight = 2999}, {0, 0, 1}).holdable);
}

/// The tilting moment of one cup is carried by its rim: as far as the pad reaches.
TEST(Adhesion, ARimCarriesTheTiltingMoment) {
  const auto held = [](double arm) {
    const SpatialFile file = read(
        "object: {weight: 10, com: [" + std::to_string(arm) + ", 0, -0.01]}\ncontacts:\n"
        "  - {position: [0, 0, 0], normal: [0, 0, -1], friction: 0.5, adhesion: 40, "
        "pad: {size: [0.1, 0.1], axis: [1, 0, 0]}}\n");
    const Grasp<3> grasp = file.grasp();
    return hold<3>(grasp, grasp.loads().front(), Vector<3>(0, 0, 1)).holdable;
  };
  // The pad presses with 30 N at 0.05 m at most, against 10 N at the arm: 1.5 N m.
  EXPECT_TRUE(held(0.149));
  EXPECT_FALSE(held(0.151));
}

/// Of a jaw with magnets the pull is constant, and the jaw presses with less.
TEST(Adhesion, OfAJawIsConstant) {
  const std::string text =
      "object: {weight: 10, com: [0, 0, 0]}\ndrives: coupled\ncontacts:\n"
      "  - {position: [0.03, 0, 0], normal: [-1, 0, 0], friction: 0.5, torsion: 0.01, "
      "finger: left, adhesion: 4, max_normal: 20}\n"
      "  - {position: [-0.03, 0, 0], normal: [1, 0, 0], friction: 0.5, torsion: 0.01, "
      "finger: right, adhesion: 4}\n";
  const SpatialFile file = read(text);
  EXPECT_EQ(file.contacts.size(), 4U);
  EXPECT_EQ(file.contacts[0].max_normal, 24);
  const Grasp<3> grasp = file.grasp();
  EXPECT_TRUE(grasp.closing(0).isApprox(Vector<3>(-1, 0, 0)));
  const Load<3>& load = grasp.loads().front();
  // Each surface must press with 10 N, of which the magnet gives 4.
  const Hold<3> hold = least_grip<3>(grasp, load, {0, 0, 1});
  EXPECT_NEAR(hold.grip, 6, 1e-6);
  EXPECT_NEAR(hold.forces[0].normal, 10, 1e-5);
  EXPECT_NEAR(finger_forces<3>(grasp, hold)[0].pressing, 6, 1e-5);
}

TEST(Adhesion, WorksInThePlane) {
  const auto file = std::get<PlanarFile>(grasp_from_yaml(
      "poise: 1\ndimension: 2\nobject: {weight: 10, com: [0, 0]}\ncontacts:\n"
      "  - {position: [-0.03, 0.01], normal: [0, -1], friction: 0.5, adhesion: 12, finger: a}\n"
      "  - {position: [0.03, 0.01], normal: [0, -1], friction: 0.5, adhesion: 12, finger: b}\n",
      "f.yaml"));
  const Grasp<2> grasp = file.grasp();
  EXPECT_NEAR(least_grip<2>(grasp, grasp.loads().front(), {0, 1}).grip, 5, 1e-7);
  // On its side friction bears all; one cup is pulled off by what the other is pressed more.
  const Hold<2> aside = least_grip<2>(grasp, grasp.loads().front(), {1, 0});
  EXPECT_NEAR(aside.grip, 10, 1e-6);
}

TEST(Adhesion, CupsOfAGripperTouchTheShape) {
  const SpatialFile file = read(
      "length_unit: mm\nobject: {mass: 2, com: [0, 0, 0], shape: {box: {size: [200, 100, 20]}}}\n"
      "gripper: {type: suction, position: [0, 0, 60], cups: [[-60, 0, 0], [60, 0, 0]], "
      "diameter: 40, adhesion: 30, friction: 0.6}\n");
  ASSERT_EQ(file.contacts.size(), 4U);
  EXPECT_TRUE(file.contacts[1].position.isApprox(Vector<3>(0.06, 0, 0.01), 1e-12));
  EXPECT_TRUE(file.contacts[1].normal.isApprox(Vector<3>(0, 0, -1), 1e-12));
  ASSERT_TRUE(file.contacts[1].pad);
  for (const Vector<3>& point : file.contacts[1].pad->points) EXPECT_NEAR(point.norm(), 0.02, 1e-12);
  EXPECT_EQ(file.mechanism.drives[1].max, 30);
  const Grasp<3> grasp = file.grasp();
  EXPECT_NEAR(least_grip<3>(grasp, grasp.loads().front(), {0, 0, 1}).grip, standard_gravity, 1e-5);
  // The posture of least vacuum has the cups below.
  const Best<3> best = best_posture(
      grasp, {.objective = Objective::grip, .max_holds = 300, .starts = 0});
  EXPECT_NEAR(best.best().value(), 0, 1e-6);
}

TEST(Adhesion, MustBeAboveZero) {
  std::vector<Contact<3>> contacts(1);
  Mechanism<3> mechanism;
  EXPECT_THROW(add_pulls<3>({{contacts[0], 0}}, contacts, mechanism), InvalidGrasp);
}

}  // namespace
}  // namespace poise::test
