#include "core/domain/grid_sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/sizing.h"
#include "core/domain/surface_mesh.h"
#include "core/domain/vertex_sizing.h"
#include "tests/support/domains.h"
#include "tests/support/meshes.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::expect_error;
using testing::icosahedron;
using testing::refined_sphere;

RadiusGrid random_grid(std::size_t columns, std::size_t rows, std::uint64_t seed) {
  Rng rng(seed);
  RadiusGrid grid{columns, rows, std::vector<double>(columns * rows)};
  for (double& r : grid.radii) r = 0.05 + 0.1 * rng.uniform();
  return grid;
}

/// The steepest slope that is found between near places.
double steepest_found(const Domain& domain, const Sizing& sizing, double step) {
  Rng rng(3);
  double most = 0;
  for (int k = 0; k < 200000; ++k) {
    const Vec3 p = domain.random_point(rng);
    const double angle = 2 * std::numbers::pi * rng.uniform();
    const Vec3 q = domain.place_at(p, step * Vec2{std::cos(angle), std::sin(angle)});
    if (domain.why_outside(q)) continue;
    most = std::max(most, std::fabs(sizing.at(p) - sizing.at(q)) / domain.distance(p, q));
  }
  return most;
}

TEST(GridSizing, HasItsValuesInTheMiddlesOfCellsAndIsBilinearBetween) {
  const BoxDomain box(3, 2);
  const GridSizing sizing(box, {3, 2, {1, 2, 3, 5, 7, 11}});
  EXPECT_DOUBLE_EQ(sizing.at({0.5, 0.5, 0}), 1);
  EXPECT_DOUBLE_EQ(sizing.at({2.5, 0.5, 0}), 3);
  EXPECT_DOUBLE_EQ(sizing.at({0.5, 1.5, 0}), 5);
  EXPECT_DOUBLE_EQ(sizing.at({2, 1, 0}), (2 + 3 + 7 + 11) / 4.0);
  EXPECT_DOUBLE_EQ(sizing.at({0, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(sizing.at({3, 2, 0}), 11);
  EXPECT_EQ(sizing.least(), 1);
  EXPECT_EQ(sizing.most(), 11);
  EXPECT_DOUBLE_EQ(sizing.lipschitz(), std::hypot(4, 8));  // in the corner of 11
}

TEST(GridSizing, GoesAroundPeriodicAxes) {
  const BoxDomain strip(2, 1, {true, false});
  const GridSizing sizing(strip, {2, 1, {1, 3}});
  EXPECT_DOUBLE_EQ(sizing.at({0, 0.3, 0}), 2);
  EXPECT_DOUBLE_EQ(sizing.at({1.75, 0.9, 0}), 2.5);
  EXPECT_DOUBLE_EQ(sizing.lipschitz(), 2);
}

TEST(GridSizing, IsAsSteepAsItSaysOnEveryDomain) {
  for (const auto& [name, domain] : testing::domains_of_every_kind())
    for (const auto& [columns, rows] : {std::pair<std::size_t, std::size_t>{7, 5}, {1, 1}, {4, 1}, {1, 3}}) {
      SCOPED_TRACE(name + " " + std::to_string(columns) + " x " + std::to_string(rows));
      const GridSizing sizing(*domain, random_grid(columns, rows, 4));
      const double found = steepest_found(*domain, sizing, 1e-5);
      EXPECT_LE(found, sizing.lipschitz() * (1 + 1e-6));
      EXPECT_GE(found, (domain->is_flat() ? 0.93 : 0.4) * sizing.lipschitz());
    }
}

TEST(GridSizing, NoRadiusNearbyIsBelowTheLeastOne) {
  double gap = 0, slope_gap = 0;  // on planar domains
  for (const auto& [name, domain] : testing::domains_of_every_kind()) {
    SCOPED_TRACE(name);
    RadiusGrid grid = random_grid(30, 20, 5);
    for (std::size_t k = 0; k < grid.radii.size(); ++k) grid.radii[k] += k % 30 < 15 ? 0.0 : 1.0;  // a step
    const GridSizing sizing(*domain, grid);
    Rng rng(6);
    for (int k = 0; k < 300; ++k) {
      const Vec3 p = domain->random_point(rng);
      const double distance = 0.15 * rng.uniform();
      double least = sizing.at(p);
      for (int m = 0; m < 300; ++m) {
        const double angle = 2 * std::numbers::pi * rng.uniform(), far = distance * std::sqrt(rng.uniform());
        const Vec3 q =
            domain->place_at(p, domain->distance_to_chart(far) * Vec2{std::cos(angle), std::sin(angle)});
        if (!domain->why_outside(q)) least = std::min(least, sizing.at(q));
      }
      ASSERT_LE(sizing.least_near(p, distance), least) << k;
      if (!domain->is_flat()) continue;
      gap += least - sizing.least_near(p, distance);
      slope_gap += least - std::max(sizing.least(), sizing.at(p) - sizing.lipschitz() * distance);
    }
  }
  EXPECT_LT(gap, 0.5 * slope_gap) << "not much better than by the slope";
}

TEST(GridSizing, OnASphereIsByLongitudeAndLatitude) {
  const Sphere sphere(2);
  const GridSizing sizing(sphere, {4, 2, {1, 2, 3, 4, 5, 6, 7, 8}});
  const auto at = [&](double longitude, double latitude) {
    const double a = longitude * std::numbers::pi / 180, b = latitude * std::numbers::pi / 180;
    return sizing.at(2.0 * Vec3{std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)});
  };
  EXPECT_NEAR(at(-135, -45), 1, 1e-12);
  EXPECT_NEAR(at(135, 45), 8, 1e-12);
  EXPECT_NEAR(at(180, -45), 2.5, 1e-12);
  EXPECT_NEAR(at(17, -90), 2.5, 1e-12);
  EXPECT_NEAR(at(-80, 90), 6.5, 1e-12);
  EXPECT_NEAR(at(-135, 67.5), 5.75, 1e-12);
}

TEST(GridSizing, RefusesWhatIsNoGrid) {
  const BoxDomain box;
  const auto refused = [&](RadiusGrid grid, const char* where) {
    expect_error([&] { GridSizing sizing(box, std::move(grid)); }, ErrorCode::invalid_parameters, where);
  };
  refused({}, "/radii");
  refused({2, 2, {1, 1, 1}}, "/radii");
  refused({2, 2, {1, 1, 1, 0}}, "/radii/1/1");
  refused({2, 2, {1, std::numeric_limits<double>::quiet_NaN(), 1, 0}}, "/radii/0/1");
  const SurfaceMesh mesh{TriangleMesh(icosahedron())};
  expect_error([&] { GridSizing sizing(mesh, {1, 1, {1}}); }, ErrorCode::invalid_parameters, "");
}

TEST(VertexSizing, IsLinearOnFaces) {
  const SurfaceMesh mesh{TriangleMesh(refined_sphere(icosahedron(), 2))};
  const LinearSizing linear(mesh, {2, 0.1, 0.4});
  std::vector<double> radii;
  for (const Vec3 v : mesh.mesh().vertices()) radii.push_back(linear.at(v));
  const VertexSizing sizing(mesh, radii);
  Rng rng(2);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 p = mesh.random_point(rng);
    EXPECT_NEAR(sizing.at(p), linear.at(p), 1e-12);
  }
  EXPECT_EQ(sizing.least(), *std::min_element(radii.begin(), radii.end()));
  EXPECT_EQ(sizing.most(), *std::max_element(radii.begin(), radii.end()));
  EXPECT_LE(sizing.lipschitz(), linear.lipschitz() * (1 + 1e-12));
  EXPECT_GT(sizing.lipschitz(), 0.95 * linear.lipschitz());
  EXPECT_NEAR(steepest_found(mesh, sizing, 1e-6), sizing.lipschitz(), 0.02 * sizing.lipschitz());
}

TEST(VertexSizing, RefusesWhatIsNoRadius) {
  const SurfaceMesh mesh{TriangleMesh(icosahedron())};
  expect_error([&] { VertexSizing sizing(mesh, std::vector<double>(11, 1)); }, ErrorCode::invalid_parameters,
               "/radii");
  std::vector<double> radii(12, 1);
  radii[5] = -1;
  expect_error([&] { VertexSizing sizing(mesh, radii); }, ErrorCode::invalid_parameters, "/radii/5");
}

}  // namespace
}  // namespace wellspaced
