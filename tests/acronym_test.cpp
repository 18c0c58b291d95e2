// The ACRONYM data set, by a small file of the same layout, written here.
#include "data/acronym.hpp"

#include <H5Cpp.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "files/grasp_writer.hpp"
#include "meshes.hpp"

namespace poise {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// What a file says; a part that is left out is not written.
struct Contents {
  std::string mesh{"meshes/Box/box.obj"}, gripper{"panda"};
  double scale{1e-4}, mass{0.013}, friction{0.8};
  std::vector<double> com{3.01, 0.02, -0.01};
  std::vector<Eigen::Matrix4d> transforms{};
  std::vector<long long> held{};
  std::string without{};  ///< a data set that is not there
};

class AcronymFile : public testing::Test {
 protected:
  AcronymFile()
      : folder_(fs::path(testing::TempDir()) / ("poise_acronym_" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "meshes/Box");
    // 400 x 800 x 600 units of 0.1 mm, 3 m from the origin, as the table of the data set is.
    write_obj(
        moved(box_mesh({400, 800, 600}), Eigen::Affine3d(Eigen::Translation3d(29800, -400, -300))),
        (folder_ / "meshes/Box/box.obj").string());
    contents_.transforms = {hand_at({3, 0, 0}), hand_at({3.5, 0, 0}), hand_at({3.03, 0, 0})};
    contents_.held = {1, 0, 0};
  }
  ~AcronymFile() override { fs::remove_all(folder_); }

  /// The hand coming along -z, its pads round this point.
  static Eigen::Matrix4d hand_at(const Vector<3>& point) {
    Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
    transform.topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(std::acos(-1.0), Vector<3>::UnitX()).toRotationMatrix();
    transform.topRightCorner<3, 1>() = point + Vector<3>(0, 0, 0.089);
    return transform;
  }

  std::string write(const Contents& c) const {
    const std::string name = (folder_ / "grasps.h5").string();
    H5::H5File file(name, H5F_ACC_TRUNC);
    for (const char* group :
         {"/object", "/gripper", "/grasps", "/grasps/qualities", "/grasps/qualities/flex"})
      file.createGroup(group);
    const auto put = [&](const std::string& path, const H5::DataType& type,
                         const std::vector<hsize_t>& size, const void* data) {
      if (path == c.without) return;
      const H5::DataSpace space = size.empty()
                                      ? H5::DataSpace(H5S_SCALAR)
                                      : H5::DataSpace(static_cast<int>(size.size()), size.data());
      H5::DataSet set = file.createDataSet(path, type, space);
      set.write(data, type);
    };
    const auto text = [&](const std::string& path, const std::string& words) {
      const char* const data = words.c_str();
      put(path, H5::StrType(H5::PredType::C_S1, H5T_VARIABLE), {}, &data);
    };
    const H5::PredType& real = H5::PredType::NATIVE_DOUBLE;
    text("/object/file", c.mesh);
    text("/gripper/type", c.gripper);
    put("/object/scale", real, {}, &c.scale);
    put("/object/mass", real, {}, &c.mass);
    put("/object/friction", real, {}, &c.friction);
    put("/object/com", real, {c.com.size()}, c.com.data());
    // Density, volume and inertia say no more than mass and com; nothing may depend on them. The
    // products of inertia have the opposite sign.
    const std::vector<double> inertia{1, -9, 0, -9, 1, 0, 0, 0, 1};
    put("/object/inertia", real, {3, 3}, inertia.data());
    std::vector<double> entries;
    for (const Eigen::Matrix4d& t : c.transforms)
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) entries.push_back(t(row, column));
    put("/grasps/transforms", real, {c.transforms.size(), 4, 4}, entries.data());
    put("/grasps/qualities/flex/object_in_gripper", H5::PredType::NATIVE_LLONG, {c.held.size()},
        c.held.data());
    return name;
  }

