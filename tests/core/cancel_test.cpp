// Every method of the registry answers a cancel soon, on sets that make single steps long.
#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/registry.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using Clock = Control::Clock;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::chrono::milliseconds allowed{10'000};
#else
constexpr std::chrono::milliseconds allowed{1'000};
#endif

/// A point with 20,000 neighbors.
PointSet wheel() {
  constexpr int n = 20'000;
  PointSet points{std::make_shared<Torus>(1, 1), {}};
  points.push_back({0.5, 0.5});
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::acos(-1.0) * k / n;
    points.push_back({0.5 + 0.4 * std::cos(angle), 0.5 + 0.4 * std::sin(angle)});
  }
  return points;
}

/// Lets `work` go on for `patience`: it ends by then, well or not, or the control ends it soon after.
template <class Work>
void expect_prompt(const std::string& name, Work work) {
  constexpr std::chrono::milliseconds patience{50};
  Control control(2);
  const Clock::time_point start = Clock::now();
  control.set_deadline(start + patience);
  try {
    work(control);
  } catch (const Error& error) {
    EXPECT_NE(error.code(), ErrorCode::internal) << name << ": " << error.what();
  }
  EXPECT_LT(Clock::now() - start, patience + allowed) << name;
}

TEST(Cancel, EveryOptimizerStopsSoonAmongCrowdedNeighborhoods) {
  const PointSet points = wheel();
  for (const Optimizer& optimizer : optimizers())
    expect_prompt(optimizer.name, [&](Control& control) { optimizer.run(points, {{"beta", 0.7}}, control); });
}

TEST(Cancel, EveryOptimizerStopsSoonOnAMillionPoints) {
  const PointSet points = testing::random_points(1, 1, 1'000'000, 1);
  for (const Optimizer& optimizer : optimizers())
    expect_prompt(optimizer.name, [&](Control& control) { optimizer.run(points, {{"beta", 0.7}}, control); });
}

TEST(Cancel, AnalysisStopsSoon) {
  const PointSet crowded = wheel(), many = testing::random_points(1, 1, 1'000'000, 1);
  expect_prompt("crowded", [&](Control& control) { measure_spacing(crowded, control); });
  expect_prompt("many", [&](Control& control) { measure_spacing(many, control); });
}

}  // namespace
}  // namespace wellspaced
