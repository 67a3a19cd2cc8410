#include "core/analyze/discrepancy.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::expect_error;
using testing::mps;
using testing::random_points;

PointSet unit_points(std::vector<double> coordinates) {
  return {std::make_shared<Torus>(), std::move(coordinates)};
}

/// Coordinates that are all multiples of 1/steps: many coincide, some are 0.
PointSet coarse_points(std::size_t n, int steps, std::uint64_t seed) {
  PointSet points = random_points(1, 1, n, seed);
  for (double& c : points.coordinates) c = std::floor(c * steps) / steps;
  return points;
}

PointSet grid(int k, double offset) {
  PointSet points{std::make_shared<Torus>(), {}};
  for (int i = 0; i < k; ++i)
    for (int j = 0; j < k; ++j) points.push_back({(i + offset) / k, (j + offset) / k, 0});
  return points;
}

/// (i / n, i step / n): a rank-1 lattice.
PointSet rank_1_lattice(std::uint64_t n, std::uint64_t step) {
  PointSet points{std::make_shared<Torus>(), {}};
  const auto part = [n](std::uint64_t i) { return static_cast<double>(i % n) / static_cast<double>(n); };
  for (std::uint64_t i = 0; i < n; ++i) points.push_back({part(i), part(i * step), 0});
  return points;
}

/// Every box with a side at a sample's coordinate or at 1, every sample.
double brute_star(const PointSet& points) {
  std::vector<double> xs = {1}, ys = {1};
  for (std::size_t i = 0; i < points.size(); ++i) {
    xs.push_back(points[i].x);
    ys.push_back(points[i].y);
  }
  const auto n = static_cast<double>(points.size());
  double star = 0;
  for (const double x : xs)
    for (const double y : ys) {
      double open = 0, closed = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        open += points[i].x < x && points[i].y < y;
        closed += points[i].x <= x && points[i].y <= y;
      }
      star = std::max({star, x * y - open / n, closed / n - x * y});
    }
  return star;
}

/// The same in O(n^2): a row of counts, one for each y, while x passes over the samples.
double star_by_rows(const PointSet& points) {
  const std::size_t n = points.size();
  std::vector<Vec2> order;
  std::vector<double> ys = {1};
  for (std::size_t i = 0; i < n; ++i) {
    order.push_back({points[i].x, points[i].y});
    ys.push_back(points[i].y);
  }
  std::sort(order.begin(), order.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
  std::vector<double> open(ys.size()), closed(ys.size());
  double star = 0;
  for (std::size_t i = 0, next; i <= n; i = next + (i == n)) {
    const double x = i < n ? order[i].x : 1;
    for (std::size_t k = 0; k < ys.size(); ++k)
      star = std::max(star, x * ys[k] - open[k] / static_cast<double>(n));
    for (next = i; next < n && order[next].x == x; ++next)
      for (std::size_t k = 0; k < ys.size(); ++k) {
        open[k] += order[next].y < ys[k];
        closed[k] += order[next].y <= ys[k];
      }
    for (std::size_t k = 0; k < ys.size(); ++k)
      star = std::max(star, closed[k] / static_cast<double>(n) - x * ys[k]);
  }
  return star;
}

/// Warnock's sum over all pairs.
double brute_l2_star2(const PointSet& points) {
  const auto n = static_cast<long double>(points.size());
  long double single = 0, pairs = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const long double x = points[i].x, y = points[i].y;
    single += (1 - x * x) * (1 - y * y);
    for (std::size_t j = 0; j < points.size(); ++j)
      pairs += (1 - std::max<long double>(x, points[j].x)) * (1 - std::max<long double>(y, points[j].y));
  }
  return static_cast<double>(1 / 9.0L - single / (2 * n) + pairs / (n * n));
}

/// Hickernell's sum over all pairs.
double brute_l2_periodic2(const PointSet& points) {
  const auto n = static_cast<long double>(points.size());
  const auto factor = [](long double a, long double b) {
    const long double d = std::abs(a - b);
    return 1.5L - d * (1 - d);
  };
  long double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    long double row = 0;  // summed apart: less is rounded away
    for (std::size_t j = 0; j < points.size(); ++j)
      row += factor(points[i].x, points[j].x) * factor(points[i].y, points[j].y);
    sum += row;
  }
  return static_cast<double>(sum / (n * n) - 16 / 9.0L);
}

void expect_brute(const PointSet& points) {
  const Discrepancy d = discrepancy(points, Control());
  EXPECT_NEAR(d.star, points.size() <= 60 ? brute_star(points) : star_by_rows(points), 1e-15);
  EXPECT_NEAR(d.l2_star * d.l2_star, brute_l2_star2(points), 1e-16);
  EXPECT_NEAR(d.l2_periodic * d.l2_periodic, brute_l2_periodic2(points), 1e-16);
}

TEST(Discrepancy, AgreesWithAllBoxesAndAllPairs) {
  for (std::uint64_t seed = 0; seed < 60; ++seed)
    for (const std::size_t n : {1u, 2u, 3u, 4u, 5u, 8u, 17u, 40u}) {
      SCOPED_TRACE(::testing::Message() << "n " << n << ", seed " << seed);
      expect_brute(random_points(1, 1, n, seed));
      for (const int steps : {1, 2, 3, 7, 64}) expect_brute(coarse_points(n, steps, seed));
    }
}

