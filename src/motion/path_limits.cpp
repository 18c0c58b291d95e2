#include "poise/path_limits.hpp"

#include <algorithm>
#include <utility>

#include "motion/held_set.hpp"
#include "motion/polygon.hpp"

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double wanted = 0.99;      // of the necessary polygon
constexpr double border_gap = 1e-3;  // of what is held on a ray
constexpr double below = 0.1;        // of `inside`: so far the polygon goes on below s'^2 = 0
constexpr double far = 1e7;          // nothing is looked for beyond [units of the axes]
constexpr std::size_t most_rows = 60;
constexpr int most_cuts = 200;  // to find a first point

/// The load over the plane of (s'', s'^2): turned into units in which both axes weigh the same.
class Plane {
 public:
  Plane(const Hand<3>& hand, const Body& body, const PathPoint& point,
        const MotionSettings& settings)
      : set_(hand, body.mass * standard_gravity, settings.force_cap) {
    MotionState state{.orientation = point.orientation,
                      .acceleration = point.velocity,
                      .angular_acceleration = point.angular_velocity};
    const MotionLoad by_acceleration = motion_load(body, state);
    state.acceleration = point.acceleration;
    state.angular_velocity = point.angular_velocity;
    state.angular_acceleration = point.angular_acceleration;
    const MotionLoad by_speed = motion_load(body, state);
    still_ = by_speed.weight();
    along_[0] = by_acceleration.dynamic();
    along_[1] = by_speed.dynamic();
    const double weight = body.mass * standard_gravity;
    for (int k = 0; k < 2; ++k) {
      const double size = set_.size(along_[k]);
      units_[k] = size > 0 ? weight / size : 1;
      along_[k] *= units_[k];
    }
    if (along_[0].isZero(0))
      throw InvalidGrasp("point", "does not move: its derivatives by s are 0");
  }

  Wrench<3> load(const Vector<2>& p) const { return still_ + p[0] * along_[0] + p[1] * along_[1]; }
  bool holds(const Vector<2>& p) { return set_.holds(load(p)); }
  std::optional<HalfPlane> half_plane(const std::optional<HeldRow>& row) const {
    if (!row) return {};
    const Vector<2> normal(row->y.dot(along_[0]), row->y.dot(along_[1]));
    const double length = normal.norm();
    if (!(length > 0)) return {};
    return HalfPlane{normal / length, (row->most - row->y.dot(still_)) / length};
  }
  std::optional<HalfPlane> half_plane_at(const Vector<2>& p) const {
    return half_plane(set_.row(load(p)));
  }
  RayEnd ray_end(const Vector<2>& from, const Vector<2>& to) {
    return poise::ray_end(set_, load(from), load(to), border_gap);
  }
  /// In the caller's units.
  const Vector<2>& units() const { return units_; }

 private:
  HeldSet set_;
  Wrench<3> still_;
  Wrench<3> along_[2];
  Vector<2> units_;
};

/// The search for both polygons.
class Search {
 public:
  explicit Search(Plane& plane) : plane_(plane) {}

  PathLimits run() {
    PathLimits limits;
    if (!find_first()) return limits;
    find_inside();
    refine();
    if (!(shrunk_ > 0)) return limits;
    limits.holdable = true;
    limits.shrunk = shrunk_;
    limits.inside = inside_.cwiseProduct(plane_.units());
    for (const Row& row : rows_) {
      const Vector<2> normal = row.half.normal.cwiseQuotient(plane_.units());
      const double here = row.half.normal.dot(inside_);
      limits.rows.push_back({normal[0], normal[1], here + shrunk_ * (row.half.most - here),
                             row.proven ? row.half.most : infinity});
    }
    return limits;
  }

 private:
  struct Row {
    HalfPlane half;
    bool proven;  ///< else the end of what was looked at
  };

  void start(double bottom) {
    rows_ = {{{{1, 0}, far}, false}, {{{-1, 0}, far}, false}, {{{0, 1}, far}, false}};
    outer_ = {{-far, bottom}, {far, bottom}, {far, far}, {-far, far}};
  }

