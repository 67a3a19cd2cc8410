#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/polygon.h"
#include "tests/support/polygons.h"

namespace wellspaced {
namespace {

using namespace testing;  // NOLINT

const Ring square = rectangle({0, 0}, {1, 1});

TEST(PolygonFeatures, AreTheNarrowestPassageOrWall) {
  const auto feature = [](const Rings& rings) { return Polygon(rings).smallest_feature(); };
  EXPECT_DOUBLE_EQ(feature({square}).length, 1);
  EXPECT_EQ(feature({square}).description, "the outer ring is 1 across");
  EXPECT_DOUBLE_EQ(feature(l_shape()).length, 2);
  EXPECT_NEAR(feature({circle({0, 0}, 1, 1000)}).length, 2, 1e-3);
  const PolygonFeature hole = feature({square, rectangle({0.4, 0.4}, {0.41, 0.41})});
  EXPECT_NEAR(hole.length, 0.01, 1e-15);
  EXPECT_EQ(hole.description, "hole 1 is 0.01 across");
  const PolygonFeature passage = feature({square, rectangle({0.003, 0.4}, {0.41, 0.81})});
  EXPECT_NEAR(passage.length, 0.003, 1e-15);
  EXPECT_EQ(passage.description,
            "the passage between vertex 3 of hole 1 and edge 3 of the outer ring is 0.003 wide");
  const PolygonFeature wall =
      feature({{{0, 0}, {1, 0}, {1, 1}, {0.51, 1}, {0.51, 0.2}, {0.5, 0.2}, {0.5, 1}, {0, 1}}});
  EXPECT_NEAR(wall.length, 0.01, 1e-15);
  EXPECT_TRUE(wall.description.starts_with("the wall between vertex")) << wall.description;
  EXPECT_NEAR(feature({comb(50)}).length, 1.0 / 99, 1e-15);
}

/// By all pairs of corners and edges.
double brute_feature(const Rings& rings) {
  double best = HUGE_VAL;
  for (const Ring& ring : rings) {
    const auto [x0, x1] =
        std::minmax_element(ring.begin(), ring.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    const auto [y0, y1] =
        std::minmax_element(ring.begin(), ring.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; });
    best = std::min(best, std::max(x1->x - x0->x, y1->y - y0->y));
  }
  for (const Ring& r : rings)
    for (std::size_t i = 0; i < r.size(); ++i)
      for (const Ring& s : rings) {
        double way = 0, length = 0;
        for (std::size_t j = 0; j < s.size(); ++j) length += norm(s[(j + 1) % s.size()] - s[j]);
        for (std::size_t k = 0; k < s.size(); ++k) {  // from corner i on, if it is the same ring
          const std::size_t j = (i + k) % s.size();
          const Vec2 a = s[j], d = s[(j + 1) % s.size()] - a;
          const double part = std::clamp(dot(r[i] - a, d) / norm2(d), 0.0, 1.0),
                       apart = norm(a + part * d - r[i]);
          const double onward = way + part * norm(d);
          way += norm(d);
          if (r[i] == a || r[i] == s[(j + 1) % s.size()]) continue;
          if (&r != &s || std::min(onward, length - onward) > 3 * apart) best = std::min(best, apart);
        }
      }
  return best;
}

TEST(PolygonFeatures, AreWhatAllPairsGive) {
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    const double length = polygon.smallest_feature().length;
    EXPECT_NEAR(length, brute_feature(polygon.rings()), 1e-12 * length + 1e-15);
  }
}

}  // namespace
}  // namespace wellspaced
