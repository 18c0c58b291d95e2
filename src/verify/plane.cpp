#include "verify/plane.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace poise::verify {
namespace {

constexpr Real pi = 3.14159265358979323846264338327950288L;
/// Pieces of the circle end where rounding puts them [rad].
constexpr Real ends = 2e-8L;

using Mat3 = Eigen::Matrix<Real, 3, 3>;
using Vec3 = Eigen::Matrix<Real, 3, 1>;

/// What everything on an arc is linear in.
Vec3 harmonics(Real theta) { return {1, std::cos(theta), std::sin(theta)}; }

/// `angle` moved by whole turns into [start, start + 2 pi), or just below `start`.
Real unwound(Real angle, Real start) {
  return angle - 2 * pi * std::floor((angle - start + ends) / (2 * pi));
}

/// a + b cos(theta) + c sin(theta) is least in an interval at its ends or at its trough.
Real least(const Vec3& g, Real from, Real to) {
  Real value = std::min(g.dot(harmonics(from)), g.dot(harmonics(to)));
  const Real trough = unwound(std::atan2(-g[2], -g[1]), from);
  if (trough >= from && trough <= to) value = std::min(value, g.dot(harmonics(trough)));
  return value;
}

/// The load about the origin is this matrix times harmonics(theta).
Mat3 load_matrix(const Load& load) {
  Mat3 w;
  w << 0, 0, 1, 0, 1, 0, 0, load.com[0], -load.com[1];
  return load.weight * w;
}

/// c0 + cos1 cos + sin1 sin + cos2 cos 2 theta + sin2 sin 2 theta
struct Effort {
  Real c0{0}, cos1{0}, sin1{0}, cos2{0}, sin2{0};

