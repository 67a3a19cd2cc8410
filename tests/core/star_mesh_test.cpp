#include "core/voronoi/star_mesh.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/analyze/spacing.h"
#include "core/generate/lattice.h"
#include "tests/support/mesh.h"
#include "tests/support/optimizing.h"
#include "tests/support/oracle.h"

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
  for (int round = 0; round < 20; ++round) {
    // A tenth of the spacing at a time, one point after the other, so that no triangle turns over.
    for (std::size_t i = 0; i < mesh.size(); i += 3) {
      const auto jump = [&](double scale) {
        return static_cast<std::uint32_t>(static_cast<std::int32_t>((rng.uniform() - 0.5) * 0.1 / scale));
      };
      const FixedPoint from = mesh.at(i);
      mesh.move_to(i, {from.x + jump(mesh.scale().x), from.y + jump(mesh.scale().y)});
    }
    mesh.legalize_all(control);
    expect_delaunay(places(mesh, input), stars_of(mesh));
  }
  EXPECT_GT(mesh.flips(), 50u);
}

TEST(StarMesh, MeasuresWhatTheAnalysisMeasures) {
  const PointSet input = mps(700, 6, 0.7);
  const Control control;
  const StarMesh mesh(input, control);
  const Spacing spacing = measure_spacing(input, control);
  const MeshRadii radii = mesh.measure();
  EXPECT_NEAR(radii.shortest * mesh.spacing(), spacing.r_f, 1e-8);
  EXPECT_NEAR(radii.outermost * mesh.spacing(), spacing.r_c, 1e-8);
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
  const PointSet out = mesh.points(input);
  for (std::size_t i = 0; i < input.size(); ++i) EXPECT_EQ(out[i] == input[i], i != mesh.original(11)) << i;
  EXPECT_NEAR(out[mesh.original(11)].x - input[mesh.original(11)].x, 1000 * 0x1p-32, 1e-9);
}

TEST(StarMesh, TakesMarksInOrderAndSeesLaterOnes) {
  StarMesh mesh(mps(200, 8), Control());
  EXPECT_EQ(mesh.take_marked(0), mesh.size());
  for (const std::size_t i : {3, 64, 130}) mesh.mark(i);
  EXPECT_EQ(mesh.take_marked(0), 3u);
  mesh.mark(2);
  mesh.mark(63);
  EXPECT_EQ(mesh.take_marked(4), 63u);
  EXPECT_EQ(mesh.take_marked(64), 64u);
  EXPECT_EQ(mesh.take_marked(65), 130u);
  EXPECT_EQ(mesh.take_marked(131), mesh.size());
  EXPECT_TRUE(mesh.any_marked());
  EXPECT_EQ(mesh.take_marked(0), 2u);
  mesh.mark_all();
  std::size_t count = 0;
  for (std::size_t i = mesh.take_marked(0); i < mesh.size(); i = mesh.take_marked(i + 1)) ++count;
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
  twins.push_back({twins[0].x + 1e-12, twins[0].y, 0});
  refused(twins, "2^32nd");
}

}  // namespace
}  // namespace wellspaced
