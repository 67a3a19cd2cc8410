// Every operation on every domain that requests can name.
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/analyze/spacing.h"
#include "core/domain/sizing.h"
#include "proto/execute.h"
#include "proto/json_writer.h"
#include "proto/result.h"
#include "tests/support/proto_requests.h"
#include "tests/support/refusals.h"

namespace wellspaced {
namespace {

using testing::expect_refusals;
using testing::invalid;
using testing::run;

const std::string ring = R"([[0,0],[2,0.5],[1,1],[2,2],[0,1.5]])", hole = R"([[0.3,0.6],[0.6,1],[0.6,0.6]])";

const std::vector<std::string> all_domains = {
    R"({"type":"box"})",
    R"({"type":"box","width":2,"height":3})",
    R"({"type":"torus","periodic":[true,false]})",
    R"({"type":"box","periodic":[false,true],"width":2})",
    R"({"type":"sphere"})",
    R"({"type":"sphere","radius":20})",
    R"({"type":"polygon","rings":[)" + ring + "," + hole + "]}",
    R"({"type":"Polygon","coordinates":[)" + ring + "]}",
};

TEST(Domains, AreGeneratedOnOptimizedAndMeasured) {
  for (const std::string& domain : all_domains) {
    SCOPED_TRACE(domain);
    const std::string generate = R"({"domain":)" + domain + R"(,"count":150,"seed":3})";
    const Result made = run("generate", generate);
    EXPECT_EQ(made.points().size(), 150u);
    const Result optimized = run("optimize", R"({"points":{"generate":)" + generate + R"(},"beta":0.82})");
    const auto& summary = optimized.summary;
    EXPECT_EQ(summary["converged"], true);
    EXPECT_LE(summary["beta_upper"], 0.82);
    EXPECT_GE(summary["beta_upper"], summary["beta"]);
    EXPECT_NEAR(summary["beta_upper"].get<double>(), summary["beta"].get<double>(), 1e-8);
    const Result analyzed =
        run("analyze", R"({"points":{"generate":)" + generate + R"(},"measures":["spacing","certificate"]})");
    EXPECT_LE(analyzed.summary["spacing"]["beta"], 1.000001);
    EXPECT_EQ(analyzed.summary["domain"], made.summary["domain"]);
  }
}

/// An octahedron, with unused vertex 6.
const std::string octahedron_vertices = R"([[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1],[9,9,9]])";
const std::string octahedron_faces = R"([[0,2,4],[2,1,4],[1,3,4],[3,0,4],[2,0,5],[1,2,5],[3,1,5],[0,3,5]])";
const std::string octahedron =
    R"({"type":"mesh","vertices":)" + octahedron_vertices + R"(,"faces":)" + octahedron_faces + "}";
const std::string open_book =
    R"({"type":"mesh","vertices":[[0,0,0],[0,1,0],[1,0.5,0],[0.5,0.5,1]],"faces":[[1,0,2],[0,1,3]],)"
    R"("allow_self_intersections":true})";

TEST(Domains, MayBeMeshes) {
  for (const std::string& domain : {octahedron, open_book}) {
    SCOPED_TRACE(domain);
    const std::string generate = R"({"domain":)" + domain + R"(,"count":200,"seed":3})";
    const Result made = run("generate", generate);
    EXPECT_EQ(made.points().size(), 200u);
    EXPECT_EQ(made.summary["domain"], nlohmann::ordered_json::parse(domain));
    const auto summary =
        run("optimize", R"({"points":{"generate":)" + generate + R"(},"beta":0.85})").summary;
    EXPECT_EQ(summary["converged"], true);
    EXPECT_LE(summary["beta"], 0.85);
    EXPECT_EQ(summary["beta_upper"], nullptr);
    const auto again =
        run("analyze", R"({"points":)" + rows_to_json(made.points().coordinates.data(), 200, 3) +
                           R"(,"domain":)" + domain + R"(,"measures":["spacing","certificate"]})")
            .summary;
    EXPECT_NEAR(again["spacing"]["beta"], summary["history"][0][1], 1e-12);
  }
}

TEST(Domains, ThatAreMeshesTakePointsOnThem) {
  const auto spacing =
      run("analyze",
          R"({"domain":)" + octahedron + R"(,"points":[[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1]]})")
          .summary["spacing"];
  EXPECT_NEAR(spacing["r_f"].get<double>(), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(spacing["r_c"].get<double>(), std::sqrt(2.0 / 3), 1e-12);  // the middles of faces
  EXPECT_EQ(spacing["valence"], nlohmann::ordered_json({{"4", 6}}));
}

TEST(Domains, ThatAreMeshesMayHaveVerticesWithoutFaces) {
  const auto made = [](const std::string& first) {
    return run("generate", R"({"count":20,"domain":{"type":"mesh","vertices":[)" + first +
                               R"([0,0,0],[1,0,0],[0,1,0],[0,0,1],[9,9,9]],"faces":)" +
                               (first.empty() ? "[[0,2,1],[0,1,3],[1,2,3],[2,0,3]]}}"
                                              : "[[1,3,2],[1,2,4],[2,3,4],[3,1,4]]}}"));
  };
  EXPECT_EQ(made("").points().size(), 20u);
  EXPECT_EQ(made("[5,5,5],").points().coordinates, made("").points().coordinates);
}

TEST(Domains, ThatAreMeshesTellTheFacesOfPointsWhereAsked) {
  const std::string made = R"({"count":40,"domain":)" + octahedron;
  const Result result = run("generate", made + R"(,"barycentric":true})");
  const auto text = [](const Result& r) { return encode_result(r, Format::json, {}, {}, Control()).bytes; };
  const auto answer = nlohmann::json::parse(text(result));
  const auto mesh = nlohmann::json::parse(octahedron);
  ASSERT_EQ(answer["face"].size(), 40u);
  ASSERT_EQ(answer["barycentric"].size(), 40u);
  for (std::size_t i = 0; i < 40; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t corner = mesh["faces"][answer["face"][i].get<std::size_t>()][k];
        sum += answer["barycentric"][i][k].get<double>() * mesh["vertices"][corner][axis].get<double>();
      }
      EXPECT_NEAR(sum, answer["points"][i][axis].get<double>(), 1e-12);
    }
  EXPECT_EQ(text(load_result(store_result(result))), text(result));
  EXPECT_FALSE(nlohmann::json::parse(text(run("generate", made + "}"))).contains("face"));
  const Result moved =
      run("optimize", R"({"beta":0.9,"barycentric":true,"points":{"generate":)" + made + "}}}");
  EXPECT_EQ(nlohmann::json::parse(text(moved))["face"].size(), 40u);
  expect_refusals({{"generate", R"({"count":40,"barycentric":true})", invalid, "/barycentric", "mesh"},
                   {"generate", made + R"(,"barycentric":1})", invalid, "/barycentric", "true or false"},
                   {"analyze", R"({"points":{"generate":)" + made + R"(}},"barycentric":true})", invalid,
                    "/barycentric", "unknown"}});
}

// 2000 flat faces: 3 points look over all of them again and again, 3000 only around themselves.
TEST(Domains, ThatAreMeshesOfManyFacesAreSlowForFewPoints) {
  nlohmann::json vertices, faces;
  for (int k = 0; k <= 1000; ++k)
    for (const int y : {0, 1}) vertices.push_back({k, y, 0});
  for (int k = 0; k < 2000; ++k)
    faces.push_back(k % 2 == 0 ? nlohmann::json{k, k + 2, k + 1} : nlohmann::json{k, k + 1, k + 2});
  const std::string mesh =
      R"(,"domain":{"type":"mesh","vertices":)" + vertices.dump() + R"(,"faces":)" + faces.dump() + "}}";
  const auto seconds = [&](const std::string& what) {
    return expected_cost(testing::read("generate", "{" + what + mesh)).seconds;
  };
  EXPECT_GT(seconds(R"("count":3)"), 1);
  EXPECT_GT(seconds(R"("count":3)"), 10 * seconds(R"("count":3000)"));
  EXPECT_LT(seconds(R"("count":3,"method":"white-noise")"), 0.1);
}

TEST(Domains, ThatAreMeshesTakeRadiiOfTheirVertices) {
  const std::string sizing =
      R"("sizing":{"type":"vertices","radii":[0.1,0.3,0.2,0.2,0.2,0.2,1]},"domain":)" + octahedron;
  const Result made = run("generate", "{" + sizing + "}");
  int left = 0, right = 0;
  for (std::size_t i = 0; i < made.points().size(); ++i) ++(made.points()[i].x < 0 ? left : right);
  EXPECT_GT(3 * right, 5 * left);
  const Result back = load_result(store_result(made));
  EXPECT_EQ(back.points().sizing->at({-1, 0, 0}), 0.3);
  EXPECT_EQ(store_result(back), store_result(made));
}

TEST(Domains, ThatAreBadMeshesAreRefusedWithTheCulprit) {
  const auto generate = [](const std::string& members) {
    return R"({"count":10,"domain":{"type":"mesh",)" + members + "}}";
  };
  const std::string corners = R"("vertices":[[0,0,0],[1,0,0],[0,1,0],[1,1,0]])";
  expect_refusals({
      {"generate", generate(corners), invalid, "/domain/faces", "missing"},
      {"generate", generate(R"("faces":[[0,1,2]])"), invalid, "/domain/vertices", "missing"},
      {"generate", generate(corners + R"(,"faces":[])"), invalid, "/domain/faces", "at least one"},
      {"generate", generate(corners + R"(,"faces":[[0,1,2],[0,1]])"), invalid, "/domain/faces/1", "three"},
      {"generate", generate(corners + R"(,"faces":[[0,1,-2]])"), invalid, "/domain/faces/0/2", "index"},
      {"generate", generate(corners + R"(,"faces":[[0,1.5,2]])"), invalid, "/domain/faces/0/1", "index"},
      {"generate", generate(corners + R"(,"faces":[[0,1,5000000000]])"), invalid, "/domain/faces/0/2",
       "index"},
      {"generate", generate(corners + R"(,"faces":[[0,1,4]])"), invalid, "/domain/faces/0", "vertex 4"},
      {"generate", generate(corners + R"(,"faces":[[0,1,2],[1,2,3]])"), invalid, "/domain/faces/1", "0"},
      {"generate", generate(R"("vertices":[[0,0,0],[1,"a",0]],"faces":[[0,1,2]])"), invalid,
       "/domain/vertices/1/1", "a number"},
      {"generate", generate(R"("vertices":7,"faces":[[0,1,2]])"), invalid, "/domain/vertices", "an array"},
      {"generate", generate(corners + R"(,"faces":[[0,1,2]],"alow":true)"), invalid, "/domain/alow",
       "allow_self_intersections"},
      {"generate",
       generate(R"("vertices":[[0,0,0],[1,0,0],[0,1,0],[0.2,0.2,-1],[0.2,0.2,1],[2,2,0]],)"
                R"("faces":[[0,1,2],[3,4,5]])"),
       invalid, "/domain/faces/1", "allow_self_intersections"},
      {"analyze", R"({"points":[[1,0,0],[0,1,0],[0,0,0]],"domain":)" + octahedron + "}", invalid, "/points/2",
       "surface"},
      {"analyze", R"({"points":[[1,0],[0,1],[0,0]],"domain":)" + octahedron + "}", invalid, "/points",
       "3 coordinates"},
  });
}

TEST(Domains, OfKeptResultsComeBackAsTheyWere) {
  std::vector<std::string> kept = all_domains;
  kept.insert(kept.end(), {octahedron, open_book});
  for (const std::string& domain : kept) {
    SCOPED_TRACE(domain);
    const Result made = run("generate", R"({"domain":)" + domain + R"(,"count":40})");
    const std::string bytes = store_result(made);
    const Result back = load_result(bytes);
    EXPECT_EQ(back.points().coordinates, made.points().coordinates);
    EXPECT_EQ(domain_to_json(*back.points().domain), domain_to_json(*made.points().domain));
    EXPECT_EQ(store_result(back), bytes);
  }
}

TEST(Domains, OfRectanglesAreTheSameHoweverTheyAreNamed) {
  EXPECT_EQ(
      run("generate", R"({"domain":{"type":"box","periodic":[true,true]},"count":50})").summary["domain"],
      run("generate", R"({"count":50})").summary["domain"]);
  EXPECT_EQ(run("generate", R"({"domain":{"type":"torus","periodic":[false,false]},"count":50})")
                .points()
                .coordinates,
            run("generate", R"({"domain":{"type":"box"},"count":50})").points().coordinates);
}

TEST(Domains, TakePointsOfTheirDimensionInPlace) {
  const Result result = run("analyze", R"({"domain":{"type":"sphere","radius":2},
      "points":[[2,0,0],[-2,0,0],[0,2,0],[0,-2,0],[0,0,2],[0,0,-2]]})");
  EXPECT_NEAR(result.summary["spacing"]["r_f"].get<double>(), 3.14159265358979, 1e-12);  // a quarter turn
  EXPECT_NEAR(result.summary["spacing"]["r_c"].get<double>(), 2 * 0.955316618124509, 1e-12);
  EXPECT_EQ(result.summary["spacing"]["valence"], nlohmann::ordered_json({{"4", 6}}));
}

TEST(Domains, AreRefusedWhereTheyCannotBe) {
  const std::string box = R"("domain":{"type":"box"})";
  expect_refusals({
      {"generate", R"({"count":10,"domain":{"type":"klein bottle"}})", invalid, "/domain/type",
       "torus, box, sphere, polygon"},
      {"generate", R"({"count":10,"domain":{"type":"box","periodic":true}})", invalid, "/domain/periodic",
       "two booleans"},
      {"generate", R"({"count":10,"domain":{"type":"box","width":-1}})", invalid, "/domain/width", "1e-6"},
      {"generate", R"({"count":10,"domain":{"type":"sphere","radius":0}})", invalid, "/domain/radius",
       "1e-6"},
      {"generate", R"({"count":10,"domain":{"type":"sphere","width":1}})", invalid, "/domain/width",
       "known here are: radius, type"},
      {"generate", R"({"method":"square","count":10,)" + box + "}", invalid, "/method", "for a torus only"},
      {"generate", R"({"radius":2,)" + box + "}", ErrorCode::infeasible, "/radius", "this box"},
      {"optimize", R"({"points":[[0.1,0.1],[0.5,1.5],[0.9,0.2]],)" + box + "}", invalid, "/points/1",
       "outside the box"},
      {"analyze", R"({"points":[[1,0,0],[0,1,0],[0,0,1.5]],"domain":{"type":"sphere"}})", invalid,
       "/points/2", "not on the sphere"},
      {"analyze", R"({"points":[[1,0],[0,1],[0.5,0]],"domain":{"type":"sphere"}})", invalid, "/points",
       "3 coordinates"},
      {"analyze", R"({"points":{"generate":{"count":10,)" + box + R"(}},"measures":["spectrum"]})", invalid,
       "/measures/0", "on a torus only"},
      {"analyze", R"({"sets":[{"generate":{"count":10,)" + box + R"(}},{"generate":{"count":10}}]})", invalid,
       "/sets/1", "another domain"},
  });
}

TEST(Sizing, SaysHowDensePointsAreMadeAndOptimized) {
  const std::string sizing = R"({"type":"linear","axis":"z","from":0.2,"to":0.05})";
  const std::string generate =
      R"({"domain":{"type":"sphere"},"sizing":)" + sizing + R"(,"count":400,"seed":1})";
  const Result made = run("generate", generate);
  EXPECT_EQ(made.points().size(), 400u);
  EXPECT_NEAR(made.summary["sizing"]["lipschitz"], 0.075, 1e-15);
  int above = 0;
  for (std::size_t i = 0; i < made.points().size(); ++i) above += made.points()[i].z > 0 ? 1 : 0;
  EXPECT_GT(above, 280);  // the integral of r^-2 is four times as large there
  const Result optimized = run("optimize", R"({"points":{"generate":)" + generate + R"(},"beta":0.85})");
  EXPECT_EQ(optimized.summary["converged"], true);
  EXPECT_LE(optimized.summary["beta"], 0.85);
  EXPECT_TRUE(optimized.summary["beta_upper"].is_null());
  const std::string bytes = store_result(optimized);
  EXPECT_EQ(store_result(load_result(bytes)), bytes);
}

TEST(Sizing, AloneSaysTheRadii) {
  const Result made =
      run("generate", R"({"sizing":{"type":"constant","radius":0.05},"domain":{"type":"box"}})");
  EXPECT_GE(measure_spacing(made.points(), Control()).r_f, 1);  // in units of r
  EXPECT_NEAR(static_cast<double>(made.points().size()), 310, 40);
}

/// 2 x 2 pixels: black and white above, 51 and 102 of 255 below.
const std::string tiny_png =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAAAAABX3VL4AAAADklEQVR4nGNg+M9gnAYABM4BmRl11eIAAAAASUVORK5CYII=";
/// Says that it has 60000 x 60000.
const std::string huge_png =
    "iVBORw0KGgoAAAANSUhEUgAA6mAAAOpgCAAAAACluSqeAAAACUlEQVR4nEsEAABiAGKnFg2PAAAAAElFTkSuQmCC";

TEST(Sizing, OfAnImageIsThatOfItsGrid) {
  const std::string rest = R"(},"count":200,"seed":3,"domain":{"type":"box","width":2}})";
  const Result image = run(
      "generate", R"({"sizing":{"type":"image","black":0.01,"white":0.06,"png":")" + tiny_png + '"' + rest);
  const Result grid = run("generate", R"({"sizing":{"type":"grid","radii":[[0.02,0.03],[0.01,0.06]])" + rest);
  const Sizing &a = *image.points().sizing, &b = *grid.points().sizing;
  for (const Vec3 p : {Vec3{0.5, 0.25, 0}, {1.5, 0.25, 0}, {0.5, 0.75, 0}, {1.5, 0.75, 0}, {1, 0.5, 0}})
    EXPECT_NEAR(a.at(p), b.at(p), 1e-15);
  EXPECT_NEAR(a.at({0.5, 0.75, 0}), 0.01, 1e-15);
  ASSERT_EQ(image.points().size(), 200u);
  EXPECT_EQ(image.summary["sizing"]["type"], "image");
  EXPECT_EQ(image.summary["sizing"]["columns"], 2);
  EXPECT_NEAR(image.summary["sizing"]["lipschitz"], std::hypot(0.05, 0.06), 1e-12);
  EXPECT_FALSE(image.summary["sizing"].contains("png"));
  for (const Result* made : {&image, &grid}) {
    const std::string bytes = store_result(*made);
    const Result loaded = load_result(bytes);
    EXPECT_EQ(store_result(loaded), bytes);
    EXPECT_EQ(loaded.points().sizing->at({0.7, 0.3, 0}), made->points().sizing->at({0.7, 0.3, 0}));
  }
}

TEST(Sizing, OfGridsAndImagesIsRefusedWithTheCulprit) {
  const auto sized = [](const std::string& sizing) { return R"({"count":9,"sizing":)" + sizing + "}"; };
  expect_refusals({
      {"generate", sized(R"({"type":"grid"})"), invalid, "/sizing/radii", "rows of radii"},
      {"generate", sized(R"({"type":"grid","radii":[]})"), invalid, "/sizing/radii", "no rows"},
      {"generate", sized(R"({"type":"grid","radii":7})"), invalid, "/sizing/radii", "array of rows"},
      {"generate", sized(R"({"type":"image","black":1,"white":2,"png":""})"), invalid, "/sizing/png",
       "it is empty"},
      {"generate", sized(R"({"type":"grid","radii":[[]]})"), invalid, "/sizing/radii/0", "one at least"},
      {"generate", sized(R"({"type":"grid","radii":[[1,2],[1]]})"), invalid, "/sizing/radii/1", "first row"},
      {"generate", sized(R"({"type":"grid","radii":[[1,2],[1,"x"]]})"), invalid, "/sizing/radii/1/1",
       "a string"},
      {"generate", sized(R"({"type":"grid","radii":[[1,2],[0,1]]})"), invalid, "/sizing/radii/1/0",
       "above 0"},
      {"generate", sized(R"({"type":"image","black":1,"white":2})"), invalid, "/sizing/png", "base64"},
      {"generate", sized(R"({"type":"image","black":0,"white":2,"png":")" + tiny_png + "\"}"), invalid,
       "/sizing/black", "above 0"},
      {"generate", sized(R"({"type":"image","black":1,"white":2,"png":"?"})"), invalid, "/sizing/png",
       "not base64"},
      {"generate", sized(R"({"type":"image","black":1,"white":2,"png":"AAAA"})"), invalid, "/sizing/png",
       "no PNG"},
      {"generate", sized(R"({"type":"image","black":1,"white":2,"png":")" + tiny_png.substr(0, 68) + "\"}"),
       invalid, "/sizing/png", "no PNG"},
      {"generate", sized(R"({"type":"image","black":1,"white":2,"png":")" + huge_png + "\"}"), invalid,
       "/sizing/png", "60000 x 60000"},
      {"generate", sized(R"({"type":"vertices","radii":[1,2]})"), invalid, "/sizing/type",
       "domains of the type mesh"},
      {"generate", sized(R"({"type":"quadratic"})"), invalid, "/sizing/type", "vertices"},
  });
}