  std::string problem(const Contents& contents) const {
    try {
      Acronym(write(contents), folder_.string()).grasp(0);
    } catch (const FileError& error) {
      return located("", {}, error.path(), error.problem()).substr(2);
    }
    return "";
  }

  Contents contents_{};
  const fs::path folder_;
};

TEST_F(AcronymFile, IsTheObjectInItsScaledFrame) {
  const Acronym data(write(contents_), folder_.string());
  ASSERT_EQ(data.size(), 3U);
  EXPECT_TRUE(data.held(0));
  EXPECT_FALSE(data.held(2));
  const SpatialFile file = data.grasp(0);
  // The mesh is scaled; the com is in the scaled frame already.
  const Eigen::AlignedBox3d box = bounds(*file.shape);
  EXPECT_LE((box.min() - Vector<3>(2.98, -0.04, -0.03)).norm(), 1e-6);
  EXPECT_LE((box.max() - Vector<3>(3.02, 0.04, 0.03)).norm(), 1e-6);
  ASSERT_EQ(file.loads.size(), 1U);
  EXPECT_EQ(file.loads[0].com, Vector<3>(3.01, 0.02, -0.01));
  EXPECT_NEAR(file.loads[0].weight, 0.013 * standard_gravity, 1e-15);
  EXPECT_EQ(file.name, "grasps, grasp 0");
  EXPECT_EQ(file.warnings, std::vector<std::string>());
}

TEST_F(AcronymFile, PadsCloseOnTheObject) {
  const SpatialFile file = Acronym(write(contents_), folder_.string()).grasp(0);
  ASSERT_EQ(file.contacts.size(), 2U);
  Eigen::AlignedBox3d left, right;
  for (const Contact<3>& c : file.contacts) {
    EXPECT_LE((c.normal - Vector<3>(c.finger == "left" ? 1 : -1, 0, 0)).norm(), 1e-9);
    EXPECT_EQ(c.friction, 0.8);
    ASSERT_EQ(c.pad->points.size(), 24U);
    for (const Vector<3>& point : c.pad->points)
      (c.finger == "left" ? left : right).extend(c.position + point);
    // All of the pads is on the box.
    EXPECT_LE((c.pad->reach - Vector<2>(0.01, 0.023)).norm(), 1e-6);
  }
  const std::vector<Drive<3>> drives = file.grasp().drives();
  ASSERT_EQ(drives.size(), 1U);
  EXPECT_EQ(drives[0].max, 70);
  // Turned about x: left stays at -x; pads of 20 x 46 mm round the point, less half a cell.
  const Vector<3> half(0, 0.01 - 0.02 / 6, 0.023 - 0.046 / 16);
  EXPECT_LE((left.min() - Vector<3>(2.98, 0, 0) + half).norm(), 1e-6);
  EXPECT_LE((left.max() - Vector<3>(2.98, 0, 0) - half).norm(), 1e-6);
  EXPECT_LE((right.min() - Vector<3>(3.02, 0, 0) + half).norm(), 1e-6);
  EXPECT_LE((right.max() - Vector<3>(3.02, 0, 0) - half).norm(), 1e-6);
}

TEST_F(AcronymFile, IsWrittenAsAGraspFileWithItsGripper) {
  const Acronym data(write(contents_), folder_.string());
  const SpatialFile file = data.grasp(0);
  const std::string text = grasp_document(file, WriteAs::gripper, folder_.string());
  EXPECT_NE(text.find("\"meshes/Box/box.obj\""), text.npos) << text;
  const SpatialFile back =
      std::get<SpatialFile>(grasp_from_json(text, (folder_ / "out.json").string()));
  EXPECT_EQ(back.loads[0].com, file.loads[0].com);
  EXPECT_EQ(back.loads[0].weight, file.loads[0].weight);
  ASSERT_EQ(back.contacts.size(), file.contacts.size());
  for (std::size_t i = 0; i < file.contacts.size(); ++i)
    EXPECT_LE((back.contacts[i].position - file.contacts[i].position).norm(), 1e-12);
  EXPECT_EQ(back.mechanism.kind, DriveKind::coupled);
  ASSERT_EQ(back.mechanism.fingers.size(), 2U);
  for (const Finger<3>& finger : back.mechanism.fingers) EXPECT_EQ(finger.max_force, 70);
}

