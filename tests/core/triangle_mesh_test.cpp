#include "core/domain/triangle_mesh.h"

#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>

#include "core/error.h"
#include "tests/support/meshes.h"

namespace wellspaced {
namespace {

using ::testing::HasSubstr;
using namespace wellspaced::testing;

void expect_refusal(const Triangles& mesh, const std::string& where, const std::string& part) {
  try {
    const TriangleMesh unused(mesh);
    ADD_FAILURE() << "taken, not refused with: " << part;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_parameters);
    EXPECT_EQ(error.where(), where) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

TEST(TriangleMesh, CountsWhatAClosedMeshIs) {
  const TriangleMesh mesh(icosahedron());
  const MeshFacts& facts = mesh.facts();
  EXPECT_EQ(facts.vertices, 12u);
  EXPECT_EQ(facts.edges, 30u);
  EXPECT_EQ(facts.faces, 20u);
  EXPECT_EQ(facts.components, 1u);
  EXPECT_EQ(facts.boundaries, 0u);
  EXPECT_EQ(facts.euler_characteristic, 2);
  EXPECT_EQ(facts.genus, 0u);
  EXPECT_TRUE(facts.closed);
  const double edge = 1 / std::sin(2 * pi / 5);
  EXPECT_NEAR(facts.area, 5 * std::sqrt(3.0) * edge * edge, 1e-12);
  EXPECT_NEAR(facts.volume.value(), 5.0 / 12 * (3 + std::sqrt(5.0)) * edge * edge * edge, 1e-12);
}

TEST(TriangleMesh, CountsBordersAndComponents) {
  Triangles two = flat_square(3);
  const auto other = open_cylinder(7);
  const auto shift = static_cast<std::uint32_t>(two.vertices.size());
  for (const Vec3 p : other.vertices) two.vertices.push_back(p + Vec3{0, 0, 5});
  for (const auto& [a, b, c] : other.faces) two.faces.push_back({a + shift, b + shift, c + shift});
  two.vertices.push_back({9, 9, 9});
  const TriangleMesh mesh(two);
  EXPECT_EQ(mesh.facts().components, 2u);
  EXPECT_EQ(mesh.facts().boundaries, 3u);
  EXPECT_EQ(mesh.facts().euler_characteristic, 1);
  EXPECT_EQ(mesh.facts().genus, 0u);
  EXPECT_EQ(mesh.facts().unused_vertices, 1u);
  EXPECT_FALSE(mesh.facts().closed);
  EXPECT_FALSE(mesh.facts().volume.has_value());
  EXPECT_EQ(mesh.component_of_face().front(), 0u);
  EXPECT_EQ(mesh.component_of_face().back(), 1u);
  EXPECT_EQ(mesh.borders().front().size(), 12u);
}

TEST(TriangleMesh, LeadsAroundFacesAndVertices) {
  const TriangleMesh mesh(height_field(4, 1, [](double x, double y) { return x * y; }));
  std::vector<int> seen(mesh.half_edges(), 0);
  for (std::uint32_t h = 0; h < mesh.half_edges(); ++h) {
    EXPECT_EQ(mesh.target(h), mesh.origin(TriangleMesh::next(h)));
    EXPECT_EQ(TriangleMesh::next(TriangleMesh::previous(h)), h);
    if (mesh.twin(h) == TriangleMesh::none) continue;
    EXPECT_EQ(mesh.twin(mesh.twin(h)), h);
    EXPECT_EQ(mesh.origin(mesh.twin(h)), mesh.target(h));
  }
  for (std::uint32_t v = 0; v < mesh.vertices().size(); ++v) {
    const std::uint32_t first = mesh.first_out(v);
    std::uint32_t h = first;
    do {
      EXPECT_EQ(mesh.origin(h), v);
      ++seen[h];
      h = mesh.turn_left(h);
    } while (h != TriangleMesh::none && h != first);
    EXPECT_EQ(mesh.at_border(v), h == TriangleMesh::none);
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
}

TEST(TriangleMesh, SaysWhichWayFacesLook) {
  Triangles mesh = tetrahedron();
  EXPECT_NEAR(TriangleMesh(mesh).facts().volume.value(), 8.0 / 3, 1e-14);
  for (auto& [a, b, c] : mesh.faces) std::swap(b, c);
  EXPECT_NEAR(TriangleMesh(mesh).facts().volume.value(), -8.0 / 3, 1e-14);
}

TEST(TriangleMesh, RefusesNumbersThatAreNone) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e61})
    for (int k = 0; k < 3; ++k) {
      Triangles mesh = tetrahedron();
      (k == 0 ? mesh.vertices[2].x : k == 1 ? mesh.vertices[2].y : mesh.vertices[2].z) = bad;
      expect_refusal(mesh, "/vertices/2", "vertex 2 has a coordinate");
    }
}

TEST(TriangleMesh, RefusesFacesThatAreNoTriangles) {
  expect_refusal({}, "/faces", "no faces");
  Triangles mesh = tetrahedron();
  mesh.faces[2] = {0, 2, 4};
  expect_refusal(mesh, "/faces/2", "uses vertex 4, but there are only 4");
  mesh.faces[2] = {0, 2, 0};
  expect_refusal(mesh, "/faces/2", "uses vertex 0 twice");
  mesh = tetrahedron();
  mesh.vertices[3] = mesh.vertices[2];
  expect_refusal(mesh, "/faces/2", "face 2 (vertices 0, 2 and 3) has no area");
  mesh = {{{0, 0, 0}, {1, 0, 0}, {0.5, 9e-10, 0}}, {{0, 1, 2}}};
  expect_refusal(mesh, "/faces/0", "no area");
  mesh.vertices[2].y = 1.1e-9;
  EXPECT_NO_THROW(TriangleMesh{mesh});
  for (Vec3& p : mesh.vertices) p = p + Vec3{1e5, 0, 0};
  expect_refusal(mesh, "/faces/0", "no area, to rounding");
}

TEST(TriangleMesh, RefusesFacesThatFitNoSurface) {
  Triangles mesh = flat_square(1);
  mesh.vertices.push_back({0, 0, 1});
  mesh.faces.push_back({0, 3, 4});
  expect_refusal(mesh, "/faces/2", "the edge of vertices 0 and 3 belongs to 3 faces (0, 1 and 2)");
  mesh = flat_square(1);
  mesh.faces[1] = {3, 0, 2};
  expect_refusal(mesh, "/faces/1", "faces 0 and 1 both run through the edge of vertices 0 and 3");
  mesh = flat_square(1);
  mesh.faces.push_back({3, 0, 1});
  expect_refusal(mesh, "/faces/2", "face 2 has the same vertices as face 0");
  mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  expect_refusal(mesh, "/vertices/0", "(faces 0 and 1 are in different ones)");
}

TEST(TriangleMesh, RefusesFacesThatCrossUnlessAllowed) {
  Triangles mesh = flat_square(2);
  const auto k = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{0.3, 0.1, -1}, {0.3, 0.1, 1}, {0.3, 0.2, 1}});
  mesh.faces.push_back({k, k + 1, k + 2});
  expect_refusal(mesh, "/faces/8", "faces 0 and 8 cross");
  EXPECT_EQ(TriangleMesh(mesh, TriangleMesh::Crossings::allow).facts().components, 2u);
}

