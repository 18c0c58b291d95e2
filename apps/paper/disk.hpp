// The paper's equations, to be read beside it: S. Ito et al., Numerical Analysis for Optimal
// Posture of Circular Object Grasped with Frictions. Numbers in brackets are its equations.
//
// Nothing here uses the solver of the library, so that each can be checked by the other.
#pragma once

#include <array>
#include <cmath>

#include "poise/grasp.hpp"

namespace poise::study {

inline constexpr double pi = 3.14159265358979323846;

/// A disk with its centre of mass in its centre, held by contact 1 at phi clockwise of the
/// object's +y (the right one) and contact 2 at phi counter-clockwise of it.
struct HeldDisk {
  double phi{0};      ///< [rad], in (0, pi/2]
  double mu1{0};      ///< friction of contact 1
  double mu2{0};      ///< friction of contact 2
  double weight{10};  ///< Mg [N]
  double radius{1};   ///< r [m]; no force depends on it

  double s() const { return std::sin(phi); }
  double c() const { return std::cos(phi); }
  /// mu sin(phi) - cos(phi): what squeezing by the internal force adds to the friction of a contact
  /// more than it needs of it. Finite bounds (24), (25) need both above 0. Rounding counts as 0.
  double d1() const { return excess(mu1); }
  double d2() const { return excess(mu2); }
  /// Whether squeezing harder always helps: the case that the paper treats.
  bool can_be_squeezed() const { return d1() > 0 && d2() > 0; }
  /// pi - phi: where a contact is right under the centre of mass. The paper's range of pinching up
  /// is |theta| below it.
  double range() const { return pi - phi; }

 private:
  double excess(double mu) const {
    const double d = mu * s() - c();
    return std::abs(d) < 1e-14 * (1 + mu) ? 0 : d;
  }
};

/// The same disk as the library sees it, its fingers named "contact 1" and "contact 2".
Grasp<2> grasp_of(const HeldDisk& disk);

/// The contact forces F, on the object [N]: each N along the inward normal, each F along the
/// circle, upwards at theta = 0.
///
/// In the library's signs F1 = -tangential and F2 = +tangential.
struct Forces {
  double N1{0}, F1{0}, N2{0}, F2{0};
  Eigen::Vector4d vector() const { return {N1, F1, N2, F2}; }
};

/// The grasp matrix G (4): columns N1, F1, N2, F2; rows x, y (object frame) and the moment about
/// the centre of mass.
Eigen::Matrix<double, 3, 4> grasp_matrix(const HeldDisk& disk);

/// The load: what the forces must supply, G F = load, in the posture theta. [N, N, N m]
Eigen::Vector3d load(const HeldDisk& disk, double theta);

/// F_T (10), the forces of least norm that balance the load, whatever the friction.
Forces F_T(const HeldDisk& disk, double theta);

/// F_N (11), the internal force: a unit vector with G F_N = 0, pressing the contacts together.
Forces F_N(const HeldDisk& disk);

/// F = F_T + alpha F_N, all the forces that balance the load.
Forces forces(const HeldDisk& disk, double theta, double alpha);

/// The evaluation function V = |F_T|^2 + alpha^2 (13) [N^2].
double V(const HeldDisk& disk, double theta, double alpha);

/// The conditions (14)-(19) as numbers that must be above 0: N1, N2, F1, F2, mu1 N1 - F1,
/// mu2 N2 - F2.
std::array<double, 6> conditions(const HeldDisk& disk, const Forces& forces);

/// alpha_1 ... alpha_6 (20)-(25): the least alpha with which each condition holds [N]. (22) and
/// (23) have the minus sign that is missing in print. alpha_5 and alpha_6 are infinite where d1 or
/// d2 is not above 0, alpha_3 and alpha_4 minus infinity where phi is a right angle: there no alpha
/// changes F1 and F2.
std::array<double, 6> alphas(const HeldDisk& disk, double theta);

/// alpha-bar, the largest of the six: the least internal force [N].
double alpha_bar(const HeldDisk& disk, double theta);

/// V with alpha-bar: the least effort in the posture theta, within the range of pinching up [N^2].
double V(const HeldDisk& disk, double theta);

}  // namespace poise::study
