#include "core/generate/lattice.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/jittered.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_distance;
using testing::brute_r_f;
using testing::expect_error;

using MakeLattice = PointSet (*)(const std::shared_ptr<const Torus>&, std::uint64_t, Control&);

PointSet make(MakeLattice lattice, double width, double height, std::uint64_t count) {
  Control control;
  return lattice(std::make_shared<Torus>(width, height), count, control);
}

/// Every sublattice of that many points, by its definition: all a * d = count, 0 <= b < d.
std::vector<PointSet> all_lattices(double width, double height, std::uint64_t count) {
  std::vector<PointSet> all;
  for (std::uint64_t d = 1; d <= count; ++d) {
    if (count % d != 0) continue;
    for (std::uint64_t b = 0; b < d; ++b) {
      PointSet points{std::make_shared<Torus>(width, height), {}};
      for (std::uint64_t j = 0; j < d; ++j)
        for (std::uint64_t i = 0; i < count / d; ++i)
          points.push_back({width * static_cast<double>((i * d + j * b) % count) / static_cast<double>(count),
                            height * static_cast<double>(j) / static_cast<double>(d), 0});
      all.push_back(std::move(points));
    }
  }
  return all;
}

TEST(Lattices, AreClosedUnderAddition) {
  for (const MakeLattice lattice : {triangular_lattice, square_lattice})
    for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{3.0, 0.5}, std::pair{0.01, 8.0}})
      for (const std::uint64_t count : {1, 2, 3, 17, 36, 97, 120}) {
        const PointSet points = make(lattice, width, height, count);
        ASSERT_EQ(points.size(), count);
        EXPECT_EQ(points[0], Vec3{});
        for (std::size_t i = 0; i < count; ++i)
          for (std::size_t j = 0; j <= i; ++j) {
            const Vec3 sum = points.domain->step(points[i], {points[j].x, points[j].y});
            ASSERT_LT(brute_distance(points, sum), 1e-12) << i << " + " << j << " of " << count;
          }
      }
}

TEST(Lattices, AreTheBestOfAll) {
  const Control control;
  for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{1.0, 0.37}})
    for (const std::uint64_t count : {12, 23, 60}) {
      double beta = INFINITY;
      for (const PointSet& points : all_lattices(width, height, count))
        beta = std::min(beta, measure_spacing(points, control).beta);
      const double best = measure_spacing(make(triangular_lattice, width, height, count), control).beta;
      EXPECT_NEAR(best, beta, 0.01) << count << ": the least stretched one has about the least beta";
      const double square = measure_spacing(make(square_lattice, width, height, count), control).beta;
      EXPECT_LT(std::fabs(square - std::sqrt(0.5)), 0.15) << count;
    }
}

TEST(Lattices, AreExactWhereTheyFitTheTorus) {
  const Control control;
  const double height = std::sqrt(3.0);
  for (const std::uint64_t k : {2, 5, 20, 71}) {
    const auto beta = [&](MakeLattice lattice, double h, std::uint64_t count) {
      return measure_spacing(make(lattice, 1, h, count), control).beta;
    };
    EXPECT_NEAR(beta(triangular_lattice, height, 2 * k * k), 1 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(beta(square_lattice, 1, k * k), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(beta(hexagonal_lattice, height, 4 * k * k), 1, 1e-12);
    EXPECT_NEAR(beta(square_lattice, 1, 25 * k * k), std::sqrt(0.5), 1e-12);
  }
  EXPECT_NEAR(measure_spacing(make(square_lattice, 1, 1, 5), control).beta, std::sqrt(0.5), 1e-12)
      << "a slanted square lattice, along (2, 1) / 5";
}

TEST(Lattices, AreStretchedLittleWhenTheyDoNotFit) {
  const Control control;
  for (const std::uint64_t count : {9998, 10000, 10007 * 2}) {
    EXPECT_LT(measure_spacing(make(triangular_lattice, 1, 1, count), control).beta, 0.585);
    EXPECT_NEAR(measure_spacing(make(square_lattice, 1, 1, count), control).beta, std::sqrt(0.5), 0.01);
    EXPECT_LT(measure_spacing(make(hexagonal_lattice, 1, 1, count), control).beta, 1.01);
  }
}

TEST(Lattices, GoRowByRow) {
  for (const std::uint64_t count : {96, 97, 100}) {
    const PointSet points = make(triangular_lattice, 1, 1, count);
    for (std::size_t i = 1; i < points.size(); ++i)
      EXPECT_TRUE(points[i].y > points[i - 1].y ||
                  (points[i].y == points[i - 1].y && points[i].x > points[i - 1].x));
  }
}

TEST(HexagonalLattice, PutsEachPointAtEqualDistanceFromThree) {
  const PointSet points = make(hexagonal_lattice, 1, std::sqrt(3.0), 400);
  const double side = brute_r_f(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    int near = 0;
    for (std::size_t j = 0; j < points.size(); ++j)
      near += i != j && points.domain->distance(points[i], points[j]) < side * (1 + 1e-9);
    ASSERT_EQ(near, 3) << i;
  }
}

TEST(HexagonalLattice, RefusesOddCountsAndNamesTheEvenOnesBesideThem) {
  expect_error([] { make(hexagonal_lattice, 1, 1, 101); }, ErrorCode::infeasible, "/count", "100 or 102");
}

TEST(Lattices, CanBeCancelled) {
  Control control;
  control.cancel();
  const auto torus = std::make_shared<Torus>();
  expect_error([&] { triangular_lattice(torus, 1000, control); }, ErrorCode::cancelled, "");
}

TEST(Jittered, HasOnePointInEachOfItsStrataOfEqualArea) {
  for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{3.0, 0.5}, std::pair{0.01, 8.0}})
    for (const std::uint64_t count : {1, 2, 3, 7, 97, 1000, 1023}) {
      SCOPED_TRACE(::testing::Message() << count << " on " << width << " x " << height);
      Rng rng(1);
      Control control;
      const PointSet points = jittered(std::make_shared<Torus>(width, height), count, rng, control);
      ASSERT_EQ(points.size(), count);
      const auto n = static_cast<double>(count);
      const double rows = std::clamp(std::round(std::sqrt(n * height / width)), 1.0, n);
      std::size_t i = 0;
      for (double row = 1; row <= rows; ++row) {
        const std::size_t begin = i;
        const auto end = static_cast<std::size_t>(std::floor(row * n / rows + 1e-9));
        const auto columns = static_cast<double>(end - begin);
        for (; i < end; ++i) {
          const auto column = static_cast<double>(i - begin);
          EXPECT_GE(points[i].y, height * static_cast<double>(begin) / n * (1 - 1e-12));
          EXPECT_LE(points[i].y, height * static_cast<double>(end) / n * (1 + 1e-12));
          EXPECT_GE(points[i].x, width * column / columns * (1 - 1e-12));
          EXPECT_LE(points[i].x, width * (column + 1) / columns * (1 + 1e-12));
        }
      }
      EXPECT_EQ(i, count);
    }
}

}  // namespace
}  // namespace wellspaced
