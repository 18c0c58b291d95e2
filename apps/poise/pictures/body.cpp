#include "pictures/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shape/sizes.hpp"

namespace poise {
namespace {

using std::numbers::pi;
constexpr float nothing = -std::numeric_limits<float>::infinity();

Mesh box(const Vector<3>& size) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(
        Vector<3>((k & 1) - 0.5, (k >> 1 & 1) - 0.5, (k >> 2) - 0.5).cwiseProduct(size));
  for (const std::array<int, 4>& q : {std::array{0, 4, 6, 2},
                                      {1, 3, 7, 5},
                                      {0, 1, 5, 4},
                                      {2, 6, 7, 3},
                                      {0, 2, 3, 1},
                                      {4, 5, 7, 6}}) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

/// Rings of points about z, from below to above; a ring of radius 0 is a pole.
Mesh turned(const std::vector<Vector<2>>& profile, const Vector<3>& stretch) {
  constexpr int around = 96;
  Mesh mesh;
  for (const Vector<2>& ring : profile)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * pi * k / around;
      mesh.vertices.emplace_back(
          Vector<3>(ring.x() * std::cos(angle), ring.x() * std::sin(angle), ring.y())
              .cwiseProduct(stretch));
    }
  for (int r = 0; r + 1 < static_cast<int>(profile.size()); ++r)
    for (int k = 0; k < around; ++k) {
      const int a = r * around + k, b = r * around + (k + 1) % around;
      if (profile[static_cast<std::size_t>(r)].x() > 0)
        mesh.triangles.push_back({a, b, b + around});
      if (profile[static_cast<std::size_t>(r) + 1].x() > 0)
        mesh.triangles.push_back({a, b + around, a + around});
    }
  return mesh;
}

Mesh ball(const Vector<3>& radii) {
  constexpr int steps = 48;
  std::vector<Vector<2>> profile;
  for (int k = 0; k <= steps; ++k) {
    const double angle = pi * k / steps;
    profile.emplace_back(k == 0 || k == steps ? 0 : std::sin(angle), -std::cos(angle));
  }
  return turned(profile, radii);
}

/// Normals of the triangles' corners: smooth where the surface is, sharp at its edges.
std::vector<std::array<Vector<3>, 3>> corner_normals(const Mesh& mesh) {
  constexpr double sharp = 0.8;  // cosine of the angle between faces
  std::vector<Vector<3>> faces;  // as long as twice their area
  std::vector<std::vector<int>> at(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    const auto& v = mesh.vertices;
    const Vector<3>&a = v[static_cast<std::size_t>(triangle[0])],
          &b = v[static_cast<std::size_t>(triangle[1])],
          &c = v[static_cast<std::size_t>(triangle[2])];
    for (const int corner : triangle)
      at[static_cast<std::size_t>(corner)].push_back(static_cast<int>(faces.size()));
    faces.emplace_back((b - a).cross(c - a));
  }
  std::vector<std::array<Vector<3>, 3>> result(faces.size());
  for (std::size_t t = 0; t < faces.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Vector<3> sum = faces[t];
      for (const int other : at[static_cast<std::size_t>(mesh.triangles[t][k])]) {
        const Vector<3>& face = faces[static_cast<std::size_t>(other)];
        if (face.dot(faces[t]) > sharp * face.norm() * faces[t].norm()) sum += face;
      }
      result[t][k] = sum.stableNormalized();
    }
  return result;
}

}  // namespace

Mesh mesh_of(const Solid& solid) {
  return std::visit(Overloaded{
                        [](const Box& b) { return box(b.size); },
                        [](const Cylinder& c) {
                          return turned({{0, -0.5}, {1, -0.5}, {1, 0.5}, {0, 0.5}},
                                        {c.radius, c.radius, c.height});
                        },
                        [](const Sphere& s) { return ball(Vector<3>::Constant(s.radius)); },
                        [](const Ellipsoid& e) { return ball(e.radii); },
                        [](const MeshShape& m) { return *m.mesh; },
                    },
                    solid);
}

