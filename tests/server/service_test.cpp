// The service as a client sees it: results, formats, contract, metrics.
#include <atomic>
#include <cmath>
#include <future>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/result.h"
#include "server/context.h"
#include "server/log.h"
#include "server/routes.h"
#include "tests/server/raw_client.h"
#include "tests/support/server_app.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using support::Answer;
using support::Caller;
using support::optimize_request;
using support::Process;
using support::ServedApp;
using support::TemporaryDirectory;
using testing::HasSubstr;
using testing::StartsWith;

struct Service : testing::Test {
  ServedApp app;
  Caller caller{app.port()};
};

TEST_F(Service, TheReadmesRequestGivesAWellSpacedSet) {
  const std::string body =
      R"({"points":{"generate":{"domain":{"type":"torus"},"method":"poisson-disk","count":10000,"seed":1}},)"
      R"("method":"opt-beta-local","beta":0.85})";
  const Answer answer = caller.post("/v1/optimize", body);
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(answer.header("Content-Type"), "application/json");
  const json result = answer.parsed();
  EXPECT_EQ(result.value("n", 0.0), 10000);
  EXPECT_EQ(result["points"].size(), result["n"]);
  EXPECT_EQ(result["converged"], true);
  EXPECT_LE(result.value("beta", 9.0), 0.85);

  const json again = {{"points", result["points"]}, {"domain", result["domain"]}};
  const Answer measured = caller.post("/v1/analyze", again.dump());
  ASSERT_EQ(measured.status, 200) << measured.body;
  EXPECT_THAT(measured.body, HasSubstr("\"beta\":" + result["beta"].dump()));
  EXPECT_TRUE(caller.idle());
}

TEST_F(Service, ATargetOutOfReachGivesTheBestSetAndSaysSo) {
  const Answer answer = caller.post("/v1/optimize", optimize_request(1000, 0.85, 1));
  ASSERT_EQ(answer.status, 200) << answer.body;
  const json result = answer.parsed();
  EXPECT_EQ(result["converged"], false);
  EXPECT_GT(result.value("beta", 0.0), 0.85);
  EXPECT_EQ(result["points"].size(), result["n"]);
}

TEST_F(Service, GeneratesWithEveryMethodOfItsList) {
  const json operation = caller.get("/v1/operations/generate").parsed();
  ASSERT_GE(operation["methods"].size(), 6u);
  for (const json& method : operation["methods"]) {
    const json body = {{"method", method["name"]}, {"count", 100}};
    const Answer answer = caller.post("/v1/generate", body.dump());
    EXPECT_EQ(answer.status, 200) << method["name"] << answer.body;
    EXPECT_GT(answer.parsed()["points"].size(), 50u) << method["name"];
  }
}

/// Several sets, groups, measures and a picture of all of it.
std::string analyze_request() {
  return R"({"compare":[{"label":"a","points":{"generate":{"count":300}},"seeds":3},
                        {"label":"b","points":{"optimize":{"points":{"generate":{"count":200}},"beta":0.8}}}],
             "measures":["spacing","certificate","distributions","local","spectrum",
                         {"measure":"periodogram","range":1},"pair-correlation","discrepancy","bond-order",
                         "zone-plate","differential"],"picture":"overview"})";
}

/// One request by all three ways, in one format.
void expect_same_bytes(const std::string& operation, const std::string& format, unsigned threads,
                       std::map<std::string, std::string>& first) {
  ServedApp app([&](Config& config) { config.threads = threads; });
  const Caller caller(app.port());
  const std::string body = operation == "analyze" ? analyze_request() : optimize_request(400, 0.85, 8);
  const Answer sync = caller.post("/v1/" + operation + "?format=" + format, body);
  ASSERT_EQ(sync.status, 200) << sync.body;
  const std::string id = caller.submit(operation, body);
  ASSERT_EQ(caller.finished(id)["status"], "successful");
  const Answer later = caller.get("/v1/jobs/" + id + "/result?format=" + format);
  EXPECT_EQ(later.body, sync.body);
  EXPECT_EQ(later.header("Content-Type"), sync.header("Content-Type"));
  EXPECT_EQ(later.header("Wellspaced-Summary"), sync.header("Wellspaced-Summary"));

  TemporaryDirectory directory;
  support::write_file(directory / "request.json", body);
  const std::string output = directory / ("out." + format);
  Process run(
      {"run", operation, directory / "request.json", "-o", output, "--threads", std::to_string(threads)});
  EXPECT_EQ(run.wait(), 0) << run.err();
  EXPECT_EQ(support::read_file(output), sync.body);
  const auto [known, fresh] = first.emplace(operation + "." + format, sync.body);
  EXPECT_TRUE(fresh || known->second == sync.body) << format << " differs with " << threads << " threads";
}