TEST(Sizing, IsRefusedWhereItCannotBe) {
  const std::string sizing = R"("sizing":{"type":"constant","radius":0.1})";
  expect_refusals({
      {"generate", R"({"method":"white-noise","count":9,)" + sizing + "}", invalid, "/sizing",
       "takes no sizing"},
      {"generate", R"({"radius":0.1,)" + sizing + "}", invalid, "/radius", "leave radius out"},
      {"generate", R"({"sizing":{"type":"linear","axis":"z","from":1,"to":2},"count":9})", invalid,
       "/sizing/axis", "x or y"},
  });
}

TEST(Sizing, ThatAsksForNoOrCountlessPointsIsRefused) {
  const auto on = [](const std::string& domain, const std::string& sizing) {
    return R"({"domain":{"type":")" + domain + R"("},"sizing":)" + sizing + "}";
  };
  expect_refusals({
      {"generate", on("box", R"({"type":"constant","radius":3})"), ErrorCode::infeasible, "/sizing", "0.707"},
      {"generate", on("sphere", R"({"type":"linear","from":4,"to":5})"), ErrorCode::infeasible, "/sizing",
       "no two points of this sphere are farther apart than 3.14"},
      {"generate", on("box", R"({"type":"constant","radius":1e308})"), invalid, "/sizing/radius", "1e100"},
      {"generate", on("box", R"({"type":"grid","radii":[[1e-200]]})"), invalid, "/sizing/radii/0/0",
       "1e-100"},
      {"generate", on("box", R"({"type":"linear","from":1e-12,"to":0.5})"), ErrorCode::too_large, "/sizing",
       "limit"},
      {"generate", on("box", R"({"type":"grid","radii":[[1e-9,0.5],[0.5,0.5]]})"), ErrorCode::too_large,
       "/sizing", "limit"},
      {"generate", R"({"domain":{"type":"sphere"},"radius":3.2})", ErrorCode::infeasible, "/radius",
       "no two points of this sphere are farther apart than 3.14"},
      {"generate", R"({"domain":{"type":"polygon","rings":[[[0,0],[1e-6,0],[0,1e-6]]]},"radius":1})",
       ErrorCode::infeasible, "/radius", "7.07e-07"},
  });
  EXPECT_EQ(
      run("generate", on("box", R"({"type":"linear","from":1e-60,"to":1e-59})").insert(1, R"("count":40,)"))
          .points()
          .size(),
      40u);
}

