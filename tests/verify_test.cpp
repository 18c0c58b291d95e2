// The verifier confirms what is right and refutes what is not.
#include "verify/verify.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>

#include "poise/grip.hpp"
#include "poise/turn.hpp"
#include "random_grasps.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;
using test::Held;

PlanarFile file_of(const Held& held) {
  PlanarFile file;
  file.loads = {held.object};
  file.contacts = held.contacts;
  return file;
}

verify::Verdict checked(const GraspFile& file, const std::string& text) {
  return verify::verify(file, parse_json(text, "result.json", max_result));
}

/// Whether a document is neither refused nor refuted.
bool is_confirmed(const GraspFile& file, const std::string& text) {
  try {
    return checked(file, text).confirmed();
  } catch (const FileError&) {
    return false;
  }
}

/// What is refuted of a document.
std::string words(const GraspFile& file, const std::string& text) {
  return verify::refutations_text(checked(file, text));
}

HoldAnswer<2> hold_answer(const PlanarFile& file, double theta, double cap = 1e6) {
  const Vector<2> up = up_at(theta);
  return {.option = {.up = {up.x(), up.y()}},
          .settings = {cap},
          .posture = posture_at<2>(file.grasp(), up, {cap})};
}
BestAnswer<2> best_answer(const PlanarFile& file, const CurveSettings& settings = {}) {
  return {settings, best_posture(file.grasp(), settings)};
}
CurveAnswer curve_answer(const PlanarFile& file, const CurveSettings& settings = {}) {
  CurveAnswer answer{settings, posture_curve(file.grasp(), settings)};
  for (const Optimum& optimum : answer.curve.optima)
    answer.optima.push_back(minimum_at(file.grasp(), optimum, settings));
  return answer;
}

/// Of what the program asks of a file.
CurveSettings settings_for(const PlanarFile& file, Domain domain,
                           Objective objective = Objective::effort) {
  return {.domain = domain, .objective = objective, .present = file.angle.value_or(0)};
}

std::string hold_text(const PlanarFile& file, double theta, double cap = 1e6) {
  return document(file.grasp(), hold_answer(file, theta, cap));
}
std::string best_text(const PlanarFile& file, const CurveSettings& settings = {}) {
  return document(file.grasp(), best_answer(file, settings));
}
std::string curve_text(const PlanarFile& file, const CurveSettings& settings = {}) {
  return document(file.grasp(), curve_answer(file, settings));
}

/// Confirmed as values and as a document alike.
template <class Answer>
void expect_confirmed(const PlanarFile& file, const Answer& answer) {
  const Grasp<2> grasp = file.grasp();
  RC_ASSERT(verify::refutations_text(verify::verify(grasp, answer)) == "");
  RC_ASSERT(words(file, document(grasp, answer)) == "");
}

Domain any_domain() { return *rc::gen::element(Domain::all, Domain::pinching_up); }

/// Now and then with a posture to turn from.
PlanarFile any_file_of(const Held& held) {
  PlanarFile file = file_of(held);
  if (*rc::gen::inRange(0, 2) == 1)
    file.angle = std::max(*rc::gen::exec(test::random_angle), -3.0);  // in (-pi, pi]
  return file;
}

RC_GTEST_PROP(Verify, ConfirmsHolds, ()) {
  const Held held = *test::grasps();
  expect_confirmed(file_of(held),
                   hold_answer(file_of(held), std::abs(*rc::gen::exec(test::random_angle))));
}

RC_GTEST_PROP(Verify, ConfirmsCurves, ()) {
  const Held held = *test::grasps({.most_contacts = 5, .awkward = false});
  const PlanarFile file = any_file_of(held);
  expect_confirmed(file, curve_answer(file, settings_for(file, any_domain())));
}

RC_GTEST_PROP(Verify, ConfirmsTheBest, ()) {
  const Held held = *test::grasps({.most_contacts = 5, .awkward = false});
  const PlanarFile file = any_file_of(held);
  expect_confirmed(file, best_answer(file, settings_for(file, any_domain())));
}

