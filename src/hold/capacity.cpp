#include "poise/capacity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dual/exact.hpp"
#include "hold/solve.hpp"
#include "poise/grip.hpp"

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double wanted = 1e-7;       // between what is held and what is proven
constexpr double near = 1e-5;         // where it is as good as closed
constexpr double no_friction = 1e-9;  // where ever less is enough
/// What contacts must do is nothing beside weights that are so many times as great: these are held
/// by the balance tolerance.
constexpr double out_of_proportion = 1e9;
constexpr double most_friction = 1e6;
constexpr double nothing = 1e-9;    ///< of the weight: what drives may do that have nothing to do
constexpr double rounding = 4e-16;  ///< of a twist
constexpr int most_probes = 200;

using Real = dual::Exact;  // a force norm of a million weights makes rounding of doubles felt

using dual::Rates;

bool is_near(double value, double bound, double little = 0) {
  return std::abs(value - bound) <= 0.9 * near * std::max({value, bound, little});
}

/// What proves that something cannot be held.
template <int Dim>
struct Proof {
  Twist<Dim> y;
  Rates rates;  ///< of the drives; empty: 0
};

/// What contacts and drives can do against y at most: `fixed` + `growing` times the force norm.
struct Power {
  Real fixed{0}, growing{0};
};

/// How far the farthest point of a contact is.
template <int Dim>
double farthest(const Contact<Dim>& contact, const Vector<Dim>& from) {
  double distance = (contact.position - from).norm();
  if constexpr (Dim == 3)
    if (contact.pad)
      for (const Vector<3>& point : contact.pad->points)
        distance = std::max(distance, (contact.position + point - from).norm());
  return distance;
}

/// What is asked: a weight through the load's com, in a posture. Equation (8) of docs/theory.md.
template <int Dim>
struct Question {
  Question(const Hand<Dim>& held_by, const Load<Dim>& held, const Vector<Dim>& upwards,
           const HoldSettings& within)
      : hand(held_by), load(held), up(upwards), settings(within), drives(held_by.drives()) {
    for (const Drive<Dim>& drive : drives)
      limited_drives = limited_drives || std::isfinite(drive.max);
    limited = limited_drives;
    for (const Contact<Dim>& contact : hand.contacts()) {
      limited = limited || std::isfinite(contact.max_normal);
      radius = std::max(radius, farthest(contact, load.com));
    }
    Load<Dim> newton = load;
    newton.weight = 1;
    newton.fixed.setZero();
    per_newton = newton.at(up);
    moving = std::abs(newton.turning()) + newton.acceleration.norm() / standard_gravity;
    still = of(0).size(hand.length());
  }

  const Hand<Dim>& hand;
  const Load<Dim>& load;
  const Vector<Dim>& up;
  const HoldSettings& settings;
  std::vector<Drive<Dim>> drives;
  bool limited_drives{false}, limited{false};
  double radius{0};        ///< L of this load: the hand's is about its center
  Wrench<Dim> per_newton;  ///< what a newton of weight adds to the load, with its accelerations
  double moving, still;    ///< the load's size is at most moving weight + still

