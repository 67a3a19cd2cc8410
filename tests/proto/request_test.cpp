#include "proto/request.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "proto/formats/npy.h"
#include "tests/support/refusals.h"

namespace wellspaced {
namespace {

using ::testing::ElementsAre;
using testing::expect_refusal;
using testing::expect_refusals;
using ::testing::HasSubstr;
using testing::invalid;
using testing::Query;
using testing::read;
using testing::read_table;
using testing::Refusal;

TEST(ReadRequest, RefusesUnknownNamesAndListsTheKnownOnes) {
  expect_refusals({
      {"generate", R"({"count":10,"metod":"square"})", invalid, "/metod",
       "known here are: allow_small_features, barycentric, count, criterion, domain, method"},
      {"generate", R"({"cuont":10})", invalid, "/cuont", "count"},
      {"generate", R"({"method":"dart","count":10})", invalid, "/method",
       "poisson-disk, two-radii, white-noise, jittered"},
      {"generate", R"({"method":"white-noise","radius":0.1})", invalid, "/radius",
       "known here are: barycentric, count"},
      {"generate", R"({"count":10,"domain":{"type":"klein bottle"}})", invalid, "/domain/type", "torus"},
      {"generate", R"({"count":10,"domain":{"depth":1}})", invalid, "/domain/depth",
       "height, periodic, type, width"},
      {"generate", R"({"count":10,"picture":"photo"})", invalid, "/picture", "voronoi, delaunay, points"},
      {"generate", R"({"count":10,"picture":{"name":"voronoi","colour":"area"}})", invalid, "/picture/colour",
       "color, name, scale"},
      {"generate", R"({"count":10,"picture":{"name":"photo"}})", invalid, "/picture/name", "voronoi"},
      {"generate", R"({"count":10,"picture":{"name":"voronoi","scale":9}})", invalid, "/picture/scale",
       "[0.25, 4]"},
      {"optimize", R"({"points":{"generate":{"count":10}},"betta":0.8})", invalid, "/betta", "beta"},
      {"optimize", R"({"points":{"generate":{"count":10}},"method":"magic"})", invalid, "/method",
       "opt-beta-local"},
      {"optimize", R"({"points":{"generate":{"count":10,"method":"x"}}})", invalid, "/points/generate/method",
       "square"},
      {"optimize", R"({"points":{"generate":{"count":10,"beta":1}}})", invalid, "/points/generate/beta",
       "count"},
      {"optimize", R"({"points":{"generate":{"count":10},"a/b~":1}})", invalid, "/points/a~1b~0", "generate"},
      {"analyze", R"({"points":{"generate":{"count":10}},"method":"spacing"})", invalid, "/method",
       "measures"},
      {"analyze", R"({"points":{"generate":{"count":10}},"measures":["spacing","taste"]})", invalid,
       "/measures/1", "spacing"},
  });
}

TEST(ReadRequest, RefusesWrongTypesAndSaysWhatWasFound) {
  expect_refusals({
      {"generate", "[]", invalid, "", "expected an object, found an array"},
      {"generate", "null", invalid, "", "found null"},
      {"generate", R"({"count":"10"})", invalid, "/count", "expected a whole number, found a string"},
      {"generate", R"({"count":[10]})", invalid, "/count", "found an array"},
      {"generate", R"({"count":true})", invalid, "/count", "found true"},
      {"generate", R"({"radius":{}})", invalid, "/radius", "expected a number, found an object"},
      {"generate", R"({"count":10,"method":5})", invalid, "/method", "expected a string, found the number 5"},
      {"generate", R"({"count":10,"seed":"1"})", invalid, "/seed", "found a string"},
      {"generate", R"({"count":10,"seed":-1})", invalid, "/seed", "from 0 to 2^64 - 1, found the number -1"},
      {"generate", R"({"count":10,"seed":0.5})", invalid, "/seed", "found the number 0.5"},
      {"generate", R"({"count":10,"seed":18446744073709551616})", invalid, "/seed", "whole number"},
      {"generate", R"({"count":10,"domain":"torus"})", invalid, "/domain",
       "expected an object, found a string"},
      {"generate", R"({"count":10,"domain":{"width":"1"}})", invalid, "/domain/width", "found a string"},
      {"generate", R"({"count":10,"picture":1})", invalid, "/picture", "expected a string"},
      {"optimize", R"({"points":5})", invalid, "/points", "expected an object, found the number 5"},
      {"optimize", R"({"points":{"generate":[]}})", invalid, "/points/generate", "found an array"},
      {"optimize", R"({"points":{"job":7}})", invalid, "/points/job", "expected a string"},
      {"optimize", R"({"points":{"points":7}})", invalid, "/points/points", "expected an array of points"},
      {"optimize", R"({"points":{"generate":{"count":10}},"beta":"0.8"})", invalid, "/beta",
       "found a string"},
      {"analyze", R"({"points":{"generate":{"count":10}},"measures":"spacing"})", invalid, "/measures",
       "expected an array"},
      {"analyze", R"({"points":{"generate":{"count":10}},"measures":[]})", invalid, "/measures",
       "one or more"},
      {"analyze", R"({"points":{"generate":{"count":10}},"measures":[1]})", invalid, "/measures/0",
       "expected a string"},
      {"analyze", R"({"points":{"generate":{"count":10}},"measures":["spacing","spacing"]})", invalid,
       "/measures/1", "twice"},
  });
}

TEST(ReadRequest, RefusesCountsOutsideTheirRange) {
  expect_refusals({
      {"generate", R"({"count":0})", invalid, "/count", "must be a whole number of at least 1; found 0"},
      {"generate", R"({"count":-3})", invalid, "/count", "of at least 1; found -3"},
      {"generate", R"({"count":2.5})", invalid, "/count", "whole number of at least 1; found 2.5"},
      {"generate", R"({"count":1e300})", invalid, "/count", "up to 1000000000000000; found 1e+300"},
      {"generate", R"({"count":10000001})", ErrorCode::too_large, "/count",
       "10000001 points are asked for, but the limit here is 10000000"},
      {"generate", R"({"method":"hexagonal","count":101})", ErrorCode::infeasible, "/count", "100 or 102"},
      {"generate", R"({"method":"two-radii","count":10,"beta":1})", invalid, "/beta", "in (1, 2]"},
      {"generate", R"({"method":"two-radii","count":10,"beta":2.1})", invalid, "/beta", "in (1, 2]"},
      {"generate", R"({"method":"two-radii","radius":0.8})", ErrorCode::infeasible, "/radius", "0.707"},
      {"generate", R"({"method":"delaunay-refinement","radius":0.8})", ErrorCode::infeasible, "/radius",
       "0.707"},
      {"generate", R"({"method":"square","count":20000000})", ErrorCode::too_large, "/count",
       "about 20000000 points"},
      {"generate", R"({"radius":1e-5})", ErrorCode::too_large, "/radius", "6966000000 points"},
      {"generate", R"({"radius":1e-300})", ErrorCode::too_large, "/radius", "Countless points"},
      {"optimize", R"({"points":{"generate":{"count":10000001}}})", ErrorCode::too_large,
       "/points/generate/count", "limit"},
      {"analyze", R"({"points":{"generate":{"radius":1e-5}}})", ErrorCode::too_large,
       "/points/generate/radius", "limit"},
      {"generate", "{}", invalid, "/count", "give count or radius"},
      {"generate", R"({"method":"square"})", invalid, "/count", "the field is missing"},
      {"generate", R"({"count":null})", invalid, "/count", "give count or radius"},
      {"generate", R"({"count":10,"radius":0.1})", invalid, "/radius", "not both"},
      {"optimize", R"({"points":{"generate":{}}})", invalid, "/points/generate/count",
       "give count or radius"},
      {"optimize", R"({"points":{"generate":{"count":10,"radius":0.1}}})", invalid, "/points/generate/radius",
       "not both"},
  });
}

TEST(ReadRequest, RefusesLengthsThatNoTorusHas) {
  expect_refusals({
      {"generate", R"({"radius":0})", invalid, "/radius", "greater than 0"},
      {"generate", R"({"radius":-0.1})", invalid, "/radius", "greater than 0; found -0.1"},
      {"generate", R"({"radius":0.8})", ErrorCode::infeasible, "/radius", "choose a smaller one"},
      {"optimize", R"({"points":{"generate":{"radius":0.8}}})", ErrorCode::infeasible,
       "/points/generate/radius", "smaller"},
      {"generate", R"({"count":10,"domain":{"width":0}})", invalid, "/domain/width", "from 1e-6 to 1e6"},
      {"generate", R"({"count":10,"domain":{"height":-1}})", invalid, "/domain/height", "from 1e-6 to 1e6"},
      {"generate", R"({"count":10,"domain":{"width":1e7}})", invalid, "/domain/width", "from 1e-6 to 1e6"},
      {"generate", R"({"count":10,"domain":{"width":2000}})", invalid, "/domain/width", "less elongated"},
      {"analyze", R"({"points":[[0,0],[0.5,0],[0,0.5]],"domain":{"width":0}})", invalid, "/domain/width",
       "side"},
      {"analyze", R"({"points":{"points":[[0,0],[0.5,0],[0,0.5]],"domain":{"width":0}}})", invalid,
       "/points/domain/width", "side"},
  });
}

TEST(ReadRequest, RefusesOptimizerParametersOutsideTheirRange) {
  const auto with = [](const std::string& field) {
    return R"({"points":{"generate":{"count":10}},)" + field + "}";
  };
  expect_refusals({
      {"optimize", with(R"("beta":0.577)"), ErrorCode::infeasible, "/beta", "below 1/sqrt(3)"},
      {"optimize", with(R"("beta":0)"), ErrorCode::infeasible, "/beta", "found 0"},
      {"optimize", with(R"("beta":-1)"), ErrorCode::infeasible, "/beta", "triangular lattice"},
      {"optimize", with(R"("method":"push-pull","rho":1.01)"), ErrorCode::infeasible, "/rho",
       "at most 1; found 1.01"},
      {"optimize", with(R"("method":"push-pull","coverage":0.5)"), ErrorCode::infeasible, "/coverage",
       "at least 0.57735; found 0.5"},
      {"optimize", with(R"("beta":1)"), invalid, "/beta", "must be a number in [0.577"},
      {"optimize", with(R"("beta":7.5)"), invalid, "/beta", "1); found 7.5"},
      {"optimize", with(R"("method":"opt-beta-local","max_sweeps":0)"), invalid, "/max_sweeps",
       "in [1, 10000]"},
      {"optimize", with(R"("method":"opt-beta-local","max_sweeps":10001)"), invalid, "/max_sweeps",
       "in [1, 10000]"},
      {"optimize", with(R"("method":"opt-beta-local","max_sweeps":1.5)"), invalid, "/max_sweeps",
       "whole number"},
      {"optimize", with(R"("method":"opt-beta-local","damping":0)"), invalid, "/damping", "in (0, 1]"},
      {"optimize", with(R"("method":"opt-beta-local","damping":1.01)"), invalid, "/damping",
       "in (0, 1]; found 1.01"},
      {"optimize", with(R"("method":"opt-beta","randomness":"wild")"), invalid, "/randomness",
       "must be one of gentle, fast; found another word"},
      {"optimize", with(R"("method":"opt-beta","randomness":1)"), invalid, "/randomness",
       "found the number 1"},
      {"optimize", with(R"("method":"opt-beta","max_visits":0)"), invalid, "/max_visits", "in [1, 1000000]"},
      {"optimize", with(R"("method":"opt-beta","damping":0.5)"), invalid, "/damping", "max_visits"},
  });
}

TEST(ReadRequest, RefusesInlinePointsThatNoMethodCanWorkWith) {
  for (const char* operation : {"optimize", "analyze"})
    expect_refusals({
        {operation, "{}", invalid, "/points", "the field is missing"},
        {operation, R"({"points":null})", invalid, "/points", "the field is missing"},
        {operation, R"({"points":[]})", ErrorCode::degenerate_input, "/points",
         "at least 3 points are needed; the point set has 0"},
        {operation, R"({"points":[[0,0],[0.5,0.5]]})", ErrorCode::degenerate_input, "/points",
         "at least 3 points are needed; the point set has 2"},
        {operation, R"({"points":{"points":[[0,0]]}})", ErrorCode::degenerate_input, "/points/points",
         "at least 3"},
        {operation, R"({"points":{"generate":{"count":2}}})", ErrorCode::degenerate_input,
         "/points/generate/count", "at least 3"},
        {operation, R"({"points":[[0,0],[0.5,1],[0.2,0.2]]})", invalid, "/points/1", "outside"},
        {operation, R"({"points":[[0,0],[0.5,0.5],[-0.1,0.2]]})", invalid, "/points/2", "outside"},
        {operation, R"({"points":{"points":[[0,0],[2,0.5],[0.1,0.2]]}})", invalid, "/points/points/1",
         "outside"},
        {operation, R"({"points":[[0,0],[0.5,0.5],[0,0]]})", ErrorCode::degenerate_input, "/points/2",
         "repeats point 0"},
        {operation, R"({"points":[[0,0,0],[0.5,0.5,0],[0,0.5,0]]})", invalid, "/points",
         "have 2 coordinates; these have 3"},
        {operation, R"({"points":[[0,0],[0.5],[0,0.5]]})", invalid, "/points/1", ""},
        {operation, R"({"points":[[0,0],["a",0],[0,0.5]]})", invalid, "/points/1/0", ""},
        {operation, R"({"points":[[0,0],[1e999,0],[0,0.5]]})", invalid, "/points/1/0", ""},
        {operation, R"({"points":[[0,0],[NaN,0],[0,0.5]]})", ErrorCode::malformed_request, "", "line 1"},
    });
}

TEST(ReadRequest, RefusesPointsFromNoneOrSeveralSources) {
  expect_refusals({
      {"analyze", R"({"points":{}})", invalid, "/points", "exactly one of generate, optimize, job or points"},
      {"analyze", R"({"points":{"job":"known","generate":{"count":10}}})", invalid, "/points", "exactly one"},
      {"analyze", R"({"points":{"job":"known","domain":{}}})", invalid, "/points/domain", "unknown field"},
      {"analyze", R"({"points":{"job":"gone"}})", ErrorCode::no_such_job, "/points/job", "no such job"},
      {"analyze", R"({"points":{"generate":{"count":10}},"domain":{}})", invalid, "/domain",
       "bring their own domain"},
      {"analyze", R"({"points":{"job":"known"},"domain":{}})", invalid, "/domain", "bring their own domain"},
      {"generate", R"({"count":10,"points":[[0,0],[0.5,0.5],[0.1,0.1]]})", invalid, "/points",
       "unknown field"},
  });
}

TEST(ReadRequest, RefusesPointsAboveTheLimitWhereverTheyComeFrom) {
  Limits limits;
  limits.analyze_points = 3;
  limits.generate_points = 2;
  const std::string csv = "0,0\n0.5,0\n0,0.5\n0.5,0.5\n";
  expect_refusal([&] { read("analyze", R"({"points":[[0,0],[0.5,0],[0,0.5],[0.5,0.5]]})", limits); },
                 {"analyze", "inline", ErrorCode::too_large, "/points", "limit"});
  expect_refusal([&] { read_table("analyze", "text/csv", csv, {}, limits); },
                 {"analyze", "csv", ErrorCode::too_large, "/points", "limit"});
  expect_refusal([&] { read("generate", R"({"count":3})", limits); },
                 {"generate", "count", ErrorCode::too_large, "/count", "limit here is 2"});
  EXPECT_NO_THROW(read("analyze", R"({"points":{"generate":{"count":3}}})", limits));
  EXPECT_NO_THROW(read("generate", R"({"count":2})", limits));
}

TEST(ReadRequest, RefusesJobsThatNeedMoreMemoryThanTheLimit) {
  Limits limits;
  limits.memory_bytes = 100 << 20;
  EXPECT_NO_THROW(read("generate", R"({"count":10000})", limits));
  expect_refusal(
      [&] { read("generate", R"({"count":5000000})", limits); },
      {"generate", "5M", ErrorCode::too_large, "/count", "the limit here is 100 MiB; ask for fewer points"});
  expect_refusal([&] { read("optimize", R"({"points":{"generate":{"radius":0.0005}}})", limits); },
                 {"optimize", "2.8M", ErrorCode::too_large, "/points",
                  "the limit here is 100 MiB; ask for fewer points"});
}

TEST(ReadRequest, RefusesBodiesItCantReadAndNamesTheWayOut) {
  expect_refusals({
      {"generate", "", ErrorCode::malformed_request, "", "line 1"},
      {"generate", "{\"count\":10", ErrorCode::malformed_request, "", ""},
      {"generate", "count=10", ErrorCode::malformed_request, "", ""},
      {"generate", "{\"count\":10,\"count\":11}", invalid, "/count", ""},
  });
  const auto typed = [](const char* type) { return [type] { read_table("analyze", type, "0,0\n"); }; };
  const Refusal unsupported{"analyze", "", ErrorCode::unsupported_media_type, "", "send application/json"};
  for (const char* type : {"", "application/x-www-form-urlencoded", "image/svg+xml", "text/plain", "json"})
    expect_refusal(typed(type), unsupported);
  expect_refusal([] { read_table("generate", "text/csv", "0,0\n"); },
                 {"generate", "csv", ErrorCode::unsupported_media_type, "", "generate takes no points"});
}

TEST(ReadRequest, RefusesParametersInTheQueryOfAJsonRequest) {
  const auto action = [] { read_table("generate", "application/json", R"({"count":10})", {{"seed", "1"}}); };
  expect_refusal(action, {"generate", "query", invalid, "/seed", "parameters go into the body"});
}

std::string npy(std::vector<double> values, std::size_t columns = 2) {
  return write_npy(values.data(), values.size() / columns, columns);
}

TEST(ReadRequest, RefusesTablesThatNoMethodCanWorkWith) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  struct {
    const char* type;
    std::string body;
    ErrorCode code;
    const char *where, *part;
  } const tables[] = {
      {"text/csv", "0,0\nnan,0.5\n0.5,0\n", invalid, "/points/1/0", "NaN"},
      {"text/csv", "0,0\n0.5,inf\n0.5,0\n", invalid, "/points/1/1", "infinite"},
      {"text/csv", "0,0\n0.5,x\n", invalid, "/points/1/1", "line 2"},
      {"text/csv", "0,0\n1.5,0\n0.5,0\n", invalid, "/points/1", "outside"},
      {"text/csv", "0,0\n0.5,0\n0.5,0\n", ErrorCode::degenerate_input, "/points/2", "repeats point 1"},
      {"text/csv", "0,0\n0.5,0\n", ErrorCode::degenerate_input, "/points", "at least 3"},
      {"text/csv", "", ErrorCode::degenerate_input, "/points", "at least 3"},
      {"text/csv", "0,0,0\n0.5,0,0\n0,0.5,0\n", invalid, "/points", "have 2 coordinates; these have 3"},
      {"text/csv", "1\n2\n3\n", invalid, "/points/0", ""},
      {"application/x-npy", npy({0, 0, nan, 0.5, 0.5, 0}), invalid, "/points/1/0", "NaN"},
      {"application/x-npy", npy({0, 0, 0.5, -inf, 0.5, 0}), invalid, "/points/1/1", "infinite"},
      {"application/x-npy", npy({0, 0, 0.5, 1, 0.5, 0}), invalid, "/points/1", "outside"},
      {"application/x-npy", npy({0, 0, 0.5, 0, 0, 0}), ErrorCode::degenerate_input, "/points/2",
       "repeats point 0"},
      {"application/x-npy", npy({0, 0, 0.5, 0}), ErrorCode::degenerate_input, "/points", "at least 3"},
      {"application/x-npy", npy({0, 0, 0, 0.5, 0, 0, 0, 0.5, 0}, 3), invalid, "/points", "these have 3"},
      {"application/x-npy", npy({0, 0, 0.5, 0, 0, 0.5}).substr(0, 150), ErrorCode::malformed_request,
       "/points", "truncated"},
      {"application/x-npy", "0,0\n", ErrorCode::malformed_request, "/points", "np.save"},
  };
  for (const auto& t : tables)
    expect_refusal([&] { read_table("analyze", t.type, t.body); },
                   {"analyze", t.body, t.code, t.where, t.part});
}

TEST(ReadRequest, RefusesQueriesThatTheirFieldsDontAllow) {
  struct {
    Query query;
    const char *where, *part;
  } const queries[] = {
      {{{"beta", "high"}}, "/beta", "expected a number, found a string"},
      {{{"beta", "0.8"}, {"beta", "0.9"}}, "/beta", "twice"},
      {{{"domain.width", "2"}, {"domain.width", "2"}}, "/domain/width", "twice"},
      {{{"domain.width", "2"}, {"domain", "torus"}}, "/domain", "twice"},
      {{{"domain", "torus"}, {"domain.width", "2"}}, "/domain/width", "twice"},
      {{{"domain", "torus"}}, "/domain", "expected an object"},
      {{{"domain.depth", "2"}}, "/domain/depth", "known here are: height, periodic, type, width"},
      {{{"domain.width", "0"}}, "/domain/width", "side"},
      {{{"domain.width", ""}}, "/domain/width", "found a string"},
      {{{"points", "[[0,0]]"}}, "/points", "the points are the body"},
      {{{"points.generate.count", "9"}}, "/points", "the points are the body"},
      {{{"gamma", "2"}}, "/gamma", "known here are: barycentric, beta"},
      {{{"", "2"}}, "/", "unknown field"},
      {{{".", "2"}}, "/", "unknown field"},
      {{{"method", "magic"}}, "/method", "opt-beta-local"},
      {{{"beta", "1e999"}}, "/beta", "expected a number"},
      {{{"beta", "[0.8]"}}, "/beta", "found a string"},
  };
  for (const auto& q : queries)
    expect_refusal([&] { read_table("optimize", "text/csv", "0,0\n0.5,0\n0,0.5\n", q.query); },
                   {"optimize", ::testing::PrintToString(q.query), invalid, q.where, q.part});
}

const GenerateRequest& generate_of(const Request& request) {
  return std::get<GenerateRequest>(request.operation);
}

const AnalyzeRequest& analyze_of(const Request& request) {
  return std::get<AnalyzeRequest>(request.operation);
}

const PointSet& only_points(const Request& request) {
  return std::get<PointSet>(analyze_of(request).groups.at(0).sets.at(0).from);
}

TEST(ReadRequest, FillsInTheDefaults) {
  const Request request = read("generate", R"({"count":1e3})");
  const GenerateRequest& generate = generate_of(request);
  EXPECT_EQ(generate.method->name, "poisson-disk");
  EXPECT_EQ(generate.seed, 0u);
  EXPECT_EQ(generate.domain->area(), 1);
  EXPECT_THAT(generate.arguments, ElementsAre(std::pair<const std::string, double>("count", 1000)));
  EXPECT_TRUE(request.picture.is_null());
  const auto optimize = read("optimize", R"({"points":{"generate":{"count":10}}})");
  EXPECT_EQ(std::get<OptimizeRequest>(optimize.operation).method->name, "opt-beta");
  EXPECT_TRUE(std::get<OptimizeRequest>(optimize.operation).arguments.empty());
  const auto analyze = read("analyze", R"({"points":{"generate":{"count":10}}})");
  ASSERT_EQ(std::get<AnalyzeRequest>(analyze.operation).measures.size(), 1u);
  EXPECT_EQ(std::get<AnalyzeRequest>(analyze.operation).measures[0].measure->name, "spacing");
}

TEST(ReadRequest, ReadsSeedsOf64Bits) {
  EXPECT_EQ(generate_of(read("generate", R"({"count":9,"seed":18446744073709551615})")).seed,
            18446744073709551615u);
  EXPECT_EQ(generate_of(read("generate", R"({"count":9,"seed":4e9})")).seed, 4000000000u);
  EXPECT_EQ(generate_of(read("generate", R"({"count":9,"seed":-0})")).seed, 0u);
}

TEST(ReadRequest, ReadsTheSamePointsFromEveryFormat) {
  const std::vector<double> values = {0, 0, 1.5, 0.25, 0.1, 0.5};
  const Query query = {{"domain.width", "2"}, {"domain.type", "torus"}, {"measures", "spacing"}};
  const Request requests[] = {
      read("analyze",
           R"({"points":[[0,0],[1.5,0.25],[0.1,0.5]],"domain":{"width":2},"measures":["spacing"]})"),
      read("analyze", R"({"points":{"points":[[0,0],[1.5,0.25],[0.1,0.5]],"domain":{"width":2}}})"),
      read_table("analyze", "application/x-npy", npy(values), query),
      read_table("analyze", "Text/CSV; charset=utf-8", "x,y\n0,0\n1.5,0.25\n0.1,0.5\n", query),
  };
  for (const Request& request : requests) {
    const auto& points = only_points(request);
    EXPECT_EQ(points.coordinates, values);
    EXPECT_EQ(points.domain->box().size.x, 2);
    EXPECT_EQ(expected_points(request), 3);
  }
}

TEST(ReadRequest, TakesEnrichFromJsonAndFromTheQuery) {
  const auto enrich = [](const Request& request) {
    return std::get<OptimizeRequest>(request.operation).enrich;
  };
  const std::string points = R"({"points":[[0,0],[0.5,0.25],[0.1,0.5]])";
  EXPECT_TRUE(enrich(read("optimize", points + R"(,"enrich":true})")));
  EXPECT_FALSE(enrich(read("optimize", points + R"(,"enrich":false})")));
  EXPECT_FALSE(enrich(read("optimize", points + "}")));
  const std::string csv = "0,0\n0.5,0.25\n0.1,0.5\n";
  EXPECT_TRUE(enrich(read_table("optimize", "text/csv", csv, {{"enrich", "true"}})));
  EXPECT_FALSE(enrich(read_table("optimize", "text/csv", csv, {{"enrich", "false"}})));
  expect_refusal(
      [&] {
        read_table("optimize", "text/csv", csv, {{"enrich", "yes"}});
      },
      {"optimize", "enrich=yes", invalid, "/enrich", "true or false"});
  expect_refusals({{"optimize", points + R"(,"enrich":1})", invalid, "/enrich",
                    "expected true or false, found the number 1"}});
}

TEST(ReadRequest, RefusesToEnrichWhereTheLimitMayBePassed) {
  const auto enriching = [](int count) {
    return R"({"points":{"generate":{"count":)" + std::to_string(count) +
           R"(}},"method":"opt-beta","max_visits":1,"enrich":true})";
  };
  EXPECT_NEAR(expected_points(read("optimize", enriching(10000))), 26576, 1);
  expect_refusals({{"optimize", enriching(4000000), ErrorCode::too_large, "/enrich", "leave enrich out"}});
  EXPECT_GT(
      expected_cost(read("optimize", enriching(10000))).bytes,
      2 * expected_cost(read("optimize", R"({"points":{"generate":{"count":10000}},"method":"opt-beta"})"))
              .bytes);
}

TEST(ReadRequest, TakesPointsAndDomainFromAJob) {
  const Request request = read("analyze", R"({"points":{"job":"known"}})");
  const auto& points = only_points(request);
  EXPECT_EQ(points.coordinates, testing::points_of_a_job().coordinates);
  EXPECT_EQ(points.domain->box().size.x, 2);
}

TEST(ExpectedCost, GrowsWithTheCountAndWithTheSweeps) {
  const auto seconds = [](const char* operation, const std::string& body) {
    return expected_cost(read(operation, body)).seconds;
  };
  const auto optimize = [&](int count, int sweeps) {
    return seconds("optimize", R"({"points":{"generate":{"count":)" + std::to_string(count) +
                                   R"(}},"method":"opt-beta-local","max_sweeps":)" + std::to_string(sweeps) +
                                   "}");
  };
  EXPECT_NEAR(optimize(100000, 100) / optimize(1000, 100), 100, 1e-6);
  EXPECT_GT(optimize(1000, 1000), 5 * optimize(1000, 100));
  EXPECT_GT(seconds("generate", R"({"radius":0.001})"), 50 * seconds("generate", R"({"radius":0.01})"));
  EXPECT_GT(seconds("analyze", R"({"points":{"generate":{"count":1000}}})"),
            seconds("generate", R"({"count":1000})"));
  EXPECT_LT(optimize(10000, 100), Limits{}.sync_seconds);  // the README's example is answered at once
  EXPECT_GT(optimize(1000000, 100), Limits{}.sync_seconds);
}

}  // namespace
}  // namespace wellspaced
