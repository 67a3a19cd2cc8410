#include "core/voronoi/star_cell.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

/// Centroids and energies of all cells from a grid of places, each given to its nearest point.
std::vector<CellMoments> brute_moments(const PointSet& points, int side) {
  const double d = hexagonal_spacing(points.domain->area(), points.size());
  const Box box = points.domain->box();
  const Vec2 step{box.size.x / side, box.size.y / side};
  std::vector<CellMoments> all(points.size());
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const Vec3 place{(column + .5) * step.x, (row + .5) * step.y, 0};
      std::size_t nearest = 0;
      for (std::size_t i = 1; i < points.size(); ++i)
        if (points.domain->distance(points[i], place) < points.domain->distance(points[nearest], place))
          nearest = i;
      const Vec2 to{wrap_difference(place.x - points[nearest].x, box.size.x) / d,
                    wrap_difference(place.y - points[nearest].y, box.size.y) / d};
      CellMoments& m = all[nearest];
      const double area = step.x * step.y / (d * d);
      m.area += area;
      m.centroid = m.centroid + area * to;
      m.energy += area * norm2(to);
    }
  for (CellMoments& m : all) m.centroid = (1 / m.area) * m.centroid;
  return all;
}

TEST(StarCell, HasTheMomentsOfTheVoronoiCell) {
  for (const PointSet& points :
       {testing::mps(60, 1), testing::mps(80, 2, 2), testing::random_points(1, 1, 50, 3)}) {
    const std::vector<CellMoments> expected = brute_moments(points, 400);
    const StarMesh mesh(points, Control());
    double area_sum = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
      const StarCell cell(mesh, i);
      const CellMoments m = moments(cell), &e = expected[mesh.original(i)];
      EXPECT_NEAR(m.area, e.area, .02);
      EXPECT_NEAR(m.centroid.x, e.centroid.x, .02);
      EXPECT_NEAR(m.centroid.y, e.centroid.y, .02);
      EXPECT_NEAR(m.energy, e.energy, .02 * (1 + e.energy));
      EXPECT_NEAR(area(cell), m.area, 1e-12);
      area_sum += m.area;
    }
    const double d = mesh.spacing();
    EXPECT_NEAR(area_sum * d * d, points.domain->area(), 1e-9);
  }
}

TEST(StarCell, ReportsTheRadiiOfTheMesh) {
  const StarMesh mesh(testing::mps(300, 4), Control());
  double shortest2 = 1e9, outermost2 = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const CellMoments m = moments(StarCell(mesh, i));
    shortest2 = std::min(shortest2, m.shortest2);
    outermost2 = std::max(outermost2, m.outermost2);
  }
  EXPECT_NEAR(std::sqrt(shortest2), mesh.measure(Control()).shortest, 1e-12);
  EXPECT_NEAR(std::sqrt(outermost2), mesh.measure(Control()).outermost, 1e-9);
}

}  // namespace
}  // namespace wellspaced
