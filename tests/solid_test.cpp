#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "shape/shape.hpp"

namespace poise {
namespace {

const Box box{{4, 2, 1}};
const Cylinder cylinder{1, 4};
const Ellipsoid ellipsoid{{3, 2, 0.5}};

std::string problem(const Solid& solid) {
  try {
    check(solid);
  } catch (const InvalidShape& error) {
    return error.what();
  }
  return "";
}

std::string normal_problem(const Solid& solid, const Vector<3>& point) {
  try {
    inward_normal(solid, point);
  } catch (const NoNormal& error) {
    return error.what();
  }
  return "";
}

Vector<3> random_direction(std::mt19937& random) {
  std::normal_distribution<double> number;
  const double x = number(random), y = number(random);
  return Vector<3>(x, y, number(random)).normalized();
}

/// How far inside a point is, positive inside; zero on the surface. From the definitions.
double depth(const Solid& solid, const Vector<3>& p) {
  if (const auto* b = std::get_if<Box>(&solid)) return (b->size / 2 - p.cwiseAbs()).minCoeff();
  if (const auto* c = std::get_if<Cylinder>(&solid))
    return std::min(c->radius - std::hypot(p.x(), p.y()), c->height / 2 - std::abs(p.z()));
  if (const auto* s = std::get_if<Sphere>(&solid)) return s->radius - p.norm();
  return 1 - p.cwiseQuotient(std::get<Ellipsoid>(solid).radii).norm();
}

/// Where a ray from the middle leaves the solid, by bisection.
Vector<3> surface_point(const Solid& solid, const Vector<3>& direction) {
  double inside = 0, outside = 10;
  for (int k = 0; k < 60; ++k) {
    const double middle = (inside + outside) / 2;
    (depth(solid, middle * direction) > 0 ? inside : outside) = middle;
  }
  return inside * direction;
}

const std::vector<Solid> solids{
    box, cylinder, Sphere{2}, ellipsoid, Ellipsoid{{1, 1, 2}}, Ellipsoid{{1, 2, 2}}};

TEST(Solid, NormalsPointStraightIn) {
  std::mt19937 random(1);
  int normals = 0;
  for (const Solid& solid : solids) {
    EXPECT_EQ(problem(solid), "");
    for (int k = 0; k < 500; ++k) {
      const Vector<3> point = surface_point(solid, random_direction(random));
      const Boundary<3> at = boundary(solid, point);
      EXPECT_NEAR(at.distance, 0, 1e-12);
      if (!at.corner.empty()) continue;
      ++normals;
      const Vector<3> n = inward_normal(solid, point);
      EXPECT_NEAR(n.norm(), 1, 1e-14);
      // The steepest way in, by differences.
      Vector<3> steepest;
      for (int j = 0; j < 3; ++j) {
        const Vector<3> step = 1e-6 * Vector<3>::Unit(j);
        steepest[j] = depth(solid, point + step) - depth(solid, point - step);
      }
      EXPECT_TRUE(n.isApprox(steepest.normalized(), 1e-5)) << point.transpose();
      EXPECT_NEAR(boundary(solid, point - 0.3 * n).distance, 0.3, 1e-9);
    }
  }
  EXPECT_GT(normals, 2900);
}

TEST(Solid, DistanceIsThatOfTheNearestPoint) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-3, 3);
  for (const Solid& solid : solids) {
    std::vector<Vector<3>> surface;
    for (int k = 0; k < 20000; ++k)
      surface.push_back(surface_point(solid, random_direction(random)));
    for (int k = 0; k < 50; ++k) {
      Vector<3> point(place(random), place(random), place(random));
      if (k % 3 == 1) point[k % 2] = 0;
      if (k % 3 == 2) point.tail<2>().setZero();
      if (k % 10 == 2) point.setZero();
      double least = std::numeric_limits<double>::infinity();
      for (const auto& p : surface) least = std::min(least, (p - point).norm());
      const double distance = boundary(solid, point).distance;
      EXPECT_LE(distance, least + 1e-9) << point.transpose();
      EXPECT_GE(distance, least - 0.06) << point.transpose();
    }
  }
}

