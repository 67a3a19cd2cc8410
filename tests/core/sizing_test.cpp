#include "core/domain/sizing.h"

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/torus.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::expect_error;

const double not_radii[] = {0, -0.0, -1, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()};

TEST(ConstantSizing, IsTheSameEverywhere) {
  const ConstantSizing sizing(0.25);
  EXPECT_EQ(sizing.type(), "constant");
  EXPECT_EQ(sizing.at({0, 0, 0}), 0.25);
  EXPECT_EQ(sizing.at({0.9, 0.3, 0}), 0.25);
  EXPECT_EQ(sizing.lipschitz(), 0);
}

TEST(ConstantSizing, RefusesWhatIsNoRadius) {
  for (const double radius : not_radii)
    expect_error([&] { ConstantSizing sizing(radius); }, ErrorCode::invalid_parameters, "/radius");
}

TEST(LinearSizing, GoesFromOneSideToTheOther) {
  const Torus torus(2, 0.5);
  const LinearSizing along_x(torus, {0, 0.1, 0.5}), along_y(torus, {1, 0.3, 0.1});
  EXPECT_EQ(along_x.type(), "linear");
  EXPECT_EQ(along_x.at({0, 0.3, 0}), 0.1);
  EXPECT_DOUBLE_EQ(along_x.at({1, 0.3, 0}), 0.3);
  EXPECT_NEAR(along_x.at({std::nextafter(2.0, 0.0), 0, 0}), 0.5, 1e-15);
  EXPECT_DOUBLE_EQ(along_x.lipschitz(), 0.2);
  EXPECT_EQ(along_y.at({1.5, 0, 0}), 0.3);
  EXPECT_DOUBLE_EQ(along_y.at({1.5, 0.125, 0}), 0.25);
  EXPECT_DOUBLE_EQ(along_y.lipschitz(), 0.4);
}

TEST(LinearSizing, ChangesByNoMoreThanItsLipschitzConstantInside) {
  const Torus torus(3, 2);
  const LinearSizing sizing(torus, {1, 0.7, 0.01});
  Rng rng(1);
  double steepest = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 p = torus.random_point(rng), q = torus.random_point(rng);
    const double slope = std::fabs(sizing.at(p) - sizing.at(q)) / norm(p - q);
    EXPECT_LE(slope, sizing.lipschitz() * (1 + 1e-9));
    steepest = std::max(steepest, slope);
  }
  EXPECT_GT(steepest, 0.99 * sizing.lipschitz());
}

TEST(LinearSizing, JumpsAtTheSeamOfATorus) {
  const LinearSizing sizing(Torus(1, 1), {0, 0.1, 0.5});
  EXPECT_NEAR(sizing.at({1 - 1e-12, 0, 0}) - sizing.at({0, 0, 0}), 0.4, 1e-9);
}

TEST(LinearSizing, StaysBetweenItsEndsWhateverRoundingDoes) {
  for (const double from : {1e-100, 1e-3, 1.0, 1e100})
    for (const double to : {1e-100, 0.3, 1.0, 1e100}) {
      const LinearSizing sizing(Torus(0.3, 1), {0, from, to});
      for (const double x : {0.0, 1e-300, 0.1, 0.15, std::nextafter(0.3, 0.0)}) {
        EXPECT_GE(sizing.at({x, 0, 0}), std::min(from, to));
        EXPECT_LE(sizing.at({x, 0, 0}), std::max(from, to));
      }
    }
}

TEST(LinearSizing, RefusesWhatIsNoRadiusOrAxis) {
  const Torus torus;
  for (const double radius : not_radii) {
    expect_error([&] { LinearSizing(torus, {0, radius, 1}); }, ErrorCode::invalid_parameters, "/from");
    expect_error([&] { LinearSizing(torus, {0, 1, radius}); }, ErrorCode::invalid_parameters, "/to");
  }
  for (const int axis : {-1, 2})
    expect_error([&] { LinearSizing(torus, {axis, 1, 1}); }, ErrorCode::invalid_parameters, "/axis");
}

}  // namespace
}  // namespace wellspaced
