#include "shape/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shape/number_text.hpp"

namespace poise {
namespace {

// Every pair of edges is looked at: this many take about a tenth of a second.
constexpr std::size_t max_vertices = 10'000;

double cross(const Vector<2>& a, const Vector<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

int side(const Vector<2>& a, const Vector<2>& b, const Vector<2>& point) {
  const double c = cross(b - a, point - a);
  return (c > 0) - (c < 0);
}

struct Edge {
  Vector<2> from, to;

  Vector<2> lower() const { return from.cwiseMin(to); }
  Vector<2> upper() const { return from.cwiseMax(to); }
};

Edge edge(const Polygon& polygon, std::size_t i) {
  const auto& v = polygon.vertices;
  return {v[i], v[i + 1 == v.size() ? 0 : i + 1]};
}

/// Two segments that share a point: of each, the ends lie on different sides of the other. Segments
/// on one line are left to their boxes.
bool meet(const Edge& a, const Edge& b) {
  if ((a.upper().array() < b.lower().array()).any() ||
      (b.upper().array() < a.lower().array()).any())
    return false;
  return side(a.from, a.to, b.from) * side(a.from, a.to, b.to) <= 0 &&
         side(b.from, b.to, a.from) * side(b.from, b.to, a.to) <= 0;
}

/// An edge and the next one, which runs back over it.
bool fold(const Edge& a, const Edge& b) {
  return side(a.from, a.to, b.to) == 0 && (a.to - a.from).dot(b.to - b.from) < 0;
}

/// The vertices moved and scaled so that they lie within 1 of the origin: no product overflows.
struct Scaled {
  Polygon polygon;
  Vector<2> origin;
  double scale;
};

Scaled scaled(const Polygon& polygon) {
  Vector<2> lower = polygon.vertices.front(), upper = lower;
  for (const auto& v : polygon.vertices) {
    lower = lower.cwiseMin(v);
    upper = upper.cwiseMax(v);
  }
  Scaled s{polygon, lower / 2 + upper / 2, (upper / 2 - lower / 2).stableNorm()};
  for (auto& v : s.polygon.vertices) v = (v - s.origin) / s.scale;
  return s;
}

[[noreturn]] void refuse(std::size_t i, std::size_t j, const std::string& problem) {
  throw InvalidShape("polygon", "edges " + std::to_string(i) + " and " + std::to_string(j) + " " +
                                    problem + ", an outline must not touch itself");
}

}  // namespace

void check_simple(const Polygon& polygon) {
  const std::size_t n = polygon.vertices.size();
  if (n < 3 || n > max_vertices)
    throw InvalidShape("polygon", "has " + std::to_string(n) + " vertices, must have 3 to " +
                                      std::to_string(max_vertices));
  for (std::size_t i = 0; i < n; ++i) {
    const auto [from, to] = edge(polygon, i);
    if (!polygon.vertices[i].allFinite() || !std::isfinite(polygon.vertices[i].squaredNorm()))
      throw InvalidShape("polygon[" + std::to_string(i) + "]", "must be finite, its square too");
    if (from == to)
      throw InvalidShape("polygon", "edge " + std::to_string(i) + ", from vertex " +
                                        std::to_string(i) + " to vertex " +
                                        std::to_string((i + 1) % n) +
                                        ", has no length: a vertex is given twice");
  }
  const Scaled s = scaled(polygon);
  if (!(s.scale * s.scale >= std::numeric_limits<double>::min()))
    throw InvalidShape("polygon", "is too small to compute with");
  for (std::size_t i = 0; i < n; ++i) {
    const Edge e = edge(s.polygon, i);
    const std::size_t next = (i + 1) % n;
    if (fold(e, edge(s.polygon, next))) refuse(i, next, "fold back on each other");
    for (std::size_t j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && meet(e, edge(s.polygon, j))) refuse(i, j, "cross or touch");
  }
  if (std::abs(area_and_centroid(s.polygon).signed_area) < 1e-12)
    throw InvalidShape("polygon", "encloses no area: its vertices lie on one line");
}

AreaAndCentroid area_and_centroid(const Polygon& polygon) {
  const Scaled s = scaled(polygon);
  double twice_area = 0;
  Vector<2> moment = Vector<2>::Zero();
  for (std::size_t i = 0; i < s.polygon.vertices.size(); ++i) {
    // The triangle between the origin and the edge.
    const auto [from, to] = edge(s.polygon, i);
    const double c = cross(from, to);
    twice_area += c;
    moment += c * (from + to) / 3;
  }
  return {twice_area / 2 * s.scale * s.scale, s.origin + s.scale * moment / twice_area};
}

double half_diagonal(const Polygon& polygon) { return scaled(polygon).scale; }

Boundary<2> boundary_of(const Polygon& polygon, const Vector<2>& point) {
  static const double one_degree = std::cos(std::numbers::pi / 180);
  const Scaled s = scaled(polygon);
  const double turn = area_and_centroid(s.polygon).signed_area > 0 ? 1 : -1;
  const Vector<2> p = (point - s.origin) / s.scale;
  const auto distance = [&](std::size_t i) {
    const auto [from, to] = edge(s.polygon, i);
    const Vector<2> along = to - from;
    const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - from - t * along).norm();
  };
  const auto normal = [&](std::size_t i) {
    const auto [from, to] = edge(s.polygon, i);
    return Vector<2>(turn * Vector<2>(from.y() - to.y(), to.x() - from.x()).stableNormalized());
  };
  std::size_t nearest = 0;
  Boundary<2> result{distance(0)};
  for (std::size_t i = 1; i < s.polygon.vertices.size(); ++i)
    if (const double d = distance(i); d < result.distance) {
      nearest = i;
      result.distance = d;
    }
  result.normal = normal(nearest);
  for (std::size_t i = 0; i < s.polygon.vertices.size() && result.corner.empty(); ++i)
    if (distance(i) <= boundary_tolerance && normal(i).dot(result.normal) < one_degree)
      result.corner = "at the corner between edges " + std::to_string(std::min(i, nearest)) +
                      " and " + std::to_string(std::max(i, nearest)) + " of the polygon";
  result.distance *= s.scale;
  return result;
}

}  // namespace poise
