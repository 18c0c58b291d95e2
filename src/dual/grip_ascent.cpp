#include "dual/grip_ascent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dual/evaluate.hpp"
#include "dual/newton.hpp"

namespace poise::dual {
namespace {

/// z of a lane, less what the drives move at these rates.
[[gnu::always_inline]] inline SpaceVelocity<Lane> less(const ContactLane<3>& c,
                                                       const SpaceVelocity<Lane>& of,
                                                       const DriveLane<3>& drive,
                                                       const Lane& rate) {
  SpaceVelocity<Lane> z;
  z.normal = of.normal - rate * drive.zeta[0];
  z.a = of.a - rate * drive.zeta[1];
  z.b = of.b - rate * drive.zeta[2];
  z.turn = of.turn - rate * drive.zeta[3];
  z.squared = z.a * z.a + z.b * z.b + z.turn * z.turn;
  z.over = inverse_root(z.squared);
  z.power = z.normal + c.mu * (z.squared * z.over);
  return z;
}
[[gnu::always_inline]] inline PlaneVelocity<Lane> less(const ContactLane<2>& c,
                                                       const PlaneVelocity<Lane>& of,
                                                       const DriveLane<2>& drive,
                                                       const Lane& rate) {
  PlaneVelocity<Lane> z;
  z.normal = of.normal - rate * drive.zeta[0];
  z.tangential = of.tangential - rate * drive.zeta[1];
  z.power = z.normal + c.mu * magnitude(z.tangential);
  return z;
}

template <bool limited>
[[gnu::always_inline]] inline LaneForces<3, double> forces(const Cones<3>& cones,
                                                           const ContactLane<3>& c,
                                                           const SpaceVelocity<Lane>& z) {
  const SpaceForce<Lane> f = project<limited>(cones, c, z);
  return {{z.normal, z.a, z.b, z.turn}, {f.n, f.kept * z.a, f.kept * z.b, f.kept * z.turn}, z.over};
}
template <bool limited>
[[gnu::always_inline]] inline LaneForces<2, double> forces(const Cones<2>& cones,
                                                           const ContactLane<2>& c,
                                                           const PlaneVelocity<Lane>& z) {
  const PlaneForce<Lane> f = project<limited>(cones, c, z);
  return {{z.normal, z.tangential}, {f.n, f.t}};
}

/// How forces change as z does: DΠ_K x.
template <bool limited>
[[gnu::always_inline]] inline void change(const Cones<3>& cones, const ContactLane<3>& c,
                                          const LaneForces<3, double>& at, const Lane (&x)[4],
                                          Lane (&df)[4]) {
  const Lane over = at.over, da = at.z[1] * over, db = at.z[2] * over, ds = at.z[3] * over;
  const Lane beside = at.z[1] * da + at.z[2] * db + at.z[3] * ds;
  const SpaceDerivative<Lane> D = derivative<limited>(cones, c, beside, over, at.f[0]);
  const Lane along = da * x[1] + db * x[2] + ds * x[3];
  const Lane rest = D.nd * x[0] + D.dd * along;
  df[0] = D.kappa * x[0] + D.nn * x[0] + D.nd * along;
  df[1] = D.kappa * x[1] + da * rest;
  df[2] = D.kappa * x[2] + db * rest;
  df[3] = D.kappa * x[3] + ds * rest;
}
template <bool limited>
[[gnu::always_inline]] inline void change(const Cones<2>& cones, const ContactLane<2>& c,
                                          const LaneForces<2, double>& at, const Lane (&x)[2],
                                          Lane (&df)[2]) {
  const PlaneDerivative<Lane> D = derivative<limited>(cones, c, at.z[1], at.f[0]);
  const Lane along = D.edge * (x[0] + D.mu * x[1]);
  df[0] = D.inside * x[0] + along;
  if constexpr (limited) df[0] -= D.at_limit * x[0];
  df[1] = D.inside * x[1] + D.mu * along;
}

/// The wrench of the forces of each contact of a lane.
[[gnu::always_inline]] inline void wrench_of(const ContactLane<3>& c, const Lane (&f)[4],
                                             Lane (&w)[6]) {
  for (int k = 0; k < 3; ++k) w[k] = f[0] * c.n[k] + f[1] * c.a[k] + f[2] * c.b[k];
  const Lane moment = c.soft * f[3];
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    w[3 + k] = c.r[i] * w[j] - c.r[j] * w[i] + moment * c.n[k];
  }
}
[[gnu::always_inline]] inline void wrench_of(const ContactLane<2>& c, const Lane (&f)[2],
                                             Lane (&w)[3]) {
  w[0] = f[0] * c.nx - f[1] * c.ny;
  w[1] = f[0] * c.ny + f[1] * c.nx;
  w[2] = w[0] * c.jx + w[1] * c.jy;
}

/// Of a lane the velocities under a twist.
template <int Dim>
using Velocity = std::conditional_t<Dim == 2, PlaneVelocity<Lane>, SpaceVelocity<Lane>>;

using Numbers = SmallVector<double, 17>;  // of the drives, and one more for contacts without

/// Makes (y, rates) a proof to the last digit, and the rates add up to 1 if there are any. Their
/// sum before.
template <int Dim>
double prove(const Cones<Dim>& cones, const Driven<Dim>& driven, LeastGrip<Dim>& found) {
  const std::size_t drives = driven.drives.size();
  // A contact that could still do power gets a little more of its drive.
  found.fixed = 0;
  const double rounding = 4 * rounding_of<double> * l1_norm(found.y);
  const auto proven = twist_of_lane<double>(found.y);
  for (int round = 0; round < 2; ++round) {
    const std::size_t* drive = driven.drive_of.data();
    Numbers more(drives + 1);
    std::fill(more.begin(), more.end(), 0.0);
    for (std::size_t k = 0; k < cones.lanes.size(); ++k) {
      Lane rate{};
      for (std::size_t i = 0; i < lane_size; ++i)
        if (drive[i] < drives) rate[i] = found.rates[drive[i]];
      const ContactLane<Dim>& c = cones.lanes[k];
      const auto z = less(c, velocity(c, proven), driven.lanes[k], rate);
      const auto alone = less(c, Velocity<Dim>{}, driven.lanes[k], Lane{} + 1.0);
      for (std::size_t i = 0; i < lane_size; ++i) {
        if (!(c.share[i] > 0)) continue;
        const double power = z.power[i] + rounding, lo = cones.scaled(c.lo)[i],
                     hi = cones.scaled(c.hi)[i];
        if (round == 0) {
          if (power > 0 && !(hi < 1e300) && alone.power[i] < 0)
            more[drive[i]] = std::max(more[drive[i]], power / -alone.power[i]);
        } else {
          found.fixed += power <= 0 ? power * lo : power * std::min(hi, 1e6);
        }
      }
      drive += lane_size;
    }
    for (std::size_t a = 0; a < drives; ++a) found.rates[a] += (1 + 1e-12) * more[a];
  }
  double sum = 0;
  for (const double rate : found.rates) sum += rate;
  if (!(sum > 0)) return 0;
  found.y /= sum;
  found.fixed /= sum;
  for (double& rate : found.rates) rate /= sum;
  return sum;
}

template <int Dim, bool limited>
class GripAscent {
  static constexpr int rows = wrench_size<Dim>, size = contact_size<Dim>;
  using Screw = Twist<Dim>;

