#include "verify/statics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/grip.hpp"

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

Vec wrench(const RealLoad& load, const Vec& up) {
  return wrench(load.turning() * up, load.com) + load.still();
}

Real RealLoad::turning() const { return weight * (1 + lift / standard_gravity); }

Vec RealLoad::still() const {
  return wrench(weight / standard_gravity * acceleration, com) + fixed;
}

Real RealLoad::size() const {
  const Vec w = still(), force = w.head(com.size());
  const Vec moment = (w - wrench(force, com)).tail(w.size() - force.size());
  return std::abs(turning()) + force.norm() + moment.norm() / length;
}

Vec velocity(const Vec& y, const Vec& point) {
  if (y.size() == 3) {
    Vec v(2);
    v << y[0] - y[2] * point[1], y[1] + y[2] * point[0];
    return v;
  }
  return y.head<3>() + y.tail<3>().cross(point.head<3>());
}

Real turning(const Vec& y) { return y.size() == 3 ? std::abs(y[2]) : y.tail<3>().norm(); }

Real relative_size(const Vec& w, const RealLoad& load) {
  const Vec force = w.head(load.com.size());
  const Vec moment = (w - wrench(force, load.com)).tail(w.size() - force.size());
  const Real size = force.norm() / load.size();
  if (!(load.radius > 0)) return size;
  return std::max(size, moment.norm() / (load.size() * load.radius));
}

namespace {

/// Calls f(tangential force, its part of the friction) for all points of a contact, and
/// f(moment, greatest part) for what moves the centre of pressure of a pad.
template <class OfPoint, class OfTilt>
void for_each_part(const RealContact& contact, const Vec& force, const OfPoint& of_point,
                   const OfTilt& of_tilt) {
  if (!contact.pad) return of_point(force.tail(force.size() - 1), Real{1});
  Eigen::Index at = 1;
  for (const RealPad::Point& point : contact.pad->points) {
    of_point(force.segment(at, 2), point.share);
    at += 2;
  }
  for (const RealPad::Tilt& tilt : contact.pad->tilts) of_tilt(force[at++], tilt.most());
}

/// The normal force of a pad at which what is left of z . f - effort / 2 is greatest, without its
/// limits: the root of (2) of the design, the right-hand side of which falls.
Real normal_of_pad(const RealContact& contact, const Vec& z) {
  const Real mu = contact.friction;
  const auto right = [&](Real normal) {
    Real sum = z[0];
    for_each_part(
        contact, z,
        [&](const auto& t, Real part) {
          sum += mu * part * std::max(Real{0}, t.norm() - mu * normal);
        },
        [&](Real m, Real most) { sum += most * std::max(Real{0}, std::abs(m) - most * normal); });
    return sum;
  };
  Real low = 0, high = right(0);
  if (!(high > 0)) return 0;
  for (int step = 0; step < 80; ++step) {
    const Real normal = (low + high) / 2;
    (right(normal) > normal ? low : high) = normal;
  }
  return (low + high) / 2;
}

Vec project_on_pad(const RealContact& contact, const Vec& z) {
  const Real mu = contact.friction;
  const Real normal = std::clamp(normal_of_pad(contact, z), contact.least, contact.most);
  Vec f(z.size());
  Eigen::Index at = 0;
  f[at++] = normal;
  for_each_part(
      contact, z,
      [&](const auto& t, Real part) {
        const Real length = t.norm();
        f.segment(at, 2) = part * (length > mu * normal ? mu * normal / length : 1) * t;
        at += 2;
      },
      [&](Real m, Real most) { f[at++] = std::clamp(m, -most * normal, most * normal); });
  return f;
}

}  // namespace

Real friction_left(const RealContact& contact, const Vec& force) {
  const Real mu = contact.friction;
  Real left = std::numeric_limits<Real>::infinity();
  for_each_part(
      contact, force,
      [&](const auto& t, Real part) { left = std::min(left, mu * part * force[0] - t.norm()); },
      [&](Real m, Real most) {
        if (most > 0) left = std::min(left, most * force[0] - std::abs(m));
      });
  return left;
}

