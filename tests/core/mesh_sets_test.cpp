// Point sets on surface meshes: what is measured of them, and what generators promise, against places that
// are looked at one by one.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/analyze/local_measures.h"
#include "core/analyze/spacing.h"
#include "core/domain/sizing.h"
#include "core/domain/surface_mesh.h"
#include "core/generate/domain_darts.h"
#include "core/generate/domain_refinement.h"
#include "core/generate/enrich.h"
#include "core/generate/jittered.h"
#include "core/mesh/meshing.h"
#include "core/optimize/opt_beta.h"
#include "core/voronoi/corner_settler.h"
#include "core/voronoi/moving_set.h"
#include "tests/support/domains.h"
#include "tests/support/geodesic_oracle.h"
#include "tests/support/meshes.h"

namespace wellspaced {
namespace {

using testing::mps_on;

const Control plain;

std::vector<std::pair<std::string, std::shared_ptr<const SurfaceMesh>>> meshes() {
  const auto made = [](Triangles triangles) {
    return std::make_shared<const SurfaceMesh>(TriangleMesh(std::move(triangles)));
  };
  const auto hills = [](double x, double y) { return 0.2 * std::sin(7 * x) * std::cos(6 * y); };
  std::vector<std::pair<std::string, std::shared_ptr<const SurfaceMesh>>> all = {
      {"tetrahedron", made(testing::tetrahedron())},
      {"icosahedron", made(testing::icosahedron())},
      {"sphere", made(testing::refined_sphere(testing::icosahedron(), 2))},
      {"hills with a border", made(testing::height_field(12, 1, hills))}};
  if (const std::string data = testing::shared_data(); !data.empty())
    all.emplace_back("fertility", made(testing::read_triangles(data + "/meshes/fertility_small.off")));
  return all;
}

/// From a place to its nearest point: the shortest way over the mesh to each of those near it in space.
double depth(const SurfaceMesh& mesh, const PointSet& points, Vec3 place, double reach) {
  std::vector<std::pair<double, std::size_t>> by_chord;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double chord = norm(points[i] - place); chord < reach) by_chord.emplace_back(chord, i);
  std::sort(by_chord.begin(), by_chord.end());
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [chord, i] : by_chord) {
    if (chord >= least) break;
    if (const auto way = mesh.logarithm(place, points[i], std::min(reach, 1.01 * least)))
      least = std::min(least, norm(*way));
  }
  return least;
}

double deepest_of_many(const SurfaceMesh& mesh, const PointSet& points, double reach, int places) {
  Rng rng(17);
  double most = 0;
  for (int k = 0; k < places; ++k) most = std::max(most, depth(mesh, points, mesh.random_point(rng), reach));
  return most;
}

TEST(MeshSets, AreMaximalAndTheirRadiiAreThoseOfTheSurface) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const PointSet points = mps_on(mesh, 400, 3);
    const Spacing spacing = measure_spacing(points, plain);
    EXPECT_LE(spacing.beta, 1 + 1e-9);
    const double deepest = deepest_of_many(*mesh, points, 2 * spacing.r_c, 1000);
    EXPECT_LE(deepest, spacing.r_c * (1 + 1e-9)) << "there is a hole that nobody measured";
    EXPECT_GE(deepest, 0.9 * spacing.r_c) << "no place is that far from all points";
  }
}

TEST(MeshSets, AreMadeByEveryGenerator) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    Control control;
    const double radius = std::sqrt(0.66 * mesh->area() / 300);
    const PointSet refined = refine_domain(mesh, radius, control);
    const Spacing spacing = measure_spacing(refined, plain);
    EXPECT_GE(spacing.r_f_free, radius * (1 - 1e-9));
    EXPECT_LE(spacing.r_c, radius * (1 + 1e-9));
    EXPECT_LE(deepest_of_many(*mesh, refined, 2 * radius, 300), radius * (1 + 1e-9));
    const PointSet counted = refine_domain_to_count(mesh, 300, control);
    EXPECT_EQ(counted.size(), 300u);
    EXPECT_LE(measure_spacing(counted, plain).beta, 1 + 1e-9);

    Rng rng(3);
    const PointSet strewn = jittered(mesh, 200, rng, control);
    ASSERT_EQ(strewn.size(), 200u);
    for (std::size_t i = 0; i < 200; ++i) EXPECT_FALSE(mesh->why_outside(strewn[i]));
    const double coverage = enrichment_coverage(strewn, plain);
    const PointSet filled = enrich(strewn, coverage, control);
    EXPECT_LE(measure_spacing(filled, plain).r_c, coverage * (1 + 1e-9));
  }
}

