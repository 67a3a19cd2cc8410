#include "core/domain/point_tree.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::random_points;

/// Half of them in a spot, some of those repeated.
PointSet clustered(std::size_t n, std::uint64_t seed) {
  PointSet points = random_points(1, 1, n, seed);
  for (std::size_t i = 0; i < n; i += 2)
    points.set(i, {0.3 + 1e-5 * points[i].x, 0.4 + 1e-5 * points[i].y, 0});
  for (std::size_t i = 0; i + 4 < n; i += 8) points.set(i + 4, points[i]);
  return points;
}

std::vector<std::uint32_t> found(const PointTree& tree, const PointTree::Window& window) {
  std::vector<std::uint32_t> all;
  tree.visit(window, [&](std::size_t k) { all.push_back(tree.original(k)); });
  std::sort(all.begin(), all.end());
  return all;
}

TEST(PointTree, FindsWhatLiesInAWindow) {
  Rng rng(1);
  for (const std::size_t n : {0u, 1u, 8u, 9u, 100u, 1000u}) {
    const PointSet points = clustered(n, n);
    const PointTree tree(points, Control());
    ASSERT_EQ(tree.size(), n);
    for (int trial = 0; trial < 200; ++trial) {
      const Vec2 center{rng.uniform(), rng.uniform()}, sides{0.3 * rng.uniform(), 0.3 * rng.uniform()};
      const PointTree::Window window{center - sides, center + sides};
      std::vector<std::uint32_t> wanted;
      for (std::uint32_t i = 0; i < n; ++i)
        if (points[i].x >= window.low.x && points[i].x <= window.high.x && points[i].y >= window.low.y &&
            points[i].y <= window.high.y)
          wanted.push_back(i);
      EXPECT_EQ(found(tree, window), wanted);
    }
  }
}

TEST(PointTree, HoldsEveryPointOnceAndClosedWindowsTheirEdges) {
  const PointSet points = clustered(777, 2);
  const PointTree tree(points, Control());
  EXPECT_EQ(found(tree, {{0, 0}, {1, 1}}).size(), points.size());
  for (std::size_t k = 0; k < tree.size(); ++k) {
    const Vec3 p = points[tree.original(k)];
    EXPECT_EQ(tree.at(k), (Vec2{p.x, p.y}));
    const auto there = found(tree, {tree.at(k), tree.at(k)});
    EXPECT_TRUE(std::binary_search(there.begin(), there.end(), tree.original(k)));
  }
}

TEST(PointTree, FindsTheNearestAndOfSeveralTheFirst) {
  Rng rng(3);
  for (const std::size_t n : {1u, 7u, 9u, 500u}) {
    const PointSet points = clustered(n, n);
    const PointTree tree(points, Control());
    for (int trial = 0; trial < 500; ++trial) {
      const Vec2 p = trial % 2 == 0 ? Vec2{3 * rng.uniform() - 1, 3 * rng.uniform() - 1}
                                    : Vec2{0.3 + 1e-5 * rng.uniform(), 0.4 + 1e-5 * rng.uniform()};
      std::uint32_t wanted = 0;
      const auto d2 = [&](std::uint32_t i) { return norm2(Vec2{points[i].x, points[i].y} - p); };
      for (std::uint32_t i = 1; i < n; ++i)
        if (d2(i) < d2(wanted)) wanted = i;
      EXPECT_EQ(tree.original(tree.nearest(p)), wanted);
    }
  }
}

TEST(PointTree, StopsWhenCancelled) {
  Control control;
  control.cancel();
  const PointSet points = random_points(1, 1, 200'000, 1);
  testing::expect_error([&] { PointTree(points, control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