Real outside(const RealContact& contact, const Vec& force) {
  Real off = std::max({Real{0}, contact.least - force[0], force[0] - contact.most});
  const auto use = [&](Real size, Real steep) {
    off = std::max(off, (size - steep * force[0]) / std::sqrt(1 + steep * steep));
  };
  for_each_part(
      contact, force, [&](const auto& t, Real part) { use(t.norm(), contact.friction * part); },
      [&](Real m, Real most) { use(std::abs(m), most); });
  return off;
}

Real effort(const RealContact& contact, const Vec& force) {
  Real sum = force[0] * force[0];
  for_each_part(
      contact, force, [&](const auto& t, Real part) { sum += t.squaredNorm() / part; },
      [&](Real m, Real) { sum += m * m; });
  return sum / contact.share;
}

Real sliding(const RealContact& contact, const Vec& z) {
  Real least = std::numeric_limits<Real>::infinity();
  for_each_part(
      contact, z, [&](const auto& t, Real) { least = std::min(least, t.norm()); },
      [](Real, Real) {});
  return least;
}

Real power(const RealContact& contact, const Vec& z) {
  Real sum = z[0];
  for_each_part(
      contact, z, [&](const auto& t, Real part) { sum += contact.friction * part * t.norm(); },
      [&](Real m, Real most) { sum += most * std::abs(m); });
  return sum;
}

// The cone is round in the tangential part: what is nearest lies in the half-plane (n, t) of z,
// inside or on one of the sides of the trapezoid.
Vec project(const RealContact& contact, const Vec& z) {
  if (contact.pad) return project_on_pad(contact, z);
  if (outside(contact, z) <= 0) return z;
  const Real mu = contact.friction;
  const Real zn = z[0], zt = z.tail(z.size() - 1).norm();
  const Real foot = std::clamp((zn + mu * zt) / (1 + mu * mu), contact.least, contact.most);
  Real n = foot, t = mu * foot;
  for (const Real side : {contact.least, contact.most}) {
    if (!std::isfinite(side)) continue;
    if (!(zt < mu * side)) continue;  // past its end, where the edge is nearer
    if (std::abs(zn - side) >= std::hypot(zn - n, zt - t)) continue;
    n = side;
    t = zt;
  }
  Vec f = zt > 0 ? Vec(z * (t / zt)) : Vec(Vec::Zero(z.size()));
  f[0] = n;
  return f;
}

Real phi(const RealContact& contact, const Vec& z) {
  const Vec f = project(contact, contact.share * z);
  return z.dot(f) - effort(contact, f) / 2;
}

Real phi(const RealGrasp& grasp, const Vec& y) {
  Real sum = 0;
  for (const RealContact& contact : grasp.contacts) sum += phi(contact, contact.G.transpose() * y);
  return sum;
}

Real bound(const RealGrasp& grasp, const Vec& w, const Vec& y) {
  return 2 * (y.dot(w) - phi(grasp, y));
}

Real bound_rounding(const RealGrasp& grasp, const Vec& w, const Vec& y,
                    const std::vector<Real>& rates) {
  Real sum = y.cwiseAbs().dot(w.cwiseAbs());
  for (std::size_t a = 0; a < rates.size(); ++a)
    if (rates[a] > 0) sum += rates[a] * grasp.drives[a].max;
  for (const RealContact& contact : grasp.contacts) {
    const Vec left = against(grasp, contact.finger, y, rates);
    // y, and what drives move of the finger.
    const Vec size = y.cwiseAbs() + (left - y).cwiseAbs();
    const Vec force = project(contact, contact.share * (contact.G.transpose() * left));
    sum += force.cwiseAbs().dot(contact.G.cwiseAbs().transpose() * size);
  }
  return 16 * std::numeric_limits<Real>::epsilon() * sum;
}

