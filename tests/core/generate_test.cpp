#include "core/generate/generate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/poisson_disk.h"
#include "core/generate/white_noise.h"
#include "core/registry.h"
#include "tests/support/oracle.h"
#include "tests/support/vector_widths.h"

namespace wellspaced {
namespace {

using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;

PointSet mps(double width, double height, double radius, std::uint64_t seed, unsigned threads = 1) {
  Rng rng(seed);
  Control control(threads);
  return poisson_disk(std::make_shared<Torus>(width, height), {radius}, rng, control);
}

TEST(PoissonDisk, KeepsBothOfItsGuaranteesOnEveryTorus) {
  struct Case {
    double width, height, radius;
  };
  const Case cases[] = {{1, 1, 0.7},    {1, 1, 0.5},     {1, 1, 0.4},    {1, 1, 0.2},
                        {1, 1, 0.05},   {1, 1, 0.02},    {4, 0.5, 0.06}, {1, 0.05, 0.03},
                        {1, 0.05, 0.2}, {0.01, 1, 0.05}, {300, 200, 11}, {1e-3, 1e-3, 5e-5}};
  for (const Case& c : cases)
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(::testing::Message()
                   << c.width << " x " << c.height << ", r " << c.radius << ", seed " << seed);
      const PointSet points = mps(c.width, c.height, c.radius, seed);
      ASSERT_GE(points.size(), 1u);
      EXPECT_GE(brute_r_f(points), c.radius);
      EXPECT_LE(brute_r_c(points, 1e-4 * c.radius), c.radius * (1 + 1e-4)) << "a dart would still fit";
      if (points.size() < 3) continue;
      EXPECT_LE(measure_spacing(points, Control()).r_c, c.radius * (1 + 1e-9));
    }
}

TEST(PoissonDisk, IsQuickWhereTheRimOfADiskJustTouchesItself) {
  const double farthest = std::hypot(1000.0, 1.0) / 2;
  for (double radius : {farthest * (1 - 1e-9), farthest * 0.999, 250.0})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Control control;
      control.set_deadline(Control::Clock::now() + std::chrono::seconds(20));  // it took a minute once
      Rng rng(seed);
      const PointSet points = poisson_disk(std::make_shared<Torus>(1000, 1), {radius}, rng, control);
      EXPECT_GE(points.size(), 1u);
      EXPECT_LE(points.size(), 4u);
    }
}

TEST(PoissonDisk, HasThePublishedStatistics) {
  // n r^2 in .690 to .703, rho .777, valence 4..8: 1.1/24.6/50.0/21.8/2.4 %, mean beta_i .859, mean nearest
  // distance 1.054 r.
  double beta_i = 0, nearest = 0, density = 0;
  std::map<int, double> valence;
  constexpr int sets = 5;
  for (std::uint64_t seed = 1; seed <= sets; ++seed) {
    const double r = poisson_disk_radius(1, 10000);
    const Spacing s = measure_spacing(mps(1, 1, r, seed), Control(2));
    EXPECT_NEAR(static_cast<double>(s.n), 10000, 100);
    EXPECT_LE(s.beta, 1 + 1e-9);
    beta_i += s.beta_i_mean / sets;
    nearest += s.nearest_mean * hexagonal_spacing(1, s.n) / r / sets;
    density += static_cast<double>(s.n) * r * r / sets;
    for (const auto& [k, count] : s.valence)
      valence[k] += 100.0 * static_cast<double>(count) / static_cast<double>(s.n) / sets;
  }
  EXPECT_NEAR(beta_i, 0.859, 0.003);
  EXPECT_NEAR(nearest, 1.054, 0.003);
  EXPECT_GT(density, 0.690);
  EXPECT_LT(density, 0.703);
  EXPECT_NEAR(valence[5], 24.6, 1);
  EXPECT_NEAR(valence[6], 50.0, 1);
  EXPECT_NEAR(valence[7], 21.8, 1);
}

TEST(PoissonDisk, DependsOnItsSeedOnly) {
  const PointSet one = mps(1, 1, 0.01, 3, 1), two = mps(1, 1, 0.01, 3, 2), other = mps(1, 1, 0.01, 4, 1);
  EXPECT_EQ(one.coordinates, two.coordinates);
  EXPECT_NE(one.coordinates, other.coordinates);
}

/// Large enough to be cut into tiles along the axes that are long.
constexpr struct {
  double width, height, radius;
} tiled[] = {{1, 1, 0.004}, {3, 0.3, 0.004}, {0.2, 5, 0.004}};

TEST(PoissonDiskInTiles, GivesTheSameOnAnyNumberOfThreadsAndEveryVectorWidth) {
  for (const auto& c : tiled) {
    const PointSet one = mps(c.width, c.height, c.radius, 3);
    EXPECT_GT(one.size(), 35000u);
    testing::on_every_vector_width([&](const std::string& name) {
      for (const unsigned threads : {1u, 2u, 3u, 8u})
        EXPECT_EQ(mps(c.width, c.height, c.radius, 3, threads).coordinates, one.coordinates)
            << name << ", " << threads << " threads";
    });
  }
}

TEST(PoissonDiskInTiles, KeepsBothOfItsGuarantees) {
  for (const auto& c : tiled)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Spacing spacing = measure_spacing(mps(c.width, c.height, c.radius, seed, 2), Control(2));
      EXPECT_GE(spacing.r_f, c.radius * (1 - 1e-12));
      EXPECT_LE(spacing.r_c, c.radius * (1 + 1e-9));
    }
}

