// Grasp files of space: what they say, in either text and in every unit.
#include <gtest/gtest.h>

#include <cmath>

#include "files/grasp_file.hpp"

namespace poise {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

const std::string yaml = R"(poise: 1
dimension: 3
name: bottle
safety: 2
length_unit: mm
up: [0, 3, 4]
tilt: {from: [0, 0, 2], max_deg: 30}
domain: all
object:
  shape: {cylinder: {radius: 30, height: 200}}
  mass: 1
loads:
  - {name: full}
  - {weight: 5, com: [0, 0, -50]}
contacts:
  - {position: [18, 24, 10], friction: 0.5, torsion: 4, finger: left}
  - {position: [0, 0, -100], normal: [0, 0, 2], friction: 0, max_normal: 7}
)";

const std::string json = R"({
  "poise": 1, "dimension": 3, "name": "bottle", "safety": 2, "length_unit": "mm", "up": [0, 3, 4],
  "tilt": {"from": [0, 0, 2], "max_deg": 30}, "domain": "all",
  "object": {"shape": {"cylinder": {"radius": 30, "height": 200}},
             "mass": 1},
  "loads": [{"name": "full"}, {"weight": 5, "com": [0, 0, -50]}],
  "contacts": [
    {"position": [18, 24, 10], "friction": 0.5, "torsion": 4, "finger": "left"},
    {"position": [0, 0, -100], "normal": [0, 0, 2], "friction": 0, "max_normal": 7}]})";

const std::string top = "poise: 1\ndimension: 3\n";
const std::string object = "object: {weight: 10, com: [0, 0, 0]}\n";
const std::string contacts =
    "contacts:\n  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
    "  - {position: [-1, 0, 0], normal: [1, 0, 0], friction: 1}\n";

SpatialFile read(const std::string& text) {
  return std::get<SpatialFile>(grasp_from_yaml(text, "f.yaml"));
}

void check(const SpatialFile& file) {
  EXPECT_EQ(file.name, "bottle");
  EXPECT_EQ(file.safety, 2);
  EXPECT_TRUE(file.up.value().isApprox(Vector<3>(0, 0.6, 0.8), 1e-15));
  EXPECT_EQ(file.tilt.value().from, Vector<3>(0, 0, 1));
  EXPECT_DOUBLE_EQ(file.tilt.value().most, 30 * degree);
  EXPECT_DOUBLE_EQ(std::get<Cylinder>(file.shape.value()).radius, 0.03);
  EXPECT_DOUBLE_EQ(std::get<Cylinder>(file.shape.value()).height, 0.2);
  ASSERT_EQ(file.loads.size(), 2U);
  EXPECT_EQ(file.loads[0].weight, standard_gravity);
  EXPECT_EQ(file.loads[0].com, Vector<3>(0, 0, 0));
  EXPECT_EQ(file.loads[1].weight, 5);
  EXPECT_TRUE(file.loads[1].com.isApprox(Vector<3>(0, 0, -0.05), 1e-15));
  ASSERT_EQ(file.contacts.size(), 2U);
  EXPECT_TRUE(file.contacts[0].position.isApprox(Vector<3>(0.018, 0.024, 0.01), 1e-15));
  EXPECT_TRUE(file.contacts[0].normal.isApprox(Vector<3>(-0.6, -0.8, 0), 1e-15));
  EXPECT_DOUBLE_EQ(file.contacts[0].torsion, 0.004);
  EXPECT_EQ(file.contacts[0].finger, "left");
  EXPECT_EQ(file.contacts[1].torsion, 0);
  EXPECT_EQ(file.contacts[1].max_normal, 7);
  EXPECT_EQ(file.warnings, std::vector<std::string>());
  const Grasp<3> grasp = file.grasp();
  ASSERT_EQ(grasp.loads().size(), 2U);
  EXPECT_EQ(grasp.loads()[1].weight, 5);
  // Safety divides friction and torsion.
  EXPECT_EQ(grasp.contacts()[0].friction, 0.25);
  EXPECT_DOUBLE_EQ(grasp.contacts()[0].torsion, 0.002);
}

TEST(SpatialFile, SaysWhatItSays) { check(read(yaml)); }

TEST(SpatialFile, IsTheSameInJson) {
  check(read(json));
  check(std::get<SpatialFile>(grasp_from_json(json, "f.json")));
}

