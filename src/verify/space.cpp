#include "verify/space.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "verify/hull.hpp"
#include "verify/plane.hpp"

namespace poise::verify {
namespace {

using Vec3 = Eigen::Matrix<Real, 3, 1>;
using Quaternion = Eigen::Quaternion<Real>;

struct Tilt {
  Vec3 from;
  Real most{0};  ///< [rad]
};

/// x is cut off where a . x > b.
struct Cut {
  Vec3 a;
  Real b;
};

bool unlimited(const Held& held) {
  return std::all_of(held.contacts.begin(), held.contacts.end(), [](const Touch& contact) {
    return contact.lo <= 0 && !std::isfinite(contact.hi);
  });
}

/// Where y proves that load x needs an effort above t: 2 (y . B x - phi(G^T y)) > t. Without limits
/// a longer or shorter y proves more, and the best length is known.
Cut cut_by(const Held& held, const Load& load, const Vec& y, Real t) {
  const Real speed = load.weight * velocity(y, load.com).norm();
  const Real value = phi(held, y), slack = delta * worth(load, y);
  const Real b = unlimited(held) ? std::sqrt(2 * std::max(value, Real{0}) * t) : t / 2 + value;
  const Vec v = load.weight * velocity(y, load.com);
  return {v.head<3>() / speed, (b + slack) / speed};
}

/// How near to the origin, and how far from it, is what cuts leave; nothing: infinitely far, and 0.
struct Left {
  Real nearest{std::numeric_limits<Real>::infinity()}, farthest{0};
};

/// What cuts leave is bounded by faces: the part of each plane that all other cuts leave, a
/// polygon.
Left left_by(std::vector<Cut> cuts) {
  constexpr Real outside = 4;
  for (int k = 0; k < 3; ++k)
    for (const Real sign : {1, -1}) cuts.push_back({sign * Vec3::Unit(k), outside});
  Left left;
  const bool around = std::all_of(cuts.begin(), cuts.end(), [](const Cut& c) { return c.b >= 0; });
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const Vec3 n = cuts[i].a, middle = cuts[i].b * n;
    if (middle.norm() > 2 * outside) continue;
    const Vec3 e = n.unitOrthogonal(), f = n.cross(e);
    std::vector<Vec3> polygon;
    for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
      polygon.emplace_back(middle + 4 * outside * (x * e + y * f));
    for (std::size_t j = 0; j < cuts.size() && !polygon.empty(); ++j) {
      if (j == i) continue;
      const auto beyond = [&](const Vec3& x) { return cuts[j].a.dot(x) - cuts[j].b; };
      std::vector<Vec3> rest;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3& from = polygon[k];
        const Vec3& to = polygon[(k + 1) % polygon.size()];
        const Real here = beyond(from), there = beyond(to);
        if (here <= 0) rest.push_back(from);
        if ((here < 0 && there > 0) || (here > 0 && there < 0))
          rest.emplace_back(from + here / (here - there) * (to - from));
      }
      polygon = rest;
    }
    // The nearest point of a face: in its middle, or on its boundary.
    bool inside = !polygon.empty();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3& from = polygon[k];
      const Vec3 way = polygon[(k + 1) % polygon.size()] - from;
      inside = inside && n.dot(way.cross(middle - from)) >= 0;
      const Real part = way.squaredNorm() > 0 ? -from.dot(way) / way.squaredNorm() : 0;
      left.nearest =
          std::min(left.nearest, (from + std::clamp(part, Real{0}, Real{1}) * way).norm());
      left.farthest = std::max(left.farthest, from.norm());
    }
    if (inside) left.nearest = std::min(left.nearest, middle.norm());
  }
  if (around) left.nearest = 0;
  return left;
}

