// Meshes as an operation: what requests may say, and what comes out in every format.

#include "proto/formats/mesh.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/math.h"
#include "proto/formats/mesh_writer.h"
#include "proto/result.h"
#include "tests/support/proto_requests.h"
#include "tests/support/refusals.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using testing::run;

const Control plain;

std::string encoded(const Result& result, Format format) {
  return encode_result(result, format, {}, {}, plain).bytes;
}

std::string request_on(const std::string& domain, const std::string& method) {
  return R"({"points":{"generate":{"count":300,"seed":2,"domain":)" + domain + R"(}},"method":")" + method +
         "\"}";
}

const std::vector<std::string> domains = {
    R"({"type":"torus","width":2})",
    R"({"type":"box","periodic":[true,false]})",
    R"({"type":"box","periodic":[false,false]})",
    R"({"type":"polygon","rings":[[[0,0],[2,0],[2,1],[1,1],[1,2],[0,2]],[[0.2,0.2],[0.4,0.2],[0.3,0.4]]]})",
    R"({"type":"sphere"})",
    R"({"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"faces":[[0,2,1],[0,1,3],[1,2,3],[2,0,3]]})"};

TEST(MeshOperation, GivesTheSameMeshInEveryFormatAndAfterItWasKept) {
  for (const std::string& domain : domains)
    for (const std::string method : {"delaunay", "voronoi"}) {
      SCOPED_TRACE(domain + method);
      const Result result = run("mesh", request_on(domain, method));
      ASSERT_NE(result.mesh, nullptr);
      const Mesh& mesh = *result.mesh;
      const json told = json::parse(encoded(result, Format::json));
      EXPECT_EQ(told["method"], method);
      EXPECT_EQ(told["n"], 300);
      EXPECT_EQ(told["seed"], 2);
      ASSERT_EQ(told["vertices"].size(), mesh.vertices.size());
      ASSERT_EQ(told["faces"].size(), mesh.faces());
      EXPECT_EQ(told["points"].size(), 300u);
      EXPECT_EQ(told["vertices"][7].size(), static_cast<std::size_t>(result.points().domain->dimension()));
      EXPECT_EQ(told["vertices"][7][1], mesh.vertices[7].y);
      EXPECT_EQ(told["faces"][5][2], mesh[5][2]);
      const bool is_delaunay = method == "delaunay";
      EXPECT_EQ(told.contains("vertex_points"), is_delaunay);
      EXPECT_EQ(told.contains("face_points"), !is_delaunay);
      EXPECT_EQ(told["quality"].contains("euler_characteristic"), is_delaunay);

      const Result kept = load_result(store_result(result));
      for (const Format format : formats_of("mesh"))
        EXPECT_EQ(encoded(kept, format), encoded(result, format));
    }
}

/// Our own readers take triangles; others read everything in tests/readers.
TEST(MeshOperation, WritesFilesThatOurReadersTake) {
  const Result result = run("mesh", request_on(domains.back(), "delaunay"));
  for (const auto& [format, read_as] :
       {std::pair(Format::ply, MeshFormat::ply), {Format::obj, MeshFormat::obj}}) {
    const Triangles triangles = read_mesh(encoded(result, format), read_as);
    EXPECT_EQ(triangles.vertices, result.mesh->vertices);
    ASSERT_EQ(triangles.faces.size(), result.mesh->faces());
    for (std::size_t f = 0; f < triangles.faces.size(); ++f)
      EXPECT_TRUE(
          std::equal(triangles.faces[f].begin(), triangles.faces[f].end(), (*result.mesh)[f].begin()));
  }
}

