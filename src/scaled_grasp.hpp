// The grasp as the solver sees it. Not installed.
//
// Forces in weights W, lengths in radii L, moments about the centre of mass, and the force of a
// contact divided by sqrt(share), so that the effort is |f|^2 and the share appears nowhere else.
#pragma once

#include <vector>

#include "poise/grasp.hpp"

namespace poise {

/// Two contacts at a time: what GCC and Clang turn into SIMD instructions on every machine.
using Lane = double __attribute__((vector_size(16)));
inline constexpr std::size_t lane_size = 2;

/// As many contacts as a Lane holds; an odd last one is filled up by a contact that carries
/// nothing.
template <int Dim>
struct ContactLane;

template <>
struct ContactLane<2> {
  Lane nx, ny;  ///< inward normal, times sqrt(share)
  Lane jx, jy;  ///< velocity of the contact point when the object turns about the com at 1 rad/s
  Lane share;
  Lane mu, edge;  ///< friction; 1 / (1 + mu^2), the squared normal part of the cone's unit edge
  Lane lo, hi;    ///< limits of the normal force
};

template <int Dim>
struct ScaledGrasp {
  explicit ScaledGrasp(const Grasp<Dim>& grasp);

  std::size_t size;     ///< contacts
  double length;        ///< L [m], or 1 where every contact is at the centre of mass
  double per_weight;    ///< 1 / W [1/N]
  bool limited{false};  ///< whether any contact has a force limit
  std::vector<ContactLane<Dim>> lanes;
  std::vector<double> unit;  ///< of each contact's forces: W sqrt(share) [N]
  /// Pseudo-inverse of G Gᵀ: the dual of a load while no contact is at the border of its cone.
  Eigen::Matrix<double, wrench_size<Dim>, wrench_size<Dim>> inverse;
};

}  // namespace poise
