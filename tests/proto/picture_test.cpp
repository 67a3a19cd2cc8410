#include "proto/picture.h"

#include <gmock/gmock.h>

#include "tests/support/png_image.h"
#include "tests/support/proto_requests.h"
#include "tests/support/svg_text.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::read;
using testing::run;

void expect_refused(const std::function<void()>& action, ErrorCode code, const char* where,
                    const char* part) {
  try {
    action();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    EXPECT_EQ(error.where(), where) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

TEST(ReadPicture, TakesANameOrAnObject) {
  EXPECT_EQ(read_picture(json(), "/picture").picture->name, "voronoi");
  EXPECT_EQ(read_picture("", "/picture").picture->name, "voronoi");
  EXPECT_EQ(read_picture("points", "/picture").picture->name, "points");
  const PictureCall call = read_picture({{"name", "delaunay"}, {"color", "area"}, {"scale", 2}}, "/picture");
  EXPECT_EQ(call.picture->name, "delaunay");
  EXPECT_EQ(call.scale, 2);
  EXPECT_EQ(argument(call.arguments, "color"), 2);
  expect_refused([] { read_picture(7, "/picture"); }, ErrorCode::invalid_parameters, "/picture",
                 "expected a string");
  expect_refused(
      [] {
        read_picture({{"color", "area"}}, "/picture");
      },
      ErrorCode::invalid_parameters, "/picture/name", "one of: voronoi");
  expect_refused([] { read_picture("Voronoi", "/picture"); }, ErrorCode::invalid_parameters, "/picture",
                 "voronoi");
}

TEST(PictureOfQuery, GathersItsParameters) {
  using Query = std::vector<std::pair<std::string, std::string>>;
  EXPECT_TRUE(picture_of_query({{"format", "svg"}}).is_null());
  EXPECT_EQ(picture_of_query({{"picture", "points"}}), "points");
  EXPECT_EQ(picture_of_query({{"picture", "points"}, {"picture.scale", "2"}, {"picture.color", "area"}}),
            (json{{"name", "points"}, {"scale", 2}, {"color", "area"}}));
  for (const Query& twice :
       {Query{{"picture", "a"}, {"picture", "b"}}, Query{{"picture.x", "1"}, {"picture.x", "1"}}})
    expect_refused([&] { picture_of_query(twice); }, ErrorCode::invalid_parameters,
                   twice[0].first == "picture" ? "/picture" : "/picture/x", "twice");
  expect_refused(
      [] {
        picture_of_query({{"picture", ""}});
      },
      ErrorCode::invalid_parameters, "/picture", "empty");
}

/// A result for each kind of groups, all with what every picture needs.
std::vector<Result> results() {
  const std::string optimized = R"({"optimize":{"points":{"generate":{"count":60}},"beta":0.85}})";
  return {
      run("optimize", R"({"points":{"generate":{"count":60}},"beta":0.85})"),
      run("analyze", R"({"points":)" + optimized + R"(,"seeds":3})"),
      run("analyze", R"({"compare":[{"label":"a","points":)" + optimized + R"(},{"label":"b<","points":)" +
                         optimized + R"(,"seeds":2},{"points":{"optimize":{"points":{"generate":{"count":200,
                             "domain":{"width":3}}},"method":"cvt","max_sweeps":3}}}]})")};
}

std::string without_images(std::string text) {
  for (auto at = text.find("base64,"); at != std::string::npos; at = text.find("base64,", at))
    text.erase(at, text.find('"', at) - at);
  return text;
}

TEST(DrawResult, DrawsEveryPictureOfEveryResultInBothFormats) {
  for (const Result& result : results())
    for (const Picture& picture : pictures()) {
      SCOPED_TRACE(result.operation + " " + picture.name);
      const PictureCall call = read_picture(picture.name, "/picture");
      const auto svg = [&](unsigned threads) {
        return to_svg(draw_result(result, call, {}, Control(threads)), Control());
      };
      const std::string text = svg(1);
      EXPECT_EQ(testing::why_malformed(text), "");
      EXPECT_TRUE(text == svg(3));
      const std::string plain = without_images(text);
      for (const char* bad : {"nan", "inf\"", "inf ", "\"\"", "-0 "})
        EXPECT_EQ(plain.find(bad), std::string::npos) << bad;
      const auto image = testing::read_png(to_png(draw_result(result, call, {}, Control()), 0.5, Control()));
      EXPECT_GT(image.width, 50u);
      EXPECT_GT(image.height, 50u);
    }
}