/// Checks that in the whole domain the effort is at least t (the greatest of the scenarios).
void check_cuts(Claims& claims, const Held& held, const Field& root,
                const std::optional<Tilt>& tilt, Real t, const std::string& words) {
  std::vector<Cut> cuts;
  const Field list = root.get("cuts", "a list of cuts");
  for (const Field& field : list.list()) {
    if (const auto n = field.find("n")) {
      const Vec normal = read_vector(*n, 3);
      // The domain is a cone: its greatest n . x is that of the direction nearest to n.
      Real most = normal.norm();
      if (tilt) {
        const Real along = normal.head<3>().dot(tilt->from);
        const Real across = (normal.head<3>() - along * tilt->from).norm();
        if (std::atan2(across, along) > tilt->most)
          most = along * std::cos(tilt->most) + across * std::sin(tilt->most);
      }
      claims.check(*n, "n . x <= 0 in the whole domain [of n]", most / normal.norm(), 1e-9L);
      cuts.push_back({normal.head<3>() / normal.norm(), 0});
      continue;
    }
    const Vec y = read_vector(field.get("y", "a twist, or n"), 6);
    const Field scenario = field.get("scenario", "the number of a scenario");
    const Real number = scenario.finite();
    if (!(number >= 0 && number < static_cast<Real>(held.loads.size())) ||
        number != std::floor(number))
      scenario.fail("must be the number of a scenario");
    const Cut cut = cut_by(held, held.loads[static_cast<std::size_t>(number)], y, t);
    if (!std::isfinite(cut.b) || !cut.a.allFinite()) continue;  // y does not move the com
    cuts.push_back(cut);
  }
  // What is left is convex: it does not meet the unit sphere if it lies inside or outside.
  const Left left = left_by(cuts);
  // Without any cut: forces add up to the weight, and W^2 <= V sum share.
  Real shares = 0;
  for (const Touch& contact : held.contacts) shares += contact.share;
  const Real alone = std::sqrt(t * shares) / held.heaviest();
  claims.check(list, words, std::min({left.farthest, 1 / left.nearest, alone}), 1 + 1e-6L);
}

Quaternion read_quaternion(const Field& field) {
  const auto number = [&](const char* key) { return field.get(key, "a number").finite(); };
  return {number("w"), number("x"), number("y"), number("z")};
}

/// Checks the turn from the present orientation to the best posture, in the world frame.
void check_turn(Claims& claims, const Field& root, const Vec& up) {
  const Quaternion before =
      read_quaternion(root.get("options", "a mapping").get("orientation", "a quaternion"));
  const Field field = root.get("rotation", "a quaternion");
  const Quaternion turn = read_quaternion(field);
  claims.check(field, "rotation has length 1", std::abs(turn.norm() - 1), 1e-12L);
  claims.check(field, "rotation has w >= 0", turn.w() >= 0);
  const Vec3 world = before.normalized() * Vec3(up.head<3>());
  claims.check(field, "rotation takes up to the world's +z", (turn * world - Vec3::UnitZ()).norm(),
               1e-11L);
  // A turn takes no longer way than the angle between the two directions.
  const Real angle = std::atan2(world.head<2>().norm(), world[2]);
  const Real taken = 2 * std::atan2(turn.vec().norm(), turn.w());
  claims.check(field, "rotation is the smallest [rad]", std::abs(taken - angle), 1e-7L);
  const Field degrees = field.get("angle_deg", "an angle in degrees");
  claims.check(degrees, "angle_deg is that of rotation [rad]",
               std::abs(radians(degrees.finite()) - taken), 1e-11L);
  const Field after = root.get("orientation", "a quaternion");
  const Quaternion claimed = read_quaternion(after), expected = turn * before.normalized();
  claims.check(after, "orientation is that after the rotation",
               std::min((claimed.coeffs() - expected.coeffs()).norm(),
                        (claimed.coeffs() + expected.coeffs()).norm()),
               1e-11L);
}

std::optional<Tilt> read_tilt(const Field& options) {
  const auto field = options.find("tilt");
  if (!field || field->is_null()) return {};
  const Vec from = read_vector(field->get("from", "a direction"), 3);
  return Tilt{from.head<3>() / from.norm(), radians(field->get("max_deg", "an angle").finite())};
}

