#include "proto/formats/polygon.h"

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "proto/request.h"
#include "tests/support/polygons.h"
#include "tests/support/refusals.h"

namespace wellspaced {
namespace {

using namespace testing;  // NOLINT
using nlohmann::json;

std::shared_ptr<const Polygon> polygon_of(const std::string& text) {
  auto domain = std::dynamic_pointer_cast<const Polygon>(read_domain(json::parse(text), "/domain"));
  if (!domain) throw Error(ErrorCode::internal, "no polygon");
  return domain;
}

const std::string rings_text =
    "[[[0,0],[1,0],[1,1],[0,1],[0,0]],[[0.25,0.25],[0.25,0.5],[0.75,0.5],[0.75,0.25],[0.25,0.25]]]";
const std::string polygon_text = R"({"type":"Polygon","coordinates":)" + rings_text + "}";

TEST(PolygonDomain, ReadsTheSamePolygonFromEveryFormat) {
  const Rings expected = Polygon(square_with_hole()).rings();
  const std::string feature =
      R"({"type":"Feature","id":7,"properties":{"name":"x"},"geometry":)" + polygon_text + "}";
  const std::vector<std::string> same = {
      R"({"type":"polygon","rings":)" + rings_text + "}",
      R"({"type":"polygon","rings":[[[0,0],[1,0],[1,1],[0,1]],[[0.25,0.25],[0.75,0.25],[0.75,0.5],[0.25,0.5]]]})",
      polygon_text,
      R"({"type":"MultiPolygon","bbox":[0,0,1,1],"coordinates":[)" + rings_text + "]}",
      feature,
      R"({"type":"FeatureCollection","features":[)" + feature + "]}",
      R"({"type":"polygon","geojson":)" + polygon_text + "}",
      R"({"type":"polygon","geojson":)" + feature + "}",
      R"x({"type":"polygon","wkt":"POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0), (0.25 0.25, 0.25 0.5, 0.75 0.5, 0.75 0.25, 0.25 0.25))"})x",
      R"x({"type":"polygon","wkt":"  polygon((0 0,1 0,1 1,0 1),( .25 +25e-2 ,0.25\n0.5,0.75 0.5 , 0.75 0.25) ) "})x",
      R"x({"type":"polygon","wkt":"MULTIPOLYGON(((0 0,1 0,1 1,0 1),(.25 .25,.25 .5,.75 .5,.75 .25)))"})x",
  };
  for (const std::string& text : same) EXPECT_EQ(polygon_of(text)->rings(), expected) << text;
}

struct Bad {
  std::string domain;
  const char* where;
  const char* part;
};

std::string polygon(const std::string& rings) { return R"({"type":"polygon","rings":)" + rings + "}"; }
std::string wkt(const std::string& text) { return R"({"type":"polygon","wkt":")" + text + "\"}"; }
std::string geojson(const std::string& type, const std::string& rest) {
  return R"({"type":")" + type + "\"" + (rest.empty() ? "" : "," + rest) + "}";
}

void expect_refused(const std::vector<Bad>& all) {
  for (const Bad& bad : all) {
    SCOPED_TRACE(bad.domain);
    try {
      polygon_of(bad.domain);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ErrorCode::invalid_parameters ||
                  error.code() == ErrorCode::degenerate_input);
      EXPECT_EQ(error.where(), std::string("/domain") + bad.where) << error.what();
      EXPECT_THAT(error.what(), ::testing::HasSubstr(bad.part));
    }
  }
}

TEST(PolygonDomain, RefusesRingsWithThePointer) {
  expect_refused({
      {R"({"type":"polygon"})", "", "one of rings, geojson and wkt"},
      {R"x({"type":"polygon","wkt":"POLYGON((0 0,1 0,1 1))","rings":[]})x", "", "only one of"},
      {R"({"type":"polygon","ring":[]})", "/ring", "unknown field"},
      {polygon("7"), "/rings", "expected an array of rings"},
      {polygon("[]"), "/rings", "at least one ring"},
      {polygon("[7]"), "/rings/0", "expected a ring"},
      {polygon("[[]]"), "/rings/0", "at least 3"},
      {polygon("[[7]]"), "/rings/0/0", "[x, y]"},
      {polygon("[[[0,0],[1]]]"), "/rings/0/1", "this one has 1"},
      {polygon("[[[0,0],[1,0,3]]]"), "/rings/0/1/2", "lies in the plane"},
      {polygon("[[[0,0],[1,\"0\"]]]"), "/rings/0/1/1", "a string"},
      {polygon("[[[0,0],[1,null]]]"), "/rings/0/1/1", "null"},
      {polygon("[[[0,0],[1,1],[1,0],[0,1]]]"), "/rings/0/2", "crosses edge 0"},
      {polygon("[[[0,0],[1,0],[1,1]],[[5,5],[6,5],[6,6]]]"), "/rings/1", "outside the outer ring"},
      {polygon("[[[0,0],[2e6,0],[1,1]]]"), "/rings/0", "1e6"},
      {R"({"type":"triangle"})", "/type", "unknown domain"},
  });
}

