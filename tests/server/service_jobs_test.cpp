// The life of a job, as a client sees it.
#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/server/raw_client.h"
#include "tests/support/server_app.h"

namespace wellspaced {
namespace {

using http::test::eventually;
using http::test::RawClient;
using nlohmann::json;
using support::Answer;
using support::Caller;
using support::endless_request;
using support::optimize_request;
using support::ServedApp;
using testing::HasSubstr;
using testing::StartsWith;

void accept_any_sync(Config& config) { config.limits.sync_seconds = 1e9; }
void one_worker(Config& config) {
  config.workers = 1;
  config.limits.sync_seconds = 1e9;
}

struct ServiceJobs : testing::Test {
  ServedApp app{accept_any_sync};
  Caller caller{app.port()};
};

const support::HeaderList async_headers = {{"Prefer", "respond-async"}};

std::string post_text(const std::string& target, const std::string& body, const std::string& more = "") {
  return "POST " + target + " HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n" + more +
         "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

TEST_F(ServiceJobs, AnAsynchronousRequestGetsItsJobAtOnceAndTheResultLater) {
  const Answer taken = caller.post("/v1/generate", R"({"count":200})", async_headers);
  ASSERT_EQ(taken.status, 202) << taken.body;
  const std::string id = taken.parsed().value("id", "");
  EXPECT_EQ(taken.header("Location"), "/v1/jobs/" + id);
  EXPECT_NE(taken.header("Retry-After"), "");
  EXPECT_EQ(taken.header("Preference-Applied"), "respond-async");
  EXPECT_THAT(taken.header("Vary"), HasSubstr("Prefer"));

  const json job = caller.finished(id);
  EXPECT_EQ(job["id"], id);
  EXPECT_EQ(job["operation"], "generate");
  EXPECT_EQ(job["status"], "successful");
  EXPECT_EQ(job["progress"], 1.0);
  EXPECT_EQ(job["attempt"], 1);
  for (const char* time : {"created", "started", "updated", "finished", "expires"})
    EXPECT_THAT(job.value(time, ""), testing::MatchesRegex("20..-..-..T..:..:..\\....Z")) << time;
  EXPECT_FALSE(job.contains("problem"));
  const json& link = job["links"].back();
  EXPECT_EQ(link["rel"], "result");
  EXPECT_EQ(caller.get(link["href"].get<std::string>()).status, 200);
}

TEST_F(ServiceJobs, AnUnknownJobIsAProblemOnEveryPath) {
  const std::string unknown = "/v1/jobs/01h00000000000000000000000000000000000";
  for (const Answer& answer :
       {caller.get(unknown), caller.get(unknown + "/result"), caller.get(unknown + "/events"),
        caller.remove(unknown), caller.remove(unknown + "?purge=true")}) {
    EXPECT_EQ(answer.status, 404);
    EXPECT_EQ(answer.problem(), "no-such-job");
  }
}

TEST_F(ServiceJobs, AResultAskedForTooEarlyIsNotReady) {
  const std::string id = caller.submit("optimize", endless_request());
  const Answer answer = caller.get("/v1/jobs/" + id + "/result");
  EXPECT_EQ(answer.status, 404);
  EXPECT_EQ(answer.problem(), "result-not-ready");
  EXPECT_NE(answer.header("Retry-After"), "");
  const Answer chained = caller.post("/v1/analyze", R"({"points":{"job":")" + id + "\"}}");
  EXPECT_EQ(chained.problem(), "result-not-ready");
  EXPECT_EQ(chained.pointer(), "/points/job");
}

TEST_F(ServiceJobs, DeleteStopsARunningJobWithinASecond) {
  const std::string id = caller.submit("optimize", endless_request());
  ASSERT_TRUE(caller.running(id));
  const auto asked = std::chrono::steady_clock::now();
  const Answer answer = caller.remove("/v1/jobs/" + id);
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(caller.finished(id)["status"], "dismissed");
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(1));
#else
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(10));
#endif
  EXPECT_TRUE(caller.idle());
  const Answer result = caller.get("/v1/jobs/" + id + "/result");
  EXPECT_EQ(result.status, 409);
  EXPECT_EQ(result.problem(), "cancelled");
}

