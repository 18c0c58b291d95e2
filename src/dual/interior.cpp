#include "dual/interior.hpp"

#include <algorithm>
#include <cmath>

#include "dual/interior_system.hpp"

namespace poise::dual {
namespace interior {
namespace {

constexpr int most_steps = 80;
/// Of the balance in the load, of the rates in y, of the gap in the value: what is asked for, what
/// is enough where rounding ends the way, and from where on it is over as soon as a step makes it
/// no better. Before, so many steps may.
constexpr double wanted_error = 1e-13, enough = 1e-10, good = 1e-10;
constexpr int patience = 8;
/// A value [units of the hand] that is as good as 0.
constexpr double no_value = 1e-6;
/// What y may leave of a proof that nothing holds, and how far tau is behind kappa then.
constexpr double certain = 1e-12, far = 1e-6;
/// Of the way to the border of the cones; and steps so short that they lead nowhere.
constexpr double most_of_the_way = 0.99, shortest_step = 1e-7;
/// What may be missing of a step's balance, of the load.
constexpr double small_residual = 1e-14;
constexpr int most_refinements = 4;

}  // namespace

/// At the border.
template <int Dim, class T>
void Interior<Dim, T>::aim() {
  for (Part& part : parts_) part.cone.aim();
  for_each_ray([](Ray<T>& ray) { ray.aim(); });
}

/// At products of s and u that are `center`, with so much of the last step's second order.
template <int Dim, class T>
void Interior<Dim, T>::aim(const T& center, const T& second) {
  for (Part& part : parts_) part.cone.aim(center, second);
  for_each_ray([&](Ray<T>& ray) { ray.aim(center, second); });
}

/// `aim_of_tau`: of kappa dtau + tau dkappa.
template <int Dim, class T>
void Interior<Dim, T>::step(const T& damping, const T& aim_of_tau, bool is_last) {
  solve(step_, damping, false);
  const T gap = step_.gap + damping * gap_residual_;
  dtau_ = (aim_of_tau - tau_ * gap) / (kappa_ + tau_ * growing_.gap + square_ / tau_);
  dkappa_ = (aim_of_tau - kappa_ * dtau_) / tau_;
  step_.x += dtau_ * growing_.x;
  for (std::size_t i = 0; i < bodies_.size(); ++i) step_.N[i] += dtau_ * growing_.N[i];
  for (std::size_t k = 0; k < parts_.size(); ++k) step_.t[k] += dtau_ * growing_.t[k];
  for (int round = 0; is_last && round < most_refinements; ++round)
    if (!(refine(damping) > small_residual * (tau_ + primal_error_))) break;

  const Screw dy = y_of(step_.x);
  const auto rate = [&](std::size_t a) -> const T& {
    return step_.x[static_cast<Eigen::Index>(a)];
  };
  std::size_t finger = hand_.fingers;
  Screw felt = dy;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (body.finger != finger) felt = felt_by(finger = body.finger, dy, rate);
    const T& N = step_.N[i];
    if (body.has_lo) body.lo.step(N - body.least * dtau_);
    if (body.has_hi) body.hi.step(body.most * dtau_ - N);
    for (std::size_t k = body.first; k < body.last; ++k) {
      Part& part = parts_[k];
      const Tail& t = step_.t[k];
      part.cone.step({part.reach * N, t},
                     part.weight * t - part.G.transpose() * felt - damping * part.residual);
    }
  }
  // The rates are unknowns; their s follow.
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    Ray<T>& ray = drives_[a].ray;
    ray.du = rate(a);
    ray.ds = ray.d - ray.du / ray.curvature();
  }
  if (for_grip_) F_.step(step_.x[step_.x.size() - 1]);
}

template <int Dim, class T>
T Interior<Dim, T>::way() {
  T way = infinity;
  if (dtau_ < 0) way = std::min<T>(way, -tau_ / dtau_);
  if (dkappa_ < 0) way = std::min<T>(way, -kappa_ / dkappa_);
  for (const Part& part : parts_) way = std::min<T>(way, part.cone.way());
  for_each_ray([&](const Ray<T>& ray) { way = std::min<T>(way, ray.way()); });
  return way;
}

template <int Dim, class T>
void Interior<Dim, T>::go(const T& length) {
  y_ += length * y_of(step_.x);
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].N += length * step_.N[i];
  for (Part& part : parts_) part.cone.go(length);
  for_each_ray([&](Ray<T>& ray) { ray.go(length); });
  tau_ += length * dtau_;
  kappa_ += length * dkappa_;
}

template <int Dim, class T>
T Interior<Dim, T>::center() {
  T sum = tau_ * kappa_;
  for (const Part& part : parts_) sum += part.cone.product();
  for_each_ray([&](const Ray<T>& ray) { sum += ray.product(); });
  return sum / degree_;
}

