#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "motion/needs.hpp"
#include "poise/grip.hpp"
#include "poise/wrist_offset.hpp"

namespace poise {
namespace {

constexpr double pi = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();
constexpr double tie = 1e-6;
constexpr double rounding = 1e-9;  // of a bound

/// A motion seen from the object as it is turned now.
struct Seen {
  Vector<3> force;  ///< acceleration of the origin and against gravity [m/s^2]
  Vector<3> omega, alpha;
};

/// What a dual y proves of one state for all rotations Q: value >= p1 . Q^T b1 + p2 . Q^T b2 +
/// u^T S u - fixed, u = Q^T omega.
struct Cut {
  std::size_t state;
  Vector<3> of_force, of_alpha;
  Eigen::Matrix3d of_omega;
  double lowest, spread;  ///< least eigenvalue of S, and half of what they differ by
  double fixed;
  double most;  ///< where the value may not be above: infinite value there
};

class Offsets {
 public:
  Offsets(const Hand<3>& hand, const Body& body, const std::vector<MotionState>& states,
          const OffsetSettings& settings)
      : hand_(hand),
        body_(body),
        states_(states),
        settings_(settings),
        weight_(body.mass * standard_gravity),
        needs_(hand, weight_, {settings.objective, settings.force_cap}) {
    for (const MotionState& state : states) {
      motion_load(body, state);  // checks it
      const Eigen::Quaterniond to_object = state.orientation.conjugate();
      seen_.push_back({to_object * (state.acceleration + standard_gravity * Vector<3>::UnitZ()),
                       to_object * state.angular_velocity, to_object * state.angular_acceleration});
    }
  }

  WristOffset run() {
    take(Eigen::Quaterniond::Identity());
    found_.now = found_.value;
    std::priority_queue<Cell> open;
    open.push({Vector<3>::Zero(), pi, lower_bound(Vector<3>::Zero(), pi)});
    while (!open.empty() && found_.cells < settings_.max_cells) {
      const Cell cell = open.top();
      if (closed(cell.bound)) break;
      open.pop();
      ++found_.cells;
      look_at(cell.middle);
      for (int k = 0; k < 8; ++k) {
        const double half = cell.half / 2;
        const Vector<3> middle =
            cell.middle +
            half * Vector<3>((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
        if (middle.norm() - std::sqrt(3.0) * half > pi) continue;  // turns farther than half round
        const double bound = std::max(cell.bound, lower_bound(middle, half));
        if (closed(bound))
          left_out_ = std::min(left_out_, bound);
        else
          open.push({middle, half, bound});
      }
    }
    const double open_bound = std::min(left_out_, open.empty() ? infinity : open.top().bound);
    found_.lower_bound = std::min(open_bound, found_.value);
    found_.optimal = closed(open_bound);
    if (found_.rotation.w() < 0) found_.rotation.coeffs() *= -1;
    return found_;
  }

 private:
  /// Rotation vectors in a cube.
  struct Cell {
    Vector<3> middle;
    double half, bound;
    bool operator<(const Cell& other) const { return bound > other.bound; }
  };

  bool closed(double bound) const {
    return bound == infinity || bound >= (1 - settings_.gap) * found_.value;
  }

  static Eigen::Quaterniond rotation(const Vector<3>& vector) {
    const double angle = vector.norm();
    return Eigen::Quaterniond(
        Eigen::AngleAxisd(angle, angle > 0 ? Vector<3>(vector / angle) : Vector<3>::UnitX()));
  }

  /// What a state needs with a rotation; what its hold proves is kept.
  double value(std::size_t k, const Eigen::Quaterniond& rotation) {
    MotionState state = states_[k];
    state.orientation = state.orientation * rotation;
    const Hold<3> hold = needs_.hold(motion_load(body_, state).at());
    add_cut(k, hold);
    return hold.holdable ? hold.value() : infinity;
  }

  void add_cut(std::size_t k, const Hold<3>& hold) {
    const bool by_grip = hold.objective == Objective::grip;
    if (hold.holdable && by_grip != (settings_.objective == Objective::grip)) return;
    Cut cut{};
    cut.state = k;
    cut.most = infinity;
    double gain = 1;
    if (!hold.holdable) {
      cut.most = never(hold.dual);
    } else if (by_grip) {
      const Wrench<3> none = Wrench<3>::Zero();
      cut.fixed = -grip_bound<3>(hand_, none, hold.dual, hold.rates, settings_.force_cap * weight_);
    } else {
      gain = 2;
      cut.fixed = 2 * phi<3>(hand_, hold.dual);
    }
    const Vector<3> omega = gain * hold.dual.tail<3>();
    const Vector<3> at_com = gain * hold.dual.head<3>() + omega.cross(body_.com);
    cut.of_force = body_.mass * at_com;
    cut.of_alpha = body_.mass * body_.com.cross(at_com) + body_.inertia * omega;
    Eigen::Matrix3d across;  // across u = omega x u
    across << 0, -omega.z(), omega.y(), omega.z(), 0, -omega.x(), -omega.y(), omega.x(), 0;
    const Eigen::Matrix3d s = body_.mass * (at_com * body_.com.transpose() -
                                            at_com.dot(body_.com) * Eigen::Matrix3d::Identity()) +
                              across.transpose() * body_.inertia;
    cut.of_omega = (s + s.transpose()) / 2;
    const Eigen::Vector3d eigen =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cut.of_omega, Eigen::EigenvaluesOnly)
            .eigenvalues();
    cut.lowest = eigen[0];
    cut.spread = (eigen[2] - eigen[0]) / 2;
    cuts_.push_back(cut);
  }

  /// The y . load above which y, or a longer one, proves more than the cap: V >= 2 (s y . load -
  /// phi(s y)), and for s >= 1 phi(s y) is at most s^2 phi(y) where no contact has a min_normal.
  double never(const Twist<3>& y) const {
    const double cap = settings_.force_cap * weight_, fixed = phi<3>(hand_, y);
    const auto& contacts = hand_.contacts();
    if (std::any_of(contacts.begin(), contacts.end(),
                    [](const Contact<3>& contact) { return contact.min_normal > 0; }))
      return cap * cap / 2 + fixed;
    return std::max(cap * std::sqrt(2 * std::max(fixed, 0.0)), 2 * fixed);
  }

  /// Of all rotations within an angle of one.
  double lower_bound(const Cut& cut, const Eigen::Quaterniond& back, double angle) const {
    const Seen& seen = seen_[cut.state];
    const auto least = [&](const Vector<3>& p, const Vector<3>& b) {
      const double size = p.norm() * b.norm();
      if (!(size > 0)) return 0.0;
      const double cosine = std::clamp(p.dot(back * b) / size, -1.0, 1.0);
      return size * std::cos(std::min(pi, std::acos(cosine) + angle));
    };
    const Vector<3> u = back * seen.omega;
    const double square = u.squaredNorm();
    const double turned = 2 * std::sin(std::min(angle, pi / 2)) * cut.spread * square;
    const double centripetal = std::max(u.dot(cut.of_omega * u) - turned, cut.lowest * square);
    const double bound =
        least(cut.of_force, seen.force) + least(cut.of_alpha, seen.alpha) + centripetal - cut.fixed;
    return bound - rounding * std::abs(bound);
  }

  /// Of all rotations of a cube; no more of the cuts than close it are looked at.
  double lower_bound(const Vector<3>& middle, double half) {
    const Eigen::Quaterniond back = rotation(middle).conjugate();
    const double angle = std::min(std::sqrt(3.0) * half, pi);
    double most = 0;
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
      const double bound = lower_bound(cuts_[k], back, angle);
      if (cuts_[k].most == infinity)
        most = std::max(most, bound);
      else if (bound > cuts_[k].most)
        most = infinity;
      if (!closed(most)) continue;
      std::swap(cuts_[k], cuts_[k / 2]);  // cuts that close much come first
      break;
    }
    return most;
  }

