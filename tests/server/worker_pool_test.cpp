#include "server/jobs/worker_pool.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "server/jobs/job_store.h"
#include "tests/support/server_stores.h"

namespace wellspaced {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;
using support::eventually;
using support::some_spec;
using testing::HasSubstr;
using testing::Not;

/// A store whose next endings go wrong.
class FailingStore final : public JobStore {
 public:
  explicit FailingStore(JobStore& store) : store_(store) {}

  std::atomic<int> failing_claims = 0, failing_completions = 0;
  std::atomic<ErrorCode> code = ErrorCode::storage_unavailable;

  Job submit(const JobSpec& spec) override { return store_.submit(spec); }
  std::optional<Claim> claim(const std::string& worker, bool attached_only = false) override {
    fail_if(failing_claims);
    return store_.claim(worker, attached_only);
  }
  Heartbeat heartbeat(const Claim& c, double p, const std::string& m) override {
    return store_.heartbeat(c, p, m);
  }
  bool complete(const Claim& claim, const std::string& result) override {
    fail_if(failing_completions);
    return store_.complete(claim, result);
  }
  bool fail(const Claim& claim, const std::string& problem) override { return store_.fail(claim, problem); }
  bool dismiss(const Claim& claim) override { return store_.dismiss(claim); }
  bool release(const Claim& claim) override { return store_.release(claim); }
  std::optional<Job> find(const std::string& id) override { return store_.find(id); }
  std::vector<Job> list(const JobFilter& filter) override { return store_.list(filter); }
  CancelOutcome cancel(const std::string& id) override { return store_.cancel(id); }
  bool purge(const std::string& id) override { return store_.purge(id); }
  std::string result(const std::string& id) override { return store_.result(id); }
  bool append_event(const Claim& c, const std::string& t, const std::string& j) override {
    return store_.append_event(c, t, j);
  }
  std::vector<JobEvent> events_after(const std::string& id, std::int64_t s) override {
    return store_.events_after(id, s);
  }
  std::pair<DomainRecord, bool> add_domain(const DomainSpec& spec, const std::string& bytes) override {
    return store_.add_domain(spec, bytes);
  }
  std::optional<DomainRecord> find_domain(const std::string& owner, const std::string& id) override {
    return store_.find_domain(owner, id);
  }
  std::vector<DomainRecord> list_domains(const std::string& owner, const std::string& cursor,
                                         int limit) override {
    return store_.list_domains(owner, cursor, limit);
  }
  std::string domain_bytes(const std::string& owner, const std::string& id) override {
    return store_.domain_bytes(owner, id);
  }
  bool delete_domain(const std::string& owner, const std::string& id) override {
    return store_.delete_domain(owner, id);
  }
  int expire() override { return store_.expire(); }
  JobCounts counts() override { return store_.counts(); }
  void ping() override { store_.ping(); }

 private:
  void fail_if(std::atomic<int>& times) {
    if (times > 0 && times-- > 0) throw Error(code, "broken by the test");
  }
  JobStore& store_;
};

class WorkerPoolTest : public testing::Test {
 protected:
  WorkerPoolTest() {
    options.claim_every_ms = 3'600'000;  // unless a test says so, only notify() brings work
    options.lease_ms = 300;              // heartbeats each 100 ms; the store's own lease is 30 s
  }
  ~WorkerPoolTest() override { let_go = true; }

  void start(JobRunner runner) {
    pool = std::make_unique<WorkerPool>(
        store, options, std::move(runner),
        [this](const JobFinished& end) {
          const std::lock_guard guard(mutex);
          finished.push_back(end);
        },
        [this] { ++events; });
  }
  std::string submit(const std::string& request = "{}") {
    const std::string id = store.submit(some_spec(request)).id;
    if (pool) pool->notify();
    return id;
  }
  bool wait(const std::string& id) { return pool->wait(id, Control::Clock::now() + seconds(30), {}); }
  Job ended(const std::string& id) {
    EXPECT_TRUE(wait(id));
    return store.find(id).value();
  }
  bool runs(const std::string& id) {
    return eventually([&] { return store.find(id)->status == JobStatus::running && running > 0; });
  }
  /// A runner that computes until it is cancelled or the test lets it go.
  JobRunner endless() {
    return [this](const Claim&, Control& control) -> std::string {
      ++running;
      while (!let_go) {
        control.check();
        std::this_thread::yield();
      }
      return "let go";
    };
  }
  std::vector<nlohmann::json> progress_events(const std::string& id) {
    std::vector<nlohmann::json> found;
    for (const JobEvent& event : store.events_after(id, 0)) {
      if (event.type == "progress") found.push_back(nlohmann::json::parse(event.json));
    }
    return found;
  }

