// Delaunay and Voronoi meshes on every kind of domain, against brute force.

#include "core/mesh/meshing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/sphere.h"
#include "core/domain/surface_mesh.h"
#include "core/mesh/mesh_quality.h"
#include "core/optimize/opt_beta.h"
#include "tests/support/domains.h"
#include "tests/support/meshes.h"
#include "tests/support/polygons.h"
#include "tests/support/refusals.h"

namespace wellspaced {
namespace {

using testing::mps_on;
using testing::NamedDomain;

const Control plain;

struct NamedSet {
  std::string name;
  PointSet points;
};

PointSet white_noise_on(const std::shared_ptr<const Domain>& domain, std::size_t n, std::uint64_t seed) {
  PointSet points{domain, {}};
  Rng rng(seed);
  for (std::size_t i = 0; i < n; ++i) points.push_back(domain->random_point(rng));
  return points;
}

/// Of about n points, on the boundary or not.
PointSet darts_on(const std::shared_ptr<const Domain>& domain, std::size_t n, std::uint64_t seed) {
  Rng rng(seed);
  Control control;
  DiskRule rule;
  rule.scale = 0.8 * hexagonal_spacing(*domain, n);
  return throw_darts_over(domain, rule, rng, control);
}

/// Even ones, white noise without any on the boundary, and few.
std::vector<NamedSet> sets_on(const NamedDomain& d) {
  std::vector<NamedSet> sets = {{d.name + ", MPS", darts_on(d.domain, 150, 1)}};
  for (const std::size_t n : {3u, 4u, 5u, 8u, 20u, 120u}) {
    if (d.domain->dimension() == 3 && n < 20) continue;
    sets.push_back({d.name + ", white noise of " + std::to_string(n), white_noise_on(d.domain, n, n)});
  }
  return sets;
}

std::vector<NamedDomain> planar_domains() {
  std::vector<NamedDomain> all;
  for (const NamedDomain& d : testing::domains_of_every_kind())
    if (d.domain->is_flat()) all.push_back(d);
  all.push_back({"box", std::make_shared<BoxDomain>(1, 1)});
  for (const auto& [name, rings] : testing::many_polygons())
    all.push_back({name, std::make_shared<Polygon>(rings)});
  return all;
}

/// What areas may be off by: 1e-9, and what rounding of places at the boundary does.
double area_tolerance(const Domain& domain) {
  const Box box = domain.box();
  const double place = std::max({std::fabs(box.low.x), std::fabs(box.low.y), norm(box.size)});
  return 1e-9 * domain.area() + 1e-16 * place * domain.boundary_length();
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces(); ++f) sum += norm(area_vector(mesh, f));
  return sum;
}

/// Every edge is once in each direction, or once at a boundary.
double boundary_length_of(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh[f];
    for (std::size_t k = 0; k < face.size(); ++k) ++edges[{face[k], face[(k + 1) % face.size()]}];
  }
  double length = 0;
  for (const auto& [edge, times] : edges) {
    EXPECT_EQ(times, 1);
    if (edges.count({edge.second, edge.first}) == 0)
      length += norm(mesh.vertices[edge.first] - mesh.vertices[edge.second]);
  }
  return length;
}

