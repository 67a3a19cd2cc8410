#include "core/optimize/lbfgs.h"

#include <vector>

#include <gtest/gtest.h>

namespace wellspaced {
namespace {

constexpr std::size_t n = 20;

/// Gradient of a parabola whose curvatures spread over a factor of 100, with its minimum at 1.
std::vector<Vec2> gradient(const std::vector<Vec2>& x) {
  std::vector<Vec2> g(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double curvature = 1 + 5 * static_cast<double>(i);
    g[i] = {curvature * (x[i].x - 1), 100 / curvature * (x[i].y - 1)};
  }
  return g;
}

TEST(Lbfgs, StartsDownTheDiagonal) {
  const std::vector<Vec2> g = gradient(std::vector<Vec2>(n));
  const std::vector<double> diagonal(n, .25);
  const std::vector<Vec2> d = Lbfgs().direction(g, diagonal, Control());
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(d[i], -.25 * g[i]);
}

TEST(Lbfgs, FindsTheMinimumOfAParabola) {
  Lbfgs lbfgs;
  const std::vector<double> diagonal(n, .01);
  std::vector<Vec2> x(n), g = gradient(x);
  for (int step = 0; step < 200; ++step) {
    std::vector<Vec2> s = lbfgs.direction(g, diagonal, Control());
    ASSERT_LE(dot(s, g), 0);
    for (std::size_t i = 0; i < n; ++i) x[i] = x[i] + s[i];
    std::vector<Vec2> y = gradient(x);
    for (std::size_t i = 0; i < n; ++i) y[i] = y[i] - g[i];
    g = gradient(x);
    lbfgs.remember(std::move(s), std::move(y));
  }
  for (const Vec2 v : x) EXPECT_NEAR(norm(v - Vec2{1, 1}), 0, 1e-6);
}

TEST(Lbfgs, DoesNotRememberStepsAgainstTheCurvature) {
  Lbfgs lbfgs;
  const std::vector<Vec2> s(n, {1, 0}), against(n, {-1, 0}), across(n, {0, 1});
  lbfgs.remember(s, against);
  lbfgs.remember(s, across);
  EXPECT_FALSE(lbfgs.remembers());
  lbfgs.remember(s, s);
  EXPECT_TRUE(lbfgs.remembers());
  lbfgs.forget();
  EXPECT_FALSE(lbfgs.remembers());
}

}  // namespace
}  // namespace wellspaced
