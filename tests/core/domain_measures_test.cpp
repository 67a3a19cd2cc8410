// Distributions, local measures and bond order on every domain, against the triangles of meshes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/analyze/bond_order.h"
#include "core/analyze/certificate.h"
#include "core/analyze/distributions.h"
#include "core/analyze/domain_certificate.h"
#include "core/analyze/domain_spacing.h"
#include "core/analyze/local_measures.h"
#include "core/analyze/spacing.h"
#include "core/domain/sphere.h"
#include "core/math.h"
#include "core/mesh/mesh_quality.h"
#include "core/mesh/meshing.h"
#include "tests/support/domains.h"

namespace wellspaced {
namespace {

using testing::mps_on;

const Control plain;

/// The angles of all triangles, in degrees.
std::vector<double> angles_of(const Mesh& mesh) {
  std::vector<double> angles;
  for (std::size_t f = 0; f < mesh.faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 at = mesh.vertices[mesh[f][k]];
      const Vec3 a = mesh.vertices[mesh[f][(k + 1) % 3]] - at, b = mesh.vertices[mesh[f][(k + 2) % 3]] - at;
      angles.push_back(180 / pi * std::acos(dot(a, b) / (norm(a) * norm(b))));
    }
  return angles;
}

std::uint64_t total(const Histogram& histogram) { return histogram.total(); }

TEST(DomainMeasures, CountTheTrianglesAndEdgesOfTheMesh) {
  for (const auto& [name, domain] : testing::domains_of_every_kind()) {
    if (name == "torus") continue;
    SCOPED_TRACE(name);
    const PointSet points = testing::mps_on(domain, 300, 4);
    const Mesh mesh = delaunay_mesh(points, plain);
    const MeshQuality quality = measure_quality(mesh);
    const Distributions all = distributions(points, plain);
    EXPECT_EQ(total(all.valence), points.size());
    // Neighbors are points whose cells touch inside: at a boundary some triangle may be of others.
    const double left_out = domain->is_flat() ? 0.02 : 0;
    const auto triangles = static_cast<double>(mesh.faces()),
               edges = static_cast<double>(quality.topology->edges);
    EXPECT_LE(total(all.angle_deg), 3 * mesh.faces());
    EXPECT_GE(static_cast<double>(total(all.angle_deg)), (1 - left_out) * 3 * triangles);
    EXPECT_LE(total(all.edge), quality.topology->edges);
    EXPECT_GE(static_cast<double>(total(all.edge)), (1 - left_out) * edges);
    EXPECT_NEAR(all.valence.mean, 2 * edges / static_cast<double>(points.size()), 6 * left_out + 1e-9);
    std::vector<double> angles = angles_of(mesh);
    const double slack =
        domain->is_flat() ? 1e-6 : 1;  // triangles on a sphere are a little larger than flat ones
    EXPECT_GE(all.angle_deg.min, *std::min_element(angles.begin(), angles.end()) - slack);
    EXPECT_LE(all.angle_deg.max, *std::max_element(angles.begin(), angles.end()) + slack);
    EXPECT_NEAR(all.angle_deg.mean, 60, 1);
  }
}

TEST(DomainMeasures, AgreeWithSpacing) {
  for (const auto& [name, domain] : testing::domains_of_every_kind()) {
    SCOPED_TRACE(name);
    const PointSet points = testing::mps_on(domain, 300, 4);
    const LocalSpacing spacing = measure_local_spacing(points, plain);
    const Distributions all = distributions(points, plain);
    EXPECT_NEAR(all.beta_i.max, spacing.global.beta_i_max, 1e-12);
    EXPECT_NEAR(all.beta_i.mean, spacing.global.beta_i_mean, 1e-12);
    EXPECT_NEAR(all.nearest.min, spacing.global.r_f / hexagonal_spacing(*domain, points.size()), 1e-9);
    EXPECT_NEAR(all.cell_area.mean, 1, 1e-9);
    EXPECT_NEAR(all.cell_area.sd, spacing.global.cell_area_sd, 1e-9);
    EXPECT_GE(all.angle_deg.min, spacing.global.angle_min_deg - 1e-6);
    const std::vector<double> beta_i = measure_locally(points, LocalMeasure::beta_i, plain);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(beta_i[i], spacing.beta_i[i], 1e-12);
    const std::vector<double> areas = measure_locally(points, LocalMeasure::area, plain),
                              angles = measure_locally(points, LocalMeasure::angle, plain),
                              valences = measure_locally(points, LocalMeasure::valence, plain);
    EXPECT_NEAR(*std::max_element(areas.begin(), areas.end()), all.cell_area.max, 1e-9);
    EXPECT_NEAR(*std::min_element(angles.begin(), angles.end()), spacing.global.angle_min_deg, 1e-6);
    EXPECT_EQ(*std::max_element(valences.begin(), valences.end()), spacing.global.valence.rbegin()->first);
  }
}

TEST(DomainMeasures, SeeTheOrderOfALatticeInABox) {
  PointSet points{std::make_shared<BoxDomain>(1, 1), {}};
  Rng rng(1);
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 14; ++column) {
      const double x = (column + 0.3 + 0.5 * (row % 2)) / 14.9, y = (row + 0.5) * std::sqrt(3) / 2 / 14.9;
      points.push_back({x, y, 0});
    }
  const BondOrder order = bond_order(points, plain);
  EXPECT_GT(order.psi6_global, 0.8) << "but at the boundary all directions are sixfold";
  EXPECT_GT(order.psi6_local, 0.8);
  const auto sphere = std::make_shared<Sphere>(1);
  const BondOrder curved = bond_order(testing::mps_on(sphere, 200, 1), plain);
  EXPECT_TRUE(std::isnan(curved.psi6_global));
  EXPECT_GT(curved.psi6_local, 0.1);
  EXPECT_LT(curved.psi6_local, 0.7);
}

/// Cells of points on one great circle are lunes, from pole to pole.
TEST(DomainMeasures, AreasOfCellsPastTheHorizonOfASphereAreThoseOfLunes) {
  const auto sphere = std::make_shared<Sphere>(3.0);
  for (const std::vector<double>& turns : {std::vector<double>{0, 0.25, 0.5},
                                           {0, 0.1, 0.15},
                                           {0.01, 0.3, 0.31, 0.7},
                                           {0, 0.02, 0.04, 0.5, 0.53}}) {
    PointSet points{sphere, {}};
    for (const double t : turns) {
      const CosSin c = portable_cos_sin(t);
      points.push_back({3 * 0.6 * c.cos, 3 * c.sin, 3 * 0.8 * c.cos});
    }
    const std::vector<double> areas = measure_locally(points, LocalMeasure::area, plain);
    const double mean = 1.0 / static_cast<double>(turns.size());
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const double next = k + 1 < turns.size() ? turns[k + 1] : turns[0] + 1;
      const double before = k > 0 ? turns[k - 1] : turns.back() - 1;
      EXPECT_NEAR(areas[k], (next - before) / 2 / mean, 1e-8) << turns.size() << " " << k;
    }
  }
}