TEST(PlanarMeshes, OfTrianglesCoverTheDomainAndHaveEmptyCircles) {
  for (const NamedDomain& d : planar_domains())
    for (const auto& [name, points] : sets_on(d)) {
      SCOPED_TRACE(name);
      const Mesh mesh = delaunay_mesh(points, plain);
      EXPECT_NEAR(area_of(mesh), d.domain->area(), area_tolerance(*d.domain));
      const MeshQuality quality = measure_quality(mesh);
      ASSERT_TRUE(quality.topology);
      EXPECT_EQ(quality.topology->euler_characteristic, d.domain->euler_characteristic());
      EXPECT_NEAR(quality.topology->boundary_length, d.domain->boundary_length(),
                  1e-9 * (1 + d.domain->boundary_length()));
      boundary_length_of(mesh);
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(mesh.vertices[i], points[i]);
        EXPECT_EQ(mesh.vertex_points[i], i);
      }
      if (dynamic_cast<const Polygon*>(d.domain.get()) != nullptr) continue;  // edges hide points there
      for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const Vec3 a = mesh.vertices[mesh[f][0]], b = mesh.vertices[mesh[f][1]],
                   c = mesh.vertices[mesh[f][2]];
        const Vec2 to_center = circumcenter({b.x - a.x, b.y - a.y}, {c.x - a.x, c.y - a.y});
        const double radius = norm(to_center);
        const Vec3 box = d.domain->box().size;
        const Vec3 center = a + Vec3{to_center.x, to_center.y, 0};
        for (std::size_t i = 0; i < points.size(); ++i)
          for (int x = -3; x <= 3; ++x)
            for (int y = -3; y <= 3; ++y) {
              if ((x != 0 && !d.domain->box().periodic[0]) || (y != 0 && !d.domain->box().periodic[1]))
                continue;
              const Vec3 image = points[i] + Vec3{x * box.x, y * box.y, 0};
              EXPECT_GE(norm(image - center), radius * (1 - 1e-9));
            }
      }
    }
}

TEST(PlanarMeshes, OfTrianglesInPolygonsAreDelaunayWhereTheySeeEachOther) {
  for (const NamedDomain& d : planar_domains()) {
    if (dynamic_cast<const Polygon*>(d.domain.get()) == nullptr) continue;
    for (const auto& [name, points] : sets_on(d)) {
      SCOPED_TRACE(name);
      const Mesh mesh = delaunay_mesh(points, plain);
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> opposite;
      for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
          opposite[{mesh[f][k], mesh[f][(k + 1) % 3]}] = mesh[f][(k + 2) % 3];
      for (const auto& [edge, third] : opposite) {
        const auto other = opposite.find({edge.second, edge.first});
        if (other == opposite.end()) continue;
        const Vec3 a = mesh.vertices[edge.first];
        const auto from_a = [&](std::uint32_t v) {
          return Vec2{mesh.vertices[v].x - a.x, mesh.vertices[v].y - a.y};
        };
        const Vec2 center = circumcenter(from_a(edge.second), from_a(third));
        EXPECT_GE(norm(from_a(other->second) - center), norm(center) * (1 - 1e-6));
      }
    }
  }
}

TEST(PlanarMeshes, OfCellsCoverTheDomainAndHoldWhatIsNearest) {
  for (const NamedDomain& d : planar_domains())
    for (const auto& [name, points] : sets_on(d)) {
      SCOPED_TRACE(name);
      const Mesh mesh = voronoi_mesh(points, plain);
      EXPECT_NEAR(area_of(mesh), d.domain->area(), area_tolerance(*d.domain));
      const double boundary = boundary_length_of(mesh);
      const Box box = d.domain->box();
      const bool is_bounded = !box.periodic[0] && !box.periodic[1];
      EXPECT_TRUE(!is_bounded || std::fabs(boundary - d.domain->boundary_length()) < 1e-9 * (1 + boundary));
      std::vector<bool> has_cell(points.size(), false);
      for (std::size_t f = 0; f < mesh.faces(); ++f) {
        has_cell[mesh.face_points[f]] = true;
        EXPECT_GT(area_vector(mesh, f).z, 0);
        for (const std::uint32_t v : mesh[f]) {
          const Vec3 place = d.domain->place_at(mesh.vertices[v], {});
          const double own = d.domain->distance(place, points[mesh.face_points[f]]);
          EXPECT_LE(own, testing::brute_distance(points, place) + 1e-9);
        }
      }
      EXPECT_EQ(std::count(has_cell.begin(), has_cell.end(), false), 0);
    }
}

