#include "core/voronoi/cell_finder.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/generate.h"
#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "tests/support/oracle.h"
#include "tests/support/vector_widths.h"

namespace wellspaced {
namespace {

using testing::expect_error;
using testing::random_points;

PointSet mps(std::uint64_t count, std::uint64_t seed) {
  Rng rng(seed);
  Control control;
  return poisson_disk(std::make_shared<Torus>(), {poisson_disk_radius(1, count)}, rng, control);
}

struct Image {
  long double x, y, d2;
  bool own;
};

/// The nearest 48 images of all samples as seen from a candidate for sample i.
std::vector<Image> images_around(const PointSet& points, std::size_t i, Vec2 u) {
  const Box box = points.domain->box();
  std::vector<Image> images;
  for (std::size_t j = 0; j < points.size(); ++j)
    for (int ty = -4; ty <= 4; ++ty)
      for (int tx = -4; tx <= 4; ++tx) {
        if (i == j && tx == 0 && ty == 0) continue;
        const bool own = i == j;
        const long double x =
            (static_cast<long double>(points[j].x) - points[i].x) + tx * box.size.x - (own ? 0 : u.x);
        const long double y =
            (static_cast<long double>(points[j].y) - points[i].y) + ty * box.size.y - (own ? 0 : u.y);
        images.push_back({x, y, x * x + y * y, own});
      }
  const auto nearer = [](const Image& a, const Image& b) { return a.d2 < b.d2; };
  const std::size_t wanted = std::min<std::size_t>(48, images.size());
  std::partial_sort(images.begin(), images.begin() + static_cast<std::ptrdiff_t>(wanted), images.end(),
                    nearer);
  images.resize(wanted);
  return images;
}

/// By definition: r_c is the radius of the largest disk with the candidate and two images on its rim and
/// nobody inside.
CellFinder::Radii brute_radii(const std::vector<Image>& images) {
  long double nearest2 = 1e300L, most2 = 0;
  for (const Image& a : images) {
    if (!a.own) nearest2 = std::min(nearest2, a.d2);
    for (const Image& b : images) {
      const long double twice = 2 * (a.x * b.y - a.y * b.x);
      if (!(twice > 0)) continue;
      const long double x = (b.y * a.d2 - a.y * b.d2) / twice, y = (a.x * b.d2 - b.x * a.d2) / twice;
      const long double r2 = x * x + y * y;
      if (r2 <= most2 || 4 * r2 > images.back().d2) continue;
      if (std::all_of(images.begin(), images.end(), [&](const Image& q) {
            return (q.x - x) * (q.x - x) + (q.y - y) * (q.y - y) >= r2 * (1 - 1e-13L);
          }))
        most2 = r2;
    }
  }
  return {static_cast<double>(std::sqrt(nearest2)), static_cast<double>(std::sqrt(most2))};
}

struct Setting {
  const PointSet& points;
  double spacing;
  NeighborGrid grid;

  explicit Setting(const PointSet& p)
      : points(p), spacing(hexagonal_spacing(p.domain->area(), p.size())), grid(p, spacing) {}
};

void expect_radii(const Setting& s, std::uint32_t i, Vec2 u, CellFinder::Radii found, double relative) {
  const CellFinder::Radii wanted = brute_radii(images_around(s.points, i, u));
  EXPECT_NEAR(found.r_f, wanted.r_f, 1e-13 * s.spacing) << i << " at " << u.x << ", " << u.y;
  EXPECT_NEAR(found.r_c, wanted.r_c, relative * wanted.r_c) << i << " at " << u.x << ", " << u.y;
}

TEST(CellFinder, FindsRadiiByDefinitionWhereverACandidateJumps) {
  Control control;
  for (const PointSet& points :
       {mps(300, 1), mps(40, 2), random_points(1, 1, 200, 3), random_points(2, 0.3, 60, 4)})
    for (const double reach : {1.0, 2.0, 3.0}) {
      const Setting s(points);
      CellFinder finder(points, s.grid, reach * s.spacing, control);
      Rng rng(5);
      for (std::uint32_t i = 0; i < 10; ++i) {
        finder.load(i);
        for (int k = 0; k < 12; ++k) {
          const double far = (k < 6 ? 0.1 : 1.2) * s.spacing;
          const Vec2 u{far * (2 * rng.uniform() - 1), far * (2 * rng.uniform() - 1)};
          expect_radii(s, i, u, finder.radii_at(u), 1e-12);
        }
      }
    }
}

TEST(CellFinder, FindsRadiiOnToriOfFewPoints) {
  Control control;
  for (const PointSet& points :
       {random_points(1, 1, 3, 1), random_points(1, 1, 7, 2), random_points(3, 1, 5, 3)}) {
    const Setting s(points);
    CellFinder finder(points, s.grid, 2 * s.spacing, control);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      finder.load(i);
      for (const Vec2 u : {Vec2{0, 0}, Vec2{0.01, 0.02}, Vec2{-0.03, 0.005}})
        expect_radii(s, i, u, finder.radii_at(u), 1e-12);
    }
  }
}

TEST(CellFinder, TakesCocircularNeighborsAsTheyCome) {
  Control control;
  for (const PointSet& points :
       {square_lattice(std::make_shared<Torus>(), 400, control),
        triangular_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 800, control),
        hexagonal_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 1600, control)}) {
    const Setting s(points);
    CellFinder finder(points, s.grid, 2 * s.spacing, control);
    Rng rng(1);
    for (std::uint32_t i = 7; i < 400; i += 97) {
      finder.load(i);
      const CellFinder::Radii at_home = finder.radii_at({});
      expect_radii(s, i, {}, at_home, 1e-12);
      for (int k = 0; k < 12; ++k) {
        const double far = std::pow(10.0, -k) * s.spacing;  // from out of the hull to within rounding
        const Vec2 u{far * rng.uniform(), far * rng.uniform()};
        expect_radii(s, i, u, finder.radii_at(u), 1e-12);
      }
      EXPECT_NEAR(finder.radii_at({}).r_c, at_home.r_c, 1e-12 * at_home.r_c);
    }
  }
}

