#include "files/grasp_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "files/value.hpp"

namespace poise {
namespace {

constexpr double pi = 3.14159265358979323846;

const std::string yaml = R"(# The disk of Fig. 6
poise: 1
dimension: 2
name: "disk \u00e9\/\U0001F600"
safety: 1.25
angle_deg: -270
domain: pinching-up
length_unit: cm
object:
  mass: 2
  com: [1, -2]
  shape: {disk: {radius: 1e2}}
contacts:
  - {position: [100, 0], friction: .5, finger: left}
  - position: [0, +100]
    normal: [0, -2]
    friction: 0x1
    min_normal: 1
    max_normal: 20
    share: 0.5
    finger: "2"
)";

const std::string json = R"({
  "poise": 1, "dimension": 2, "name": "disk \u00e9\/\ud83d\ude00", "safety": 1.25,
	"angle_deg": -270, "domain": "pinching-up", "length_unit": "cm",
  "object": {"mass": 2, "com": [1, -2], "shape": {"disk": {"radius": 1E+2}}},
  "contacts": [
    {"position": [100, 0], "friction": 0.5, "finger": "left"},
    {"position": [0, 100], "normal": [0, -2], "friction": 1.0, "min_normal": 1,
     "max_normal": 20, "share": 0.5, "finger": "2"}
  ]
}
)";

const std::string top = "poise: 1\ndimension: 2\n";
const std::string object = "object: {weight: 10, com: [0, 0]}\n";
const std::string contacts =
    "contacts:\n  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
    "  - {position: [-1, 0], normal: [1, 0], friction: 1}\n";

PlanarFile read(const std::string& text) {
  return std::get<PlanarFile>(grasp_from_yaml(text, "f.yaml"));
}

std::vector<std::string> warnings(const std::string& text) { return read(text).warnings; }

std::string error(const std::string& text) {
  try {
    grasp_from_json(text, "f.json");
  } catch (const FileError& e) {
    return e.what();
  }
  return "";
}

void expect_equal(const PlanarFile& a, const PlanarFile& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.safety, b.safety);
  EXPECT_EQ(a.angle, b.angle);
  EXPECT_EQ(a.domain, b.domain);
  EXPECT_EQ(a.loads[0].weight, b.loads[0].weight);
  EXPECT_EQ(a.loads[0].com, b.loads[0].com);
  ASSERT_EQ(a.shape.has_value(), b.shape.has_value());
  if (a.shape) {
    EXPECT_EQ(outline(*a.shape), outline(*b.shape));
  }
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    const Contact<2>&c = a.contacts[i], &d = b.contacts[i];
    EXPECT_EQ(c.position, d.position);
    EXPECT_EQ(c.normal, d.normal);
    EXPECT_EQ(c.friction, d.friction);
    EXPECT_EQ(c.min_normal, d.min_normal);
    EXPECT_EQ(c.max_normal, d.max_normal);
    EXPECT_EQ(c.share, d.share);
    EXPECT_EQ(c.finger, d.finger);
  }
}

TEST(GraspFile, SaysWhatItSays) {
  const PlanarFile file = read(yaml);
  EXPECT_EQ(file.name, "disk \u00e9/\U0001F600");
  EXPECT_EQ(file.safety, 1.25);
  EXPECT_DOUBLE_EQ(file.angle.value(), pi / 2);
  EXPECT_EQ(file.domain, Domain::pinching_up);
  EXPECT_DOUBLE_EQ(file.loads[0].weight, 2 * 9.80665);
  EXPECT_TRUE(file.loads[0].com.isApprox(Vector<2>(0.01, -0.02)));
  EXPECT_DOUBLE_EQ(std::get<Disk>(file.shape.value()).radius, 1);
  ASSERT_EQ(file.contacts.size(), 2U);
  EXPECT_TRUE(file.contacts[0].position.isApprox(Vector<2>(1, 0)));
  EXPECT_TRUE(file.contacts[0].normal.isApprox(Vector<2>(-1, 0)));
  EXPECT_EQ(file.contacts[0].friction, 0.5);
  EXPECT_EQ(file.contacts[0].min_normal, 0);
  EXPECT_EQ(file.contacts[0].max_normal, std::numeric_limits<double>::infinity());
  EXPECT_EQ(file.contacts[0].share, 1);
  EXPECT_EQ(file.contacts[0].finger, "left");
  EXPECT_EQ(file.contacts[1].friction, 1);
  EXPECT_EQ(file.contacts[1].min_normal, 1);
  EXPECT_EQ(file.contacts[1].max_normal, 20);
  EXPECT_EQ(file.contacts[1].share, 0.5);
  EXPECT_EQ(file.contacts[1].finger, "2");
  EXPECT_EQ(file.warnings, std::vector<std::string>());
  EXPECT_DOUBLE_EQ(file.grasp().contacts()[0].friction, 0.4);
}

