// Bad input gets a problem document that names the field, and nothing is lost or left running.
#include <array>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/formats/npy.h"
#include "tests/server/raw_client.h"
#include "tests/support/server_app.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using support::Answer;
using support::Caller;
using support::ServedApp;
using testing::HasSubstr;

constexpr const char* kJson = "application/json";
constexpr const char* kNpy = "application/x-npy";

struct BadInput {
  const char* name;
  std::string target, body;
  int status;
  std::string problem, pointer;
  std::string type = kJson;
};

void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }

std::string npy(const std::string& name) {
  return support::read_file(std::string(WELLSPACED_TEST_DATA) + "/npy/" + name);
}

std::string with_points(const std::string& points) { return R"({"points":)" + points + "}"; }

std::string with_beta(const std::string& beta) {
  return R"({"points":{"generate":{"count":50}},"beta":)" + beta + "}";
}

const std::string invalid = "invalid-parameters", malformed = "malformed-request",
                  degenerate = "degenerate-input";

const std::array<double, 6> with_nan = {0.1, 0.2, std::numeric_limits<double>::quiet_NaN(), 0.3, 0.4, 0.5};

const std::vector<BadInput> bad_inputs = {
    {"NanCoordinate", "/v1/analyze", with_points("[[0.1,0.2],[NaN,0.3],[0.4,0.5]]"), 400, malformed, "?"},
    {"InfiniteCoordinate", "/v1/analyze", with_points("[[0.1,0.2],[0.3,1e999],[0.4,0.5]]"), 422, invalid,
     "/points/1/1"},
    {"NanInNpy", "/v1/analyze", write_npy(with_nan.data(), 3, 2), 422, invalid, "/points/1/0", kNpy},
    {"PointOutside", "/v1/analyze", with_points("[[0.1,0.2],[0.3,1.0],[0.4,0.5]]"), 422, invalid,
     "/points/1"},
    {"NegativeCoordinate", "/v1/optimize", with_points("[[0.1,0.2],[0.3,0.4],[-0.4,0.5]]"), 422, invalid,
     "/points/2"},
    {"Duplicates", "/v1/optimize", with_points("[[0.1,0.2],[0.3,0.4],[0.5,0.6],[0.1,0.2]]"), 422, degenerate,
     "/points/3"},
    {"TwoPoints", "/v1/analyze", with_points("[[0.1,0.2],[0.3,0.4]]"), 422, degenerate, "/points"},
    {"NoPoints", "/v1/analyze", with_points("[]"), 422, degenerate, "/points"},
    {"TwoGeneratedPoints", "/v1/optimize", with_points(R"({"generate":{"count":2}})"), 422, degenerate,
     "/points/generate/count"},
    {"CountZero", "/v1/generate", R"({"count":0})", 422, invalid, "/count"},
    {"CountNegative", "/v1/generate", R"({"count":-5})", 422, invalid, "/count"},
    {"CountFractional", "/v1/generate", R"({"count":10.5})", 422, invalid, "/count"},
    {"CountAboveLimit", "/v1/generate", R"({"count":10000001})", 422, "too-large", "/count"},
    {"CountHuge", "/v1/generate", R"({"count":1e300})", 422, invalid, "/count"},
    {"InnerCount", "/v1/analyze", with_points(R"({"generate":{"count":0}})"), 422, invalid,
     "/points/generate/count"},
    {"CountMissing", "/v1/generate", "{}", 422, invalid, "/count"},
    {"CountAndRadius", "/v1/generate", R"({"count":10,"radius":0.1})", 422, invalid, "?"},
    {"BetaBelowTheLattice", "/v1/optimize", with_beta("0.57"), 422, "infeasible", "/beta"},
    {"BetaOne", "/v1/optimize", with_beta("1"), 422, invalid, "/beta"},
    {"BetaAboveOne", "/v1/optimize", with_beta("2"), 422, invalid, "/beta"},
    {"BetaText", "/v1/optimize", with_beta("\"0.8\""), 422, invalid, "/beta"},
    {"UnknownGenerator", "/v1/generate", R"({"method":"magic","count":10})", 422, invalid, "/method"},
    {"UnknownOptimizer", "/v1/optimize", R"({"method":"magic","points":{"generate":{"count":50}}})", 422,
     invalid, "/method"},
    {"UnknownMeasure", "/v1/analyze", R"({"measures":["magic"],"points":{"generate":{"count":50}}})", 422,
     invalid, "/measures/0"},
    {"UnknownDomain", "/v1/generate", R"({"count":10,"domain":{"type":"torrus"}})", 422, invalid,
     "/domain/type"},
    {"UnknownField", "/v1/generate", R"({"count":10,"sead":1})", 422, invalid, "/sead"},
    {"UnknownQueryParameter", "/v1/generate?sead=1", R"({"count":10})", 422, invalid, "/sead"},
    {"UnknownPicture", "/v1/generate?picture=photo", R"({"count":10})", 422, invalid, "/picture"},
    {"UnknownPictureParameter", "/v1/generate?picture.colour=area", R"({"count":10})", 422, invalid,
     "/picture/colour"},
    {"BadPictureParameter", "/v1/generate?picture=voronoi&picture.size_px=1", R"({"count":10})", 422, invalid,
     "/picture/size_px"},
    {"ConvergenceOfNothing", "/v1/generate?picture=convergence&format=svg", R"({"count":10})", 422, invalid,
     "/picture"},
    {"SetsOfTwoSizes", "/v1/analyze",
     R"({"sets":[[[0,0],[0.5,0],[0,0.5]],[[0,0],[0.5,0],[0,0.5],[0.5,0.5]]]})", 422, invalid, "/sets/1"},
    {"SetsOfTwoDomains", "/v1/analyze",
     R"({"sets":[{"generate":{"count":10}},{"generate":{"count":10,"domain":{"width":2}}}]})", 422, invalid,
     "/sets/1"},
    {"SetsFoundToDiffer", "/v1/analyze", R"({"sets":[{"generate":{"count":10}},{"generate":{"count":11}}]})",
     422, invalid, "/sets/1"},
    {"RangeBeyondMemory", "/v1/analyze",
     R"({"points":{"generate":{"count":1000000}},"measures":[{"measure":"spectrum","range":20}]})", 422,
     "too-large", "/measures/0/range"},
    {"BadSizing", "/v1/analyze",
     R"({"points":{"generate":{"count":10}},"sizing":{"type":"linear","from":1,"to":0}})", 422, invalid,
     "/sizing/to"},
    {"UnknownSizing", "/v1/analyze", R"({"points":{"generate":{"count":10}},"sizing":{"type":"wavy"}})", 422,
     invalid, "/sizing/type"},
    {"MeasuresThatAreNoList", "/v1/analyze?measures.x=1", "0.1,0.2\n0.3,0.7\n0.4,0.5\n", 422, invalid,
     "/measures", "text/csv"},
    {"SeedsOfPoints", "/v1/analyze", R"({"points":[[0,0],[0.5,0],[0,0.5]],"seeds":2})", 422, invalid,
     "/seeds"},
    {"CountText", "/v1/generate", R"({"count":"10"})", 422, invalid, "/count"},
    {"MethodNumber", "/v1/generate", R"({"count":10,"method":7})", 422, invalid, "/method"},
    {"SeedNegative", "/v1/generate", R"({"count":10,"seed":-1})", 422, invalid, "/seed"},
    {"DomainText", "/v1/generate", R"({"count":10,"domain":"torus"})", 422, invalid, "/domain"},
    {"WidthZero", "/v1/generate", R"({"count":10,"domain":{"width":0}})", 422, invalid, "/domain/width"},
    {"PointsText", "/v1/analyze", with_points("\"all\""), 422, invalid, "/points"},
    {"PointsMissing", "/v1/analyze", "{}", 422, invalid, "/points"},
    {"PointOfThree", "/v1/analyze", with_points("[[1,2,3],[1,2,3],[1,2,3]]"), 422, invalid, "/points"},
    {"RaggedPoints", "/v1/analyze", with_points("[[0.1,0.2],[0.3],[0.4,0.5]]"), 422, invalid, "/points/1"},
    {"TextCoordinate", "/v1/analyze", with_points(R"([[0.1,"a"],[0.3,0.1],[0.4,0.5]])"), 422, invalid,
     "/points/0/1"},
    {"UnknownJobOfPoints", "/v1/analyze", with_points(R"({"job":"nonsense"})"), 404, "no-such-job",
     "/points/job"},
    {"TopLevelArray", "/v1/generate", "[]", 422, invalid, "?"},
    {"EmptyBody", "/v1/generate", "", 400, malformed, "?"},
    {"TruncatedJson", "/v1/generate", R"({"count":)", 400, malformed, "?"},
    {"DeepNesting", "/v1/analyze", std::string(100000, '['), 400, malformed, "?"},
    {"DeepPoints", "/v1/analyze", R"({"points":)" + std::string(100000, '['), 422, invalid, "/points/0/0"},
    {"DeepObjects", "/v1/generate",
     [] {
       std::string text;
       for (int k = 0; k < 100000; ++k) text += R"({"a":)";
       return text;
     }(),
     400, malformed, "?"},
    {"InvalidUtf8", "/v1/generate", "{\"count\":10,\"\xff\xfe\":1}", 400, malformed, "?"},
    {"TruncatedNpy", "/v1/analyze", npy("little_f8.npy").substr(0, 130), 400, malformed, "?", kNpy},
    {"NpyOfObjects", "/v1/analyze", npy("dtype_O.npy"), 422, invalid, "/points", kNpy},
    {"EmptyNpy", "/v1/analyze", "", 400, malformed, "?", kNpy},
    {"TextAsNpy", "/v1/analyze", "0.1,0.2\n", 400, malformed, "?", kNpy},
    {"RaggedCsv", "/v1/analyze", "0.1,0.2\n0.3\n0.4,0.5\n", 422, invalid, "/points/1", "text/csv"},
    {"BadQueryBeta", "/v1/optimize?beta=2", "0.1,0.2\n0.3,0.7\n0.4,0.5\n", 422, invalid, "/beta", "text/csv"},
    {"UnknownMediaType", "/v1/generate", "<x/>", 415, "unsupported-media-type", "?", "application/xml"},
    {"GenerateFromNpy", "/v1/generate", npy("little_f8.npy"), 415, "unsupported-media-type", "?", kNpy},
};

