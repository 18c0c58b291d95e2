// poise batch: many grasps, a line for each, to be continued after any end.
#include <fcntl.h>
#include <pty.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>

#include <random>
#include <regex>
#include <vector>

#include "command_line.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration)

namespace poise {
namespace {

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) list.push_back(line);
  return list;
}

/// Grasps in the plane and in space, every seventh of which is bad and every fifth slips off its
/// only finger.
std::string grasps(int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::string text;
  for (int k = 0; k < count; ++k) {
    const bool space = k % 9 == 0;
    const auto vector = [&](double x, double y, double z) {
      return space ? Json{x, y, z} : Json{x, y};
    };
    Json grasp = {{"poise", 1}, {"dimension", space ? 3 : 2}, {"name", "g" + std::to_string(k)}};
    grasp["object"] = {
        {"weight", k % 7 == 3 ? -1 : 5 + uniform(random)},
        {"com", vector(0.2 * uniform(random), 0.2 * uniform(random), 0.1 * uniform(random))}};
    const double friction = k % 5 == 2 ? 0 : 0.8;
    grasp["contacts"] = {
        {{"position", vector(1, 0.1 * uniform(random), 0)},
         {"normal", vector(-1, 0, 0)},
         {"friction", friction}},
        {{"position", vector(-1, 0.1 * uniform(random), 0.1)},
         {"normal", vector(1, 0, 0)},
         {"friction", friction}},
        {{"position", vector(0.1, 1, -0.1)}, {"normal", vector(0, -1, 0)}, {"friction", friction}}};
    if (friction == 0) grasp["contacts"] = {grasp["contacts"][0]};
    text += grasp.dump() + "\n";
  }
  return text;
}

class Batch : public CommandLine {
 protected:
  /// Ends a run of the program as soon as it has written so much.
  void kill_at(std::uintmax_t bytes, std::vector<std::string> arguments) const {
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    ASSERT_EQ(posix_spawn(&child, POISE_PROGRAM, &actions, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
    std::error_code none;
    int status = 0;
    const fs::path part = folder() / "out.jsonl.part";
    while (waitpid(child, &status, WNOHANG) == 0) {
      if (const auto size = fs::file_size(part, none); !none && size >= bytes) {
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
        return;
      }
      sched_yield();
    }
  }
  /// What a run of the program writes on a terminal, until it ends or has written what `enough`
  /// finds: then it is ended.
  static std::string on_a_terminal(std::vector<std::string> arguments, const std::regex& enough) {
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    int terminal = 0;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0) {
      execv(POISE_PROGRAM, argv.data());
      _exit(127);
    }
    std::string written;
    char some[4096];
    for (ssize_t size; (size = read(terminal, some, sizeof some)) > 0;) {
      written.append(some, static_cast<std::size_t>(size));
      if (std::regex_search(written, enough)) kill(child, SIGKILL);
    }
    close(terminal);
    int status = 0;
    waitpid(child, &status, 0);
    return written;
  }
  bool there(const std::string& name) const { return fs::exists(folder() / name); }
};

TEST_F(Batch, RecordsAreTheAnswersOfSingleGrasps) {
  write("in.jsonl", grasps(60));
  const Outcome run = poise("batch in.jsonl -o out.jsonl --gap 1e-3");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.out, "");
  const auto in = lines(contents(folder() / "in.jsonl"));
  const auto out = lines(contents(folder() / "out.jsonl"));
  ASSERT_EQ(out.size(), in.size());
  EXPECT_FALSE(there("out.jsonl.part"));
  EXPECT_FALSE(there("out.jsonl.run"));
  int answered = 0, unholdable = 0, bad = 0;
  for (std::size_t k = 0; k < in.size(); ++k) {
    const Json record = Json::parse(out[k]);
    EXPECT_EQ(record["record"], k);
    if (k % 7 == 3) {
      ++bad;
      EXPECT_EQ(record["error"]["path"], "object.weight");
      EXPECT_EQ(record["error"]["problem"], "is -1, must be at least 0");
      EXPECT_GT(record["error"]["column"], 1);
      continue;
    }
    EXPECT_EQ(record["name"], "g" + std::to_string(k));
    write("one.json", in[k]);
    const bool holds = !record["best"].is_null();
    ++(holds ? answered : unholdable);
    const Json one = json(k % 9 == 0 ? "best one.json --gap 1e-3" : "best one.json", holds ? 0 : 1);
    for (const char* key : {"status", "lower_bound", "relative_gap"})
      EXPECT_EQ(record[key], one[key]) << key << " of " << k;
    for (const char* which : {"best", "best_pinched"}) {
      ASSERT_EQ(record[which].is_null(), one[which].is_null()) << k;
      EXPECT_FALSE(record[which].contains("contacts"));
      for (const auto& [key, value] : record[which].items())
        EXPECT_EQ(value, one[which][key]) << which << " " << key << " of " << k;
    }
  }
  EXPECT_GT(answered, 20);
  EXPECT_GT(unholdable, 5);
  EXPECT_EQ(lines(run.err).back(),
            std::to_string(in.size()) + " records: " + std::to_string(answered) + " answered, " +
                std::to_string(unholdable) + " unholdable, " + std::to_string(bad) + " bad");
}

