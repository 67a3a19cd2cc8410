#include "core/domain/torus.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::expect_error;

TEST(Wrap, StaysHalfOpenWhereRoundingWouldReachThePeriod) {
  EXPECT_EQ(wrap(-1e-20, 1), 0);
  EXPECT_EQ(wrap(1, 1), 0);
  EXPECT_EQ(wrap(std::nextafter(1.0, 0.0), 1), std::nextafter(1.0, 0.0));
  EXPECT_DOUBLE_EQ(wrap(-0.25, 1), 0.75);
  EXPECT_DOUBLE_EQ(wrap(7.5, 2), 1.5);
  for (double x : {-5e300, -1.0 / 3, -1e-300, 1e300})
    for (double period : {1.0, 0.3, 1e-6, 1e6}) {
      EXPECT_GE(wrap(x, period), 0) << x << " " << period;
      EXPECT_LT(wrap(x, period), period) << x << " " << period;
    }
}

TEST(Torus, RefusesSidesThatAreNoSides) {
  for (double side : {0.0, -1.0, 1e7, 1e-7, std::nan(""), std::numeric_limits<double>::infinity()}) {
    expect_error([&] { Torus(side, 1); }, ErrorCode::invalid_parameters, "/width");
    expect_error([&] { Torus(1, side); }, ErrorCode::invalid_parameters, "/height");
  }
  expect_error([] { Torus(1, 1001); }, ErrorCode::invalid_parameters, "/height", "1000 times");
}

TEST(Torus, MeasuresDistanceAroundTheSeam) {
  const Torus torus(2, 1);
  EXPECT_NEAR(torus.distance({0.1, 0.9, 0}, {1.9, 0.1, 0}), std::hypot(0.2, 0.2), 1e-15);
  EXPECT_DOUBLE_EQ(torus.distance({0, 0, 0}, {1, 0.5, 0}), std::hypot(1, 0.5));
}

TEST(Torus, IsHalfOpen) {
  const Torus torus(2, 1);
  EXPECT_FALSE(torus.why_outside({0, 0, 0}));
  EXPECT_TRUE(torus.why_outside({2, 0, 0}));
  EXPECT_TRUE(torus.why_outside({0, 1, 0}));
  EXPECT_TRUE(torus.why_outside({-1e-300, 0, 0}));
}

TEST(Torus, StepsAndRandomPointsStayInside) {
  const Torus torus(0.3, 7);
  Rng rng(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = torus.random_point(rng);
    EXPECT_FALSE(torus.why_outside(p));
    EXPECT_FALSE(torus.why_outside(torus.step(p, {rng.uniform() * 20 - 10, rng.uniform() * 20 - 10})));
  }
}

TEST(RequireUsable, NamesThePointThatCannotBeUsed) {
  PointSet points{std::make_shared<Torus>(), {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}};
  EXPECT_NO_THROW(require_usable(points, Control()));
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < points.coordinates.size(); ++k) {
    const std::string row = "/" + std::to_string(k / 2);
    PointSet bad = points;
    for (double value : {nan, infinity, -infinity}) {
      bad.coordinates[k] = value;
      expect_error([&] { require_usable(bad, Control()); }, ErrorCode::invalid_parameters,
                   row + "/" + std::to_string(k % 2));
    }
    bad.coordinates[k] = 1.0;
    expect_error([&] { require_usable(bad, Control()); }, ErrorCode::invalid_parameters, row, "half-open");
  }
}

TEST(RequireUsable, RefusesFewerThanThreePointsAndRepetitions) {
  PointSet two{std::make_shared<Torus>(), {0.1, 0.2, 0.3, 0.4}};
  expect_error([&] { require_usable(two, Control()); }, ErrorCode::degenerate_input, "", "at least 3");
  PointSet repeated{std::make_shared<Torus>(), {0.1, 0.2, 0.3, 0.4, 0.5, 0.5, 0.1, 0.2}};
  expect_error([&] { require_usable(repeated, Control()); }, ErrorCode::degenerate_input, "/3",
               "repeats point 0");
  PointSet signed_zero{std::make_shared<Torus>(), {0.0, 0.2, 0.3, 0.4, -0.0, 0.2}};
  expect_error([&] { require_usable(signed_zero, Control()); }, ErrorCode::degenerate_input, "/2");
}

TEST(RequireUsable, StopsWhenItIsCancelled) {
  const PointSet points = testing::random_points(1, 1, 20000, 1);
  Control control;
  control.cancel();
  testing::expect_error([&] { require_usable(points, control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