/// One server for all of them: a request that breaks it fails those after it.
class ServiceInput : public testing::TestWithParam<BadInput> {
 public:
  static void SetUpTestSuite() { app_ = new ServedApp; }
  static void TearDownTestSuite() {
    delete app_;
    app_ = nullptr;
  }

 protected:
  Caller caller_{app_->port()};
  inline static ServedApp* app_ = nullptr;
};

TEST_P(ServiceInput, GetsAProblemThatNamesTheField) {
  const BadInput& bad = GetParam();
  for (const bool later : {false, true}) {
    const Answer answer = caller_.post(
        bad.target, bad.body,
        later ? support::HeaderList{{"Prefer", "respond-async"}} : support::HeaderList{}, bad.type);
    EXPECT_EQ(answer.status, bad.status) << answer.body;
    EXPECT_EQ(answer.problem(), bad.problem) << answer.body;
    if (bad.pointer != "?") {
      EXPECT_EQ(answer.pointer(), bad.pointer) << answer.body;
    }
    EXPECT_LT(answer.body.size(), 2000u);
    EXPECT_FALSE(answer.parsed().value("detail", "").empty());
  }
  EXPECT_EQ(caller_.metric("wellspaced_jobs_running"), 0);
  EXPECT_EQ(caller_.metric("wellspaced_job_queue_depth"), 0);
  EXPECT_EQ(caller_.get("/v1/jobs").parsed()["jobs"].size(), 0u) << "a refused request left a job";
}

