#include "shape/shape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

namespace poise {
namespace {

constexpr double pi = 3.14159265358979323846;

const Polygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
const Polygon square_clockwise{{{0, 2}, {2, 2}, {2, 0}, {0, 0}}};
const Polygon ell{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}};

/// A polygon seen whole from its middle, so never self-intersecting; usually not convex.
Polygon random_star(std::mt19937& random, std::size_t vertices) {
  std::uniform_real_distribution<double> radius(0.3, 1), place(-2, 2);
  const Vector<2> middle(place(random), place(random));
  Polygon polygon;
  for (std::size_t i = 0; i < vertices; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(vertices);
    polygon.vertices.emplace_back(middle +
                                  radius(random) * Vector<2>(std::cos(angle), std::sin(angle)));
  }
  if (random() % 2 == 0) std::reverse(polygon.vertices.begin(), polygon.vertices.end());
  return polygon;
}

/// Counts the edges that a ray to the right crosses.
bool inside(const Polygon& polygon, const Vector<2>& p) {
  bool odd = false;
  const auto& v = polygon.vertices;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++)
    if ((v[i].y() > p.y()) != (v[j].y() > p.y()) &&
        p.x() < v[i].x() + (v[j].x() - v[i].x()) * (p.y() - v[i].y()) / (v[j].y() - v[i].y()))
      odd = !odd;
  return odd;
}

Polygon moved(const Polygon& polygon, const Eigen::Affine2d& motion) {
  Polygon result;
  for (const auto& v : polygon.vertices) result.vertices.push_back(motion * v);
  return result;
}

std::string problem(const Shape& shape) {
  try {
    check(shape);
  } catch (const InvalidShape& error) {
    return error.what();
  }
  return "";
}

std::string normal_problem(const Shape& shape, const Vector<2>& point) {
  try {
    inward_normal(shape, point);
  } catch (const NoNormal& error) {
    return error.what();
  }
  return "";
}

TEST(Shape, AreasAndCentroidsOfClosedForms) {
  EXPECT_DOUBLE_EQ(area(Disk{2}), 4 * pi);
  EXPECT_DOUBLE_EQ(area(Ellipse{{2, 3}}), 6 * pi);
  EXPECT_EQ(centroid(Disk{2}), Vector<2>(0, 0));
  EXPECT_EQ(centroid(Ellipse{{2, 3}}), Vector<2>(0, 0));
  for (const Polygon& polygon : {square, square_clockwise}) {
    EXPECT_DOUBLE_EQ(area(polygon), 4);
    EXPECT_TRUE(centroid(polygon).isApprox(Vector<2>(1, 1), 1e-14));
  }
  // Two rectangles: 3 x 1 at (1.5, 0.5) and 1 x 3 at (0.5, 2.5).
  EXPECT_DOUBLE_EQ(area(ell), 6);
  EXPECT_TRUE(centroid(ell).isApprox(Vector<2>(1, 1.5), 1e-14));
  EXPECT_TRUE(centroid(Polygon{{{1, 1}, {4, 1}, {1, 7}}}).isApprox(Vector<2>(2, 3), 1e-14));
}

TEST(Shape, AreaAndCentroidOfPolygonsEqualThoseOfTheirPixels) {
  std::mt19937 random(1);
  for (int k = 0; k < 10; ++k) {
    const Polygon polygon = random_star(random, 3 + random() % 10);
    check(polygon);
    constexpr int pixels = 800;
    constexpr double step = 6.0 / pixels;
    double count = 0;
    Vector<2> sum = Vector<2>::Zero();
    for (int i = 0; i < pixels; ++i)
      for (int j = 0; j < pixels; ++j)
        if (const Vector<2> p(-3 + (i + 0.5) * step, -3 + (j + 0.5) * step); inside(polygon, p)) {
          count += 1;
          sum += p;
        }
    EXPECT_NEAR(area(polygon), count * step * step, 0.01);
    EXPECT_NEAR((centroid(polygon) - sum / count).norm(), 0, 0.005);
  }
}

TEST(Shape, CentroidMovesWithThePolygon) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-10, 10);
  for (int k = 0; k < 100; ++k) {
    const Polygon polygon = random_star(random, 3 + random() % 20);
    const Eigen::Affine2d motion = Eigen::Translation2d(number(random), number(random)) *
                                   Eigen::Rotation2Dd(number(random)) * Eigen::Scaling(3.0);
    EXPECT_NEAR(area(moved(polygon, motion)), 9 * area(polygon), 1e-12);
    EXPECT_NEAR((centroid(moved(polygon, motion)) - motion * centroid(polygon)).norm(), 0, 1e-12);
  }
}