TEST(ServiceBytes, AreTheSameSyncAsyncAndFromTheCommandLineWithOneAndTwoThreads) {
  std::map<std::string, std::string> first;
  for (const unsigned threads : {1u, 2u})
    for (const char* format : {"json", "npy", "csv", "svg", "png"})
      expect_same_bytes("optimize", format, threads, first);
  EXPECT_EQ(first.size(), 5u);
}

TEST(ServiceBytes, OfAnAnalysisAreTheSameToo) {
  std::map<std::string, std::string> first;
  for (const unsigned threads : {1u, 2u})
    for (const char* format : {"json", "svg", "png"}) expect_same_bytes("analyze", format, threads, first);
  EXPECT_EQ(first.size(), 3u);
}

TEST_F(Service, AnswersInTheFormatOfAcceptAndTheQueryWins) {
  const std::string body = R"({"count":50,"method":"white-noise"})";
  const Answer csv = caller.post("/v1/generate", body, {{"Accept", "text/csv"}});
  EXPECT_THAT(csv.header("Content-Type"), StartsWith("text/csv"));
  const Answer npy = caller.post("/v1/generate?format=npy", body, {{"Accept", "text/csv"}});
  EXPECT_EQ(npy.header("Content-Type"), "application/x-npy");
  EXPECT_THAT(npy.body, StartsWith("\x93NUMPY"));
  EXPECT_EQ(npy.body.size() % 64, 50 * 16 % 64);
  EXPECT_THAT(npy.header("Content-Disposition"), HasSubstr("wellspaced-generate.npy"));
  EXPECT_EQ(json::parse(npy.header("Wellspaced-Summary"), nullptr, false).value("n", 0), 50);
  const Answer svg = caller.post("/v1/generate?picture=delaunay", body, {{"Accept", "image/svg+xml"}});
  EXPECT_EQ(svg.header("Content-Type"), "image/svg+xml");
  EXPECT_THAT(svg.body, HasSubstr("<svg"));
  const Answer png = caller.post("/v1/generate?picture=points&picture.color=area&picture.scale=0.5", body,
                                 {{"Accept", "image/png"}});
  EXPECT_EQ(png.header("Content-Type"), "image/png");
  EXPECT_THAT(png.body, StartsWith("\x89PNG"));
}

TEST_F(Service, ComparesAndAveragesInOneRequest) {
  const Answer answer = caller.post("/v1/analyze", analyze_request());
  ASSERT_EQ(answer.status, 200) << answer.body;
  const json compared = answer.parsed()["compare"];
  ASSERT_EQ(compared.size(), 2u);
  EXPECT_EQ(compared[0]["sets"], 3);
  EXPECT_EQ(compared[0]["label"], "a");
  EXPECT_LE(compared[1]["certificate"]["beta_upper"].get<double>(), 0.8);
  EXPECT_TRUE(compared[1]["optimized"][0]["converged"]);
}

TEST_F(Service, AveragesOverKeptResults) {
  json sets = json::array();
  for (const int seed : {1, 2}) {
    const std::string id = caller.submit("optimize", optimize_request(200, 0.85, seed));
    ASSERT_EQ(caller.finished(id)["status"], "successful");
    sets.push_back({{"job", id}});
  }
  const Answer answer = caller.post("/v1/analyze", json{{"sets", sets}, {"measures", {"spectrum"}}}.dump());
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(answer.parsed()["sets"], 2);
  // What looked at several sets is no point set itself.
  const std::string several = caller.submit("analyze", json{{"sets", sets}}.dump());
  ASSERT_EQ(caller.finished(several)["status"], "successful");
  const Answer refused = caller.post("/v1/analyze", json{{"points", {{"job", several}}}}.dump());
  EXPECT_EQ(refused.status, 422);
  EXPECT_EQ(refused.parsed()["errors"][0]["pointer"], "/points/job");
}

