#include "core/math.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace wellspaced {
namespace {

TEST(PortableAtan2, AgreesWithLibmEverywhere) {
  Rng rng(1);
  for (int i = 0; i < 100000; ++i) {
    const double x = (rng.uniform() - 0.5) * std::pow(10, 20 * rng.uniform() - 10);
    const double y = (rng.uniform() - 0.5) * std::pow(10, 20 * rng.uniform() - 10);
    const double wanted = std::atan2(y, x);
    EXPECT_NEAR(portable_atan2(y, x), wanted, 8e-16 * std::fabs(wanted)) << y << " " << x;
  }
}

TEST(PortableAtan2, IsRightOnTheAxes) {
  EXPECT_EQ(portable_atan2(0, 0), 0);
  EXPECT_DOUBLE_EQ(portable_atan2(0, 2), 0);
  EXPECT_DOUBLE_EQ(portable_atan2(3, 0), pi / 2);
  EXPECT_DOUBLE_EQ(portable_atan2(-3, 0), -pi / 2);
  EXPECT_DOUBLE_EQ(portable_atan2(0, -1), pi);
}

TEST(PortableLog10, AgreesWithLibm) {
  Rng rng(2);
  for (int i = 0; i < 100000; ++i) {
    const double x = std::pow(10, 600 * rng.uniform() - 300), near_one = 1 + 0.1 * (rng.uniform() - 0.5);
    EXPECT_NEAR(portable_log10(x), std::log10(x), 8e-16 * std::fabs(std::log10(x))) << x;
    EXPECT_NEAR(portable_log10(near_one), std::log10(near_one), 1e-16) << near_one;
  }
  EXPECT_EQ(portable_log10(1), 0);
  EXPECT_DOUBLE_EQ(portable_log10(1000), 3);
  EXPECT_DOUBLE_EQ(portable_log10(5e-324), std::log10(5e-324));
}

TEST(PortableExp, AgreesWithLibm) {
  Rng rng(3);
  for (int i = 0; i < 100000; ++i) {
    const double x = 1450 * rng.uniform() - 745, small = rng.uniform() - 0.5;
    const double wanted = std::exp(x);
    EXPECT_NEAR(portable_exp(x), wanted, std::fmax(2.3e-16 * wanted, 5e-324)) << x;
    EXPECT_NEAR(portable_exp(small), std::exp(small), 2.3e-16 * std::exp(small)) << small;
  }
}

TEST(PortableExp, IsRightAtItsEnds) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(portable_exp(0), 1);
  EXPECT_EQ(portable_exp(-0.0), 1);
  EXPECT_DOUBLE_EQ(portable_exp(709.782712893384), std::exp(709.782712893384));
  EXPECT_EQ(portable_exp(709.79), infinity);
  EXPECT_EQ(portable_exp(infinity), infinity);
  EXPECT_EQ(portable_exp(-745.1), 5e-324);
  EXPECT_EQ(portable_exp(-745.2), 0);
  EXPECT_EQ(portable_exp(-infinity), 0);
  EXPECT_TRUE(std::isnan(portable_exp(std::numeric_limits<double>::quiet_NaN())));
}

TEST(PortableCosSin, AgreesWithLibmAllAround) {
  for (const std::uint64_t n : {1u, 2u, 3u, 5u, 8u, 12u, 1000u, 10240u})
    for (std::uint64_t k = 0; k < n; ++k) {
      const auto [cos, sin] = portable_cos_sin(k, n);
      const long double angle =
          2 * std::acos(-1.0L) * static_cast<long double>(k) / static_cast<long double>(n);
      EXPECT_NEAR(cos, static_cast<double>(std::cos(angle)), 1.2e-16) << k << "/" << n;
      EXPECT_NEAR(sin, static_cast<double>(std::sin(angle)), 1.2e-16) << k << "/" << n;
    }
}

TEST(PortableCosSin, IsExactAtQuarterTurns) {
  const double cos[] = {1, 0, -1, 0}, sin[] = {0, 1, 0, -1};
  for (std::uint64_t k = 0; k < 4; ++k) {
    EXPECT_EQ(portable_cos_sin(3 * k, 12).cos, cos[k]);
    EXPECT_EQ(portable_cos_sin(3 * k, 12).sin, sin[k]);
  }
}

TEST(PortableCosSin, TakesAnyNumberOfTurns) {
  Rng rng(4);
  for (int i = 0; i < 100000; ++i) {
    const double turns = (rng.uniform() - 0.5) * std::pow(10, 20 * rng.uniform() - 10);
    const auto [cos, sin] = portable_cos_sin(turns);
    const long double part = static_cast<long double>(turns) - std::floor(static_cast<long double>(turns));
    const long double angle = 2 * std::acos(-1.0L) * part;
    EXPECT_NEAR(cos, static_cast<double>(std::cos(angle)), 2e-16) << turns;
    EXPECT_NEAR(sin, static_cast<double>(std::sin(angle)), 2e-16) << turns;
  }
  for (const double whole : {-3.0, 0.0, 1.0, 4503599627370495.0}) {
    EXPECT_EQ(portable_cos_sin(whole).cos, 1);
    EXPECT_EQ(portable_cos_sin(whole).sin, 0);
  }
  EXPECT_EQ(portable_cos_sin(0.25).sin, 1);
  EXPECT_EQ(portable_cos_sin(-0.25).cos, 0);
  EXPECT_EQ(portable_cos_sin(-0.25).sin, -1);
  EXPECT_EQ(portable_cos_sin(1e6 + 0.5).cos, -1);
}

TEST(Rng, DrawsTheSameNumbersEverywhere) {
  Rng rng(42);
  const std::uint64_t first = rng.next();
  EXPECT_EQ(Rng(42).next(), first);
  EXPECT_NE(Rng(43).next(), first);
  EXPECT_NE(Rng(42, 1).next(), first);
}

TEST(Rng, IsUniform) {
  Rng rng(7);
  int counts[10] = {};
  double sum = 0;
  for (int i = 0; i < 100000; ++i) {
    ++counts[rng.below(10)];
    const double u = rng.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
  }
  for (int count : counts) EXPECT_NEAR(count, 10000, 500);  // five standard deviations
  EXPECT_NEAR(sum / 100000, 0.5, 0.005);
}

}  // namespace
}  // namespace wellspaced
