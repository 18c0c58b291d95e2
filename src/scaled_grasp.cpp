#include "scaled_grasp.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace poise {

template <>
ScaledGrasp<2>::ScaledGrasp(const Grasp<2>& grasp)
    : length(grasp.radius() > 0 ? grasp.radius() : 1), per_weight(1 / grasp.object().weight) {
  size = grasp.contacts().size();
  lanes.resize((size + lane_size - 1) / lane_size);
  std::fill(lanes.begin(), lanes.end(), ContactLane<2>{});
  Eigen::Matrix3d GGt = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < size; ++i) {
    const Contact<2>& contact = grasp.contacts()[i];
    const double root = std::sqrt(contact.share), weight = grasp.object().weight;
    const Vector<2> r = (contact.position - grasp.object().com) / length;
    ContactLane<2>& lane = lanes[i / lane_size];
    const std::size_t k = i % lane_size;
    lane.nx[k] = root * contact.normal.x();
    lane.ny[k] = root * contact.normal.y();
    lane.jx[k] = -r.y();
    lane.jy[k] = r.x();
    lane.share[k] = contact.share;
    lane.unit[k] = weight * root;
    lane.mu[k] = contact.friction;
    lane.edge[k] = 1 / (1 + contact.friction * contact.friction);
    lane.lo[k] = contact.min_normal / weight / root;
    lane.hi[k] = contact.max_normal / weight / root;
    limited = limited || contact.min_normal > 0 || std::isfinite(contact.max_normal);
    Eigen::Matrix<double, 3, 2> forces;  // wrenches of unit forces along x and y
    forces << Eigen::Matrix2d::Identity(), -r.y(), r.x();
    GGt += contact.share * forces * forces.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(GGt);
  Eigen::Vector3d values = eigen.eigenvalues();
  const double least = 1e-14 * values.maxCoeff();
  for (double& value : values) value = value > least ? 1 / value : 0;
  inverse = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

Cones<2, Wide> widened(const Cones<2>& cones) {
  Cones<2, Wide> wide{cones.size, cones.limited, {}};
  wide.lanes.resize(cones.size);
  for (std::size_t i = 0; i < cones.size; ++i) {
    const ContactLane<2>& c = cones.lanes[i / lane_size];
    const std::size_t k = i % lane_size;
    ContactLane<2, Wide>& w = wide.lanes[i];
    w = {c.nx[k], c.ny[k], c.jx[k], c.jy[k], 0, c.mu[k], 0, c.lo[k], c.hi[k], c.unit[k]};
    w.share = w.nx * w.nx + w.ny * w.ny;
    w.edge = 1 / (1 + w.mu * w.mu);
  }
  return wide;
}

}  // namespace poise
