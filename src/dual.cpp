#include "dual.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace poise::dual {
namespace {

using Mask = long long __attribute__((vector_size(16)));

Lane lanes(double x) { return Lane{x, x}; }
double sum(Lane x) { return x[0] + x[1]; }

/// Projects every contact's z and adds up, without a branch. Two contacts a turn; docs/theory.md
/// has the three cases of the projection.
template <bool limited>
void evaluate_plane(const ScaledGrasp<2>& grasp, const Wrench<2>& w, const Twist<2>& y,
                    Point<2>& point) {
  const Lane zero = lanes(0), one = lanes(1);
  const Lane vx = lanes(y[0]), vy = lanes(y[1]), omega = lanes(y[2]);
  Lane fx{}, fy{}, fm{}, phi{};
  Lane Mxx{}, Mxy{}, Myy{}, Mxm{}, Mym{}, Mmm{};
  for (std::size_t p = 0; p < grasp.lanes.size(); ++p) {
    const ContactLane<2>& c = grasp.lanes[p];
    const Lane ux = vx + omega * c.jx, uy = vy + omega * c.jy;
    const Lane zn = c.nx * ux + c.ny * uy, zt = c.nx * uy - c.ny * ux;
    const Lane mu = zt < zero ? -c.mu : c.mu;  // t = mu n is the edge on z's side
    const Lane beside = zt < zero ? -zt : zt;
    const Lane along = (zn + mu * zt) * c.edge;  // normal force of z's projection to the edge
    Lane n, t, free;                             // free: 1 where the normal force may change
    Mask inside;
    if constexpr (limited) {
      inside = beside < c.mu * (zn < c.lo ? c.lo : zn > c.hi ? c.hi : zn);
      n = inside ? zn : along;
      free = (n > c.lo) & (n < c.hi) ? one : zero;
      n = n < c.lo ? c.lo : n > c.hi ? c.hi : n;
    } else {
      inside = beside < c.mu * zn;
      n = inside ? zn : along;
      free = n > zero ? one : zero;
      n = n > zero ? n : zero;
    }
    t = inside ? zt : mu * n;
    point.lanes[p] = {{zn, zt}, {n, t}};
    const Lane gx = n * c.nx - t * c.ny, gy = n * c.ny + t * c.nx;
    fx += gx;
    fy += gy;
    fm += gx * c.jx + gy * c.jy;
    phi += n * (zn - 0.5 * n) + t * (zt - 0.5 * t);
    // DΠ as a 2 x 2 matrix on forces along x and y.
    const Lane ex = c.nx - mu * c.ny, ey = c.ny + mu * c.nx, e = c.edge * free;
    Lane Pxx = e * ex * ex, Pxy = e * ex * ey, Pyy = e * ey * ey;
    if constexpr (limited) {
      const Lane held = one - free;
      Pxx = inside ? c.share - held * c.nx * c.nx : Pxx;
      Pxy = inside ? -held * c.nx * c.ny : Pxy;
      Pyy = inside ? c.share - held * c.ny * c.ny : Pyy;
    } else {
      Pxx = inside ? c.share : Pxx;
      Pxy = inside ? zero : Pxy;
      Pyy = inside ? c.share : Pyy;
    }
    const Lane qx = Pxx * c.jx + Pxy * c.jy, qy = Pxy * c.jx + Pyy * c.jy;
    Mxx += Pxx;
    Mxy += Pxy;
    Myy += Pyy;
    Mxm += qx;
    Mym += qy;
    Mmm += qx * c.jx + qy * c.jy;
  }
  point.y = y;
  point.residual = w - Wrench<2>(sum(fx), sum(fy), sum(fm));
  point.value = y.dot(w) - sum(phi);
  point.M(0, 0) = sum(Mxx);
  point.M(0, 1) = sum(Mxy);
  point.M(1, 1) = sum(Myy);
  point.M(0, 2) = sum(Mxm);
  point.M(1, 2) = sum(Mym);
  point.M(2, 2) = sum(Mmm);
}

}  // namespace

