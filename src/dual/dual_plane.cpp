// The dual of holding in the plane: docs/theory.md, "One posture".
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "dual/maximise.hpp"

namespace poise::dual {
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
  const double lambda =
      alpha * problem.hand.internal.square * problem.hand.internal.per_margin[side][i];
  const double an = lambda * c.mu[i], at = side == 0 ? -lambda : lambda;
  const double gx = an * c.nx[i] - at * c.ny[i], gy = an * c.ny[i] + at * c.nx[i];
  const Twist<2> clamped =
      y - problem.hand.inverse * Wrench<2>(gx, gy, gx * c.jx[i] + gy * c.jy[i]);
  // Contacts at one point have no line between them.
  return l1_norm(clamped) < 1e7 ? clamped : y;
}

}  // namespace

Twist<2> cold_start(const Problem<2>& problem, const Wrench<2>& w) {
  if (in_closed_form(problem)) return cold_start_two(problem, w);
  return problem.hand.inverse * w;
}

// A pull towards y = 0 gives the sharpest proof: the direction is normal to the faces on which the
// nearest balance lies, and so the same for all loads near this one, up to the limit of holding.
bool separate(const Problem<2>& problem, const Wrench<2>& w, double force_cap, Point<2>& point) {
  Point<2> pulled = point;
  ascend<2, double>(problem, w, Twist<2>::Zero(), {.pull = first_pull}, pulled);
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
  const double norm = dual_norm<2, double>(d);
  if (!(norm > 0) ||
      prove<2, double>(problem, w, Twist<2>::Zero(), d / norm, force_cap, pulled) != Rise::proof)
    return false;
  point = pulled;
  return true;
}

template void evaluate(const Cones<2>&, const Wrench<2>&, const Twist<2>&, Point<2>&);
template bool maximise(const Problem<2>&, const Wrench<2>&, const Twist<2>&, double, Point<2>&);
template bool decide(const Cones<2, Wide>&, const Wrench<2>&, double, Point<2, Wide>&);

}  // namespace poise::dual
