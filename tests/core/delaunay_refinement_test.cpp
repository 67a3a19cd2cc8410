#include "core/generate/delaunay_refinement.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;

PointSet refined(double width, double height, double radius) {
  Control control;
  return delaunay_refinement(std::make_shared<Torus>(width, height), radius, control);
}

TEST(DelaunayRefinement, KeepsBothRadiiOnEveryTorus) {
  struct Case {
    double width, height, radius;
  };
  for (const Case& c : {Case{1, 1, 0.7071}, Case{1, 1, 0.6}, Case{1, 1, 0.5}, Case{1, 1, 0.11},
                        Case{1, 1, 0.03}, Case{4, 0.5, 0.06}, Case{1, 0.05, 0.03}, Case{0.01, 1, 0.05},
                        Case{1000, 1, 400}, Case{1000, 1, 3}, Case{300, 200, 11}}) {
    SCOPED_TRACE(::testing::Message() << c.width << " x " << c.height << ", r " << c.radius);
    const PointSet points = refined(c.width, c.height, c.radius);
    ASSERT_GE(points.size(), 2u);
    EXPECT_GE(brute_r_f(points), c.radius * (1 - 1e-9));
    EXPECT_LE(brute_r_c(points, 1e-3 * c.radius), c.radius * (1 + 1e-3));
    if (points.size() < 3) continue;
    const Spacing s = measure_spacing(points, Control());
    EXPECT_LE(s.r_c, c.radius * (1 + 1e-9));
    if (c.radius > std::min(c.width, c.height)) continue;  // a point's own images may then be nearer
    EXPECT_GE(s.angle_min_deg, 30 - 1e-6);
  }
}

TEST(DelaunayRefinement, GivesExactlyTheCountWithBetaAtMostOneOnEveryTorus) {
  for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{0.5, 3.0}, std::pair{20.0, 0.02}})
    for (std::uint64_t count = 1; count <= 200; count += count < 40 ? 1 : 37) {
      SCOPED_TRACE(::testing::Message() << width << " x " << height << ", count " << count);
      Control control;
      const PointSet points =
          delaunay_refinement_of_count(std::make_shared<Torus>(width, height), count, control);
      ASSERT_EQ(points.size(), count);
      if (count < 2) continue;
      const double r_f = brute_r_f(points);
      EXPECT_LE(brute_r_c(points, 1e-3 * r_f), r_f * (1 + 1e-3));
      if (count < 3) continue;
      EXPECT_LE(measure_spacing(points, control).beta, 1 + 1e-9);
    }
}

TEST(DelaunayRefinement, GivesAsManyPointsAsExpectedAndNoLattice) {
  const PointSet points = refined(1, 1, 0.008);
  const Spacing s = measure_spacing(points, Control(2));
  EXPECT_NEAR(static_cast<double>(s.n), delaunay_refinement_count(1, 0.008), 0.02 * static_cast<double>(s.n));
  EXPECT_GT(s.beta, 0.99);
  EXPECT_NEAR(s.beta_i_mean, 0.82, 0.02);
}

TEST(DelaunayRefinement, GoesRowByRow) {
  const double radius = 0.02;
  const PointSet points = refined(1, 1, radius);
  double highest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(points[i].y, highest - radius / std::sqrt(2.0)) << i;
    highest = std::max(highest, points[i].y);
  }
}

TEST(DelaunayRefinement, RefusesRadiiThatLeaveNoRoom) {
  expect_error([] { refined(1, 1, 0.71); }, ErrorCode::infeasible, "/radius", "0.707");
  expect_error([] { refined(1, 1, 0); }, ErrorCode::invalid_parameters, "/radius");
}

TEST(DelaunayRefinement, CanBeCancelled) {
  Control control;
  control.cancel();
  expect_error([&] { delaunay_refinement(std::make_shared<Torus>(), 0.01, control); }, ErrorCode::cancelled,
               "");
}

}  // namespace
}  // namespace wellspaced
