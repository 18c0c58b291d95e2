#include "shake/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-7;      ///< what the parts that were found may be wrong by
constexpr double longest_corner = 30;  ///< of the first simplex, of its shortest
/// What is held is told a little nearer to the inside, by a part of the gap: what the solver leaves
/// of an imbalance does not matter there.
constexpr double pulled = 0.01;
constexpr int most_probes = 60;      ///< along one ray
constexpr double first_step = 1e-3;  ///< before its end
/// After so many of them ever nearer: with drives that are much stronger than the load needs, cuts
/// far out say little of where friction ends.
constexpr int patient_probes = 8;

/// Where to ask along a ray: at its end, as far as cuts allow; where that comes nearer no more, in
/// longer and longer steps before it.
struct Probes {
  double step;
  double end{infinity}, shorter{0};

  double next(double new_end) {
    if (new_end > end * (1 - step))
      shorter = shorter == 0 ? step : std::min(4 * shorter, (1 + shorter) / 2);
    end = new_end;
    return end * (1 - shorter);
  }
};

/// The corners of a regular simplex about 0.
template <int Dim>
std::array<Vector<Dim>, Dim + 1> simplex();
template <>
std::array<Vector<2>, 3> simplex<2>() {
  const double half = std::sqrt(3) / 2;
  return {Vector<2>(0, 1), Vector<2>(-half, -0.5), Vector<2>(half, -0.5)};
}
template <>
std::array<Vector<3>, 4> simplex<3>() {
  const double k = 1 / std::sqrt(3);
  return {Vector<3>(k, k, k), Vector<3>(k, -k, -k), Vector<3>(-k, k, -k), Vector<3>(-k, -k, k)};
}

/// A unit vector across `along`, on the side of n.
template <int Dim>
Vector<Dim> across(const Vector<Dim>& along, const Vector<Dim>& n) {
  const Vector<Dim> part = n - along.dot(n) * along;
  if (part.norm() > 1e-12) return part.normalized();
  if constexpr (Dim == 2)
    return {-along.y(), along.x()};
  else
    return tangents(along).col(0);
}

}  // namespace

template <int Dim>
double Cap<Dim>::reach(const Vector<Dim>& n, double b) const {
  const double radius = center.norm();
  if (!(b < radius)) return infinity;
  const Vector<Dim> along = center / radius;
  const double to = std::atan2(std::abs(across(along, n).dot(n)), along.dot(n));
  return std::max(to - std::acos(std::max(b / radius, -1.0)), 0.0);
}

template <int Dim>
Vector<Dim> Cap<Dim>::at(const Vector<Dim>& n, double angle) const {
  const double radius = center.norm();
  const Vector<Dim> along = center / radius;
  return std::cos(angle) * center + radius * std::sin(angle) * across(along, n);
}

template <int Dim>
Vector<Dim> Cap<Dim>::touching(const Vector<Dim>& n, double b) const {
  return at(n, reach(n, b));
}

template <int Dim>
typename Body<Dim>::Held Body<Dim>::look(const Vector<Dim>& z) {
  ++holds;
  typename Supply<Dim>::Answer answer = supply_.ask(z);
  if (answer.cut) cuts_.push_back(std::move(*answer.cut));
  const double part = answer.part * (1 + rounding);
  if (part == infinity) return {};
  const auto pull = [&](const Vector<Dim>& way) -> Vector<Dim> {
    return inside_ + (1 - pull_) * way;
  };
  // Parts are convex in z, and 0 at 0 where forces can be multiplied.
  const double along = part <= 1 ? 1 : (1 - part_inside_) / (part - part_inside_);
  Held held{pull(along * (z - inside_)), {}};
  if (supply_.is_gauge() && part > 0.5) held.beside = pull(z / part - inside_);
  return held;
}

/// As far from the inside as cuts allow.
template <int Dim>
double Body<Dim>::end_of(const Vector<Dim>& direction, double far) const {
  double end = far;
  for (const SupplyCut<Dim>& each : cuts_)
    if (const double rises = each.n.dot(direction); rises > 0)
      end = std::min(end, std::max((each.b - each.n.dot(inside_)) / rises, 0.0));
  return end;
}

template <int Dim>
std::optional<Vector<Dim>> Body<Dim>::look_along(const Vector<Dim>& direction, double far) {
  Probes probes{first_step};
  for (int k = 0; k < most_probes; ++k) {
    double end = probes.next(end_of(direction, far));
    if (k > patient_probes) end *= std::pow(0.5, k - patient_probes);
    if (!(end > 0)) return {};
    const std::optional<Vector<Dim>> found = look(inside_ + end * direction).on_line;
    if (found && (*found - inside_).norm() > 1e-9 * end) return found;
  }
  return {};
}

