#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/polygon.h"
#include "tests/support/exact_place.h"
#include "tests/support/polygons.h"

namespace wellspaced {
namespace {

using namespace testing;  // NOLINT

Vec2 planar(Vec3 p) { return {p.x, p.y}; }

/// The least part of the way from p to p + u that crosses the boundary; infinite if none does. Rational.
Rational first_crossing(const Rings& rings, Vec2 p, Vec2 u) {
  Rational first = 1000;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      const Rational dx = Rational(b.x) - a.x, dy = Rational(b.y) - a.y, ax = Rational(a.x) - p.x,
                     ay = Rational(a.y) - p.y;
      const Rational speed = u.x * dy - u.y * dx;
      if (speed == 0) continue;
      const Rational way = (ax * dy - ay * dx) / speed, along = (ax * u.y - ay * u.x) / speed;
      if (way >= 0 && along >= 0 && along <= 1) first = std::min(first, way);
    }
  return first;
}

TEST(PolygonMoves, OfPointsInsideEndThreeQuartersOfTheWayToTheBoundary) {
  Rng rng(1);
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    const double size = std::max(polygon.box().size.x, polygon.box().size.y);
    int cut = 0, whole = 0;
    for (int k = 0; k < (name == "star 1000" || name == "81 holes" ? 10 : 60); ++k) {
      const Vec3 p = polygon.random_point(rng);
      const Vec2 u = on_circle({0, 0}, size * std::pow(10.0, -4 * rng.uniform()), 6.28 * rng.uniform());
      const Vec2 v = polygon.possible(p, u);
      const double expected = std::min(1.0, 0.75 * static_cast<double>(first_crossing(rings, planar(p), u)));
      const double rounding = 1e-9 * norm(u) + 0x1p-48 * (std::abs(p.x) + std::abs(p.y));
      ASSERT_NEAR(norm(v), expected * norm(u), name == "needle" ? norm(u) : rounding) << p.x << " " << p.y;
      ASSERT_NEAR(cross(v, u), 0, rounding * norm(u));
      (expected < 1 ? cut : whole) += 1;
      const Vec3 q = polygon.step(p, v);
      ASSERT_FALSE(polygon.why_outside(q));
      ASSERT_EQ(polygon.freedom(q).dimensions, 2);
      ASSERT_EQ(exact_place(rings, planar(q)), "inside");
    }
    EXPECT_GT(cut, 0);
    EXPECT_GT(whole, name == "needle" ? -1 : 0);
  }
}

TEST(PolygonMoves, KeepAnywhereInsideEvenIfTooLong) {
  const Polygon polygon({star(30, 3), circle({0, 0}, 0.05, 8)});
  Rng rng(2);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 p = polygon.random_point(rng);
    const Vec3 q = polygon.step(p, {3 * rng.uniform() - 1.5, 3 * rng.uniform() - 1.5});
    ASSERT_EQ(polygon.freedom(q).dimensions, 2);
    ASSERT_FALSE(polygon.why_outside(q));
  }
  const Vec3 p = polygon.random_point(rng);
  EXPECT_EQ(polygon.step(p, {0, 0}), p);
  EXPECT_EQ(polygon.step(p, {HUGE_VAL, 0}), p);
  EXPECT_EQ(polygon.step(p, {std::nan(""), 0}), p);
}

TEST(PolygonMoves, StayOnTheirEdge) {
  Rng rng(3);
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    const auto curves = polygon.boundary();
    for (int k = 0; k < 200; ++k) {
      const std::size_t curve = rng.below(curves.size());
      const Vec3 from = polygon.boundary_point(curve, 0),
                 to = polygon.boundary_point(curve, curves[curve].length);
      Vec3 p = polygon.boundary_point(curve, curves[curve].length * rng.uniform());
      const Freedom freedom = polygon.freedom(p);
      ASSERT_EQ(freedom.dimensions, 1);
      EXPECT_NEAR(norm(freedom.along), 1, 1e-15);
      for (int moves = 0; moves < 5; ++moves) {
        const Vec2 u = curves[curve].length * Vec2{4 * rng.uniform() - 2, 4 * rng.uniform() - 2};
        const Vec2 v = polygon.possible(p, u);
        const double way = dot(u, freedom.along), room = way > 0 ? norm(to - p) : norm(p - from);
        EXPECT_NEAR(dot(v, freedom.along), std::copysign(std::min(std::abs(way), 0.75 * room), way),
                    1e-12 * norm(u));
        EXPECT_NEAR(cross(v, freedom.along), 0, 1e-15 * norm(u));
        const Vec3 q = polygon.step(p, v);
        ASSERT_EQ(polygon.freedom(q).dimensions, 1);
        ASSERT_EQ(polygon.freedom(q).along, freedom.along);
        ASSERT_TRUE(exact_on_edge(planar(from), planar(to), planar(q)));
        p = q;
      }
    }
  }
}

