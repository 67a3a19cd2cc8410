#include "core/voronoi/gift_wrap.h"

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/generate/generate.h"
#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/voronoi/stars.h"
#include "tests/support/oracle.h"
#include "tests/support/vector_widths.h"

namespace wellspaced {
namespace {

using testing::collect_stars;
using testing::expect_delaunay;
using testing::random_points;

PointSet mps(std::uint64_t count, std::uint64_t seed, double width = 1) {
  Rng rng(seed);
  Control control(2);
  return poisson_disk(std::make_shared<Torus>(width, 1), {poisson_disk_radius(width, count)}, rng, control);
}

GridOrder order_of(const PointSet& points) {
  return grid_order(points, wrap_cell * hexagonal_spacing(points.domain->area(), points.size()), Control());
}

std::set<std::uint32_t> ids(const std::vector<Spoke>& star) {
  std::set<std::uint32_t> set;
  for (const Spoke& spoke : star) set.insert(spoke.id);
  return set;
}

TEST(GridOrder, HoldsEveryPointOnceInItsCell) {
  for (const PointSet& points : {random_points(1, 1, 1000, 1), random_points(5, 0.2, 300, 2), mps(2000, 3)}) {
    const GridOrder order = order_of(points);
    std::set<std::uint32_t> seen(order.original.begin(), order.original.end());
    EXPECT_EQ(seen.size(), points.size());
    for (std::uint32_t c = 0; c < order.columns * order.rows; ++c)
      for (std::uint32_t k = order.start[c]; k < order.start[c + 1]; ++k) {
        EXPECT_EQ(order.row_of(order.y[k]) * order.columns + order.column_of(order.x[k]), c);
        EXPECT_EQ(points[order.original[k]], (Vec3{order.x[k], order.y[k], 0}));
        if (k > order.start[c]) {
          EXPECT_LT(order.original[k - 1], order.original[k]);
        }
      }
  }
}

TEST(WrapStars, OfEvenSetsAreDelaunay) {
  for (const PointSet& points : {mps(300, 1), mps(1000, 2, 3), mps(900, 3, 0.4)}) {
    EXPECT_TRUE(wrap_stars(order_of(points), Control(2)).has_value());
    expect_delaunay(points,
                    collect_stars(points, [](const PointSet& p, const Control& c, const StarVisitor& v) {
                      EXPECT_TRUE(visit_stars_by_wrapping(p, c, v));
                    }));
  }
}

TEST(WrapStars, AreThoseOfCgal) {
  // Above 8192 points there is more than one block.
  for (const PointSet& points : {mps(20000, 4), random_points(1, 1, 5000, 5), random_points(2, 1, 9000, 6)}) {
    std::vector<std::vector<Spoke>> wrapped(points.size());
    if (!visit_stars_by_wrapping(points, Control(2), [&](std::size_t i, std::span<const Spoke> spokes) {
          wrapped[i].assign(spokes.begin(), spokes.end());
        }))
      continue;
    const auto cgal = collect_stars(points, visit_stars_by_cgal);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(ids(wrapped[i]), ids(cgal[i])) << i;
  }
}

TEST(WrapStars, AreTheSameOnAnyNumberOfThreadsAndAnyVectorWidth) {
  const GridOrder order = order_of(mps(30000, 7));
  const auto same = [](const Star& a, const Star& b) {
    return a.degree == b.degree && std::equal(a.neighbor, a.neighbor + Star::most, b.neighbor);
  };
  const auto first = wrap_stars(order, Control(1)).value();
  testing::on_every_vector_width([&](const std::string& name) {
    for (const unsigned threads : {1u, 2u, 3u, 8u}) {
      const auto again = wrap_stars(order, Control(threads)).value();
      EXPECT_TRUE(std::equal(first.begin(), first.end(), again.begin(), same)) << name << " " << threads;
    }
  });
}

TEST(WrapStars, DeclineWhatDoesNotSuitThem) {
  const Control control;
  Control generating;
  EXPECT_FALSE(wrap_stars(order_of(random_points(1, 1, 12, 1)), control)) << "too few";
  EXPECT_FALSE(wrap_stars(order_of(random_points(1, 0.01, 500, 1)), control)) << "thin";
  PointSet heap = random_points(1, 1, 2000, 1);
  for (double& c : heap.coordinates) c *= 0.1;
  EXPECT_FALSE(wrap_stars(order_of(heap), control)) << "clustered";
  PointSet hole = mps(3000, 2);
  PointSet rest{hole.domain, {}};
  for (std::size_t i = 0; i < hole.size(); ++i)
    if (norm(hole[i] - Vec3{0.5, 0.5, 0}) > 0.3) rest.push_back(hole[i]);
  EXPECT_FALSE(wrap_stars(order_of(rest), control)) << "a hole";
  PointSet twins = mps(1000, 3);
  twins.push_back(twins[17]);
  EXPECT_FALSE(wrap_stars(order_of(twins), control)) << "two points the same";
}

TEST(WrapStars, OfLatticesAreMutualOrDeclined) {
  Control control;
  for (const auto lattice : {square_lattice, triangular_lattice, hexagonal_lattice}) {
    const PointSet points = lattice(std::make_shared<Torus>(), 1024, control);
    const auto stars = wrap_stars(order_of(points), control);
    if (!stars) continue;
    std::size_t edges = 0;
    for (const Star& star : *stars) edges += static_cast<std::size_t>(star.degree);
    EXPECT_EQ(edges, 6 * points.size()) << "Euler, on a torus";
  }
}

TEST(WrapStars, StopWhenTheyAreCancelled) {
  Control control;
  const GridOrder order = order_of(mps(1000, 1));
  control.cancel();
  testing::expect_error([&] { wrap_stars(order, control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