TEST(Solid, EdgesAndCornersHaveNoNormal) {
  EXPECT_EQ(normal_problem(box, {2, 0, 0}), "");
  EXPECT_EQ(normal_problem(box, {2, 0, 0.5}),
            "is on the edge between face +x and face +z of the box, give the normal");
  EXPECT_EQ(normal_problem(box, {-2, -1, 0.50001}),
            "is at the corner between face -x, face -y and face +z of the box, give the normal");
  EXPECT_EQ(normal_problem(cylinder, {0.6, 0.8, 0}), "");
  EXPECT_EQ(normal_problem(cylinder, {0, 0, -2}), "");
  EXPECT_EQ(normal_problem(cylinder, {0.6, 0.8, -2}),
            "is on the edge between the side and the end -z of the cylinder, give the normal");
}

TEST(Solid, APointOffTheSurfaceHasNoNormal) {
  EXPECT_EQ(normal_problem(Sphere{1}, {0, 0.9, 0}),
            "is 0.1 m from the boundary of the shape, must be within 0.0001 m of it, or give the "
            "normal");
  EXPECT_NE(normal_problem(cylinder, {1, 0, 2.1}), "");
  EXPECT_NE(normal_problem(box, {0, 0, 0}), "");
  EXPECT_NE(normal_problem(box, {std::nan(""), 0, 0}), "");
}

TEST(Solid, SlenderOnesStillHaveTwoSides) {
  const Box sheet{{5000, 5000, 1}};
  EXPECT_TRUE(inward_normal(sheet, {0, 0, 0.5}).isApprox(Vector<3>(0, 0, -1)));
  EXPECT_TRUE(inward_normal(sheet, {0, 0, -0.4}).isApprox(Vector<3>(0, 0, 1)));
  const Cylinder wire{0.5, 5000}, coin{2500, 1};
  EXPECT_TRUE(inward_normal(wire, {0, -0.4, 100}).isApprox(Vector<3>(0, 1, 0)));
  EXPECT_NE(normal_problem(wire, {0, 0, 100}), "");
  EXPECT_TRUE(inward_normal(coin, {0, 1, -0.4}).isApprox(Vector<3>(0, 0, 1)));
}

TEST(Solid, MeasuresAndMiddle) {
  EXPECT_EQ(size(Solid(box)), std::sqrt(21.0) / 2);
  EXPECT_EQ(size(Solid(cylinder)), std::sqrt(6.0));
  EXPECT_EQ(size(Solid(Sphere{2})), 2);
  EXPECT_EQ(size(Solid(ellipsoid)), 3);
  for (const Solid& solid : solids) {
    EXPECT_EQ(centroid(solid), (Vector<3>(0, 0, 0)));
    const Eigen::AlignedBox3d in = bounds(solid);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(depth(solid, in.max()[k] * Vector<3>::Unit(k)), 0, 1e-15);
      EXPECT_EQ(in.min()[k], -in.max()[k]);
    }
  }
}

TEST(Solid, WhatIsNoSolid) {
  EXPECT_EQ(problem(Box{{1, 0, 1}}), "box.size[1]: is 0, must be above 0");
  EXPECT_EQ(problem(Box{{1, 1, 1e-4}}),
            "box.size: are 1, 1 and 0.0001, one must be at most 5000 times the other");
  EXPECT_EQ(problem(Cylinder{-1, 1}), "cylinder.radius: is -1, must be above 0");
  EXPECT_EQ(problem(Cylinder{1, std::nan("")}), "cylinder.height: is nan, must be above 0");
  EXPECT_EQ(problem(Cylinder{1, 1e-6}),
            "cylinder: has a height of 5e-07 diameters, must be from 0.0002 to 5000");
  EXPECT_EQ(problem(Sphere{1e200}), "sphere.radius: is 1e+200, too large to compute with");
  EXPECT_EQ(problem(Ellipsoid{{1, 1e4, 1}}),
            "ellipsoid.radii: are 1, 10000 and 1, one must be at most 5000 times the other");
}

}  // namespace
}  // namespace poise
