#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/domain/box_domain.h"
#include "proto/request.h"
#include "tests/support/refusals.h"

namespace wellspaced {
namespace {

using ::testing::ElementsAre;
using testing::expect_refusal;
using testing::expect_refusals;
using testing::invalid;
using testing::read;
using testing::read_table;

const AnalyzeRequest& analyze_of(const Request& request) {
  return std::get<AnalyzeRequest>(request.operation);
}

std::vector<std::uint64_t> seeds_of(const SourceGroup& group) {
  std::vector<std::uint64_t> seeds;
  for (const PointSource& source : group.sets) {
    const auto* generate = std::get_if<GenerateRequest>(&source.from);
    if (generate == nullptr)
      generate = &std::get<GenerateRequest>(
          std::get<std::shared_ptr<const OptimizeRequest>>(source.from)->points.from);
    seeds.push_back(generate->seed);
  }
  return seeds;
}

TEST(ReadRequest, TakesSeveralSeedsOfOneSource) {
  const Request generated = read("analyze", R"({"points":{"generate":{"count":10,"seed":7}},"seeds":3})");
  ASSERT_EQ(analyze_of(generated).groups.size(), 1u);
  EXPECT_THAT(seeds_of(analyze_of(generated).groups[0]), ElementsAre(7, 8, 9));
  const Request optimized =
      read("analyze", R"({"points":{"optimize":{"points":{"generate":{"count":10}},"beta":0.8}},"seeds":2})");
  EXPECT_THAT(seeds_of(analyze_of(optimized).groups[0]), ElementsAre(0, 1));
  EXPECT_EQ(expected_points(optimized), 10);
}

TEST(ReadRequest, TakesSetsFromAnySource) {
  const Request request =
      read("analyze",
           R"({"sets":[[[0,0],[1.5,0],[0,0.5]],{"points":[[0,0.1],[0.5,0],[0,0.5]],"domain":{"width":2}},
          {"job":"known"},{"generate":{"count":3,"domain":{"width":2}}},
          {"optimize":{"points":[[0,0.2],[1.5,0],[0,0.5]],"domain":{"width":2}}}],"domain":{"width":2}})");
  const SourceGroup& group = analyze_of(request).groups.at(0);
  ASSERT_EQ(group.sets.size(), 5u);
  EXPECT_EQ(std::get<PointSet>(group.sets[0].from).coordinates[2], 1.5);
  EXPECT_EQ(std::get<PointSet>(group.sets[1].from).coordinates[1], 0.1);
  EXPECT_EQ(std::get<PointSet>(group.sets[2].from).coordinates, testing::points_of_a_job().coordinates);
  const auto& optimize = *std::get<std::shared_ptr<const OptimizeRequest>>(group.sets[4].from);
  EXPECT_EQ(std::get<PointSet>(optimize.points.from).coordinates[1], 0.2);
  EXPECT_EQ(optimize.pointer, "/sets/4/optimize");
  EXPECT_EQ(optimize.points.pointer, "/sets/4/optimize/points");
}

TEST(ReadRequest, TakesGroupsToCompare) {
  const Request request =
      read("analyze", R"({"compare":[{"label":"a","points":{"generate":{"count":10}},"seeds":2},
                                {"sets":[[[0,0],[0.5,0],[0,0.5]]]}],"measures":["spacing","spectrum"]})");
  const AnalyzeRequest& analyze = analyze_of(request);
  EXPECT_TRUE(analyze.compares);
  ASSERT_EQ(analyze.groups.size(), 2u);
  EXPECT_EQ(analyze.groups[0].label, "a");
  EXPECT_EQ(analyze.groups[0].sets.size(), 2u);
  EXPECT_EQ(analyze.groups[1].label, "");
  EXPECT_EQ(analyze.groups[1].pointer, "/compare/1/sets");
}