TEST_F(ServiceJobs, DeleteOfAFinishedJobNeedsPurge) {
  const std::string id = caller.submit("generate", R"({"count":50})");
  ASSERT_EQ(caller.finished(id)["status"], "successful");
  const Answer kept = caller.remove("/v1/jobs/" + id);
  EXPECT_EQ(kept.status, 409);
  EXPECT_EQ(kept.problem(), "conflict");
  EXPECT_EQ(caller.get("/v1/jobs/" + id + "/result").status, 200);
  for (const char* wrong : {"?purge=maybe", "?purge=", "?purge=true&purge=true"}) {
    EXPECT_EQ(caller.remove("/v1/jobs/" + id + wrong).status, 422) << wrong;
    EXPECT_EQ(caller.remove("/v1/jobs/" + id + wrong).pointer(), "/purge") << wrong;
  }
  EXPECT_EQ(caller.remove("/v1/jobs/" + id + "?now=1").pointer(), "/now");
  EXPECT_EQ(caller.remove("/v1/jobs/" + id + "?purge=true").status, 204);
  EXPECT_EQ(caller.get("/v1/jobs/" + id).problem(), "no-such-job");
}

TEST(ServiceJobQueue, AResultThatAWaitingJobNeedsCanNotBePurged) {
  const ServedApp busy(one_worker);
  const Caller busy_caller(busy.port());
  const std::string source = busy_caller.submit("generate", R"({"count":50})");
  ASSERT_EQ(busy_caller.finished(source)["status"], "successful");
  const std::string running = busy_caller.submit("optimize", endless_request());
  const std::string user = busy_caller.submit("analyze", R"({"points":{"job":")" + source + "\"}}");
  const Answer kept = busy_caller.remove("/v1/jobs/" + source + "?purge=true");
  EXPECT_EQ(kept.status, 409);
  EXPECT_THAT(kept.body, HasSubstr(user));
  busy_caller.remove("/v1/jobs/" + running);
  EXPECT_EQ(busy_caller.finished(user)["status"], "successful");
  EXPECT_EQ(busy_caller.remove("/v1/jobs/" + source + "?purge=true").status, 204);
}

TEST(ServiceJobQueue, WorkThatSomebodyWaitsForIsNotBehindLongJobs) {
  const ServedApp busy(one_worker);
  const Caller busy_caller(busy.port());
  for (int k = 0; k < 3; ++k) busy_caller.submit("optimize", endless_request());
  ASSERT_TRUE(eventually([&] { return busy_caller.metric("wellspaced_jobs_running") == 1; }));
  EXPECT_EQ(busy_caller.post("/v1/generate", R"({"count":50})").status, 200);
  EXPECT_EQ(busy_caller.metric("wellspaced_jobs_running"), 1);
}

TEST_F(ServiceJobs, ListsByPagesFromTheNewest) {
  std::vector<std::string> ids;
  for (int k = 0; k < 5; ++k) ids.insert(ids.begin(), caller.submit("generate", R"({"count":20})"));
  for (const std::string& id : ids) caller.finished(id);
  std::vector<std::string> listed;
  std::string target = "/v1/jobs?limit=2&operation=generate&status=successful";
  for (int page = 0; page < 4 && !target.empty(); ++page) {
    const Answer answer = caller.get(target);
    ASSERT_EQ(answer.status, 200) << answer.body;
    const json jobs = answer.parsed()["jobs"];
    for (const json& job : jobs) listed.push_back(job["id"]);
    const std::string link = answer.header("Link");
    target = link.empty() ? "" : link.substr(1, link.find('>') - 1);
    EXPECT_THAT(link, testing::AnyOf("", HasSubstr("rel=\"next\"")));
  }
  EXPECT_EQ(listed, ids);
  EXPECT_EQ(caller.get("/v1/jobs?operation=analyze").parsed()["jobs"].size(), 0u);
  EXPECT_EQ(caller.get("/v1/jobs?status=failed").parsed()["jobs"].size(), 0u);
}

TEST_F(ServiceJobs, BadFiltersNameTheParameter) {
  for (const std::string parameter :
       {"limit=0", "limit=501", "limit=x", "status=done", "color=red", "cursor=x", "operation=bake"}) {
    const Answer answer = caller.get("/v1/jobs?" + parameter);
    EXPECT_EQ(answer.status, 422) << parameter;
    EXPECT_EQ(answer.problem(), "invalid-parameters");
    EXPECT_EQ(answer.pointer(), "/" + parameter.substr(0, parameter.find('=')));
  }
}

