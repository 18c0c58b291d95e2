#include <gtest/gtest.h>

#include "bad_files.hpp"
#include "command_line.hpp"

namespace poise {
namespace {

/// Fig. 4(c) of the paper: only the ends of its range can be held.
const std::string fig_4c =
    "poise: 1\n"
    "dimension: 2\n"
    "object: {weight: 10, com: [0, 0], shape: {disk: {radius: 1}}}\n"
    "contacts:\n"
    "  - {position: [0.7071067811865476, 0.7071067811865476], friction: 1}\n"
    "  - {position: [-0.7071067811865476, 0.7071067811865476], friction: 1}\n";

/// Both fingers push the same way, beside the centre of mass.
const std::string not_to_be_held =
    "{\"poise\": 1, \"dimension\": 2, \"object\": {\"weight\": 10, \"com\": [0, 1]},\n"
    " \"contacts\": [{\"position\": [1, 0], \"normal\": [0, 1], \"friction\": 0.1},\n"
    "                {\"position\": [1.5, 0], \"normal\": [0, 1], \"friction\": 0.1}]}\n";

void expect_minimum(const Json& minimum, double angle, double effort, const std::string& kind,
                    const std::string& manner) {
  EXPECT_NEAR(minimum["angle_deg"], angle, 1e-9);
  EXPECT_NEAR(minimum["effort"], effort, 1e-9 * effort);
  EXPECT_EQ(minimum["kind"], kind);
  EXPECT_EQ(minimum["manner"], manner);
}

TEST_F(CommandLine, FindsTheOptimaOfThePapersFig6) {
  const Json pinched = json("best " + example("ito-fig6") + " --domain pinching-up");
  ASSERT_EQ(pinched["minima"].size(), 3U);
  expect_minimum(pinched["minima"][0], 105, 100, "boundary", "resting");
  expect_minimum(pinched["minima"][1], -105, 100, "boundary", "resting");
  expect_minimum(pinched["minima"][2], 30, 300, "kink", "pinched");
  EXPECT_EQ(pinched["best_pinched"], pinched["minima"][2]);

  const Json all = json("best " + example("ito-fig6"));
  expect_minimum(all["best"], 165, 80.38475772933680, "kink", "cradled");
  expect_minimum(all["best_pinched"], 30, 300, "kink", "pinched");
  EXPECT_NEAR(all["relative_gap"], 0, 1e-9);
}

TEST_F(CommandLine, HoldsThePapersFig4cAtTheEndsAlone) {
  write("4c.yaml", fig_4c);
  const Json best = json("best 4c.yaml --domain pinching-up");
  ASSERT_EQ(best["minima"].size(), 2U);
  expect_minimum(best["minima"][0], 135, 100, "boundary", "resting");
  expect_minimum(best["minima"][1], -135, 100, "boundary", "resting");
  EXPECT_TRUE(best["best_pinched"].is_null());

  const Json hold = json("hold 4c.yaml --angle 20", 1);
  EXPECT_EQ(hold["holdable"], false);
  EXPECT_GT(hold["lower_bound"], 1e12 * 100);
  EXPECT_FALSE(hold["reason"].get<std::string>().empty());
}

TEST_F(CommandLine, GivesTheAnswersThatTheExamplesTell) {
  const Json l_part = json("best " + example("l-part"));
  EXPECT_NEAR(l_part["best"]["angle_deg"], 131.99, 0.005);
  EXPECT_NEAR(l_part["best"]["grip"], 1.184, 0.0005);
  EXPECT_EQ(l_part["best"]["manner"], "pinched");  // parallel pads, all friction used
  EXPECT_EQ(l_part["best_pinched"], l_part["best"]);
  EXPECT_NEAR(l_part["minima"][1]["angle_deg"], -25.46, 0.005);
  EXPECT_NEAR(l_part["minima"][1]["grip"], 1.233, 0.0005);
  EXPECT_NEAR(json("hold " + example("l-part"))["grip"], 2.125, 0.0005);

  const Json hexagon = json("best " + example("hexagon-three-fingers"));
  EXPECT_NEAR(hexagon["best"]["angle_deg"], 59.49, 0.005);
  EXPECT_NEAR(hexagon["best"]["grip"], 4.740, 0.0005);
  const Json easiest = json("best " + example("hexagon-three-fingers") + " --objective effort");
  EXPECT_NEAR(easiest["best"]["angle_deg"], -173.22, 0.005);
  EXPECT_EQ(easiest["best"]["contacts"][2]["limit"], "min");
  EXPECT_NEAR(hexagon["holdable_arcs_deg"][0][0], 54, 0.5);
  EXPECT_NEAR(hexagon["holdable_arcs_deg"][0][1], 360 - 54, 0.5);
  EXPECT_NEAR(json("hold " + example("hexagon-three-fingers"))["grip"], 7.072, 0.0005);
}

TEST_F(CommandLine, ExitsWith1WhereNothingCanBeHeld) {
  write("no.json", not_to_be_held);
  for (const std::string command : {"hold", "best", "curve"})
    for (const std::string json : {"", " --json"}) {
      const Outcome run = poise(command + " no.json" + json);
      EXPECT_EQ(run.status, 1) << command << json;
      EXPECT_EQ(run.err, "") << command << json;
      EXPECT_NE(run.out, "") << command << json;
    }
  EXPECT_EQ(poise("check no.json").status, 0);
}

TEST_F(CommandLine, RefusesEveryBadFileInItsWords) {
  for (const BadFile& bad : bad_files) {
    write("bad.yaml", bad.text);
    const Outcome run = poise("best bad.yaml --json");
    EXPECT_EQ(run.status, 2) << bad.name;
    EXPECT_EQ(run.err, "poise: bad.yaml:" + bad.message + "\n") << bad.name;
    EXPECT_EQ(run.out, "") << bad.name;
  }
}

TEST_F(CommandLine, RefusesBadUsageAndSaysWhatIsRight) {
  write("4c.yaml", fig_4c);
  const struct {
    std::string arguments, words;
  } usages[] = {
      {"", "A subcommand is required"},
      {"hodl 4c.yaml",
       "unknown command 'hodl', must be check, hold, best, turn, curve, capacity, motion, draw, "
       "verify, contacts, batch, view or import"},
      {"best", "FILE is required"},
      {"best 4c.yaml 4c.yaml", "unexpected '4c.yaml', poise best takes one FILE"},
      {"best 4c.yaml hold", "unexpected 'hold'"},
      {"hold 4c.yaml --up 0 1", "unexpected '1': numbers of one flag are written with commas"},
      {"best 4c.yaml --jsn",
       "unknown option --jsn, poise best knows --help, --json, --domain, --objective, --force-cap"},
      {"best 4c.yaml --angle 3", "unknown option --angle"},
      {"best 4c.yaml --json=3", "disallowed flag override"},
      {"--json best 4c.yaml", "unknown option --json, poise knows --version, --help"},
      {"check 4c.yaml --domain all", "unknown option --domain"},
      {"hold 4c.yaml --domain all", "unknown option --domain"},
      {"hold 4c.yaml --angle", "--angle"},
      {"hold 4c.yaml --angle ''", "--angle: '' is not a number of degrees"},
      {"hold 4c.yaml --angle 1x", "--angle: '1x' is not a number of degrees"},
      {"hold 4c.yaml --angle nan", "--angle: 'nan' is not a number of degrees"},
      {"hold 4c.yaml --angle 1e999", "--angle: '1e999' is not a number of degrees"},
      {"hold 4c.yaml --angle 1 --angle 2", "--angle"},
      {"hold 4c.yaml --angle 1 --up 0,1", "--angle excludes --up"},
      {"hold 4c.yaml --up 0,0", "--up: 0,0 has no direction"},
      {"hold 4c.yaml --up 1",
       "--up: '1' is not a direction, must be like 0.5,0.8 (in space 0.5,0,0.8)"},
      {"hold 4c.yaml --up 1,2,", "--up: '1,2,' is not a direction"},
      {"hold 4c.yaml --up 1,2,3,4", "--up: '1,2,3,4' is not a direction"},
      {"hold 4c.yaml --up 1,2,3",
       "--up: has 3 numbers, must have 2: 4c.yaml is in the plane (dimension 2)"},
      {"best 4c.yaml --domain half", "--domain: 'half' must be all or pinching-up"},
      {"best 4c.yaml --force-cap 0", "--force-cap: '0' is not a number of weights"},
      {"best 4c.yaml --force-cap -1", "--force-cap: '-1'"},
      {"best 4c.yaml --force-cap 1e10", "--force-cap: '1e10'"},
      {"best 4c.yaml --force-cap inf", "--force-cap: 'inf'"},
      {"capacity 4c.yaml --safety 0.9", "--safety: '0.9' is not a factor, must be at least 1"},
      {"capacity 4c.yaml --up 0,1 --angle 3", "--angle"},
      {"draw 4c.yaml", "--out is required"},
      {"draw 4c.yaml -o x.pdf", "--out: 'x.pdf' must end with .svg or .png"},
      {"curve 4c.yaml --plot", "--plot"},
      {"curve 4c.yaml --plot ''", "--plot: '' is not a file"},
      {"best none.yaml", "none.yaml: does not exist"},
      {"best .", ".: is a folder, must be a file"},
      {"best ''", "does not exist"},
  };
  for (const auto& usage : usages) {
    const Outcome run = poise(usage.arguments);
    EXPECT_EQ(run.status, 2) << usage.arguments;
    EXPECT_EQ(run.out, "") << usage.arguments;
    EXPECT_EQ(run.err.find("poise: "), 0U) << usage.arguments << ": " << run.err;
    EXPECT_NE(run.err.find(usage.words), run.err.npos) << usage.arguments << ": " << run.err;
    EXPECT_LE(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;
  }
}

TEST_F(CommandLine, PrintsHelpAndVersion) {
  for (const std::string arguments :
       {"--help", "-h", "check --help", "hold --help", "best --help", "curve -h", "--version"}) {
    const Outcome run = poise(arguments);
    EXPECT_EQ(run.status, 0) << arguments;
    EXPECT_EQ(run.err, "") << arguments;
    EXPECT_NE(run.out.find("poise"), run.out.npos) << arguments;
  }
}

TEST_F(CommandLine, TakesPosturesInEveryForm) {
  const std::string file = example("ito-fig6");
  const Json upright = json("hold " + file);
  EXPECT_EQ(upright["angle_deg"], 0.0);
  EXPECT_EQ(upright["options"], Json::parse(R"({"force_cap": 1000000.0, "objective": "effort"})"));
  EXPECT_EQ(json("hold " + file + " --angle -330")["angle_deg"], 30.0);
  EXPECT_EQ(json("hold " + file + " --angle=-180")["angle_deg"], 180.0);
  EXPECT_EQ(json("hold " + file + " --angle +12.5")["angle_deg"], 12.5);
  EXPECT_NEAR(json("hold " + file + " --up 1,-1")["angle_deg"], 135, 1e-12);
  EXPECT_NEAR(json("hold " + file + " --up -0.001,0")["angle_deg"], -90, 1e-12);
  EXPECT_EQ(json("hold " + example("hexagon-three-fingers"))["angle_deg"], 90.0);
}

TEST_F(CommandLine, ReadsStandardInput) {
  const Outcome run =
      shell("printf '%s' '" + fig_4c + "' | '" POISE_PROGRAM "' hold - --angle 180");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(shell("printf '{' | '" POISE_PROGRAM "' best -").err.find("poise: standard input:1:"),
            0U);
}

TEST_F(CommandLine, TheFlagOverridesTheDomainOfTheFile) {
  write("pinched.yaml", fig_4c + "domain: pinching-up\n");
  EXPECT_EQ(json("best pinched.yaml")["options"]["domain"], "pinching-up");
  EXPECT_EQ(json("best pinched.yaml")["minima"].size(), 2U);
  EXPECT_EQ(json("best pinched.yaml --domain all")["options"]["domain"], "all");
  EXPECT_EQ(json("best pinched.yaml --domain all")["best"]["angle_deg"], 180.0);
}

TEST_F(CommandLine, TheForceCapDecidesWhatIsHeld) {
  EXPECT_EQ(json("hold " + example("ito-fig6") + " --angle 30 --force-cap 1.75")["holdable"], true);
  EXPECT_EQ(json("hold " + example("ito-fig6") + " --angle 30 --force-cap 1.7", 1)["holdable"],
            false);
}

TEST_F(CommandLine, WarningsDoNotMixWithTheAnswer) {
  write("doubtful.yaml", fig_4c + "  - {position: [0, -1], friction: 20}\n");
  const Outcome run = poise("best doubtful.yaml --json");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err.find("poise: doubtful.yaml:7:"), 0U) << run.err;
  EXPECT_TRUE(Json::accept(run.out));

  const Outcome check = poise("check doubtful.yaml");
  EXPECT_EQ(check.status, 0);
  EXPECT_EQ(check.err, "");
  EXPECT_NE(check.out.find("doubtful.yaml:7:"), check.out.npos);
}

TEST_F(CommandLine, PrintsNoColourIntoAPipe) {
  for (const std::string command : {"check ", "hold ", "best ", "curve "})
    EXPECT_EQ(poise(command + example("l-part"), "TERM=xterm").out.find('\033'), std::string::npos);
}

/// A block of 10 N between two fingers of friction 0.4, which need 12.5 N.
std::string vice_with(const std::string& rest) {
  return "{\"poise\": 1, \"dimension\": 2, " + rest +
         "\"object\": {\"weight\": 10, \"com\": [0, 0]},\n \"contacts\": [\n"
         "  {\"position\": [-1, 0], \"normal\": [1, 0], \"friction\": 0.4, \"finger\": \"a\"},\n"
         "  {\"position\": [1, 0], \"normal\": [-1, 0], \"friction\": 0.4, \"finger\": \"b\"}]}\n";
}

TEST_F(CommandLine, SaysHowToGetFromNowToTheBest) {
  write("turned.yaml", contents(POISE_EXAMPLES "/ito-fig6.yaml") + "angle_deg: 0\n");
  const std::string out = poise("best turned.yaml").out;
  for (const char* words :
       {"now", "best pinched", "turn by 30.00° counter-clockwise", "times the effort"})
    EXPECT_NE(out.find(words), out.npos) << words << "\n" << out;
  // Where it is already as good, it stays.
  write("there.yaml", contents(POISE_EXAMPLES "/ito-fig6.yaml") + "angle_deg: -165\n");
  EXPECT_NE(poise("best there.yaml").out.find("stay"), std::string::npos);
}

TEST_F(CommandLine, FindsThePostureOfLeastGripInThePlane) {
  const Json grip = json("best " + example("hexagon-three-fingers") + " --objective grip");
  const Json effort = json("best " + example("hexagon-three-fingers") + " --objective effort");
  EXPECT_EQ(grip["status"], "optimal");
  for (const Json& minimum : effort["minima"])
    EXPECT_LE(grip["best"]["grip"], minimum["grip"].get<double>() * (1 + 1e-7));
  EXPECT_LT(grip["best"]["grip"], 0.95 * effort["best"]["grip"].get<double>());
  for (const std::string command : {"best", "curve"}) {
    const std::string asked =
        command + " " + example("hexagon-three-fingers") + " --objective grip";
    write("result.json", poise(asked + " --json").out);
    EXPECT_EQ(poise("verify " + example("hexagon-three-fingers") + " result.json").status, 0)
        << command;
  }
  // A jaw that can press with 10 N holds no more than 2 mu times that.
  write("weak.json", vice_with("\"drives\": \"each\", \"fingers\": {\"a\": {\"max_force\": 9}, "
                               "\"b\": {\"max_force\": 9}}, \"objective\": \"grip\", "));
  const Outcome weak = poise("best weak.json");
  EXPECT_EQ(weak.status, 1) << weak.out << weak.err;
  EXPECT_NE(weak.out.find("more than their max of 9"), std::string::npos) << weak.out;
}

/// What is pushed up with 5 N and turned, and then pulled with (-2, -3) N: two fingers of friction
/// 0.6 press with 35/6 N and 4.5 N, in any posture.
TEST_F(CommandLine, WeighsSeveralLoadsInThePlane) {
  const std::string contacts =
      "contacts:\n"
      "  - {position: [-0.03, 0], normal: [1, 0], friction: 0.6, finger: left}\n"
      "  - {position: [0.03, 0], normal: [-1, 0], friction: 0.6, finger: right}\n";
  write("pushed.yaml",
        "poise: 1\ndimension: 2\nangle_deg: 20\nobject: {weight: 0, com: [0, 0]}\n"
        "loads: [{name: pushed, force: [0, 5], moment: 0.06}, {name: pulled, force: [-2, -3]}]\n" +
            contacts);
  const Json hold = json("hold pushed.yaml");
  EXPECT_NEAR(hold["load_grips"][0], 35.0 / 6, 1e-9);
  EXPECT_NEAR(hold["load_grips"][1], 4.5, 1e-9);
  const Json best = json("best pushed.yaml");
  EXPECT_NEAR(best["best"]["grip"], 35.0 / 6, 1e-9);
  EXPECT_NEAR(best["best"]["angle_deg"], 20, 1e-9);
  EXPECT_EQ(best["best"]["load"], 0);
  EXPECT_NEAR(best["lower_bound"], 35.0 / 6, 1e-9);

  // Beside a weight that needs more where the fingers are level.
  write("both.yaml",
        "poise: 1\ndimension: 2\nobject: {weight: 10, com: [0, 0]}\n"
        "loads: [{name: carried}, {name: pushed, weight: 0, force: [0, 8.5], moment: 0.06}]\n" +
            contacts);
  const Json curve = json("curve both.yaml");
  EXPECT_EQ(curve["load_curves"].size(), 2U);
  EXPECT_EQ(curve["load_curves"][1]["arcs"].size(), 1U);
  const std::string table = poise("curve both.yaml").out;
  EXPECT_NE(table.find("carried"), std::string::npos) << table;
  EXPECT_NE(table.find("pushed"), std::string::npos) << table;
  for (const char* asked : {"curve both.yaml", "best both.yaml", "turn both.yaml --to 120",
                            "curve both.yaml --objective effort",
                            "best both.yaml --objective effort --domain pinching-up"}) {
    write("result.json", poise(std::string(asked) + " --json").out);
    const Outcome verified = poise("verify both.yaml result.json");
    EXPECT_EQ(verified.status, 0) << asked << "\n" << verified.out << verified.err;
  }
}

TEST_F(CommandLine, SaysSoWhereTheAnswerCannotBeWritten) {
  const std::string best = "'" POISE_PROGRAM "' best " + example("l-part");
  const Outcome full = shell(best + " >/dev/full");
  EXPECT_EQ(full.status, 2);
  EXPECT_EQ(full.err, "poise: cannot write the answer: No space left on device\n");
  EXPECT_EQ(shell(best + " >&-").status, 2);

  // A reader that leaves early ends it quietly.
  const Outcome head = shell(best + " --json | head -1");
  EXPECT_EQ(head.status, 0);
  EXPECT_EQ(head.out, "{\n");
  EXPECT_EQ(head.err, "");
  const Outcome left = shell("(sleep 0.2; " + best + " --json; echo $? >status.txt) | true");
  EXPECT_EQ(left.err, "");
  EXPECT_EQ(contents(folder() / "status.txt"), "2\n");
}

TEST_F(CommandLine, VerifiesWhatTheOthersPrint) {
  for (const std::string command : {"check", "hold", "best", "curve"}) {
    const Outcome printed =
        shell("'" POISE_PROGRAM "' " + command + " " + example("l-part") + " --json > result.json");
    ASSERT_EQ(printed.status, 0) << printed.err;
    const Outcome run = poise("verify " + example("l-part") + " result.json");
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("Confirmed: all "), run.out.npos);
    EXPECT_EQ(json("verify " + example("l-part") + " result.json")["confirmed"], true);
    const Outcome other = poise("verify " + example("ito-fig6") + " result.json");
    EXPECT_EQ(other.status, 1) << command;
    EXPECT_NE(other.out.find("Refuted\n  line "), other.out.npos);
  }
  EXPECT_EQ(poise("verify " + example("l-part")).status, 2);
  write("damaged.json", "{\n \"poise_result\": 1,\n \"command\": \"hold\", \"options\": []}");
  const Outcome damaged = poise("verify " + example("l-part") + " damaged.json");
  EXPECT_EQ(damaged.status, 2);
  EXPECT_EQ(damaged.out, "");
  EXPECT_EQ(damaged.err.find("poise: damaged.json:3:"), 0U) << damaged.err;
}

class Plot : public CommandLine {
 protected:
  void SetUp() override {
    ASSERT_EQ(std::system("command -v gnuplot >/dev/null 2>&1"), 0)
        << "gnuplot is part of the set-up";
  }
};

TEST_F(Plot, DrawsEveryExample) {
  for (const std::string name : {"ito-fig6", "l-part", "hexagon-three-fingers"}) {
    const Outcome run = poise("curve " + example(name) + " --plot curve.svg");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("Drawn in curve.svg"), run.out.npos);
    const std::string svg = contents(folder() / "curve.svg");
    EXPECT_NE(svg.find("<svg"), svg.npos);
    EXPECT_NE(svg.find("</svg>"), svg.npos);
    EXPECT_NE(svg.find("best pinched"), svg.npos);
  }
}

