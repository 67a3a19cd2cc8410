#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/polygon.h"
#include "tests/support/polygons.h"

namespace wellspaced {
namespace {

using namespace testing;  // NOLINT

double area_of_piece(std::span<const Vec2> piece) {
  double twice = 0;
  for (std::size_t k = 2; k < piece.size(); ++k) twice += cross(piece[k - 1] - piece[0], piece[k] - piece[0]);
  return twice / 2;
}

bool holds(std::span<const Vec2> piece, Vec2 p) {
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const Vec2 a = piece[k], b = piece[(k + 1) % piece.size()];
    if (cross(b - a, p - a) < 0) return false;
  }
  return true;
}

double diagonal(const Polygon& polygon) { return norm(Vec2{polygon.box().size.x, polygon.box().size.y}); }

TEST(PolygonPieces, AddUpToTheAreaAtEveryReach) {
  Rng rng(3);
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    // What rounding a corner changes: a unit in the last place along the whole boundary.
    const double rounding = 1e-12 * polygon.area() + 0x1p-51 * diagonal(polygon) * polygon.boundary_length();
    EXPECT_NEAR(polygon.area(), area_of(rings), rounding);
    ChartPieces pieces;
    for (const double reach : {1.0, 1.5, 3.0, 100.0}) {
      ASSERT_TRUE(polygon.pieces(polygon.random_point(rng), reach * diagonal(polygon), pieces));
      EXPECT_NEAR(area_of_pieces(pieces), area_of(rings), rounding) << reach;
    }
  }
}

TEST(PolygonPieces, AreConvexAndCounterClockwise) {
  Rng rng(4);
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    const double rounding = 0x1p-50 * diagonal(polygon) * diagonal(polygon);
    ChartPieces pieces;
    for (const double reach : {0.01, 0.05, 0.3, 1.0}) {
      if (!polygon.pieces(polygon.random_point(rng), reach * diagonal(polygon), pieces)) continue;
      for (std::size_t k = 0; k < pieces.ends.size(); ++k) {
        const auto piece = pieces[k];
        ASSERT_GE(piece.size(), 3u);
        ASSERT_GE(area_of_piece(piece), -rounding);
        for (std::size_t i = 0; i < piece.size(); ++i) {
          const Vec2 a = piece[i], b = piece[(i + 1) % piece.size()], c = piece[(i + 2) % piece.size()];
          ASSERT_GE(cross(b - a, c - b), -rounding);
          ASSERT_NE(a, b);
        }
      }
    }
  }
}

/// Places at random within reach are in one piece if they are inside, and in none otherwise.
TEST(PolygonPieces, CoverTheDomainWithinReachOnce) {
  Rng rng(5);
  int surrounded = 0;
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    ChartPieces pieces;
    for (int k = 0; k < 300; ++k) {
      const Vec3 base = polygon.random_point(rng);
      const double reach = diagonal(polygon) * std::pow(10.0, -3.5 * rng.uniform());
      const bool cut = polygon.pieces(base, reach, pieces);
      surrounded += cut ? 0 : 1;
      for (int i = 0; i < 20; ++i) {
        Vec2 u{2 * rng.uniform() - 1, 2 * rng.uniform() - 1};
        if (norm(u) > 1) continue;
        u = reach * u;
        const Vec3 place = base + Vec3{u.x, u.y, 0};
        const bool inside = !polygon.why_outside(place);
        if (!cut) {
          ASSERT_TRUE(inside);
          continue;
        }
        int count = 0;
        for (std::size_t j = 0; j < pieces.ends.size(); ++j) count += holds(pieces[j], u) ? 1 : 0;
        ASSERT_EQ(count, inside ? 1 : 0) << place.x << " " << place.y << " reach " << reach;
      }
    }
  }
  EXPECT_GT(surrounded, 500);
}

TEST(PolygonPieces, AreNotNeededDeepInside) {
  const Polygon polygon({rectangle({0, 0}, {1, 1})});
  ChartPieces pieces;
  EXPECT_FALSE(polygon.pieces({0.5, 0.5, 0}, 0.49, pieces));
  EXPECT_TRUE(polygon.pieces({0.5, 0.5, 0}, 0.501, pieces));
  EXPECT_TRUE(polygon.pieces({0.1, 0.5, 0}, 0.101, pieces));
  EXPECT_FALSE(polygon.pieces({0.1, 0.5, 0}, 0.09, pieces));
}

/// However fine the boundary's squares are: as many pieces as there are edges in reach, about.
TEST(PolygonPieces, AreFewWhateverTheReach) {
  const Polygon polygon({rectangle({0, 0}, {1, 1})});
  ChartPieces pieces;
  for (const double reach : {0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 10.0}) {
    ASSERT_TRUE(polygon.pieces({0.001, 0.002, 0}, reach, pieces));
    EXPECT_LE(pieces.ends.size(), 30u) << reach;
  }
}

/// Many edges side by side don't change that: squares as large as the reach hold each of them once.
TEST(PolygonPieces, AreFewOfCombs) {
  for (const double angle : {0.0, std::numbers::pi / 2, 1.0}) {
    const Polygon polygon(turned({comb(500)}, angle));
    ChartPieces pieces;
    Rng rng(1);
    ASSERT_TRUE(polygon.pieces(polygon.random_point(rng), 2, pieces));
    EXPECT_LE(pieces.ends.size(), 10 * polygon.boundary().size());
  }
}

/// By points at random: the area within reach of a place.
TEST(PolygonPieces, HaveTheAreaThatRandomPointsFind) {
  const Polygon polygon({star(60, 11, 0.4), circle({0.1, 0}, 0.2, 40)});
  Rng rng(6);
  ChartPieces pieces;
  const Vec3 base = polygon.random_point(rng);
  ASSERT_TRUE(polygon.pieces(base, 4, pieces));
  int hits = 0;
  constexpr int tries = 200000;
  for (int k = 0; k < tries; ++k)
    hits += polygon.why_outside({2 * rng.uniform() - 1, 2 * rng.uniform() - 1, 0}) ? 0 : 1;
  const double share = area_of_pieces(pieces) / 4, deviation = std::sqrt(share * (1 - share) / tries);
  EXPECT_NEAR(static_cast<double>(hits) / tries, share, 4 * deviation);
}

}  // namespace
}  // namespace wellspaced