Real imbalance_power(const RealLoad& load, const Vec& y) {
  return load.size() * (velocity(y, load.com).norm() + load.radius * turning(y));
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
RealContact real_contact(const Contact<Dim>& contact) {
  RealContact result{contact.finger,   real(contact.position), real(contact.normal),
                     contact.friction, contact.min_normal,     contact.max_normal,
                     contact.share,    contact.torsion,        {}};
  const Mat t = tangents(result.normal);
  const bool soft = Dim == 3 && result.torsion > 0;
  result.G = Mat::Zero(wrench_size<Dim>, soft ? Dim + 1 : Dim);
  result.G.col(0) = wrench(result.normal, result.position);
  for (int k = 0; k < t.cols(); ++k) result.G.col(1 + k) = wrench(t.col(k), result.position);
  if (soft) result.G.col(Dim).tail(3) = result.normal * (result.torsion / result.friction);
  return result;
}

/// The distance of the points from their middle across an axis, as the root of the mean of squares;
/// of points in a row along it as if they were spread evenly over the reach.
Real gyration_about(const RealPad& pad, const Vec& across, Real reach) {
  Real square = 0;
  for (const RealPad::Point& point : pad.points)
    square += point.share * std::pow(across.dot(point.place - pad.middle), 2);
  return std::sqrt(square) > 1e-6L * reach ? std::sqrt(square) : reach / std::sqrt(Real{3});
}

/// How far the farthest point of a contact is.
Real farthest(const RealContact& contact, const Vec& from) {
  Real distance = (contact.position - from).norm();
  if (contact.pad)
    for (const RealPad::Point& point : contact.pad->points)
      distance = std::max(distance, (contact.position + point.place - from).norm());
  return distance;
}

/// Makes a pad of what is already a point contact.
void add_pad(const Pad& given, RealContact& contact) {
  RealPad& pad = contact.pad.emplace();
  pad.middle = Vec::Zero(3);
  for (std::size_t k = 0; k < given.points.size(); ++k) {
    pad.points.push_back({real(given.points[k]), given.shares[k]});
    pad.middle += pad.points[k].share * pad.points[k].place;
  }
  const Vec along = real(given.axis);
  const Vec across = contact.normal.head<3>().cross(along.head<3>());
  pad.tilts = {{along, given.reach[1], gyration_about(pad, across, given.reach[1])},
               {across, given.reach[0], gyration_about(pad, along, given.reach[0])}};
  const Mat t = tangents(contact.normal);
  const auto count = static_cast<Eigen::Index>(pad.points.size());
  contact.G = Mat::Zero(6, 1 + 2 * count + 2);
  contact.G.col(0) = wrench(contact.normal, contact.middle());
  for (Eigen::Index k = 0; k < count; ++k)
    for (int side = 0; side < 2; ++side)
      contact.G.col(1 + 2 * k + side) =
          wrench(t.col(side), contact.position + pad.points[static_cast<std::size_t>(k)].place);
  for (int c = 0; c < 2; ++c) {
    const RealPad::Tilt& tilt = pad.tilts[static_cast<std::size_t>(c)];
    contact.G.col(1 + 2 * count + c).tail(3) = tilt.gyration * tilt.axis;
  }
}

}  // namespace

Real RealGrasp::greatest_size() const {
  Real greatest = 0;
  for (const RealLoad& load : loads) greatest = std::max(greatest, load.size());
  return greatest;
}

template <int Dim>
RealGrasp real_grasp(const Grasp<Dim>& grasp) {
  RealGrasp result{.dim = Dim, .fingers = grasp.fingers()};
  for (std::size_t k = 0; k < grasp.fingers().size(); ++k)
    result.closing.push_back(real(grasp.closing(k)));
  if (has_grip(grasp)) {
    result.in_parts = grip_unit(grasp) == GripUnit::part_of_max;
    for (const Drive<Dim>& drive : grasp.drives()) {
      RealDrive& real_drive =
          result.drives.emplace_back(RealDrive{drive.name, {}, drive.max, drive.turns});
      for (const auto& moved : drive.moves)
        real_drive.moves.push_back({moved.finger, real(moved.twist)});
    }
  }
  for (const Contact<Dim>& contact : grasp.contacts()) {
    result.contacts.push_back(real_contact(contact));
    if (contact.pad) add_pad(*contact.pad, result.contacts.back());
  }
  for (const Load<Dim>& load : grasp.loads()) {
    RealLoad& real_load = result.loads.emplace_back();
    real_load = {load.weight, real(load.com), real(load.fixed), load.lift, real(load.acceleration)};
    for (const RealContact& contact : result.contacts)
      real_load.radius = std::max(real_load.radius, farthest(contact, real_load.com));
    real_load.length = result.loads.front().radius > 0 ? result.loads.front().radius : 1;
  }
  return result;
}

