#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/edge_grid.h"
#include "core/domain/polygon.h"
#include "core/error.h"
#include "tests/support/oracle.h"
#include "tests/support/polygons.h"

namespace wellspaced {
namespace {

using namespace testing;  // NOLINT

constexpr auto invalid = ErrorCode::invalid_parameters, degenerate = ErrorCode::degenerate_input;

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

TEST(PolygonValidation, RefusesWhatIsNoneAndSaysWhereAndWhy) {
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
TEST(PolygonValidation, RefusesReversedRingsAtTheSamePlace) {
  Rings rings = {l_shape()[0], {{1, 1}, {0.5, 0.6}, {0.6, 0.5}}};
  std::reverse(rings[0].begin(), rings[0].end());
  std::reverse(rings[1].begin(), rings[1].end());
  expect_error([&] { Polygon{rings}; }, degenerate, "/rings/1/2", "touches vertex 2 of the outer ring");
}

TEST(PolygonValidation, TakesCollinearVerticesAndNearMisses) {
  EXPECT_DOUBLE_EQ(Polygon({{{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}}).area(), 1);
  EXPECT_NO_THROW(Polygon({square, {{1e-12, 0.5}, {0.5, 0.3}, {0.5, 0.7}}}));
  EXPECT_NO_THROW(Polygon({{{0, 0}, {1, 0}, {1, 1}, {0.5, 1e-12}, {0, 1}}}));
}

/// All work of the constructor but sorting is on pairs of edges that share a square, and on squares.
TEST(PolygonValidation, ManyEdgesTakeLittleWork) {
  const auto grid_of = [](const Ring& ring) {
    const PolygonRings rings({ring});
    return EdgeGrid(rings, 8 * static_cast<double>(rings.edges().size()));
  };
  for (const std::size_t n : {10000u, 100000u}) {
    const EdgeGrid grid = grid_of(circle({0, 0}, 1, n));
    EXPECT_LT(grid.pairs(), 20.0 * static_cast<double>(n) * std::sqrt(static_cast<double>(n) / 10000));
    EXPECT_LT(static_cast<double>(grid.squares()), 8.2 * static_cast<double>(n));
  }
  EXPECT_LT(grid_of(star(10000, 8, 0.6)).pairs(), 10000 * 500.0);  // spikes across 40 squares each
  EXPECT_EQ(Polygon({star(10000, 8, 0.6)}).boundary().size(), 10000u);
}

TEST(PolygonValidation, RefusesWhatWouldTakeTooMuchWork) {
  expect_error([] { Polygon({comb(100000)}); }, degenerate, "/rings", "simplify the rings");
}

using Whole = std::pair<int, int>;

int side(Whole a, Whole b, Whole c) {
  const int d = (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
  return d > 0 ? 1 : d < 0 ? -1 : 0;
}
bool between(Whole a, Whole b, Whole c) {
  return std::min(a.first, b.first) <= c.first && c.first <= std::max(a.first, b.first) &&
         std::min(a.second, b.second) <= c.second && c.second <= std::max(a.second, b.second);
}
bool meet(Whole a, Whole b, Whole c, Whole d) {
  return (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) ||
         (side(a, b, c) == 0 && between(a, b, c)) || (side(a, b, d) == 0 && between(a, b, d)) ||
         (side(c, d, a) == 0 && between(c, d, a)) || (side(c, d, b) == 0 && between(c, d, b));
}
bool in_ring(const std::vector<Whole>& ring, Whole p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Whole a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.second > p.second) != (b.second > p.second))
      inside = inside != ((side(a, b, p) > 0) == (b.second > a.second));
  }
  return inside;
}

/// By whole numbers, over all pairs.
bool is_valid(std::vector<std::vector<Whole>> rings) {
  for (auto& ring : rings) {
    if (ring.front() == ring.back()) ring.pop_back();
    if (ring.size() < 3) return false;
  }
  for (std::size_t k = 0; k < rings.size(); ++k)
    for (std::size_t i = 0; i < rings[k].size(); ++i) {
      const auto& r = rings[k];
      const Whole a = r[i], b = r[(i + 1) % r.size()], c = r[(i + 2) % r.size()];
      if (a == b || (side(a, b, c) == 0 && !between(a, c, b))) return false;
      for (std::size_t l = 0; l < rings.size(); ++l)
        for (std::size_t j = 0; j < rings[l].size(); ++j) {
          const bool near = k == l && (i == j || (i + 1) % r.size() == j || (j + 1) % r.size() == i);
          if (!near && meet(a, b, rings[l][j], rings[l][(j + 1) % rings[l].size()])) return false;
        }
      for (std::size_t l = 0; l < rings.size(); ++l)
        if (k != 0 && l != k && in_ring(rings[l], a) != (l == 0)) return false;
    }
  return true;
}

TEST(PolygonValidation, TakesExactlyWhatIsValid) {
  Rng rng(17);
  int valid = 0, invalid_ones = 0;
  ChartPieces pieces;
  for (int k = 0; k < 5000; ++k) {
    std::vector<std::vector<Whole>> rings(1 + rng.below(3));
    Rings doubles;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const int low = r == 0 ? 0 : 1, span = r == 0 ? 9 : 5;
      const std::size_t n = 3 + rng.below(r == 0 ? 4 : 2);
      doubles.emplace_back();
      for (std::size_t i = 0; i < n; ++i) {
        const int x = low + static_cast<int>(rng.below(span)), y = low + static_cast<int>(rng.below(span));
        rings[r].push_back({x, y});
        doubles[r].push_back({0x1p-3 * x, 0x1p-3 * y});
      }
    }
    bool taken = true;
    try {
      const Polygon polygon(doubles);
      ASSERT_NEAR(polygon.area(), area_of(doubles), 1e-12);
      ASSERT_TRUE(polygon.pieces({0, 0, 0}, 0.2 * static_cast<double>(1 + k % 7), pieces));
      if (k % 7 == 6) {  // all of it, with corners and edges right on the lines of the grid
        ASSERT_NEAR(area_of_pieces(pieces), area_of(doubles), 1e-12);
      }
    } catch (const Error& error) {
      taken = false;
      ASSERT_NE(error.code(), ErrorCode::internal);
    }
    ASSERT_EQ(taken, is_valid(rings)) << k;
    (taken ? valid : invalid_ones) += 1;
  }
  EXPECT_GT(valid, 300);
  EXPECT_GT(invalid_ones, 500);
}

}  // namespace
}  // namespace wellspaced
