#include "dual/dual.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "dual/ascend.hpp"

namespace poise::dual {
namespace {

/// Projects every contact's z and adds up, without a branch. docs/theory.md has the cases of the
/// projection; the largest of what they give is right: where z is inside the cone, its projection
/// to the edge presses less.
template <bool limited, class T>
void evaluate_plane(const Cones<2, T>& cones, const Screw<2, T>& w, const Screw<2, T>& y,
                    Point<2, T>& point) {
  using L = LaneOf<T>;
  const L vx = all(y[0]), vy = all(y[1]), omega = all(y[2]);
  L fx{}, fy{}, fm{}, phi{};
  LaneForces<2, T>* forces = point.lanes.data();
  for (const ContactLane<2, T>& c : cones.lanes) {
    const L ux = vx + omega * c.jx, uy = vy + omega * c.jy;
    const L zn = c.nx * ux + c.ny * uy, zt = c.nx * uy - c.ny * ux;
    const L beside = magnitude(zt);
    const L along = (zn + c.mu * beside) * c.edge;  // normal force of z's projection to the edge
    L n = larger(zn, along);
    if constexpr (limited)
      n = smaller(larger(n, cones.scaled(c.lo)), cones.scaled(c.hi));
    else
      n = larger(n, L{});
    const L t = with_sign_of(zt, smaller(beside, L(c.mu * n)));
    *forces++ = {{zn, zt}, {n, t}};
    const L gx = n * c.nx - t * c.ny, gy = n * c.ny + t * c.nx;
    fx += gx;
    fy += gy;
    fm += gx * c.jx + gy * c.jy;
    if constexpr (limited)
      phi += n * (zn - 0.5 * n) + t * (zt - 0.5 * t);
    else
      phi += n * n + t * t;  // f and z - f are perpendicular
  }
  if constexpr (!limited) phi *= all(T(0.5));
  point.y = y;
  point.residual = w - Screw<2, T>(sum(fx), sum(fy), sum(fm));
  point.value = y.dot(w) - sum(phi);
}

template <bool limited, class T>
Square<2, T> curvature_plane(const Cones<2, T>& cones, const Point<2, T>& point) {
  using L = LaneOf<T>;
  const L zero{};
  L Mxx{}, Mxy{}, Myy{}, Mxm{}, Mym{}, Mmm{};
  // Adds e times the outer product of the wrench of a force at the contact.
  const auto add = [&](const ContactLane<2, T>& c, const L& e, const L& x, const L& y) {
    const L m = x * c.jx + y * c.jy, ex = e * x, ey = e * y;
    Mxx += ex * x;
    Mxy += ex * y;
    Myy += ey * y;
    Mxm += ex * m;
    Mym += ey * m;
    Mmm += e * m * m;
  };
  const LaneForces<2, T>* forces = point.lanes.data();
  for (const ContactLane<2, T>& c : cones.lanes) {
    const L zt = forces->z[1], n = forces->f[0];
    ++forces;
    const auto inside = magnitude(zt) < c.mu * n;
    L free = c.edge;  // neither at its least nor at its greatest
    if constexpr (limited)
      free = n > cones.scaled(c.lo) ? (n < cones.scaled(c.hi) ? free : zero) : zero;
    else
      free = n > zero ? free : zero;
    // Inside, forces along x and y; on the edge those along it.
    const L share = inside ? c.share : zero, sx = share * c.jx, sy = share * c.jy;
    Mxx += share;
    Myy += share;
    Mxm += sx;
    Mym += sy;
    Mmm += sx * c.jx + sy * c.jy;
    const L mu = with_sign_of(zt, c.mu);
    add(c, inside ? zero : free, c.nx - mu * c.ny, c.ny + mu * c.nx);
    if constexpr (limited) {  // at a limit not those along the normal
      const L held = free > zero ? zero : all(T(-1));
      add(c, inside ? held : zero, c.nx, c.ny);
    }
  }
  Square<2, T> M;
  M << sum(Mxx), sum(Mxy), sum(Mxm), T(0), sum(Myy), sum(Mym), T(0), T(0), sum(Mmm);
  return M;
}

}  // namespace

template <class T>
Square<2, T> curvature(const Cones<2, T>& cones, const Point<2, T>& point) {
  return cones.limited ? curvature_plane<true>(cones, point) : curvature_plane<false>(cones, point);
}

template <int Dim, class T>
void evaluate(const Cones<Dim, T>& cones, const Screw<Dim, T>& w, const Screw<Dim, T>& y,
              Point<Dim, T>& point) {
  if (cones.limited)
    evaluate_plane<true>(cones, w, y, point);
  else
    evaluate_plane<false>(cones, w, y, point);
}

/// x = M⁻¹ r for positive semidefinite M (upper triangle), by M = UᵀDU without divisions on the
/// way. Directions in which M vanishes get very long steps instead of none.
template <class T>
Screw<2, T> newton_step(const Square<2, T>& M, const Screw<2, T>& r) {
  // A pivot is known to within rounding of its own diagonal entry.
  constexpr double rounding = 4.5 * rounding_of<T>, least = rounding * rounding;
  const T a = std::max(M(0, 0), T(least));
  const T aM = a * M(1, 1);
  const T b = std::max<T>(aM - M(0, 1) * M(0, 1), rounding * aM + least * a);
  const T c = a * M(1, 2) - M(0, 1) * M(0, 2);
  const T baM = b * a * M(2, 2);
  const T d = std::max<T>(baM - b * M(0, 2) * M(0, 2) - c * c, rounding * baM + least * a * b);
  const T ra = 1 / a, rb = 1 / b, rd = 1 / d;
  const T r1 = a * r[1] - M(0, 1) * r[0], r2 = b * (a * r[2] - M(0, 2) * r[0]) - c * r1;
  Screw<2, T> x;
  x[2] = r2 * rd;
  x[1] = (r1 - c * x[2]) * rb;
  x[0] = (r[0] - M(0, 1) * x[1] - M(0, 2) * x[2]) * ra;
  return x;
}

template <class T>
T quadratic(const Square<2, T>& M, const Screw<2, T>& x) {
  return x[0] * (M(0, 0) * x[0] + 2 * (M(0, 1) * x[1] + M(0, 2) * x[2])) +
         x[1] * (M(1, 1) * x[1] + 2 * M(1, 2) * x[2]) + M(2, 2) * x[2] * x[2];
}

/// On the faces where z is, the forces are corrected until they balance. False if they leave their
/// faces.
bool polish(const Cones<2>& cones, const Wrench<2>& w, double tolerance, Point<2>& point) {
  Point<2> trial = point;
  const Square<2, double> M = curvature(cones, point);
  const double scale = std::sqrt(squared_norm(point)) + 1;
  for (int round = 0; round < 4; ++round) {
    const Twist<2> dy = newton_step(M, trial.residual);
    trial.y += dy;
    Wrench<2> balance = w;
    for (std::size_t i = 0; i < cones.size; ++i) {
      const ContactLane<2>& c = cones.lanes[i / lane_size];
      LaneForces<2, double>& lane = trial.lanes[i / lane_size];
      const std::size_t k = i % lane_size;
      const double ux = dy[0] + dy[2] * c.jx[k], uy = dy[1] + dy[2] * c.jy[k];
      const Vector<2> dz(c.nx[k] * ux + c.ny[k] * uy, c.nx[k] * uy - c.ny[k] * ux);
      const Face<> on = face<double>(cones, i, point.z(i));
      Vector<2> f = trial.f(i) + on.P * dz;
      // What is off its face by rounding goes back to it; by more, the face is not the right one.
      const double n = std::clamp(f[0], cones.scaled(c.lo[k]), cones.scaled(c.hi[k]));
      const double t = std::clamp(f[1], -c.mu[k] * n, c.mu[k] * n);
      if (std::abs(n - f[0]) > tolerance * scale || std::abs(t - f[1]) > tolerance * scale)
        return false;
      f = {n, on.edge ? on.sign * c.mu[k] * n : t};
      lane.f[0][k] = f[0];
      lane.f[1][k] = f[1];
      lane.z[0][k] += dz[0];
      lane.z[1][k] += dz[1];
      const double gx = f[0] * c.nx[k] - f[1] * c.ny[k], gy = f[0] * c.ny[k] + f[1] * c.nx[k];
      balance -= Wrench<2>(gx, gy, gx * c.jx[k] + gy * c.jy[k]);
    }
    trial.residual = balance;
  }
  const double effort = squared_norm(trial);
  if (size<2, double>(trial.residual) > std::max(0.5 * delta, 1e-15 * scale)) return false;
  Point<2> proof = trial;
  evaluate<2, double>(cones, w, trial.y, proof);
  if (std::abs(effort - 2 * proof.value) > 1e3 * tolerance * effort) return false;
  trial.value = proof.value;
  point = trial;
  return true;
}

template <class T>
Eigen::Matrix<T, 3, 2> columns(const Cones<2, T>& cones, std::size_t contact) {
  const ContactLane<2, T>& c = cones.lanes[contact / lane_size_of<T>];
  const std::size_t k = contact % lane_size_of<T>;
  const T nx = element(c.nx, k), ny = element(c.ny, k), jx = element(c.jx, k),
          jy = element(c.jy, k);
  Eigen::Matrix<T, 3, 2> G;
  G << nx, -ny, ny, nx, nx * jx + ny * jy, nx * jy - ny * jx;
  return G;
}

template <class T>
Face<T> face(const T& mu, const T& edge, const T& lo, const T& hi,
             const Eigen::Matrix<T, 2, 1>& z) {
  const T beside = z[1] < 0 ? -z[1] : z[1], zero = 0, one = 1;
  Face<T> face{};
  face.sign = z[1] < 0 ? -1 : 1;
  face.edge = !(beside < mu * std::clamp(z[0], lo, hi));
  const T n = face.edge ? (z[0] + mu * beside) * edge : z[0];
  face.at_lo = !(n > lo);
  face.at_hi = !face.at_lo && !(n < hi);
  const bool free = !face.at_lo && !face.at_hi;
  const T held = face.at_lo ? lo : hi;
  const Eigen::Matrix<T, 2, 1> along(one, face.sign * mu);
  if (face.edge) {
    face.P = (free ? edge : zero) * along * along.transpose();
    face.f0 = (free ? zero : held) * along;
  } else {
    face.P << (free ? one : zero), zero, zero, one;
    face.f0 << (free ? zero : held), zero;
  }
  return face;
}

namespace {

/// Two planar contacts have one internal force alpha f_N, along the line between them. Clamped to
/// the cones from 0 (the paper's alpha-bar), it gives the forces; y follows from the edge at which
/// it stops.
Twist<2> cold_start_two(const Problem<2>& problem, const Wrench<2>& w) {
  const Twist<2> y = problem.hand.inverse * w;
  const ContactLane<2>& c = problem.lanes[0];
  // Forces of the two contacts without internal force.
  const auto pair = [](const Lane& x) { return Pair{x[0], x[1]}; };
  const Pair nx = pair(c.nx), ny = pair(c.ny), mu = pair(c.mu);
  const Pair ux = y[0] + y[2] * pair(c.jx), uy = y[1] + y[2] * pair(c.jy);
  const Pair n = nx * ux + ny * uy, t = nx * uy - ny * ux;
  // mu n -+ t >= 0 of both contacts bound alpha from below where it grows with alpha, else from
  // above.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Pair zero{}, none = {infinity, infinity};
  Pair from[2], to[2];
  for (int side = 0; side < 2; ++side) {
    const Pair per_margin = problem.hand.internal.per_margin[side];
    const Pair alpha = ((side == 0 ? t : -t) - mu * n) * per_margin;
    from[side] = per_margin > zero ? alpha : -none;
    to[side] = per_margin < zero ? alpha : none;
  }
  const Pair froms = larger(from[0], from[1]), tos = smaller(to[0], to[1]);
  const double least = std::max(froms[0], froms[1]), greatest = std::min(tos[0], tos[1]);
  const double alpha = std::min(std::max(0.0, least), greatest);
  if (alpha == 0 || !(least <= greatest)) return y;
  const Pair* const stops = alpha > 0 ? from : to;
  const int i = stops[0][0] == alpha || stops[1][0] == alpha ? 0 : 1;
  const int side = stops[0][i] == alpha ? 0 : 1;
  const double lambda = alpha * problem.hand.internal.square * problem.hand.internal.per_margin[side][i];
  const double an = lambda * c.mu[i], at = side == 0 ? -lambda : lambda;
  const double gx = an * c.nx[i] - at * c.ny[i], gy = an * c.ny[i] + at * c.nx[i];
  const Twist<2> clamped = y - problem.hand.inverse * Wrench<2>(gx, gy, gx * c.jx[i] + gy * c.jy[i]);
  // Contacts at one point have no line between them.
  return span(clamped) < 1e7 ? clamped : y;
}

}  // namespace

template <>
Twist<2> cold_start<2>(const Problem<2>& problem, const Wrench<2>& w) {
  if (in_closed_form(problem)) return cold_start_two(problem, w);
  return problem.hand.inverse * w;
}

namespace {

/// From the y that is pulled towards 0 by rho: the direction from what can be balanced to w, as a
/// proof that nothing holds. It is normal to the faces on which the nearest balance lies, and so
/// the same for all loads near this one, up to the limit of holding.
bool separate(const Problem<2>& problem, const Wrench<2>& w, double force_cap,
              const Point<2>& pulled, Point<2>& proof) {
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  Wrench<2> beyond = w;
  for (std::size_t i = 0; i < problem.size; ++i) {
    const Eigen::Matrix<double, 3, 2> G = columns<double>(problem, i);
    const Face<> on = face<double>(problem, i, pulled.z(i));
    M += G * on.P * G.transpose();
    beyond -= G * on.f0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(M);
  Twist<2> d = Twist<2>::Zero();
  for (int k = 0; k < 3; ++k)
    if (eigen.eigenvalues()[k] <= 1e-9 * M.trace())
      d += eigen.eigenvectors().col(k).dot(beyond) * eigen.eigenvectors().col(k);
  if (!(length<2, double>(d) > 0)) return false;
  d /= length<2, double>(d);
  Point<2> far = pulled;
  if (prove<2, double>(problem, w, Twist<2>::Zero(), d, force_cap, far) != Rise::proof) return false;
  proof = far;
  return true;
}

/// The solution in wide numbers, rounded.
void round_to(const Problem<2>& problem, const Wrench<2>& w, const Point<2, Wide>& wide,
              Point<2>& point) {
  evaluate<2, double>(problem, w, wide.y.cast<double>(), point);
  point.residual = w;
  for (std::size_t i = 0; i < problem.size; ++i) {
    LaneForces<2, double>& lane = point.lanes[i / lane_size];
    const Vector<2> f = wide.f(i).cast<double>(), z = wide.z(i).cast<double>();
    for (int k = 0; k < 2; ++k) {
      lane.f[k][i % lane_size] = f[k];
      lane.z[k][i % lane_size] = z[k];
    }
    point.residual -= columns<double>(problem, i) * f;
  }
}

}  // namespace

bool decide(const Cones<2, Wide>& cones, const Wrench<2>& w, double force_cap,
            Point<2, Wide>& point) {
  const Screw<2, Wide> load = w.cast<Wide>();
  point.y.setZero();
  // A pull towards y = 0 that fades away: y is bounded whether w can be held or not.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::optional<Point<2, Wide>> within;  // the first, with the shortest y, that is within delta
  for (double rho = 1e-6; rho > 1e-27; rho *= 1e-5) {
    ascend<2, Wide>(cones, load, Screw<2, Wide>(point.y), infinity, rho, point);
    const Wide missing = size<2, Wide>(point.residual + Wide(rho) * point.y);
    if (missing <= 0.9 * delta && !within) within = point;
    if (missing <= 1e-3 * delta) {
      within = point;
      break;
    }
  }
  if (within) {
    point = *within;
    return squared_norm(point) <= force_cap * force_cap;
  }
  // y points from what can be balanced to w.
  const Screw<2, Wide> d = point.y / length<2, Wide>(point.y);
  prove<2, Wide>(cones, load, Screw<2, Wide>::Zero(), d, force_cap, point);
  return false;
}

template <>
bool maximise<2>(const Problem<2>& problem, const Wrench<2>& w, const Twist<2>& start,
                 double force_cap, Point<2>& point) {
  // A proof that a neighbour cannot be held is too long to start from.
  const bool near = span(start) < 1e8;
  if (climb<2>(problem, w, near ? start : cold_start<2>(problem, w), force_cap, 0, point)) return true;
  // A pull towards y = 0 gives the sharpest proof.
  Point<2> pulled = point;
  climb<2>(problem, w, Twist<2>::Zero(), std::numeric_limits<double>::infinity(), 1e-6, pulled);
  if (separate(problem, w, force_cap, pulled, point)) return false;
  if (lower_bound(point) > force_cap * force_cap) return false;
  Point<2, Wide> wide(problem.size);
  const bool holdable = decide(Widened<2>(problem).cones(), w, force_cap, wide);
  if (holdable)
    round_to(problem, w, wide, point);
  else
    evaluate<2, double>(problem, w, wide.y.cast<double>(), point);
  return holdable;
}

template void evaluate<2, double>(const Cones<2>&, const Wrench<2>&, const Twist<2>&, Point<2>&);
template Eigen::Matrix<double, 3, 2> columns(const Cones<2>&, std::size_t);
template Eigen::Matrix<Wide, 3, 2> columns(const Cones<2, Wide>&, std::size_t);
template Face<double> face(const double&, const double&, const double&, const double&,
                           const Vector<2>&);
template Face<Wide> face(const Wide&, const Wide&, const Wide&, const Wide&,
                         const Eigen::Matrix<Wide, 2, 1>&);
template double lower_bound(const Point<2>&);

}  // namespace poise::dual