TEST_F(ServiceJobs, EventsTellProgressAndTheEndAndReplayFromTheLastSeen) {
  const std::string id = caller.submit("optimize", endless_request());
  ASSERT_TRUE(caller.running(id));
  RawClient stream(app.port());
  stream.say("GET /v1/jobs/" + id + "/events HTTP/1.1\r\nHost: x\r\n\r\n");
  ASSERT_TRUE(stream.hear("retry: 2000\n\nevent: status\nid: ")) << stream.received();
  EXPECT_THAT(stream.received(), HasSubstr("text/event-stream"));
  EXPECT_THAT(stream.received(), HasSubstr("X-Accel-Buffering: no"));
  ASSERT_TRUE(stream.hear("event: progress\n")) << stream.received();
  ASSERT_TRUE(stream.hear("\"beta\":")) << stream.received();
  EXPECT_THAT(stream.received(), HasSubstr("\"status\":\"running\""));
  caller.remove("/v1/jobs/" + id);
  ASSERT_TRUE(stream.hear("event: done\n")) << stream.received();
  EXPECT_TRUE(eventually([&] { return stream.has_news(std::chrono::milliseconds(10)); }))
      << "the stream goes on";

  const std::string path = "/v1/jobs/" + id + "/events";
  const Answer whole = caller.get(path, {{"Last-Event-ID", "0"}});
  ASSERT_EQ(whole.status, 200);
  std::string last;
  int expected = 0;
  for (std::size_t at = whole.body.find("id: "); at != std::string::npos;
       at = whole.body.find("\nid: ", at + 1)) {
    last = std::to_string(std::stoi(whole.body.substr(whole.body.find("id: ", at) + 4)));
    EXPECT_EQ(last, std::to_string(++expected)) << "events are numbered without gaps";
  }
  EXPECT_GE(expected, 4);
  EXPECT_EQ(caller.get(path, {{"Last-Event-ID", last}}).status, 204);
  const Answer tail = caller.get(path, {{"Last-Event-ID", std::to_string(expected - 1)}});
  EXPECT_THAT(tail.body, HasSubstr("event: done\nid: " + last + "\n"));
  EXPECT_EQ(tail.body.find("event: progress"), std::string::npos);
  const Answer fresh = caller.get(path);
  EXPECT_THAT(fresh.body, HasSubstr("\"status\":\"dismissed\""));
  EXPECT_THAT(fresh.body, HasSubstr("event: done"));
}

TEST_F(ServiceJobs, ResultsHaveTagsAndRangesAndHeads) {
  const std::string id = caller.submit("generate", R"({"count":200})");
  ASSERT_EQ(caller.finished(id)["status"], "successful");
  const std::string path = "/v1/jobs/" + id + "/result";
  const Answer whole = caller.get(path, {{"Accept", "application/x-npy"}});
  ASSERT_EQ(whole.status, 200);
  EXPECT_EQ(whole.header("Content-Type"), "application/x-npy");
  const std::string tag = whole.header("ETag");
  EXPECT_THAT(tag, StartsWith("\""));
  EXPECT_NE(caller.get(path + "?format=csv").header("ETag"), tag);
  std::set<std::string> pictures;
  for (const char* query : {"?format=svg", "?format=svg&picture=delaunay", "?format=svg&picture=points",
                            "?format=svg&picture=points&picture.color=area", "?format=png&picture=points"})
    EXPECT_TRUE(pictures.insert(caller.get(path + query).header("ETag")).second) << query;
  EXPECT_EQ(caller.get(path + "?format=npy", {{"If-None-Match", tag}}).status, 304);
  EXPECT_EQ(caller.get(path + "?format=csv", {{"If-None-Match", tag}}).status, 200);
  const Answer head = caller.head(path + "?format=npy");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.header("ETag"), tag);
  EXPECT_EQ(head.header("Content-Length"), std::to_string(whole.body.size()));

  const Answer part = caller.get(path + "?format=npy", {{"Range", "bytes=6-9"}});
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, whole.body.substr(6, 4));
  EXPECT_EQ(part.header("Content-Range"), "bytes 6-9/" + std::to_string(whole.body.size()));
  const Answer stale = caller.get(path + "?format=npy", {{"Range", "bytes=6-9"}, {"If-Range", "\"other\""}});
  EXPECT_EQ(stale.status, 200);
  const Answer beyond = caller.get(path + "?format=npy", {{"Range", "bytes=99999999-"}});
  EXPECT_EQ(beyond.status, 416);
  EXPECT_EQ(beyond.problem(), "range-not-satisfiable");
  EXPECT_EQ(caller.get(path + "?format=pdf").problem(), "not-acceptable");
}