/// Fingers with drives of their own, coupled ones, and now and then weak ones.
PlanarFile random_driven_file() {
  const Held held = *test::grasps({.most_contacts = 5, .awkward = false});
  PlanarFile file = any_file_of(held);
  if (*rc::gen::inRange(0, 3) == 0) file.mechanism.kind = DriveKind::coupled;
  if (*rc::gen::inRange(0, 3) != 0) return file;
  const bool same = *rc::gen::element(false, true);
  const double most = held.object.weight * *rc::gen::inRange(2, 30) / 10;
  const auto fingers = Grasp<2>(held.object, held.contacts).fingers();
  for (std::size_t k = 0; k < fingers.size(); ++k)
    file.mechanism.fingers.push_back(
        {.name = fingers[k], .max_force = most * (same ? 1 : 1 + static_cast<double>(k))});
  return file;
}

RC_GTEST_PROP(Verify, ConfirmsTheBestGrip, ()) {
  const PlanarFile file = random_driven_file();
  if (!has_grip<2>(file.grasp())) return;
  expect_confirmed(file, best_answer(file, settings_for(file, any_domain(), Objective::grip)));
}

RC_GTEST_PROP(Verify, ConfirmsCurvesOfTheGrip, ()) {
  const PlanarFile file = random_driven_file();
  if (!has_grip<2>(file.grasp())) return;
  expect_confirmed(file, curve_answer(file, settings_for(file, any_domain(), Objective::grip)));
}

RC_GTEST_PROP(Verify, ConfirmsTheNearlyUnholdable, ()) {
  const Held held = *test::nearly_unholdable();
  expect_confirmed(file_of(held), best_answer(file_of(held)));
  expect_confirmed(file_of(held), curve_answer(file_of(held)));
}

// Among degenerate grasps there are a few whose arcs are so steep that rounding spoils them.
TEST(Verify, RefutesFewOfTheAwkward) {
  int tried = 0, refuted = 0;
  rc::check([&] {
    const Held held = *test::grasps({.most_contacts = 5});
    const CurveSettings settings = settings_for(file_of(held), any_domain());
    const verify::Verdict verdict = checked(file_of(held), best_text(file_of(held), settings));
    ++tried;
    if (verdict.confirmed()) return;
    ++refuted;
    if (std::getenv("POISE_SHOW")) std::cerr << held << "\n" << refutations_text(verdict) << "\n";
  });
  EXPECT_GE(tried, 100);
  EXPECT_LE(refuted, tried / 400);
}

/// Keys below which nothing is claimed: proofs, which may be any that prove, what was asked for,
/// and what is stated for information.
bool claims_nothing(const std::string& key) {
  for (const char* word : {"dual", "y", "options", "residual", "poise_result", "cuts", "holds"})
    if (key == word) return true;
  return false;
}

/// Calls f for every number below `value` that carries a claim; `scale` is that of its list.
void for_each_claim(Json& value, const std::string& path, double scale,
                    const std::function<void(double&, const std::string&, double)>& f) {
  if (value.is_object()) {
    for (const auto& [key, part] : value.items())
      if (!claims_nothing(key)) for_each_claim(part, path + "." + key, 0, f);
  } else if (value.is_array()) {
    double largest = 0;
    for (const Json& part : value)
      if (part.is_number()) largest = std::max(largest, std::abs(part.get<double>()));
    for (std::size_t i = 0; i < value.size(); ++i)
      for_each_claim(value[i], path + "[" + std::to_string(i) + "]", largest, f);
  } else if (value.is_number()) {
    double number = value.get<double>();
    f(number, path, scale);
    value = number;
  }
}