  Real operator()(Real a) const {
    return c0 + cos1 * std::cos(a) + sin1 * std::sin(a) + cos2 * std::cos(2 * a) +
           sin2 * std::sin(2 * a);
  }
  Real slope(Real a) const {
    return sin1 * std::cos(a) - cos1 * std::sin(a) + 2 * sin2 * std::cos(2 * a) -
           2 * cos2 * std::sin(2 * a);
  }
  Real scale() const {
    return std::abs(c0) + std::abs(cos1) + std::abs(sin1) + std::abs(cos2) + std::abs(sin2);
  }
  /// Where it may be stationary between two angles, with these: with z = exp(i theta) the slope is
  /// a polynomial of degree 4 in z, the zeros of which are eigenvalues.
  std::vector<Real> turning_points(Real from, Real to) const {
    using Complex = std::complex<Real>;
    const Complex first(sin1, cos1), second(2 * sin2, 2 * cos2);
    std::vector<Real> angles{from, to};
    const auto add = [&](Complex z) {
      const Real angle = unwound(std::arg(z), from);
      if (angle > from && angle < to) angles.push_back(angle);
    };
    // second z^4 + first z^3 + conj(first) z + conj(second) = 0
    if (std::abs(second) > 1e-16L * std::abs(first)) {
      Eigen::Matrix<Complex, 4, 4> companion = Eigen::Matrix<Complex, 4, 4>::Zero();
      companion.bottomLeftCorner<3, 3>().setIdentity();
      companion.col(3) << -std::conj(second) / second, -std::conj(first) / second, 0,
          -first / second;
      const Eigen::ComplexEigenSolver<Eigen::Matrix<Complex, 4, 4>> zeros(companion, false);
      for (int k = 0; k < 4; ++k) add(zeros.eigenvalues()[k]);
    } else if (std::abs(first) > 0) {
      const Real angle = std::atan2(sin1, cos1);
      add(std::polar(Real{1}, angle));
      add(std::polar(Real{1}, angle + pi));
    }
    std::sort(angles.begin(), angles.end());
    return angles;
  }
  Real least(Real from, Real to) const {
    Real value = std::numeric_limits<Real>::infinity();
    for (const Real angle : turning_points(from, to)) value = std::min(value, (*this)(angle));
    return value;
  }
};

/// Postures on which all contacts keep to their faces.
struct Arc {
  Field field;
  Real from, to;
  Effort V;
  Mat3 y;  ///< times harmonics(theta)
};

struct Gap {
  Field field;
  Real from, to;
  Vec y;
};

Real read_angle(const Field& field, const char* key) {
  return radians(field.get(key, "an angle in degrees").finite());
}

Arc read_arc(const Field& field) {
  const Field V = field.get("V", "a mapping"), y = field.get("y", "a mapping");
  const auto coefficient = [&](const char* key) { return V.get(key, "a number").finite(); };
  const auto column = [&](const char* key) { return read_vector(y.get(key, "a twist"), 3); };
  Arc arc{field,
          read_angle(field, "from_deg"),
          read_angle(field, "to_deg"),
          {coefficient("c0"), coefficient("cos1"), coefficient("sin1"), coefficient("cos2"),
           coefficient("sin2")},
          {}};
  arc.y << column("c0"), column("cos1"), column("sin1");
  return arc;
}

/// A face of the trapezoid {|t| <= mu n, lo <= n <= hi}: there the force is P z + f0, for all z
/// with every `side` at least 0.
struct Face {
  Eigen::Matrix<Real, 2, 2> P = Eigen::Matrix<Real, 2, 2>::Zero();
  Eigen::Matrix<Real, 2, 1> f0 = Eigen::Matrix<Real, 2, 1>::Zero();
  std::vector<Vec3> sides{};  ///< a + b z_n + c z_t
};

/// The face to which z is projected.
Face face_of(const Touch& contact, const Eigen::Matrix<Real, 2, 1>& z) {
  const Real mu = contact.friction, lo = contact.lo, hi = contact.hi, sign = z[1] < 0 ? -1 : 1;
  const bool limited = std::isfinite(hi);
  const auto limit = [&](Face& face, const Vec3& n) {  // lo <= n <= hi
    face.sides.emplace_back(n - Vec3(lo, 0, 0));
    if (limited) face.sides.emplace_back(Vec3(hi, 0, 0) - n);
  };
  const Vec3 one(1, 0, 0), n(0, 1, 0), t(0, 0, sign);
  const Vec3 foot = (n + mu * t) / (1 + mu * mu);
  const auto at = [&](const Vec3& side) { return side[0] + side[1] * z[0] + side[2] * z[1]; };
  Face face;
  const Real clamped = std::clamp(z[0], lo, hi);
  if (at(t) <= mu * clamped) {  // inside, or on a flat side
    face.P(1, 1) = 1;
    if (z[0] > lo && z[0] < hi) {
      face.P(0, 0) = 1;
      limit(face, n);
      face.sides.emplace_back(mu * n - t);
      face.sides.emplace_back(mu * n + t);
    } else {
      face.f0[0] = clamped;
      if (lo < hi) face.sides.emplace_back(z[0] <= lo ? Vec3(lo * one - n) : Vec3(n - hi * one));
      face.sides.emplace_back(mu * clamped * one - t);
      face.sides.emplace_back(mu * clamped * one + t);
    }
  } else if (at(foot) > lo && at(foot) < hi) {  // an edge
    const Eigen::Matrix<Real, 2, 1> edge(1, mu * sign);
    face.P = edge * edge.transpose() / (1 + mu * mu);
    limit(face, foot);
    if (mu > 0) face.sides.emplace_back(t - mu * n);  // else both edges are one
  } else {                                            // a corner, or the apex
    const Real corner = at(foot) <= lo ? lo : hi;
    face.f0 << corner, sign * mu * corner;
    const Real beyond = at(foot) <= lo ? -1 : 1;
    if (lo < hi) face.sides.emplace_back(beyond * (foot - corner * one));
    if (corner > 0 && mu > 0)
      face.sides.emplace_back(t - mu * corner * one);
    else if (corner <= 0 && lo < hi)
      face.sides.emplace_back(beyond * (n - mu * t) / (1 + mu * mu));
  }
  return face;
}

/// Checks that the arc's y gives forces that balance all along the arc, at an effort of V: then it
/// also proves that no others have less.
void check_arc(Claims& claims, const Held& held, const Arc& arc, Real force_cap) {
  const Load& load = held.loads.front();
  const Real W = load.weight, middle = (arc.from + arc.to) / 2;
  claims.check(arc.field, "from_deg is not above to_deg, nor by more than a turn below",
               arc.from <= arc.to && arc.to - arc.from <= 2 * pi + ends);
  const auto states = arc.field.get("states", "a list of states").list();
  if (states.size() != held.contacts.size())
    arc.field.get("states", "a list").fail("must have as many states as the grasp has contacts");

  const Mat3 w = load_matrix(load);
  Mat3 Q = 2 * arc.y.transpose() * w;  // twice the dual value is e^T Q e, e = harmonics(theta)
  Mat3 off = w;
  Real outside = 0, length = W;
  for (std::size_t i = 0; i < held.contacts.size(); ++i) {
    const Touch& contact = held.contacts[i];
    const Mat z = contact.share * contact.G.transpose() * arc.y;  // 2 x 3
    const Face face = face_of(contact, z * harmonics(middle));
    Mat f = face.P * z;
    f.col(0) += face.f0;
    Q -= (2 * z.transpose() * f - f.transpose() * f) / contact.share;
    off -= contact.G * f;
    length = std::max(length, (contact.G.cwiseAbs().transpose() * arc.y.cwiseAbs()).sum());
    for (const Vec3& side : face.sides) {
      Vec3 g = z.transpose() * side.tail<2>();
      g[0] += side[0];
      outside = std::max(outside, -least(g, arc.from, arc.to) / std::max(z.norm(), W));
    }

    const Eigen::Matrix<Real, 2, 1> force = f * harmonics(middle);
    const Real n = force[0], t = std::abs(force[1]);
    const Field state = states[i].get("state", "unloaded, sticking or slipping");
    const Field limit = states[i].get("limit", "none, min or max");
    const std::string &is = state.word({"unloaded", "sticking", "slipping"}),
                      &at = limit.word({"none", "min", "max"});
    const Real little = 1e-8L * W;
    const bool unloaded = n <= little, slipping = contact.friction * n - t <= little;
    claims.check(state, "state is that of the arc's middle",
                 is == "unloaded"   ? unloaded
                 : is == "slipping" ? slipping
                                    : n > 0 && t <= contact.friction * n);
    const bool max = n >= contact.hi - little, min = contact.lo > 0 && n <= contact.lo + little;
    claims.check(limit, "limit is that of the arc's middle",
                 at == "max"   ? max
                 : at == "min" ? min
                               : (!max && !min) || n < 1e-6L * W);
  }
  claims.check(arc.field, "contacts keep to their faces along the arc [of y]", outside, 1e-7L);

  const Real digits = 1e-15L * length / W;  // what y loses by its rounding
  for (const Real theta : {arc.from, middle, arc.to}) {
    const Vec left = off * harmonics(theta);
    const Vec force = left.head(2);
    const Real moment = (left - wrench(force, load.com))[2];
    Real error = force.norm() / W;
    if (load.radius > 0) error = std::max(error, std::abs(moment) / (W * load.radius));
    claims.check(arc.field, "forces balance the load along the arc [weights]", error,
                 1e-11L + digits);
  }

  const Field V = arc.field.get("V", "a mapping");
  const Effort dual{Q(0, 0) + (Q(1, 1) + Q(2, 2)) / 2, Q(0, 1) + Q(1, 0), Q(0, 2) + Q(2, 0),
                    (Q(1, 1) - Q(2, 2)) / 2, (Q(1, 2) + Q(2, 1)) / 2};
  const Real scale = dual.scale();
  if (arc.from == arc.to) {  // a single posture: V is a number
    claims.check(V, "V is twice the dual value of y [of V]",
                 difference(arc.V(middle), dual(middle)), 1e-9L);
  } else {
    for (const auto& [key, claimed, true_value] :
         {std::tuple{"c0", arc.V.c0, dual.c0}, std::tuple{"cos1", arc.V.cos1, dual.cos1},
          std::tuple{"sin1", arc.V.sin1, dual.sin1}, std::tuple{"cos2", arc.V.cos2, dual.cos2},
          std::tuple{"sin2", arc.V.sin2, dual.sin2}})
      claims.check(V.get(key, "a number"), "V is twice the dual value of y [of all coefficients]",
                   std::abs(claimed - true_value) / scale, 1e-11L + 4e-15L * std::sqrt(scale) / W);
  }
  const Real cap = force_cap * W,
             most = -Effort{-arc.V.c0, -arc.V.cos1, -arc.V.sin1, -arc.V.cos2, -arc.V.sin2}.least(
                 arc.from, arc.to);
  claims.check(arc.field, "V is within the force cap: V / cap^2", most / (cap * cap), 1 + 1e-6L);
}

/// Within rounding of where arcs end; a single posture is not.
bool is_sliver(const Arc& arc) { return arc.from != arc.to && std::abs(arc.to - arc.from) <= ends; }

std::vector<Arc> check_arcs(Claims& claims, const Held& held, const Field& root, Real force_cap) {
  std::vector<Arc> arcs;
  for (const Field& field : root.get("arcs", "a list of arcs").list()) {
    arcs.push_back(read_arc(field));
    if (is_sliver(arcs.back()))
      claims.note("An arc narrower than 2e-8 rad proves nothing; its neighbours must.");
    else
      check_arc(claims, held, arcs.back(), force_cap);
  }
  return arcs;
}

/// What y proves of the effort in all postures between two: twice its dual value, less `balance`
/// times what it moves the com by.
Vec3 proof(const Held& held, const Vec& y, Real balance) {
  const Load& load = held.loads.front();
  Vec3 g = 2 * load_matrix(load).transpose() * y.head<3>();
  g[0] -= 2 * phi(held, y) + 2 * balance * worth(load, y);
  return g;
}

/// The domain [rad]: from <= to <= from + 2 pi.
struct Domain {
  Real from, to;
  bool circle;
};

/// The postures of the fork, an open interval; none if it has no width.
struct Wedge {
  Real from{0}, to{0};
  bool unclear{false};
};

Real distance_to_segment(const Vec& a, const Vec& b) {
  const Vec ab = b - a;
  const Real s =
      ab.squaredNorm() > 0 ? std::clamp(-a.dot(ab) / ab.squaredNorm(), Real{0}, Real{1}) : 0;
  return (a + s * ab).norm();
}

// Down points into the cone which the contacts span, seen from the com outside of their hull: into
// the rest of the widest angle between neighbouring directions.
Wedge wedge_of(const Held& held, const Load& load) {
  std::vector<Vec> arms;
  for (const Touch& contact : held.contacts) arms.emplace_back(contact.position - load.com);
  const auto direction = [](const Vec& arm) { return std::atan2(arm[1], arm[0]); };
  std::sort(arms.begin(), arms.end(),
            [&](const Vec& a, const Vec& b) { return direction(a) < direction(b); });
  Real distance = std::numeric_limits<Real>::infinity(), widest = -1;
  std::size_t first = 0;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const Real turn = i == 0 ? direction(arms[0]) + 2 * pi - direction(arms.back())
                             : direction(arms[i]) - direction(arms[i - 1]);
    if (turn > widest) widest = turn, first = i;
  }
  for (const Vec& a : arms)
    for (const Vec& b : arms) distance = std::min(distance, distance_to_segment(a, b));
  if (widest <= pi || distance <= 0.999e-9L * load.radius) return {};  // or the com is inside
  const Vec& last = arms[(first + arms.size() - 1) % arms.size()];
  const Real from = std::atan2(-last[0], -last[1]), width = 2 * pi - widest;
  if (width <= 1e-12L) return {};
  return {from, from + width, distance < 1.001e-9L * load.radius};
}

