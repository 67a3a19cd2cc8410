#include "core/domain/polygon.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/polygons.h"

namespace wellspaced {
namespace {

using namespace testing;  // NOLINT

double triangle_area(const DomainTriangle& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]).z; }

TEST(Polygon, KnowsItsSizes) {
  const Polygon polygon(square_with_hole());
  EXPECT_EQ(polygon.type(), "polygon");
  EXPECT_EQ(polygon.dimension(), 2);
  EXPECT_DOUBLE_EQ(polygon.area(), 1 - 0.125);
  EXPECT_EQ(polygon.euler_characteristic(), 0);
  EXPECT_EQ(Polygon(l_shape()).euler_characteristic(), 1);
  EXPECT_EQ(polygon.box().size, (Vec3{1, 1, 0}));
  EXPECT_EQ(Polygon(moved(l_shape(), 1, {-3, 7})).box().low, (Vec3{-3, 7, 0}));
  EXPECT_FALSE(polygon.box().periodic[0]);
  EXPECT_EQ(polygon.distance({0, 0, 0}, {3, 4, 0}), 5);
  EXPECT_TRUE(polygon.is_flat());
}

TEST(Polygon, TakesRingsOfAnyOrientationClosedOrNot) {
  const Rings expected = Polygon(square_with_hole()).rings();
  ASSERT_EQ(expected.size(), 2u);
  EXPECT_GT(shoelace(expected[0]), 0);
  EXPECT_LT(shoelace(expected[1]), 0);
  for (int variant = 0; variant < 8; ++variant) {
    Rings rings = square_with_hole();
    if (variant & 1) std::reverse(rings[0].begin() + 1, rings[0].end());
    if (variant & 2) std::reverse(rings[1].begin() + 1, rings[1].end());
    if (variant & 4)
      for (Ring& ring : rings) ring.push_back(ring.front());
    EXPECT_EQ(Polygon(rings).rings(), expected);
  }
  EXPECT_EQ(Polygon(expected).rings(), expected);
}

TEST(Polygon, TrianglesAreThePolygonAndUseItsCornersOnly) {
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    std::size_t corners = 0;
    for (const Ring& ring : rings) corners += ring.size();
    const auto triangles = polygon.triangles();
    EXPECT_EQ(triangles.size(), corners + 2 * (rings.size() - 1) - 2);
    double area = 0;
    for (const DomainTriangle& t : triangles) {
      for (const Vec3 p : t) ASSERT_EQ(polygon.freedom(p).dimensions, 0);
      area += triangle_area(t);
    }
    EXPECT_NEAR(area, polygon.area(), 1e-12 * area);
  }
}

TEST(Polygon, RandomPointsAreInsideAndUniformByArea) {
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    Rng rng(99);
    const auto triangles = polygon.triangles();
    if (triangles.size() > 400 || name == "needle") continue;
    // Triangles joined until each group expects 20 points; points are told by the triangle they are in.
    constexpr int tries = 20000;
    std::vector<double> expected{0};
    std::vector<std::size_t> group(triangles.size());
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      if (expected.back() > 20) expected.push_back(0);
      expected.back() += tries * triangle_area(triangles[k]) / polygon.area();
      group[k] = expected.size() - 1;
    }
    std::vector<double> found(expected.size());
    for (int i = 0; i < tries; ++i) {
      const Vec3 p = polygon.random_point(rng);
      ASSERT_FALSE(polygon.why_outside(p));
      ASSERT_EQ(polygon.freedom(p).dimensions, 2);
      const auto holds = [&](const DomainTriangle& t) {
        return triangle_area({t[0], t[1], p}) >= 0 && triangle_area({t[1], t[2], p}) >= 0 &&
               triangle_area({t[2], t[0], p}) >= 0;
      };
      const auto k = std::find_if(triangles.begin(), triangles.end(), holds) - triangles.begin();
      if (k < std::ssize(triangles)) ++found[group[static_cast<std::size_t>(k)]];
    }
    double chi2 = 0;
    for (std::size_t g = 0; g < expected.size(); ++g)
      if (expected[g] > 5) chi2 += (found[g] - expected[g]) * (found[g] - expected[g]) / expected[g];
    const auto freedom = static_cast<double>(expected.size());
    EXPECT_LT(chi2, freedom + 5 * std::sqrt(2 * freedom));
  }
}

TEST(Polygon, RandomPointsAreUniformWithinATriangle) {
  const Polygon polygon({{{0, 0}, {1, 0}, {0, 1}}});
  Rng rng(5);
  int counts[4] = {};  // of four triangles of the same area
  for (int k = 0; k < 40000; ++k) {
    const Vec3 p = polygon.random_point(rng);
    ++counts[p.x > 0.5 ? 0 : p.y > 0.5 ? 1 : p.x + p.y < 0.5 ? 2 : 3];
  }
  for (const int count : counts) EXPECT_NEAR(count, 10000, 4 * std::sqrt(7500.0));
}

}  // namespace
}  // namespace wellspaced