  /// Asks those states that need most, where what is known does not rule it out.
  void look_at(const Vector<3>& middle) {
    if (closed(lower_bound(middle, 0))) return;
    const Eigen::Quaterniond there = rotation(middle);
    double most = 0;
    for (std::size_t j = 0; j < hard_.size() && most < infinity; ++j) {
      most = std::max(most, value(hard_[j], there));
      if (most >= (1 - settings_.gap / 2) * found_.value) return;
    }
    take(there);
  }

  /// Asks all states; the one that needs most is asked first from now on.
  void take(const Eigen::Quaterniond& rotation) {
    double most = 0;
    std::size_t state = 0;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const std::size_t kept = cuts_.size();
      const double need = value(k, rotation);
      if (need > most) {
        most = need;
        state = k;
      } else {
        cuts_.erase(cuts_.begin() + static_cast<std::ptrdiff_t>(kept),
                    cuts_.end());  // of those that decide nothing
      }
      if (need == infinity || need >= (1 - tie) * found_.value) break;
    }
    if (const auto at = std::find(hard_.begin(), hard_.end(), state); at != hard_.end())
      hard_.erase(at);
    hard_.insert(hard_.begin(), state);
    if (most < (1 - tie) * found_.value) {
      found_.value = most;
      found_.rotation = rotation;
      found_.state = state;
    }
  }

  const Hand<3>& hand_;
  const Body& body_;
  const std::vector<MotionState>& states_;
  const OffsetSettings& settings_;
  double weight_;
  Needs needs_;
  std::vector<Seen> seen_;
  std::vector<Cut> cuts_;
  std::vector<std::size_t> hard_;  ///< states that were the ones to need most
  double left_out_{infinity};      ///< the least bound of cubes that were closed
  WristOffset found_;
};

}  // namespace

WristOffset best_offset(const Hand<3>& hand, const Body& body,
                        const std::vector<MotionState>& states, const OffsetSettings& settings) {
  if (states.empty()) throw InvalidGrasp("states", "must not be empty");
  if (!(settings.gap > 0 && settings.gap < 1))
    throw InvalidGrasp("gap", "must be above 0 and below 1");
  if (settings.max_cells < 1) throw InvalidGrasp("max_cells", "must be at least 1");
  return Offsets(hand, body, states, settings).run();
}

}  // namespace poise