TEST(DrawResult, DrawsAsManyGroupsAsThereMayBe) {
  std::string groups;
  for (int g = 0; g < 16; ++g)
    groups += std::string(g == 0 ? "" : ",") + R"({"label":")" + std::string(60, 'W') +
              R"(","points":{"optimize":{"points":{"generate":{"count":)" + std::to_string(20 + g) +
              R"(}},"method":"cvt","max_sweeps":4}}})";
  const Result result = run("analyze", R"({"compare":[)" + groups + "]}");
  for (const Picture& picture : pictures()) {
    SCOPED_TRACE(picture.name);
    const PictureCall call = read_picture(picture.name, "/picture");
    EXPECT_EQ(testing::why_malformed(to_svg(draw_result(result, call, {}, Control()), Control())), "");
    EXPECT_GT(testing::read_png(to_png(draw_result(result, call, {}, Control()), 0.5, Control())).width, 50u);
  }
}

TEST(RequireDrawable, RefusesConvergenceOfWhatWasNotOptimized) {
  const PictureCall convergence = read_picture("convergence", "/picture");
  const auto check = [&](const char* operation, const std::string& body) {
    return [&convergence, operation, body] { require_drawable(read(operation, body), convergence, {}); };
  };
  const char* const generate = R"({"count":30})";
  expect_refused(check("generate", generate), ErrorCode::invalid_parameters, "/picture", "optimize");
  expect_refused(check("analyze", R"({"points":{"generate":{"count":30}}})"), ErrorCode::invalid_parameters,
                 "/picture", "ask for it with optimize");
  EXPECT_NO_THROW(check("optimize", R"({"points":{"generate":{"count":30}}})")());
  EXPECT_NO_THROW(check("analyze", R"({"points":{"optimize":{"points":{"generate":{"count":30}}}}})")());
  expect_refused([&] { draw_result(run("generate", generate), convergence, {}, Control()); },
                 ErrorCode::invalid_parameters, "/picture", "optimize");
}

TEST(RequireDrawable, LimitsThePointsThatAreDrawn) {
  Limits limits;
  limits.picture_points = 100;
  const auto request = [](int count) {
    return read("generate", R"({"count":)" + std::to_string(count) + "}");
  };
  const PictureCall voronoi = read_picture("voronoi", ""), spectrum = read_picture("spectrum", "");
  EXPECT_NO_THROW(require_drawable(request(100), voronoi, limits));
  expect_refused([&] { require_drawable(request(101), voronoi, limits); }, ErrorCode::too_large, "/picture",
                 "limit of 100");
  EXPECT_NO_THROW(require_drawable(request(1000), spectrum, limits));
  expect_refused([&] { require_drawable(request(1001), spectrum, limits); }, ErrorCode::too_large, "/picture",
                 "limit of 1000");
}

TEST(RequireDrawable, CountsAllSetsTogether) {
  Limits limits;
  limits.picture_points = 100;
  const auto request = [](int sets) {
    return read("analyze", R"({"points":{"generate":{"count":100}},"seeds":)" + std::to_string(sets) + "}");
  };
  const PictureCall averaged = read_picture("distributions", ""), first = read_picture("zone-plate", "");
  EXPECT_NO_THROW(require_drawable(request(11), first, limits));
  EXPECT_NO_THROW(require_drawable(request(10), averaged, limits));
  expect_refused([&] { require_drawable(request(11), averaged, limits); }, ErrorCode::too_large, "/picture",
                 "fewer points or sets");
}

TEST(RequireDrawable, LimitsTheMemory) {
  const PictureCall wide = read_picture({{"name", "periodogram"}, {"range", 12}}, "/picture");
  const Request many = read("generate", R"({"count":900000})");
  expect_refused([&] { require_drawable(many, wide, {}); }, ErrorCode::too_large, "/picture/range",
                 "the limit here is");
  const Request thin = read("generate", R"({"count":900000,"domain":{"width":900}})");
  expect_refused([&] { require_drawable(thin, wide, {}); }, ErrorCode::too_large, "/picture",
                 "more than a million");
  const Result result = run("generate", R"({"method":"white-noise","count":3000})");
  Limits limits;
  limits.memory_bytes = 10 << 20;
  expect_refused([&] { draw_result(result, wide, limits, Control()); }, ErrorCode::too_large,
                 "/picture/range", "MiB, and the limit here is 10 MiB");
}

TEST(RequireDrawable, LimitsTheTime) {
  const Request request = read("generate", R"({"count":20000})");
  const PictureCall slow =
      read_picture({{"name", "zone-plate"}, {"columns", 4096}, {"sigma", 8}}, "/picture");
  expect_refused([&] { require_drawable(request, slow, {}); }, ErrorCode::too_large, "/picture/columns",
                 "s, and the limit here is 10 s");
  for (const Picture& picture : pictures())
    if (!picture.needs_history) {
      EXPECT_NO_THROW(require_drawable(request, read_picture(picture.name, "/picture"), {})) << picture.name;
    }
}

PictureCall as_png(const json& picture) {
  PictureCall call = read_picture(picture, "/picture");
  call.format = Format::png;
  return call;
}

std::string refusal_of(const Request& request, const PictureCall& call) {
  try {
    require_drawable(request, call, {});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RequireDrawable, RefusesAPngOfTooManyPixelsAndNamesTheFieldBeforeTheWork) {
  const Request one = read("generate", R"({"count":100})"),
                many = read("analyze", R"({"points":{"generate":{"count":100}},"seeds":16})");
  const json fine = {{"name", "voronoi"}, {"scale", 4}},
             large = {{"name", "voronoi"}, {"scale", 4}, {"size_px", 4000}},
             wide = {{"name", "voronoi"}, {"size_px", 4000}};
  EXPECT_NO_THROW(require_drawable(one, as_png(fine), {}));
  EXPECT_NO_THROW(require_drawable(one, as_png(wide), {}));
  EXPECT_NO_THROW(require_drawable(one, read_picture(large, "/picture"), {}));  // as SVG
  const auto refuses = [](const Request& request, const json& picture, const char* where, const char* part) {
    expect_refused([&] { require_drawable(request, as_png(picture), {}); }, ErrorCode::too_large, where,
                   part);
  };
  refuses(one, large, "/picture/scale", "most are 40 million; ask for a scale of at most 1.5");
  refuses(many, fine, "/picture/scale", "or for fewer sets");
  refuses(many, wide, "/picture/size_px", "or for a size_px of at most 15");
  refuses(many, large, "/picture", "fewer sets");
}

TEST(RequireDrawable, SuggestsWhatItThenTakes) {
  const Request many = read("analyze", R"({"compare":[{"points":{"generate":{"count":300}}},
      {"points":{"generate":{"count":200,"domain":{"width":3}}}},{"points":{"generate":{"count":200}}}]})");
  for (const Picture& picture : pictures()) {
    if (picture.needs_history) continue;
    SCOPED_TRACE(picture.name);
    json asked = {{"name", picture.name}, {"size_px", 4000}, {"scale", 4}};
    const std::string text = refusal_of(many, as_png(asked)), size = "a size_px of at most ",
                      scale = "a scale of at most ";
    for (const auto& [before, field] : {std::pair(size, "size_px"), std::pair(scale, "scale")}) {
      const auto at = text.find(before);
      if (at == std::string::npos) continue;
      json smaller = asked;
      smaller[field] = std::stod(text.substr(at + before.size()));
      EXPECT_EQ(refusal_of(many, as_png(smaller)), "") << text;
    }
    EXPECT_THAT(text, HasSubstr(size));
  }
}

TEST(DrawResult, RefusesAPngOfTooManyPixelsToo) {
  const Result result = run("generate", R"({"count":30})");
  const json picture = {{"name", "points"}, {"size_px", 4000}, {"scale", 3}};
  expect_refused([&] { draw_result(result, as_png(picture), {}, Control()); }, ErrorCode::too_large,
                 "/picture/scale", "150 million pixels");
  expect_refused([&] { encode_result(result, Format::png, picture, {}, Control()); }, ErrorCode::too_large,
                 "/picture/scale", "ask for");
  EXPECT_NO_THROW(encode_result(result, Format::svg, picture, {}, Control()));
}

std::vector<SetsSize> sizes_of(const Result& result) {
  std::vector<SetsSize> sizes;
  for (const ResultGroup& group : result.groups) {
    const Vec3 sides = group.sets.front().domain->box().size;
    SetsSize size;
    size.n = static_cast<double>(group.sets.front().size());
    size.sets = static_cast<double>(group.sets.size());
    size.height_over_width = sides.y / sides.x;
    size.aspect = std::max(sides.y / sides.x, sides.x / sides.y);
    sizes.push_back(size);
  }
  return sizes;
}

void expect_known_size(const Result& result, const json& asked) {
  SCOPED_TRACE(asked.dump());
  const PictureCall call = read_picture(asked, "/picture");
  const Drawing drawing = draw_result(result, call, {}, Control());
  const SheetSize sheet = call.picture->sheet(sizes_of(result), call.arguments);
  const double pixels = drawing.width_px * drawing.height_px, known = sheet.width_px * sheet.height_px;
  EXPECT_LT(pixels, 1.25 * known) << drawing.width_px << " x " << drawing.height_px << " for "
                                  << sheet.width_px << " x " << sheet.height_px;
  EXPECT_GT(pixels, 0.75 * known) << drawing.width_px << " x " << drawing.height_px << " for "
                                  << sheet.width_px << " x " << sheet.height_px;
}

TEST(DrawResult, DrawsSheetsOfTheSizeThatWasKnownBefore) {
  const std::string optimized = R"({"optimize":{"points":{"generate":{"count":60}},"beta":0.85}})";
  std::vector<Result> all = results();
  all.push_back(run("analyze", R"({"points":)" + optimized + R"(,"seeds":18})"));
  all.push_back(run("analyze", R"({"points":{"optimize":{"points":{"generate":{"count":100,"domain":
                                   {"width":1,"height":2.5}}},"method":"cvt","max_sweeps":3}}})"));
  for (const Result& result : all)
    for (const Picture& picture : pictures())
      for (const int size_px : {300, 700, 1600}) {
        expect_known_size(result, {{"name", picture.name}, {"size_px", size_px}});
        if (picture.name == "zone-plate")
          expect_known_size(result, {{"name", picture.name}, {"size_px", size_px}, {"columns", 230}});
        if (picture.name == "differential")
          expect_known_size(result, {{"name", picture.name}, {"size_px", size_px}, {"pixels", 451}});
        if (picture.name == "periodogram")
          expect_known_size(result, {{"name", picture.name}, {"size_px", size_px}, {"range", 9}});
      }
}