 public:
  GripAscent(const Problem<Dim>& problem, const Driven<Dim>& driven, const Wrench<Dim>& w)
      : cones_(problem),
        driven_(driven),
        w_(w),
        drives_(driven.drives.size()),
        free_(problem.lanes.size()),
        pull_(drives_),
        here_(problem.size, drives_),
        trial_(problem.size, drives_),
        slope_(drives_ + 1),
        steepest_(drives_ + 1) {}

  bool run(const Point<Dim>& held, LeastGrip<Dim>& found);

 private:
  static constexpr int most_steps = 60;
  static constexpr double most_gap = 1e-8;  ///< between value and proof, of the value

  struct Stand {
    Stand(std::size_t contacts, std::size_t drives) : point(contacts), rates(drives + 1) {}
    Point<Dim> point;  ///< value: of the dual function
    Numbers rates;
    double F{0};
  };
  /// A way of (y, rates).
  struct Way {
    Screw y;
    Numbers rates;
  };

  void find_efforts(const Stand& at, Numbers& efforts, Numbers& slopes) const;
  bool fill(Stand& at, double sum);
  void evaluate(Stand& at, double sum);
  void linearise();
  Way way(const Screw& missing, double growth) const;
  void go(const Way& way, double length, double sum);
  bool climb(double sum, double tolerance);
  bool finish(LeastGrip<Dim>& found);

