#include <vector>

#include <gtest/gtest.h>

#include "core/voronoi/star_mesh.h"
#include "tests/support/mesh.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::mps;
using testing::random_points;

/// Delaunay, once points with empty stars are left out.
void expect_delaunay_without_removed(const StarMesh& mesh, const PointSet& input) {
  const PointSet places = testing::places(mesh, input);
  const auto stars = testing::stars_of(mesh);
  PointSet kept{input.domain, {}};
  std::vector<std::uint32_t> number(input.size());
  std::vector<std::vector<Spoke>> kept_stars;
  for (std::size_t i = 0; i < input.size(); ++i) {
    if (stars[i].empty()) continue;
    number[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(places[i]);
    kept_stars.push_back(stars[i]);
  }
  for (auto& star : kept_stars)
    for (Spoke& spoke : star) spoke.id = number[spoke.id];
  testing::expect_delaunay(kept, kept_stars);
}

TEST(StarMeshEdit, StaysDelaunayWhenPointsAreTakenOut) {
  for (const PointSet& input : {mps(300, 1), mps(300, 2, 3), random_points(1, 1, 300, 3)}) {
    StarMesh mesh(input, Control());
    std::size_t removed = 0;
    for (std::size_t i = 0; i < mesh.size(); i += 3) removed += mesh.remove(i) ? 1 : 0;
    EXPECT_GT(removed, mesh.size() / 3 - 5);
    expect_delaunay_without_removed(mesh, input);
  }
}

TEST(StarMeshEdit, IsAsBeforeWhenAPointIsPutBack) {
  const PointSet input = mps(300, 4);
  StarMesh mesh(input, Control());
  const auto before = testing::stars_of(mesh);
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    ASSERT_TRUE(mesh.remove(i));
    EXPECT_EQ(mesh.star(i).degree, 0);
    // From far away too.
    ASSERT_TRUE(mesh.insert(i, mesh.at(i), (i + 1 + i % 7 * 40) % mesh.size()));
  }
  const auto after = testing::stars_of(mesh);
  for (std::size_t i = 0; i < input.size(); ++i) EXPECT_EQ(after[i].size(), before[i].size());
  testing::expect_delaunay(testing::places(mesh, input), after);
}

TEST(StarMeshEdit, StaysDelaunayWhenPointsAreMovedAnywhere) {
  for (const PointSet& input : {mps(200, 5), mps(200, 6, .4)}) {
    StarMesh mesh(input, Control());
    Rng rng(7);
    for (int round = 0; round < 5; ++round) {
      for (std::size_t i = 0; i < mesh.size(); i += 4) {
        ASSERT_TRUE(mesh.remove(i));
        const FixedPoint place{static_cast<std::uint32_t>(rng.next()),
                               static_cast<std::uint32_t>(rng.next())};
        ASSERT_TRUE(mesh.insert(i, place, (i + 1) % mesh.size()));
        EXPECT_EQ(mesh.at(i), place);
      }
      EXPECT_TRUE(mesh.is_positive());
      testing::expect_delaunay(testing::places(mesh, input), testing::stars_of(mesh));
    }
  }
}

TEST(StarMeshEdit, TakesPointsOnEdges) {
  const PointSet input = mps(200, 8);
  StarMesh mesh(input, Control());
  for (std::size_t i = 0; i + 1 < mesh.size(); i += 5) {
    ASSERT_TRUE(mesh.remove(i));
    const Vec2 half = .5 * mesh.offset(i + 1, mesh.star(i + 1).neighbor[0]);
    ASSERT_TRUE(mesh.insert(i, mesh.moved(i + 1, half), i + 1));
  }
  EXPECT_TRUE(mesh.is_positive());
  testing::expect_delaunay(testing::places(mesh, input), testing::stars_of(mesh));
}

TEST(StarMeshEdit, LeavesAloneWhatItCannotTakeOut) {
  const PointSet input = random_points(1, 1, 22, 3);
  StarMesh mesh(input, Control());
  // Until edges would have to reach around the torus.
  std::size_t removed = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const auto before = testing::stars_of(mesh);
    if (mesh.remove(i)) {
      ++removed;
      continue;
    }
    const auto after = testing::stars_of(mesh);
    for (std::size_t k = 0; k < before.size(); ++k) {
      ASSERT_EQ(before[k].size(), after[k].size());
      for (std::size_t s = 0; s < before[k].size(); ++s) EXPECT_EQ(before[k][s].id, after[k][s].id);
    }
  }
  EXPECT_GT(removed, 0u);
  EXPECT_LT(removed, mesh.size());
}

}  // namespace
}  // namespace wellspaced
