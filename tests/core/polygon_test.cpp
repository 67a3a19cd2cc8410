#include "core/domain/polygon.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/support/oracle.h"
#include "tests/support/polygons.h"

namespace wellspaced {
namespace {

using namespace testing;  // NOLINT

constexpr auto invalid = ErrorCode::invalid_parameters, degenerate = ErrorCode::degenerate_input;

double area_of(const DomainTriangle& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]).z; }

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
      area += area_of(t);
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
      expected.back() += tries * area_of(triangles[k]) / polygon.area();
      group[k] = expected.size() - 1;
    }
    std::vector<double> found(expected.size());
    for (int i = 0; i < tries; ++i) {
      const Vec3 p = polygon.random_point(rng);
      ASSERT_FALSE(polygon.why_outside(p));
      ASSERT_EQ(polygon.freedom(p).dimensions, 2);
      const auto holds = [&](const DomainTriangle& t) {
        return area_of({t[0], t[1], p}) >= 0 && area_of({t[1], t[2], p}) >= 0 &&
               area_of({t[2], t[0], p}) >= 0;
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

struct Refused {
  const char* name;
  Rings rings;
  ErrorCode code;
  const char* where;
  const char* part;
};

const Ring square = rectangle({0, 0}, {1, 1});

std::vector<Refused> refused() {
  const double nan = std::nan("");
  return {
      {"nothing", {}, invalid, "/rings", "at least one ring"},
      {"empty ring", {{}}, degenerate, "/rings/0", "at least 3"},
      {"point", {{{1, 1}}}, degenerate, "/rings/0", "at least 3"},
      {"two vertices", {{{0, 0}, {1, 1}, {0, 0}}}, degenerate, "/rings/0", "this one has 2"},
      {"to and fro", {{{0, 0}, {1, 1}, {0, 0}, {1, 1}}}, degenerate, "/rings/0", "this one has 2"},
      {"empty hole", {square, {}}, degenerate, "/rings/1", "at least 3"},
      {"nan", {square, {{0.2, 0.2}, {0.4, 0.2}, {0.3, nan}}}, invalid, "/rings/1/2", "finite"},
      {"infinite", {{{0, 0}, {HUGE_VAL, 0}, {0, 1}}}, invalid, "/rings/0/1", "finite"},
      {"line", {{{0, 0}, {1, 1}, {2, 2}, {3, 3}}}, degenerate, "/rings/0", "no area"},
      {"repeated", {{{0, 0}, {1, 0}, {1, 0}, {1, 1}}}, degenerate, "/rings/0/2", "repeats the one before"},
      {"closed twice", {{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {0, 0}}}, degenerate, "/rings/0/3", "closes"},
      {"small", {rectangle({0, 0}, {1e-7, 1e-7})}, invalid, "/rings/0", "1e-6"},
      {"large", {rectangle({0, 0}, {2e6, 2e6})}, invalid, "/rings/0", "1e6"},
      {"overflowing", {rectangle({-1e308, -1e308}, {1e308, 1e308})}, invalid, "/rings/0", "1e6"},
      {"elongated", {rectangle({0, 0}, {1001, 1})}, invalid, "/rings/0", "1000 times"},
      {"bow-tie",
       {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}},
       degenerate,
       "/rings/0/2",
       "edge 2 crosses edge 0 at (0.5, 0.5)"},
      {"reversed bow-tie", {{{0, 1}, {1, 0}, {1, 1}, {0, 0}}}, degenerate, "/rings/0/", "at (0.5, 0.5)"},
      {"spike", {{{0, 0}, {1, 0}, {2, 0}, {1, 0.0}, {1, 1}}}, degenerate, "/rings/0/2", "spike"},
      {"inward spike",
       {{{0, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0.5, 0.5}, {0.5, 1}, {0, 1}}},
       degenerate,
       "/rings/0/4",
       "spike"},
      {"touches vertex",
       {{{0, 0}, {0.5, 0.5}, {1, 0}, {1, 1}, {0.5, 0.5}, {0, 1}}},
       degenerate,
       "/rings/0/4",
       "touches vertex 1"},
      {"touches edge",
       {{{0, 0}, {1, 0}, {1, 1}, {0.5, 0}, {0, 1}}},
       degenerate,
       "/rings/0/3",
       "touches edge 0"},
      {"runs along",
       {{{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 0}, {1, 0}, {1, 1}, {0, 1}}},
       degenerate,
       "/rings/0/4",
       "runs along"},
      {"hole far outside",
       {square, rectangle({3, 3}, {4, 4})},
       degenerate,
       "/rings/1",
       "outside the outer ring"},
      {"hole outside",
       {l_shape()[0], rectangle({1.2, 1.2}, {1.8, 1.8})},
       degenerate,
       "/rings/1",
       "outside the outer ring"},
      {"hole around",
       {square, rectangle({-1, -1}, {2, 2})},
       degenerate,
       "/rings/1",
       "outside the outer ring"},
      {"hole crosses box",
       {square, rectangle({0.5, 0.2}, {1.5, 0.8})},
       degenerate,
       "/rings/1/1",
       "outside the outer ring"},
      {"hole crosses",
       {l_shape()[0], rectangle({0.5, 0.5}, {1.5, 1.5})},
       degenerate,
       "/rings/1/1",
       "of the outer ring at"},
      {"hole same", {square, square}, degenerate, "/rings/1/", "runs along"},
      {"hole touches outer in a point",
       {square, {{0, 0.5}, {0.5, 0.3}, {0.5, 0.7}}},
       degenerate,
       "/rings/1/0",
       "two rings touch"},
      {"hole touches outer corner",
       {l_shape()[0], {{1, 1}, {0.5, 0.6}, {0.6, 0.5}}},
       degenerate,
       "/rings/1/0",
       "touches vertex 3 of the outer ring"},
      {"hole touches outer along",
       {square, rectangle({0.5, 0.2}, {1, 0.4})},
       degenerate,
       "/rings/1/1",
       "runs along"},
      {"holes touch in a point",
       {square, {{0.1, 0.5}, {0.5, 0.3}, {0.5, 0.7}}, {{0.5, 0.5}, {0.9, 0.3}, {0.9, 0.7}}},
       degenerate,
       "/rings/2/0",
       "two rings touch"},
      {"holes cross",
       {square, rectangle({0.1, 0.1}, {0.5, 0.5}), rectangle({0.3, 0.3}, {0.7, 0.7})},
       degenerate,
       "/rings/2/",
       "crosses"},
      {"holes touch along",
       {square, rectangle({0.1, 0.1}, {0.5, 0.5}), rectangle({0.5, 0.3}, {0.7, 0.7})},
       degenerate,
       "/rings/2/",
       "runs along"},
      {"hole in hole",
       {square, rectangle({0.1, 0.1}, {0.8, 0.8}), rectangle({0.3, 0.3}, {0.7, 0.7})},
       degenerate,
       "/rings/2",
       "inside another hole, ring 1"},
      {"hole around hole",
       {square, rectangle({0.3, 0.3}, {0.7, 0.7}), rectangle({0.1, 0.1}, {0.8, 0.8})},
       degenerate,
       "/rings/1",
       "inside another hole, ring 2"},
      {"crosses by one ulp",
       {{{0, 0}, {1, 0}, {1, 1}, {0.5, -0x1p-1074}, {0, 1}}},
       degenerate,
       "/rings/0/",
       "crosses"},
      {"edge of an ulp",
       {{{0, 1}, {1, 1}, {1, 2}, {std::nextafter(1, 0), 2}}},
       degenerate,
       "/rings/0/",
       "too close|so short"},
      {"two ulps wide", {rectangle({1e6, 0}, {1e6 + 0x1p-32, 1e-6})}, invalid, "/rings/0", "1e-6"},
      {"thin", {{{1, 1}, {2, 1}, {1.5, 2}, {1.5 - 0x1p-52, 1 + 0x1p-51}}}, degenerate, "/rings", ""},
  };
}

TEST(Polygon, RefusesWhatIsNoneAndSaysWhereAndWhy) {
  for (const Refused& r : refused()) {
    SCOPED_TRACE(r.name);
    try {
      const Polygon polygon(r.rings);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(r.code)) << error.what();
      EXPECT_TRUE(error.where().starts_with(r.where)) << error.where();
      if (!std::string(r.where).ends_with("/") && std::string(r.where) != "/rings") {
        EXPECT_EQ(error.where(), r.where);
      }
      const std::string part = r.part, message = error.what();
      const auto bar = part.find('|');
      EXPECT_TRUE(message.find(part.substr(0, bar)) != std::string::npos ||
                  (bar != std::string::npos && message.find(part.substr(bar + 1)) != std::string::npos))
          << message;
    }
  }
}