TEST(ReadRequest, RefusesSetsThatCannotBeAveraged) {
  const std::string three = "[[0,0],[0.5,0],[0,0.5]]", four = "[[0,0],[0.5,0],[0,0.5],[0.5,0.5]]";
  const std::string generate = R"("points":{"generate":{"count":10}})";
  expect_refusals({
      {"analyze", "{\"sets\":[" + three + "," + four + "]}", invalid, "/sets/1",
       "this set has 4 points, the first one 3"},
      {"analyze", "{\"sets\":[" + three + ",{\"job\":\"known\"}]}", invalid, "/sets/1", "another domain"},
      {"analyze", R"({"sets":[]})", invalid, "/sets", "1 to 1000"},
      {"analyze", R"({"sets":{}})", invalid, "/sets", "array"},
      {"analyze", R"({"sets":[7]})", invalid, "/sets/0", "expected an object, found the number 7"},
      {"analyze", R"({"sets":[[[0,0],[0.5,0]]]})", ErrorCode::degenerate_input, "/sets/0", "at least 3"},
      {"analyze", R"({"sets":[[[0,0],[0.5,0],[2,0]]]})", invalid, "/sets/0/2", "outside"},
      {"analyze", R"({"sets":[{"generate":{"count":10,"kind":1}}]})", invalid, "/sets/0/generate/kind",
       "count"},
      {"analyze", R"({"sets":[{"generate":{"count":10}}],"domain":{}})", invalid, "/domain",
       "their own domain"},
      {"analyze", "{" + generate + R"(,"sets":[]})", invalid, "/points", "either sets, or points"},
      {"analyze", "{\"sets\":[" + three + R"(],"seeds":2})", invalid, "/seeds", "either sets, or points"},
      {"analyze", "{" + generate + R"(,"seeds":0})", invalid, "/seeds", "[1, 1000]"},
      {"analyze", "{" + generate + R"(,"seeds":1001})", invalid, "/seeds", "[1, 1000]"},
      {"analyze", "{\"points\":" + three + R"(,"seeds":2})", invalid, "/seeds", "only generated points"},
      {"analyze", R"({"points":{"generate":{"method":"square","count":9}},"seeds":2})", invalid, "/seeds",
       "square takes no seed"},
      {"analyze", R"({"points":{"generate":{"count":1000000}},"seeds":11})", ErrorCode::too_large, "/points",
       "about 11000000 points together"},
      {"optimize", "{" + generate + R"(,"seeds":2})", invalid, "/seeds", "unknown field"},
  });
}

TEST(ReadRequest, RefusesComparisonsThatAreNone) {
  const std::string one = R"({"points":{"generate":{"count":10}}})";
  std::string umlauts;
  for (int k = 0; k < 60; ++k) umlauts += "ü";
  EXPECT_NO_THROW(
      read("analyze", R"({"compare":[{"points":{"generate":{"count":10}},"label":")" + umlauts + "\"}]}"));
  expect_refusals({
      {"analyze", R"({"compare":[]})", invalid, "/compare", "1 to 16"},
      {"analyze", R"({"compare":[7]})", invalid, "/compare/0", "expected an object"},
      {"analyze", R"({"compare":[{}]})", invalid, "/compare/0/points", "missing"},
      {"analyze", "{\"compare\":[" + one + R"(],"points":[]})", invalid, "/points", "brings its own points"},
      {"analyze", "{\"compare\":[" + one + R"(],"seeds":2})", invalid, "/seeds", "brings its own points"},
      {"analyze", R"({"compare":[{"points":{"generate":{"count":10}},"name":"x"}]})", invalid,
       "/compare/0/name", "label"},
      {"analyze",
       R"({"compare":[{"points":{"generate":{"count":10}},"label":")" + std::string(61, 'x') + "\"}]}",
       invalid, "/compare/0/label", "60"},
  });
}