template <int Dim, class T>
void Interior<Dim, T>::keep(Found& best) const {
  const auto plain = [&](const T& number) { return static_cast<double>(number / tau_); };
  best.value = for_grip_ ? plain(F_.s) : plain(square_ / (2 * tau_));
  best.y = (y_ / tau_).template cast<double>();
  best.residual = (balance_residual_ / tau_).template cast<double>();
  best.rates.clear();
  best.normals.clear();
  best.tangentials.clear();
  for (const Drive& drive : drives_) best.rates.push_back(plain(drive.ray.u));
  for (const Body& body : bodies_) best.normals.push_back(plain(body.N));
  for (const Part& part : parts_)
    best.tangentials.push_back((part.cone.s.tail / tau_).template cast<double>());
}

template <int Dim, class T>
Balance<Dim> Interior<Dim, T>::run() {
  using std::abs;
  Found best{};
  best.error = infinity;
  keep(best);  // where numbers overflow at once there is something to tell, too
  int last_better = 0;
  for (best.steps = 0;; ++best.steps) {
    find_residuals();
    const T value = for_grip_ ? F_.s : T(square_ / (2 * tau_));
    const T proven = for_grip_ ? dual_ : T(dual_ - square_ / (2 * tau_));
    const T gap = abs(value - proven) / std::max<T>({value, abs(proven), tau_ * no_value});
    const T size_y = y_.cwiseAbs().maxCoeff() + tau_;
    const auto error =
        static_cast<double>(std::max<T>({T(primal_error_ / tau_), T(dual_error_ / size_y), gap}));
    if (error < best.error) {
      best.error = error;
      last_better = best.steps;
      keep(best);
    }
    if (!(error > wanted_error) || !(error < infinity)) break;
    // On the way to a proof that nothing holds tau vanishes, and errors tell nothing.
    const int most_waits = best.error <= good ? 0 : patience;
    if (tau_ > kappa_ && best.steps > last_better + most_waits) break;
    if (best.error > enough && dual_ > 0 && dual_error_ + square_ <= certain * dual_ &&
        tau_ < far * kappa_) {
      best.state = Found::State::not_held;
      best.y = (y_ / dual_).template cast<double>();
      for (std::size_t a = 0; a < drives_.size(); ++a)
        best.rates[a] = static_cast<double>(drives_[a].ray.u / dual_);
      return best;
    }
    const T here = center();
    if (best.steps == most_steps || !(here > 1e-300)) break;

    factorise();
    aim();
    solve(growing_, 1, true);
    step(1, -tau_ * kappa_, false);
    const T affine = std::min<T>(1, way()), left = 1 - affine, sigma = left * left * left;
    // Of a short way's second order only its part: else steps to and fro may never end.
    const T second = std::min<T>(1, 2 * affine);
    const T target = sigma * here, corrected = target - tau_ * kappa_ - second * dtau_ * dkappa_;
    aim(target, second);
    step(1 - sigma, corrected, true);
    const T length = std::min<T>(1, most_of_the_way * way());
    if (!(length > shortest_step)) break;
    go(length);
  }
  best.state = best.error <= enough ? Found::State::held : Found::State::open;
  if (best.error < infinity) settle(best);
  return best;
}

/// What rounding left of the balance, by the smallest change of forces; then back into the cones.
template <int Dim, class T>
void Interior<Dim, T>::settle(Found& best) const {
  Factors<double> factors(rows);
  factors.matrix().setZero();
  for (const ConeContact<Dim>& contact : hand_.contacts)
    factors.matrix() += contact.normal * contact.normal.transpose();
  for (const ConePart<Dim>& part : hand_.parts) factors.matrix() += part.G * part.G.transpose();
  factors.factorise(rows);
  typename Factors<double>::Column y = best.residual;
  factors.solve(y);
  Twist<Dim> change = y;
  // What no force feels is left.
  if (!(change.norm() <= 1e3 * best.residual.norm())) change.setZero();
  best.residual = w_.template cast<double>();
  for (std::size_t i = 0; i < hand_.contacts.size(); ++i) {
    const ConeContact<Dim>& contact = hand_.contacts[i];
    double& N = best.normals[i];
    N = std::clamp(N + contact.normal.dot(change), contact.lo, contact.hi);
    best.residual -= N * contact.normal;
    for (std::size_t k = contact.first; k < contact.last; ++k) {
      PartForce<Dim>& t = best.tangentials[k];
      t += hand_.parts[k].G.transpose() * change;
      const double most = hand_.parts[k].reach * N, length = t.norm();
      if (length > most) t *= most / length;
      best.residual -= hand_.parts[k].G * t;
    }
  }
}

}  // namespace interior

template <int Dim>
Balance<Dim> quick_balance(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted) {
  return interior::Interior<Dim, double>(hand, w, wanted).run();
}

template <int Dim>
Balance<Dim> balance(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted) {
  const Balance<Dim> found = quick_balance(hand, w, wanted);
  if (found.state != Balance<Dim>::State::open) return found;
#ifdef __wasm__
  return found;  // the page with the core in it is loaded from the web: digits are not worth its
                 // size
#else
  // Of a load that is held but for its own rounding they make out that it is not.
  const Balance<Dim> wide = interior::Interior<Dim, Wide>(hand, w, wanted).run();
  const bool is_better = wide.state != Balance<Dim>::State::open || wide.error < found.error;
  return is_better ? wide : found;
#endif
}

