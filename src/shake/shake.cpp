#include "poise/shake.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "hold/solve.hpp"
#include "shake/body.hpp"
#include "shake/settings.hpp"

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double small_angle = 0.01 * std::numbers::pi / 180;
/// By which parts of the way to the middle what is held is drawn nearer where rounding decides.
constexpr double nearer[] = {1e-4, 1e-3, 1e-2, 0.1, 0.5};
/// How far to look beside a sphere of radius 1: a simplex that far contains it.
constexpr double around_sphere = 20;

/// What was found of a load: what is to lie in what is held of it.
template <int Dim, class Goal>
struct Found {
  Goal goal;
  std::optional<Hull<Dim>> hull;
};

/// Takes what was found of a load. Whether it is the weakest so far.
template <int Dim, class Result>
bool take(const Body<Dim>& body, std::size_t load, double& reach, Result& result) {
  result.holds += body.holds;
  const bool decides = !body.holdable || body.bound < result.bound;
  result.holdable = result.holdable && body.holdable;
  result.proven = body.holdable ? result.proven && body.proven : body.proven;
  reach = body.holdable ? std::min(reach, body.reach) : 0;
  if (!decides) return false;
  result.bound = body.holdable ? body.bound : 0;
  result.cut = {load, body.cut.y, body.cut.rates};
  return true;
}

/// Where rounding decides, a corner of what was found to be held may not be by a hold of its own,
/// with forces that can be shown. It is drawn nearer until it is, and the reach measured again: on
/// the way from the middle to a point of the ball or cap no facet is passed, so that the point is
/// in the hull of the middle and the corners of one facet.
/// @param is_held  of a corner
/// @return whether there are forces for all; where not, nothing is told
template <int Dim, class Goal, class IsHeld>
bool draw_nearer(Found<Dim, Goal>& found, double& reach, const IsHeld& is_held) {
  Hull<Dim>& hull = *found.hull;
  bool drawn = false;
  for (const std::size_t corner : hull.corners()) {
    double drawn_by = 0;
    bool held = is_held(hull[corner]);
    for (const double part : nearer) {
      if (held) break;
      drawn = true;
      if (!hull.draw(corner, found.goal.center, (part - drawn_by) / (1 - drawn_by))) return false;
      drawn_by = part;
      held = is_held(hull[corner]);
    }
    if (!held) return false;
  }
  if (drawn)
    for (const typename Hull<Dim>::Facet& facet : hull.facets())
      reach = std::min(reach, found.goal.reach(facet.n, facet.b));
  return true;
}

/// Tells what is held, with `point(load, z)` the vectors that results have for it, and `middle`
/// that of the posture itself.
/// @param load_at  the load and the posture of such a vector
template <int Dim, class Goal, class Result, class Point, class LoadAt>
void tell_what_is_held(const Hand<Dim>& hand, const ShakeSettings& settings, double little,
                       double& reach, Result& result, std::vector<Found<Dim, Goal>>& found,
                       const Vector<Dim>& middle, const Point& point, const LoadAt& load_at) {
  const double before = reach;
  bool all = true;
  for (std::size_t k = 0; k < found.size() && result.holdable && all; ++k) {
    const auto is_held = [&](const Vector<Dim>& x) {
      const auto [load, up] = load_at(k, x);
      return hold<Dim>(hand, load, up, {.force_cap = settings.force_cap}).holdable;
    };
    const auto is_corner_held = [&](const Vector<Dim>& z) { return is_held(point(k, z)); };
    all = is_held(middle) && (!found[k].hull || draw_nearer(found[k], reach, is_corner_held));
  }
  if (!all || !result.holdable) {
    reach = 0;
    result.proven = all ? result.proven : result.bound <= little;
    return;
  }
  if (reach < before) result.proven = result.bound <= reach * (1 + settings.gap) + little;
  reach = std::min(reach, result.bound);  // else above it by rounding
  for (std::size_t k = 0; k < found.size(); ++k)
    if (const auto& hull = found[k].hull)
      for (const std::size_t corner : hull->corners())
        result.held[k].push_back(point(k, (*hull)[corner]));
}

}  // namespace

