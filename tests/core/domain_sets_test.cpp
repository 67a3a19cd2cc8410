// Generators, optimizers and measures on every kind of domain, against oracles that know nothing of cells.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "core/analyze/certificate.h"
#include "core/analyze/domain_certificate.h"
#include "core/analyze/domain_spacing.h"
#include "core/analyze/spacing.h"
#include "core/domain/polygon.h"
#include "core/domain/sizing.h"
#include "core/domain/sphere.h"
#include "core/generate/domain_darts.h"
#include "core/generate/domain_refinement.h"
#include "core/generate/enrich.h"
#include "core/generate/jittered.h"
#include "core/optimize/cvt.h"
#include "core/optimize/distmesh.h"
#include "core/optimize/opt_beta.h"
#include "core/registry.h"
#include "core/voronoi/moving_set.h"
#include "tests/support/domains.h"

namespace wellspaced {
namespace {

using testing::brute_r_c_on;
using testing::brute_r_f;
using testing::domains_of_every_kind;
using testing::expect_error;
using testing::mps_on;

const Control plain;

/// How often each freedom occurs: 0, 1, 2.
std::array<int, 3> freedoms(const PointSet& points) {
  std::array<int, 3> count{};
  for (std::size_t i = 0; i < points.size(); ++i)
    ++count[static_cast<std::size_t>(points.domain->freedom(points[i]).dimensions)];
  return count;
}

/// Over all pairs but those of two corners.
double brute_r_f_free(const PointSet& points) {
  double least = std::numeric_limits<double>::infinity();
  const auto is_corner = [&](std::size_t i) { return points.domain->freedom(points[i]).dimensions == 0; };
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!is_corner(i) || !is_corner(j))
        least = std::min(least, points.domain->distance(points[i], points[j]));
  return least;
}

/// White noise where a quarter of the domain, by x, is left empty; none on the boundary.
PointSet noise_with_a_hole(const std::shared_ptr<const Domain>& domain, std::size_t n) {
  PointSet points{domain, {}};
  Rng rng(n);
  const Box box = domain->box();
  while (points.size() < n) {
    const Vec3 p = domain->random_point(rng);
    if (p.x > box.low.x + box.size.x / 4) points.push_back(p);
  }
  return points;
}

TEST(Enrichment, FillsHolesOnEveryDomainByBruteForce) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    const PointSet points = noise_with_a_hole(domain, 60);
    Control control;
    const double coverage = enrichment_coverage(points, control);
    const PointSet filled = enrich(points, coverage, control);
    EXPECT_GT(filled.size(), points.size());
    EXPECT_LE(filled.size() - points.size(), most_inserted(*domain, coverage));
    EXPECT_TRUE(std::equal(points.coordinates.begin(), points.coordinates.end(), filled.coordinates.begin()));
    EXPECT_LE(brute_r_c_on(filled, 1e-6 * coverage), coverage * (1 + 2e-6));
    for (std::size_t i = points.size(); i < filled.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE(domain->distance(filled[i], filled[j]), coverage * (1 - 1e-9)) << i << " " << j;
    EXPECT_EQ(enrich(filled, coverage, control).coordinates, filled.coordinates);
  }
}

TEST(DomainRefinement, KeepsBothRadiiOnEveryDomain) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    if (is_torus(*domain)) continue;
    for (const double n : {20.0, 90.0}) {
      SCOPED_TRACE(name + " " + std::to_string(n));
      Control control;
      const double r = std::sqrt(0.66 * domain->area() / n);
      const PointSet points = refine_domain(domain, r, control);
      EXPECT_GE(brute_r_f_free(points), r * (1 - 1e-9));
      EXPECT_LE(brute_r_c_on(points, 1e-6 * r), r * (1 + 2e-6));
      EXPECT_EQ(refine_domain(domain, r, control).coordinates, points.coordinates);
      const PointSet counted = refine_domain_to_count(domain, static_cast<std::uint64_t>(n), control);
      EXPECT_EQ(counted.size(), static_cast<std::size_t>(n));
      EXPECT_LE(brute_r_c_on(counted, 1e-6 * r), brute_r_f_free(counted) * (1 + 3e-6));
    }
  }
}