/// Numbers that are zero but for rounding: compared with the others of their vector, or with
/// `zero`. Angles end where rounding puts them, within 2e-8 rad.
bool is_rounding(double number, const std::string& path, double scale, double weight) {
  if (path.ends_with("_deg") || path.find("_arcs_deg") != std::string::npos)
    return std::abs(number) < 0.2;
  if (path.find(".V.") != std::string::npos) return std::abs(number) < 1e-4 * weight * weight;
  if (path.ends_with("relative_gap")) return std::abs(number) < 1e-8;
  return std::abs(number) <= std::max(1e-3 * scale, 1e-6);
}

void expect_spoilt_refused(const GraspFile& file, const std::string& text, double weight) {
  ASSERT_EQ(words(file, text), "");
  int spoilt = 0;
  Json document = Json::parse(text);
  for_each_claim(document, "", 0, [&](double& number, const std::string& path, double scale) {
    if (is_rounding(number, path, scale, weight)) return;
    ++spoilt;
  });
  EXPECT_GT(spoilt, 5);
  for (int k = 0; k < spoilt; ++k) {
    Json copy = Json::parse(text);
    int at = 0;
    std::string where;
    for_each_claim(copy, "", 0, [&](double& number, const std::string& path, double scale) {
      if (is_rounding(number, path, scale, weight) || at++ != k) return;
      number *= 1 + 1e-5;
      where = path;
    });
    EXPECT_FALSE(is_confirmed(file, copy.dump())) << where;
  }
}

PlanarFile example(const std::string& name) {
  return std::get<PlanarFile>(read_grasp_file(POISE_EXAMPLES "/" + name + ".yaml"));
}

/// Nothing holds it: both fingers push the same way, beside the centre of mass.
PlanarFile not_to_be_held() {
  PlanarFile file;
  file.loads = {{10, {0, 1}}};
  file.contacts = {{{1, 0}, {0, 1}, 0.1}, {{1.5, 0}, {0, 1}, 0.1}};
  return file;
}

TEST(Verify, RefusesEveryNumberThatIsOff) {
  for (const char* name : {"ito-fig6", "l-part", "hexagon-three-fingers"}) {
    SCOPED_TRACE(name);
    const PlanarFile file = example(name);
    expect_spoilt_refused(file, hold_text(file, file.angle.value_or(0.3)), file.loads[0].weight);
    for (const Objective objective : {Objective::effort, Objective::grip}) {
      SCOPED_TRACE(to_string(objective));
      const CurveSettings all = settings_for(file, Domain::all, objective);
      expect_spoilt_refused(file, curve_text(file, all), file.loads[0].weight);
      expect_spoilt_refused(file, best_text(file, all), file.loads[0].weight);
    }
    const CurveSettings pinched = settings_for(file, Domain::pinching_up);
    expect_spoilt_refused(file, best_text(file, pinched), file.loads[0].weight);
  }
}

/// Carried, accelerated and pushed: each of the loads decides somewhere.
PlanarFile pushed() {
  PlanarFile file;
  file.loads = {{.weight = 10},
                {.weight = 6, .com = {0.01, 0}, .acceleration = {6, 0}},
                {.weight = 0, .fixed = {6, 1, 0}}};
  file.contacts = {{{-0.03, 0}, {1, 0}, 0.8}, {{0.03, 0}, {-1, 0}, 0.8}};
  return file;
}

/// Of fingers below that can hold none of the loads everywhere.
PlanarFile carried() {
  PlanarFile file = pushed();
  file.loads.pop_back();
  file.contacts = {{{-0.03, -0.02}, {0.5, 1}, 0.3}, {{0.03, -0.02}, {-0.3, 1}, 0.4}};
  return file;
}

RC_GTEST_PROP(Verify, ConfirmsSeveralLoadsInThePlane, ()) {
  PlanarFile file = random_driven_file();
  file.loads = *rc::gen::exec([] { return test::random_loads(4); });
  const Grasp<2> grasp = file.grasp();
  const bool is_grip = *rc::gen::element(true, false) || grasp.is_general();
  if (is_grip && !has_grip<2>(grasp)) return;
  const auto settings =
      settings_for(file, any_domain(), is_grip ? Objective::grip : Objective::effort);
  expect_confirmed(file, curve_answer(file, settings));
  expect_confirmed(file, best_answer(file, settings));
}