TEST(PolygonMoves, LeaveCornersWhereTheyAre) {
  const Polygon polygon(l_shape());
  EXPECT_EQ(polygon.freedom({1, 1, 0}).dimensions, 0);
  EXPECT_EQ(polygon.possible({1, 1, 0}, {-0.1, -0.1}), (Vec2{0, 0}));
  EXPECT_EQ(polygon.step({1, 1, 0}, {-0.1, -0.1}), (Vec3{1, 1, 0}));
}

TEST(PolygonMoves, PassAReentrantCornerButNotThroughIt) {
  const Polygon polygon(l_shape());
  EXPECT_EQ(polygon.possible({0.5, 0.5, 0}, {0.4, 0}), (Vec2{0.4, 0}));
  const Vec2 cut = polygon.possible({0.5, 1.5, 0}, {1, -1});  // through the corner itself
  EXPECT_NEAR(cut.x, 0.375, 1e-9);
  EXPECT_NEAR(cut.y, -0.375, 1e-9);
}

TEST(PolygonBoundary, IsItsEdgesInOrder) {
  const Polygon polygon(square_with_hole());
  const auto curves = polygon.boundary();
  ASSERT_EQ(curves.size(), 8u);
  EXPECT_EQ(polygon.boundary_length(), 4 + 1.5);
  EXPECT_EQ(polygon.boundary_point(0, 0), (Vec3{0, 0, 0}));
  EXPECT_EQ(polygon.boundary_point(0, 1), (Vec3{1, 0, 0}));
  EXPECT_EQ(polygon.boundary_point(3, 0.25), (Vec3{0, 0.75, 0}));
  EXPECT_EQ(polygon.boundary_point(4, 0), (Vec3{0.25, 0.25, 0}));  // the hole goes round clockwise
  EXPECT_EQ(polygon.boundary_point(4, 0.25), (Vec3{0.25, 0.5, 0}));
  EXPECT_FALSE(curves[0].closed);
}

TEST(PolygonBoundary, PointsBetweenCornersAreOnTheirOwnEdge) {
  Rng rng(4);
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    const auto curves = polygon.boundary();
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const double length = curves[c].length;
      const Vec3 from = polygon.boundary_point(c, 0), to = polygon.boundary_point(c, length);
      ASSERT_EQ(polygon.freedom(from).dimensions, 0);
      ASSERT_EQ(polygon.freedom(to).dimensions, 0);
      ASSERT_NEAR(norm(to - from), length, 1e-15 * length);
      for (const double along : {1e-300, 1e-17 * length, 1e-9 * length, rng.uniform() * length, 0.5 * length,
                                 std::nextafter(length, 0)}) {
        const Vec3 p = polygon.boundary_point(c, along);
        ASSERT_EQ(polygon.freedom(p).dimensions, 1) << along;
        const Vec2 d = planar(to) - planar(from);
        ASSERT_EQ(polygon.freedom(p).along, (1 / norm(d)) * d);
        ASSERT_TRUE(exact_on_edge(planar(from), planar(to), planar(p)));
        if (name == "needle" || name == "sharp corners") continue;
        ASSERT_NEAR(norm(p - from), along, 1e-9 * length + 1e-14 * (std::abs(p.x) + std::abs(p.y)));
      }
    }
  }
}

}  // namespace
}  // namespace wellspaced