TEST_F(Batch, OnePostureOfEachGrasp) {
  const std::string disk = R"({"poise": 1, "dimension": 2, "object": {"weight": 10, "com": [0, 0]},
    "contacts": [{"position": [1, 0], "normal": [-1, 0], "friction": 1},
                 {"position": [-1, 0], "normal": [1, 0], "friction": 1}]})";
  std::string line = disk;
  std::replace(line.begin(), line.end(), '\n', ' ');
  write("in.jsonl", line + "\n");
  write("one.json", disk);
  for (const char* posture : {"", "--angle 20", "--up 0.3,-0.4"}) {
    const Json record =
        Json::parse(poise(std::string("batch in.jsonl --what hold ") + posture).out);
    const Json one = json(std::string("hold one.json ") + posture);
    for (const char* key : {"holdable", "effort", "lower_bound", "grip", "fingers"})
      EXPECT_EQ(record[key], one[key]) << posture;
    EXPECT_NEAR(record["angle_deg"], one["angle_deg"], 1e-12) << posture;
  }
  const Json wrong = Json::parse(poise("batch in.jsonl --what hold --up 0,0,1").out);
  EXPECT_EQ(wrong["error"]["path"], "up");
}

TEST_F(Batch, AFolderInTheOrderOfNames) {
  fs::create_directories(folder() / "grasps");
  for (const char* name : {"l-part", "box-soft-jaws", "ito-fig6"})
    fs::copy_file(fs::path(POISE_EXAMPLES) / (std::string(name) + ".yaml"),
                  folder() / "grasps" / (std::string(name) + ".yaml"));
  write("grasps/bad.json", "{\n\"poise\": 2}");
  write("grasps/notes.txt", "no grasp");
  const Outcome run = poise("batch grasps --gap 1e-2");
  const auto out = lines(run.out);
  ASSERT_EQ(out.size(), 4U) << run.err;
  const char* const names[] = {"bad.json", "box-soft-jaws.yaml", "ito-fig6.yaml", "l-part.yaml"};
  for (std::size_t k = 0; k < out.size(); ++k) EXPECT_EQ(Json::parse(out[k])["file"], names[k]);
  EXPECT_EQ(Json::parse(out[0])["error"]["line"], 2);
  EXPECT_EQ(Json::parse(out[3])["best"]["grip"], json("best " + example("l-part"))["best"]["grip"]);
  fs::create_directories(folder() / "empty");
  EXPECT_EQ(poise("batch empty").status, 2);
}