TEST_F(Plot, DrawsWhatCannotBeHeldToo) {
  write("no.json", not_to_be_held);
  const Outcome run = poise("curve no.json --json --plot no.svg");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(Json::accept(run.out));
  EXPECT_NE(contents(folder() / "no.svg").find("cannot be held in any posture"), std::string::npos);
}

bool is_picture(const std::string& file) {
  return file.starts_with("\x89PNG") || file.find("</svg>") != std::string::npos;
}

TEST_F(Plot, DrawsEveryExampleAsItHangs) {
  for (const auto& entry : fs::directory_iterator(POISE_EXAMPLES)) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string file = "'" + entry.path().string() + "'";
    for (const std::string picture : {"hanging.svg", "hanging.png"}) {
      const Outcome run = poise("draw " + file + " -o " + picture);
      EXPECT_LE(run.status, 1) << file << run.err;
      EXPECT_EQ(run.out, "Drawn in " + picture + "\n") << file;
      EXPECT_TRUE(is_picture(contents(folder() / picture))) << file;
      EXPECT_LT(fs::file_size(folder() / picture), 600000U) << file;
      fs::remove(folder() / picture);
    }
  }
  // The posture may be given, and need not hold; the file's name stays its own.
  EXPECT_EQ(poise("draw " + example("l-part") + " --angle 20 -o a.svg").status, 0);
  EXPECT_NE(contents(folder() / "a.svg").find("at 20.00°: grip "), std::string::npos);
  EXPECT_EQ(poise("draw " + example("bottle") + " --up 1,0,0 -o a.svg").status, 0);
  EXPECT_EQ(poise("draw " + example("box-hard-jaws") + " --up 0,0,1 -o a.png").status, 1);
  write("old.png", "old");
  EXPECT_EQ(poise("draw " + example("bottle") + " -o none/old.png").err,
            "poise: none/old.png: cannot be written: No such file or directory\n");
}