Domain read_domain(const Held& held, const Field& options) {
  const std::string& word = options.get("domain", "all or pinched").word({"all", "pinched"});
  const Wedge wedge = wedge_of(held, held.loads.front());
  if (word == "all" || !(wedge.to > wedge.from)) return {-pi, pi, true};
  return {wedge.to, wedge.from + 2 * pi, false};
}

/// Arcs that follow each other without a break.
struct Chain {
  std::vector<Arc> arcs;  ///< unwound
  bool circle{false};
  Real from() const { return arcs.front().from; }
  Real to() const { return arcs.back().to; }
};

/// Checks that the arcs tile the holdable intervals and keep to the domain.
std::vector<Chain> check_tiling(Claims& claims, const std::vector<Arc>& arcs, const Field& root,
                                const Domain& domain) {
  const Field list = root.get("holdable_arcs_deg", "a list of intervals");
  std::vector<Chain> chains;
  std::vector<bool> used(arcs.size());
  std::vector<std::pair<Real, Real>> intervals;
  for (const Field& field : list.list()) {
    const Vec interval = read_vector(field, 2);
    Real from = radians(interval[0]), to = radians(interval[1]);
    const bool whole = interval[1] - interval[0] >= 360;
    claims.check(field, "from is in [-180, 180), from <= to <= from + 360",
                 interval[0] >= -180 && interval[0] < 180 && from <= to && to <= from + 2 * pi);
    for (const auto& [other_from, other_to] : intervals) {
      const Real next = unwound(from, other_from);
      claims.check(field, "intervals do not overlap",
                   next > other_to && next + to - from < other_from + 2 * pi);
    }
    intervals.emplace_back(from, to);
    Chain chain{{}, whole};
    if (whole && !arcs.empty()) from = arcs.front().from, to = from + 2 * pi;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      Arc arc = arcs[i];
      arc.from = unwound(arc.from, from);
      arc.to += arc.from - arcs[i].from;
      if (used[i] || arc.to > to + ends) continue;
      used[i] = true;
      chain.arcs.push_back(arc);
    }
    std::stable_sort(chain.arcs.begin(), chain.arcs.end(),
                     [](const Arc& a, const Arc& b) { return a.from < b.from; });
    if (chain.arcs.empty()) {
      claims.check(field, "arcs tile the interval [rad]", 2 * pi, ends);
      continue;
    }
    Real off = std::max(std::abs(chain.from() - from), std::abs(chain.to() - to));
    for (std::size_t i = 1; i < chain.arcs.size(); ++i)
      off = std::max(off, std::abs(chain.arcs[i].from - chain.arcs[i - 1].to));
    claims.check(field, "arcs tile the interval [rad]", off, ends);
    chains.push_back(std::move(chain));
  }
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const Arc& arc = arcs[i];
    claims.check(arc.field, "arc lies in a holdable interval", used[i]);
    if (domain.circle) continue;
    const Real from = unwound(arc.from, domain.from);
    claims.check(arc.field, "arc lies in the domain [rad]",
                 std::max({Real{0}, domain.from - from, from + arc.to - arc.from - domain.to}),
                 ends);
  }
  return chains;
}

