#include "core/generate/enrich.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/generate.h"
#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_distance;
using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;
using testing::random_points;

TEST(Enrich, ReachesTheCoverageWithPointsThatAreThatFarFromAllOthers) {
  for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{4.0, 0.5}, std::pair{0.02, 5.0}})
    for (const std::size_t n : {3, 30, 300}) {
      SCOPED_TRACE(::testing::Message() << n << " on " << width << " x " << height);
      const PointSet input = random_points(width, height, n, n);
      Control control(2);
      const double coverage = enrichment_coverage(input, control);
      const PointSet points = enrich(input, coverage, control);
      ASSERT_GE(points.size(), n);
      EXPECT_LE(brute_r_c(points, 1e-3 * coverage), coverage * (1 + 1e-3));
      EXPECT_LE(measure_spacing(points, control).r_c, coverage * (1 + 1e-9));
      EXPECT_EQ(brute_r_f(points), brute_r_f(input));
      EXPECT_LE(static_cast<double>(points.size() - n), most_inserted(*input.domain, coverage));
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (i < n) {
          ASSERT_EQ(points[i], input[i]);
          continue;
        }
        const PointSet before{
            points.domain,
            {points.coordinates.begin(), points.coordinates.begin() + 2 * static_cast<std::ptrdiff_t>(i)}};
        EXPECT_GT(brute_distance(before, points[i]), coverage) << i;
      }
    }
}

TEST(Enrich, FillsWhatACrowdLeavesFree) {
  for (const double corner : {0.3, 1e-3, 1e-5}) {
    PointSet input = random_points(1, 1, 1000, 1);
    for (double& c : input.coordinates) c *= corner;
    Control control(2);
    const double coverage = enrichment_coverage(input, control);
    EXPECT_EQ(coverage, radius_for_count(*input.domain, 1000));
    const PointSet points = enrich(input, coverage, control);
    EXPECT_LE(measure_spacing(points, control).r_c, coverage * (1 + 1e-9));
    EXPECT_LE(static_cast<double>(points.size()), 1000 + most_inserted(*input.domain, coverage));
  }
}

TEST(Enrich, LeavesSetsWithBetaAtMostOneAsTheyAre) {
  Control control;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const PointSet points = poisson_disk(std::make_shared<Torus>(), {0.06}, rng, control);
    EXPECT_EQ(enrich(points, enrichment_coverage(points, control), control).coordinates, points.coordinates);
  }
  const PointSet lattice = square_lattice(std::make_shared<Torus>(), 100, control);
  EXPECT_NEAR(enrichment_coverage(lattice, control), 0.1, 1e-12) << "r_f";
  EXPECT_EQ(enrich(lattice, enrichment_coverage(lattice, control), control).size(), 100u);
}

TEST(Enrich, FillsTheHoleThatATakenPointLeaves) {
  Control control;
  PointSet points = square_lattice(std::make_shared<Torus>(), 400, control);
  const Vec3 taken = points[210];
  points.coordinates.erase(points.coordinates.begin() + 420, points.coordinates.begin() + 422);
  const PointSet filled = enrich(points, 0.0499, control);
  ASSERT_EQ(filled.size(), 400u);
  EXPECT_LT(filled.domain->distance(filled[399], taken), 1e-12);
}

TEST(Enrich, DependsOnItsInputOnly) {
  const PointSet input = random_points(2, 1, 5000, 3);
  Control one(1), two(2);
  EXPECT_EQ(enrich(input, 0.01, one).coordinates, enrich(input, 0.01, two).coordinates);
}

TEST(Enrich, CanBeCancelled) {
  const PointSet input = random_points(1, 1, 100, 1);
  Control control;
  control.cancel();
  expect_error([&] { enrich(input, 0.01, control); }, ErrorCode::cancelled, "");
  expect_error([&] { enrichment_coverage(input, control); }, ErrorCode::cancelled, "");
}

TEST(MostInserted, IsReachedByTheTriangularLattice) {
  const Torus torus(1, std::sqrt(3.0));
  EXPECT_EQ(most_inserted(torus, 0.1 * (1 - 1e-12)), 200);
  EXPECT_EQ(most_inserted(Torus(1000, 1), 100 * (1 - 1e-5)), 10);
}

}  // namespace
}  // namespace wellspaced
