// Pads, fingers and drives in grasp files.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "files/grasp_file.hpp"
#include "files/grasp_writer.hpp"
#include "poise/grip.hpp"

namespace poise {
namespace {

const std::string plane = R"(poise: 1
dimension: 2
length_unit: mm
object: {weight: 10, com: [0, 0]}
contacts:
  - {position: [-30, 0], normal: [1, 0], friction: 0.6, finger: left}
  - {position: [30, 0], normal: [-1, 0], friction: 0.6, finger: right}
)";

const std::string space = R"(poise: 1
dimension: 3
length_unit: mm
up: [0, 0, 1]
object: {weight: 19.62, com: [0, 20, 0]}
contacts:
  - {position: [-25, 0, 0], normal: [1, 0, 0], friction: 0.8, finger: left,
     pad: {size: [26.14, 20], axis: [0.3, 1, 0], grid: 4}}
  - {position: [25, 0, 0], normal: [-1, 0, 0], friction: 0.8, finger: right,
     pad: {points: [[5, 0, 10], [0, 10, -10], [0, -10, -10]], shares: [0.5, 0.25, 0.25]}}
)";

GraspFile read(const std::string& text) { return grasp_from_yaml(text, "f.yaml"); }

/// What follows "f.yaml:".
std::string message(const std::string& text) {
  try {
    read(text);
  } catch (const FileError& error) {
    const std::string what = error.what();
    return what.substr(what.find(':') + 1);
  }
  return "accepted";
}

template <int Dim>
FileOf<Dim> file_of(const std::string& text) {
  return std::get<FileOf<Dim>>(read(text));
}