/// The greatest power per newton of each contact, with what rounding may make of it.
template <int Dim>
std::vector<double> powers(const ConeHand<Dim>& hand, const Twist<Dim>& y,
                           const std::vector<double>& rates) {
  std::vector<Twist<Dim>> felt(hand.fingers, y);
  double size = y.cwiseAbs().sum();
  for (std::size_t a = 0; a < hand.drives.size(); ++a)
    for (const auto& moved : hand.drives[a].moved) {
      felt[moved.finger] -= rates[a] * moved.twist;
      size += rates[a] * moved.twist.cwiseAbs().sum();
    }
  std::vector<double> result;
  for (const ConeContact<Dim>& contact : hand.contacts) {
    const Twist<Dim>& twist = felt[contact.finger];
    double power = contact.normal.dot(twist), steep = 1;
    for (std::size_t k = contact.first; k < contact.last; ++k) {
      power += hand.parts[k].reach * (hand.parts[k].G.transpose() * twist).norm();
      steep += hand.parts[k].reach;
    }
    result.push_back(power + interior::rounding<double> * steep * size);
  }
  return result;
}

/// Where rates have no part in it, as of fingers that stand still: a motion of the object off these,
/// mixed in, with rates that keep the others from doing anything.
template <int Dim>
void lift_off(const ConeHand<Dim>& hand, double size, std::vector<double>& power,
              GripCut<Dim>& cut) {
  const auto is_endless = [&](std::size_t i) {
    return power[i] > 0 && hand.contacts[i].hi == interior::infinity;
  };
  Vector<Dim> off = Vector<Dim>::Zero();
  for (std::size_t i = 0; i < power.size(); ++i)
    if (is_endless(i)) off -= hand.contacts[i].normal.template head<Dim>();
  if (!(off.norm() > 1e-3)) return;
  Twist<Dim> motion = Twist<Dim>::Zero();
  motion.template head<Dim>() = size * off.normalized();
  const std::vector<double> rates(hand.drives.size(), 2 * size);
  const std::vector<double> freed = powers(hand, motion, rates);
  double part = 0;
  for (std::size_t i = 0; i < power.size(); ++i)
    if (is_endless(i))
      part = std::max(part, freed[i] < 0 ? 1.01 * power[i] / -freed[i] : interior::infinity);
  if (!(part > 0) || !(part < 1e-6)) return;
  cut.y += part * motion;
  for (std::size_t a = 0; a < cut.rates.size(); ++a) cut.rates[a] += part * rates[a];
  power = powers(hand, cut.y, cut.rates);
}

template <int Dim>
GripCut<Dim> grip_cut(const ConeHand<Dim>& hand, const Balance<Dim>& found, double force_norm) {
  GripCut<Dim> cut{found.y, found.rates, 0, 0};
  if (found.state == Balance<Dim>::State::not_held)
    std::fill(cut.rates.begin(), cut.rates.end(), 0.0);
  std::vector<double> power = powers(hand, cut.y, cut.rates);
  // Power is convex in (y, rates): rates alone, mixed in, take from it what they leave below 0.
  double size = std::max(cut.y.cwiseAbs().maxCoeff(), 1e-300);
  for (const double rate : cut.rates) size = std::max(size, rate);
  const std::vector<double> alone(hand.drives.size(),
                                  size / static_cast<double>(hand.drives.size()));
  const std::vector<double> shut = powers(hand, Twist<Dim>(Twist<Dim>::Zero()), alone);
  double part = 0;
  for (std::size_t i = 0; i < power.size(); ++i)
    if (power[i] > 0 && hand.contacts[i].hi == interior::infinity && shut[i] < 0)
      part = std::max(part, 1.01 * power[i] / -shut[i]);
  if (part > 0 && part < 1e-3) {
    for (std::size_t a = 0; a < cut.rates.size(); ++a) cut.rates[a] += part * alone[a];
    power = powers(hand, cut.y, cut.rates);
  }
  lift_off(hand, size, power, cut);
  for (const double rate : cut.rates) cut.rate_sum += rate;
  for (std::size_t i = 0; i < power.size(); ++i) {
    const ConeContact<Dim>& contact = hand.contacts[i];
    cut.fixed += power[i] * (power[i] <= 0 ? contact.lo : std::min(contact.hi, force_norm));
  }
  return cut;
}

template GripCut<2> grip_cut(const ConeHand<2>&, const Balance<2>&, double);
template GripCut<3> grip_cut(const ConeHand<3>&, const Balance<3>&, double);
template Balance<2> quick_balance(const ConeHand<2>&, const Wrench<2>&, Wanted);
template Balance<3> quick_balance(const ConeHand<3>&, const Wrench<3>&, Wanted);
template Balance<2> balance(const ConeHand<2>&, const Wrench<2>&, Wanted);
template Balance<3> balance(const ConeHand<3>&, const Wrench<3>&, Wanted);

}  // namespace poise::dual
