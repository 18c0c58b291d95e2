#include "shape/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "shape/number_text.hpp"

namespace poise {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Triangle = std::array<int, 3>;

const Vector3d& corner(const Mesh& mesh, const Triangle& triangle, std::size_t k) {
  return mesh.vertices[static_cast<std::size_t>(triangle[k])];
}

AlignedBox3d box_of(const Mesh& mesh, const Triangle& triangle) {
  AlignedBox3d box(corner(mesh, triangle, 0));
  box.extend(corner(mesh, triangle, 1));
  box.extend(corner(mesh, triangle, 2));
  return box;
}

/// Half the diagonal of a bounding box.
double size_of(const AlignedBox3d& box) { return box.isEmpty() ? 0 : box.diagonal().norm() / 2; }

/// Six times the volume of the tetrahedron from a point to a triangle.
double six_volumes(const Mesh& mesh, const Triangle& triangle, const Vector3d& from) {
  return (corner(mesh, triangle, 0) - from)
      .dot((corner(mesh, triangle, 1) - from).cross(corner(mesh, triangle, 2) - from));
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}
std::string counted(std::size_t count, const std::string& thing) {
  return counted(count, thing, thing + "s");
}

/// Sets of which any two may be made one.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::size_t a, std::size_t b) { parent_[of(b)] = of(a); }

 private:
  std::vector<std::size_t> parent_;
};

/// The same surface with other vertices: `to` tells which takes the place of each. Triangles that
/// shrink to a line are left out, and vertices that no triangle has.
Mesh renumbered(const Mesh& mesh, const std::vector<int>& to) {
  Mesh result;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (Triangle triangle : mesh.triangles) {
    for (int& vertex : triangle) vertex = to[static_cast<std::size_t>(vertex)];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      continue;
    for (int& vertex : triangle) {
      int& mine = number[static_cast<std::size_t>(vertex)];
      if (mine < 0) {
        mine = static_cast<int>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[static_cast<std::size_t>(vertex)]);
      }
      vertex = mine;
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

/// Without vertices that no triangle has.
Mesh without_others(const Mesh& mesh) {
  std::vector<int> same(mesh.vertices.size());
  std::iota(same.begin(), same.end(), 0);
  return renumbered(mesh, same);
}

/// For each vertex the first that is equal to it.
std::vector<int> first_equals(const Mesh& mesh) {
  const auto at = [&](int i) -> const Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(i)];
  };
  std::vector<int> order(mesh.vertices.size()), to(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const Vector3d &p = at(a), &q = at(b);
    return std::tie(p[0], p[1], p[2], a) < std::tie(q[0], q[1], q[2], b);
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool equal = k > 0 && at(order[k]) == at(order[k - 1]);
    to[static_cast<std::size_t>(order[k])] =
        equal ? to[static_cast<std::size_t>(order[k - 1])] : order[k];
  }
  return to;
}

