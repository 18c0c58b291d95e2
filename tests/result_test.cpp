// The JSON documents have exactly the keys that are promised, with the promised types.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "ask/document.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;
using Keys = std::set<std::string>;

const Keys unholdable_keys{"holdable",  "up",          "angle_deg", "dual",
                           "objective", "lower_bound", "reason"};
const Keys hold_keys{"objective", "grip",   "drives",      "holdable", "up",
                     "angle_deg", "dual",   "lower_bound", "effort",   "force_norm",
                     "residual",  "manner", "all_loaded",  "fingers",  "contacts"};
const Keys document_keys{"poise_result", "command", "options"};

Keys with(Keys keys, const Keys& more) {
  keys.insert(more.begin(), more.end());
  return keys;
}

Keys keys(const Json& object) {
  Keys result;
  for (const auto& item : object.items()) result.insert(item.key());
  return result;
}

/// No number of a document is -0.
void check_numbers(const Json& value) {
  if (value.is_number_float()) {
    EXPECT_FALSE(std::signbit(value.get<double>()) && value.get<double>() == 0);
  }
  if (value.is_structured())
    for (const auto& part : value) check_numbers(part);
}

Json parsed(const std::string& text) {
  EXPECT_EQ(text.back(), '\n');
  const Json document = Json::parse(text);
  EXPECT_EQ(document["poise_result"], 1);
  check_numbers(document);
  return document;
}

void check_hold(const Json& hold, std::size_t contacts, std::size_t fingers) {
  EXPECT_TRUE(hold["holdable"].is_boolean());
  EXPECT_EQ(hold["up"].size(), 2U);
  EXPECT_EQ(hold["dual"].size(), 3U);
  EXPECT_GT(hold["angle_deg"].get<double>(), -180);
  EXPECT_LE(hold["angle_deg"].get<double>(), 180);
  EXPECT_TRUE(hold["lower_bound"].is_number());
  if (!hold["holdable"].get<bool>()) {
    EXPECT_TRUE(hold["reason"].is_string());
    return;
  }
  for (const char* key : {"effort", "force_norm", "residual"})
    EXPECT_TRUE(hold[key].is_number_float()) << key;
  EXPECT_TRUE(hold["all_loaded"].is_boolean());
  EXPECT_TRUE((std::set<std::string>{"resting", "cradled", "pinched"}.count(hold["manner"])));
  ASSERT_EQ(hold["fingers"].size(), fingers);
  for (const Json& finger : hold["fingers"]) {
    EXPECT_EQ(keys(finger), (Keys{"finger", "normal_force", "pressing_force", "force"}));
    EXPECT_TRUE(finger["finger"].is_string());
    EXPECT_EQ(finger["force"].size(), 2U);
  }
  ASSERT_EQ(hold["contacts"].size(), contacts);
  for (const Json& contact : hold["contacts"]) {
    EXPECT_EQ(keys(contact), (Keys{"finger", "friction_used", "normal_force", "tangential_force",
                                   "force", "state", "limit"}));
    EXPECT_TRUE(
        (std::set<std::string>{"unloaded", "sticking", "slipping"}.count(contact["state"])));
    EXPECT_TRUE((std::set<std::string>{"none", "min", "max"}.count(contact["limit"])));
  }
}

void check_arcs(const Json& arcs, std::size_t contacts) {
  for (const Json& arc : arcs) {
    EXPECT_EQ(keys(arc), (Keys{"from_deg", "to_deg", "V", "y", "states"}));
    EXPECT_EQ(keys(arc["V"]), (Keys{"c0", "cos1", "sin1", "cos2", "sin2"}));
    EXPECT_EQ(keys(arc["y"]), (Keys{"c0", "cos1", "sin1"}));
    for (const Json& part : arc["y"]) EXPECT_EQ(part.size(), 3U);
    ASSERT_EQ(arc["states"].size(), contacts);
    for (const Json& state : arc["states"]) EXPECT_EQ(keys(state), (Keys{"state", "limit"}));
  }
}

/// A disk of radius 1 and weight 10 between two fingers at +-phi from +y.
Grasp<2> disk(double phi, double mu_1, double mu_2) {
  const Vector<2> right(std::sin(phi), std::cos(phi)), left(-right.x(), right.y());
  return Grasp<2>({.weight = 10}, {{.position = right, .normal = -right, .friction = mu_1},
                                   {.position = left, .normal = -left, .friction = mu_2}});
}

/// A disk in three fingers that must keep touching and must not press too hard; one has two
/// contacts.
Grasp<2> limited_disk() {
  std::vector<Contact<2>> contacts;
  const char* const names[] = {"index", "middle", "thumb", "thumb"};
  const double angles[] = {0.5, 2.5, 4.6, 4.8};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector<2> out(std::cos(angles[i]), std::sin(angles[i]));
    contacts.push_back({.position = out,
                        .normal = -out,
                        .friction = 0.5,
                        .min_normal = 1,
                        .max_normal = 6,
                        .share = i < 2 ? 1 : 0.5,
                        .finger = names[i]});
  }
  return Grasp<2>({.weight = 10}, contacts);
}