TEST(GraspFile, IsTheSameInYamlAndJson) {
  expect_equal(read(yaml), read(json));
  expect_equal(read(yaml), std::get<PlanarFile>(grasp_from_json(json, "f.json")));
}

TEST(GraspFile, HasDefaults) {
  const PlanarFile file = read(top + object + contacts);
  EXPECT_EQ(file.name, "");
  EXPECT_EQ(file.safety, 1);
  EXPECT_FALSE(file.angle);
  EXPECT_EQ(file.domain, Domain::all);
  EXPECT_FALSE(file.shape);
  EXPECT_EQ(file.contacts[0].finger, "");
}

TEST(GraspFile, LineEndsAndByteOrderMarkDoNotMatter) {
  std::string dos = "\xEF\xBB\xBF" + yaml;
  for (std::size_t i = 0; (i = dos.find('\n', i)) != std::string::npos; i += 2)
    dos.replace(i, 1, "\r\n");
  expect_equal(read(yaml), read(dos));
  expect_equal(read(json), read("\xEF\xBB\xBF" + json));
}

TEST(GraspFile, AUnitScalesEveryLength) {
  const std::string rest =
      "object: {weight: 1, com: [1, 2], shape: {polygon: [[0, 0], [4, 0], [4, 3], [0, 3]]}}\n"
      "contacts: [{position: [4, 1], friction: 1, min_normal: 0.5}]\n";
  const PlanarFile metres = read(top + rest);
  for (const auto& [unit, scale] : {std::pair("m", 1.0), std::pair("cm", 0.01),
                                    std::pair("mm", 0.001), std::pair("in", 0.0254)}) {
    const PlanarFile file = read(top + "length_unit: " + unit + "\n" + rest);
    EXPECT_TRUE(file.loads[0].com.isApprox(scale * metres.loads[0].com));
    EXPECT_TRUE(file.contacts[0].position.isApprox(scale * metres.contacts[0].position));
    EXPECT_DOUBLE_EQ(size(*file.shape), scale * 2.5);
    EXPECT_EQ(file.loads[0].weight, 1);
    EXPECT_EQ(file.contacts[0].min_normal, 0.5);
    EXPECT_EQ(file.contacts[0].normal, metres.contacts[0].normal);
  }
}

TEST(GraspFile, OutwardNormalsAreFlippedThoseOfTheShapeAreNot) {
  const PlanarFile file = read(top +
                               "normals: outward\n"
                               "object: {weight: 1, shape: {ellipse: {radii: [2, 1]}}}\n"
                               "contacts: [{position: [2, 0], friction: 1},\n"
                               "  {position: [-2, 0], normal: [-1, 0], friction: 1}]\n");
  EXPECT_EQ(file.contacts[0].normal, Vector<2>(-1, 0));
  EXPECT_EQ(file.contacts[1].normal, Vector<2>(1, 0));
  EXPECT_EQ(file.warnings, std::vector<std::string>());
}

TEST(GraspFile, TheCentreOfMassIsThatOfTheShapeUnlessGiven) {
  const std::string shape = "shape: {polygon: [[0, 0], [3, 0], [3, 1], [1, 1], [1, 4], [0, 4]]}";
  EXPECT_TRUE(read(top + "object: {weight: 1, " + shape + "}\n" + contacts)
                  .loads[0]
                  .com.isApprox(Vector<2>(1, 1.5)));
  EXPECT_EQ(read(top + "object: {weight: 1, com: [1, 2], " + shape + "}\n" + contacts).loads[0].com,
            Vector<2>(1, 2));
}

TEST(GraspFile, AnAngleIsTakenModuloATurn) {
  const auto angle = [](const std::string& degrees) {
    return read(top + "angle_deg: " + degrees + "\n" + object + contacts).angle.value();
  };
  EXPECT_DOUBLE_EQ(angle("3630"), pi / 6);
  EXPECT_EQ(angle("180"), pi);
  EXPECT_EQ(angle("-180"), pi);
  EXPECT_EQ(angle("540"), pi);
}

TEST(GraspFile, AnAliasStandsForItsValue) {
  const PlanarFile file =
      read(top + object +
           "contacts:\n  - &left {position: [1, 0], normal: &n [-1, 0], friction: 1}\n"
           "  - {position: [2, 0], normal: *n, friction: 1}\n  - *left\n");
  EXPECT_EQ(file.contacts[1].normal, Vector<2>(-1, 0));
  EXPECT_EQ(file.contacts[2].position, Vector<2>(1, 0));
}

