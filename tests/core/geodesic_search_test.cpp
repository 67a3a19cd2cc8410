#include "core/domain/geodesic_search.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/domain/surface_mesh.h"
#include "core/math.h"
#include "tests/support/geodesic_oracle.h"
#include "tests/support/meshes.h"

namespace wellspaced {
namespace {

using namespace wellspaced::testing;

double bumps(double x, double y) {
  return 0.12 * portable_cos_sin(1.3 * x + 0.2).sin * portable_cos_sin(1.7 * y).cos;
}
/// Squares with a narrow pit: to the other side one walks around it or through it.
double pit(double x, double y) { return std::fabs(x - 0.5) < 0.15 && std::fabs(y - 0.5) < 0.15 ? -0.6 : 0; }

/// Distances against CGAL's, from `bases` places to 40 random ones and some vertices each.
void expect_exact_distances(const Triangles& triangles, int bases, double tolerance = 1e-12) {
  const SurfaceMesh mesh{TriangleMesh(triangles, TriangleMesh::Crossings::allow)};
  GeodesicOracle oracle(mesh.mesh());
  Rng rng(3);
  const auto faces = mesh.mesh().faces().size();
  for (int b = 0; b < bases; ++b) {
    const auto vertex = [&] { return mesh.mesh().corner(static_cast<std::uint32_t>(rng.below(faces)), 1); };
    const Vec3 base = b % 3 == 2 ? vertex() : mesh.random_point(rng);
    std::vector<Vec3> points;
    std::vector<MeshPlace> places;
    for (int k = 0; k < 48; ++k) {
      points.push_back(k % 6 == 0 ? vertex() : mesh.random_point(rng));
      places.push_back(mesh.locate(points.back()));
    }
    const std::vector<double> exact = oracle.distances(mesh.locate(base), places);
    for (std::size_t k = 0; k < points.size(); ++k) {
      SCOPED_TRACE("base " + std::to_string(b) + ", point " + std::to_string(k));
      EXPECT_NEAR(mesh.distance(base, points[k]), exact[k], tolerance * (exact[k] + 1e-3));
      // Within reach and out of it.
      const auto near = mesh.logarithm(base, points[k], exact[k] * (1 + 1e-9));
      ASSERT_TRUE(near.has_value());
      EXPECT_NEAR(norm(*near), exact[k], tolerance * (exact[k] + 1e-3));
      EXPECT_EQ(mesh.logarithm(base, points[k], exact[k] * (1 - 1e-9)).has_value(), exact[k] == 0);
    }
  }
}

TEST(GeodesicSearch, DistancesAreThoseOfCgal) {
  expect_exact_distances(tetrahedron(), 9);
  expect_exact_distances(icosahedron(), 9);
  expect_exact_distances(height_field(9, 1, bumps), 6);
  expect_exact_distances(height_field(12, 1, pit), 6);
  expect_exact_distances(open_cylinder(9), 6);
  expect_exact_distances(refined_sphere(icosahedron(), 2), 3);
}

TEST(GeodesicSearch, DistancesOnRealMeshesAreThoseOfCgal) {
  const std::string folder = shared_data();
  if (folder.empty()) GTEST_SKIP() << "WELLSPACED_DATA_DIR is not set";
  for (const char* name :
       {"icosahedron.off", "eight.off", "spot.obj", "fertility_small.off", "mesh_with_border.off"}) {
    SCOPED_TRACE(name);
    expect_exact_distances(read_triangles(folder + "/meshes/" + name), 3);
  }
}

TEST(GeodesicSearch, DistancesBetweenVerticesOfTheIcosahedronAreThoseExpected) {
  const std::string folder = shared_data();
  if (folder.empty()) GTEST_SKIP() << "WELLSPACED_DATA_DIR is not set";
  const SurfaceMesh mesh{TriangleMesh(read_triangles(folder + "/meshes/icosahedron.off"))};
  std::ifstream expected(folder + "/expected/geodesic_icosahedron.csv");
  int pairs = 0;
  for (std::string line; std::getline(expected, line); ++pairs) {
    std::istringstream cells(line.substr(line.find(',') + 1));
    std::size_t a = 0, b = 0;
    double distance = 0;
    char comma;
    cells >> a >> comma >> b >> comma >> distance;
    EXPECT_NEAR(mesh.distance(mesh.mesh().vertices()[a], mesh.mesh().vertices()[b]), distance, 1e-9) << line;
  }
  EXPECT_EQ(pairs, 18);
}

TEST(GeodesicSearch, TheOrderOfWindowsDoesNotMatter) {
  for (const Triangles& triangles : {height_field(25, 1, bumps), height_field(12, 1, pit), icosahedron()}) {
    const TriangleMesh mesh(triangles, TriangleMesh::Crossings::allow);
    const SurfaceMesh surface(mesh);
    const Unfolding unfolding(mesh);
    Rng rng(9);
    for (int k = 0; k < 5; ++k) {
      const MeshPlace base = surface.locate(k == 0 ? mesh.corner(3, 1) : surface.random_point(rng));
      std::vector<GeodesicSearch> searches;
      // All of them are aimed at where there are up to 64; nearest first if no window is enough.
      for (const std::size_t enough : {std::size_t{0}, std::size_t{100}, GeodesicSearch::enough_windows}) {
        Rng same(k);
        searches.emplace_back(unfolding, base, GeodesicSearch::unreached);
        for (int i = 0; i < (k % 2 == 0 ? 40 : 70); ++i)
          searches.back().add(surface.locate(surface.random_point(same)));
        searches.back().run(GeodesicSearch::Border::ignore, enough);
      }
      for (std::size_t i = 0; i < searches[0].targets().size(); ++i)
        for (const GeodesicSearch& search : searches) {
          EXPECT_NEAR(search.targets()[i].distance, searches[0].targets()[i].distance, 1e-12);
          EXPECT_NEAR(norm(search.targets()[i].vector), search.targets()[i].distance, 1e-12);
        }
    }
  }
}

}  // namespace
}  // namespace wellspaced