TEST(Shape, CentroidFarFromTheOriginAndAtExtremeScales) {
  const Eigen::Affine2d far(Eigen::Translation2d(1e8, -1e8));
  EXPECT_NEAR((centroid(moved(ell, far)) - far * Vector<2>(1, 1.5)).norm(), 0, 1e-7);
  for (const double scale : {1e-150, 1e-9, 1e9, 1e150}) {
    const Polygon polygon = moved(ell, Eigen::Affine2d(Eigen::Scaling(scale)));
    EXPECT_EQ(problem(polygon), "");
    EXPECT_TRUE((centroid(polygon) / scale).isApprox(Vector<2>(1, 1.5), 1e-12));
    EXPECT_TRUE(inward_normal(polygon, scale * Vector<2>(1, 2)).isApprox(Vector<2>(-1, 0), 1e-12));
  }
}

TEST(Shape, NormalsOfDiskAndEllipse) {
  const Ellipse ellipse{{3, 0.5}};
  for (int degrees = 0; degrees < 360; degrees += 5) {
    const double t = degrees * pi / 180;
    const Vector<2> direction(std::cos(t), std::sin(t));
    EXPECT_TRUE(inward_normal(Disk{2}, 2 * direction).isApprox(-direction, 1e-12));
    // The tangent at parameter t, turned by 90 degrees.
    const Vector<2> tangent(-3 * std::sin(t), 0.5 * std::cos(t));
    const Vector<2> inward = Vector<2>(-tangent.y(), tangent.x()).normalized();
    const Vector<2> point = ellipse.radii.cwiseProduct(direction);
    EXPECT_TRUE(inward_normal(ellipse, point).isApprox(inward, 1e-9)) << degrees;
  }
}

TEST(Shape, DistanceFromAnEllipseIsThatOfItsNearestPoint) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-2, 2), exponent(-2, 0);
  for (int k = 0; k < 300; ++k) {
    Ellipse ellipse{{1, std::pow(10, exponent(random))}};
    if (k % 2 == 0) ellipse.radii.reverseInPlace();
    Vector<2> point(place(random), place(random));
    if (k % 5 == 1) point.x() = 0;
    if (k % 5 == 2) point.y() = 0;
    if (k % 5 == 3) point.y() = 1e-17;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& p : outline(ellipse, 20000)) least = std::min(least, (p - point).norm());
    EXPECT_NEAR(boundary(ellipse, point).distance, least, 3e-4) << point.transpose();
  }
  EXPECT_DOUBLE_EQ(boundary(Ellipse{{2, 1}}, {0, 0}).distance, 1);
  EXPECT_DOUBLE_EQ(boundary(Ellipse{{1, 1}}, {0, 0}).distance, 1);
  EXPECT_DOUBLE_EQ(boundary(Disk{1}, {0, 0}).distance, 1);
}

TEST(Shape, NormalsOfPolygonsPointInwards) {
  std::mt19937 random(4);
  for (int k = 0; k < 100; ++k) {
    const Polygon polygon = random_star(random, 3 + random() % 10);
    const auto& v = polygon.vertices;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vector<2> from = v[i], to = v[(i + 1) % v.size()], middle = (from + to) / 2;
      const Vector<2> normal = inward_normal(polygon, middle);
      EXPECT_NEAR(normal.norm(), 1, 1e-14);
      EXPECT_NEAR(normal.dot(to - from), 0, 1e-14);
      EXPECT_TRUE(inside(polygon, middle + 1e-6 * normal));
      EXPECT_FALSE(inside(polygon, middle - 1e-6 * normal));
      EXPECT_NEAR(boundary(polygon, middle - 1e-3 * normal).distance, 1e-3, 1e-12);
    }
  }
}

TEST(Shape, ARoundedPointIsStillOnTheBoundary) {
  EXPECT_EQ(normal_problem(Disk{1}, {0.70711, 0.70711}), "");
  EXPECT_EQ(normal_problem(Disk{0.035}, {0.024749, 0.024749}), "");
  EXPECT_EQ(normal_problem(Disk{1}, {0.71, 0.7}),
            "is 0.00295 m from the boundary of the shape, must be within 0.0001 m of it, or give "
            "the normal");
  EXPECT_EQ(normal_problem(ell, {2, 2}),
            "is 1 m from the boundary of the shape, must be within 0.00025 m of it, or give the "
            "normal");
  EXPECT_NE(normal_problem(Disk{1}, {std::nan(""), 0}), "");
}

