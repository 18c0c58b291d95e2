// Where the interior-point method stands, and its equations: what is missing of them, and the step
// that follows from aims. Not installed.
//
// Contacts are eliminated one by one; left is a small dense system for (rates, y, F).
#pragma once

#include <Eigen/Eigenvalues>
#include <vector>

#include "dual/interior.hpp"
#include "dual/interior_cones.hpp"
#include "dual/tolerances.hpp"
#include "dual/wide.hpp"

namespace poise::dual::interior {

/// A pivot is known to within rounding of its own diagonal entry.
template <class T>
constexpr double rounding = 4.5 * rounding_of<T>;

/// LDLᵀ of a symmetric matrix of which only the last pivots are negative, in place.
template <class T>
class Factors {
 public:
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  using Column = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  explicit Factors(Eigen::Index size) : A_(size, size), over_(size) {}
  Matrix& matrix() { return A_; }
  void factorise(Eigen::Index positive) {
    for (Eigen::Index j = 0; j < A_.rows(); ++j) {
      using std::abs;
      const T least = rounding<T> * abs(A_(j, j)) + 1e-300;
      T pivot = A_(j, j);
      for (Eigen::Index k = 0; k < j; ++k) pivot -= A_(j, k) * A_(k, j);
      pivot = j < positive ? std::max<T>(pivot, least) : std::min<T>(pivot, -least);
      over_[j] = 1 / pivot;
      for (Eigen::Index i = j + 1; i < A_.rows(); ++i) {
        T sum = A_(i, j);
        for (Eigen::Index k = 0; k < j; ++k) sum -= A_(i, k) * A_(k, j);
        A_(j, i) = sum;             // L D
        A_(i, j) = sum * over_[j];  // L
      }
    }
  }
  void solve(Column& x) const {
    const Eigen::Index size = A_.rows();
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index k = 0; k < i; ++k) x[i] -= A_(i, k) * x[k];
    for (Eigen::Index i = size; i-- > 0;) {
      x[i] *= over_[i];
      for (Eigen::Index k = i + 1; k < size; ++k) x[i] -= A_(k, i) * x[k];
    }
  }

 private:
  Matrix A_;
  Column over_;
};

template <int Dim, class T>
class Interior {
  static constexpr int rows = wrench_size<Dim>, D = part_size<Dim>;
  using Tail = Eigen::Matrix<T, D, 1>;
  using Square = Eigen::Matrix<T, rows, rows>;
  using Screw = Eigen::Matrix<T, rows, 1>;
  using Column = typename Factors<T>::Column;
  using Found = Balance<Dim>;

  /// A step, or one of its right-hand sides.
  struct Side {
    Column x;             ///< rates, y, F
    std::vector<T> N;     ///< of each contact
    std::vector<Tail> t;  ///< of each part
    T gap;                ///< of kappa
  };
  struct Part {
    T reach, weight;
    Eigen::Matrix<T, rows, D> G;
    Cone<D, T> cone;  ///< s = (reach N, t)
    Tail residual;
    // dt = K⁻¹ (Gᵀ dy + residual) + aim - corner dN, K⁻¹ = over (I - bend w1 w1ᵀ).
    T over, bend, schur;
    Tail corner;

    Tail by_K(const Tail& x) const { return over * (x - (bend * cone.w1.dot(x)) * cone.w1); }
  };
  struct Body {
    std::size_t first, last, finger;
    Screw normal;
    T weight, least, most;
    bool has_lo, has_hi;
    T N;
    Ray<T> lo, hi;
    T residual;
    Screw arrow;  ///< the wrench of dN = 1 and the dt that follow
    T over;
  };
  struct Drive {
    struct Moved {
      std::size_t finger;
      Screw twist;
    };
    std::vector<Moved> moved;
    T most;      ///< 0 to the grip
    Ray<T> ray;  ///< s = F - e, or most - e
    T residual;
  };

 public:
  Interior(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted);
  Found run();