TEST_F(Batch, StrangeLines) {
  const std::string good = lines(grasps(2))[1];
  write("in.jsonl", "\n{\n" + std::string(3 << 20, ' ') + "\n" + good + "\r\n[]\nnull\n" + good);
  const Outcome run = poise("batch - < in.jsonl");
  const auto out = lines(run.out);
  ASSERT_EQ(out.size(), 7U) << run.err;
  for (const std::size_t k : {0U, 1U, 2U, 4U, 5U})
    EXPECT_TRUE(Json::parse(out[k])["error"].contains("problem")) << out[k];
  EXPECT_EQ(Json::parse(out[2])["error"]["problem"], "is longer than 1 MiB");
  EXPECT_EQ(Json::parse(out[3])["best"], Json::parse(out[6])["best"]);
  EXPECT_NE(run.err.find("7 records: 2 answered, 0 unholdable, 5 bad"), std::string::npos);
  write("none.jsonl", "");
  EXPECT_EQ(poise("batch none.jsonl -o none.out").status, 0);
  EXPECT_EQ(contents(folder() / "none.out"), "");
}

TEST_F(Batch, StrictStopsAndLeavesNothing) {
  write("in.jsonl", grasps(10));
  const Outcome run = poise("batch in.jsonl -o out.jsonl --strict");
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("\"record\":3"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("is -1, must be at least 0"), std::string::npos) << run.err;
  for (const char* name : {"out.jsonl", "out.jsonl.part", "out.jsonl.run"})
    EXPECT_FALSE(there(name)) << name;
}

TEST_F(Batch, KilledAtAnyMomentItGoesOn) {
  write("in.jsonl", grasps(150));
  const std::string in = folder() / "in.jsonl", file = folder() / "out.jsonl";
  const Outcome undisturbed = poise("batch '" + in + "' -o '" + file + "' --gap 1e-2");
  const std::string expected = contents(file);
  ASSERT_EQ(lines(expected).size(), 150U);
  std::mt19937 random(std::random_device{}());
  std::uniform_int_distribution<std::uintmax_t> anywhere(0, expected.size());
  for (int run = 0; run < 5; ++run) {
    fs::remove(file);
    for (int kill = 0; kill < 3 && !fs::exists(file); ++kill)
      kill_at(anywhere(random), {"poise", "batch", in, "-o", file, "--gap", "1e-2", "--resume"});
    const Outcome last = poise("batch '" + in + "' -o '" + file + "' --gap 1e-2 --resume");
    EXPECT_EQ(contents(file), expected);
    if (last.err.find("is finished") == std::string::npos) {
      EXPECT_EQ(last.err, undisturbed.err);  // counts of all records
      EXPECT_EQ(last.status, undisturbed.status);
    }
    EXPECT_FALSE(there("out.jsonl.part"));
    EXPECT_FALSE(there("out.jsonl.run"));
  }
}

TEST_F(Batch, ATornLineIsCutOff) {
  write("in.jsonl", grasps(40));
  poise("batch in.jsonl -o out.jsonl");
  const std::string expected = contents(folder() / "out.jsonl");
  // A note of the run, from one that had no room.
  ASSERT_EQ(shell("(ulimit -f 1; '" POISE_PROGRAM "' batch in.jsonl -o again.jsonl)").status, 2);
  ASSERT_TRUE(there("again.jsonl.run"));
  const std::string note = contents(folder() / "again.jsonl.run");
  for (std::size_t bytes = 0; bytes <= expected.size(); bytes += 1 + expected.size() / 19) {
    write("again.jsonl.run", note);
    write("again.jsonl.part", expected.substr(0, bytes));
    fs::remove(folder() / "again.jsonl");
    const Outcome run = poise("batch in.jsonl -o again.jsonl --resume");
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_EQ(contents(folder() / "again.jsonl"), expected) << bytes;
  }
}

