#include "apps/paper/exact.hpp"

#include <Eigen/LU>
#include <cmath>

namespace poise::study {
namespace {

/// N1 = W sin(phi + theta) / (2 s d), F1 = F2 = mu N1, N2 = N1 + W sin(theta) / s: docs/paper.md.
Harmonic2 branch(const HeldDisk& disk, double mu, double d) {
  const double phi = disk.phi, s = disk.s(), c = disk.c();
  const double scale = disk.weight * disk.weight / (4 * s * s), m = (1 + mu * mu) / (d * d);
  Harmonic2 V;
  V.c0 = scale * (m + 2 * c / d + 2);
  V.cos2 = -scale * (m * std::cos(2 * phi) + 2 * c / d + 2);
  V.sin2 = scale * (m * std::sin(2 * phi) + 2 * s / d);
  return V;
}

}  // namespace

double theta_b(const HeldDisk& disk) {
  const double mu1 = disk.mu1, mu2 = disk.mu2;
  return std::atan2(disk.s() * (mu1 - mu2), mu1 * disk.d2() + mu2 * disk.d1());
}

Vector<2> edges_meet(const HeldDisk& disk) {
  const double s = disk.s(), c = disk.c(), r = disk.radius;
  Eigen::Matrix2d edges;  // the upper ones, pointing into the disk
  edges << -s - disk.mu1 * c, s + disk.mu2 * c, disk.mu1 * s - c, disk.mu2 * s - c;
  const Eigen::Vector2d p1(r * s, r * c), p2(-r * s, r * c);
  Eigen::Matrix2d lines = edges;
  lines.col(1) *= -1;
  return p1 + (lines.inverse() * (p2 - p1)).x() * edges.col(0);
}

Harmonic2 V_5(const HeldDisk& disk) { return branch(disk, disk.mu1, disk.d1()); }

Harmonic2 V_6(const HeldDisk& disk) {
  Harmonic2 V = branch(disk, disk.mu2, disk.d2());
  V.sin2 *= -1;
  return V;
}

double rise_beyond_b(double phi, double mu, double other) {
  const double s = std::sin(phi), c = std::cos(phi);
  return (2 * mu * mu * other + mu + other) *
             (other * (mu * std::sin(2 * phi) - std::cos(2 * phi)) - mu) +
         2 * mu * (mu * s - c) * (2 * mu * other * s - (mu + other) * c);
}

double least_other_friction(double phi, double mu) {
  const double s = std::sin(phi), c = std::cos(phi), d = mu * s - c;
  const double k = mu * std::sin(2 * phi) - std::cos(2 * phi), q = 2 * mu * mu + 1;
  // A x^2 + B x + C with A > 0 > C.
  const double A = q * k, B = mu * (k - q) + 2 * mu * d * (2 * mu * s - c);
  const double C = -mu * mu * (1 + 2 * d * c);
  const double root = std::sqrt(B * B - 4 * A * C);
  return B > 0 ? -2 * C / (B + root) : (root - B) / (2 * A);
}

std::vector<Minimum> minima(const HeldDisk& disk) {
  const double end = disk.range(), W = disk.weight, b = theta_b(disk);
  const bool first = disk.d1() > 0, second = disk.d2() > 0;
  // One contact right under the centre of mass carries all, and V falls towards it.
  const double alpha_end = W * disk.s() / std::sqrt(2.0);
  std::vector<Minimum> result{{'a', -end, W * W, alpha_end, Kind::boundary}};
  const auto add_b = [&](Kind kind) {
    result.push_back(
        {'b', b, first ? V_5(disk)(b) : V_6(disk)(b), alphas(disk, b)[first ? 4 : 5], kind});
  };
  if (first && second) {
    if (rise_beyond_b(disk.phi, disk.mu1, disk.mu2) > 0 &&
        rise_beyond_b(disk.phi, disk.mu2, disk.mu1) > 0)
      add_b(Kind::kink);
  } else if (first) {  // holds from b to c, and at a alone
    if (b < end && V_5(disk).slope(b) > 0) add_b(Kind::boundary);
  } else if (second) {  // holds from a to b, and at c alone
    if (b > -end && V_6(disk).slope(b) < 0) add_b(Kind::boundary);
  }
  result.push_back({'c', end, W * W, alpha_end, Kind::boundary});
  return result;
}

}  // namespace poise::study
