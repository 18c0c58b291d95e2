#include "dual/interior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <cstdlib>
#include <cstdio>

namespace poise::dual {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_steps = 80;
/// Of the balance in the load, of the rates in y, of the gap in the value: what is asked for, and
/// what is enough where rounding ends the way.
constexpr double wanted_error = 1e-13, enough = 1e-8;
/// An error from which on it is over as soon as a step makes it no better, and how many such steps
/// there may be before.
constexpr double good = 1e-10;
constexpr int patience = 8;  // steps
/// What may be missing of a step's balance, of the load.
constexpr double small_residual = 1e-14;
/// Shorter steps lead nowhere.
constexpr double shortest_step = 1e-7;
/// A pivot is known to within rounding of its own diagonal entry.
constexpr double rounding = 1e-15;

/// s >= 0 and its multiplier u: a limit of N, the effort that a drive has left, F.
struct Ray {
  double s, u;
  double ds, du;
  double d;  ///< the step's aim: ds + (s / u) du = d

  double curvature() const { return u / s; }
  double product() const { return s * u; }
  void aim() { d = -s; }
  void aim(double center) { d = -s + (center - ds * du) / u; }
  void step(double change) {
    ds = change;
    du = curvature() * (d - ds);
  }
  double way() const {
    return std::min(ds < 0 ? -s / ds : infinity, du < 0 ? -u / du : infinity);
  }
  void go(double length) {
    s += length * ds;
    u += length * du;
  }
};

/// A head and a tail.
template <int D>
struct Spin {
  double head;
  Eigen::Matrix<double, D, 1> tail;

  double dot(const Spin& other) const { return head * other.head + tail.dot(other.tail); }
  /// Lorentz length, squared.
  double square() const {
    const double t = tail.norm();
    return (head - t) * (head + t);
  }
};

/// s in the cone |tail| <= head and its multiplier u, scaled by W after Nesterov and Todd:
/// W = scale [w0 w1ᵀ; w1 I + w1 w1ᵀ/(1 + w0)], W u = W⁻¹ s = lambda.
template <int D>
struct Cone {
  using Tail = Eigen::Matrix<double, D, 1>;
  Spin<D> s, u;
  Spin<D> ds, du;
  Spin<D> d;  ///< the step's aim: ds + W² du = d
  double scale, w0;
  Tail w1;
  Spin<D> lambda;

