// Grasps written as JSON, and within the page.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "ask/ask.hpp"
#include "ask/document.hpp"
#include "files/grasp_writer.hpp"

namespace poise {
namespace {

namespace fs = std::filesystem;

/// All that is understood of a grasp file.
template <class File>
std::string understood(const File& file) {
  const auto grasp = file.grasp();
  return document(file, grasp, ask(file, grasp, {.command = Command::check}));
}

TEST(GraspWriter, WritesWhatItReads) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(POISE_EXAMPLES)) {
    if (entry.path().extension() != ".yaml") continue;
    const GraspFile any = read_grasp_file(entry.path().string());
    ++files;
    std::visit(
        []<class File>(const File& file) {
          const auto again = std::get<File>(grasp_from_json(grasp_document(file), "again"));
          EXPECT_EQ(understood(again), understood(file));
        },
        any);
  }
  EXPECT_GE(files, 8U);
}

TEST(GraspWriter, WritesEveryKey) {
  const std::string text = R"({"poise": 1, "dimension": 2, "name": "\u003c\"ä", "safety": 1.25,
    "angle_deg": -170, "domain": "pinching-up",
    "object": {"weight": 3, "com": [0.1, 0], "shape": {"ellipse": {"radii": [1, 0.5]}}},
    "contacts": [{"position": [1, 0], "normal": [-1, 0.25], "friction": 0.3, "min_normal": 0.5,
                  "max_normal": 7, "share": 0.5, "finger": "f"},
                 {"position": [-1, 0], "friction": 1}]})";
  const auto file = std::get<PlanarFile>(grasp_from_json(text, "f"));
  const auto written = nlohmann::json::parse(grasp_document(file));
  auto expected = nlohmann::json::parse(text);
  expected["contacts"][1]["normal"] = {1, 0};
  EXPECT_NEAR(written["angle_deg"], -170, 1e-12);
  expected["angle_deg"] = written["angle_deg"];
  EXPECT_EQ(written, expected);
}

TEST(GraspWriter, WritesEveryKeyInSpace) {
  const std::string text = R"({"poise": 1, "dimension": 3, "name": "n", "safety": 1.25,
    "up": [0, -1, 0], "tilt": {"from": [0, 0, 1], "max_deg": 90},
    "object": {"weight": 3, "com": [0.1, 0, 0], "shape": {"ellipsoid": {"radii": [1, 0.5, 2]}}},
    "loads": [{"name": "one"}, {"weight": 2, "com": [0, 0, 1], "acceleration": {"up": 2}},
              {"acceleration": {"fixed": [0, 1, 2]}, "force": [1, 0, 0], "moment": [0, 2, 0]}],
    "contacts": [{"position": [1, 0, 0], "normal": [-1, 0.25, 0], "friction": 0.3, "torsion": 0.01,
                  "min_normal": 0.5, "max_normal": 7, "share": 0.5, "finger": "f"},
                 {"position": [-1, 0, 0], "friction": 1}]})";
  const auto file = std::get<SpatialFile>(grasp_from_json(text, "f"));
  auto expected = nlohmann::json::parse(text);
  expected["contacts"][1]["normal"] = {1, 0, 0};
  EXPECT_EQ(nlohmann::json::parse(grasp_document(file)), expected);
}

std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The program as it is installed, with a page beside it or without.
class View : public testing::Test {
 protected:
  View() : folder_(fs::path(testing::TempDir()) / ("poise_view_" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "bin");
    fs::create_directories(folder_ / "share/poise");
    fs::copy_file(POISE_PROGRAM, folder_ / "bin/poise", fs::copy_options::overwrite_existing);
  }
  ~View() override { fs::remove_all(folder_); }

  void install_page() const {
    std::ofstream(folder_ / "share/poise/playground.html")
        << "<!doctype html><script type=\"application/json\" id=\"grasp\">null</script><p>page";
  }
  int poise(const std::string& arguments) const {
    const int status = std::system(("cd '" + folder_.string() + "' && bin/poise " + arguments +
                                    " >out.txt 2>err.txt </dev/null")
                                       .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string text(const std::string& file) const { return contents(folder_ / file); }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

TEST_F(View, WritesThePageWithTheGraspInside) {
  install_page();
  ASSERT_EQ(poise("view '" POISE_EXAMPLES "/l-part.yaml'"), 0) << text("err.txt");
  EXPECT_EQ(text("out.txt"), "Wrote l-part.html: open it in a browser.\n");
  const std::string page = text("l-part.html");
  EXPECT_TRUE(page.ends_with("</script><p>page"));
  EXPECT_NE(page.find(R"("name": "L-shaped part between two fingers")"), std::string::npos);
}

TEST_F(View, NamesAreNeverMarkup) {
  install_page();
  std::ofstream(folder() / "f.json") << R"({"poise": 1, "dimension": 2,
    "name": "</script><script>alert(1)</script>", "object": {"weight": 1, "com": [0, 0]},
    "contacts": [{"position": [0, -1], "normal": [0, 1], "friction": 1}]})";
  ASSERT_EQ(poise("view f.json -o page.html"), 0) << text("err.txt");
  const std::string page = text("page.html");
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  const std::size_t from = page.find('{'), to = page.find("</script>");
  const auto grasp = nlohmann::json::parse(page.substr(from, to - from));
  EXPECT_EQ(grasp["name"], "</script><script>alert(1)</script>");
}

TEST_F(View, SaysSoWhereThereIsNoPage) {
  EXPECT_EQ(poise("view '" POISE_EXAMPLES "/l-part.yaml'"), 2);
  EXPECT_EQ(text("out.txt"), "");
  EXPECT_NE(text("err.txt").find("build it with ./dev web"), std::string::npos) << text("err.txt");
  EXPECT_FALSE(fs::exists(folder() / "l-part.html"));
}

TEST_F(View, InSpace) {
  install_page();
  ASSERT_EQ(poise("view '" POISE_EXAMPLES "/bottle.yaml'"), 0) << text("err.txt");
  const std::string page = text("bottle.html");
  EXPECT_NE(page.find(R"("loads": [)"), std::string::npos);
}

TEST_F(View, ABadFileLeavesNoPage) {
  install_page();
  std::ofstream(folder() / "f.yaml") << "poise: 1\n";
  EXPECT_EQ(poise("view f.yaml"), 2);
  EXPECT_NE(text("err.txt").find("f.yaml"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder() / "f.html"));
}

}  // namespace
}  // namespace poise
