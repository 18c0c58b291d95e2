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

/// Projects every contact's z and adds up, without a branch. docs/theory.md has the three cases of
/// the projection.
template <bool limited>
void evaluate_plane(const ScaledGrasp<2>& grasp, const Wrench<2>& w, const Twist<2>& y,
                    Point<2>& point) {
  const Lane zero{};
  const Lane vx = lanes(y[0]), vy = lanes(y[1]), omega = lanes(y[2]);
  Lane fx{}, fy{}, fm{}, phi{};
  for (std::size_t p = 0; p < grasp.lanes.size(); ++p) {
    const ContactLane<2>& c = grasp.lanes[p];
    const Lane ux = vx + omega * c.jx, uy = vy + omega * c.jy;
    const Lane zn = c.nx * ux + c.ny * uy, zt = c.nx * uy - c.ny * ux;
    const Lane mu = zt < zero ? -c.mu : c.mu;  // t = mu n is the edge on z's side
    const Lane beside = zt < zero ? -zt : zt;
    const Lane along = (zn + mu * zt) * c.edge;  // normal force of z's projection to the edge
    Lane n;
    Mask inside;
    if constexpr (limited) {
      inside = beside < c.mu * (zn < c.lo ? c.lo : zn > c.hi ? c.hi : zn);
      n = inside ? zn : along;
      n = n < c.lo ? c.lo : n > c.hi ? c.hi : n;
    } else {
      inside = beside < c.mu * zn;
      n = inside ? zn : along;
      n = n > zero ? n : zero;
    }
    const Lane t = inside ? zt : mu * n;
    point.lanes[p] = {{zn, zt}, {n, t}};
    const Lane gx = n * c.nx - t * c.ny, gy = n * c.ny + t * c.nx;
    fx += gx;
    fy += gy;
    fm += gx * c.jx + gy * c.jy;
    phi += n * (zn - 0.5 * n) + t * (zt - 0.5 * t);
  }
  point.y = y;
  point.residual = w - Wrench<2>(sum(fx), sum(fy), sum(fm));
  point.value = y.dot(w) - sum(phi);
}