  /// The load with another weight [N].
  Load<Dim> of(double weight) const {
    Load<Dim> other = load;
    other.weight = weight;
    return other;
  }
  /// Without its fixed wrench, which is nothing beside weights that are great enough; of 1 N where
  /// it has no weight.
  Load<Dim> without_fixed() const {
    Load<Dim> other = of(load.weight > 0 ? load.weight : 1);
    other.fixed.setZero();
    return other;
  }
  /// What an imbalance of the tolerance does against y at most, for each newton of the load's size.
  Real tolerance(const Twist<Dim>& y) const {
    const Real omega = y.template tail<wrench_size<Dim> - Dim>().norm();
    return dual::delta * (dual::velocity<Dim>(y, load.com).norm() + radius * omega);
  }
  /// What one newton of weight does against y at least, if the balance is off by the tolerance.
  Real driven(const Twist<Dim>& y) const {
    return y.template cast<Real>().dot(per_newton.template cast<Real>()) - moving * tolerance(y);
  }
  /// And what the fixed wrench does.
  Real driven_by_fixed(const Twist<Dim>& y) const {
    return y.template cast<Real>().dot(load.fixed.template cast<Real>()) - still * tolerance(y);
  }
  /// How a drive moves the finger of a contact.
  Twist<Dim> screw(std::size_t drive, std::size_t contact) const {
    Twist<Dim> sum = Twist<Dim>::Zero();
    for (const auto& moved : drives[drive].moves)
      if (moved.finger == hand.contacts()[contact].finger) sum += moved.twist;
    return sum;
  }
  /// y against the finger of a contact.
  Twist<Dim> felt(const Proof<Dim>& proof, std::size_t contact) const {
    Twist<Dim> left = proof.y;
    for (std::size_t a = 0; a < proof.rates.size(); ++a)
      if (proof.rates[a] > 0) left -= proof.rates[a] * screw(a, contact);
    return left;
  }
  Power power(const Proof<Dim>& proof, double friction_factor) const {
    Power power;
    Real squared = 0;
    for (std::size_t a = 0; a < proof.rates.size(); ++a)
      if (proof.rates[a] > 0) power.fixed += Real{proof.rates[a]} * drives[a].max;
    for (std::size_t i = 0; i < hand.contacts().size(); ++i) {
      const Contact<Dim>& contact = hand.contacts()[i];
      const Twist<Dim> z = felt(proof, i);
      const Real along = dual::power(contact, z, friction_factor);
      if (std::isfinite(contact.max_normal)) {
        power.fixed += (along > 0 ? contact.max_normal : contact.min_normal) * along;
        continue;
      }
      // A cone cut at min_normal is that cut and the cone.
      power.fixed += contact.min_normal * along;
      if (along <= 0) continue;
      Contact<Dim> whole = contact;
      whole.min_normal = 0;
      squared += 2 * std::max(dual::phi(whole, z, friction_factor), Real{0});
    }
    power.growing = std::sqrt(squared);
    return power;
  }
  /// With rates at which contacts without max_normal can do nothing, where the drives' max is worth
  /// less than the force cap.
  Proof<Dim> eased(Proof<Dim> proof, double friction_factor) const {
    if (!limited_drives) return proof;
    if (proof.rates.empty()) {
      proof.rates.resize(drives.size());
      std::fill(proof.rates.begin(), proof.rates.end(), 0.0);
    }
    for (std::size_t i = 0; i < hand.contacts().size(); ++i) {
      const Contact<Dim>& contact = hand.contacts()[i];
      if (std::isfinite(contact.max_normal)) continue;
      const Twist<Dim> z = felt(proof, i);
      const auto along = static_cast<double>(dual::power(contact, z, friction_factor)) +
                         rounding * (z.cwiseAbs().sum() + proof.y.cwiseAbs().sum());
      if (!(along > 0)) continue;
      double least = infinity, more = 0;
      std::size_t best = 0;
      for (std::size_t a = 0; a < drives.size(); ++a) {
        const Twist<Dim> opening = -screw(a, i);
        const auto eases = -static_cast<double>(dual::power(contact, opening, friction_factor));
        if (!(eases > 0) || !(drives[a].max / eases < least)) continue;
        least = drives[a].max / eases;
        more = along / eases;
        best = a;
      }
      proof.rates[best] += more;
    }
    return proof;
  }
  /// The hold of another weight [N] by the same contacts, or by changed ones.
  Hold<Dim> hold(const ScaledHand<Dim>& contacts, double weight, double friction_factor = 1) const {
    return solve<Dim>(hand, contacts, friction_factor, of(weight), up, settings);
  }
  /// Whether limits are too low for a load, and what proves it.
  bool needs_too_much(const Wrench<Dim>& wrench, double unit, double friction_factor,
                      Proof<Dim>& proof) const {
    if (!hand.is_general() || !limited) return false;
    const LeastPart<Dim> least = least_part(hand, friction_factor, wrench, unit);
    if (least.state != dual::Balance<Dim>::State::not_held && !(least.part > 1 + 1e-9))
      return false;
    proof = {least.y, least.rates};
    return true;
  }
  /// A hold, or what proves that there is none.
  bool holds(double weight, double friction_factor, Hold<Dim>& hold, Proof<Dim>& proof) const {
    const Load<Dim> probed = of(weight);
    if (needs_too_much(probed.at(up), probed.size(hand.length()), friction_factor, proof))
      return false;
    hold = friction_factor == 1
               ? this->hold(hand.scaled(), weight)
               : this->hold(hand.scaled().with_friction(friction_factor), weight, friction_factor);
    if (!hold.holdable) proof = {hold.dual, hold.rates};
    return hold.holdable;
  }
  /// With a hold that was found, of a load, by `by`.
  Posture<Dim> posture(Hold<Dim> hold, const Load<Dim>& held, const Hand<Dim>& by) const {
    Posture<Dim> posture{.up = up, .holds = {std::move(hold)}};
    if (posture.holdable()) posture.manner = poise::manner(by, held, up, posture.hold());
    return posture;
  }
};

