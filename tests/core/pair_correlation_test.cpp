#include "core/analyze/pair_correlation.h"

#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "core/math.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::expect_error;
using testing::mps;
using testing::random_points;

/// Over all ordered pairs and all images, with nothing but distances.
std::vector<double> brute_g(const PointSet& points, double reach, int bins) {
  const Vec3 sides = points.domain->box().size;
  const double area = sides.x * sides.y, n = static_cast<double>(points.size());
  const double width = reach * std::sqrt(2 * area / (std::sqrt(3.0) * n)) / bins;
  const int along = static_cast<int>(width * bins / sides.x) + 2,
            up = static_cast<int>(width * bins / sides.y) + 2;
  std::vector<double> g(static_cast<std::size_t>(bins));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j)
      for (int tx = -along; tx <= along && i != j; ++tx)
        for (int ty = -up; ty <= up; ++ty) {
          const Vec3 d = points[j] - points[i];
          const double r = std::hypot(d.x + tx * sides.x, d.y + ty * sides.y);
          const auto bin = static_cast<std::size_t>(r / width);
          if (bin >= g.size()) continue;
          const double inner = static_cast<double>(bin) * width, outer = inner + width;
          g[bin] += area / (n * (n - 1) * pi * (outer * outer - inner * inner));
        }
  return g;
}

TEST(PairCorrelation, AgreesWithAllPairsAndTheirImages) {
  const std::tuple<double, double, std::size_t, double, int> cases[] = {
      {1, 1, 2, 8, 40},    {1, 1, 3, 8, 400},    {3, 0.2, 3, 8, 100},  {0.2, 3, 3, 8, 100},
      {3, 0.2, 40, 8, 90}, {100, 0.1, 5, 8, 30}, {0.1, 100, 5, 3, 30}, {1, 1, 100, 0.1, 3},
      {2, 1, 300, 20, 77}, {1, 1, 500, 8, 400},  {1, 3, 700, 1, 1},    {1, 1, 5, 64, 1000}};
  for (const auto& [width, height, n, reach, bins] : cases) {
    SCOPED_TRACE(::testing::Message() << width << " x " << height << ", n " << n << ", reach " << reach);
    const PointSet points = random_points(width, height, n, 5);
    const PairCorrelation found = pair_correlation(points, {reach, bins}, Control(2));
    const std::vector<double> wanted = brute_g(points, reach, bins);
    ASSERT_EQ(found.g.size(), wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
      ASSERT_NEAR(found.g[k], wanted[k], 1e-9 * std::max(1.0, wanted[k])) << k;
  }
}

TEST(PairCorrelation, OfClustersAgreesWithAllPairs) {
  PointSet points = random_points(1, 1, 200, 8);
  for (std::size_t i = 0; i < 150; ++i)
    points.set(i, {1e-3 * points[i].x, i % 2 == 0 ? 1e-3 * points[i].y : 1 - 1e-3 * points[i].y, 0});
  for (std::size_t i = 0; i < 10; ++i) points.set(i, {0.5, 0.5, 0});  // ten that coincide
  const PairCorrelation found = pair_correlation(points, {2, 50}, Control());
  const std::vector<double> wanted = brute_g(points, 2, 50);
  for (std::size_t k = 0; k < wanted.size(); ++k)
    EXPECT_NEAR(found.g[k], wanted[k], 1e-9 * std::max(1.0, wanted[k])) << k;
}

TEST(PairCorrelation, OfWhiteNoiseIsOneAtEveryDistance) {
  constexpr int sets = 40;
  for (const auto& [height, n] : {std::pair{1.0, 2000}, std::pair{0.1, 300}, std::pair{1.0, 2}}) {
    std::vector<PairCorrelation> all;
    for (std::uint64_t seed = 0; seed < sets; ++seed)
      all.push_back(
          pair_correlation(random_points(1, height, static_cast<std::size_t>(n), seed), {8, 50}, Control()));
    const PairCorrelation mean = average(all);
    EXPECT_NEAR(mean.d_hex, hexagonal_spacing(height, static_cast<std::size_t>(n)), 1e-12);
    for (std::size_t k = 0; k < mean.g.size(); ++k) {
      double square = 0;  // of the deviations from 1, of which it is to be told whether their mean is 0
      for (const PairCorrelation& one : all) square += (one.g[k] - 1) * (one.g[k] - 1);
      EXPECT_NEAR(mean.g[k], 1, 5 * std::sqrt(square) / sets + 1e-12) << "n " << n << ", bin " << k;
      if (n == 2000) {  // as many pairs as independent ones would be, each in both directions
        const double pairs = sets * mean.n * mean.neighbors(k) / mean.g[k] / 2;
        EXPECT_NEAR(mean.g[k], 1, 5 / std::sqrt(pairs)) << k;
      }
    }
  }
}

TEST(PairCorrelation, OfTheTriangularLatticePeaksAtItsShells) {
  Control control;
  const PointSet lattice =
      triangular_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 2 * 40 * 40, control);
  // With 399 bins no shell falls between two of them; 8 d_hex are within half a side, so no own image counts.
  const PairCorrelation p = pair_correlation(lattice, {8, 399}, control);
  const std::pair<double, double> shells[] = {{1, 6},  {3, 6},   {4, 6},  {7, 12},  {9, 6},
                                              {12, 6}, {13, 12}, {16, 6}, {19, 12}, {21, 12}};
  std::size_t next = 0;
  for (const auto& [distance2, neighbors] : shells) {
    const auto shell = static_cast<std::size_t>(std::sqrt(distance2) / p.bin);
    while (next < shell) EXPECT_EQ(p.g[next++], 0) << distance2;
    EXPECT_NEAR(p.neighbors(next++), neighbors, 1e-9) << distance2;
  }
  const PairCorrelationPeak peak = highest_peak(p);
  EXPECT_NEAR(peak.r, 1, p.bin / 2);
  EXPECT_NEAR(peak.height, p.g[static_cast<std::size_t>(1 / p.bin)], 0);
}

