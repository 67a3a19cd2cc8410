#include "core/optimize/opt_beta_local.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/generate.h"
#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/optimize/nelder_mead.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;
using testing::random_points;

PointSet mps(std::uint64_t count, std::uint64_t seed, double height = 1) {
  Rng rng(seed);
  Control control(2);
  return poisson_disk(std::make_shared<Torus>(1, height), {poisson_disk_radius(height, count)}, rng, control);
}

TEST(NelderMead, FindsTheMinimumOfAParabola) {
  const auto cost = [](Vec2 u) { return (u.x - 0.3) * (u.x - 0.3) + 4 * (u.y + 0.2) * (u.y + 0.2); };
  const Trial best = nelder_mead(cost, 0.1, 60);
  EXPECT_NEAR(best.at.x, 0.3, 1e-3);
  EXPECT_NEAR(best.at.y, -0.2, 1e-3);
}

TEST(NelderMead, NeverReturnsWorseThanTheStart) {
  EXPECT_EQ(nelder_mead([](Vec2 u) { return norm2(u); }, 0.1, 10).at, (Vec2{0, 0}));
}

TEST(OptBetaLocal, ReachesItsTargetAndSaysWhatItReached) {
  const PointSet input = mps(2000, 1);
  Control control(2);
  const OptimizeResult result = opt_beta_local(input, {0.85, 100, {}}, control);
  ASSERT_EQ(result.converged, true);
  ASSERT_EQ(result.points.size(), input.size());
  const double r_f = brute_r_f(result.points), r_c = brute_r_c(result.points, 1e-5);
  EXPECT_LE(r_c / r_f, 0.85 + 1e-3);
  EXPECT_EQ(result.history.size(), static_cast<std::size_t>(result.sweeps) + 1);
  EXPECT_NEAR(result.history.back().beta, r_c / r_f, 1e-3);
  EXPECT_LE(result.history.back().beta, 0.85);
}

TEST(OptBetaLocal, KeepsTheBestStateWhenTheTargetIsOutOfReach) {
  const PointSet input = mps(500, 2);
  Control control;
  const OptimizeResult result = opt_beta_local(input, {0.58, 25, {}}, control);
  EXPECT_EQ(result.converged, false);
  EXPECT_EQ(result.sweeps, 25);
  double best = 1e9;
  for (const SweepRecord& s : result.history) best = std::min(best, s.beta);
  EXPECT_DOUBLE_EQ(measure_spacing(result.points, control).beta, best);
}

TEST(OptBetaLocal, LeavesAloneWhatIsGoodEnough) {
  Control control;
  const PointSet lattice = triangular_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 800, control);
  const OptimizeResult result = opt_beta_local(lattice, {0.6, 10, {}}, control);
  EXPECT_EQ(result.converged, true);
  EXPECT_EQ(result.sweeps, 0);
  EXPECT_EQ(result.points.coordinates, lattice.coordinates);
}

TEST(OptBetaLocal, WorksFromAnyStartOnAnyTorus) {
  Control control(2);
  const PointSet starts[] = {random_points(1, 1, 400, 1),
                             random_points(1, 1, 3, 2),
                             random_points(1, 1, 7, 3),
                             random_points(1, 0.05, 30, 4),
                             random_points(10, 0.1, 60, 5),
                             mps(300, 1, 2),
                             square_lattice(std::make_shared<Torus>(), 100, control)};
  for (const PointSet& start : starts) {
    const double before = measure_spacing(start, control).beta;
    const OptimizeResult result = opt_beta_local(start, {0.65, 15, {}}, control);
    EXPECT_LE(measure_spacing(result.points, control).beta, before);
    EXPECT_EQ(result.points.size(), start.size());
    for (std::size_t i = 0; i < start.size(); ++i) EXPECT_FALSE(start.domain->why_outside(result.points[i]));
  }
}

TEST(OptBetaLocal, GivesTheSameBytesOnAnyNumberOfThreads) {
  const PointSet input = mps(1500, 4);
  Control one(1), four(4);
  const auto a = opt_beta_local(input, {0.8, 5, {}}, one), b = opt_beta_local(input, {0.8, 5, {}}, four);
  EXPECT_EQ(a.points.coordinates, b.points.coordinates);
}

TEST(OptBetaLocal, ReportsMonotoneProgress) {
  struct Watch final : Control {
    void on_progress(const Progress& p) override {
      EXPECT_GE(p.fraction, last);
      last = p.fraction;
      ++reports;
    }
    double last = 0;
    int reports = 0;
  } watch;
  opt_beta_local(mps(200, 5), {0.58, 6, {}}, watch);
  EXPECT_EQ(watch.reports, 6);
  EXPECT_EQ(watch.last, 1);
}

TEST(OptBetaLocal, RefusesWhatCannotBe) {
  const PointSet input = mps(100, 1);
  Control control;
  expect_error(
      [&] {
        opt_beta_local(input, {0.5, 10, {}}, control);
      },
      ErrorCode::infeasible, "/beta", "0.57735");
  expect_error(
      [&] {
        opt_beta_local(input, {1.0, 10, {}}, control);
      },
      ErrorCode::invalid_parameters, "/beta");
  expect_error(
      [&] {
        opt_beta_local(input, {std::nan(""), 10, {}}, control);
      },
      ErrorCode::infeasible, "/beta");
  expect_error(
      [&] {
        opt_beta_local(input, {0.8, 0, {}}, control);
      },
      ErrorCode::invalid_parameters, "/max_sweeps");
  expect_error(
      [&] {
        opt_beta_local(input, {0.8, 10, 0.0}, control);
      },
      ErrorCode::invalid_parameters, "/damping");
  PointSet heap = random_points(1, 1, 5000, 1);
  for (double& c : heap.coordinates) c *= 1e-3;
  expect_error(
      [&] {
        opt_beta_local(heap, {0.8, 10, {}}, control);
      },
      ErrorCode::degenerate_input, "", "clustered");
  PointSet two = random_points(1, 1, 2, 1);
  expect_error([&] { opt_beta_local(two, {0.8, 10, {}}, control); }, ErrorCode::degenerate_input, "");
}

TEST(OptBetaLocal, CanBeCancelled) {
  const PointSet input = mps(1000, 1);
  struct CancelAtFirstReport final : Control {
    void on_progress(const Progress&) override { cancel(); }
  } control;
  expect_error([&] { opt_beta_local(input, {0.58, 1000, {}}, control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
