// False results that were once confirmed, made from true ones.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ask/ask.hpp"
#include "ask/document.hpp"
#include "verify/verify.hpp"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

GraspFile example(const std::string& name) {
  return read_grasp_file(POISE_EXAMPLES "/" + name + ".yaml");
}

Json result_of(const GraspFile& file, const Question& question) {
  return std::visit(
      [&]<class File>(const File& own) {
        constexpr int Dim = std::is_same_v<File, PlanarFile> ? 2 : 3;
        const Grasp<Dim> grasp = own.grasp();
        return Json::parse(document<Dim>(own, grasp, ask(own, grasp, question)));
      },
      file);
}

/// What is refuted, or why the document is refused; empty where all is confirmed.
std::string problem(const GraspFile& file, const Json& result) {
  try {
    return refutations_text(
        verify::verify(file, parse_json(result.dump(), "result.json", max_result)));
  } catch (const FileError& error) {
    return error.what();
  }
}

void expect_refuted(const GraspFile& file, const Json& result, const std::string& by) {
  EXPECT_NE(problem(file, result).find(by), std::string::npos) << problem(file, result);
}

/// The box between two jaws on its side, pressed harder by s, and a longer dual: the box turning
/// about the line through both contacts, which does no work.
Json squeezed(const GraspFile& box, double s, double turning) {
  Json result =
      result_of(box, {.command = Command::hold, .up = {1, 0, 0}, .objective = Objective::effort});
  double effort = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    Json &contact = result["contacts"][i], &finger = result["fingers"][i];
    const double n = contact["normal_force"].get<double>() + s;
    const double t = contact["tangential_force"], y = contact["force"][1];
    contact["normal_force"] = finger["normal_force"] = n;
    contact["force"][1] = finger["force"][1] = y < 0 ? -n : n;
    contact["friction_used"] = t / (0.4 * n);
    if (s > 0) contact["state"] = "sticking";
    effort += n * n + t * t;
  }
  result["effort"] = result["lower_bound"] = effort;
  result["force_norm"] = std::sqrt(effort);
  const Vector<3> omega(0, turning, 0), v = -omega.cross(Vector<3>(-0.01, 0, 0));
  for (std::size_t k = 0; k < 3; ++k) {
    result["dual"][k] = result["dual"][k].get<double>() + v[static_cast<Eigen::Index>(k)];
    result["dual"][k + 3] =
        result["dual"][k + 3].get<double>() + omega[static_cast<Eigen::Index>(k)];
  }
  return result;
}

TEST(ForgedResults, AreNotLeastByALongDual) {
  const GraspFile box = example("box-hard-jaws");
  EXPECT_EQ(problem(box, squeezed(box, 0, 0)), "");
  for (const double turning : {0.0, 1e6, 1e12, 1e22})
    expect_refuted(box, squeezed(box, 1000, turning), "lower_bound is what dual proves");
}

TEST(ForgedResults, AreNotHeldByForcesBeyondAnyCap) {
  const GraspFile box = example("box-hard-jaws");
  Json result = squeezed(box, 1e20, 0);
  result["up"] = result["options"]["up"] = {0, 0, 1};
  for (const double cap : {1e30, 1e9}) {
    result["options"]["force_cap"] = cap;
    EXPECT_NE(problem(box, result), "") << cap;
  }
}

