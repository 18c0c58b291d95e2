// The program as its users meet it: a child process with arguments, streams and an exit status.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace poise {

namespace fs = std::filesystem;
using Json = nlohmann::json;

inline std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

struct Outcome {
  int status;  ///< -1 where a signal ended it
  std::string out, err;
};

class CommandLine : public testing::Test {
 protected:
  CommandLine()
      : folder_(fs::path(testing::TempDir()) / ("poise_cli_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);  // of one that was killed
    fs::create_directories(folder_);
  }
  ~CommandLine() override { fs::remove_all(folder_); }

  /// Runs the program in the test's folder; the arguments are a piece of shell.
  Outcome poise(const std::string& arguments, const std::string& environment = "") const {
    return shell(environment + " '" POISE_PROGRAM "' " + arguments);
  }
  Outcome shell(const std::string& command) const {
    const std::string in = folder_.string();
    const int status =
        std::system(("cd '" + in + "' && (" + command + ") >out.txt 2>err.txt </dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder_ / "out.txt"),
            contents(folder_ / "err.txt")};
  }
  Json json(const std::string& arguments, int status = 0) const {
    const Outcome run = poise(arguments + " --json");
    EXPECT_EQ(run.status, status) << arguments << "\n" << run.err;
    EXPECT_EQ(run.err, "") << arguments;
    return Json::parse(run.out);
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return name;
  }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

inline std::string example(const std::string& name) {
  return "'" POISE_EXAMPLES "/" + name + ".yaml'";
}

}  // namespace poise