TEST(Discrepancy, OfLargerSetsAgreesWithAllRowsAndAllPairs) {
  for (std::uint64_t seed : {1u, 2u}) {
    expect_brute(random_points(1, 1, 2000, seed));
    expect_brute(coarse_points(2000, 300, seed));
  }
  expect_brute(mps(1500, 3));
  expect_brute(rank_1_lattice(1597, 987));
  expect_brute(grid(32, 0));
  PointSet diagonal = unit_points({});
  for (int i = 0; i < 1000; ++i) diagonal.push_back({i / 1000.0, i / 1000.0, 0});
  expect_brute(diagonal);
  for (std::size_t i = 0; i < 1000; ++i) diagonal.set(i, {diagonal[i].x, 0.999 - diagonal[i].x, 0});
  expect_brute(diagonal);
  PointSet corner = random_points(1, 1, 1000, 5);
  for (double& c : corner.coordinates) c = c < 0.5 ? c * 1e-9 : 1 - c * 1e-9;
  expect_brute(corner);
}

TEST(Discrepancy, OfOnePointHasItsClosedForm) {
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.25, 0.5}, {0.9, 0.1}, {0.0, 0.75}}) {
    const Discrepancy d = discrepancy(unit_points({x, y}), Control());
    EXPECT_EQ(d.star, std::max({x, y, 1 - x * y}));
    EXPECT_NEAR(d.l2_star * d.l2_star, 1 / 9.0 - (1 - x * x) * (1 - y * y) / 2 + (1 - x) * (1 - y), 1e-16);
    EXPECT_NEAR(d.l2_periodic * d.l2_periodic, 2.25 - 16 / 9.0, 1e-15);
  }
}

TEST(Discrepancy, OfGridsHasItsClosedForms) {
  for (const int k : {1, 2, 3, 10, 64, 100}) {
    SCOPED_TRACE(k);
    const double side = 1.0 / k, e = side * side / 12;
    const Discrepancy centered = discrepancy(grid(k, 0.5), Control());
    EXPECT_NEAR(centered.star, side - side * side / 4, 1e-15);
    EXPECT_NEAR(centered.l2_star, std::sqrt(2 * e / 3 + 3.5 * e * e), 1e-13);
    EXPECT_NEAR(centered.l2_periodic, std::sqrt(4 * side * side / 9 + std::pow(side, 4) / 36), 1e-13);
    const Discrepancy cornered = discrepancy(grid(k, 0), Control());
    EXPECT_NEAR(cornered.star, 1 - (1 - side) * (1 - side), 1e-15);
    EXPECT_NEAR(cornered.l2_periodic, centered.l2_periodic, 1e-13);
  }
}

TEST(Discrepancy, IsWhatScipyFinds) {
  // scipy 1.10.1, qmc.discrepancy(P, method="WD"), a square, and method="L2-star", which is none.
  const Discrepancy few = discrepancy(
      unit_points({0.0, 0.0, 0.125, 0.75, 0.3, 0.3, 0.3, 0.9, 0.55, 0.1, 0.7, 0.625, 0.95, 0.5}), Control());
  EXPECT_NEAR(few.l2_periodic * few.l2_periodic, 0.025357506023242715, 1e-15);
  EXPECT_NEAR(few.l2_star, 0.1054011627839708, 1e-15);
  // k = np.arange(1000); P = np.stack([(k + 0.5) / 1000, (k * 377 % 1000) / 1000], axis=1)
  PointSet lattice = unit_points({});
  for (int k = 0; k < 1000; ++k) lattice.push_back({(k + 0.5) / 1000, (k * 377 % 1000) / 1000.0, 0});
  const Discrepancy many = discrepancy(lattice, Control());
  EXPECT_NEAR(many.l2_periodic * many.l2_periodic, 1.2389540295920654e-06, 1e-12);
  EXPECT_NEAR(many.l2_periodic * many.l2_periodic, 1.2389539222222223e-06, 1e-18)
      << "the sum over pairs in Python's fractions";
  EXPECT_NEAR(many.l2_star, 0.001132518465013209, 1e-12);
}

TEST(Discrepancy, KeepsItsDigitsWhereSumsCancel) {
  // Of a rank-1 lattice every sample sees the same: the sum over pairs is one over samples.
  constexpr std::uint64_t n = 28657, step = 17711;  // Fibonacci numbers
  const auto b = [](std::uint64_t i) {
    const long double t = static_cast<long double>(i % n) / n;
    return t * t - t + 1 / 6.0L;
  };
  long double sum = 0;
  for (std::uint64_t i = 0; i < n; ++i) sum += 4 / 3.0L * (b(i) + b(i * step)) + b(i) * b(i * step);
  const auto wanted = static_cast<double>(sum / n);
  ASSERT_LT(wanted, 1e-8);
  const Discrepancy d = discrepancy(rank_1_lattice(n, step), Control());
  EXPECT_NEAR(d.l2_periodic * d.l2_periodic, wanted, 1e-8 * wanted);
}

