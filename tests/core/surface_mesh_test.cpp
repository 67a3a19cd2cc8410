#include "core/domain/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/math.h"
#include "tests/support/meshes.h"

namespace wellspaced {
namespace {

using ::testing::HasSubstr;
using namespace wellspaced::testing;

double bumps(double x, double y) {
  return 0.12 * portable_cos_sin(1.3 * x + 0.2).sin * portable_cos_sin(1.7 * y).cos;
}
Vec2 in_plane(const SurfaceMesh& mesh, std::uint32_t face, Vec3 v) {
  const Frame frame = mesh.frame(face);
  return {dot(v, frame.x), dot(v, frame.y)};
}

TEST(SurfaceMesh, IsADomainLikeTheOthers) {
  const SurfaceMesh mesh{TriangleMesh(icosahedron())};
  EXPECT_EQ(mesh.type(), "mesh");
  EXPECT_EQ(mesh.dimension(), 3);
  EXPECT_FALSE(mesh.is_flat());
  EXPECT_EQ(mesh.euler_characteristic(), 2);
  EXPECT_EQ(mesh.boundary_length(), 0);
  EXPECT_EQ(mesh.triangles().size(), 20u);
  double sum = 0;
  for (const DomainTriangle& t : mesh.triangles()) sum += mesh.area_of(t);
  EXPECT_NEAR(sum, mesh.area(), 1e-12);
  EXPECT_NEAR(mesh.box().low.y, -0.85065080835203999, 1e-15);
}

TEST(SurfaceMesh, ComponentsAreInfinitelyFarApart) {
  Triangles two = tetrahedron();
  for (const Vec3 p : tetrahedron().vertices) two.vertices.push_back(p + Vec3{5, 0, 0});
  for (const auto& [a, b, c] : tetrahedron().faces) two.faces.push_back({a + 4, b + 4, c + 4});
  const SurfaceMesh mesh{TriangleMesh(two)};
  EXPECT_EQ(mesh.distance(two.vertices[0], two.vertices[4]), std::numeric_limits<double>::infinity());
  EXPECT_EQ(mesh.distance(two.vertices[0], two.vertices[0]), 0);
}

TEST(SurfaceMesh, OnAFlatSquareVectorsAreDifferences) {
  const SurfaceMesh mesh{TriangleMesh(flat_square(5))};
  Rng rng(1);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p = mesh.random_point(rng), q = mesh.random_point(rng);
    const auto u = mesh.logarithm(p, q, 2);
    ASSERT_TRUE(u.has_value());
    const Vec2 difference = in_plane(mesh, mesh.locate(p).face, q - p);
    EXPECT_NEAR(u->x, difference.x, 1e-14);
    EXPECT_NEAR(u->y, difference.y, 1e-14);
    EXPECT_NEAR(mesh.distance(p, q), norm(q - p), 1e-14);
    EXPECT_LT(norm(mesh.step(p, *u) - q), 1e-14);
  }
}

TEST(SurfaceMesh, OnAFineSphereDistancesAreNearlyArcs) {
  const SurfaceMesh mesh{TriangleMesh(refined_sphere(icosahedron(), 4))};
  Rng rng(1);
  for (int k = 0; k < 50; ++k) {
    const Vec3 p = mesh.random_point(rng), q = mesh.random_point(rng);
    const double arc = portable_atan2(norm(cross(p, q)), dot(p, q));
    EXPECT_NEAR(mesh.distance(p, q), arc, 0.002 * arc);
  }
}

TEST(SurfaceMesh, StepGoesToWhereTheLogarithmPoints) {
  // Convex: no way bends at a vertex, so all places can be stepped to.
  for (const Triangles& triangles : {icosahedron(), tetrahedron(), refined_sphere(icosahedron(), 2)}) {
    const SurfaceMesh mesh{TriangleMesh(triangles)};
    Rng rng(2);
    for (int k = 0; k < 200; ++k) {
      const Vec3 p =
          k % 4 == 0 ? mesh.mesh().corner(static_cast<std::uint32_t>(k) % 4, 2) : mesh.random_point(rng);
      const Vec3 q = mesh.random_point(rng);
      EXPECT_LT(norm(mesh.step(p, mesh.logarithm(p, q, 10).value()) - q), k % 4 == 0 ? 1e-8 : 1e-13) << k;
    }
  }
}

TEST(SurfaceMesh, StepStaysOnTheSurfaceAndIsAsLongAsItSays) {
  const SurfaceMesh mesh{TriangleMesh(height_field(8, 1, bumps))};
  Rng rng(5);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p = mesh.random_point(rng);
    const Vec2 wish{rng.uniform() - 0.5, rng.uniform() - 0.5}, u = mesh.possible(p, wish);
    EXPECT_NEAR(cross(wish, u), 0, 1e-15);
    EXPECT_LE(norm(u), norm(wish));
    const Vec3 q = mesh.step(p, u);
    EXPECT_EQ(mesh.freedom(q).dimensions, 2);
    EXPECT_LT(norm(mesh.nearest(q) - q), 1e-15);
    EXPECT_LE(mesh.distance(p, q), norm(u) * (1 + 1e-12));
    const Vec2 short_way = mesh.possible(p, 1e-3 * wish);
    EXPECT_NEAR(mesh.distance(p, mesh.step(p, short_way)), norm(short_way), 1e-9);
  }
}

