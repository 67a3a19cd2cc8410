#include "core/optimize/opt_beta.h"

#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "core/analyze/periodogram.h"
#include "core/analyze/spacing.h"
#include "core/analyze/spectrum.h"
#include "core/generate/generate.h"
#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/optimize/push_pull.h"
#include "tests/support/oracle.h"
#include "tests/support/vector_widths.h"

namespace wellspaced {
namespace {

using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;
using testing::random_points;
using Randomness = OptBetaOptions::Randomness;

PointSet mps(std::uint64_t count, std::uint64_t seed, double height = 1) {
  Rng rng(seed);
  Control control;
  return poisson_disk(std::make_shared<Torus>(1, height), {poisson_disk_radius(height, count)}, rng, control);
}

OptBetaOptions to(double beta, Randomness randomness = Randomness::gentle) { return {beta, randomness, {}}; }

TEST(OptBeta, ReachesItsTargetByBruteForce) {
  for (const double beta : {0.9, 0.788, 0.747, 0.70})
    for (const Randomness randomness : {Randomness::gentle, Randomness::fast}) {
      SCOPED_TRACE(beta);
      const PointSet input = mps(300, 1);
      Control control;
      const OptimizeResult result = opt_beta(input, to(beta, randomness), control);
      ASSERT_EQ(result.converged, true);
      ASSERT_EQ(result.points.size(), input.size());
      const double tolerance = 4e-7;  // so that this proves r_c <= beta r_f
      EXPECT_LE((brute_r_c(result.points, tolerance) + tolerance) / brute_r_f(result.points), beta);
      EXPECT_NEAR(result.history.back().beta, measure_spacing(result.points, control).beta, 1e-6);
    }
}

TEST(OptBeta, ReachesSeventyHundredthsOnManySizesAndTori) {
  Control control;
  for (const std::uint64_t count : {50, 100, 400, 2000})
    for (const double height : {1.0, 2.5})
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(::testing::Message() << count << " points, height " << height << ", seed " << seed);
        const OptimizeResult result = opt_beta(mps(count, seed, height), to(0.70), control);
        EXPECT_EQ(result.converged, true);
        EXPECT_LE(measure_spacing(result.points, control).beta, 0.70);
      }
}

TEST(OptBeta, GentlyReachesItsTargetFromTwentyPointsOn) {
  Control control;
  for (const std::uint64_t count : {20, 22, 25, 30, 40})
    for (const double beta : {0.70, 0.705, 0.71, 0.72, 0.735, 0.75})
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(::testing::Message() << count << " points to " << beta << ", seed " << seed);
        const PointSet input = mps(count, seed);
        if (input.size() < 20) continue;  // too few for a mesh
        const OptimizeResult result = opt_beta(input, to(beta), control);
        EXPECT_EQ(result.converged, true);
        EXPECT_LE(measure_spacing(result.points, control).beta, beta);
      }
}

TEST(OptBeta, LeavesACalmerSpectrumWhereGentle) {
  Control control(2);
  const auto swing = [&](const PointSet& points) {
    return oscillations(spectrum(periodogram(points, 360, control))).value();
  };
  const PointSet input = mps(3000, 6);
  const double before = swing(input);
  for (const auto& [beta, most] : {std::pair{0.85, before}, {0.788, 2.1}, {0.747, 2.5}, {0.716, 2.85}}) {
    const double gentle = swing(opt_beta(input, to(beta), control).points);
    EXPECT_LT(gentle, most) << beta;
    EXPECT_LT(gentle, swing(opt_beta(input, to(beta, Randomness::fast), control).points)) << beta;
  }
}

TEST(OptBeta, DescendsBelowTheFieldsFloor) {
  Control control;
  const OptimizeResult result = opt_beta(mps(1000, 3), to(0.68), control);
  EXPECT_EQ(result.converged, true);
  EXPECT_LE(measure_spacing(result.points, control).beta, 0.68);
}

TEST(OptBeta, RipensWhatIsStuckOnTheWayDown) {
  Control control;
  for (const std::size_t n : {30u, 100u, 1000u}) {
    const OptimizeResult result = opt_beta(mps(n, 3), to(0.667), control);
    EXPECT_EQ(result.converged, true) << n;
    EXPECT_LE(measure_spacing(result.points, control).beta, 0.667) << n;
  }
}