/// The area of all cells together, as they are cut.
double area_of_cells(const PointSet& points) {
  const MovingSet set(points, plain);
  std::vector<double> areas(points.size());
  set.for_each_cell(plain, [&](std::size_t i, CellFinder& cells) { areas[i] = cells.moments().area; });
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

// Behind a sharp vertex charts show everything twice: a point beside it, or in it, may not have it twice.
TEST(MeshSets, HaveCellsThatCountWhatIsBehindSharpVerticesOnce) {
  for (Triangles shape : {testing::tetrahedron(), testing::icosahedron()}) {
    const std::vector<Vec3> vertices = shape.vertices;
    const auto mesh = std::make_shared<const SurfaceMesh>(TriangleMesh(std::move(shape)));
    for (const std::uint64_t seed : {1, 2, 3}) {
      PointSet points = mps_on(mesh, 300, seed);
      EXPECT_NEAR(area_of_cells(points), mesh->area(), 1e-9 * mesh->area());
      for (const Vec3 vertex : vertices) {  // move the nearest point there
        std::size_t nearest = 0;
        for (std::size_t i = 1; i < points.size(); ++i)
          if (norm(points[i] - vertex) < norm(points[nearest] - vertex)) nearest = i;
        points.set(nearest, vertex);
      }
      EXPECT_NEAR(area_of_cells(points), mesh->area(), 1e-9 * mesh->area());
    }
  }
}

// Behind a sharp vertex the cell of one point may meet itself: there may be a hole. Straight through space
// nothing is farther than over the surface.
TEST(MeshSets, LeaveNoHolesBehindSharpVertices) {
  const auto mesh = std::make_shared<const SurfaceMesh>(TriangleMesh(
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}));
  Rng places(7);
  std::vector<Vec3> looked_at = mesh->mesh().vertices();
  for (int k = 0; k < 20'000; ++k) {
    const Vec3 p = mesh->random_point(places), vertex = mesh->mesh().vertices()[k % 4];
    looked_at.push_back(p);
    looked_at.push_back(mesh->nearest(vertex + 0.1 * (p - vertex)));
  }
  const auto deepest = [&](const PointSet& points) {
    double most = 0;
    for (const Vec3 place : looked_at) {
      double depth = HUGE_VAL;
      for (std::size_t i = 0; i < points.size(); ++i) depth = std::min(depth, norm(points[i] - place));
      most = std::max(most, depth);
    }
    return most;
  };
  Control control;
  for (const double radius : {0.05, 0.13})
    EXPECT_LE(deepest(refine_domain(mesh, radius, control)), radius * (1 + 1e-9));
  for (const std::uint64_t count : {16, 40, 120})
    for (const std::uint64_t seed : {0, 1, 2, 3}) {
      Rng rng(seed);
      const PointSet points = throw_darts_over_to_count(mesh, count, {}, rng, control);
      EXPECT_LE(deepest(points), measure_spacing(points, plain).r_f * (1 + 1e-9)) << count << " " << seed;
      EXPECT_LE(deepest(points), measure_spacing(points, plain).r_c * (1 + 1e-9)) << count << " " << seed;
    }
}

// One search from each point tells of most faces that they are covered.
TEST(MeshSets, OfFewPointsOnManyFacesAreMaximal) {
  const auto mesh =
      std::make_shared<const SurfaceMesh>(TriangleMesh(testing::refined_sphere(testing::icosahedron(), 3)));
  for (const std::uint64_t count : {1, 3, 8, 20}) {
    Rng rng(3);
    Control control;
    const PointSet points = throw_darts_over_to_count(mesh, count, {}, rng, control);
    ASSERT_EQ(points.size(), count);
    if (count < 3) continue;
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, mesh->distance(points[i], points[j]));
    EXPECT_LE(deepest_of_many(*mesh, points, 7, 200), nearest * (1 + 1e-9)) << count;
  }
}