  const Cones<Dim>& cones_;
  const Driven<Dim>& driven_;
  const Wrench<Dim>& w_;
  std::size_t drives_;
  SmallVector<Velocity<Dim>, 16 / lane_size> free_;  ///< of the contacts under y alone
  SmallVector<Screw, 16> pull_;  ///< of a drive: the wrench that its rate takes away
  Stand here_, trial_;
  Numbers slope_, steepest_;
  Numbers efforts_{drives_ + 1};
  Square<Dim, double> S_;  ///< minus the curvature of the dual function, the rates following y
  Screw lift_;             ///< of F as y moves
  double give_{0};
  double force_{0};  ///< the norm of the forces at the start
};

/// The efforts of the drives, and how fast they fall as each rate grows.
template <int Dim, bool limited>
void GripAscent<Dim, limited>::find_efforts(const Stand& at, Numbers& efforts,
                                            Numbers& slopes) const {
  std::fill(efforts.begin(), efforts.end(), 0.0);
  std::fill(slopes.begin(), slopes.end(), 0.0);
  const std::size_t* drive = driven_.drive_of.data();
  for (std::size_t k = 0; k < cones_.lanes.size(); ++k) {
    const LaneForces<Dim, double>& lane = at.point.lanes[k];
    const auto& zeta = driven_.lanes[k].zeta;
    Lane df[size], effort{}, slope{};
    change<limited>(cones_, cones_.lanes[k], lane, zeta, df);
    for (int j = 0; j < size; ++j) {
      effort += zeta[j] * lane.f[j];
      slope += zeta[j] * df[j];
    }
    for (std::size_t i = 0; i < lane_size; ++i) {
      efforts[drive[i]] += effort[i];
      slopes[drive[i]] += slope[i];
    }
    drive += lane_size;
  }
}

/// The rates that are best for y, and their forces: all drives whose rates are above 0 have the
/// same effort F. Newton's method, which for rates that are too low never goes too far.
template <int Dim, bool limited>
bool GripAscent<Dim, limited>::fill(Stand& at, double sum) {
  const auto twist = twist_of_lane<double>(at.point.y);
  for (std::size_t k = 0; k < cones_.lanes.size(); ++k) free_[k] = velocity(cones_.lanes[k], twist);
  at.rates[drives_] = 0;
  for (int round = 0; round < 30; ++round) {
    const std::size_t* drive = driven_.drive_of.data();
    for (std::size_t k = 0; k < cones_.lanes.size(); ++k) {
      Lane rate;
      for (std::size_t i = 0; i < lane_size; ++i) rate[i] = at.rates[*drive++];
      at.point.lanes[k] = forces<limited>(cones_, cones_.lanes[k],
                                          less(cones_.lanes[k], free_[k], driven_.lanes[k], rate));
    }
    find_efforts(at, efforts_, slope_);
    // What is left of linear efforts, cut at F.
    double F = 0, total = 0;
    for (std::size_t a = 0; a < drives_; ++a) {
      if (slope_[a] < 1e-6 * steepest_[a]) slope_[a] = 0.5 * steepest_[a];
      total += at.rates[a];
    }
    for (std::size_t cut = 0; cut <= drives_ + 1; ++cut) {
      double above = -sum, give = 0;
      for (std::size_t a = 0; a < drives_; ++a) {
        const double rate = at.rates[a] + (efforts_[a] - F) / slope_[a];
        if (!(rate > 0)) continue;
        above += rate;
        give += 1 / slope_[a];
      }
      if (!(above > 1e-15 * sum)) break;
      F += above / give;
    }
    double off = std::abs(total - sum);
    if (F == 0) off = 0;
    double worst = 0;
    for (std::size_t a = 0; a < drives_; ++a) {
      const double before = at.rates[a];
      at.rates[a] = std::max(0.0, before + (efforts_[a] - F) / slope_[a]);
      worst = std::max(worst, std::abs(at.rates[a] - before) * slope_[a]);
    }
    at.F = F;
    if (worst <= 1e-12 * force_ + 1e-15 * sum && off <= 1e-12 * sum) return true;
  }
  return false;
}

template <int Dim, bool limited>
void GripAscent<Dim, limited>::evaluate(Stand& at, double sum) {
  fill(at, sum);
  Lane total[rows] = {}, power{};
  for (std::size_t k = 0; k < cones_.lanes.size(); ++k) {
    const LaneForces<Dim, double>& lane = at.point.lanes[k];
    Lane w[rows];
    wrench_of(cones_.lanes[k], lane.f, w);
    for (int j = 0; j < rows; ++j) total[j] += w[j];
    for (int j = 0; j < size; ++j) power += lane.f[j] * (lane.z[j] - 0.5 * lane.f[j]);
  }
  for (int j = 0; j < rows; ++j) at.point.residual[j] = w_[j] - poise::sum(total[j]);
  at.point.value = at.point.y.dot(w_) - poise::sum(power);
}

template <int Dim, bool limited>
void GripAscent<Dim, limited>::linearise() {
  S_ = curvature_lanes<limited>(cones_, here_.point);
  find_efforts(here_, efforts_, slope_);
  for (Screw& pull : pull_) pull.setZero();
  const std::size_t* drive = driven_.drive_of.data();
  for (std::size_t k = 0; k < cones_.lanes.size(); ++k) {
    Lane df[size], w[rows];
    change<limited>(cones_, cones_.lanes[k], here_.point.lanes[k], driven_.lanes[k].zeta, df);
    wrench_of(cones_.lanes[k], df, w);
    for (std::size_t i = 0; i < lane_size; ++i, ++drive)
      if (*drive < drives_)
        for (int j = 0; j < rows; ++j) pull_[*drive][j] += w[j][i];
  }
  lift_.setZero();
  give_ = 0;
  for (std::size_t a = 0; a < drives_; ++a) {
    if (!(here_.rates[a] > 0) || !(slope_[a] > 1e-6 * steepest_[a])) {
      slope_[a] = 0;
      continue;
    }
    const Screw part = pull_[a] / slope_[a];
    S_.noalias() -= part * pull_[a].transpose();
    lift_ += part;
    give_ += 1 / slope_[a];
  }
  if (give_ > 0) S_.noalias() += lift_ * (lift_ / give_).transpose();
}

/// How y, and the rates with it, must move to make up for what is missing of the balance while the
/// sum of the rates grows.
template <int Dim, bool limited>
typename GripAscent<Dim, limited>::Way GripAscent<Dim, limited>::way(const Screw& missing,
                                                                     double growth) const {
  Way way{missing, Numbers(drives_)};
  if (growth != 0) way.y += lift_ * (growth / give_);
  way.y = newton_step(S_, way.y);
  const double dF = give_ > 0 ? (lift_.dot(way.y) - growth) / give_ : 0;
  for (std::size_t a = 0; a < drives_; ++a)
    way.rates[a] = slope_[a] > 0 ? (pull_[a].dot(way.y) - dF) / slope_[a] : 0;
  return way;
}

template <int Dim, bool limited>
void GripAscent<Dim, limited>::go(const Way& way, double length, double sum) {
  trial_.point.y = here_.point.y + length * way.y;
  for (std::size_t a = 0; a < drives_; ++a)
    trial_.rates[a] = std::max(0.0, here_.rates[a] + length * way.rates[a]);
  evaluate(trial_, sum);
}

template <int Dim, bool limited>
bool GripAscent<Dim, limited>::climb(double sum, double tolerance) {
  for (int step = 0; step < most_steps; ++step) {
    if (here_.point.residual.cwiseAbs().maxCoeff() <= tolerance) return true;
    linearise();
    Way way = this->way(here_.point.residual, 0);
    const double reach = here_.point.y.norm();
    if (!(way.y.norm() <= reach)) {
      S_.diagonal().array() += here_.point.residual.norm() / reach;
      way = this->way(here_.point.residual, 0);
    }
    const double slope = here_.point.residual.dot(way.y);
    double length = 1;
    for (int trial = 0;; ++trial) {
      if (trial == 30) return false;
      go(way, length, sum);
      if (trial_.point.value >=
          here_.point.value + 1e-3 * length * slope - 1e-14 * std::abs(here_.point.value))
        break;
      const double there = trial_.point.residual.dot(way.y);
      length *= std::clamp(slope / (slope - there), 0.1, 0.7);
    }
    std::swap(here_, trial_);
  }
  return false;
}

template <int Dim, bool limited>
bool GripAscent<Dim, limited>::run(const Point<Dim>& held, LeastGrip<Dim>& found) {
  force_ = std::sqrt(squared_norm(held));
  std::fill(steepest_.begin(), steepest_.end(), 0.0);
  for (std::size_t i = 0; i < driven_.drive_of.size(); ++i)
    for (int j = 0; j < size; ++j) {
      const double zeta = driven_.lanes[i / lane_size].zeta[j][i % lane_size];
      steepest_[driven_.drive_of[i]] += zeta * zeta;
    }
  // A first guess of the direction in which y will go, and the sum of rates for which it leaves
  // nearly the same grip.
  here_.point = held;
  std::fill(here_.rates.begin(), here_.rates.end(), 0.0);
  find_efforts(here_, efforts_, slope_);
  const double most = *std::max_element(efforts_.begin(), efforts_.begin() + drives_);
  if (!(most > 1e-9 * force_)) return false;
  double sum = force_ * force_ / most;
  const double unit = sum;
  here_.point.y = 2 * held.y;
  here_.F = 0;
  evaluate(here_, sum);
  if (!climb(sum, 1e-4 * force_)) return false;
  for (const double times : {30.0, 1e3, 1e5}) {
    linearise();
    const Way way = this->way(Screw::Zero(), 1);
    const double growth = times * unit - sum;
    sum = times * unit;
    go(way, growth, sum);
    std::swap(here_, trial_);
    if (!climb(sum, times < 1e5 ? 1e-4 * force_ : 1e-9 * force_)) return false;
  }
  return finish(found);
}

/// The rates at which y and the rates grow are the proof, but for rounding; rounding of y is in the
/// forces, too, and taken from them once more.
template <int Dim, bool limited>
bool GripAscent<Dim, limited>::finish(LeastGrip<Dim>& found) {
  linearise();
  const Way proof = way(Screw::Zero(), 1), rest = way(here_.point.residual, 0);
  found.point = here_.point;
  Lane total[rows] = {};
  const auto twist = twist_of_lane<double>(rest.y);
  const std::size_t* drive = driven_.drive_of.data();
  for (std::size_t k = 0; k < cones_.lanes.size(); ++k) {
    Lane rate{};
    for (std::size_t i = 0; i < lane_size; ++i, ++drive)
      if (*drive < drives_) rate[i] = rest.rates[*drive];
    const ContactLane<Dim>& c = cones_.lanes[k];
    const auto z = less(c, velocity(c, twist), driven_.lanes[k], rate);
    const LaneForces<Dim, double> moved = forces<limited>(cones_, c, z);  // for its z
    Lane df[size], w[rows];
    change<limited>(cones_, c, here_.point.lanes[k], moved.z, df);
    LaneForces<Dim, double>& lane = found.point.lanes[k];
    for (int j = 0; j < size; ++j) lane.f[j] += df[j];
    wrench_of(c, lane.f, w);
    for (int j = 0; j < rows; ++j) total[j] += w[j];
  }
  for (int j = 0; j < rows; ++j) found.point.residual[j] = w_[j] - poise::sum(total[j]);
  if (!(primal_norm<Dim, double>(found.point.residual) <= 10 * delta)) return false;
  Stand forces_only = here_;
  forces_only.point = found.point;
  find_efforts(forces_only, efforts_, slope_);
  found.value = std::max(0.0, *std::max_element(efforts_.begin(), efforts_.begin() + drives_));

  found.y = proof.y;
  found.rates.resize(drives_);
  for (std::size_t a = 0; a < drives_; ++a) found.rates[a] = std::max(0.0, proof.rates[a]);
  if (!(prove(cones_, driven_, found) > 0)) return false;
  // In the unit of scaled_grip().
  const double unit = driven_.alike ? 1 : 1 / cones_.per_weight;
  found.value *= unit;
  found.y *= unit;
  found.fixed *= unit;
  const double bound = found.y.dot(w_) - found.fixed;
  return found.value - bound <= most_gap * found.value;
}

}  // namespace

