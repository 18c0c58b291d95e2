#include "shape/ellipse.hpp"

#include <cmath>

namespace poise {
namespace {

/// The root u > 0 of (r x / (u + r - 1))^2 + (y / u)^2 = 1, for r >= 1 and y > 0: the left side
/// falls from infinity to 0.
double root(double r, double x, double y) {
  double low = y, high = std::hypot(r * x, y);
  for (;;) {
    const double u = low + (high - low) / 2;
    if (u <= low || u >= high) return u;
    const double p = r * x / (u + (r - 1)), q = y / u;
    (p * p + q * q > 1 ? low : high) = u;
  }
}

/// For semi-axes a >= b and a point with x, y >= 0. The line from the nearest point q to the point
/// is normal to the ellipse: point - q = (u - 1) b^2 (q.x / a^2, q.y / b^2), and q lies on it.
Vector<2> nearest_in_quadrant(double a, double b, const Vector<2>& point) {
  const double x = point.x() / a, y = point.y() / b, r = (a / b) * (a / b);
  if (y > 0) {
    const double u = root(r, x, y);
    return {r * point.x() / (u + (r - 1)), point.y() / u};
  }
  // From the major axis, between the centres of curvature of its ends, two points are nearest.
  const double cosine = r > 1 ? x * r / (r - 1) : 1;
  if (cosine >= 1) return {a, 0};
  return {a * cosine, b * std::sqrt(1 - cosine * cosine)};
}

}  // namespace

Vector<2> nearest_point(const Ellipse& ellipse, const Vector<2>& point) {
  const double a = ellipse.radii.x(), b = ellipse.radii.y();
  const Vector<2> p = point.cwiseAbs();
  Vector<2> q = a >= b ? nearest_in_quadrant(a, b, p)
                       : nearest_in_quadrant(b, a, p.reverse()).reverse().eval();
  for (int k = 0; k < 2; ++k) q[k] = std::copysign(q[k], point[k]);
  return q;
}

}  // namespace poise