TEST(MechanismFile, APadIsARectangleOrPoints) {
  const auto file = file_of<3>(space);
  const Pad& rectangle = *file.contacts[0].pad;
  ASSERT_EQ(rectangle.points.size(), 16U);
  // The axis is turned into the pad's plane; cells of 26.14 / 4 by 20 / 4 mm.
  EXPECT_NEAR((rectangle.axis - Vector<3>(0, 1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((rectangle.points[1] - rectangle.points[0]).norm(), 0.02614 / 4, 1e-15);
  EXPECT_NEAR((rectangle.points[4] - rectangle.points[0]).norm(), 0.02 / 4, 1e-15);
  EXPECT_NEAR((rectangle.reach - Vector<2>(0.01307, 0.01)).norm(), 0, 1e-15);

  const Grasp<3> grasp = file.grasp();
  const Pad& points = *grasp.contacts()[1].pad;
  EXPECT_NEAR(points.points[0].x(), 0, 1e-15);  // in the plane across the normal
  EXPECT_NEAR(points.points[0].z(), 0.01, 1e-15);
  // As far as the points extend from their mean, (0, 0, 0).
  const Vector<3> across = grasp.contacts()[1].normal.cross(points.axis);
  for (const auto& [axis, reach] :
       {std::pair(points.axis, points.reach.x()), {across, points.reach.y()}}) {
    double most = 0;
    for (const Vector<3>& point : points.points) most = std::max(most, std::abs(axis.dot(point)));
    EXPECT_NEAR(reach, most, 1e-15);
  }
}

TEST(MechanismFile, InThePlaneAPadIsItsTwoEnds) {
  const auto file = file_of<2>(plane +
                               "  - {position: [0, 30], normal: [0, -2], friction: 0.5, "
                               "pad: {size: 20}}\n");
  ASSERT_EQ(file.contacts.size(), 4U);
  EXPECT_NEAR((file.contacts[2].position - file.contacts[3].position).norm(), 0.02, 1e-15);
  EXPECT_NEAR((file.contacts[2].position + file.contacts[3].position - Vector<2>(0, 0.06)).norm(),
              0, 1e-15);
  EXPECT_EQ(file.contacts[2].share, 0.5);
  EXPECT_EQ(file.grasp().fingers().size(), 3U);
}

TEST(MechanismFile, InThePlaneAFingerWithoutALabelIsNamedAfterItsContactInTheFile) {
  const auto file = file_of<2>(R"(poise: 1
dimension: 2
object: {weight: 10, com: [0, 0]}
contacts:
  - {position: [-3, 0], normal: [1, 0], friction: 0.6, pad: {size: 1}}
  - {position: [0, 4], normal: [0, -1], friction: 0.6}
  - {position: [3, 0], normal: [-1, 0], friction: 0.6, pad: {size: 1}}
drives: [{moves: ['0'], along: [1, 0]}, {moves: ['1'], along: [0, -1]}]
fingers: {2: {closing: [-1, 0]}}
)");
  const Grasp<2> grasp = file.grasp();
  EXPECT_EQ(grasp.fingers(), (std::vector<std::string>{"0", "1", "2"}));
  EXPECT_EQ(grasp.finger_of(2), 1U);
  EXPECT_EQ(grasp.finger_of(4), 2U);
}

// A force along n + mu t has the part n.c + mu t.c along c: below 0 for both t the finger cannot
// press along c, whatever holds the object.
TEST(MechanismFile, AFingerMustCloseOnTheObject) {
  const auto with = [](const std::string& closing) {
    return plane + "fingers: {left: {closing: " + closing + "}}\n";
  };
  const std::string refused =
      "8:27: fingers.left.closing: points away from the object, where no contact of the finger can "
      "push: must be the direction in which it pushes";
  EXPECT_EQ(message(with("[-1, 0]")), refused);
  // The edge of the cone is at atan 0.6 = 31 degrees from the normal: 121 degrees are too many.
  EXPECT_EQ(message(with("[-0.601, 1]")), refused);
  const std::string doubted =
      "f.yaml:8:27: fingers.left.closing: goes against the inward normals of its contacts: does it "
      "point away from the object?";
  EXPECT_EQ(file_of<2>(with("[-0.599, 1]")).warnings, std::vector<std::string>{doubted});
  EXPECT_TRUE(file_of<2>(with("[0, 1]")).warnings.empty());  // a fork that is driven aside
  // Of two contacts it is enough that one can.
  EXPECT_TRUE(file_of<2>(plane + "  - {position: [0, 30], normal: [-1, -1], friction: 0, finger: "
                                 "left}\nfingers: {left: {closing: [-1, 0]}}\n")
                  .warnings.empty());
}

TEST(MechanismFile, ADriveThatOnlyOpensIsDoubted) {
  const std::string doubt =
      ": moves its fingers away from the object: the grip does not count what it holds. Is it the "
      "way in which it closes?";
  const auto warnings = [](const std::string& text) {
    return std::visit([](const auto& file) { return file.warnings; }, read(text));
  };
  EXPECT_EQ(warnings(plane + "drives: [{moves: [left], along: [-1, 0]}]\n"),
            std::vector<std::string>{"f.yaml:8:33: drives[0].along" + doubt});
  // A slide that moves both jaws closes one of them.
  EXPECT_TRUE(warnings(plane + "drives: [{moves: [left, right], along: [-1, 0]}]\n").empty());
  // Of the axes through (-25, -60, 0) mm along +y and -y one turns the pad on the left inwards.
  const auto turned = [&](const std::string& axis) {
    return warnings(space + "drives: [{moves: [left], about: {axis: [0, " + axis +
                    ", 0], through: [-25, 0, -60]}}]\n");
  };
  EXPECT_TRUE(turned("1").empty());
  EXPECT_EQ(turned("-1"), std::vector<std::string>{"f.yaml:11:33: drives[0].about" + doubt});
}

TEST(MechanismFile, DrivesAreEachUnlessTheFileSaysOtherwise) {
  EXPECT_EQ(file_of<2>(plane).mechanism, Mechanism<2>{});
  EXPECT_EQ(file_of<2>(plane + "drives: coupled\n").mechanism.kind, DriveKind::coupled);
  EXPECT_EQ(file_of<3>(space).grasp().drives().size(), 2U);
  EXPECT_EQ(file_of<3>(space + "drives: coupled\n").grasp().drives().size(), 1U);
  EXPECT_EQ(file_of<3>(space).objective, Objective::grip);
  EXPECT_EQ(file_of<3>(space + "objective: effort\n").objective, Objective::effort);
}

TEST(MechanismFile, FingersHaveClosingDirectionsAndForces) {
  const auto file = file_of<3>(
      space + "fingers: {left: {closing: [2, 0, 1], max_force: 70}, right: {max_force: 60}}\n");
  const Grasp<3> grasp = file.grasp();
  EXPECT_NEAR((grasp.closing(0) - Vector<3>(2, 0, 1) / std::sqrt(5.0)).norm(), 0, 1e-15);
  EXPECT_NEAR((grasp.closing(1) - Vector<3>(-1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(grasp.drives()[0].max, 70);
  EXPECT_EQ(grasp.drives()[1].max, 60);
  EXPECT_EQ(grip_unit(grasp), GripUnit::part_of_max);
  // Of coupled fingers the least limits their drive.
  const auto coupled = file_of<3>(
      space + "drives: coupled\nfingers: {left: {max_force: 70}, right: {max_force: 60}}\n");
  EXPECT_EQ(most_grip(coupled.grasp()), 60);
}

TEST(MechanismFile, AJointMovesItsFingersAboutAnAxis) {
  const auto file = file_of<2>(
      plane +
      "drives:\n"
      "  - {name: pin, moves: [left], about: {axis: [0, 0, -1], through: [-20, -60, 0]}, max: 2}\n"
      "  - {moves: [right], along: [-3, 0]}\n");
  const Drive<2>& pin = file.mechanism.drives[0];
  EXPECT_TRUE(pin.turns);
  EXPECT_EQ(pin.max, 2);
  // The pin stands still, and the contact at (-30, 0) mm moves towards +x and +y.
  const auto velocity = [&](const Vector<2>& at) {
    const Twist<2>& y = pin.moves[0].twist;
    return Vector<2>(y[0] - y[2] * at.y(), y[1] + y[2] * at.x());
  };
  EXPECT_NEAR(velocity({-0.02, -0.06}).norm(), 0, 1e-15);
  EXPECT_NEAR((velocity({-0.03, 0}) - Vector<2>(0.06, 0.01)).norm(), 0, 1e-15);
  EXPECT_NEAR((file.mechanism.drives[1].moves[0].twist - Twist<2>(-1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(file.mechanism.drives[1].name, "right");
}

TEST(MechanismFile, IsWrittenAsItWasRead) {
  const std::string lists =
      "drives:\n"
      "  - {name: knuckle, moves: [left], about: {axis: [0, 1, 1], through: [10, 0, 30]}, max: "
      "2.1}\n"
      "  - {moves: [right], along: [-3, 0, 4], max: 70}\n"
      "fingers: {left: {closing: [1, 0, 0.1]}}\nobjective: grip\n";
  for (const std::string& more : {std::string("drives: coupled\n"), lists}) {
    const auto file = file_of<3>(space + more);
    const auto again = std::get<SpatialFile>(grasp_from_json(grasp_document(file), "f.json"));
    EXPECT_EQ(again.contacts.size(), file.contacts.size());
    for (std::size_t i = 0; i < file.contacts.size(); ++i) {
      const Pad &a = *again.contacts[i].pad, &b = *file.contacts[i].pad;
      ASSERT_EQ(a.points.size(), b.points.size());
      for (std::size_t k = 0; k < a.points.size(); ++k)
        EXPECT_NEAR((a.points[k] - b.points[k]).norm(), 0, 1e-15);
      EXPECT_NEAR((a.reach - b.reach).norm(), 0, 1e-15);
    }
    EXPECT_EQ(again.objective, file.objective);
    EXPECT_EQ(again.mechanism.kind, file.mechanism.kind);
    ASSERT_EQ(again.mechanism.drives.size(), file.mechanism.drives.size());
    for (std::size_t a = 0; a < file.mechanism.drives.size(); ++a) {
      const Drive<3>&one = again.mechanism.drives[a], &other = file.mechanism.drives[a];
      EXPECT_EQ(one.name, other.name);
      EXPECT_EQ(one.max, other.max);
      EXPECT_NEAR((one.moves[0].twist - other.moves[0].twist).norm(), 0, 1e-15);
    }
  }
}

TEST(MechanismFile, WhatIsWrongIsSaid) {
  EXPECT_EQ(message(plane + "drives: all\n"), "8:9: drives: is \"all\", must be each or coupled");
  EXPECT_EQ(message(plane + "drives: []\n"),
            "8:9: drives: is empty, must be each, coupled or a list of drives");
  for (const std::string& value : {"3", "true", "{moves: [left], along: [1, 0]}"})
    EXPECT_NE(message(plane + "drives: " + value + "\n")
                  .find(", must be each, coupled or a list of drives"),
              std::string::npos);
  EXPECT_EQ(message(plane + "drives: [3]\n"),
            "8:10: drives[0]: is 3, must be a mapping (keys: name, moves, along, about, max)");
  EXPECT_EQ(message(plane + "drives: [{moves: left, along: [1, 0]}]\n"),
            "8:18: drives[0].moves: is \"left\", must be a list of fingers");
  EXPECT_EQ(message(plane + "drives: [{moves: [], along: [1, 0]}]\n"),
            "8:18: drives[0].moves: is empty, must name a finger");
  EXPECT_EQ(message(plane + "drives: [{moves: [left], along: [1, 0], max: .nan}]\n"),
            "8:46: drives[0].max: is nan, must be a finite number");
  EXPECT_EQ(message(plane + "drives:\n"
                            "  - {name: jaw, moves: [left], along: [1, 0]}\n"
                            "  - {name: jaw, moves: [right], along: [-1, 0]}\n"),
            "10:12: drives[1].name: is \"jaw\" once more, must be the name of no other drive");
  // A drive without a name has that of its first finger.
  EXPECT_EQ(message(plane + "drives:\n"
                            "  - {name: right, moves: [left], along: [1, 0]}\n"
                            "  - {moves: [right], along: [-1, 0]}\n"),
            "10:5: drives[1].name: is \"right\" once more, must be the name of no other drive");
  EXPECT_EQ(message(plane + "drives: [{moves: [thumb], along: [1, 0]}]\n"),
            "8:19: drives[0].moves[0]: is \"thumb\", must be the finger of a contact");
  EXPECT_EQ(message(plane + "drives: [{moves: [left]}]\n"),
            "8:10: drives[0].along: is missing, must be [x, y], or about");
  EXPECT_EQ(
      message(plane + "drives: [{moves: [left], about: {axis: [0, 1, 0], through: [0, 0]}}]\n"),
      "8:40: drives[0].about.axis: must be [0, 0, 1] or [0, 0, -1] in the plane");
  EXPECT_EQ(message(plane + "drives: [{moves: [left, left], along: [1, 0]}]\n"),
            "8:25: drives[0].moves[1]: is \"left\" once more, must be named once");
  EXPECT_EQ(message(plane + "objective: grip\nfingers: {left: {max_force: 5}}\n"),
            "9:10: fingers.right.max_force: must be given, as another finger has one: the grip is "
            "counted in parts of them");
  EXPECT_EQ(message(plane + "fingers: {left: {max_force: 0}}\n"),
            "8:29: fingers.left.max_force: is 0, must be above 0");
  EXPECT_EQ(message(plane + "fingers: {thumb: {max_force: 1}}\n").substr(0, 19),
            "8:11: fingers.thumb");
  EXPECT_EQ(message(plane + "fingers: {left: {max_force: 1}, left: {max_force: 2}}\n"),
            "8:33: fingers.left: is given twice, first in line 8");
  EXPECT_EQ(message(plane + "fingers: {left: {closing: [.nan, 0]}}\n"),
            "8:28: fingers.left.closing[0]: is nan, must be a finite number");
  EXPECT_EQ(message(plane + "fingers: [left]\n"),
            "8:10: fingers: is a list of 1, must be a mapping (keys: left, right)");
  EXPECT_EQ(message(plane + "  - {position: [30, 5], normal: [-1, 0], friction: 1, finger: right}\n"
                            "fingers: 3\n"),
            "9:10: fingers: is 3, must be a mapping (keys: left, right)");
  // Contacts without a label are fingers that are called by their numbers.
  const std::string two_called_2 =
      plane +
      "  - {position: [30, 5], normal: [-1, 0], friction: 1}\n"
      "  - {position: [30, 9], normal: [-1, 0], friction: 1, finger: '2'}\n";
  EXPECT_EQ(message(two_called_2), "accepted");
  EXPECT_EQ(
      message(two_called_2 + "drives: [{moves: ['2'], along: [-1, 0]}]\n"),
      "10:19: drives[0].moves[0]: is \"2\", which two fingers are called: the contact of that "
      "number must be given a label");
  EXPECT_EQ(message(plane + "objective: force\n"),
            "8:12: objective: is \"force\", must be grip or effort");
  const auto with_pad = [](const std::string& pad) {
    return "poise: 1\ndimension: 3\nobject: {weight: 1, com: [0, 0, 0]}\ncontacts:\n"
           "  - {position: [0, 0, 1], normal: [0, 0, -1], friction: 1, " +
           pad + "}\n";
  };
  EXPECT_EQ(message(with_pad("pad: {size: [1, 1], axis: [0, 0, 1]}")),
            "5:86: contacts[0].pad.axis: is along the normal, must be in the pad's plane");
  EXPECT_EQ(message(with_pad("pad: {size: [1, 1], axis: [1, 0, 0], grid: 65}")),
            "5:103: contacts[0].pad.grid: is 65, must be a whole number from 1 to 64");
  EXPECT_EQ(message(with_pad("pad: {points: [[0, 0, 0], [1, 0, 0]], shares: [0.5, 0.6]}")),
            "5:106: contacts[0].pad.shares: add up to 1.1, must add up to 1");
  EXPECT_EQ(
      message(with_pad("torsion: 1, pad: {size: [1, 1], axis: [1, 0, 0]}")),
      "5:69: contacts[0].torsion: is given for a pad, must be left out: its points resist the "
      "twist");
}

}  // namespace
}  // namespace poise