TEST(SpatialFile, HasDefaults) {
  const SpatialFile file = read(top + object + contacts);
  EXPECT_EQ(file.name, "");
  EXPECT_EQ(file.safety, 1);
  EXPECT_FALSE(file.up);
  EXPECT_FALSE(file.tilt);
  EXPECT_FALSE(file.shape);
  EXPECT_EQ(file.loads.size(), 1U);
  EXPECT_EQ(file.contacts[0].torsion, 0);
}

TEST(SpatialFile, AUnitScalesEveryLength) {
  for (const auto& [unit, scale] : {std::pair("m", 1.0), std::pair("cm", 0.01),
                                    std::pair("mm", 0.001), std::pair("in", 0.0254)})
    for (const auto& [shape, radius] :
         {std::pair("box: {size: [4, 2, 2]}", 2.0), std::pair("sphere: {radius: 2}", 2.0),
          std::pair("ellipsoid: {radii: [2, 1, 3]}", 2.0),
          std::pair("cylinder: {radius: 2, height: 3}", 2.0)}) {
      const SpatialFile file =
          read(top + "length_unit: " + unit + "\nobject: {weight: 1, shape: {" + shape +
               "}}\ncontacts: [{position: [2, 0, 0], friction: 1, " +
               "torsion: 0.5, min_normal: 0.5}]\n");
      EXPECT_TRUE(file.contacts[0].position.isApprox(Vector<3>(scale * radius, 0, 0), 1e-15));
      EXPECT_TRUE(file.contacts[0].normal.isApprox(Vector<3>(-1, 0, 0), 1e-12)) << shape;
      EXPECT_DOUBLE_EQ(bounds(*file.shape).max().x(), scale * radius);
      EXPECT_DOUBLE_EQ(file.contacts[0].torsion, scale * 0.5);
      EXPECT_EQ(file.contacts[0].min_normal, 0.5);
      EXPECT_EQ(file.loads[0].weight, 1);
    }
}

TEST(SpatialFile, OutwardNormalsAreFlippedThoseOfTheShapeAreNot) {
  const SpatialFile file = read(top +
                                "normals: outward\n"
                                "object: {weight: 1, shape: {sphere: {radius: 1}}}\n"
                                "contacts: [{position: [0, 0, 1], friction: 1},\n"
                                "  {position: [0, 0, -1], normal: [0, 0, -1], friction: 1}]\n");
  EXPECT_EQ(file.contacts[0].normal, Vector<3>(0, 0, -1));
  EXPECT_EQ(file.contacts[1].normal, Vector<3>(0, 0, 1));
  EXPECT_EQ(file.warnings, std::vector<std::string>());
}

TEST(SpatialFile, TiltMayBeAnythingFromNoneToHorizontal) {
  for (const auto& [text, most] : {std::pair("0", 0.0), std::pair("90", 90 * degree)})
    EXPECT_DOUBLE_EQ(
        read(top + "tilt: {from: [1, 0, 0], max_deg: " + text + "}\n" + object + contacts)
            .tilt.value()
            .most,
        most);
}

TEST(SpatialFile, WarnsOfWhatLooksLikeAMistake) {
  using Lines = std::vector<std::string>;
  const std::string unit = "is the unit right (weight in N, mass in kg)?",
                    inward = "the inward normal of the shape",
                    length = "it is a length, about the size of the touching area";
  EXPECT_EQ(read(top + "normals: outward\n" + object + contacts).warnings.size(), 2U);
  EXPECT_EQ(
      read(top + "object:\n  shape: {box: {size: [2, 2, 2]}}\n  weight: 1\nloads:\n" +
           "    - {mass: 20000, com: [0, 0, 1.5]}\n    - {name: other}\ncontacts:\n" +
           "  - {position: [1, 0, 0], normal: [-1, 0, 0.2], friction: 0.5, torsion: 5}\n" +
           "  - {position: [1, 0, 0], friction: 30}\n")
          .warnings,
      (Lines{"f.yaml:7:14: loads[0].mass: makes a weight of 1.96e+05 N: " + unit,
             "f.yaml:7:26: loads[0].com: lies outside the shape",
             "f.yaml:10:35: contacts[0].normal: is 11.3 degrees away from " + inward,
             "f.yaml:10:73: contacts[0].torsion: is 5 m, more than the size of the grasp: " + length,
             "f.yaml:11:37: contacts[1].friction: is 30, uncommonly high: is it an angle?",
             "f.yaml:11:16: contacts[1].position: is the same as that of contacts[0]"}));
}

}  // namespace
}  // namespace poise