  /// A point that is held: rest, or else by cutting away.
  bool find_first() {
    if (plane_.holds(inside_)) return true;
    start(0);
    for (int k = 0; k < most_cuts && outer_.size() > 2; ++k) {
      const Vector<2> middle = centroid(outer_);
      if (k > 0 && plane_.holds(middle)) {
        inside_ = middle;
        return true;
      }
      const Vector<2> at = k == 0 ? inside_ : middle;
      const std::optional<HalfPlane> half = plane_.half_plane_at(at);
      if (!half) return false;
      outer_ = cut(outer_, *half);
    }
    return false;
  }

  /// The middle of what is held around the first point.
  void find_inside() {
    for (int round = 0; round < 2; ++round) {
      std::vector<Vector<2>> ends;
      for (const Vector<2>& way :
           {Vector<2>(1, 0), {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
        double length = way.y() < 0 ? std::min(far, inside_.y()) : far;
        if (!(length > 0)) continue;
        const RayEnd end = plane_.ray_end(inside_, inside_ + length * way);
        ends.push_back(inside_ + end.held * length * way);
      }
      if (const Corners around = hull(ends); around.size() > 2) inside_ = centroid(around);
    }
  }

  void refine() {
    start(-below * inside_.y());
    for (const Vector<2>& corner : Corners(outer_))
      if (!look_towards(corner)) return;
    for (std::size_t looks = 0; looks < 2 * most_rows && rows_.size() < most_rows; ++looks) {
      const auto [part, worst] = least_part_inside(outer_);
      if (part >= wanted || !look_towards(worst)) break;
    }
    prune();
    shrunk_ = least_part_inside(outer_).first;
  }

  /// How much of the way to a corner is held for certain, at the corner where it is least.
  std::pair<double, Vector<2>> least_part_inside(const Corners& corners) const {
    const Corners inner = hull(held_);
    std::pair<double, Vector<2>> least{2, inside_};
    for (const Vector<2>& corner : corners)
      if (const double part = part_inside(inner, inside_, corner); part < least.first)
        least = {part, corner};
    return least;
  }

  bool touches(const HalfPlane& half) const {
    return std::any_of(outer_.begin(), outer_.end(), [&](const Vector<2>& corner) {
      return half.normal.dot(corner) > half.most * (1 - 1e-9);
    });
  }

  /// Rows without which as much is held for certain are left out.
  void prune() {
    const double enough = std::min(wanted, least_part_inside(outer_).first);
    const Vector<2> low(-far, -below * inside_.y());
    std::reverse(rows_.begin(), rows_.end());  // the ends of what is looked at come last
    for (std::size_t k = 0; k < rows_.size();) {
      Corners without = {low, {far, low.y()}, {far, far}, {-far, far}};
      for (std::size_t j = 0; j < rows_.size(); ++j)
        if (j != k && rows_[j].proven) without = cut(without, rows_[j].half);
      if (rows_[k].proven ? least_part_inside(without).first < enough : touches(rows_[k].half)) {
        ++k;
        continue;
      }
      if (rows_[k].proven) outer_ = without;
      rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }

  /// A row, or a point that is held, more; false where neither is new.
  bool look_towards(const Vector<2> corner) {
    const RayEnd end = plane_.ray_end(inside_, corner);
    if (!end.found) return false;
    held_.push_back(inside_ + end.held * (corner - inside_));
    const std::optional<HalfPlane> half = plane_.half_plane(end.row);
    if (!half) return end.held >= 1;
    rows_.push_back({*half, true});
    outer_ = cut(outer_, *half);
    return outer_.size() > 2;
  }

  Plane& plane_;
  Vector<2> inside_ = Vector<2>::Zero();
  std::vector<Row> rows_;
  Corners outer_;
  std::vector<Vector<2>> held_;
  double shrunk_{0};
};

}  // namespace

PathLimits path_limits(const Hand<3>& hand, const Body& body, const PathPoint& point,
                       const MotionSettings& settings) {
  Plane plane(hand, body, point, settings);
  return Search(plane).run();
}

}  // namespace poise
