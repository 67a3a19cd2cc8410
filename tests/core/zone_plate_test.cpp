#include "core/analyze/zone_plate.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/math.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::expect_error;
using testing::random_points;

double field(const PointSet& points, double frequency, Vec2 p) {
  const double width = points.domain->box().size.x;
  const double k = frequency * width * std::sqrt(static_cast<double>(points.size()) / points.domain->area());
  return (1 + std::cos(pi * k * norm2(p) / (width * width))) / 2;
}

/// A pixel from the definition, over all samples.
double brute_pixel(const PointSet& points, const ZonePlateOptions& options, Vec2 center) {
  const double sigma = options.sigma * std::sqrt(points.domain->area() / static_cast<double>(points.size()));
  double sum = 0, weights = 0, nearest = std::numeric_limits<double>::infinity(), there = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 p{points[i].x, points[i].y};
    const double d = norm(p - center), f = field(points, options.frequency, p);
    if (d < nearest) {
      nearest = d;
      there = f;
    }
    if (d > 3 * sigma) continue;
    sum += std::exp(-d * d / (2 * sigma * sigma)) * f;
    weights += std::exp(-d * d / (2 * sigma * sigma));
  }
  return weights > 0 ? sum / weights : there;
}

PointSet poisson(std::uint64_t n, std::uint64_t seed) {
  Rng rng(seed);
  Control control(2);
  return poisson_disk_of_count(std::make_shared<Torus>(), n, rng, control);
}

TEST(ZonePlate, AgreesWithASumOverAllSamples) {
  for (const double height : {1.0, 0.3, 2.5})
    for (const std::size_t n : {1u, 5u, 300u})
      for (const double sigma : {0.1, 0.5, 2.0})
        for (const std::optional<int> size : {std::optional<int>(), std::optional(23)}) {
          const PointSet points = random_points(1.7, 1.7 * height, n, n);
          const ZonePlateOptions options{size, 1.2, sigma};
          const ZonePlate image = zone_plate(points, options, Control(2));
          const auto columns = static_cast<double>(image.columns), rows = static_cast<double>(image.rows);
          EXPECT_EQ(columns,
                    size ? 23 : std::max(1.0, std::round(std::sqrt(static_cast<double>(n) / height))));
          EXPECT_EQ(rows, std::max(1.0, std::round(columns * height)));
          ASSERT_EQ(image.pixels.size(), image.columns * image.rows);
          for (std::size_t row = 0; row < image.rows; ++row)
            for (std::size_t column = 0; column < image.columns; ++column) {
              const Vec2 center{1.7 * (static_cast<double>(column) + 0.5) / columns,
                                1.7 * height * (static_cast<double>(row) + 0.5) / rows};
              EXPECT_NEAR(image.pixels[row * image.columns + column], brute_pixel(points, options, center),
                          1e-10);
            }
        }
}

TEST(ZonePlate, TakesItsErrorAwayFromTheBorder) {
  const PointSet points = random_points(1, 1, 400, 3);
  const ZonePlateOptions options;
  const ZonePlate image = zone_plate(points, options, Control());
  const ZonePlateField wanted = zone_plate_field(*points.domain, 400, 0.5);
  ASSERT_EQ(image.columns, 20u);
  double sum = 0;
  for (std::size_t row = 1; row < 19; ++row)  // 3 sigma are one pixel and a half
    for (std::size_t column = 1; column < 19; ++column) {
      const Vec2 center{(static_cast<double>(column) + 0.5) / 20, (static_cast<double>(row) + 0.5) / 20};
      const double error = image.pixels[row * 20 + column] - wanted.blurred(center, 0.5 / 20);
      sum += error * error / (18 * 18);
    }
  EXPECT_NEAR(image.rmse, std::sqrt(sum), 1e-12);
}

TEST(ZonePlate, IsWhiteWithoutFrequency) {
  const ZonePlate image = zone_plate(random_points(1, 1, 200, 4), {{}, 0, 0.5}, Control());
  for (const double pixel : image.pixels) EXPECT_EQ(pixel, 1);
  EXPECT_EQ(image.rmse, 0);
  const ZonePlate nearly = zone_plate(random_points(1, 1, 200, 4), {{}, 1e-9, 0.5}, Control());
  for (const double pixel : nearly.pixels) EXPECT_NEAR(pixel, 1, 1e-12);
}

TEST(ZonePlate, OfAGridUnderANarrowFilterIsTheFieldItself) {
  PointSet grid{std::make_shared<Torus>(), {}};
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 30; ++column) grid.push_back({(column + 0.5) / 30, (row + 0.5) / 30});
  const ZonePlate image = zone_plate(grid, {{}, 0.5, 0.05}, Control());
  ASSERT_EQ(image.columns, 30u);
  for (std::size_t i = 0; i < grid.size(); ++i)
    EXPECT_NEAR(image.pixels[i], field(grid, 0.5, {grid[i].x, grid[i].y}), 1e-12);
}

TEST(ZonePlate, KnowsItsBlurredFieldInClosedForm) {
  const ZonePlateField f{1.6, 7};
  for (const double sigma : {0.02, 0.1, 0.3})
    for (const Vec2 p : {Vec2{0, 0}, Vec2{0.5, 0.1}, Vec2{0.7, 1.1}, Vec2{1.6, 0.4}}) {
      const int steps = 400;  // a side; the trapezoid rule of a smooth function that vanishes is exact
      double sum = 0, weights = 0;
      for (int ix = -steps; ix <= steps; ++ix)
        for (int iy = -steps; iy <= steps; ++iy) {
          const Vec2 z{8.0 * ix / steps, 8.0 * iy / steps};
          const double weight = std::exp(-norm2(z) / 2);
          const Vec2 q = p + sigma * z;
          sum += weight * (1 + std::cos(pi * 7 * norm2(q) / (1.6 * 1.6))) / 2;
          weights += weight;
        }
      EXPECT_NEAR(f.blurred(p, sigma), sum / weights, 1e-9) << sigma << " " << p.x << " " << p.y;
    }
}

