// What job_store.h promises, checked on every kind of store.
#include "server/jobs/job_store.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "tests/support/server_job_store_test.h"

namespace wellspaced {
namespace {

using support::some_spec;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using support::code_of;
class JobStoreTest : public support::JobStoreTest {};

INSTANTIATE_TEST_SUITE_P(Every, JobStoreTest, testing::Values(support::sqlite_kind()),
                         [](const auto& test) { return std::string(test.param.name); });

// ---- submit, find, list

TEST_P(JobStoreTest, KeepsWhatWasSubmitted) {
  JobSpec spec = some_spec(std::string("\0\xff{", 3));
  spec.owner = "somebody";
  const Job job = store().submit(spec);
  EXPECT_EQ(job.status, JobStatus::accepted);
  EXPECT_EQ(job.operation, "optimize");
  EXPECT_EQ(job.owner, "somebody");
  EXPECT_EQ(job.trace, spec.trace);
  EXPECT_EQ(job.attempt, 0);
  EXPECT_EQ(job.queue_position, 1);
  EXPECT_GT(job.created_ms, 1'600'000'000'000);
  EXPECT_EQ(job.updated_ms, job.created_ms);
  EXPECT_FALSE(job.started_ms || job.finished_ms || job.expires_ms || job.cancel_requested || job.attached);

  const Claim taken = claim();
  EXPECT_EQ(taken.id, job.id);
  EXPECT_EQ(taken.attempt, 1);
  EXPECT_EQ(taken.spec.operation, spec.operation);
  EXPECT_EQ(taken.spec.owner, spec.owner);
  EXPECT_EQ(taken.spec.content_type, spec.content_type);
  EXPECT_EQ(taken.spec.query, spec.query);
  EXPECT_EQ(taken.spec.request, spec.request);
  EXPECT_EQ(taken.spec.trace, spec.trace);
  EXPECT_FALSE(taken.spec.attached);
}

TEST_P(JobStoreTest, KnowsNothingOfOtherIds) {
  for (const char* id : {"", "x", "00000000000000000000000000000000zz", "' OR 1=1 --"}) {
    EXPECT_FALSE(store().find(id));
    EXPECT_EQ(store().cancel(id), CancelOutcome::unknown);
    EXPECT_FALSE(store().purge(id));
    EXPECT_THAT(store().events_after(id, 0), IsEmpty());
    EXPECT_EQ(code_of([&] { store().result(id); }), ErrorCode::no_such_job);
  }
}

TEST_P(JobStoreTest, ClaimsInTheOrderOfSubmission) {
  std::vector<std::string> submitted, claimed;
  for (int i = 0; i < 10; ++i) submitted.push_back(submit());
  EXPECT_TRUE(std::is_sorted(submitted.begin(), submitted.end()));
  EXPECT_EQ(store().find(submitted[6])->queue_position, 7);
  for (int i = 0; i < 10; ++i) claimed.push_back(claim().id);
  EXPECT_EQ(claimed, submitted);
  EXPECT_FALSE(store().claim("a worker"));
}

TEST_P(JobStoreTest, GivesOnlyAttachedJobsToThoseWhoAskForThem) {
  submit();
  JobSpec spec = some_spec();
  spec.attached = true;
  const std::string attached = store().submit(spec).id;
  EXPECT_EQ(store().claim("a worker", true).value().id, attached);
  EXPECT_FALSE(store().claim("a worker", true));
  EXPECT_TRUE(store().claim("a worker"));
}

TEST_P(JobStoreTest, KeepsTheOrderOfIdsWhenTheClockIsSetBack) {
  const std::string first = submit();
  test_store().advance(-3'600'000);
  EXPECT_LT(first, submit());
}

TEST_P(JobStoreTest, RefusesJobsAboveTheQueueLimit) {
  limits.queue = 2;
  submit();
  const std::string second = submit();
  EXPECT_EQ(code_of([&] { submit(); }), ErrorCode::overloaded);
  JobSpec attached = some_spec();
  attached.attached = true;
  EXPECT_EQ(code_of([&] { store().submit(attached); }), ErrorCode::overloaded);
  store().cancel(second);
  store().submit(attached);
  EXPECT_EQ(code_of([&] { submit(); }), ErrorCode::overloaded) << "attached jobs take room in the queue";
  claim();
  submit();
}

TEST_P(JobStoreTest, RefusesLiveJobsAboveTheOwnersLimit) {
  limits.live_per_owner = 2;
  JobSpec spec = some_spec();
  spec.owner = "somebody";
  store().submit(spec);
  store().submit(spec);
  EXPECT_EQ(code_of([&] { store().submit(spec); }), ErrorCode::too_many_jobs);
  const Claim running = claim();
  EXPECT_EQ(code_of([&] { store().submit(spec); }), ErrorCode::too_many_jobs) << "running jobs are live";

  JobSpec other = spec;
  other.owner = "somebody else";
  store().submit(other);
  JobSpec attached = spec;
  attached.attached = true;
  store().submit(attached);

  store().complete(running, "done");
  store().submit(spec);
  EXPECT_EQ(code_of([&] { store().submit(spec); }), ErrorCode::too_many_jobs);
}

TEST_P(JobStoreTest, ListsTheNewestFirstInPages) {
  std::vector<std::string> ids;
  for (int i = 0; i < 7; ++i) ids.insert(ids.begin(), submit());
  JobFilter filter;
  filter.limit = 3;
  std::vector<std::string> listed;
  std::vector<Job> page;
  do {
    page = store().list(filter);
    for (const Job& job : page) listed.push_back(job.id);
    if (!page.empty()) filter.cursor = page.back().id;
    store().cancel(filter.cursor);
    store().purge(filter.cursor);  // a cursor's job may be gone
  } while (page.size() == 3);
  EXPECT_EQ(listed, ids);
  filter = {};
  filter.limit = -1;
  EXPECT_THAT(store().list(filter), IsEmpty());
}

TEST_P(JobStoreTest, ListsByOwnerStatusAndOperation) {
  JobSpec spec = some_spec();
  spec.owner = "somebody";
  const std::string optimize = store().submit(spec).id;
  claim();
  spec.operation = "analyze";
  const std::string analyze = store().submit(spec).id;
  submit();  // of nobody
  const auto ids = [&](const JobFilter& filter) {
    std::vector<std::string> found;
    for (const Job& job : store().list(filter)) found.push_back(job.id);
    return found;
  };
  JobFilter filter;
  filter.owner = "somebody";
  EXPECT_THAT(ids(filter), ElementsAre(analyze, optimize));
  filter.status = JobStatus::running;
  EXPECT_THAT(ids(filter), ElementsAre(optimize));
  filter.operation = "analyze";
  EXPECT_THAT(ids(filter), IsEmpty());
  filter.status.reset();
  EXPECT_THAT(ids(filter), ElementsAre(analyze));
}

// ---- results

TEST_P(JobStoreTest, GivesResultsBackByteForByte) {
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{1} << 20, (std::size_t{5} << 20) + 1}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>((i * 2654435761u) >> 13);
    const std::string id = submit(bytes);
    const Claim taken = claim();
    EXPECT_TRUE(taken.spec.request == bytes) << size;
    EXPECT_TRUE(store().complete(taken, bytes));
    EXPECT_TRUE(store().result(id) == bytes) << size;
    const Job job = store().find(id).value();
    EXPECT_EQ(job.status, JobStatus::successful);
    EXPECT_EQ(job.result_bytes, static_cast<std::int64_t>(size));
    EXPECT_EQ(job.progress, 1);
    EXPECT_EQ(job.expires_ms.value() - job.finished_ms.value(), limits.keep_result_ms);
    EXPECT_LE(job.created_ms, job.started_ms.value());
    EXPECT_LE(job.started_ms.value(), job.finished_ms.value());
  }
}