TEST(Verify, RefusesEveryNumberThatIsOffInCurvesOfSeveralLoads) {
  for (const PlanarFile& file : {pushed(), carried()})
    for (const Objective objective : {Objective::effort, Objective::grip}) {
      SCOPED_TRACE(to_string(objective));
      const CurveSettings settings{.objective = objective};
      expect_spoilt_refused(file, curve_text(file, settings), 10);
      expect_spoilt_refused(file, best_text(file, settings), 10);
    }
}

/// The true curve of one load, told as that of all.
TEST(Verify, RefusesACurveThatForgetsALoad) {
  for (const Objective objective : {Objective::effort, Objective::grip}) {
    const PlanarFile file = pushed();
    const CurveSettings settings{.objective = objective};
    const Json curve = Json::parse(curve_text(file, settings));
    EXPECT_EQ(words(file, curve.dump()), "");
    for (std::size_t k = 0; k < file.loads.size(); ++k) {
      const Json& all = curve["arcs"];
      if (std::all_of(all.begin(), all.end(), [&](const Json& arc) { return arc["load"] == k; }))
        continue;
      Json copy = curve;
      copy["arcs"] = copy["load_curves"][k]["arcs"];
      copy["holdable_arcs_deg"] = copy["load_curves"][k]["holdable_arcs_deg"];
      for (Json& arc : copy["arcs"]) arc["load"] = k;
      EXPECT_NE(words(file, copy.dump()).find("no load needs more along the arc"),
                std::string::npos);
    }
  }
}

TEST(Verify, RefusesCurvesOfLoadsThatAreMissingOrNotTheirs) {
  for (const PlanarFile& file : {pushed(), carried()}) {
    const Json best = Json::parse(best_text(file));
    EXPECT_EQ(words(file, best.dump()), "");
    Json copy = best;
    copy.erase("load_curves");
    EXPECT_FALSE(is_confirmed(file, copy.dump()));
    copy = best;
    std::swap(copy["load_curves"][0], copy["load_curves"][1]);
    EXPECT_FALSE(is_confirmed(file, copy.dump()));
    for (std::size_t k = 0; k < file.loads.size(); ++k)
      for (std::size_t i = 0; i < best["load_curves"][k]["arcs"].size(); ++i) {
        copy = best;
        copy["load_curves"][k]["arcs"].erase(i);
        EXPECT_FALSE(is_confirmed(file, copy.dump()));
      }
    for (const char* list : {"arcs", "unholdable_arcs"})
      for (std::size_t i = 0; i < best[list].size(); ++i) {
        copy = best;
        copy[list][i]["load"] = (copy[list][i]["load"].get<std::size_t>() + 1) % file.loads.size();
        // What cannot be held may be none of several loads, proven by one y.
        if (list == std::string("arcs")) EXPECT_FALSE(is_confirmed(file, copy.dump())) << i;
        copy[list][i].erase("load");
        EXPECT_FALSE(is_confirmed(file, copy.dump())) << list << i;
      }
  }
  EXPECT_FALSE(Json::parse(best_text(carried()))["unholdable_arcs"].empty());
}