 private:
  Eigen::Index y_row() const { return static_cast<Eigen::Index>(drives_.size()); }
  auto y_of(const Column& x) const { return x.template segment<rows>(y_row()); }
  auto y_of(Column& x) const { return x.template segment<rows>(y_row()); }
  /// y less what the drives move of a finger, with rates from `rate`.
  template <class Rate>
  Screw felt_by(std::size_t finger, const Screw& y, const Rate& rate) const {
    Screw felt = y;
    for (std::size_t a = 0; a < drives_.size(); ++a)
      for (const auto& moved : drives_[a].moved)
        if (moved.finger == finger) felt -= rate(a) * moved.twist;
    return felt;
  }
  T power(const Drive& drive) const {
    T sum = 0;
    for (const auto& moved : drive.moved) sum += moved.twist.dot(wrench_[moved.finger]);
    return sum;
  }
  void clear_wrenches() { std::fill(wrench_.begin(), wrench_.end(), Screw(Screw::Zero())); }
  template <class Function>
  void for_each_ray(const Function& f) {
    for (Body& body : bodies_) {
      if (body.has_lo) f(body.lo);
      if (body.has_hi) f(body.hi);
    }
    for (Drive& drive : drives_) f(drive.ray);
    if (for_grip_) f(F_);
  }

  // The equations.
  void find_unfelt();
  void find_residuals();
  void factorise();
  void solve_for(Column& x) const;
  void solve(Side& side, const T& damping, bool of_tau);
  void follow(Side& side, const Column& x) const;
  T refine(const T& damping);

  // The method: interior.cpp.
  T center();
  void aim();
  void aim(const T& center, const T& second);
  void step(const T& damping, const T& aim_of_tau, bool is_last);
  T way();
  void go(const T& length);
  void keep(Found& best) const;
  void settle(Found& best) const;

  const ConeHand<Dim>& hand_;
  const Screw w_;
  const bool for_grip_;
  std::vector<Part> parts_;
  std::vector<Body> bodies_;
  std::vector<Drive> drives_;
  Ray<T> F_{};
  Screw y_ = Screw::Zero();
  T tau_{1}, kappa_{1}, dtau_{0}, dkappa_{0};
  double degree_{1};
  // Where it stands.
  std::vector<Screw> wrench_;  ///< of the fingers
  Screw balance_residual_;
  T F_residual_{0}, gap_residual_{0}, square_{0}, dual_{0}, primal_error_{0}, dual_error_{0};
  Factors<T> factors_;
  std::vector<Twist<Dim>> unfelt_;  ///< of length 1: what neither contacts nor the load feel
  std::vector<Square> M_;           ///< of the fingers: wrench per twist
  Side step_, growing_;             ///< growing: per unit of tau
};

template <int Dim, class T>
Interior<Dim, T>::Interior(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted)
    : hand_(hand),
      w_(w.template cast<T>()),
      for_grip_(wanted == Wanted::grip),
      wrench_(hand.fingers),
      factors_(rows + static_cast<Eigen::Index>(hand.drives.size()) + (for_grip_ ? 1 : 0)),
      M_(hand.fingers) {
  clear_wrenches();
  parts_.reserve(hand.parts.size());
  bodies_.reserve(hand.contacts.size());
  for (const ConeContact<Dim>& contact : hand.contacts) {
    Body body{.first = contact.first, .last = contact.last, .finger = contact.finger};
    body.normal = contact.normal.template cast<T>();
    body.weight = for_grip_ ? 0 : contact.weight;
    body.least = contact.lo;
    body.most = contact.hi;
    body.has_hi = contact.hi < infinity;
    body.has_lo = contact.lo > 0 || contact.first == contact.last;
    body.N = contact.lo + (body.has_hi ? std::min(1.0, (contact.hi - contact.lo) / 2) : 1);
    if (body.has_lo) body.lo.s = body.N - body.least;
    if (body.has_hi) body.hi.s = body.most - body.N;
    wrench_[contact.finger] += body.N * body.normal;
    for (std::size_t k = contact.first; k < contact.last; ++k) {
      const ConePart<Dim>& given = hand.parts[k];
      Part part{.reach = given.reach, .weight = for_grip_ ? 0 : given.weight};
      part.G = given.G.template cast<T>();
      part.cone.s = {part.reach * body.N, Tail::Zero()};
      part.cone.u = {1 / part.cone.s.head, Tail::Zero()};
      parts_.push_back(part);
    }
    bodies_.push_back(body);
  }
  F_.s = 0;
  for (const ConeDrive<Dim>& given : hand.drives) {
    Drive drive{};
    for (const auto& moved : given.moved)
      drive.moved.push_back({moved.finger, moved.twist.template cast<T>()});
    drive.most = for_grip_ ? 0 : given.max;
    F_.s = std::max<T>(F_.s, power(drive));
    drives_.push_back(std::move(drive));
  }
  F_.s += 1;
  for (Drive& drive : drives_) {
    const T left = (for_grip_ ? F_.s : drive.most) - power(drive);
    drive.ray.s = for_grip_ ? left : std::max<T>(left, drive.most / 2);
  }
  degree_ += static_cast<double>(parts_.size());
  for_each_ray([&](Ray<T>& ray) {
    ray.u = 1 / ray.s;
    degree_ += 1;
  });
  find_unfelt();
  for (Side* side : {&step_, &growing_}) {
    side->x.resize(factors_.matrix().rows());
    side->N.resize(bodies_.size());
    side->t.resize(parts_.size());
  }
}