template <>
void evaluate<2>(const ScaledGrasp<2>& grasp, const Wrench<2>& w, const Twist<2>& y,
                 Point<2>& point) {
  if (grasp.limited)
    evaluate_plane<true>(grasp, w, y, point);
  else
    evaluate_plane<false>(grasp, w, y, point);
}

namespace {

/// x = M⁻¹ r for positive semidefinite M (upper triangle). Directions in which M vanishes get very
/// long steps instead of none.
template <int N>
Eigen::Matrix<double, N, 1> newton_step(const Eigen::Matrix<double, N, N>& M,
                                        const Eigen::Matrix<double, N, 1>& r) {
  const double least = 1e-15 * M.trace() + 1e-30;
  double U[N][N], inverse[N], x[N];  // M = Uᵀ D U
  for (int i = 0; i < N; ++i) {
    double pivot = M(i, i);
    for (int k = 0; k < i; ++k) pivot -= U[k][i] * U[k][i] * inverse[k];
    inverse[i] = 1 / std::max(pivot, least);
    x[i] = r[i];
    for (int k = 0; k < i; ++k) x[i] -= U[k][i] * inverse[k] * x[k];
    for (int j = i + 1; j < N; ++j) {
      U[i][j] = M(i, j);
      for (int k = 0; k < i; ++k) U[i][j] -= U[k][i] * inverse[k] * U[k][j];
    }
  }
  Eigen::Matrix<double, N, 1> step;
  for (int i = N - 1; i >= 0; --i) {
    step[i] = x[i];
    for (int j = i + 1; j < N; ++j) step[i] -= U[i][j] * step[j];
    step[i] *= inverse[i];
  }
  return step;
}

/// The larger of the force and the moment of a scaled wrench.
template <int Dim>
double size(const Wrench<Dim>& w) {
  return std::max(w.template head<Dim>().norm(), w.template tail<wrench_size<Dim> - Dim>().norm());
}

/// Dual to `size`: |v| + |omega|.
template <int Dim>
double length(const Twist<Dim>& y) {
  return y.template head<Dim>().norm() + y.template tail<wrench_size<Dim> - Dim>().norm();
}

template <int Dim>
double squared_norm(const Point<Dim>& point) {
  Lane sum_{};
  for (const LaneForces<Dim>& lane : point.lanes)
    for (int k = 0; k < Dim; ++k) sum_ += lane.f[k] * lane.f[k];
  return sum(sum_);
}

/// Near the limit of friction |z| is about |f|², and Π_K(z) has lost digits. The forces have not:
/// on the faces where z is, they are corrected until they balance. False if they leave their faces.
bool polish(const ScaledGrasp<2>& grasp, const Wrench<2>& w, double tolerance, Point<2>& point) {
  Point<2> trial = point;
  const double scale = std::sqrt(squared_norm(point)) + 1;
  for (int round = 0; round < 4; ++round) {
    const Twist<2> dy = newton_step<3>(trial.M, trial.residual);
    trial.y += dy;
    Wrench<2> balance = w;
    for (std::size_t i = 0; i < grasp.size; ++i) {
      const ContactLane<2>& c = grasp.lanes[i / lane_size];
      LaneForces<2>& lane = trial.lanes[i / lane_size];
      const std::size_t k = i % lane_size;
      const double ux = dy[0] + dy[2] * c.jx[k], uy = dy[1] + dy[2] * c.jy[k];
      const Vector<2> dz(c.nx[k] * ux + c.ny[k] * uy, c.nx[k] * uy - c.ny[k] * ux);
      const Face on = face(grasp, i, point.z(i));
      Vector<2> f = trial.f(i) + on.P * dz;
      // What is off its face by rounding goes back to it; by more, the face is not the right one.
      const double n = std::clamp(f[0], c.lo[k], c.hi[k]);
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
  if (size<2>(trial.residual) > std::max(delta, tolerance / 100 * scale)) return false;
  Point<2> proof = trial;
  evaluate(grasp, w, trial.y, proof);
  if (std::abs(effort - 2 * proof.value) > 1e3 * tolerance * effort) return false;
  trial.value = proof.value;
  point = trial;
  return true;
}

}  // namespace

Eigen::Matrix<double, 3, 2> columns(const ScaledGrasp<2>& grasp, std::size_t contact) {
  const ContactLane<2>& c = grasp.lanes[contact / lane_size];
  const std::size_t k = contact % lane_size;
  Eigen::Matrix<double, 3, 2> G;
  G << c.nx[k], -c.ny[k], c.ny[k], c.nx[k], c.nx[k] * c.jx[k] + c.ny[k] * c.jy[k],
      c.nx[k] * c.jy[k] - c.ny[k] * c.jx[k];
  return G;
}

Face face(const ScaledGrasp<2>& grasp, std::size_t contact, const Vector<2>& z) {
  const ContactLane<2>& c = grasp.lanes[contact / lane_size];
  const std::size_t k = contact % lane_size;
  const double lo = c.lo[k], hi = c.hi[k], mu = c.mu[k];
  Face face{};
  face.sign = z[1] < 0 ? -1 : 1;
  face.edge = !(std::abs(z[1]) < mu * std::clamp(z[0], lo, hi));
  const double n = face.edge ? (z[0] + mu * std::abs(z[1])) * c.edge[k] : z[0];
  face.at_lo = !(n > lo);
  face.at_hi = !face.at_lo && !(n < hi);
  const bool free = !face.at_lo && !face.at_hi;
  const double held = face.at_lo ? lo : hi;
  const Vector<2> edge(1, face.sign * mu);
  if (face.edge) {
    face.P = (free ? c.edge[k] : 0) * edge * edge.transpose();
    face.f0 = free ? Vector<2>(0, 0) : Vector<2>(held * edge);
  } else {
    face.P << (free ? 1 : 0), 0, 0, 1;
    face.f0 = Vector<2>(free ? 0 : held, 0);
  }
  return face;
}

template <int Dim>
double lower_bound(const Point<Dim>& point) {
  return 2 * (point.value - delta * length<Dim>(point.y));
}

namespace {

/// Two planar contacts have one internal force alpha f_N, along the line between them. Clamped to
/// the cones from 0 (the paper's equation (12) with alpha-bar), it gives the forces; y follows from
/// the constraint it stops at.
Twist<2> cold_start_two(const ScaledGrasp<2>& grasp, const Wrench<2>& w) {
  const Twist<2> y = grasp.inverse * w;
  const ContactLane<2>& c = grasp.lanes[0];
  Vector<2> line(c.jy[1] - c.jy[0], c.jx[0] - c.jx[1]);  // from contact 0 to contact 1
  double least = -std::numeric_limits<double>::infinity(), greatest = -least;
  double stop_least = 0, stop_greatest = 0;  // rates of the constraints at which alpha stops
  Vector<2> at_least(0, 0), at_greatest(0, 0);
  int i_least = 0, i_greatest = 0;
  double norm = 0;
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1 : -1, share = c.share[i];
    const double ux = y[0] + y[2] * c.jx[i], uy = y[1] + y[2] * c.jy[i];
    const double n = c.nx[i] * ux + c.ny[i] * uy, t = c.nx[i] * uy - c.ny[i] * ux;
    const double dn = sign * (c.nx[i] * line.x() + c.ny[i] * line.y()) / share;
    const double dt = sign * (c.nx[i] * line.y() - c.ny[i] * line.x()) / share;
    norm += dn * dn + dt * dt;
    const auto constrain = [&](double value, double rate, double an, double at) {
      if (rate == 0) return;
      const double alpha = -value / rate;
      if (rate > 0 && alpha > least) {
        least = alpha;
        stop_least = rate;
        at_least = {an, at};
        i_least = i;
      } else if (rate < 0 && alpha < greatest) {
        greatest = alpha;
        stop_greatest = rate;
        at_greatest = {an, at};
        i_greatest = i;
      }
    };
    constrain(c.mu[i] * n - t, c.mu[i] * dn - dt, c.mu[i], -1);
    constrain(c.mu[i] * n + t, c.mu[i] * dn + dt, c.mu[i], 1);
    if (grasp.limited) {
      constrain(n - c.lo[i], dn, 1, 0);
      constrain(c.hi[i] - n, -dn, -1, 0);
    }
  }
  const bool press = least > 0;
  if (!(least <= greatest) || (!press && !(greatest < 0))) return y;
  const double lambda = press ? least * norm / stop_least : greatest * norm / stop_greatest;
  const int i = press ? i_least : i_greatest;
  const Vector<2> a = press ? at_least : at_greatest;
  const double gx = a[0] * c.nx[i] - a[1] * c.ny[i], gy = a[0] * c.ny[i] + a[1] * c.nx[i];
  const Twist<2> clamped =
      y - grasp.inverse * (lambda * Wrench<2>(gx, gy, gx * c.jx[i] + gy * c.jy[i]));
  return length<2>(clamped) < 1e7 ? clamped : y;  // contacts at one point have no line between them
}

}  // namespace

template <>
Twist<2> cold_start<2>(const ScaledGrasp<2>& grasp, const Wrench<2>& w) {
  if (grasp.size == 2) return cold_start_two(grasp, w);
  return grasp.inverse * w;
}

namespace {

enum class Rise { none, some, proof };

/// Goes from y along d, of length 1, as far as a proof that nothing holds needs: `far` is it, if it
/// is one.
template <int Dim>
Rise prove(const ScaledGrasp<Dim>& grasp, const Wrench<Dim>& w, const Twist<Dim>& y,
           const Twist<Dim>& d, double force_cap, Point<Dim>& far) {
  // Far out, but not so far that rounding in G^T d makes itself felt as a force.
  evaluate<Dim>(grasp, w, 1e13 * d, far);
  const double rise = far.residual.dot(d) - delta;
  if (rise <= 0) return Rise::none;
  evaluate<Dim>(grasp, w, y + 2 * force_cap * force_cap / rise * d, far);
  return lower_bound(far) > force_cap * force_cap ? Rise::proof : Rise::some;
}

/// maximise() with a y of its own in the unholdable case: any that proves it. With rho > 0 it
/// maximises value − ½ rho |y|² instead, whose y is bounded: (w − G f) / rho.
template <int Dim>
bool ascend(const ScaledGrasp<Dim>& grasp, const Wrench<Dim>& w, const Twist<Dim>& start,
            double force_cap, double rho, Point<Dim>& point) {
  constexpr int rows = wrench_size<Dim>;
  const double unholdable = force_cap * force_cap;
  const auto above_cap = [&] {
    return 2 * point.value > unholdable && lower_bound(point) > unholdable;
  };
  bool settled = false, unbounded = false;
  const auto evaluate_at = [&](const Twist<Dim>& y) {
    evaluate<Dim>(grasp, w, y, point);
    if (rho == 0) return;
    point.value -= rho / 2 * y.squaredNorm();
    point.residual -= rho * y;
    point.M.diagonal().array() += rho;
  };
  evaluate_at(start);
  // Where steps are cut short by changing faces, the step heeds the faces passed before, too: else
  // it zigzags between them near the limit of holding.
  Square<Dim> curvature = point.M;
  for (int step = 0; step < 100; ++step) {
    const double error = size<Dim>(point.residual);
    if (above_cap()) return false;
    if (error <= 1e-13 && std::abs(point.y.dot(point.residual)) <= 1e-12 * std::abs(point.value))
      return true;
    if (rho > 0 && error <= 1e-12 + 1e-14 * length<Dim>(point.y)) return true;
    if (rho == 0 && (settled || error <= delta / 2 + 1e-14 * length<Dim>(point.y)) &&
        polish(grasp, w, 1e-13, point))
      return !above_cap();
    if (unbounded && error <= delta) return true;

    Twist<Dim> dy = newton_step<rows>(curvature, point.residual);
    const double reach = 100 * (1 + length<Dim>(point.y)), stretch = length<Dim>(dy);
    if (stretch > reach) {
      curvature.diagonal().array() += point.residual.norm() / reach;
      dy = newton_step<rows>(curvature, point.residual);
    }
    const double before = point.value, slope = point.residual.dot(dy);
    double least = 0, most = 1, a = 1, slope_there = 0;
    const Twist<Dim> y = point.y;
    for (int trial = 0; trial < 60; ++trial) {
      evaluate_at(y + a * dy);
      slope_there = point.residual.dot(dy);
      if (trial == 0 && point.value - before >= 0.1 * slope) break;  // the full step will do
      // Else stop where the slope vanishes: it falls with a, piecewise linearly.
      if (std::abs(slope_there) <= 1e-9 * slope || most - least <= 1e-15 * most) break;
      (slope_there > 0 ? least : most) = a;
      a += slope_there / dy.dot(point.M.template selfadjointView<Eigen::Upper>() * dy);
      if (!(a > least && a < most)) a = (least + most) / 2;
    }
    const bool cut = a < 1;
    settled = !cut && std::abs(slope_there) <= 1e-6 * slope;
    // Still rising where every step is long: does it rise for ever?
    if (rho == 0 && stretch > reach && slope_there > 0.5 * slope) {
      Point<Dim> far = point;
      const Rise rise = prove<Dim>(grasp, w, point.y, dy / length<Dim>(dy), force_cap, far);
      if (rise == Rise::proof) {
        point = far;
        return false;
      }
      unbounded = rise == Rise::none;
    }
    curvature = cut ? Square<Dim>(point.M + 0.5 * curvature) : point.M;
  }
  // Within rounding of the limit of holding there is neither a proof nor a balance within delta:
  // what rounding of such large forces leaves is a balance.
  return size<Dim>(point.residual) <= delta || (rho == 0 && polish(grasp, w, 1e-9, point));
}

}  // namespace

namespace {

/// Replaces a proof that nothing holds by the sharpest: the direction from what can be balanced to
/// w. It is normal to the faces on which the nearest balance lies, and so the same for all loads
/// near this one, up to the limit of holding.
void sharpen(const ScaledGrasp<2>& grasp, const Wrench<2>& w, double force_cap, Point<2>& point) {
  Point<2> nearest = point;
  if (!ascend<2>(grasp, w, Twist<2>::Zero(), std::numeric_limits<double>::infinity(), 1e-6,
                 nearest))
    return;
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  Wrench<2> beyond = w;
  for (std::size_t i = 0; i < grasp.size; ++i) {
    const Eigen::Matrix<double, 3, 2> G = columns(grasp, i);
    const Face on = face(grasp, i, nearest.z(i));
    M += G * on.P * G.transpose();
    beyond -= G * on.f0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(M);
  Twist<2> d = Twist<2>::Zero();
  for (int k = 0; k < 3; ++k)
    if (eigen.eigenvalues()[k] <= 1e-9 * M.trace())
      d += eigen.eigenvectors().col(k).dot(beyond) * eigen.eigenvectors().col(k);
  if (!(length<2>(d) > 0)) return;
  d /= length<2>(d);
  if (prove<2>(grasp, w, Twist<2>::Zero(), d, force_cap, nearest) == Rise::proof) point = nearest;
}

}  // namespace

template <>
bool maximise<2>(const ScaledGrasp<2>& grasp, const Wrench<2>& w, const Twist<2>& start,
                 double force_cap, Point<2>& point) {
  if (ascend<2>(grasp, w, start, force_cap, 0, point)) return true;
  sharpen(grasp, w, force_cap, point);
  return false;
}

template double lower_bound<2>(const Point<2>&);

}  // namespace poise::dual