TEST(Domains, WithDetailsSmallerThanTheRadiusAreRefusedUnlessThatIsAllowed) {
  const std::string passage =
      R"("domain":{"type":"polygon","rings":[[[0,0],[1,0],[1,0.45],[1.05,0.45],[1.05,0],[2,0],[2,1],[1.05,1],
          [1.05,0.55],[1,0.55],[1,1],[0,1]]]})";
  const std::string body = R"({"radius":0.2,)" + passage;
  expect_refusals(
      {{"generate", body + "}", ErrorCode::infeasible, "/radius", "0.05"},
       {"generate", body + R"(,"allow_small_features":1})", invalid, "/allow_small_features", ""},
       {"generate", R"({"count":50,"method":"white-noise","allow_small_features":true})", invalid,
        "/allow_small_features", "unknown"},
       {"optimize", R"({"points":{"generate":)" + body + "}}}", ErrorCode::infeasible,
        "/points/generate/radius", "allow_small_features"},
       {"generate", R"({"sizing":{"type":"linear","axis":"x","from":0.2,"to":0.3},)" + passage + "}",
        ErrorCode::infeasible, "/sizing", "0.05"}});
  EXPECT_GT(run("generate", body + R"(,"allow_small_features":true})").points().size(), 12u);
  EXPECT_GT(run("generate", R"({"radius":0.04,)" + passage + "}").points().size(), 100u);
  EXPECT_EQ(run("generate", R"({"count":40,)" + passage + "}").points().size(), 40u);
}

