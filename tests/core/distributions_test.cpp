#include "core/analyze/distributions.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/lattice.h"
#include "core/math.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::collect_stars;
using testing::expect_error;
using testing::mps;
using testing::random_points;

constexpr Histogram Distributions::*all_of_them[] = {&Distributions::beta_i,    &Distributions::valence,
                                                     &Distributions::angle_deg, &Distributions::edge,
                                                     &Distributions::nearest,   &Distributions::cell_area};

struct Values {
  std::vector<double> beta_i, valence, angle_deg, edge, nearest, cell_area;
};

/// By the definitions, from CGAL's triangulation.
Values brute_values(const PointSet& points) {
  Values values;
  const double d_hex = hexagonal_spacing(points.domain->area(), points.size());
  const double mean_area = points.domain->area() / static_cast<double>(points.size());
  const auto stars = collect_stars(points, visit_stars_by_cgal);
  for (std::size_t i = 0; i < stars.size(); ++i) {
    double r_c = 0, r_f = std::numeric_limits<double>::infinity(), area = 0;
    std::vector<Vec2> corners;
    for (std::size_t k = 0; k < stars[i].size(); ++k) {
      const Vec2 a = stars[i][k].offset, b = stars[i][(k + 1) % stars[i].size()].offset;
      corners.push_back(circumcenter(a, b));
      r_c = std::max(r_c, norm(corners.back()));
      values.angle_deg.push_back(std::acos(dot(a, b) / (norm(a) * norm(b))) * 180 / pi);
      const bool mine = stars[i][k].id > i || (stars[i][k].id == i && (a.x > 0 || (a.x == 0 && a.y > 0)));
      if (mine) values.edge.push_back(norm(a) / d_hex);
      if (stars[i][k].id != i) r_f = std::min(r_f, norm(a));
    }
    for (std::size_t k = 0; k < corners.size(); ++k)
      area += cross(corners[k], corners[(k + 1) % corners.size()]) / 2;
    values.beta_i.push_back(r_c / r_f);
    values.valence.push_back(static_cast<double>(stars[i].size()));
    values.nearest.push_back(r_f / d_hex);
    values.cell_area.push_back(area / mean_area);
  }
  return values;
}

/// A value that rounding moves across an edge may have changed its bin; in random sets none is so near.
void expect_counts(const Histogram& h, const std::vector<double>& values, double origin, double width) {
  std::map<std::int64_t, std::uint64_t> bins;
  for (const double v : values) ++bins[static_cast<std::int64_t>(std::floor((v - origin) / width))];
  ASSERT_FALSE(h.counts.empty());
  const std::int64_t first = bins.begin()->first;
  EXPECT_NEAR(h.low, origin + static_cast<double>(first) * width, 1e-12);
  EXPECT_EQ(h.width, width);
  EXPECT_GT(h.counts.front(), 0u);
  EXPECT_GT(h.counts.back(), 0u);
  std::uint64_t above = 0;
  for (const auto& [bin, count] : bins) {
    const auto k = static_cast<std::size_t>(bin - first);
    if (k >= 400) {
      above += count;
    } else {
      ASSERT_LT(k, h.counts.size());
      EXPECT_EQ(h.counts[k], count) << "bin at " << origin + static_cast<double>(bin) * width;
    }
  }
  EXPECT_EQ(h.above, above);
  EXPECT_EQ(h.total(), values.size());
  const double n = static_cast<double>(values.size()),
               mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double square = 0;
  for (const double v : values) square += (v - mean) * (v - mean) / n;
  const double max = *std::max_element(values.begin(), values.end());
  EXPECT_NEAR(h.mean, mean, 1e-9 * max);
  EXPECT_NEAR(h.sd, std::sqrt(square), 1e-9 * max);
  EXPECT_NEAR(h.min, *std::min_element(values.begin(), values.end()), 1e-9 * max);
  EXPECT_NEAR(h.max, max, 1e-9 * max);
}

void expect_brute(const PointSet& points) {
  const Distributions d = distributions(points, Control(2));
  const Values values = brute_values(points);
  expect_counts(d.beta_i, values.beta_i, 0.5, 0.01);
  expect_counts(d.valence, values.valence, -0.5, 1);
  expect_counts(d.angle_deg, values.angle_deg, 0, 1);
  expect_counts(d.edge, values.edge, 0, 0.02);
  expect_counts(d.nearest, values.nearest, 0, 0.02);
  expect_counts(d.cell_area, values.cell_area, 0, 0.02);
}