TEST(MeshSets, OfFewPointsHaveTheirCoverageRadius) {
  const auto mesh = std::make_shared<const SurfaceMesh>(TriangleMesh(
      Triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}));
  for (const std::size_t n : {3u, 4u, 5u, 8u, 12u, 30u})
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      Rng rng(seed);
      PointSet points{mesh, {}};
      for (std::size_t i = 0; i < n; ++i) points.push_back(mesh->random_point(rng));
      constexpr double infinity = std::numeric_limits<double>::infinity();
      std::vector<Vec3> places(2000);
      for (Vec3& at : places) at = mesh->random_point(rng);
      std::vector<double> nearest(places.size(), infinity), ways;
      for (std::size_t i = 0; i < n; ++i) {
        std::vector<Neighbor> all;
        for (const Vec3 at : places) all.push_back({at - points[i], 0});
        mesh->distances(points[i], infinity, all, ways);
        for (std::size_t k = 0; k < all.size(); ++k) nearest[k] = std::min(nearest[k], ways[k]);
      }
      const double farthest = *std::max_element(nearest.begin(), nearest.end());
      const double r_c = measure_spacing(points, plain).r_c;
      EXPECT_GE(r_c, farthest * (1 - 1e-9)) << n << " points, seed " << seed;
      EXPECT_LE(r_c, farthest * 1.1) << n << " points, seed " << seed;
    }
}

/// Ways along a needle are as long as it is, however thin; rounding of areas would hide where points are.
TEST(MeshSets, OnNeedlesAreWhatTheyAreOnALine) {
  for (const double height : {1e-3, 1e-6, 1.1e-9}) {
    SCOPED_TRACE(height);
    const Vec3 along{0.6, 0.48, 0.64}, across{-0.8, 0.36, 0.48};
    const auto needle = std::make_shared<const SurfaceMesh>(
        TriangleMesh({{{}, along, 0.5 * along + height * across}, {{0, 1, 2}}}));
    Control control;
    Rng rng(1);
    const PointSet points = throw_darts_over_to_count(needle, 30, {}, rng, control);
    EXPECT_EQ(points.size(), 30u);
    std::vector<double> at;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_FALSE(needle->why_outside(points[i])) << i;
      at.push_back(dot(points[i], along));
    }
    std::sort(at.begin(), at.end());
    double least = 1, most = 0;
    for (std::size_t k = 1; k < at.size(); ++k) {
      least = std::min(least, at[k] - at[k - 1]);
      most = std::max(most, at[k] - at[k - 1]);
    }
    const Spacing spacing = measure_spacing(points, control);
    EXPECT_NEAR(spacing.r_f, least, 3 * height);
    EXPECT_NEAR(spacing.r_c, most / 2, 3 * height);
    EXPECT_LE(spacing.beta, 1);
  }
}

TEST(MeshSets, WithoutPointsOnSomePartAreRefused) {
  const auto mesh = std::make_shared<const SurfaceMesh>(TriangleMesh(
      Triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}}, {{0, 1, 2}, {3, 4, 5}}}));
  const PointSet points{mesh, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 0}};
  try {
    measure_spacing(points, plain);
    ADD_FAILURE() << "r_c is infinite";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::degenerate_input);
    EXPECT_NE(std::string(error.what()).find("with (0, 0, 5) has no point"), std::string::npos)
        << error.what();
  }
}

TEST(MeshSets, CornersThatAreSettledAreAsFarAsTheySay) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const PointSet points = mps_on(mesh, 400, 4);
    const MovingSet set(points, plain);
    const NeighborGrid grid(points, set.spacing());
    CornerSettler settler(points, grid);
    CellFinder cells = set.finder(plain);
    for (std::size_t i = 0; i < 12; ++i) {
      set.find_cell(i, cells);
      for (const Cell& part : cells.parts())
        for (std::size_t k = 0; k < part.corners().size(); ++k) {
          const Vec2 at = part.corners()[k].at;
          const CornerSettler::Corner corner =
              settler.settle(mesh->place_at(points[i], at), norm(at), part.is_outer(k));
          EXPECT_NEAR(corner.distance, depth(*mesh, points, corner.at, 4 * set.spacing()),
                      1e-9 * set.spacing());
        }
    }
  }
}