/// (y, rates) as a bound on the weight: weight * gain <= fixed.
struct Cut {
  Real gain, fixed;
};

template <int Dim>
Cut cut_by(const Question<Dim>& asked, const Proof<Dim>& proof) {
  const Power most = asked.power(proof, 1);
  const Real growing = asked.settings.force_cap * most.growing;
  return {asked.driven(proof.y) - asked.moving * growing,
          most.fixed - asked.driven_by_fixed(proof.y) + asked.still * growing};
}

/// The part of a contact's tangential velocity that makes all of it slip.
template <int Dim>
Real sliding(const Contact<Dim>& contact, const Twist<Dim>& y) {
  if constexpr (Dim == 3)
    if (contact.pad) {
      const std::vector<Real> beside = dual::pad_slide<Real>(contact, y).beside;
      return *std::min_element(beside.begin(), beside.end());
    }
  return dual::slide<Real>(contact, y).beside;
}

/// In every hold of the greatest weight (8) is an equation.
template <int Dim>
std::vector<Deciding> deciding_by(const Question<Dim>& asked, const Proof<Dim>& proof) {
  const Real gain = cut_by(asked, proof).gain, least = 1e-9 * std::abs(gain);
  std::vector<Deciding> result;
  for (std::size_t i = 0; i < asked.hand.contacts().size(); ++i) {
    const Contact<Dim>& contact = asked.hand.contacts()[i];
    const Twist<Dim> felt = asked.felt(proof, i);
    const Real along = dual::power(contact, felt);
    const bool pressing = std::isfinite(contact.max_normal) && along > least;
    result.push_back({pressing ? static_cast<double>(along / gain) : 0,
                      contact.friction > 0 && sliding(contact, felt) > least && along > -least});
  }
  return result;
}

template <int Dim>
std::vector<double> drives_by(const Question<Dim>& asked, const Proof<Dim>& proof) {
  const Real gain = cut_by(asked, proof).gain, least = 1e-9 * std::abs(gain);
  std::vector<double> result(asked.drives.size(), 0.0);
  for (std::size_t a = 0; a < proof.rates.size(); ++a)
    if (proof.rates[a] > least) result[a] = static_cast<double>(proof.rates[a] / gain);
  return result;
}