template <int Dim, class T>
void Interior<Dim, T>::find_unfelt() {
  constexpr double nothing = 1e-15;  // of a square
  Eigen::Matrix<double, rows, rows> felt = Eigen::Matrix<double, rows, rows>::Zero();
  for (const ConeContact<Dim>& contact : hand_.contacts)
    felt += contact.normal * contact.normal.transpose();
  for (const ConePart<Dim>& part : hand_.parts) felt += part.G * part.G.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, rows, rows>> eigen(felt);
  const Wrench<Dim> w = w_.template cast<double>();
  for (int k = 0; k < rows; ++k) {
    const Twist<Dim> twist = eigen.eigenvectors().col(k);
    const bool is_felt = eigen.eigenvalues()[k] > nothing * eigen.eigenvalues()[rows - 1];
    if (!is_felt && std::abs(twist.dot(w)) <= 1e-13 * w.norm()) unfelt_.push_back(twist);
  }
}

/// Nothing of what neither contacts nor the load feel: rounding would make it without end.
template <int Dim, class T>
void Interior<Dim, T>::solve_for(Column& x) const {
  factors_.solve(x);
  for (const Twist<Dim>& unfelt : unfelt_) {
    const Screw v = unfelt.template cast<T>();
    y_of(x) -= v.dot(y_of(x)) * v;
  }
}

template <int Dim, class T>
void Interior<Dim, T>::find_residuals() {
  using std::abs;
  clear_wrenches();
  dual_error_ = 0;
  square_ = 0;
  dual_ = y_.dot(w_);
  const auto rate = [&](std::size_t a) -> const T& { return drives_[a].ray.u; };
  std::size_t finger = hand_.fingers;
  Screw felt = y_;
  for (Body& body : bodies_) {
    if (body.finger != finger) felt = felt_by(finger = body.finger, y_, rate);
    Screw& wrench = wrench_[finger];
    wrench += body.N * body.normal;
    square_ += body.weight * body.N * body.N;
    T pull = body.normal.dot(felt) - body.weight * body.N;
    if (body.has_lo) {
      pull += body.lo.u;
      dual_ += body.lo.u * body.least;
    }
    if (body.has_hi) {
      pull -= body.hi.u;
      dual_ -= body.hi.u * body.most;
    }
    for (std::size_t k = body.first; k < body.last; ++k) {
      Part& part = parts_[k];
      const Tail& t = part.cone.s.tail;
      wrench += part.G * t;
      square_ += part.weight * t.squaredNorm();
      part.residual = part.G.transpose() * felt + part.cone.u.tail - part.weight * t;
      pull += part.reach * part.cone.u.head;
      dual_error_ = std::max<T>(dual_error_, part.residual.cwiseAbs().maxCoeff());
    }
    body.residual = pull;
    dual_error_ = std::max<T>(dual_error_, abs(pull));
  }
  balance_residual_ = tau_ * w_;
  for (const Screw& wrench : wrench_) balance_residual_ -= wrench;
  primal_error_ = balance_residual_.cwiseAbs().maxCoeff();
  F_residual_ = for_grip_ ? T(F_.u - tau_) : T(0);
  for (Drive& drive : drives_) {
    drive.residual = (for_grip_ ? F_.s : T(drive.most * tau_)) - power(drive) - drive.ray.s;
    primal_error_ = std::max<T>(primal_error_, abs(drive.residual));
    if (for_grip_) F_residual_ += drive.ray.u;
    dual_ -= drive.ray.u * drive.most;
  }
  dual_error_ = std::max<T>(dual_error_, abs(F_residual_));
  gap_residual_ = dual_ - (for_grip_ ? F_.s : T(0)) - square_ / tau_ - kappa_;
}