/// With so few points cells have no corners, or charts don't reach them.
TEST(DomainSets, HaveAsManyPointsAsAreAskedForHoweverFew) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    if (is_torus(*domain)) continue;
    const std::vector<BoundaryCurve> curves = domain->boundary();
    const auto corners = static_cast<std::uint64_t>(
        std::count_if(curves.begin(), curves.end(), [](const BoundaryCurve& c) { return !c.closed; }));
    for (std::uint64_t more = corners == 0 ? 1 : 0; more < 8; ++more) {
      SCOPED_TRACE(name + ", corners and " + std::to_string(more));
      Control control;
      Rng rng(more);
      const PointSet thrown = throw_darts_over_to_count(domain, corners + more, {}, rng, control);
      const PointSet refined = refine_domain_to_count(domain, corners + more, control);
      EXPECT_EQ(thrown.size(), corners + more);
      EXPECT_EQ(refined.size(), corners + more);
      if (more > 1) {
        EXPECT_GT(brute_r_f(thrown), 0);
        EXPECT_GT(brute_r_f(refined), 0);
      }
    }
  }
}

/// Two or three points may cover all of a sphere.
TEST(DomainSets, OfVeryLargeRadiiAreMaximalOnSpheres) {
  const auto sphere = std::make_shared<const Sphere>(1);
  for (const double radius : {0.9, 1.2, 1.5, 1.6, 1.7}) {
    SCOPED_TRACE(radius);
    Control control;
    Rng rng(3), places(5);
    DiskRule rule;
    rule.scale = radius;
    for (const PointSet& points :
         {throw_darts_over(sphere, rule, rng, control), refine_domain(sphere, radius, control)}) {
      EXPECT_GE(brute_r_f(points), radius * (1 - 1e-9));
      for (int k = 0; k < 20'000; ++k) {
        const Vec3 place = sphere->random_point(places);
        double depth = 4;
        for (std::size_t i = 0; i < points.size(); ++i)
          depth = std::min(depth, sphere->distance(place, points[i]));
        ASSERT_LE(depth, radius * (1 + 1e-9)) << points.size();
      }
    }
  }
}

/// So far from the origin that coordinates don't tell how near points are.
TEST(DomainSets, HaveNoCertificateWhereRoundingHidesDistances) {
  const double far = 1e12;
  const auto square = std::make_shared<const Polygon>(
      std::vector<std::vector<Vec2>>{{{far, far}, {far + 1, far}, {far + 1, far + 1}, {far, far + 1}}});
  PointSet points{square, {}};
  Rng rng(1);
  for (int k = 0; k < 300; ++k) points.push_back(square->random_point(rng));
  EXPECT_FALSE(certify_domain(points, plain).has_value());
}

/// Every cell of a grid of areas has about as many points as it should: strata are equal.
TEST(Jittered, HasOnePointInEachPartOfEqualAreaOnEveryDomain) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    constexpr std::size_t n = 256, sets = 400;
    std::array<std::vector<double>, 2> below;  // how many points are below some height: jittered, random
    Control control;
    Rng rng(5);
    for (std::size_t s = 0; s < sets; ++s) {
      const PointSet points = jittered(domain, n, rng, control);
      ASSERT_EQ(points.size(), n);
      std::array<double, 2> count{};
      const double height = domain->box().low.y + 0.37 * domain->box().size.y;
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_FALSE(domain->why_outside(points[i])) << i;
        ASSERT_EQ(domain->freedom(points[i]).dimensions, 2);
        count[0] += points[i].y < height;
        count[1] += domain->random_point(rng).y < height;
      }
      for (std::size_t k = 0; k < 2; ++k) below[k].push_back(count[k]);
    }
    std::array<double, 2> mean{}, variance{};
    for (std::size_t k = 0; k < 2; ++k) {
      for (const double b : below[k]) mean[k] += b / sets;
      for (const double b : below[k]) variance[k] += (b - mean[k]) * (b - mean[k]) / sets;
    }
    EXPECT_NEAR(mean[0], mean[1], 6 * std::sqrt(variance[1] / sets)) << "each place is as likely";
    EXPECT_LT(variance[0], 0.2 * variance[1]) << "counts vary less than those of independent points";
  }
}