/// Postures, next to each other, that are as low (or, turned round, as high) as any around.
struct Valley {
  Real from, to;
};

/// The local minima of sign * V along a chain that are deeper than rounding.
std::vector<Valley> valleys(const Chain& chain, Real sign) {
  struct Point {
    Real at, value, rounding;
  };
  std::vector<Point> points;
  for (int round = 0; round < (chain.circle ? 2 : 1); ++round)  // twice around: none is at an end
    for (const Arc& arc : chain.arcs)
      for (const Real at : arc.V.turning_points(arc.from, arc.to))
        points.push_back({at + 2 * pi * round, sign * arc.V(at),
                          1e-9L * std::abs(arc.V(at)) + 1e-12L * arc.V.scale()});
  std::vector<Valley> found;
  std::size_t lowest = 0, highest = 0;  // since the last turn
  bool falling = !chain.circle;         // may the way down be the end
  const auto add = [&](std::size_t k) {
    std::size_t first = k, last = k;
    const Real level = points[k].value;
    while (first > 0 && points[first - 1].value <= level + points[k].rounding) --first;
    while (last + 1 < points.size() && points[last + 1].value <= level + points[k].rounding) ++last;
    found.push_back({points[first].at, points[last].at});
  };
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point& p = points[k];
    if (falling) {
      if (p.value < points[lowest].value) lowest = k;
      if (p.value > points[lowest].value + p.rounding + points[lowest].rounding) {
        add(lowest);
        falling = false;
        highest = k;
      }
    } else {
      if (p.value > points[highest].value) highest = k;
      if (p.value < points[highest].value - p.rounding - points[highest].rounding) {
        falling = true;
        lowest = k;
      }
    }
  }
  if (falling && !chain.circle) add(lowest);
  if (chain.circle && found.empty())
    found.push_back({points.front().at, points.front().at + 2 * pi});
  return found;
}