TEST(GraspFile, TagsOfTheCoreSchemaAreUnderstood) {
  const PlanarFile file = read(top + "name: !!str 12\nsafety: !!float 2\n" + object + contacts);
  EXPECT_EQ(file.name, "12");
  EXPECT_EQ(file.safety, 2);
}

TEST(GraspFile, AFlowMappingThatIsNoJsonIsStillYaml) {
  EXPECT_EQ(read("{poise: 1, dimension: 2, name: a, object: {weight: 1, com: [0, 0]},\n"
                 " contacts: [{position: [1, 0], normal: [-1, 0], friction: 1}]}  # YAML\n")
                .name,
            "a");
}

TEST(GraspFile, WarnsOfWhatLooksLikeAMistake) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(warnings(top + object + contacts), Lines());
  EXPECT_EQ(warnings(top + "normals: outward\n" + object + contacts),
            (Lines{"f.yaml:6:32: contacts[0].normal: points away from the centre of mass: if it "
                   "points out of the object, write normals: outward",
                   "f.yaml:7:33: contacts[1].normal: points away from the centre of mass: if it "
                   "points out of the object, write normals: outward"}));
  EXPECT_EQ(warnings(top + "length_unit: mm\nobject: {mass: 50000, com: [0, 0]}\n"
                           "contacts: [{position: [0.05, 0], normal: [-1, 0], friction: 30}]\n"),
            (Lines{"f.yaml:4:16: object.mass: makes a weight of 4.9e+05 N: is the unit right "
                   "(weight in N, mass in kg)?",
                   "f.yaml:5:11: contacts: the farthest is 5e-05 m from the centre of mass: is "
                   "length_unit right?",
                   "f.yaml:5:61: contacts[0].friction: is 30, uncommonly high: is it an angle?"}));
  EXPECT_EQ(warnings(top + object +
                     "contacts:\n  - {position: [80, 0], normal: [-1, 0], friction: 1}\n"
                     "  - {position: [80, 0], normal: [-1, 0], friction: 1}\n"),
            (Lines{"f.yaml:5:3: contacts: the farthest is 80 m from the centre of mass: is "
                   "length_unit right?",
                   "f.yaml:6:16: contacts[1].position: is the same as that of contacts[0]"}));
  EXPECT_EQ(warnings(top + "object: {weight: 1, com: [3, 0], shape: {disk: {radius: 1}}}\n"
                           "contacts:\n  - {position: [1, 0], normal: [-1, 0.2], friction: 1}\n"
                           "  - {position: [2, 0], normal: [1, 0], friction: 1}\n"),
            (Lines{"f.yaml:3:26: object.com: lies outside the shape",
                   "f.yaml:5:32: contacts[0].normal: is 11.3 degrees away from the inward normal "
                   "of the shape",
                   "f.yaml:6:16: contacts[1].position: is 1 m from the boundary of the shape"}));
}

TEST(GraspFile, TheShapeMayPointAwayFromTheCentreOfMass) {
  EXPECT_EQ(
      warnings(top +
               "object: {weight: 1, shape: {polygon: [[0, 0], [3, 0], [3, 1], [1, 1], [1, 4], "
               "[0, 4]]}}\ncontacts:\n  - {position: [1, 3], normal: [-1, 0], friction: 1}\n"
               "  - {position: [2, 1], friction: 1}\n"),
      std::vector<std::string>());
}

TEST(GraspFile, ErrorsInJsonHaveTheirPlace) {
  EXPECT_EQ(error("{\n  \"poise\": 1,\n  \"dimension\": \"\\u00e9\"}"),
            "f.json:3:16: dimension: is \"\u00e9\", must be a number");
  EXPECT_EQ(error("{\"poise\": 1,\n}"), "f.json:2:1: a key in quotes expected");
  EXPECT_EQ(error("{\"poise\": 1"), "f.json:1:12: '}' expected");
  EXPECT_EQ(error("{\"poise\" 1}"), "f.json:1:10: ':' expected");
  EXPECT_EQ(error("{\"poise\": one}"), "f.json:1:11: a value expected");
  EXPECT_EQ(error("{\"poise\": }"), "f.json:1:11: a value expected");
  EXPECT_EQ(error("{\"poise\": \"a\n\"}"), "f.json:1:13: the line ends within quotes");
  EXPECT_EQ(error("{\"poise\": \"a"), "f.json:1:13: the text ends within quotes");
  EXPECT_EQ(error("{\"poise\": \"\\q\"}"), "f.json:1:13: unknown escape");
  EXPECT_EQ(error("{\"poise\": \"\\u12g4\"}"), "f.json:1:16: four hexadecimal digits expected");
  EXPECT_EQ(error("{\"poise\": \"\\ud83d\"}"), "f.json:1:17: half a surrogate pair");
  EXPECT_EQ(error("{\"poise\": \"\\ude00\"}"), "f.json:1:17: half a surrogate pair");
  EXPECT_EQ(error("{} {}"), "f.json:1:4: the text must end after its value");
  EXPECT_EQ(error(std::string(100000, '[')), "f.json:1:34: is nested too deeply");
  EXPECT_EQ(error("poise: 1"), "f.json:1:1: a value expected");
  EXPECT_EQ(error(""), "f.json:1:1: a value expected");
}

