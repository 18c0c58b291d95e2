// The program in space. Answers are judged by statics written out here, not by the solver.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>

#include "command_line.hpp"
#include "poise/load.hpp"

namespace poise {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

/// Two jaws with soft pads on a block; the centre of mass is beside the line through them.
const std::string block =
    "poise: 1\n"
    "dimension: 3\n"
    "name: block\n"
    "object: {weight: 10, com: [0.01, 0.02, 0.03]}\n"
    "contacts:\n"
    "  - {position: [0.05, 0, 0], normal: [-1, 0, 0], friction: 0.6, torsion: 0.02}\n"
    "  - {position: [-0.05, 0, 0], normal: [1, 0, 0], friction: 0.5, torsion: 0.03}\n";

/// Three hard fingers round a ball, one below.
const std::string ball =
    "poise: 1\n"
    "dimension: 3\n"
    "object: {weight: 10, com: [0.1, 0, 0], shape: {sphere: {radius: 1}}}\n"
    "contacts:\n"
    "  - {position: [1, 0, 0], friction: 0.5, finger: a}\n"
    "  - {position: [-0.5, 0.8660254, 0], friction: 0.5, finger: b}\n"
    "  - {position: [-0.5, -0.8660254, 0], friction: 0.5, finger: b}\n"
    "  - {position: [0, 0, -1], friction: 0.2}\n";

/// The same, of unknown filling.
const std::string filled =
    "poise: 1\n"
    "dimension: 3\n"
    "object:\n"
    "  shape: {sphere: {radius: 1}}\n"
    "loads: [{weight: 10, com: [0.1, 0, 0]}, {weight: 6, com: [0, 0, -0.4]}, {weight: 2}]\n" +
    ball.substr(ball.find("contacts:"));

/// Two smooth fingers on one line: nothing carries what is across it.
const std::string slippery =
    "poise: 1\n"
    "dimension: 3\n"
    "object: {weight: 10, com: [0, 1, 0]}\n"
    "contacts:\n"
    "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 0}\n"
    "  - {position: [-1, 0, 0], normal: [1, 0, 0], friction: 0}\n";

Vector<3> vector(const Json& list) {
  EXPECT_EQ(list.size(), 3U) << list;
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

Eigen::Quaterniond quaternion(const Json& q) {
  const Eigen::Quaterniond result(q["w"].get<double>(), q["x"].get<double>(), q["y"].get<double>(),
                                  q["z"].get<double>());
  EXPECT_NEAR(result.norm(), 1, 1e-12) << q;
  EXPECT_GE(result.w(), 0) << q;
  return result;
}

std::set<std::string> keys(const Json& object) {
  std::set<std::string> result;
  for (const auto& item : object.items()) result.insert(item.key());
  return result;
}

struct Held {
  Vector<3> position, normal;
  double friction, torsion;
};

std::vector<Held> contacts_of(const Json& check) {
  std::vector<Held> contacts;
  for (const Json& c : check["contacts"])
    contacts.push_back({vector(c["position"]), vector(c["normal"]), c["friction"], c["torsion"]});
  return contacts;
}

class Space : public CommandLine {
 protected:
  /// Judges a hold of a file by its statics, with what `check` says of the file.
  static void judge(const Json& hold, const Json& check) {
    const bool many = check["loads"].size() > 1;
    std::set<std::string> expected{"holdable",   "up",        "dual",   "lower_bound", "effort",
                                   "force_norm", "residual",  "manner", "all_loaded",  "fingers",
                                   "contacts",   "objective", "grip",   "drives"};
    if (many) expected.insert({"load", "load_efforts", "load_holds"});
    std::set<std::string> given = keys(hold);
    for (const char* key : {"poise_result", "command", "options"}) given.erase(key);
    EXPECT_EQ(given, expected);
    EXPECT_EQ(hold["holdable"], true);

    const std::size_t load = many ? hold["load"].get<std::size_t>() : 0;
    const Json& object = check["loads"][load];
    const double weight = object["weight"];
    const Vector<3> up = vector(hold["up"]), com = vector(object["com"]);
    const std::vector<Held> contacts = contacts_of(check);
    ASSERT_EQ(hold["contacts"].size(), contacts.size());
    Vector<3> force = Vector<3>::Zero(), moment = Vector<3>::Zero();
    double effort = 0, radius = 0;
    std::map<std::string, Vector<3>> fingers;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Held& c = contacts[i];
      const Json& entry = hold["contacts"][i];
      EXPECT_EQ(entry.contains("torsion_moment"), c.torsion > 0);
      const Vector<3> f = vector(entry["force"]);
      const double n = entry["normal_force"], t = entry["tangential_force"],
                   m = entry.value("torsion_moment", 0.0),
                   bent = c.torsion > 0 ? m * c.friction / c.torsion : 0;
      EXPECT_NEAR(f.dot(c.normal), n, 1e-9 * weight);
      EXPECT_NEAR((f - n * c.normal).norm(), t, 1e-9 * weight);
      EXPECT_GE(n, 0);
      if (entry["state"] != "unloaded" && c.friction > 0) {
        EXPECT_NEAR(entry["friction_used"], std::hypot(t, bent) / (c.friction * n), 1e-9);
      }
      EXPECT_LE(entry["friction_used"], 1);
      force += f;
      moment += c.position.cross(f) + m * c.normal;
      effort += n * n + t * t + bent * bent;
      radius = std::max(radius, (c.position - com).norm());
      fingers.try_emplace(entry["finger"], Vector<3>::Zero()).first->second += f;
    }
    EXPECT_LE((force - weight * up).norm(), 1e-9 * weight);
    EXPECT_LE((moment - com.cross(weight * up)).norm(), 1e-9 * weight * radius);
    EXPECT_NEAR(hold["effort"], effort, 1e-9 * effort);
    EXPECT_NEAR(hold["force_norm"], std::sqrt(effort), 1e-9 * std::sqrt(effort));
    EXPECT_LE(hold["residual"], 1e-9);
    EXPECT_NEAR(hold["lower_bound"], effort, 1e-8 * effort);
    // Without limits the power of the load on y, about the origin, is V.
    Eigen::Matrix<double, 6, 1> y, w;
    ASSERT_EQ(hold["dual"].size(), 6U);
    for (int k = 0; k < 6; ++k) y[k] = hold["dual"][static_cast<std::size_t>(k)];
    w << weight * up, com.cross(weight * up);
    EXPECT_NEAR(y.dot(w), effort, 1e-8 * effort);

    double grip = 0;
    ASSERT_EQ(hold["fingers"].size(), fingers.size());
    for (const Json& finger : hold["fingers"]) {
      EXPECT_LE((vector(finger["force"]) - fingers[finger["finger"]]).norm(), 1e-9 * weight);
    }
    for (const Json& drive : hold["drives"])
      grip = std::max(grip, drive["part_of_max"].is_null() ? drive["effort"].get<double>()
                                                           : hold["grip"].get<double>());
    EXPECT_EQ(hold["grip"], grip);
    if (many) {
      ASSERT_EQ(hold["load_efforts"].size(), check["loads"].size());
      EXPECT_EQ(hold["load_efforts"][load], hold["effort"]);
      for (const Json& other : hold["load_efforts"]) EXPECT_LE(other, hold["effort"]);
    }
  }
};

TEST_F(Space, HoldsBalanceAndObeyFriction) {
  write("block.yaml", block);
  write("ball.yaml", ball);
  write("filled.yaml", filled);
  for (const std::string file : {"block.yaml", "ball.yaml", "filled.yaml"}) {
    const Json check = json("check " + file);
    for (const std::string up : {"0,0,1", "0.2,0.1,3", "-0.3,0.2,0.5"})
      judge(json("hold " + file + " --objective effort --up " + up), check);
  }
}

TEST_F(Space, ABallOnItsFingerNeedsItsWeight) {
  const std::string up =
      "poise: 1\ndimension: 3\nobject: {weight: 10, shape: {sphere: {radius: 1}}}\n";
  write("one.yaml", up + "contacts: [{position: [0, 0, -1], friction: 0}]\n");
  const Json hold = json("hold one.yaml --objective effort");
  EXPECT_EQ(hold["up"], Json::parse("[0.0, 0.0, 1.0]"));
  EXPECT_NEAR(hold["effort"], 100, 1e-9);
  EXPECT_EQ(hold["manner"], "resting");
  EXPECT_EQ(hold["contacts"][0]["friction_used"], 1.0);
  EXPECT_EQ(hold["options"], Json::parse(R"({"force_cap": 1000000.0, "objective": "effort"})"));
}

TEST_F(Space, TakesPosturesInEveryForm) {
  write("block.yaml", block);
  write("turned.yaml", block + "up: [0, 3, 4]\n");
  EXPECT_EQ(json("hold block.yaml")["up"], Json::parse("[0.0, 0.0, 1.0]"));
  EXPECT_LE((vector(json("hold turned.yaml")["up"]) - Vector<3>(0, 0.6, 0.8)).norm(), 1e-15);
  const Json given = json("hold turned.yaml --up 0,-3,4");
  EXPECT_LE((vector(given["up"]) - Vector<3>(0, -0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(given["options"]["up"], Json::parse("[0.0, -3.0, 4.0]"));
}

TEST_F(Space, WhatCannotBeHeldHasItsReason) {
  write("slippery.yaml", slippery);
  const Json hold = json("hold slippery.yaml", 1);
  EXPECT_EQ(hold["holdable"], false);
  EXPECT_FALSE(hold["reason"].get<std::string>().empty());
  EXPECT_GT(hold["lower_bound"], 1e12 * 100);
  const Outcome run = poise("hold slippery.yaml");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.out.find("With (0.000, 0.000, 1.000) up it cannot be held: it would"), run.out.npos)
      << run.out;
}

TEST_F(Space, ALoadThatCannotBeHeldDecides) {
  // Held from below by three smooth fingers: only over their triangle.
  const std::string tripod =
      "poise: 1\ndimension: 3\nobject: {weight: 1}\nloads: [{com: [0, 0, 1]}, "
      "{com: [2, 0, 1]}]\ncontacts:\n"
      "  - {position: [1, 0, 0], normal: [0, 0, 1], friction: 0}\n"
      "  - {position: [-1, 1, 0], normal: [0, 0, 1], friction: 0}\n"
      "  - {position: [-1, -1, 0], normal: [0, 0, 1], friction: 0}\n";
  write("tripod.yaml", tripod);
  const Json hold = json("hold tripod.yaml --objective effort", 1);
  EXPECT_EQ(hold["load"], 1);
  EXPECT_NEAR(hold["load_efforts"][0], 0.375, 1e-9);  // 1/2, 1/4, 1/4
  EXPECT_NEAR(json("hold tripod.yaml", 1)["load_grips"][0], 0.5, 1e-9);
  EXPECT_TRUE(hold["load_efforts"][1].is_null());
  const Outcome run = poise("hold tripod.yaml");
  EXPECT_NE(run.out.find("against load 1 it would"), run.out.npos) << run.out;
}

/// Judges the document of `best` by itself; returns it.
class SpaceBest : public Space {
 protected:
  Json best(const std::string& file, const std::string& flags = "") const {
    const Json check = json("check " + file),
               document = json("best " + file + " --objective effort " + flags);
    EXPECT_EQ(keys(document),
              (std::set<std::string>{"poise_result", "command", "options", "status", "best",
                                     "best_pinched", "minima", "minima_complete", "lower_bound",
                                     "relative_gap", "holds", "turn", "without_pressing_harder",
                                     "cuts"}));
    const Json& options = document["options"];
    EXPECT_EQ(options["domain"], "all");
    EXPECT_EQ(document["status"], "optimal");
    EXPECT_EQ(document["minima_complete"], false);
    EXPECT_EQ(document["best"], document["minima"][0]);
    for (const Json& minimum : document["minima"]) {
      judge(minimum, check);
      // The best is known up to the gap.
      EXPECT_GE(minimum["effort"].get<double>(),
                document["best"]["effort"].get<double>() * (1 - options["gap"].get<double>()));
      EXPECT_GE(minimum["effort"], document["lower_bound"]);
    }
    if (!document["best_pinched"].is_null()) {
      EXPECT_EQ(document["best_pinched"]["manner"], "pinched");
      EXPECT_EQ(std::count(document["minima"].begin(), document["minima"].end(),
                           document["best_pinched"]),
                1);
    }
    const double effort = document["best"]["effort"], bound = document["lower_bound"];
    EXPECT_EQ(document["relative_gap"], (effort - bound) / effort);
    EXPECT_LE(document["relative_gap"], options["gap"]);
    EXPECT_LE(document["holds"], options["max_holds"]);
    judge_turn(document);
    judge_cuts(document, check);
    return document;
  }

  /// The rotation leads from the present orientation to the best posture, the shortest way.
  static void judge_turn(const Json& document) {
    const Eigen::Quaterniond before = quaternion(document["options"]["orientation"]),
                             turn = quaternion(document["turn"]["rotation"]),
                             after = quaternion(document["turn"]["orientation"]);
    const Vector<3> up = vector(document["best"]["up"]), sky = Vector<3>::UnitZ();
    EXPECT_LE((after * up - sky).norm(), 1e-9);
    EXPECT_LE((after.toRotationMatrix() - (turn * before).toRotationMatrix()).norm(), 1e-12);
    const double angle = document["turn"]["rotation"]["angle_deg"].get<double>() * degree;
    EXPECT_NEAR(angle, std::atan2((before * up).cross(sky).norm(), (before * up).dot(sky)), 1e-9);
    EXPECT_NEAR(angle, 2 * std::acos(std::min(1.0, turn.w())), 1e-7);
  }

  /// Cuts are valid: no hold that is shown contradicts one. Without limits the y of a cut, times
  /// any s > 0, says that s y . w(x) <= sqrt(V(x)) |P(G^T s y)|, for every x.
  static void judge_cuts(const Json& document, const Json& check) {
    const std::vector<Held> contacts = contacts_of(check);
    EXPECT_FALSE(document["cuts"].empty());
    for (const Json& cut : document["cuts"]) {
      if (cut.contains("n")) {
        EXPECT_EQ(keys(cut), (std::set<std::string>{"n"}));
        for (const Json& minimum : document["minima"])
          EXPECT_LE(vector(cut["n"]).dot(vector(minimum["up"])), 1e-9);
        continue;
      }
      EXPECT_EQ(keys(cut), (std::set<std::string>{"y", "load"}));
      ASSERT_EQ(cut["y"].size(), 6U);
      const std::size_t load = cut["load"];
      ASSERT_LT(load, check["loads"].size());
      const Json& object = check["loads"][load];
      Vector<3> v, omega;
      for (int k = 0; k < 3; ++k) {
        v[k] = cut["y"][static_cast<std::size_t>(k)];
        omega[k] = cut["y"][static_cast<std::size_t>(k) + 3];
      }
      double square = 0;  // of the projection of G^T y on the cones
      for (const Held& c : contacts) {
        const Vector<3> z = v + omega.cross(c.position);
        const double n = z.dot(c.normal), spin = omega.dot(c.normal) * c.torsion;
        const double t =
            std::hypot((z - n * c.normal).norm(), c.friction > 0 ? spin / c.friction : 0);
        square += t <= c.friction * n ? n * n + t * t
                                      : std::pow(std::max(0.0, n + c.friction * t), 2) /
                                            (1 + c.friction * c.friction);
      }
      for (const Json& minimum : document["minima"]) {
        const double known = check["loads"].size() > 1
                                 ? minimum["load_efforts"][load].get<double>()
                                 : minimum["effort"].get<double>();
        const Vector<3> up = vector(minimum["up"]), com = vector(object["com"]);
        const double weight = object["weight"], power = weight * up.dot(v + omega.cross(com));
        EXPECT_LE(power, std::sqrt(known * square) * (1 + 1e-9) + 1e-12 * v.norm());
      }
    }
  }
};

TEST_F(SpaceBest, IsWhatItClaims) {
  write("block.yaml", block);
  write("ball.yaml", ball);
  write("filled.yaml", filled);
  for (const std::string file : {"block.yaml", "ball.yaml", "filled.yaml"}) {
    const Json document = best(file);
    EXPECT_EQ(document["options"],
              Json::parse(
                  R"({"domain": "all", "force_cap": 1000000.0, "objective": "effort", "gap": 1e-06,
                              "max_holds": 2000, "orientation": {"w": 1, "x": 0, "y": 0, "z": 0}})"));
    // No posture that is asked for needs less.
    for (const std::string up : {"0,0,1", "1,0,0", "0,1,0", "-1,-1,1", "0.1,0.3,-1"}) {
      const Outcome hold = poise("hold " + file + " --json --up " + up);
      if (hold.status == 0) {
        EXPECT_GE(Json::parse(hold.out)["effort"], document["lower_bound"]) << file << " " << up;
      }
    }
  }
}

TEST_F(SpaceBest, StaysWithinTheTilt) {
  write("ball.yaml", ball + "tilt: {from: [1, 0, 0], max_deg: 30}\n");
  const Json file = best("ball.yaml");
  EXPECT_NEAR(file["options"]["tilt"]["max_deg"], 30, 1e-12);
  EXPECT_EQ(file["options"]["tilt"]["from"], Json::parse("[1.0, 0.0, 0.0]"));
  EXPECT_GE(vector(file["best"]["up"]).x(), std::cos(30 * degree) - 1e-9);
  // Flags override either part.
  const Json wider = best("ball.yaml", "--tilt-max 60");
  EXPECT_NEAR(wider["options"]["tilt"]["max_deg"], 60, 1e-12);
  EXPECT_LE(wider["lower_bound"], file["best"]["effort"]);
  EXPECT_LE(wider["best"]["effort"].get<double>(),
            file["best"]["effort"].get<double>() * (1 + 1e-6));
  const Json other = best("ball.yaml", "--tilt-from 0,0,2");
  EXPECT_GE(vector(other["best"]["up"]).z(), std::cos(30 * degree) - 1e-9);
}

TEST_F(SpaceBest, TurnsFromThePresentOrientation) {
  write("block.yaml", block);
  write("turned.yaml", block + "up: [0, 3, 4]\n");
  const Json plain = best("block.yaml");
  // Told by `up`, the posture is right, and the heading is the nearest to the world's.
  const Json turned = best("turned.yaml");
  const Eigen::Quaterniond now = quaternion(turned["options"]["orientation"]);
  EXPECT_LE((now * Vector<3>(0, 0.6, 0.8) - Vector<3>::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(now.z(), 0);
  // The flag overrides it, in any length.
  const Json flag = best("turned.yaml", "--orientation 0,2,0,0");
  EXPECT_EQ(flag["options"]["orientation"], Json::parse(R"({"w": 0, "x": 1, "y": 0, "z": 0})"));
  const std::string words = poise("best turned.yaml --orientation 0,2,0,0").out;
  EXPECT_NE(words.find("  (0.000, 0.000, -1.000)  grip "), words.npos) << words;
}

TEST_F(SpaceBest, TheForceCapAndTheGapAreAskedFor) {
  write("ball.yaml", ball);
  const Json rough = best("ball.yaml", "--gap 0.1 --max-holds 300 --force-cap 50");
  EXPECT_EQ(rough["options"]["gap"], 0.1);
  EXPECT_EQ(rough["options"]["max_holds"], 300);
  EXPECT_EQ(rough["options"]["force_cap"], 50.0);
  EXPECT_LE(rough["holds"], best("ball.yaml")["holds"]);
}

TEST_F(SpaceBest, TheUnholdableIsNullsAndProof) {
  write("slippery.yaml", slippery);
  const Json document = json("best slippery.yaml", 1);
  EXPECT_EQ(document["status"], "unholdable");
  for (const char* key :
       {"best", "best_pinched", "lower_bound", "relative_gap", "turn", "without_pressing_harder"})
    EXPECT_TRUE(document[key].is_null()) << key;
  EXPECT_EQ(document["minima"], Json::array());
  EXPECT_FALSE(document["cuts"].empty());
  const Outcome run = poise("best slippery.yaml");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.out.find("Cannot be held in any posture."), 0U) << run.out;
}

TEST_F(SpaceBest, WhatMaxNormalForbidsIsNamed) {
  // Three fingers below carry 10 N only if they press with more than 2 N each.
  std::string fingers;
  for (const char* at : {"[-0.05, 0.02, -0.05], normal: [0.7, 0, -0.7]",
                         "[0.05, 0.02, -0.05], normal: [-0.7, 0, -0.7]",
                         "[0, -0.03, -0.05], normal: [0, 0.7, -0.7]"})
    fingers += "  - {position: " + std::string(at) + ", friction: 0.5, max_normal: 2}\n";
  write("weak.yaml",
        "poise: 1\ndimension: 3\nobject: {weight: 10, com: [0, 0, 0]}\ncontacts:\n" + fingers);
  const Outcome run = poise("best weak.yaml");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.out.find("Only max_normal forbids it."), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("max_normal of 2"), std::string::npos) << run.out;
}

TEST_F(SpaceBest, ThePresentPostureIsAskedInAnyCase) {
  // Four fingers below, each of which may carry its quarter: nothing else holds.
  std::string fingers;
  for (const char* at : {"[-1, -1, -1]", "[1, -1, -1]", "[1, 1, -1]", "[-1, 1, -1]"})
    fingers += "  - {position: " + std::string(at) +
               ", normal: [0, 0, 1], friction: 0.3, max_normal: 0.25}\n";
  write("tray.yaml",
        "poise: 1\ndimension: 3\nup: [0, 0, 1]\nobject: {weight: 1, com: [0, 0, 0]}\ncontacts:\n" +
            fingers);
  const Json document = best("tray.yaml");
  EXPECT_NEAR(document["best"]["effort"], 4 * 0.25 * 0.25, 1e-9);
  EXPECT_EQ(document["turn"]["rotation"]["w"], 1.0);
}

TEST_F(SpaceBest, NothingFoundIsNotCalledUnholdable) {
  // It can be held, but not in the first posture that is tried.
  write("hanging.yaml",
        "poise: 1\n"
        "dimension: 3\n"
        "object: {weight: 10, com: [0, -1, 0]}\n"
        "contacts:\n"
        "  - {position: [1, 0.2, 0], normal: [0, -1, 0.1], friction: 0.1}\n"
        "  - {position: [-1, 0, 0.3], normal: [0.1, -1, 0], friction: 0.1}\n"
        "  - {position: [0, 0, -1], normal: [0, -1, 0], friction: 0.1}\n");
  EXPECT_EQ(poise("best hanging.yaml").status, 0);
  const Json document = json("best hanging.yaml --max-holds 1", 4);
  EXPECT_EQ(document["status"], "gap");
  EXPECT_TRUE(document["best"].is_null());
  EXPECT_TRUE(document["lower_bound"].is_number());
  const Outcome run = poise("best hanging.yaml --max-holds 1");
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.out.find("That there is none is not"), run.out.npos) << run.out;
}

TEST_F(SpaceBest, AGapThatIsLeftIsNamed) {
  write("ball.yaml", ball);
  const Json document = json("best ball.yaml --gap 1e-9 --max-holds 6");
  EXPECT_EQ(document["status"], "gap");
  EXPECT_GT(document["relative_gap"], 1e-9);
  EXPECT_LE(document["lower_bound"], document["best"]["effort"]);
  const Outcome run = poise("best ball.yaml --gap 1e-9 --max-holds 6");
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.out.find("Not proven: a gap of 1e-09 was wanted, after 6 holds it is"),
            run.out.npos)
      << run.out;
}

TEST_F(SpaceBest, PeopleSeeNewtonsTurnAndProof) {
  write("filled.yaml", filled + "up: [0, 0, 1]\n");
  const std::string out = poise("best filled.yaml").out;
  for (const char* words :
       {"  now ", "(0.000, 0.000, 1.000)  grip ", "  best ", "turn by", " about (", "Proven with",
        "a quaternion", "Forces at the best, against load", "decides",
        "Minima found, lowest first; there may be others"})
    EXPECT_NE(out.find(words), out.npos) << words << "\n" << out;
  EXPECT_EQ(out.find('\033'), out.npos);
}

TEST_F(SpaceBest, GivesTheAnswersThatTheExamplesTell) {
  fs::copy_file(POISE_EXAMPLES "/bottle.yaml", folder() / "bottle.yaml");
  const Json bottle = json("best bottle.yaml");
  EXPECT_NEAR(bottle["turn"]["rotation"]["angle_deg"], 86.00, 0.05);
  EXPECT_NEAR(bottle["best"]["load_grips"][0], bottle["best"]["load_grips"][1], 0.05);
  const std::string table = poise("best bottle.yaml").out;
  EXPECT_NE(table.find("(0.000, 0.000, 1.000)  grip 12.26 N"), table.npos) << table;
  EXPECT_NE(table.find("grip 9.880 N  pinched  turn by 86"), table.npos) << table;
  // What it would be if its filling were known.
  const std::string text = contents(folder() / "bottle.yaml");
  const std::size_t full = text.find("  - {name: full"), empty = text.find("  - {name: nearly"),
                    end = text.find("contacts:");
  write("full.yaml", std::string(text).erase(empty, end - empty));
  write("empty.yaml", std::string(text).erase(full, empty - full));
  const Json if_full = json("best full.yaml");
  EXPECT_NEAR(if_full["turn"]["rotation"]["angle_deg"], 73, 0.5);
  // On the other side.
  EXPECT_LT(vector(if_full["best"]["up"]).x() * vector(bottle["best"]["up"]).x(), 0);
  EXPECT_NEAR(json("best empty.yaml")["turn"]["rotation"]["angle_deg"], 3, 0.5);

  fs::copy_file(POISE_EXAMPLES "/box-three-fingers.yaml", folder() / "box.yaml");
  const Json box = json("best box.yaml");
  EXPECT_NEAR(box["turn"]["rotation"]["angle_deg"], 45, 1e-6);
  EXPECT_NEAR(box["best"]["grip"], 6.689, 0.0005);
  EXPECT_NEAR(json("hold box.yaml")["grip"], 9.429, 0.0005);

  fs::copy_file(POISE_EXAMPLES "/tray.yaml", folder() / "tray.yaml");
  const Json tray = json("best tray.yaml");
  EXPECT_NEAR(tray["turn"]["rotation"]["angle_deg"], 15, 1e-6);
  EXPECT_GT(vector(tray["best"]["up"]).y(), 0);  // as is the centre of mass
  EXPECT_NEAR(tray["best"]["grip"], 6.161, 0.0005);
  EXPECT_NEAR(json("hold tray.yaml")["grip"], 6.934, 0.0005);
  const std::string limited = contents(folder() / "tray.yaml");
  const std::size_t tilt = limited.find("tilt:");
  write("free.yaml", std::string(limited).erase(tilt, limited.find('\n', tilt) - tilt));
  const Json tilted = json("best free.yaml");
  EXPECT_NEAR(tilted["turn"]["rotation"]["angle_deg"], 65, 0.5);
  EXPECT_NEAR(tilted["best"]["grip"], 4.069, 0.0005);

  fs::copy_file(POISE_EXAMPLES "/cylinder-three-fingers.yaml", folder() / "cylinder.yaml");
  const Json cylinder = json("best cylinder.yaml"), upright = json("hold cylinder.yaml");
  EXPECT_NEAR(cylinder["best"]["grip"], 3.159, 0.0005);
  const Json resting = json("best cylinder.yaml --objective effort")["best"];
  EXPECT_NEAR(resting["force_norm"], 0.5 * 9.80665, 1e-6);
  EXPECT_EQ(resting["manner"], "resting");
  EXPECT_NEAR(upright["grip"], 0.5 * 9.80665 / 3 / 0.5, 1e-9);  // W / 3 by friction 0.5
  EXPECT_NEAR(upright["force_norm"], 6.330, 0.0005);

  for (const std::string jaws : {"hard", "soft"}) {
    fs::copy_file(POISE_EXAMPLES "/box-" + jaws + "-jaws.yaml", folder() / (jaws + ".yaml"));
    EXPECT_NEAR(json("best " + jaws + ".yaml")["best"]["grip"], 4.856, 0.0005);
  }
  EXPECT_FALSE(json("hold hard.yaml", 1)["holdable"]);
  EXPECT_NEAR(json("hold soft.yaml")["grip"], 6.934, 0.0005);
}

TEST_F(Space, RefusesFlagsOfTheOtherDimension) {
  write("block.yaml", block);
  write("plane.yaml",
        "poise: 1\ndimension: 2\nobject: {weight: 10, com: [0, 0]}\n"
        "contacts: [{position: [0, -1], normal: [0, 1], friction: 1}]\n");
  const struct {
    std::string arguments, words;
  } usages[] = {
      {"curve block.yaml", "curve: is for the plane, block.yaml is in space (dimension 3)"},
      {"hold block.yaml --angle 3", "--angle: is for the plane, block.yaml is in space"},
      {"hold block.yaml --up 1,0", "--up: has 2 numbers, must have 3: block.yaml is in space"},
      {"hold block.yaml --up 0,0,0", "--up: 0,0,0 has no direction"},
      {"best block.yaml --domain pinching-up", "--domain: pinching-up is for the plane"},
      {"best block.yaml --tilt-max 30", "--tilt-max: needs --tilt-from, or a tilt in block.yaml"},
      {"best block.yaml --tilt-from 0,0,1", "--tilt-from: needs --tilt-max, or a tilt in"},
      {"best block.yaml --tilt-from 0,0 --tilt-max 3", "--tilt-from: '0,0' is not a direction"},
      {"best block.yaml --tilt-from 0,0,0 --tilt-max 3", "--tilt-from: 0,0,0 has no direction"},
      {"best block.yaml --tilt-from 0,0,1 --tilt-max 91",
       "--tilt-max: '91' is not an angle from 0"},
      {"best block.yaml --orientation 1,0,0", "--orientation: '1,0,0' is not a quaternion"},
      {"best block.yaml --orientation 0,0,0,0", "--orientation: 0,0,0,0 has no length"},
      {"best block.yaml --gap 0", "--gap: '0' is not a part of the effort"},
      {"best block.yaml --gap 1", "--gap: '1' is not a part of the effort"},
      {"best block.yaml --max-holds 0", "--max-holds: '0' is not a number of holds"},
      {"best block.yaml --max-holds 2.5", "--max-holds: '2.5' is not a number of holds"},
      {"best plane.yaml --gap 0.1", "--gap: is for space, plane.yaml is in the plane"},
      {"best plane.yaml --max-holds 10", "--max-holds: is for space"},
      {"best plane.yaml --tilt-from 0,0,1", "--tilt-from: is for space"},
      {"best plane.yaml --tilt-max 10", "--tilt-max: is for space"},
      {"best plane.yaml --orientation 1,0,0,0", "--orientation: is for space"},
  };
  for (const auto& usage : usages) {
    const Outcome run = poise(usage.arguments);
    EXPECT_EQ(run.status, 2) << usage.arguments;
    EXPECT_EQ(run.out, "") << usage.arguments;
    EXPECT_EQ(run.err.find("poise: " + usage.words), 0U) << usage.arguments << ": " << run.err;
  }
  EXPECT_EQ(poise("best block.yaml --domain all").status, 0);
}

TEST_F(Space, ChecksSayWhatWasUnderstood) {
  write("filled.yaml", filled + "tilt: {from: [0, 0, 2], max_deg: 40}\nup: [0, 2, 0]\n");
  const Json check = json("check filled.yaml");
  EXPECT_EQ(keys(check), (std::set<std::string>{"poise_result", "command", "options", "name",
                                                "dimension", "safety", "up", "tilt", "loads",
                                                "shape", "contacts", "force_closure", "warnings"}));
  EXPECT_EQ(check["dimension"], 3);
  EXPECT_EQ(check["up"], Json::parse("[0.0, 1.0, 0.0]"));
  EXPECT_EQ(check["tilt"]["from"], Json::parse("[0.0, 0.0, 1.0]"));
  EXPECT_NEAR(check["tilt"]["max_deg"], 40, 1e-12);
  EXPECT_EQ(check["shape"]["sphere"]["radius"], 1.0);
  ASSERT_EQ(check["loads"].size(), 3U);
  EXPECT_EQ(check["loads"][1]["weight"], 6.0);
  EXPECT_EQ(check["contacts"][3]["finger"], "3");
  EXPECT_EQ(check["force_closure"], true);
  const Outcome run = poise("check filled.yaml");
  EXPECT_EQ(run.status, 0);
  for (const char* words : {"load 1", "sphere, radius 1.000 m", "with (0.000, 1.000, 0.000) up",
                            "at most 40.00° from (0.000, 0.000, 1.000)", "No warnings."})
    EXPECT_NE(run.out.find(words), run.out.npos) << words << "\n" << run.out;
}

/// A box in two pads.
const std::string jaws =
    "poise: 1\ndimension: 3\nlength_unit: mm\nup: [0, 0, 1]\n"
    "object: {density: 800, com: [0, 5, 0], shape: {mesh: part.obj}}\n"
    "gripper: {type: parallel_jaw, position: [0, 0, 10], opening: 60, pad: {width: 20, height: "
    "20},\n"
    "  friction: 0.5, samples: 4, max_force: 30}\n";

TEST_F(Space, ContactsOfAGripperAreAGraspFile) {
  // Edges of 40, 60 and 80 mm.
  std::string mesh;
  for (int k = 0; k < 8; ++k)
    mesh += std::string("v ") + (k & 1 ? "20 " : "-20 ") + (k & 2 ? "30 " : "-30 ") +
            (k & 4 ? "40\n" : "-40\n");
  mesh += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  fs::create_directories(folder() / "parts");
  fs::create_directories(folder() / "other");
  write("parts/part.obj", mesh);
  write("parts/jaws.yaml", jaws);
  const Json check = json("check parts/jaws.yaml");
  ASSERT_EQ(check["contacts"].size(), 2U);
  EXPECT_EQ(check["contacts"][0]["pad"]["points"].size(), 4U);
  EXPECT_NEAR(check["loads"][0]["weight"], 0.04 * 0.06 * 0.08 * 800 * standard_gravity, 1e-9);
  const Json now = json("hold parts/jaws.yaml");
  EXPECT_EQ(now["holdable"], true);
  for (const std::string out : {"here.yaml", "other/there.json"}) {
    const Outcome run = poise("contacts parts/jaws.yaml -o " + out);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "Wrote " + out + "\n");
    const Json again = json("check " + out);
    EXPECT_EQ(again["contacts"], check["contacts"]);
    EXPECT_EQ(again["loads"], check["loads"]);
    EXPECT_EQ(json("hold " + out), now);
  }
  const Outcome printed = poise("contacts parts/jaws.yaml");
  EXPECT_EQ(printed.out, contents(folder() / "here.yaml"));
  EXPECT_EQ(poise("contacts parts/none.yaml").status, 2);
  EXPECT_EQ(poise("contacts parts/jaws.yaml -o none/out.yaml").status, 2);
  // In the plane there are contacts, too.
  EXPECT_EQ(poise("contacts " + example("l-part")).status, 0);
}

