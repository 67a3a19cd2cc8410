#include "core/optimize/push_pull.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/lattice.h"
#include "core/optimize/capacity_step.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;
using testing::expect_laws;
using testing::mps;
using testing::random_points;

double worst_area_deviation(const PointSet& points) {
  const StarMesh mesh(points, Control());
  double worst = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) worst = std::max(worst, std::abs(area_deviation(mesh, i)));
  return worst;
}

TEST(PushPull, ReachesItsTargetsByBruteForce) {
  const std::pair<double, double> targets[] = {{.777, .70}, {.82, .72}, {.85, .67},
                                               {.87, .65},  {.88, .63}, {.90, .80}};
  for (const auto& [rho, coverage] : targets)
    for (const double height : {1.0, 3.0}) {
      SCOPED_TRACE(::testing::Message() << rho << " " << coverage << " " << height);
      const PointSet input = mps(300, 1, height);
      Control control;
      const OptimizeResult result = push_pull(input, {rho, coverage, {}, 1000}, control);
      ASSERT_EQ(result.converged, true);
      ASSERT_EQ(result.points.size(), input.size());
      const double d = hexagonal_spacing(height, input.size()), tolerance = 4e-7;
      EXPECT_GE(brute_r_f(result.points), rho * d);
      // The oracle's value is right to within the tolerance.
      EXPECT_LE(brute_r_c(result.points, tolerance), coverage * d + tolerance);
    }
}

TEST(PushPull, ReachesAreasToo) {
  for (const double area_sd : {.15, .08, .04}) {
    SCOPED_TRACE(area_sd);
    const PointSet input = mps(500, 2);
    Control control;
    const OptimizeResult result = push_pull(input, {.777, .75, area_sd, 1000}, control);
    EXPECT_EQ(result.converged, true);
    EXPECT_LE(worst_area_deviation(result.points), area_sd);
    const Spacing spacing = measure_spacing(result.points, control);
    EXPECT_LE(spacing.cell_area_sd, area_sd);
    EXPECT_GE(spacing.rho, .777);
    EXPECT_LE(spacing.coverage, .75);
  }
}

TEST(PushPull, KeepsAreasThatAreWithinReachWhenThoseAskedForAreNot) {
  Control control;
  const OptimizeResult result = push_pull(mps(400, 3), {.87, .65, .005, 1000}, control);
  EXPECT_EQ(result.converged, false);
  EXPECT_LE(worst_area_deviation(result.points), .03);
}

TEST(PushPull, ReturnsWhatHoldsItsTargetsBitForBit) {
  Control control;
  const PointSet lattice = triangular_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 800, control);
  const OptimizeResult result = push_pull(lattice, {.999, .578, .001, 10}, control);
  EXPECT_EQ(result.converged, true);
  EXPECT_EQ(result.sweeps, 0);
  EXPECT_EQ(result.points.coordinates, lattice.coordinates);
}

TEST(PushPull, KeepsTheBestStateWhenItsTargetsAreOutOfReach) {
  const PointSet input = mps(400, 3);
  for (const int sweeps : {1, 3, 10, 100}) {
    Control control;
    const OptimizeResult result = push_pull(input, {.99, .58, {}, sweeps}, control);
    EXPECT_EQ(result.converged, false);
    EXPECT_EQ(result.sweeps, sweeps);
    expect_laws(input, result);
  }
}

TEST(PushPull, IsNeverWorseThanItsInputThoughItsTargetsMayBe) {
  const PointSet input = mps(400, 4);
  Control control;
  const OptimizeResult even = push_pull(input, {.85, .68, {}, 500}, control);
  ASSERT_EQ(even.converged, true);
  for (const PushPullOptions& loose : {PushPullOptions{.89, 10, {}, 1000}, {.5, .64, {}, 1000}}) {
    const OptimizeResult result = push_pull(even.points, loose, control);
    EXPECT_EQ(result.converged, true);
    EXPECT_LE(measure_spacing(result.points, control).beta, measure_spacing(even.points, control).beta);
  }
}

TEST(PushPull, WinsWhatItCanWhereTargetsAreOutOfReach) {
  const PushPullOptions hard[] = {{.99, .58, {}, 600}, {.87, .65, .001, 600}};
  for (const PushPullOptions& options : hard) {
    const PointSet input = mps(1000, 5);
    Control control;
    const OptimizeResult result = push_pull(input, options, control);
    EXPECT_EQ(result.converged, false);
    expect_laws(input, result);
    EXPECT_LT(measure_spacing(result.points, control).beta, .75);
  }
}

TEST(PushPull, WorksOnLatticesAndWhiteNoise) {
  Control control;
  for (const PointSet& input :
       {square_lattice(std::make_shared<Torus>(), 400, control), random_points(1, 1, 500, 1),
        random_points(3, 1, 300, 2), mps(20, 5), mps(50, 6)})
    expect_laws(input, push_pull(input, {.85, .68, {}, 300}, control));
}

TEST(PushPull, RefusesWhatCannotBe) {
  const PointSet input = mps(100, 1);
  const auto refused = [&](const PushPullOptions& options, ErrorCode code, const std::string& where,
                           const std::string& part = "") {
    Control control;
    expect_error([&] { push_pull(input, options, control); }, code, where, part);
  };
  const double nan = std::nan("");
  refused({1.001, .65, {}, 10}, ErrorCode::infeasible, "/rho", "at most 1");
  refused({.87, .577, {}, 10}, ErrorCode::infeasible, "/coverage", "0.57735");
  refused({0, .65, {}, 10}, ErrorCode::invalid_parameters, "/rho");
  refused({nan, .65, {}, 10}, ErrorCode::invalid_parameters, "/rho");
  refused({.87, nan, {}, 10}, ErrorCode::invalid_parameters, "/coverage");
  refused({.87, .65, 0.0, 10}, ErrorCode::invalid_parameters, "/area_sd");
  refused({.87, .65, nan, 10}, ErrorCode::invalid_parameters, "/area_sd");
  refused({.87, .65, {}, 0}, ErrorCode::invalid_parameters, "/max_sweeps");
  Control control;
  expect_error([&] { push_pull(random_points(1, 1, 10, 1), {}, control); }, ErrorCode::degenerate_input, "",
               "20 points");
}

TEST(PushPull, GivesTheSameBytesOnAnyNumberOfThreads) {
  testing::expect_same_on_threads([](const PointSet& points, Control& control) {
    return push_pull(points, {.87, .65, .1, 50}, control);
  });
}

TEST(PushPull, ReportsMonotoneProgressAndCanBeCancelled) {
  testing::expect_watchable([](const PointSet& points, Control& control) {
    return push_pull(points, {.99, .58, {}, 50}, control);
  });
}

TEST(CapacityStep, BringsACellNearerToTheMean) {
  const PointSet input = mps(300, 7);
  StarMesh mesh(input, Control());
  int corrected = 0, better = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const double before = std::abs(area_deviation(mesh, i));
    if (!capacity_step(mesh, i, .1)) {
      EXPECT_LE(before, .1);
      continue;
    }
    ++corrected;
    better += std::abs(area_deviation(mesh, i)) < .5 * before ? 1 : 0;
  }
  EXPECT_GT(corrected, 20);
  EXPECT_EQ(better, corrected);
  EXPECT_TRUE(mesh.is_positive());
}

}  // namespace
}  // namespace wellspaced
