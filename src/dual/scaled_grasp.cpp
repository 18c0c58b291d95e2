#include "dual/scaled_grasp.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace poise {
namespace {

template <class Matrix, class Twist>
Matrix pseudo_inverse(const Matrix& GGt, std::vector<Twist>& kernel) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(GGt);
  auto values = eigen.eigenvalues().eval();
  const double least = 1e-14 * values.maxCoeff();
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (!(values[k] > least)) kernel.push_back(eigen.eigenvectors().col(k));
    values[k] = values[k] > least ? 1 / values[k] : 0;
  }
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

InternalForce internal_force(const ContactLane<2>& c) {
  InternalForce force{};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t other = 1 - i;
    const double x = (c.jy[other] - c.jy[i]) / c.share[i], z = (c.jx[i] - c.jx[other]) / c.share[i];
    const double n = c.nx[i] * x + c.ny[i] * z, t = c.nx[i] * z - c.ny[i] * x;
    for (std::size_t side = 0; side < 2; ++side) {
      const double rate = c.mu[i] * n + (side == 0 ? -t : t);
      force.per_margin[side][i] = rate != 0 ? 1 / rate : 0;
    }
    force.square += n * n + t * t;
  }
  return force;
}

}  // namespace

template <>
ScaledGrasp<2>::ScaledGrasp(const Grasp<2>& grasp)
    : length(grasp.radius() > 0 ? grasp.radius() : 1),
      per_length(1 / length),
      per_weight(1 / grasp.object().weight) {
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
  inverse = pseudo_inverse(GGt, unfelt);
  if (size == 2) internal = internal_force(lanes[0]);
}

template <>
ScaledGrasp<3>::ScaledGrasp(const Grasp<3>& grasp)
    : length(grasp.radius() > 0 ? grasp.radius() : 1),
      per_length(1 / length),
      per_weight(1 / grasp.object().weight) {
  size = grasp.contacts().size();
  lanes.resize((size + lane_size - 1) / lane_size);
  std::fill(lanes.begin(), lanes.end(), ContactLane<3>{});
  Eigen::Matrix<double, 6, 6> GGt = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<Eigen::Matrix<double, 6, 4>> columns;
  for (std::size_t i = 0; i < size; ++i) {
    const Contact<3>& contact = grasp.contacts()[i];
    const double root = std::sqrt(contact.share), weight = grasp.object().weight;
    const Vector<3> r = (contact.position - grasp.object().com) / length;
    Eigen::Matrix3d frame;
    frame << contact.normal, tangents(contact.normal);
    frame *= root;
    ContactLane<3>& lane = lanes[i / lane_size];
    const std::size_t k = i % lane_size;
    for (int d = 0; d < 3; ++d) {
      lane.n[d][k] = frame(d, 0);
      lane.a[d][k] = frame(d, 1);
      lane.b[d][k] = frame(d, 2);
      lane.r[d][k] = r[d];
    }
    lane.soft[k] = contact.torsion > 0 ? contact.torsion / (contact.friction * length) : 0;
    lane.share[k] = contact.share;
    lane.unit[k] = weight * root;
    lane.mu[k] = contact.friction;
    lane.edge[k] = 1 / (1 + contact.friction * contact.friction);
    lane.lo[k] = contact.min_normal / weight / root;
    lane.hi[k] = contact.max_normal / weight / root;
    limited = limited || contact.min_normal > 0 || std::isfinite(contact.max_normal);
    Eigen::Matrix<double, 6, 4>& G = columns.emplace_back();
    G.setZero();
    G.topLeftCorner<3, 3>() = frame;
    if (contact.friction == 0) G.rightCols<3>().setZero();
    for (int d = 0; d < 3; ++d) G.col(d).tail<3>() = r.cross(G.col(d).head<3>());
    G.col(3).tail<3>() = lane.soft[k] * frame.col(0);
    GGt += G * G.transpose();
  }
  inverse = pseudo_inverse(GGt, unfelt);
  // A very soft finger takes digits from the others in G G^T, not in G.
  for (Twist<3>& y : unfelt) {
    Twist<3> felt = Twist<3>::Zero();
    for (const Eigen::Matrix<double, 6, 4>& G : columns) felt += G * (G.transpose() * y);
    y = (y - inverse * felt).normalized();
  }
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

Cones<3, Wide> widened(const Cones<3>& cones) {
  Cones<3, Wide> wide{cones.size, cones.limited, {}};
  wide.lanes.resize(cones.size);
  for (std::size_t i = 0; i < cones.size; ++i) {
    const ContactLane<3>& c = cones.lanes[i / lane_size];
    const std::size_t k = i % lane_size;
    ContactLane<3, Wide>& w = wide.lanes[i];
    // The tangents are perpendicular to the normal in all digits.
    Eigen::Matrix<Wide, 3, 1> n, a;
    for (int d = 0; d < 3; ++d) {
      n[d] = c.n[d][k];
      a[d] = c.a[d][k];
      w.r[d] = c.r[d][k];
    }
    w.share = n.squaredNorm();
    if (w.share > 0) {
      a -= n * (a.dot(n) / w.share);
      a *= sqrt(w.share / a.squaredNorm());
    }
    const Eigen::Matrix<Wide, 3, 1> b = n.cross(a) / (w.share > 0 ? sqrt(w.share) : Wide(1));
    for (int d = 0; d < 3; ++d) {
      w.n[d] = n[d];
      w.a[d] = a[d];
      w.b[d] = b[d];
    }
    w.soft = c.soft[k];
    w.mu = c.mu[k];
    w.edge = 1 / (1 + w.mu * w.mu);
    w.lo = c.lo[k];
    w.hi = c.hi[k];
    w.unit = c.unit[k];
  }
  return wide;
}

}  // namespace poise
