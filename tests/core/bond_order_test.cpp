#include "core/analyze/bond_order.h"

#include <cmath>
#include <complex>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "core/math.h"
#include "core/optimize/opt_beta.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::collect_stars;
using testing::expect_error;
using testing::mps;
using testing::random_points;

std::complex<double> sixfold(Vec2 d) { return std::polar(1.0, 6 * std::atan2(d.y, d.x)); }

/// By the definitions, from CGAL's triangulation.
BondOrder brute_bond_order(const PointSet& points) {
  BondOrder result;
  std::complex<double> all;
  double terms = 0;
  for (const std::vector<Spoke>& star : collect_stars(points, visit_stars_by_cgal)) {
    std::complex<double> psi6, edges;
    for (std::size_t k = 0; k < star.size(); ++k) {
      psi6 += sixfold(star[k].offset) / static_cast<double>(star.size());
      edges += sixfold(star[(k + 1) % star.size()].offset - star[k].offset);
    }
    all += psi6;
    terms += static_cast<double>(star.size());
    result.psi6.push_back(std::abs(psi6));
    result.psi6_local += std::abs(psi6) / static_cast<double>(points.size());
    result.psi6_edges += std::abs(edges);
  }
  result.psi6_global = std::abs(all) / static_cast<double>(points.size());
  result.psi6_edges /= terms;
  return result;
}

void expect_near(const BondOrder& a, const BondOrder& b, double tolerance) {
  EXPECT_NEAR(a.psi6_global, b.psi6_global, tolerance);
  EXPECT_NEAR(a.psi6_local, b.psi6_local, tolerance);
  EXPECT_NEAR(a.psi6_edges, b.psi6_edges, tolerance);
  ASSERT_EQ(a.psi6.size(), b.psi6.size());
  for (std::size_t i = 0; i < a.psi6.size(); ++i) ASSERT_NEAR(a.psi6[i], b.psi6[i], tolerance) << i;
}

/// A triangular lattice that the torus fits, and one turned by 30 degrees.
PointSet lattice(bool upright) {
  Control control;
  const double root = std::sqrt(3.0);
  return triangular_lattice(std::make_shared<Torus>(upright ? root : 1, upright ? 1 : root), 800, control);
}

TEST(BondOrder, AgreesWithItsDefinitions) {
  const std::tuple<double, double, std::size_t> shapes[] = {
      {1, 1, 3}, {1, 1, 50}, {2, 0.1, 30}, {1, 1, 3000}};
  for (const auto& [width, height, n] : shapes) {
    SCOPED_TRACE(::testing::Message() << width << " x " << height << ", n " << n);
    const PointSet points = random_points(width, height, n, 7);
    expect_near(bond_order(points, Control(2)), brute_bond_order(points), 1e-11);
  }
  expect_near(bond_order(mps(2000, 3), Control(2)), brute_bond_order(mps(2000, 3)), 1e-11);
}

TEST(BondOrder, OfTheTriangularLatticeIsOne) {
  for (const bool upright : {false, true}) {
    const BondOrder order = bond_order(lattice(upright), Control());
    EXPECT_NEAR(order.psi6_global, 1, 1e-12);
    EXPECT_NEAR(order.psi6_local, 1, 1e-12);
    EXPECT_NEAR(order.psi6_edges, 1, 1e-12);
    ASSERT_EQ(order.psi6.size(), 800u);
    for (const double psi6 : order.psi6) EXPECT_NEAR(psi6, 1, 1e-12);
  }
}