/// Whether it is plain that turns to all sides can be balanced too, if no contact presses harder
/// than before by `slack` [N]. Contacts that press against each other, each with its force inside
/// of its cone, can then give any change that is small beside that. Such forces are sought by going
/// down |G f|^2 from 1 N along each normal; that they are right is then seen from G f = 0 and the
/// cones.
bool holds_beside(const Held& held, const Load& load, Real slack) {
  constexpr Real turn = 1e-5L;
  if (!(load.radius > 0)) return false;
  std::vector<Touch> touches;
  Mat G(6, 0);
  for (const Touch& contact : held.contacts) {
    if (!(contact.friction > 0)) continue;
    touches.push_back(contact);
    touches.back().lo = 0;
    touches.back().hi = std::numeric_limits<Real>::infinity();
    for (Eigen::Index k = 0; k < contact.G.cols(); ++k) {
      const Vec3 force = contact.G.col(k).head(3), moment = contact.G.col(k).tail(3);
      G.conservativeResize(6, G.cols() + 1);
      G.rightCols(1) << force, (moment - Vec3(load.com.head<3>()).cross(force)) / load.radius;
    }
  }
  // Calls f for each contact with its part of v.
  const auto each = [&](Vec& v, const auto& f) {
    Eigen::Index at = 0;
    for (const Touch& contact : touches) {
      f(contact, v.segment(at, contact.G.cols()));
      at += contact.G.cols();
    }
  };
  if (touches.empty()) return false;
  const auto inverse = G.completeOrthogonalDecomposition();
  Mat loads = Mat::Zero(6, 3);
  loads.topRows(3) = load.weight * turn * Mat::Identity(3, 3);
  const Mat change = inverse.solve(loads);
  if (!((G * change - loads).norm() <= 1e-9L * loads.norm())) return false;

  Vec start = Vec::Zero(G.cols()), more = start;
  each(start, [](const Touch&, auto f) { f[0] = 1; });
  const Real step = 1 / G.squaredNorm();
  for (int round = 0; round < 1000; ++round) {
    more -= step * (G.transpose() * (G * (start + more)));
    each(more, [](const Touch& contact, auto f) { f = project(contact, f); });
  }
  Vec internal = start + more;
  internal -= inverse.solve(G * internal);
  if (!((G * internal).norm() <= 1e-12L * internal.norm())) return false;
  Real inside = std::numeric_limits<Real>::infinity(), steepest = 0;
  each(internal, [&](const Touch& contact, const auto& f) {
    inside = std::min(inside, contact.friction * f[0] - f.tail(f.size() - 1).norm());
    steepest = std::max(steepest, contact.friction);
  });
  // So much of them is needed for the change to stay within the cones.
  const Real share = (1 + steepest) * change.norm() / inside;
  return inside > 0 && share * internal.norm() + change.norm() < slack;
}

/// Whether a minimum is inside of the domain and of what can be held, for sure.
bool surely_inside(const Held& held, const std::optional<Tilt>& tilt, const HoldClaim& hold) {
  if (tilt) {
    const Vec3 up = hold.up.head<3>();
    if (std::atan2(up.cross(tilt->from).norm(), up.dot(tilt->from)) > tilt->most - 1e-5L)
      return false;
  }
  if (!hold.holdable || hold.others.size() + 1 != held.loads.size()) return false;
  for (std::size_t k = 0; k < held.loads.size(); ++k) {
    const std::size_t other = k < hold.scenario ? k : k - 1;
    const Real slack = k == hold.scenario ? hold.slack : hold.others[other].slack;
    if (!holds_beside(held, held.loads[k], slack)) return false;
  }
  return true;
}

HoldClaim check_in_domain(Claims& claims, const Held& held, const Field& field,
                          const std::optional<Tilt>& tilt, Real cap) {
  const HoldClaim hold = check_hold(claims, held, field, cap);
  claims.check(field, "an optimum is holdable", hold.holdable);
  if (tilt) {
    const Vec3 up = hold.up.head<3>();
    claims.check(field, "the posture lies in the domain [rad]",
                 std::atan2(tilt->from.cross(up).norm(), tilt->from.dot(up)) - tilt->most, 1e-8L);
  }
  return hold;
}

}  // namespace

// The hull of the com and the contacts: seen from the com outside, the facets that meet there bound
// the cone which the contacts span.
Fork fork_in_space(const Held& held, const Load& load, const Vec& up) {
  if (load.radius <= 0) return Fork::no;
  std::vector<Vec> points{Vec::Zero(3)};
  for (const Touch& contact : held.contacts)
    points.emplace_back((contact.position - load.com) / load.radius);
  const auto facets = hull(points);
  if (!facets) return Fork::no;
  Real most = -2;
  for (const Facet& facet : *facets)
    if (facet.offset >= -1e-9L) most = std::max(most, -facet.normal.dot(up));
  if (most == -2) return Fork::no;  // the com is inside
  points.erase(points.begin());
  if (const auto contacts = hull(points)) {
    Real outside = -1;
    for (const Facet& facet : *contacts) outside = std::max(outside, facet.offset);
    if (outside < 0.99e-9L) return Fork::no;
  }
  return most < -1e-9L ? Fork::yes : most > 1e-9L ? Fork::no : Fork::unclear;
}

