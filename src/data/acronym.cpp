#include "data/acronym.hpp"

#include <filesystem>

#include "files/mesh_field.hpp"
#include "shape/characters.hpp"

namespace poise {
namespace {

AcronymData read(const std::string& file) {
  try {
    return read_acronym(file);
  } catch (const ReadError& error) {
    throw FileError(file, {}, "", error.what());
  }
}

/// The Panda hand as the data set has it: it comes along +z of its base, its fingers close along x,
/// from 41 mm to either side, and their pads reach from 66 to 112 mm along z.
ParallelJaw panda() {
  ParallelJaw jaw;
  jaw.pose.position.z() = 0.089;
  jaw.opening = 0.082;
  jaw.width = 0.02;
  jaw.height = 0.046;
  jaw.samples = 24;    // 3 x 8 cells, almost squares
  jaw.max_force = 70;  // what the hand can hold for long
  return jaw;
}

}  // namespace

Acronym::Acronym(const std::string& file, const std::string& mesh_root)
    : file_(file), data_(read(file)) {
  if (!data_.problem.empty()) {
    problem_.emplace(file_, Place{}, "", data_.problem);
  } else if (data_.gripper != "panda") {
    problem_.emplace(file_, Place{}, "/gripper/type",
                     "is " + shown(data_.gripper) + ", must be panda");
  } else {
    const std::string mesh = (std::filesystem::path(mesh_root) / data_.mesh).string();
    try {
      shape_ = mesh_shape(mesh, data_.scale, notes_);
      surface_.emplace(shape_);
    } catch (const ReadError& error) {
      problem_.emplace(file_, Place{}, "/object/file", harmless(mesh) + " " + error.what());
    }
  }
}

SpatialFile Acronym::grasp(std::size_t n) const {
  if (problem_) throw FileError(*problem_);
  const Eigen::Matrix4d& transform = data_.transforms.at(n);
  const Eigen::Matrix3d turn = transform.topLeftCorner<3, 3>();
  if (!transform.allFinite() || !(turn * turn.transpose()).isIdentity(1e-4) ||
      turn.determinant() < 0 || (transform.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() > 1e-9)
    throw FileError(file_, {}, "/grasps/transforms[" + std::to_string(n) + "]",
                    "is no pose: not a turn and a step");
  ParallelJaw jaw = panda();
  jaw.pose.orientation = Eigen::Quaterniond(turn).normalized();
  jaw.pose.position = transform.topRightCorner<3, 1>() + jaw.pose.orientation * jaw.pose.position;
  jaw.friction = data_.friction;

  SpatialFile result;
  result.name = std::filesystem::path(file_).stem().string() + ", grasp " + std::to_string(n);
  result.shape = shape_;
  result.loads = {{.weight = data_.mass * standard_gravity, .com = data_.com}};
  std::vector<std::string> behind;
  result.contacts = contacts(jaw, *surface_, &behind);
  result.gripper = jaw;
  result.mechanism = mechanism(jaw);
  for (const std::string& note : notes_)
    result.warnings.push_back(located(file_, {}, "/object/file", note));
  for (const std::string& note : behind)
    result.warnings.push_back(located(file_, {}, "gripper", note));
  if (!held(n))
    result.warnings.push_back(
        located(file_, {}, "/grasps/qualities/flex/object_in_gripper[" + std::to_string(n) + "]",
                "is 0: in the simulation of the data set it did not hold the object"));
  return result;
}

}  // namespace poise
