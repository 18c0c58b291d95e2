#include "shape/ellipse.hpp"

#include <cmath>

namespace poise {
namespace {

/// The root u > low of sum (r x / (u + r - 1))^2 = 1, for r >= 1: the left side falls to 0.
template <int Dim>
double root(const Vector<Dim>& r, const Vector<Dim>& x, double low) {
  double high = r.cwiseProduct(x).stableNorm();
  for (;;) {
    const double u = low + (high - low) / 2;
    if (u <= low || u >= high) return u;
    const auto cosines = (r.array() * x.array()) / (u + (r.array() - 1));
    (cosines.matrix().squaredNorm() > 1 ? low : high) = u;
  }
}

}  // namespace

// For a point with coordinates >= 0. The line from the nearest point q to the point is normal to
// the ellipse: point - q = (u - 1) b^2 (q.x / a^2, q.y / b^2, ...) with b the least semi-axis, and
// q lies on it.
template <int Dim>
Vector<Dim> nearest_point(const Vector<Dim>& radii, const Vector<Dim>& point) {
  Eigen::Index least = 0;
  const double b = radii.minCoeff(&least);
  const Vector<Dim> p = point.cwiseAbs(), x = p.cwiseQuotient(radii),
                    r = (radii / b).cwiseProduct(radii / b);
  // q in radii, where u = 0: the point lies in the middle of the least axis, between the centres of
  // curvature, and is as near to both sides.
  Vector<Dim> cosines = Vector<Dim>::Zero();
  double low = 0;
  for (int k = 0; k < Dim; ++k)
    if (r[k] > 1)
      cosines[k] = x[k] * r[k] / (r[k] - 1);
    else
      low = std::hypot(low, x[k]);
  Vector<Dim> q;
  if (low == 0 && cosines.squaredNorm() < 1) {
    cosines[least] = std::sqrt(1 - cosines.squaredNorm());
    q = radii.cwiseProduct(cosines);
  } else {
    const double u = root<Dim>(r, x, low);
    q = (r.array() * p.array() / (u + (r.array() - 1))).matrix();
  }
  for (int k = 0; k < Dim; ++k) q[k] = std::copysign(q[k], point[k]);
  return q;
}

template Vector<2> nearest_point<2>(const Vector<2>&, const Vector<2>&);
template Vector<3> nearest_point<3>(const Vector<3>&, const Vector<3>&);

}  // namespace poise