TEST(SurfaceMesh, GoesOverEdgesAsIfTheyWereUnfolded) {
  // Around a prism of n sides and circumference c, straight on: back at the beginning.
  const std::uint32_t n = 11;
  const SurfaceMesh mesh{TriangleMesh(open_cylinder(n))};
  const double c = 2 * n * portable_cos_sin(1, 2 * n).sin;
  Rng rng(4);
  for (int k = 0; k < 50; ++k) {
    const Vec3 p = mesh.random_point(rng);
    const Vec2 around = in_plane(mesh, mesh.locate(p).face, {-p.y, p.x, 0});
    EXPECT_LT(norm(mesh.step(p, (c / norm(around)) * around) - p), 1e-13);
    const Vec3 opposite = mesh.step(p, (c / 2 / norm(around)) * around);
    EXPECT_NEAR(mesh.distance(p, opposite), c / 2, 1e-12);
  }
}

TEST(SurfaceMesh, RefusesPointsBesideTheSurfaceAndSaysHowFar) {
  const SurfaceMesh mesh{TriangleMesh(flat_square(3))};
  EXPECT_FALSE(mesh.why_outside({0.3, 0.2, 0}).has_value());
  EXPECT_FALSE(mesh.why_outside({0.3, 0.2, 1e-10}).has_value());
  EXPECT_THAT(mesh.why_outside({0.3, 0.2, 0.25}).value(), HasSubstr("0.25 away from the surface"));
  EXPECT_THAT(mesh.why_outside({-3, -4, 0}).value(), HasSubstr("5 away from the surface"));
  Rng rng(1);
  const SurfaceMesh sphere{TriangleMesh(refined_sphere(icosahedron(), 3))};
  for (int k = 0; k < 1000; ++k) EXPECT_FALSE(sphere.why_outside(sphere.random_point(rng)).has_value());
}

TEST(SurfaceMesh, FindsTheNearestFaceOfAll) {
  const SurfaceMesh mesh{TriangleMesh(height_field(6, 1, bumps))};
  Rng rng(8);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p{1.4 * rng.uniform() - 0.2, 1.4 * rng.uniform() - 0.2, rng.uniform() - 0.5};
    double nearest = std::numeric_limits<double>::infinity();
    for (const DomainTriangle& triangle : mesh.triangles())
      nearest = std::min(nearest, std::sqrt(FaceTree({&triangle, 1}).nearest(p).distance2));
    EXPECT_NEAR(norm(mesh.nearest(p) - p), nearest, 1e-14);
  }
}

TEST(SurfaceMesh, RandomPointsAreUniformByArea) {
  const SurfaceMesh mesh{TriangleMesh(height_field(3, 1, [](double x, double) { return 3 * x * x; }))};
  Rng rng(6);
  constexpr int n = 100000;
  std::vector<double> count(mesh.triangles().size(), 0);
  for (int k = 0; k < n; ++k) ++count[mesh.locate(mesh.random_point(rng)).face];
  double chi2 = 0;
  for (std::size_t f = 0; f < count.size(); ++f) {
    const double expected = n * mesh.area_of(mesh.triangles()[f]) / mesh.area();
    chi2 += (count[f] - expected) * (count[f] - expected) / expected;
  }
  EXPECT_LT(chi2, 40);  // 17 degrees of freedom: 1 in 1000
}

TEST(SurfaceMesh, LocalizeKeepsWhatIsNearOnTheSurface) {
  // A sheet and its copy close above it, joined at one side: near in space is far on the surface.
  Triangles fold = height_field(6, 1, [](double, double) { return 0.0; });
  const auto shift = static_cast<std::uint32_t>(fold.vertices.size());
  const Triangles flat = fold;
  for (const Vec3 p : flat.vertices) fold.vertices.push_back({p.x, p.y, 0.01});
  for (const auto& [a, b, c] : flat.faces) fold.faces.push_back({a + shift, c + shift, b + shift});
  for (std::uint32_t j = 0; j < 6; ++j) {
    const std::uint32_t a = 7 * j, b = a + 7;
    fold.faces.push_back({a, b, b + shift});
    fold.faces.push_back({a, b + shift, a + shift});
  }
  const SurfaceMesh mesh{TriangleMesh(fold)};
  const Vec3 base{0.3, 0.42, 0};
  std::vector<Neighbor> neighbors = {
      {{0.1, 0.1, 0}, 7}, {{0, 0, 0.01}, 8}, {{-0.25, 0, 0.01}, 9}, {{0.3, 0, 0}, 10}, {{0.4, 0.31, 0}, 11}};
  mesh.localize(base, 0.5, neighbors);
  ASSERT_EQ(neighbors.size(), 3u);
  EXPECT_EQ(neighbors[0].id, 7u);
  EXPECT_NEAR(norm(neighbors[0].offset), std::sqrt(0.02), 1e-14);
  EXPECT_EQ(neighbors[0].offset.z, 0);
  EXPECT_EQ(neighbors[1].id, 9u);
  EXPECT_NEAR(norm(neighbors[1].offset), 0.3 + 0.01 + 0.05, 1e-14);
  EXPECT_EQ(neighbors[2].id, 10u);
  std::vector<HalfPlane> half_planes(3);
  mesh.bisectors(base, {0.1, 0}, neighbors, half_planes);
  EXPECT_NEAR(half_planes[0].n.x, neighbors[0].offset.x - 0.1, 1e-15);
  EXPECT_NEAR(half_planes[0].c, norm2(half_planes[0].n) / 2, 1e-15);
}

