#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/surface_mesh.h"
#include "core/math.h"
#include "core/voronoi/cell.h"
#include "tests/support/meshes.h"

namespace wellspaced {
namespace {

using namespace wellspaced::testing;

double bumps(double x, double y) {
  return 0.12 * portable_cos_sin(1.3 * x + 0.2).sin * portable_cos_sin(1.7 * y).cos;
}
Vec2 in_plane(const SurfaceMesh& mesh, std::uint32_t face, Vec3 v) {
  const Frame frame = mesh.frame(face);
  return {dot(v, frame.x), dot(v, frame.y)};
}

TEST(SurfaceMeshBorder, PiecesOfAFineMeshAddUpToItsArea) {
  const SurfaceMesh mesh{TriangleMesh(flat_square(100))};
  ChartPieces pieces;
  ASSERT_TRUE(mesh.pieces({0.3, 0.4, 0}, 2, pieces));
  double area = 0;
  for (std::size_t k = 0; k < pieces.ends.size(); ++k) area += cross(pieces[k][1], pieces[k][2]) / 2;
  EXPECT_NEAR(area, 1, 1e-12);
}

TEST(SurfaceMeshBorder, TheBorderIsCutAtItsCorners) {
  const SurfaceMesh square{TriangleMesh(flat_square(4))};
  ASSERT_EQ(square.boundary().size(), 4u);
  EXPECT_NEAR(square.boundary_length(), 4, 1e-14);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_FALSE(square.boundary()[c].closed);
    EXPECT_NEAR(square.boundary()[c].length, 1, 1e-15);
    EXPECT_EQ(square.freedom(square.boundary_point(c, 0)).dimensions, 0);
    EXPECT_EQ(square.boundary_point(c, 1), square.boundary_point((c + 1) % 4, 0));
    for (const double along : {1e-300, 1e-3, 0.25, 0.3, 0.5, 0.999, 1 - 1e-16}) {
      const Vec3 p = square.boundary_point(c, along);
      const Freedom freedom = square.freedom(p);
      ASSERT_EQ(freedom.dimensions, 1) << along;
      const Vec2 tangent =
          in_plane(square, square.locate(p).face, square.boundary_point(c, 1) - square.boundary_point(c, 0));
      EXPECT_NEAR(dot(tangent, freedom.along), 1, 1e-14);
    }
  }
  const SurfaceMesh cylinder{TriangleMesh(open_cylinder(16))};
  ASSERT_EQ(cylinder.boundary().size(), 2u);
  EXPECT_TRUE(cylinder.boundary()[0].closed);
  EXPECT_EQ(cylinder.freedom(cylinder.boundary_point(0, 0)).dimensions, 1);
  EXPECT_LT(
      norm(cylinder.boundary_point(1, 0.3) - cylinder.boundary_point(1, 0.3 + cylinder.boundary()[1].length)),
      1e-14);
}

TEST(SurfaceMeshBorder, BorderPointsSlideBetweenCorners) {
  const SurfaceMesh mesh{TriangleMesh(height_field(7, 1, bumps))};
  Rng rng(11);
  for (std::size_t c = 0; c < mesh.boundary().size(); ++c) {
    const double length = mesh.boundary()[c].length;
    EXPECT_EQ(mesh.step(mesh.boundary_point(c, 0), {1, 1}), mesh.boundary_point(c, 0));
    EXPECT_EQ(mesh.possible(mesh.boundary_point(c, 0), {1, 1}), Vec2{});
    for (int k = 0; k < 100; ++k) {
      const double at = length * (0.01 + 0.98 * rng.uniform());
      const Vec3 p = mesh.boundary_point(c, at);
      const Freedom freedom = mesh.freedom(p);
      ASSERT_EQ(freedom.dimensions, 1);
      const double s = 3 * (rng.uniform() - 0.5);
      const Vec2 u = mesh.possible(p, s * freedom.along);
      EXPECT_NEAR(cross(u, freedom.along), 0, 1e-15);
      const Vec3 q = mesh.step(p, u);
      EXPECT_EQ(mesh.freedom(q).dimensions, 1);
      EXPECT_LT(norm(q - mesh.boundary_point(c, at + std::clamp(s, -0.75 * at, 0.75 * (length - at)))),
                1e-13);
      EXPECT_EQ(mesh.possible(p, Vec2{-freedom.along.y, freedom.along.x}), Vec2{});
    }
  }
}

TEST(SurfaceMeshBorder, InnerPointsNeverReachTheBorder) {
  const SurfaceMesh mesh{TriangleMesh(flat_square(3))};
  Vec3 p{0.4, 0.3, 0};
  for (int k = 0; k < 200; ++k) {
    const Vec2 u = mesh.possible(p, in_plane(mesh, mesh.locate(p).face, {-0.3, -2, 0}));
    p = mesh.step(p, u);
    ASSERT_EQ(mesh.freedom(p).dimensions, 2) << k;
    ASSERT_GT(p.y, 0);
  }
  EXPECT_LT(p.y, 1e-9);
  const Vec2 u = mesh.possible({0.4, 0.3, 0}, in_plane(mesh, mesh.locate({0.4, 0.3, 0}).face, {0, -2, 0}));
  EXPECT_NEAR(norm(u), 0.75 * 0.3, 1e-14);
}

/// Whether the pieces hold p, and how many of them do.
int pieces_with(const ChartPieces& pieces, Vec2 p) {
  int count = 0;
  for (std::size_t k = 0; k < pieces.ends.size(); ++k) {
    const auto corners = pieces[k];
    bool inside = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
      inside = inside && cross(b - a, p - a) > 0;
    }
    count += inside;
  }
  return count;
}