/// W⁻² = (2 w wᵀ - diag(1, -I)) / scale² with w = (w0, -w1); K is the tail's block of it and the
/// weight. Differences are worked out by hand: near the border of a cone they lose all digits.
template <int Dim, class T>
void Interior<Dim, T>::factorise() {
  for (Square& M : M_) M.setZero();
  for (Part& part : parts_) {
    part.cone.rescale();
    const Cone<D, T>& cone = part.cone;
    const T per = 1 / (cone.scale * cone.scale), w1 = cone.w1.squaredNorm();
    const T p = part.weight / per, all = 1 + p + 2 * w1;
    part.over = 1 / (per * (1 + p));
    part.bend = 2 / all;
    part.corner = (-2 * cone.w0 / all * part.reach) * cone.w1;
    part.schur = per * (1 + p * (1 + 2 * w1)) / all;
  }
  for (Body& body : bodies_) {
    T h = body.weight;
    if (body.has_lo) h += body.lo.curvature();
    if (body.has_hi) h += body.hi.curvature();
    body.arrow = body.normal;
    Square& M = M_[body.finger];
    for (std::size_t k = body.first; k < body.last; ++k) {
      const Part& part = parts_[k];
      h += part.reach * part.reach * part.schur;
      body.arrow -= part.G * part.corner;
      const Screw bent = part.G * part.cone.w1;
      M += part.over * (part.G * part.G.transpose());
      M -= bent * ((part.over * part.bend) * bent).transpose();
    }
    body.over = 1 / h;
    M += body.arrow * (body.over * body.arrow).transpose();
  }
  auto& A = factors_.matrix();
  A.setZero();
  const Eigen::Index y = y_row();
  for (const Square& M : M_) A.template block<rows, rows>(y, y) += M;
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    A(row, row) += 1 / drives_[a].ray.curvature();
    for (const auto& moved : drives_[a].moved) {
      const Screw felt = M_[moved.finger] * moved.twist;
      A.col(row).template segment<rows>(y) -= felt;
      for (std::size_t b = 0; b <= a; ++b)
        for (const auto& other : drives_[b].moved)
          if (other.finger == moved.finger)
            A(row, static_cast<Eigen::Index>(b)) += felt.dot(other.twist);
    }
  }
  if (for_grip_) {
    const Eigen::Index row = A.rows() - 1;
    A.row(row).head(y).setOnes();
    A(row, row) = -F_.curvature();
  }
  factors_.factorise(y + rows);
}

