#include "gripper/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/sizes.hpp"

namespace poise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A convex body along a line: where it is entered and left, and the outward normals there.
struct Stretch {
  double from{-infinity}, to{infinity};
  Vector<3> entered = Vector<3>::Zero(), left = Vector<3>::Zero();

  /// What is in another convex body too.
  void cut(const Stretch& other) {
    if (other.from > from) {
      from = other.from;
      entered = other.entered;
    }
    if (other.to < to) {
      to = other.to;
      left = other.left;
    }
  }
};

Stretch nothing() { return {infinity, -infinity, Vector<3>::Zero(), Vector<3>::Zero()}; }

/// Between two planes across an axis, at -half and half.
Stretch between_planes(int axis, double half, const Vector<3>& origin, const Vector<3>& direction) {
  const double o = origin[axis], d = direction[axis];
  if (d == 0) return std::abs(o) <= half ? Stretch{} : nothing();
  const double side = d > 0 ? 1 : -1;
  return {(-side * half - o) / d, (side * half - o) / d, -side * Vector<3>::Unit(axis),
          side * Vector<3>::Unit(axis)};
}

/// Within an ellipsoid, or where a radius is infinite a cylinder.
Stretch within(const Vector<3>& radii, const Vector<3>& origin, const Vector<3>& direction) {
  const Vector<3> o = origin.cwiseQuotient(radii), d = direction.cwiseQuotient(radii);
  const double speed = d.norm();
  if (speed == 0) return o.norm() <= 1 ? Stretch{} : nothing();
  const Vector<3> along = d / speed;
  const double middle = -o.dot(along);
  const double off = o.cross(along).squaredNorm();  // of the line from the middle
  if (off > 1) return nothing();
  const double half = std::sqrt(1 - off);
  const auto normal = [&](double at) -> Vector<3> {
    return (o + at * along).cwiseQuotient(radii).normalized();
  };
  return {(middle - half) / speed, (middle + half) / speed, normal(middle - half),
          normal(middle + half)};
}

Stretch stretch_of(const Box& box, const Vector<3>& origin, const Vector<3>& direction) {
  Stretch stretch;
  for (int axis = 0; axis < 3; ++axis)
    stretch.cut(between_planes(axis, box.size[axis] / 2, origin, direction));
  return stretch;
}

Stretch stretch_of(const Cylinder& cylinder, const Vector<3>& origin, const Vector<3>& direction) {
  Stretch stretch = within({cylinder.radius, cylinder.radius, infinity}, origin, direction);
  stretch.cut(between_planes(2, cylinder.height / 2, origin, direction));
  return stretch;
}

std::optional<Meeting> first_of(const Stretch& stretch, const Vector<3>& origin,
                                const Vector<3>& direction) {
  if (stretch.from > stretch.to || stretch.to < 0) return {};
  const bool outside = stretch.from >= 0;
  const double distance = outside ? stretch.from : stretch.to;
  return Meeting{distance, origin + distance * direction, outside ? stretch.entered : stretch.left};
}

/// Where a ray meets the plane of a triangle, in double precision.
Meeting meeting_with(const Mesh& mesh, int triangle, const Vector<3>& origin,
                     const Vector<3>& direction) {
  const auto& [i, j, k] = mesh.triangles[static_cast<std::size_t>(triangle)];
  const Vector<3>&a = mesh.vertices[static_cast<std::size_t>(i)],
        &b = mesh.vertices[static_cast<std::size_t>(j)],
        &c = mesh.vertices[static_cast<std::size_t>(k)];
  const Vector<3> outward = (b - a).cross(c - a).stableNormalized();
  const double slope = direction.dot(outward);
  // A triangle seen edge-on is met somewhere between its corners.
  const double nearest = std::min({(a - origin).dot(direction), (b - origin).dot(direction),
                                   (c - origin).dot(direction)}),
               farthest = std::max({(a - origin).dot(direction), (b - origin).dot(direction),
                                    (c - origin).dot(direction)});
  const double distance =
      slope == 0 ? nearest : std::clamp((a - origin).dot(outward) / slope, nearest, farthest);
  return {distance, origin + distance * direction, outward};
}

}  // namespace

Surface::Surface(const Solid& solid) : solid_(solid), bounds_(poise::bounds(solid)) {
  if (const auto* mesh = std::get_if<MeshShape>(&solid)) finder_ = triangle_finder(*mesh->mesh);
}

bool Surface::closed() const {
  const auto* mesh = std::get_if<MeshShape>(&solid_);
  return !mesh || mesh->defect.empty();
}

std::optional<Meeting> Surface::first(const Vector<3>& origin, const Vector<3>& direction) const {
  const auto convex = [&](const Stretch& stretch) { return first_of(stretch, origin, direction); };
  return std::visit(
      Overloaded{
          [&](const Box& box) { return convex(stretch_of(box, origin, direction)); },
          [&](const Cylinder& cylinder) { return convex(stretch_of(cylinder, origin, direction)); },
          [&](const Sphere& sphere) {
            return convex(within(Vector<3>::Constant(sphere.radius), origin, direction));
          },
          [&](const Ellipsoid& e) { return convex(within(e.radii, origin, direction)); },
          [&](const MeshShape& shape) -> std::optional<Meeting> {
            const std::optional<int> triangle = finder_->first(origin, direction);
            if (!triangle) return {};
            return meeting_with(*shape.mesh, *triangle, origin, direction);
          },
      },
      solid_);
}

}  // namespace poise