TEST(SurfaceMeshBorder, PiecesAreTheDomainWithinReach) {
  const SurfaceMesh mesh{TriangleMesh(flat_square(4))};
  Rng rng(12);
  ChartPieces pieces;
  EXPECT_FALSE(mesh.pieces({0.5, 0.5, 0}, 0.49, pieces));
  const double reach = 0.4;
  for (int k = 0; k < 200; ++k) {
    Vec3 base{rng.uniform(), rng.uniform(), 0};
    if (k % 4 == 1) base = mesh.boundary_point(static_cast<std::size_t>(k / 4) % 4, rng.uniform());
    if (k % 4 == 2) base.x = base.x < 0.5 ? 0.03 * base.x : 1 - 0.03 * (1 - base.x);
    if (k % 8 == 3) base = mesh.boundary_point(static_cast<std::size_t>(k / 8) % 4, 0);
    const double margin = std::min({base.x, base.y, 1 - base.x, 1 - base.y});
    ASSERT_EQ(mesh.pieces(base, reach, pieces), margin <= reach);
    if (margin > reach) continue;
    const Frame frame = mesh.frame(mesh.locate(base).face);
    for (int i = 0; i < 50; ++i) {
      const Vec2 u{reach * (2 * rng.uniform() - 1), reach * (2 * rng.uniform() - 1)};
      if (norm(u) > reach) continue;
      const Vec3 q = base + u.x * frame.x + u.y * frame.y;
      const bool inside = q.x > 0 && q.x < 1 && q.y > 0 && q.y < 1;
      EXPECT_EQ(pieces_with(pieces, u), inside ? 1 : 0)
          << base.x << " " << base.y << " to " << q.x << " " << q.y;
    }
  }
}

/// Area of what a convex cell and a convex piece have in common.
double common_area(std::span<const Vec2> piece, const Cell& cell) {
  std::vector<Vec2> left(piece.begin(), piece.end()), next;
  const auto corners = cell.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i].at, edge = corners[(i + 1) % corners.size()].at - a;
    next.clear();
    for (std::size_t k = 0; k < left.size(); ++k) {
      const Vec2 p = left[k], q = left[(k + 1) % left.size()];
      const double of_p = cross(edge, p - a), of_q = cross(edge, q - a);
      if (of_p >= 0) next.push_back(p);
      if ((of_p >= 0) != (of_q >= 0)) next.push_back(p + (of_p / (of_p - of_q)) * (q - p));
    }
    left.swap(next);
  }
  double area = 0;
  for (std::size_t k = 1; k + 1 < left.size(); ++k)
    area += cross(left[k] - left[0], left[k + 1] - left[0]) / 2;
  return area;
}

/// Sum of the areas of the Voronoi cells of n samples, as the kernel sees them.
double area_of_cells(const SurfaceMesh& mesh, std::size_t n) {
  Rng rng(14);
  const double spacing = hexagonal_spacing(mesh, n), reach = 3.5 * spacing;
  std::vector<Vec3> samples;
  for (int misses = 0; misses < 3000; ++misses) {
    const Vec3 p = mesh.random_point(rng);
    const auto near = [&](Vec3 q) { return norm(q - p) < 0.65 * spacing; };
    if (std::any_of(samples.begin(), samples.end(), near)) continue;
    samples.push_back(p);
    misses = 0;
  }
  double sum = 0;
  Cell cell;
  for (const Vec3 p : samples) {
    std::vector<Neighbor> neighbors;
    for (std::uint32_t k = 0; k < samples.size(); ++k)
      if (samples[k] != p && norm(samples[k] - p) <= reach) neighbors.push_back({samples[k] - p, k});
    mesh.localize(p, reach, neighbors);
    std::vector<HalfPlane> half_planes(neighbors.size());
    mesh.bisectors(p, {}, neighbors, half_planes);
    cell.reset(reach / 2);
    for (std::size_t k = 0; k < half_planes.size(); ++k)
      cell.clip(half_planes[k], static_cast<std::int32_t>(k));
    ChartPieces pieces;
    if (!mesh.pieces(p, std::sqrt(cell.outradius2()), pieces)) {
      EXPECT_TRUE(cell.closed());
      for (const Cell::Corner& corner : cell.corners()) pieces.corners.push_back(corner.at);
      pieces.close();
    }
    for (std::size_t k = 0; k < pieces.ends.size(); ++k) sum += common_area(pieces[k], cell);
  }
  return sum;
}

TEST(SurfaceMeshBorder, CellsAddUpToTheAreaToSecondOrder) {
  const SurfaceMesh open{TriangleMesh(height_field(15, 1, bumps))};
  EXPECT_NEAR(area_of_cells(open, 700), open.area(), 0.001 * open.area());
  const SurfaceMesh closed{TriangleMesh(refined_sphere(icosahedron(), 3))};
  const double few = area_of_cells(closed, 250) / closed.area() - 1;
  const double many = area_of_cells(closed, 1000) / closed.area() - 1;
  EXPECT_LT(few, 0.008);
  EXPECT_NEAR(many, few / 4, few / 16);
  // All in one plane: exact.
  const SurfaceMesh square{TriangleMesh(flat_square(7))};
  EXPECT_NEAR(area_of_cells(square, 300), 1, 1e-10);
}

TEST(SurfaceMeshBorder, ClosedMeshesGoOnEverywhere) {
  const SurfaceMesh mesh{TriangleMesh(icosahedron())};
  ChartPieces pieces;
  EXPECT_FALSE(mesh.pieces(mesh.mesh().vertices()[0], 10, pieces));
  EXPECT_TRUE(mesh.boundary().empty());
  EXPECT_EQ(mesh.possible(mesh.mesh().vertices()[0], {5, 5}), (Vec2{5, 5}));
}

}  // namespace
}  // namespace wellspaced