TEST(ThrowDartsOver, IsMaximalByBruteForce) {
  for (const auto& [name, domain] : domains_of_every_kind())
    for (const double n : {6.0, 40.0, 150.0}) {
      SCOPED_TRACE(name + " " + std::to_string(n));
      if (n > 100 && name == "sphere") continue;  // the oracle takes n^4 steps
      const double r = std::sqrt(0.6966 * domain->area() / n);
      const PointSet points = mps_on(domain, n, 7);
      for (std::size_t i = 0; i < points.size(); ++i) ASSERT_FALSE(domain->why_outside(points[i]));
      EXPECT_GE(brute_r_f_free(points), r);
      EXPECT_LE(brute_r_c_on(points, 1e-6 * r), r * (1 + 2e-6));
      EXPECT_EQ(mps_on(domain, n, 7).coordinates, points.coordinates);
      EXPECT_NE(mps_on(domain, n, 8).coordinates, points.coordinates);
    }
}

TEST(ThrowDartsOver, FillsTheBoundaryFirst) {
  const auto box = std::make_shared<BoxDomain>(2, 1);
  const PointSet points = mps_on(box, 500, 1);
  const double r = std::sqrt(0.6966 * 2 / 500);
  const auto count = freedoms(points);
  EXPECT_EQ(count[0], 4);
  EXPECT_GT(count[1], 6 / (2 * r));
  EXPECT_LT(count[1], 6 / r);
  std::vector<double> bottom;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].y == 0) bottom.push_back(points[i].x);
  std::sort(bottom.begin(), bottom.end());
  for (std::size_t k = 1; k < bottom.size(); ++k) {
    EXPECT_GE(bottom[k] - bottom[k - 1], r);
    EXPECT_LE(bottom[k] - bottom[k - 1], 2 * r * (1 + 1e-9));
  }
}

TEST(ThrowDartsOver, HasExactlyTheCountThatWasAskedForAndStaysMaximal) {
  for (const auto& [name, domain] : domains_of_every_kind())
    for (const std::uint64_t count : {4u, 10u, 100u, 997u}) {
      SCOPED_TRACE(name + " " + std::to_string(count));
      if (count < domain->boundary().size()) continue;
      Rng rng(count);
      Control control;
      const PointSet points = throw_darts_over_to_count(domain, count, {}, rng, control);
      EXPECT_EQ(points.size(), count);
      if (count > 8) {  // measure_ratio leaves pairs of corners out
        EXPECT_LE(measure_ratio(points, plain).beta(), 1 + 1e-8);
      }
    }
}

/// There coordinates are rounded far more coarsely than the polygon's size suggests.
TEST(ThrowDartsOver, IsMaximalFarFromTheOrigin) {
  for (const double far : {1e4, 1e6, 1e9}) {
    const double side = std::max(1e-3, 1e-9 * far), noise = 1e-15 * far / side;
    SCOPED_TRACE(far);
    const auto ring = [&](std::vector<Vec2> corners) {
      for (Vec2& c : corners) c = Vec2{far, -0.7 * far} + side * c;
      return corners;
    };
    const auto polygon = std::make_shared<const Polygon>(std::vector<std::vector<Vec2>>{
        ring({{0, 0.1}, {0.9, 0}, {1, 0.8}, {0.2, 1}}), ring({{0.4, 0.4}, {0.4, 0.6}, {0.7, 0.5}})});
    for (const double coverage : {1.0, 1.4}) {
      Rng rng(1);
      Control control;
      DiskRule rule;
      rule.coverage = coverage;
      const PointSet points = throw_darts_over_to_count(polygon, 200, rule, rng, control);
      const double r_f = brute_r_f_free(points);
      EXPECT_LE(brute_r_c_on(points, 1e-6 * r_f), coverage * r_f * (1 + 3e-6 + 1000 * noise));
    }
    Control control;
    const PointSet refined = refine_domain_to_count(polygon, 200, control);
    const double r_f = brute_r_f_free(refined);
    EXPECT_EQ(refined.size(), 200u);
    EXPECT_LE(brute_r_c_on(refined, 1e-6 * r_f), r_f * (1 + 3e-6 + 1000 * noise));
  }
}