template <bool limited>
Eigen::Matrix3d curvature_plane(const ScaledGrasp<2>& grasp, const Point<2>& point) {
  const Lane zero{}, one = lanes(1);
  Lane Mxx{}, Mxy{}, Myy{}, Mxm{}, Mym{}, Mmm{};
  for (std::size_t p = 0; p < grasp.lanes.size(); ++p) {
    const ContactLane<2>& c = grasp.lanes[p];
    const Lane zt = point.lanes[p].z[1], n = point.lanes[p].f[0];
    const Lane mu = zt < zero ? -c.mu : c.mu;
    const Mask inside = (zt < zero ? -zt : zt) < c.mu * n;
    const Mask free = limited ? (n > c.lo) & (n < c.hi) : n > zero;
    // DΠ as a 2 x 2 matrix on forces along x and y: 1 inside, the edge's direction on the edge.
    const Lane ex = c.nx - mu * c.ny, ey = c.ny + mu * c.nx, e = free ? c.edge : zero;
    Lane Pxx = e * ex * ex, Pxy = e * ex * ey, Pyy = e * ey * ey;
    if constexpr (limited) {
      const Lane held = free ? zero : one;
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
  Eigen::Matrix3d M;
  M << sum(Mxx), sum(Mxy), sum(Mxm), 0, sum(Myy), sum(Mym), 0, 0, sum(Mmm);
  return M;
}

/// G DΠ_K Gᵀ, upper triangle: minus the generalised Hessian of the dual function.
Eigen::Matrix3d curvature(const ScaledGrasp<2>& grasp, const Point<2>& point) {
  return grasp.limited ? curvature_plane<true>(grasp, point) : curvature_plane<false>(grasp, point);
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

/// x = M⁻¹ r for positive semidefinite M (upper triangle), by M = UᵀDU without divisions on the
/// way. Directions in which M vanishes get very long steps instead of none.
Twist<2> newton_step(const Eigen::Matrix3d& M, const Wrench<2>& r) {
  // A pivot is known to within rounding of its own diagonal entry.
  constexpr double rounding = 1e-15, least = 1e-30;
  const double a = std::max(M(0, 0), least);
  const double aM = a * M(1, 1);
  const double b = std::max(aM - M(0, 1) * M(0, 1), rounding * aM + least * a);
  const double c = a * M(1, 2) - M(0, 1) * M(0, 2);
  const double baM = b * a * M(2, 2);
  const double d = std::max(baM - b * M(0, 2) * M(0, 2) - c * c, rounding * baM + least * a * b);
  const double ra = 1 / a, rb = 1 / b, rd = 1 / d;
  const double r1 = a * r[1] - M(0, 1) * r[0], r2 = b * (a * r[2] - M(0, 2) * r[0]) - c * r1;
  Twist<2> x;
  x[2] = r2 * rd;
  x[1] = (r1 - c * x[2]) * rb;
  x[0] = (r[0] - M(0, 1) * x[1] - M(0, 2) * x[2]) * ra;
  return x;
}

double quadratic(const Eigen::Matrix3d& M, const Twist<2>& x) {
  return x[0] * (M(0, 0) * x[0] + 2 * (M(0, 1) * x[1] + M(0, 2) * x[2])) +
         x[1] * (M(1, 1) * x[1] + 2 * M(1, 2) * x[2]) + M(2, 2) * x[2] * x[2];
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

/// A length for comparisons.
template <int Dim>
double span(const Eigen::Matrix<double, Dim, 1>& y) {
  return y.cwiseAbs().sum();
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
  const Eigen::Matrix3d M = curvature(grasp, point);
  const double scale = std::sqrt(squared_norm(point)) + 1;
  for (int round = 0; round < 4; ++round) {
    const Twist<2> dy = newton_step(M, trial.residual);
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
  if (size<2>(trial.residual) > std::max(delta, 1e-15 * scale)) return false;
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
/// the cones from 0 (the paper's alpha-bar), it gives the forces; y follows from the edge at which
/// it stops.
Twist<2> cold_start_two(const ScaledGrasp<2>& grasp, const Wrench<2>& w) {
  const Twist<2> y = grasp.inverse * w;
  const ContactLane<2>& c = grasp.lanes[0];
  // Forces of the two contacts without internal force, and the internal force.
  const Lane ux = y[0] + y[2] * c.jx, uy = y[1] + y[2] * c.jy;
  const Lane n = c.nx * ux + c.ny * uy, t = c.nx * uy - c.ny * ux;
  const double x = c.jy[1] - c.jy[0], z = c.jx[0] - c.jx[1];  // from contact 0 to contact 1
  const Lane dx = Lane{x, -x} / c.share, dz = Lane{z, -z} / c.share;
  const Lane dn = c.nx * dx + c.ny * dz, dt = c.nx * dz - c.ny * dx;
  // mu n -+ t >= 0 of both contacts: alpha >= -value / rate where the rate is positive, <=
  // elsewhere.
  const Lane rates[2] = {c.mu * dn - dt, c.mu * dn + dt};
  const Lane alphas[2] = {(t - c.mu * n) / rates[0], (-t - c.mu * n) / rates[1]};
  double least = -std::numeric_limits<double>::infinity(), greatest = -least;
  int at_least = 0, at_greatest = 0;
  for (int k = 0; k < 4; ++k) {
    const double alpha = alphas[k / 2][k % 2], rate = rates[k / 2][k % 2];
    const bool above = rate > 0 && alpha > least, below = rate < 0 && alpha < greatest;
    least = above ? alpha : least;
    at_least = above ? k : at_least;
    greatest = below ? alpha : greatest;
    at_greatest = below ? k : at_greatest;
  }
  const double alpha = std::min(std::max(0.0, least), greatest);
  if (alpha == 0 || !(least <= greatest)) return y;
  const int k = alpha > 0 ? at_least : at_greatest, i = k % 2;
  const double lambda = alpha * sum(dn * dn + dt * dt) / rates[k / 2][i];
  const double an = lambda * c.mu[i], at = k < 2 ? -lambda : lambda;
  const double gx = an * c.nx[i] - at * c.ny[i], gy = an * c.ny[i] + at * c.nx[i];
  const Twist<2> clamped = y - grasp.inverse * Wrench<2>(gx, gy, gx * c.jx[i] + gy * c.jy[i]);
  // Contacts at one point have no line between them.
  return clamped.cwiseAbs().maxCoeff() < 1e7 ? clamped : y;
}

}  // namespace

template <>
Twist<2> cold_start<2>(const ScaledGrasp<2>& grasp, const Wrench<2>& w) {
  if (grasp.size == 2 && !grasp.limited) return cold_start_two(grasp, w);
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
  // Others may round G^T y otherwise: then it must still be a proof.
  const double rounding = 2e-16 * length<Dim>(far.y);
  const double doubt = rounding * rounding * static_cast<double>(grasp.size);
  return lower_bound(far) - doubt > force_cap * force_cap ? Rise::proof : Rise::some;
}

/// maximise() with a y of its own in the unholdable case: any that proves it. With rho > 0 it
/// maximises value − ½ rho |y|² instead, whose y is bounded: (w − G f) / rho.
template <int Dim>
bool ascend(const ScaledGrasp<Dim>& grasp, const Wrench<Dim>& w, const Twist<Dim>& start,
            double force_cap, double rho, Point<Dim>& point) {
  const double unholdable = force_cap * force_cap;
  const auto above_cap = [&] {
    return 2 * point.value > unholdable && lower_bound(point) > unholdable;
  };
  bool settled = false, unbounded = false;
  int cuts = 0;  // steps in a row that changing faces cut short
  const auto evaluate_at = [&](const Twist<Dim>& y) {
    evaluate<Dim>(grasp, w, y, point);
    if (rho == 0) return;
    point.value -= rho / 2 * y.squaredNorm();
    point.residual -= rho * y;
  };
  const auto curvature_here = [&] {
    Square<Dim> M = curvature(grasp, point);
    if (rho > 0) M.diagonal().array() += rho;
    return M;
  };
  evaluate_at(start);
  // Where steps are cut short again and again, the next heeds the faces passed before: else
  // it zigzags between them near the limit of holding.
  Square<Dim> M;
  for (int step = 0; step < 100; ++step) {
    const double error = point.residual.cwiseAbs().maxCoeff();
    if (above_cap()) return false;
    if (error <= 1e-13 && std::abs(point.y.dot(point.residual)) <= 1e-12 * std::abs(point.value))
      return true;
    if (rho > 0 && error <= 1e-12 + 1e-14 * span(point.y)) return true;
    if (rho == 0 && (settled || error <= delta / 2 + 1e-14 * span(point.y)) &&
        polish(grasp, w, 1e-13, point))
      return !above_cap();
    if (unbounded && error <= delta) return true;

    M = cuts > 1 ? Square<Dim>(curvature_here() + 0.5 * M) : curvature_here();
    Twist<Dim> dy = newton_step(M, point.residual);
    const double reach = (step < 4 ? 3 : 100) * (1 + span(point.y)), stretch = span(dy);
    if (stretch > reach) {
      M.diagonal().array() += point.residual.norm() / reach;
      dy = newton_step(M, point.residual);
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
      a += slope_there / quadratic(curvature_here(), dy);
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
    cuts = cut ? cuts + 1 : 0;
  }
  return size<Dim>(point.residual) <= delta;
}

}  // namespace

namespace {

/// From the y that is pulled towards 0 by rho: the direction from what can be balanced to w, as a
/// proof that nothing holds. It is normal to the faces on which the nearest balance lies, and so
/// the same for all loads near this one, up to the limit of holding.
bool separate(const ScaledGrasp<2>& grasp, const Wrench<2>& w, double force_cap,
              const Point<2>& pulled, Point<2>& proof) {
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  Wrench<2> beyond = w;
  for (std::size_t i = 0; i < grasp.size; ++i) {
    const Eigen::Matrix<double, 3, 2> G = columns(grasp, i);
    const Face on = face(grasp, i, pulled.z(i));
    M += G * on.P * G.transpose();
    beyond -= G * on.f0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(M);
  Twist<2> d = Twist<2>::Zero();
  for (int k = 0; k < 3; ++k)
    if (eigen.eigenvalues()[k] <= 1e-9 * M.trace())
      d += eigen.eigenvectors().col(k).dot(beyond) * eigen.eigenvectors().col(k);
  if (!(length<2>(d) > 0)) return false;
  d /= length<2>(d);
  Point<2> far = pulled;
  if (prove<2>(grasp, w, Twist<2>::Zero(), d, force_cap, far) != Rise::proof) return false;
  proof = far;
  return true;
}

}  // namespace

template <>
bool maximise<2>(const ScaledGrasp<2>& grasp, const Wrench<2>& w, const Twist<2>& start,
                 double force_cap, Point<2>& point) {
  const double unholdable = force_cap * force_cap;
  // A proof that a neighbour cannot be held is too long to start from.
  const bool near = span(start) < 1e8;
  if (ascend<2>(grasp, w, near ? start : cold_start<2>(grasp, w), force_cap, 0, point)) return true;
  const bool proven = lower_bound(point) > unholdable;
  // A pull towards y = 0 gives the sharpest proof; fading away, it also shows the faces of forces
  // so large that rounding hid them.
  for (const double rho : {1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    Point<2> pulled = point;
    ascend<2>(grasp, w, Twist<2>::Zero(), std::numeric_limits<double>::infinity(), rho, pulled);
    if (separate(grasp, w, force_cap, pulled, point) || proven) return false;
    evaluate<2>(grasp, w, pulled.y, pulled);
    for (const double tolerance : {1e-13, 1e-11, 1e-9})
      if (polish(grasp, w, tolerance, pulled)) {
        point = pulled;
        return !(lower_bound(point) > unholdable);
      }
  }
  return false;
}

template double lower_bound<2>(const Point<2>&);

}  // namespace poise::dual
