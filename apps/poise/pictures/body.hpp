// A body seen from one side: which pixel shows which part of it, and how light or dark.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/mesh.hpp"
#include "shape/shape.hpp"

namespace poise {

/// The surface of a body in triangles fine enough to look at.
Mesh mesh_of(const Solid& solid);

/// A parallel projection. Unit vectors in the object frame: to the right and upwards in the
/// picture, and towards the eye.
struct View {
  Vector<3> right, upwards, toward;
  Vector<3> centre;  ///< what is in the middle of the picture [m]
  double scale{1};   ///< pixels per metre
  Vector<2> middle;  ///< of the picture [pixels], y downwards

  Vector<2> at(const Vector<3>& point) const {
    const Vector<3> r = point - centre;
    return middle + scale * Vector<2>(r.dot(right), -r.dot(upwards));
  }
  double nearness(const Vector<3>& point) const { return (point - centre).dot(toward); }
};

/// What is nearest to the eye in each pixel.
class ShadedBody {
 public:
  ShadedBody(const Mesh& mesh, const View& view, int width, int height);

  /// Whether the body hides a point from the eye.
  bool hides(const Vector<3>& point, double tolerance) const;

  /// 0xAARRGGBB, premultiplied, a quarter of the pixels: shaded, with silhouette and edges drawn.
  std::vector<std::uint32_t> shaded(double opacity) const;
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  struct Pixel {
    float nearness;
    float nx, ny, nz;  ///< normal: to the right, upwards, towards the eye
  };
  bool edge(int x, int y) const;
  const Pixel& pixel(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }

  View view_;
  int width_, height_;
  double size_;  ///< of the mesh [m]
  std::vector<Pixel> pixels_;
};

}  // namespace poise