/// The step as far as it follows from aims and residuals, or per unit of tau.
template <int Dim, class T>
void Interior<Dim, T>::solve(Side& side, const T& damping, bool of_tau) {
  clear_wrenches();  // what contacts do before y moves
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    T pull = of_tau ? T(0) : T(damping * body.residual);
    if (body.has_lo) pull += body.lo.curvature() * (of_tau ? body.least : body.lo.d);
    if (body.has_hi) pull += body.hi.curvature() * (of_tau ? body.most : T(-body.hi.d));
    for (std::size_t k = body.first; k < body.last; ++k) {
      side.t[k].setZero();
      if (of_tau) continue;
      const Part& part = parts_[k];
      const Spin<D, T>& d = part.cone.d;
      const Tail residual = damping * part.residual - part.weight * d.tail;
      pull += part.reach * part.schur * d.head - part.corner.dot(residual);
      side.t[k] = part.by_K(residual) + (d.head / part.reach) * part.corner + d.tail;
    }
    side.N[i] = body.over * pull;
    Screw& wrench = wrench_[body.finger];
    wrench += side.N[i] * body.normal;
    for (std::size_t k = body.first; k < body.last; ++k) {
      side.t[k] -= side.N[i] * parts_[k].corner;
      wrench += parts_[k].G * side.t[k];
    }
  }
  Column& x = side.x;
  y_of(x) = of_tau ? w_ : Screw(damping * balance_residual_);
  for (const Screw& each : wrench_) y_of(x) -= each;
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    const Drive& drive = drives_[a];
    x[static_cast<Eigen::Index>(a)] =
        power(drive) + (of_tau ? T(-drive.most) : T(drive.ray.d - damping * drive.residual));
  }
  if (for_grip_)
    x[x.size() - 1] = of_tau ? T(1) : T(-damping * F_residual_ - F_.curvature() * F_.d);
  solve_for(x);
  follow(side, x);

  side.gap = w_.dot(y_of(x));
  for (std::size_t a = 0; a < drives_.size(); ++a)
    side.gap -= drives_[a].most * x[static_cast<Eigen::Index>(a)];
  if (for_grip_) side.gap -= x[x.size() - 1];
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const T& N = side.N[i];
    if (body.has_lo)
      side.gap += body.least * body.lo.curvature() * ((of_tau ? body.least : body.lo.d) - N);
    if (body.has_hi)
      side.gap -= body.most * body.hi.curvature() * ((of_tau ? T(-body.most) : body.hi.d) + N);
    if (for_grip_) continue;
    side.gap -= 2 / tau_ * body.weight * body.N * N;
    for (std::size_t k = body.first; k < body.last; ++k)
      side.gap -= 2 / tau_ * parts_[k].weight * parts_[k].cone.s.tail.dot(side.t[k]);
  }
}

/// What the contacts do as y and the rates move.
template <int Dim, class T>
void Interior<Dim, T>::follow(Side& side, const Column& x) const {
  const Screw dy = y_of(x);
  const auto rate = [&](std::size_t a) -> const T& { return x[static_cast<Eigen::Index>(a)]; };
  std::size_t finger = hand_.fingers;
  Screw felt = dy;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    if (body.finger != finger) felt = felt_by(finger = body.finger, dy, rate);
    const T N = body.over * body.arrow.dot(felt);
    side.N[i] += N;
    for (std::size_t k = body.first; k < body.last; ++k)
      side.t[k] += parts_[k].by_K(parts_[k].G.transpose() * felt) - N * parts_[k].corner;
  }
}

/// Near the border of a cone forces along it are nearly free, and rounding of y is felt in them:
/// what is missing of the balance is solved for once more. How much it was.
template <int Dim, class T>
T Interior<Dim, T>::refine(const T& damping) {
  clear_wrenches();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    Screw& wrench = wrench_[body.finger];
    wrench += step_.N[i] * body.normal;
    for (std::size_t k = body.first; k < body.last; ++k) wrench += parts_[k].G * step_.t[k];
  }
  Column& x = growing_.x;  // needed no more
  const Column& known = step_.x;
  y_of(x) = damping * balance_residual_ + dtau_ * w_;
  for (const Screw& wrench : wrench_) y_of(x) -= wrench;
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    const Drive& drive = drives_[a];
    const auto row = static_cast<Eigen::Index>(a);
    x[row] = power(drive) + drive.ray.d - damping * drive.residual - dtau_ * drive.most -
             known[row] / drive.ray.curvature();
    if (for_grip_) x[row] -= known[known.size() - 1];
  }
  if (for_grip_) {
    T& missing = x[x.size() - 1];
    missing = dtau_ - damping * F_residual_ - F_.curvature() * (F_.d - known[known.size() - 1]);
    for (std::size_t a = 0; a < drives_.size(); ++a) missing -= known[static_cast<Eigen::Index>(a)];
  }
  const T missing = y_of(x).cwiseAbs().maxCoeff();
  solve_for(x);
  follow(step_, x);
  step_.x += x;
  return missing;
}

}  // namespace poise::dual::interior
