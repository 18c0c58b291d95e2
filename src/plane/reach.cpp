#include "plane/reach.hpp"

#include <algorithm>
#include <numbers>

namespace poise {

Reach::Reach(double theta) : at(theta), cosine(std::cos(theta)), sine(std::sin(theta)) {}

void Reach::keep(const Eigen::RowVector3d& g, double rounding) {
  const double least_g = g[0] + rounding;
  if (least_g >= 0 && least_g * least_g >= g[1] * g[1] + g[2] * g[2]) return;
  const double along = g[1] * cosine + g[2] * sine, half = g[2] * cosine - g[1] * sine;
  const double here = std::max(g[0] + along, 0.0), far = g[0] - along;
  // here + 2 half t + far t^2 = 0
  const double square = half * half - here * far;
  if (square < 0) return;
  const double sum = -(half + std::copysign(std::sqrt(square), half));
  const double one = sum / far, other = here / sum;
  for (const double t : {one, other}) {
    if (t > 0) most = std::min(most, t);
    if (t < 0) least = std::max(least, t);
  }
  if (here == 0) (half > 0 ? least : most) = 0;  // but for rounding, only one side is open
}

void Reach::stop(double angle) {
  const double t = std::tan(std::remainder(angle - at, 2 * std::numbers::pi) / 2);
  (t < 0 ? least : most) = t < 0 ? std::max(least, t) : std::min(most, t);
}

}  // namespace poise
