// Inertias of shapes: against sums over small cells.
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "poise/motion.hpp"
#include "shape/shape.hpp"

namespace poise {
namespace {

/// Cells of a box around the origin whose middles are inside.
Eigen::Matrix3d summed(const Vector<3>& half, const std::function<bool(const Vector<3>&)>& inside) {
  constexpr int cells = 80;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const Vector<3> step = 2 * half / cells;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k) {
        const Vector<3> r = -half + Vector<3>(i + 0.5, j + 0.5, k + 0.5).cwiseProduct(step);
        if (inside(r))
          sum += step.prod() * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
      }
  return sum;
}

void expect_near(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double part) {
  EXPECT_LT((a - b).norm(), part * b.norm()) << a << "\n\n" << b;
}

TEST(Inertia, OfSolidsIsTheSumOverTheirCells) {
  const Vector<3> v(0.1, 0.2, 0.3);
  expect_near(inertia(Box{2 * v}), summed(v, [](const Vector<3>&) { return true; }), 1e-3);
  expect_near(inertia(Ellipsoid{v}),
              summed(v, [&](const Vector<3>& r) { return r.cwiseQuotient(v).squaredNorm() <= 1; }),
              5e-3);
  expect_near(inertia(Sphere{0.2}),
              summed(Vector<3>::Constant(0.2), [](const Vector<3>& r) { return r.norm() <= 0.2; }),
              5e-3);
  expect_near(
      inertia(Cylinder{0.2, 0.5}),
      summed({0.2, 0.2, 0.25}, [](const Vector<3>& r) { return r.head<2>().norm() <= 0.2; }), 5e-3);
}

Solid of(Mesh mesh) { return MeshShape{.mesh = std::make_shared<const Mesh>(std::move(mesh))}; }

TEST(Inertia, OfAMeshIsAboutItsCentroidWhereverItLies) {
  // A wedge: the half of a box below the plane x / a + y / b = 0, shifted.
  const Vector<3> half(0.1, 0.2, 0.3), shift(7, -5, 3);
  Mesh mesh;
  for (const double z : {-half.z(), half.z()})
    for (const Vector<2>& corner :
         {Vector<2>(-half.x(), -half.y()), {half.x(), -half.y()}, {-half.x(), half.y()}})
      mesh.vertices.push_back(shift + Vector<3>(corner.x(), corner.y(), z));
  mesh.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                    {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  const Solid wedge = of(mesh);
  ASSERT_NEAR(volume(wedge), 4 * half.prod(), 1e-9);
  const Vector<3> middle = centroid(wedge) - shift;
  const Eigen::Matrix3d about_origin =
      summed(half, [&](const Vector<3>& r) { return r.x() / half.x() + r.y() / half.y() < -1e-9; });
  const Eigen::Matrix3d moved =
      volume(wedge) *
      (middle.squaredNorm() * Eigen::Matrix3d::Identity() - middle * middle.transpose());
  expect_near(inertia(wedge), about_origin - moved, 3e-2);
  EXPECT_EQ(inertia_problem(inertia(wedge)), "");
}

}  // namespace
}  // namespace poise