TEST(ForgedResults, HaveOptionsThatTheProgramTakes) {
  const GraspFile part = example("l-part"), box = example("box-three-fingers");
  const Json hold = result_of(part, {.command = Command::hold});
  const Json best = result_of(box, {.command = Command::best});
  EXPECT_EQ(problem(part, hold) + problem(box, best), "");
  for (const double cap : {0.0, -1e-3, 1e10, 1e30}) {
    Json forged = hold;
    forged["options"]["force_cap"] = cap;
    expect_refuted(part, forged, "force_cap is above 0 and at most 1e9");
    forged = best;
    forged["options"]["force_cap"] = cap;
    expect_refuted(box, forged, "force_cap is above 0 and at most 1e9");
  }
  for (const double gap : {0.0, 1.0, 5.0, -1.0}) {
    Json forged = best;
    forged["options"]["gap"] = gap;
    expect_refuted(box, forged, "gap is above 0 and below 1");
  }
  for (const double holds : {0.0, 1e7}) {
    Json forged = best;
    forged["options"]["max_holds"] = holds;
    expect_refuted(box, forged, "max_holds is from 1 to 1000000");
  }
  for (const Json& tilt :
       {Json{{"from", {0, 0, 1}}, {"max_deg", 91}}, Json{{"from", {0, 0, 1}}, {"max_deg", -1}},
        Json{{"from", {0, 0, 2}}, {"max_deg", 10}}}) {
    Json forged = best;
    forged["options"]["tilt"] = tilt;
    expect_refuted(box, forged, "tilt is from a unit vector");
  }
  Json forged = best;
  forged["options"]["orientation"] = {{"w", 2}, {"x", 0}, {"y", 0}, {"z", 0}};
  expect_refuted(box, forged, "orientation is a quaternion of length 1");
  forged = best;
  forged["options"]["safety"] = 2;
  expect_refuted(box, forged, "safety is an option of the command");
  forged = best;
  forged["options"]["domain"] = "pinching-up";
  expect_refuted(box, forged, "domain is all in space");
}

TEST(ForgedResults, DoNotCutAwayTheOnePostureAllowed) {
  const GraspFile box = example("box-three-fingers");
  Json result = result_of(
      box, {.command = Command::best, .tilt_from = Vector<3>(0, 0, 1), .tilt_max_deg = 0});
  EXPECT_EQ(result["status"], "optimal");
  EXPECT_EQ(problem(box, result), "");
  for (const char* key :
       {"best", "best_pinched", "lower_bound", "relative_gap", "turn", "without_pressing_harder"})
    result[key] = nullptr;
  result["status"] = "unholdable";
  result["minima"] = Json::array();
  for (const double off : {9e-10, 1e-12, 0.0}) {
    result["cuts"] = {{{"n", {1, 0, off}}},
                      {{"n", {-1, 0, off}}},
                      {{"n", {0, 1, off}}},
                      {{"n", {0, -1, off}}},
                      {{"n", {0, 0, -1}}}};
    expect_refuted(box, result, "cuts prove that the force cap is not enough");
  }
}

TEST(ForgedResults, AreOfThePostureAskedFor) {
  const GraspFile part = example("l-part");
  for (const Command command : {Command::hold, Command::capacity}) {
    Json result = result_of(part, {.command = command, .angle_deg = 10});
    EXPECT_EQ(problem(part, result), "");
    result["options"]["angle_deg"] = 0;
    expect_refuted(part, result, "up is the posture asked for");
    result["options"].erase("angle_deg");
    EXPECT_NE(problem(part, result), "");
  }
}

TEST(ForgedResults, SayHowWellTheyBalance) {
  const GraspFile part = example("l-part");
  Json result = result_of(part, {.command = Command::hold});
  for (const double residual : {1e9, -5.0, 1e-9}) {
    result["residual"] = residual;
    expect_refuted(part, result, "residual is the error of the balance");
  }
}

TEST(ForgedResults, HideNoPostureUnderNarrowArcs) {
  const GraspFile slim = grasp_from_yaml(
      "poise: 1\ndimension: 2\nobject: {weight: 10, com: [0, 0]}\ncontacts:\n"
      "  - {position: [-0.1, -0.1], normal: [0, 1], friction: 0.0005}\n"
      "  - {position: [0.1, -0.1], normal: [0, 1], friction: 0.0005}\n",
      "slim.yaml");
  const Json result = result_of(slim, {.command = Command::best});
  EXPECT_EQ(result["status"], "optimal");
  EXPECT_EQ(problem(slim, result), "");
  double from = 180, to = -180;
  for (const Json& arc : result["arcs"]) {
    from = std::min(from, arc["from_deg"].get<double>());
    to = std::max(to, arc["to_deg"].get<double>());
  }
  Json forged = result;
  for (const char* key : {"best", "best_pinched", "lower_bound", "relative_gap", "worst"})
    forged[key] = nullptr;
  for (const char* key : {"minima", "arcs", "holdable_arcs_deg"}) forged[key] = Json::array();
  forged["status"] = "unholdable";
  for (const double width : {3.9e-8, 1e-9 * (to - from), 1e-4}) {
    Json hidden = forged;
    const double step = std::max(width * 180 / std::numbers::pi, (to - from) / 30000);
    for (double at = from; at < to; at += step)
      hidden["unholdable_arcs"].push_back(
          {{"from_deg", at}, {"to_deg", std::min(at + step, to)}, {"y", {0, 0, 0}}});
    EXPECT_NE(problem(slim, hidden), "") << width;
  }
  forged = result;  // one holdable interval over all the circle, of arcs that nobody looks at
  forged["unholdable_arcs"] = Json::array();
  forged["holdable_arcs_deg"] = {{-180, 180}};
  for (double at = to; at < from + 0.05; at += 1e-6)
    forged["arcs"].push_back(Json(forged["arcs"][0]));
  EXPECT_NE(problem(slim, forged), "");
}

