// poise batch and the ACRONYM data set, by a small file of its layout, written here.
#include <H5Cpp.h>

#include <cmath>
#include <vector>

#include "acronym_sample.hpp"
#include "command_line.hpp"

namespace poise {
namespace {

class BatchOfAcronym : public CommandLine {
 protected:
  BatchOfAcronym() {
    write_acronym_mesh(folder());
    write_acronym(folder() / "one.h5", {0, 0.005, 0.3, -0.01});  // at 0.3 m the hand misses
    write_acronym(folder() / "two.h5", {0.002, 0.3, 0.004});
  }

  /// Its records, as `poise import` and `poise best` have them.
  void check(const Json& record, const std::string& file, int grasp) const {
    EXPECT_EQ(record["file"], file);
    EXPECT_EQ(record["grasp"], grasp);
    const Outcome import = poise("import acronym " + file + " --mesh-root . --grasp " +
                                 std::to_string(grasp) + " -o one.json");
    ASSERT_EQ(import.status == 2, record.contains("error")) << record << import.err;
    if (record.contains("error")) return;
    const Json one = json("best one.json --gap 1e-2 2> /dev/null");
    EXPECT_NEAR(record["best"]["effort"].get<double>() / one["best"]["effort"].get<double>(), 1,
                2e-2);
    EXPECT_EQ(record["best"]["fingers"].size(), 2U);
  }