using std::numbers::pi;

HoldAnswer<2> held_at(const Grasp<2>& grasp, double theta, const HoldSettings& settings = {}) {
  return {.settings = settings, .posture = posture_at<2>(grasp, up_at(theta), settings)};
}

std::string best_text(const Grasp<2>& grasp, const CurveSettings& settings = {}) {
  return document(grasp, BestAnswer<2>{settings, best_posture(grasp, settings)});
}

TEST(ResultDocument, OfAHoldHasThePromisedKeys) {
  const Grasp<2> grasp = disk(5 * pi / 12, 1, 1 / std::sqrt(3.0));
  HoldAnswer<2> answer = held_at(grasp, pi / 6);
  answer.option.angle_deg = 30;
  const Json document = parsed(poise::document(grasp, answer));
  EXPECT_EQ(keys(document), with(document_keys, hold_keys));
  EXPECT_EQ(document["command"], "hold");
  EXPECT_EQ(document["options"],
            (Json{{"force_cap", 1e6}, {"objective", "effort"}, {"angle_deg", 30.0}}));
  EXPECT_EQ(document["angle_deg"], 30.0);
  EXPECT_NEAR(document["effort"], 300, 1e-9);
  EXPECT_EQ(document["fingers"][0]["finger"], "0");
  check_hold(document, 2, 2);
}

TEST(ResultDocument, OfAHoldEchoesWhatWasAskedFor) {
  const Grasp<2> grasp = disk(1, 1, 1);
  const Json plain = parsed(document(grasp, held_at(grasp, 0, {.force_cap = 50})));
  EXPECT_EQ(plain["options"], (Json{{"force_cap", 50.0}, {"objective", "effort"}}));
  HoldAnswer<2> answer = held_at(grasp, -0.0);
  answer.option.up = {-0.0, 2.0};
  const Json up = parsed(document(grasp, answer));
  EXPECT_EQ(up["options"], (Json{{"force_cap", 1e6}, {"objective", "effort"}, {"up", {0.0, 2.0}}}));
}

TEST(ResultDocument, OfAHoldThatIsNoneHasItsReason) {
  const Grasp<2> grasp = disk(pi / 4, 1, 1);
  const Json document = parsed(poise::document(grasp, held_at(grasp, 0.3)));
  EXPECT_EQ(keys(document), with(document_keys, unholdable_keys));
  EXPECT_EQ(document["holdable"], false);
  EXPECT_GT(document["lower_bound"], 1e12 * 100);
  check_hold(document, 2, 2);
}

TEST(ResultDocument, OfTheBestPostureHasThePromisedKeys) {
  const Keys best_keys{"status",
                       "best",
                       "best_pinched",
                       "minima",
                       "lower_bound",
                       "relative_gap",
                       "turn",
                       "worst",
                       "without_pressing_harder",
                       "arcs",
                       "unholdable_arcs",
                       "holdable_arcs_deg"};
  for (const Grasp<2>& grasp : {disk(5 * pi / 12, 1, 1 / std::sqrt(3.0)), limited_disk()}) {
    const std::size_t contacts = grasp.contacts().size(), fingers = grasp.fingers().size();
    for (const Domain domain : {Domain::all, Domain::pinching_up}) {
      const CurveSettings settings{.domain = domain};
      const Json document = parsed(best_text(grasp, settings));
      EXPECT_EQ(keys(document), with(document_keys, best_keys));
      EXPECT_EQ(document["options"],
                (Json{{"domain", domain == Domain::all ? "all" : "pinching-up"},
                      {"present_deg", 0.0},
                      {"force_cap", 1e6},
                      {"objective", "effort"}}));
      EXPECT_EQ(document["status"], "optimal");
      EXPECT_EQ(document["best"], document["minima"][0]);
      EXPECT_LT(std::abs(document["relative_gap"].get<double>()), 1e-9);
      for (const Json& minimum : document["minima"]) {
        Keys expected = with(hold_keys, {"kind"});
        if (minimum.contains("edges_meet")) {
          expected.insert("edges_meet");
          EXPECT_EQ(minimum["kind"], "kink");
        }
        if (minimum.contains("from_deg")) expected = with(expected, {"from_deg", "to_deg"});
        EXPECT_EQ(keys(minimum), expected);
        check_hold(minimum, contacts, fingers);
      }
      check_hold(document["worst"], contacts, fingers);
      check_arcs(document["arcs"], contacts);
      for (const Json& arc : document["unholdable_arcs"]) {
        EXPECT_EQ(keys(arc), (Keys{"from_deg", "to_deg", "y"}));
        EXPECT_EQ(arc["y"].size(), 3U);
      }
      for (const Json& arc : document["holdable_arcs_deg"]) {
        ASSERT_EQ(arc.size(), 2U);
        EXPECT_GE(arc[0], -180);
        EXPECT_LT(arc[0], 180);
        EXPECT_LE(arc[0], arc[1]);
      }
    }
  }
}

