#include "apps/paper/disk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poise::study {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double root2 = std::sqrt(2.0);

/// (24), and (25) with -theta: from mu N > F.
double friction_bound(const HeldDisk& disk, double mu, double d, double theta) {
  if (d <= 0) return infinity;
  const double s = disk.s(), c = disk.c();
  return disk.weight / (root2 * d) * ((s + mu * c) * std::cos(theta) + mu / s * std::sin(theta));
}

}  // namespace

Grasp<2> grasp_of(const HeldDisk& disk) {
  const auto contact = [&](double side, double friction, const char* name) {
    Contact<2> result;
    result.position = disk.radius * Vector<2>(side * disk.s(), disk.c());
    result.normal = -result.position;
    result.friction = friction;
    result.finger = name;
    return result;
  };
  return Grasp<2>({disk.weight, {0, 0}},
                  {contact(1, disk.mu1, "contact 1"), contact(-1, disk.mu2, "contact 2")});
}

Eigen::Matrix<double, 3, 4> grasp_matrix(const HeldDisk& disk) {
  const double s = disk.s(), c = disk.c(), r = disk.radius;
  Eigen::Matrix<double, 3, 4> G;
  G << -s, -c, s, c,  //
      -c, s, -c, s,   //
      0, r, 0, -r;
  return G;
}

Eigen::Vector3d load(const HeldDisk& disk, double theta) {
  return {disk.weight * std::sin(theta), disk.weight * std::cos(theta), 0};
}

Forces F_T(const HeldDisk& disk, double theta) {
  const double s = disk.s(), c = disk.c(), half = disk.weight / 2;
  const double x = std::sin(theta), y = std::cos(theta);
  return {.N1 = -half * (x / s + c * y),
          .F1 = half * s * y,
          .N2 = half * (x / s - c * y),
          .F2 = half * s * y};
}

Forces F_N(const HeldDisk& disk) {
  const double s = disk.s() / root2, c = disk.c() / root2;
  return {.N1 = s, .F1 = c, .N2 = s, .F2 = c};
}

Forces forces(const HeldDisk& disk, double theta, double alpha) {
  const Forces T = F_T(disk, theta), N = F_N(disk);
  return {.N1 = T.N1 + alpha * N.N1,
          .F1 = T.F1 + alpha * N.F1,
          .N2 = T.N2 + alpha * N.N2,
          .F2 = T.F2 + alpha * N.F2};
}

double V(const HeldDisk& disk, double theta, double alpha) {
  return F_T(disk, theta).vector().squaredNorm() + alpha * alpha;
}

std::array<double, 6> conditions(const HeldDisk& disk, const Forces& f) {
  return {f.N1, f.N2, f.F1, f.F2, disk.mu1 * f.N1 - f.F1, disk.mu2 * f.N2 - f.F2};
}

std::array<double, 6> alphas(const HeldDisk& disk, double theta) {
  const double s = disk.s(), c = disk.c(), W = disk.weight;
  const double x = std::sin(theta), y = std::cos(theta);
  const double alpha3 = std::abs(c) < 1e-14 ? -infinity : -W * s * y / (root2 * c);
  return {W / (root2 * s * s) * (x + s * c * y),   // (20) N1 > 0
          W / (root2 * s * s) * (-x + s * c * y),  // (21) N2 > 0
          alpha3,                                  // (22) F1 > 0
          alpha3,                                  // (23) F2 > 0
          friction_bound(disk, disk.mu1, disk.d1(), theta),
          friction_bound(disk, disk.mu2, disk.d2(), -theta)};
}

double alpha_bar(const HeldDisk& disk, double theta) {
  const std::array<double, 6> all = alphas(disk, theta);
  return *std::max_element(all.begin(), all.end());
}

double V(const HeldDisk& disk, double theta) { return V(disk, theta, alpha_bar(disk, theta)); }

}  // namespace poise::study
