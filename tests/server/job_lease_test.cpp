// What job_store.h promises about leases, fencing and cancels, checked on every kind of store.
#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/jobs/job_store.h"
#include "tests/support/server_job_store_test.h"

namespace wellspaced {
namespace {

using support::some_spec;
using testing::HasSubstr;

class JobLeaseTest : public support::JobStoreTest {};

INSTANTIATE_TEST_SUITE_P(Every, JobLeaseTest, testing::Values(support::sqlite_kind()),
                         [](const auto& test) { return std::string(test.param.name); });

// ---- leases and fencing

TEST_P(JobLeaseTest, GivesARunningJobToNobodyElseWithinItsLease) {
  submit();
  const Claim taken = claim();
  test_store().advance(limits.lease_ms - 10'000);
  EXPECT_FALSE(store().claim("another worker"));
  EXPECT_TRUE(store().heartbeat(taken, 0.1, "").still_ours);
  test_store().advance(limits.lease_ms - 10'000);
  EXPECT_FALSE(store().claim("another worker")) << "the heartbeat has renewed the lease";
}

TEST_P(JobLeaseTest, AWorkerThatWakesAfterItsLeaseChangesNothing) {
  const std::string id = submit("request");
  const Claim old = claim();
  let_the_lease_run_out();
  const Claim taken = claim();
  EXPECT_EQ(taken.id, id);
  EXPECT_EQ(taken.attempt, old.attempt + 1);
  EXPECT_EQ(taken.spec.request, "request");

  const auto nothing_changes = [&] {
    const Job before = store().find(id).value();
    const std::size_t events = store().events_after(id, 0).size();
    EXPECT_FALSE(store().heartbeat(old, 0.9, "old").still_ours);
    EXPECT_FALSE(store().append_event(old, "progress", "{}"));
    EXPECT_FALSE(store().complete(old, "old"));
    EXPECT_FALSE(store().fail(old, "old"));
    EXPECT_FALSE(store().dismiss(old));
    EXPECT_FALSE(store().release(old));
    const Job after = store().find(id).value();
    EXPECT_EQ(after.status, before.status);
    EXPECT_EQ(after.attempt, before.attempt);
    EXPECT_EQ(after.progress, before.progress);
    EXPECT_EQ(after.message, before.message);
    EXPECT_EQ(after.updated_ms, before.updated_ms);
    EXPECT_EQ(store().events_after(id, 0).size(), events);
  };
  nothing_changes();
  EXPECT_TRUE(store().complete(taken, "new"));
  nothing_changes();
  EXPECT_EQ(store().result(id), "new");
}

TEST_P(JobLeaseTest, AnEndedJobTakesNothingFromItsOwnWorker) {
  const std::string id = submit();
  const Claim taken = claim();
  EXPECT_TRUE(store().complete(taken, "first"));
  EXPECT_FALSE(store().complete(taken, "second"));
  EXPECT_FALSE(store().fail(taken, "{}"));
  EXPECT_FALSE(store().heartbeat(taken, 0.5, "").still_ours);
  EXPECT_FALSE(store().append_event(taken, "progress", "{}"));
  EXPECT_EQ(store().result(id), "first");
}

TEST_P(JobLeaseTest, FailsAJobWhoseWorkersKeepDying) {
  const std::string id = submit();
  for (int attempt = 1; attempt <= limits.max_attempts; ++attempt) {
    EXPECT_EQ(claim().attempt, attempt);
    let_the_lease_run_out();
  }
  const std::string next = submit();
  EXPECT_EQ(claim().id, next) << "the others go on";
  const Job job = store().find(id).value();
  EXPECT_EQ(job.status, JobStatus::failed);
  EXPECT_THAT(job.problem, HasSubstr("worker-crashed"));
  EXPECT_TRUE(job.finished_ms && job.expires_ms);
}

TEST_P(JobLeaseTest, CountsNoAttemptForAReleasedJobAndYetFencesItsOldWorker) {
  const std::string id = submit("request");
  const std::string younger = submit();
  for (int i = 1; i <= 3 * limits.max_attempts; ++i) {
    const Claim taken = claim();
    ASSERT_EQ(taken.id, id) << "a released job keeps its place";
    ASSERT_EQ(taken.attempt, i);
    ASSERT_EQ(taken.spec.request, "request");
    ASSERT_TRUE(store().release(taken));
    ASSERT_EQ(status(id), JobStatus::accepted);
    ASSERT_FALSE(store().find(id)->started_ms);
    ASSERT_FALSE(store().complete(taken, "late"));
  }
  const Claim taken = claim();
  EXPECT_TRUE(store().complete(taken, "good"));
  EXPECT_EQ(status(id), JobStatus::successful);
}

TEST_P(JobLeaseTest, TriesAnAttachedJobOnce) {
  JobSpec spec = some_spec();
  spec.attached = true;
  const std::string crashed = store().submit(spec).id;
  EXPECT_TRUE(claim().spec.attached);
  let_the_lease_run_out();
  EXPECT_FALSE(store().claim("a worker"));
  EXPECT_EQ(status(crashed), JobStatus::dismissed);

  const std::string released = store().submit(spec).id;
  EXPECT_TRUE(store().release(claim()));
  EXPECT_EQ(status(released), JobStatus::dismissed);
}

TEST_P(JobLeaseTest, KeepsTheProgressOfAHeartbeatAndNeverLetsItFall) {
  const std::string id = submit();
  const Claim taken = claim();
  store().heartbeat(taken, 0.5, "sweep 3");
  EXPECT_EQ(store().find(id)->progress, 0.5);
  EXPECT_EQ(store().find(id)->message, "sweep 3");
  store().heartbeat(taken, 0.25, "sweep 4");
  EXPECT_EQ(store().find(id)->progress, 0.5);
  EXPECT_TRUE(store().heartbeat(taken, std::numeric_limits<double>::quiet_NaN(), "").still_ours);
  EXPECT_TRUE(store().heartbeat(taken, -1, "").still_ours);
  EXPECT_EQ(store().find(id)->progress, 0.5);
  EXPECT_TRUE(store().heartbeat(taken, std::numeric_limits<double>::infinity(), "").still_ours);
  EXPECT_EQ(store().find(id)->progress, 1);
}

// ---- cancel

TEST_P(JobLeaseTest, DismissesAWaitingJobAtOnce) {
  const std::string id = submit();
  EXPECT_EQ(store().cancel(id), CancelOutcome::requested);
  EXPECT_EQ(status(id), JobStatus::dismissed);
  EXPECT_EQ(store().cancel(id), CancelOutcome::already_over);
  EXPECT_FALSE(store().claim("a worker"));
}

TEST_P(JobLeaseTest, TellsTheWorkerOfACancelAndWaitsForIt) {
  const std::string id = submit();
  const Claim taken = claim();
  EXPECT_FALSE(store().heartbeat(taken, 0, "").cancel);
  EXPECT_EQ(store().cancel(id), CancelOutcome::requested);
  EXPECT_EQ(store().cancel(id), CancelOutcome::requested);
  EXPECT_EQ(status(id), JobStatus::running);
  EXPECT_TRUE(store().find(id)->cancel_requested);
  const Heartbeat answer = store().heartbeat(taken, 0, "");
  EXPECT_TRUE(answer.still_ours && answer.cancel);
  EXPECT_TRUE(store().dismiss(taken));
  EXPECT_EQ(status(id), JobStatus::dismissed);
}

TEST_P(JobLeaseTest, RunsACancelledJobNeverAgain) {
  const std::string crashed = submit();
  claim();
  store().cancel(crashed);
  let_the_lease_run_out();
  EXPECT_FALSE(store().claim("a worker"));
  EXPECT_EQ(status(crashed), JobStatus::dismissed);

  const std::string released = submit();
  const Claim taken = claim();
  store().cancel(released);
  EXPECT_TRUE(store().release(taken));
  EXPECT_EQ(status(released), JobStatus::dismissed);
}

TEST_P(JobLeaseTest, LetsEitherCancelOrCompletionWinNeverBoth) {
  limits.live_per_owner = 1000;
  for (int round = 0; round < 50; ++round) {
    const std::string id = submit();
    const Claim taken = claim();
    std::atomic<int> ready = 0;
    CancelOutcome outcome = CancelOutcome::unknown;
    std::thread canceller([&] {
      ++ready;
      while (ready < 2) {
      }
      outcome = store().cancel(id);
    });
    ++ready;
    while (ready < 2) {
    }
    const bool completed = store().complete(taken, "bytes");
    canceller.join();
    // A job that runs is still its worker's after a cancel, so a completion always counts.
    EXPECT_TRUE(completed);
    EXPECT_NE(outcome, CancelOutcome::unknown);
    EXPECT_EQ(status(id), JobStatus::successful);
    EXPECT_EQ(store().result(id), "bytes");
    EXPECT_EQ(store().cancel(id), CancelOutcome::already_over);
    const auto events = store().events_after(id, 0);
    EXPECT_EQ(std::count_if(events.begin(), events.end(), [](const JobEvent& e) { return e.type == "done"; }),
              1);
  }
}

}  // namespace
}  // namespace wellspaced