TEST_F(Service, ParametersOfAPictureInTheQueryKeepTheRequestsPicture) {
  const std::string body = R"({"points":{"generate":{"count":50}},"picture":"spectrum"})";
  const Answer spectrum = caller.post("/v1/analyze?format=svg&picture.range=2", body);
  ASSERT_EQ(spectrum.status, 200) << spectrum.body;
  EXPECT_THAT(spectrum.body, HasSubstr("radial mean power"));
}

TEST_F(Service, APictureOfTheQueryIsTheSameSynchronousAndNot) {
  const std::string body = R"({"points":{"generate":{"count":50}},"picture":"points"})";
  const std::string query = "?picture=periodogram&picture.range=1.5";
  const Answer sync = caller.post("/v1/analyze" + query + "&format=svg", body);
  ASSERT_EQ(sync.status, 200) << sync.body;
  const Answer accepted = caller.post("/v1/analyze" + query, body, {{"Prefer", "respond-async"}});
  ASSERT_EQ(accepted.status, 202) << accepted.body;
  const std::string id = accepted.parsed()["id"];
  ASSERT_EQ(caller.finished(id)["status"], "successful");
  const std::string path = "/v1/jobs/" + id + "/result?format=svg";
  EXPECT_EQ(caller.get(path).body, sync.body);
  EXPECT_THAT(caller.get(path + "&picture=spectrum").body, HasSubstr("radial mean power"));
  const Answer unknown = caller.get(path + "&colour=red");
  EXPECT_EQ(unknown.status, 422);
  EXPECT_EQ(unknown.parsed()["errors"][0]["pointer"], "/colour");
}

TEST(ServicePictures, WaitForTheirTurnAndLeaveThreadsForOtherRequests) {
  ServedApp app([](Config& config) {
    config.http.threads = 2;
    config.workers = 1;
  });
  const Caller caller(app.port());
  const std::string id = caller.submit("generate", R"({"count":20000})");
  ASSERT_EQ(caller.finished(id)["status"], "successful");
  const std::string path = "/v1/jobs/" + id + "/result?format=png&picture=zone-plate&picture.columns=1000";
  std::atomic<int> drawn = 0;
  std::vector<std::future<int>> pictures;
  for (int k = 0; k < 6; ++k)
    pictures.push_back(std::async(std::launch::async, [&] {
      const int status = caller.get(path).status;
      ++drawn;
      return status;
    }));
  // All six would keep both threads for long; with one place there is always a thread that answers.
  int answered = 0;
  for (; drawn < 6; ++answered)
    EXPECT_EQ(caller.get("/livez").status + caller.get("/v1/operations").status, 400);
  EXPECT_GT(answered, 6);
  for (auto& picture : pictures) EXPECT_EQ(picture.get(), 200);
  const Answer posted = caller.post("/v1/generate?format=png", R"({"count":100})");
  EXPECT_EQ(posted.status, 200);
}

TEST_F(Service, RefusesPicturesThatTakeTooLong) {
  const std::string query = "?format=png&picture=zone-plate&picture.columns=4096&picture.sigma=8";
  const Answer refused = caller.post("/v1/generate" + query, R"({"count":20000})");
  EXPECT_EQ(refused.status, 422);
  EXPECT_EQ(refused.problem(), "too-large");
  EXPECT_EQ(refused.parsed()["errors"][0]["pointer"], "/picture/columns");
}

TEST_F(Service, RefusesHugePngsBeforeTheWork) {
  const std::string query = "?format=png&picture=points&picture.size_px=4000&picture.scale=3";
  // To optimize that many points takes seconds; no job is made of it.
  const std::string body = R"({"points":{"generate":{"count":100000}}})";
  const auto jobs = [&] { return caller.get("/v1/jobs").parsed()["jobs"].size(); };
  const std::size_t before = jobs();
  const Answer refused = caller.post("/v1/optimize" + query, body);
  EXPECT_EQ(refused.status, 422);
  EXPECT_EQ(refused.problem(), "too-large");
  EXPECT_EQ(refused.parsed()["errors"][0]["pointer"], "/picture/scale");
  EXPECT_EQ(jobs(), before);
}

