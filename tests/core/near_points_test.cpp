// Points that nearly coincide, against cells that are cut with numbers of a thousand bits.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include "core/analyze/bond_order.h"
#include "core/analyze/certificate.h"
#include "core/analyze/distributions.h"
#include "core/analyze/local_measures.h"
#include "core/analyze/spacing.h"
#include "core/domain/box_domain.h"
#include "core/domain/near_pair.h"
#include "core/domain/sphere.h"
#include "core/generate/lattice.h"
#include "core/math.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::expect_error;
using testing::random_points;
using Exact = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<1024, boost::multiprecision::digit_base_2, void, std::int32_t>,
    boost::multiprecision::et_off>;

struct Corner {
  Exact x, y;
  int label;
};

/// Keeps what of the cell is nearer to the origin than to (x, y).
std::vector<Corner> cut(const std::vector<Corner>& cell, const Exact& x, const Exact& y, int label) {
  const Exact half = (x * x + y * y) / 2;
  std::vector<Exact> side;
  bool cuts = false;
  for (const Corner& c : cell) {
    side.push_back(c.x * x + c.y * y - half);
    cuts = cuts || side.back() > 0;
  }
  if (!cuts) return cell;
  std::vector<Corner> left;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const std::size_t next = (k + 1) % cell.size();
    const bool here = side[k] <= 0, there = side[next] <= 0;
    if (here) left.push_back(cell[k]);
    if (here == there) continue;
    const Exact t = side[k] / (side[k] - side[next]);
    left.push_back({cell[k].x + t * (cell[next].x - cell[k].x), cell[k].y + t * (cell[next].y - cell[k].y),
                    here ? label : cell[k].label});
  }
  return left;
}

struct CellMeasure {
  double nearest, outradius, area;
  int valence;
};

/// Of the cell of sample i, of all images within two periods, or within a box.
CellMeasure exact_measure(const PointSet& points, std::size_t i) {
  const bool repeats = is_torus(*points.domain);
  const Exact w = points.domain->box().size.x, h = points.domain->box().size.y;
  const Exact left = repeats ? -w : Exact(-points[i].x), right = left + (repeats ? 2 : 1) * w,
              low = repeats ? -h : Exact(-points[i].y), high = low + (repeats ? 2 : 1) * h;
  std::vector<Corner> cell = {{left, low, -1}, {right, low, -1}, {right, high, -1}, {left, high, -1}};
  Exact nearest2 = 2 * w * w;
  const int reach = repeats ? 2 : 0;
  for (std::size_t j = 0; j < points.size(); ++j)
    for (int ty = -reach; ty <= reach; ++ty)
      for (int tx = -reach; tx <= reach; ++tx) {
        if (j == i && tx == 0 && ty == 0) continue;
        const Exact x = Exact(points[j].x) - Exact(points[i].x) + tx * w,
                    y = Exact(points[j].y) - Exact(points[i].y) + ty * h;
        cell = cut(cell, x, y, static_cast<int>(25 * j) + 5 * (ty + 2) + tx + 2);
        if (j != i) nearest2 = std::min<Exact>(nearest2, Exact(x * x + y * y));
      }
  Exact outradius2 = 0, twice_area = 0;
  std::set<int> labels;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const Corner &a = cell[k], &b = cell[(k + 1) % cell.size()];
    outradius2 = std::max<Exact>(outradius2, Exact(a.x * a.x + a.y * a.y));
    twice_area += a.x * b.y - a.y * b.x;
    if (a.label >= 0) labels.insert(a.label);
  }
  return {static_cast<double>(Exact(sqrt(nearest2))), static_cast<double>(Exact(sqrt(outradius2))),
          static_cast<double>(twice_area) / 2, static_cast<int>(labels.size())};
}

/// Clusters of that size around places, some of them on the seams and where four of them meet.
PointSet clusters(double size, std::size_t each, std::uint64_t seed, std::size_t others) {
  PointSet points = random_points(1, 1, others, seed);
  Rng rng(seed + 1000);
  for (const Vec3 at :
       {Vec3{0, 0, 0}, Vec3{0.3, 0, 0}, Vec3{0, 0.6, 0}, Vec3{0.74, 0.75, 0}, Vec3{0.5, 0.4, 0}})
    for (std::size_t k = 0; k < each; ++k)
      points.push_back(points.domain->step(at, {size * (rng.uniform() - 0.5), size * (rng.uniform() - 0.5)}));
  return points;
}

