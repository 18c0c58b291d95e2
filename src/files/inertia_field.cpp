#include "files/inertia_field.hpp"

#include "files/mesh_field.hpp"
#include "poise/motion.hpp"
#include "readers/readers.hpp"

namespace poise {
namespace {

/// A com counts as the centroid of a shape within this part of its size.
constexpr double same_place = 1e-4;

}  // namespace

std::optional<Eigen::Matrix3d> read_inertia(const Field& object) {
  const auto inertial = object.find("inertial");
  const auto given = object.find("inertia");
  if (!given) {
    if (!inertial) return {};
    return read_inertial(*inertial).inertia;
  }
  if (inertial) inertial->fail("is given as well as inertia, must be one of them");
  const std::string expected = "[ixx, iyy, izz, ixy, ixz, iyz], kg m2 about the com";
  const std::vector<Field> list = given->list(expected);
  if (list.size() != 6)
    given->fail("has " + std::to_string(list.size()) + " numbers, must be " + expected);
  double v[6];
  for (std::size_t k = 0; k < 6; ++k) v[k] = list[k].number();
  Eigen::Matrix3d inertia;
  inertia << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  if (const std::string problem = inertia_problem(inertia); !problem.empty())
    given->fail(problem + ": must be " + expected);
  return inertia;
}

Eigen::Matrix3d inertia_of(const SpatialFile& file, const std::string& name) {
  if (file.inertia) {  // that of a robot model, where a dummy is no harm else, was not looked at
    if (const std::string problem = inertia_problem(*file.inertia); !problem.empty())
      throw FileError(name, {}, "object.inertial", "is of a link whose inertia " + problem);
    return *file.inertia;
  }
  const auto fail = [&](const std::string& why) {
    return FileError(name, {}, "object.inertia",
                     "is missing, but the motion turns the object: must be [ixx, iyy, izz, ixy, "
                     "ixz, iyz], kg m2 about the com, as " +
                         why);
  };
  if (!file.shape) throw fail("there is no shape to take it from");
  const auto* mesh = std::get_if<MeshShape>(&*file.shape);
  if (mesh && !mesh->defect.empty()) throw fail("the mesh " + mesh->defect);
  const Load<3>& load = file.loads.front();
  if ((load.com - centroid(*file.shape)).norm() > same_place * size(*file.shape))
    throw fail("the com is not the middle of the shape, so that its mass is not spread evenly");
  return load.weight / standard_gravity / volume(*file.shape) * inertia(*file.shape);
}

}  // namespace poise