TEST_P(JobStoreTest, SaysWhyThereIsNoResult) {
  const std::string id = submit();
  EXPECT_EQ(code_of([&] { store().result(id); }), ErrorCode::result_not_ready);
  const Claim taken = claim();
  EXPECT_EQ(code_of([&] { store().result(id); }), ErrorCode::result_not_ready);
  store().fail(taken, R"({"status":422})");
  EXPECT_EQ(code_of([&] { store().result(id); }), ErrorCode::conflict);
  EXPECT_EQ(store().find(id)->status, JobStatus::failed);
  EXPECT_EQ(store().find(id)->problem, R"({"status":422})");
  const std::string dismissed = submit();
  store().cancel(dismissed);
  EXPECT_EQ(code_of([&] { store().result(dismissed); }), ErrorCode::conflict);
}

TEST_P(JobStoreTest, PurgesOnlyWhatIsOver) {
  const std::string id = submit();
  EXPECT_FALSE(store().purge(id));
  const Claim taken = claim();
  EXPECT_FALSE(store().purge(id));
  store().complete(taken, "bytes");
  EXPECT_TRUE(store().purge(id));
  EXPECT_FALSE(store().find(id));
  EXPECT_THAT(store().events_after(id, 0), IsEmpty());
  EXPECT_FALSE(store().purge(id));
}

