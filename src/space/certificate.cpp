#include "space/search.hpp"

namespace poise::search {
namespace {

/// What rounding of vertices may make out, and of y where it is as good as infinitely long.
constexpr double safe = 1 - 1e-10;
/// A bound [squared weights] that is as good as 0.
constexpr double no_bound = 1e-300;

/// By the farthest vertex.
double bound_of_gauge(const SearchState& state) {
  const std::size_t far = state.polytope.farthest();
  const double square = far == Polytope::none ? 0 : state.polytope[far].square;
  return safe / std::max(square, 1e-40);
}

/// Down from the target in longer and longer steps to a level whose set is proven empty, then
/// between the last two.
double bound_of_level_sets(SearchState& state) {
  if (state.leaves_no_posture()) return safe * state.target;
  const auto proves = [&](double t) {
    state.rebuild(t);
    return state.leaves_no_posture();
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
  proves(least);
  return safe * least;
}

}  // namespace

double lower_bound(SearchState& state) {
  const double bound = state.oracle.is_gauge ? bound_of_gauge(state) : bound_of_level_sets(state);
  return std::max(state.oracle.least, bound);
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
