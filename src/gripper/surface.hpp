// Where rays meet a body: exactly, as for a finger that moves along a line until it touches.
#pragma once

#include <memory>
#include <optional>

#include "readers/readers.hpp"
#include "shape/shape.hpp"

namespace poise {

/// Where a ray meets a surface.
struct Meeting {
  double distance{0};                     ///< along the ray, from its origin [m]
  Vector<3> point = Vector<3>::Zero();    ///< [m]
  Vector<3> outward = Vector<3>::Zero();  ///< unit normal; which way is out, a mesh that is not
                                          ///< closed does not know
};

/// The surface of a body, prepared for many rays.
class Surface {
 public:
  /// @throws ReadError where a mesh cannot be searched
  explicit Surface(const Solid& solid);

  /// The first point at which a ray, its direction of length 1, meets the surface, from outside or
  /// from inside.
  std::optional<Meeting> first(const Vector<3>& origin, const Vector<3>& direction) const;

  /// Whether it has an inside.
  bool closed() const;

  /// The box that it lies in [m].
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }

 private:
  Solid solid_;
  Eigen::AlignedBox3d bounds_;
  std::unique_ptr<TriangleFinder> finder_{};  ///< of a mesh
};

}  // namespace poise