  double product() const { return s.dot(u); }
  void rescale() {
    const double least = std::numeric_limits<double>::min();
    const double ls = std::sqrt(std::max(s.square(), least));
    const double lu = std::sqrt(std::max(u.square(), least));
    const Tail s1 = s.tail / ls, u1 = u.tail / lu;
    w1 = (s1 - u1) / std::sqrt(2 * (1 + s.head / ls * (u.head / lu) + s1.dot(u1)));
    w0 = std::sqrt(1 + w1.squaredNorm());
    scale = std::sqrt(ls / lu);
    lambda = times(u);
  }
  Spin<D> times(const Spin<D>& x) const {
    const double along = w1.dot(x.tail);
    return {scale * (w0 * x.head + along), scale * (x.tail + (x.head + along / (1 + w0)) * w1)};
  }
  Spin<D> over(const Spin<D>& x) const {
    const double along = w1.dot(x.tail);
    return {(w0 * x.head - along) / scale, (x.tail - (x.head - along / (1 + w0)) * w1) / scale};
  }
  void aim() { d = {-s.head, -s.tail}; }
  void aim(double center) {
    const Spin<D> a = over(ds), b = times(du);
    const double head = center - lambda.dot(lambda) - a.dot(b);
    const Tail tail = -2 * lambda.head * lambda.tail - a.head * b.tail - b.head * a.tail;
    const double first = (lambda.head * head - lambda.tail.dot(tail)) / lambda.square();
    d = times({first, (tail - first * lambda.tail) / lambda.head});
  }
  /// The tail of du is known without the rounding of W⁻²; the head of W² du = d - ds gives its head.
  void step(const Spin<D>& change, const Tail& tail) {
    ds = change;
    const double left = (d.head - ds.head) / (scale * scale);
    du = {(left - 2 * w0 * w1.dot(tail)) / (1 + 2 * w1.squaredNorm()), tail};
  }
  /// The least t > 0 with x + t dx on the border.
  static double way(const Spin<D>& x, const Spin<D>& dx) {
    const double a = dx.square(), b = x.head * dx.head - x.tail.dot(dx.tail), c = x.square();
    // Whoever goes back in a timelike direction meets the border: the root is real.
    if (a >= 0 && b >= 0) return infinity;
    return c / (std::sqrt(std::max(b * b - a * c, 0.0)) - b);
  }
  double way() const { return std::min(way(s, ds), way(u, du)); }
  void go(double length) {
    s.head += length * ds.head;
    s.tail += length * ds.tail;
    u.head += length * du.head;
    u.tail += length * du.tail;
  }
};

/// LDLᵀ of a symmetric matrix of which only the last pivots are negative, in place.
class Factors {
 public:
  explicit Factors(Eigen::Index size) : A_(size, size), over_(size) {}
  Eigen::MatrixXd& matrix() { return A_; }
  void factorise(Eigen::Index positive) {
    for (Eigen::Index j = 0; j < A_.rows(); ++j) {
      const double least = rounding * std::abs(A_(j, j)) + 1e-300;
      double pivot = A_(j, j);
      for (Eigen::Index k = 0; k < j; ++k) pivot -= A_(j, k) * A_(k, j);
      pivot = j < positive ? std::max(pivot, least) : std::min(pivot, -least);
      over_[j] = 1 / pivot;
      for (Eigen::Index i = j + 1; i < A_.rows(); ++i) {
        double sum = A_(i, j);
        for (Eigen::Index k = 0; k < j; ++k) sum -= A_(i, k) * A_(k, j);
        A_(j, i) = sum;             // L D
        A_(i, j) = sum * over_[j];  // L
      }
    }
  }
  void solve(Eigen::VectorXd& x) const {
    const Eigen::Index size = A_.rows();
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index k = 0; k < i; ++k) x[i] -= A_(i, k) * x[k];
    for (Eigen::Index i = size; i-- > 0;) {
      x[i] *= over_[i];
      for (Eigen::Index k = i + 1; k < size; ++k) x[i] -= A_(k, i) * x[k];
    }
  }

 private:
  Eigen::MatrixXd A_;
  Eigen::VectorXd over_;
};

template <int Dim>
class Interior {
  static constexpr int rows = wrench_size<Dim>, D = part_size<Dim>;
  using Tail = PartForce<Dim>;
  using Square = Eigen::Matrix<double, rows, rows>;

  /// One right-hand side of a step: of its constant part, or of what grows with tau.
  struct Side {
    Eigen::VectorXd x;            ///< y, rates, F
    std::vector<double> N;        ///< of each contact
    std::vector<Tail> t;          ///< of each part
    double gap;                   ///< of kappa
  };
  struct Part {
    const ConePart<Dim>* data;
    Cone<D> cone;  ///< s = (reach N, t)
    Tail residual;
    // dt = K⁻¹ (Gᵀ dy + residual) + aim - corner dN, K⁻¹ = over (I - bend w1 w1ᵀ).
    double over, bend, schur;
    Tail corner;
    double weight;

    Tail by_K(const Tail& x) const {
      return over * (x - bend * cone.w1.dot(x) * cone.w1);
    }
  };
  struct Body {
    const ConeContact<Dim>* data;
    double N;
    double residual;
    Ray lo, hi;
    bool has_lo, has_hi;
    Wrench<Dim> arrow;  ///< of dN = 1 and the dt that follow
    double over, weight;
  };

 public:
  Interior(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted);
  Balance<Dim> run();

 private:
  using State = typename Balance<Dim>::State;