TEST_F(ServiceJobs, AJobsPointsFeedTheNextRequestAsynchronousOrNot) {
  const std::string made = caller.submit("generate", R"({"count":300,"seed":5})");
  ASSERT_EQ(caller.finished(made)["status"], "successful");
  const Answer chained = caller.post(
      "/v1/optimize", R"({"method":"opt-beta-local","max_sweeps":3,"points":{"job":")" + made + "\"}}");
  ASSERT_EQ(chained.status, 200) << chained.body;
  const Answer direct = caller.post(
      "/v1/optimize",
      R"({"method":"opt-beta-local","max_sweeps":3,"points":{"generate":{"count":300,"seed":5}}})");
  EXPECT_EQ(chained.parsed()["points"], direct.parsed()["points"]);
  const std::string synchronous = chained.header("Wellspaced-Job");
  const Answer measured = caller.post("/v1/analyze", R"({"points":{"job":")" + synchronous + "\"}}");
  ASSERT_EQ(measured.status, 200) << measured.body;
  EXPECT_THAT(measured.body, HasSubstr("\"beta\":" + chained.parsed()["beta"].dump()));
}

TEST_F(ServiceJobs, PreferWaitGivesTheResultWhenItIsReadyInTime) {
  const Answer quick = caller.post("/v1/generate", R"({"count":50})", {{"Prefer", "respond-async, wait=30"}});
  EXPECT_EQ(quick.status, 200) << quick.body;
  EXPECT_EQ(quick.parsed()["points"].is_array(), true);
  const Answer slow =
      caller.post("/v1/optimize", endless_request(), {{"Prefer", "wait=0"}, {"Prefer", "respond-async"}});
  EXPECT_EQ(slow.status, 202) << slow.body;
  const std::string id = slow.parsed().value("id", "");
  EXPECT_EQ(caller.get("/v1/jobs/" + id, {{"Prefer", "wait=0"}}).status, 200);
  EXPECT_EQ(caller.post("/v1/generate", R"({"count":50})", {{"Prefer", "handling=lenient"}}).status, 200);
}

TEST_F(ServiceJobs, AWaitForAJobEndsWithTheJob) {
  const std::string id = caller.submit("optimize", endless_request());
  ASSERT_TRUE(caller.running(id));
  RawClient waiting(app.port());
  waiting.say("GET /v1/jobs/" + id + " HTTP/1.1\r\nHost: x\r\nPrefer: wait=60\r\n\r\n");
  EXPECT_EQ(caller.remove("/v1/jobs/" + id).status, 200);
  const auto answer = waiting.response();
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(json::parse(answer.body, nullptr, false).value("status", ""), "dismissed");
}

TEST_F(ServiceJobs, ASynchronousClientThatLeavesCancelsItsComputation) {
  RawClient client(app.port());
  client.say(post_text("/v1/optimize", endless_request()));
  ASSERT_TRUE(eventually([&] { return caller.metric("wellspaced_jobs_running") == 1; }));
  client.close();
  EXPECT_TRUE(caller.idle());
  const json jobs = caller.get("/v1/jobs").parsed()["jobs"];
  ASSERT_EQ(jobs.size(), 1u);
  EXPECT_EQ(jobs[0]["status"], "dismissed");
}

TEST_F(ServiceJobs, AnAsynchronousClientThatLeavesDoesNot) {
  RawClient client(app.port());
  client.say(post_text("/v1/optimize", endless_request(), "Prefer: respond-async, wait=60\r\n"));
  ASSERT_TRUE(eventually([&] { return caller.metric("wellspaced_jobs_running") == 1; }));
  client.close();
  const std::string left =
      "wellspaced_http_requests_total{route=\"/v1/optimize\",method=\"POST\",code=\"499\"}";
  ASSERT_TRUE(eventually([&] { return caller.metric(left) == 1; }));
  EXPECT_EQ(caller.get("/v1/jobs?status=running").parsed()["jobs"].size(), 1u);
}

