#include "space/oracle.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "dual/exact.hpp"
#include "dual/grip_ascent.hpp"
#include "dual/newton.hpp"
#include "dual/twist.hpp"
#include "hold/cone_hand.hpp"

namespace poise::search {
namespace {

/// So often a quick hold may turn out to be none before quick ones are believed no more: x is
/// beside what can be held.
constexpr int most_contradictions = 20;
/// y longer than this times the effort is no start for other loads.
constexpr double too_long = 1e4;
/// Twists that no contact feels, of length 1, do nothing where they move the weight by less than
/// no_motion; where they move it they are made so long that it is as good as infinite, beside an
/// effort of the force cap, too.
constexpr double no_motion = 1e-9, endless = 1e8, endless_of_cap = 1e20;
/// Where only single planes of postures hold, nothing has an inside, and the interior-point method
/// ends with fewer digits. What it found with errors up to these is held, as it is by hold().
constexpr double most_error = 1e-8, most_grip_error = 1e-6;
/// A longer y, about the object frame's origin [weights], rounds y . w.
constexpr double longest_y = 1e13;

/// Of a load that does not turn the normal is 0: its half-space is all of space, or nothing.
struct Direction {
  Vector<3> normal;
  double speed;
};
Direction direction(const Vector<3>& v) {
  const double speed = v.norm();
  if (speed > 1e-300) return {v / speed, speed};
  return {Vector<3>::Zero(), 1};
}

/// A grip in parts of the largest load's size: of next to nothing it is 0.
double squared_grip(double grip) {
  constexpr double nothing = 1e-12;
  return grip > nothing ? grip * grip : 0;
}

/// phi(G^T y), and what rounding of G^T y may hide of it: a cut must not be deeper than it is.
double phi_rounded_up(const dual::Point<3>& point, bool is_gauge) {
  double power = 0, squared = 0, contacts = 0;
  for (const dual::LaneForces<3, double>& lane : point.lanes) {
    Lane zf{}, ff{};
    for (int k = 0; k < contact_size<3>; ++k) {
      zf += lane.z[k] * lane.f[k];
      ff += lane.f[k] * lane.f[k];
    }
    power += sum(zf);
    squared += sum(ff);
    contacts += lane_size;
  }
  const double rounding = 1e-15 * std::sqrt(contacts) * dual::l1_norm(point.y);
  const double phi = is_gauge ? squared / 2 : power - squared / 2;
  return phi + rounding * (std::sqrt(squared) + rounding / 2);
}

/// Newton steps until what the dual may still gain is little beside what it adds to `proven`, a
/// bound on the effort. True where it then shows that w needs at least `least`; else `start` is
/// where to go on from.
bool needs_at_least(double least, double proven, const dual::Problem<3>& problem,
                    const Wrench<3>& w, Twist<3>& start, dual::Point<3>& point) {
  constexpr int most_steps = 6;
  const auto is_too_long = [&](const Twist<3>& y) {
    return !(dual::l1_norm(y) < too_long * (1 + proven));
  };
  if (is_too_long(start)) start = dual::cold_start(problem, w);
  dual::evaluate<3, double>(problem, w, Twist<3>(start), point);
  for (int step = 0; step < most_steps; ++step) {
    const dual::Square<3, double> M = dual::curvature<3, double>(problem, point);
    const Twist<3> dy = dual::newton_step(M, point.residual);
    const double gain = point.residual.dot(dy), before = point.value;
    start = point.y;
    if (!(dual::l1_norm(dy) < 3 * (1 + dual::l1_norm(start)))) return false;
    dual::evaluate<3, double>(problem, w, Twist<3>(start + dy), point);
    if (!(point.value >= before + 0.1 * gain) || is_too_long(point.y)) return false;
    start = point.y;
    const double missing = least - 2 * point.value;
    if (missing > 0) {
      if (gain < 1e-3 * missing) return false;  // it may be the best yet
      continue;
    }
    const double left = point.residual.dot(dual::newton_step(M, point.residual));
    if (left <= 0.1 * (2 * point.value - proven)) return true;
  }
  return false;
}

}  // namespace

ScaledLoad::ScaledLoad(const ScaledHand<3>& hand, const Load<3>& load, double largest,
                       double force_cap)
    : problem(hand, load.size(hand.length)),
      arm((load.com - hand.center) * hand.per_length),
      turning(load.turning() / problem.weight),
      still(scaled_wrench(hand, problem.weight, load.still())),
      size(problem.weight / largest),
      unit(size * size),
      cap(std::min(force_cap / size, 1e9)) {}  // the most that a hold takes

std::vector<ScaledLoad> scaled_loads(const Grasp<3>& grasp, const ScaledHand<3>& hand,
                                     double force_cap) {
  std::vector<ScaledLoad> loads;
  for (const Load<3>& load : grasp.loads())
    loads.emplace_back(hand, load, grasp.size(), force_cap);
  return loads;
}

const HalfSpace* nearest_held(const Vector<3>& x, const Corner& corner) {
  const HalfSpace* nearest = nullptr;
  for (const HalfSpace* each : corner)
    if (each != nullptr && each->origin == HalfSpace::Origin::held &&
        (nearest == nullptr || each->x.dot(x) > nearest->x.dot(x)))
      nearest = each;
  return nearest;
}

Oracle::Oracle(const Grasp<3>& grasp, const std::vector<ScaledLoad>& loads, Objective objective)
    : is_gauge(!loads.front().problem.limited),
      unit(grasp.size()),
      candidates(on_one_contact(grasp)),
      grasp_(grasp),
      loads_(loads),
      objective_(objective) {
  bool is_still = false;
  double cap = 0;
  for (const Contact<3>& contact : grasp.contacts()) shares_ += contact.share;
  for (std::size_t s = 0; s < loads.size(); ++s) {
    is_still = is_still || !loads[s].still.isZero(0);
    cap = std::max(cap, loads[s].cap * loads[s].size);
    if (loads[s].size == 1) largest_ = s;
  }
  is_gauge = scales = is_gauge && !is_still;
  most = cap * cap;
  if (is_grip() || grasp.is_general()) {
    is_gauge = false;
    for (const auto& drive : grasp.driven().drives)
      scales = scales && (is_grip() || !std::isfinite(drive.max));
    if (is_grip()) {
      unit = scaled_grip(grasp, grasp.size());
      const std::vector<Vector<3>> more = on_fixed_fingers(grasp);
      candidates.insert(candidates.end(), more.begin(), more.end());
    }
    if (is_grip()) most = std::min(most, std::pow(most_grip(grasp) / unit, 2));
    for (const Load<3>& load : grasp.loads())
      cones_.push_back(
          cone_hand(grasp, load.size(grasp.length()), is_grip() ? dual::Wanted::grip : dual::Wanted::effort));
  }
  // |f| >= W / sqrt(sum share), by y = t e_k, where forces add up to the weight.
  if (!is_still && !is_grip()) least = 1 / shares_;
  for (std::size_t s = 0; s < loads.size(); ++s)
    for (const Twist<3>& twist : loads[s].problem.hand.unfelt) {
      const Vector<3> v = loads[s].velocity(twist);
      if (!(v.norm() > no_motion)) continue;
      if (loads[s].still.isZero(0)) thin.push_back({v.normalized(), 0});
      const double most_length = is_gauge || is_grip() ? endless : endless_of_cap;
      for (const double length : {most_length, -most_length})
        unresisted.push_back(adopted({.load = s, .y = length * twist}));
    }
}

double Oracle::half_width(double t) const { return least > 0 ? std::sqrt(t * shares_) : infinity; }

/// Of one load by ascent; false where that leaves it open.
bool Oracle::quick_grip(std::size_t s, const Vector<3>& x, Answer& answer) const {
  const ScaledLoad& load = loads_[s];
  const Driven<3>& driven = grasp_.driven();
  if (!is_grip() || !driven.apart) return false;
  const Wrench<3> w = load.at(x);
  dual::Point<3> held(load.problem.size);
  dual::LeastGrip<3> found(load.problem.size);
  if (dual::approach(load.problem, w, dual::cold_start(load.problem, w), load.cap, held)) {
    if (!dual::least_grip(load.problem, driven, w, held, found)) return false;
  } else {
    found.y = held.y;
    if (!driven.alike || !dual::refute(load.problem, driven, w, load.cap, found)) return false;
  }
  HalfSpace& cut = answer.half_space = general_half_space(s, found.y, x);
  const double times = scaled_grip(grasp_, load.problem.weight) / unit;
  cut.rates.assign(found.rates.begin(), found.rates.end());
  for (const double rate : found.rates) cut.rate_sum += rate / times;
  cut.phi = found.fixed - found.y.dot(load.still);
  answer.value = squared_grip(found.value * times);
  return true;
}

Answer Oracle::general_answer(const Vector<3>& x, double target) {
  Answer worst{-1, {}};
  ++holds;
  for (std::size_t s = 0; s < loads_.size(); ++s) {
    Answer answer;
    if (!quick_grip(s, x, answer)) answer = answer_by_interior(s, x, target);
    const bool holdable = answer.value <= most;
    answer.half_space.origin = holdable ? HalfSpace::Origin::held : HalfSpace::Origin::unholdable;
    if (!holdable) answer.value = infinity;
    if (!(answer.value > worst.value)) continue;
    worst = std::move(answer);
    if (!holdable) break;
  }
  return worst;
}

/// Of one load, with y and the rates as they were found, made right where rounding made them wrong.
Answer Oracle::answer_by_interior(std::size_t s, const Vector<3>& x, double target) const {
  using State = dual::Balance<3>::State;
  const ScaledLoad& load = loads_[s];
  const dual::ConeHand<3>& cones = cones_[s];
  const dual::Balance<3> found =
      dual::balance(cones, load.at(x), is_grip() ? dual::Wanted::grip : dual::Wanted::effort);
  const bool is_held =
      found.state != State::not_held && found.error <= (is_grip() ? most_grip_error : most_error);
  HalfSpace cut = general_half_space(s, found.y, x);
  double value = infinity;
  if (is_grip()) {
    const dual::GripCut<3> proof = dual::grip_cut(cones, found, load.cap);
    const double times = scaled_grip(grasp_, load.problem.weight) / unit;
    cut = general_half_space(s, proof.y, x);
    cut.rates = proof.rates;
    cut.rate_sum = proof.rate_sum / times;  // F in the oracle's unit
    cut.phi = proof.fixed - proof.y.dot(load.still);
    if (is_held) value = squared_grip(found.value * times);
  } else {
    const double size = load.problem.weight;
    const auto& drives = grasp_.driven().drives;
    cut.rates.resize(drives.size());
    dual::Rates rates(drives.size());
    std::size_t limited = 0;
    for (std::size_t a = 0; a < drives.size(); ++a) {
      cut.rates[a] = 0;
      if (!std::isfinite(drives[a].max)) continue;
      const double per_length = drives[a].turns ? load.problem.hand.per_length : 1;
      cut.rates[a] = found.rates[limited++] * size * per_length;
    }
    const Wrench<3> none = Wrench<3>::Zero();
    const auto phi = [&](double times) {
      const Twist<3> y = about_origin(load.problem.hand, size, times * found.y);
      for (std::size_t a = 0; a < rates.size(); ++a) rates[a] = times * cut.rates[a];
      return -static_cast<double>(dual::effort_bound<3>(grasp_, none, y, rates, 1)) /
             (2 * size * size);
    };
    // Where nothing holds (y, rates) are a direction: as long as they cut deepest.
    double times = 1;
    if (!is_held) {
      const auto height = [&](double length) {
        return (phi(length) + target / (2 * load.unit)) / length;
      };
      double least = height(times);
      for (double longer = 1e2; longer < 1e25; longer *= 1e2)
        if (const double here = height(longer); here < least) {
          times = longer;
          least = here;
        }
    }
    cut.y *= times;
    cut.speed *= times;
    cut.phi = phi(times) - cut.y.dot(load.still);
    for (double& rate : cut.rates) rate *= times;
    if (is_held) value = 2 * found.value * load.unit;
  }
  return {value, cut};
}

HalfSpace Oracle::general_half_space(std::size_t load, const Twist<3>& y,
                                     const Vector<3>& x) const {
  const auto [normal, speed] = direction(loads_[load].velocity(y));
  return {.normal = normal, .x = x, .load = load, .y = y, .speed = speed};
}

Answer Oracle::evaluate(const Vector<3>& x, const Aim& aim) {
  if (!cones_.empty()) return general_answer(x, aim.target);
  using Origin = HalfSpace::Origin;
  Answer worst{-1, {}};
  ++holds;
  for (std::size_t s = 0; s < loads_.size(); ++s) {
    const ScaledLoad& load = loads_[s];
    const Wrench<3> w = load.at(x);
    dual::Point<3> point(load.problem.size);
    const bool is_near = aim.start != nullptr && aim.start->load == s;
    Twist<3> start = is_near ? aim.start->y : dual::cold_start(load.problem, w);
    if (aim.proven > 0 &&
        needs_at_least(aim.best / load.unit, aim.proven / load.unit, load.problem, w, start, point))
      return {2 * load.unit * point.value, half_space(point, s, x, Origin::held)};
    const double value = effort(load, w, start, aim, point);
    const bool holdable = value < infinity;
    if (!(value > worst.value)) continue;
    if (!holdable && !is_gauge) deepen(load, w, aim.target, point);
    worst = {value, half_space(point, s, x, holdable ? Origin::held : Origin::unholdable)};
    if (!holdable) break;
  }
  return worst;
}

/// Of one load; infinite where unholdable.
double Oracle::effort(const ScaledLoad& load, const Wrench<3>& w, const Twist<3>& start,
                      const Aim& aim, dual::Point<3>& point) {
  const auto effort_here = [&] { return load.unit * dual::squared_norm(point); };
  if (aim.digits == Digits::all)
    return dual::maximise<3>(load.problem, w, start, load.cap, point) ? effort_here() : infinity;
  if (!dual::approach(load.problem, w, start, load.cap, point)) return infinity;
  const double quick = effort_here();
  if (aim.digits == Digits::rough || !(quick < aim.improvement)) return quick;
  if (contradicted_ > most_contradictions) return infinity;
  if (!(point.residual.cwiseAbs().maxCoeff() > 0.5 * dual::delta)) return quick;
  const dual::Point<3> rough = point;
  if (!dual::maximise<3>(load.problem, w, Twist<3>(point.y), load.cap, point)) {
    ++contradicted_;
    return infinity;
  }
  const double exact = effort_here();
  // Rounding of a load may ask for a very long y, of no use for other loads.
  if (dual::l1_norm(point.y) > 1e3 * dual::l1_norm(rough.y)) point = rough;
  return exact;
}

/// Where nothing holds, y is a direction: farther along it may cut deeper, and so may less far
/// where y is so long that its rounding counts.
void Oracle::deepen(const ScaledLoad& load, const Wrench<3>& w, double t,
                    dual::Point<3>& point) const {
  const double half = t / (2 * load.unit);
  const auto depth = [&] {
    return (point.y.dot(w) - phi_rounded_up(point, false) - half) / point.y.cwiseAbs().sum();
  };
  const Twist<3> found = point.y;
  Twist<3> deepest_y = found;
  double deepest = depth();
  for (double times = 1e3; times > 1e-13; times *= 1e-3) {
    dual::evaluate<3, double>(load.problem, w, Twist<3>(times * found), point);
    if (const double here = depth(); here > deepest) {
      deepest_y = point.y;
      deepest = here;
    }
  }
  dual::evaluate<3, double>(load.problem, w, deepest_y, point);
}

HalfSpace Oracle::half_space(const dual::Point<3>& point, std::size_t load, const Vector<3>& x,
                             HalfSpace::Origin origin) const {
  const auto [normal, speed] = direction(loads_[load].velocity(point.y));
  const double phi = phi_rounded_up(point, is_gauge) - point.y.dot(loads_[load].still);
  return {origin, normal, x, load, point.y, speed, phi};
}

/// Where the root of the effort is a gauge y may be as long as is best for a cut; not so long that
/// rounding would count, also where y is told about an origin far from the center.
double Oracle::stretch(const HalfSpace& half_space, double half) const {
  if (!is_gauge) return 1;
  const ScaledHand<3>& hand = loads_[half_space.load].problem.hand;
  const double arm = 1 + hand.center.norm() * hand.per_length;
  return std::sqrt(half) *
         std::min(1 / std::sqrt(half_space.phi), longest_y / (arm * half_space.y.norm()));
}

double Oracle::offset(const HalfSpace& half_space, double t) const {
  if (half_space.origin == HalfSpace::Origin::domain) return 0;
  if (is_grip()) {
    const double rounding = (dual::delta + 1e-15) * dual::dual_norm<3, double>(half_space.y);
    return (half_space.rate_sum * std::sqrt(t) + half_space.phi + rounding) / half_space.speed;
  }
  const double half = t / (2 * loads_[half_space.load].unit);
  const double times = stretch(half_space, half);
  const double rounding = (dual::delta + 1e-15) * dual::dual_norm<3, double>(half_space.y);
  return (half / times + times * half_space.phi + rounding) / half_space.speed;
}

double Oracle::value_proven(const HalfSpace& half_space, double along) const {
  if (half_space.origin == HalfSpace::Origin::domain) return along > 0 ? infinity : 0;
  const double rounding = (dual::delta + 1e-15) * dual::dual_norm<3, double>(half_space.y);
  const double power = half_space.speed * along - rounding;
  double value = 0;
  if (is_grip()) {
    if (power > half_space.phi) value = std::pow((power - half_space.phi) / half_space.rate_sum, 2);
  } else {
    const double unit = loads_[half_space.load].unit;
    if (!is_gauge)
      value = 2 * unit * (power - half_space.phi);
    else if (power > 0)  // y may be as long as stretch() makes it
      value = unit * power * power / (2 * half_space.phi);
  }
  return value > most ? infinity : std::max(value, 0.0);
}

HalfSpace Oracle::adopted(const HalfSpace& known) const {
  if (known.origin == HalfSpace::Origin::domain) return known;
  if (!cones_.empty()) return general_half_space(known.load, known.y, known.x);  // felt by none
  const dual::Problem<3>& problem = loads_[known.load].problem;
  dual::Point<3> point(problem.size);
  dual::evaluate<3, double>(problem, Wrench<3>::Zero(), known.y, point);
  return half_space(point, known.load, known.x, known.origin);
}

/// Between the y of its three planes, for while no contact changes its face y is linear; else that
/// of the nearest.
std::optional<HalfSpace> Oracle::start_at(const Vector<3>& x, const Corner& corner) const {
  const HalfSpace* nearest = nearest_held(x, corner);
  if (nearest == nullptr) return {};
  HalfSpace start = *nearest;
  Eigen::Matrix3d at;
  for (int k = 0; k < 3; ++k) {
    const HalfSpace* each = corner[static_cast<std::size_t>(k)];
    if (each == nullptr || each->origin != HalfSpace::Origin::held || each->load != start.load)
      return start;
    at.col(k) = each->x;
  }
  const Vector<3> part = at.inverse() * x.normalized();
  if (!(part.minCoeff() > -0.5) || !(part.maxCoeff() < 2)) return start;
  start.y.setZero();
  for (int k = 0; k < 3; ++k) start.y += part[k] * corner[static_cast<std::size_t>(k)]->y;
  return start;
}

Cut Oracle::cut_by(std::size_t load, const Twist<3>& y) const {
  const dual::Problem<3>& problem = loads_[load].problem;
  return {.y = about_origin(problem.hand, problem.weight, y), .load = load};
}

Cut Oracle::cut(const HalfSpace& half_space, double t) const {
  if (half_space.origin == HalfSpace::Origin::domain) return {.n = half_space.normal};
  if (is_grip()) {
    // Of length 1 in its rates, or where there are none in y.
    const ScaledLoad& load = loads_[half_space.load];
    const double times = scaled_grip(grasp_, load.problem.weight) / unit;
    const double sum = half_space.rate_sum * times;
    const double size = half_space.y.cwiseAbs().maxCoeff(), per = sum > 1e-9 * size ? sum : size;
    Cut cut{.y = about_origin(load.problem.hand,
                              scaled_grip(grasp_, load.problem.weight) / load.problem.weight / per,
                              half_space.y),
            .load = half_space.load,
            .rates = half_space.rates};
    for (double& rate : *cut.rates) rate /= per;
    return cut;
  }
  if (!cones_.empty()) {
    Cut cut = cut_by(half_space.load, half_space.y);
    cut.rates = half_space.rates;
    return cut;
  }
  const double half = t / (2 * loads_[half_space.load].unit);
  return cut_by(half_space.load, stretch(half_space, half) * half_space.y);
}

Cut Oracle::side_of_cube(int side, double t) const {
  Twist<3> y = Twist<3>::Zero();
  y[side / 2] = (side % 2 == 0 ? 1 : -1) * std::sqrt(t / shares_);
  return cut_by(largest_, y);
}

}  // namespace poise::search