TEST(Domains, WithCornersThatCoincideToRoundingAreRefusedWhereEachIsAPoint) {
  const std::string polygon =
      R"("domain":{"type":"polygon","rings":[[[0,0],[1,0],[1,1],[0.999999999999,1],[0,1]]]})";
  for (const char* method : {"poisson-disk", "two-radii", "delaunay-refinement"})
    for (const char* size : {R"("count":50)", R"("radius":0.1)"})
      expect_refusals(
          {{"generate", R"({"method":")" + std::string(method) + "\"," + size + "," + polygon + "}",
            ErrorCode::infeasible, "/domain", "two corners near (1, 1, 0) are 1e-12 apart"}});
  EXPECT_EQ(run("generate", R"({"method":"white-noise","count":50,)" + polygon + "}").points().size(), 50u);
}

TEST(Domains, OfEveryKindHaveTheirHolesFilled) {
  for (
      const std::string domain :
      {R"({"type":"box"})", R"({"type":"box","periodic":[true,false]})", R"({"type":"sphere"})",
       R"({"type":"polygon","rings":[[[0,0],[1,0],[1,1],[0,1]],[[0.4,0.4],[0.6,0.4],[0.6,0.6],[0.4,0.6]]]})"}) {
    SCOPED_TRACE(domain);
    const std::string points =
        R"({"points":{"generate":{"method":"white-noise","count":200,"domain":)" + domain + "}}";
    const Result result = run("optimize", points + R"(,"beta":0.85,"enrich":true})");
    EXPECT_GT(result.summary["enriched"], 20);
    EXPECT_EQ(result.summary["converged"], true);
    const Result sized = run("optimize", points + R"(,"beta":0.9,"enrich":true,
        "sizing":{"type":"linear","axis":"y","from":1,"to":2}})");
    EXPECT_GT(sized.summary["enriched"], 20);
    EXPECT_LE(sized.summary["beta"], 0.9 + 1e-9);
  }
}

}  // namespace
}  // namespace wellspaced
