#include <algorithm>
#include <cmath>

#include "dual/exact.hpp"
#include "poise/grip.hpp"
#include "space/search.hpp"

namespace poise::search {
namespace {

using dual::Exact;

/// What rounding of vertices may make out, and of y where it is as good as infinitely long.
constexpr double safe = 1 - 1e-10;
/// A bound [squared weights] that is as good as 0.
constexpr double no_bound = 1e-300;
/// So much is added to what cuts leave: where planes are nearly parallel rounding moves a vertex by
/// far more than itself, and who computes otherwise must find the bound true.
constexpr double loosened = 1e-11;
/// Shorter y [1 / weight] lose less by rounding than the search adds for it.
constexpr double longest_trusted_y = 1e6;

/// What cuts are to prove: that no posture needs at most t, an effort [N^2] or a grip.
struct Claim {
  const Grasp<3>& grasp;
  const SpatialSettings& settings;
  bool is_gauge;  ///< the root of the effort is one
  Exact t;

  /// y . w of the loads that need at most t is at most this.
  Exact most_power(const Cut& cut) const;
};

Exact Claim::most_power(const Cut& cut) const {
  dual::Rates rates;
  const std::size_t count = cut.rates ? cut.rates->size() : 0;
  rates.resize(count);
  Exact sum = 0;
  for (std::size_t a = 0; a < count; ++a) sum += rates[a] = (*cut.rates)[a];
  const Wrench<3> none = Wrench<3>::Zero();
  if (settings.objective == Objective::grip) {
    const bool in_parts = grip_unit<3>(grasp) == GripUnit::part_of_max;
    return sum * t - dual::grip_bound<3>(grasp, none, cut.y, rates, in_parts,
                                         settings.force_cap * grasp.size());
  }
  if (count > 0) return t / 2 - dual::effort_bound<3>(grasp, none, cut.y, rates, 1) / 2;
  const Exact phi = dual::phi<3>(grasp, cut.y);
  return is_gauge ? std::sqrt(2 * std::max<Exact>(phi, 0) * t) : t / 2 + phi;
}

/// The half-space n . x <= b in which a cut leaves the loads x that need at most t. Where the root
/// of the effort is a gauge, for the best length of y.
Plane left_by(const Claim& claim, const Cut& cut) {
  if (cut.n) return {cut.n->normalized(), 0};
  const Grasp<3>& grasp = claim.grasp;
  const Load<3>& load = grasp.loads()[cut.load];
  const Eigen::Matrix<Exact, 3, 1> v = dual::velocity<3>(cut.y, load.com);
  const Exact speed = std::abs(load.turning()) * v.norm();
  const Exact size = grasp.radius() + (load.com - grasp.center()).norm();
  const Exact slack = dual::delta * load.size(grasp.length()) * (v.norm() + size * cut.y.tail<3>().norm());
  const Exact fixed = cut.y.cast<Exact>().dot(load.still().cast<Exact>());
  const Exact b = claim.most_power(cut) - fixed;
  if (!(speed > 0)) return {Vector<3>::Zero(), static_cast<double>(b + slack)};
  const double side = load.turning() < 0 ? -1 : 1;
  return {(v / v.norm()).cast<double>() * side, static_cast<double>((b + slack) / speed)};
}

/// What cuts leave of the loads x that need at most t, in a cube around the unit sphere.
Polytope left_by(const Claim& claim, const std::vector<Cut>& cuts) {
  constexpr double cube = 4;
  Polytope left(cube);
  int id = static_cast<int>(Polytope::cube_sides);
  for (const Cut& cut : cuts) {
    const Plane plane = left_by(claim, cut);
    if (plane.n.allFinite() && std::isfinite(plane.b)) left.cut(plane.n, plane.b + loosened, id++);
  }
  return left;
}

/// By the farthest vertex.
double bound_of_gauge(const SearchState& state) {
  const std::size_t far = state.polytope.farthest();
  const double square = far == Polytope::none ? 0 : state.polytope[far].square;
  return safe / std::max(square, 1e-40);
}

/// Down from the target in longer and longer steps to a level whose set is proven empty, then
/// between the last two.
double bound_of_level_sets(SearchState& state) {
  if (leaves_no_posture(state.polytope)) return safe * state.target;
  const auto proves = [&](double t) {
    state.rebuild(t);
    return leaves_no_posture(state.polytope);
  };
  constexpr int halvings = 8;
  const double from = state.target, bottom = std::max(state.oracle.least, no_bound);
  double most = from, least = from;
  for (double step = state.gap; least == most || !proves(least); step *= 4) {
    most = least;
    least = step < 0.5 ? from * (1 - step) : least / 4;
    if (least <= bottom) break;
  }
  for (int k = 0; k < halvings && least > bottom; ++k) {
    const double middle = std::sqrt(least * most);
    (proves(middle) ? least : most) = middle;
  }
  return proves(least) ? safe * least : 0;
}

}  // namespace

double lower_bound(SearchState& state) {
  const double bound = state.oracle.is_gauge ? bound_of_gauge(state) : bound_of_level_sets(state);
  return std::max(state.oracle.least, bound);
}

double proven_bound(const Grasp<3>& grasp, const std::vector<Cut>& cuts, const Oracle& oracle,
                    const SpatialSettings& settings, double claimed) {
  const bool is_grip = settings.objective == Objective::grip;
  const bool is_long = std::any_of(cuts.begin(), cuts.end(), [&](const Cut& cut) {
    return cut.y.cwiseAbs().maxCoeff() > longest_trusted_y * grasp.loads()[cut.load].size(grasp.length());
  });
  if (!is_long && !is_grip && !grasp.is_general()) return claimed;
  const Exact unit = oracle.unit;
  const auto left_at = [&](Exact bound) {
    return left_by(
        {grasp, settings, oracle.is_gauge, is_grip ? unit * std::sqrt(bound) : unit * unit * bound},
        cuts);
  };
  const double least = oracle.least;
  if (oracle.is_gauge) {
    const Polytope left = left_at(claimed);
    const std::size_t far = left.farthest();
    const double beyond = far == Polytope::none ? 0 : left[far].square;
    return std::max(least, claimed / std::max(beyond, 1.0));
  }
  // Claims that fail do so by little: longer and longer steps down.
  double bound = claimed;
  for (double step = 1e-3 * settings.gap; bound > least; step *= 4) {
    if (leaves_no_posture(left_at(bound))) return bound;
    bound = claimed * (1 - step);
  }
  return least;
}

std::vector<Cut> certificate(const SearchState& state, double t) {
  const Polytope& polytope = state.polytope;
  constexpr std::size_t sides = Polytope::cube_sides;
  std::vector<char> needed(sides + state.half_spaces.size(), polytope.empty() ? 1 : 0);
  for (std::size_t i = 0; i < polytope.size(); ++i)
    if (polytope[i].alive)
      for (const int id : polytope[i].planes) needed[static_cast<std::size_t>(id)] = 1;
  std::vector<Cut> cuts;
  const bool is_cube_proven =
      state.oracle.is_gauge || state.oracle.half_width(t) <= half_of_limited_cube;
  for (std::size_t id = 0; id < needed.size(); ++id) {
    if (needed[id] == 0 || (id < sides && !is_cube_proven)) continue;
    cuts.push_back(id < sides ? state.oracle.side_of_cube(static_cast<int>(id), t)
                              : state.oracle.cut(state.half_spaces[id - sides], t));
  }
  return cuts;
}

}  // namespace poise::search
