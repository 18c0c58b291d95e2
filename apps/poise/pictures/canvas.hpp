// Drawing with cairo: SVG or PNG, by the ending of the file's name.
#pragma once

#include <cairo-svg.h>

#include <cstdint>
#include <string>
#include <vector>

#include "poise/wrench.hpp"

namespace poise {

struct Colour {
  Colour(const char* hex, double alpha = 1);  ///< "#rrggbb"
  double red, green, blue, opacity;
};

/// A picture of so many points, white at first, y downwards.
class Canvas {
 public:
  Canvas(double width, double height, bool svg);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void fill(const std::vector<Vector<2>>& polygon, const Colour& colour);
  void line(const std::vector<Vector<2>>& points, const Colour& colour, double width,
            const std::vector<double>& dashes = {});
  void arrow(const Vector<2>& from, const Vector<2>& to, const Colour& colour, double width,
             const std::vector<double>& dashes = {});
  /// Along points, to the last.
  void arrow(std::vector<Vector<2>> points, const Colour& colour, double width,
             const std::vector<double>& dashes = {});
  void dot(const Vector<2>& at, double radius, const Colour& colour);
  /// Flush left at a point on the line of its letters' feet.
  void text(const std::string& words, const Vector<2>& at, double size, const Colour& colour,
            bool bold = false);
  double text_width(const std::string& words, double size, bool bold = false) const;
  /// 0xAARRGGBB, premultiplied, stretched over the whole picture.
  void image(std::vector<std::uint32_t> pixels, int width, int height);

  /// What the file holds.
  std::string finish();

 private:
  void use(const Colour& colour);
  void font(double size, bool bold) const;
  void path(const std::vector<Vector<2>>& points);

  bool svg_;
  double width_, height_;
  std::string bytes_;
  cairo_surface_t* surface_;
  cairo_t* cairo_;
};

}  // namespace poise