TEST(PolygonDomain, RefusesGeoJsonWithThePointer) {
  expect_refused({
      {geojson("Polygon", ""), "/coordinates", "missing"},
      {geojson("Polygon", R"("coordinates":[[[0,0],[1,1],[1,0],[0,1],[0,0]]])"), "/coordinates/0/2",
       "crosses"},
      {geojson("Polygon", R"("coordinates":[[[0,0,5],[1,1],[1,0]]])"), "/coordinates/0/0/2", "plane"},
      {geojson("MultiPolygon", R"("coordinates":[])"), "/coordinates", "0 polygons"},
      {geojson("MultiPolygon", R"("coordinates":[[[[0,0],[1,0],[1,1]]],[[[5,0],[6,0],[6,1]]]])"),
       "/coordinates", "2 polygons"},
      {geojson("MultiPolygon", R"("coordinates":[[[[0,0],[1,0],[1,0],[1,1]]]])"), "/coordinates/0/0/2",
       "repeats"},
      {geojson("Point", R"("coordinates":[0,0])"), "/type", "a Point is no polygon"},
      {geojson("GeometryCollection", R"("geometries":[])"), "/type", "is no polygon"},
      {geojson("Feature", R"("geometry":null)"), "/geometry", "null"},
      {geojson("Feature", R"("geometry":{"type":"Feature","geometry":{}})"), "/geometry/type",
       "a Feature is no geometry"},
      {geojson("Feature", R"("geometry":{"type":"LineString","coordinates":[]})"), "/geometry/type",
       "a LineString"},
      {geojson("Feature", R"("geometry":{"type":"Polygon","coordinates":[[[0,0],[1,1]]]})"),
       "/geometry/coordinates/0", "at least 3"},
      {geojson("FeatureCollection", R"("features":[])"), "/features", "0 features"},
      {geojson("FeatureCollection", R"("features":[7])"), "/features/0", "Feature"},
      {geojson("FeatureCollection", R"("features":[{},{}])"), "/features", "2 features"},
      {geojson(
           "FeatureCollection",
           R"("features":[{"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[2,0]]]}}])"),
       "/features/0/geometry/coordinates/0", "no area"},
      {R"({"type":"polygon","geojson":7})", "/geojson", "the number 7"},
      {R"({"type":"polygon","geojson":{"type":"polygon"}})", "/geojson/type", "GeoJSON's types"},
      {R"({"type":"polygon","geojson":)" + geojson("Polygon", R"("coordinates":[[[0,0],[1,0],[2,0]]])") + "}",
       "/geojson/coordinates/0", "no area"},
  });
}

TEST(PolygonDomain, RefusesWktWithTheCharacterAndTheVertex) {
  expect_refused({
      {wkt(""), "/wkt", "empty"},
      {wkt("POINT (1 2)"), "/wkt", "found 'POINT'"},
      {wkt("SRID=4326;POLYGON((0 0,1 0,1 1))"), "/wkt", "SRID"},
      {wkt("POLYGON EMPTY"), "/wkt", "empty"},
      {wkt("POLYGON Z ((0 0 1,1 0 1,1 1 1))"), "/wkt", "without Z"},
      {wkt("POLYGONM ((0 0 1,1 0 1,1 1 1))"), "/wkt", "without M"},
      {wkt("MULTIPOLYGON ZM (((0 0 1,1 0 1,1 1 1)))"), "/wkt", "without ZM"},
      {wkt("POLYGON ((0 0, 1 0 5, 1 1))"), "/wkt", "at character 20 ('5, 1 1))'), in ring 0, vertex 1"},
      {wkt("POLYGON ((0 0, 1 0, 1 1)"), "/wkt", "expected ',' or ')' after a ring, at character 25"},
      {wkt("POLYGON (0 0, 1 0, 1 1)"), "/wkt", "expected '(' before a vertex, at character 10"},
      {wkt("POLYGON ((0 0, 1, 1 1))"), "/wkt", "expected a number"},
      {wkt("POLYGON ((0 0, 1 1e999, 1 1))"), "/wkt", "range of a double"},
      {wkt("POLYGON ((0 0, 1 0, 1 1)) x"), "/wkt", "nothing after the polygon"},
      {wkt("MULTIPOLYGON (((0 0, 1 0, 1 1)), ((5 0, 6 0, 6 1)))"), "/wkt", "several polygons"},
      {wkt("POLYGON ((0 0, 1 0, nan 1))"), "/wkt", "ring 0, vertex 2: a coordinate"},
      {wkt("POLYGON ((0 0, 1 1, 1 0, 0 1))"), "/wkt", "ring 0, vertex 2: edge 2 crosses edge 0"},
      {wkt("POLYGON ((0 0, 1 0, 1 1), (5 5, 6 5, 6 6))"), "/wkt", "ring 1: the hole is outside"},
      {R"({"type":"polygon","wkt":7})", "/wkt", "expected a string"},
  });
}