  std::unique_ptr<support::TestStore> test_store = support::sqlite_kind().create(JobLimits());
  FailingStore store{test_store->store()};
  WorkerPoolOptions options;
  std::mutex mutex;
  std::vector<JobFinished> finished;
  std::atomic<int> events = 0, running = 0;
  std::atomic<bool> let_go = false;
  std::unique_ptr<WorkerPool> pool;  // declared last: its threads use the others
};

// ---- how a run ends

TEST_F(WorkerPoolTest, StoresTheResult) {
  options.threads_per_job = 3;
  start([](const Claim& claim, Control& control) {
    return claim.spec.request + " by " + std::to_string(control.threads());
  });
  const std::string id = submit("request");
  EXPECT_EQ(ended(id).status, JobStatus::successful);
  EXPECT_EQ(store.result(id), "request by 3");
  EXPECT_GE(events, 1);
  const std::lock_guard guard(mutex);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].operation, "optimize");
  EXPECT_EQ(finished[0].status, JobStatus::successful);
  EXPECT_GE(finished[0].seconds, 0);
}

TEST_F(WorkerPoolTest, KeepsAnErrorAsAProblem) {
  start([](const Claim&, Control&) -> std::string {
    throw Error(ErrorCode::degenerate_input, "points 3 and 7 are the same; remove one");
  });
  const Job job = ended(submit());
  EXPECT_EQ(job.status, JobStatus::failed);
  EXPECT_THAT(job.problem, HasSubstr("degenerate-input"));
  EXPECT_THAT(job.problem, HasSubstr("points 3 and 7"));
}

TEST_F(WorkerPoolTest, TellsNothingOfOtherExceptions) {
  start([](const Claim& claim, Control&) -> std::string {
    if (claim.spec.request == "int") throw 42;
    throw std::runtime_error(claim.spec.request);
  });
  for (const char* request : {"int", "", "secret"}) {
    const Job job = ended(submit(request));
    EXPECT_EQ(job.status, JobStatus::failed);
    EXPECT_THAT(job.problem, HasSubstr("internal"));
    EXPECT_THAT(job.problem, Not(HasSubstr("secret")));
  }
}

TEST_F(WorkerPoolTest, FailsAJobAboveItsTimeLimit) {
  options.job_limit_ms = 20;
  start(endless());
  const Job job = ended(submit());
  EXPECT_EQ(job.status, JobStatus::failed);
  EXPECT_THAT(job.problem, HasSubstr("deadline-exceeded"));
}

TEST_F(WorkerPoolTest, EndsAWaitingClientsJobAtTheLimitOfSynchronousAnswersOnly) {
  options.attached_limit_ms = 20;
  start(endless());
  JobSpec spec = some_spec();
  spec.attached = true;
  const std::string waited_for = store.submit(spec).id;
  pool->notify();
  const Job job = ended(waited_for);
  EXPECT_EQ(job.status, JobStatus::failed);
  EXPECT_THAT(job.problem, HasSubstr("deadline-exceeded"));
  EXPECT_THAT(job.problem, HasSubstr("Prefer: respond-async"));

  running = 0;
  const std::string asynchronous = submit();
  ASSERT_TRUE(runs(asynchronous));
  const auto past_the_limit = Control::Clock::now() + milliseconds(100);
  EXPECT_TRUE(eventually([&] { return Control::Clock::now() > past_the_limit; }));
  EXPECT_EQ(store.find(asynchronous)->status, JobStatus::running);
}

TEST_F(WorkerPoolTest, DismissesACancelledRunAtOnce) {
  options.lease_ms = 3'600'000;  // no heartbeat could bring the news
  options.progress_every_ms = 3'600'000;
  start(endless());
  const std::string id = submit();
  ASSERT_TRUE(runs(id));
  EXPECT_EQ(pool->cancel(id), CancelOutcome::requested);
  EXPECT_EQ(ended(id).status, JobStatus::dismissed);
  EXPECT_EQ(pool->cancel(id), CancelOutcome::already_over);
  EXPECT_EQ(pool->cancel("unknown"), CancelOutcome::unknown);
}

TEST_F(WorkerPoolTest, DismissesACancelledRunThatEndsAllTheSame) {
  start([this](const Claim&, Control&) -> std::string {
    ++running;
    while (!let_go) std::this_thread::yield();
    return "too late";
  });
  const std::string id = submit();
  ASSERT_TRUE(runs(id));
  pool->cancel(id);
  let_go = true;
  EXPECT_EQ(ended(id).status, JobStatus::dismissed);
}

