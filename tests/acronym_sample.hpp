// A small data set like ACRONYM, for tests.
#pragma once

#include <H5Cpp.h>

#include <filesystem>
#include <fstream>
#include <vector>

namespace poise {

/// meshes/Box/box.obj: a box of 40 x 80 x 60 mm about the origin.
inline void write_acronym_mesh(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "meshes/Box");
  std::ofstream obj(folder / "meshes/Box/box.obj");
  for (int k = 0; k < 8; ++k)
    obj << "v " << (k & 1 ? 20 : -20) << ' ' << (k & 2 ? 40 : -40) << ' ' << (k & 4 ? 30 : -30)
        << '\n';
  obj << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

/// A file of that layout: hands that come along -z, their pads at this y.
inline void write_acronym(const std::filesystem::path& name, const std::vector<double>& ys,
                          const char* mesh = "meshes/Box/box.obj") {
  const H5::H5File file(name.string(), H5F_ACC_TRUNC);
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
  text("/object/file", mesh);
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

}  // namespace poise