  Eigen::Index drive_row(std::size_t a) const { return rows + static_cast<Eigen::Index>(a); }
  double most(std::size_t a) const { return for_grip_ ? 0 : hand_.drives[a].max; }
  /// y less what the drives move of a finger.
  Twist<Dim> against(std::size_t finger, const Twist<Dim>& y, const auto& rate) const {
    Twist<Dim> left = y;
    for (std::size_t a = 0; a < hand_.drives.size(); ++a)
      for (const auto& moved : hand_.drives[a].moved)
        if (moved.finger == finger) left -= rate(a) * moved.twist;
    return left;
  }
  void find_residuals();
  bool is_done();
  void factorise();
  void aim_at(double center, bool corrected);
  void solve(Side& side, double damping, bool of_tau);
  void follow(Side& side, const Eigen::VectorXd& x) const;
  double refine(double damping);
  void step(double damping, double aim_of_tau, bool last);
  double way() const;
  void go(double length);
  void settle(Balance<Dim>& best) const;
  template <class Function>
  void for_each_ray(const Function& f) {
    for (Body& body : bodies_) {
      if (body.has_lo) f(body.lo);
      if (body.has_hi) f(body.hi);
    }
    for (Ray& drive : drives_) f(drive);
    if (for_grip_) f(F_);
  }

  const ConeHand<Dim>& hand_;
  const Wrench<Dim>& w_;
  bool for_grip_;
  std::vector<Part> parts_;
  std::vector<Body> bodies_;
  std::vector<Ray> drives_;  ///< s = F - e, or max - e
  std::vector<double> drive_residual_;
  Ray F_{};
  Twist<Dim> y_ = Twist<Dim>::Zero();
  double tau_{1}, kappa_{1}, dtau_{0}, dkappa_{0};
  double degree_{1};
  // Where it stands.
  Wrench<Dim> balance_residual_;
  double F_residual_{0}, gap_residual_{0}, square_{0}, dual_{0};
  double primal_error_{0}, dual_error_{0};
  std::vector<Wrench<Dim>> wrench_;  ///< of the fingers
  Factors factors_;
  std::vector<Square> M_;  ///< of the fingers
  Side constant_, growing_;
};

template <int Dim>
Interior<Dim>::Interior(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted)
    : hand_(hand),
      w_(w),
      for_grip_(wanted == Wanted::grip),
      drive_residual_(hand.drives.size()),
      wrench_(hand.fingers),
      factors_(rows + static_cast<Eigen::Index>(hand.drives.size()) + (for_grip_ ? 1 : 0)),
      M_(hand.fingers) {
  std::fill(wrench_.begin(), wrench_.end(), Wrench<Dim>::Zero());
  parts_.reserve(hand.parts.size());
  for (const ConeContact<Dim>& contact : hand.contacts) {
    Body body{};
    body.data = &contact;
    body.has_hi = contact.hi < infinity;
    body.has_lo = contact.lo > 0 || contact.first == contact.last;
    body.N = contact.lo + (body.has_hi ? std::min(1.0, (contact.hi - contact.lo) / 2) : 1);
    body.weight = for_grip_ ? 0 : contact.weight;
    if (body.has_lo) body.lo.s = body.N - contact.lo;
    if (body.has_hi) body.hi.s = contact.hi - body.N;
    wrench_[contact.finger] += body.N * contact.normal;
    for (std::size_t k = contact.first; k < contact.last; ++k) {
      Part part{};
      part.data = &hand.parts[k];
      part.weight = for_grip_ ? 0 : part.data->weight;
      part.cone.s = {part.data->reach * body.N, Tail::Zero()};
      part.cone.u = {1 / part.cone.s.head, Tail::Zero()};
      parts_.push_back(part);
    }
    bodies_.push_back(body);
  }
  double greatest = 0;
  for (const ConeDrive<Dim>& drive : hand.drives) {
    Ray ray{};
    for (const auto& moved : drive.moved) ray.s += moved.twist.dot(wrench_[moved.finger]);
    greatest = std::max(greatest, ray.s);
    drives_.push_back(ray);
  }
  F_.s = greatest + 1;
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    const double left = (for_grip_ ? F_.s : most(a)) - drives_[a].s;
    drives_[a].s = for_grip_ ? left : std::max(left, most(a) / 2);
  }
  degree_ += static_cast<double>(parts_.size());
  for_each_ray([&](Ray& ray) {
    ray.u = 1 / ray.s;
    degree_ += 1;
  });
  for (Side* side : {&constant_, &growing_}) {
    side->x.resize(factors_.matrix().rows());
    side->N.resize(bodies_.size());
    side->t.resize(parts_.size());
  }
}