TEST(ThrowDartsOver, RefusesFewerPointsThanCorners) {
  Rng rng(1);
  Control control;
  expect_error([&] { throw_darts_over_to_count(std::make_shared<BoxDomain>(), 3, {}, rng, control); },
               ErrorCode::infeasible, "/count", "4 corners");
}

TEST(MovingSet, MeasuresWhatBruteForceDoes) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    const PointSet points = mps_on(domain, 45, 5);
    const GlobalRatio ratio = measure_ratio(points, plain);
    EXPECT_NEAR(ratio.r_f, brute_r_f_free(points), 1e-12);
    EXPECT_NEAR(ratio.r_c, brute_r_c_on(points, 1e-7), 2e-7);
    const Spacing spacing = measure_spacing(points, plain);
    EXPECT_NEAR(spacing.r_f, brute_r_f(points), 1e-12);
    EXPECT_NEAR(spacing.r_f_free, ratio.r_f, 1e-12);
  }
}

TEST(MovingSet, WhiteNoiseIsMeasuredTheSame) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    PointSet points{domain, {}};
    Rng rng(12);
    for (int i = 0; i < 40; ++i) points.push_back(domain->random_point(rng));
    const GlobalRatio ratio = measure_ratio(points, plain);
    EXPECT_NEAR(ratio.r_f, brute_r_f(points), 1e-12);
    EXPECT_NEAR(ratio.r_c, brute_r_c_on(points, 1e-7), 2e-7);
  }
}

TEST(MovingSet, CellsAddUpToTheDomain) {
  for (const auto& [name, domain] : domains_of_every_kind())
    for (const double n : {8.0, 300.0}) {
      SCOPED_TRACE(name);
      const PointSet points = mps_on(domain, n, 6);
      const MovingSet set(points, plain);
      CellFinder cells = set.finder(plain);
      double area = 0;
      for (std::size_t i = 0; i < set.size(); ++i) {
        cells.load(static_cast<std::uint32_t>(i), set.reach(i));
        cells.cell_at({});
        area += cells.moments().area;
      }
      EXPECT_NEAR(area, domain->area(), 1e-9 * domain->area());
    }
}

TEST(Certify, ProvesBoundsOnEveryDomainThatHoldWhatBruteForceFinds) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    const PointSet points = mps_on(domain, 40, 3);
    const auto proof = certify(points, plain);
    ASSERT_TRUE(proof);
    const double r_f = brute_r_f_free(points), r_c = brute_r_c_on(points, 1e-9);
    EXPECT_LE(proof->r_f_lower, r_f);
    EXPECT_NEAR(proof->r_f_lower, r_f, 1e-9 * r_f);
    EXPECT_GE(proof->r_c_upper * (1 + 1e-12), r_c);
    EXPECT_NEAR(proof->r_c_upper, r_c, 1e-8);
    EXPECT_GE(proof->beta_upper, proof->r_c_upper / proof->r_f_lower);
  }
}

/// The laws of OptimizeResult, on every domain, for every optimizer, with and without a sizing function.
TEST(Optimizers, KeepTheirPromisesOnEveryDomain) {
  for (const auto& [name, domain] : domains_of_every_kind())
    for (const bool sized : {false, true}) {
      PointSet input = mps_on(domain, 120, 11);
      if (sized) input.sizing = std::make_shared<LinearSizing>(*domain, LinearSizingOptions{1, 1, 1.05});
      const double before = measure_ratio(input, plain).beta();
      const auto kinds = freedoms(input);
      for (const Optimizer& optimizer : optimizers()) {
        SCOPED_TRACE(name + " " + optimizer.name + (sized ? " with radii that vary" : ""));
        Arguments arguments;
        for (const Parameter& p : optimizer.parameters)
          if (p.name == "max_sweeps") arguments["max_sweeps"] = 12;
        Control one(1), two(2);
        const OptimizeResult result = optimizer.run(input, arguments, one);
        ASSERT_EQ(result.points.size(), input.size());
        EXPECT_EQ(freedoms(result.points), kinds);
        for (std::size_t i = 0; i < input.size(); ++i) {
          ASSERT_FALSE(domain->why_outside(result.points[i])) << i;
          const Freedom a = domain->freedom(input[i]), b = domain->freedom(result.points[i]);
          ASSERT_EQ(a.dimensions, b.dimensions) << i;
          if (a.dimensions == 0) {
            ASSERT_EQ(input[i], result.points[i]);
          }
        }
        const double after = measure_ratio(result.points, plain).beta();
        EXPECT_LE(after, before);
        EXPECT_NEAR(result.history.front().beta, before, 1e-6 * before);
        EXPECT_EQ(optimizer.run(input, arguments, two).points.coordinates, result.points.coordinates);
      }
    }
}