TEST(ReadRequest, ReadsParametersOfMeasures) {
  const Request json = read("analyze", R"({"points":{"generate":{"count":10}},
      "measures":["spacing",{"measure":"spectrum","range":2.5}]})");
  const Request table = read_table("analyze", "text/csv", "0,0\n0.5,0\n0,0.5\n",
                                   {{"measures", "spacing,spectrum"}, {"spectrum.range", "2.5"}});
  for (const Request* request : {&json, &table}) {
    const auto& calls = analyze_of(*request).measures;
    ASSERT_EQ(calls.size(), 2u);
    EXPECT_EQ(calls[1].measure->name, "spectrum");
    EXPECT_EQ(argument(calls[1].arguments, "range"), 2.5);
  }
  const std::string generate = R"({"points":{"generate":{"count":10}},"measures":[)";
  expect_refusals({
      {"analyze", generate + R"({"measure":"spectrum","range":0}]})", invalid, "/measures/0/range",
       "[0.1, 1000]"},
      {"analyze", generate + R"("spacing",{"measure":"spectrum","rnage":1}]})", invalid, "/measures/1/rnage",
       "measure, range"},
      {"analyze", generate + R"({"range":1}]})", invalid, "/measures/0/measure", "one of: spacing"},
      {"analyze", generate + R"({"measure":"taste"}]})", invalid, "/measures/0/measure", "unknown name"},
      {"analyze", generate + R"("spectrum",{"measure":"spectrum"}]})", invalid, "/measures/1", "twice"},
  });
  expect_refusal(
      [] {
        read_table("analyze", "text/csv", "0,0\n0.5,0\n0,0.5\n", {{"spectrum.range", "2.5"}});
      },
      {"analyze", "spectrum.range alone", invalid, "/spectrum", "add spectrum to measures"});
  const auto expect_refused_query = [](const Query& query, const char* where, const char* part) {
    expect_refusal([&] { read_table("analyze", "text/csv", "0,0\n0.5,0\n0,0.5\n", query); },
                   {"analyze", where, invalid, where, part});
  };
  expect_refused_query({{"measures", "spectrum"}, {"spectrum.measure", "local"}}, "/spectrum/measure",
                       "named in measures alone");
  expect_refused_query({{"measures", "spectrum"}, {"spectrum", "3"}}, "/spectrum", "spectrum.range=");
  expect_refused_query({{"measures", "local"}, {"local", "3"}}, "/local", "has no parameters");
  expect_refused_query({{"compare", "3"}}, "/compare", "the points are the body");
  expect_refused_query({{"sets", "3"}}, "/sets", "the points are the body");
}

TEST(ReadRequest, ReadsNumbersInQueriesAsPeopleWriteThem) {
  for (const char* half : {"0.5", ".5", "5e-1", "0.50"}) {
    const Request request =
        read_table("analyze", "text/csv", "0,0\n0.3,0\n0,0.4\n",
                   {{"domain.width", half}, {"measures", "spectrum"}, {"spectrum.range", half}});
    EXPECT_EQ(domain_of(analyze_of(request).groups[0].sets[0]).box().size.x, 0.5) << half;
    EXPECT_EQ(argument(analyze_of(request).measures[0].arguments, "range"), 0.5) << half;
  }
  for (const char* none : {".", "0.5x", "inf", "nan", "1e999", "0x1"})
    expect_refusal(
        [&] {
          read_table("analyze", "text/csv", "0,0\n0.3,0\n0,0.4\n", {{"domain.width", none}});
        },
        {"analyze", none, invalid, "/domain/width", "found a string"});
}

TEST(ReadRequest, TakesEveryReachOfTheDifferentialByItself) {
  const std::string generate =
      R"({"points":{"generate":{"count":10}},"measures":[{"measure":"differential","reach":)";
  for (const char* reach : {"1", "4", "12.8", "13", "16"})
    EXPECT_NO_THROW(read("analyze", generate + reach + "}]}")) << reach;
  expect_refusals({{"analyze", generate + R"(16,"sigma":0.05}]})", invalid, "/measures/0/sigma", "reach"}});
}

TEST(ReadRequest, RefusesFrequenciesBeyondTheMemory) {
  const std::string million = R"({"points":{"generate":{"count":1000000}},"measures":[)";
  EXPECT_NO_THROW(read("analyze", million + "\"spectrum\"]}"));
  expect_refusals({
      {"analyze", million + R"({"measure":"spectrum","range":12}]})", ErrorCode::too_large,
       "/measures/0/range", "but the limit here is 4096 MiB; ask for a range of at most"},
      {"analyze", million + R"("spacing",{"measure":"periodogram","range":1000}]})", ErrorCode::too_large,
       "/measures/1/range", "ask for a range of at most"},
      // Few points, but forty million numbers.
      {"analyze",
       R"({"points":{"generate":{"count":20}},"measures":[{"measure":"periodogram","range":1000}]})",
       ErrorCode::too_large, "/measures/0/range", "ask for a range of at most 7"},
  });
}