TEST(MeshSets, ReachTheirBetaWithAndWithoutSizing) {
  for (const auto& [name, mesh] : meshes())
    for (const bool sized : {false, true}) {
      SCOPED_TRACE(name + (sized ? " sized" : ""));
      const auto sizing = std::make_shared<LinearSizing>(*mesh, LinearSizingOptions{1, 1, 1.5});
      Rng rng(5);
      Control control;
      DiskRule rule;
      if (sized) rule.sizing = sizing.get();
      PointSet points = throw_darts_over_to_count(mesh, 500, rule, rng, control);
      if (sized) points.sizing = sizing;
      OptBetaOptions options;
      options.beta = 0.8;
      const OptimizeResult result = opt_beta(points, options, control);
      EXPECT_EQ(result.converged, true);
      const Spacing before = measure_spacing(points, plain), after = measure_spacing(result.points, plain);
      EXPECT_LE(after.beta, 0.8);
      EXPECT_LT(after.beta_i_mean, before.beta_i_mean);
      if (sized) continue;
      EXPECT_LE(deepest_of_many(*mesh, result.points, 2 * after.r_c, 500), after.r_c * (1 + 1e-9));
    }
}

/// From a place to the nearest of the points that may be it, by CGAL's exact geodesics.
double exact_depth(testing::GeodesicOracle& oracle, const SurfaceMesh& mesh, const PointSet& points,
                   Vec3 place, double reach, std::size_t but) {
  std::vector<MeshPlace> near;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i != but && norm(points[i] - place) <= reach) near.push_back(mesh.locate(points[i]));
  const std::vector<double> distances = oracle.distances(mesh.locate(place), near);
  return *std::min_element(distances.begin(), distances.end());
}

/// 100 points with their nearest neighbors, which r_f is the least of, and 100 corners of cells, which r_c is
/// the largest of, on a surface whose features are 20 radii and more.
TEST(MeshSets, HaveRadiiWithinAPercentOfExactGeodesics) {
  constexpr std::size_t none = ~std::size_t{0};
  std::vector<std::pair<std::string, std::shared_ptr<const SurfaceMesh>>> surfaces = {
      {"sphere", std::make_shared<const SurfaceMesh>(
                     TriangleMesh(testing::refined_sphere(testing::icosahedron(), 3)))}};
  if (const std::string data = testing::shared_data(); !data.empty())
    surfaces.emplace_back("eight", std::make_shared<const SurfaceMesh>(
                                       TriangleMesh(testing::read_triangles(data + "/meshes/eight.off"))));
  for (const auto& [name, mesh] : surfaces) {
    SCOPED_TRACE(name);
    const double radius = mesh->smallest_feature().length / 20;
    DiskRule rule;
    rule.scale = radius;
    Rng rng(9);
    Control control;
    const PointSet points = throw_darts_over(mesh, rule, rng, control);
    const LocalSpacing spacing = measure_local_spacing(points, plain);
    const std::vector<double> nearest = measure_locally(points, LocalMeasure::nearest, plain);
    const double unit = MovingSet(points, plain).spacing(), reach = 2 * spacing.global.r_c;
    const Mesh cells = voronoi_mesh(points, plain);
    testing::GeodesicOracle oracle(mesh->mesh());
    double worst_r_f = 0, worst_r_c = 0;
    for (int pair = 0; pair < 100; ++pair) {
      const std::size_t i = rng.below(points.size()), v = rng.below(cells.vertices.size());
      const double exact_r_f = exact_depth(oracle, *mesh, points, points[i], reach, i);
      worst_r_f = std::max(worst_r_f, std::fabs(nearest[i] * unit / exact_r_f - 1));
      const Vec3 corner = cells.vertices[v];
      const double exact_r_c = exact_depth(oracle, *mesh, points, corner, reach, none);
      const double ours = depth(*mesh, points, corner, reach);
      worst_r_c = std::max(worst_r_c, std::fabs(ours / exact_r_c - 1));
      EXPECT_LE(exact_r_c, spacing.global.r_c * 1.01);
    }
    EXPECT_LE(worst_r_f, 0.01);
    EXPECT_LE(worst_r_c, 0.01);
    std::cout << name << ", " << points.size() << " points " << radius
              << " apart: largest error of 100 nearest distances " << worst_r_f
              << ", of 100 corners of cells " << worst_r_c << '\n';
  }
}

}  // namespace
}  // namespace wellspaced
