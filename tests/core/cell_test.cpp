#include "core/voronoi/cell.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace wellspaced {
namespace {

HalfPlane bisector(double x, double y) { return {{x, y}, (x * x + y * y) / 2}; }

double area(const Cell& cell) {
  double twice = 0;
  const auto corners = cell.corners();
  for (std::size_t k = 0; k < corners.size(); ++k)
    twice += cross(corners[k].at, corners[(k + 1) % corners.size()].at);
  return twice / 2;
}

TEST(Cell, IsTheStartingSquareBeforeAnyCut) {
  Cell cell;
  cell.reset(3);
  EXPECT_EQ(cell.corners().size(), 4u);
  EXPECT_FALSE(cell.closed());
  EXPECT_DOUBLE_EQ(cell.outradius2(), 18);
  EXPECT_DOUBLE_EQ(area(cell), 36);
}

TEST(Cell, OfTheSquareLatticeIsASquareWhateverTheOrder) {
  std::vector<HalfPlane> neighbors;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      if (x != 0 || y != 0) neighbors.push_back(bisector(x, y));
  Rng rng(1);
  for (int order = 0; order < 200; ++order) {
    for (std::size_t k = neighbors.size(); k-- > 1;) std::swap(neighbors[k], neighbors[rng.below(k + 1)]);
    Cell cell;
    cell.reset(3);
    for (std::size_t k = 0; k < neighbors.size(); ++k) cell.clip(neighbors[k], static_cast<std::int32_t>(k));
    ASSERT_EQ(cell.corners().size(), 4u) << "diagonal neighbors only touch corners";
    EXPECT_TRUE(cell.closed());
    EXPECT_NEAR(cell.outradius2(), 0.5, 1e-14);
    EXPECT_NEAR(area(cell), 1, 1e-14);
  }
}

TEST(Cell, IsTheIntersectionOfItsHalfPlanes) {
  Rng rng(2);
  for (int round = 0; round < 200; ++round) {
    std::vector<HalfPlane> planes;
    for (int k = 0; k < 12; ++k) planes.push_back(bisector(rng.uniform() * 4 - 2, rng.uniform() * 4 - 2));
    Cell cell;
    cell.reset(3);
    for (std::size_t k = 0; k < planes.size(); ++k) cell.clip(planes[k], static_cast<std::int32_t>(k));
    for (const Cell::Corner& corner : cell.corners())
      for (const HalfPlane& h : planes) EXPECT_LE(dot(h.n, corner.at), h.c + 1e-9);
    // An area by counting places, as an oracle: the same half-planes, no clipping.
    int inside = 0;
    constexpr int side = 120;
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const Vec2 p{6 * (i + 0.5) / side - 3, 6 * (j + 0.5) / side - 3};
        inside +=
            std::all_of(planes.begin(), planes.end(), [&](const HalfPlane& h) { return dot(h.n, p) <= h.c; });
      }
    const double step = 6.0 / side;
    double perimeter = 0;
    for (std::size_t k = 0; k < cell.corners().size(); ++k)
      perimeter += norm(cell.corners()[(k + 1) % cell.corners().size()].at - cell.corners()[k].at);
    EXPECT_NEAR(area(cell), inside * step * step, perimeter * step);
  }
}

TEST(Cell, LabelsItsEdges) {
  Cell cell;
  cell.reset(10);
  cell.clip(bisector(2, 0), 7);
  cell.clip(bisector(0, 2), 8);
  cell.clip(bisector(-2, 0), 9);
  EXPECT_FALSE(cell.closed());
  cell.clip(bisector(0, -2), 10);
  ASSERT_TRUE(cell.closed());
  const auto corners = cell.corners();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 middle = 0.5 * (corners[k].at + corners[(k + 1) % corners.size()].at);
    const int wanted = middle.x > 0.5 ? 7 : middle.y > 0.5 ? 8 : middle.x < -0.5 ? 9 : 10;
    EXPECT_EQ(corners[k].label, wanted);
  }
}

TEST(Cell, IgnoresANeighborThatCoincides) {
  Cell cell;
  cell.reset(1);
  cell.clip({{0, 0}, 0}, 1);
  EXPECT_EQ(cell.corners().size(), 4u);
}

TEST(Circumcenter, IsAsFarFromAllThree) {
  Rng rng(3);
  for (int k = 0; k < 1000; ++k) {
    const Vec2 a{rng.uniform() - 0.5, rng.uniform() - 0.5}, b{rng.uniform() - 0.5, rng.uniform() - 0.5};
    if (std::fabs(cross(a, b)) < 1e-3) continue;
    const Vec2 c = circumcenter(a, b);
    EXPECT_NEAR(norm(c), norm(c - a), 1e-9);
    EXPECT_NEAR(norm(c), norm(c - b), 1e-9);
  }
}

}  // namespace
}  // namespace wellspaced