/// What an arc of grip claims, changed as a whole: its forces, its proof, or where it ends.
TEST(Verify, RefusesArcsOfGripThatAreNot) {
  const PlanarFile file = example("l-part");
  const Json best = Json::parse(best_text(file, settings_for(file, Domain::all, Objective::grip)));
  ASSERT_EQ(words(file, best.dump()), "");
  ASSERT_GE(best["arcs"].size(), 3U);
  const double weight = file.loads[0].weight;
  const auto refuted = [&](const char* what, std::size_t k, const auto& change) {
    Json copy = best;
    change(copy["arcs"][k], copy["arcs"][(k + 1) % copy["arcs"].size()]);
    EXPECT_FALSE(is_confirmed(file, copy.dump())) << what << " " << k;
  };
  for (std::size_t k = 0; k < best["arcs"].size(); ++k) {
    refuted("F raised", k, [&](Json& arc, Json&) {
      arc["F"]["c0"] = arc["F"]["c0"].get<double>() + 1e-5 * weight;
    });
    refuted("forces dropped", k, [](Json& arc, Json&) { arc["forces"].erase(0); });
    refuted("no rates", k, [](Json& arc, Json&) { arc["rates"] = Json::array(); });
    refuted("rates that say less", k, [](Json& arc, Json&) {
      for (Json& rate : arc["rates"]) rate = 0.9 * rate.get<double>();
    });
    refuted("rates below 0", k, [](Json& arc, Json&) {
      arc["rates"][0] = arc["rates"][0].get<double>() + 1;
      arc["rates"][1] = arc["rates"][1].get<double>() - 1;
    });
    refuted("y of another", k, [](Json& arc, Json& other) { arc["y"] = other["y"]; });
    refuted("forces that do not balance", k, [](Json& arc, Json&) {
      Json& number = arc["forces"][0]["normal"]["cos1"];
      number = number.get<double>() + 1e-6;
    });
    refuted("wider", k, [](Json& arc, Json&) { arc["to_deg"] = arc["to_deg"].get<double>() + 1; });
    refuted("V in place of F", k, [](Json& arc, Json&) { arc.erase("F"); });
  }
}

TEST(Verify, RefusesNumbersOfWhatCannotBeHeld) {
  const PlanarFile file = not_to_be_held();
  for (const std::string& text : {hold_text(file, 1), best_text(file)})
    EXPECT_EQ(words(file, text), "");
  Json hold = Json::parse(hold_text(file, 1));
  hold["lower_bound"] = 0.99e14;  // (1e6 weights)^2 is 1e14
  EXPECT_FALSE(checked(file, hold.dump()).confirmed());
  hold = Json::parse(hold_text(file, 1));
  hold["angle_deg"] = hold["angle_deg"].get<double>() * (1 + 1e-5);
  EXPECT_FALSE(checked(file, hold.dump()).confirmed());
}

TEST(Verify, RefusesProofsThatDoNotProve) {
  const auto flip = [](Json& y) {
    for (Json& number : y) number = -number.get<double>();
  };
  const PlanarFile no = not_to_be_held();
  Json hold = Json::parse(hold_text(no, 1));
  flip(hold["dual"]);
  EXPECT_FALSE(checked(no, hold.dump()).confirmed());

  for (const PlanarFile& file : {no, example("hexagon-three-fingers")}) {
    const Json best = Json::parse(best_text(file));
    ASSERT_GT(best["unholdable_arcs"].size(), 0U);
    for (std::size_t k = 0; k < best["unholdable_arcs"].size(); ++k) {
      Json copy = best;
      flip(copy["unholdable_arcs"][k]["y"]);
      EXPECT_FALSE(checked(file, copy.dump()).confirmed()) << k;
      copy = best;
      copy["unholdable_arcs"].erase(k);
      EXPECT_FALSE(checked(file, copy.dump()).confirmed()) << k;
    }
  }
  const PlanarFile disk = example("ito-fig6");
  for (const std::string& text : {best_text(disk), curve_text(disk)}) {
    const Json document = Json::parse(text);
    for (std::size_t k = 0; k < document["arcs"].size(); ++k) {
      Json copy = document;
      copy["arcs"].erase(k);
      EXPECT_FALSE(checked(disk, copy.dump()).confirmed()) << k;
    }
    const char* list = document.contains("minima") ? "minima" : "optima";
    for (std::size_t k = 0; k < document[list].size(); ++k) {
      Json copy = document;
      copy[list].erase(k);
      EXPECT_FALSE(checked(disk, copy.dump()).confirmed()) << k;
    }
  }
}