TEST_F(Plot, ShowsWhatActsBesidesTheWeight) {
  const auto picture_of = [&](const std::string& load, const std::string& command) {
    write("loaded.yaml", R"({poise: 1, dimension: 2, angle_deg: 20,
      object: {weight: 6, shape: {disk: {radius: 0.05}}},
      contacts: [{position: [-0.05, 0], normal: [1, 0], friction: 2, finger: left},
                 {position: [0.05, 0], normal: [-1, 0], friction: 2, finger: right}],
      loads: [{)" + load + "}]}");
    const Outcome run = poise(command);
    EXPECT_EQ(run.status, 0) << run.err;
    return contents(folder() / "loaded.svg");
  };
  const auto shows = [](const std::string& svg, const std::string& words) {
    return svg.find(">" + words + "<") != svg.npos;
  };
  for (const std::string command :
       {"draw loaded.yaml -o loaded.svg", "curve loaded.yaml --plot loaded.svg"}) {
    const std::string pushed = picture_of("force: [3, 4], at: [0, 0.02]", command);
    EXPECT_TRUE(shows(pushed, "other load") && shows(pushed, "5.000 N"));
    EXPECT_TRUE(shows(pushed, "6.000 N"));  // the weight, not the size of the load
  }
  const std::string draw = "draw loaded.yaml -o loaded.svg";
  const std::string turned = picture_of("moment: 0.75", draw);
  EXPECT_TRUE(shows(turned, "other load") && shows(turned, "0.7500 N m"));
  EXPECT_TRUE(shows(turned, "6.000 N"));
  const std::string lifted = picture_of("acceleration: {up: 4.903325}", draw);
  EXPECT_TRUE(shows(lifted, "other load") && shows(lifted, "3.000 N"));
  EXPECT_TRUE(shows(lifted, "6.000 N"));
  const std::string plain = picture_of("weight: 7", draw);
  EXPECT_FALSE(shows(plain, "other load"));
  EXPECT_TRUE(shows(plain, "7.000 N"));
}