TEST(PlanarMeshes, OfOnePlaceSeenFromManyPointsHaveOneVertexThere) {
  for (const auto periodic :
       {std::array<bool, 2>{true, true}, {true, false}, {false, true}, {false, false}}) {
    std::shared_ptr<const Domain> domain = std::make_shared<BoxDomain>(1, 1);
    const bool is_torus = periodic[0] && periodic[1], is_strip = periodic[0] != periodic[1];
    if (is_torus) domain = std::make_shared<Torus>();
    if (is_strip) domain = std::make_shared<BoxDomain>(1, 1, periodic);
    PointSet points{domain, {}};
    for (int i = 0; i < 64; ++i) points.push_back({(i % 8 + 0.5) / 8, (i / 8 + 0.5) / 8, 0});
    const Mesh cells = voronoi_mesh(points, plain);
    EXPECT_EQ(cells.faces(), 64u);
    for (std::size_t f = 0; f < 64; ++f) EXPECT_EQ(cells[f].size(), 4u);
    const Mesh triangles = delaunay_mesh(points, plain);
    EXPECT_NEAR(area_of(triangles), 1, 1e-12);
    EXPECT_TRUE(!is_torus || triangles.faces() == 128);
    EXPECT_EQ(measure_quality(triangles).topology->euler_characteristic, domain->euler_characteristic());
  }
}

/// Area of a spherical triangle on the unit sphere, by van Oosterom and Strackee.
double solid_angle(Vec3 a, Vec3 b, Vec3 c) {
  a = (1 / norm(a)) * a;
  b = (1 / norm(b)) * b;
  c = (1 / norm(c)) * c;
  return 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

double solid_angle(const Mesh& mesh, std::size_t f) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < mesh[f].size(); ++k)
    sum += solid_angle(mesh.vertices[mesh[f][0]], mesh.vertices[mesh[f][k]], mesh.vertices[mesh[f][k + 1]]);
  return sum;
}

// Products of such coordinates are below what doubles can hold: CGAL's filters fail on them.
TEST(PlanarMeshes, OfCellsTakeTheSmallestCoordinatesThereAre) {
  const auto box = std::make_shared<const BoxDomain>(1, 1);
  const PointSet points{box, {0, 0, 1, 5e-324, 0.7, 5e-324, 0.4, 0.9}};
  EXPECT_NEAR(measure_quality(voronoi_mesh(points, Control())).area, 1, 1e-9);
  const auto polygon = std::make_shared<const Polygon>(
      std::vector<std::vector<Vec2>>{{{0, 0}, {1, 1e-160}, {1, 1}, {1e-160, 1}}});
  EXPECT_NEAR(measure_quality(voronoi_mesh(testing::mps_on(polygon, 29, 1), Control())).area, 1, 1e-9);
}

TEST(SphereMeshes, AreTheConvexHullAndItsDual) {
  const auto sphere = std::make_shared<Sphere>(0.7);
  for (const std::size_t n : {12u, 20u, 60u, 400u}) {
    SCOPED_TRACE(n);
    const PointSet points = n == 400 ? mps_on(sphere, 400, 3) : white_noise_on(sphere, n, n);
    const Mesh triangles = delaunay_mesh(points, plain), cells = voronoi_mesh(points, plain);
    EXPECT_EQ(triangles.faces(), 2 * points.size() - 4);
    double covered = 0;
    for (std::size_t f = 0; f < triangles.faces(); ++f) {
      covered += solid_angle(triangles, f);
      const Vec3 normal = area_vector(triangles, f), base = triangles.vertices[triangles[f][0]];
      for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LE(dot(normal, points[i] - base), 1e-12);
    }
    EXPECT_NEAR(covered, 4 * pi, 1e-9);
    EXPECT_EQ(cells.faces(), points.size());
    EXPECT_EQ(boundary_length_of(cells), 0);
    double in_cells = 0;
    for (std::size_t f = 0; f < cells.faces(); ++f) {
      in_cells += solid_angle(cells, f);
      for (const std::uint32_t v : cells[f])
        EXPECT_NEAR(sphere->distance(cells.vertices[v], points[f]),
                    testing::brute_distance(points, cells.vertices[v]), 1e-9);
    }
    EXPECT_NEAR(in_cells, 4 * pi, 1e-9);
  }
}