  /// The numbers of an array.
  static std::vector<double> numbers(const H5::H5File& file, const std::string& path) {
    const H5::DataSet set = file.openDataSet(path);
    std::vector<double> values(static_cast<std::size_t>(set.getSpace().getSimpleExtentNpoints()));
    set.read(values.data(), H5::PredType::NATIVE_DOUBLE);
    return values;
  }
};

constexpr const char* options = " --mesh-root . --gap 1e-2 --max-holds 50";

TEST_F(BatchOfAcronym, RecordsAreThoseOfSingleGrasps) {
  const Outcome run = poise(std::string("batch one.h5 two.h5 -o out.jsonl") + options);
  EXPECT_EQ(run.status, 1) << run.err;
  std::ifstream out(folder() / "out.jsonl");
  int record = 0;
  for (std::string line; std::getline(out, line); ++record) {
    const Json parsed = Json::parse(line);
    EXPECT_EQ(parsed["record"], record);
    check(parsed, record < 4 ? "one.h5" : "two.h5", record < 4 ? record : record - 4);
  }
  EXPECT_EQ(record, 7);
  EXPECT_NE(run.err.find("7 records: 5 answered, 0 unholdable, 2 bad"), std::string::npos)
      << run.err;
}

TEST_F(BatchOfAcronym, ArraysGoWithTheTransforms) {
  poise(std::string("batch one.h5 two.h5 -o out.jsonl --hdf5 out.h5") + options);
  ASSERT_TRUE(fs::exists(folder() / "out.h5"));
  EXPECT_FALSE(fs::exists(folder() / "out.h5.part"));
  const H5::H5File file((folder() / "out.h5").string(), H5F_ACC_RDONLY);
  EXPECT_EQ(numbers(file, "one/holdable"), (std::vector<double>{1, 1, -1, 1}));
  EXPECT_EQ(numbers(file, "two/holdable"), (std::vector<double>{1, -1, 1}));
  std::ifstream out(folder() / "out.jsonl");
  for (std::string line; std::getline(out, line);) {
    const Json record = Json::parse(line);
    const std::string group = record["file"] == "one.h5" ? "one/" : "two/";
    const std::size_t n = record["grasp"];
    for (const std::string kind : {"best", "best_pinched"}) {
      const auto up = numbers(file, group + kind + "_up");
      const auto effort = numbers(file, group + kind + "_effort");
      const auto normal = numbers(file, group + kind + "_normal_force");
      const Json hold = record.value(kind, Json());
      if (hold.is_null()) {
        EXPECT_TRUE(std::isnan(effort[n]));
        EXPECT_TRUE(std::isnan(up[3 * n]));
        continue;
      }
      EXPECT_EQ(effort[n], hold["effort"]);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(up[3 * n + k], hold["up"][k]);
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_EQ(normal[2 * n + k], hold["fingers"][k]["normal_force"]);
    }
  }
  std::string units, fingers;
  const H5::DataSet set = file.openDataSet("one/best_normal_force");
  const H5::Attribute unit = set.openAttribute("units"), label = set.openAttribute("fingers");
  unit.read(unit.getStrType(), units);
  label.read(label.getStrType(), fingers);
  EXPECT_EQ(units, "N");
  EXPECT_EQ(fingers, "left,right");
}

TEST_F(BatchOfAcronym, ResumedItIsTheSame) {
  const std::string run = std::string("batch one.h5 two.h5 -o out.jsonl --hdf5 out.h5") + options;
  poise(run);
  const std::string expected = contents(folder() / "out.jsonl");
  shell("(ulimit -f 4; '" POISE_PROGRAM "' batch one.h5 two.h5 -o again.jsonl --hdf5 again.h5 " +
        std::string(options) + ")");
  ASSERT_TRUE(fs::exists(folder() / "again.jsonl.part"));
  EXPECT_FALSE(fs::exists(folder() / "again.h5"));
  std::string resumed = run + " --resume";
  for (const char* name : {"out.jsonl", "out.h5"}) resumed.replace(resumed.find(name), 3, "again");
  EXPECT_EQ(poise(resumed).status, 1);
  EXPECT_EQ(contents(folder() / "again.jsonl"), expected);
  EXPECT_TRUE(contents(folder() / "again.h5") == contents(folder() / "out.h5"));
}

TEST_F(BatchOfAcronym, WhatIsWrongIsSaid) {
  for (const auto& [arguments, words] : {
           std::pair("batch one.h5", "one.h5: needs --mesh-root"),
           {"batch none.h5 --mesh-root .", "none.h5: does not exist"},
           {"batch one.h5 --mesh-root . --hdf5 out.h5", "--hdf5: needs --out"},
           {"batch - --hdf5 out.h5 -o out.jsonl", "--hdf5: is for the ACRONYM data set"},
           {"batch one.h5 --mesh-root . --hdf5 none/out.h5 -o out.jsonl --max-holds 5",
            "none/out.h5: cannot be written"},
       }) {
    const Outcome run = poise(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
  }
  EXPECT_FALSE(fs::exists(folder() / "out.jsonl.part"));
}

TEST_F(BatchOfAcronym, ABadFileIsBadRecordsAndTheRunGoesOn) {
  // Without its mesh each grasp is a bad record, so that its arrays are as long as its transforms.
  fs::create_directory(folder() / "other");
  write_acronym(folder() / "lost.h5", {0, 0, 0, 0, 0}, "meshes/none.obj");
  write("no.h5", "no HDF5");
  const Outcome run =
      poise(std::string("batch lost.h5 no.h5 two.h5 -o out.jsonl --hdf5 out.h5") + options);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("9 records: 2 answered, 0 unholdable, 7 bad"), std::string::npos)
      << run.err;
  std::ifstream out(folder() / "out.jsonl");
  int record = 0;
  for (std::string line; std::getline(out, line); ++record) {
    const Json parsed = Json::parse(line);
    if (record < 5) {
      EXPECT_EQ(parsed["error"]["path"], "/object/file");
      EXPECT_EQ(parsed["grasp"], record);
    } else if (record == 5) {
      EXPECT_EQ(parsed["error"]["problem"], "is not a file of HDF5");
      EXPECT_FALSE(parsed.contains("grasp"));
    }
  }
  const H5::H5File file((folder() / "out.h5").string(), H5F_ACC_RDONLY);
  EXPECT_EQ(numbers(file, "lost/holdable"), std::vector<double>(5, -1));
  EXPECT_EQ(numbers(file, "lost/best_effort").size(), 5U);
  EXPECT_EQ(numbers(file, "two/holdable"), (std::vector<double>{1, -1, 1}));
  EXPECT_FALSE(file.nameExists("no"));
}

TEST_F(BatchOfAcronym, ABadPoseIsOneBadRecord) {
  const double none = std::nan("");
  write_acronym(folder() / "poses.h5", {0, none, 1e30, 0.002});
  const Outcome run = poise(std::string("batch poses.h5") + options);
  std::istringstream out(run.out);
  std::vector<std::string> problems;
  for (std::string line; std::getline(out, line);)
    problems.push_back(Json::parse(line).value("error", Json::object()).value("problem", ""));
  ASSERT_EQ(problems.size(), 4U) << run.err;
  EXPECT_EQ(problems[0] + problems[3], "");
  EXPECT_EQ(problems[1], "is no pose: not a turn and a step");
  EXPECT_EQ(problems[2].find("the left pad is farther than a million times its size"), 0U)
      << problems[2];
}

TEST_F(BatchOfAcronym, ClaimsOfManyGraspsAreRefused) {
  {
    H5::H5File file((folder() / "many.h5").string(), H5F_ACC_TRUNC);
    const hsize_t size[] = {100'000'000'000, 4, 4}, chunk[] = {1, 4, 4};
    H5::DSetCreatPropList chunks;  // which take room only where something is written
    chunks.setChunk(3, chunk);
    file.createGroup("/grasps");
    file.createDataSet("/grasps/transforms", H5::PredType::NATIVE_DOUBLE, H5::DataSpace(3, size),
                       chunks);
  }
  const Outcome run = poise(std::string("batch many.h5 two.h5") + options);
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(Json::parse(run.out.substr(0, run.out.find('\n')))["error"]["problem"],
            "has 100000000000 of /grasps/transforms, at most 1000000 are read");
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 4);
}

TEST_F(BatchOfAcronym, ArraysAreWrittenOverNothing) {
  const std::string run = "batch one.h5 --mesh-root . -o out.jsonl --hdf5 ";
  fs::create_directory(folder() / "folder");
  const std::string before = contents(folder() / "one.h5");
  for (const auto& [file, words] :
       {std::pair("one.h5", "one.h5: is read by this command, must be another file"),
        {"./out.jsonl", "--hdf5: must be another file than that of --out"},
        {"out.jsonl.part", "--hdf5: must be another file than that of --out"},
        {"folder", "folder: is a folder, must be a file"},
        {"/dev/null", "/dev/null and out.jsonl must be files"}}) {
    const Outcome refused = poise(run + file);
    EXPECT_EQ(refused.status, 2) << file;
    EXPECT_NE(refused.err.find(words), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(folder() / "out.jsonl.part")) << file;
  }
  EXPECT_EQ(contents(folder() / "one.h5"), before);
  fs::copy_file(folder() / "one.h5", folder() / "folder/one.h5");
  EXPECT_NE(poise("batch one.h5 folder/one.h5 --mesh-root . -o out.jsonl --hdf5 out.h5")
                .err.find("two inputs would make the group one"),
            std::string::npos);
  fs::rename(folder() / "two.h5", folder() / "TWO.H5");
  EXPECT_EQ(poise(std::string("batch TWO.H5 -o out.jsonl --hdf5 out.h5") + options).status, 1);
}

}  // namespace
}  // namespace poise