/// By contacts without max_normal alone, with drives that have a max doing nothing.
template <int Dim>
Hold<Dim> hold_without_limits(const Question<Dim>& asked) {
  const Hand<Dim>& hand = asked.hand;
  const Load<Dim> load = asked.without_fixed();
  std::vector<Contact<Dim>> contacts;
  for (const Contact<Dim>& contact : hand.contacts())
    if (!std::isfinite(contact.max_normal)) {
      contacts.push_back(contact);
      contacts.back().min_normal = 0;
    }
  Hold<Dim> hold;
  if (contacts.empty()) return hold;
  const Hand<Dim> fingers(contacts, hand.center());
  Mechanism<Dim> mechanism{.kind = DriveKind::listed};
  for (Drive<Dim> drive : asked.drives) {
    if (!std::isfinite(drive.max)) continue;
    drive.max = nothing * load.size(hand.length()) * (drive.turns ? hand.scaled().length : 1);
    std::erase_if(drive.moves, [&](const auto& moved) {
      const auto& left = fingers.fingers();
      return std::find(left.begin(), left.end(), moved.finger) == left.end();
    });
    if (!drive.moves.empty()) mechanism.drives.push_back(std::move(drive));
  }
  if (mechanism.drives.empty()) mechanism.kind = DriveKind::each;
  const Hold<Dim> found = poise::hold(Hand<Dim>(contacts, hand.center(), 1, mechanism), load,
                                      asked.up, {asked.settings.force_cap});
  hold.holdable = found.holdable;
  hold.dual = found.dual;
  if (!found.holdable) return hold;
  hold.effort = found.effort;
  hold.lower_bound = found.lower_bound;
  hold.residual = found.residual;
  hold.forces.resize(hand.contacts().size());
  std::size_t next = 0;
  auto point = found.pad_forces.begin();
  for (std::size_t i = 0; i < hold.forces.size(); ++i) {
    const bool presses = !std::isfinite(hand.contacts()[i].max_normal);
    if constexpr (Dim == 3)
      if (const auto& pad = hand.contacts()[i].pad)
        for (std::size_t k = 0; k < pad->points.size(); ++k)
          hold.pad_forces.push_back(presses ? *point++ : Vector<3>::Zero());
    if (presses) {
      hold.forces[i] = found.forces[next++];
      continue;
    }
    ContactForce<Dim> none{};
    none.limit = ForceLimit::max;  // which is 0
    if constexpr (Dim == 3) none.tangential = none.center_of_pressure = Vector<3>::Zero();
    hold.forces[i] = none;
  }
  return hold;
}

/// The search for both ends: every y that proves something cuts the range.
template <int Dim>
class WeightSearch {
 public:
  explicit WeightSearch(const Question<Dim>& asked) : asked_(asked) {
    range_.greatest.bound = infinity;
    pressing_ = asked.still;
    for (const Contact<Dim>& contact : asked.hand.contacts()) {
      pressing_ += contact.min_normal;
      if (std::isfinite(contact.max_normal)) strength_ += contact.max_normal;
    }
    for (const Drive<Dim>& drive : asked.drives)
      if (std::isfinite(drive.max))
        strength_ += drive.turns ? drive.max / asked.hand.scaled().length : drive.max;
  }

  WeightRange<Dim> run() {
    bound_greatest();
    range_.holdable = !(pressing_ > 0) || find_least();
    if (range_.holdable) find_greatest();
    if (!range_.holdable) try_given();
    const bool is_greatest_near = range_.greatest.weight == infinity ||
                                  is_near(range_.greatest.weight, range_.greatest.bound);
    range_.proven = range_.holdable
                        ? is_greatest_near && is_near(range_.least.weight, range_.least.bound)
                        : empty();
    complete(range_.least, least_);
    complete(range_.greatest, greatest_);
    if (range_.holdable && range_.greatest.bound < infinity) {
      const Proof<Dim> proof{range_.greatest.dual, range_.greatest.rates};
      range_.deciding = deciding_by(asked_, proof);
      range_.deciding_drives = drives_by(asked_, proof);
    }
    return std::move(range_);
  }

 private:
  void cut(Proof<Dim> proof) {
    const double size = proof.y.template lpNorm<Eigen::Infinity>();
    if (!(size > 0)) return;
    proof.y /= size;
    for (double& rate : proof.rates) rate /= size;
    apply(proof);
    if (asked_.limited_drives) apply(asked_.eased(std::move(proof), 1));
  }

  void apply(const Proof<Dim>& proof) {
    const Cut row = cut_by(asked_, proof);
    const auto weight = static_cast<double>(row.fixed / row.gain);
    WeightEnd<Dim>& least = range_.least;
    WeightEnd<Dim>& greatest = range_.greatest;
    const bool none = row.gain >= 0 && row.fixed < -nothing * pressing_;
    if (!none_ && (none || (row.gain > 0 && weight < greatest.bound))) {
      none_ = none;
      greatest.bound = none ? 0 : std::max(weight, 0.0);
      greatest.dual = proof.y;
      greatest.rates = proof.rates;
    } else if (row.gain < 0 && weight > least.bound && !from_zero_) {
      least.bound = weight;
      least.dual = proof.y;
      least.rates = proof.rates;
    }
  }