TEST_F(Plot, TakesNamesAsTheyAre) {
  write("name.yaml", fig_4c + "name: \"it's `touch was_run` {/Symbol a} <b>&amp; @x $y \\\\ é\"\n");
  EXPECT_EQ(poise("curve name.yaml --plot \"it's a name.svg\"").status, 0);
  const std::string svg = contents(folder() / "it's a name.svg");
  EXPECT_NE(svg.find("it's `touch was_run` {/Symbol a} &lt;b&gt;&amp;amp; @x $y \\ é"), svg.npos);
  EXPECT_FALSE(fs::exists(folder() / "was_run"));
}

TEST_F(Plot, IsTheSameInAnyLocale) {
  const std::string curve = "curve " + example("l-part") + " --plot ";
  EXPECT_EQ(poise(curve + "utf8.svg", "LC_ALL=C.UTF-8").err, "");
  EXPECT_EQ(poise(curve + "c.svg", "LC_ALL=C LANG=C").err, "");
  EXPECT_EQ(contents(folder() / "utf8.svg"), contents(folder() / "c.svg"));
}

TEST_F(Plot, LeavesNothingBehindWhereItFails) {
  const std::string curve = "curve " + example("l-part") + " --plot ";
  const Outcome missing = poise(curve + "none/x.svg");
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.out, "");
  EXPECT_EQ(missing.err, "poise: none/x.svg: cannot be written: No such file or directory\n");
  EXPECT_EQ(poise(curve + ".").err, "poise: .: is a folder, must be a file\n");

  fs::create_directory(folder() / "empty");
  write("old.svg", "old");
  const Outcome no_gnuplot =
      poise(curve + "old.svg", "PATH='" + (folder() / "empty").string() + "'");
  EXPECT_EQ(no_gnuplot.status, 2);
  EXPECT_EQ(no_gnuplot.out, "");
  EXPECT_NE(no_gnuplot.err.find("needs gnuplot"), no_gnuplot.err.npos) << no_gnuplot.err;
  EXPECT_EQ(contents(folder() / "old.svg"), "old");
  for (const auto& entry : fs::directory_iterator(folder()))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();

  EXPECT_EQ(poise(curve + "old.svg").status, 0);
  EXPECT_NE(contents(folder() / "old.svg"), "old");
}

