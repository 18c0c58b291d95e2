// The cone of a contact in the plane against its definition.
#include "dual/cone_plane.hpp"

#include <gtest/gtest.h>

#include "dual/kernel_plane.hpp"
#include "random_grasps.hpp"

namespace poise::test {
namespace {

using dual::Slide;

/// As many contacts as a lane holds, with their cones in newtons.
struct Lanes {
  explicit Lanes(bool limits)
      : hand(contacts(limits), Vector<2>::Zero()), cones(hand.scaled().cones(1)) {}

  static std::vector<Contact<2>> contacts(bool limits) {
    std::vector<Contact<2>> all;
    for (std::size_t i = 0; i < lane_size; ++i) {
      Contact<2> contact = random_contact(0);
      contact.friction = random_friction(true);
      if (limits && one_in(2)) contact.min_normal = real(0, 0.5);
      if (limits && one_in(2)) contact.max_normal = contact.min_normal + real(0, 1);
      all.push_back(contact);
    }
    return all;
  }
  const ContactLane<2>& lane() const { return cones.lanes[0]; }
  Vector<2> project(std::size_t i, const Vector<2>& z) const {
    const Lane zn = z[0] - Lane{}, zt = z[1] - Lane{};
    const dual::PlaneVelocity<Lane> at{zn, zt, zn + lane().mu * magnitude(zt)};
    const auto f = cones.limited ? dual::project<true>(cones, lane(), at)
                                 : dual::project<false>(cones, lane(), at);
    return {f.n[i], f.t[i]};
  }
  Eigen::Matrix2d derivative(std::size_t i, const Vector<2>& z) const {
    const Lane zt = z[1] - Lane{}, n = project(i, z)[0] - Lane{};
    const auto d = cones.limited ? dual::derivative<true>(cones, lane(), zt, n)
                                 : dual::derivative<false>(cones, lane(), zt, n);
    const Vector<2> along(1, d.mu[i]);
    Eigen::Matrix2d D =
        d.inside[i] * Eigen::Matrix2d::Identity() + d.edge[i] * along * along.transpose();
    D(0, 0) -= d.at_limit[i];
    return D;
  }
  dual::Face<> face(std::size_t i, const Vector<2>& z) const {
    return dual::face<double>(cones, i, z);
  }
  /// A force of the cone, with a normal force up to 3 N or the greatest.
  Vector<2> force(std::size_t i) const {
    const Contact<2>& c = hand.contacts()[i];
    const double n = real(c.min_normal, std::min(c.max_normal, 3.0));
    return {n, c.friction * n * coordinate()};
  }