  bool empty() const {
    return none_ || (!(asked_.still > 0) && range_.greatest.bound <= dual::delta * strength_) ||
           range_.greatest.bound < range_.least.bound ||
           range_.least.bound > out_of_proportion * pressing_;
  }

  bool probe(WeightEnd<Dim>& end, Hold<Dim>& hold, double weight) {
    Proof<Dim> proof;
    if (!asked_.holds(weight, 1, hold, proof)) {
      cut(std::move(proof));
      return false;
    }
    end.weight = weight;
    return true;
  }

  void bound_greatest() {
    const Hand<Dim>& hand = asked_.hand;
    if (!(asked_.moving > 0)) {  // it falls freely: any weight is as good as none
      Proof<Dim> proof;
      if (asked_.holds(asked_.load.weight, 1, greatest_, proof))
        range_.greatest.weight = infinity;
      else
        cut(std::move(proof));
      return;
    }
    const Load<Dim> given = asked_.without_fixed();
    const double unit = given.size(hand.length());
    if (!hand.is_general()) {
      greatest_ =
          solve<Dim>(hand, hand.scaled().without_limits(), 1, given, asked_.up, asked_.settings);
    } else if (!asked_.limited) {
      greatest_ = hold_without_limits(asked_);
    } else {
      std::vector<Contact<Dim>> contacts = hand.contacts();
      for (Contact<Dim>& contact : contacts) contact.min_normal = 0;
      const LeastPart<Dim> least =
          least_part(Hand<Dim>(std::move(contacts), hand.center(), 1, hand.mechanism()), 1,
                     given.at(asked_.up), unit);
      if (least.state == dual::Balance<Dim>::State::held &&
          least.part * strength_ <= nothing * unit)
        greatest_ = hold_without_limits(asked_);
      else
        cut({least.y, least.rates});
    }
    if (greatest_.holdable) {
      range_.greatest.weight = infinity;
      return;
    }
    cut({greatest_.dual, greatest_.rates});
    Twist<Dim> y = Twist<Dim>::Zero();
    y.template head<Dim>() = asked_.up;
    cut({y, {}});
  }

  bool find_least() {
    WeightEnd<Dim>& end = range_.least;
    const Wrench<Dim>& none = asked_.load.fixed;
    const double unit = asked_.still > 0 ? asked_.still : asked_.load.size(asked_.hand.length());
    Proof<Dim> proof;
    if (!asked_.needs_too_much(none, unit, 1, proof)) {
      least_ = poise::hold<Dim>(asked_.hand, none, unit, Twist<Dim>::Zero(),
                                {asked_.settings.force_cap});
      proof = {least_.dual, least_.rates};
    }
    from_zero_ = least_.holdable;
    if (from_zero_) {
      end.bound = 0;
      end.dual.setZero();
      end.rates.resize(0);
      return true;
    }
    cut(std::move(proof));
    double step = wanted;
    for (int k = 0; k < most_probes && end.bound > 0 && step < 1 && !empty(); ++k) {
      const double weight = end.bound * (1 + step);
      if (probe(end, least_, weight)) return true;
      if (end.bound <= weight) step *= 8;
    }
    return false;
  }

  /// A little below the bound there is a hold, or a lower bound.
  void find_greatest() {
    WeightEnd<Dim>& end = range_.greatest;
    if (end.weight == infinity) return;
    const auto nothing_beside_least = [&] {
      range_.holdable = range_.least.weight > 0;
      if (!range_.holdable) return;
      end.weight = range_.least.weight;
      greatest_ = least_;
    };
    if (end.bound == infinity) {  // rounding hid it
      if (!probe(end, greatest_, asked_.load.weight)) nothing_beside_least();
      return;
    }
    double step = wanted;
    for (int k = 0; k < most_probes && step < 1 && !empty(); ++k) {
      const double weight = end.bound * (1 - step);
      if (probe(end, greatest_, weight)) return;
      if (end.bound >= weight) step *= 8;
    }
    nothing_beside_least();
  }

  /// What is held is held, also where the ends are lost in rounding.
  void try_given() {
    Hold<Dim> hold = asked_.hold(asked_.hand.scaled(), asked_.load.weight);
    range_.holdable = hold.holdable;
    if (!hold.holdable) return;
    range_.least.weight = range_.greatest.weight = asked_.load.weight;
    least_ = greatest_ = std::move(hold);
  }