template <int Dim>
void Interior<Dim>::find_residuals() {
  std::fill(wrench_.begin(), wrench_.end(), Wrench<Dim>::Zero());
  dual_error_ = 0;
  square_ = 0;
  dual_ = y_.dot(w_);
  const auto rate = [&](std::size_t a) { return drives_[a].u; };
  std::size_t finger = hand_.fingers;
  Twist<Dim> felt = Twist<Dim>::Zero();
  for (Body& body : bodies_) {
    const ConeContact<Dim>& contact = *body.data;
    if (contact.finger != finger) felt = against(finger = contact.finger, y_, rate);
    Wrench<Dim>& wrench = wrench_[finger];
    wrench += body.N * contact.normal;
    square_ += body.weight * body.N * body.N;
    double pull = contact.normal.dot(felt) - body.weight * body.N;
    if (body.has_lo) {
      pull += body.lo.u;
      dual_ += body.lo.u * contact.lo;
    }
    if (body.has_hi) {
      pull -= body.hi.u;
      dual_ -= body.hi.u * contact.hi;
    }
    for (std::size_t k = contact.first; k < contact.last; ++k) {
      Part& part = parts_[k];
      const Tail& t = part.cone.s.tail;
      wrench += part.data->G * t;
      square_ += part.weight * t.squaredNorm();
      part.residual = part.data->G.transpose() * felt + part.cone.u.tail - part.weight * t;
      pull += part.data->reach * part.cone.u.head;
      dual_error_ = std::max(dual_error_, part.residual.template lpNorm<Eigen::Infinity>());
    }
    body.residual = pull;
    dual_error_ = std::max(dual_error_, std::abs(pull));
  }
  balance_residual_ = tau_ * w_;
  for (const Wrench<Dim>& wrench : wrench_) balance_residual_ -= wrench;
  primal_error_ = balance_residual_.template lpNorm<Eigen::Infinity>();
  F_residual_ = for_grip_ ? F_.u - tau_ : 0;
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    double effort = 0;
    for (const auto& moved : hand_.drives[a].moved)
      effort += moved.twist.dot(wrench_[moved.finger]);
    drive_residual_[a] = (for_grip_ ? F_.s : most(a) * tau_) - effort - drives_[a].s;
    primal_error_ = std::max(primal_error_, std::abs(drive_residual_[a]));
    F_residual_ += for_grip_ ? drives_[a].u : 0;
    dual_ -= drives_[a].u * most(a);
  }
  dual_error_ = std::max(dual_error_, std::abs(F_residual_));
  gap_residual_ = dual_ - (for_grip_ ? F_.s : 0) - square_ / tau_ - kappa_;
}

