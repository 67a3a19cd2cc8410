#include "core/analyze/differential.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/sizing.h"
#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/math.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::expect_error;
using testing::random_points;

const double density_of_hexagons = 2 / std::sqrt(3.0);

std::vector<double> constant(std::size_t n, double radius = 1) { return std::vector<double>(n, radius); }

std::vector<double> random_radii(std::size_t n, double ratio, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<double> radii(n);
  for (double& r : radii) r = std::pow(ratio, rng.uniform());
  return radii;
}

/// All differences of ordered pairs, with all images that can matter, from the definition.
std::vector<Vec2> brute_differences(const PointSet& points, const std::vector<double>& radii, double reach) {
  const Vec3 sides = points.domain->box().size;
  const auto n = static_cast<double>(points.size());
  double squares = 0;
  for (const double r : radii) squares += r * r / n;
  const double r_ref = std::sqrt(std::sqrt(3.0) / 2 * n * squares / points.domain->area());
  const double most = reach * *std::max_element(radii.begin(), radii.end()) / r_ref;
  const int across = static_cast<int>(most / sides.x) + 2, up = static_cast<int>(most / sides.y) + 2;
  std::vector<Vec2> all;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j)
      for (int x = -across; x <= across && i != j; ++x)
        for (int y = -up; y <= up; ++y) {
          const Vec2 offset{points[j].x - points[i].x + x * sides.x, points[j].y - points[i].y + y * sides.y};
          const Vec2 d = 2 * r_ref / (radii[i] + radii[j]) * offset;
          if (std::max(std::fabs(d.x), std::fabs(d.y)) <= reach) all.push_back(d);
        }
  return all;
}

double brute_density(const std::vector<Vec2>& differences, Vec2 q, double sigma, std::size_t n) {
  double sum = 0;
  for (const Vec2 d : differences) sum += std::exp(-norm2(q - d) / (2 * sigma * sigma));
  return sum / (2 * pi * sigma * sigma) / (static_cast<double>(n - 1) * density_of_hexagons);
}

/// Mean over the rings around r, of width `width`.
double mean_around(const DifferentialDomain& domain, double r, double width) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < domain.r.size(); ++k)
    if (std::fabs(domain.r[k] - r) <= width / 2) {
      sum += domain.r[k] * domain.mean[k];
      count += domain.r[k];
    }
  return sum / count;
}

PointSet poisson(double width, double height, std::uint64_t n, std::uint64_t seed) {
  Rng rng(seed);
  Control control(2);
  return poisson_disk_of_count(std::make_shared<Torus>(width, height), n, rng, control);
}

TEST(DifferentialDomain, AgreesWithASumOverAllPairs) {
  for (const double height : {1.0, 0.1})
    for (const std::size_t n : {2u, 3u, 40u})
      for (const double ratio : {1.0, 3.0, 1000.0})
        for (const DifferentialOptions& options :
             {DifferentialOptions{2.5, 33, 0.2}, DifferentialOptions{4, 21, 0.05},
              DifferentialOptions{1, 201, 0.25}}) {
          const PointSet points = random_points(1.3, 1.3 * height, n, n);
          const std::vector<double> radii = random_radii(n, ratio, n);
          const DifferentialDomain found = differential_domain(points, radii, options, Control(2));
          const auto differences = brute_differences(points, radii, options.reach + 7 * options.sigma);
          const double height_of_a_kernel =
              1 / (2 * pi * options.sigma * options.sigma * static_cast<double>(n - 1) * density_of_hexagons);
          const int middle = options.pixels / 2, stride = std::max(1, options.pixels / 20);
          for (int row = middle % stride; row < options.pixels; row += stride)
            for (int column = middle % stride; column < options.pixels; column += stride) {
              const double step = 2 * options.reach / options.pixels;
              const Vec2 q{(column - middle) * step, (row - middle) * step};
              const double wanted = brute_density(differences, q, options.sigma, n);
              // Half a percent of a kernel's height; many pairs have different shares of that.
              EXPECT_NEAR(found.at(column, row), wanted, 0.005 * std::max(height_of_a_kernel, wanted))
                  << n << " " << ratio << " " << q.x << " " << q.y;
            }
        }
}