/// Makes vertices one that are no farther apart than this.
Mesh welded(const Mesh& mesh, double tolerance) {
  if (tolerance == 0) return renumbered(mesh, first_equals(mesh));
  // In cells twice as wide, what is near to a point lies in one of eight.
  using Cell = std::array<long long, 3>;
  const auto hash = [](const Cell& cell) {
    std::uint64_t sum = 0;
    for (const long long part : cell)
      sum = (sum ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(sum ^ sum >> 32);
  };
  std::unordered_map<Cell, std::vector<int>, decltype(hash)> cells(mesh.vertices.size(), hash);
  const auto cell_of = [](const Vector3d& p) {
    const Vector3d low = p.array().floor();
    return Cell{static_cast<long long>(low.x()), static_cast<long long>(low.y()),
                static_cast<long long>(low.z())};
  };
  const Vector3d corner = bounds(mesh).min();
  std::vector<int> to(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3d& p = mesh.vertices[i];
    const Vector3d in_cells = (p - corner) / (2 * tolerance);
    const Cell first = cell_of(in_cells - Vector3d::Constant(0.5));
    int near = -1;
    for (int k = 0; k < 8 && near < 0; ++k) {
      const auto found =
          cells.find({first[0] + (k & 1), first[1] + (k >> 1 & 1), first[2] + (k >> 2)});
      if (found == cells.end()) continue;
      for (const int other : found->second)
        if ((mesh.vertices[static_cast<std::size_t>(other)] - p).norm() <= tolerance) near = other;
    }
    to[i] = near < 0 ? static_cast<int>(i) : near;
    if (near < 0) cells[cell_of(in_cells)].push_back(to[i]);
  }
  return renumbered(mesh, to);
}

/// A triangle at an edge, and which way it runs along it.
struct Side {
  int low, high;         ///< vertices of the edge
  std::size_t triangle;  ///< index
  bool up;               ///< from low to high
};

/// All sides, those of one edge together.
std::vector<Side> sides_of(const Mesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

/// What is done with triangles that have the same corners.
enum class Doubles {
  one,      ///< one of them is kept
  no_fins,  ///< the same, but for those that have an edge of their own
  opposed,  ///< those that face opposite ways cancel in pairs, one of the others is kept
  pairs     ///< they cancel in pairs, whichever way they face
};

struct Single {
  Mesh mesh;
  std::size_t kept{0}, left_out{0};  ///< copies of what is kept, and triangles that are gone
  bool doubles{false};
};

Single without_doubles(const Mesh& mesh, Doubles way) {
  struct Copy {
    Triangle corners;  ///< from the least, in ascending order
    std::size_t index;
    bool turned;  ///< faces the other way than `corners`
  };
  std::vector<Copy> copies;
  copies.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle corners = mesh.triangles[t];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const bool turned = corners[1] > corners[2];
    if (turned) std::swap(corners[1], corners[2]);
    copies.push_back({corners, t, turned});
  }
  std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) {
    return std::tie(a.corners, a.index) < std::tie(b.corners, b.index);
  });
  Single single{.mesh = {mesh.vertices, {}}};
  std::vector<bool> keep(mesh.triangles.size(), false);
  std::vector<std::size_t> count_of(mesh.triangles.size(), 1);  // of the copies of what is kept
  for (auto first = copies.begin(); first != copies.end();) {
    auto last = first;
    while (last != copies.end() && last->corners == first->corners) ++last;
    const std::ptrdiff_t all = last - first;
    const std::ptrdiff_t turned =
        std::count_if(first, last, [](const Copy& copy) { return copy.turned; });
    const bool none =
        (way == Doubles::opposed && 2 * turned == all) || (way == Doubles::pairs && all % 2 == 0);
    // What cancels leaves one that faces as most do.
    const auto chosen = way == Doubles::one || way == Doubles::no_fins
                            ? first
                            : std::find_if(first, last, [&](const Copy& copy) {
                                return copy.turned == (2 * turned > all);
                              });
    if (!none) keep[chosen->index] = true;
    if (all > 1) {
      single.doubles = true;
      (none ? single.left_out : single.kept) += static_cast<std::size_t>(none ? all : all - 1);
      count_of[chosen->index] = static_cast<std::size_t>(all);
    }
    first = last;
  }
  for (bool changed = true; changed;) {
    single.mesh.triangles.clear();
    std::vector<std::size_t> index;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (keep[t]) {
        single.mesh.triangles.push_back(mesh.triangles[t]);
        index.push_back(t);
      }
    changed = false;
    if (way == Doubles::one || !single.doubles) break;
    const std::vector<Side> sides = sides_of(single.mesh);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto same = [&](std::size_t other) {
        return sides[other].low == sides[k].low && sides[other].high == sides[k].high;
      };
      const std::size_t t = index[sides[k].triangle];
      if ((k > 0 && same(k - 1)) || (k + 1 < sides.size() && same(k + 1)) || count_of[t] == 1 ||
          !keep[t])
        continue;
      keep[t] = false;
      changed = true;
      single.kept -= count_of[t] - 1;
      single.left_out += count_of[t];
    }
  }
  return single;
}

/// Calls `each` with the sides of one edge after the other.
template <class Each>
void for_each_edge(const std::vector<Side>& sides, const Each& each) {
  for (auto first = sides.begin(); first != sides.end();) {
    auto last = first;
    while (last != sides.end() && last->low == first->low && last->high == first->high) ++last;
    each(std::vector<Side>(first, last));
    first = last;
  }
}

