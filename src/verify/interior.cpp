#include <Eigen/Geometry>
#include <Eigen/QR>
#include <limits>

#include "verify/space.hpp"

namespace poise::verify {
namespace {

using Inverse = Eigen::CompleteOrthogonalDecomposition<Mat>;

/// The contacts with friction, without their limits, and how their forces balance about the com.
struct Frictional {
  std::vector<RealContact> contacts;
  Mat G{6, 0};

  /// Calls f for each contact with its part of v.
  template <class F>
  void each(Vec& v, const F& f) const {
    Eigen::Index first = 0;
    for (const RealContact& contact : contacts) {
      f(contact, v.segment(first, contact.G.cols()));
      first += contact.G.cols();
    }
  }
};

Frictional frictional(const RealGrasp& grasp, const RealLoad& load) {
  Frictional result;
  Mat& G = result.G;
  for (const RealContact& contact : grasp.contacts) {
    if (!(contact.friction > 0)) continue;
    result.contacts.push_back(contact);
    result.contacts.back().least = 0;
    result.contacts.back().most = std::numeric_limits<Real>::infinity();
    for (Eigen::Index k = 0; k < contact.G.cols(); ++k) {
      const Vec3 force = contact.G.col(k).head(3), moment = contact.G.col(k).tail(3);
      G.conservativeResize(6, G.cols() + 1);
      G.rightCols(1) << force, (moment - Vec3(load.com.head<3>()).cross(force)) / load.radius;
    }
  }
  return result;
}

/// Forces that press against each other, each inside of its cone, sought by going down |G f|^2 from
/// 1 N along each normal.
Vec internal_forces(const Frictional& hand, const Inverse& inverse) {
  const Mat& G = hand.G;
  Vec start = Vec::Zero(G.cols()), more = start;
  hand.each(start, [](const RealContact&, auto f) { f[0] = 1; });
  const Real step = 1 / G.squaredNorm();
  for (int round = 0; round < 1000; ++round) {
    more -= step * (G.transpose() * (G * (start + more)));
    hand.each(more, [](const RealContact& contact, auto f) { f = project(contact, f); });
  }
  const Vec internal = start + more;
  return internal - inverse.solve(G * internal);
}

}  // namespace

// Contacts that press against each other can give any change that is small beside that. That the
// forces are right is seen from G f = 0 and the cones.
bool holds_around(const RealGrasp& grasp, const RealLoad& load, Real slack) {
  constexpr Real turn = 1e-5L;
  if (!(load.radius > 0)) return false;
  const Frictional hand = frictional(grasp, load);
  if (hand.contacts.empty()) return false;
  const Inverse inverse(hand.G);
  Mat turned = Mat::Zero(6, 3);
  turned.topRows(3) = load.turning() * turn * Mat::Identity(3, 3);
  const Mat change = inverse.solve(turned);
  if (!((hand.G * change - turned).norm() <= 1e-9L * turned.norm())) return false;

  Vec internal = internal_forces(hand, inverse);
  if (!((hand.G * internal).norm() <= 1e-12L * internal.norm())) return false;
  Real inside = std::numeric_limits<Real>::infinity(), steepest = 0;
  hand.each(internal, [&](const RealContact& contact, const auto& f) {
    inside = std::min(inside, friction_left(contact, f));
    steepest = std::max(steepest, contact.friction);
    if (!contact.pad) return;
    for (const RealPad::Tilt& tilt : contact.pad->tilts) steepest = std::max(steepest, tilt.most());
  });
  // So much of them is needed for the change to stay within the cones.
  const Real share = (1 + steepest) * change.norm() / inside;
  return inside > 0 && share * internal.norm() + change.norm() < slack;
}

}  // namespace poise::verify