TEST(DifferentialDomain, HasAKernelOfItsWeightMeanAndVariance) {
  const double sigma = 0.04, step = 2.0 / 81, d_hex = hexagonal_spacing(1, 2);
  const int sets = 500;
  double weight = 0, spread = 0;
  Vec2 shift;
  Rng rng(9);
  for (int s = 0; s < sets; ++s) {
    // More than 12 sigma from -d, and from images of both.
    const double angle = 2 * pi * rng.uniform(), length = 0.38 + 0.04 * rng.uniform();
    const Vec2 d{length * std::cos(angle), length * std::sin(angle)};
    PointSet points{std::make_shared<Torus>(), {0.5, 0.5, 0.5 + d.x * d_hex, 0.5 + d.y * d_hex}};
    const DifferentialDomain found = differential_domain(points, constant(2), {1, 81, sigma}, Control());
    for (int row = 0; row < 81; ++row)
      for (int column = 0; column < 81; ++column) {
        const Vec2 away = Vec2{(column - 40) * step, (row - 40) * step} - d;
        if (norm(away) > 6.2 * sigma) continue;
        const double share = found.at(column, row) * step * step * density_of_hexagons / sets;
        weight += share;
        shift = shift + share * away;
        spread += share * norm2(away) / (2 * sigma * sigma);
      }
  }
  EXPECT_NEAR(weight, 1, 1e-6);
  EXPECT_NEAR(norm(shift), 0, 1e-4 * sigma);
  EXPECT_NEAR(spread, 1, 5e-4);
}

TEST(DifferentialDomain, OfEqualRadiiIsThePairCorrelation) {
  const PointSet points = poisson(1, 1, 1500, 1);
  const DifferentialDomain found =
      differential_domain(points, constant(1500, 0.37), {4, 401, 0.02}, Control(2));
  const double d_hex = hexagonal_spacing(1, 1500), width = 0.1;
  std::vector<double> pairs(50);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j) {
      const double r = points.domain->distance(points[i], points[j]) / d_hex;
      if (i != j && r < 4) ++pairs[static_cast<std::size_t>(r / width)];
    }
  for (std::size_t bin = 1; bin < 38; ++bin) {
    const double r = (static_cast<double>(bin) + 0.5) * width;
    const double g = pairs[bin] / (1499 * density_of_hexagons * 2 * pi * r * width);
    if (std::fabs(r - 0.8) < 0.11) continue;  // the hole's edge: the kernel and the rings carry it over
    EXPECT_NEAR(mean_around(found, r, width), g, 0.04 + 0.05 * g) << r;
  }
  EXPECT_LT(mean_around(found, 0.4, 0.5), 1e-6);
}

TEST(DifferentialDomain, OfWhiteNoiseIsOneInEveryDirection) {
  std::vector<DifferentialDomain> sets;
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    sets.push_back(differential_domain(random_points(1, 0.5, 1000, seed), constant(1000), {}, Control(2)));
  const DifferentialDomain mean = average(sets);
  EXPECT_EQ(mean.n, 1000);
  EXPECT_EQ(mean.sets, 5);
  ASSERT_EQ(mean.r.size(), 129u);
  const double pixel = 1 / std::sqrt(5 * 1000 * density_of_hexagons * 4 * pi * 0.05 * 0.05);
  for (std::size_t k = 10; k < mean.r.size(); ++k) {
    const double pairs = 5 * 1000 * density_of_hexagons * 2 * pi * mean.r[k] * 2 * std::sqrt(pi) * 0.05 / 2;
    EXPECT_NEAR(mean.mean[k], 1, 5 / std::sqrt(pairs)) << k;
    EXPECT_NEAR(mean.anisotropy_db[k], 20 * std::log10(pixel), 5) << k;
  }
  for (const double density : mean.density) EXPECT_NEAR(density, 1, 7 * pixel);
}