/// The torus has a way of its own, which knows nothing of MovingSet.
TEST(MeasureDomainSpacing, SaysOfATorusWhatItsTriangulationSays) {
  const PointSet points = mps_on(std::make_shared<Torus>(1.5, 1), 700, 9);
  const LocalSpacing a = measure_domain_spacing(points, plain), b = measure_local_spacing(points, plain);
  EXPECT_NEAR(a.global.beta, b.global.beta, 1e-12);
  EXPECT_NEAR(a.global.r_f, b.global.r_f, 1e-14);
  EXPECT_NEAR(a.global.r_c, b.global.r_c, 1e-13);
  EXPECT_NEAR(a.global.rho, b.global.rho, 1e-12);
  EXPECT_NEAR(a.global.packing_density, b.global.packing_density, 1e-12);
  EXPECT_NEAR(a.global.nearest_mean, b.global.nearest_mean, 1e-12);
  EXPECT_NEAR(a.global.cell_area_sd, b.global.cell_area_sd, 1e-11);
  EXPECT_NEAR(a.global.angle_min_deg, b.global.angle_min_deg, 1e-9);
  EXPECT_NEAR(a.global.angle_max_deg, b.global.angle_max_deg, 1e-9);
  EXPECT_NEAR(a.global.edge_max, b.global.edge_max, 1e-12);
  EXPECT_EQ(a.global.valence, b.global.valence);
  ASSERT_EQ(a.beta_i.size(), b.beta_i.size());
  for (std::size_t i = 0; i < a.beta_i.size(); ++i) EXPECT_NEAR(a.beta_i[i], b.beta_i[i], 1e-11);
}

TEST(MeasureDomainSpacing, ValencesOfASphereObeyEuler) {
  const PointSet points = mps_on(std::make_shared<Sphere>(2), 500, 2);
  const Spacing s = measure_spacing(points, plain);
  int sum = 0;
  for (const auto& [valence, count] : s.valence) sum += valence * static_cast<int>(count);
  EXPECT_EQ(sum, 6 * static_cast<int>(points.size()) - 12);
}

/// The radius of the smallest cap that holds all points, by what it is about: one, two or three of them.
/// What is farthest from all is the opposite place of its center, where it is no more than half a sphere.
TEST(MeasureDomainSpacing, OfPointsInOneHalfOfASphereSeesPastTheHorizon) {
  Rng rng(3);
  for (int trial = 0; trial < 200; ++trial) {
    const double radius = trial % 2 == 0 ? 1 : 3;
    PointSet points{std::make_shared<Sphere>(radius), {}};
    const std::size_t n = 3 + static_cast<std::size_t>(trial % 9);
    const double low = trial % 3 == 0 ? 0.9 : 0.05;
    while (points.size() < n) {
      const Vec3 p = points.domain->random_point(rng);
      if (p.z > low * radius) points.push_back(p);
    }
    double farthest = 0;
    const auto look = [&](Vec3 center) {
      if (!(norm(center) > 1e-9)) return;
      for (const double sign : {1.0, -1.0}) {
        const Vec3 at = (sign * radius / norm(center)) * center;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < n; ++i)
          nearest = std::min(nearest, points.domain->distance(at, points[i]));
        farthest = std::max(farthest, nearest);
      }
    };
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        look(points[i] + points[j]);
        for (std::size_t k = 0; k < j; ++k) look(cross(points[j] - points[i], points[k] - points[i]));
      }
    EXPECT_NEAR(measure_spacing(points, plain).r_c, farthest, 1e-9 * radius)
        << n << " points, trial " << trial;
    EXPECT_FALSE(certify(points, plain).has_value());
  }
  PointSet axes{std::make_shared<Sphere>(1), {1, 0, 0, 0, 1, 0, 0, 0, 1}};
  EXPECT_NEAR(measure_spacing(axes, plain).r_c, std::numbers::pi - std::acos(1 / std::sqrt(3.0)), 1e-12);
}

}  // namespace
}  // namespace wellspaced