TEST(PairCorrelation, CountsEveryOtherSampleWithinReach) {
  const PointSet points = random_points(1, 1, 4, 1);
  const double far = 60;  // area of the disk / area of the torus times 3 others, up to its rim
  const PairCorrelation p = pair_correlation(points, {far, 10}, Control());
  double neighbors = 0;
  for (std::size_t k = 0; k < p.g.size(); ++k) neighbors += p.neighbors(k);
  const double radius = far * p.d_hex;
  EXPECT_NEAR(neighbors, 3 * pi * radius * radius, 3 * 2 * pi * radius);
}

TEST(PairCorrelation, OfMaximalPoissonDisksIsZeroBelowTheConflictRadiusAndJumpsThere) {
  std::vector<PairCorrelation> sets;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    sets.push_back(pair_correlation(mps(4000, seed), {}, Control(2)));
  const PairCorrelation p = average(sets);
  const double r_f = std::sqrt(poisson_disk_constant * std::sqrt(3.0) / 2);  // rho
  for (std::size_t k = 0; static_cast<double>(k + 1) * p.bin < 0.99 * r_f; ++k) EXPECT_EQ(p.g[k], 0) << k;
  const PairCorrelationPeak peak = highest_peak(p);
  EXPECT_NEAR(peak.r, r_f, 2 * p.bin);
  EXPECT_GT(peak.height, 2);
  for (std::size_t k = 250; k < 400; ++k) EXPECT_NEAR(p.g[k], 1, 0.05) << "far away nothing is known: " << k;
}

TEST(PairCorrelation, AveragesBinByBin) {
  std::vector<PairCorrelation> sets;
  for (std::uint64_t seed : {1u, 2u, 3u})
    sets.push_back(pair_correlation(random_points(1, 1, 50 + seed, seed), {4, 9}, Control()));
  const PairCorrelation mean = average(sets);
  EXPECT_DOUBLE_EQ(mean.n, 52);
  EXPECT_DOUBLE_EQ(mean.d_hex, (sets[0].d_hex + sets[1].d_hex + sets[2].d_hex) / 3);
  for (std::size_t k = 0; k < 9; ++k)
    EXPECT_NEAR(mean.g[k], (sets[0].g[k] + sets[1].g[k] + sets[2].g[k]) / 3, 1e-12);
  EXPECT_EQ(average({sets.data(), 1}).g, sets[0].g);
}

TEST(PairCorrelation, FindsTheFirstOfEqualPeaks) {
  const PairCorrelationPeak peak = highest_peak({4, 1, 0.5, 0.25, {0, 1, 3, 2, 3, 1}});
  EXPECT_EQ(peak.r, 0.625);
  EXPECT_EQ(peak.height, 3);
}

TEST(PairCorrelation, DoesNotNoticeTranslationsOrScale) {
  const PointSet points = random_points(1, 2, 600, 3);
  PointSet moved = points;
  for (std::size_t i = 0; i < points.size(); ++i)
    moved.set(i, points.domain->step(points[i], {0.3071, 1.8123}));
  const PairCorrelation a = pair_correlation(points, {8, 60}, Control());
  // A pair may come to lie on the other side of a bin's edge; none of these does.
  EXPECT_EQ(a.g, pair_correlation(moved, {8, 60}, Control()).g);
  PointSet larger{std::make_shared<Torus>(1024, 2048), points.coordinates};
  for (double& c : larger.coordinates) c *= 1024;  // a power of two: exact
  EXPECT_EQ(a.g, pair_correlation(larger, {8, 60}, Control()).g);
}

TEST(PairCorrelation, IsTheSameOnAnyNumberOfThreads) {
  const PointSet points = random_points(1, 1, 20000, 3);
  const PairCorrelation one = pair_correlation(points, {}, Control(1));
  for (unsigned threads : {2u, 3u, 8u}) EXPECT_EQ(one.g, pair_correlation(points, {}, Control(threads)).g);
}

TEST(PairCorrelation, RefusesWhatItCannotMeasure) {
  const auto measure = [](std::size_t n, double reach, int bins) {
    return [=] { pair_correlation(random_points(1, 1, n, 1), {reach, bins}, Control()); };
  };
  for (const std::size_t n : {0u, 1u})
    expect_error(measure(n, 8, 400), ErrorCode::degenerate_input, "", "at least 2 points");
  for (const double reach : {0.0, -1.0, 64.1, std::nan(""), std::numeric_limits<double>::infinity()})
    expect_error(measure(10, reach, 400), ErrorCode::invalid_parameters, "/reach", "64");
  for (const int bins : {0, -1, 100001})
    expect_error(measure(10, 8, bins), ErrorCode::invalid_parameters, "/bins", "100000");
}

TEST(PairCorrelation, CanBeCancelled) {
  Control control(2);
  control.cancel();
  expect_error([&] { pair_correlation(random_points(1, 1, 5000, 3), {}, control); }, ErrorCode::cancelled,
               "");
}

}  // namespace
}  // namespace wellspaced