TEST(BondOrder, OfTwoCrystalsIsHighLocallyOnly) {
  // On one half the lattice, on the other the lattice turned by 30 degrees: 1 + -1.
  const PointSet lying = lattice(false), standing = lattice(true);
  PointSet both{std::make_shared<Torus>(2, std::sqrt(3.0)), {}};
  for (std::size_t i = 0; i < lying.size(); ++i) both.push_back(lying[i]);
  for (int tile = 0; tile < 3; ++tile)
    for (std::size_t i = 0; i < standing.size(); ++i) {
      const Vec3 p{1 + standing[i].x, standing[i].y + tile, 0};
      if (p.x < 1.98 && p.y < 1.7) both.push_back(p);
    }
  const BondOrder order = bond_order(both, Control());
  EXPECT_GT(order.psi6_local, 0.8);
  EXPECT_GT(order.psi6_edges, 0.8);
  EXPECT_LT(order.psi6_global, 0.2);
}

TEST(BondOrder, DoesNotNoticeSwappedAxesTranslationsOrScale) {
  const PointSet points = random_points(1, 1, 800, 3);
  PointSet swapped = points, moved = points, larger{std::make_shared<Torus>(1024, 1024), points.coordinates};
  for (std::size_t i = 0; i < points.size(); ++i) {
    swapped.set(i, {points[i].y, points[i].x, 0});  // conjugates exp(6 i theta)
    moved.set(i, points.domain->step(points[i], {0.3071, 0.8123}));
  }
  for (double& c : larger.coordinates) c *= 1024;
  const BondOrder order = bond_order(points, Control());
  expect_near(order, bond_order(swapped, Control()), 1e-11);
  expect_near(order, bond_order(moved, Control()), 1e-9);
  expect_near(order, bond_order(larger, Control()), 0);
}

TEST(BondOrder, RisesFromWhiteNoiseToWellSpacedSets) {
  // The numbers are those that sets of a million points have.
  const PointSet input = mps(5000, 2);
  OptBetaOptions options;
  options.beta = 0.75;
  Control control(2);
  const BondOrder white = bond_order(random_points(1, 1, 5000, 2), control),
                  spaced = bond_order(input, control),
                  optimized = bond_order(opt_beta(input, options, control).points, control);
  EXPECT_NEAR(white.psi6_local, 0.361, 0.01);
  EXPECT_NEAR(white.psi6_edges, 0.364, 0.01);
  EXPECT_NEAR(spaced.psi6_local, 0.438, 0.01);
  EXPECT_NEAR(spaced.psi6_edges, 0.369, 0.01);
  EXPECT_GT(optimized.psi6_local, spaced.psi6_local + 0.05);
  EXPECT_GT(optimized.psi6_edges, spaced.psi6_edges + 0.02);
  for (const BondOrder& order : {white, spaced, optimized}) {
    EXPECT_LT(order.psi6_global, 0.05) << "no direction is preferred";
    EXPECT_LE(order.psi6_global, order.psi6_local);
  }
}

TEST(BondOrder, IsTheSameOnAnyNumberOfThreads) {
  const PointSet points = random_points(1, 1, 20000, 3);
  const BondOrder one = bond_order(points, Control(1));
  for (unsigned threads : {2u, 3u, 8u}) expect_near(one, bond_order(points, Control(threads)), 0);
}

TEST(BondOrder, OfTinyDistancesStaysFinite) {
  PointSet points = random_points(1, 1, 20, 3);
  points.set(0, {0, 0, 0});
  points.set(1, {2e-10, 0, 0});
  points.set(2, {0, 2e-10, 0});
  const BondOrder order = bond_order(points, Control());
  for (const double psi6 : order.psi6) {
    EXPECT_GE(psi6, 0);
    EXPECT_LE(psi6, 1 + 1e-12);
  }
}

TEST(BondOrder, RefusesWhatHasNoTriangulation) {
  expect_error([] { bond_order(random_points(1, 1, 2, 1), Control()); }, ErrorCode::degenerate_input, "");
  PointSet points = random_points(1, 1, 5, 1);
  points.set(4, points[2]);
  expect_error([&] { bond_order(points, Control()); }, ErrorCode::degenerate_input, "/4");
}

TEST(BondOrder, CanBeCancelled) {
  Control control(2);
  control.cancel();
  expect_error([&] { bond_order(random_points(1, 1, 5000, 3), control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
