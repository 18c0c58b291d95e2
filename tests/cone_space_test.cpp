// The round cone of a contact in space, with and without torsion, against its definition.
#include "dual/cone_space.hpp"

#include <gtest/gtest.h>

#include "dual/kernel_space.hpp"
#include "random_space_grasps.hpp"

namespace poise::test {
namespace {

using dual::Slide;
using Vector4 = Eigen::Vector4d;  // normal, along the tangents, and the moment's part

/// As many contacts as a lane holds, with their cones in newtons.
struct Lanes {
  explicit Lanes(bool limits)
      : hand(contacts(limits), Vector<3>::Zero()), cones(hand.scaled().cones(1)) {}

  static std::vector<Contact<3>> contacts(bool limits) {
    std::vector<Contact<3>> all;
    for (std::size_t i = 0; i < lane_size; ++i) {
      Contact<3> contact = space::random_contact(0, true);
      if (limits && one_in(2)) contact.min_normal = real(0, 0.5);
      if (limits && one_in(2)) contact.max_normal = contact.min_normal + real(0, 1);
      all.push_back(contact);
    }
    return all;
  }
  const ContactLane<3>& lane() const { return cones.lanes[0]; }
  /// z of which `turn` is 0 where the finger is hard.
  Vector4 z(std::size_t i) const {
    Vector4 z =
        Vector4(coordinate(), coordinate(), coordinate(), coordinate()) * (one_in(3) ? 3 : 1);
    if (lane().soft[i] == 0) z[3] = 0;
    return z;
  }
  dual::SpaceVelocity<Lane> velocity(const Vector4& z) const {
    const auto all = [](double x) { return x - Lane{}; };
    const Lane squared = all(z.tail<3>().squaredNorm()), over = inverse_root(squared);
    return {all(z[0]),
            all(z[1]),
            all(z[2]),
            all(z[3]),
            squared,
            over,
            all(z[0]) + lane().mu * squared * over};
  }
  Vector4 project(std::size_t i, const Vector4& z) const {
    const auto at = velocity(z);
    const auto f = cones.limited ? dual::project<true>(cones, lane(), at)
                                 : dual::project<false>(cones, lane(), at);
    return {f.n[i], f.kept[i] * z[1], f.kept[i] * z[2], f.kept[i] * z[3]};
  }
  Eigen::Matrix4d derivative(std::size_t i, const Vector4& z) const {
    const auto at = velocity(z);
    const Lane beside = at.squared * at.over, n = project(i, z)[0] - Lane{};
    const auto D = cones.limited ? dual::derivative<true>(cones, lane(), beside, at.over, n)
                                 : dual::derivative<false>(cones, lane(), beside, at.over, n);
    Vector4 d = z * at.over[i];
    d[0] = 0;
    const Vector4 e = Vector4::Unit(0);
    return D.kappa[i] * Eigen::Matrix4d::Identity() + D.nn[i] * e * e.transpose() +
           D.nd[i] * (e * d.transpose() + d * e.transpose()) + D.dd[i] * d * d.transpose();
  }
  /// Which part of the cone z projects to: beside it, at a limit, at the apex.
  std::array<bool, 3> face(std::size_t i, const Vector4& z) const {
    const Contact<3>& c = hand.contacts()[i];
    const double n = project(i, z)[0];
    const double within = std::clamp(z[0], c.min_normal, c.max_normal);
    return {z.tail<3>().norm() < c.friction * within, !(n > c.min_normal), !(n < c.max_normal)};
  }
  /// A force of the cone, with a normal force up to 3 N or the greatest.
  Vector4 force(std::size_t i) const {
    const Contact<3>& c = hand.contacts()[i];
    const double n = real(c.min_normal, std::min(c.max_normal, 3.0));
    Vector<3> t(coordinate(), coordinate(), lane().soft[i] > 0 ? coordinate() : 0);
    t *= c.friction * n / std::max(1.0, t.norm());
    return {n, t[0], t[1], t[2]};
  }

