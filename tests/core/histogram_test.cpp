#include "core/analyze/histogram.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::expect_error;

using Counts = std::vector<std::uint64_t>;

Histogram of(const BinGrid& grid, const std::vector<double>& values) {
  return histogram(grid, values, Control());
}

TEST(Histogram, BeginsAndEndsWithBinsThatHoldSomething) {
  const Histogram h = of({0, 0.5}, {2.2, 3.6, 2.4, 2.0});
  EXPECT_EQ(h.low, 2);
  EXPECT_EQ(h.width, 0.5);
  EXPECT_EQ(h.counts, (Counts{3, 0, 0, 1}));
  EXPECT_EQ(h.above, 0u);
  EXPECT_EQ(h.total(), 4u);
  EXPECT_DOUBLE_EQ(h.mean, 2.55);
  EXPECT_DOUBLE_EQ(h.sd, std::sqrt((0.35 * 0.35 + 1.05 * 1.05 + 0.15 * 0.15 + 0.55 * 0.55) / 4));
  EXPECT_EQ(h.min, 2.0);
  EXPECT_EQ(h.max, 3.6);
}

TEST(Histogram, PutsEdgesIntoTheUpperBin) {
  for (const BinGrid& grid : {BinGrid{0.5, 0.01}, BinGrid{0, 0.02}, BinGrid{0, 1}, BinGrid{-0.5, 1}})
    for (int k = 0; k < 2000; ++k) {
      const double edge = grid.origin + k * grid.width;
      EXPECT_EQ(grid.bin(edge), k);
      EXPECT_EQ(grid.bin(std::nextafter(edge, -1)), std::max(k - 1, 0));
    }
  EXPECT_EQ(of({0, 1}, {5}).counts, Counts{1});
  EXPECT_EQ(of({0, 1}, {5}).low, 5);
}

TEST(Histogram, KeepsToItsFirstAndLastBin) {
  const BinGrid degrees{0, 1, 179};
  EXPECT_EQ(degrees.bin(180), 179);
  EXPECT_EQ(degrees.bin(1e300), 179);
  EXPECT_EQ(degrees.bin(std::numeric_limits<double>::infinity()), 179);
  EXPECT_EQ(degrees.bin(std::nan("")), 179);
  EXPECT_EQ(degrees.bin(-1e300), 0);
  const BinGrid open{0, 0.01};
  EXPECT_EQ(open.bin(1e300), open.last);
}

TEST(Histogram, CountsAboveWhatDoesNotFit) {
  const Histogram h = of({0, 1}, {10.5, 409.5, 410.0, 1e9, 1e18});
  EXPECT_EQ(h.low, 10);
  ASSERT_EQ(h.counts.size(), 400u);
  EXPECT_EQ(h.counts.front(), 1u);
  EXPECT_EQ(h.counts.back(), 1u);
  EXPECT_EQ(h.above, 3u);
  EXPECT_EQ(h.total(), 5u);
  EXPECT_EQ(h.max, 1e18);
}

TEST(Histogram, OfCountsIsThatOfTheirValues) {
  BinCounts bins{3, Counts(500)};
  std::vector<double> values;
  for (const int bin : {7, 7, 9, 406, 407, 502, 503, 10000}) {
    bins.add(bin);
    values.push_back(bin + 0.5);
  }
  const Histogram a = histogram({0, 1}, bins), b = of({0, 1}, values);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.counts, b.counts);
  EXPECT_EQ(a.above, b.above);
  const Histogram nothing = histogram({0, 1}, BinCounts{0, Counts(5), 2});
  EXPECT_TRUE(nothing.counts.empty());
  EXPECT_EQ(nothing.above, 2u);
}

TEST(Histogram, PoolsAsIfCountedAtOnce) {
  Rng rng(1);
  for (const double spread : {1.0, 10.0, 100.0, 5000.0}) {
    SCOPED_TRACE(spread);
    std::vector<double> all;
    std::vector<Histogram> sets;
    for (int s = 0; s < 5; ++s) {
      const double from = rng.uniform() * spread;
      std::vector<double> values;
      for (int i = 0; i < 300; ++i) values.push_back(from + spread * rng.uniform());
      sets.push_back(of({0.5, 0.01}, values));
      all.insert(all.end(), values.begin(), values.end());
    }
    const Histogram pooled = pool(sets), wanted = of({0.5, 0.01}, all);
    EXPECT_EQ(pooled.low, wanted.low);
    EXPECT_EQ(pooled.counts, wanted.counts);
    EXPECT_EQ(pooled.above, wanted.above);
    EXPECT_NEAR(pooled.mean, wanted.mean, 1e-12 * spread);
    EXPECT_NEAR(pooled.sd, wanted.sd, 1e-12 * spread);
    EXPECT_EQ(pooled.min, wanted.min);
    EXPECT_EQ(pooled.max, wanted.max);
    EXPECT_EQ(pool({sets.data(), 1}).counts, sets[0].counts);
  }
}

TEST(Histogram, CanBeCancelled) {
  Control control;
  control.cancel();
  const std::vector<double> values(10, 1.0);
  expect_error([&] { histogram({0, 1}, values, control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
