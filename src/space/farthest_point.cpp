#include "space/search.hpp"

namespace poise::search {
namespace {

/// False: the farthest vertex is no farther than the target asks for.
bool cut_farthest(SearchState& state, Nearness& nearness) {
  const std::size_t far = state.polytope.farthest_not_passed_over();
  if (far == Polytope::none) return false;
  const Polytope::Vertex vertex = state.polytope[far];
  if (vertex.square <= 1 / state.wanted_target()) return false;
  if (state.cut_to_domain(vertex.x, vertex.planes, far)) return true;
  const Vector<3> up = state.posture_towards(vertex.x, vertex.planes);
  const std::optional<HalfSpace> start =
      state.oracle.start_at(vertex.x, state.corner(vertex.planes));
  const HalfSpace* from = start ? &*start : nullptr;
  const bool holds = state.visit(up, from, far, 1 / vertex.square) < infinity;
  const auto is_still_there = [&] { return state.polytope.has(far, vertex.x); };
  if (is_still_there() && state.digits != Digits::rough) state.cut_exactly_at(up, from, far);
  if (is_still_there()) state.polytope.pass_over(far);
  if (nearness.is_due(holds))
    nearness.update(state.visit_towards(state.inside(), up, vertex.planes, nearness.part()));
  return true;
}

}  // namespace

void farthest_point(SearchState& state, int max_holds) {
  Nearness nearness;
  repeat(state, max_holds, [&] { return cut_farthest(state, nearness); });
}

void minimise(SearchState& state, int max_holds) {
  for (const TiltCone& cone : state.domain)
    if (state.best_value == infinity && state.is_in_domain(cone.axis)) state.visit(cone.axis);
  for (const Vector<3>& up : state.oracle.candidates) {
    if (state.oracle.holds >= max_holds / 4) break;
    if (state.is_in_domain(up) && !state.is_cut_off(up)) state.visit(up);
  }
  state.oracle.is_gauge ? farthest_point(state, max_holds) : level_set(state, max_holds);
}

}  // namespace poise::search
