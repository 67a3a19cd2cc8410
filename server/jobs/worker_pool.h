#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/control.h"
#include "server/jobs/job_store.h"

namespace wellspaced {

/// Computes a job: the result's bytes. Errors: any; Error is shown to the client, everything else only
/// logged.
using JobRunner = std::function<std::string(const Claim&, Control&)>;

/// A run that ended, for metrics and logs.
struct JobFinished {
  std::string id, operation, trace;
  JobStatus status = JobStatus::successful;
  double seconds = 0;
};

struct WorkerPoolOptions {
  unsigned workers = 1;
  unsigned attached_workers = 0;  ///< more of them, for jobs whose client waits; never behind long work
  unsigned threads_per_job = 1;
  std::int64_t job_limit_ms = 3'600'000;
  std::int64_t attached_limit_ms = 60'000;  ///< for jobs whose client waits for them
  std::int64_t lease_ms = 30'000;           ///< as in JobLimits; renewed each third of it
  std::int64_t claim_every_ms = 3'000;  ///< looks for leases of dead processes and jobs that others submitted
  std::int64_t progress_every_ms = 500;
  std::int64_t expire_every_ms = 60'000;
  std::int64_t stop_grace_ms = 5'000;  ///< for runs to notice that they are cancelled
  std::string name;                    ///< of this process in the store; empty: "<host>:<pid>"
};

/// Threads that take jobs from a store, run them, and write down how they end.
///
/// Guarantees
/// 1. A run ends in one way: its result is stored; or its Error is stored as a problem; or, when cancelled,
/// the job is
///    dismissed; or, on `stop`, it goes back to the queue; or, when its lease was lost, nothing is written.
/// 2. A run that computes without pause keeps its lease: one thread does nothing but heartbeats and progress
/// events.
/// 3. A store that fails for a while stops no worker; claims and endings are tried again.
/// 4. At most one progress event a job each `progress_every_ms`:
/// {"progress","sweep","beta","r_c","r_f","message"}, what
///    is not known left out.
///
/// Callbacks come from the pool's threads, several at a time; they must neither throw nor block for long.
/// Thread safety: everything from any thread, but the destructor.
class WorkerPool {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts the threads. `store` must outlive the pool. `on_event` is called after events have appeared in
  /// the store.
  WorkerPool(JobStore& store, WorkerPoolOptions options, JobRunner run,
             std::function<void(const JobFinished&)> on_finished, std::function<void()> on_event);
  /// Stops, and waits for runs that `stop` has left behind.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// A job was submitted: an idle worker takes it at once.
  void notify();

  /// Waits until the job is over (true; also if it is unknown), or until the deadline has passed, `gone` says
  /// that nobody waits any more (asked every 50 ms or so; may be empty), or the pool stops (false). Errors:
  /// those of JobStore::find.
  bool wait(const std::string& id, Clock::time_point deadline, const std::function<bool()>& gone);

  /// Cancels in the store, and a run in this process at once. The run is also stopped if the store fails.
  /// Errors: those of JobStore::cancel.
  CancelOutcome cancel(const std::string& id);

  /// Takes no more jobs, cancels the runs, and puts their jobs back into the queue. A run that is deaf to its
  /// Control is left behind after the grace, its job taken from it; then the answer is false and the process
  /// should exit without destroying the pool. Any number of times.
  bool stop();

 private:
  class Run;
  using RunPointer = std::shared_ptr<Run>;

  /// How a run ends; `accepted`: back to the queue.
  struct Outcome {
    JobStatus status = JobStatus::failed;
    std::string bytes;  ///< result or problem
  };

  void work(bool attached_only);
  bool claim_and_run(bool attached_only);
  RunPointer begin(Claim claim);
  void execute(const RunPointer& run);
  Outcome compute(Run& run);
  bool write_ending(const Run& run, Outcome& outcome);
  bool write_ending_once(const Claim& claim, const Outcome& outcome);
  void finish(const RunPointer& run);

  void tend();
  void tend_run(Run& run);
  void clean();

  std::vector<RunPointer> runs();
  bool pause(std::chrono::milliseconds time);
  void wake_waiters();

  JobStore& store_;
  const WorkerPoolOptions options_;
  const JobRunner run_;
  const std::function<void(const JobFinished&)> on_finished_;
  const std::function<void()> on_event_;

  std::mutex mutex_;  // guards what follows; never held during a call of the store or a callback
  std::condition_variable work_to_do_, changed_, pause_over_;
  bool stopping_ = false, stopped_ = false;
  std::uint64_t submitted_ = 0;  // counts notifications, so that none is lost between a claim and a wait
  std::uint64_t ended_ = 0;      // counts runs that ended and jobs that were cancelled here
  std::vector<RunPointer> runs_;
  std::vector<std::thread> threads_;
};

}  // namespace wellspaced