TEST(ZonePlate, FieldIsSharpUnderNoFilterAndKeepsItsPhaseFarOut) {
  const ZonePlateField f{2, 3e5};
  for (const Vec2 p : {Vec2{0, 0}, Vec2{0.5, 0.1}, Vec2{2, 2}}) EXPECT_NEAR(f.blurred(p, 0), f.at(p), 1e-12);
  EXPECT_NEAR(f.at({2, 2}), 1, 1e-9);  // 3e5 whole turns
  EXPECT_NEAR((ZonePlateField{1, 1}).at({0.6, 0.8}), 0, 1e-12);
}

TEST(ZonePlate, HasItsFrequencyInCyclesASpacing) {
  const ZonePlateField f = zone_plate_field(Torus(2, 1), 800, 0.5);  // a spacing is .05
  EXPECT_NEAR(f.k, 0.5 * 2 / 0.05, 1e-12);
  // At a width's distance, half a cycle a spacing, but for the frequency's own growth.
  EXPECT_NEAR(f.at({2, 0}) - f.at({1.95, 0}), 1, 0.02);
}

TEST(ZonePlate, ComesNearerToTheFieldWithMoreSamples) {
  // The same field in the domain: its frequency a spacing falls.
  double before = 1;
  for (const std::uint64_t n : {500u, 2000u, 8000u}) {
    const double error =
        zone_plate(poisson(n, 1), {{}, 0.5 * std::sqrt(500.0 / static_cast<double>(n)), 0.5}, Control(2))
            .rmse;
    EXPECT_LT(error, 0.75 * before) << n;
    before = error;
  }
}

TEST(ZonePlate, OfALatticeOnASmoothFieldIsNearlyIdeal) {
  Control control;
  const PointSet lattice = square_lattice(std::make_shared<Torus>(), 90000, control);
  EXPECT_LT(zone_plate(lattice, {{}, 0.05, 1.5}, control).rmse, 0.004);
}

TEST(ZonePlate, ShowsLessNoiseForBlueNoiseThanForWhite) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const double blue = zone_plate(poisson(3000, seed), {}, Control(2)).rmse;
    const double white = zone_plate(random_points(1, 1, 3000, seed), {}, Control(2)).rmse;
    EXPECT_LT(blue, 0.75 * white);
  }
}

TEST(ZonePlate, WidensItsReachWhereNothingIs) {
  // All in one spot: every pixel is that of the nearest sample, at little cost.
  PointSet points = random_points(1, 1, 20000, 5);
  for (std::size_t i = 0; i < points.size(); ++i)
    points.set(i, {0.2 + 1e-3 * points[i].x, 0.2 + 1e-3 * points[i].y, 0});
  const ZonePlateOptions options{60, 0.5, 0.5};
  const ZonePlate image = zone_plate(points, options, Control(2));
  for (const std::size_t i : {0u, 30u * 60, 60u * 60 - 1})
    EXPECT_NEAR(
        image.pixels[i],
        brute_pixel(points, options,
                    {(static_cast<double>(i % 60) + 0.5) / 60, (static_cast<double>(i / 60) + 0.5) / 60}),
        1e-9);
}

TEST(ZonePlate, IsTheSameOnAnyNumberOfThreads) {
  const PointSet points = random_points(1, 0.6, 3000, 6);
  const ZonePlate one = zone_plate(points, {}, Control(1)), many = zone_plate(points, {}, Control(5));
  EXPECT_EQ(one.pixels, many.pixels);
  EXPECT_EQ(one.rmse, many.rmse);
}

TEST(ZonePlate, LimitsItsImageWhateverTheShape) {
  const ZonePlate thin = zone_plate(random_points(0.01, 10, 500'000, 7), {}, Control(2));
  EXPECT_EQ(thin.columns, 22u);
  EXPECT_EQ(thin.rows, 22'000u);
  EXPECT_EQ(zone_plate(random_points(10, 0.01, 3, 7), {}, Control()).rows, 1u);
  expect_error(
      [] {
        zone_plate(random_points(0.01, 10, 50, 7), {200, 0.5, 0.5}, Control());
      },
      ErrorCode::invalid_parameters, "/columns", "2^24");
}

TEST(ZonePlate, RefusesWhatItCannotShow) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = -std::log(0.0);
  const PointSet points = random_points(1, 1, 10, 1);
  const auto show = [&](const ZonePlateOptions& options) {
    return [&points, options] { zone_plate(points, options, Control()); };
  };
  for (const int size : {0, -1, 4097})
    expect_error(show({size, 0.5, 0.5}), ErrorCode::invalid_parameters, "/columns");
  for (const double frequency : {-0.1, 16.1, nan, infinity})
    expect_error(show({{}, frequency, 0.5}), ErrorCode::invalid_parameters, "/frequency");
  for (const double sigma : {0.0, -1.0, 8.1, nan, infinity})
    expect_error(show({{}, 0.5, sigma}), ErrorCode::invalid_parameters, "/sigma");
  expect_error(
      [] {
        zone_plate({std::make_shared<Torus>(), {}}, {}, Control());
      },
      ErrorCode::degenerate_input, "");
  Control over;
  over.cancel();
  expect_error([&] { zone_plate(points, {}, over); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