TEST(GraspFile, ColumnsCountCharacters) {
  EXPECT_EQ(error("{\"\u00e9\U0001F600\": 1, \"poise\": 1, \"dimension\": 2}"),
            "f.json:1:2: \u00e9\U0001F600: is not a known key, the nearest is poise");
}

TEST(GraspFile, IsReadFromDisk) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("poise_grasp_file_test_" + std::to_string(std::random_device()()));
  std::filesystem::create_directory(folder);
  const std::string file = (folder / "f.yaml").string();
  std::ofstream(file) << yaml;
  expect_equal(std::get<PlanarFile>(read_grasp_file(file)), read(yaml));

  const auto problem = [](const std::string& name) {
    try {
      read_grasp_file(name);
    } catch (const FileError& e) {
      EXPECT_EQ(e.line(), 0);
      EXPECT_EQ(e.file(), name);
      return e.problem();
    }
    return std::string();
  };
  EXPECT_EQ(problem(folder.string()), "is a folder, must be a file");
  EXPECT_EQ(problem(file + "x"), "does not exist");
  std::ofstream(file) << "";
  EXPECT_EQ(problem(file), "is empty, must be a grasp file");
  std::ofstream(file) << std::string(max_text + 1, '#');
  EXPECT_EQ(problem(file), "is larger than 1048576 bytes, the most that is read");
  std::filesystem::remove_all(folder);
}

TEST(GraspFile, HoweverDamagedIsReadOrRefused) {
  std::mt19937 random(6);
  int refused = 0;
  for (int k = 0; k < 3000; ++k) {
    std::string text = k % 2 == 0 ? yaml : json;
    for (std::size_t edits = 1 + random() % 4; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text.erase(at, 1 + random() % 8);
          break;
        case 1:
          text.insert(at, 1, "[]{}:,-&*!|>'\"%@`#?\n\t\\ 0e."[random() % 26]);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 30));
      }
    }
    try {
      read(text);
    } catch (const FileError& e) {
      EXPECT_FALSE(e.problem().empty());
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST(PlainScalar, FollowsTheCoreSchema) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{{"0", 0},
                                                                               {"-0", 0},
                                                                               {"+1", 1},
                                                                               {"007", 7},
                                                                               {"1e3", 1000},
                                                                               {"1E+3", 1000},
                                                                               {"1e-3", 1e-3},
                                                                               {".5", 0.5},
                                                                               {"-.5", -0.5},
                                                                               {"5.", 5},
                                                                               {"-1.5e2", -150},
                                                                               {"0x1F", 31},
                                                                               {"0o17", 15},
                                                                               {"1e400", infinity},
                                                                               {".inf", infinity},
                                                                               {"-.INF", -infinity},
                                                                               {"+.Inf", infinity},
                                                                               {"1e-400", 0}}) {
    const Value scalar = plain_scalar(text, 3);
    ASSERT_TRUE(std::holds_alternative<double>(scalar.data)) << text;
    EXPECT_EQ(std::get<double>(scalar.data), value) << text;
    EXPECT_EQ(scalar.at, 3U);
  }
  for (const std::string text : {".nan", ".NaN", ".NAN"})
    EXPECT_TRUE(std::isnan(std::get<double>(plain_scalar(text, 0).data)));
  for (const std::string text : {"", "~", "null", "Null", "NULL"})
    EXPECT_TRUE(std::holds_alternative<std::monostate>(plain_scalar(text, 0).data));
  for (const std::string text : {"true", "True", "TRUE"})
    EXPECT_TRUE(std::get<bool>(plain_scalar(text, 0).data));
  for (const std::string text :
       {"yes",   "no",  "on",  "off",   "1_000", "1,5",  "-",    "+",    ".",
        "e3",    ".e3", "1e",  "1e+",   "0x",    "0o8",  "0xg",  "-0x1", "0b1",
        "+.nan", "inf", "nan", "1.2.3", "1 2",   "nULL", "tRUE", "0X1",  "12:30:45"})
    EXPECT_EQ(std::get<std::string>(plain_scalar(text, 0).data), text);
}

}  // namespace
}  // namespace poise