/// The pixels that a refused differential measure says to ask for, with so much memory.
int suggested_pixels(const std::string& measure_with, int pixels, const Limits& limits) {
  try {
    read("analyze", measure_with + std::to_string(pixels) + "}]}", limits);
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "/measures/0/pixels") << error.what();
    const std::string text = error.what(), before = "ask for a pixels of at most ";
    const auto at = text.find(before);
    if (at != std::string::npos) return std::stoi(text.substr(at + before.size()));
    ADD_FAILURE() << text;
  }
  return 0;
}

TEST(ReadRequest, SuggestsOnlyPixelsThatTheMeasureTakes) {
  const std::string wanted =
      R"({"points":{"generate":{"count":100}},"measures":[{"measure":"differential","sigma":0.25,"pixels":)";
  for (std::uint64_t kibibytes = 3000; kibibytes < 9000; kibibytes += 97) {
    Limits limits;
    limits.memory_bytes = kibibytes << 10;
    const int pixels = suggested_pixels(wanted, 1025, limits);
    EXPECT_EQ(pixels % 2, 1) << kibibytes;
    EXPECT_NO_THROW(read("analyze", wanted + std::to_string(pixels) + "}]}", limits)) << pixels;
    EXPECT_EQ(suggested_pixels(wanted, pixels + 2, limits), pixels);  // it is the largest
  }
}

/// A domain that repeats along no axis.
TEST(RequireMeaning, RefusesOnOtherDomainsWhatNeedsATorus) {
  for (const Measure& measure : measures()) {
    EXPECT_NO_THROW(require_meaning(measure, Torus(), "/measures/0"));
    if (measure.needs_torus) {
      expect_refusal([&] { require_meaning(measure, BoxDomain(), "/measures/0"); },
                     {"analyze", measure.name, invalid, "/measures/0", "on a torus only, not on a box"});
    } else {
      EXPECT_NO_THROW(require_meaning(measure, BoxDomain(), "/measures/0"));
    }
  }
}

TEST(ReadRequest, RefusesParametersOfMeasuresBeforeTheWork) {
  const std::string wide = R"({"points":{"generate":{"count":10,"domain":{"height":9}}},"measures":[)";
  expect_refusals({
      {"analyze", wide + R"("spacing",{"measure":"differential","pixels":100}]})", invalid,
       "/measures/1/pixels", "odd"},
      {"analyze", wide + R"({"measure":"differential","sigma":2}]})", invalid, "/measures/0/sigma", "reach"},
      {"analyze", wide + R"({"measure":"zone-plate","columns":4000}]})", invalid, "/measures/0/columns",
       "2^24"},
  });
}

TEST(ExpectedCost, AddsUpWhatIsKeptOfEachGroup) {
  const auto bytes = [](int groups) {
    std::string list;
    for (int g = 0; g < groups; ++g)
      list += std::string(g == 0 ? "" : ",") + R"({"points":{"generate":{"count":1000}}})";
    return expected_cost(read("analyze", R"({"compare":[)" + list +
                                             R"(],"measures":[{"measure":"periodogram","range":10}]})"))
        .bytes;
  };
  const double power = 2 * 317.0 * 317;  // numbers of one
  EXPECT_GE(bytes(11) - bytes(1), 10 * 50 * power);
  const auto blamed = [](const std::string& first, const std::string& second) {
    try {
      read("analyze", R"({"compare":[{"points":{"generate":{"count":)" + first +
                          R"(}}},{"points":{"generate":{"count":)" + second + "}}}]}");
    } catch (const Error& error) {
      return error.where();
    }
    return std::string("none");
  };
  EXPECT_EQ(blamed("9000000", "2000000"), "/compare/0/points");
  EXPECT_EQ(blamed("2000000", "9000000"), "/compare/1/points");
}

}  // namespace
}  // namespace wellspaced
