#include "shake/supply.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dual/exact.hpp"
#include "dual/twist.hpp"
#include "hold/solve.hpp"

namespace poise {
namespace {

using dual::Exact;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of forces that are as good as balanced, and of a part as good as proven.
constexpr double most_error = 1e-8;

/// The most that forces do against z: what limits leave, and of contacts without one up to a force
/// norm. Equation (8) of docs/theory.md.
template <int Dim>
Exact most_power(const Hand<Dim>& hand, const Twist<Dim>& y, const dual::Rates& rates,
                 double force_norm) {
  Exact sum = 0, squares = 0;
  for (std::size_t a = 0; a < rates.size(); ++a)
    if (rates[a] > 0) sum += Exact{rates[a]} * hand.driven().drives[a].max;
  const auto felt = dual::against_fingers(hand, y, rates, false);
  for (std::size_t i = 0; i < hand.contacts().size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    const Twist<Dim>& z = felt[hand.finger_of(i)];
    const Exact along = dual::power(contact, z);
    if (std::isfinite(contact.max_normal)) {
      sum += along * (along > 0 ? contact.max_normal : contact.min_normal);
      continue;
    }
    sum += along * contact.min_normal;
    if (along <= 0) continue;
    Contact<Dim> whole = contact;
    whole.min_normal = 0;
    squares += 2 * std::max<Exact>(dual::phi(whole, z, 1), 0);
  }
  return sum + std::sqrt(squares) * force_norm;
}

}  // namespace

template <int Dim>
Supply<Dim>::Supply(const Hand<Dim>& hand, const Load<Dim>& load, double force_cap)
    : hand_(hand),
      load_(load),
      cap_(force_cap),
      unit_(load.size(hand.length())),
      still_(load.still()),
      drives_(hand.drives()) {
  if (!(unit_ > 0)) unit_ = 1;
  bool limited = false, pressed = false;
  for (const Drive<Dim>& drive : drives_) limited = limited || std::isfinite(drive.max);
  for (const Contact<Dim>& contact : hand.contacts()) {
    limited = limited || std::isfinite(contact.max_normal);
    pressed = pressed || contact.min_normal > 0;
  }
  if (limited) parts_ = part_hand(hand, 1, unit_);
  is_gauge_ = !pressed && still_.isZero(0);
}

template <int Dim>
Wrench<Dim> Supply<Dim>::wrench(const Vector<Dim>& z) const {
  return still_ + wrench_of<Dim>(load_.weight / standard_gravity * z, load_.com);
}

template <int Dim>
typename Supply<Dim>::Answer Supply<Dim>::ask(const Vector<Dim>& z) const {
  if (parts_) {
    Answer answer = ask_limits(wrench(z));
    if (answer.part < infinity || answer.cut->n.dot(z) > answer.cut->b) return answer;
  }
  return ask_hold(wrench(z));  // where nothing is limited, or that is not what decides
}

template <int Dim>
typename Supply<Dim>::Answer Supply<Dim>::ask_limits(const Wrench<Dim>& w) const {
  using State = typename dual::Balance<Dim>::State;
  const ScaledHand<Dim>& scaled = hand_.scaled();
  const Wrench<Dim> load = scaled_wrench(scaled, unit_, w);
  dual::Balance<Dim> found = dual::quick_balance(parts_->cones, load, dual::Wanted::grip);
  if (found.state == State::open && !(found.error <= most_error))
    found = dual::balance(parts_->cones, load, dual::Wanted::grip);
  const bool is_held = found.state != State::not_held && found.error <= most_error;
  const dual::GripCut<Dim> proof = dual::grip_cut(parts_->cones, found, cap_);
  dual::Rates rates;
  rates.resize(drives_.size());
  for (std::size_t a = 0, limited = 0; a < drives_.size(); ++a)
    rates[a] =
        std::isfinite(drives_[a].max) ? proof.rates[limited++] * parts_->unit / drives_[a].max : 0;
  return {is_held ? found.value / parts_->unit : infinity,
          cut_by(about_origin(scaled, 1 / unit_, proof.y), std::move(rates))};
}

template <int Dim>
typename Supply<Dim>::Answer Supply<Dim>::ask_hold(const Wrench<Dim>& w) const {
  const Hold<Dim> hold =
      poise::hold<Dim>(hand_, w, unit_, Twist<Dim>(Twist<Dim>::Zero()), {.force_cap = cap_});
  if (hold.holdable) return {parts_ ? 1.0 : 0.0, {}};
  return {infinity, cut_by(hold.dual, hold.rates)};
}

template <int Dim>
SupplyCut<Dim> Supply<Dim>::cut_by(const Twist<Dim>& y, SmallVector<double, 4> rates) const {
  using dual::velocity;
  SupplyCut<Dim> cut;
  const double size = y.cwiseAbs().maxCoeff();
  if (!(size > 0)) return cut;
  cut.y = y / size;
  for (double& rate : rates) rate /= size;
  cut.rates = std::move(rates);
  const Eigen::Matrix<Exact, Dim, 1> v = velocity<Dim>(cut.y, load_.com);
  const Exact omega = cut.y.template tail<wrench_size<Dim> - Dim>().norm();
  const Exact arm = hand_.radius() + (load_.com - hand_.center()).norm();
  const Exact most = most_power(hand_, cut.y, cut.rates, cap_ * unit_) -
                     cut.y.template cast<Exact>().dot(still_.template cast<Exact>()) +
                     dual::delta * unit_ * (v.norm() + arm * omega);
  const Exact speed = v.norm() * load_.weight / standard_gravity;
  if (speed > 0) cut.n = (v / v.norm()).template cast<double>();
  cut.b = static_cast<double>(speed > 0 ? most / speed : most);
  return cut;
}

template class Supply<2>;
template class Supply<3>;

}  // namespace poise