  /// What is held at an end; where any weight is held, the given one as any other: contacts with a
  /// limit have no part in it.
  void complete(WeightEnd<Dim>& end, Hold<Dim>& hold) const {
    const Hand<Dim>& hand = asked_.hand;
    if (end.weight < infinity || !hold.holdable) {
      end.posture = asked_.posture(std::move(hold), asked_.of(end.weight), hand);
      return;
    }
    if (!(asked_.moving > 0)) {
      end.posture = asked_.posture(std::move(hold), asked_.load, hand);
      return;
    }
    std::vector<Contact<Dim>> contacts = hand.contacts();
    for (Contact<Dim>& contact : contacts) {
      contact.min_normal = 0;
      if (std::isfinite(contact.max_normal)) contact.max_normal = 0;
    }
    end.posture =
        asked_.posture(std::move(hold), asked_.without_fixed(),
                       Hand<Dim>(std::move(contacts), hand.center(), 1, hand.mechanism()));
  }

  const Question<Dim>& asked_;
  double pressing_{0};     ///< how hard contacts must press even where there is no weight [N]
  bool from_zero_{false};  ///< they can do so without any weight
  bool none_{false};       ///< the dual of the greatest weight leaves none, not even 0
  double strength_{0};     ///< of all contacts with max_normal [N]
  WeightRange<Dim> range_;
  Hold<Dim> least_, greatest_;
};

/// The search for the least friction: every y that proves something raises the bound.
template <int Dim>
class FrictionSearch {
 public:
  explicit FrictionSearch(const Question<Dim>& asked) : asked_(asked) { found_.factor = infinity; }

  LeastFriction<Dim> run() {
    probe(1);
    if (!probe(0)) narrow();
    found_.proven = found_.factor < infinity ? is_near(found_.factor, found_.bound, no_friction)
                                             : found_.bound >= most_friction * (1 - near);
    found_.posture = asked_.posture(std::move(hold_), asked_.load, asked_.hand);
    return std::move(found_);
  }

 private:
  void narrow() {
    double step = wanted;
    for (int k = 0; k < most_probes && !found(); ++k) {
      const double failed = failed_, factor = found_.factor, near = found_.bound * (1 + step);
      if (near > failed) {
        probe(near);
        if (found_.bound <= near) step *= 8;
      }
      if (found_.factor == infinity) {
        if (!(failed_ < most_friction)) break;
        probe(std::min(2 * std::max(failed_, 1.0), most_friction));
      } else if (!(found_.factor - failed_ <= (factor - failed) / 2)) {
        probe(failed_ + (found_.factor - failed_) / 2);  // where proofs reach not far, halving does
      }
      if (failed_ == failed && found_.factor == factor) break;  // rounding leaves it open
    }
  }

  bool found() const {
    return found_.factor < infinity && found_.factor - failed_ <= wanted * found_.factor;
  }

  bool probe(double factor) {
    if (!(factor < found_.factor)) return true;
    Hold<Dim> there;
    Proof<Dim> proof;
    if (!asked_.holds(asked_.load.weight, factor, there, proof)) {
      cut(std::move(proof));
      failed_ = std::max({failed_, factor, found_.bound});
      return false;
    }
    found_.factor = factor;
    hold_ = std::move(there);
    return true;
  }

  void cut(Proof<Dim> proof) {
    const double size =
        std::max(proof.y.template lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min());
    proof.y /= size;
    for (double& rate : proof.rates) rate /= size;
    const Real unit = asked_.moving * asked_.load.weight + asked_.still;
    const Real needed =
        asked_.load.weight * asked_.driven(proof.y) + asked_.driven_by_fixed(proof.y);
    const auto does = [&](const Proof<Dim>& with, double factor) {
      const Power most = asked_.power(with, factor);
      return needed > most.fixed + asked_.settings.force_cap * unit * most.growing;
    };
    const auto proves = [&](double factor) {  // less and less the more friction there is
      return does(proof, factor) ||
             (asked_.limited_drives && does(asked_.eased(proof, factor), factor));
    };
    if (!proves(found_.bound)) return;
    double from = found_.bound, to = most_friction;
    if (proves(to)) from = to;
    for (double middle = 0; from < to; (proves(middle) ? from : to) = middle) {
      middle = from + (to - from) / 2;
      if (middle <= from || middle >= to) break;
    }
    found_.bound = from;
    if (!does(proof, from)) proof = asked_.eased(std::move(proof), from);
    found_.dual = proof.y;
    found_.rates = proof.rates;
  }