TEST(SurfaceMesh, LocalizeIsTheSameForManyNeighborsAsForEach) {
  // Faces so small that it aims first, and more neighbors than are aimed at together.
  const SurfaceMesh mesh{TriangleMesh(height_field(60, 1, bumps))};
  Rng rng(9);
  std::size_t images = 0;  // beyond the first ones
  for (int k = 0; k < 4; ++k) {
    const Vec3 p = mesh.random_point(rng);
    std::vector<Neighbor> neighbors;
    for (std::uint32_t i = 0; i < 150; ++i) neighbors.push_back({mesh.random_point(rng) - p, i});
    const std::vector<Neighbor> before = neighbors;
    mesh.localize(p, 0.6, neighbors);
    std::size_t at = 0;
    for (const Neighbor& neighbor : before) {
      const Vec3 q = p + neighbor.offset;
      const double distance = mesh.distance(p, q);
      ASSERT_EQ(at < neighbors.size() && neighbors[at].id == neighbor.id, distance <= 0.6) << neighbor.id;
      if (distance > 0.6) continue;
      EXPECT_NEAR(norm(neighbors[at].offset), distance, 1e-12);
      for (bool is_first = true; at < neighbors.size() && neighbors[at].id == neighbor.id; is_first = false) {
        const Vec2 way = mesh.way_to(p, neighbors[at++]);
        images += is_first ? 0 : 1;
        if (!is_first) {
          EXPECT_LT(norm(mesh.place_at(p, way) - q), 1e-9) << neighbor.id;
        }
      }
    }
    EXPECT_EQ(at, neighbors.size());
  }
  EXPECT_GT(images, 10u);
}

/// The corner of a cube, unfolded by hand: what lies behind it is seen past both of its sides, a quarter turn
/// apart.
TEST(SurfaceMesh, WhatLiesBehindACornerIsSeenPastBothOfItsSides) {
  // Three squares that meet in the origin, seen from outside.
  const Triangles corner{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}},
                         {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 5, 4}, {0, 6, 5}, {0, 1, 6}}};
  const SurfaceMesh mesh{TriangleMesh(corner)};
  const Vec3 p{0.4, 0.4, 0}, q{0, 0.1, 0.12};
  std::vector<Neighbor> neighbors = {{q - p, 5}};
  mesh.localize(p, 2, neighbors);
  ASSERT_EQ(neighbors.size(), 2u);
  // Over the edge along y: q in the plane z = 0 is (-0.12, 0.1). Over the edge along x, and then that along
  // z: (0.1, -0.12) and a quarter turn on, which is not in sight, or (-0.1, -0.12).
  const double direct = std::hypot(0.4 + 0.12, 0.4 - 0.1), around = std::hypot(0.4 + 0.1, 0.4 + 0.12);
  EXPECT_NEAR(norm(neighbors[0].offset), direct, 1e-14);
  EXPECT_NEAR(norm(neighbors[1].offset), around, 1e-14);
}

TEST(SurfaceMesh, HardMeshesStayExact) {
  // Needles, an axis far from the origin, all of one plane but for a fold.
  Triangles needles = height_field(6, 1, [](double x, double) { return std::fabs(x - 0.5); });
  for (Vec3& p : needles.vertices) p = {1000 + 1e-4 * p.x, p.y, 1e-4 * p.z};
  const SurfaceMesh mesh{TriangleMesh(needles)};
  Rng rng(13);
  for (int k = 0; k < 100; ++k) {
    const Vec3 p = mesh.random_point(rng), q = mesh.random_point(rng);
    const double unfolded = std::sqrt(2.0) * (p.x - q.x);
    EXPECT_NEAR(mesh.distance(p, q), norm(Vec2{unfolded, p.y - q.y}), 2e-9);  // vertices are rounded
    EXPECT_FALSE(mesh.why_outside(p).has_value());
  }
}

}  // namespace
}  // namespace wellspaced