TEST_P(JobStoreTest, DropsResultsAfterTheirTimeAndJobsAfterTwiceTheirTime) {
  const std::string id = submit();
  store().complete(claim(), "bytes");
  const std::string waiting = submit();
  EXPECT_EQ(store().expire(), 0);
  test_store().advance(limits.keep_result_ms - 60'000);
  EXPECT_EQ(store().expire(), 0);
  EXPECT_EQ(store().result(id), "bytes");

  test_store().advance(60'001);
  EXPECT_EQ(code_of([&] { store().result(id); }), ErrorCode::result_expired)
      << "the clock decides, not expire()";
  EXPECT_EQ(store().expire(), 1);
  EXPECT_EQ(code_of([&] { store().result(id); }), ErrorCode::result_expired);
  EXPECT_EQ(status(id), JobStatus::successful);
  EXPECT_EQ(store().expire(), 0);

  test_store().advance(limits.keep_result_ms);
  EXPECT_EQ(store().expire(), 1);
  EXPECT_FALSE(store().find(id));
  EXPECT_EQ(status(waiting), JobStatus::accepted) << "live jobs never expire";
}

TEST_P(JobStoreTest, ExpiresAnyNumberOfJobs) {
  limits.live_per_owner = 1000;
  for (int i = 0; i < 50; ++i) {
    submit();
    store().complete(claim(), "bytes");
  }
  test_store().advance(2 * limits.keep_result_ms + 1);
  EXPECT_EQ(store().expire(), 100);
  EXPECT_THAT(store().list({}), IsEmpty());
}

// ---- results that other jobs take their points from

struct Chain {
  std::string source, user;
};

/// A finished job, and a live one that takes its points from it.
Chain chain(JobStore& store) {
  Chain made;
  made.source = store.submit(some_spec()).id;
  store.complete(store.claim("a worker").value(), "bytes");
  JobSpec spec = some_spec();
  spec.needs = made.source;
  made.user = store.submit(spec).id;
  return made;
}

TEST_P(JobStoreTest, RefusesToPurgeAResultThatALiveJobNeeds) {
  const Chain made = chain(store());
  try {
    store().purge(made.source);
    ADD_FAILURE() << "purged while its user was waiting";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::conflict);
    EXPECT_THAT(error.what(), HasSubstr(made.user));
  }
  const Claim taken = claim();
  EXPECT_EQ(taken.spec.needs, made.source);
  EXPECT_EQ(code_of([&] { store().purge(made.source); }), ErrorCode::conflict);
  EXPECT_EQ(store().result(made.source), "bytes");
  store().complete(taken, "more bytes");
  EXPECT_TRUE(store().purge(made.source));
  EXPECT_EQ(store().result(made.user), "more bytes");
}

TEST_P(JobStoreTest, KeepsAResultPastItsTimeWhileALiveJobNeedsIt) {
  const Chain made = chain(store());
  test_store().advance(3 * limits.keep_result_ms);
  EXPECT_EQ(store().expire(), 0);
  EXPECT_EQ(store().result(made.source), "bytes");
  store().cancel(made.user);
  EXPECT_EQ(code_of([&] { store().result(made.source); }), ErrorCode::result_expired);
  EXPECT_EQ(store().expire(), 2) << "its result, then its row";
  EXPECT_FALSE(store().find(made.source));
}

TEST_P(JobStoreTest, TakesNoJobWhoseNeededResultIsNotThere) {
  JobSpec spec = some_spec();
  spec.needs = "no such job";
  EXPECT_EQ(code_of([&] { store().submit(spec); }), ErrorCode::no_such_job);
  spec.needs = submit();
  EXPECT_EQ(code_of([&] { store().submit(spec); }), ErrorCode::result_not_ready);
  store().complete(claim(), "bytes");
  test_store().advance(limits.keep_result_ms + 1);
  EXPECT_EQ(code_of([&] { store().submit(spec); }), ErrorCode::result_expired);
  EXPECT_EQ(store().counts().accepted, 0);
}

// ---- events

TEST_P(JobStoreTest, AppendsAnEventForEveryChangeOfStatus) {
  const std::string id = submit();
  Claim taken = claim();
  store().append_event(taken, "progress", R"({"progress":0.5})");
  store().release(taken);
  taken = claim();
  store().complete(taken, "bytes");
  std::vector<std::string> told;
  std::int64_t sequence = 0;
  for (const JobEvent& event : store().events_after(id, 0)) {
    EXPECT_EQ(event.sequence, ++sequence);
    const auto json = nlohmann::json::parse(event.json);
    if (event.type == "progress") {
      told.push_back("progress");
      continue;
    }
    EXPECT_EQ(json.size(), 4u);
    EXPECT_EQ(json["id"], id);
    EXPECT_EQ(json["progress"], json["status"] == "successful" ? 1 : 0);
    told.push_back(event.type + " " + json["status"].get<std::string>() + " " + json["attempt"].dump());
  }
  EXPECT_THAT(told, ElementsAre("status accepted 0", "status running 1", "progress", "status accepted 1",
                                "status running 2", "status successful 2", "done successful 2"));
}

TEST_P(JobStoreTest, KeepsTheNewestEventsAndTheirNumbers) {
  limits.events_per_job = 256;
  const std::string id = submit();
  const Claim taken = claim();  // two events so far
  for (int i = 3; i <= 300; ++i) ASSERT_TRUE(store().append_event(taken, "progress", std::to_string(i)));
  const auto kept = store().events_after(id, 0);
  ASSERT_EQ(kept.size(), 256u);
  EXPECT_EQ(kept.front().sequence, 45);
  EXPECT_EQ(kept.front().json, "45");
  EXPECT_EQ(kept.back().sequence, 300);
}

TEST_P(JobStoreTest, ResumesEventsAfterASequenceNumber) {
  const std::string id = submit();
  const Claim taken = claim();
  store().append_event(taken, "progress", "3");
  test_store().reopen();
  EXPECT_EQ(store().events_after(id, 2).front().json, "3");
  const std::int64_t last = store().events_after(id, 0).back().sequence;
  EXPECT_THAT(store().events_after(id, last), IsEmpty());
  store().cancel(id);
  EXPECT_EQ(store().events_after(id, last).front().sequence, last + 1);
}

// ---- the whole

TEST_P(JobStoreTest, CountsWhatWaitsAndRuns) {
  EXPECT_EQ(store().counts().accepted, 0);
  EXPECT_EQ(store().counts().oldest_accepted_ms, 0);
  submit();
  submit();
  test_store().advance(5000);
  submit();
  JobCounts counts = store().counts();
  EXPECT_EQ(counts.accepted, 3);
  EXPECT_EQ(counts.running, 0);
  EXPECT_GE(counts.oldest_accepted_ms, 5000);
  EXPECT_LT(counts.oldest_accepted_ms, 35'000);
  claim();
  claim();
  counts = store().counts();
  EXPECT_EQ(counts.accepted, 1);
  EXPECT_EQ(counts.running, 2);
  EXPECT_LT(counts.oldest_accepted_ms, 5000);
  store().ping();
}

TEST_P(JobStoreTest, SharesItsJobsWithAnotherProcess) {
  const std::string id = submit();
  const auto other = test_store().another();
  const Claim taken = other->claim("a worker over there").value();
  EXPECT_EQ(taken.id, id);
  EXPECT_FALSE(store().claim("a worker here"));
  EXPECT_EQ(store().cancel(id), CancelOutcome::requested);
  EXPECT_TRUE(other->heartbeat(taken, 0, "").cancel);
  EXPECT_TRUE(other->complete(taken, "from there"));
  EXPECT_EQ(store().result(id), "from there");
}

TEST_P(JobStoreTest, LosesNothingByARestart) {
  JobSpec spec = some_spec();
  spec.attached = true;
  const std::string running = submit("running request");
  const Claim before = claim();
  const std::string successful = submit();
  store().complete(claim(), "bytes");
  const std::string failed = submit();
  store().fail(claim(), "{}");
  const std::string dismissed = submit();
  store().cancel(dismissed);
  const std::string accepted = submit("accepted request");
  test_store().reopen();

  EXPECT_EQ(store().result(successful), "bytes");
  EXPECT_EQ(status(failed), JobStatus::failed);
  EXPECT_EQ(store().find(failed)->problem, "{}");
  EXPECT_EQ(status(dismissed), JobStatus::dismissed);
  EXPECT_EQ(status(accepted), JobStatus::accepted);
  let_the_lease_run_out();
  const Claim again = claim();
  EXPECT_EQ(again.id, running);
  EXPECT_EQ(again.attempt, before.attempt + 1);
  EXPECT_EQ(again.spec.request, "running request");
  EXPECT_FALSE(store().complete(before, "late"));
  EXPECT_EQ(claim().spec.request, "accepted request");
}

TEST_P(JobStoreTest, GivesEachJobOneResultUnderEightThreads) {
  constexpr int kThreads = 8, kJobsEach = 25;
  limits.live_per_owner = kThreads * kJobsEach;
  store();
  std::mutex mutex;
  std::set<std::string> submitted;
  std::map<std::string, std::string> completed;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      const auto take_one = [&] {
        const auto taken = store().claim("worker " + std::to_string(t));
        if (!taken) return;
        const std::string result = taken->id + " by " + std::to_string(t);
        store().heartbeat(*taken, 0.5, "");
        ASSERT_TRUE(store().complete(*taken, result));
        const std::lock_guard guard(mutex);
        EXPECT_TRUE(completed.emplace(taken->id, result).second);
      };
      for (int i = 0; i < kJobsEach; ++i) {
        const std::string id = submit();
        {
          const std::lock_guard guard(mutex);
          EXPECT_TRUE(submitted.insert(id).second);
        }
        take_one();
      }
      while (store().counts().accepted > 0) take_one();
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(submitted.size(), std::size_t{kThreads * kJobsEach});
  EXPECT_EQ(completed.size(), submitted.size());
  for (const auto& [id, result] : completed) EXPECT_EQ(store().result(id), result);
}

TEST(JobStatus, IsReadAndWrittenAsTheSameWord) {
  for (const char* word : {"accepted", "running", "successful", "failed", "dismissed"}) {
    EXPECT_STREQ(to_string(job_status_from(word)), word);
  }
  for (const char* word : {"", "Running", "done"}) {
    EXPECT_EQ(code_of([&] { job_status_from(word); }), ErrorCode::invalid_parameters);
  }
}

}  // namespace
}  // namespace wellspaced
