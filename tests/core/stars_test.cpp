#include "core/voronoi/stars.h"

#include <set>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/voronoi/neighbors.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::collect_stars;
using testing::expect_delaunay;
using testing::random_points;

struct Shape {
  double width, height;
  std::size_t n;
};

/// Few points and thin tori, where cells touch their own images, and ordinary ones.
const Shape shapes[] = {{1, 1, 3},     {1, 1, 4},    {1, 1, 7},     {1, 1, 20},    {1, 1, 300}, {1, 1, 1500},
                        {3, 0.5, 400}, {1, 0.02, 5}, {0.02, 1, 40}, {100, 0.2, 6}, {1, 1.7, 12}};

/// Everything around one center, tight clusters and lines: what a uniform grid handles worst.
PointSet clustered(double spread, std::size_t n, std::uint64_t seed) {
  PointSet points = random_points(1, 1, n, seed);
  for (std::size_t i = 0; i < n; ++i)
    points.set(i, points.domain->step({0.99, 0.99, 0}, {spread * points[i].x, spread * points[i].y}));
  return points;
}

TEST(Stars, OfTheKernelAreDelaunayOnEveryTorus) {
  for (const Shape& s : shapes)
    for (std::uint64_t seed : {1u, 2u, 3u}) {
      SCOPED_TRACE(::testing::Message()
                   << s.width << " x " << s.height << ", n " << s.n << ", seed " << seed);
      const PointSet points = random_points(s.width, s.height, s.n, seed);
      expect_delaunay(points, collect_stars(points, visit_stars_by_kernel));
    }
}

TEST(Stars, OfCgalAreDelaunayOnEveryTorus) {
  for (const Shape& s : shapes) {
    SCOPED_TRACE(::testing::Message() << s.width << " x " << s.height << ", n " << s.n);
    const PointSet points = random_points(s.width, s.height, s.n, 4);
    expect_delaunay(points, collect_stars(points, visit_stars_by_cgal));
  }
}

TEST(Stars, OfKernelAndCgalAreTheSame) {
  for (const Shape& s : shapes) {
    SCOPED_TRACE(::testing::Message() << s.width << " x " << s.height << ", n " << s.n);
    const PointSet points = random_points(s.width, s.height, s.n, 5);
    const auto kernel = collect_stars(points, visit_stars_by_kernel),
               cgal = collect_stars(points, visit_stars_by_cgal);
    const auto as_set = [](const std::vector<Spoke>& star) {
      std::set<std::tuple<std::uint32_t, long, long>> set;
      for (const Spoke& spoke : star)
        set.insert({spoke.id, std::lround(spoke.offset.x * 1e9), std::lround(spoke.offset.y * 1e9)});
      return set;
    };
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(as_set(kernel[i]), as_set(cgal[i])) << i;
  }
}

TEST(Stars, OfClusteredSetsAreDelaunay) {
  for (double spread : {0.3, 1e-3, 1e-9}) {
    const PointSet points = clustered(spread, 600, 6);
    EXPECT_FALSE(is_even(points));
    expect_delaunay(points, collect_stars(points, visit_stars));
  }
}

TEST(Stars, TakeTheKernelForWhiteNoise) { EXPECT_TRUE(is_even(random_points(1, 1, 20000, 1))); }

TEST(Stars, OfTheSquareLatticeHaveNoSlivers) {
  Control control;
  const PointSet points = square_lattice(std::make_shared<Torus>(), 1024, control);
  for (const auto& star : collect_stars(points, visit_stars_by_kernel)) EXPECT_EQ(star.size(), 4u);
}

TEST(NeighborGrid, FindsWhatAllPairsFind) {
  for (const Shape& s : shapes) {
    SCOPED_TRACE(::testing::Message() << s.width << " x " << s.height << ", n " << s.n);
    const PointSet points = random_points(s.width, s.height, s.n, 7);
    const double spacing = hexagonal_spacing(points.domain->area(), s.n);
    const NeighborGrid grid(points, spacing);
    for (double reach : {0.3 * spacing, 2 * spacing, 0.6 * std::min(s.width, s.height)}) {
      std::vector<Neighbor> found;
      grid.gather(points[0], 0, reach, found);
      std::size_t wanted = 0;
      const int nx = static_cast<int>(reach / s.width) + 1, ny = static_cast<int>(reach / s.height) + 1;
      for (std::size_t j = 0; j < s.n; ++j)
        for (int ty = -ny; ty <= ny; ++ty)
          for (int tx = -nx; tx <= nx; ++tx)
            if (j != 0 || tx != 0 || ty != 0)
              wanted += norm(points[j] + Vec3{tx * s.width, ty * s.height, 0} - points[0]) <= reach;
      EXPECT_EQ(found.size(), wanted) << reach;
    }
  }
}

TEST(NeighborGrid, KeepsUpWithMovingPoints) {
  PointSet points = random_points(1, 1, 200, 8);
  NeighborGrid grid(points, 0.08);
  Rng rng(9);
  for (int step = 0; step < 2000; ++step) {
    const auto i = static_cast<std::uint32_t>(rng.below(200));
    const Vec3 from = points[i], to = points.domain->random_point(rng);
    points.set(i, to);
    grid.move(i, from, to);
  }
  for (std::uint32_t i = 0; i < 200; ++i) {
    std::vector<Neighbor> found;
    grid.gather(points[i], i, 0.2, found);
    std::size_t wanted = 0;
    for (std::size_t j = 0; j < 200; ++j)
      wanted += j != i && points.domain->distance(points[i], points[j]) <= 0.2;
    EXPECT_EQ(found.size(), wanted);
  }
}

TEST(VisitStarsOfCoverage, IsRightWhateverTheCoverageIsSaidToBe) {
  const PointSet points = random_points(2, 1, 300, 1);
  for (const double coverage : {0.01, 0.1, 1.0}) {
    SCOPED_TRACE(coverage);
    expect_delaunay(points,
                    collect_stars(points, [&](const PointSet& p, const Control& c, const StarVisitor& v) {
                      visit_stars_of_coverage(p, coverage, c, v);
                    }));
  }
}

}  // namespace
}  // namespace wellspaced