std::vector<std::pair<std::string, std::shared_ptr<const SurfaceMesh>>> surfaces() {
  const auto made = [](Triangles triangles) {
    return std::make_shared<const SurfaceMesh>(TriangleMesh(std::move(triangles)));
  };
  const auto hills = [](double x, double y) { return 0.2 * std::sin(7 * x) * std::cos(6 * y); };
  std::vector<std::pair<std::string, std::shared_ptr<const SurfaceMesh>>> all = {
      {"icosahedron", made(testing::icosahedron())},
      {"sphere", made(testing::refined_sphere(testing::icosahedron(), 2))},
      {"hills with a border", made(testing::height_field(12, 1, hills))}};
  if (const std::string data = testing::shared_data(); !data.empty())
    for (const char* name : {"fertility_small.off", "eight.off", "mesh_with_border.off", "spot.obj"})
      all.emplace_back(name, made(testing::read_triangles(data + "/meshes/" + name)));
  return all;
}

TEST(SurfaceMeshes, HaveTheTopologyOfTheSurfaceAndAboutItsArea) {
  for (const auto& [name, surface] : surfaces()) {
    SCOPED_TRACE(name);
    const PointSet points = mps_on(surface, 4000, 5);
    const Mesh triangles = delaunay_mesh(points, plain);
    const MeshQuality quality = measure_quality(triangles);
    EXPECT_EQ(quality.topology->euler_characteristic, surface->euler_characteristic());
    EXPECT_EQ(quality.topology->boundary_edges == 0, surface->mesh().facts().closed);
    EXPECT_NEAR(quality.area, surface->area(), 0.03 * surface->area());
    EXPECT_GT(quality.angle_deg.least, 10);
    const Mesh cells = voronoi_mesh(points, plain);
    EXPECT_EQ(cells.faces(), points.size());
    EXPECT_NEAR(area_of(cells), surface->area(), 0.03 * surface->area());
    const double boundary = boundary_length_of(cells);
    EXPECT_NEAR(boundary, surface->boundary_length(), 0.03 * surface->boundary_length());
  }
}

/// A flat patch as a mesh: the right triangle, or the square without its upper right quarter.
std::vector<NamedDomain> flat_patches() {
  const Triangles triangle = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const Triangles angle = {{{0, 0, 0}, {1, 0, 0}, {1, .5, 0}, {.5, .5, 0}, {.5, 1, 0}, {0, 1, 0}},
                           {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}};
  return {{"triangle", std::make_shared<SurfaceMesh>(TriangleMesh(triangle))},
          {"angle", std::make_shared<SurfaceMesh>(TriangleMesh(angle))}};
}

TEST(SurfaceMeshes, OfCellsOnFlatPatchesCoverThemAndHoldWhatIsNearest) {
  for (const NamedDomain& d : flat_patches())
    for (const std::size_t n : {10u, 20u, 50u, 150u})
      for (std::uint64_t seed = 0; seed < 6; ++seed) {
        SCOPED_TRACE(d.name + ", " + std::to_string(n) + " points, seed " + std::to_string(seed));
        const PointSet points = darts_on(d.domain, n, seed);
        const Mesh mesh = voronoi_mesh(points, plain);
        double area = 0;
        std::vector<bool> has_cell(points.size(), false);
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
          area += area_vector(mesh, f).z;
          const std::uint32_t owner = mesh.face_points[f];
          has_cell[owner] = true;
          for (const std::uint32_t v : mesh[f]) {
            const Vec3 at = mesh.vertices[v];
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < points.size(); ++i) nearest = std::min(nearest, norm(points[i] - at));
            ASSERT_LE(norm(points[owner] - at), nearest + 1e-9);
          }
        }
        EXPECT_NEAR(area, d.domain->area(), 1e-9);
        EXPECT_EQ(std::count(has_cell.begin(), has_cell.end(), true), static_cast<long>(points.size()));
      }
}