template <int Dim>
bool least_grip(const Problem<Dim>& problem, const Driven<Dim>& driven, const Wrench<Dim>& w,
                const Point<Dim>& held, LeastGrip<Dim>& found) {
  return with_simd([&] {
    return problem.limited ? GripAscent<Dim, true>(problem, driven, w).run(held, found)
                           : GripAscent<Dim, false>(problem, driven, w).run(held, found);
  });
}

template <int Dim>
bool refute(const Problem<Dim>& problem, const Driven<Dim>& driven, const Wrench<Dim>& w,
            double most, LeastGrip<Dim>& found) {
  found.value = std::numeric_limits<double>::infinity();
  found.rates.resize(driven.drives.size());
  std::fill(found.rates.begin(), found.rates.end(), 0.0);
  found.y /= l1_norm(found.y);
  const double sum = prove<Dim>(problem, driven, found);
  const double proven = found.y.dot(w) - found.fixed;
  return sum > 0 ? proven > 2 * most : proven > 1e-9;
}

template bool refute(const Problem<2>&, const Driven<2>&, const Wrench<2>&, double, LeastGrip<2>&);
template bool refute(const Problem<3>&, const Driven<3>&, const Wrench<3>&, double, LeastGrip<3>&);
template bool least_grip(const Problem<2>&, const Driven<2>&, const Wrench<2>&, const Point<2>&,
                         LeastGrip<2>&);
template bool least_grip(const Problem<3>&, const Driven<3>&, const Wrench<3>&, const Point<3>&,
                         LeastGrip<3>&);

}  // namespace poise::dual
