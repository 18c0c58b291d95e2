#include "poise/shake.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "hold/solve.hpp"
#include "shake/body.hpp"
#include "shake/settings.hpp"

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of standard gravity: what is as good as no acceleration.
constexpr double no_acceleration = 1e-9;
constexpr double small_angle = 0.01 * std::numbers::pi / 180;
/// Of the force cap: forces are at least as great as the load, and some weights in the mean.
constexpr double part_of_cap = 1e-3;
/// By which parts what is held is drawn towards the middle where rounding decides at its border.
constexpr double nearer[] = {1e-4, 1e-3, 1e-2};
/// How far to look beside a sphere of radius 1: a simplex that far contains it.
constexpr double around_sphere = 20;

/// The settings of one load: no longer reach is of interest than that of the loads before.
Wanted wanted_of(const ShakeSettings& settings, double reach) {
  return {.gap = settings.gap,
          .little = 0,
          .far = infinity,
          .horizon = infinity,
          .enough = reach,
          .max_holds = settings.max_holds};
}

/// Takes what was found of a load, with the points that are held told by `point`. Whether the load
/// is the weakest so far.
template <int Dim, class Result, class Tell>
bool take(const Body<Dim>& body, std::size_t load, double& reach, Result& result,
          const Tell& point) {
  result.holds += body.holds;
  for (const Vector<Dim>& z : body.held()) result.held[load].push_back(point(z));
  const bool decides = !body.holdable || body.bound < result.bound;
  result.holdable = result.holdable && body.holdable;
  result.proven = body.holdable ? result.proven && body.proven : body.proven;
  reach = body.holdable ? std::min(reach, body.reach) : 0;
  if (!decides) return false;
  result.bound = body.holdable ? body.bound : 0;
  result.cut = {load, body.cut.y, body.cut.rates};
  return true;
}

/// Draws what is held towards the middle: its hull is smaller by a part, and so is the ball in it.
template <int Dim>
bool draw_nearer(Shake<Dim>& result, double part) {
  if (!std::isfinite(result.acceleration)) return false;
  result.acceleration *= 1 - part;
  for (auto& held : result.held)
    for (Vector<Dim>& x : held) x *= 1 - part;
  return true;
}
template <int Dim>
bool draw_nearer(Tilting<Dim>&, double) {  // of a cap it is not known how much smaller it is
  return false;
}

/// Where rounding decides, what was found to be held may not be by a hold of its own, with forces
/// that can be shown. Then less is told of it, or nothing.
template <int Dim, class Result, class LoadAt>
void drop_what_has_no_forces(const Hand<Dim>& hand, const ShakeSettings& settings, double little,
                             double& reach, Result& result, const Vector<Dim>& inside,
                             const LoadAt& load_at) {
  const auto is_held = [&](std::size_t k, const Vector<Dim>& z) {
    const auto [load, up] = load_at(k, z);
    return hold<Dim>(hand, load, up, {.force_cap = settings.force_cap}).holdable;
  };
  const auto all_held = [&] {
    for (std::size_t k = 0; k < result.held.size(); ++k)
      for (const Vector<Dim>& z : result.held[k])
        if (!is_held(k, z)) return false;
    return true;
  };
  bool all = true;
  for (std::size_t k = 0; k < result.held.size() && result.holdable; ++k)
    all = all && is_held(k, inside);
  if (all) {
    all = all_held();
    for (const double part : nearer) {
      if (all || !draw_nearer(result, part)) break;
      all = all_held();
      result.proven = result.bound <= reach * (1 + settings.gap) + little;
    }
  }
  if (all) {
    reach = std::min(reach, result.bound);  // else above it by rounding
    return;
  }
  reach = 0;
  result.proven = result.bound <= little;
  for (auto& held : result.held) held.clear();
}

}  // namespace

template <int Dim>
Shake<Dim> shake(const Grasp<Dim>& grasp, const Vector<Dim>& up, const ShakeSettings& settings) {
  check_up<Dim>(up);
  check_shake(settings);
  const Hand<Dim> hand = limited_hand<Dim>(grasp, settings);
  Shake<Dim> result{.holdable = true, .acceleration = infinity, .bound = infinity};
  result.held.resize(grasp.loads().size());
  for (std::size_t k = 0; k < grasp.loads().size() && result.holdable; ++k) {
    const Load<Dim>& load = grasp.loads()[k];
    const Supply<Dim> supply(hand, load, settings.force_cap);
    const Ball<Dim> ball{supply.at(up)};
    Body<Dim> body(supply, ball.center);
    Wanted wanted = wanted_of(settings, result.acceleration);
    wanted.little = no_acceleration * standard_gravity;
    wanted.far = part_of_cap * settings.force_cap * standard_gravity;
    wanted.horizon = 4 * wanted.far;
    if (load.weight > 0)
      body.measure(ball, wanted);
    else
      body.only_inside();
    if (take(body, k, result.acceleration, result,
             [&](const Vector<Dim>& z) { return Vector<Dim>(z - ball.center); }))
      result.direction = body.cut.n;
  }
  drop_what_has_no_forces(hand, settings, no_acceleration * standard_gravity, result.acceleration,
                          result, Vector<Dim>(Vector<Dim>::Zero()),
                          [&](std::size_t k, const Vector<Dim>& z) {
                            Load<Dim> load = grasp.loads()[k];
                            load.acceleration += z;
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
  for (std::size_t k = 0; k < grasp.loads().size() && result.holdable; ++k) {
    const Load<Dim>& load = grasp.loads()[k];
    const Supply<Dim> supply(hand, load, settings.force_cap);
    const Cap<Dim> cap{supply.at(up)};
    Body<Dim> body(supply, cap.center);
    Wanted wanted = wanted_of(settings, result.angle);
    wanted.little = small_angle;
    wanted.horizon = around_sphere * std::abs(supply.gravity());
    const double gravity = supply.gravity();
    if (load.turning() != 0)
      body.measure(cap, wanted);
    else
      body.only_inside();
    if (take(body, k, result.angle, result,
             [&](const Vector<Dim>& z) { return Vector<Dim>(z / gravity); }))
      result.up = body.holdable ? Vector<Dim>(cap.at(body.cut.n, body.bound) / gravity) : up;
  }
  result.angle = std::min(result.angle, pi);
  result.bound = std::min(result.bound, pi);
  // Another vector in place of up is another lift.
  drop_what_has_no_forces(hand, settings, small_angle, result.angle, result, up,
                          [&](std::size_t k, const Vector<Dim>& z) {
                            Load<Dim> load = grasp.loads()[k];
                            const double length = z.norm();
                            load.lift = length * (standard_gravity + load.lift) - standard_gravity;
                            return std::pair(load, length > 0 ? Vector<Dim>(z / length) : up);
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
