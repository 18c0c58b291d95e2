#include "space/search.hpp"

namespace poise::search {
namespace {

/// Where the way from a shorter x to a longer one goes through the unit sphere.
Vector<3> posture_between(const Vector<3>& shorter, const Vector<3>& longer) {
  const Vector<3> way = longer - shorter;
  const double a = way.squaredNorm(), b = shorter.dot(way), c = 1 - shorter.squaredNorm();
  return (shorter + c / (b + std::sqrt(b * b + a * c)) * way).normalized();
}

/// Loads x of the sublevel set lie outside of the unit sphere (a heavier object needs less), inside
/// of it, or, by what is known, on both sides: then there is a posture between them.
class LevelSet {
 public:
  explicit LevelSet(SearchState& state) : state_(state) {
    const Vector<3> none = Vector<3>::Zero();
    if (const double value = state.evaluate(none, nullptr, Digits::all).value; value < infinity)
      lighter_ = Known{none, value};
  }
  /// False: nothing is left to do.
  bool step();

 private:
  struct Known {
    Vector<3> x;
    double value;
  };
  /// As good as any between the target and the best.
  bool is_on_target(double value) const {
    return value < infinity && value <= (1 - 0.5 * state_.gap) * state_.best_value;
  }
  bool is_on_target(const std::optional<Known>& known) const {
    return known && is_on_target(known->value);
  }
  void remember(const Vector<3>& x, double value) {
    if (is_on_target(value)) (x.norm() > 1 ? heavier_ : lighter_) = Known{x, value};
  }
  /// Visits a posture. Whether it is better than the best.
  bool improves_at(const Vector<3>& up) {
    const double before = state_.best_value;
    state_.visit(up);
    return state_.best_value < before;
  }
  double cut_at_lighter(const Vector<3>& x);
  bool cut_farthest();
  bool cut_nearest();
  void look_inside(const Polytope::Vertex& vertex, const Vector<3>& up);

  SearchState& state_;
  /// Loads of the domain known to need no more than the target when they were found.
  std::optional<Known> lighter_, heavier_;
  bool heavier_needs_less_{false};
  Nearness nearness_;
};

bool LevelSet::step() {
  const bool heavier = is_on_target(heavier_), lighter = is_on_target(lighter_);
  // While neither is known the sides take turns.
  const bool from_inside = heavier || (heavier_needs_less_ && !lighter);
  heavier_needs_less_ = false;
  if (heavier && lighter) return improves_at(posture_between(lighter_->x, heavier_->x));
  if (!from_inside) return cut_farthest();
  return cut_nearest() || !(heavier || leaves_no_posture(state_.polytope));
}

/// Cuts off the farthest vertex outside of the unit sphere. False: there is none.
bool LevelSet::cut_farthest() {
  const std::size_t far = state_.polytope.farthest_not_passed_over();
  if (far == Polytope::none) return false;
  const Polytope::Vertex vertex = state_.polytope[far];
  const Vector<3>& x = vertex.x;
  const Polytope::Planes& planes = vertex.planes;
  if (vertex.square <= 1) return false;
  if (state_.cut_to_domain(x, planes, far)) return true;
  const Vector<3> up = state_.posture_towards(x, planes);
  const std::optional<HalfSpace> start = state_.oracle.start_at(x, state_.corner(planes));
  const HalfSpace* from = start ? &*start : nullptr;
  const double before = state_.best_value, at_up = state_.visit(up, from, far);
  if (state_.best_value < before) return true;
  const auto is_still_there = [&] { return state_.polytope.has(far, x); };
  bool holds = at_up < infinity;
  if (is_still_there() && state_.digits != Digits::rough && holds)
    state_.cut_exactly_at(up, from, far);
  if (is_still_there()) {
    const double value = state_.cut_at(state_.on_tight_planes(x, planes).load(), from, far);
    holds = value < infinity;
    heavier_needs_less_ = value <= at_up;
    if (is_still_there() && is_on_target(value)) {
      heavier_ = Known{x, value};
      return true;
    }
  }
  if (is_still_there()) state_.polytope.pass_over(far);
  if (nearness_.is_due(holds)) look_inside(vertex, up);
  return true;
}

/// On the way from a vertex to the inside, and from its posture.
void LevelSet::look_inside(const Polytope::Vertex& vertex, const Vector<3>& up) {
  const Vector<3> inside = state_.inside();
  const Vector<3> x = vertex.x + nearness_.part() * (inside - vertex.x);
  const double value = state_.cut_at(x);
  remember(x, value);
  const bool holds = state_.visit_towards(inside, up, vertex.planes, nearness_.part());
  nearness_.update(holds || value < infinity);
}

double LevelSet::cut_at_lighter(const Vector<3>& x) {
  const double value = state_.cut_at(x);
  if (x.norm() < 1) remember(x, value);
  return value;
}

/// Cuts off the point of the polytope nearest to the origin. False: it is not inside of the sphere,
/// or cannot be cut off.
bool LevelSet::cut_nearest() {
  if (state_.polytope.empty()) return false;
  const Vector<3> x = state_.polytope.nearest();
  const auto is_gone = [&] { return state_.polytope.empty() || state_.polytope.nearest() != x; };
  if (x.norm() >= 1) return false;
  if (state_.cut_to_domain(x, {}, Polytope::none)) return is_gone();
  if (x.norm() > no_direction && improves_at(x.normalized())) return true;
  const auto is_done = [&] { return is_on_target(lighter_) || is_gone(); };
  if (cut_at_lighter(x) < infinity) return is_done();
  // It lies outside of what can be held, a known x inside: between them are postures, too.
  if (heavier_) {
    const Vector<3> up = posture_between(x, heavier_->x);
    if (improves_at(up)) return true;
    const Vector<3> middle = (up + heavier_->x) / 2;
    const double value = cut_at_lighter(middle);
    if (middle.norm() > 1) remember(middle, value);
  }
  // Where it lies outside by rounding, it is approached from the inside.
  const Vector<3> inside = heavier_ ? heavier_->x : state_.best.x;
  for (int k = 1; k <= Nearness::most_halvings && !is_done(); ++k)
    cut_at_lighter(x + std::ldexp(1, -k) * (inside - x));
  return is_done();
}

}  // namespace

void level_set(SearchState& state, int max_holds) {
  LevelSet search(state);
  repeat(state, max_holds, [&] { return search.step(); });
}

}  // namespace poise::search