/// A block of 10 N between two fingers that press with up to 25 N.
std::string vice(const std::string& rest = "") {
  return "{\"poise\": 1, \"dimension\": 2, " + rest +
         "\"object\": {\"weight\": 10, \"com\": [0, 0]},\n"
         " \"contacts\": [\n"
         "  {\"position\": [-1, 0], \"normal\": [1, 0], \"friction\": 0.4, \"max_normal\": 25},\n"
         "  {\"position\": [1, 0], \"normal\": [-1, 0], \"friction\": 0.4, \"max_normal\": 25}]}\n";
}

TEST_F(CommandLine, CapacityIsWhatTwoFingersCarryByFriction) {
  write("vice.json", vice("\"angle_deg\": 0, "));
  const Json document = json("capacity vice.json");
  ASSERT_EQ(document["capacities"].size(), 2U);
  const Json& now = document["capacities"][0];
  EXPECT_EQ(now["posture"], "now");
  EXPECT_NEAR(now["weight"]["greatest"], 20, 1e-5);
  EXPECT_NEAR(now["weight"]["greatest_bound"], 20, 1e-8);
  EXPECT_EQ(now["weight"]["any"], false);
  EXPECT_NEAR(now["friction"]["factor"], 0.5, 1e-6);
  EXPECT_NEAR(now["command"]["grip"], 1.5 * 10 / (2 * 0.4), 1e-9);
  EXPECT_EQ(document["capacities"][1]["posture"], "best");
  EXPECT_NEAR(json("capacity vice.json --safety 1")["capacities"][0]["command"]["grip"], 12.5,
              1e-9);
  // Upside down; and with less friction than it needs.
  EXPECT_NEAR(json("capacity vice.json --angle 180")["capacities"][0]["weight"]["greatest"], 20,
              1e-5);
  write("slippery.json", vice("\"safety\": 4, \"angle_deg\": 0, "));
  const Json slips = json("capacity slippery.json --up 0,3", 1);
  EXPECT_NEAR(slips["capacities"][0]["friction"]["factor"], 2, 1e-6);
  EXPECT_EQ(slips["capacities"][0]["command"]["holdable"], false);

  const Outcome run = poise("capacity vice.json --angle 0");
  EXPECT_NE(run.out.find("20.00 N (2.039 kg), 2.000 times the given"), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("0.2000 instead of 0.4000: a safety factor of 2.000"), std::string::npos);
  EXPECT_NE(run.out.find("grip to command  18.75 N, with a safety factor of 1.500"),
            std::string::npos);
}