/// W⁻² = ([w0 -w1ᵀ]ᵀ [w0 -w1ᵀ] 2 - diag(1, -I)) / scale², of which K takes the tail's block with the
/// weight. Differences are worked out by hand: near the border of a cone they lose all digits.
template <int Dim>
void Interior<Dim>::factorise() {
  for (Square& M : M_) M.setZero();
  for (Part& part : parts_) {
    part.cone.rescale();
    const Cone<D>& cone = part.cone;
    const double per = 1 / (cone.scale * cone.scale), w1 = cone.w1.squaredNorm();
    const double p = part.weight / per, all = 1 + p + 2 * w1;
    part.over = 1 / (per * (1 + p));
    part.bend = 2 / all;
    part.corner = -2 * cone.w0 / all * part.data->reach * cone.w1;
    part.schur = per * (1 + p * (1 + 2 * w1)) / all;
  }
  for (Body& body : bodies_) {
    const ConeContact<Dim>& contact = *body.data;
    double h = body.weight;
    if (body.has_lo) h += body.lo.curvature();
    if (body.has_hi) h += body.hi.curvature();
    body.arrow = contact.normal;
    Square& M = M_[contact.finger];
    for (std::size_t k = contact.first; k < contact.last; ++k) {
      const Part& part = parts_[k];
      const auto& G = part.data->G;
      h += part.data->reach * part.data->reach * part.schur;
      body.arrow -= G * part.corner;
      const Wrench<Dim> bent = G * part.cone.w1;
      M.noalias() += part.over * (G * G.transpose());
      M.noalias() -= (part.over * part.bend) * bent * bent.transpose();
    }
    body.over = 1 / h;
    M.noalias() += body.over * body.arrow * body.arrow.transpose();
  }
  Eigen::MatrixXd& A = factors_.matrix();
  A.setZero();
  for (const Square& M : M_) A.template topLeftCorner<rows, rows>() += M;
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    const Eigen::Index row = drive_row(a);
    A(row, row) += 1 / drives_[a].curvature();
    for (const auto& moved : hand_.drives[a].moved) {
      const Wrench<Dim> felt = M_[moved.finger] * moved.twist;
      A.row(row).template head<rows>() -= felt.transpose();
      for (std::size_t b = 0; b <= a; ++b)
        for (const auto& other : hand_.drives[b].moved)
          if (other.finger == moved.finger) A(row, drive_row(b)) += felt.dot(other.twist);
    }
  }
  if (for_grip_) {
    const Eigen::Index row = A.rows() - 1;
    for (std::size_t a = 0; a < drives_.size(); ++a) A(row, drive_row(a)) = 1;
    A(row, row) = -F_.curvature();
  }
  factors_.factorise(rows + static_cast<Eigen::Index>(drives_.size()));
}

template <int Dim>
void Interior<Dim>::aim_at(double center, bool corrected) {
  for (Part& part : parts_) corrected ? part.cone.aim(center) : part.cone.aim();
  for_each_ray([&](Ray& ray) { corrected ? ray.aim(center) : ray.aim(); });
}

/// The step as far as it follows from the aims and the residuals, or per unit of tau.
template <int Dim>
void Interior<Dim>::solve(Side& side, double damping, bool of_tau) {
  std::vector<Wrench<Dim>>& wrench = wrench_;  // what contacts do before y moves
  std::fill(wrench.begin(), wrench.end(), Wrench<Dim>::Zero());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const ConeContact<Dim>& contact = *body.data;
    Wrench<Dim>& sum = wrench[contact.finger];
    double pull = of_tau ? 0 : damping * body.residual;
    if (body.has_lo) pull += body.lo.curvature() * (of_tau ? contact.lo : body.lo.d);
    if (body.has_hi) pull += body.hi.curvature() * (of_tau ? contact.hi : -body.hi.d);
    for (std::size_t k = contact.first; k < contact.last; ++k) {
      side.t[k].setZero();
      if (of_tau) continue;
      const Part& part = parts_[k];
      const Spin<D>& d = part.cone.d;
      const Tail residual = damping * part.residual - part.weight * d.tail;
      pull += part.data->reach * part.schur * d.head - part.corner.dot(residual);
      side.t[k] = part.by_K(residual) + d.head / part.data->reach * part.corner + d.tail;
      sum += part.data->G * side.t[k];
    }
    side.N[i] = body.over * pull;
    sum += side.N[i] * body.arrow;
    for (std::size_t k = contact.first; k < contact.last; ++k)
      side.t[k] -= side.N[i] * parts_[k].corner;
  }
  Eigen::VectorXd& x = side.x;
  x.template head<rows>() = of_tau ? w_ : Wrench<Dim>(damping * balance_residual_);
  for (const Wrench<Dim>& each : wrench) x.template head<rows>() -= each;
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    double aim = of_tau ? -most(a) : drives_[a].d - damping * drive_residual_[a];
    for (const auto& moved : hand_.drives[a].moved)
      aim += moved.twist.dot(wrench[moved.finger]);
    x[drive_row(a)] = aim;
  }
  if (for_grip_)
    x[x.size() - 1] = of_tau ? 1 : -damping * F_residual_ - F_.curvature() * F_.d;
  factors_.solve(x);
  follow(side, x);

  side.gap = w_.dot(x.template head<rows>());
  for (std::size_t a = 0; a < drives_.size(); ++a) side.gap -= most(a) * x[drive_row(a)];
  if (for_grip_) side.gap -= x[x.size() - 1];
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const double N = side.N[i], lo = body.data->lo, hi = body.data->hi;
    if (body.has_lo) side.gap += lo * body.lo.curvature() * ((of_tau ? lo : body.lo.d) - N);
    if (body.has_hi) side.gap -= hi * body.hi.curvature() * ((of_tau ? -hi : body.hi.d) + N);
    if (for_grip_) continue;
    side.gap -= 2 / tau_ * body.weight * body.N * N;
    for (std::size_t k = body.data->first; k < body.data->last; ++k)
      side.gap -= 2 / tau_ * parts_[k].weight * parts_[k].cone.s.tail.dot(side.t[k]);
  }
}