template RealGrasp real_grasp(const Grasp<2>&);
template RealGrasp real_grasp(const Grasp<3>&);

Vec against(const RealGrasp& grasp, const std::string& finger, const Vec& y,
            const std::vector<Real>& rates) {
  Vec left = y;
  for (std::size_t a = 0; a < rates.size(); ++a)
    for (const RealDrive::Moved& moved : grasp.drives[a].moves)
      if (moved.finger == finger) left -= rates[a] * moved.twist;
  return left;
}

Real bound(const RealGrasp& grasp, const Vec& w, const Vec& y, const std::vector<Real>& rates) {
  Real sum = y.dot(w);
  for (std::size_t a = 0; a < rates.size(); ++a)
    if (rates[a] > 0) sum -= rates[a] * grasp.drives[a].max;
  for (const RealContact& contact : grasp.contacts)
    sum -= phi(contact, contact.G.transpose() * against(grasp, contact.finger, y, rates));
  return 2 * sum;
}

Real grip_bound(const RealGrasp& grasp, const Vec& w, const Vec& y, const std::vector<Real>& rates,
                Real cap) {
  std::vector<Real> speeds = rates;
  for (std::size_t a = 0; a < rates.size(); ++a) speeds[a] /= grasp.unit(grasp.drives[a]);
  Real sum = y.dot(w);
  for (const RealContact& contact : grasp.contacts) {
    const Vec z = contact.G.transpose() * against(grasp, contact.finger, y, speeds);
    const Real most = power(contact, z);
    sum -= most * (most <= 0 ? contact.least : std::min(contact.most, cap));
  }
  return sum;
}

RealGrasp with_load(RealGrasp grasp, const RealLoad& load) {
  grasp.loads = {load};
  return grasp;
}

RealGrasp with_friction(RealGrasp grasp, Real factor) {
  for (RealContact& contact : grasp.contacts) {
    contact.friction *= factor;
    contact.torsion *= factor;  // G has their ratio
  }
  return grasp;
}

PowerBound power_bound(const RealGrasp& grasp, const Vec& y, const std::vector<Real>& rates) {
  PowerBound bound;
  for (std::size_t a = 0; a < rates.size(); ++a)
    if (rates[a] > 0) bound.limited += rates[a] * grasp.drives[a].max;
  Real squared = 0;
  for (const RealContact& contact : grasp.contacts) {
    const Vec z = contact.G.transpose() * against(grasp, contact.finger, y, rates);
    // What a force with normal force 1 can do against y at most.
    const Real most = power(contact, z);
    if (std::isfinite(contact.most)) {
      bound.limited += std::max(contact.least * most, contact.most * most);
      continue;
    }
    bound.limited += contact.least * most;
    RealContact whole = contact;
    whole.least = 0;
    squared += effort(whole, project(whole, contact.share * z));
  }
  bound.per_norm = std::sqrt(squared);
  return bound;
}

WeightBound weight_bound(const RealGrasp& grasp, const RealLoad& load, const Vec& up, const Vec& y,
                         const std::vector<Real>& rates, Real cap) {
  RealLoad newton = load, nothing = load;
  newton.weight = 1;
  newton.fixed.setZero();
  nothing.weight = 0;
  const Real moving = std::abs(newton.turning()) + newton.acceleration.norm() / standard_gravity;
  const Real tolerated = delta * imbalance_power(load, y) / load.size();
  const PowerBound power = power_bound(grasp, y, rates);
  const Real per_newton = tolerated + cap * power.per_norm;
  return {y.dot(wrench(newton, up)) - moving * per_newton,
          power.limited - y.dot(load.fixed) + nothing.size() * per_newton};
}

}  // namespace poise::verify
