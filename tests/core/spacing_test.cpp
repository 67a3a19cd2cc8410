#include "core/analyze/spacing.h"

#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "core/generate/white_noise.h"
#include "core/math.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::brute_r_c;
using testing::brute_r_f;
using testing::expect_error;
using testing::random_points;

const std::string data = std::string(WELLSPACED_TEST_DATA) + "/points/";

PointSet read_points(const std::string& name) {
  PointSet points{std::make_shared<Torus>(), {}};
  std::ifstream file(data + name);
  double x, y;
  while (file >> x >> y) points.push_back({x, y, 0});
  EXPECT_GT(points.size(), 1000u) << name;
  return points;
}

/// name -> key -> value, as CGAL's periodic triangulation measured them.
std::map<std::string, std::map<std::string, std::string>> expected_measures() {
  std::map<std::string, std::map<std::string, std::string>> all;
  std::ifstream file(data + "points_periodic.csv");
  for (std::string line; std::getline(file, line);) {
    std::stringstream cells(line);
    std::string name, cell;
    std::getline(cells, name, ',');
    while (std::getline(cells, cell, ','))
      all[name][cell.substr(0, cell.find('='))] = cell.substr(cell.find('=') + 1);
  }
  return all;
}

TEST(Spacing, OfOtherSamplersPointSetsIsWhatCgalMeasured) {
  const auto all = expected_measures();
  ASSERT_EQ(all.size(), 4u);
  for (const auto& [name, wanted] : all) {
    SCOPED_TRACE(name);
    const Spacing s = measure_spacing(read_points(name), Control(2));
    const auto number = [&values = wanted](const std::string& key) { return std::stod(values.at(key)); };
    EXPECT_EQ(static_cast<double>(s.n), number("N"));
    EXPECT_NEAR(s.r_f, number("r_f"), 1e-9);
    EXPECT_NEAR(s.r_c, number("r_c"), 1e-9);
    EXPECT_NEAR(s.beta, number("beta"), 1e-9);
    EXPECT_NEAR(s.beta_i_max, number("max_beta_i"), 1e-9);
    EXPECT_NEAR(s.rho, number("rho"), 1e-9);
    EXPECT_NEAR(s.nearest_mean, number("mean_nn_norm"), 1e-9);
    EXPECT_NEAR(s.angle_min_deg, number("angle_min"), 1e-9);
    if (name.find("RegularGrid") != std::string::npos)
      continue;  // cocircular: angles and valence aren't unique
    EXPECT_NEAR(s.angle_max_deg, number("angle_max"), 1e-9);
    std::ostringstream valence;
    for (const auto& [k, count] : s.valence) valence << k << ":" << count << " ";
    EXPECT_EQ(valence.str(), wanted.at("valence"));
  }
}

TEST(Spacing, AgreesWithDistancesAlone) {
  const std::tuple<double, double, std::size_t> shapes[] = {
      {1, 1, 3}, {1, 1, 50}, {2, 0.1, 30}, {1, 1, 800}, {5, 3, 200}};
  for (const auto& [width, height, n] : shapes)
    for (std::uint64_t seed : {1u, 2u}) {
      SCOPED_TRACE(::testing::Message() << width << " x " << height << ", n " << n << ", seed " << seed);
      const PointSet points = random_points(width, height, n, seed);
      const Spacing s = measure_spacing(points, Control(1));
      EXPECT_NEAR(s.r_f, brute_r_f(points), 1e-12);
      EXPECT_NEAR(s.r_c, brute_r_c(points, 1e-6), 1e-6);
    }
}