TEST(Distributions, AgreeWithTheirDefinitions) {
  const std::tuple<double, double, std::size_t> shapes[] = {
      {1, 1, 3}, {1, 1, 50}, {2, 0.1, 30}, {50, 1, 3}, {1, 3, 3000}};
  for (const auto& [width, height, n] : shapes) {
    SCOPED_TRACE(::testing::Message() << width << " x " << height << ", n " << n);
    expect_brute(random_points(width, height, n, 7));
  }
  expect_brute(mps(2000, 3));
}

TEST(Distributions, OfClustersCountWhatIsFarAbove) {
  PointSet points = random_points(1, 1, 2000, 8);
  for (std::size_t i = 20; i < points.size(); ++i) points.set(i, 1e-3 * points[i]);
  expect_brute(points);
  const Distributions d = distributions(points, Control());
  EXPECT_GT(d.edge.above, 0u);
  EXPECT_GT(d.cell_area.above, 0u);
}

TEST(Distributions, CountEverySampleEdgeAndAngle) {
  const PointSet points = random_points(1, 1, 5000, 2);
  const Distributions d = distributions(points, Control(2));
  for (const Histogram& one : {d.beta_i, d.valence, d.nearest, d.cell_area}) EXPECT_EQ(one.total(), 5000u);
  EXPECT_EQ(d.edge.total(), 3 * 5000u);
  EXPECT_EQ(d.angle_deg.total(), 3 * 2 * 5000u) << "three a triangle, two triangles a sample";
  EXPECT_NEAR(d.angle_deg.mean, 60, 1e-9);
  EXPECT_NEAR(d.valence.mean, 6, 1e-12);
  EXPECT_NEAR(d.cell_area.mean, 1, 1e-9);
}

TEST(Distributions, AgreeWithTheSpacing) {
  for (const PointSet& points : {random_points(2, 1, 4000, 2), mps(4000, 2)}) {
    const Distributions d = distributions(points, Control(2));
    const Spacing s = measure_spacing(points, Control(2));
    EXPECT_EQ(d.beta_i.max, s.beta_i_max);
    EXPECT_NEAR(d.beta_i.mean, s.beta_i_mean, 1e-12);
    EXPECT_NEAR(d.angle_deg.min, s.angle_min_deg, 1e-9);
    EXPECT_NEAR(d.angle_deg.max, s.angle_max_deg, 1e-9);
    EXPECT_NEAR(d.edge.min, s.rho, 1e-12);
    EXPECT_NEAR(d.edge.max, s.edge_max * s.rho, 1e-9);
    EXPECT_NEAR(d.nearest.min, s.rho, 1e-12);
    EXPECT_NEAR(d.nearest.mean, s.nearest_mean, 1e-12);
    EXPECT_NEAR(d.cell_area.sd, s.cell_area_sd, 1e-9);
    for (const auto& [valence, count] : s.valence)
      EXPECT_EQ(d.valence.counts[static_cast<std::size_t>(valence - d.valence.low)], count) << valence;
  }
}

TEST(Distributions, OfMaximalPoissonDisksAreWhatTheFieldFound) {
  constexpr std::uint64_t n = 20000;
  const PointSet points = mps(n, 1);
  const Distributions d = distributions(points, Control(2));
  const std::map<int, double> percent = {{4, 1.1}, {5, 24.6}, {6, 50.0}, {7, 21.8}, {8, 2.4}};
  for (const auto& [valence, wanted] : percent) {
    const auto count =
        static_cast<double>(d.valence.counts.at(static_cast<std::size_t>(valence - d.valence.low)));
    EXPECT_NEAR(100 * count / static_cast<double>(points.size()), wanted, 1) << valence;
  }
  const double r = poisson_disk_radius(1, n) / hexagonal_spacing(1, points.size());
  EXPECT_NEAR(d.beta_i.mean, 0.859, 0.003);
  EXPECT_NEAR(d.nearest.mean, 1.054 * r, 0.003);
  EXPECT_GE(d.nearest.min, r * (1 - 1e-12));
  EXPECT_LE(d.beta_i.max, 1 + 1e-9);
  EXPECT_GE(d.angle_deg.min, 30 - 1e-6);
  EXPECT_LE(d.angle_deg.max, 120 + 1e-6);
}

