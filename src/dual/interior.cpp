#include "dual/interior.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dual/tolerances.hpp"
#include "dual/wide.hpp"

namespace poise::dual {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
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
/// A pivot is known to within rounding of its own diagonal entry.
template <class T>
constexpr double rounding = 4.5 * rounding_of<T>;

/// s >= 0 and its multiplier u: a limit of N, the effort that a drive has left, F.
template <class T>
struct Ray {
  T s, u;
  T ds, du;
  T d;  ///< the step's aim: ds + (s / u) du = d

  T curvature() const { return u / s; }
  T product() const { return s * u; }
  void aim() { d = -s; }
  void aim(const T& center, const T& second) { d = -s + (center - second * ds * du) / u; }
  void step(const T& change) {
    ds = change;
    du = curvature() * (d - ds);
  }
  T way() const {
    return std::min<T>(ds < 0 ? T(-s / ds) : T(infinity), du < 0 ? T(-u / du) : T(infinity));
  }
  void go(const T& length) {
    s += length * ds;
    u += length * du;
  }
};

/// A head and a tail.
template <int D, class T>
struct Spin {
  T head;
  Eigen::Matrix<T, D, 1> tail;

  T dot(const Spin& other) const { return head * other.head + tail.dot(other.tail); }
  /// Lorentz length, squared.
  T square() const {
    const T t = tail.norm();
    return (head - t) * (head + t);
  }
};

/// s in the cone |tail| <= head and its multiplier u, scaled by W after Nesterov and Todd:
/// W = scale [w0 w1ᵀ; w1 I + w1 w1ᵀ/(1 + w0)], W u = W⁻¹ s = lambda.
template <int D, class T>
struct Cone {
  using Tail = Eigen::Matrix<T, D, 1>;
  Spin<D, T> s, u;
  Spin<D, T> ds, du;
  Spin<D, T> d;  ///< the step's aim: ds + W² du = d
  T scale, w0;
  Tail w1;
  Spin<D, T> lambda;

  T product() const { return s.dot(u); }
  void rescale() {
    using std::sqrt;
    const T least = std::numeric_limits<double>::min();
    const T ls = sqrt(std::max<T>(s.square(), least)), lu = sqrt(std::max<T>(u.square(), least));
    const Tail s1 = s.tail / ls, u1 = u.tail / lu;
    w1 = (s1 - u1) / sqrt(2 * (1 + s.head / ls * (u.head / lu) + s1.dot(u1)));
    w0 = sqrt(1 + w1.squaredNorm());
    scale = sqrt(ls / lu);
    lambda = times(u);
  }
  Spin<D, T> times(const Spin<D, T>& x) const {
    const T along = w1.dot(x.tail);
    return {scale * (w0 * x.head + along), scale * (x.tail + (x.head + along / (1 + w0)) * w1)};
  }
  Spin<D, T> over(const Spin<D, T>& x) const {
    const T along = w1.dot(x.tail);
    return {(w0 * x.head - along) / scale, (x.tail - (x.head - along / (1 + w0)) * w1) / scale};
  }
  void aim() { d = {-s.head, -s.tail}; }
  void aim(const T& center, const T& second) {
    const Spin<D, T> a = over(ds), b = times(du);
    const T head = center - lambda.dot(lambda) - second * a.dot(b);
    const Tail tail = -2 * lambda.head * lambda.tail - second * (a.head * b.tail + b.head * a.tail);
    const T first = (lambda.head * head - lambda.tail.dot(tail)) / lambda.square();
    d = times({first, (tail - first * lambda.tail) / lambda.head});
  }
  /// The tail of du is known without the rounding of W⁻²; the head of W² du = d - ds gives its
  /// head.
  void step(const Spin<D, T>& change, const Tail& tail) {
    ds = change;
    const T left = (d.head - ds.head) / (scale * scale);
    du = {(left - 2 * w0 * w1.dot(tail)) / (1 + 2 * w1.squaredNorm()), tail};
  }
  /// The least t > 0 with x + t dx on the border.
  static T way(const Spin<D, T>& x, const Spin<D, T>& dx) {
    const T a = dx.square(), b = x.head * dx.head - x.tail.dot(dx.tail), c = x.square();
    if (a >= 0 && b >= 0) return infinity;
    // Whoever goes back in a timelike direction meets the border: the root is real.
    using std::sqrt;
    const T root = sqrt(std::max<T>(b * b - a * c, 0));
    return b < 0 ? c / (root - b) : (b + root) / -a;
  }
  T way() const { return std::min<T>(way(s, ds), way(u, du)); }
  void go(const T& length) {
    s.head += length * ds.head;
    s.tail += length * ds.tail;
    u.head += length * du.head;
    u.tail += length * du.tail;
  }
};

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

  void find_unfelt();
  void solve_for(Column& x) const;
  void find_residuals();
  T center();
  void factorise();
  void aim();
  void aim(const T& center, const T& second);
  void solve(Side& side, const T& damping, bool of_tau);
  void follow(Side& side, const Column& x) const;
  T refine(const T& damping);
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
  std::vector<Square> M_;  ///< of the fingers: wrench per twist
  Side step_, growing_;    ///< growing: per unit of tau
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

}  // namespace

template <int Dim>
Balance<Dim> quick_balance(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted) {
  return Interior<Dim, double>(hand, w, wanted).run();
}

template <int Dim>
Balance<Dim> balance(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted) {
  const Balance<Dim> found = quick_balance(hand, w, wanted);
  if (found.state != Balance<Dim>::State::open) return found;
#ifdef __wasm__
  return found;  // the page with the core in it is loaded from the web: digits are not worth its size
#else
  // Of a load that is held but for its own rounding they make out that it is not.
  const Balance<Dim> wide = Interior<Dim, Wide>(hand, w, wanted).run();
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
    result.push_back(power + rounding<double> * steep * size);
  }
  return result;
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
    if (power[i] > 0 && hand.contacts[i].hi == infinity && shut[i] < 0)
      part = std::max(part, 1.01 * power[i] / -shut[i]);
  if (part > 0 && part < 1e-3) {
    for (std::size_t a = 0; a < cut.rates.size(); ++a) cut.rates[a] += part * alone[a];
    power = powers(hand, cut.y, cut.rates);
  }
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