/// A plate that hangs beside the two pads which hold it.
GraspFile plate() {
  return grasp_from_yaml(
      "poise: 1\ndimension: 3\nobject: {weight: 10, com: [0.01, 0, -0.005]}\n"
      "drives: coupled\ncontacts:\n"
      "  - {position: [0, -0.01, 0], normal: [0, 1, 0], friction: 0.5, pad: {size: [0.02, 0.02],"
      " axis: [1, 0, 0], grid: 3}}\n"
      "  - {position: [0, 0.01, 0], normal: [0, -1, 0], friction: 0.6, pad: {size: [0.02, 0.02],"
      " axis: [1, 0, 0], grid: 3}}\n",
      "plate.yaml");
}

TEST(ForgedResults, OfPadsTellWhatEachPointCarries) {
  const GraspFile file = plate();
  for (const Objective objective : {Objective::grip, Objective::effort}) {
    const Json hold = result_of(
        file, {.command = Command::hold, .up = {0.3, 0.2, 0.933}, .objective = objective});
    EXPECT_EQ(problem(file, hold), "");
    const auto refuted = [&](const char* what, const auto& change) {
      Json forged = hold;
      change(forged);
      EXPECT_NE(problem(file, forged), "") << to_string(objective) << ": " << what;
    };
    const auto times = [](Json& number, double factor) { number = factor * number.get<double>(); };
    refuted("a point carries more", [&](Json& forged) {
      for (Json& number : forged["contacts"][0]["point_forces"][4]) times(number, 1.001);
    });
    refuted("points change places", [&](Json& forged) {
      Json& points = forged["contacts"][0]["point_forces"];
      std::swap(points[0], points[8]);
    });
    refuted("all points carry more", [&](Json& forged) {
      for (Json& point : forged["contacts"][1]["point_forces"])
        for (Json& number : point) times(number, 1.001);
    });
    refuted("a point is missing",
            [&](Json& forged) { forged["contacts"][0]["point_forces"].erase(0); });
    refuted("no points", [&](Json& forged) { forged["contacts"][0].erase("point_forces"); });
    refuted("the centre of pressure is elsewhere", [&](Json& forged) {
      Json& x = forged["contacts"][0]["center_of_pressure"][0];
      x = x.get<double>() + 1e-6;
    });
    refuted("a moment about the normal",
            [&](Json& forged) { times(forged["contacts"][0]["torsion_moment"], 1.001); });
    refuted("less friction",
            [&](Json& forged) { times(forged["contacts"][0]["friction_used"], 0.99); });
    refuted("another proof", [&](Json& forged) {
      Json& y = forged[objective == Objective::grip ? "y" : "dual"];
      for (Json& number : y) times(number, 1.1);
    });
    refuted("a lower bound", [&](Json& forged) { times(forged["lower_bound"], 1.001); });
  }
  const Json best = result_of(file, {.command = Command::best, .objective = Objective::grip});
  EXPECT_EQ(problem(file, best), "");
  Json forged = best;
  for (Json& cut : forged["cuts"])
    if (cut.contains("rates"))
      for (Json& rate : cut["rates"]) rate = 0.9 * rate.get<double>();
  EXPECT_NE(problem(file, forged), "");
}