TEST(DrawResult, DrawsSheetsOfThinDomainsOfTheSizeThatWasKnownBefore) {
  std::string thin;
  for (int g = 0; g < 9; ++g)
    thin += std::string(g == 0 ? "" : ",") +
            R"({"label":"thin","points":{"generate":{"count":600,"domain":{"width":1,"height":25}}}})";
  const Result result = run("analyze", R"({"compare":[)" + thin + "]}");
  for (const char* name : {"voronoi", "points", "zone-plate"})
    expect_known_size(result, {{"name", name}, {"size_px", 1600}});
}

TEST(MergedPicture, TakesParametersOfTheQueryForThePictureOfTheRequest) {
  EXPECT_EQ(merged_picture("spectrum", nullptr), "spectrum");
  EXPECT_EQ(merged_picture("spectrum", "points"), "points");
  EXPECT_EQ(merged_picture("spectrum", {{"scale", 2}}), (json{{"name", "spectrum"}, {"scale", 2}}));
  EXPECT_EQ(merged_picture({{"name", "spectrum"}, {"range", 2}}, {{"scale", 2}}),
            (json{{"name", "spectrum"}, {"range", 2}, {"scale", 2}}));
  EXPECT_EQ(merged_picture({{"name", "spectrum"}}, {{"name", "points"}, {"scale", 2}}),
            (json{{"name", "points"}, {"scale", 2}}));
  for (const json& none : {json(), json("")})
    EXPECT_EQ(merged_picture(none, {{"color", "area"}}), (json{{"name", "voronoi"}, {"color", "area"}}));
}