/// The same in a box, which has no seams.
PointSet boxed(PointSet points) {
  points.domain = std::make_shared<BoxDomain>();
  return points;
}

double least_distance(const PointSet& points) { return testing::brute_r_f(points); }

TEST(NearPoints, AreMeasuredAsExactCellsAre) {
  const Control control(2);
  int sets = 0;
  for (const double size : {1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 3e-9, 1e-9})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(::testing::Message() << "clusters of " << size << ", seed " << seed);
      const PointSet points = clusters(size, 4, seed, seed == 3 ? 0 : 7);
      if (least_distance(points) < nearest_distance(*points.domain)) continue;
      ++sets;
      const double tolerance = 4e-16 / least_distance(points);
      const auto measured = [&](LocalMeasure what) { return measure_locally(points, what, control); };
      const auto beta_i = measured(LocalMeasure::beta_i), nearest = measured(LocalMeasure::nearest),
                 area = measured(LocalMeasure::area), valence = measured(LocalMeasure::valence);
      const double d_hex = hexagonal_spacing(1, points.size()), n = static_cast<double>(points.size());
      double r_c = 0, valences = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const CellMeasure cell = exact_measure(points, i);
        EXPECT_EQ(valence[i], cell.valence) << i;
        EXPECT_NEAR(nearest[i] * d_hex / cell.nearest, 1, 1e-15 + tolerance) << i;
        EXPECT_NEAR(beta_i[i] * cell.nearest / cell.outradius, 1, 1e-12 + tolerance) << i;
        EXPECT_NEAR(area[i], cell.area * n, 1e-12 + tolerance * n) << i;
        r_c = std::max(r_c, cell.outradius);
        valences += cell.valence;
      }
      EXPECT_EQ(valences, 6 * n);
      const Spacing s = measure_spacing(points, control);
      EXPECT_NEAR(s.r_c / r_c, 1, 1e-12 + tolerance);
      const auto proof = certify(points, control);
      ASSERT_TRUE(proof);
      EXPECT_GE(proof->r_c_upper, r_c * (1 - 1e-15));
      EXPECT_LE(proof->r_c_upper, r_c * (1 + 1e-12 + 10 * tolerance));
    }
  EXPECT_GE(sets, 18);
}

TEST(NearPoints, AreMeasuredInABoxAsExactCellsAre) {
  const Control control(2);
  int sets = 0;
  for (const double size : {1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 3e-9, 1e-9})
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      SCOPED_TRACE(::testing::Message() << "clusters of " << size << ", seed " << seed);
      const PointSet points = boxed(clusters(size, 4, seed, seed % 2 == 0 ? 0 : 7));
      if (least_distance(points) < nearest_distance(*points.domain)) continue;
      ++sets;
      const double tolerance = 4e-16 / least_distance(points);
      const LocalSpacing s = measure_local_spacing(points, control);
      std::map<int, std::size_t> valence;
      double r_c = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const CellMeasure cell = exact_measure(points, i);
        EXPECT_NEAR(s.beta_i[i] * cell.nearest / cell.outradius, 1, 1e-12 + tolerance) << i;
        r_c = std::max(r_c, cell.outradius);
        ++valence[cell.valence];
      }
      // The kernel leaves out edges that seem to touch a corner: of neighbors so near, somewhat longer ones.
      if (size > 1e-7) {
        EXPECT_EQ(s.global.valence, valence);
      }
      EXPECT_NEAR(s.global.r_c / r_c, 1, 1e-12 + tolerance);
    }
  EXPECT_GE(sets, 30);
}

TEST(NearPoints, AtTheLimitAreMeasuredAndBelowItRefused) {
  for (const Vec3 at : {Vec3{0.5, 0.5, 0}, Vec3{0, 0.25, 0}, Vec3{0.9, 0, 0}, Vec3{0, 0, 0}}) {
    PointSet points = random_points(1, 1, 20, 9);
    const auto add = [&](double distance, double turn) {
      points.set(0, at);
      points.set(7, points.domain->step(at, {distance * std::cos(turn), distance * std::sin(turn)}));
    };
    for (double turn = 0.1; turn < 6; turn += 0.7) {
      add(1.01e-10, turn);
      const Spacing s = measure_spacing(points, Control());
      EXPECT_NEAR(s.r_f, 1.01e-10, 2e-16);
      add(0.99e-10, turn);
      expect_error([&] { measure_spacing(points, Control()); }, ErrorCode::degenerate_input, "/7",
                   "away from point 0");
      add(1e-30, turn);
      expect_error([&] { measure_spacing(points, Control()); }, ErrorCode::degenerate_input, "/7");
    }
  }
}