TEST(CellFinder, PutsACandidateOnANeighbor) {
  Control control;
  const PointSet points = mps(200, 1);
  const Setting s(points);
  CellFinder finder(points, s.grid, 2 * s.spacing, control);
  finder.load(100);
  finder.radii_at({});
  finder.cell_at({});
  const Vec3 nearest = finder.neighbors()[0].offset;
  EXPECT_EQ(finder.radii_at({nearest.x, nearest.y}).r_f, 0);
  expect_radii(s, 100, {0.01, 0}, finder.radii_at({0.01, 0}), 1e-12);
}

TEST(CellFinder, SeesTheSameCellInRadiiAndCorners) {
  Control control;
  const PointSet points = random_points(1, 1, 500, 6);
  const Setting s(points);
  CellFinder finder(points, s.grid, 2 * s.spacing, control);
  for (std::uint32_t i = 0; i < 500; ++i) {
    finder.load(i);
    const Vec2 u{0.1 * s.spacing, -0.2 * s.spacing};
    const CellFinder::Radii radii = finder.radii_at(u);
    EXPECT_NEAR(std::sqrt(finder.cell_at(u).outradius2()), radii.r_c, 1e-12 * radii.r_c);
    EXPECT_TRUE(
        std::is_sorted(finder.neighbors().begin(), finder.neighbors().end(),
                       [](const auto& a, const auto& b) { return norm2(a.offset) < norm2(b.offset); }));
    EXPECT_NEAR(finder.radii_at(u).r_c, radii.r_c, 1e-12 * radii.r_c);
  }
}

TEST(CellFinder, FindsTheSameBitsOnAnyVectorWidth) {
  const PointSet even = mps(500, 7), random = random_points(1, 1, 500, 8);
  Control lattice_control;
  const PointSet square = square_lattice(std::make_shared<Torus>(), 400, lattice_control);
  for (const PointSet* points : {&even, &random, &square}) {
    std::vector<double> first;
    testing::on_every_vector_width([&](const std::string& name) {
      Control control;
      const Setting s(*points);
      CellFinder finder(*points, s.grid, 2 * s.spacing, control);
      Rng rng(9);
      std::vector<double> all;
      for (std::uint32_t i = 0; i < 300; ++i) {
        finder.load(i);
        for (int k = 0; k < 15; ++k) {
          const double far = (k % 5 == 0 ? 1 : 0.2) * s.spacing;
          const CellFinder::Radii radii =
              finder.radii_at({far * (rng.uniform() - 0.5), far * (rng.uniform() - 0.5)});
          all.push_back(radii.r_f);
          all.push_back(radii.r_c);
        }
      }
      if (first.empty()) first = all;
      EXPECT_TRUE(first == all) << name;
    });
  }
}

TEST(CellFinder, StopsInACrowdWhenItIsCancelled) {
  PointSet heap = random_points(1, 1, 3000, 1);
  for (double& c : heap.coordinates) c *= 1e-2;
  Control control;
  const Setting s(heap);
  CellFinder finder(heap, s.grid, 2 * s.spacing, control);
  control.cancel();
  expect_error([&] { finder.load(0); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