/// A part on three fingers, one of them soft; it slips off unless it is nearly upright.
SpatialFile on_three_fingers(const std::string& tilt) {
  return std::get<SpatialFile>(grasp_from_yaml(
      "poise: 1\ndimension: 3\nobject: {weight: 10, com: [0.1, 0.05, 0.9]}\n" + tilt +
          "contacts:\n"
          "  - {position: [1, 0, 0], normal: [0, 0, 1], friction: 0.3}\n"
          "  - {position: [-0.5, 0.866, 0], normal: [0.1, 0, 1], friction: 0.3, torsion: 0.1}\n"
          "  - {position: [-0.5, -0.866, 0], normal: [0, 0, 1], friction: 0.3}\n",
      "three.yaml"));
}

std::string best_text(const SpatialFile& file, const Eigen::Quaterniond& orientation) {
  SpatialSettings settings;
  settings.tilt = file.tilt;
  BestAnswer<3> answer{settings, best_posture(file.grasp(), settings)};
  answer.orientation = orientation;
  return document(file.grasp(), answer);
}

std::string hold_text(const SpatialFile& file, const Vector<3>& up) {
  const HoldAnswer<3> answer{.option = {.up = {up.x(), up.y(), up.z()}},
                             .posture = posture_at(file.grasp(), up)};
  return document(file.grasp(), answer);
}

TEST(Verify, RefusesWhatIsOffInSpace) {
  const Eigen::Quaterniond lying(Eigen::AngleAxisd(1.2, Vector<3>(0.6, 0.64, 0.48)));
  const SpatialFile file = on_three_fingers("tilt: {from: [0.1, 0, 1], max_deg: 20}\n");
  const Vector<3> up = Vector<3>(0.1, 0.05, 1).normalized();
  expect_spoilt_refused(file, hold_text(file, up), 10);
  expect_spoilt_refused(file, best_text(file, lying), 10);
}

/// What is in it weighs more or less, and lies higher or lower; one finger is weak.
SpatialFile filled() {
  return std::get<SpatialFile>(grasp_from_yaml(
      "poise: 1\ndimension: 3\n"
      "object: {weight: 8, com: [0, 0, 0.2]}\n"
      "loads: [{name: full}, {weight: 3, com: [0.1, 0, -0.3]}]\n"
      "contacts:\n"
      "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 0.7, torsion: 0.2}\n"
      "  - {position: [-1, 0.1, 0], normal: [1, 0, 0], friction: 0.8, torsion: 0.2}\n"
      "  - {position: [0, -1, 0.1], normal: [0, 1, 0], friction: 0.5, max_normal: 4}\n",
      "filled.yaml"));
}

TEST(Verify, RefusesWhatIsOffWithLoadsAndLimits) {
  const SpatialFile file = filled();
  const Vector<3> up = Vector<3>(0.1, 0.05, 1).normalized();
  expect_spoilt_refused(file, hold_text(file, up), 3);
  const Eigen::Quaterniond lying(Eigen::AngleAxisd(1.2, Vector<3>(0.6, 0.64, 0.48)));
  expect_spoilt_refused(file, best_text(file, lying), 3);
}

TEST(Verify, RefusesLoadsThatAreNotProven) {
  const SpatialFile file = filled();
  const Vector<3> up = Vector<3>(0.1, 0.05, 1).normalized();
  const Json hold = Json::parse(hold_text(file, up));
  EXPECT_EQ(words(file, hold.dump()), "");
  const std::size_t decides = hold["load"].get<std::size_t>(), other = 1 - decides;
  ASSERT_TRUE(hold["load_holds"][other].is_object());
  Json copy = hold;  // the one that does not decide, as if it did
  copy.update(copy["load_holds"][other]);
  copy["load"] = other;
  copy["load_holds"][other] = nullptr;
  EXPECT_FALSE(checked(file, copy.dump()).confirmed());
  copy = hold;
  for (Json& number : copy["load_holds"][other]["dual"]) number = -number.get<double>();
  EXPECT_FALSE(checked(file, copy.dump()).confirmed());
}