/// What the contacts do as y and the rates move.
template <int Dim>
void Interior<Dim>::follow(Side& side, const Eigen::VectorXd& x) const {
  const Twist<Dim> dy = x.template head<rows>();
  const auto rate = [&](std::size_t a) { return x[drive_row(a)]; };
  std::size_t finger = hand_.fingers;
  Twist<Dim> felt = Twist<Dim>::Zero();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const ConeContact<Dim>& contact = *body.data;
    if (contact.finger != finger) felt = against(finger = contact.finger, dy, rate);
    const double N = body.over * body.arrow.dot(felt);
    side.N[i] += N;
    for (std::size_t k = contact.first; k < contact.last; ++k) {
      const Part& part = parts_[k];
      side.t[k] += part.by_K(part.data->G.transpose() * felt) - N * part.corner;
    }
  }
}

/// Near the border of a cone forces along it are nearly free, and rounding of y is felt in them:
/// what is missing of the balance is solved for once more. How much it was.
template <int Dim>
double Interior<Dim>::refine(double damping) {
  std::fill(wrench_.begin(), wrench_.end(), Wrench<Dim>::Zero());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const ConeContact<Dim>& contact = *bodies_[i].data;
    Wrench<Dim>& wrench = wrench_[contact.finger];
    wrench += constant_.N[i] * contact.normal;
    for (std::size_t k = contact.first; k < contact.last; ++k)
      wrench += parts_[k].data->G * constant_.t[k];
  }
  Eigen::VectorXd& x = growing_.x;  // needed no more
  const Eigen::VectorXd& known = constant_.x;
  x.template head<rows>() = damping * balance_residual_ + dtau_ * w_;
  for (const Wrench<Dim>& wrench : wrench_) x.template head<rows>() -= wrench;
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    const Ray& drive = drives_[a];
    double missing = drive.d - damping * drive_residual_[a] - dtau_ * most(a) -
                     known[drive_row(a)] / drive.curvature();
    if (for_grip_) missing -= known[known.size() - 1];
    for (const auto& moved : hand_.drives[a].moved)
      missing += moved.twist.dot(wrench_[moved.finger]);
    x[drive_row(a)] = missing;
  }
  if (for_grip_) x[x.size() - 1] = 0;
  const double missing = x.template head<rows>().template lpNorm<Eigen::Infinity>();
  factors_.solve(x);
  follow(constant_, x);
  constant_.x += x;
  return missing;
}