TEST_F(CommandLine, CapacityOfDrivesSaysWhatToTypeIntoTheirController) {
  const auto jaws = [&](const std::string& drives) {
    write("jaws.yaml",
          "poise: 1\ndimension: 2\nangle_deg: 0\nobject: {weight: 10, com: [0, 0]}\n" + drives +
              "contacts:\n"
              "  - {position: [-1, 0], normal: [1, 0], friction: 0.3, finger: left}\n"
              "  - {position: [1, 0], normal: [-1, 0], friction: 0.3, finger: right}\n");
    return poise("capacity jaws.yaml").out;
  };
  std::string out = jaws("drives: coupled\nfingers: {left: {max_force: 20}}\n");
  EXPECT_NE(out.find("greatest weight  12.00 N (1.224 kg), 1.200 times"), std::string::npos) << out;
  EXPECT_NE(out.find("grip to command  25.00 N (more than the gripper gives: 20.00 N), with"),
            std::string::npos)
      << out;
  EXPECT_NE(out.find("the drive of all fingers gives its max; left and right use all\ntheir "
                     "friction."),
            std::string::npos)
      << out;
  write("answer.json", poise("capacity jaws.yaml --json").out);
  EXPECT_EQ(poise("verify jaws.yaml answer.json").status, 0);
  out = jaws("fingers: {left: {max_force: 50}, right: {max_force: 20}}\n");
  EXPECT_NE(out.find("grip to command  125.0 % of max (more than the gripper gives), with"),
            std::string::npos)
      << out;
  EXPECT_NE(out.find("the drive of right gives its max"), std::string::npos) << out;
}