/// What a gripper can hold, each number changed by itself and with what belongs to it.
TEST(ForgedResults, HoldNoMoreAndNoLessThanTheyCan) {
  const GraspFile file = example("hexagon-three-fingers");
  const Json result = result_of(file, {.command = Command::capacity, .angle_deg = 90});
  EXPECT_EQ(problem(file, result), "");
  Json hold = result_of(file, {.command = Command::hold, .angle_deg = 90});
  for (const char* key : {"poise_result", "command", "options"}) hold.erase(key);
  const auto refuted = [&](const char* what, const auto& change) {
    Json forged = result;
    change(forged["capacities"][0]["weight"], forged["capacities"][0]["friction"]);
    EXPECT_NE(problem(file, forged), "") << what;
  };
  refuted("the given weight is the greatest", [&](Json& weight, Json&) {
    weight["greatest"] = weight["given"];
    weight["greatest_hold"] = hold;
  });
  refuted("no weight can be held", [](Json& weight, Json&) {
    weight["holdable"] = false;
    for (const char* key : {"greatest_hold", "least_hold", "contacts"}) weight.erase(key);
    for (const char* key : {"greatest", "least"}) weight[key] = nullptr;
  });
  refuted("no bound", [](Json& weight, Json&) { weight["greatest_bound"] = nullptr; });
  refuted("any weight", [&](Json& weight, Json&) {
    weight["any"] = true;
    weight["greatest"] = weight["greatest_bound"] = nullptr;
    weight["contacts"] = Json::array();
    weight["greatest_hold"] = hold;
  });
  refuted("the given weight is the least", [&](Json& weight, Json&) {
    weight["least"] = weight["given"];
    weight["least_hold"] = hold;
  });
  refuted("per_newton", [](Json& weight, Json&) { weight["contacts"][0]["per_newton"] = 99; });
  refuted("slipping", [](Json& weight, Json&) {
    Json& slipping = weight["contacts"][0]["slipping"];
    slipping = !slipping.get<bool>();
  });
  refuted("no friction is enough",
          [](Json&, Json& friction) { friction["factor"] = friction["hold"] = nullptr; });
  for (const bool bound_too : {false, true})
    refuted("all the friction is needed", [&](Json&, Json& friction) {
      friction["factor"] = 1;
      friction["hold"] = hold;
      if (bound_too) friction["bound"] = 0;
    });
  Json forged = result;
  forged["capacities"] = Json::array();
  expect_refuted(file, forged, "there are some");
  forged = result;
  forged["capacities"].push_back(Json(forged["capacities"][0]));
  EXPECT_NE(problem(file, forged), "");
  forged = result;
  forged["options"]["safety"] = 1.2;
  EXPECT_NE(problem(file, forged), "");
}

