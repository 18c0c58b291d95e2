// How the dual of holding is maximised, in any dimension and numbers of any type. Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "dual/evaluate.hpp"
#include "dual/newton.hpp"
#include "dual/polish.hpp"
#include "dual/proof.hpp"

namespace poise::dual {

/// Whether the ascent ends with all digits of the forces, or as soon as they balance but for the
/// rounding of z.
enum class Digits { rough, polished };

/// What an ascent aims at. With a pull rho > 0 it maximises value − ½ rho |y|² instead, whose y is
/// bounded: (w − G f) / rho.
struct Aim {
  double force_cap{std::numeric_limits<double>::infinity()};
  double pull{0};
  Digits digits{Digits::polished};
};

/// Newton's method with a search along the step. As maximise(), with a y of its own in the
/// unholdable case: any that proves it.
template <int Dim, class T>
class Ascent {
 public:
  Ascent(const Cones<Dim, T>& cones, const Screw<Dim, T>& w, const Aim& aim, Point<Dim, T>& point)
      : cones_(cones),
        w_(w),
        aim_(aim),
        unholdable_(aim.force_cap * aim.force_cap),
        point_(point) {}

  bool run(const Screw<Dim, T>& start) {
    evaluate_at(start);
    for (int step = 0; step < most_steps; ++step) {
      const State state = state_here();
      if (state != State::rising) return state == State::held;
      if (!advance((step < 4 ? 3 : 100) * (1 + distance_))) return false;
    }
    return primal_norm<Dim, T>(point_.residual) <= 0.5 * delta;
  }

 private:
  enum class State { rising, held, not_held };

  static constexpr int most_steps = 100;
  static constexpr bool in_doubles = std::is_same_v<T, double>;
  static constexpr double rounding = rounding_of<T>;

  /// A step from y along dy.
  struct Line {
    Screw<Dim, T> y, dy;
    T value, slope;  ///< at y
  };

  void evaluate_at(const Screw<Dim, T>& y) {
    evaluate<Dim, T>(cones_, w_, y, point_);
    if (aim_.pull == 0) return;
    point_.value -= aim_.pull / 2 * y.squaredNorm();
    point_.residual -= T(aim_.pull) * y;
  }

  Square<Dim, T> curvature_here() const {
    Square<Dim, T> M = curvature<Dim, T>(cones_, point_);
    if (aim_.pull > 0) M.diagonal().array() += T(aim_.pull);
    return M;
  }

  bool above_cap() const {
    return 2 * point_.value > unholdable_ && lower_bound(point_) > unholdable_;
  }

  State state_here() {
    [[maybe_unused]] const T last_error = error_;
    error_ = point_.residual.cwiseAbs().maxCoeff();
    distance_ = l1_norm(point_.y);
    if (above_cap() || !(distance_ < longest)) return State::not_held;
    if (aim_.pull > 0 || !in_doubles) {
      if (!(error_ <= 4500 * rounding + 45 * rounding * distance_)) return State::rising;
      const bool balanced = aim_.pull > 0 || primal_norm<Dim, T>(point_.residual) <= 0.5 * delta;
      return balanced ? State::held : State::not_held;
    }
    if constexpr (in_doubles) {
      using Now = Schedule<Dim>;
      if (error_ <= Now::balance &&
          std::abs(point_.y.dot(point_.residual)) <= Now::gap * std::abs(point_.value))
        return State::held;
      const bool stalled = !Now::waits_for_stall || error_ > 0.1 * last_error;
      if (((settled_ && stalled) || error_ <= delta / 2 + 1e-14 * distance_) &&
          (aim_.digits == Digits::rough || polish<Dim>(cones_, w_, point_)))
        return above_cap() ? State::not_held : State::held;
      if (unbounded_ && error_ <= 0.5 * delta) return State::held;
    }
    return State::rising;
  }

