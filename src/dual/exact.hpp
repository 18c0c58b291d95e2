// The formula on which every proof rests, (2) of docs/theory.md, from the contacts themselves and
// in more digits than the solver has: a long y is worth less than its rounding. Not installed.
#pragma once

#include <algorithm>
#include <limits>

#include "dual/cone_pad.hpp"
#include "dual/cone_plane.hpp"
#include "dual/cone_space.hpp"
#include "dual/scaled_hand.hpp"
#include "dual/tolerances.hpp"
#include "poise/grasp.hpp"
#include "poise/small_vector.hpp"

namespace poise::dual {

using Exact = long double;

/// The velocity of a point of the object under a twist about its frame's origin.
template <int Dim>
Eigen::Matrix<Exact, Dim, 1> velocity(const Twist<Dim>& y, const Vector<Dim>& point) {
  Eigen::Matrix<Exact, Dim, 1> v = y.template head<Dim>().template cast<Exact>();
  const Eigen::Matrix<Exact, Dim, 1> r = point.template cast<Exact>();
  if constexpr (Dim == 2)
    v += Exact{y[2]} * Eigen::Matrix<Exact, 2, 1>(-r.y(), r.x());
  else
    v += y.template tail<3>().template cast<Exact>().cross(r);
  return v;
}

/// Of a contact the greatest z . f - effort / 2.
template <int Dim>
Exact phi(const Contact<Dim>& contact, const Twist<Dim>& y, double friction_factor) {
  const Exact mu = Exact{contact.friction} * friction_factor, share = contact.share;
  if constexpr (Dim == 3)
    if (contact.pad) return pad_phi<Exact>(contact, pad_slide<Exact>(contact, y), mu);
  const Slide<Exact> z = slide<Exact>(contact, y);
  // Where z is inside the cone, its projection to the edge presses less.
  const Exact edge = (z.normal + mu * z.beside) / (1 + mu * mu);
  const Exact n =
      std::clamp<Exact>(share * std::max(z.normal, edge), contact.min_normal, contact.max_normal);
  const Exact t = std::min(share * z.beside, mu * n);
  return n * z.normal + t * z.beside - (n * n + t * t) / (2 * share);
}

/// phi(G^T y), with all frictions and torsions multiplied by a factor.
template <int Dim>
Exact phi(const Hand<Dim>& hand, const Twist<Dim>& y, double friction_factor = 1) {
  Exact sum = 0;
  for (const Contact<Dim>& contact : hand.contacts()) sum += phi(contact, y, friction_factor);
  return sum;
}

/// The greatest power of a contact's force per newton of normal force.
template <int Dim>
Exact power(const Contact<Dim>& contact, const Twist<Dim>& y, double friction_factor = 1) {
  const Exact mu = Exact{contact.friction} * friction_factor;
  if constexpr (Dim == 3)
    if (contact.pad) return pad_power<Exact>(contact, pad_slide<Exact>(contact, y), mu);
  return power(slide<Exact>(contact, y), mu);
}

using Rates = SmallVector<double, 4>;

/// y less what drives with these rates move of each finger.
template <int Dim>
SmallVector<Twist<Dim>, 8> against_fingers(const Hand<Dim>& hand, const Twist<Dim>& y,
                                           const Rates& rates, bool in_parts) {
  SmallVector<Twist<Dim>, 8> left(hand.fingers().size());
  std::fill(left.begin(), left.end(), y);
  if (rates.empty()) return left;
  const Driven<Dim>& driven = hand.driven();
  for (const auto& moved : driven.moved)
    left[moved.finger] -=
        rates[moved.drive] / (in_parts ? driven.drives[moved.drive].max : 1) * moved.twist;
  return left;
}

/// What (y, rates) prove of the effort under the limits of drives, 2 (y . w - Σ rate max - phi):
/// (9) of docs/theory.md [N^2].
template <int Dim>
Exact effort_bound(const Hand<Dim>& hand, const Wrench<Dim>& load, const Twist<Dim>& y,
                   const Rates& rates, double friction_factor) {
  Exact sum = y.template cast<Exact>().dot(load.template cast<Exact>());
  for (std::size_t a = 0; a < rates.size(); ++a)
    if (rates[a] > 0) sum -= Exact{rates[a]} * hand.driven().drives[a].max;
  const auto felt = against_fingers(hand, y, rates, false);
  for (std::size_t i = 0; i < hand.contacts().size(); ++i)
    sum -= phi(hand.contacts()[i], felt[hand.finger_of(i)], friction_factor);
  return 2 * sum;
}

/// What rounding may take of effort_bound, twice over: others may compute it otherwise.
template <int Dim>
Exact effort_rounding(const Hand<Dim>& hand, const Wrench<Dim>& load, const Twist<Dim>& y,
                      const Rates& rates, double friction_factor) {
  Exact sum = (y.cwiseAbs().template cast<Exact>()).dot(load.cwiseAbs().template cast<Exact>());
  for (std::size_t a = 0; a < rates.size(); ++a)
    if (rates[a] > 0) sum += Exact{rates[a]} * hand.driven().drives[a].max;
  const auto felt = against_fingers(hand, y, rates, false);
  for (std::size_t i = 0; i < hand.contacts().size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    const Twist<Dim>& z = felt[hand.finger_of(i)];
    // The force is no longer than this, whether it has to press or not.
    const Exact most = 2 * std::max<Exact>(phi(contact, z, friction_factor), 0) * contact.share;
    const Exact steep = 1 + Exact{contact.friction} * friction_factor;
    const Exact force = std::min<Exact>(std::sqrt(most) + 2 * steep * contact.min_normal,
                                        4 * steep * contact.max_normal);
    const Twist<Dim> size = y.cwiseAbs() + (z - y).cwiseAbs();
    const Exact arm = contact.position.template lpNorm<1>() + hand.radius();
    sum += steep * force *
           (size.template head<Dim>().sum() +
            arm * size.template tail<wrench_size<Dim> - Dim>().sum());
  }
  return 32 * std::numeric_limits<Exact>::epsilon() * sum;
}

/// Whether (y, rates), or a part of them that rounding leaves more of, prove that no load within
/// the balance tolerance is held with a force norm of at most `cap` [N].
template <int Dim>
bool proves_none(const Hand<Dim>& hand, const Wrench<Dim>& load, double weight, double cap,
                 const Twist<Dim>& y, const Rates& rates, double friction_factor) {
  const Vector<Dim> center = hand.center();
  const Exact omega = y.template tail<wrench_size<Dim> - Dim>().norm();
  // About the com, wherever that is.
  const Exact imbalance = weight * (velocity<Dim>(y, center).norm() + 3 * hand.radius() * omega);
  constexpr int shortest = -80;
  for (int exponent = 0; exponent >= shortest; exponent -= 2) {
    const double length = std::ldexp(1.0, exponent);
    const Twist<Dim> shorter = length * y;
    Rates slower = rates;
    for (double& rate : slower) rate *= length;
    const Exact proven = effort_bound(hand, load, shorter, slower, friction_factor) -
                         effort_rounding(hand, load, shorter, slower, friction_factor) -
                         2 * delta * length * imbalance;
    if (proven > Exact{cap} * cap) return true;
  }
  return false;
}

/// What (y, rates) prove of the grip: (10) of docs/theory.md. `in_parts`: grip is in parts of max.
/// `force_norm` [N]: of the forces that are looked at, by which rounding is worth something.
template <int Dim>
Exact grip_bound(const Hand<Dim>& hand, const Wrench<Dim>& load, const Twist<Dim>& y,
                 const Rates& rates, bool in_parts, double force_norm) {
  const auto felt = against_fingers(hand, y, rates, in_parts);
  Exact sum = y.template cast<Exact>().dot(load.template cast<Exact>());
  for (std::size_t i = 0; i < hand.contacts().size(); ++i) {
    const Contact<Dim>& contact = hand.contacts()[i];
    const Exact most = power(contact, felt[hand.finger_of(i)]);
    sum -= most * (most <= 0 ? contact.min_normal : std::min(contact.max_normal, force_norm));
  }
  return sum;
}

/// What y proves of the effort in the posture `up`: 2 (y . w - phi(G^T y)) [N^2].
template <int Dim>
Exact bound(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
            const Twist<Dim>& y, double friction_factor) {
  const Exact power = load.turning() * velocity<Dim>(y, load.com).dot(up.template cast<Exact>()) +
                      y.template cast<Exact>().dot(load.still().template cast<Exact>());
  return 2 * (power - phi(hand, y, friction_factor));
}

}  // namespace poise::dual