TEST(DifferentialDomain, OfWhiteNoiseThatFollowsItsRadiiIsOne) {
  const auto radius = [](Vec3 p) { return 1 + 0.5 * std::cos(2 * pi * p.x); };  // smooth on the torus
  const std::size_t n = 4000;
  std::vector<DifferentialDomain> sets;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    PointSet points{std::make_shared<Torus>(), {}};
    std::vector<double> radii;
    Rng rng(seed);
    while (points.size() < n) {
      const Vec3 p = points.domain->random_point(rng);
      if (rng.uniform() * radius(p) * radius(p) > 0.25) continue;  // the smallest radius is .5
      points.push_back(p);
      radii.push_back(radius(p));
    }
    sets.push_back(differential_domain(points, radii, {}, Control(2)));
  }
  const DifferentialDomain mean = average(sets);
  for (std::size_t k = 5; k < mean.r.size(); ++k) {
    const double pairs = 3 * n * density_of_hexagons * 2 * pi * mean.r[k] * 2 * std::sqrt(pi) * 0.05 / 2;
    EXPECT_NEAR(mean.mean[k], 1, 5 / std::sqrt(pairs) + 0.02) << k;
  }
}

/// exp maps a torus of circumference 2 pi to a ring, radii growing as the distance from its center, 500 to 1.
TEST(DifferentialDomain, SeesThroughAConformalMap) {
  const std::size_t n = 6000;
  const double height = 2 * pi, length = std::log(500.0);
  const PointSet flat = poisson(length, height, n, 2);
  const double outer = 500, side = 3 * outer;
  PointSet warped{std::make_shared<Torus>(side, side), {}};
  std::vector<double> radii;
  for (std::size_t i = 0; i < n; ++i) {
    const double scale = std::exp(flat[i].x);
    warped.push_back({side / 2 + scale * std::cos(flat[i].y), side / 2 + scale * std::sin(flat[i].y), 0});
    radii.push_back(scale);
  }
  // The ring fills a part of its torus only: what lies in it appears that much denser, and smaller.
  const double part = pi * (outer * outer - 1) / (side * side), shrunk = std::sqrt(part);
  const DifferentialDomain before = differential_domain(flat, constant(n), {4, 161, 0.05}, Control(2));
  const DifferentialDomain after =
      differential_domain(warped, radii, {4 * shrunk, 161, 0.05 * shrunk}, Control(2));
  double peak = 0;
  for (std::size_t k = 8; k < 81; ++k) {
    // Rings at the ends lack what would lie beyond.
    const double r = before.r[k], lost = 2 * r * hexagonal_spacing(length * height, n) / (pi * length);
    EXPECT_NEAR(part * after.mean[k], before.mean[k] * (1 - lost), 0.06) << r;
    peak = std::max(peak, before.mean[k]);
  }
  EXPECT_GT(peak, 1.5);
  EXPECT_LT(part * mean_around(after, 0.35 * shrunk, 0.3 * shrunk), 1e-3);
}

TEST(DifferentialDomain, OfALatticeHasItsNeighborsAtDistanceOne) {
  Control control;
  const PointSet lattice =
      triangular_lattice(std::make_shared<Torus>(std::sqrt(3.0), 1), 2 * 20 * 20, control);
  const double sigma = 0.05;
  const DifferentialDomain found = differential_domain(lattice, constant(800), {2, 201, sigma}, control);
  double sum = 0;  // over the disk in which the six nearest lie
  const int middle = 100;
  const double step = 4.0 / 201;
  for (int row = 0; row < 201; ++row)
    for (int column = 0; column < 201; ++column)
      if (norm(Vec2{(column - middle) * step, (row - middle) * step}) < 1.36)
        sum += found.at(column, row) * step * step;
  EXPECT_NEAR(sum * density_of_hexagons * 799 / 800, 6, 1e-3);
  const auto ring = static_cast<std::size_t>(std::lround(1 / step));
  const auto highest = std::max_element(found.mean.begin(), found.mean.begin() + 70) - found.mean.begin();
  EXPECT_NEAR(found.r[static_cast<std::size_t>(highest)], 1, 1.01 * step);
  EXPECT_GT(found.anisotropy_db[ring], 5);
  EXPECT_EQ(found.mean[5], 0);
  EXPECT_TRUE(std::isnan(found.anisotropy_db[5]));
  EXPECT_TRUE(std::isnan(found.anisotropy_db[0]));
}

