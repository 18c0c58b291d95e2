#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "verify/checks.hpp"
#include "verify/space.hpp"

namespace poise::verify {
namespace {

bool is_unlimited(const RealGrasp& grasp) {
  return std::all_of(grasp.contacts.begin(), grasp.contacts.end(), [](const RealContact& contact) {
    return contact.least <= 0 && !std::isfinite(contact.most);
  });
}

/// The greatest n . x in the domain, a cone: that of the direction nearest to n.
Real greatest_in_domain(const Vec3& n, const std::optional<Tilt>& tilt) {
  if (!tilt) return n.norm();
  const Vec3 from = tilt->from.cast<Real>();
  const Real along = n.dot(from), across = (n - along * from).norm();
  if (std::atan2(across, along) <= tilt->most) return n.norm();
  return along * std::cos(Real{tilt->most}) + across * std::sin(Real{tilt->most});
}

using Polygon = std::vector<Vec3>;

/// A large square in the plane of a half-space, around the point nearest to the origin.
Polygon square_in(const HalfSpace& half, Real size) {
  const Vec3 e = half.a.unitOrthogonal(), f = half.a.cross(e);
  Polygon square;
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
    square.emplace_back(half.b * half.a + size * (x * e + y * f));
  return square;
}

/// What a half-space leaves of a polygon.
Polygon clipped(const Polygon& polygon, const HalfSpace& half) {
  Polygon rest;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& from = polygon[k];
    const Vec3& to = polygon[(k + 1) % polygon.size()];
    const Real start = half.beyond(from), end = half.beyond(to);
    if (start <= 0) rest.push_back(from);
    if ((start < 0 && end > 0) || (start > 0 && end < 0))
      rest.emplace_back(from + start / (start - end) * (to - from));
  }
  return rest;
}

/// How near to the origin, and how far from it, is what cuts leave; nothing: infinitely far, and 0.
struct Distances {
  Real nearest{std::numeric_limits<Real>::infinity()}, farthest{0};
};

/// Adds a face: the nearest point is in its middle, or on its boundary.
void add_face(Distances& left, const Polygon& face, const HalfSpace& half) {
  const Vec3 middle = half.b * half.a;
  bool inside = !face.empty();
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vec3& from = face[k];
    const Vec3 way = face[(k + 1) % face.size()] - from;
    inside = inside && half.a.dot(way.cross(middle - from)) >= 0;
    const Real part = way.squaredNorm() > 0 ? -from.dot(way) / way.squaredNorm() : 0;
    left.nearest = std::min(left.nearest, (from + std::clamp(part, Real{0}, Real{1}) * way).norm());
    left.farthest = std::max(left.farthest, from.norm());
  }
  if (inside) left.nearest = std::min(left.nearest, middle.norm());
}

/// What cuts leave is bounded by faces: the part of each plane that all other cuts leave.
Distances left_by(std::vector<HalfSpace> cuts) {
  constexpr Real outside = 4;
  // Of loads that do not turn: all of space, or nothing.
  const auto is_plane = [](const HalfSpace& c) { return !c.a.isZero(0); };
  const auto still = std::partition(cuts.begin(), cuts.end(), is_plane);
  if (std::any_of(still, cuts.end(), [](const HalfSpace& c) { return c.b < 0; })) return {};
  cuts.erase(still, cuts.end());
  for (int k = 0; k < 3; ++k)
    for (const Real sign : {1, -1}) cuts.push_back({sign * Vec3::Unit(k), outside});
  Distances left;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (std::abs(cuts[i].b) > 2 * outside) continue;
    Polygon face = square_in(cuts[i], 4 * outside);
    for (std::size_t j = 0; j < cuts.size() && !face.empty(); ++j)
      if (j != i) face = clipped(face, cuts[j]);
    add_face(left, face, cuts[i]);
  }
  if (std::all_of(cuts.begin(), cuts.end(), [](const HalfSpace& c) { return c.b >= 0; }))
    left.nearest = 0;
  return left;
}

}  // namespace

