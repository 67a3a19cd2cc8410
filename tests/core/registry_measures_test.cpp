#include "core/registry_measures.h"

#include <gtest/gtest.h>

#include "core/analyze/spectrum.h"

namespace wellspaced {
namespace {

SetsSize size_of(double n, double sets) {
  SetsSize size;
  size.n = n;
  size.sets = sets;
  return size;
}

TEST(PeriodogramCost, IsThatOfEachSetInTurnBesideTheMean) {
  const Cost one = periodogram_cost(size_of(1000, 1), 2.5), two = periodogram_cost(size_of(1000, 2), 2.5),
             five = periodogram_cost(size_of(1000, 5), 2.5);
  const double k_max = k_max_of(1000, 1, 2.5);
  EXPECT_EQ(one.bytes, static_cast<double>(periodogram_bytes(1000, static_cast<int>(k_max), 8)));
  EXPECT_EQ(two.bytes, one.bytes + 16 * k_max * k_max);
  EXPECT_EQ(five.bytes, two.bytes);
  EXPECT_DOUBLE_EQ(five.seconds, 5 * one.seconds);
}

TEST(PeriodogramCost, IsEndlessWhereThereIsNoPeriodogram) {
  EXPECT_GT(periodogram_cost(size_of(1e9, 1), 1000).bytes, 1e20);
  EXPECT_GT(periodogram_cost(size_of(1e300, 1), 1000).bytes, 1e20);
}

TEST(PairCorrelationCost, GrowsWithThePairsAndTheBins) {
  const Cost one = pair_correlation_cost(size_of(1000, 1), {8, 400}),
             wide = pair_correlation_cost(size_of(1000, 1), {16, 400}),
             fine = pair_correlation_cost(size_of(1000, 1), {8, 800});
  EXPECT_GT(wide.seconds, 3 * one.seconds);
  EXPECT_EQ(wide.bytes, one.bytes);
  EXPECT_EQ(fine.bytes, one.bytes + 60.0 * 400);
}

TEST(RangeParameter, HasItsDefaultAsTextAndNumber) {
  const Parameter p = range_parameter("how far", 0.5, 20, 2.5);
  EXPECT_EQ(p.name, "range");
  EXPECT_EQ(p.description, "how far");
  EXPECT_EQ(p.minimum, 0.5);
  EXPECT_EQ(p.maximum, 20);
  EXPECT_EQ(p.fallback, "2.5");
  EXPECT_EQ(range_of({}, 2.5), 2.5);
  EXPECT_EQ(range_of({{"range", 7.0}}, 2.5), 7);
}

}  // namespace
}  // namespace wellspaced