/// Of the periodogram, of points in the unit square.
double power_at(const PointSet& points, double kx, double ky) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += std::polar(1.0, -2 * std::numbers::pi * (kx * points[i].x + ky * points[i].y));
  return std::norm(sum) / static_cast<double>(points.size());
}

TEST(PoissonDiskInTiles, ShowsNoBordersAtLowFrequencies) {
  // Blocks are a twelfth and tiles a half of the torus wide here.
  double power = 0;
  constexpr int sets = 5, frequencies = 12;
  for (std::uint64_t seed = 1; seed <= sets; ++seed) {
    const PointSet points = mps(1, 1, 0.0036, seed, 2);
    for (int k = 1; k <= frequencies; ++k)
      power += (power_at(points, k, 0) + power_at(points, 0, k)) / (2 * sets * frequencies);
  }
  EXPECT_NEAR(power, 0.060, 0.025) << "what one tile gives";
}

TEST(PoissonDisk, RefusesRadiiThatLeaveNoRoom) {
  expect_error([] { mps(1, 1, 0.71, 1); }, ErrorCode::infeasible, "/radius", "0.707");
  expect_error([] { mps(1, 1, 0, 1); }, ErrorCode::invalid_parameters, "/radius");
  expect_error([] { mps(1, 1, std::nan(""), 1); }, ErrorCode::invalid_parameters, "/radius");
}

TEST(PoissonDisk, CanBeCancelled) {
  Rng rng(1);
  Control control;
  control.cancel();
  expect_error([&] { poisson_disk(std::make_shared<Torus>(), {0.01}, rng, control); }, ErrorCode::cancelled,
               "");
}

TEST(PoissonDiskOfCount, IsMaximalAtExactlyThatCountOnEveryTorus) {
  for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{3.0, 0.5}, std::pair{0.02, 20.0}})
    for (const std::uint64_t count : {1, 2, 3, 4, 5, 7, 12, 30, 101, 400})
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(::testing::Message()
                     << width << " x " << height << ", count " << count << ", seed " << seed);
        Rng rng(seed);
        Control control;
        const PointSet points =
            poisson_disk_of_count(std::make_shared<Torus>(width, height), count, rng, control);
        ASSERT_EQ(points.size(), count);
        if (count < 2) continue;
        const double r_f = brute_r_f(points);
        EXPECT_LE(brute_r_c(points, 1e-4 * r_f), r_f * (1 + 1e-4)) << "a dart would still fit";
        if (count >= 3) {
          EXPECT_LE(measure_spacing(points, control).beta, 1 + 1e-9);
        }
      }
}

TEST(PoissonDiskOfCount, HasTheDensityOfPoissonDisks) {
  double density = 0;
  constexpr int sets = 5;
  for (std::uint64_t seed = 1; seed <= sets; ++seed) {
    Rng rng(seed);
    Control control(2);
    const PointSet points = poisson_disk_of_count(std::make_shared<Torus>(), 10000, rng, control);
    ASSERT_EQ(points.size(), 10000u);
    const Spacing s = measure_spacing(points, control);
    EXPECT_LE(s.beta, 1 + 1e-9);
    EXPECT_NEAR(s.beta_i_mean, 0.859, 0.005);
    density += static_cast<double>(s.n) * s.r_f * s.r_f / sets;
  }
  EXPECT_GT(density, 0.692);
  EXPECT_LT(density, 0.700);
}

TEST(PoissonDiskOfCount, GoesRowByRow) {
  Rng rng(1);
  Control control;
  const PointSet points = poisson_disk_of_count(std::make_shared<Torus>(), 2000, rng, control);
  // Rows of the background grid are at most r / sqrt(2) high, and one of them is left before the next begins.
  const double row = radius_for_count(*points.domain, 1900) / std::sqrt(2.0);
  double highest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(points[i].y, highest - row) << i;
    highest = std::max(highest, points[i].y);
  }
}

TEST(Generators, StayInTheirDomainAndHaveExactlyTheirCount) {
  for (const Generator& generator : generators())
    for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{3.0, 0.5}, std::pair{0.1, 7.0}})
      for (double count : {1.0, 2.0, 3.0, 10.0, 100.0, 997.0, 10000.0}) {
        const auto& range = *std::find_if(generator.parameters.begin(), generator.parameters.end(),
                                          [](const Parameter& p) { return p.name == "count"; });
        if (count < range.minimum) continue;
        if (generator.name == "hexagonal") count = 2 * std::ceil(count / 2);
        SCOPED_TRACE(generator.name + " " + std::to_string(count) + " on height " + std::to_string(height));
        const auto torus = std::make_shared<Torus>(width, height);
        Rng rng(1);
        Control control(2);
        const PointSet points = generator.run(torus, {{"count", count}}, rng, control);
        for (std::size_t i = 0; i < points.size(); ++i) ASSERT_FALSE(torus->why_outside(points[i]));
        EXPECT_EQ(static_cast<double>(points.size()), count);
        Rng again(1);
        Control alone(1);
        EXPECT_EQ(generator.run(torus, {{"count", count}}, again, alone).coordinates, points.coordinates);
      }
}

TEST(WhiteNoise, IsUniform) {
  Rng rng(1);
  Control control;
  const PointSet points = white_noise(std::make_shared<Torus>(2, 1), 40000, rng, control);
  int quarters[4] = {};
  for (std::size_t i = 0; i < points.size(); ++i) ++quarters[(points[i].x >= 1) + 2 * (points[i].y >= 0.5)];
  for (int count : quarters) EXPECT_NEAR(count, 10000, 440);  // five standard deviations
}

}  // namespace
}  // namespace wellspaced
