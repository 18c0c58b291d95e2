// many_grasps FILE OUT COUNT: a file of the ACRONYM data set with so many grasps. They are those of
// FILE again and again, from the second time on with the hand moved by up to 1 mm and turned by up
// to 1 degree about each of its axes.
#include <H5Cpp.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <random>
#include <vector>

namespace {

using Transform = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

template <class T>
std::vector<T> read(const H5::H5File& file, const char* path, const H5::PredType& type) {
  const H5::DataSet set = file.openDataSet(path);
  std::vector<T> values(static_cast<std::size_t>(set.getSpace().getSimpleExtentNpoints()));
  set.read(values.data(), type);
  return values;
}

/// Puts other values in the place of those that are there.
template <class T>
void replace(const H5::H5File& file, const char* path, const std::vector<hsize_t>& size,
             const std::vector<T>& values, const H5::PredType& type) {
  file.unlink(path);
  const H5::DataSpace space(static_cast<int>(size.size()), size.data());
  file.createDataSet(path, type, space).write(values.data(), type);
}

void make(const char* from, const char* to, std::size_t count) {
  namespace fs = std::filesystem;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  fs::permissions(to, fs::perms::owner_write, fs::perm_options::add);
  const H5::H5File file(to, H5F_ACC_RDWR);
  const char* const poses = "/grasps/transforms";
  const char* const held = "/grasps/qualities/flex/object_in_gripper";
  const auto old_poses = read<double>(file, poses, H5::PredType::NATIVE_DOUBLE);
  const auto old_held = read<int>(file, held, H5::PredType::NATIVE_INT);

  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr double millimetre = 1e-3, degree = 3.14159265358979323846 / 180;
  std::vector<double> new_poses;
  std::vector<int> new_held;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t n = k % old_held.size();
    Transform pose = Eigen::Map<const Transform>(&old_poses[16 * n]);
    if (k >= old_held.size()) {
      Eigen::Affine3d move = Eigen::Affine3d::Identity();
      for (int axis = 0; axis < 3; ++axis) {
        move.translate(millimetre * uniform(random) * Eigen::Vector3d::Unit(axis));
        move.rotate(Eigen::AngleAxisd(degree * uniform(random), Eigen::Vector3d::Unit(axis)));
      }
      pose = Transform(pose * move.matrix());
    }
    new_poses.insert(new_poses.end(), pose.data(), pose.data() + 16);
    new_held.push_back(old_held[n]);
  }
  replace(file, poses, {count, 4, 4}, new_poses, H5::PredType::NATIVE_DOUBLE);
  replace(file, held, {count}, new_held, H5::PredType::NATIVE_INT);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: many_grasps FILE OUT COUNT\n", stderr);
    return 2;
  }
  try {
    make(argv[1], argv[2], std::strtoul(argv[3], nullptr, 10));
  } catch (const H5::Exception& error) {
    std::fprintf(stderr, "many_grasps: %s\n", error.getCDetailMsg());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "many_grasps: %s\n", error.what());
    return 2;
  }
  return 0;
}