bool within(Real angle, Real from, Real to, Real slack) {
  return unwound(angle, from - slack) <= to + slack;
}

/// An optimum of a list.
struct OptimumClaim {
  Field field;
  HoldClaim hold;
  std::string kind{};
  Real from{0}, to{0};  ///< the stretch
  Real digits{0};       ///< what the effort lost where it was found, relative: arcs are steep
};

/// The edges along which two contacts press, and the vertical through the com, meet in one point.
void check_meeting(Claims& claims, const Held& held, const OptimumClaim& optimum) {
  const bool asked =
      optimum.kind == "kink" && optimum.hold.loaded.size() == 2 && optimum.hold.slipping;
  if (!asked) return;
  const Field field =
      optimum.field.get("edges_meet", "a point, or null where the edges are parallel");
  const Load& load = held.loads.front();
  std::array<Vec, 2> edges;
  const auto contacts = optimum.field.get("contacts", "a list").list();
  for (std::size_t k = 0; k < 2; ++k)
    edges[k] =
        read_vector(contacts[optimum.hold.loaded[k]].get("force", "a force"), 2).normalized();
  const auto cross = [](const Vec& a, const Vec& b) { return a[0] * b[1] - a[1] * b[0]; };
  const Real sine = std::abs(cross(edges[0], edges[1]));
  if (field.is_null()) {
    claims.check(field, "edges are parallel", sine, 1.1e-9L);
    return;
  }
  const Vec point = read_vector(field, 2);
  const Real extent = (point - load.com).norm() + load.radius, size = extent > 0 ? extent : 1;
  for (std::size_t k = 0; k < 2; ++k)
    claims.check(
        field, "edges_meet is on the edges of the cones [of its distance]",
        std::abs(cross(point - held.contacts[optimum.hold.loaded[k]].position, edges[k])) / size,
        1e-9L);
  claims.check(field, "edges_meet is on the vertical through the com [of its distance]",
               std::abs(cross(point - load.com, optimum.hold.up)) / size,
               1e-9L / std::max(sine, Real{1e-6L}));
}

