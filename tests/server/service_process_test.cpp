// The real program: kill -9, SIGTERM, its flags, its log, and `wellspaced run`.
#include <csignal>
#include <filesystem>
#include <future>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include "proto/result.h"
#include "server/log.h"
#include "tests/server/raw_client.h"
#include "tests/support/server_app.h"

namespace wellspaced {
namespace {

using http::test::eventually;
using nlohmann::json;
using support::Answer;
using support::Caller;
using support::endless_request;
using support::optimize_request;
using support::Process;
using support::TemporaryDirectory;
using testing::HasSubstr;

struct ServiceProcess : testing::Test {
  TemporaryDirectory directory;

  std::vector<std::string> serve(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {
        "serve", "--listen", "127.0.0.1:0", "--store", directory / "jobs.db", "--threads", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  std::string file(const std::string& name, const std::string& text) const {
    support::write_file(directory / name, text);
    return directory / name;
  }
};

void expect_json_lines(const std::string& log) {
  std::istringstream lines(log);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const json entry = json::parse(line, nullptr, false);
    ASSERT_TRUE(entry.is_object()) << line;
    for (const char* key : {"time", "level", "message"}) EXPECT_TRUE(entry.contains(key)) << line;
  }
  EXPECT_GT(count, 0);
}

TEST_F(ServiceProcess, EveryAcknowledgedJobSurvivesAKill) {
  const std::string body = optimize_request(2000, 0.7, 60);
  std::vector<std::string> ids;
  {
    Process first(serve({"--workers", "1"}));
    const Caller caller(first.port());
    for (int k = 0; k < 3; ++k) ids.push_back(caller.submit("optimize", body));
    ids.push_back(caller.submit("generate", R"({"count":500,"seed":3})"));
    ASSERT_TRUE(caller.running(ids.front()));
    first.signal(SIGKILL);
    EXPECT_EQ(first.wait(), 128 + SIGKILL);
  }
  Process second(serve());
  const Caller caller(second.port());
  for (const std::string& id : ids) EXPECT_EQ(caller.finished(id)["status"], "successful") << id;
  EXPECT_EQ(caller.status(ids.front())["attempt"], 2);
  EXPECT_EQ(caller.status(ids.back())["attempt"], 1);
  const std::string expected = caller.post("/v1/optimize", body).body;
  ASSERT_THAT(expected, HasSubstr("\"points\""));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(caller.get("/v1/jobs/" + ids[k] + "/result").body, expected);
  EXPECT_TRUE(caller.idle());
}

TEST_F(ServiceProcess, AStopFinishesRequestsUnderWayAndKeepsJobsForTheNextStart) {
  Process first(serve({"--workers", "2", "--drain-seconds", "1", "--sync-seconds", "100000"}));
  const Caller caller(first.port());
  const std::string id = caller.submit("optimize", endless_request());
  ASSERT_TRUE(caller.running(id));
  auto sync = std::async(std::launch::async,
                         [&] { return caller.post("/v1/optimize", optimize_request(3000, 0.6, 15)); });
  ASSERT_TRUE(eventually([&] { return caller.metric("wellspaced_jobs_running") == 2; }));
  first.signal(SIGTERM);
  // The signal needs a moment; from then on it must not be ready.
  EXPECT_TRUE(eventually([&] { return caller.get("/readyz").status != 200; }));
  const Answer answer = sync.get();
  EXPECT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(first.wait(), 0);
  expect_json_lines(first.err());

  Process second(serve());
  const Caller next(second.port());
  ASSERT_TRUE(next.running(id));
  EXPECT_EQ(next.status(id)["attempt"], 2);
  EXPECT_EQ(next.remove("/v1/jobs/" + id).status, 200);
  EXPECT_EQ(next.finished(id)["status"], "dismissed");
}

TEST_F(ServiceProcess, ASignalWithNothingToDoEndsItAtOnce) {
  for (const int number : {SIGTERM, SIGINT}) {
    Process process(serve({"--drain-seconds", "0"}));
    ASSERT_NE(process.port(), 0);
    process.signal(number);
    EXPECT_EQ(process.wait(), 0);
  }
}

TEST_F(ServiceProcess, LogsOneJsonObjectALineWhateverClientsSend) {
  Process process(serve({"--drain-seconds", "0"}));
  const Caller caller(process.port());
  caller.get("/nothing?\"quoted\\",
             {{"traceparent", "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01"}});
  http::test::RawClient raw(process.port());
  raw.ask("GET /%ff%0a{\"a\":1} HTTP/1.1\r\nHost: x\r\n\r\n");
  caller.post("/v1/generate", R"({"count":50})", {{"X-Request-Id", "find-me"}});
  caller.finished(caller.submit("generate", R"({"count":50})"));
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
  expect_json_lines(process.err());
  EXPECT_THAT(process.err(), HasSubstr("\"request_id\":\"find-me\""));
  EXPECT_THAT(process.err(), HasSubstr("0af7651916cd43dd8448eb211c80319c"));
  EXPECT_EQ(process.out(), "");
}

TEST(Log, MessagesOfOtherPartsBecomeJsonToo) {
  testing::internal::CaptureStderr();
  start_log("info");
  spdlog::warn("job {} said \"no\\way\"\n", 7);
  log_info("mine", {{"key", "value \xff"}});
  spdlog::info("\"message\":\"a trap\"");
  flush_log();
  const std::string text = testing::internal::GetCapturedStderr();
  start_log("off");
  expect_json_lines(text);
  EXPECT_THAT(text, HasSubstr(R"("message":"job 7 said \"no\\way\"\n")"));
  EXPECT_THAT(text, HasSubstr(R"("message":"mine","key":"value)"));
}

TEST_F(ServiceProcess, ASecondServerOnTheSamePortSaysSo) {
  Process first(serve());
  const std::string address = "127.0.0.1:" + std::to_string(first.port());
  Process second({"serve", "--listen", address, "--store", directory / "other.db"});
  EXPECT_NE(second.wait(), 0);
  EXPECT_THAT(second.err(), HasSubstr(std::to_string(first.port())));
}

TEST_F(ServiceProcess, TwoServersShareAStore) {
  Process first(serve({"--workers", "1"}));
  Process second(serve({"--workers", "1"}));
  const Caller one(first.port()), two(second.port());
  const std::string id = one.submit("generate", R"({"count":50})");
  EXPECT_EQ(two.finished(id)["status"], "successful");
  EXPECT_EQ(two.get("/v1/jobs/" + id + "/result").body, one.get("/v1/jobs/" + id + "/result").body);
}

TEST_F(ServiceProcess, AStoreThatCannotBeUsedIsNamed) {
  const std::string blocker = file("file", "");
  Process process({"serve", "--listen", "127.0.0.1:0", "--store", blocker + "/jobs.db"});
  EXPECT_NE(process.wait(), 0);
  EXPECT_THAT(process.err(), HasSubstr(blocker));
}

TEST_F(ServiceProcess, HealthcheckTellsByItsExitCode) {
  Process server(serve());
  const std::string address = "127.0.0.1:" + std::to_string(server.port());
  EXPECT_EQ(Process({"--healthcheck", "--listen", address}).wait(), 0) << "also without HOME";
  EXPECT_EQ(Process({"--healthcheck"}, {{"WELLSPACED_LISTEN", address}}).wait(), 0);
  server.signal(SIGKILL);
  server.wait();
  EXPECT_EQ(Process({"--healthcheck", "--listen", address}).wait(), 1);
}

TEST_F(ServiceProcess, PrintsItsVersionAndItsDescription) {
  Process version_of({"--version"});
  EXPECT_EQ(version_of.wait(), 0);
  EXPECT_EQ(version_of.out(), "wellspaced " + std::string(version()) + "\n");
  Process openapi({"--print-openapi"});
  EXPECT_EQ(openapi.wait(), 0);
  Process server(serve());
  EXPECT_EQ(openapi.out(), Caller(server.port()).get("/openapi.json").body);
}

/// The limit on points that --print-openapi tells.
std::string points_told(const std::vector<std::string>& flags, const Process::Environment& environment) {
  std::vector<std::string> arguments = {"--print-openapi"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  Process process(arguments, environment);
  EXPECT_EQ(process.wait(), 0) << process.err();
  const std::string text = json::parse(process.out(), nullptr, false)["info"].value("description", "");
  return text.substr(text.rfind("bytes, ") + 7);
}

TEST_F(ServiceProcess, AFlagWinsOverTheEnvironmentAndThatOverTheFile) {
  const std::string config = file("config.toml", "generate-limit = 111\n");
  const Process::Environment environment = {{"WELLSPACED_GENERATE_LIMIT", "222"}};
  EXPECT_EQ(points_told({}, {}), "10000000 points.");
  EXPECT_EQ(points_told({"--config", config}, {}), "111 points.");
  EXPECT_EQ(points_told({}, {{"WELLSPACED_CONFIG", config}}), "111 points.");
  EXPECT_EQ(points_told({"--config", config}, {{"WELLSPACED_CONFIG", directory / "absent.toml"}}),
            "111 points.");
  EXPECT_EQ(points_told({"--config", config}, environment), "222 points.");
  EXPECT_EQ(points_told({"--config", config, "--generate-limit", "333"}, environment), "333 points.");
}

TEST_F(ServiceProcess, BadSettingsAreRefusedByName) {
  const std::string store = directory / "jobs.db";
  const struct {
    std::vector<std::string> arguments;
    std::string told;
  } rows[] = {
      {{"--config", file("unknown.toml", "generate-limits = 111\n")}, "generate-limits"},
      {{"--config", file("wrong.toml", "generate-limit = \"many\"\n")}, "generate-limit"},
      {{"--config", directory / "absent.toml"}, "absent.toml"},
      {{"--workers", "-1"}, "--workers"},
      {{"--workers", "many"}, "--workers"},
      {{"--queue-limit", "0"}, "--queue-limit"},
      {{"--sync-seconds", "-1"}, "--sync-seconds"},
      {{"--sync-seconds", "nan"}, "--sync-seconds"},
      {{"--log-level", "loud"}, "--log-level"},
      {{"--listen", "8080"}, "--listen"},
      {{"--listen", "127.0.0.1:99999"}, "--listen"},
      {{"--listen", "0.0.0.0:8080"}, "--allow-public"},
      {{"--listen", ":8080"}, "--allow-public"},
      {{"--listen", "[::]:8080"}, "--allow-public"},
      {{"--no-such-flag"}, "--no-such-flag"},
  };
  for (const auto& row : rows) {
    std::vector<std::string> arguments = {"--check-config", "--store", store};
    arguments.insert(arguments.end(), row.arguments.begin(), row.arguments.end());
    Process process(arguments);
    EXPECT_NE(process.wait(), 0) << row.arguments.back();
    EXPECT_THAT(process.err(), HasSubstr(row.told));
  }
  Process from_environment({"--check-config", "--store", store}, {{"WELLSPACED_WORKERS", "many"}});
  EXPECT_NE(from_environment.wait(), 0);
  EXPECT_THAT(from_environment.err(), HasSubstr("--workers"));
  const Process::Environment flags = {{"WELLSPACED_ALLOW_PUBLIC", "true"},
                                      {"WELLSPACED_LISTEN", ":80"},
                                      {"WELLSPACED_PORT", "tcp://1.2.3.4"}};
  EXPECT_EQ(Process({"--check-config", "--store", store}, flags).wait(), 0);
  EXPECT_EQ(Process({"--check-config", "--store", store}).wait(), 0);
  EXPECT_EQ(Process({"--check-config", "--store", store, "--listen", "0.0.0.0:80", "--allow-public"}).wait(),
            0);
  EXPECT_NE(Process({"--check-config"}).wait(), 0) << "without HOME there is no place for the store";
  EXPECT_EQ(Process({"--check-config"}, {{"HOME", directory / ""}}).wait(), 0);
  EXPECT_FALSE(std::filesystem::exists(store)) << "a check changes nothing";
}

TEST_F(ServiceProcess, RunReadsStandardInputAndWritesStandardOutput) {
  Process process({"run", "generate", "-", "-o", "-", "--format", "csv"}, {},
                  R"({"method":"white-noise","count":10})");
  EXPECT_EQ(process.wait(), 0) << process.err();
  const std::string text = process.out();
  EXPECT_GE(std::count(text.begin(), text.end(), '\n'), 10);
}

TEST_F(ServiceProcess, RunTakesPointsFromAnotherRunsFile) {
  const std::string request = file("request.json", R"({"count":200})"), points = directory / "points.npy";
  EXPECT_EQ(Process({"run", "generate", request, "-o", points}).wait(), 0);
  Process process({"run", "optimize", points, "-o", directory / "better.csv", "--query",
                   "method=opt-beta-local", "--query", "max_sweeps=3"});
  EXPECT_EQ(process.wait(), 0) << process.err();
  EXPECT_GT(support::read_file(directory / "better.csv").size(), 1000u);
}

TEST_F(ServiceProcess, RunTellsWhatIsWrongAndLeavesNoOutput) {
  const std::string request = file("request.json", R"({"count":200})"), output = directory / "out.json";
  Process bad({"run", "generate", file("bad.json", R"({"count":0})"), "-o", output});
  EXPECT_EQ(bad.wait(), 1);
  EXPECT_EQ(json::parse(bad.err(), nullptr, false)["errors"][0]["pointer"], "/count");
  EXPECT_FALSE(std::filesystem::exists(output));
  Process absent({"run", "generate", directory / "absent.json", "-o", output});
  EXPECT_EQ(absent.wait(), 2);
  EXPECT_THAT(absent.err(), HasSubstr("absent.json"));
  Process folder({"run", "generate", directory / "", "-o", output});
  EXPECT_EQ(folder.wait(), 2);
  EXPECT_THAT(folder.err(), HasSubstr("can't read"));
  Process nowhere({"run", "generate", request, "-o", directory / "no/out.json"});
  EXPECT_EQ(nowhere.wait(), 2);
  Process strange({"run", "generate", request, "-o", directory / "out.pdf"});
  EXPECT_EQ(strange.wait(), 2);
  EXPECT_THAT(strange.err(), HasSubstr("out.pdf' is none of json, npy, csv, svg"));
  Process unknown({"run", "generate", request, "-o", output, "--format", "pdf"});
  EXPECT_EQ(unknown.wait(), 2);
  EXPECT_THAT(unknown.err(), HasSubstr("--format: 'pdf'"));
  Process unnamed({"run", "generate", request, "-o", directory / "out"});
  EXPECT_EQ(unnamed.wait(), 0) << "no ending means the default format" << unnamed.err();
  Process chained({"run", "analyze", file("chained.json", R"({"points":{"job":"x"}})"), "-o", output});
  EXPECT_EQ(chained.wait(), 1);
  EXPECT_THAT(chained.err(), HasSubstr("/points/job"));
}

}  // namespace
}  // namespace wellspaced
