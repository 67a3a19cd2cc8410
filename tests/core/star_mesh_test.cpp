#include "core/voronoi/star_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/lattice.h"
#include "core/optimize/opt_beta.h"
#include "tests/support/mesh.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"
#include "tests/support/vector_widths.h"

namespace wellspaced {
namespace {

using testing::expect_delaunay;
using testing::expect_error;
using testing::mps;
using testing::places;
using testing::random_points;
using testing::stars_of;

TEST(StarMesh, IsDelaunayFromTheStart) {
  for (const PointSet& input : {mps(500, 1), mps(300, 2, 3), mps(400, 3, 0.2), random_points(1, 1, 300, 4)}) {
    const StarMesh mesh(input, Control());
    expect_delaunay(places(mesh, input), stars_of(mesh));
  }
}

TEST(StarMesh, IsDelaunayAgainAfterMovesAndFlips) {
  const PointSet input = mps(400, 5, 1.5);
  const Control control;
  StarMesh mesh(input, control);
  Rng rng(1);
  std::size_t flips = 0;
  for (int round = 0; round < 20; ++round) {
    // A tenth of the spacing at a time, one point after the other, so that no triangle turns over.
    for (std::size_t i = 0; i < mesh.size(); i += 3) {
      const auto jump = [&](double scale) {
        return static_cast<std::uint32_t>(static_cast<std::int32_t>((rng.uniform() - 0.5) * 0.1 / scale));
      };
      const FixedPoint from = mesh.at(i);
      mesh.move_to(i, {from.x + jump(mesh.scale().x), from.y + jump(mesh.scale().y)});
    }
    flips += mesh.legalize_all(control);
    expect_delaunay(places(mesh, input), stars_of(mesh));
  }
  EXPECT_GT(flips, 50u);
}

TEST(StarMesh, MeasuresWhatTheAnalysisMeasures) {
  const PointSet input = mps(700, 6, 0.7);
  const Control control;
  const StarMesh mesh(input, control);
  const Spacing spacing = measure_spacing(input, control);
  const MeshRadii radii = mesh.measure(control);
  EXPECT_NEAR(radii.shortest * mesh.spacing(), spacing.r_f, 1e-8);
  EXPECT_NEAR(radii.outermost * mesh.spacing(), spacing.r_c, 1e-8);
}

/// Every edge and every triangle, in double.
MeshRadii measured_one_by_one(const StarMesh& mesh) {
  double shortest2 = 1e300, outermost2 = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Star& star = mesh.star(i);
    for (int k = 0; k < star.degree; ++k) {
      const Vec2 a = mesh.offset(i, star.neighbor[k]), b = mesh.offset(i, star.neighbor[star.after(k)]);
      const double area2 = cross(a, b);
      shortest2 = std::min(shortest2, norm2(a));
      outermost2 = std::max(outermost2, norm2(a) * norm2(b) * norm2(a - b) / (4 * area2 * area2));
    }
  }
  return {std::sqrt(shortest2), std::sqrt(outermost2)};
}

TEST(StarMesh, MeasuresEveryStarOnAnyVectorWidth) {
  Control control;
  const PointSet lattice = triangular_lattice(std::make_shared<Torus>(), 1000, control);
  const PointSet even = opt_beta(mps(40000, 4), {0.75, {}, {}}, control).points;
  for (const PointSet& input : {random_points(1, 1, 2000, 1), mps(30000, 2), lattice, even}) {
    const StarMesh mesh(input, control);
    const MeshRadii expected = measured_one_by_one(mesh);
    testing::on_every_vector_width([&](const std::string& name) {
      const MeshRadii radii = mesh.measure(control);
      EXPECT_EQ(radii.shortest, expected.shortest) << name;
      EXPECT_EQ(radii.outermost, expected.outermost) << name;
    });
  }
}

TEST(StarMesh, CutsStripsThatHoldEveryPlaceOnce) {
  for (const PointSet& input : {mps(100, 1), mps(5000, 1), mps(5000, 2, 7), mps(4000, 3, 0.1)}) {
    const StarMesh mesh(input, Control());
    std::uint32_t end = 0;
    for (const Strip& strip : mesh.strips()) {
      EXPECT_EQ(strip.begin, end);
      end = strip.end;
    }
    EXPECT_EQ(end, mesh.size());
    if (mesh.strips().size() == 1) continue;
    EXPECT_EQ(mesh.strips().size() % 2, 0u);
    for (std::uint32_t v = 0; v < mesh.size(); ++v) {
      std::array<int, 2> holders{};
      for (std::size_t s = 0; s < mesh.strips().size(); ++s) {
        const Strip& strip = mesh.strips()[s];
        const bool own = strip.begin <= v && v < strip.end, held = strip.territory.holds(v);
        EXPECT_TRUE(held || !own) << v;
        holders[s % 2] += held;
      }
      EXPECT_EQ(holders, (std::array<int, 2>{1, 1})) << "of each color, at place " << v;
    }
  }
  EXPECT_GE(StarMesh(mps(5000, 1), Control()).strips().size(), 4u);
}

TEST(StarMesh, PutsOffFlipsBeyondATerritory) {
  const PointSet input = mps(2000, 5);
  const Control control;
  StarMesh mesh(input, control);
  Rng rng(2);
  for (std::size_t i = 0; i < mesh.size(); i += 3) {
    const FixedPoint from = mesh.at(i);
    mesh.move_to(i, {from.x + static_cast<std::uint32_t>(0.1 * rng.uniform() / mesh.scale().x), from.y});
  }
  const auto n = static_cast<std::uint32_t>(mesh.size());
  const Territory half{0, n / 2, n};
  Suspects suspects{half};
  for (std::uint32_t i = 0; i < n / 2; ++i)
    for (int k = 0; k < mesh.star(i).degree; ++k) suspects.add(i, mesh.star(i).neighbor[k]);
  std::vector<Star> before;
  for (std::uint32_t i = 0; i < n; ++i) before.push_back(mesh.star(i));
  EXPECT_GT(mesh.legalize(suspects), 20u);
  for (std::uint32_t i = n / 2; i < n; ++i)
    EXPECT_TRUE(std::equal(before[i].neighbor, before[i].neighbor + Star::most, mesh.star(i).neighbor)) << i;
  suspects.territory = mesh.everywhere();
  suspects.edges.swap(suspects.put_off);
  mesh.legalize(suspects);
  EXPECT_TRUE(suspects.put_off.empty());
  mesh.legalize_all(control);
  expect_delaunay(places(mesh, input), stars_of(mesh));
}

TEST(StarMesh, TriangulatesCocircularPointsAfterANudge) {
  Control control;
  const PointSet lattice = square_lattice(std::make_shared<Torus>(), 400, control);
  const StarMesh mesh(lattice, control);
  std::size_t edges = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) edges += static_cast<std::size_t>(mesh.star(i).degree);
  EXPECT_EQ(edges, 6 * lattice.size());  // Euler, on a torus
}