TEST(DifferentialDomain, IsSymmetric) {
  const DifferentialDomain found =
      differential_domain(random_points(1, 1, 60, 3), random_radii(60, 5, 3), {3, 41, 0.1}, Control());
  for (int row = 0; row < 41; ++row)
    for (int column = 0; column < 41; ++column)
      EXPECT_EQ(found.at(column, row), found.at(40 - column, 40 - row));
}

TEST(DifferentialDomain, DoesNotChangeWhenEqualRadiiOrPointsMoveTogether) {
  const PointSet points = random_points(1, 0.7, 300, 4);
  PointSet moved = points;
  for (std::size_t i = 0; i < points.size(); ++i)
    moved.set(i, points.domain->step(points[i], {0.377, 0.511}));
  const DifferentialDomain here = differential_domain(points, constant(300), {}, Control(2)),
                           there = differential_domain(moved, constant(300, 1e-9), {}, Control(2));
  const double kernel = 1 / (2 * pi * 0.05 * 0.05 * 299 * density_of_hexagons);
  for (std::size_t i = 0; i < here.density.size(); ++i)
    EXPECT_NEAR(there.density[i], here.density[i], 0.002 * kernel + 0.002 * here.density[i]);
}

TEST(DifferentialDomain, OnlyRatiosOfRadiiCountHoweverExtreme) {
  const PointSet points = random_points(1, 1, 50, 5);
  std::vector<double> radii = random_radii(50, 8, 5);
  const DifferentialDomain found = differential_domain(points, radii, {}, Control());
  for (double& r : radii) r = std::ldexp(r, 1000);
  EXPECT_EQ(differential_domain(points, radii, {}, Control()).density, found.density);
  std::fill(radii.begin(), radii.end(), 5e-324);
  radii[7] = 1e308;
  for (const double density : differential_domain(points, radii, {}, Control()).density)
    EXPECT_TRUE(std::isfinite(density));
}

TEST(DifferentialDomain, CountsPointsInOnePlace) {
  PointSet points{std::make_shared<Torus>(), {}};
  for (int i = 0; i < 20; ++i) points.push_back({0.3, 0.4, 0});
  const DifferentialDomain found = differential_domain(points, constant(20), {1, 41, 0.05}, Control());
  const double kernels = 20 * 19 / (2 * pi * 0.05 * 0.05 * 19 * density_of_hexagons);
  EXPECT_NEAR(found.at(20, 20), kernels, 0.006 * kernels);
}

TEST(DifferentialDomain, IsTheSameOnAnyNumberOfThreads) {
  const PointSet points = random_points(1, 1, 2000, 6);
  const std::vector<double> radii = random_radii(2000, 20, 6);
  const DifferentialDomain one = differential_domain(points, radii, {}, Control(1)),
                           many = differential_domain(points, radii, {}, Control(5));
  EXPECT_EQ(one.density, many.density);
  EXPECT_EQ(one.mean, many.mean);
}

TEST(DifferentialDomain, AveragesPixelByPixel) {
  std::vector<DifferentialDomain> sets;
  for (std::uint64_t seed = 0; seed < 3; ++seed)
    sets.push_back(differential_domain(random_points(1, 1, 20 + 10 * seed, seed), constant(20 + 10 * seed),
                                       {2, 31, 0.2}, Control()));
  const DifferentialDomain mean = average(sets);
  EXPECT_EQ(mean.n, 30);
  EXPECT_EQ(mean.sets, 3);
  for (std::size_t i = 0; i < mean.density.size(); ++i)
    EXPECT_NEAR(mean.density[i], (sets[0].density[i] + sets[1].density[i] + sets[2].density[i]) / 3, 1e-12);
  for (std::size_t k = 0; k < mean.mean.size(); ++k)
    EXPECT_NEAR(mean.mean[k], (sets[0].mean[k] + sets[1].mean[k] + sets[2].mean[k]) / 3, 1e-12);
  EXPECT_EQ(average({sets.data(), 1}).anisotropy_db[9], sets[0].anisotropy_db[9]);
}