TEST(OptBeta, LoosensLatticesWhosePushesAndPullsCancel) {
  Control control;
  const auto torus = std::make_shared<Torus>();
  for (const std::uint64_t n : {44u, 284u, 2900u})
    for (const PointSet& lattice : {square_lattice(torus, n, control), hexagonal_lattice(torus, n, control)})
      for (const auto randomness : {OptBetaOptions::Randomness::gentle, OptBetaOptions::Randomness::fast}) {
        const OptimizeResult result = opt_beta(lattice, {0.70, randomness, {}}, control);
        EXPECT_EQ(result.converged, true) << n;
        EXPECT_LE(measure_spacing(result.points, control).beta, 0.70) << n;
      }
}

TEST(OptBeta, SpreadsClustersOverTheirDomain) {
  Control control;
  for (const double side : {.1, .03, .01})
    for (const std::size_t n : {60u, 200u}) {
      PointSet cluster = random_points(1, 1, n, 60);
      for (double& c : cluster.coordinates) c = .4 + side * c;
      const OptimizeResult result = opt_beta(cluster, to(0.80), control);
      EXPECT_EQ(result.converged, true) << n << " points in " << side;
      EXPECT_LE(measure_spacing(result.points, control).beta, 0.80) << n << " points in " << side;
    }
}

TEST(OptBeta, DoesNotLeaveTightPairsAmongOtherPoints) {
  Control control;
  PointSet points = mps(400, 5);
  for (std::size_t i = 0; i < 40; ++i) {  // pairs as near as 1e-6
    const Vec3 p = points[10 * i];
    points.push_back({wrap(p.x + 1e-6 * static_cast<double>(1 + i), 1), p.y, 0});
  }
  for (const double beta : {0.8, 0.7}) {
    const OptimizeResult result = opt_beta(points, to(beta), control);
    EXPECT_EQ(result.converged, true);
    EXPECT_LE(measure_spacing(result.points, control).beta, beta);
  }
  const OptimizeResult pushed = push_pull(points, {.8, .68, {}, 2000}, control);
  EXPECT_EQ(pushed.converged, true);
}

TEST(OptBeta, KeepsTheBestStateWhenItsVisitsRunOut) {
  const PointSet input = mps(500, 2);
  Control control;
  for (const int visits : {1, 3, 10, 100}) {
    const OptimizeResult result = opt_beta(input, {0.58, Randomness::fast, visits}, control);
    EXPECT_EQ(result.converged, false);
    double best = std::numeric_limits<double>::infinity();
    for (const SweepRecord& s : result.history) best = std::min(best, s.beta);
    EXPECT_NEAR(measure_spacing(result.points, control).beta, best, 1e-6) << visits;
    EXPECT_LE(best, result.history.front().beta);
  }
}

TEST(OptBeta, LeavesAloneWhatIsGoodEnough) {
  Control control;
  const PointSet lattice = triangular_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 800, control);
  const OptimizeResult result = opt_beta(lattice, to(0.6), control);
  EXPECT_EQ(result.converged, true);
  EXPECT_EQ(result.sweeps, 0);
  EXPECT_EQ(result.points.coordinates, lattice.coordinates);
}

TEST(OptBeta, ImprovesACocircularLattice) {
  Control control;
  const PointSet lattice = square_lattice(std::make_shared<Torus>(), 400, control);
  const OptimizeResult result = opt_beta(lattice, to(0.70), control);
  EXPECT_EQ(result.converged, true);
  EXPECT_LE(measure_spacing(result.points, control).beta, 0.70);
}

TEST(OptBeta, IsNeverWorseThanItsInput) {
  Control control;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PointSet start = random_points(1, 1, 200, seed);
    try {
      const OptimizeResult result = opt_beta(start, {0.75, Randomness::gentle, 40}, control);
      EXPECT_LE(measure_spacing(result.points, control).beta, measure_spacing(start, control).beta);
      for (std::size_t i = 0; i < start.size(); ++i)
        EXPECT_FALSE(start.domain->why_outside(result.points[i]));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::degenerate_input) << error.what();
    }
  }
}

