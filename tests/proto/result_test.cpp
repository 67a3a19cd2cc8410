#include "proto/result.h"

#include <array>
#include <cctype>
#include <string>

#include <gmock/gmock.h>

#include "proto/json_reader.h"
#include "tests/support/proto_requests.h"

namespace wellspaced {
namespace {

using ::testing::HasSubstr;
using testing::run;

/// Results of every operation, with the largest seed and the smallest and largest torus.
std::vector<Result> some_results() {
  return {
      run("generate", R"({"count":50,"seed":18446744073709551615,"picture":"points"})"),
      run("generate", R"({"count":50,"domain":{"width":1e-6,"height":1e-6}})"),
      run("generate", R"({"count":50,"domain":{"width":1e6,"height":123456.789}})"),
      run("generate", R"({"count":1})"),
      run("optimize",
          R"({"points":{"generate":{"count":60,"seed":18446744073709551615}},"method":"opt-beta-local","max_sweeps":2})"),
      run("optimize",
          R"({"points":{"generate":{"count":60,"domain":{"width":1e6,"height":1e6}}},"method":"opt-beta-local","max_sweeps":2})"),
      run("analyze", R"({"points":{"generate":{"count":60,"domain":{"width":1e-6,"height":3e-6}}}})"),
      run("analyze", R"({"points":{"job":"known"}})"),
      run("analyze",
          R"({"points":{"generate":{"count":30}},"seeds":3,"picture":{"name":"points","color":"area"}})"),
      run("analyze", R"({"compare":[{"label":"a","points":{"generate":{"count":20}},"seeds":2},
                                    {"points":{"generate":{"count":10,"domain":{"width":3}}}}]})"),
  };
}

Encoded encoded(const Result& result, Format format) {
  return encode_result(result, format, {}, {}, Control());
}

TEST(StoreResult, IsUndoneByLoadResult) {
  for (const Result& result : some_results()) {
    const std::string bytes = store_result(result);
    const Result back = load_result(bytes);
    EXPECT_EQ(back.operation, result.operation);
    EXPECT_EQ(back.picture, result.picture);
    EXPECT_EQ(back.summary.dump(), result.summary.dump());
    ASSERT_EQ(back.groups.size(), result.groups.size());
    for (std::size_t g = 0; g < back.groups.size(); ++g) {
      EXPECT_EQ(back.groups[g].label, result.groups[g].label);
      ASSERT_EQ(back.groups[g].sets.size(), result.groups[g].sets.size());
      for (std::size_t k = 0; k < back.groups[g].sets.size(); ++k) {
        const PointSet &found = back.groups[g].sets[k], &kept = result.groups[g].sets[k];
        EXPECT_EQ(found.coordinates, kept.coordinates);
        EXPECT_EQ(found.domain->box().size, kept.domain->box().size);
      }
    }
    EXPECT_TRUE(store_result(back) == bytes);
    for (const Format format : formats_of(result.operation)) {
      if (is_picture(format) && result.points().size() < 3) continue;
      EXPECT_TRUE(encoded(back, format).bytes == encoded(result, format).bytes) << name_of(format);
    }
  }
}

TEST(StoreResult, KeepsTheLargestSeed) {
  EXPECT_EQ(load_result(store_result(some_results().front())).summary["seed"], 18446744073709551615u);
}

TEST(LoadResult, ReadsWhatVersionOneKept) {
  std::string bytes =
      R"({"operation":"generate","picture":"","domain":{"type":"torus","width":2.0,"height":1.0},"summary":{"n":1}})"
      "\n";
  const double point[] = {1.5, 0.25};
  bytes.append(reinterpret_cast<const char*>(point), sizeof point);
  const Result result = load_result(bytes);
  EXPECT_THAT(result.points().coordinates, ::testing::ElementsAre(1.5, 0.25));
  EXPECT_EQ(result.points().domain->box().size.x, 2);
}

TEST(OnlyPoints, AreOfResultsWithOneSet) {
  EXPECT_EQ(only_points(run("generate", R"({"count":10})")).size(), 10u);
  EXPECT_THROW(only_points(run("analyze", R"({"points":{"generate":{"count":10}},"seeds":2})")), Error);
}

TEST(LoadResult, RefusesOtherBytes) {
  const std::string good = store_result(run("generate", R"({"count":10})"));
  const std::string bad[] = {"",
                             "\n",
                             "{}\n",
                             "[1]\n",
                             "{\"operation\":\n",
                             good.substr(0, good.size() - 8),
                             good.substr(0, good.size() - 1),
                             good + "12345678",
                             good.substr(1),
                             R"({"operation":1,"picture":"","domain":{},"summary":{}})"
                             "\n",
                             R"({"operation":"generate","picture":"","domain":{"type":"egg"},"summary":{}})"
                             "\n"};
  for (const std::string& bytes : bad) try {
      load_result(bytes);
      ADD_FAILURE() << "no error: " << bytes.substr(0, 60);
    } catch (const Error& error) {
      EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(ErrorCode::internal));
    }
}

