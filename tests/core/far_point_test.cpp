#include "core/optimize/far_point.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "core/voronoi/star_mesh.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;
using testing::expect_laws;
using testing::mps;
using testing::random_points;

TEST(FarPoint, RaisesTheConflictRadiusByBruteForce) {
  for (const double height : {1.0, 3.0}) {
    const PointSet input = mps(300, 1, height);
    Control control;
    const OptimizeResult result = far_point(input, {100, 0}, control);
    expect_laws(input, result);
    EXPECT_EQ(result.converged, std::nullopt);
    const double r_f = brute_r_f(result.points), d = hexagonal_spacing(height, input.size());
    EXPECT_GT(r_f, .88 * d);
    EXPECT_LT(brute_r_c(result.points, 1e-6) / r_f, .97);
  }
}

TEST(FarPoint, ConflictRadiusNeverFalls) {
  for (const PointSet& input : {mps(400, 2), random_points(1, 1, 400, 3), random_points(1, 3, 200, 4)}) {
    Control control;
    const OptimizeResult result = far_point(input, {30, 0}, control);
    for (std::size_t k = 1; k < result.history.size(); ++k)
      EXPECT_GE(result.history[k].r_f, result.history[k - 1].r_f * (1 - 1e-6)) << k;
    EXPECT_GT(result.history.back().r_f, 1.05 * result.history.front().r_f);
  }
}

/// One sweep by definition: a triangulation of the others for each point.
PointSet swept_by_definition(PointSet points) {
  const StarMesh order(points, Control());
  for (std::size_t visit = 0; visit < points.size(); ++visit) {
    const std::size_t i = order.original(visit);
    PointSet others{points.domain, {}};
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != i) others.push_back(points[j]);
    const auto stars = testing::collect_stars(others, visit_stars_by_cgal);
    Vec3 farthest = points[i];
    double distance = testing::brute_distance(others, points[i]) * (1 + 1e-6);
    for (std::size_t j = 0; j < stars.size(); ++j)
      for (std::size_t k = 0; k < stars[j].size(); ++k) {
        const Vec2 center = circumcenter(stars[j][k].offset, stars[j][(k + 1) % stars[j].size()].offset);
        if (!(norm(center) > distance * (1 + 1e-9))) continue;
        distance = norm(center);
        farthest = points.domain->step(others[j], center);
      }
    points.set(i, farthest);
  }
  return points;
}

TEST(FarPoint, SweepsAsItsDefinitionSays) {
  for (const PointSet& input : {mps(150, 1), mps(120, 2, 2), random_points(1, 1, 200, 3)}) {
    Control control;
    const OptimizeResult result = far_point(input, {1}, control);
    const PointSet expected = swept_by_definition(input);
    ASSERT_EQ(result.history.size(), 2u);
    EXPECT_NEAR(result.history[1].r_f, brute_r_f(expected), 1e-6);
    EXPECT_NEAR(result.history[1].r_c, brute_r_c(expected, 1e-7), 1e-6);
  }
}

TEST(FarPoint, ReturnsATriangularLatticeBitForBit) {
  Control control;
  const PointSet lattice = triangular_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 800, control);
  const OptimizeResult result = far_point(lattice, {10}, control);
  EXPECT_EQ(result.points.coordinates, lattice.coordinates);
  EXPECT_EQ(result.sweeps, 1);
}

TEST(FarPoint, WorksFromAnyStart) {
  Control control;
  for (const PointSet& input :
       {square_lattice(std::make_shared<Torus>(), 400, control), random_points(1, 1, 500, 1),
        random_points(3, 1, 300, 2), mps(20, 5), mps(50, 6), mps(400, 7, 3)})
    expect_laws(input, far_point(input, {20}, control));
}

TEST(FarPoint, WorksOrRefusesWhereEdgesReachAroundTheTorus) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const PointSet input = random_points(1, seed % 2 == 0 ? 1 : .5, 25 + seed % 20, seed);
    Control control;
    try {
      expect_laws(input, far_point(input, {10}, control));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::degenerate_input) << error.what();
      EXPECT_NE(std::string(error.what()).find("opt-beta"), std::string::npos) << error.what();
    }
  }
}

TEST(FarPoint, EndsWhenPointsGetNoFartherFromEachOther) {
  const PointSet input = mps(400, 8);
  Control control;
  const int coarse = far_point(input, {1000, 1e-3}, control).sweeps;
  const int fine = far_point(input, {1000, 1e-5}, control).sweeps;
  EXPECT_LT(coarse, fine);
  EXPECT_LT(fine, 1000);
}

TEST(FarPoint, RefusesWhatCannotBe) {
  const PointSet input = mps(100, 1);
  Control control;
  const FarPointOptions idle{0}, negative{10, -1};
  expect_error([&] { far_point(input, idle, control); }, ErrorCode::invalid_parameters, "/max_sweeps");
  expect_error([&] { far_point(input, negative, control); }, ErrorCode::invalid_parameters, "/tolerance");
  expect_error([&] { far_point(random_points(1, 1, 10, 1), {}, control); }, ErrorCode::degenerate_input, "",
               "20 points");
}

TEST(FarPoint, GivesTheSameBytesOnAnyNumberOfThreads) {
  testing::expect_same_on_threads(
      [](const PointSet& points, Control& control) { return far_point(points, {10}, control); });
}

TEST(FarPoint, ReportsMonotoneProgressAndCanBeCancelled) {
  testing::expect_watchable([](const PointSet& points, Control& control) {
    return far_point(points, {8, 0}, control);
  });
}

}  // namespace
}  // namespace wellspaced