TEST(DrawResult, SaysWhichParameterIsBad) {
  const PictureCall even = read_picture({{"name", "differential"}, {"pixels", 100}}, "/picture");
  expect_refused([&] { draw_result(run("generate", R"({"count":30})"), even, {}, Control()); },
                 ErrorCode::invalid_parameters, "/picture/pixels", "odd");
  const PictureCall voronoi = read_picture("voronoi", "/picture");
  expect_refused([&] { draw_result(run("generate", R"({"count":2})"), voronoi, {}, Control()); },
                 ErrorCode::degenerate_input, "", "at least 3");
}

TEST(PictureSchema, NamesEveryPictureAndParameter) {
  const auto schema = picture_schema();
  ASSERT_EQ(schema["oneOf"].size(), pictures().size() + 1);
  for (std::size_t k = 0; k < pictures().size(); ++k) {
    const Picture& picture = pictures()[k];
    EXPECT_EQ(schema["oneOf"][0]["enum"][k], picture.name);
    for (const Parameter& p : picture.parameters)
      EXPECT_TRUE(schema["oneOf"][k + 1]["properties"].contains(p.name)) << p.name;
  }
}

TEST(DrawResult, ShowsPointsOnEveryDomainTheSameOnAnyNumberOfThreads) {
  for (
      const std::string domain :
      {R"({"type":"box","width":2})", R"({"type":"box","periodic":[false,true]})", R"({"type":"sphere"})",
       R"({"type":"polygon","rings":[[[5,5],[7,5],[7,6],[6,6],[6,7],[5,7]]]})",
       R"({"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"faces":[[0,2,1],[0,1,3],[1,2,3],[2,0,3]]})"})
    for (const std::string name : {"voronoi", "delaunay", "points", "distributions"}) {
      SCOPED_TRACE(domain + " " + name);
      const Result result = run("generate", R"({"count":150,"domain":)" + domain + "}");
      const PictureCall call = read_picture(name, "/picture");
      const Control one(1), three(3);
      const std::string svg = to_svg(draw_result(result, call, {}, one), one);
      EXPECT_EQ(to_svg(draw_result(result, call, {}, three), three), svg);
      EXPECT_GT(svg.size(), 3000u);
      EXPECT_EQ(svg.find("nan"), std::string::npos);
    }
}

}  // namespace
}  // namespace wellspaced