  /// One step, of a length up to `reach` or little more. False where it ends with a proof that
  /// nothing holds.
  bool advance(const T& reach) {
    using std::abs;
    Square<Dim, T> M = curvature_here();
    // Where steps are cut short again and again, the next heeds the faces passed before: else it
    // zigzags between them near the limit of holding.
    if (cuts_ > 1) M += T(0.5) * passed_;
    Line line{point_.y, newton_step(M, point_.residual), point_.value, 0};
    const T stretch = l1_norm(line.dy);
    if (stretch > reach) {
      M.diagonal().array() += point_.residual.norm() / reach;
      line.dy = newton_step(M, point_.residual);
    }
    line.slope = point_.residual.dot(line.dy);
    if constexpr (!in_doubles)
      if (rises_around_a_bend(line)) return true;
    evaluate_at(line.y + line.dy);
    T slope = point_.residual.dot(line.dy);
    // The full step will do if it rises as it should, or by less than rounding shows.
    const bool cut = !(point_.value - line.value >= 0.1 * line.slope) &&
                     line.slope > 4 * rounding * abs(line.value) && stop_within(line, slope);
    settled_ = !cut && abs(slope) <= 1e-6 * line.slope;
    // Still rising where every step is long: does it rise for ever?
    if (aim_.pull == 0 && stretch > reach && slope > 0.5 * line.slope && proves_along(line.dy))
      return false;
    cuts_ = cut ? cuts_ + 1 : 0;
    if (cuts_ > 1) passed_ = M;
    return true;
  }

  /// Goes back to where the slope along the line vanishes, or where half of it may be left on a way
  /// that rises: it falls all along, in the plane piecewise linearly. Starts at the line's end, of
  /// which it is told the slope. Whether it cuts the step short.
  bool stop_within(const Line& line, T& slope) {
    using std::abs;
    T least = 0, most = 1, part = 1;
    for (int trial = 1; trial < 60; ++trial) {
      if (abs(slope) <= Schedule<Dim>::flat * line.slope ||
          (Schedule<Dim>::half_is_enough && abs(slope) <= 0.5 * line.slope &&
           point_.value > line.value) ||
          most - least <= 4.5 * rounding * most)
        break;
      (slope > 0 ? least : most) = part;
      part += slope / quadratic(curvature_here(), line.dy);
      if (!(part > least && part < most)) part = (least + most) / 2;
      evaluate_at(line.y + part * line.dy);
      slope = point_.residual.dot(line.dy);
    }
    return part < 1;
  }

  /// Near the apex of a round cone the way up is bent: a part of the step, and a correction across
  /// it.
  bool rises_around_a_bend(const Line& line) {
    for (T part = 1; part > 1e-3; part *= 0.25) {
      const T enough = line.value + 0.1 * part * line.slope;
      evaluate_at(line.y + part * line.dy);
      for (int k = 0; k < 2 && point_.value < enough; ++k) {
        Square<Dim, T> across = curvature_here();
        across.diagonal().array() += 30 * line.slope / line.dy.squaredNorm();
        evaluate_at(point_.y + newton_step(across, point_.residual));
      }
      if (point_.value >= enough) return true;
    }
    return false;
  }

  bool proves_along(const Screw<Dim, T>& dy) {
    Point<Dim, T> far = point_;
    const Screw<Dim, T> direction = dy / dual_norm<Dim, T>(dy);
    const Rise rise = prove<Dim, T>(cones_, w_, point_.y, direction, aim_.force_cap, far);
    if (rise == Rise::proof) point_ = far;
    unbounded_ = rise == Rise::none;
    return rise == Rise::proof;
  }

  const Cones<Dim, T>& cones_;
  const Screw<Dim, T>& w_;
  const Aim& aim_;
  double unholdable_;  ///< an effort that is
  Point<Dim, T>& point_;
  T error_{std::numeric_limits<double>::infinity()}, distance_{0};
  bool settled_{false}, unbounded_{false};
  int cuts_{0};  ///< steps in a row that changing faces cut short
  Square<Dim, T> passed_;
};

/// In doubles with the SIMD instructions that this machine has.
template <int Dim, class T>
bool ascend(const Cones<Dim, T>& cones, const Screw<Dim, T>& w, const Screw<Dim, T>& start,
            const Aim& aim, Point<Dim, T>& point) {
  const auto run = [&] { return Ascent<Dim, T>(cones, w, aim, point).run(start); };
  if constexpr (std::is_same_v<T, double>)
    return with_simd(run);
  else
    return run();
}

}  // namespace poise::dual
