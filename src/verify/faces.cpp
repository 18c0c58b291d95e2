#include "verify/faces.hpp"

#include <algorithm>
#include <cmath>

namespace poise::verify {
namespace {

/// One contact and the half of its trapezoid to the side of z. Lengths along the normal and along
/// the tangent are written as what they are in z.
struct Half {
  Real mu, least, most, sign;
  Vec3 n{0, 1, 0}, t{0, 0, sign};
  Vec3 foot = (n + mu * t) / (1 + mu * mu);  ///< along the normal, of the nearest point of the edge

  static Vec3 constant(Real value) { return {value, 0, 0}; }

  /// least <= along <= most
  void limit(Face& face, const Vec3& along) const {
    face.sides.emplace_back(along - constant(least));
    if (std::isfinite(most)) face.sides.emplace_back(constant(most) - along);
  }

  Face inside() const {
    Face face;
    face.P.setIdentity();
    limit(face, n);
    face.sides.emplace_back(mu * n - t);
    face.sides.emplace_back(mu * n + t);
    return face;
  }

  /// At a limit of the normal force; `beyond` is -1 for the least, 1 for the greatest.
  Face flat_side(Real at, Real beyond) const {
    Face face;
    face.P(1, 1) = 1;
    face.f0[0] = at;
    if (least < most) face.sides.emplace_back(beyond * (n - constant(at)));
    face.sides.emplace_back(constant(mu * at) - t);
    face.sides.emplace_back(constant(mu * at) + t);
    return face;
  }

  Face edge() const {
    Face face;
    const Eigen::Matrix<Real, 2, 1> direction(1, mu * sign);
    face.P = direction * direction.transpose() / (1 + mu * mu);
    limit(face, foot);
    if (mu > 0) face.sides.emplace_back(t - mu * n);  // else both edges are one
    return face;
  }

  /// The end of the edge at a limit, or the apex.
  Face corner(Real at, Real beyond) const {
    Face face;
    face.f0 << at, sign * mu * at;
    if (least < most) face.sides.emplace_back(beyond * (foot - constant(at)));
    if (at > 0 && mu > 0)
      face.sides.emplace_back(t - constant(mu * at));
    else if (at <= 0 && least < most)
      face.sides.emplace_back(beyond * (n - mu * t) / (1 + mu * mu));
    return face;
  }
};

}  // namespace

Face face_of(const RealContact& contact, const Eigen::Matrix<Real, 2, 1>& z) {
  const Half half{contact.friction, contact.least, contact.most, z[1] < 0 ? Real{-1} : Real{1}};
  const Real clamped = std::clamp(z[0], half.least, half.most);
  if (std::abs(z[1]) <= half.mu * clamped) {
    if (z[0] > half.least && z[0] < half.most) return half.inside();
    return half.flat_side(clamped, z[0] <= half.least ? -1 : 1);
  }
  const Real foot = (z[0] + half.mu * std::abs(z[1])) / (1 + half.mu * half.mu);
  if (foot > half.least && foot < half.most) return half.edge();
  return foot <= half.least ? half.corner(half.least, -1) : half.corner(half.most, 1);
}

}  // namespace poise::verify
