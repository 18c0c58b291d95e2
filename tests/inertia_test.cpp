// Inertias of shapes: against sums over small cells.
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "poise/motion.hpp"
#include "shape/shape.hpp"

namespace poise {
namespace {

/// Cells of a box around the origin, as far as they are inside.
Eigen::Matrix3d summed(const Vector<3>& half,
                       const std::function<double(const Vector<3>&)>& inside) {
  constexpr int cells = 40;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const Vector<3> step = 2 * half / cells;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k) {
        const Vector<3> r = -half + Vector<3>(i + 0.5, j + 0.5, k + 0.5).cwiseProduct(step);
        if (const double part = inside(r); part > 0)
          sum += part * step.prod() *
                 (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
      }
  return sum;
}

void expect_near(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double part) {
  EXPECT_LT((a - b).norm(), part * b.norm()) << a << "\n\n" << b;
}

TEST(Inertia, OfSolidsIsTheSumOverTheirCells) {
  const Vector<3> v(0.1, 0.2, 0.3);
  expect_near(inertia(Box{2 * v}), summed(v, [](const Vector<3>&) { return 1; }), 1e-3);
  expect_near(
      inertia(Ellipsoid{v}),
      summed(v, [&](const Vector<3>& r) { return r.cwiseQuotient(v).squaredNorm() <= 1 ? 1 : 0; }),
      2e-2);
  expect_near(
      inertia(Sphere{0.2}),
      summed(Vector<3>::Constant(0.2), [](const Vector<3>& r) { return r.norm() <= 0.2 ? 1 : 0; }),
      2e-2);
  expect_near(inertia(Cylinder{0.2, 0.5}),
              summed({0.2, 0.2, 0.25},
                     [](const Vector<3>& r) { return r.head<2>().norm() <= 0.2 ? 1 : 0; }),
              2e-2);
}

Solid of(Mesh mesh) { return MeshShape{.mesh = std::make_shared<const Mesh>(std::move(mesh))}; }

TEST(Inertia, OfAMeshIsAboutItsCentroidWhereverItLies) {
  // A wedge: the half of a box below the plane x / a + y / b = 0, far from the origin.
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
  // A right triangle with legs a and b: of its area A the integrals about its centroid of x^2, y^2
  // and x y are A a^2 / 18, A b^2 / 18 and -A a b / 36.
  const double x = half.x(), y = half.y(), z = half.z();
  Eigen::Matrix3d second = Eigen::Vector3d(4 * x * x / 18, 4 * y * y / 18, z * z / 3).asDiagonal();
  second(0, 1) = second(1, 0) = -4 * x * y / 36;
  second *= volume(wedge);
  expect_near(inertia(wedge), second.trace() * Eigen::Matrix3d::Identity() - second, 1e-9);
  EXPECT_EQ(inertia_problem(inertia(wedge)), "");
}

}  // namespace
}  // namespace poise
