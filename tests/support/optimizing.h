#pragma once

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/generate.h"
#include "core/generate/poisson_disk.h"
#include "core/optimize/optimize.h"
#include "tests/support/oracle.h"

namespace wellspaced::testing {

inline PointSet mps(std::uint64_t count, std::uint64_t seed, double height = 1) {
  Rng rng(seed);
  Control control;
  return poisson_disk(std::make_shared<Torus>(1, height), {poisson_disk_radius(height, count)}, rng, control);
}

/// What OptimizeResult promises: as many points, all in the domain, the best beta of the history, measured on
/// the points themselves, and not above the input's.
inline void expect_laws(const PointSet& input, const OptimizeResult& result) {
  const Control control;
  ASSERT_EQ(result.points.size(), input.size());
  for (std::size_t i = 0; i < input.size(); ++i)
    ASSERT_FALSE(input.domain->why_outside(result.points[i])) << i;
  ASSERT_FALSE(result.history.empty());
  EXPECT_EQ(result.history.front().sweep, 0);
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < result.history.size(); ++k) {
    best = std::min(best, result.history[k].beta);
    if (k > 0) {
      EXPECT_LT(result.history[k - 1].sweep, result.history[k].sweep);
    }
  }
  const double before = measure_spacing(input, control).beta,
               after = measure_spacing(result.points, control).beta;
  EXPECT_LE(after, before);
  EXPECT_NEAR(after, std::min(best, before), 1e-5 * after);
  EXPECT_NEAR(result.history.front().beta, before, 1e-5 * before);
}

template <class Optimize>
void expect_same_on_threads(const Optimize& optimize) {
  const PointSet input = mps(1500, 4);
  Control one(1), four(4);
  const OptimizeResult a = optimize(input, one), b = optimize(input, four);
  EXPECT_EQ(a.points.coordinates, b.points.coordinates);
  EXPECT_NE(a.points.coordinates, input.coordinates);
}

/// Progress never falls, ends at 1 where the allowance is used up, and a cancel in a report ends the work.
template <class Optimize>
void expect_watchable(const Optimize& optimize) {
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
  optimize(mps(300, 5), watch);
  EXPECT_GT(watch.reports, 5);
  EXPECT_EQ(watch.last, 1);
  struct CancelAtSecondReport final : Control {
    void on_progress(const Progress&) override {
      if (++reports == 2) cancel();
    }
    int reports = 0;
  } cancelled;
  expect_error([&] { optimize(mps(300, 5), cancelled); }, ErrorCode::cancelled, "");
  EXPECT_EQ(cancelled.reports, 2);
}

}  // namespace wellspaced::testing