TEST(TriangleMesh, StopsLookingForCrossingsWhereAllFacesAreInEachOthersBoxes) {
  constexpr std::uint32_t n = 2500;
  Triangles disk{{{0, 0, 0}}, {}};
  for (std::uint32_t k = 0; k < n; ++k) {
    const CosSin turn = portable_cos_sin(k, n);
    disk.vertices.push_back({turn.cos, turn.sin, 0});
    disk.faces.push_back({0, 1 + k, 1 + (k + 1) % n});
  }
  try {
    const TriangleMesh unused(disk);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::too_large);
    EXPECT_EQ(error.where(), "/faces");
    EXPECT_THAT(error.what(), HasSubstr("allow_self_intersections"));
  }
  EXPECT_NO_THROW(TriangleMesh(disk, TriangleMesh::Crossings::allow));
}

TEST(TriangleMesh, MeasuresWhatCgalMeasured) {
  const std::string folder = shared_data();
  if (folder.empty()) GTEST_SKIP() << "WELLSPACED_DATA_DIR is not set";
  std::ifstream expected(folder + "/expected/meshes.csv");
  int meshes = 0;
  for (std::string line; std::getline(expected, line);) {
    std::map<std::string, double> value;
    std::istringstream cells(line);
    std::string name, vertices, faces, cell;
    std::getline(cells, name, ',');
    std::getline(cells, vertices, ',');
    std::getline(cells, faces, ',');
    while (std::getline(cells, cell, ','))
      value[cell.substr(0, cell.find('='))] = std::stod(cell.substr(cell.find('=') + 1));
    if (name.ends_with(".ply")) continue;  // tests/proto reads it
    SCOPED_TRACE(name);
    const TriangleMesh mesh(read_triangles(folder + "/meshes/" + name));
    EXPECT_EQ(mesh.facts().vertices, std::stoul(vertices));
    EXPECT_EQ(mesh.facts().faces, std::stoul(faces));
    EXPECT_EQ(mesh.facts().closed, value["closed"] == 1);
    EXPECT_EQ(static_cast<double>(mesh.facts().components), value["components"]);
    EXPECT_EQ(static_cast<double>(mesh.facts().boundaries), value["boundary_cycles"]);
    EXPECT_NEAR(mesh.facts().area, value["area"], 1e-12 * value["area"]);
    EXPECT_NEAR(mesh.facts().volume.value_or(0), value["volume"], 1e-12 * value["volume"]);
    ++meshes;
  }
  EXPECT_EQ(meshes, 6);
}

TEST(TriangleMesh, RefusesTheSharedBadMeshes) {
  const std::string folder = shared_data();
  if (folder.empty()) GTEST_SKIP() << "WELLSPACED_DATA_DIR is not set";
  const auto bad = [&](const char* name) { return read_triangles(folder + "/meshes_reject/" + name); };
  expect_refusal(bad("fan3.obj"), "/faces/2", "belongs to 3 faces (0, 1 and 2)");
  expect_refusal(bad("degtri_sliding.off"), "/faces/2", "has no area");
  expect_refusal(bad("tet-shuffled.off"), "/faces/1",
                 "faces 0 and 1 both run through the edge of vertices 0 and 1");
}

}  // namespace
}  // namespace wellspaced