TEST(PolygonDomain, IsWrittenSoThatItReadsBackAsTheSameBits) {
  for (const auto& [name, rings] : many_polygons()) {
    SCOPED_TRACE(name);
    const Polygon polygon(rings);
    const std::string text = domain_to_json(polygon).dump();
    const auto again = polygon_of(text);
    EXPECT_EQ(domain_to_json(*again).dump(), text);
    const Rings before = polygon.rings(), after = again->rings();
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t k = 0; k < before.size(); ++k) {
      ASSERT_EQ(before[k].size(), after[k].size());
      for (std::size_t i = 0; i < before[k].size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(before[k][i].x), std::bit_cast<std::uint64_t>(after[k][i].x));
        ASSERT_EQ(std::bit_cast<std::uint64_t>(before[k][i].y), std::bit_cast<std::uint64_t>(after[k][i].y));
      }
    }
  }
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorCode::internal, "can't read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The area as the pieces have it, which are made on a way of their own.
double area_by_pieces(const Polygon& polygon) {
  ChartPieces pieces;
  const Box box = polygon.box();
  polygon.pieces(box.low, 2 * norm(box.size), pieces);
  return area_of_pieces(pieces);
}

TEST(PolygonDomain, TakesSouthAfricaWithLesothoLeftOut) {
  const auto polygon =
      polygon_of(contents(std::string(WELLSPACED_TEST_DATA) + "/polygons/naturalearth_South_Africa.geojson"));
  EXPECT_EQ(polygon->euler_characteristic(), 0);
  EXPECT_NEAR(polygon->area(), area_of(polygon->rings()), 1e-12 * polygon->area());
  EXPECT_NEAR(polygon->area(), area_by_pieces(*polygon), 1e-12 * polygon->area());
  EXPECT_FALSE(polygon->why_outside({26.05, -26.2, 0}));  // west of Johannesburg
  EXPECT_TRUE(polygon->why_outside({28.2, -29.5, 0}));    // Lesotho
  EXPECT_TRUE(polygon->why_outside({31.4, -26.5, 0}));    // Eswatini
  EXPECT_FALSE(polygon->smallest_feature().description.empty());
}

/// Until generators and optimizers are ready for it.
class SharedPolygons : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* shared = std::getenv("WELLSPACED_DATA_DIR");
    if (shared == nullptr) GTEST_SKIP() << "WELLSPACED_DATA_DIR is not set";
    folder_ = shared;
  }
  std::string file(const std::string& name) const { return contents(folder_ / name); }
  std::filesystem::path folder_;
};

/// {name, rings, vertices, valid, area}
TEST_F(SharedPolygons, HaveTheAreasThatOthersFound) {
  std::istringstream table(file("expected/polygons.csv"));
  int found = 0;
  for (std::string line; std::getline(table, line);) {
    std::istringstream cells(line);
    std::string name, rings, vertices, valid, area;
    for (std::string* cell : {&name, &rings, &vertices, &valid, &area}) std::getline(cells, *cell, ',');
    const std::string path = "polygons/" + name.substr(name.find('/') + 1);
    if (valid != "true" || !std::filesystem::exists(folder_ / path)) continue;
    SCOPED_TRACE(name);
    const auto polygon = polygon_of(R"({"type":"polygon","rings":)" + file(path) + "}");
    EXPECT_EQ(polygon->rings().size(), std::stoul(rings));
    EXPECT_NEAR(polygon->area() / std::stod(area), 1, 1e-5);
    EXPECT_NEAR(polygon->area(), area_by_pieces(*polygon), 1e-12 * polygon->area());
    ++found;
  }
  EXPECT_EQ(found, 4);
}

TEST_F(SharedPolygons, HaveTheAreasThatTheirAuthorFound) {
  for (const std::string name : {"eberly-14", "held-3", "mei-4"}) {
    const auto polygon =
        polygon_of(R"({"type":"polygon","rings":)" + file("polygons/" + name + ".json") + "}");
    const json meta = json::parse(file("polygons/" + name + ".meta.json"));
    EXPECT_NEAR(polygon->area(), meta["area"].get<double>(), 1e-9 * polygon->area()) << name;
    EXPECT_EQ(polygon->box().low.x, meta["bounds"][0].get<double>());
    EXPECT_EQ(polygon->box().low.y, meta["bounds"][1].get<double>());
  }
}

TEST_F(SharedPolygons, ThatAreIslandsAreTaken) {
  const auto polygon = polygon_of(file("polygons/cdt_island.geojson"));
  EXPECT_NEAR(polygon->area(), area_of(polygon->rings()), 1e-12);
}

TEST_F(SharedPolygons, ThatAreInvalidAreRefusedWithTheRing) {
  expect_refused({
      {polygon(file("polygons_reject/hourglass.json")), "/rings/0/4", "touches vertex 1"},
      {polygon(file("polygons_reject/bad-hole.json")), "/rings/0/18", "leave it out"},
  });
  // Its rings are closed twice; put right, the holes are wrong still.
  json rings = json::parse(file("polygons_reject/bad-hole.json"));
  for (json& ring : rings) ring.erase(ring.size() - 1);
  expect_refused({{polygon(rings.dump()), "/rings/1/8", "goes back on itself"}});
}

}  // namespace
}  // namespace wellspaced
