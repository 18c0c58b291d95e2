#include "pictures/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "plot.hpp"
#include "shape/characters.hpp"

namespace poise {
namespace {

constexpr double pixels_per_point = 2;  // of a PNG

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Colour::Colour(const char* hex, double alpha) : opacity(alpha) {
  const long value = std::strtol(hex + 1, nullptr, 16);
  red = static_cast<double>(value >> 16 & 255) / 255;
  green = static_cast<double>(value >> 8 & 255) / 255;
  blue = static_cast<double>(value & 255) / 255;
}

Canvas::Canvas(double width, double height, bool svg) : svg_(svg), width_(width), height_(height) {
  surface_ = svg ? cairo_svg_surface_create_for_stream(append, &bytes_, width, height)
                 : cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                              static_cast<int>(pixels_per_point * width),
                                              static_cast<int>(pixels_per_point * height));
  cairo_ = cairo_create(surface_);
  if (!svg) cairo_scale(cairo_, pixels_per_point, pixels_per_point);
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  use("#ffffff");
  cairo_paint(cairo_);
}

Canvas::~Canvas() {
  cairo_destroy(cairo_);
  cairo_surface_destroy(surface_);
}

void Canvas::use(const Colour& colour) {
  cairo_set_source_rgba(cairo_, colour.red, colour.green, colour.blue, colour.opacity);
}

void Canvas::path(const std::vector<Vector<2>>& points) {
  cairo_new_path(cairo_);
  for (const Vector<2>& point : points) cairo_line_to(cairo_, point.x(), point.y());
}

void Canvas::fill(const std::vector<Vector<2>>& polygon, const Colour& colour) {
  use(colour);
  path(polygon);
  cairo_fill(cairo_);
}

void Canvas::line(const std::vector<Vector<2>>& points, const Colour& colour, double width,
                  const std::vector<double>& dashes) {
  use(colour);
  path(points);
  cairo_set_line_width(cairo_, width);
  cairo_set_dash(cairo_, dashes.data(), static_cast<int>(dashes.size()), 0);
  cairo_stroke(cairo_);
}

void Canvas::arrow(const Vector<2>& from, const Vector<2>& to, const Colour& colour, double width,
                   const std::vector<double>& dashes) {
  arrow({from, to}, colour, width, dashes);
}

void Canvas::arrow(std::vector<Vector<2>> points, const Colour& colour, double width,
                   const std::vector<double>& dashes) {
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
  if (!(length > 0)) return;
  const double head = std::min(4.5 * width, 0.7 * length);
  const Vector<2> to = points.back();
  do points.pop_back();
  while (points.size() > 1 && (to - points.back()).norm() < head);
  const Vector<2> along = (to - points.back()).normalized(), across(-along.y(), along.x());
  points.push_back(to - 0.8 * head * along);
  line(points, colour, width, dashes);
  fill({to, to - head * along + 0.4 * head * across, to - head * along - 0.4 * head * across},
       colour);
}

void Canvas::dot(const Vector<2>& at, double radius, const Colour& colour) {
  use(colour);
  cairo_new_path(cairo_);
  cairo_arc(cairo_, at.x(), at.y(), radius, 0, 6.283185307179586);
  cairo_fill(cairo_);
}

void Canvas::font(double size, bool bold) const {
  cairo_select_font_face(cairo_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_, size);
}

void Canvas::text(const std::string& words, const Vector<2>& at, double size, const Colour& colour,
                  bool bold) {
  font(size, bold);
  use(colour);
  cairo_move_to(cairo_, at.x(), at.y());
  cairo_show_text(cairo_, harmless(words).c_str());
}

double Canvas::text_width(const std::string& words, double size, bool bold) const {
  font(size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, harmless(words).c_str(), &extents);
  return extents.x_advance;
}

void Canvas::image(std::vector<std::uint32_t> pixels, int width, int height) {
  cairo_surface_t* const image =
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                          CAIRO_FORMAT_ARGB32, width, height, 4 * width);
  cairo_save(cairo_);
  cairo_scale(cairo_, width_ / width, height_ / height);
  cairo_set_source_surface(cairo_, image, 0, 0);
  cairo_paint(cairo_);
  cairo_restore(cairo_);
  // A vector surface may look at the pixels later than now.
  if (svg_) cairo_surface_flush(surface_);
  cairo_surface_finish(image);
  cairo_surface_destroy(image);
}

std::string Canvas::finish() {
  if (!svg_) cairo_surface_write_to_png_stream(surface_, append, &bytes_);
  cairo_surface_finish(surface_);
  const cairo_status_t status = cairo_status(cairo_);
  if (status != CAIRO_STATUS_SUCCESS)
    throw OutputError(std::string("cairo: ") + cairo_status_to_string(status));
  return std::move(bytes_);
}

}  // namespace poise
