#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>

#include "readers/readers.hpp"

namespace poise::readers {

Inertial read_inertial(const std::string& xml, const std::string& name) {
  console_bridge::noOutputHandler();
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(xml);
  if (!model) throw ReadError("is not a robot model (URDF)");
  const urdf::LinkConstSharedPtr link = model->getLink(name);
  if (!link) {
    std::string known;
    for (const auto& [each, unused] : model->links_) known += (known.empty() ? "" : ", ") + each;
    throw ReadError("has no link " + name + ", its links are " + known);
  }
  if (!link->inertial) throw ReadError("has no inertial in its link " + name);
  const urdf::Vector3& com = link->inertial->origin.position;
  Eigen::Quaterniond q;  // of the axes in which the inertia is told
  link->inertial->origin.rotation.getQuaternion(q.x(), q.y(), q.z(), q.w());
  Eigen::Matrix3d own;
  const urdf::Inertial& i = *link->inertial;
  own << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
  const Eigen::Matrix3d turned = q.toRotationMatrix();
  const Inertial inertial{i.mass, {com.x, com.y, com.z}, turned * own * turned.transpose()};
  if (!(inertial.mass > 0)) throw ReadError("has no mass above 0 in its link " + name);
  return inertial;
}

}  // namespace poise::readers
