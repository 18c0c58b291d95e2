// Volumes and centroids against closed forms, laws, and what can and cannot be mended.
#include "shape/mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "meshes.hpp"

namespace poise {
namespace {

using namespace test;
using Strings = std::vector<std::string>;

const double pi = std::acos(-1.0);

/// Of a regular polygon in the unit circle, as a part of the circle's.
double polygon_part(int sides) { return std::sin(2 * pi / sides) * sides / (2 * pi); }

TEST(MeshVolume, OfABoxIsItsProduct) {
  const Mesh box = box_mesh({2, 3, 0.5});
  EXPECT_NEAR(volume(box), 3, 1e-15);
  EXPECT_TRUE(centroid(box).isApprox(Vector3d(1, 1.5, 0.25), 1e-15));
  EXPECT_NEAR(volume(inside_out(box)), -3, 1e-15);
  EXPECT_TRUE(centroid(inside_out(box)).isApprox(Vector3d(1, 1.5, 0.25), 1e-15));
}

TEST(MeshVolume, OfAPrismIsThatOfItsPolygon) {
  for (const int sides : {3, 4, 7, 100}) {
    const Mesh prism = cylinder_mesh(0.3, 2, sides);
    EXPECT_NEAR(volume(prism), 2 * pi * 0.09 * polygon_part(sides), 1e-14);
    EXPECT_LE(centroid(prism).norm(), 1e-15);
  }
}

TEST(MeshVolume, OfATorusIsThatOfItsPolygons) {
  // Pappus holds for the polygon that the tube is, swept round the polygon that the ring is.
  const Mesh torus = torus_mesh(1, 0.25, 60, 40);
  EXPECT_NEAR(volume(torus), 2 * pi * pi * 0.25 * 0.25 * polygon_part(60) * polygon_part(40), 3e-4);
  EXPECT_NEAR(volume(torus_mesh(1, 0.25, 2000, 400)), 2 * pi * pi * 0.25 * 0.25, 1e-4);
  EXPECT_LE(centroid(torus).norm(), 1e-15);
}

TEST(MeshVolume, OfAConeIsAThird) {
  const Mesh cone = turned_mesh({{0, 0}, {0.5, 0}, {0, 2}}, 50);
  EXPECT_NEAR(volume(cone), pi * 0.25 * 2 / 3 * polygon_part(50), 1e-14);
  EXPECT_TRUE(centroid(cone).isApprox(Vector3d(0, 0, 0.5), 1e-13));
}

TEST(MeshVolume, MovesAndGrowsWithTheMesh) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  const Mesh cone = turned_mesh({{0, 0}, {0.5, 0}, {0.2, 1}, {0, 2}}, 20);
  const double v = volume(cone);
  const Vector3d c = centroid(cone);
  for (int k = 0; k < 100; ++k) {
    const double scale = std::pow(10, 3 * number(random));
    Eigen::Affine3d motion =
        Eigen::Translation3d(10 * Vector3d(number(random), 0, 1)) *
        Eigen::AngleAxisd(3 * number(random), Vector3d(1, number(random), 0.3).normalized()) *
        Eigen::Scaling(scale);
    const Mesh other = moved(cone, motion);
    EXPECT_NEAR(volume(other) / (v * std::pow(scale, 3)), 1, 1e-9);
    EXPECT_LE((centroid(other) - motion * c).norm(), 1e-12 * (scale + 10));
  }
  // Far away, as the tables of data sets are.
  const Mesh far = moved(cone, Eigen::Affine3d(Eigen::Translation3d(1e4, -1e4, 1e4)));
  EXPECT_NEAR(volume(far), v, 1e-10);
  EXPECT_LE((centroid(far) - c - Vector3d(1e4, -1e4, 1e4)).norm(), 1e-10);
}

/// Its repairs, or that nothing could be done.
Strings repairs_of(const Mesh& mesh, double expected_volume, const Vector3d& expected_centroid) {
  const MendedMesh result = mended(mesh);
  EXPECT_EQ(result.defect, "");
  EXPECT_NEAR(volume(result.mesh), expected_volume, 1e-6 * expected_volume);
  EXPECT_LE((centroid(result.mesh) - expected_centroid).norm(), 1e-5);
  return result.repairs;
}

const Mesh box = box_mesh({2, 3, 0.5});
const Vector3d middle(1, 1.5, 0.25);

TEST(MendedMesh, AClosedMeshStaysAsItIs) {
  EXPECT_EQ(repairs_of(box, 3, middle), Strings());
  EXPECT_EQ(repairs_of(soup(box), 3, middle), Strings());
  EXPECT_EQ(mended(soup(box)).mesh.vertices.size(), 8U);
  EXPECT_EQ(repairs_of(torus_mesh(1, 0.25, 30, 20), volume(torus_mesh(1, 0.25, 30, 20)),
                       Vector3d::Zero()),
            Strings());
}

TEST(MendedMesh, TurnsWhatIsInsideOut) {
  EXPECT_EQ(repairs_of(inside_out(box), 3, middle), Strings{"was inside out, and was turned"});
  Mesh mixed = box;
  for (const std::size_t t : {2U, 7U, 11U}) std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  EXPECT_EQ(repairs_of(mixed, 3, middle),
            Strings{"3 triangles of it did not agree with the neighbours and were turned"});
}

TEST(MendedMesh, MakesVerticesOneThatAreNear) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  Mesh rough = soup(box);
  for (Vector3d& v : rough.vertices)
    v += 3e-7 * Vector3d(number(random), number(random), number(random));
  const Strings repairs = repairs_of(rough, 3, middle);
  ASSERT_EQ(repairs.size(), 1U);
  EXPECT_EQ(repairs[0],
            "was open: 28 vertices no farther than 1e-06 of its size from others were made one "
            "with them");
  for (Vector3d& v : rough.vertices)
    v += 1e-3 * Vector3d(number(random), number(random), number(random));
  EXPECT_EQ(mended(rough).defect,
            "is not closed: 36 edges of its 12 triangles belong to one triangle only");
}

