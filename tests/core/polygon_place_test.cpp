#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/polygon.h"
#include "tests/support/exact_place.h"
#include "tests/support/polygons.h"

namespace wellspaced {
namespace {

using namespace testing;  // NOLINT

Vec2 neighbor(Vec2 p, int dx, int dy) {
  for (; dx != 0; dx -= dx > 0 ? 1 : -1) p.x = std::nextafter(p.x, dx > 0 ? HUGE_VAL : -HUGE_VAL);
  for (; dy != 0; dy -= dy > 0 ? 1 : -1) p.y = std::nextafter(p.y, dy > 0 ? HUGE_VAL : -HUGE_VAL);
  return p;
}

std::string place(const Polygon& polygon, Vec2 p) {
  const Vec3 q{p.x, p.y, 0};
  if (polygon.why_outside(q)) return "outside";
  switch (polygon.freedom(q).dimensions) {
    case 0:
      return "corner";
    case 1:
      return "edge";
    default:
      return "inside";
  }
}

/// On edges as well as plain arithmetic hits them, beside them by units in the last place, in and beside
/// corners, and anywhere.
std::vector<Vec2> hard_places(const Rings& rings, Rng& rng) {
  std::vector<Vec2> places;
  const auto add_around = [&](Vec2 p) {
    places.push_back(p);
    for (int k = 0; k < 4; ++k)
      places.push_back(neighbor(p, static_cast<int>(rng.below(7)) - 3, static_cast<int>(rng.below(7)) - 3));
  };
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      low = {std::min(low.x, a.x), std::min(low.y, a.y)};
      high = {std::max(high.x, a.x), std::max(high.y, a.y)};
      if (ring.size() > 200 && rng.below(20) != 0) continue;
      add_around(a);
      add_around(a + 0.5 * (b - a));
      add_around(a + rng.uniform() * (b - a));
      add_around(a + 1e-9 * (b - a));
      add_around({rng.uniform() * (b.x - a.x) + a.x, a.y});  // straight beside a corner
      add_around({a.x, rng.uniform() * (b.y - a.y) + a.y});
    }
  for (int k = 0; k < 200; ++k)
    places.push_back({low.x + (1.2 * rng.uniform() - 0.1) * (high.x - low.x),
                      low.y + (1.2 * rng.uniform() - 0.1) * (high.y - low.y)});
  return places;
}

TEST(PolygonPlaces, AreWhatRationalArithmeticSays) {
  Rng rng(1);
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    int counts[4] = {};
    for (const Vec2 p : hard_places(rings, rng)) {
      const std::string expected = exact_place(rings, p);
      ASSERT_EQ(place(polygon, p), expected) << std::hexfloat << p.x << " " << p.y;
      ++counts[expected == "inside" ? 0 : expected == "outside" ? 1 : expected == "edge" ? 2 : 3];
    }
    for (const int count : counts) EXPECT_GT(count, 0);
  }
}

TEST(PolygonPlaces, AreExactOnASlopeThatDoublesMiss) {
  // 0.1 + 0.2 is not 0.3, and the edge from (0, 0) to (1, 0.3) passes between doubles nearly everywhere.
  const Rings rings = {{{0, 0}, {1, 0.3}, {0.1 + 0.2, 0.3}}};
  const Polygon polygon(rings);
  Rng rng(7);
  for (int k = 0; k < 300; ++k) {
    const double x = rng.uniform();
    for (int d = -3; d <= 3; ++d) {
      const Vec2 p = neighbor({x, x * 0.3}, 0, d);
      EXPECT_EQ(place(polygon, p), exact_place(rings, p));
    }
  }
}

TEST(PolygonPlaces, TellCornersByTheirBitsOnly) {
  const Polygon polygon(l_shape());
  EXPECT_EQ(place(polygon, {1, 1}), "corner");
  EXPECT_EQ(place(polygon, {-0.0, 0}), "corner");
  EXPECT_EQ(place(polygon, neighbor({1, 1}, 1, 0)), "edge");
  EXPECT_EQ(place(polygon, neighbor({1, 1}, -1, -1)), "edge");
  EXPECT_EQ(place(polygon, neighbor({1, 1}, -2, -2)), "inside");
  EXPECT_EQ(place(polygon, neighbor({1, 1}, 2, 2)), "outside");
}

TEST(PolygonPlaces, OutsideIsSaidWithTheCoordinates) {
  const Polygon polygon(square_with_hole());
  const auto why = polygon.why_outside({0.5, 0.375, 0});
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("(0.5, 0.375)"), std::string::npos) << *why;
  EXPECT_TRUE(polygon.why_outside({5, 0.3, 0}));
  EXPECT_TRUE(polygon.why_outside({std::nan(""), 0.3, 0}));
  EXPECT_TRUE(polygon.why_outside({0.1, HUGE_VAL, 0}));
  EXPECT_FALSE(polygon.why_outside({0.1, 0.3, 0}));
}

}  // namespace
}  // namespace wellspaced