TEST(NearPoints, ThatAreTooNearAreRefusedByEveryMeasure) {
  PointSet points{std::make_shared<Torus>(),
                  {0.5, 0.5, 0.50000000000008, 0.50000000000008, 0.50000000000004, 0.50000000000001,
                   0.50000000000009, 0.50000000000002}};
  const Control control;
  EXPECT_NO_THROW(visit_stars(
      points, control, [](std::size_t, std::span<const Spoke> spokes) { EXPECT_GE(spokes.size(), 3u); }));
  expect_error([&] { measure_spacing(points, control); }, ErrorCode::degenerate_input, "/1", "point 0");
  expect_error([&] { distributions(points, control); }, ErrorCode::degenerate_input, "/1", "point 0");
  expect_error([&] { bond_order(points, control); }, ErrorCode::degenerate_input, "/1", "point 0");
}

TEST(NearPoints, InACertificateNeedNoTrust) {
  for (const double size : {1e-9, 1e-12, 1e-15}) {
    const PointSet points = clusters(size, 8, 5, 0);
    EXPECT_NO_THROW(certify(points, Control(), visit_stars_by_kernel));
    const auto proof = certify(points, Control());
    if (proof) {
      EXPECT_GE(proof->r_c_upper, testing::brute_r_c(points, 1e-4) - 1e-4);
    }
  }
}

/// The nearest pair by all pairs.
std::optional<double> brute_near(const PointSet& points, double limit) {
  const double least = least_distance(points);
  if (least < limit) return least;
  return std::nullopt;
}

TEST(NearPair, IsFoundIfThereIsOne) {
  Rng rng(3);
  for (int round = 0; round < 400; ++round) {
    const double height = round % 3 == 0 ? 0.01 : 1;
    PointSet points = random_points(1, height, 3 + rng.below(60), static_cast<std::uint64_t>(round));
    if (round % 2 == 0)  // a crowd, so that the uniform grid does not serve
      for (int k = 0; k < 40; ++k)
        points.push_back(points.domain->step({0.999, 0, 0}, {0.004 * rng.uniform(), 0.004 * rng.uniform()}));
    const double limit = std::pow(10, -1 - 4 * rng.uniform()) * height;
    const auto found = find_near_pair(points, limit, Control());
    const auto wanted = brute_near(points, limit);
    ASSERT_EQ(found.has_value(), wanted.has_value()) << round;
    if (!found) continue;
    EXPECT_LT(found->earlier, found->later);
    EXPECT_EQ(found->distance, points.domain->distance(points[found->earlier], points[found->later]));
    EXPECT_LT(found->distance, limit);
  }
}

TEST(NearPair, IsFoundOnASphere) {
  const auto sphere = std::make_shared<Sphere>(2);
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    PointSet points{sphere, {}};
    for (int k = 0; k < 80; ++k) points.push_back(sphere->random_point(rng));
    const double limit = 0.02 + 0.1 * rng.uniform();
    EXPECT_EQ(find_near_pair(points, limit, Control()).has_value(), brute_near(points, limit).has_value());
  }
}

TEST(NearPair, IsFoundInACrowdInNoTime) {
  PointSet points = random_points(1, 1, 200000, 4);
  for (double& c : points.coordinates) c *= 1e-13;
  EXPECT_TRUE(find_near_pair(points, 1e-10, Control()));
}

TEST(NearPair, IsThatWithTheFirstLaterPointOfThoseThatRepeat) {
  Control control;
  PointSet points = square_lattice(std::make_shared<Torus>(), 400, control);
  points.set(300, points[17]);
  points.set(200, points[350]);
  points.set(120, points[3]);
  const auto found = find_near_pair(points, 1e-10, Control());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->later, 120u);
  EXPECT_EQ(found->earlier, 3u);
}

}  // namespace
}  // namespace wellspaced