TEST(MendedMesh, LeavesOutWhatStandsTwice) {
  Mesh twice = box;
  twice.triangles.push_back(box.triangles[3]);
  EXPECT_EQ(repairs_of(twice, 3, middle), Strings{"had 1 triangle twice, of which one was kept"});
  // Both sides of each triangle, as renderers like it.
  Mesh two_sided = box;
  for (const auto& t : inside_out(box).triangles) two_sided.triangles.push_back(t);
  EXPECT_EQ(repairs_of(two_sided, 3, middle),
            Strings{"had 12 triangles twice, of which one was kept"});
  // Two boxes with a wall between them.
  const Mesh neighbour = moved(box, Eigen::Affine3d(Eigen::Translation3d(2, 0, 0)));
  EXPECT_EQ(repairs_of(together(box, neighbour), 6, Vector3d(2, 1.5, 0.25)),
            Strings{"had 4 triangles twice that bound nothing: they were left out"});
}

TEST(MendedMesh, TakesPartsThatDoNotOverlapAsOneBody) {
  const Mesh away = moved(box, Eigen::Affine3d(Eigen::Translation3d(4, 0, 0)));
  EXPECT_EQ(repairs_of(together(box, inside_out(away)), 6, Vector3d(3, 1.5, 0.25)),
            (Strings{"1 part of it was inside out, and turned",
                     "has 2 parts that do not overlap: they are taken as one rigid body"}));
  // Two that share an edge, where four triangles meet.
  const Mesh diagonal = moved(box, Eigen::Affine3d(Eigen::Translation3d(2, 3, 0)));
  EXPECT_EQ(repairs_of(together(box, diagonal), 6, Vector3d(2, 3, 0.25)),
            Strings{"has 2 parts that do not overlap: they are taken as one rigid body"});
}

