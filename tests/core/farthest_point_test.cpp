#include "core/generate/farthest_point.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/lattice.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_distance;
using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;
using testing::random_points;

FarthestPointEnd at_count(std::size_t count) {
  FarthestPointEnd end;
  end.count = count;
  return end;
}

FarthestPointEnd at_coverage(double coverage) {
  FarthestPointEnd end;
  end.coverage = coverage;
  return end;
}

PointSet first(const PointSet& points, std::size_t n) {
  return {points.domain,
          {points.coordinates.begin(), points.coordinates.begin() + 2 * static_cast<std::ptrdiff_t>(n)}};
}

TEST(InsertFarthest, PutsEachPointIntoTheDeepestHole) {
  for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{4.0, 0.5}, std::pair{0.02, 5.0}})
    for (const std::size_t n : {1, 2, 5, 30, 31}) {
      SCOPED_TRACE(::testing::Message() << n << " on " << width << " x " << height);
      PointSet points = random_points(width, height, n, n);
      Control control;
      const PointSet input = points;
      FarthestPointEnd end = at_count(n + 20);
      end.shallowest = n == 31 ? hexagonal_spacing(width * height, n) : 0;  // too high a guess
      const double left = insert_farthest(points, end, control);
      ASSERT_EQ(points.size(), n + 20);
      EXPECT_EQ(first(points, n).coordinates, input.coordinates);
      for (std::size_t i = n; i < points.size(); ++i) {
        const PointSet before = first(points, i);
        const double depth = brute_distance(before, points[i]);
        EXPECT_NEAR(depth, brute_r_c(before, 1e-5 * depth), 2e-5 * depth) << i;
      }
      EXPECT_NEAR(left, brute_r_c(points, 1e-5 * left), 2e-5 * left);
    }
}

TEST(InsertFarthest, StopsAtTheCoverageAndNoEarlier) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PointSet points = random_points(1, 0.6, 60, seed);
    const double r_f = brute_r_f(points);
    Control control;
    const double coverage = 0.09, left = insert_farthest(points, at_coverage(coverage), control);
    EXPECT_LE(left, coverage);
    EXPECT_LE(brute_r_c(points, 1e-5), coverage + 1e-5);
    EXPECT_GE(brute_r_f(points), std::min(r_f, coverage));
    const std::size_t last = points.size() - 1;
    EXPECT_GT(brute_distance(first(points, last), points[last]), coverage);
  }
}

TEST(InsertFarthest, DependsOnItsInputOnly) {
  const PointSet input = random_points(1, 1, 3000, 1);
  for (const double shallowest : {0.0, 0.01, 0.02, 0.1}) {
    PointSet points = input, again = input;
    FarthestPointEnd end = at_count(4000);
    end.shallowest = shallowest;
    Control one(1), two(2);
    insert_farthest(points, end, one);
    insert_farthest(again, end, two);
    EXPECT_EQ(points.coordinates, again.coordinates) << shallowest;
  }
}

TEST(InsertFarthest, WorksWhereAllPointsAreInOneCorner) {
  for (const double corner : {0.1, 1e-3, 1e-9}) {
    PointSet points = random_points(1, 1, 600, 2);
    for (double& c : points.coordinates) c *= corner;
    Control control(2);
    const double coverage = 0.06;
    insert_farthest(points, at_coverage(coverage), control);
    EXPECT_LE(brute_r_c(points, 1e-3), coverage + 1e-3);
    EXPECT_LE(measure_ratio(points, control).r_c, coverage * (1 + 1e-9));
    EXPECT_LT(static_cast<double>(points.size()), 600 + 1.2 / (coverage * coverage));
  }
}

TEST(InsertFarthest, DoesNotMindThatAllHolesAreEquallyDeep) {
  Control control;
  PointSet points = square_lattice(std::make_shared<Torus>(), 100, control);
  insert_farthest(points, at_count(200), control);
  EXPECT_NEAR(brute_r_f(points), 0.1 * std::sqrt(0.5), 1e-12) << "a square lattice, turned";
}

TEST(InsertFarthest, CanBeCancelled) {
  PointSet points = random_points(1, 1, 100, 1);
  Control control;
  control.cancel();
  expect_error([&] { insert_farthest(points, at_count(200), control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