/// `aim_of_tau`: of kappa dtau + tau dkappa.
template <int Dim>
void Interior<Dim>::step(double damping, double aim_of_tau, bool last) {
  solve(constant_, damping, false);
  const double gap = constant_.gap + damping * gap_residual_;
  dtau_ = (aim_of_tau - tau_ * gap) / (kappa_ + tau_ * growing_.gap + square_ / tau_);
  dkappa_ = (aim_of_tau - kappa_ * dtau_) / tau_;
  constant_.x += dtau_ * growing_.x;
  for (std::size_t i = 0; i < bodies_.size(); ++i) constant_.N[i] += dtau_ * growing_.N[i];
  for (std::size_t k = 0; k < parts_.size(); ++k) constant_.t[k] += dtau_ * growing_.t[k];
  for (int round = 0; last && round < 4; ++round)
    if (!(refine(damping) > small_residual * (tau_ + primal_error_))) break;

  const Twist<Dim> dy = constant_.x.template head<rows>();
  const auto rate = [&](std::size_t a) { return constant_.x[drive_row(a)]; };
  std::size_t finger = hand_.fingers;
  Twist<Dim> felt = Twist<Dim>::Zero();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const ConeContact<Dim>& contact = *body.data;
    if (contact.finger != finger) felt = against(finger = contact.finger, dy, rate);
    const double N = constant_.N[i];
    if (body.has_lo) body.lo.step(N - contact.lo * dtau_);
    if (body.has_hi) body.hi.step(contact.hi * dtau_ - N);
    for (std::size_t k = contact.first; k < contact.last; ++k) {
      Part& part = parts_[k];
      const Tail& t = constant_.t[k];
      part.cone.step({part.data->reach * N, t}, part.weight * t -
                                                    part.data->G.transpose() * felt -
                                                    damping * part.residual);
    }
  }
  // The rates are unknowns; their s follow.
  for (std::size_t a = 0; a < drives_.size(); ++a) {
    Ray& drive = drives_[a];
    drive.du = constant_.x[drive_row(a)];
    drive.ds = drive.d - drive.du / drive.curvature();
  }
  if (for_grip_) F_.step(constant_.x[constant_.x.size() - 1]);
}

template <int Dim>
double Interior<Dim>::way() const {
  double way = std::min(dtau_ < 0 ? -tau_ / dtau_ : infinity,
                        dkappa_ < 0 ? -kappa_ / dkappa_ : infinity);
  for (const Part& part : parts_) way = std::min(way, part.cone.way());
  const_cast<Interior*>(this)->for_each_ray([&](Ray& ray) { way = std::min(way, ray.way()); });
  return way;
}

template <int Dim>
void Interior<Dim>::go(double length) {
  y_ += length * constant_.x.template head<rows>();
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].N += length * constant_.N[i];
  for (Part& part : parts_) part.cone.go(length);
  for_each_ray([&](Ray& ray) { ray.go(length); });
  tau_ += length * dtau_;
  kappa_ += length * dkappa_;
}