/// Checks an optimum by itself and where it lies on the arcs.
OptimumClaim check_optimum(Claims& claims, const Held& held, const Field& field,
                           const std::vector<Chain>& chains, bool maximum, Real force_cap) {
  OptimumClaim claim{field, check_hold(claims, held, field, force_cap)};
  claim.kind = field.get("kind", "boundary, kink or smooth").word({"boundary", "kink", "smooth"});
  claims.check(field, "an optimum is holdable", claim.hold.holdable);
  if (!claim.hold.holdable) return claim;
  const Real at = claim.hold.angle, sign = maximum ? -1 : 1;
  claim.from = claim.to = at;
  const auto from = field.find("from_deg"), to = field.find("to_deg");
  if (from || to) {
    claim.from = read_angle(field, "from_deg");
    claim.to = read_angle(field, "to_deg");
    const Real middle = (claim.from + claim.to) / 2;
    claims.check(field, "the posture is the middle of its stretch [rad]",
                 std::abs(std::remainder(middle - at, 2 * pi)), 1e-9L);
  }

  Real off = 1, steep = 0, jump = 0, differs = 0, flattest = 1;
  bool at_end = false, fits = false;
  for (const Chain& chain : chains) {
    const Real start = chain.from();
    const Real here = unwound(claim.from, start), last = here + claim.to - claim.from;
    const Real beyond = std::max(start - here, last - chain.to());
    if (!chain.circle && beyond > ends) continue;
    fits = true;
    at_end = !chain.circle && (here - start <= 2 * ends || chain.to() - last <= 2 * ends);
    std::optional<Real> before, after;
    for (const Arc& arc : chain.arcs) {
      for (const Real turn : {Real{0}, -2 * pi, 2 * pi}) {  // where a circle is closed
        const Real from_here = std::clamp(here - turn, arc.from, arc.to);
        const Real to_here = std::clamp(last - turn, arc.from, arc.to);
        if (std::abs(from_here - (here - turn)) <= ends && arc.to - (here - turn) >= -ends) {
          off = std::min(off, difference(arc.V(from_here), claim.hold.effort));
          const Real slope = arc.V.slope(from_here);
          flattest =
              std::min(flattest, std::abs(slope) / (claim.hold.effort + 1e-4L * arc.V.scale()));
          claim.digits = std::max(claim.digits, 1e-13L * arc.V.scale() / claim.hold.effort);
        }
        if (is_sliver(arc)) continue;
        // One-sided slopes, of the arcs that reach the ends of the stretch.
        if (here - turn > arc.from + ends && here - turn <= arc.to + 2 * ends && arc.to > arc.from)
          before = arc.V.slope(from_here) / (claim.hold.effort + 1e-4L * arc.V.scale());
        if (last - turn >= arc.from - 2 * ends && last - turn < arc.to - ends)
          after = arc.V.slope(to_here) / (claim.hold.effort + 1e-4L * arc.V.scale());
        // Inside of the stretch V is the same.
        if (std::max(here - turn, arc.from) < std::min(last - turn, arc.to))
          for (const Real x : {std::max(here - turn, arc.from), std::min(last - turn, arc.to)})
            differs = std::max(differs, difference(arc.V(x), claim.hold.effort));
      }
    }
    if (before) steep = std::max(steep, sign * *before);
    if (after) steep = std::max(steep, -sign * *after);
    if (before && after) jump = *after - *before;
  }
  claims.check(field, "the posture lies in a holdable interval", fits);
  claims.check(field, "effort is V of its arc", off, 1e-7L + claim.digits);
  claims.check(field, "V rises from a minimum and falls from a maximum [of V, per rad]", steep,
               1e-5L);
  if (claim.to - claim.from > 0)
    claims.check(field, "V is the same along the stretch", differs, 1e-8L);
  const Field kind = field.get("kind", "a word");
  const bool stretch = claim.to - claim.from > 1e-8L;
  const bool right = claim.kind == "boundary" ? at_end
                     : claim.kind == "kink"
                         ? !stretch && !at_end && jump > 1e-12L
                         : !at_end && (stretch || jump < 1e-6L || flattest < 1e-5L);
  claims.check(kind, "kind follows from the arcs", right);
  check_meeting(claims, held, claim);
  return claim;
}