TEST(OptBeta, TakesSetsThatAMeshCanNotHold) {
  struct Case {
    PointSet input;
    double reached;
  };
  PointSet wheel = random_points(1, 1, 160, 7);
  for (int k = 0; k < 40; ++k)
    wheel.push_back({0.5 + 0.2 * std::cos(k * 0.157 + 0.01), 0.5 + 0.2 * std::sin(k * 0.157 + 0.01), 0});
  for (const auto& [input, reached] : {Case{mps(7, 1), 0.9}, Case{random_points(1, 1, 15, 2), 0.9},
                                       Case{random_points(20, 0.1, 60, 3), 0.95}, Case{wheel, 0.75}}) {
    Control control;
    const OptimizeResult result = opt_beta(input, to(0.75), control);
    EXPECT_EQ(result.points.size(), input.size());
    const double beta = measure_spacing(result.points, control).beta;
    EXPECT_LE(beta, reached);
    EXPECT_EQ(result.converged, beta <= 0.75);
    for (std::size_t k = 1; k < result.history.size(); ++k)
      EXPECT_GT(result.history[k].sweep, result.history[k - 1].sweep);
    EXPECT_EQ(result.history.back().sweep, result.sweeps);
  }
}

TEST(OptBeta, EvensOutWhiteNoise) {
  for (const std::size_t n : {500u, 20000u}) {
    Control control(2);
    const OptimizeResult result = opt_beta(random_points(1, 1, n, 3), to(0.75), control);
    EXPECT_EQ(result.converged, true) << n;
  }
}

TEST(OptBeta, KeepsPointsThatViolateNothing) {
  const PointSet input = mps(2000, 4);
  Control control;
  const OptimizeResult result = opt_beta(input, to(0.95), control);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < input.size(); ++i) kept += result.points[i] == input[i] ? 1 : 0;
  EXPECT_EQ(result.converged, true);
  EXPECT_GT(kept, input.size() / 20);
  EXPECT_LT(kept, input.size());
}

TEST(OptBeta, GivesTheSameBytesOnAnyNumberOfThreadsAndAnyVectorWidth) {
  const PointSet input = mps(30000, 5);  // enough that threads share a sweep
  const auto run = [&](unsigned threads) {
    Control control(threads);
    return opt_beta(input, {0.75, Randomness::fast, 30}, control).points.coordinates;
  };
  const std::vector<double> one = run(1);
  for (const unsigned threads : {2u, 3u, 8u}) EXPECT_EQ(run(threads), one) << threads;
  testing::on_every_vector_width([&](const std::string& name) { EXPECT_EQ(run(2), one) << name; });
}

TEST(OptBeta, ReportsMonotoneProgress) {
  struct Watch final : Control {
    void on_progress(const Progress& p) override {
      EXPECT_GE(p.fraction, last);
      EXPECT_LE(p.fraction, 1);
      last = p.fraction;
      ++reports;
    }
    double last = 0;
    int reports = 0;
  } watch;
  opt_beta(mps(200, 5), {0.6, Randomness::fast, 300}, watch);
  EXPECT_GT(watch.reports, 5);
}

TEST(OptBeta, RefusesWhatCannotBe) {
  const PointSet input = mps(100, 1);
  Control control;
  expect_error([&] { opt_beta(input, to(0.5), control); }, ErrorCode::infeasible, "/beta", "0.57735");
  expect_error([&] { opt_beta(input, to(1), control); }, ErrorCode::invalid_parameters, "/beta");
  expect_error([&] { opt_beta(input, to(std::nan("")), control); }, ErrorCode::infeasible, "/beta");
  const OptBetaOptions idle{0.8, Randomness::fast, 0};
  expect_error([&] { opt_beta(input, idle, control); }, ErrorCode::invalid_parameters, "/max_visits");
  expect_error([&] { opt_beta(random_points(1, 1, 2, 1), to(0.8), control); }, ErrorCode::degenerate_input,
               "");
}

TEST(OptBeta, CanBeCancelled) {
  const PointSet input = mps(1000, 1);
  struct CancelAtFirstReport final : Control {
    void on_progress(const Progress&) override { cancel(); }
  } control;
  expect_error([&] { opt_beta(input, to(0.6), control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
