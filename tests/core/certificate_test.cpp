#include "core/analyze/certificate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/generate.h"
#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/optimize/opt_beta.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_r_c;
using testing::brute_r_f;
using testing::random_points;

PointSet mps(std::uint64_t count, std::uint64_t seed, double height = 1) {
  Rng rng(seed);
  Control control(2);
  return poisson_disk(std::make_shared<Torus>(1, height), {poisson_disk_radius(height, count)}, rng, control);
}

PointSet heap(double spread, std::size_t n, std::uint64_t seed) {
  PointSet points = random_points(1, 1, n, seed);
  for (std::size_t i = 0; i < n; ++i)
    points.set(i, points.domain->step({0.99, 0.99, 0}, {spread * points[i].x, spread * points[i].y}));
  return points;
}

void expect_tight(const PointSet& points) {
  const Control control(2);
  const auto c = certify(points, control);
  ASSERT_TRUE(c);
  const Spacing s = measure_spacing(points, control);
  EXPECT_LE(c->r_f_lower, s.r_f * (1 + 1e-14));
  EXPECT_GE(c->r_f_lower, s.r_f * (1 - 1e-11) - 1e-15);
  EXPECT_GE(c->r_c_upper, s.r_c * (1 - 1e-14));
  EXPECT_LE(c->r_c_upper, s.r_c * (1 + 1e-11));
  EXPECT_GE(c->beta_upper, s.beta * (1 - 1e-14));
}

TEST(Certificate, BoundsWhatBruteForceFinds) {
  const Control control;
  for (const PointSet& points :
       {random_points(1, 1, 3, 1), random_points(1, 1, 40, 2), random_points(3, 0.2, 60, 3), mps(150, 4),
        mps(80, 5, 0.1), heap(0.2, 60, 6), random_points(0.01, 1, 30, 7)}) {
    const auto c = certify(points, control);
    ASSERT_TRUE(c);
    const double r_f = brute_r_f(points), r_c = brute_r_c(points, 1e-4);
    EXPECT_LE(c->r_f_lower, r_f);
    EXPECT_NEAR(c->r_f_lower, r_f, 1e-12);
    EXPECT_GE(c->r_c_upper, r_c);
    EXPECT_NEAR(c->r_c_upper, r_c, 2e-4);
    EXPECT_GE(c->beta_upper, r_c / r_f);
  }
}

TEST(Certificate, IsTightOnEverySet) {
  Control control;
  for (const PointSet& points :
       {mps(20000, 1), mps(3000, 2, 7), random_points(1, 1, 3000, 3), heap(1e-3, 500, 4)})
    expect_tight(points);
  for (const auto lattice : {square_lattice, triangular_lattice, hexagonal_lattice})
    expect_tight(lattice(std::make_shared<Torus>(1, 0.7), 300, control));
}

TEST(Certificate, ProvesOptBetasTargets) {
  Control control(2);
  const OptimizeResult result = opt_beta(mps(2000, 5), {0.7, OptBetaOptions::Randomness::fast, {}}, control);
  const auto c = certify(result.points, control);
  ASSERT_TRUE(c);
  EXPECT_LE(c->beta_upper, 0.7);
}

TEST(Certificate, FindsTheClosestPairAcrossTheSeams) {
  for (const Vec3 twin : {Vec3{0.9995, 0.3, 0}, Vec3{0.0005, 0.9996, 0}, Vec3{0.9997, 0.9997, 0}}) {
    PointSet points = mps(300, 6);
    points.set(0, {0.0002, twin.y < 0.5 ? 0.3 : 0.0001, 0});
    points.set(1, twin);
    const auto c = certify(points, Control());
    ASSERT_TRUE(c);
    EXPECT_NEAR(c->r_f_lower, brute_r_f(points), 1e-13);
  }
}

TEST(Certificate, IsAFunctionOfThePointsAlone) {
  const PointSet points = mps(5000, 7);
  const auto one = certify(points, Control(1)), four = certify(points, Control(4));
  EXPECT_EQ(one->beta_upper, four->beta_upper);
  EXPECT_EQ(one->r_f_lower, four->r_f_lower);
}

// ---- nothing is believed of who found the neighbors

using Stars = std::vector<std::vector<Spoke>>;

StarSource told(const Stars& stars) {
  return [&stars](const PointSet&, const Control&, const StarVisitor& visit) {
    for (std::size_t i = 0; i < stars.size(); ++i) visit(i, stars[i]);
  };
}

TEST(Certificate, StaysTrueWhenNeighborsAreMissing) {
  const PointSet points = mps(200, 8);
  Stars stars = testing::collect_stars(points, visit_stars);
  for (auto& star : stars)
    if (star.size() > 5) star.erase(star.begin() + 2);
  if (const auto c = certify(points, Control(), told(stars))) {
    EXPECT_GE(c->r_c_upper, measure_spacing(points, Control()).r_c);
  }
}

TEST(Certificate, StaysTrueWhenOffsetsAreWrong) {
  const PointSet points = mps(200, 9);
  const Spacing s = measure_spacing(points, Control());
  Stars stars = testing::collect_stars(points, visit_stars);
  for (auto& star : stars)
    for (Spoke& spoke : star) spoke.offset = 0.3 * spoke.offset;
  const auto c = certify(points, Control(), told(stars));
  ASSERT_TRUE(c);
  EXPECT_GE(c->beta_upper, s.beta) << "shorter offsets, the same samples";
}

TEST(Certificate, IsNotGivenForStarsThatDoNotTurnAround) {
  const PointSet points = mps(200, 10);
  const Stars stars = testing::collect_stars(points, visit_stars);
  Stars turned = stars, halved = stars, emptied = stars;
  std::reverse(turned[7].begin(), turned[7].end());
  halved[7].resize(2);
  emptied[7].assign(3, {{0, 0}, 7});
  for (const Stars& bad : {turned, halved, emptied}) EXPECT_FALSE(certify(points, Control(), told(bad)));
}

TEST(Certificate, StopsWhenItIsCancelled) {
  Control control;
  control.cancel();
  testing::expect_error([&] { certify(mps(100, 1), control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