TEST(OptBeta, ReachesItsTargetOnEveryDomain) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    const PointSet input = mps_on(domain, 400, 2);
    OptBetaOptions options;
    options.beta = 0.76;
    Control control;
    const OptimizeResult result = opt_beta(input, options, control);
    EXPECT_EQ(result.converged, true);
    EXPECT_LE(measure_spacing(result.points, plain).beta, 0.76);
  }
}

TEST(OptBeta, ReachesItsTargetWhereRadiiVary) {
  const auto sphere = std::make_shared<Sphere>();
  const auto sizing = std::make_shared<LinearSizing>(*sphere, LinearSizingOptions{0, 0.05, 0.15});
  DiskRule rule;
  rule.sizing = sizing.get();
  Rng rng(1);
  Control control;
  PointSet input = throw_darts_over(sphere, rule, rng, control);
  input.sizing = sizing;
  OptBetaOptions options;
  options.beta = 0.8;
  const OptimizeResult result = opt_beta(input, options, control);
  EXPECT_EQ(result.converged, true);
  const Spacing before = measure_spacing(input, plain), after = measure_spacing(result.points, plain);
  EXPECT_LE(after.beta, 0.8);
  EXPECT_LT(after.beta_i_mean, before.beta_i_mean);
}

TEST(Cvt, EnergyNeverRisesOnAnyDomain) {
  for (const auto& [name, domain] : domains_of_every_kind())
    for (const CvtOptions::Variant variant : {CvtOptions::Variant::lloyd, CvtOptions::Variant::accelerated}) {
      SCOPED_TRACE(name);
      CvtOptions options;
      options.variant = variant;
      options.max_sweeps = 30;
      double last = 1e300;
      options.on_energy = [&](int, double energy) {
        EXPECT_LE(energy, last * (1 + 1e-9));
        last = energy;
      };
      Control control;
      cvt(mps_on(domain, 150, 4), options, control);
    }
}

/// The outline of Table 1 (reproduce/sections/polygons.py). With this seed one of its edges has so many
/// points that .75 can't be had.
TEST(OptBeta, ComesNearToTheLeastThatABoundaryLeavesRoomFor) {
  const auto outline = std::make_shared<Polygon>(
      std::vector<std::vector<Vec2>>{{{0, 0},
                                      {0.9, 0},
                                      {1, 0.12},
                                      {1, 0.55},
                                      {0.72, 0.55},
                                      {0.62, 0.4},
                                      {0.5, 0.55},
                                      {0.5, 0.8},
                                      {0.15, 0.8},
                                      {0, 0.62}},
                                     {{0.2, 0.2}, {0.32, 0.14}, {0.4, 0.22}, {0.36, 0.36}, {0.24, 0.38}}});
  Control control;
  Rng rng(0);
  DiskRule rule;
  rule.scale = 0.0314;
  const PointSet points = throw_darts_over(outline, rule, rng, control);
  const OptimizeResult result = opt_beta(points, {0.75, OptBetaOptions::Randomness::gentle, {}}, control);
  EXPECT_EQ(result.converged, false);
  EXPECT_LE(measure_spacing(result.points, control).beta, 0.79);
}

}  // namespace
}  // namespace wellspaced