TEST_F(WorkerPoolTest, LearnsOfACancelElsewhereByItsHeartbeat) {
  start(endless());
  const std::string id = submit();
  ASSERT_TRUE(runs(id));
  test_store->another()->cancel(id);
  EXPECT_EQ(ended(id).status, JobStatus::dismissed);
}

TEST_F(WorkerPoolTest, CancelsAWaitingJob) {
  start(endless());
  const std::string first = submit();
  ASSERT_TRUE(runs(first));
  const std::string second = submit();
  EXPECT_EQ(pool->cancel(second), CancelOutcome::requested);
  EXPECT_EQ(ended(second).status, JobStatus::dismissed);
  EXPECT_EQ(running, 1);
}

// ---- leases

TEST_F(WorkerPoolTest, KeepsTheLeaseOfALongRun) {
  start(endless());
  const std::string id = submit();
  ASSERT_TRUE(runs(id));
  for (int i = 0; i < 5; ++i) {
    test_store->advance(20'000);  // of a lease of 30 s
    const std::int64_t before = store.find(id)->updated_ms;
    ASSERT_TRUE(eventually([&] { return store.find(id)->updated_ms >= before + 20'000; }));
  }
  EXPECT_FALSE(store.claim("another worker"));
  let_go = true;
  EXPECT_EQ(ended(id).attempt, 1);
}

TEST_F(WorkerPoolTest, StopsARunThatLostItsLeaseAndWritesNothing) {
  std::atomic<bool> stopped = false;
  start([&](const Claim&, Control& control) -> std::string {
    ++running;
    while (!control.cancelled()) std::this_thread::yield();
    stopped = true;
    return "of the old worker";
  });
  const std::string id = submit();
  ASSERT_TRUE(runs(id));
  std::optional<Claim> taken;
  ASSERT_TRUE(eventually([&] {  // a heartbeat may come between the two
    test_store->advance(JobLimits().lease_ms + 1);
    taken = store.claim("another worker");
    return taken.has_value();
  }));
  ASSERT_TRUE(eventually([&] { return stopped.load(); }));
  EXPECT_TRUE(store.complete(*taken, "of the new worker"));
  pool.reset();
  EXPECT_EQ(store.result(id), "of the new worker");
  EXPECT_TRUE(finished.empty());
}

TEST_F(WorkerPoolTest, TakesTheJobOfADeadWorkerWithoutBeingAsked) {
  options.claim_every_ms = 20;
  const std::string id = submit();
  const auto elsewhere = test_store->another();
  ASSERT_TRUE(elsewhere->claim("a worker that dies"));
  test_store->advance(JobLimits().lease_ms + 1);
  start([](const Claim& claim, Control&) { return std::to_string(claim.attempt); });
  EXPECT_EQ(ended(id).status, JobStatus::successful);
  EXPECT_EQ(store.result(id), "2");
}

// ---- progress and expiry

TEST_F(WorkerPoolTest, PassesTheLatestProgressOnNotMoreOftenThanAllowed) {
  options.progress_every_ms = 3'600'000;
  start([&](const Claim& claim, Control& control) -> std::string {
    for (int sweep = 1; sweep <= 1000; ++sweep) control.report({sweep / 2000.0, sweep, 0.75, 0.03, 0.04});
    ++running;
    eventually([&] { return !progress_events(claim.id).empty(); });
    for (int sweep = 1001; sweep <= 2000; ++sweep) control.report({sweep / 2000.0, sweep});
    eventually([&] { return store.find(claim.id)->progress == 1; });
    return "bytes";
  });
  const std::string id = submit();
  EXPECT_EQ(ended(id).message, "sweep 2000");
  const auto told = progress_events(id);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_GT(told[0]["sweep"], 0);
  EXPECT_EQ(told[0]["progress"], told[0]["sweep"].get<int>() / 2000.0);
  EXPECT_EQ(told[0]["beta"], 0.75);
  EXPECT_EQ(told[0]["r_c"], 0.03);
  EXPECT_EQ(told[0]["r_f"], 0.04);
  EXPECT_THAT(told[0]["message"], HasSubstr("beta 0.7500"));
}

TEST_F(WorkerPoolTest, LeavesOutWhatIsNotKnown) {
  start([&](const Claim& claim, Control& control) -> std::string {
    control.report({0.5});
    eventually([&] { return !progress_events(claim.id).empty(); });
    return "bytes";
  });
  const std::string id = submit();
  ended(id);
  EXPECT_EQ(progress_events(id).at(0), (nlohmann::json{{"progress", 0.5}, {"sweep", 0}}));
}

TEST_F(WorkerPoolTest, DropsExpiredJobs) {
  options.expire_every_ms = 20;
  start(endless());
  const std::string id = submit();
  let_go = true;
  ended(id);
  test_store->advance(2 * JobLimits().keep_result_ms + 1);
  EXPECT_TRUE(eventually([&] { return !store.find(id); }));
}

// ---- many jobs, stopping, broken stores

TEST_F(WorkerPoolTest, RunsAsManyJobsAtOnceAsItHasWorkers) {
  options.workers = 4;
  start(endless());
  std::vector<std::string> ids;
  for (int i = 0; i < 5; ++i) ids.push_back(store.submit(some_spec()).id);
  pool->notify();  // one word for all
  EXPECT_TRUE(eventually([&] { return running == 4; }));
  EXPECT_EQ(store.find(ids[4])->status, JobStatus::accepted);
  let_go = true;
  for (const std::string& id : ids) EXPECT_EQ(ended(id).status, JobStatus::successful);
}

TEST_F(WorkerPoolTest, ReturnsRunningJobsToTheQueueWhenItStops) {
  options.workers = 2;
  start(endless());
  const std::string first = submit(), second = submit(), third = submit();
  ASSERT_TRUE(eventually([&] { return running == 2; }));
  EXPECT_TRUE(pool->stop());
  EXPECT_TRUE(pool->stop());
  EXPECT_FALSE(wait(first)) << "nobody waits for a pool that has stopped";
  for (const std::string& id : {first, second, third}) EXPECT_EQ(store.find(id)->status, JobStatus::accepted);
  EXPECT_TRUE(finished.empty());
  pool.reset();
  let_go = true;
  start(endless());
  for (const std::string& id : {first, second, third}) EXPECT_EQ(ended(id).status, JobStatus::successful);
}

TEST_F(WorkerPoolTest, TakesItsJobFromARunThatDoesNotStop) {
  options.stop_grace_ms = 20;
  start([this](const Claim&, Control&) -> std::string {
    ++running;
    while (!let_go) std::this_thread::yield();
    return "too late";
  });
  const std::string id = submit();
  ASSERT_TRUE(runs(id));
  EXPECT_FALSE(pool->stop());
  EXPECT_EQ(store.find(id)->status, JobStatus::accepted);
  let_go = true;
  pool.reset();
  EXPECT_EQ(store.find(id)->status, JobStatus::accepted) << "what it returns in the end is not stored";
}

TEST_F(WorkerPoolTest, WaitsUntilTheDeadlineOrUntilNobodyIsThere) {
  start(endless());
  const std::string id = submit();
  EXPECT_FALSE(pool->wait(id, Control::Clock::now() + milliseconds(1), {}));
  EXPECT_FALSE(pool->wait(id, Control::Clock::now() - hours(1), {}));
  int asked = 0;
  EXPECT_FALSE(pool->wait(id, Control::Clock::time_point::max(), [&] { return ++asked == 3; }));
  EXPECT_EQ(asked, 3);
  EXPECT_TRUE(pool->wait("unknown", Control::Clock::time_point::max(), {}));
}

TEST_F(WorkerPoolTest, SeesTheEndOfAJobThatAnotherProcessRuns) {
  const std::string id = submit();
  const Claim taken = store.claim("a worker over there").value();
  start(endless());
  std::thread other([&] { test_store->another()->complete(taken, "bytes"); });
  EXPECT_TRUE(wait(id));
  other.join();
}

TEST_F(WorkerPoolTest, TriesAgainWhenTheStoreFails) {
  options.claim_every_ms = 20;
  store.failing_claims = 3;
  store.failing_completions = 1;
  start([](const Claim&, Control&) { return "bytes"; });
  const std::string id = submit();
  EXPECT_EQ(ended(id).status, JobStatus::successful);
  EXPECT_EQ(store.find(id)->attempt, 1);
  EXPECT_EQ(store.failing_completions, 0);
}

TEST_F(WorkerPoolTest, FailsAJobWhoseResultDoesNotFitOnTheDisk) {
  store.code = ErrorCode::storage_full;
  store.failing_completions = 1;
  start([](const Claim&, Control&) { return "bytes"; });
  const Job job = ended(submit());
  EXPECT_EQ(job.status, JobStatus::failed);
  EXPECT_THAT(job.problem, HasSubstr("storage-full"));
}

}  // namespace
}  // namespace wellspaced