  Hand<2> hand;
  Cones<2> cones;
};

Vector<2> random_z() { return Vector<2>(coordinate(), coordinate()) * (one_in(3) ? 3 : 1); }
Twist<2> random_twist() { return {coordinate(), coordinate(), coordinate()}; }

RC_GTEST_PROP(PlaneCone, ProjectsToTheNearestForce, ()) {
  const Lanes lanes(one_in(2));
  const Vector<2> z = random_z();
  for (std::size_t i = 0; i < lane_size; ++i) {
    const Contact<2>& contact = lanes.hand.contacts()[i];
    const Vector<2> f = lanes.project(i, z);
    RC_ASSERT(std::abs(f[1]) <= contact.friction * f[0] + 1e-15);
    RC_ASSERT(f[0] >= contact.min_normal && f[0] <= contact.max_normal);
    for (int k = 0; k < 20; ++k) RC_ASSERT((z - f).dot(lanes.force(i) - f) <= 1e-14);
    const bool inside = dual::contains(contact, z);
    RC_ASSERT(inside == ((f - z).norm() <= 1e-15) || (f - z).norm() <= 1e-12);
  }
}

RC_GTEST_PROP(PlaneCone, HasTheDerivativeOfItsProjection, ()) {
  const Lanes lanes(one_in(2));
  const Vector<2> z = random_z();
  constexpr double h = 1e-6;
  for (std::size_t i = 0; i < lane_size; ++i) {
    const auto kind = [&](const Vector<2>& at) {
      const dual::Face<> face = lanes.face(i, at);
      return std::array{face.edge, face.at_lo, face.at_hi, face.sign > 0};
    };
    Eigen::Matrix2d differences;
    bool smooth = true;
    for (int k = 0; k < 2; ++k) {
      const Vector<2> aside = h * Vector<2>::Unit(k);
      smooth = smooth && kind(z + aside) == kind(z - aside);
      differences.col(k) = (lanes.project(i, z + aside) - lanes.project(i, z - aside)) / (2 * h);
    }
    if (smooth) RC_ASSERT((differences - lanes.derivative(i, z)).norm() <= 1e-8);
  }
}

RC_GTEST_PROP(PlaneCone, IsMadeOfFacesOnWhichTheProjectionIsAffine, ()) {
  const Lanes lanes(one_in(2));
  const Vector<2> z = random_z();
  for (std::size_t i = 0; i < lane_size; ++i) {
    const dual::Face<> face = lanes.face(i, z);
    RC_ASSERT((face.P * z + face.f0 - lanes.project(i, z)).norm() <= 1e-14);
  }
}

RC_GTEST_PROP(PlaneCone, PowerIsTheMostThatAForceOfOneNewtonDoes, ()) {
  const double mu = random_friction(true);
  const Vector<2> z = random_z();
  const Slide<double> slide{z[0], std::abs(z[1])};
  double most = -1e9;
  for (int k = -1000; k <= 1000; ++k) most = std::max(most, z.dot(Vector<2>(1, mu * k / 1000)));
  RC_ASSERT(std::abs(dual::power(slide, mu) - most) <= 1e-12);
  RC_ASSERT(dual::is_polar(slide, mu) == (most <= 0) || std::abs(most) <= 1e-12);
}

RC_GTEST_PROP(PlaneCone, FeelsATwistAsTheColumnsOfTheGraspMatrixDo, ()) {
  const Lanes lanes(false);
  const Twist<2> y = random_twist();
  const auto z = dual::velocity(lanes.lane(), dual::twist_of_lane<double>(y));
  for (std::size_t i = 0; i < lane_size; ++i) {
    const Vector<2> at(z.normal[i], z.tangential[i]);
    RC_ASSERT((dual::columns<double>(lanes.cones, i).transpose() * y - at).norm() <= 1e-14);
    // About the origin, in meters.
    const Twist<2> in_meters(y[0], y[1], y[2] * lanes.hand.scaled().per_length);
    const auto slide = dual::slide<long double>(lanes.hand.contacts()[i], in_meters);
    RC_ASSERT(std::abs(static_cast<double>(slide.normal) - at[0]) <= 1e-14);
    RC_ASSERT(std::abs(static_cast<double>(slide.beside) - std::abs(at[1])) <= 1e-14);
  }
}

RC_GTEST_PROP(PlaneCone, KeepsTheDigitsOfForcesUnderALongTwist, ()) {
  const Lanes lanes(false);
  const Twist<2> y = 1e12 * random_twist(), rest = 1e-5 * random_twist();
  const auto z = dual::velocity(lanes.lane(), dual::twofold_twist(y, rest));
  const ContactLane<2>& c = lanes.lane();
  for (std::size_t i = 0; i < lane_size; ++i) {
    const auto number = [&](int k) { return Wide(y[k]) + Wide(rest[k]); };
    const Wide ux = number(0) + number(2) * c.jx[i], uy = number(1) + number(2) * c.jy[i];
    const Wide normal = ux * c.nx[i] + uy * c.ny[i];
    const Wide power = normal + abs(uy * c.nx[i] - ux * c.ny[i]) * c.mu[i];
    RC_ASSERT(std::abs(static_cast<double>(power - z.power[i])) <=
              1e-15 + 2e-16 * std::abs(z.power[i]));
    RC_ASSERT(std::abs(static_cast<double>(normal - z.normal[i])) <=
              1e-15 + 2e-16 * std::abs(z.normal[i]));
  }
}

}  // namespace
}  // namespace poise::test
