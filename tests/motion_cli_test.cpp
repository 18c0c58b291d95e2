// poise motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "command_line.hpp"

namespace poise {
namespace {

constexpr double g = 9.80665;

std::string jaws(const std::string& object, double max_force = 30) {
  return "poise: 1\n"
         "dimension: 3\n"
         "name: box in a jaw\n"
         "object: {" +
         object +
         "}\n"
         "drives: coupled\n"
         "fingers: {l: {max_force: " +
         std::to_string(max_force) +
         "}}\n"
         "contacts:\n"
         "  - {position: [-0.04, 0, 0], normal: [1, 0, 0], friction: 0.5, torsion: 0.01, finger: "
         "l}\n"
         "  - {position: [0.04, 0, 0], normal: [-1, 0, 0], friction: 0.5, torsion: 0.01, finger: "
         "r}\n";
}

/// A lift by z = t^3 / 3, so that the acceleration is 2 t.
std::string lift() {
  std::string text = "t,x,y,z,qw,qx,qy,qz\n";
  for (int k = 0; k <= 100; ++k) {
    const double t = 0.01 * k;
    char row[128];
    std::snprintf(row, sizeof row, "%.17g,0,0,%.17g,1,0,0,0\n", t, t * t * t / 3);
    text += row;
  }
  return text;
}

/// Turning about z at a constant rate.
std::string spin() {
  std::string text = "t,x,y,z,qw,qx,qy,qz\n";
  for (int k = 0; k <= 100; ++k) {
    const double t = 0.01 * k;
    char row[160];
    std::snprintf(row, sizeof row, "%.17g,0,0,0,%.17g,0,0,%.17g\n", t, std::cos(t), std::sin(t));
    text += row;
  }
  return text;
}

class Motions : public CommandLine {};

TEST_F(Motions, ALiftTakesTheClosedForm) {
  write("jaws.yaml", jaws("mass: 0.5, com: [0, 0, 0]"));
  write("lift.csv", lift());
  const Json document = json("motion jaws.yaml lift.csv -o out.csv --plot out.svg");
  EXPECT_NEAR(document["peak"]["grip"], 0.5 * (g + 2), 1e-6);
  EXPECT_EQ(document["peak"]["row"], 101);
  EXPECT_EQ(document["peak"]["cause"], "weight");
  EXPECT_NEAR(document["peak"]["without"]["linear"], 0.5 * g, 1e-6);
  EXPECT_TRUE(document["holdable"]);
  EXPECT_TRUE(document["slip"].is_null());
  const double factor = std::sqrt((30 / 0.5 - g) / 2);  // g + 2 s = F / m
  EXPECT_NEAR(document["speed"]["factor"], factor, 1e-5);
  EXPECT_NEAR(document["speed"]["bound"], factor, 1e-5);
  const std::string csv = contents(folder() / "out.csv");
  EXPECT_EQ(csv.substr(0, 24), "t,grip,lower_bound,held\n");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 102);
  const std::string svg = contents(folder() / "out.svg");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_GT(std::count(svg.begin(), svg.end(), 'L'), 100);  // a point for each pose
}

TEST_F(Motions, SlipWhereTheJawGivesNoMore) {
  write("jaws.yaml", jaws("mass: 0.5, com: [0, 0, 0]", 0.5 * (g + 1.001)));
  write("lift.csv", lift());
  const Json document = json("motion jaws.yaml lift.csv", 1);
  EXPECT_FALSE(document["holdable"]);
  EXPECT_EQ(document["slip"]["row"], 52);
  EXPECT_NEAR(document["speed"]["factor"], std::sqrt(1.001 / 2), 1e-5);
  const Outcome run = poise("motion jaws.yaml lift.csv");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.out.find("It slips, first at 0.51"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("It may only run 0.7075"), std::string::npos) << run.out;
}

TEST_F(Motions, NeedAnInertiaOnlyWhereTheyTurn) {
  write("jaws.yaml", jaws("mass: 0.5, com: [0, 0, 0]"));
  write("lift.csv", lift());
  write("spin.csv", spin());
  EXPECT_EQ(poise("motion jaws.yaml lift.csv").status, 0);
  const Outcome run = poise("motion jaws.yaml spin.csv");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "poise: jaws.yaml: object.inertia: is missing, but the motion turns the object: must "
            "be [ixx, iyy, izz, ixy, ixz, iyz], kg m2 about the com, as there is no shape to take "
            "it from\n");
  for (const char* object : {"mass: 0.5, com: [0, 0, 0], inertia: [0.001, 0.001, 0.001, 0, 0, 0]",
                             "mass: 0.5, shape: {box: {size: [0.08, 0.05, 0.05]}}",
                             "density: 700, shape: {cylinder: {radius: 0.04, height: 0.05}}"}) {
    write("jaws.yaml", jaws(object));
    EXPECT_EQ(poise("motion jaws.yaml spin.csv").status, 0) << object;
  }
  write("jaws.yaml", jaws("mass: 0.5, com: [0, 0, 0], inertia: [0.001, 0.001, 0.0021, 0, 0, 0]"));
  const Outcome refused = poise("motion jaws.yaml lift.csv");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("object.inertia: has a principal moment above the sum"),
            std::string::npos)
      << refused.err;
}

TEST_F(Motions, AreOfSpaceAndOfAFileThatCanBeRead) {
  write("lift.csv", lift());
  write("flat.json",
        R"({"poise": 1, "dimension": 2, "object": {"weight": 1, "com": [0, 0]},
            "contacts": [{"position": [1, 0], "normal": [-1, 0], "friction": 1},
                         {"position": [-1, 0], "normal": [1, 0], "friction": 1}]})");
  const Outcome flat = poise("motion flat.json lift.csv");
  EXPECT_EQ(flat.status, 2);
  EXPECT_NE(flat.err.find("is in the plane (dimension 2)"), std::string::npos) << flat.err;
  write("jaws.yaml", jaws("mass: 0.5, com: [0, 0, 0]"));
  EXPECT_EQ(poise("motion jaws.yaml none.csv").status, 2);
  EXPECT_EQ(poise("motion jaws.yaml lift.csv -o lift.csv").status, 2);
}

TEST_F(Motions, FindTheWristOffsetThatNeedsLeast) {
  // Upright two fingers hold the weight by friction; turned, one of them carries it.
  write("jaws.yaml", jaws("mass: 0.5, com: [0, 0, 0]"));
  write("lift.csv", lift());
  const Json document = json("motion jaws.yaml lift.csv --offset");
  const Json& offset = document["offset"];
  EXPECT_LE(offset["grip"].get<double>(), document["peak"]["grip"].get<double>());
  EXPECT_LE(offset["lower_bound"].get<double>(), offset["grip"].get<double>() * (1 + 1e-9));
}

}  // namespace
}  // namespace poise
