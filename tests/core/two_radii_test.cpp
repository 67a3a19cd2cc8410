#include "core/generate/two_radii.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;

PointSet make(double width, double height, const TwoRadiiOptions& options, std::uint64_t seed) {
  Rng rng(seed);
  Control control;
  return two_radii(std::make_shared<Torus>(width, height), options, rng, control);
}

TEST(TwoRadii, KeepBothOfTheirGuaranteesOnEveryTorus) {
  struct Case {
    double width, height, radius;
  };
  for (const Case& c : {Case{1, 1, 0.7}, Case{1, 1, 0.4}, Case{1, 1, 0.1}, Case{1, 1, 0.03},
                        Case{4, 0.5, 0.06}, Case{1, 0.05, 0.03}, Case{0.01, 1, 0.05}, Case{300, 200, 11}})
    for (const double beta : {1.0001, 1.2, 1.5, 2.0})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        SCOPED_TRACE(::testing::Message() << c.width << " x " << c.height << ", r " << c.radius << ", beta "
                                          << beta << ", seed " << seed);
        const PointSet points = make(c.width, c.height, {c.radius, beta}, seed);
        ASSERT_GE(points.size(), 1u);
        EXPECT_GE(brute_r_f(points), c.radius);
        EXPECT_LE(brute_r_c(points, 1e-3 * c.radius), beta * c.radius * (1 + 1e-3));
        if (points.size() < 3) continue;
        EXPECT_LE(measure_spacing(points, Control()).r_c, beta * c.radius * (1 + 1e-9));
      }
}

TEST(TwoRadii, AreNearlyReachedAndGiveAsManyPointsAsExpected) {
  for (const double beta : {1.1, 1.5, 2.0}) {
    const TwoRadiiOptions options{0.01, beta};
    const PointSet points = make(1, 1, options, 1);
    const Spacing s = measure_spacing(points, Control(2));
    EXPECT_LT(s.r_f, 0.01 * 1.01);
    EXPECT_GT(s.beta, 0.98 * beta);
    const auto n = static_cast<double>(points.size());
    EXPECT_NEAR(two_radii_count(1, options), n, 0.03 * n);
  }
}

TEST(TwoRadii, AreMoreRandomThanOne) {
  double before = 0;
  for (const double beta : {1.01, 1.3, 1.6, 2.0}) {
    const double mean = measure_spacing(make(1, 1, {0.01, beta}, 1), Control(2)).beta_i_mean;
    EXPECT_GT(mean, before) << beta;
    before = mean;
  }
}

TEST(TwoRadiiOfCount, HaveExactlyThatCountAndTheirBetaOnEveryTorus) {
  for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{3.0, 0.5}, std::pair{0.02, 20.0}})
    for (const std::uint64_t count : {1, 2, 3, 4, 7, 30, 400, 3000})
      for (const double beta : {1.001, 1.5, 2.0}) {
        SCOPED_TRACE(::testing::Message()
                     << width << " x " << height << ", count " << count << ", beta " << beta);
        Rng rng(count);
        Control control;
        const PointSet points =
            two_radii_of_count(std::make_shared<Torus>(width, height), count, {0, beta}, rng, control);
        ASSERT_EQ(points.size(), count);
        if (count < 3) continue;
        EXPECT_LE(measure_spacing(points, control).beta, beta * (1 + 1e-9));
        if (count > 400) continue;
        const double r_f = brute_r_f(points);
        EXPECT_LE(brute_r_c(points, 1e-3 * r_f), beta * r_f * (1 + 1e-3));
      }
}

TEST(TwoRadii, RefuseWhatIsNoRadiusOrNoRatio) {
  expect_error([] { make(1, 1, {0.71, 1.5}, 1); }, ErrorCode::infeasible, "/radius", "0.707");
  expect_error([] { make(1, 1, {0, 1.5}, 1); }, ErrorCode::invalid_parameters, "/radius");
  for (const double beta : {1.0, 0.5, 2.01, std::nan("")})
    expect_error([&] { make(1, 1, {0.1, beta}, 1); }, ErrorCode::invalid_parameters, "/beta", "poisson-disk");
}

TEST(TwoRadii, CanBeCancelled) {
  Rng rng(1);
  Control control;
  control.cancel();
  expect_error(
      [&] {
        two_radii(std::make_shared<Torus>(), {0.01, 1.5}, rng, control);
      },
      ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