template <int Dim>
Shake<Dim> shake(const Grasp<Dim>& grasp, const Vector<Dim>& up, const ShakeSettings& settings) {
  check_up<Dim>(up);
  check_shake(settings);
  const Hand<Dim> hand = limited_hand<Dim>(grasp, settings);
  Shake<Dim> result{.holdable = true, .acceleration = infinity, .bound = infinity};
  result.held.resize(grasp.loads().size());
  std::vector<Found<Dim, Ball<Dim>>> found;
  for (std::size_t k = 0; k < grasp.loads().size() && result.holdable; ++k) {
    const Load<Dim>& load = grasp.loads()[k];
    const Supply<Dim> supply(hand, load, settings.force_cap);
    const Ball<Dim> ball{supply.at(up)};
    Body<Dim> body(supply, ball.center);
    if (load.weight > 0)
      body.measure(ball, wanted_shake(settings, result.acceleration));
    else
      body.only_inside();
    if (take(body, k, result.acceleration, result)) result.direction = body.cut.n;
    found.push_back({ball, body.hull()});
  }
  tell_what_is_held(
      hand, settings, no_acceleration, result.acceleration, result, found,
      Vector<Dim>(Vector<Dim>::Zero()),
      [&](std::size_t k, const Vector<Dim>& z) { return Vector<Dim>(z - found[k].goal.center); },
      [&](std::size_t k, const Vector<Dim>& x) {
        Load<Dim> load = grasp.loads()[k];
        load.acceleration += x;
        return std::pair(load, up);
      });
  return result;
}

template <int Dim>
Tilting<Dim> tilting(const Grasp<Dim>& grasp, const Vector<Dim>& up,
                     const ShakeSettings& settings) {
  check_up<Dim>(up);
  check_shake(settings);
  const Hand<Dim> hand = limited_hand<Dim>(grasp, settings);
  constexpr double pi = std::numbers::pi;
  Tilting<Dim> result{.holdable = true, .angle = infinity, .bound = infinity};
  result.held.resize(grasp.loads().size());
  std::vector<Found<Dim, Cap<Dim>>> found;
  for (std::size_t k = 0; k < grasp.loads().size() && result.holdable; ++k) {
    const Load<Dim>& load = grasp.loads()[k];
    const Supply<Dim> supply(hand, load, settings.force_cap);
    const Cap<Dim> cap{supply.at(up)};
    Body<Dim> body(supply, cap.center);
    const Wanted wanted{.gap = settings.gap,
                        .little = small_angle,
                        .far = infinity,
                        .horizon = around_sphere * std::abs(supply.gravity()),
                        .enough = result.angle,
                        .needed = 0,
                        .max_holds = settings.max_holds};
    const double gravity = supply.gravity();
    if (load.turning() != 0)
      body.measure(cap, wanted);
    else
      body.only_inside();
    found.push_back({cap, body.hull()});
    if (take(body, k, result.angle, result))
      result.up = body.holdable ? Vector<Dim>(cap.at(body.cut.n, body.bound) / gravity) : up;
  }
  result.angle = std::min(result.angle, pi);
  result.bound = std::min(result.bound, pi);
  tell_what_is_held(
      hand, settings, small_angle, result.angle, result, found, up,
      [&](std::size_t k, const Vector<Dim>& z) {
        return Vector<Dim>(z / (standard_gravity + grasp.loads()[k].lift));
      },
      [&](std::size_t k, const Vector<Dim>& x) {  // another vector in place of up is another lift
        Load<Dim> load = grasp.loads()[k];
        const double length = x.norm();
        load.lift = length * (standard_gravity + load.lift) - standard_gravity;
        return std::pair(load, length > 0 ? Vector<Dim>(x / length) : up);
      });
  return result;
}

#define POISE_INSTANTIATE(Dim)                                                            \
  template Shake<Dim> shake(const Grasp<Dim>&, const Vector<Dim>&, const ShakeSettings&); \
  template Tilting<Dim> tilting(const Grasp<Dim>&, const Vector<Dim>&, const ShakeSettings&);
POISE_INSTANTIATE(2)
POISE_INSTANTIATE(3)
#undef POISE_INSTANTIATE

}  // namespace poise
