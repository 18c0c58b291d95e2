// The program that redoes the paper.
#include <sys/wait.h>

#include "command_line.hpp"

namespace poise {
namespace {

class PaperProgram : public CommandLine {
 protected:
  Outcome paper(const std::string& arguments, const std::string& environment = "") const {
    return shell(environment + " '" POISE_PAPER "' " + arguments);
  }
  Json json(const std::string& arguments) const {
    const Outcome run = paper(arguments + " --json");
    EXPECT_EQ(run.status, 0) << arguments << "\n" << run.err;
    EXPECT_EQ(run.err, "") << arguments;
    return Json::parse(run.out);
  }
};

TEST_F(PaperProgram, WritesItsFiguresTableAndFindings) {
  const Json result = json("--out a/b");
  EXPECT_EQ(result["poise_result"], 1);
  EXPECT_EQ(result["command"], "paper");
  EXPECT_EQ(result["options"]["weight"], 10);
  EXPECT_TRUE(result["options"]["phi_deg"].is_null());
  ASSERT_EQ(result["disks"].size(), 7U);
  const Json& fig6 = result["disks"].back();
  EXPECT_EQ(fig6["name"], "Fig. 6");
  ASSERT_EQ(fig6["minima"].size(), 3U);
  EXPECT_EQ(fig6["minima"][1]["name"], "b");
  EXPECT_NEAR(fig6["minima"][1]["angle_deg"], 30, 1e-12);
  EXPECT_NEAR(fig6["minima"][1]["effort"], 300, 1e-10);
  EXPECT_NEAR(fig6["minima"][1]["internal_force"], 15.7830, 5e-5);

  const fs::path out = folder() / "a/b";
  for (const std::string name :
       {"figure-2", "figure-3a", "figure-3b", "figure-3c", "figure-4a", "figure-4b", "figure-4c",
        "figure-5", "figure-6", "figure-7", "equal-frictions", "when-b-is-a-minimum", "sampling"})
    EXPECT_NE(contents(out / (name + ".svg")).find("</svg>"), std::string::npos) << name;
  for (const auto& entry : fs::directory_iterator(out))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  for (const std::string curve : {"α₁", "α₂", "α₃ = α₄", "α₅", "α₆", "ᾱ"})
    EXPECT_NE(contents(out / "figure-6.svg").find(curve), std::string::npos) << curve;
  for (const std::string figure : {"figure-5.svg", "figure-6.svg"})
    for (const std::string curve : {"V₁", "V₂", "V₃ = V₄", "V₅", "V₆"})
      EXPECT_NE(contents(out / figure).find(curve), std::string::npos) << figure << " " << curve;
  EXPECT_NE(contents(out / "figure-4c.svg").find("no finite value"), std::string::npos);
  EXPECT_NE(contents(out / "minima.txt").find("15.7830      300.0000"), std::string::npos);
  const std::string findings = contents(out / "findings.md");
  for (int number = 1; number <= 7; ++number)
    EXPECT_NE(findings.find("## " + std::to_string(number) + ". "), std::string::npos) << number;
  // The page of the documentation tells these numbers.
  EXPECT_NE(findings.find("7259 of 20000"), std::string::npos);
  EXPECT_NE(findings.find("| Fig. 6 | 165.00° | cradled | 80.3848 |"), std::string::npos);
}

TEST_F(PaperProgram, TakesAnyDisk) {
  const Json result = json("--out x --phi 80 --mu1 0.9 --mu2 0.2 --weight 5");
  const Json& given = result["disks"].back();
  EXPECT_EQ(given["name"], "Given");
  EXPECT_NEAR(given["phi_deg"], 80, 1e-12);
  ASSERT_EQ(given["minima"].size(), 2U);  // V falls through b
  EXPECT_NEAR(given["minima"][0]["effort"], 25, 1e-12);
  EXPECT_NE(contents(folder() / "x/given-curves.svg").find("b (no minimum)"), std::string::npos);
  for (const std::string odd : {"--phi 90 --mu1 0 --mu2 0 --weight 0.001", "--phi 45 --mu2 2",
                                "--mu1 1000000 --weight 1000000"}) {
    const Outcome run = paper("--out x " + odd);
    EXPECT_EQ(run.status, 0) << odd;
    EXPECT_EQ(run.err, "") << odd;
  }
}

TEST_F(PaperProgram, DrawsTheSameInAnyLocale) {
  const Outcome utf8 = paper("--out utf8", "LC_ALL=C.UTF-8");
  const Outcome plain = paper("--out c", "LC_ALL=C LANG=C");
  EXPECT_EQ(plain.status, 0);
  EXPECT_EQ(plain.err, "");
  for (const auto& entry : fs::directory_iterator(folder() / "utf8"))
    EXPECT_EQ(contents(entry.path()), contents(folder() / "c" / entry.path().filename()))
        << entry.path();
}

TEST_F(PaperProgram, SaysWhatIsWrong) {
  write("file", "");
  for (const auto& [arguments, message] : {
           std::pair<std::string, std::string>{"", "--out is required"},
           {"--out ''", "--out: '' is not a directory"},
           {"file --out x", "file"},
           {"--out x --phi 0", "--phi: '0' is not an angle above 0 and at most 90 degrees"},
           {"--out x --phi 90.1", "--phi: '90.1' is not an angle above 0 and at most 90 degrees"},
           {"--out x --phi pi", "--phi: 'pi' is not an angle"},
           {"--out x --mu1 -0.1", "--mu1: '-0.1' is not a friction, 0 to 1e6"},
           {"--out x --mu2 nan", "--mu2: 'nan' is not a friction"},
           {"--out x --weight 0", "--weight: '0' is not a weight above 0"},
           {"--out file", "file: cannot be made a directory: Not a directory"},
           {"--out file/x", "file/x: cannot be made a directory: Not a directory"},
       }) {
    const Outcome run = paper(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_TRUE(run.err.starts_with("paper: ")) << run.err;
    EXPECT_NE(run.err.find(message), run.err.npos) << run.err;
  }
}

}  // namespace
}  // namespace poise