INSTANTIATE_TEST_SUITE_P(Bad, ServiceInput, testing::ValuesIn(bad_inputs),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(ServiceInputLimits, ABodyOverTheLimitIsRefusedBeforeItIsSent) {
  ServedApp app([](Config& config) { config.limits.body_bytes = 1000; });
  const Caller caller(app.port());
  EXPECT_EQ(caller.post("/v1/generate", std::string(1001, ' ')).problem(), "payload-too-large");
  http::test::RawClient raw(app.port());
  const auto answer = raw.ask(
      "POST /v1/generate HTTP/1.1\r\nHost: x\r\nContent-Length: 99999999\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_EQ(answer.status, 413);
  EXPECT_EQ(caller.post("/v1/generate", R"({"count":5})").status, 200);
}

TEST(ServiceInputLimits, EachLimitOfTheOperatorNamesTheField) {
  ServedApp app([](Config& config) {
    config.limits.optimize_points = 100;
    config.limits.analyze_points = 50;
    config.limits.picture_points = 20;
  });
  const Caller caller(app.port());
  const Answer optimize = caller.post("/v1/optimize", with_points(R"({"generate":{"count":101}})"));
  EXPECT_EQ(optimize.problem(), "too-large");
  EXPECT_EQ(optimize.pointer(), "/points/generate/count");
  EXPECT_EQ(caller.post("/v1/analyze", with_points(R"({"generate":{"count":51}})")).problem(), "too-large");
  const std::string body = R"({"method":"white-noise","count":21})";
  const Answer picture = caller.post("/v1/generate?format=svg", body);
  EXPECT_EQ(picture.status, 422);
  EXPECT_EQ(picture.problem(), "too-large");
  EXPECT_EQ(caller.get("/v1/jobs").parsed()["jobs"].size(), 0u) << "refused only after the work";
  EXPECT_EQ(caller.post("/v1/generate?format=csv", body).status, 200);
}

TEST(ServiceInputLimits, WorkAboveTheMemoryLimitIsRefusedBeforeItStarts) {
  ServedApp app([](Config& config) { config.limits.memory_bytes = 1 << 20; });
  const Caller caller(app.port());
  const Answer answer = caller.post("/v1/generate", R"({"count":1000000})", {{"Prefer", "respond-async"}});
  EXPECT_EQ(answer.problem(), "too-large");
  EXPECT_EQ(caller.get("/v1/jobs").parsed()["jobs"].size(), 0u);
}

TEST(ServiceInputLimits, WorkTooLongForASynchronousAnswerNamesTheHeaderToSend) {
  ServedApp app;
  const Caller caller(app.port());
  const Answer answer = caller.post("/v1/optimize", support::endless_request());
  EXPECT_EQ(answer.status, 422);
  EXPECT_EQ(answer.problem(), "too-large-for-sync");
  EXPECT_THAT(answer.body, HasSubstr("Prefer: respond-async"));
  EXPECT_EQ(answer.parsed()["errors"][0]["pointer"], "/points");
  EXPECT_EQ(caller.get("/v1/jobs").parsed()["jobs"].size(), 0u);
}

}  // namespace
}  // namespace wellspaced