TEST(SurfaceMeshes, HaveACellOfEveryPointOrAreRefused) {
  const NamedDomain d = {"tetrahedron", std::make_shared<SurfaceMesh>(TriangleMesh(testing::tetrahedron()))};
  std::size_t made = 0;
  for (const std::size_t n : {3u, 5u, 8u, 12u, 20u, 60u})
    for (std::uint64_t seed = 0; seed < 5; ++seed)
      for (const PointSet& points : {white_noise_on(d.domain, n, seed), darts_on(d.domain, n, seed)}) try {
          const Mesh mesh = voronoi_mesh(points, plain);
          ++made;
          EXPECT_EQ(mesh.faces(), points.size());
          for (std::size_t f = 0; f < mesh.faces(); ++f) EXPECT_GT(norm(area_vector(mesh, f)), 0);
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), ErrorCode::infeasible) << error.what();
          EXPECT_LT(points.size(), 20u) << error.what();
        }
  EXPECT_GT(made, 20u);
}

TEST(SphereMeshes, OfPointsInOneHalfAreRefused) {
  PointSet points{std::make_shared<Sphere>(2), {}};
  for (const Vec3 p : {Vec3{2, 0, 0}, Vec3{0, 2, 0}, Vec3{0, 0, 2}}) points.push_back(p);
  for (const auto make : {delaunay_mesh, voronoi_mesh})
    testing::expect_refusal([&] { make(points, plain); },
                            {"mesh", "3 points", ErrorCode::infeasible, "", "one half of the sphere"});
}

TEST(SurfaceMeshes, NameTheCornerOfTheBorderThatIsNoPoint) {
  PointSet points{flat_patches().front().domain, {}};
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.3, 0.3, 0}, Vec3{0.1, 0.6, 0}})
    points.push_back(p);
  testing::expect_refusal([&] { voronoi_mesh(points, plain); },
                          {"mesh", "4 points", ErrorCode::infeasible, "",
                           "the corner (0, 1, 0) of the domain's border is no point"});
}

TEST(SurfaceMeshes, WithTooFewPointsAreRefusedWithARadiusThatWillDo) {
  const std::string data = testing::shared_data();
  if (data.empty()) GTEST_SKIP() << "WELLSPACED_DATA_DIR is not set";
  const auto surface = std::make_shared<const SurfaceMesh>(
      TriangleMesh(testing::read_triangles(data + "/meshes/fertility_small.off")));
  try {
    delaunay_mesh(mps_on(surface, 60, 1), plain);
    ADD_FAILURE() << "60 points can't follow four handles";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::infeasible);
    EXPECT_NE(std::string(error.what()).find("would do"), std::string::npos) << error.what();
  }
}

TEST(Meshes, DontDependOnThreads) {
  std::vector<NamedDomain> all = testing::domains_of_every_kind();
  for (const auto& [name, surface] : surfaces()) all.push_back({name, surface});
  for (const NamedDomain& d : all) {
    SCOPED_TRACE(d.name);
    const PointSet points = mps_on(d.domain, 3000, 2);
    for (const auto make : {delaunay_mesh, voronoi_mesh}) {
      const Mesh one = make(points, Control(1)), three = make(points, Control(3));
      EXPECT_EQ(one.vertices, three.vertices);
      EXPECT_EQ(one.corners, three.corners);
      EXPECT_EQ(one.ends, three.ends);
    }
  }
}

}  // namespace
}  // namespace wellspaced
