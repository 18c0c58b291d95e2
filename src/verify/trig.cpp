#include "verify/trig.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace poise::verify {

Real radians_of(Real degrees) { return degrees * (pi / 180); }

Vec up_at(Real theta) {
  Vec up(2);
  up << std::sin(theta), std::cos(theta);
  return up;
}

Vec3 harmonics(Real theta) { return {1, std::cos(theta), std::sin(theta)}; }

Real unwound(Real angle, Real start) {
  return angle - 2 * pi * std::floor((angle - start + end_slack) / (2 * pi));
}

bool within(Real angle, Real from, Real to, Real slack) {
  return unwound(angle, from - slack) <= to + slack;
}

Real angle_between(Real a, Real b) { return std::abs(std::remainder(a - b, 2 * pi)); }

// a + b cos(theta) + c sin(theta) is least at an end or at its trough.
Real least(const Vec3& g, Real from, Real to) {
  Real value = std::min(g.dot(harmonics(from)), g.dot(harmonics(to)));
  const Real trough = unwound(std::atan2(-g[2], -g[1]), from);
  if (trough >= from && trough <= to) value = std::min(value, g.dot(harmonics(trough)));
  return value;
}

Real greatest_size(const Vec3& g, Real from, Real to) {
  return -std::min(least(g, from, to), least(-g, from, to));
}

Real relative_size(const Mat3& wrenches, const RealLoad& load, Real from, Real to) {
  Mat3 about_com = wrenches;
  for (int k = 0; k < 3; ++k) about_com(2, k) -= wrench(wrenches.col(k).head(2), load.com)[2];
  Real size = 0;
  for (int row = 0; row < 3; ++row) {
    const Real unit = load.size() * (row < 2 ? 1 : load.radius);
    if (unit > 0) size = std::max(size, greatest_size(about_com.row(row), from, to) / unit);
  }
  return size;
}

Mat3 load_matrix(const RealLoad& load) {
  Mat3 w;
  w << 0, 0, 1, 0, 1, 0, 0, load.com[0], -load.com[1];
  w *= load.turning();
  w.col(0) += load.still();
  return w;
}

Real Effort::operator()(Real theta) const {
  return c0 + cos1 * std::cos(theta) + sin1 * std::sin(theta) + cos2 * std::cos(2 * theta) +
         sin2 * std::sin(2 * theta);
}

Real Effort::slope(Real theta) const {
  return sin1 * std::cos(theta) - cos1 * std::sin(theta) + 2 * sin2 * std::cos(2 * theta) -
         2 * cos2 * std::sin(2 * theta);
}

Real Effort::scale() const {
  return std::abs(c0) + std::abs(cos1) + std::abs(sin1) + std::abs(cos2) + std::abs(sin2);
}

// With z = exp(i theta) the slope is a polynomial of degree 4 in z, the zeros of which are
// eigenvalues: second z^4 + first z^3 + conj(first) z + conj(second) = 0.
std::vector<Real> Effort::turning_points(Real from, Real to) const {
  using Complex = std::complex<Real>;
  using Companion = Eigen::Matrix<Complex, 4, 4>;
  const Complex first(sin1, cos1), second(2 * sin2, 2 * cos2);
  std::vector<Real> angles{from, to};
  const auto add = [&](Complex z) {
    const Real angle = unwound(std::arg(z), from);
    if (angle > from && angle < to) angles.push_back(angle);
  };
  if (std::abs(second) > 1e-16L * std::abs(first)) {
    Companion companion = Companion::Zero();
    companion.bottomLeftCorner<3, 3>().setIdentity();
    companion.col(3) << -std::conj(second) / second, -std::conj(first) / second, 0, -first / second;
    const Eigen::ComplexEigenSolver<Companion> zeros(companion, false);
    for (int k = 0; k < 4; ++k) add(zeros.eigenvalues()[k]);
  } else if (std::abs(first) > 0) {
    const Real angle = std::atan2(sin1, cos1);
    add(std::polar(Real{1}, angle));
    add(std::polar(Real{1}, angle + pi));
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

Real Effort::least(Real from, Real to) const {
  Real value = (*this)(from);
  for (const Real angle : turning_points(from, to)) value = std::min(value, (*this)(angle));
  return value;
}

Real Effort::greatest(Real from, Real to) const {
  return -Effort{-c0, -cos1, -sin1, -cos2, -sin2}.least(from, to);
}

Effort effort_of(const Harmonic2& V) { return {V.c0, V.cos1, V.sin1, V.cos2, V.sin2}; }
Effort effort_of(const Harmonic1& F) { return {F.c0, F.cos1, F.sin1, 0, 0}; }

}  // namespace poise::verify