ShadedBody::ShadedBody(const Mesh& mesh, const View& view, int width, int height)
    : view_(view),
      width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
              Pixel{nothing, 0, 0, 0}) {
  Eigen::AlignedBox3d box;
  for (const Vector<3>& vertex : mesh.vertices) box.extend(vertex);
  size_ = mesh.vertices.empty() ? 0 : box.diagonal().norm();
  const auto normals = corner_normals(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Vector<2> p[3];
    double near[3];
    Vector<3> n[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector<3>& vertex = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
      p[k] = view.at(vertex);
      near[k] = view.nearness(vertex);
      n[k] = {normals[t][k].dot(view.right), normals[t][k].dot(view.upwards),
              normals[t][k].dot(view.toward)};
    }
    const auto cross = [](const Vector<2>& a, const Vector<2>& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    if (!(std::abs(area) > 1e-12)) continue;
    const Vector<2> low = p[0].cwiseMin(p[1]).cwiseMin(p[2]),
                    high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    const int x0 = std::max(0, static_cast<int>(std::floor(low.x()))),
              x1 = std::min(width - 1, static_cast<int>(std::ceil(high.x()))),
              y0 = std::max(0, static_cast<int>(std::floor(low.y()))),
              y1 = std::min(height - 1, static_cast<int>(std::ceil(high.y())));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Vector<2> at(x + 0.5, y + 0.5);
        const double a = cross(p[1] - at, p[2] - at) / area, b = cross(p[2] - at, p[0] - at) / area,
                     c = 1 - a - b;
        if (a < 0 || b < 0 || c < 0) continue;
        const auto nearness = static_cast<float>(a * near[0] + b * near[1] + c * near[2]);
        Pixel& pixel = pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x)];
        if (!(nearness > pixel.nearness)) continue;
        Vector<3> normal = a * n[0] + b * n[1] + c * n[2];
        if (normal.z() < 0) normal = -normal;  // of an open surface, from behind
        normal.normalize();
        pixel = {nearness, static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                 static_cast<float>(normal.z())};
      }
  }
}

bool ShadedBody::hides(const Vector<3>& point, double tolerance) const {
  const Vector<2> at = view_.at(point);
  const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
  return pixel(x, y).nearness > view_.nearness(point) + tolerance;
}

/// At the border of the body, where something lies before something else, and where it is sharp.
bool ShadedBody::edge(int x, int y) const {
  const Pixel& here = pixel(x, y);
  for (const auto& [dx, dy] : {std::pair(2, 0), {-2, 0}, {0, 2}, {0, -2}}) {
    if (x + dx < 0 || y + dy < 0 || x + dx >= width_ || y + dy >= height_) continue;
    const Pixel& there = pixel(x + dx, y + dy);
    if (there.nearness == nothing) return true;
    // A surface seen at a flat angle has steps, too.
    const double step = 0.004 * size_ + 8 / (view_.scale * std::max(0.1F, here.nz));
    if (here.nearness - there.nearness > step) return true;
    if (here.nx * there.nx + here.ny * there.ny + here.nz * there.nz < 0.65F) return true;
  }
  return false;
}

std::vector<std::uint32_t> ShadedBody::shaded(double opacity) const {
  const int columns = width_ / 2, rows = height_ / 2;
  std::vector<std::uint32_t> image(static_cast<std::size_t>(columns) *
                                   static_cast<std::size_t>(rows));
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      double sum[4] = {};  // alpha, red, green, blue
      for (int k = 0; k < 4; ++k) {
        const int px = 2 * x + k % 2, py = 2 * y + k / 2;
        const Pixel& here = pixel(px, py);
        if (here.nearness == nothing) continue;
        const bool line = edge(px, py);
        const double light =
            std::max(0.0, -0.35 * here.nx + 0.55 * here.ny + 0.76 * static_cast<double>(here.nz));
        const double shade = 0.62 + 0.38 * light;
        const double colour[3] = {line ? 0.42 : 0.955 * shade, line ? 0.42 : 0.945 * shade,
                                  line ? 0.42 : 0.915 * shade};
        const double alpha = line ? 1 : opacity;
        sum[0] += alpha;
        for (int c = 0; c < 3; ++c) sum[c + 1] += alpha * colour[c];
      }
      std::uint32_t value = 0;
      for (const double part : sum)
        value = value << 8 | static_cast<std::uint32_t>(std::lround(255 * part / 4));
      image[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
            static_cast<std::size_t>(x)] = value;
    }
  return image;
}

}  // namespace poise