TEST(Verify, RefusesThatNothingIsPinched) {
  const SpatialFile bottle = std::get<SpatialFile>(read_grasp_file(POISE_EXAMPLES "/bottle.yaml"));
  SpatialFile full = bottle;
  full.loads.resize(1);
  for (const SpatialFile& file : {filled(), full}) {
    const Json best = Json::parse(best_text(file, Eigen::Quaterniond::Identity()));
    EXPECT_EQ(words(file, best.dump()), "");
    ASSERT_TRUE(best["best_pinched"].is_object());
    Json copy = best;
    copy["best_pinched"] = nullptr;
    EXPECT_FALSE(checked(file, copy.dump()).confirmed());
  }
}

/// Each cut left out, and its proof turned round: most of them are needed.
void expect_cuts_needed(const SpatialFile& file, const char* status) {
  const Json best = Json::parse(best_text(file, Eigen::Quaterniond::Identity()));
  EXPECT_EQ(best["status"], status);
  EXPECT_EQ(words(file, best.dump()), "");
  int needed = 0, turned = 0;
  for (std::size_t k = 0; k < best["cuts"].size(); ++k) {
    Json copy = best;
    copy["cuts"].erase(k);
    needed += checked(file, copy.dump()).confirmed() ? 0 : 1;
    copy = best;
    for (Json& number : copy["cuts"][k].contains("y") ? copy["cuts"][k]["y"] : copy["cuts"][k]["n"])
      number = -number.get<double>();
    turned += checked(file, copy.dump()).confirmed() ? 0 : 1;
  }
  EXPECT_GE(needed, 2);
  EXPECT_GE(turned, 3);
}

TEST(Verify, RefusesCutsThatDoNotProve) {
  // Upright, but not so far tilted that all fingers carry the same, and upside down.
  expect_cuts_needed(on_three_fingers("tilt: {from: [0, 0, 1], max_deg: 3}\n"), "optimal");
  expect_cuts_needed(on_three_fingers("tilt: {from: [0, 0, -1], max_deg: 3}\n"), "unholdable");
  expect_cuts_needed(filled(), "optimal");
}

TEST(Verify, RefusesTheResultOfAnotherGrasp) {
  EXPECT_FALSE(checked(example("ito-fig6"), best_text(example("l-part"))).confirmed());
}

TEST(Verify, NamesWhatIsMissing) {
  const PlanarFile file = example("l-part");
  const auto problem = [&](const std::string& text) -> std::string {
    try {
      checked(file, text);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  Json best = Json::parse(best_text(file));
  best["unknown"] = {{"is", "not checked"}};
  EXPECT_NE(problem(best.dump()).find("unknown: is not a known key"), std::string::npos);
  best.erase("unknown");
  best["best"].erase("effort");
  EXPECT_NE(problem(best.dump()).find("best.effort: is missing, must be a number"),
            std::string::npos);
  EXPECT_EQ(problem("{\"poise_result\": 1,\n \"command\": 3}"),
            "result.json:2:13: command: is 3, must be check, hold, best, turn, curve, capacity or "
            "sturdiest");
  EXPECT_EQ(problem("[1]"), "result.json:1:1: is a list of 1, must be a mapping");
  EXPECT_EQ(problem("{\"a\": 1, \"a\": 2}"), "result.json:1:10: \"a\" is given twice");
  EXPECT_NE(problem("{\"poise_result\": 2}").find("must be 1"), std::string::npos);
  EXPECT_NE(problem("nonsense").find("result.json:1:1: a value expected"), std::string::npos);
}

}  // namespace
}  // namespace poise