/// The same of a gripper whose drive limits it, and what it commands.
TEST(ForgedResults, HoldNoMoreThanTheirDrivesGive) {
  const GraspFile file = grasp_from_yaml(
      "poise: 1\ndimension: 3\nobject: {weight: 10, com: [0, 0, 0]}\ndrives: coupled\n"
      "fingers: {left: {max_force: 20}}\ncontacts:\n"
      "  - {position: [-1, 0, 0], normal: [1, 0, 0], friction: 0.3, torsion: 0.1, finger: left}\n"
      "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 0.3, torsion: 0.1, finger: right}\n",
      "jaws.yaml");
  const Json result = result_of(file, {.command = Command::capacity, .up = {0, 0, 1}});
  EXPECT_EQ(problem(file, result), "");
  const Json& at = result["capacities"][0];
  EXPECT_NEAR(at["weight"]["greatest_bound"], 2 * 20 * 0.3, 1e-7);
  EXPECT_NEAR(at["command"]["grip"], 1.5 * 10 / (2 * 0.3), 1e-6);  // more than the drive gives
  const auto refuted = [&](const std::string& what, const auto& change, const std::string& by) {
    SCOPED_TRACE(what);
    Json forged = result;
    change(forged["capacities"][0]);
    expect_refuted(file, forged, by);
  };
  const char* const of_bound = "no weight beyond the bound can be held, by its dual";
  for (const double factor : {0.5, 0.999, 1.001})
    refuted(
        "rates",
        [&](Json& forged) {
          Json& rate = forged["weight"]["greatest_rates"][0];
          rate = factor * rate.template get<double>();
        },
        of_bound);
  refuted(
      "no rates", [](Json& forged) { forged["weight"].erase("greatest_rates"); }, of_bound);
  refuted(
      "rates below 0", [](Json& forged) { forged["weight"]["greatest_rates"][0] = -1; },
      "rates are of drives with a max");
  refuted(
      "rates of more drives", [](Json& forged) { forged["weight"]["greatest_rates"].push_back(0); },
      "rates are of drives with a max");
  refuted(
      "per_newton", [](Json& forged) { forged["weight"]["drives"][0]["per_newton"] = 0.61; },
      "per_newton is the rate of the drive");
  refuted(
      "a drive's name", [](Json& forged) { forged["weight"]["drives"][0]["name"] = "left"; },
      "name is that of the drive");
  refuted(
      "no drives", [](Json& forged) { forged["weight"]["drives"] = Json::array(); },
      "each drive decides or not");
  refuted(
      "more than the drive gives",
      [&](Json& forged) { forged["weight"]["greatest_hold"] = at["command"]; },
      "effort is at most max");
  refuted(
      "any weight",
      [&](Json& forged) {
        Json& weight = forged["weight"];
        weight["any"] = true;
        weight["greatest"] = weight["greatest_bound"] = nullptr;
        weight["greatest_dual"] = {0, 0, 0, 0, 0, 0};
        weight.erase("greatest_rates");
        weight["contacts"] = weight["drives"] = Json::array();
        weight["greatest_hold"] = result_of(file, {.command = Command::hold, .up = {0, 0, 1}});
        for (const char* key : {"poise_result", "command", "options"})
          weight["greatest_hold"].erase(key);
      },
      "drives with a max do nothing");
  refuted(
      "less friction",
      [](Json& forged) {
        Json& rate = forged["friction"]["rates"][0];
        rate = 0.99 * rate.template get<double>();
      },
      "with less friction the weight cannot be held");
  refuted(
      "a smaller grip", [](Json& forged) { forged["command"]["grip"] = 20; },
      "grip is the greatest effort of a drive");
  refuted(
      "another objective",
      [&](Json& forged) {
        Json hold = result_of(
            file, {.command = Command::hold, .up = {0, 0, 1}, .objective = Objective::effort});
        for (const char* key : {"poise_result", "command", "options"}) hold.erase(key);
        forged["command"] = hold;
      },
      "the command is the least grip");
}

// A million times the friction is said not to be enough, though the stop, which presses with less
// than 2 N, needs 1.34 times the block's.
TEST(ForgedResults, NeedNoMoreFrictionThanTheyDo) {
  const GraspFile block = grasp_from_yaml(
      "poise: 1\ndimension: 2\nobject: {weight: 10, com: [0, 0]}\ncontacts:\n"
      "  - {position: [0, 0], normal: [-0.5, 0.8660254], friction: 0.25}\n"
      "  - {position: [-0.001, 0], normal: [1, 0], friction: 0, max_normal: 2}\n",
      "block.yaml");
  Json result = result_of(block, {.command = Command::capacity, .angle_deg = 0});
  Json& friction = result["capacities"][0]["friction"];
  friction["factor"] = friction["hold"] = nullptr;
  expect_refuted(block, result, "factor is null where a million times the friction");
}

// Forces in doubles lie that far beside cones as wide as these.
TEST(ForgedResults, AreNotSeenInMuchFriction) {
  const GraspFile file = grasp_from_yaml(
      "poise: 1\ndimension: 2\nangle_deg: -62.956856700757328\n"
      "object: {weight: 1, com: [0, 0]}\ncontacts:\n"
      "  - {position: [0.93803170857293505, 0.34654943905846991],"
      " normal: [-0.86029015740739001, -0.26760866795402821], friction: 100.86442884419334}\n"
      "  - {position: [0.85288186297549029, -0.52210394348966283],"
      " normal: [-0.93939031027584585, 0.34764762892513679], friction: 325.28556708308059}\n",
      "much-friction.yaml");
  for (const Command command : {Command::best, Command::hold, Command::curve})
    EXPECT_EQ(problem(file, result_of(file, {.command = command})), "");
}

}  // namespace
}  // namespace poise
