// What the documentation claims, beside its listings (tests/docs).
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace poise {
namespace {

namespace fs = std::filesystem;

const fs::path root = POISE_ROOT;

std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// What stands between ```language and ``` in a page.
struct Listing {
  std::string place, language, text;
};

std::vector<Listing> listings(const fs::path& page) {
  std::vector<Listing> found;
  std::istringstream lines(contents(page));
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!line.starts_with("```")) {
      if (inside) found.back().text += line + '\n';
      continue;
    }
    inside = !inside;
    if (inside)
      found.push_back(
          {page.filename().string() + ":" + std::to_string(number), line.substr(3), ""});
  }
  EXPECT_FALSE(inside) << page;
  return found;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// What a command prints on both streams, in the root of the repository.
std::string output(const std::string& command) {
  const std::string program = "'" POISE_PROGRAM "'", paper = "'" POISE_PAPER "'";
  const std::string in = root.string();
  const std::string line =
      replaced(replaced(command, "build/poise", program), "build/paper", paper);
  std::FILE* pipe = popen(("cd '" + in + "' && { " + line + "\n} 2>&1 </dev/null").c_str(), "r");
  if (!pipe) return "cannot be run";
  std::string text;
  std::array<char, 4096> buffer{};
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), n);
  pclose(pipe);
  return text;
}

/// The keys of a JSON document, but for a shape, which is told as in a grasp file.
void add_keys(const nlohmann::json& value, std::set<std::string>& keys) {
  if (value.is_array())
    for (const auto& part : value) add_keys(part, keys);
  if (!value.is_object()) return;
  for (const auto& [key, part] : value.items()) {
    keys.insert(key);
    if (key != "shape") add_keys(part, keys);
  }
}

// Every key of what the program prints for the examples is named on the page, and every command.
TEST(Documentation, CommandLineNamesEveryKey) {
  const std::string page = contents(root / "docs/command-line.md");
  std::set<std::string> keys;
  const fs::path result =
      fs::path(testing::TempDir()) / ("poise_result_" + std::to_string(getpid()) + ".json");
  for (const auto& example : fs::directory_iterator(root / "examples")) {
    if (example.path().extension() != ".yaml") continue;
    const std::string file = "'" + example.path().string() + "'";
    for (const std::string command : {"check", "hold", "best", "curve"}) {
      const std::string text = output("build/poise " + command + " " + file + " --json");
      if (!text.starts_with("{")) continue;  // there is no curve in space
      add_keys(nlohmann::json::parse(text), keys);
      std::ofstream(result) << text;
      add_keys(nlohmann::json::parse(
                   output("build/poise verify " + file + " '" + result.string() + "' --json")),
               keys);
    }
  }
  fs::remove(result);
  EXPECT_GT(keys.size(), 80U);
  for (const std::string& key : keys)
    EXPECT_NE(page.find("`" + key + "`"), page.npos) << key << " is not on the page";
}

// The tables of docs/paper.md that were measured: how often, and how many samples.
TEST(Documentation, PaperTellsWhatIsMeasured) {
  const fs::path out = fs::path(testing::TempDir()) / ("poise_paper_" + std::to_string(getpid()));
  output("build/paper --out '" + out.string() + "'");
  const std::string findings = contents(out / "findings.md");
  fs::remove_all(out);
  const std::string page = contents(root / "docs/paper.md");
  std::istringstream lines(page.substr(page.find("## Beyond the disk")));
  int cells = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| ")) continue;
    std::istringstream row(replaced(line, ",", ""));
    std::string cell;
    std::getline(row, cell, '|');  // before the first
    std::getline(row, cell, '|');  // what it is
    while (std::getline(row, cell, '|')) {
      if (cell.find_first_of("0123456789") == std::string::npos ||
          cell.find("e-") != std::string::npos || cell.find("rad") != std::string::npos)
        continue;
      ++cells;
      cell = cell.substr(1, cell.size() - 2);
      EXPECT_NE(findings.find(cell), std::string::npos) << line;
    }
  }
  EXPECT_EQ(cells, 18);
  EXPECT_NE(replaced(page, ",", "").find("7259 of 20000"), std::string::npos);
  EXPECT_NE(findings.find("7259 of 20000"), std::string::npos);
}

// The verifier in Python, as it stands on its page, confirms real results and refuses spoilt ones.
TEST(Documentation, CertificateListingVerifies) {
  const fs::path folder =
      fs::path(testing::TempDir()) / ("poise_certificate_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const auto path = [&](const char* name) { return "'" + (folder / name).string() + "'"; };
  int scripts = 0;
  for (const Listing& listing : listings(root / "docs/certificate.md")) {
    if (listing.language != "python") continue;
    ++scripts;
    std::ofstream(folder / "verify.py") << listing.text;
  }
  EXPECT_EQ(scripts, 1);
  // A tray on three supports, and the same turned so far that it slips off.
  const std::string tray =
      "poise: 1\ndimension: 3\nobject: {weight: 10, com: [0.1, 0.05, 0.9]}\ncontacts:\n"
      "  - {position: [1, 0, 0], normal: [0, 0, 1], friction: 0.3}\n"
      "  - {position: [-0.5, 0.866, 0], normal: [0.1, 0, 1], friction: 0.3, torsion: 0.1}\n"
      "  - {position: [-0.5, -0.866, 0], normal: [0, 0, 1], friction: 0.3}\n";
  std::ofstream(folder / "tray.yaml") << tray << "tilt: {from: [0, 0, 1], max_deg: 30}\n";
  std::ofstream(folder / "fallen.yaml") << tray << "tilt: {from: [0, 0, -1], max_deg: 30}\n";
  for (const std::string& grasp :
       {std::string("examples/ito-fig6.yaml"), std::string("examples/hexagon-three-fingers.yaml"),
        std::string("examples/bottle.yaml"), path("tray.yaml"), path("fallen.yaml")}) {
    output("build/poise check " + grasp + " --json > " + path("grasp.json"));
    const std::string python = "/usr/bin/python3 " + path("verify.py") + " " + path("grasp.json");
    for (const std::string command : {"hold", "best"}) {
      output("build/poise " + command + " " + grasp + " --objective effort --json > " +
             path("result.json"));
      EXPECT_EQ(output(python + " " + path("result.json")), "confirmed\n") << grasp << command;
      EXPECT_NE(output("build/poise verify " + grasp + " " + path("result.json")).find("Confirmed"),
                std::string::npos)
          << grasp << command;
      // The proofs, turned round.
      const std::string text = contents(folder / "result.json");
      std::string spoilt = replaced(replaced(text, "\"y\": [", "\"y\": [-1e3"), "[-1e3-", "[1e3");
      if (command == "hold")
        spoilt = replaced(replaced(text, "dual\": [", "dual\": [-1e3"), "[-1e3-", "[1e3");
      if (spoilt == text || grasp.find("ito") != std::string::npos) continue;
      std::ofstream(folder / "spoilt.json") << spoilt;
      EXPECT_NE(output(python + " " + path("spoilt.json")), "confirmed\n") << grasp << command;
      EXPECT_EQ(output("build/poise verify " + grasp + " " + path("spoilt.json")).find("Confirmed"),
                std::string::npos)
          << grasp << command;
    }
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace poise
