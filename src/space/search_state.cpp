#include "space/search_state.hpp"

namespace poise::search {
namespace {

/// Where nothing held: what is above the cap by more than rounding shall be told from it.
constexpr double above_most = 1.01;
/// What rounding may take of a bound: a proof goes for so much more, or what the gap allows.
constexpr double rounding_of_proofs = 3e-10;
/// Angles outside of the domain [rad] that may be rounding, for postures; and for vertices, which
/// are cut off as far as that goes. The domain's posture nearest to a vertex is worth a visit.
constexpr double domain_rounding = 1e-9, vertex_rounding = 1e-12, near_domain = 1e-2;
/// What is nearer to a plane is on it but for rounding: a thin plane; one of a corner.
constexpr double on_thin = 1e-6, on_tight = 1e-7;

}  // namespace

SearchState::SearchState(Oracle asked, std::vector<TiltCone> cones, double wanted, Digits how)
    : oracle(std::move(asked)), domain(std::move(cones)), gap(wanted), digits(how) {
  half_spaces = oracle.unresisted;
  rebuild(oracle.is_gauge ? target : wanted_target());
}

void SearchState::begin_with(const SearchState& other) {
  if (other.best_value < infinity) visit(other.best.x, &other.best);
  for (const HalfSpace& known : other.half_spaces) {
    half_spaces.push_back(oracle.adopted(known));
    cut(half_spaces.size() - 1);
  }
}

Polytope SearchState::cube() const {
  const double half = oracle.half_width(target);
  return Polytope(oracle.is_gauge ? half : std::min(half, half_of_limited_cube));
}

double SearchState::wanted_target() const {
  const double margin = std::clamp(rounding_of_proofs, 0.01 * gap, 0.5 * gap);
  return std::min((1 - gap + margin) * best_value, above_most * oracle.most);
}

bool SearchState::is_in_domain(const Vector<3>& up) const {
  return std::all_of(domain.begin(), domain.end(),
                     [&](const TiltCone& cone) { return cone.excess(up) <= domain_rounding; });
}

bool SearchState::is_cut_off(const Vector<3>& up) const {
  const double at = wanted_target();
  return std::any_of(half_spaces.begin(), half_spaces.end(), [&](const HalfSpace& half_space) {
    return half_space.normal.dot(up) > oracle.offset(half_space, at);
  });
}

/// To the planes that motions without resistance leave, where it is on them but for rounding.
Vector<3> SearchState::snapped(const Vector<3>& x) const {
  const auto is_on = [&](const Plane& plane) { return std::abs(plane.n.dot(x)) < on_thin; };
  const std::vector<Plane>& thin = oracle.thin;
  if (thin.empty() || x.norm() <= no_direction || !std::all_of(thin.begin(), thin.end(), is_on))
    return x;
  const Vector<3> moved = OnPlanes(x, thin).load().normalized() * x.norm();
  return is_in_domain(x) && !is_in_domain(moved) ? x : moved;
}

Answer SearchState::evaluate(const Vector<3>& x, const HalfSpace* start, Digits how,
                             double proven) {
  return oracle.evaluate(snapped(x), {start, best_value, improvement(), target, how, proven});
}

double SearchState::cut_by(const Answer& answer, std::size_t vertex) {
  half_spaces.push_back(answer.half_space);
  cut(half_spaces.size() - 1, vertex);
  return answer.value;
}

double SearchState::cut_at(const Vector<3>& x, const HalfSpace* start, std::size_t vertex) {
  return cut_by(evaluate(x, start), vertex);
}

double SearchState::cut_exactly_at(const Vector<3>& x, const HalfSpace* start, std::size_t vertex) {
  return cut_by(evaluate(x, start, Digits::all), vertex);
}

double SearchState::visit(const Vector<3>& up, const HalfSpace* start, std::size_t vertex,
                          double proven) {
  const Answer answer = evaluate(up, start, digits, proven);
  const bool is_better = answer.value < improvement() && is_in_domain(up);
  if (is_better) {
    best_value = answer.value;
    best = answer.half_space;
  }
  if (!is_better || oracle.is_gauge) return cut_by(answer, vertex);
  half_spaces.push_back(answer.half_space);
  rebuild(wanted_target());
  return answer.value;
}

bool SearchState::cut(std::size_t half_space, std::size_t vertex) {
  const Vector<3>& normal = half_spaces[half_space].normal;
  const double b = oracle.offset(half_spaces[half_space], target);
  const int id = static_cast<int>(Polytope::cube_sides + half_space);
  return (vertex != Polytope::none && polytope.cut(normal, b, id, vertex)) ||
         polytope.cut(normal, b, id);
}

void SearchState::rebuild(double new_target) {
  target = new_target;
  polytope = cube();
  for (std::size_t i = 0; i < half_spaces.size(); ++i) cut(i);
}

Corner SearchState::corner(const Polytope::Planes& planes) const {
  Corner corner{};
  for (std::size_t k = 0; k < 3; ++k)
    if (const auto id = static_cast<std::size_t>(planes[k]); id >= Polytope::cube_sides)
      corner[k] = &half_spaces[id - Polytope::cube_sides];
  return corner;
}

OnPlanes SearchState::on_tight_planes(const Vector<3>& x, const Polytope::Planes& planes) const {
  std::vector<Plane> tight;
  for (const HalfSpace* each : corner(planes)) {
    if (each == nullptr || each->origin == HalfSpace::Origin::held) continue;
    const double b = oracle.is_gauge ? 0 : oracle.offset(*each, target);
    if (std::abs(each->normal.dot(x) - b) <= on_tight) tight.push_back({each->normal, b});
  }
  return {x, tight};
}

bool SearchState::visit_towards(const Vector<3>& inside, const Vector<3>& up,
                                const Polytope::Planes& planes, double part) {
  const Vector<3> x = best_value < infinity ? Vector<3>(up + part * (inside - up)) : inside;
  return x.norm() > no_direction && visit(posture_towards(x, planes)) < infinity;
}

bool SearchState::cut_to_domain(const Vector<3>& x, const Polytope::Planes& planes,
                                std::size_t vertex) {
  for (const TiltCone& cone : domain) {
    const double excess = cone.excess(x);
    if (!(excess > vertex_rounding)) continue;
    const HalfSpace* nearest = nearest_held(x, corner(planes));
    const HalfSpace start = nearest != nullptr ? *nearest : HalfSpace{};
    half_spaces.push_back(
        {.origin = HalfSpace::Origin::domain, .normal = cone.plane(x).normalized()});
    if (!cut(half_spaces.size() - 1, vertex) && vertex != Polytope::none) {
      if (excess < domain_rounding) continue;
      polytope.pass_over(vertex);
    }
    if (excess < near_domain) visit(cone.nearest(x), nearest != nullptr ? &start : nullptr);
    return true;
  }
  return false;
}

bool leaves_no_posture(const Polytope& polytope) {
  return polytope.empty() || polytope[polytope.farthest()].square <= 1 ||
         polytope.nearest().squaredNorm() > 1;
}

}  // namespace poise::search