/// Checks that a list holds every minimum or maximum of the arcs, and each once.
void check_complete(Claims& claims, const Field& list, const std::vector<OptimumClaim>& optima,
                    const std::vector<Chain>& chains, bool maxima) {
  const std::string words = maxima ? "maxima" : "minima";
  for (const Chain& chain : chains)
    for (const Valley& valley : valleys(chain, maxima ? -1 : 1)) {
      const auto inside = [&](const OptimumClaim& optimum) {
        return within(optimum.hold.angle, valley.from, valley.to, 2 * ends) ||
               within(valley.from, optimum.from, optimum.to, 2 * ends);
      };
      claims.check(list, "all " + words + " of the arcs are in the list",
                   std::any_of(optima.begin(), optima.end(), inside));
    }
  for (std::size_t i = 0; i < optima.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      claims.check(
          optima[i].field, words + " are listed once",
          std::abs(std::remainder(optima[i].hold.angle - optima[k].hold.angle, 2 * pi)) > 1e-9L);
  for (std::size_t i = 1; i < optima.size(); ++i) {
    const HoldClaim &a = optima[i - 1].hold, &b = optima[i].hold;
    const Real worse = (maxima ? b.effort - a.effort : a.effort - b.effort) / b.effort;
    const Real digits = optima[i - 1].digits + optima[i].digits;
    claims.check(optima[i].field, "optima are in the order of their effort", worse, 2e-9L + digits);
    if (std::abs(worse) + digits > 0.5e-9L) continue;
    const Real nearer = std::abs(b.angle) - std::abs(a.angle);
    claims.check(optima[i].field, "of equal optima that of the least angle is first",
                 nearer > -2e-8L && (nearer > 2e-8L || b.angle <= a.angle + 1e-7L));
  }
}

/// Where two claims are about one posture, they must be the same.
void check_same(Claims& claims, const OptimumClaim& a, const OptimumClaim& b,
                const std::string& words) {
  claims.check(a.field, words,
               difference(a.hold.effort, b.hold.effort) +
                   std::abs(std::remainder(a.hold.angle - b.hold.angle, 2 * pi)),
               1e-9L);
}

/// Checks that arcs and unholdable arcs cover the domain, and returns the least effort that is
/// proven there; the lower bound itself where nothing can be held.
Real check_cover(Claims& claims, const Held& held, const Field& root, const std::vector<Arc>& arcs,
                 const std::vector<Gap>& gaps, const Domain& domain, bool open) {
  struct Piece {
    const Field* field;
    Real from, to;
    Vec y_from, y_to;  ///< what its ends prove their neighbours by
    bool arc;
  };
  Real start = domain.from;
  if (domain.circle && !(arcs.empty() && gaps.empty()))
    start = arcs.empty() ? gaps.front().from : arcs.front().from;
  const Real stop = domain.circle ? start + 2 * pi : domain.to;
  std::vector<Piece> pieces;
  const auto add = [&](const Field& field, Real from, Real to, const Vec& a, const Vec& b,
                       bool arc) {
    const Real at = unwound(from, start);
    pieces.push_back({&field, at, at + to - from, a, b, arc});
  };
  for (const Arc& arc : arcs)
    if (!is_sliver(arc))
      add(arc.field, arc.from, arc.to, arc.y * harmonics(arc.from), arc.y * harmonics(arc.to),
          true);
  for (const Gap& gap : gaps) add(gap.field, gap.from, gap.to, gap.y, gap.y, false);
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });

  Real value = std::numeric_limits<Real>::infinity();
  for (const Arc& arc : arcs)
    if (!is_sliver(arc)) value = std::min(value, arc.V.least(arc.from, arc.to));

  // Walk once around. Between two pieces: what any y that is at hand proves, the neighbours' first.
  Real reached = start;
  const Piece* before = nullptr;
  if (domain.circle && !pieces.empty())
    before = &*std::max_element(pieces.begin(), pieces.end(),
                                [](const Piece& a, const Piece& b) { return a.to < b.to; });
  const auto reach = [&](const Field& at, Real to, const Piece* after) {
    if (!open)
      claims.check(at, "arcs and unholdable arcs cover the domain [rad]", to - reached, ends);
    const bool by_arcs = (before && before->arc) || (after && after->arc);
    if (to <= reached || (to - reached <= ends && !by_arcs)) return;
    Real best = -std::numeric_limits<Real>::infinity();
    const auto use = [&](const Vec& y) {
      best = std::max(best, least(proof(held, y, 0), reached, to));
    };
    if (before) use(before->y_to);
    if (after) use(after->y_from);
    if (to - reached > ends)
      for (const Piece& piece : pieces) use(piece.y_from), use(piece.y_to);
    value = std::min(value, best * (1 + 2e-6L));
  };
  for (const Piece& piece : pieces) {
    reach(*piece.field, piece.from, &piece);
    claims.check(*piece.field, "arcs do not overlap [rad]",
                 std::min(reached, piece.to) - piece.from, ends);
    if (piece.to >= reached) before = &piece;
    reached = std::max(reached, piece.to);
  }
  reach(root, stop, domain.circle && !pieces.empty() ? &pieces.front() : nullptr);
  claims.check(root, "arcs keep to the domain [rad]", reached - stop, ends);
  return value;
}

/// Checks that y proves all postures of an unholdable arc. A longer or shorter y is as good.
void check_gap(Claims& claims, const Held& held, const Gap& gap, Real cap) {
  const Real from = gap.from + ends, to = gap.to - ends;
  Real best = 0;
  if (from < to)
    for (int exponent = -80; exponent <= 80 && best <= cap * cap; exponent += 2) {
      const Vec y = std::ldexp(Real{1}, exponent) * gap.y;
      best = std::max(best, least(proof(held, y, delta), from, to));
    }
  claims.check(gap.field, "y proves that the force cap is not enough: cap^2 / bound",
               from >= to ? 0
               : best > 0 ? cap * cap / best
                          : 2,
               1);
}

Real force_cap(const Field& options) {
  return options.get("force_cap", "a number of weights").finite();
}

}  // namespace

Real radians(Real degrees) { return degrees * (pi / 180); }

Vec up_at(Real theta) {
  Vec up(2);
  up << std::sin(theta), std::cos(theta);
  return up;
}

Fork fork_in_plane(const Held& held, const Load& load, const Vec& up) {
  const Wedge wedge = wedge_of(held, load);
  if (!(wedge.to > wedge.from)) return Fork::no;
  if (wedge.unclear) return Fork::unclear;
  const Real at = std::atan2(up[0], up[1]), half = (wedge.to - wedge.from) / 2;
  const Real inside = half - std::abs(std::remainder(at - (wedge.to + wedge.from) / 2, 2 * pi));
  return inside > 1e-9L ? Fork::yes : inside < -1e-9L ? Fork::no : Fork::unclear;
}