TEST_F(Batch, AFullDiskLeavesWholeRecords) {
  write("in.jsonl", grasps(40));
  poise("batch in.jsonl -o out.jsonl");
  const std::string expected = contents(folder() / "out.jsonl");
  const Outcome full = shell("(ulimit -f 8; '" POISE_PROGRAM "' batch in.jsonl -o again.jsonl)");
  EXPECT_EQ(full.status, 2);
  EXPECT_NE(full.err.find("go on with --resume: File too large"), std::string::npos) << full.err;
  const std::string part = contents(folder() / "again.jsonl.part");
  EXPECT_GT(part.size(), 2000U);
  EXPECT_EQ(part.back(), '\n');
  EXPECT_EQ(part, expected.substr(0, part.size()));
  EXPECT_EQ(poise("batch in.jsonl -o again.jsonl --resume").status, 1);
  EXPECT_EQ(contents(folder() / "again.jsonl"), expected);
  const Outcome device = poise("batch in.jsonl > /dev/full");
  EXPECT_EQ(device.status, 2);
  EXPECT_NE(device.err.find("No space left"), std::string::npos) << device.err;
}

TEST_F(Batch, WhatCannotBeContinuedIsRefused) {
  write("in.jsonl", grasps(40));
  const auto full = [&] {
    shell("rm -f out.*; (ulimit -f 8; '" POISE_PROGRAM "' batch in.jsonl -o out.jsonl)");
    ASSERT_TRUE(there("out.jsonl.part"));
  };
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const std::string before = contents(folder() / "out.jsonl.part");
    const Outcome run = poise(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
    EXPECT_EQ(contents(folder() / "out.jsonl.part"), before);
  };
  full();
  refused("batch in.jsonl -o out.jsonl", "unfinished run");
  refused("batch in.jsonl -o out.jsonl --resume --gap 1e-3", "of another run");
  refused("batch in.jsonl -o out.jsonl --resume --what hold", "of another run");
  refused("batch in.jsonl in.jsonl -o out.jsonl --resume", "of another run");
  write("in.jsonl", grasps(41));
  refused("batch in.jsonl -o out.jsonl --resume", "of another run");
  full();
  write("out.jsonl.part", "nonsense\n");
  refused("batch in.jsonl -o out.jsonl --resume", "out.jsonl.part:1:1: is not a record");
}

TEST_F(Batch, ABarOnATerminalAlone) {
  write("few.jsonl", grasps(10));
  const std::string few = folder() / "few.jsonl", out = folder() / "out.jsonl";
  const std::string end = on_a_terminal({"poise", "batch", few, "-o", out}, std::regex("never"));
  EXPECT_TRUE(end.ends_with("\r\033[K10 records: 7 answered, 2 unholdable, 1 bad\r\n")) << end;
  const std::string plain = poise("batch few.jsonl").err;
  EXPECT_EQ(plain, "10 records: 7 answered, 2 unholdable, 1 bad\n");

  const std::string line = lines(grasps(2))[1] + "\n";
  std::string text;
  for (int k = 0; k < 100000; ++k) text += line;  // longer than any bar takes to come
  write("many.jsonl", text);
  const std::regex bar(R"(\r\[=* *\] \d+ records, [\d.]+/s, \d+ %, [\dhmins ]+ left\x1b\[K)");
  const std::string many = folder() / "many.jsonl", other = folder() / "other.jsonl";
  EXPECT_TRUE(std::regex_search(on_a_terminal({"poise", "batch", many, "-o", other}, bar), bar));
}

TEST_F(Batch, WhatCannotBeUsedIsRefusedAtOnce) {
  write("in.jsonl", grasps(3));
  for (const auto& [arguments, words] : {
           std::pair("batch none.jsonl -o out.jsonl", "none.jsonl: does not exist"),
           {"batch in.jsonl -o none/out.jsonl", "none/out.jsonl: cannot be written"},
           {"batch in.jsonl -o in.jsonl/out", "in.jsonl/out: cannot be written: Not a directory"},
           {"batch in.jsonl -o out.jsonl --up 0,1", "--up: is for --what hold"},
           {"batch in.jsonl -o out.jsonl --what hold --gap 0.1", "--gap: is for --what best"},
           {"batch in.jsonl --what all", "--what: 'all' must be best or hold"},
           {"batch in.jsonl --resume", "--resume: needs --out"},
           {"batch", "INPUT is required"},
       }) {
    const Outcome run = poise(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
    EXPECT_FALSE(there("out.jsonl.part"));
  }
}

}  // namespace
}  // namespace poise