void check_best_in_space(Claims& claims, const Held& held, const Field& root) {
  const Field options = root.get("options", "a mapping");
  const Real weights = options.get("force_cap", "a number of weights").finite();
  const Real cap = weights * held.heaviest();
  const auto tilt = read_tilt(options);
  const Field status = root.get("status", "optimal, gap or unholdable");
  const std::string& is = status.word({"optimal", "gap", "unholdable"});
  const Field best = root.get("best", "a hold or null");
  const Field pinched = root.get("best_pinched", "a hold or null");
  const Field lower = root.get("lower_bound", "a number [N^2] or null");
  const Field gap = root.get("relative_gap", "a number or null");
  const Field list = root.get("minima", "a list of holds");
  std::vector<HoldClaim> minima;
  for (const Field& field : list.list())
    minima.push_back(check_in_domain(claims, held, field, tilt, weights));
  for (std::size_t k = 1; k < minima.size(); ++k)
    claims.check(list, "minima are in the order of their effort",
                 (minima[k - 1].effort - minima[k].effort) / minima[k].effort, 1e-8L);
  claims.note("The list of local minima in space is not proven complete.");

  if (is == "unholdable") {
    for (const Field& field : {best, pinched, gap})
      claims.check(field, "is null where nothing is held", field.is_null());
    claims.check(list, "minima are empty where nothing is held", minima.empty());
    check_cuts(claims, held, root, tilt, cap * cap,
               "cuts prove that the force cap is not enough: they leave nothing on the unit "
               "sphere");
    return;
  }
  const Real bound = lower.finite();
  if (bound > 0)
    check_cuts(claims, held, root, tilt, bound,
               "cuts prove lower_bound: they leave nothing on the unit sphere");
  claims.check(best, "best is null only where the gap stays open", !best.is_null() || is == "gap");
  if (best.is_null()) {
    for (const Field& field : {pinched, gap})
      claims.check(field, "is null where nothing was found", field.is_null());
    claims.note("Nothing was found that can be held, nor a proof that nothing can.");
    return;
  }
  const HoldClaim hold = check_in_domain(claims, held, best, tilt, weights);
  claims.check(lower, "lower_bound is not above effort", (bound - hold.effort) / hold.effort,
               1e-9L);
  claims.check(gap, "relative_gap is (effort - lower_bound) / effort",
               std::abs(gap.finite() - std::max(Real{0}, (hold.effort - bound) / hold.effort)),
               1e-13L);
  if (is == "optimal")
    claims.check(gap, "the gap is the wanted one", (hold.effort - bound) / hold.effort,
                 options.get("gap", "a number").finite() + 1e-9L);
  for (const HoldClaim& minimum : minima)
    claims.check(best, "best is the lowest of the minima",
                 (hold.effort - minimum.effort) / hold.effort, 1e-8L);
  for (const HoldClaim& minimum : minima)
    if (minimum.manner == "pinched" && surely_inside(held, tilt, minimum))
      claims.check(
          pinched, "best_pinched is no higher than a pinched minimum inside the domain",
          pinched.is_null() ? 2 : pinched.get("effort", "a number [N^2]").finite() / minimum.effort,
          1 + 1e-8L);
  if (!pinched.is_null()) {
    const HoldClaim squeezed = check_in_domain(claims, held, pinched, tilt, weights);
    claims.check(pinched, "best_pinched is pinched", squeezed.manner == "pinched");
    claims.check(pinched, "best_pinched is one of the minima",
                 std::any_of(minima.begin(), minima.end(), [&](const HoldClaim& minimum) {
                   return (minimum.up - squeezed.up).norm() <= 1e-9L;
                 }));
  }
  check_turn(claims, root, hold.up);
}

}  // namespace poise::verify
