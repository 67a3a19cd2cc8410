#include "core/optimize/cvt.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_distance;
using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;
using testing::expect_laws;
using testing::mps;
using testing::random_points;
using Variant = CvtOptions::Variant;

constexpr Variant variants[] = {Variant::lloyd, Variant::accelerated};

std::vector<double> energies(const PointSet& input, CvtOptions options) {
  std::vector<double> all;
  options.on_energy = [&](int, double energy) { all.push_back(energy); };
  Control control;
  cvt(input, options, control);
  return all;
}

/// The mean of the squared distance over a fine grid, as a cell's integral in units of d_hex.
double brute_energy(const PointSet& points, int side) {
  double sum = 0;
  const Box box = points.domain->box();
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const double d =
          brute_distance(points, {(column + .5) / side * box.size.x, (row + .5) / side * box.size.y, 0});
      sum += d * d;
    }
  const double spacing = hexagonal_spacing(points.domain->area(), points.size());
  return sum / (side * side) / (spacing * spacing) * std::sqrt(3.0) / 2;
}

TEST(Cvt, TellsTheEnergyOfItsInput) {
  for (const PointSet& input : {mps(200, 1), random_points(2, 1, 100, 2)})
    EXPECT_NEAR(energies(input, {Variant::lloyd, 1})[0] / brute_energy(input, 500), 1, 1e-3);
}

TEST(Cvt, EnergyNeverRises) {
  for (const Variant variant : variants)
    for (const PointSet& input : {mps(500, 1), mps(300, 2, 3), random_points(1, 1, 500, 3)}) {
      const std::vector<double> all = energies(input, {variant, 100, 0});
      ASSERT_GT(all.size(), 50u);
      for (std::size_t k = 1; k < all.size(); ++k) EXPECT_LE(all[k], all[k - 1] * (1 + 1e-9)) << k;
    }
}

TEST(Cvt, NeedsAFractionOfLloydsSweepsWhenAccelerated) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const PointSet& input : {mps(1000, seed), random_points(1, 1, 1000, seed)})
      EXPECT_LT(energies(input, {Variant::accelerated, 50, 0}).back(),
                energies(input, {Variant::lloyd, 125, 0}).back());
}

TEST(Cvt, KeepsTheStateOfLeastBetaByBruteForce) {
  for (const Variant variant : variants) {
    const PointSet input = mps(300, 4);
    Control control;
    const OptimizeResult result = cvt(input, {variant, 100}, control);
    expect_laws(input, result);
    EXPECT_EQ(result.converged, std::nullopt);
    double best = 1e9;
    for (const SweepRecord& s : result.history) best = std::min(best, s.beta);
    EXPECT_LT(best, .9);
    EXPECT_NEAR(brute_r_c(result.points, 1e-6) / brute_r_f(result.points), best, 1e-4);
  }
}

TEST(Cvt, WorksFromAnyStart) {
  Control control;
  for (const Variant variant : variants)
    for (const PointSet& input :
         {square_lattice(std::make_shared<Torus>(), 400, control), random_points(1, 1, 500, 1),
          random_points(3, 1, 300, 2), mps(20, 5), mps(50, 6), mps(400, 7, 3)})
      expect_laws(input, cvt(input, {variant, 30}, control));
}

TEST(Cvt, ReturnsACentroidalLatticeBitForBit) {
  Control control;
  const PointSet lattice = triangular_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 800, control);
  for (const Variant variant : variants) {
    const OptimizeResult result = cvt(lattice, {variant, 100}, control);
    EXPECT_EQ(result.points.coordinates, lattice.coordinates);
    EXPECT_EQ(result.sweeps, 1);
  }
}

TEST(Cvt, EndsWhenNothingMovesFarther) {
  const PointSet input = mps(400, 8);
  Control control;
  for (const Variant variant : variants) {
    const int coarse = cvt(input, {variant, 1000, .05}, control).sweeps;
    const int fine = cvt(input, {variant, 1000, .01}, control).sweeps;
    EXPECT_LT(coarse, fine);
    EXPECT_LT(fine, 1000);
  }
}

TEST(Cvt, RefusesWhatCannotBe) {
  const PointSet input = mps(100, 1);
  Control control;
  const CvtOptions idle{Variant::lloyd, 0}, negative{Variant::lloyd, 10, -1};
  const CvtOptions nan{Variant::lloyd, 10, std::nan("")};
  expect_error([&] { cvt(input, idle, control); }, ErrorCode::invalid_parameters, "/max_sweeps");
  expect_error([&] { cvt(input, negative, control); }, ErrorCode::invalid_parameters, "/tolerance");
  expect_error([&] { cvt(input, nan, control); }, ErrorCode::invalid_parameters, "/tolerance");
  expect_error([&] { cvt(random_points(1, 1, 10, 1), {}, control); }, ErrorCode::degenerate_input, "",
               "20 points");
}

TEST(Cvt, GivesTheSameBytesOnAnyNumberOfThreads) {
  for (const Variant variant : variants)
    testing::expect_same_on_threads([&](const PointSet& points, Control& control) {
      return cvt(points, {variant, 40}, control);
    });
}

TEST(Cvt, ReportsMonotoneProgressAndCanBeCancelled) {
  for (const Variant variant : variants)
    testing::expect_watchable([&](const PointSet& points, Control& control) {
      return cvt(points, {variant, 20, 0}, control);
    });
}

}  // namespace
}  // namespace wellspaced
