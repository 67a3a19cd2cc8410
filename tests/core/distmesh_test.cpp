#include "core/optimize/distmesh.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "tests/support/mesh.h"
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

TEST(DistMesh, MovesEachPointByTheForcesOfItsEdges) {
  const PointSet input = mps(200, 1);
  const StarMesh mesh(input, Control());
  const auto stars = testing::collect_stars(testing::places(mesh, input), visit_stars_by_cgal);
  double square_sum = 0, count = 0;
  for (const auto& star : stars)
    for (const Spoke& spoke : star) {
      square_sum += norm2(spoke.offset);
      ++count;
    }
  const double rest = 1.2 * std::sqrt(square_sum / count);
  const std::vector<Vec2> moves = distmesh_moves(mesh, Control());
  Vec2 sum;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    Vec2 expected;
    for (const Spoke& spoke : stars[mesh.original(i)]) {
      const double length = norm(spoke.offset);
      expected = expected - (0.2 * std::max(0.0, rest - length) / length) * spoke.offset;
    }
    EXPECT_NEAR(norm(mesh.spacing() * moves[i] - expected), 0, 1e-9);
    sum = sum + moves[i];
  }
  EXPECT_NEAR(norm(sum), 0, 1e-9) << "forces between points cancel";
}

TEST(DistMesh, KeepsTheStateOfLeastBetaByBruteForce) {
  const PointSet input = mps(300, 2);
  Control control;
  const OptimizeResult result = distmesh(input, {100, 0}, control);
  expect_laws(input, result);
  EXPECT_EQ(result.converged, std::nullopt);
  EXPECT_EQ(result.sweeps, 100);
  EXPECT_EQ(result.history.size(), 101u);
  EXPECT_LT(brute_r_c(result.points, 1e-6) / brute_r_f(result.points), .9);
}

TEST(DistMesh, WorksFromAnyStart) {
  Control control;
  for (const PointSet& input :
       {square_lattice(std::make_shared<Torus>(), 400, control), random_points(1, 1, 500, 1),
        random_points(3, 1, 300, 2), mps(20, 5), mps(50, 6), mps(400, 7, 3)})
    expect_laws(input, distmesh(input, {30}, control));
}

TEST(DistMesh, ReturnsABalancedLatticeBitForBit) {
  Control control;
  const PointSet lattice = triangular_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 800, control);
  const OptimizeResult result = distmesh(lattice, {}, control);
  EXPECT_EQ(result.points.coordinates, lattice.coordinates);
  EXPECT_EQ(result.sweeps, 1);
}

TEST(DistMesh, EndsWhenNothingMovesFarther) {
  const PointSet input = mps(400, 8);
  Control control;
  const int coarse = distmesh(input, {1000, .05}, control).sweeps;
  const int fine = distmesh(input, {1000, .02}, control).sweeps;
  EXPECT_LT(coarse, fine);
  EXPECT_LT(fine, 1000);
}

TEST(DistMesh, RefusesWhatCannotBe) {
  const PointSet input = mps(100, 1);
  Control control;
  const DistMeshOptions idle{0}, negative{10, -1}, nan{10, std::nan("")};
  expect_error([&] { distmesh(input, idle, control); }, ErrorCode::invalid_parameters, "/max_sweeps");
  expect_error([&] { distmesh(input, negative, control); }, ErrorCode::invalid_parameters, "/tolerance");
  expect_error([&] { distmesh(input, nan, control); }, ErrorCode::invalid_parameters, "/tolerance");
  expect_error([&] { distmesh(random_points(1, 1, 10, 1), {}, control); }, ErrorCode::degenerate_input, "",
               "20 points");
}

TEST(DistMesh, GivesTheSameBytesOnAnyNumberOfThreads) {
  testing::expect_same_on_threads(
      [](const PointSet& points, Control& control) { return distmesh(points, {40}, control); });
}

TEST(DistMesh, ReportsMonotoneProgressAndCanBeCancelled) {
  testing::expect_watchable([](const PointSet& points, Control& control) {
    return distmesh(points, {20, 0}, control);
  });
}

}  // namespace
}  // namespace wellspaced