TEST(Shape, ACornerHasNoNormal) {
  EXPECT_EQ(normal_problem(ell, {1, 1}),
            "is at the corner between edges 2 and 3 of the polygon, give the normal");
  EXPECT_EQ(normal_problem(ell, {0, 0}),
            "is at the corner between edges 0 and 5 of the polygon, give the normal");
  EXPECT_EQ(normal_problem(ell, {2.999999, 0}),
            "is at the corner between edges 0 and 1 of the polygon, give the normal");
  // A vertex on a straight side is none, nor is one where the outline hardly turns.
  const Polygon straight{{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}};
  EXPECT_TRUE(inward_normal(straight, {1, 0}).isApprox(Vector<2>(0, 1)));
  const Polygon round{outline(Disk{1}, 1000)};
  EXPECT_TRUE(inward_normal(round, {1, 0}).isApprox(Vector<2>(-1, 0), 0.004));
}

TEST(Shape, WhatIsNoShape) {
  EXPECT_EQ(problem(Disk{0}), "disk.radius: is 0, must be above 0");
  EXPECT_EQ(problem(Disk{std::nan("")}), "disk.radius: is nan, must be above 0");
  EXPECT_EQ(problem(Disk{1e200}), "disk.radius: is 1e+200, too large to compute with");
  EXPECT_EQ(problem(Ellipse{{1, -2}}), "ellipse.radii[1]: is -2, must be above 0");
  EXPECT_EQ(problem(Polygon{}), "polygon: has 0 vertices, must have 3 to 10000");
  EXPECT_EQ(problem(Polygon{{{0, 0}, {1, 0}, {std::nan(""), 1}}}),
            "polygon[2]: must be finite, its square too");
  EXPECT_EQ(problem(Polygon{{{0, 0}, {1, 0}, {1, 0}, {0, 1}}}),
            "polygon: edge 1, from vertex 1 to vertex 2, has no length: a vertex is given twice");
  EXPECT_EQ(problem(Polygon{{{0, 0}, {0.1, 0.3}, {0.2, 0.6}}}),
            "polygon: edges 1 and 2 fold back on each other, an outline must not touch itself");
  EXPECT_EQ(problem(Polygon{{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}}),
            "polygon: edges 0 and 2 cross or touch, an outline must not touch itself");
  EXPECT_EQ(problem(Polygon{{{0, 0}, {1e-160, 0}, {0, 1e-160}}}),
            "polygon: is too small to compute with");
  EXPECT_EQ(problem(Polygon{std::vector<Vector<2>>(10001)}),
            "polygon: has 10001 vertices, must have 3 to 10000");
  EXPECT_EQ(problem(Polygon{outline(Disk{1}, 10000)}), "");
}

TEST(Shape, PolygonsAreRefusedWhereTheirEdgesCross) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  int refused = 0;
  for (int k = 0; k < 2000; ++k) {
    Polygon polygon;
    const std::size_t n = 4 + random() % 3;
    for (std::size_t i = 0; i < n; ++i) polygon.vertices.emplace_back(place(random), place(random));
    // Second source: the parameters at which the lines of two edges meet.
    bool crosses = false;
    const auto& v = polygon.vertices;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j) {
        if (i == 0 && j == n - 1) continue;
        Eigen::Matrix2d lines;
        lines << v[i + 1] - v[i], v[j] - v[(j + 1) % n];
        const Vector<2> st = lines.inverse() * (v[j] - v[i]);
        crosses |= (st.array() >= 0).all() && (st.array() <= 1).all();
      }
    EXPECT_EQ(problem(polygon).empty(), !crosses);
    refused += crosses;
  }
  EXPECT_GT(refused, 200);
  EXPECT_LT(refused, 1800);
}

TEST(Shape, OutlinesLieOnTheBoundary) {
  EXPECT_EQ(outline(ell), ell.vertices);
  EXPECT_EQ(outline(Disk{2}).size(), 180U);
  for (const Shape& shape : {Shape(Disk{2}), Shape(Ellipse{{2, 0.1}})})
    for (const auto& point : outline(shape, 50)) EXPECT_LT(boundary(shape, point).distance, 1e-12);
}

TEST(Shape, Sizes) {
  EXPECT_EQ(size(Disk{2}), 2);
  EXPECT_EQ(size(Ellipse{{2, 3}}), 3);
  EXPECT_DOUBLE_EQ(size(ell), 2.5);
}

}  // namespace
}  // namespace poise
