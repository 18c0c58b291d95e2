#include "apps/paper/counts.hpp"

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
    const Best<2> best =
        best_posture(Grasp<2>({1, {x, flat * y}}, {contact(first), contact(second)}));
    if (!best.holdable()) {
      ++counts.unholdable;
      continue;
    }
    const poise::Minimum<2>& lowest = best.best();
    if (lowest.manner == Manner::resting) {
      ++counts.resting;
    } else if (lowest.optimum.kind == Kind::smooth) {
      ++counts.smooth;
    } else if (lowest.optimum.kind == Kind::boundary) {
      ++counts.end;
    } else {
      ++counts.kink;
      if (lowest.manner == Manner::pinched) ++counts.kink_pinched;
    }
    if (const poise::Minimum<2>* pinched = best.best_pinched()) {
      ++counts.pinched;
      if (pinched->edges_meet) ++counts.pinched_where_edges_meet;
    }
  }
  return counts;
}

}  // namespace poise::study
