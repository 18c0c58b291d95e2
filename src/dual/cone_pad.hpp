// A pad: one normal force N in fixed parts s_k over its points, tangential forces |t_k| <= mu s_k
// N, and moments |m_c| <= reach_c N about the axes in its plane. docs/theory.md, "Pads". Not
// installed.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "poise/contact.hpp"

namespace poise::dual {

/// What the effort takes of a pad beside its points: mean, and about either axis in its plane the
/// gyration radius rho, with how far the centre of pressure may move across that axis.
struct PadFrame {
  explicit PadFrame(const Contact<3>& contact)
      : axes{contact.pad->axis, contact.normal.cross(contact.pad->axis)},
        reach{contact.pad->reach.y(), contact.pad->reach.x()} {
    const Pad& pad = *contact.pad;
    for (std::size_t k = 0; k < pad.points.size(); ++k) mean += pad.shares[k] * pad.points[k];
    for (std::size_t c = 0; c < 2; ++c) {
      double square = 0;
      for (std::size_t k = 0; k < pad.points.size(); ++k) {
        const double x = axes[1 - c].dot(pad.points[k] - mean);
        square += pad.shares[k] * x * x;
      }
      // Points in a row across the axis: as if they were spread evenly over the reach.
      gyration[c] =
          std::sqrt(square) > 1e-6 * reach[c] ? std::sqrt(square) : reach[c] / std::sqrt(3.0);
    }
  }
  std::array<Vector<3>, 2> axes;
  std::array<double, 2> reach, gyration{};
  Vector<3> mean = Vector<3>::Zero();  ///< from the contact's position
};

/// z of a pad: of its points the lengths, and what turns it about the axes in its plane.
template <class Real>
struct PadSlide {
  Real normal;
  std::vector<Real> beside;
  std::array<Real, 2> turn;
};

/// Under a twist about the object frame's origin.
template <class Real>
PadSlide<Real> pad_slide(const Contact<3>& contact, const Twist<3>& y) {
  using Real3 = Eigen::Matrix<Real, 3, 1>;
  const Real3 n = contact.normal.cast<Real>(), omega = y.tail<3>().cast<Real>();
  const auto velocity = [&](const Vector<3>& point) -> Real3 {
    return y.head<3>().cast<Real>() +
           omega.cross(Real3(contact.position.cast<Real>() + point.cast<Real>()));
  };
  const PadFrame frame(contact);
  PadSlide<Real> z{n.dot(velocity(frame.mean)), {}, {}};
  for (const Vector<3>& point : contact.pad->points) {
    const Real3 u = velocity(point);
    z.beside.push_back((u - n.dot(u) * n).norm());
  }
  for (std::size_t c = 0; c < 2; ++c) z.turn[c] = std::abs(omega.dot(frame.axes[c].cast<Real>()));
  return z;
}

/// The greatest power of a force with normal force 1.
template <class Real>
Real pad_power(const Contact<3>& contact, const PadSlide<Real>& z, Real mu) {
  const PadFrame frame(contact);
  Real sum = z.normal;
  for (std::size_t k = 0; k < z.beside.size(); ++k)
    sum += mu * contact.pad->shares[k] * z.beside[k];
  for (std::size_t c = 0; c < 2; ++c) sum += frame.reach[c] * z.turn[c];
  return sum;
}

/// The greatest z . f - effort / 2 over the cone, and the N where it is: the right-hand side of
/// (11) of docs/theory.md, "Pads", falls in N and is convex, so that Newton's steps from below end.
template <class Real>
Real pad_phi(const Contact<3>& contact, const PadSlide<Real>& z, Real mu) {
  const PadFrame frame(contact);
  const std::vector<double>& shares = contact.pad->shares;
  Real N = contact.min_normal;
  for (int step = 0; step < 1000; ++step) {
    Real left = z.normal - N, slope = 1;
    for (std::size_t k = 0; k < shares.size(); ++k)
      if (z.beside[k] > mu * N) {
        left += mu * shares[k] * (z.beside[k] - mu * N);
        slope += mu * mu * shares[k];
      }
    for (std::size_t c = 0; c < 2; ++c) {
      const Real kappa = frame.reach[c] > 0 ? Real(frame.reach[c] / frame.gyration[c]) : 0;
      const Real p = frame.gyration[c] * z.turn[c];
      if (p <= kappa * N) continue;
      left += kappa * (p - kappa * N);
      slope += kappa * kappa;
    }
    const Real next = std::min<Real>(N + left / slope, contact.max_normal);
    if (!(next > N)) break;
    N = next;
  }
  Real phi = N * z.normal - N * N / 2;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const Real t = std::min<Real>(z.beside[k], mu * N);
    phi += shares[k] * (t * z.beside[k] - t * t / 2);
  }
  for (std::size_t c = 0; c < 2; ++c) {
    if (!(frame.reach[c] > 0)) continue;
    const Real p = frame.gyration[c] * z.turn[c];
    const Real m = std::min<Real>(p, frame.reach[c] / frame.gyration[c] * N);
    phi += m * p - m * m / 2;
  }
  return phi;
}

}  // namespace poise::dual