TEST_F(Space, AMeshThatCannotBeUsedIsBadInput) {
  write("jaws.yaml", jaws);
  const Outcome run = poise("best jaws.yaml");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "poise: jaws.yaml:5:54: object.shape.mesh: part.obj does not exist\n");
}

TEST_F(Space, ExamplesWithMeshesAnswerAsTheyAreSaidTo) {
  struct Said {
    std::string example, command, answer;  ///< the words in its comment, and where they come from
    const char* part;
  };
  for (const auto& [name, command, words, part] :
       {Said{"mug-parallel-jaw", "hold", "4.69 N", ""},
        {"mug-parallel-jaw", "best", "1.71 N", "best"},
        {"drill-three-fingers", "hold", "25.64 N", ""},
        {"drill-three-fingers", "best", "10.37 N", "best"},
        {"bracket-parallel-jaw", "hold", "3.56 N", ""},
        {"bracket-parallel-jaw", "best", "1.84 N", "best"}}) {
    const std::string file = std::string(POISE_EXAMPLES) + "/" + name + ".yaml";
    EXPECT_NE(contents(file).find(" " + words), std::string::npos) << name << " " << words;
    const Outcome run = poise(command + " " + example(name) + " --json");
    EXPECT_EQ(run.status, 0) << run.err;
    const Json document = Json::parse(run.out), hold = *part ? document[part] : document;
    // With several loads the table has the grip of the one that presses hardest.
    if (!hold.contains("load")) {
      EXPECT_NEAR(hold["grip"], std::stod(words), 0.01) << name << " " << words;
    } else {
      const std::string table = poise(command + " " + example(name)).out;
      const std::string before = *part ? "grip " : "the grip to command is ";
      const std::size_t line = table.find(*part ? "  best " : before);
      const std::string number = table.substr(table.find(before, line) + before.size());
      EXPECT_NEAR(std::stod(number), std::stod(words), 0.01) << name << " " << words;
    }
    write("result.json", run.out);
    EXPECT_EQ(poise("verify " + example(name) + " result.json").status, 0) << name;
  }
  // The bracket's centre of mass, by its two legs: in neither of them.
  const Vector<3> com =
      vector(json("check " + example("bracket-parallel-jaw"))["loads"][0]["com"]);
  const double foot = 0.1 * 0.012, wall = 0.012 * 0.068;
  EXPECT_NEAR(com.x(), (foot * 0.05 + wall * 0.006) / (foot + wall), 1e-9);
  EXPECT_NEAR(com.z(), (foot * 0.006 + wall * 0.046) / (foot + wall), 1e-9);
  EXPECT_GT(std::min(com.x(), com.z()), 0.012);
}

TEST_F(Space, SmallMomentsAreShownWithTheirDigits) {
  // The com is 1 um beside the line between two soft fingers: each bears half of 1e-5 N m.
  write("soft.yaml",
        "poise: 1\ndimension: 3\nup: [0, 0, 1]\nobject: {weight: 10, com: [0, 1e-6, 0]}\n"
        "contacts:\n"
        "  - {position: [-1, 0, 0], normal: [1, 0, 0], friction: 0.8, torsion: 0.1}\n"
        "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 0.8, torsion: 0.1}\n");
  EXPECT_NE(poise("hold soft.yaml").out.find(" 0.000005000 "), std::string::npos);
}

}  // namespace
}  // namespace poise