/// A simplex of what is held around the inside.
template <int Dim>
bool Body<Dim>::span(double far) {
  std::array<Vector<Dim>, Dim + 1> corners = simplex<Dim>();
  double shortest = infinity;
  for (Vector<Dim>& corner : corners) {
    const std::optional<Vector<Dim>> found = look_along(corner, far);
    if (!found) return false;
    corner = *found;
    shortest = std::min(shortest, (corner - inside_).norm());
  }
  // The shortest bounds the reach; what is much longer would cost digits.
  for (Vector<Dim>& corner : corners) {
    const Vector<Dim> way = corner - inside_;
    corner = inside_ + std::min(1.0, longest_corner * shortest / way.norm()) * way;
  }
  hull_.emplace(corners);
  return !hull_->facets().empty();
}

template <int Dim>
template <class Goal>
void Body<Dim>::take_bound(const Goal& goal) {
  for (; taken_ < cuts_.size(); ++taken_) {
    const SupplyCut<Dim>& each = cuts_[taken_];
    if (each.n.isZero(0)) continue;
    const double here = std::max(goal.reach(each.n, each.b), 0.0);
    if (!(here < bound)) continue;
    bound = here;
    cut = each;
  }
}

/// Moves a facet outwards where the ball or cap touches it, or the bound inwards. False: neither.
template <int Dim>
template <class Goal>
bool Body<Dim>::extend(const Goal& goal, const typename Hull<Dim>::Facet& facet,
                       const Wanted& wanted) {
  const Vector<Dim> touching = goal.touching(facet.n, facet.b) - inside_;
  const double length = touching.norm(), before = bound;
  const Vector<Dim> direction = length > 0 ? Vector<Dim>(touching / length) : facet.n;
  Probes probes{wanted.gap / 8};
  for (int k = 0; k < most_probes; ++k) {
    const double end = probes.next(end_of(direction, wanted.horizon));
    if (!(end > length)) break;
    const Held found = look(inside_ + end * direction);
    bool moved = false;
    for (const std::optional<Vector<Dim>>& z : {found.beside, found.on_line})
      if (z && facet.n.dot(*z) > facet.b) moved = hull_->add(*z) || moved;
    if (moved) return true;
  }
  take_bound(goal);
  return bound < before;
}

template <int Dim>
void Body<Dim>::only_inside() {
  ++holds;
  const typename Supply<Dim>::Answer here = supply_.ask(inside_);
  holdable = here.part <= 1 + rounding;
  part_inside_ = std::min(here.part, 1.0);
  if (here.cut) cuts_.push_back(*here.cut);
  if (!holdable) {
    if (here.cut) cut = *here.cut;
    proven = here.cut && cut.n.dot(inside_) > cut.b;
    return;
  }
  reach = bound = infinity;
}

template <int Dim>
template <class Goal>
void Body<Dim>::measure(const Goal& goal, const Wanted& wanted) {
  only_inside();
  if (!holdable) return;
  reach = 0;
  pull_ = pulled * wanted.gap;
  take_bound(goal);
  const bool spanned = bound > wanted.needed && span(wanted.horizon);
  take_bound(goal);
  const auto is_near = [&] { return bound <= reach * (1 + wanted.gap) + wanted.little; };
  while (spanned) {
    const auto& facets = hull_->facets();
    const auto by_reach = [&](const auto& a, const auto& b) {
      return goal.reach(a.n, a.b) < goal.reach(b.n, b.b);
    };
    const typename Hull<Dim>::Facet nearest =
        *std::min_element(facets.begin(), facets.end(), by_reach);
    reach = std::max(goal.reach(nearest.n, nearest.b), 0.0);
    take_bound(goal);
    if (reach >= wanted.far || reach >= wanted.enough || is_near() || bound <= wanted.needed ||
        holds >= wanted.max_holds)
      break;
    if (!extend(goal, nearest, wanted)) break;
  }
  if (reach >= wanted.far) reach = bound = infinity;
  proven = reach >= wanted.enough || is_near();
}

template struct Cap<2>;
template struct Cap<3>;
template class Body<2>;
template class Body<3>;
#define POISE_INSTANTIATE(Dim, Goal) \
  template void Body<Dim>::measure(const Goal<Dim>&, const Wanted&);
POISE_INSTANTIATE(2, Ball)
POISE_INSTANTIATE(3, Ball)
POISE_INSTANTIATE(2, Cap)
POISE_INSTANTIATE(3, Cap)
#undef POISE_INSTANTIATE

}  // namespace poise