TEST(ResultDocument, OfAKinkBetweenTwoSlippingContactsSaysWhereTheirEdgesMeet) {
  const Grasp<2> grasp = disk(5 * pi / 12, 1, 1 / std::sqrt(3.0));
  const Json document = parsed(best_text(grasp));
  const Json& meet = document["best_pinched"]["edges_meet"];
  ASSERT_EQ(meet.size(), 2U);
  EXPECT_NEAR(std::atan2(meet[0].get<double>(), meet[1].get<double>()), pi / 6, 1e-12);
}

TEST(ResultDocument, OfAnObjectThatCannotBeHeldIsNullsAndProof) {
  // Both fingers push the same way, beside the centre of mass.
  const Grasp<2> grasp({.weight = 10, .com = {0, 1}},
                       {{.position = {1, 0}, .normal = {0, 1}, .friction = 0.1},
                        {.position = {1.5, 0}, .normal = {0, 1}, .friction = 0.1}});
  const Json document = parsed(best_text(grasp));
  EXPECT_EQ(document["status"], "unholdable");
  for (const char* key : {"best", "best_pinched", "worst", "lower_bound", "relative_gap"})
    EXPECT_TRUE(document[key].is_null()) << key;
  for (const char* key : {"minima", "arcs", "holdable_arcs_deg"})
    EXPECT_EQ(document[key], Json::array()) << key;
  EXPECT_FALSE(document["unholdable_arcs"].empty());
}

TEST(ResultDocument, OfTheCurveHasThePromisedKeys) {
  for (const Grasp<2>& grasp : {disk(5 * pi / 12, 1, 1 / std::sqrt(3.0)), limited_disk()}) {
    CurveAnswer answer{{}, posture_curve(grasp)};
    for (const Optimum& optimum : answer.curve.optima)
      answer.optima.push_back(minimum_at(grasp, optimum));
    const Json document = parsed(poise::document(grasp, answer));
    EXPECT_EQ(keys(document), with(document_keys, {"optima", "arcs", "holdable_arcs_deg"}));
    EXPECT_EQ(document["command"], "curve");
    check_arcs(document["arcs"], grasp.contacts().size());
    for (const Json& optimum : document["optima"]) {
      EXPECT_TRUE(optimum["type"] == "min" || optimum["type"] == "max");
      check_hold(optimum, grasp.contacts().size(), grasp.fingers().size());
    }
  }
}

TEST(ResultDocument, OfACheckSaysWhatWasUnderstood) {
  const PlanarFile file = std::get<PlanarFile>(grasp_from_json(R"({
    "poise": 1, "dimension": 2, "name": "part", "safety": 2, "length_unit": "mm",
    "object": {"mass": 1, "shape": {"ellipse": {"radii": [30, 20]}}},
    "contacts": [{"position": [30, 0], "friction": 4, "max_normal": 20},
                 {"position": [-30, 0], "friction": 0.5, "finger": "thumb"}]})",
                                                               "f.json"));
  const Grasp<2> grasp = file.grasp();
  const Json document =
      parsed(poise::document(file, grasp, CheckAnswer<2>{force_closure(grasp), {}}));
  EXPECT_EQ(keys(document), with(document_keys, {"name", "dimension", "safety", "angle_deg",
                                                 "domain", "loads", "shape", "contacts",
                                                 "force_closure", "fork_deg", "warnings"}));
  ASSERT_EQ(document["loads"].size(), 1U);
  EXPECT_EQ(document["loads"][0]["weight"], standard_gravity);
  EXPECT_EQ(document["loads"][0]["lift"], 0.0);
  EXPECT_TRUE(document["angle_deg"].is_null());
  EXPECT_EQ(document["contacts"][0]["friction"], 2.0);
  EXPECT_EQ(document["contacts"][0]["max_normal"], 20.0);
  EXPECT_TRUE(document["contacts"][1]["max_normal"].is_null());
  EXPECT_EQ(document["contacts"][1]["finger"], "thumb");
  EXPECT_EQ(document["shape"]["ellipse"]["radii"].size(), 2U);
  EXPECT_EQ(document["force_closure"], true);
  EXPECT_EQ(document["warnings"].size(), 1U);
}

TEST(ResultDocument, IsWrittenInReadableLines) {
  const Grasp<2> grasp = limited_disk();
  const std::string text = best_text(grasp);
  std::size_t longest = 0, from = 0;
  for (std::size_t at = 0; (at = text.find('\n', from)) != std::string::npos; from = at + 1)
    longest = std::max(longest, at - from);
  EXPECT_LE(longest, 140U);
  EXPECT_EQ(Json::parse(text).dump(), Json::parse(Json::parse(text).dump(1)).dump());
}

}  // namespace
}  // namespace poise