HalfSpace half_space(const RealGrasp& grasp, const RealLoad& load, const Cut& cut,
                     const OptionsClaim& options, Real t) {
  const Vec y = real(cut.y), none = Vec::Zero(y.size());
  std::vector<Real> rates;
  if (cut.rates) rates.assign(cut.rates->begin(), cut.rates->end());
  const Vec v = load.turning() * velocity(y, load.com);
  // Where the load does not turn, all of space is left, or nothing.
  const auto along = [&](Real b) -> HalfSpace {
    if (!(v.norm() > 0)) return {Vec3::Zero(), b};
    return {v.head<3>() / v.norm(), b / v.norm()};
  };
  const Real value = phi(grasp, y), slack = delta * imbalance_power(load, y);
  if (options.objective == Objective::grip) {
    // Of (y, rates): (sum of rates) F >= y . w(x), less what contacts can do.
    Real sum = 0;
    for (const Real rate : rates) sum += rate;
    const Real limits =
        -grip_bound(grasp, none, y, rates, options.force_cap * grasp.greatest_size());
    return along(sum * t + limits - y.dot(load.still()) + slack);
  }
  if (!rates.empty()) {
    const Real drives = -bound(grasp, none, y, rates) / 2;
    return along(t / 2 + drives - y.dot(load.still()) + slack);
  }
  const bool scales = is_unlimited(grasp) && load.still().isZero(0);
  const Real b =
      scales ? std::sqrt(2 * std::max(value, Real{0}) * t) : t / 2 + value - y.dot(load.still());
  return along(b + slack);
}

std::optional<HalfSpace> check_cut(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                                   const Cut& cut, const OptionsClaim& options, Real t) {
  if (cut.n) {
    const Vec3 n = cut.n->cast<Real>();
    const Real greatest = greatest_in_domain(n, options.tilt) / n.norm();
    verdict.check(place / "n", "n . x <= 0 in the whole domain [of n]", greatest, 1e-9L);
    // Nothing of the domain is cut off, however thin it is, not even by rounding.
    return HalfSpace{n / n.norm(), std::max(greatest, Real{0}) + 1e-15L};
  }
  const RealLoad& load = load_of(verdict, place / "load", grasp, cut.load);
  const std::size_t rates = cut.rates ? cut.rates->size() : 0;
  const bool right =
      (rates == 0 || rates == grasp.drives.size()) &&
      (rates == 0 || std::all_of(cut.rates->begin(), cut.rates->end(),
                                 [](double rate) { return rate >= 0 && std::isfinite(rate); }));
  verdict.check(place / "rates", "rates are of the drives, and at least 0", right);
  if (!right) return {};
  const HalfSpace half = half_space(grasp, load, cut, options, t);
  if (!std::isfinite(half.b) || !half.a.allFinite()) return {};
  return half;
}

Real most_held(const RealGrasp& grasp, const OptionsClaim& options) {
  const Real cap = options.force_cap * grasp.greatest_size();
  if (options.objective != Objective::grip) return cap * cap;
  Real most = cap;
  for (const RealDrive& drive : grasp.drives) {
    if (drive.turns) most = std::min(most, cap * grasp.loads[0].radius);
    most = std::min(most, drive.max / grasp.unit(drive));
  }
  return most;
}

void check_cuts(Verdict& verdict, const RealGrasp& grasp, const std::vector<Cut>& cuts,
                const OptionsClaim& options, Real least, const std::string& words) {
  const Path list = Path() / "cuts";
  std::vector<HalfSpace> half_spaces;
  for (std::size_t k = 0; k < cuts.size(); ++k)
    if (const auto half = check_cut(verdict, list[k], grasp, cuts[k], options, least))
      half_spaces.push_back(*half);
  // What is left is convex: it does not meet the unit sphere if it lies inside or outside.
  const Distances left = left_by(half_spaces);
  // Without any cut: forces add up to the weight, and W^2 <= V sum share.
  Real shares = 0, greatest = 0;
  for (const RealLoad& load : grasp.loads)
    if (load.still().isZero(0)) greatest = std::max(greatest, std::abs(load.turning()));
  for (const RealContact& contact : grasp.contacts) shares += contact.share;
  const Real alone = options.objective == Objective::grip ? std::numeric_limits<Real>::infinity()
                                                          : std::sqrt(least * shares) / greatest;
  verdict.check(list, words, std::min({left.farthest, 1 / left.nearest, alone}), 1 + 1e-6L);
}

}  // namespace poise::verify