TEST_F(CommandLine, VerifyKnowsLoadsThatNeedNothing) {
  // Lying on its cups an object needs no vacuum, however heavy it is.
  write("cups.yaml",
        "poise: 1\ndimension: 2\nobject: {weight: 10, com: [0, 0]}\n"
        "loads: [{name: full}, {name: half, weight: 5}]\ncontacts:\n"
        "  - {position: [-1, 0], normal: [0, -1], friction: 0.5, adhesion: 12, finger: left}\n"
        "  - {position: [1, 0], normal: [0, -1], friction: 0.5, adhesion: 12, finger: right}\n");
  const Json hold = json("hold cups.yaml --angle 180");
  EXPECT_EQ(hold["grip"], 0);
  write("answer.json", hold.dump());
  const Outcome run = poise("verify cups.yaml answer.json");
  EXPECT_EQ(run.status, 0) << run.out;
}

TEST_F(CommandLine, CapacityHasALeastWeightWhereAFingerMustPress) {
  // Pushed from below with 12 to 20 N, between two fingers that carry up to 0.3 * 5 N each.
  write("pushed.json",
        "{\"poise\": 1, \"dimension\": 2, \"object\": {\"weight\": 10, \"com\": [0, 0]},\n"
        " \"contacts\": [\n"
        "  {\"position\": [0, -1], \"normal\": [0, 1], \"friction\": 0.3,\n"
        "   \"min_normal\": 12, \"max_normal\": 20},\n"
        "  {\"position\": [-1, 0], \"normal\": [1, 0], \"friction\": 0.3, \"max_normal\": 5},\n"
        "  {\"position\": [1, 0], \"normal\": [-1, 0], \"friction\": 0.3, \"max_normal\": 5}]}\n");
  const Json answer = json("capacity pushed.json --angle 0");
  const Json& at = answer["capacities"][0];
  EXPECT_NEAR(at["weight"]["least_bound"], 12 - 2 * 0.3 * 5, 1e-8);
  EXPECT_NEAR(at["weight"]["greatest_bound"], 20 + 2 * 0.3 * 5, 1e-8);
  EXPECT_NEAR(at["friction"]["bound"], 0.2 / 0.3, 1e-8);  // 12 N - 10 N = 2 * 0.2 * 5 N
  write("answer.json", answer.dump());
  const Outcome run = poise("verify pushed.json answer.json");
  EXPECT_EQ(run.status, 0) << run.out;
}