TEST_F(Service, RefusesFormatsItDoesNotHaveWithTheListOfThoseItHas) {
  for (const Answer& answer :
       {caller.post("/v1/generate", R"({"count":50})", {{"Accept", "application/pdf"}}),
        caller.post("/v1/generate?format=pdf", R"({"count":50})")}) {
    EXPECT_EQ(answer.status, 406);
    EXPECT_EQ(answer.problem(), "not-acceptable");
    for (const char* format : {"json", "npy", "csv", "svg"}) EXPECT_THAT(answer.body, HasSubstr(format));
  }
  const Answer analyzed = caller.post("/v1/analyze?format=npy", R"({"points":{"generate":{"count":50}}})");
  EXPECT_EQ(analyzed.problem(), "not-acceptable");
}

TEST_F(Service, ReadsPointsAsNpyAndCsvWithTheParametersInTheQuery) {
  const std::string npy = caller.post("/v1/generate?format=npy", R"({"count":300})").body;
  const Answer from_npy = caller.post("/v1/optimize?method=opt-beta-local&beta=0.9&max_sweeps=5&format=csv",
                                      npy, {}, "application/x-npy");
  ASSERT_EQ(from_npy.status, 200) << from_npy.body;
  const std::string csv = caller.post("/v1/generate?format=csv", R"({"count":300})").body;
  const Answer from_csv =
      caller.post("/v1/optimize?method=opt-beta-local&beta=0.9&max_sweeps=5&format=csv", csv, {}, "text/csv");
  EXPECT_EQ(from_csv.body, from_npy.body);
}

TEST_F(Service, EveryRouteIsInTheDescriptionAndEveryDescribedPathIsARoute) {
  std::set<std::string> described, routed;
  const json document = caller.get("/openapi.json").parsed();
  for (const auto& [path, methods] : document["paths"].items())
    for (const auto& [method, operation] : methods.items())
      if (method != "parameters") described.insert(method + " " + path);
  const Config config;
  Metrics metrics;
  TemporaryDirectory directory;
  const auto store = open_sqlite_store(directory / "jobs.db", {});
  Context context{config, *store, metrics};
  for (const http::Route& route : routes(context)) {
    std::string method = route.method;
    for (char& c : method) c = static_cast<char>(std::tolower(c));
    routed.insert(method + " " + route.pattern);
  }
  EXPECT_EQ(described, routed);
  EXPECT_GE(routed.size(), 16u);
}

TEST_F(Service, EveryGetOfTheDescriptionAnswersWithADescribedStatusAndType) {
  const std::string id = caller.submit("generate", R"({"count":50})");
  ASSERT_EQ(caller.finished(id)["status"], "successful");
  const std::string domain =
      caller.post("/v1/domains", "POLYGON ((0 0, 1 0, 0 1, 0 0))", {}, "text/wkt").parsed()["id"];
  const json document = caller.get("/openapi.json").parsed();
  for (const auto& [path, methods] : document["paths"].items()) {
    if (!methods.contains("get") || path.ends_with("/events")) continue;
    std::string target =
        std::regex_replace(path, std::regex("\\{id\\}"), path.starts_with("/v1/domains") ? domain : id);
    target = std::regex_replace(target, std::regex("\\{operation\\}"), "analyze");
    const Answer answer = caller.get(target);
    EXPECT_EQ(answer.status, 200) << target << answer.body;
    const std::string type = answer.header("Content-Type").substr(0, answer.header("Content-Type").find(';'));
    EXPECT_TRUE(methods["get"]["responses"]["200"]["content"].contains(type)) << target << " " << type;
    const Answer head = caller.head(target);
    EXPECT_EQ(head.status, 200) << target;
    EXPECT_EQ(head.header("Content-Type"), answer.header("Content-Type"));
    EXPECT_EQ(head.body, "");
  }
}

TEST_F(Service, AParameterGivenTwiceIsRefused) {
  for (const char* target : {"/v1/jobs?limit=1&limit=2", "/v1/domains?cursor=a&limit=1&cursor=a",
                             "/v1/operations/generate?x=1&x=1"}) {
    const Answer answer = caller.get(target);
    EXPECT_EQ(answer.status, 422) << target;
    EXPECT_THAT(answer.body, ::testing::HasSubstr("given twice; give it once")) << target;
  }
  const Answer answer = caller.post(
      "/v1/domains?allow_self_intersections=true&allow_self_intersections=false", "OFF\n", {}, "model/off");
  EXPECT_EQ(answer.parsed()["errors"][0]["pointer"], "/allow_self_intersections");
}