/// What is refused stays refused in any orientation and turned, and names the same vertices.
TEST(Polygon, RefusesReversedRingsAtTheSamePlace) {
  Rings rings = {l_shape()[0], {{1, 1}, {0.5, 0.6}, {0.6, 0.5}}};
  std::reverse(rings[0].begin(), rings[0].end());
  std::reverse(rings[1].begin(), rings[1].end());
  expect_error([&] { Polygon{rings}; }, degenerate, "/rings/1/2", "touches vertex 2 of the outer ring");
}

TEST(Polygon, TakesCollinearVerticesAndNearMisses) {
  EXPECT_DOUBLE_EQ(Polygon({{{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}}).area(), 1);
  EXPECT_NO_THROW(Polygon({square, {{1e-12, 0.5}, {0.5, 0.3}, {0.5, 0.7}}}));
  EXPECT_NO_THROW(Polygon({{{0, 0}, {1, 0}, {1, 1}, {0.5, 1e-12}, {0, 1}}}));
}

TEST(Polygon, ManyEdgesTakeLittleTime) {
  const auto begin = std::chrono::steady_clock::now();
  const Polygon polygon({star(20000, 8, 0.6)});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took.count(), 20);  // 0.3 s on one core; quadratic work would take minutes
  EXPECT_EQ(polygon.boundary().size(), 20000u);
}

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