TEST(StarMesh, ReturnsUnmovedPointsBitForBit) {
  const PointSet input = mps(200, 7);
  StarMesh mesh(input, Control());
  mesh.move_to(11, {mesh.at(11).x + 1000, mesh.at(11).y});
  const PointSet out = mesh.points(input, Control());
  for (std::size_t i = 0; i < input.size(); ++i) EXPECT_EQ(out[i] == input[i], i != mesh.original(11)) << i;
  EXPECT_NEAR(out[mesh.original(11)].x - input[mesh.original(11)].x, 1000 * 0x1p-32, 1e-9);
}

TEST(StarMesh, TakesMarksInOrderAndSeesLaterOnes) {
  StarMesh mesh(mps(200, 8), Control());
  EXPECT_EQ(mesh.take_marked(0, mesh.size()), mesh.size());
  for (const std::size_t i : {3, 64, 130}) mesh.mark(i);
  EXPECT_EQ(mesh.take_marked(0, mesh.size()), 3u);
  mesh.mark(2);
  mesh.mark(63);
  EXPECT_EQ(mesh.take_marked(4, mesh.size()), 63u);
  EXPECT_EQ(mesh.take_marked(64, mesh.size()), 64u);
  EXPECT_EQ(mesh.take_marked(65, mesh.size()), 130u);
  EXPECT_EQ(mesh.take_marked(131, mesh.size()), mesh.size());
  EXPECT_TRUE(mesh.any_marked());
  EXPECT_EQ(mesh.take_marked(0, mesh.size()), 2u);
  mesh.mark_all();
  std::size_t count = 0;
  for (std::size_t i = mesh.take_marked(0, mesh.size()); i < mesh.size();
       i = mesh.take_marked(i + 1, mesh.size()))
    ++count;
  EXPECT_EQ(count, mesh.size());
  EXPECT_FALSE(mesh.any_marked());
}

TEST(StarMesh, RefusesWhatItCannotHold) {
  const auto refused = [](const PointSet& points, const std::string& part) {
    expect_error([&] { StarMesh(points, Control()); }, ErrorCode::degenerate_input, "", part);
  };
  refused(random_points(1, 1, 19, 1), "20 points");
  refused(random_points(1, 0.05, 40, 1), "thinner");
  PointSet wheel{std::make_shared<Torus>(), {}};
  wheel.push_back({0.5, 0.5, 0});
  for (int k = 0; k < 40; ++k)
    wheel.push_back({0.5 + 0.3 * std::cos(k * 0.157 + 0.01), 0.5 + 0.3 * std::sin(k * 0.157 + 0.01), 0});
  refused(wheel, "neighbors");
  PointSet twins = mps(100, 9);
  twins.set(0, {0.25, 0.25, 0});
  twins.push_back({0.25 + 1.1e-10, 0.25, 0});
  refused(twins, "2^32nd");
}

}  // namespace
}  // namespace wellspaced