TEST_F(AcronymFile, AGraspThatDidNotHoldIsSaidToBeSo) {
  contents_.held[0] = 0;
  const std::vector<std::string> warnings =
      Acronym(write(contents_), folder_.string()).grasp(0).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("object_in_gripper[0]: is 0"), std::string::npos) << warnings[0];
}

TEST_F(AcronymFile, AHandThatMissesSaysSo) {
  const Acronym data(write(contents_), folder_.string());
  EXPECT_THROW(data.grasp(1), MissedGrip);
  EXPECT_THROW(data.grasp(2), MissedGrip);
  EXPECT_THROW(data.grasp(3), std::out_of_range);
}

TEST_F(AcronymFile, SaysWhatIsWrong) {
  Contents c = contents_;
  EXPECT_EQ(problem(c), "");
  for (const char* path :
       {"/object/scale", "/object/file", "/object/com", "/object/mass", "/object/friction",
        "/gripper/type", "/grasps/transforms", "/grasps/qualities/flex/object_in_gripper"}) {
    c = contents_;
    c.without = path;
    EXPECT_EQ(problem(c),
              std::string("has no data set ") + path + ": it is not a grasp file of ACRONYM");
  }
  c = contents_;
  c.com = {1, 2};
  EXPECT_EQ(problem(c), "has something else than its numbers in /object/com");
  c = contents_;
  c.held.pop_back();
  EXPECT_EQ(problem(c),
            "has something else than its numbers in /grasps/qualities/flex/object_in_gripper");
  c = contents_;
  c.scale = -1;
  EXPECT_EQ(problem(c), "has no number above 0 in /object/scale");
  c = contents_;
  c.mass = std::nan("");
  EXPECT_EQ(problem(c), "has a number in /object/mass that is not finite");
  c = contents_;
  c.gripper = "allegro";
  EXPECT_EQ(problem(c), "/gripper/type: is allegro, must be panda");
  c = contents_;
  c.mesh = "meshes/Box/bag.obj";
  EXPECT_EQ(problem(c),
            "/object/file: " + (folder_ / "meshes/Box/bag.obj").string() + " does not exist");
  c = contents_;
  c.transforms[0](0, 0) = -1;  // a mirror
  EXPECT_EQ(problem(c), "/grasps/transforms[0]: is no pose: not a turn and a step");
  try {
    Acronym((folder_ / "meshes/Box/box.obj").string(), folder_.string());
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_EQ(error.problem(), "is not a file of HDF5");
  }
}

TEST_F(AcronymFile, MostOfTheDataSetsGraspsTouchOnBothSides) {
  const char* const root = std::getenv("POISE_DATA");
  if (!root || !fs::is_directory(fs::path(root) / "acronym"))
    GTEST_SKIP() << "POISE_DATA has no acronym";
  for (const auto& entry : fs::directory_iterator(fs::path(root) / "acronym/grasps")) {
    const Acronym data(entry.path().string(), (fs::path(root) / "acronym").string());
    EXPECT_EQ(data.size(), 2000U);
    int held = 0, touched = 0;
    for (std::size_t n = 0; n < data.size(); ++n) {
      if (!data.held(n)) continue;
      ++held;
      try {
        const SpatialFile file = data.grasp(n);
        // The published centre of mass is that of the mesh.
        if (touched++ == 0) {
          EXPECT_LE((centroid(*file.shape) - file.loads[0].com).norm(), 1e-5);
        }
      } catch (const MissedGrip&) {
      }
    }
    std::printf("%s: %d held, %d touched\n", entry.path().filename().c_str(), held, touched);
    EXPECT_GT(touched, held / 2);
  }
}

}  // namespace
}  // namespace poise