TEST_F(Service, UnknownPathsAndMethodsAreProblems) {
  const Answer nothing = caller.get("/v2/generate");
  EXPECT_EQ(nothing.status, 404);
  EXPECT_EQ(nothing.problem(), "not-found");
  const Answer wrong = caller.get("/v1/generate");
  EXPECT_EQ(wrong.status, 405);
  EXPECT_EQ(wrong.problem(), "method-not-allowed");
  EXPECT_THAT(wrong.header("Allow"), HasSubstr("POST"));
}

TEST_F(Service, MetricsAreValidPrometheusText) {
  const std::string id = caller.submit("generate", R"({"count":50})");
  caller.finished(id);
  caller.get("/v1/jobs/" + id);
  caller.get("/v1/jobs/nonsense");
  caller.get("/nonsense/" + id);
  const Answer answer = caller.get("/metrics");
  EXPECT_THAT(answer.header("Content-Type"), StartsWith("text/plain; version=0.0.4"));
  const std::regex comment("# (HELP|TYPE) [a-z_:]+ .+");
  const std::regex sample(R"RE([a-z_:]+(\{[a-z_]+="[^"\n]*"(,[a-z_]+="[^"\n]*")*\})? [0-9.+e-]+)RE");
  std::istringstream lines(answer.body);
  std::set<std::string> typed;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(std::regex_match(line, line.starts_with("#") ? comment : sample)) << line;
    if (line.starts_with("# TYPE ")) {
      EXPECT_TRUE(typed.insert(line.substr(0, line.rfind(' '))).second) << line;
    }
  }
  EXPECT_EQ(answer.body.find(id), std::string::npos) << "an id is in a label";
  EXPECT_EQ(answer.body.find("nonsense"), std::string::npos) << "a client's word is in a label";
  EXPECT_EQ(caller.metric("wellspaced_jobs_submitted_total{operation=\"generate\"}"), 1);
  EXPECT_EQ(caller.metric("wellspaced_jobs_finished_total{operation=\"generate\",status=\"successful\"}"), 1);
  EXPECT_GE(caller.metric("wellspaced_points_generated_total"), 25);
}

TEST_F(Service, MetricsNameTheRouteOfRefusedRequestsToo) {
  caller.post("/v1/generate", R"({"count":0})");
  caller.get("/v1/jobs/nonsense");
  const std::string refused =
      "wellspaced_http_requests_total{route=\"/v1/generate\",method=\"POST\",code=\"422\"}";
  const std::string unknown =
      "wellspaced_http_requests_total{route=\"/v1/jobs/{id}\",method=\"GET\",code=\"404\"}";
  // An exchange is counted when its last byte is out, which the client may see first.
  EXPECT_TRUE(http::test::eventually([&] { return caller.metric(refused) == 1; }));
  EXPECT_TRUE(http::test::eventually([&] { return caller.metric(unknown) == 1; }));
  EXPECT_EQ(caller.metric("wellspaced_rejected_total{reason=\"invalid-parameters\"}"), 1);
}

TEST_F(Service, ProbesAnswer) {
  EXPECT_EQ(caller.get("/livez").status, 200);
  EXPECT_EQ(caller.get("/readyz").status, 200);
  EXPECT_THAT(caller.get("/readyz?verbose").body, HasSubstr("[ok] store"));
  EXPECT_EQ(caller.get("/version").parsed()["version"], std::string(version()));
  EXPECT_THAT(caller.get("/").body, HasSubstr("/v1/generate"));
}

TEST_F(Service, ARequestIdIsEchoed) {
  EXPECT_EQ(caller.get("/livez", {{"X-Request-Id", "abc-123"}}).header("X-Request-Id"), "abc-123");
  const Answer problem = caller.get("/nothing", {{"X-Request-Id", "abc-124"}});
  EXPECT_EQ(problem.parsed()["request_id"], "abc-124");
}

}  // namespace
}  // namespace wellspaced