/// A mesh whose triangles agree with their neighbours, and its parts.
struct Oriented {
  Mesh mesh;
  std::vector<std::size_t> part{};  ///< of each triangle
  std::size_t parts{0}, turned{0};  ///< `turned`: triangles that did not agree
  std::string defect{};
};

void flip(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

/// Turns triangles so that each edge of two triangles is run along both ways; the first triangle of
/// a part stays as it is.
Oriented oriented(Mesh mesh) {
  const std::size_t count = mesh.triangles.size();
  const std::vector<Side> sides = sides_of(mesh);
  struct Neighbour {
    std::size_t triangle;
    bool agrees;
  };
  std::vector<std::vector<Neighbour>> neighbours(count);
  std::size_t open = 0, crowded = 0;
  for_each_edge(sides, [&](const std::vector<Side>& at) {
    if (at.size() == 1) ++open;
    if (at.size() > 2) ++crowded;
    if (at.size() != 2) return;
    const bool agrees = at[0].up != at[1].up;
    neighbours[at[0].triangle].push_back({at[1].triangle, agrees});
    neighbours[at[1].triangle].push_back({at[0].triangle, agrees});
  });

  Oriented result{.mesh = std::move(mesh)};
  if (open > 0) {
    result.defect = "is not closed: " + counted(open, "edge") + " of its " +
                    counted(count, "triangle") + (open == 1 ? " belongs" : " belong") +
                    " to one triangle only";
    return result;
  }
  constexpr auto none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> patch(count, none);
  std::vector<bool> turned(count, false);
  std::size_t patches = 0;
  for (std::size_t seed = 0; seed < count; ++seed) {
    if (patch[seed] != none) continue;
    patch[seed] = patches;
    for (std::vector<std::size_t> stack{seed}; !stack.empty();) {
      const std::size_t t = stack.back();
      stack.pop_back();
      for (const Neighbour& next : neighbours[t]) {
        const bool turn = turned[t] == next.agrees;
        if (patch[next.triangle] == none) {
          patch[next.triangle] = patches;
          turned[next.triangle] = turn;
          stack.push_back(next.triangle);
        } else if (turned[next.triangle] != turn) {
          result.defect = "has no inside: its triangles cannot all face outwards";
          return result;
        }
      }
    }
    ++patches;
  }
  for (std::size_t t = 0; t < count; ++t)
    if (turned[t]) {
      flip(result.mesh.triangles[t]);
      ++result.turned;
    }

  // Where more than two triangles meet, each patch must be closed by itself, or be one with others.
  Sets sets(patches);
  const std::vector<Side> now = result.turned > 0 ? sides_of(result.mesh) : sides;
  const auto unbalanced = [&](const std::vector<Side>& at, const auto& group_of) {
    std::map<std::size_t, int> sums;
    for (const Side& side : at) sums[group_of(side.triangle)] += side.up ? 1 : -1;
    std::vector<std::size_t> groups;
    for (const auto& [group, sum] : sums)
      if (sum != 0) groups.push_back(group);
    return groups;
  };
  if (crowded > 0)
    for_each_edge(now, [&](const std::vector<Side>& at) {
      const auto groups = unbalanced(at, [&](std::size_t t) { return patch[t]; });
      for (const std::size_t group : groups) sets.join(groups.front(), group);
    });
  std::size_t wrong = 0;
  if (crowded > 0)
    for_each_edge(now, [&](const std::vector<Side>& at) {
      if (!unbalanced(at, [&](std::size_t t) { return sets.of(patch[t]); }).empty()) ++wrong;
    });
  if (wrong > 0) {
    result.defect = "is not closed: at " + counted(wrong, "edge") +
                    " more than two triangles meet that do not bound a body";
    return result;
  }
  std::map<std::size_t, std::size_t> number;
  result.part.resize(count);
  for (std::size_t t = 0; t < count; ++t)
    result.part[t] = number.try_emplace(sets.of(patch[t]), number.size()).first->second;
  result.parts = number.size();
  return result;
}

/// Whether two boxes have more in common than a part of a side.
bool overlap(const AlignedBox3d& a, const AlignedBox3d& b, double tolerance) {
  const AlignedBox3d common = a.intersection(b);
  return !common.isEmpty() && common.sizes().minCoeff() > tolerance;
}

/// Whether any two boxes do, or there are too many to tell.
bool any_overlap(std::vector<AlignedBox3d> boxes, double tolerance) {
  constexpr std::size_t most = 100'000'000;
  std::size_t compared = 0;
  std::sort(boxes.begin(), boxes.end(),
            [](const AlignedBox3d& a, const AlignedBox3d& b) { return a.min().x() < b.min().x(); });
  for (auto a = boxes.begin(); a != boxes.end(); ++a)
    for (auto b = a + 1; b != boxes.end() && b->min().x() <= a->max().x(); ++b)
      if (++compared > most || overlap(*a, *b, tolerance)) return true;
  return false;
}

/// Turns each part inside in; says what it did, and what is wrong.
void turn_parts(Oriented& oriented, std::vector<std::string>& repairs) {
  Mesh& mesh = oriented.mesh;
  std::vector<AlignedBox3d> boxes(oriented.parts);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    boxes[oriented.part[t]].extend(box_of(mesh, mesh.triangles[t]));
  if (any_overlap(boxes, 1e-9 * size_of(bounds(mesh)))) {
    oriented.defect = "has " + std::to_string(boxes.size()) +
                      " parts that may overlap or lie within each other: what is solid is not "
                      "known";
    return;
  }
  std::vector<double> volumes(oriented.parts);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    volumes[oriented.part[t]] +=
        six_volumes(mesh, mesh.triangles[t], boxes[oriented.part[t]].center()) / 6;
  std::size_t inverted = 0;
  for (std::size_t k = 0; k < oriented.parts; ++k) {
    if (std::abs(volumes[k]) <= 1e-9 * std::pow(size_of(boxes[k]), 3)) {
      oriented.defect = oriented.parts == 1 ? "has no volume: it is flat"
                                            : "has a part without volume: it is flat";
      return;
    }
    if (volumes[k] < 0) ++inverted;
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (volumes[oriented.part[t]] < 0) flip(mesh.triangles[t]);
  if (oriented.turned > 0)
    repairs.push_back(counted(oriented.turned, "triangle") +
                      " of it did not agree with the neighbours and " +
                      (oriented.turned == 1 ? "was" : "were") + " turned");
  if (inverted == oriented.parts)
    repairs.emplace_back("was inside out, and was turned");
  else if (inverted > 0)
    repairs.push_back(counted(inverted, "part") + " of it " + (inverted == 1 ? "was" : "were") +
                      " inside out, and turned");
  if (oriented.parts > 1)
    repairs.push_back("has " + std::to_string(oriented.parts) +
                      " parts that do not overlap: they are taken as one rigid body");
}

/// How often a closed surface goes round a point: the solid angles of its triangles (van Oosterom
/// and Strackee 1983) over that of the whole sphere.
double winding(const Mesh& mesh, const Vector3d& point) {
  double angle = 0;
  for (const Triangle& triangle : mesh.triangles) {
    const Vector3d a = corner(mesh, triangle, 0) - point, b = corner(mesh, triangle, 1) - point,
                   c = corner(mesh, triangle, 2) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

/// Whether the surface crosses itself, as seen just beneath some of its triangles, where it should
/// go round once: in words, or nothing.
std::string crossing(const Mesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  const std::size_t most = std::clamp<std::size_t>(2'000'000 / count, 16, 64);
  const std::size_t step = std::max<std::size_t>(count / most, 1);
  std::size_t looked = 0, deeper = 0;
  for (std::size_t t = step / 2; t < count; t += step) {
    const Vector3d &a = corner(mesh, mesh.triangles[t], 0), &b = corner(mesh, mesh.triangles[t], 1),
                   &c = corner(mesh, mesh.triangles[t], 2);
    const Vector3d normal = (b - a).cross(c - a);
    const double round = (b - a).norm() + (c - b).norm() + (a - c).norm();
    const double radius = normal.norm() / round;  // of the circle in it
    if (!(radius > 1e-9 * round)) continue;
    ++looked;
    const double times = winding(mesh, (a + b + c) / 3 - 1e-7 * radius * normal.normalized());
    if (std::abs(times - 1) > 0.5) ++deeper;
  }
  if (deeper == 0) return "";
  return "crosses itself: beneath " + std::to_string(deeper) + " of " + std::to_string(looked) +
         " triangles it is not within itself once, and what it encloses twice counts twice";
}

}  // namespace

AlignedBox3d bounds(const Mesh& mesh) {
  AlignedBox3d box;
  for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

double volume(const Mesh& mesh) {
  const Vector3d middle = bounds(mesh).center();
  double six = 0;
  for (const Triangle& triangle : mesh.triangles) six += six_volumes(mesh, triangle, middle);
  return six / 6;
}

Vector3d centroid(const Mesh& mesh) {
  const Vector3d middle = bounds(mesh).center();  // far from the origin digits would be lost
  double six = 0;
  Vector3d sum = Vector3d::Zero();
  for (const Triangle& triangle : mesh.triangles) {
    const double part = six_volumes(mesh, triangle, middle);
    six += part;
    sum += part * (corner(mesh, triangle, 0) + corner(mesh, triangle, 1) +
                   corner(mesh, triangle, 2) - 3 * middle);
  }
  return middle + sum / (4 * six);
}

/// Of a tetrahedron with a corner at the origin and the others a, b and c it is six volumes / 120
/// times a a^T + b b^T + c c^T + s s^T, s = a + b + c.
Eigen::Matrix3d second_moments(const Mesh& mesh) {
  const Vector3d middle = centroid(mesh);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Triangle& triangle : mesh.triangles) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = corner(mesh, triangle, k) - middle;
    const Vector3d s = corners.rowwise().sum();
    sum += six_volumes(mesh, triangle, middle) / 120 *
           (corners * corners.transpose() + s * s.transpose());
  }
  return sum;
}

MendedMesh mended(const Mesh& mesh) {
  for (const Vector3d& vertex : mesh.vertices)
    if (!vertex.allFinite()) return {mesh, {}, "has a vertex that is not finite"};
  const Mesh given = welded(mesh, 0);
  if (given.triangles.empty()) return {given, {}, "has no triangles"};
  const double size = size_of(bounds(given));
  // The first of these that closes it.
  std::string defect;
  for (const double tolerance : {0.0, 1e-8, 1e-7, 1e-6, 1e-5}) {
    const Mesh merged = tolerance > 0 ? welded(given, tolerance * size) : given;
    for (const Doubles way : {Doubles::one, Doubles::no_fins, Doubles::opposed, Doubles::pairs}) {
      Single single = without_doubles(merged, way);
      if (way != Doubles::one && !single.doubles) break;
      std::vector<std::string> repairs;
      if (const std::size_t gone = given.vertices.size() - merged.vertices.size(); gone > 0)
        repairs.push_back("was open: " + counted(gone, "vertex", "vertices") + " no farther than " +
                          number_text(tolerance) + " of its size from others " +
                          (gone == 1 ? "was" : "were") + " made one with them");
      if (single.kept > 0)
        repairs.push_back("had " + counted(single.kept, "triangle") +
                          " twice, of which one was kept");
      if (single.left_out > 0)
        repairs.push_back("had " + counted(single.left_out, "triangle") +
                          " twice that bound nothing: they were left out");
      if (single.mesh.triangles.empty()) continue;
      if (single.left_out > 0) single.mesh = without_others(single.mesh);
      Oriented result = oriented(std::move(single.mesh));
      if (defect.empty()) defect = result.defect;
      if (!result.defect.empty()) continue;
      turn_parts(result, repairs);
      if (!result.defect.empty()) return {given, {}, result.defect};
      if (const std::string words = crossing(result.mesh); !words.empty()) repairs.push_back(words);
      return {std::move(result.mesh), std::move(repairs), ""};
    }
  }
  return {given, {}, defect};
}

}  // namespace poise
