#include "verify/held.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace poise::verify {

Vec wrench(const Vec& force, const Vec& point) {
  if (force.size() == 2) {
    Vec w(3);
    w << force, point[0] * force[1] - point[1] * force[0];
    return w;
  }
  Vec w(6);
  w << force, point.head<3>().cross(force.head<3>());
  return w;
}

Vec wrench(const Load& load, const Vec& up) { return wrench(load.weight * up, load.com); }

Vec velocity(const Vec& y, const Vec& point) {
  if (y.size() == 3) {
    Vec v(2);
    v << y[0] - y[2] * point[1], y[1] + y[2] * point[0];
    return v;
  }
  return y.head<3>() + y.tail<3>().cross(point.head<3>());
}

Real turning(const Vec& y) { return y.size() == 3 ? std::abs(y[2]) : y.tail<3>().norm(); }

Real outside(const Touch& contact, const Vec& force) {
  return std::max({Real{0}, contact.lo - force[0], force[0] - contact.hi,
                   force.tail(force.size() - 1).norm() - contact.friction * force[0]});
}

// The cone is round in the tangential part: what is nearest lies in the half-plane (n, t) of z,
// inside or on one of the sides of the trapezoid.
Vec project(const Touch& contact, const Vec& z) {
  if (outside(contact, z) <= 0) return z;
  const Real mu = contact.friction, lo = contact.lo, hi = contact.hi;
  const Real zn = z[0], zt = z.tail(z.size() - 1).norm();
  const Real foot = std::clamp((zn + mu * zt) / (1 + mu * mu), lo, hi);
  Real n = foot, t = mu * foot;
  for (const Real side : {lo, hi}) {
    if (!std::isfinite(side)) continue;
    const Real at = std::min(zt, mu * side);
    if (std::hypot(zn - side, zt - at) < std::hypot(zn - n, zt - t)) n = side, t = at;
  }
  Vec f = zt > 0 ? Vec(z * (t / zt)) : Vec(Vec::Zero(z.size()));
  f[0] = n;
  return f;
}

Vec response(const Touch& contact, const Vec& z) { return project(contact, contact.share * z); }

Real phi(const Touch& contact, const Vec& z) {
  const Vec f = response(contact, z);
  return z.dot(f) - f.squaredNorm() / contact.share / 2;
}

Real phi(const Held& held, const Vec& y) {
  Real sum = 0;
  for (const Touch& contact : held.contacts) sum += phi(contact, contact.G.transpose() * y);
  return sum;
}

Real bound(const Held& held, const Vec& w, const Vec& y) { return 2 * (y.dot(w) - phi(held, y)); }

Real worth(const Load& load, const Vec& y) {
  return load.weight * (velocity(y, load.com).norm() + load.radius * turning(y));
}

Real proven(const Held& held, const Load& load, const Vec& w, const Vec& y) {
  return bound(held, w, y) - 2 * delta * worth(load, y);
}

namespace {

/// Two tangents, at right angles to the normal and to each other; one in the plane.
Mat tangents(const Vec& n) {
  Mat t(n.size(), n.size() - 1);
  if (n.size() == 2) {
    t << -n[1], n[0];
    return t;
  }
  Eigen::Index least = 0;
  n.cwiseAbs().minCoeff(&least);
  const Eigen::Matrix<Real, 3, 1> normal = n.head<3>();
  t.col(0) = normal.cross(Eigen::Matrix<Real, 3, 1>::Unit(least)).normalized();
  t.col(1) = normal.cross(t.col(0).head<3>());
  return t;
}

template <int Dim>
Touch touch(const Contact<Dim>& contact) {
  Touch touch;
  touch.finger = contact.finger;
  touch.position = contact.position.template cast<Real>();
  touch.normal = contact.normal.template cast<Real>();
  touch.friction = contact.friction;
  touch.lo = contact.min_normal;
  touch.hi = contact.max_normal;
  touch.share = contact.share;
  touch.torsion = contact.torsion;
  const Mat t = tangents(touch.normal);
  const bool soft = Dim == 3 && touch.torsion > 0;
  touch.G = Mat::Zero(wrench_size<Dim>, soft ? Dim + 1 : Dim);
  touch.G.col(0) = wrench(touch.normal, touch.position);
  for (int k = 0; k < t.cols(); ++k) touch.G.col(1 + k) = wrench(t.col(k), touch.position);
  if (soft) touch.G.col(Dim).tail(3) = touch.normal * (touch.torsion / touch.friction);
  return touch;
}

Load load(const std::vector<Touch>& contacts, Real weight, const Vec& com) {
  Real radius = 0;
  for (const Touch& contact : contacts) radius = std::max(radius, (contact.position - com).norm());
  return {weight, com, radius};
}

}  // namespace

Real Held::heaviest() const {
  Real most = 0;
  for (const Load& each : loads) most = std::max(most, each.weight);
  return most;
}

Held held(const std::vector<Grasp<3>>& scenarios) {
  Held held{3, {}, {}, scenarios.front().fingers()};
  for (const Contact<3>& contact : scenarios.front().contacts())
    held.contacts.push_back(touch(contact));
  for (const Grasp<3>& grasp : scenarios)
    held.loads.push_back(
        load(held.contacts, grasp.object().weight, grasp.object().com.cast<Real>()));
  return held;
}

Held held(const Grasp<2>& grasp) {
  Held held{2, {}, {}, grasp.fingers()};
  for (const Contact<2>& contact : grasp.contacts()) held.contacts.push_back(touch(contact));
  held.loads = {load(held.contacts, grasp.object().weight, grasp.object().com.cast<Real>())};
  return held;
}

Held with_friction(Held held, Real factor) {
  for (Touch& contact : held.contacts) {
    contact.friction *= factor;
    contact.torsion *= factor;  // G has their ratio
  }
  return held;
}

WeightBound weight_bound(const Held& held, const Load& load, const Vec& up, const Vec& y,
                         Real cap) {
  WeightBound bound;
  Real squared = 0;
  for (const Touch& contact : held.contacts) {
    const Vec z = contact.G.transpose() * y;
    // What a force with normal force 1 can do against y at most.
    const Real power = z[0] + contact.friction * z.tail(z.size() - 1).norm();
    if (std::isfinite(contact.hi)) {
      bound.fixed += std::max(contact.lo * power, contact.hi * power);
      continue;
    }
    bound.fixed += contact.lo * power;
    Touch whole = contact;
    whole.lo = 0;
    squared += contact.share * project(whole, z).squaredNorm();
  }
  const Load newton{1, load.com, load.radius};
  bound.gain = y.dot(wrench(newton, up)) - delta * worth(newton, y) - cap * std::sqrt(squared);
  return bound;
}

}  // namespace poise::verify