void check_curve(Claims& claims, const Held& held, const Field& root) {
  const Field options = root.get("options", "a mapping");
  const Real cap = force_cap(options);
  const Domain domain = read_domain(held, options);
  const auto arcs = check_arcs(claims, held, root, cap);
  const auto chains = check_tiling(claims, arcs, root, domain);
  std::vector<OptimumClaim> minima, maxima;
  const Field list = root.get("optima", "a list of holds");
  for (const Field& field : list.list()) {
    const Field type = field.get("type", "min or max");
    const bool maximum = type.word({"min", "max"}) == "max";
    auto& optima = maximum ? maxima : minima;
    optima.push_back(check_optimum(claims, held, field, chains, maximum, cap));
    claims.check(type, "minima come before maxima", maximum || maxima.empty());
  }
  check_complete(claims, list, minima, chains, false);
  check_complete(claims, list, maxima, chains, true);
  claims.note(
      "This document has no proof that the postures beside its arcs cannot be held; that of "
      "poise best has.");
}

void check_best_in_plane(Claims& claims, const Held& held, const Field& root) {
  const Field options = root.get("options", "a mapping");
  const Real weights = force_cap(options), cap = weights * held.loads.front().weight;
  const Domain domain = read_domain(held, options);
  const Field status = root.get("status", "optimal, gap or unholdable");
  const std::string& is = status.word({"optimal", "gap", "unholdable"});
  const auto arcs = check_arcs(claims, held, root, weights);
  const auto chains = check_tiling(claims, arcs, root, domain);
  std::vector<Gap> gaps;
  for (const Field& field : root.get("unholdable_arcs", "a list of arcs").list()) {
    gaps.push_back({field, read_angle(field, "from_deg"), read_angle(field, "to_deg"),
                    read_vector(field.get("y", "a twist"), 3)});
    check_gap(claims, held, gaps.back(), cap);
  }
  const Real value = check_cover(claims, held, root, arcs, gaps, domain, is == "gap");

  std::vector<OptimumClaim> minima;
  const Field list = root.get("minima", "a list of holds");
  for (const Field& field : list.list())
    minima.push_back(check_optimum(claims, held, field, chains, false, weights));
  check_complete(claims, list, minima, chains, false);
  const Field best = root.get("best", "a hold or null");
  const Field pinched = root.get("best_pinched", "a hold or null");
  const Field worst = root.get("worst", "a hold or null");
  const Field lower = root.get("lower_bound", "a number [N^2] or null");
  const Field gap = root.get("relative_gap", "a number or null");
  claims.check(best, "best is null where there are no minima", best.is_null() == minima.empty());
  claims.check(status, "status is unholdable only where there are no minima",
               minima.empty() ? is != "optimal" : is != "unholdable");
  if (best.is_null() || minima.empty()) {
    for (const Field& field : {pinched, worst, lower, gap})
      claims.check(field, "is null where nothing is held", field.is_null());
    return;
  }
  check_same(claims, check_optimum(claims, held, best, chains, false, weights), minima.front(),
             "best is the first of the minima");
  const auto squeezed = [](const OptimumClaim& minimum) {
    return minimum.hold.manner == "pinched" && minimum.kind != "boundary";
  };
  const auto first = std::find_if(minima.begin(), minima.end(), squeezed);
  claims.check(pinched, "best_pinched is null where no interior minimum is pinched",
               pinched.is_null() == (first == minima.end()));
  if (!pinched.is_null() && first != minima.end())
    check_same(claims, check_optimum(claims, held, pinched, chains, false, weights), *first,
               "best_pinched is the lowest interior minimum that is pinched");

  Real most = 0;
  for (const Chain& chain : chains)
    for (const Arc& arc : chain.arcs)
      for (const Real at : arc.V.turning_points(arc.from, arc.to)) most = std::max(most, arc.V(at));
  const OptimumClaim highest = check_optimum(claims, held, worst, chains, true, weights);
  claims.check(worst, "worst is the highest V of the arcs", difference(highest.hold.effort, most),
               1e-7L);

  const Real effort = minima.front().hold.effort, bound = lower.finite();
  claims.check(lower, "lower_bound is not above what the y of the arcs prove [of effort]",
               (bound - value) / effort, 1e-8L + minima.front().digits);
  claims.check(gap, "relative_gap is (effort - lower_bound) / effort",
               std::abs(gap.finite() - (effort - bound) / effort), 1e-14L);
  if (is == "optimal")
    claims.check(lower, "the best is optimal: the gap is closed", (effort - bound) / effort,
                 1e-8L + minima.front().digits);
}

}  // namespace poise::verify