  Hand<3> hand;
  Cones<3> cones;
};

Twist<3> random_twist() {
  Twist<3> y;
  for (int k = 0; k < 6; ++k) y[k] = coordinate();
  return y;
}

RC_GTEST_PROP(SpaceCone, ProjectsToTheNearestForce, ()) {
  const Lanes lanes(one_in(2));
  for (std::size_t i = 0; i < lane_size; ++i) {
    const Contact<3>& contact = lanes.hand.contacts()[i];
    const Vector4 z = lanes.z(i), f = lanes.project(i, z);
    RC_ASSERT(f.tail<3>().norm() <= contact.friction * f[0] + 1e-15);
    RC_ASSERT(f[0] >= contact.min_normal && f[0] <= contact.max_normal);
    for (int k = 0; k < 20; ++k) RC_ASSERT((z - f).dot(lanes.force(i) - f) <= 1e-14);
    const Eigen::Matrix<double, 3, 2> tangent = tangents(contact.normal);
    const Vector<3> force = z[0] * contact.normal + tangent * z.segment<2>(1);
    const double moment = contact.torsion > 0 ? z[3] * contact.torsion / contact.friction : 0;
    RC_ASSERT(dual::contains(contact, force, moment) == ((f - z).norm() <= 1e-15) ||
              (f - z).norm() <= 1e-12);
  }
}

RC_GTEST_PROP(SpaceCone, HasTheDerivativeOfItsProjection, ()) {
  const Lanes lanes(one_in(2));
  constexpr double h = 1e-6;
  for (std::size_t i = 0; i < lane_size; ++i) {
    const Vector4 z = lanes.z(i);
    const int sizes = lanes.lane().soft[i] > 0 ? 4 : 3;
    bool smooth = z.tail<3>().norm() > 0.01;  // the cone's round part is curved
    Eigen::Matrix4d differences = lanes.derivative(i, z);
    for (int k = 0; k < sizes; ++k) {
      const Vector4 aside = h * Vector4::Unit(k);
      smooth = smooth && lanes.face(i, z + aside) == lanes.face(i, z - aside);
      differences.col(k) = (lanes.project(i, z + aside) - lanes.project(i, z - aside)) / (2 * h);
    }
    if (smooth)
      RC_ASSERT((differences - lanes.derivative(i, z)).topLeftCorner(sizes, sizes).norm() <= 1e-7);
  }
}

RC_GTEST_PROP(SpaceCone, PowerIsTheMostThatAForceOfOneNewtonDoes, ()) {
  const double mu = random_friction(true);
  const Vector<2> t(coordinate(), coordinate());
  const double normal = coordinate();
  const Slide<double> slide{normal, t.norm()};
  double most = -1e9;
  for (int k = 0; k < 10000; ++k)
    most = std::max(most, normal + mu * t.dot(direction(2 * pi * k / 10000)));
  RC_ASSERT(std::abs(dual::power(slide, mu) - most) <= 1e-6);
  RC_ASSERT(dual::is_polar(slide, mu) == (most <= 0) || std::abs(most) <= 1e-6);
}

RC_GTEST_PROP(SpaceCone, FeelsATwistAsTheColumnsOfTheGraspMatrixDo, ()) {
  const Lanes lanes(false);
  const Twist<3> y = random_twist();
  const auto z = dual::velocity(lanes.lane(), dual::twist_of_lane<double>(y));
  for (std::size_t i = 0; i < lane_size; ++i) {
    const Contact<3>& contact = lanes.hand.contacts()[i];
    const Vector4 at(z.normal[i], z.a[i], z.b[i], z.turn[i]);
    if (contact.friction > 0)
      RC_ASSERT((dual::columns(lanes.lane(), i).transpose() * y - at).norm() <=
                1e-13 * (1 + at.norm()));
    // About the origin, in meters.
    Twist<3> in_meters = y;
    in_meters.tail<3>() *= lanes.hand.scaled().per_length;
    const auto slide = dual::slide<long double>(contact, in_meters);
    RC_ASSERT(std::abs(static_cast<double>(slide.normal) - at[0]) <= 1e-13 * (1 + at.norm()));
    RC_ASSERT(std::abs(static_cast<double>(slide.beside) - at.tail<3>().norm()) <=
              1e-13 * (1 + at.norm()));
  }
}

RC_GTEST_PROP(SpaceCone, KeepsTheDigitsOfForcesUnderALongTwist, ()) {
  const Lanes lanes(false);
  const Twist<3> y = 1e12 * random_twist(), rest = 1e-5 * random_twist();
  const auto z = dual::velocity(lanes.lane(), dual::twofold_twist(y, rest));
  const ContactLane<3>& c = lanes.lane();
  using Wide3 = Eigen::Matrix<Wide, 3, 1>;
  const dual::Screw<3, Wide> all = y.cast<Wide>() + rest.cast<Wide>();
  for (std::size_t i = 0; i < lane_size; ++i) {
    const Wide3 n(c.n[0][i], c.n[1][i], c.n[2][i]), r(c.r[0][i], c.r[1][i], c.r[2][i]);
    const Wide3 u = all.head<3>() + all.tail<3>().cross(r);
    const Wide turn = n.dot(all.tail<3>()) * c.soft[i];
    const Wide power = n.dot(u) + sqrt(n.cross(u).squaredNorm() + turn * turn) * c.mu[i];
    RC_ASSERT(std::abs(static_cast<double>(power - z.power[i])) <=
              1e-14 + 2e-16 * std::abs(z.power[i]));
  }
}

}  // namespace
}  // namespace poise::test