TEST_F(ServiceJobs, ProbesAnswerWhileEveryWorkerIsBusy) {
  for (int k = 0; k < 3; ++k) caller.submit("optimize", endless_request());
  ASSERT_TRUE(eventually([&] { return caller.metric("wellspaced_jobs_running") == 2; }));
  EXPECT_EQ(caller.get("/livez").status, 200);
  EXPECT_EQ(caller.get("/readyz").status, 200);
  const json waiting = caller.get("/v1/jobs?status=accepted").parsed()["jobs"];
  ASSERT_EQ(waiting.size(), 1u);
  EXPECT_EQ(waiting[0]["queue"]["position"], 1);
}

TEST(ServiceJobLimits, AFullQueueRefusesAtOnceAndSaysWhenToComeBack) {
  ServedApp app([](Config& config) {
    one_worker(config);
    config.jobs.queue = 1;
  });
  const Caller caller(app.port());
  ASSERT_TRUE(caller.running(caller.submit("optimize", endless_request())));
  caller.submit("optimize", endless_request());
  for (const char* preference : {"respond-async", "handling=strict"}) {
    const Answer refused = caller.post("/v1/generate", R"({"count":50})", {{"Prefer", preference}});
    EXPECT_EQ(refused.status, 503);
    EXPECT_EQ(refused.problem(), "overloaded");
    EXPECT_NE(refused.header("Retry-After"), "");
  }
}

TEST(ServiceJobLimits, LiveJobsOfAnOwnerAreLimited) {
  ServedApp app([](Config& config) {
    one_worker(config);
    config.jobs.live_per_owner = 2;
  });
  const Caller caller(app.port());
  const std::string first = caller.submit("optimize", endless_request());
  caller.submit("optimize", endless_request());
  const Answer refused = caller.post("/v1/generate", R"({"count":50})", {{"Prefer", "respond-async"}});
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(refused.problem(), "too-many-jobs");
  EXPECT_NE(refused.header("Retry-After"), "");
  caller.remove("/v1/jobs/" + first);
  caller.finished(first);
  EXPECT_NE(caller.submit("generate", R"({"count":50})"), "");
}

TEST(ServiceJobLimits, AJobOverItsTimeFailsWithItsProblem) {
  ServedApp app([](Config& config) {
    accept_any_sync(config);
    config.job_limit_seconds = 1;
  });
  const Caller caller(app.port());
  const Answer sync = caller.post("/v1/optimize", endless_request());
  EXPECT_EQ(sync.status, 504) << sync.body;
  EXPECT_EQ(sync.problem(), "deadline-exceeded");
  const std::string id = sync.header("Wellspaced-Job");
  const json jobs = caller.get("/v1/jobs?status=failed").parsed()["jobs"];
  ASSERT_EQ(jobs.size(), 1u);
  EXPECT_EQ(jobs[0]["problem"]["status"], 504);
  EXPECT_EQ(caller.get("/v1/jobs/" + jobs[0].value("id", "") + "/result").problem(), "deadline-exceeded");
}

TEST(ServiceDrain, NewWorkIsRefusedAndThoseWhoWaitGetTheirJobsState) {
  ServedApp app([](Config& config) {
    accept_any_sync(config);
    config.drain_seconds = 3;
  });
  const Caller caller(app.port());
  const std::string id = caller.submit("optimize", endless_request());
  ASSERT_TRUE(caller.running(id));
  RawClient waiting(app.port());
  waiting.say("GET /v1/jobs/" + id + " HTTP/1.1\r\nHost: x\r\nPrefer: wait=60\r\n\r\n");
  app.stop();
  const Answer ready = caller.get("/readyz");
  EXPECT_EQ(ready.status, 503);
  EXPECT_EQ(ready.problem(), "draining");
  EXPECT_NE(ready.header("Retry-After"), "");
  EXPECT_EQ(caller.get("/livez").status, 200);
  EXPECT_EQ(caller.post("/v1/generate", R"({"count":50})").problem(), "draining");
  EXPECT_EQ(caller.get("/v1/jobs/" + id).status, 200) << "what is known can still be read";
  const auto answer = waiting.response();
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(json::parse(answer.body, nullptr, false).value("status", ""), "running");
  EXPECT_TRUE(app.join());
}

}  // namespace
}  // namespace wellspaced