TEST(DifferentialDomain, MeasuresRingsOfPixels) {
  const DifferentialDomain found =
      differential_domain(random_points(1, 1, 100, 8), constant(100), {2, 31, 0.1}, Control());
  ASSERT_EQ(found.r.size(), 16u);
  for (int ring = 0; ring < 16; ++ring) {
    std::vector<double> members;
    for (int y = -15; y <= 15; ++y)
      for (int x = -15; x <= 15; ++x)
        if ((y > 0 || (y == 0 && x >= 0)) && std::lround(std::hypot(x, y)) == ring)
          members.push_back(found.at(15 + x, 15 + y));
    double mean = 0, variance = 0;
    for (const double m : members) mean += m / static_cast<double>(members.size());
    for (const double m : members)
      variance += (m - mean) * (m - mean) / static_cast<double>(members.size() - 1);
    const auto k = static_cast<std::size_t>(ring);
    EXPECT_DOUBLE_EQ(found.r[k], ring * 4.0 / 31);
    EXPECT_NEAR(found.mean[k], mean, 1e-12);
    if (ring > 0) {
      EXPECT_NEAR(found.anisotropy_db[k], 10 * std::log10(variance / (mean * mean)), 1e-9);
    }
  }
}

TEST(DifferentialDomain, RefusesWhatItCannotMeasure) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = -std::log(0.0);
  const PointSet points = random_points(1, 1, 20, 1);
  const auto with = [&](const DifferentialOptions& options) {
    return [&points, options] { differential_domain(points, constant(20), options, Control()); };
  };
  for (const double reach : {0.9, 16.1, -1.0, nan, infinity})
    expect_error(with({reach, 257, 0.05}), ErrorCode::invalid_parameters, "/reach");
  for (const int size : {-1, 0, 1, 2, 256, 1027})
    expect_error(with({4, size, 0.05}), ErrorCode::invalid_parameters, "/pixels");
  for (const double sigma : {0.0, -1.0, 4 / 257.0, 1.01, nan, infinity})
    expect_error(with({4, 257, sigma}), ErrorCode::invalid_parameters, "/sigma");
  for (const std::size_t n : {0u, 19u, 21u})
    expect_error([&] { differential_domain(points, constant(n), {}, Control()); },
                 ErrorCode::invalid_parameters, "/radii");
  for (const double radius : {0.0, -1.0, nan, infinity}) {
    std::vector<double> radii = constant(20);
    radii[17] = radius;
    expect_error([&] { differential_domain(points, radii, {}, Control()); }, ErrorCode::invalid_parameters,
                 "/radii/17");
  }
  for (const std::size_t n : {0u, 1u})
    expect_error([&] { differential_domain(random_points(1, 1, n, 1), constant(n), {}, Control()); },
                 ErrorCode::degenerate_input, "");
  Control over;
  over.cancel();
  expect_error([&] { differential_domain(points, constant(20), {}, over); }, ErrorCode::cancelled, "");
}

TEST(DifferentialDomain, StopsSoonWhereAllPointsAreWithinReachOfEachOther) {
  PointSet points = random_points(1, 1, 100'000, 1);
  for (std::size_t i = 0; i < points.size(); ++i) points.set(i, {1e-4 * points[i].x, 1e-4 * points[i].y, 0});
  Control control;
  control.set_deadline(Control::Clock::now() + std::chrono::milliseconds(50));
  const auto start = Control::Clock::now();
  expect_error([&] { differential_domain(points, constant(points.size()), {}, control); },
               ErrorCode::deadline_exceeded, "");
  EXPECT_LT(Control::Clock::now() - start, std::chrono::seconds(10));
}

}  // namespace
}  // namespace wellspaced