TEST(Discrepancy, WrapsAroundTheTorus) {
  const PointSet points = random_points(1, 1, 500, 3);
  const double unmoved = discrepancy(points, Control()).l2_periodic;
  for (const Vec2 shift : {Vec2{0.3071, 0}, Vec2{0, 0.8123}, Vec2{0.5, 0.25}}) {
    PointSet moved = points;
    for (std::size_t i = 0; i < points.size(); ++i) moved.set(i, points.domain->step(points[i], shift));
    EXPECT_NEAR(discrepancy(moved, Control()).l2_periodic, unmoved, 1e-12);
  }
}

TEST(Discrepancy, DividesByTheSidesOfTheTorus) {
  const PointSet points = random_points(1, 1, 300, 3);
  PointSet stretched{std::make_shared<Torus>(64, 0.25), {}};  // powers of two: exact
  for (std::size_t i = 0; i < points.size(); ++i)
    stretched.push_back({points[i].x * 64, points[i].y * 0.25, 0});
  const Discrepancy a = discrepancy(points, Control()), b = discrepancy(stretched, Control());
  EXPECT_EQ(a.star, b.star);
  EXPECT_EQ(a.l2_star, b.l2_star);
  EXPECT_EQ(a.l2_periodic, b.l2_periodic);
}

TEST(Discrepancy, DoesNotMindTheOrderOrTheAxes) {
  const PointSet points = random_points(1, 1, 400, 4);
  PointSet backwards = points, swapped = points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    backwards.set(i, points[points.size() - 1 - i]);
    swapped.set(i, {points[i].y, points[i].x, 0});
  }
  const Discrepancy a = discrepancy(points, Control());
  for (const PointSet& other : {backwards, swapped}) {
    const Discrepancy b = discrepancy(other, Control());
    EXPECT_NEAR(a.star, b.star, 1e-15);
    EXPECT_NEAR(a.l2_star, b.l2_star, 1e-13);
    EXPECT_NEAR(a.l2_periodic, b.l2_periodic, 1e-13);
  }
}

TEST(Discrepancy, OfWhiteNoiseIsWhatProbabilitySays) {
  constexpr std::size_t n = 200;
  constexpr int sets = 300;
  double star2 = 0, periodic2 = 0;
  for (std::uint64_t seed = 0; seed < sets; ++seed) {
    const Discrepancy d = discrepancy(random_points(1, 1, n, seed), Control());
    star2 += d.l2_star * d.l2_star / sets;
    periodic2 += d.l2_periodic * d.l2_periodic / sets;
    EXPECT_LE(d.l2_star, d.star);
  }
  EXPECT_NEAR(star2 * n, 1 / 4.0 - 1 / 9.0, 0.02);
  EXPECT_NEAR(periodic2 * n, 9 / 4.0 - 16 / 9.0, 0.02);
}

TEST(Discrepancy, OfWellSpacedSetsIsBelowWhiteNoise) {
  for (std::uint64_t seed : {1u, 2u, 3u}) {
    const PointSet spaced = mps(4000, seed);
    const Discrepancy d = discrepancy(spaced, Control());
    const Discrepancy white = discrepancy(random_points(1, 1, spaced.size(), seed), Control());
    EXPECT_LT(d.star, 0.8 * white.star);
    EXPECT_LT(d.l2_star, 0.6 * white.l2_star);
    EXPECT_LT(d.l2_periodic, 0.6 * white.l2_periodic);
  }
}

TEST(Discrepancy, OfManyPointsIsQuickWhateverTheyAre) {
  constexpr std::size_t n = 20000;
  PointSet up = unit_points({}), down = unit_points({});
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / n;
    up.push_back({t, t * t, 0});
    down.push_back({t, (1 - t) * (1 - t) * 0.9999, 0});
  }
  const auto start = std::chrono::steady_clock::now();
  for (const PointSet& points :
       {random_points(1, 1, n, 1), rank_1_lattice(n, 7639), grid(141, 0.5), up, down})
    EXPECT_LT(discrepancy(points, Control()).star, 0.5);
  // Quadratic work would take minutes under a sanitizer.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Discrepancy, IsTheSameOnAnyNumberOfThreads) {
  const PointSet points = random_points(1, 1, 5000, 3);
  const Discrepancy one = discrepancy(points, Control(1));
  for (unsigned threads : {2u, 3u, 8u}) {
    const Discrepancy many = discrepancy(points, Control(threads));
    EXPECT_EQ(one.star, many.star);
    EXPECT_EQ(one.l2_star, many.l2_star);
    EXPECT_EQ(one.l2_periodic, many.l2_periodic);
  }
}

TEST(Discrepancy, RefusesNoPoints) {
  expect_error([] { discrepancy(unit_points({}), Control()); }, ErrorCode::degenerate_input, "");
}

TEST(Discrepancy, CanBeCancelled) {
  Control control(2);
  control.cancel();
  expect_error([&] { discrepancy(random_points(1, 1, 5000, 3), control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