  const Question<Dim>& asked_;
  LeastFriction<Dim> found_;
  double failed_{0};  ///< the greatest factor that was too little, proven or not
  Hold<Dim> hold_;
};

/// The hold of least grip with a safety factor on the friction; of least effort without a grip.
template <int Dim>
Posture<Dim> safe_posture(const Question<Dim>& asked, double safety) {
  const Hand<Dim>& hand = asked.hand;
  if (!has_grip(hand))
    return asked.posture(
        asked.hold(hand.scaled().with_friction(1 / safety), asked.load.weight, 1 / safety),
        asked.load, hand);
  const Hand<Dim> safe(hand.contacts(), hand.center(), safety, hand.mechanism());
  return asked.posture(
      least_grip(safe, asked.load, asked.up,
                 {.force_cap = asked.settings.force_cap, .objective = Objective::grip}),
      asked.load, hand);
}

}  // namespace

template <int Dim>
WeightRange<Dim> weight_range(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                              const HoldSettings& settings) {
  const Question<Dim> asked(hand, load, up, settings);
  return WeightSearch<Dim>(asked).run();
}

template <int Dim>
std::vector<Deciding> deciding(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                               const Twist<Dim>& dual, const SmallVector<double, 4>& rates,
                               const HoldSettings& settings) {
  return deciding_by<Dim>({hand, load, up, settings}, {dual, rates});
}

template <int Dim>
std::vector<double> deciding_drives(const Hand<Dim>& hand, const Load<Dim>& load,
                                    const Vector<Dim>& up, const Twist<Dim>& dual,
                                    const SmallVector<double, 4>& rates,
                                    const HoldSettings& settings) {
  return drives_by<Dim>({hand, load, up, settings}, {dual, rates});
}

template <int Dim>
LeastFriction<Dim> least_friction(const Hand<Dim>& hand, const Load<Dim>& load,
                                  const Vector<Dim>& up, const HoldSettings& settings) {
  const Question<Dim> asked(hand, load, up, settings);
  return FrictionSearch<Dim>(asked).run();
}

template <int Dim>
Capacity<Dim> capacity(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
                       double safety, const HoldSettings& settings) {
  if (!(safety >= 1) || !std::isfinite(safety)) throw InvalidGrasp("safety", "must be at least 1");
  const Question<Dim> asked(hand, load, up, settings);
  return {WeightSearch<Dim>(asked).run(), FrictionSearch<Dim>(asked).run(),
          safe_posture(asked, safety)};
}

#define POISE_INSTANTIATE(Dim)                                                                    \
  template WeightRange<Dim> weight_range(const Hand<Dim>&, const Load<Dim>&, const Vector<Dim>&,  \
                                         const HoldSettings&);                                    \
  template std::vector<Deciding> deciding(const Hand<Dim>&, const Load<Dim>&, const Vector<Dim>&, \
                                          const Twist<Dim>&, const SmallVector<double, 4>&,       \
                                          const HoldSettings&);                                   \
  template std::vector<double> deciding_drives(                                                   \
      const Hand<Dim>&, const Load<Dim>&, const Vector<Dim>&, const Twist<Dim>&,                  \
      const SmallVector<double, 4>&, const HoldSettings&);                                        \
  template LeastFriction<Dim> least_friction(const Hand<Dim>&, const Load<Dim>&,                  \
                                             const Vector<Dim>&, const HoldSettings&);            \
  template Capacity<Dim> capacity(const Hand<Dim>&, const Load<Dim>&, const Vector<Dim>&, double, \
                                  const HoldSettings&);
POISE_INSTANTIATE(2)
POISE_INSTANTIATE(3)
#undef POISE_INSTANTIATE

}  // namespace poise