TEST(Distributions, OfTheTriangularLatticeAreSingleBins) {
  Control control;
  const Distributions d =
      distributions(triangular_lattice(std::make_shared<Torus>(1, std::sqrt(3.0)), 800, control), control);
  EXPECT_EQ(d.valence.counts, std::vector<std::uint64_t>{800});
  EXPECT_EQ(d.valence.low, 5.5);
  EXPECT_NEAR(d.angle_deg.min, 60, 1e-9);
  EXPECT_NEAR(d.angle_deg.max, 60, 1e-9);
  EXPECT_NEAR(d.edge.mean, 1, 1e-12);
  for (const auto which : all_of_them) EXPECT_NEAR((d.*which).sd, 0, 1e-9);
}

TEST(Distributions, OfOtherSamplersHaveTheValencesThatCgalFound) {
  const std::string folder = std::string(WELLSPACED_TEST_DATA) + "/points/";
  std::ifstream table(folder + "points_periodic.csv");
  int sets = 0;
  for (std::string line; std::getline(table, line);) {
    const std::string name = line.substr(0, line.find(','));
    if (name.find("RegularGrid") != std::string::npos) continue;  // cocircular: valence is not unique
    SCOPED_TRACE(name);
    ++sets;
    PointSet points{std::make_shared<Torus>(), {}};
    std::ifstream file(folder + name);
    for (double x, y; file >> x >> y;) points.push_back({x, y, 0});
    const Histogram valence = distributions(points, Control()).valence;
    std::ostringstream found;
    for (std::size_t k = 0; k < valence.counts.size(); ++k)
      if (valence.counts[k] > 0)
        found << valence.low + 0.5 + static_cast<double>(k) << ":" << valence.counts[k] << " ";
    EXPECT_EQ(found.str(), line.substr(line.find("valence=") + 8));
  }
  EXPECT_EQ(sets, 3);
}

TEST(Distributions, ArePooledEachByItself) {
  std::vector<Distributions> sets;
  Values all;
  for (std::uint64_t seed : {1u, 2u, 3u}) {
    const PointSet points = random_points(1, 1, 500 + 100 * seed, seed);
    sets.push_back(distributions(points, Control()));
    const Values one = brute_values(points);
    for (const auto which : {&Values::beta_i, &Values::valence, &Values::angle_deg, &Values::edge,
                             &Values::nearest, &Values::cell_area})
      (all.*which).insert((all.*which).end(), (one.*which).begin(), (one.*which).end());
  }
  const Distributions d = pool(sets);
  expect_counts(d.beta_i, all.beta_i, 0.5, 0.01);
  expect_counts(d.valence, all.valence, -0.5, 1);
  expect_counts(d.angle_deg, all.angle_deg, 0, 1);
  expect_counts(d.edge, all.edge, 0, 0.02);
  expect_counts(d.nearest, all.nearest, 0, 0.02);
  expect_counts(d.cell_area, all.cell_area, 0, 0.02);
}

TEST(Distributions, AreTheSameOnAnyNumberOfThreads) {
  const PointSet points = random_points(1, 1, 20000, 3);
  const Distributions one = distributions(points, Control(1));
  for (unsigned threads : {2u, 3u, 8u}) {
    const Distributions many = distributions(points, Control(threads));
    for (const auto which : all_of_them) {
      EXPECT_EQ((one.*which).low, (many.*which).low);
      EXPECT_EQ((one.*which).counts, (many.*which).counts);
      EXPECT_EQ((one.*which).above, (many.*which).above);
      EXPECT_EQ((one.*which).mean, (many.*which).mean);
      EXPECT_EQ((one.*which).sd, (many.*which).sd);
      EXPECT_EQ((one.*which).min, (many.*which).min);
      EXPECT_EQ((one.*which).max, (many.*which).max);
    }
  }
}

TEST(Distributions, RefuseWhatHasNoTriangulation) {
  expect_error([] { distributions(random_points(1, 1, 2, 1), Control()); }, ErrorCode::degenerate_input, "");
  PointSet points = random_points(1, 1, 5, 1);
  points.set(4, points[2]);
  expect_error([&] { distributions(points, Control()); }, ErrorCode::degenerate_input, "/4");
}

TEST(Distributions, CanBeCancelled) {
  Control control(2);
  control.cancel();
  expect_error([&] { distributions(random_points(1, 1, 5000, 3), control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