TEST(EncodeResult, WritesPointsThatReadBackBitForBit) {
  for (const Result& result : some_results()) {
    const auto rows = result.points().size();
    if (result.operation != "analyze") {
      EXPECT_EQ(read_npy(encoded(result, Format::npy).bytes, rows).values, result.points().coordinates);
      EXPECT_EQ(read_csv(encoded(result, Format::csv).bytes, rows).values, result.points().coordinates);
      constexpr std::array<std::string_view, 1> tables = {"/points"};
      const JsonDocument document = read_json(encoded(result, Format::json).bytes, tables, rows);
      ASSERT_EQ(document.tables.size(), 1u);
      EXPECT_EQ(document.tables[0].table.values, result.points().coordinates);
    }
  }
}

TEST(EncodeResult, WritesTheWholeSummaryAsJson) {
  for (const Result& result : some_results()) {
    const Encoded json = encoded(result, Format::json);
    EXPECT_EQ(json.media_type, "application/json");
    EXPECT_EQ(json.summary_line, "");
    auto document = nlohmann::ordered_json::parse(json.bytes);
    EXPECT_EQ(document.contains("points"), result.operation != "analyze");
    document.erase("points");
    EXPECT_EQ(document.dump(), result.summary.dump());
    EXPECT_EQ(json.bytes.back(), '\n');
  }
}

TEST(EncodeResult, SummarizesInOneLineOfPrintableAsciiWithoutArrays) {
  for (const Result& result : some_results())
    for (const Format format : formats_of(result.operation)) {
      if (format == Format::json || (is_picture(format) && result.points().size() < 3)) continue;
      const std::string line = encoded(result, format).summary_line;
      for (const char c : line) EXPECT_TRUE(c >= 0x20 && c < 0x7f) << static_cast<int>(c);
      EXPECT_LT(line.size(), 4000u);
      const auto summary = nlohmann::ordered_json::parse(line);
      EXPECT_EQ(line.find('['), std::string::npos) << line;
      for (const auto& [key, value] : result.summary.items()) {
        EXPECT_NE(summary.contains(key), value.is_array()) << key;
        const bool flat = value.dump().find('[') == std::string::npos;
        if (flat && !value.is_array()) {
          EXPECT_EQ(summary[key], value) << key;
        }
      }
    }
}

TEST(EncodeResult, EscapesWhatIsNotAscii) {
  Result result = run("generate", R"({"count":10})");
  result.summary["method"] = "caf\xc3\xa9 \xff\n";
  const std::string line = encoded(result, Format::csv).summary_line;
  EXPECT_THAT(line, HasSubstr("caf\\u00e9 \\ufffd\\n"));
}

TEST(EncodeResult, NamesFileAndMediaType) {
  const Result result = run("generate", R"({"count":10})");
  for (const Format format : formats_of("generate")) {
    const Encoded out = encoded(result, format);
    EXPECT_EQ(out.media_type, media_type_of(format));
    EXPECT_EQ(out.file_name, "wellspaced-generate." + std::string(name_of(format)));
  }
}

TEST(EncodeResult, DrawsTheRequestsPictureUnlessAnotherIsAskedFor) {
  const auto svg = [](const Result& result, const nlohmann::json& picture) {
    return encode_result(result, Format::svg, picture, {}, Control()).bytes;
  };
  const Result plain = run("generate", R"({"count":50})");
  const Result delaunay = run("generate", R"({"count":50,"picture":"delaunay"})");
  EXPECT_TRUE(svg(delaunay, {}) == svg(plain, "delaunay"));
  EXPECT_TRUE(svg(plain, {}) == svg(delaunay, "voronoi"));
  EXPECT_FALSE(svg(plain, "voronoi") == svg(plain, "delaunay"));
  EXPECT_FALSE(svg(plain, "points") == svg(plain, "delaunay"));
}

TEST(EncodeResult, RefusesPicturesAboveTheLimit) {
  const Result result = run("generate", R"({"method":"square","count":100})");
  Limits limits;
  limits.picture_points = 100;
  EXPECT_NO_THROW(encode_result(result, Format::svg, {}, limits, Control()));
  limits.picture_points = 99;
  try {
    encode_result(result, Format::svg, {}, limits, Control());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(ErrorCode::too_large));
    EXPECT_THAT(error.what(), HasSubstr("limit of 99"));
  }
}

TEST(FormatsOf, OffersJsonFirstAndPointsWhereTheyAreNew) {
  for (const char* operation : {"generate", "optimize", "analyze"}) {
    EXPECT_EQ(formats_of(operation).front(), Format::json);
    EXPECT_EQ(formats_of(operation).back(), Format::png);
  }
  EXPECT_EQ(formats_of("analyze").size(), 3u);
}

}  // namespace
}  // namespace wellspaced