template <int Dim>
Balance<Dim> Interior<Dim>::run() {
  Balance<Dim> best{};
  best.state = State::open;
  double least = infinity;
  int step_ = 0, last_better = 0;
  for (;; ++step_) {
    find_residuals();
    const double size_y = y_.template lpNorm<Eigen::Infinity>() + tau_;
    const double primal = (for_grip_ ? F_.s : square_ / 2 / tau_) / tau_;
    const double proven = for_grip_ ? dual_ / tau_ : (dual_ - square_ / 2 / tau_) / tau_;
    const double gap = std::abs(primal - proven) / std::max({primal, std::abs(proven), 1e-300});
    if (getenv("DBG")) printf("%2d p %.2e d %.2e gap %.2e tau %.2e kap %.2e primal %.6g proven %.6g\n", step_, primal_error_/tau_, dual_error_/size_y, gap, tau_, kappa_, primal, proven);
    const double error = std::max({primal_error_ / tau_, dual_error_ / size_y, gap});
    if (error < least || step_ == 0) {
      least = error;
      last_better = step_;
      best.value = primal;
      best.y = y_ / tau_;
      best.residual = balance_residual_ / tau_;
      best.rates.clear();
      for (const Ray& drive : drives_) best.rates.push_back(drive.u / tau_);
      best.normals.clear();
      best.tangentials.clear();
      for (const Body& body : bodies_) best.normals.push_back(body.N / tau_);
      for (const Part& part : parts_) best.tangentials.push_back(part.cone.s.tail / tau_);
    }
    best.steps = step_;
    if (error <= wanted_error || !(error < infinity) || step_ > last_better + patience) break;
    if (least <= good && step_ > last_better) break;
    if (least > enough && dual_ > 0 && dual_error_ + square_ <= 1e-12 * dual_ &&
        tau_ < 1e-6 * kappa_) {
      best.state = State::not_held;
      best.y = y_ / dual_;
      for (std::size_t a = 0; a < drives_.size(); ++a) best.rates[a] = drives_[a].u / dual_;
      return best;
    }
    if (step_ == most_steps) break;
    double center = tau_ * kappa_;
    for (const Part& part : parts_) center += part.cone.product();
    for_each_ray([&](const Ray& ray) { center += ray.product(); });
    center /= degree_;
    if (!(center > 1e-300)) break;

    factorise();
    aim_at(0, false);
    solve(growing_, 1, true);
    step(1, -tau_ * kappa_, false);
    const double free = std::min(1.0, way());
    const double sigma = (1 - free) * (1 - free) * (1 - free);
    const double corrected = sigma * center - tau_ * kappa_ - dtau_ * dkappa_;
    aim_at(sigma * center, true);
    step(1 - sigma, corrected, true);
    const double length = std::min(1.0, 0.99 * way());
    if (!(length > shortest_step)) break;
    go(length);
    // Nothing but ratios counts.
    if (tau_ + kappa_ > 1e100) break;
  }
  best.error = least;
  if (least <= enough) best.state = State::held;
  settle(best);
  return best;
}

/// What rounding left of the balance, by the smallest change of forces.
template <int Dim>
void Interior<Dim>::settle(Balance<Dim>& best) const {
  if (!(best.residual.template lpNorm<Eigen::Infinity>() > 1e-16)) return;
  Factors factors(rows);
  factors.matrix().setZero();
  for (const ConeContact<Dim>& contact : hand_.contacts)
    factors.matrix() += contact.normal * contact.normal.transpose();
  for (const ConePart<Dim>& part : hand_.parts) factors.matrix() += part.G * part.G.transpose();
  factors.factorise(rows);
  Eigen::VectorXd y = best.residual;
  factors.solve(y);
  const Twist<Dim> change = y;
  for (std::size_t i = 0; i < hand_.contacts.size(); ++i)
    best.normals[i] += hand_.contacts[i].normal.dot(change);
  best.residual = w_;
  for (std::size_t i = 0; i < hand_.contacts.size(); ++i)
    best.residual -= best.normals[i] * hand_.contacts[i].normal;
  for (std::size_t k = 0; k < hand_.parts.size(); ++k) {
    best.tangentials[k] += hand_.parts[k].G.transpose() * change;
    best.residual -= hand_.parts[k].G * best.tangentials[k];
  }
}

}  // namespace

template <int Dim>
Balance<Dim> balance(const ConeHand<Dim>& hand, const Wrench<Dim>& w, Wanted wanted) {
  return Interior<Dim>(hand, w, wanted).run();
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
    double power = contact.normal.dot(twist);
    for (std::size_t k = contact.first; k < contact.last; ++k)
      power += hand.parts[k].reach * (hand.parts[k].G.transpose() * twist).norm();
    result.push_back(power + rounding * size);
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
  const double size = std::max(cut.y.cwiseAbs().maxCoeff(), 1e-300);
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
template Balance<2> balance(const ConeHand<2>&, const Wrench<2>&, Wanted);
template Balance<3> balance(const ConeHand<3>&, const Wrench<3>&, Wanted);

}  // namespace poise::dual
