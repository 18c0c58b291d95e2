#include "apps/paper/counts.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "apps/paper/exact.hpp"
#include "poise/best_posture.hpp"

namespace poise::study {
namespace {

/// Uniform numbers that do not depend on the standard library at hand.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double operator()(double from, double to) {
    return from + (to - from) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }

 private:
  std::mt19937_64 bits_;
};

/// The paper's way to pinch: all fingers press, and the com is not in their fork.
bool pinches_up(const Grasp<2>& grasp, const poise::Minimum<2>& posture) {
  const Interval fork = fork_wedge(grasp, grasp.loads().front().com);
  const double from_start = std::remainder(posture.optimum.angle - fork.from - pi, 2 * pi) + pi;
  return from_start >= fork.to - fork.from && all_loaded<2>(grasp, posture.hold(), grasp.size());
}

}  // namespace

DiskCounts count_disks(std::size_t disks, std::uint64_t seed) {
  Random uniform(seed);
  DiskCounts counts{.disks = disks};
  for (std::size_t k = 0; k < disks; ++k) {
    HeldDisk disk{.phi = uniform(0.3, pi / 2)};
    const double least = disk.c() / disk.s();
    disk.mu1 = least + std::pow(10, uniform(-3, 1));
    disk.mu2 = least + std::pow(10, uniform(-3, 1));
    if (minima(disk).size() < 3) ++counts.b_is_no_minimum;
  }
  return counts;
}

EllipseCounts count_ellipses(std::size_t ellipses, double off_centre, std::uint64_t seed) {
  Random uniform(seed);
  EllipseCounts counts{.ellipses = ellipses};
  for (std::size_t k = 0; k < ellipses; ++k) {
    const double flat = uniform(0.3, 1), friction = uniform(0.1, 1.5);
    const auto contact = [&](double angle) {
      const double x = std::cos(angle), y = std::sin(angle);
      Contact<2> result;
      result.position = {x, flat * y};
      result.normal = {-flat * x, -y};
      result.friction = friction;
      return result;
    };
    const double first = uniform(-pi, pi), second = uniform(-pi, pi);
    const double x = uniform(-off_centre, off_centre), y = uniform(-off_centre, off_centre);
    const Grasp<2> grasp({1, {x, flat * y}}, {contact(first), contact(second)});
    const Best<2> best = best_posture(grasp);
    if (!best.holdable()) {
      ++counts.unholdable;
      continue;
    }
    const poise::Minimum<2>& lowest = best.best();
    if (!all_loaded<2>(grasp, lowest.hold(), grasp.size())) {
      ++counts.resting;
    } else if (lowest.optimum.kind == Kind::smooth) {
      ++counts.smooth;
    } else if (lowest.optimum.kind == Kind::boundary) {
      ++counts.end;
    } else {
      ++counts.kink;
      if (pinches_up(grasp, lowest)) ++counts.kink_pinched;
    }
    const auto pinched =
        std::find_if(best.minima.begin(), best.minima.end(), [&](const poise::Minimum<2>& minimum) {
          return minimum.optimum.kind != Kind::boundary && pinches_up(grasp, minimum);
        });
    if (pinched != best.minima.end()) {
      ++counts.pinched;
      if (pinched->edges_meet) ++counts.pinched_where_edges_meet;
    }
  }
  return counts;
}

}  // namespace poise::study
