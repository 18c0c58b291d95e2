#include "space/nearest_tie.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "space/oracle.hpp"

namespace poise {
namespace {

using search::infinity;
using search::Oracle;

/// A smaller gain of turn [rad] is not worth leaving the minimum; nor is it looked for farther than
/// this from the nearest posture.
constexpr double worth = 0.01;
constexpr int most_holds = 400, most_sections = 30;
/// What rounding may make of a unit vector on two planes; the square of the sine of planes that are
/// parallel but for rounding; and a plane of no thickness is given this.
constexpr double rounding = 1e-10, parallel = 1e-14, thickness = 1e-9;

double turn(const Vector<3>& from, const Vector<3>& to) {
  return std::atan2(from.cross(to).norm(), from.dot(to));
}

/// What half-spaces leave of the unit sphere, by the points in which the nearest to a given one may
/// be: that one itself, the nearest of a circle, and where two circles meet.
class Uncut {
 public:
  explicit Uncut(const Vector<3>& present) : present_(present), candidates_{present} {}

  /// Keeps n . u <= b, n of length 1.
  void cut(const Vector<3>& n, double b) {
    if (b >= 1) return;
    std::erase_if(candidates_, [&](const Vector<3>& u) { return n.dot(u) > b + rounding; });
    circles_.push_back({n, b});
    if (b <= -1) return;
    const Vector<3> across = present_ - n.dot(present_) * n;
    const Vector<3> way =
        across.norm() > rounding ? Vector<3>(across.normalized()) : Vector<3>(tangents(n).col(0));
    add(b * n + std::sqrt(1 - b * b) * way);
    for (const search::Plane& other : circles_) meet({n, b}, other);
  }
  /// None: nothing is left.
  std::optional<Vector<3>> nearest() const {
    const auto nearer = [&](const Vector<3>& a, const Vector<3>& b) {
      return present_.dot(a) < present_.dot(b);
    };
    const auto best = std::max_element(candidates_.begin(), candidates_.end(), nearer);
    return best != candidates_.end() ? std::optional(*best) : std::nullopt;
  }

 private:
  void add(const Vector<3>& u) {
    if (std::all_of(circles_.begin(), circles_.end(), [&](const search::Plane& circle) {
          return circle.n.dot(u) <= circle.b + rounding;
        }))
      candidates_.push_back(u);
  }
  void meet(const search::Plane& a, const search::Plane& b) {
    const Vector<3> apart = b.n - a.n, along = a.n.cross(apart);  // without cancellation
    const double square = along.squaredNorm();
    if (!(square > parallel)) return;
    const Vector<3> middle = ((a.b - b.b) * b.n + b.b * apart).cross(along) / square;
    const double rest = 1 - middle.squaredNorm();
    if (!(rest >= 0)) return;
    for (const double side : {1.0, -1.0})
      add((middle + side * std::sqrt(rest / square) * along).normalized());
  }

  Vector<3> present_;
  std::vector<search::Plane> circles_;
  std::vector<Vector<3>> candidates_;
};

/// The search in the units of the oracle.
class Search {
 public:
  Search(const Grasp<3>& grasp, const SpatialSettings& settings, const Vector<3>& present)
      : settings_(settings),
        present_(present),
        loads_(search::scaled_loads(grasp, grasp.scaled(), settings.force_cap)),
        oracle_(grasp, loads_, settings.objective),
        uncut_(present) {
    for (const search::Plane& plane : oracle_.thin)
      for (const double side : {1.0, -1.0}) uncut_.cut(side * plane.n, thickness);
    if (settings.tilt)
      uncut_.cut(-settings.tilt->from.normalized(), -std::cos(settings.tilt->most));
  }

  /// A value as the oracle has it.
  double scaled(double value) const {
    const double part = value / oracle_.unit;
    return settings_.objective == Objective::grip ? part * part : part / oracle_.unit;
  }
  /// The posture nearest to the present with a value of at most `most`, by cutting off what needs
  /// more than `cut`; none where it turns farther than `farthest`.
  std::optional<Vector<3>> nearest(double cut, double most, double farthest) {
    while (oracle_.holds < most_holds) {
      const std::optional<Vector<3>> up = uncut_.nearest();
      if (!up || turn(present_, *up) > farthest) return {};
      const search::Answer answer = evaluate(*up, cut);
      if (answer.value <= most) return on_planes(*up);
      const search::HalfSpace& beyond = answer.half_space;
      const double b = oracle_.offset(beyond, cut);
      if (!(beyond.normal.dot(*up) > b + rounding)) return {};  // by rounding
      uncut_.cut(beyond.normal, b);
    }
    return {};
  }
  /// The lowest on the way from the present through a posture and a little beyond.
  Vector<3> lowest_beyond(const Vector<3>& up) {
    const Vector<3> way = (up.dot(present_) * up - present_).normalized();
    const auto at = [&](double angle) -> Vector<3> {
      return on_planes(std::cos(angle) * up + std::sin(angle) * way);
    };
    const auto value = [&](double angle) {
      const Vector<3> there = at(angle);
      const bool outside =
          settings_.tilt && turn(settings_.tilt->from, there) > settings_.tilt->most;
      return outside ? infinity : evaluate(there, 1).value;
    };
    // By golden sections of [lo, hi].
    const double golden = (std::sqrt(5) - 1) / 2;
    double lo = 0, hi = worth;
    std::array<double, 2> angle = {hi - golden * hi, golden * hi};
    std::array<double, 2> at_angle = {value(angle[0]), value(angle[1])};
    for (int k = 0; k < most_sections; ++k) {
      const std::size_t better = at_angle[0] <= at_angle[1] ? 0 : 1;
      (better == 0 ? hi : lo) = angle[1 - better];
      angle[1 - better] = angle[better];
      at_angle[1 - better] = at_angle[better];
      angle[better] = better == 0 ? hi - golden * (hi - lo) : lo + golden * (hi - lo);
      at_angle[better] = value(angle[better]);
    }
    const std::size_t better = at_angle[0] <= at_angle[1] ? 0 : 1;
    return at_angle[better] < value(0) ? at(angle[better]) : up;
  }

 private:
  Vector<3> on_planes(const Vector<3>& up) const {
    return search::OnPlanes(up, oracle_.thin).posture(up);
  }
  search::Answer evaluate(const Vector<3>& up, double target) {
    return oracle_.evaluate(on_planes(up),
                            {nullptr, infinity, infinity, target, search::Digits::as_needed});
  }

  const SpatialSettings& settings_;
  Vector<3> present_;
  std::vector<search::ScaledLoad> loads_;
  Oracle oracle_;
  Uncut uncut_;
};

}  // namespace

std::optional<Vector<3>> nearest_tie(const Grasp<3>& grasp, const SpatialSettings& settings,
                                     const Vector<3>& present, const Vector<3>& known,
                                     double lowest, double most) {
  Search search(grasp, settings, present);
  const double least = search.scaled(lowest), greatest = search.scaled(most);
  const auto nearest =
      search.nearest((least + greatest) / 2, greatest, turn(present, known) - worth);
  return nearest ? std::optional(search.lowest_beyond(*nearest)) : std::nullopt;
}

}  // namespace poise