TEST_F(CommandLine, VerifyConfirmsCapacityAndRefutesMore) {
  write("vice.json", vice("\"angle_deg\": 0, "));
  write("answer.json", poise("capacity vice.json --json").out);
  EXPECT_EQ(poise("verify vice.json answer.json").status, 0);
  const auto refuted = [&](const auto& change) {
    Json answer = Json::parse(contents(folder() / "answer.json"));
    change(answer["capacities"][0]);
    write("changed.json", answer.dump());
    return poise("verify vice.json changed.json").status == 1;
  };
  EXPECT_TRUE(refuted([](Json& at) { at["weight"]["greatest"] = 20.1; }));
  EXPECT_TRUE(refuted([](Json& at) { at["weight"]["greatest_bound"] = 19.9; }));
  EXPECT_TRUE(refuted([](Json& at) { at["weight"]["greatest_dual"] = {1, 0, 0}; }));
  EXPECT_TRUE(refuted([](Json& at) { at["friction"]["factor"] = 0.49; }));
  EXPECT_TRUE(refuted([](Json& at) { at["friction"]["bound"] = 0.51; }));
  EXPECT_TRUE(refuted([](Json& at) { at["command"]["contacts"][0]["normal_force"] = 12.5; }));
  EXPECT_FALSE(refuted([](Json&) {}));

  for (const char* const name :
       {"l-part", "hexagon-three-fingers", "ito-fig6", "bottle", "box-hard-jaws", "box-soft-jaws",
        "cylinder-three-fingers", "screwdriver"}) {
    write("answer.json", poise("capacity " + example(name) + " --json").out);
    EXPECT_EQ(poise("verify " + example(name) + " answer.json").status, 0) << name;
  }
}

}  // namespace
}  // namespace poise
