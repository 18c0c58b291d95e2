#include "verify/fork.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/trig.hpp"

namespace poise::verify {
namespace {

Real distance_to_segment(const Vec& a, const Vec& b) {
  const Vec ab = b - a;
  const Real s =
      ab.squaredNorm() > 0 ? std::clamp(-a.dot(ab) / ab.squaredNorm(), Real{0}, Real{1}) : 0;
  return (a + s * ab).norm();
}

}  // namespace

// Down points into the cone which the contacts span, seen from the com outside of their hull: into
// the rest of the widest angle between neighbouring directions.
Wedge wedge_of(const RealGrasp& grasp, const RealLoad& load) {
  std::vector<Vec> arms;
  for (const RealContact& contact : grasp.contacts) arms.emplace_back(contact.position - load.com);
  const auto direction = [](const Vec& arm) { return std::atan2(arm[1], arm[0]); };
  std::sort(arms.begin(), arms.end(),
            [&](const Vec& a, const Vec& b) { return direction(a) < direction(b); });
  Real distance = std::numeric_limits<Real>::infinity(), widest = -1;
  std::size_t first = 0;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const Real turn = i == 0 ? direction(arms[0]) + 2 * pi - direction(arms.back())
                             : direction(arms[i]) - direction(arms[i - 1]);
    if (turn <= widest) continue;
    widest = turn;
    first = i;
  }
  for (const Vec& a : arms)
    for (const Vec& b : arms) distance = std::min(distance, distance_to_segment(a, b));
  if (widest <= pi || distance <= 0.999e-9L * load.radius) return {};  // or the com is inside
  const Vec& last = arms[(first + arms.size() - 1) % arms.size()];
  const Real from = std::atan2(-last[0], -last[1]), width = 2 * pi - widest;
  if (width <= 1e-12L) return {};
  return {from, from + width};
}

}  // namespace poise::verify