TEST(Spacing, OfLatticesHasTheirClosedForms) {
  Control control;
  // The torus that a triangular lattice of 2 * 20 * 20 points fits exactly: aspect sqrt(3).
  const auto fitting = std::make_shared<Torus>(1, std::sqrt(3.0));
  const Spacing triangular = measure_spacing(triangular_lattice(fitting, 800, control), control);
  EXPECT_EQ(triangular.n, 800u);
  EXPECT_NEAR(triangular.beta, 1 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(triangular.rho, 1, 1e-12);
  EXPECT_NEAR(triangular.packing_density, pi / (2 * std::sqrt(3.0)), 1e-12);
  EXPECT_NEAR(triangular.angle_min_deg, 60, 1e-6);
  EXPECT_NEAR(triangular.cell_area_sd, 0, 1e-9);

  const Spacing square = measure_spacing(square_lattice(std::make_shared<Torus>(), 1024, control), control);
  EXPECT_NEAR(square.beta, 1 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(square.r_f, 1.0 / 32, 1e-15);
  EXPECT_NEAR(square.beta_i_mean, square.beta, 1e-12);

  const Spacing honeycomb = measure_spacing(hexagonal_lattice(fitting, 4 * 400, control), control);
  EXPECT_NEAR(honeycomb.beta, 1, 1e-12);
  EXPECT_EQ(honeycomb.n, 1600u);
}

TEST(Spacing, ObeysItsOwnLaws) {
  for (std::uint64_t seed : {1u, 2u, 3u}) {
    const LocalSpacing local = measure_local_spacing(random_points(1, 2, 500, seed), Control(2));
    const Spacing& s = local.global;
    EXPECT_LE(s.beta_i_max, s.beta);
    EXPECT_EQ(*std::max_element(local.beta_i.begin(), local.beta_i.end()), s.beta_i_max);
    EXPECT_NEAR(s.beta * s.rho, s.coverage, 1e-12);
    const double least = std::asin(1 / (2 * s.beta)) * 180 / pi;
    EXPECT_GE(s.angle_min_deg, least - 1e-9);
    EXPECT_LE(s.angle_max_deg, 180 - 2 * least + 1e-9);
    EXPECT_LE(s.edge_max, 2 * s.beta + 1e-9);
    std::size_t samples = 0, edges = 0;
    for (const auto& [k, count] : s.valence) {
      samples += count;
      edges += static_cast<std::size_t>(k) * count;
    }
    EXPECT_EQ(samples, 500u);
    EXPECT_EQ(edges, 6u * 500u) << "Euler: the mean valence on a torus is 6";
  }
}

TEST(Spacing, DoesNotNoticeTranslations) {
  const PointSet points = random_points(1, 1, 300, 3);
  PointSet moved = points;
  for (std::size_t i = 0; i < points.size(); ++i)
    moved.set(i, points.domain->step(points[i], {0.3071, 0.8123}));
  const Spacing a = measure_spacing(points, Control()), b = measure_spacing(moved, Control());
  EXPECT_NEAR(a.beta, b.beta, 1e-9 * a.beta);
  EXPECT_NEAR(a.beta_i_mean, b.beta_i_mean, 1e-9 * a.beta_i_mean);
}

TEST(Spacing, ScalesWithItsDomain) {
  const PointSet points = random_points(1, 1, 300, 3);
  PointSet larger{std::make_shared<Torus>(1024, 1024), points.coordinates};
  for (double& c : larger.coordinates) c *= 1024;  // a power of two: exact
  const Spacing a = measure_spacing(points, Control()), b = measure_spacing(larger, Control());
  EXPECT_EQ(a.beta, b.beta);
  EXPECT_EQ(a.r_f * 1024, b.r_f);
}

TEST(Spacing, IsTheSameOnAnyNumberOfThreads) {
  const PointSet points = random_points(1, 1, 20000, 3);
  const Spacing one = measure_spacing(points, Control(1));
  for (unsigned threads : {2u, 3u, 8u}) {
    const Spacing many = measure_spacing(points, Control(threads));
    EXPECT_EQ(one.beta_i_mean, many.beta_i_mean);
    EXPECT_EQ(one.nearest_mean, many.nearest_mean);
    EXPECT_EQ(one.cell_area_sd, many.cell_area_sd);
    EXPECT_EQ(one.r_c, many.r_c);
  }
}

TEST(Spacing, OfPointsOnOneLineIsRight) {
  for (const bool upright : {false, true})
    for (const std::size_t n : {3u, 50u, 499u, 500u, 2000u}) {
      PointSet points{std::make_shared<Torus>(), {}};
      for (std::size_t i = 0; i < n; ++i) {
        const double along = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        points.push_back(upright ? Vec3{0.3, along, 0} : Vec3{along, 0.3, 0});
      }
      const Spacing s = measure_spacing(points, Control(2));
      EXPECT_NEAR(s.r_f, 1.0 / static_cast<double>(n), 1e-12);
      EXPECT_NEAR(s.r_c, std::hypot(0.5, 0.5 / static_cast<double>(n)), 1e-9) << n;
    }
}

TEST(Spacing, CanBeCancelled) {
  const PointSet points = random_points(1, 1, 5000, 3);
  Control control(2);
  control.cancel();
  expect_error([&] { measure_spacing(points, control); }, ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced
