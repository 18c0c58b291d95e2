// poise batch and the ACRONYM data set, by a small file of its layout, written here.
#include <H5Cpp.h>

#include <cmath>
#include <vector>

#include "command_line.hpp"

namespace poise {
namespace {

class BatchOfAcronym : public CommandLine {
 protected:
  BatchOfAcronym() {
    fs::create_directories(folder() / "meshes/Box");
    // A box of 40 x 80 x 60 mm about the origin.
    std::string obj;
    for (int k = 0; k < 8; ++k) {
      std::ostringstream vertex;
      vertex << "v " << (k & 1 ? 20 : -20) << ' ' << (k & 2 ? 40 : -40) << ' ' << (k & 4 ? 30 : -30)
             << '\n';
      obj += vertex.str();
    }
    obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    write("meshes/Box/box.obj", obj);
    write_h5("one.h5", {0, 0.005, 0.3, -0.01});  // at 0.3 m the hand misses
    write_h5("two.h5", {0.002, 0.3, 0.004});
  }

  /// Hands that come along -z, their pads at this y.
  void write_h5(const std::string& name, const std::vector<double>& ys) const {
    const H5::H5File file((folder() / name).string(), H5F_ACC_TRUNC);
    for (const char* group :
         {"/object", "/gripper", "/grasps", "/grasps/qualities", "/grasps/qualities/flex"})
      file.createGroup(group);
    const auto put = [&](const char* path, const std::vector<hsize_t>& size,
                         const std::vector<double>& values) {
      const H5::DataSpace space = size.empty()
                                      ? H5::DataSpace(H5S_SCALAR)
                                      : H5::DataSpace(static_cast<int>(size.size()), size.data());
      file.createDataSet(path, H5::PredType::NATIVE_DOUBLE, space)
          .write(values.data(), H5::PredType::NATIVE_DOUBLE);
    };
    const auto text = [&](const char* path, const char* words) {
      const H5::StrType type(H5::PredType::C_S1, H5T_VARIABLE);
      file.createDataSet(path, type, H5::DataSpace(H5S_SCALAR)).write(&words, type);
    };
    text("/object/file", "meshes/Box/box.obj");
    text("/gripper/type", "panda");
    put("/object/scale", {}, {0.001});
    put("/object/mass", {}, {0.1});
    put("/object/friction", {}, {0.7});
    put("/object/com", {3}, {0, 0, 0.004});
    std::vector<double> transforms, held;
    for (const double y : ys) {
      transforms.insert(transforms.end(), {1, 0, 0, 0, 0, -1, 0, y, 0, 0, -1, 0.089, 0, 0, 0, 1});
      held.push_back(1);
    }
    put("/grasps/transforms", {ys.size(), 4, 4}, transforms);
    put("/grasps/qualities/flex/object_in_gripper", {ys.size()}, held);
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
           {"batch none.h5 --mesh-root .", "none.h5: cannot be read: No such file"},
           {"batch one.h5 --mesh-root . --hdf5 out.h5", "--hdf5: needs --out"},
           {"batch - --hdf5 out.h5 -o out.jsonl", "--hdf5: is for the ACRONYM data set"},
           {"batch one.h5 --mesh-root . --hdf5 none/out.h5 -o out.jsonl --max-holds 5",
            "none/out.h5: cannot be written"},
       }) {
    const Outcome run = poise(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
  }
  const Outcome lost = poise("batch one.h5 --mesh-root nowhere");  // the run goes on
  EXPECT_EQ(lost.status, 1);
  EXPECT_EQ(Json::parse(lost.out)["error"]["path"], "/object/file");
}

}  // namespace
}  // namespace poise