TEST(MeshOperation, TellsHowGoodItsMeshIs) {
  const ordered_json quality =
      run("mesh", R"({"points":{"generate":{"method":"triangular","count":64,"domain":
          {"width":8,"height":6.928203230275509}}}})")
          .summary["quality"];
  EXPECT_EQ(quality["vertices"], 64);
  EXPECT_EQ(quality["faces"], 128);
  EXPECT_EQ(quality["edges"], 192);
  EXPECT_EQ(quality["boundary_edges"], 0);
  EXPECT_EQ(quality["euler_characteristic"], 0);
  EXPECT_NEAR(quality["angle_deg"]["min"].get<double>(), 60, 1e-9);
  EXPECT_NEAR(quality["angle_deg"]["max"].get<double>(), 60, 1e-9);
  EXPECT_NEAR(quality["aspect_ratio"]["max"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(quality["area"].get<double>(), quality["domain_area"].get<double>(), 1e-9);
  EXPECT_EQ(quality["valence"], ordered_json({{"6", 64}}));
  const ordered_json cells = run("mesh", R"({"points":{"generate":{"method":"triangular","count":64,"domain":
          {"width":8,"height":6.928203230275509}}},"method":"voronoi"})")
                                 .summary["quality"];
  EXPECT_EQ(cells["faces"], 64);
  EXPECT_NEAR(cells["angle_deg"]["max"].get<double>(), 120, 1e-9);
  EXPECT_NEAR(cells["aspect_ratio"]["max"].get<double>(), 2 / std::sqrt(3), 1e-9);
}

TEST(MeshOperation, IsToldInTheQueryWherePointsAreATable) {
  const std::string csv = "0.1,0.2\n0.7,0.3\n0.4,0.8\n0.5,0.55\n";
  Control control;
  const Result result = execute(
      testing::read_table("mesh", "text/csv", csv, {{"method", "voronoi"}, {"domain.type", "box"}}), control);
  EXPECT_EQ(result.mesh->faces(), 4u);
  EXPECT_EQ(result.summary["domain"]["type"], "box");
}

TEST(MeshOperation, RefusesWhatItCantMean) {
  using testing::invalid;
  const std::string points = R"({"points":{"generate":{"count":9}},)";
  testing::expect_refusals({
      {"mesh", points + R"("method":"quad"})", invalid, "/method", "there are: delaunay, voronoi"},
      {"mesh", points + R"("picture":"points"})", invalid, "/picture", ""},
      {"mesh", points + R"("beta":0.7})", invalid, "/beta", ""},
      {"mesh", "{}", invalid, "/points", "generate"},
      {"mesh", R"({"points":{"generate":{"count":2}}})", ErrorCode::degenerate_input,
       "/points/generate/count", ""},
      {"mesh", R"({"points":[[0.1,0.2],[0.3,0.4],[0.1,0.2]]})", ErrorCode::degenerate_input, "/points/2", ""},
  });
}

/// A torus in space, of 6 by 5 squares cut in two.
json torus_in_space() {
  constexpr int around = 6, through = 5;
  json vertices = json::array(), faces = json::array();
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < through; ++j) {
      const double u = 2 * pi * i / around, v = 2 * pi * j / through, r = 2 + std::cos(v);
      vertices.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
      const int next = (i + 1) % around * through, up = (j + 1) % through;
      faces.push_back({i * through + j, next + j, next + up});
      faces.push_back({i * through + j, next + up, i * through + up});
    }
  return {{"type", "mesh"}, {"vertices", vertices}, {"faces", faces}};
}

TEST(MeshOperation, NamesTheRadiusThatWouldDoWherePointsAreTooFew) {
  const auto body = [](int count) {
    return R"({"points":{"generate":{"method":"white-noise","count":)" + std::to_string(count) +
           R"(,"domain":)" + torus_in_space().dump() + "}}}";
  };
  testing::expect_refusal([&] { run("mesh", body(5)); },
                          {"mesh", body(5), ErrorCode::infeasible, "/points", "would do"});
  EXPECT_EQ(run("mesh", body(500)).summary["quality"]["euler_characteristic"], 0);
}

}  // namespace
}  // namespace wellspaced
