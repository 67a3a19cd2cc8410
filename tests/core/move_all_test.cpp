#include "core/optimize/move_all.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/mesh.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::mps;

std::vector<Vec2> random_moves(std::size_t n, double size, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Vec2> moves(n);
  for (Vec2& move : moves) {
    move.x = (2 * rng.uniform() - 1) * size;
    move.y = (2 * rng.uniform() - 1) * size;
  }
  return moves;
}

TEST(MoveAll, MovesAllPointsAndStaysDelaunayWhetherTrianglesTurnOverOrNot) {
  for (const double size : {.01, .1, .4, 1.0})
    for (const double height : {1.0, 3.0}) {
      SCOPED_TRACE(size);
      const PointSet input = mps(400, 1, height);
      StarMesh mesh(input, Control());
      const std::vector<Vec2> moves = random_moves(mesh.size(), size, 2);
      std::vector<FixedPoint> expected(mesh.size());
      for (std::size_t i = 0; i < mesh.size(); ++i) expected[i] = mesh.moved(i, moves[i]);
      EXPECT_EQ(move_all(mesh, moves, input, Control()), 1);
      for (std::size_t i = 0; i < mesh.size(); ++i) EXPECT_EQ(mesh.at(i), expected[i]);
      EXPECT_TRUE(mesh.is_positive());
      testing::expect_delaunay(testing::places(mesh, input), testing::stars_of(mesh));
    }
}

TEST(MoveAll, HalvesMovesThatLeadToWhatItCannotTriangulate) {
  const PointSet input = mps(200, 3);
  StarMesh mesh(input, Control());
  // All to one place.
  std::vector<Vec2> moves(mesh.size());
  for (std::size_t i = 0; i < mesh.size(); ++i) moves[i] = mesh.offset(i, 0);
  const double part = move_all(mesh, moves, input, Control());
  EXPECT_GT(part, 0);
  EXPECT_LT(part, 1);
  testing::expect_delaunay(testing::places(mesh, input), testing::stars_of(mesh));
}

TEST(MoveAll, FindsTheLongestMove) {
  EXPECT_EQ(longest(std::vector<Vec2>{{0, 1}, {-3, 4}, {2, 2}}), 5);
  EXPECT_EQ(longest(std::vector<Vec2>{}), 0);
}

}  // namespace
}  // namespace wellspaced