TEST(MendedMesh, ManyPartsTakeNoTime) {
  const Mesh small = moved(box, Eigen::Affine3d(Eigen::Scaling(0.1)));
  Mesh parts;
  for (int k = 0; k < 20000; ++k) {
    for (const Vector3d& v : small.vertices)
      parts.vertices.push_back(v + Vector3d(k % 200, k / 200, 0));
    for (const auto& [a, b, c] : small.triangles)
      parts.triangles.push_back({a + 8 * k, b + 8 * k, c + 8 * k});
  }
  EXPECT_NEAR(volume(mended(parts).mesh), 20000 * 3e-3, 1e-9);
  EXPECT_EQ(mended(parts).repairs,
            Strings{"has 20000 parts that do not overlap: they are taken as one rigid body"});
  for (std::size_t i = 8; i < 16; ++i) parts.vertices[i].x() -= 0.9;
  EXPECT_NE(mended(parts).defect.find("has 20000 parts that may overlap"), std::string::npos);
}

TEST(MendedMesh, NoticesThatASurfaceCrossesItself) {
  // A tube along a figure of eight, which meets itself in the middle.
  const Mesh eight = ring_mesh(80, 24, [](int i, int j) {
    const double t = turn(i, 80) + 0.01, a = turn(j, 24);
    const Vector3d centre(std::sin(t), std::sin(t) * std::cos(t), 0);
    const Vector3d across = Vector3d(-std::cos(2 * t), std::cos(t), 0).normalized();
    return Vector3d(centre + 0.2 * (std::cos(a) * across + std::sin(a) * Vector3d::UnitZ()));
  });
  const Strings words = mended(eight).repairs;
  ASSERT_GE(words.size(), 1U);
  EXPECT_EQ(words.back().find("crosses itself: beneath "), 0U) << words.back();
  // Walls that are thin, and edges that are sharp, are none of it.
  for (const Mesh& mesh :
       {torus_mesh(1, 0.99, 60, 40), box_mesh({1, 1, 1e-6}), sphere_mesh(1, 60, 60),
        turned_mesh({{0, 0}, {1, 0.01}, {0, 0.02}}, 100),
        turned_mesh({{0, 0}, {1, 0}, {1, 1}, {0.999999, 1}, {0.999999, 1e-6}, {0, 1e-6}}, 100)})
    EXPECT_EQ(mended(mesh).repairs, Strings());
}

TEST(MendedMesh, SaysWhyThereIsNoVolume) {
  EXPECT_EQ(mended({}).defect, "has no triangles");
  EXPECT_EQ(mended({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}).defect, "has no triangles");
  Mesh open = box;
  open.triangles.pop_back();
  EXPECT_EQ(mended(open).defect,
            "is not closed: 3 edges of its 11 triangles belong to one triangle only");
  EXPECT_EQ(mended(open).mesh.triangles.size(), 11U);
  const Mesh flat = moved(box, Eigen::Affine3d(Eigen::Scaling(1.0, 1.0, 0.0)));
  EXPECT_NE(mended(flat).defect, "");
  Mesh infinite = box;
  infinite.vertices[3].x() = std::nan("");
  EXPECT_EQ(mended(infinite).defect, "has a vertex that is not finite");
  const Mesh inner = moved(box, Eigen::Translation3d(0.5, 0.5, 0.1) * Eigen::Scaling(0.5));
  for (const Mesh& nested : {together(box, inner), together(box, inside_out(inner))})
    EXPECT_EQ(mended(nested).defect,
              "has 2 parts that may overlap or lie within each other: what is solid is not known");
  // A wall inside: at its rim three triangles meet.
  Mesh wall = box;
  wall.triangles.push_back({0, 3, 7});
  wall.triangles.push_back({0, 7, 4});
  EXPECT_EQ(mended(wall).defect,
            "is not closed: at 4 edges more than two triangles meet that do not bound a body");
}

TEST(MendedMesh, AMoebiusBandHasNoInside) {
  // A closed surface without an inside: a Klein bottle, as a grid glued with one turn reversed.
  const int n = 8;
  Mesh bottle;
  for (int i = 0; i < n * n; ++i)
    bottle.vertices.emplace_back(std::cos(i), std::sin(1.7 * i), std::cos(2.3 * i));
  const auto at = [&](int i, int j) { return i < n ? i * n + j % n : (2 * n - j % n) % n; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      bottle.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      bottle.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  EXPECT_EQ(mended(bottle).defect, "has no inside: its triangles cannot all face outwards");
}

}  // namespace
}  // namespace poise
