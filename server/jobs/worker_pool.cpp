#include "server/jobs/worker_pool.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "server/problem.h"

namespace wellspaced {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kAskGoneEvery{50};
constexpr milliseconds kLookEvery{500};  // for jobs that another process runs
constexpr milliseconds kHeartbeatWithProgressEvery{1000};
constexpr milliseconds kRetryAfter{1000};
constexpr int kEndingTries = 5;

WorkerPoolOptions with_name(WorkerPoolOptions options) {
  if (options.name.empty()) {
    char host[256] = "";
    gethostname(host, sizeof host - 1);
    options.name = std::string(host) + ":" + std::to_string(getpid());
  }
  return options;
}

std::string message_for(const Progress& progress) {
  if (progress.sweep <= 0) return "";
  std::string message = "sweep " + std::to_string(progress.sweep);
  if (!std::isnan(progress.beta)) message += fmt::format(", beta {:.4f}", progress.beta);
  return message;
}

std::string event_for(const Progress& progress) {
  nlohmann::ordered_json event = {{"progress", progress.fraction}, {"sweep", progress.sweep}};
  const std::pair<const char*, double> measures[] = {
      {"beta", progress.beta}, {"r_c", progress.r_c}, {"r_f", progress.r_f}};
  for (const auto& [name, value] : measures) {
    if (std::isfinite(value)) event[name] = value;
  }
  if (const std::string message = message_for(progress); !message.empty()) event["message"] = message;
  return event.dump();
}

std::string problem_for(const Error& error) { return to_json(to_problem(error), ""); }

}  // namespace

/// A job that is being computed: its claim, its Control, and why it should stop.
class WorkerPool::Run final : public Control {
 public:
  enum class Reason { none, dismissed, stopping, lost };

  Run(Claim taken, unsigned threads) : Control(threads), claim(std::move(taken)) {}

  /// The first reason counts.
  void stop_because(Reason reason) {
    Reason none = Reason::none;
    reason_.compare_exchange_strong(none, reason);
    cancel();
  }
  Reason reason() const { return reason_; }

  /// The latest progress, if there was any since the last call.
  std::optional<Progress> take_progress() {
    const std::lock_guard guard(mutex_);
    return std::exchange(fresh_, std::nullopt);
  }

  const Claim claim;

  // For the tending thread only.
  Progress latest;
  bool event_due = false, heartbeat_due = false;
  Clock::time_point next_event = Clock::time_point::min(), last_heartbeat = Clock::now();

 private:
  void on_progress(const Progress& progress) override {
    const std::lock_guard guard(mutex_);
    fresh_ = progress;
  }

  std::atomic<Reason> reason_ = Reason::none;
  std::mutex mutex_;
  std::optional<Progress> fresh_;
};

WorkerPool::WorkerPool(JobStore& store, WorkerPoolOptions options, JobRunner run,
                       std::function<void(const JobFinished&)> on_finished, std::function<void()> on_event)
    : store_(store),
      options_(with_name(std::move(options))),
      run_(std::move(run)),
      on_finished_(on_finished ? std::move(on_finished) : [](const JobFinished&) {}),
      on_event_(on_event ? std::move(on_event) : [] {}) {
  for (unsigned i = 0; i < options_.workers; ++i) threads_.emplace_back([this] { work(false); });
  for (unsigned i = 0; i < options_.attached_workers; ++i) threads_.emplace_back([this] { work(true); });
  threads_.emplace_back([this] { tend(); });
  threads_.emplace_back([this] { clean(); });
}

WorkerPool::~WorkerPool() {
  stop();
  for (std::thread& thread : threads_) thread.join();
}

// ---- calls from outside

void WorkerPool::notify() {
  {
    const std::lock_guard guard(mutex_);
    ++submitted_;
  }
  work_to_do_.notify_all();  // not every worker takes every job
}

void WorkerPool::wake_waiters() {
  {
    const std::lock_guard guard(mutex_);
    ++ended_;
  }
  changed_.notify_all();
}

bool WorkerPool::wait(const std::string& id, Clock::time_point deadline, const std::function<bool()>& gone) {
  for (;;) {
    std::unique_lock lock(mutex_);
    const std::uint64_t seen = ended_;
    const bool stopped = stopped_;
    lock.unlock();
    const auto job = store_.find(id);
    if (!job || is_terminal(job->status)) return true;
    if (stopped) return false;

    const Clock::time_point look_again = Clock::now() + kLookEvery;
    for (bool changed = false; !changed && Clock::now() < look_again;) {
      if (Clock::now() >= deadline || (gone && gone())) return false;
      lock.lock();
      changed = changed_.wait_until(lock, std::min(deadline, Clock::now() + kAskGoneEvery),
                                    [&] { return stopped_ || ended_ != seen; });
      lock.unlock();
    }
  }
}

CancelOutcome WorkerPool::cancel(const std::string& id) {
  const auto stop_local_runs = [&] {
    for (const RunPointer& run : runs()) {
      if (run->claim.id == id) run->stop_because(Run::Reason::dismissed);
    }
  };
  CancelOutcome outcome = CancelOutcome::unknown;
  try {
    // The store first: a run that stops before the store knows why would make the answer "already over".
    outcome = store_.cancel(id);
  } catch (const Error&) {
    stop_local_runs();
    throw;
  }
  stop_local_runs();
  wake_waiters();
  on_event_();
  return outcome;
}

bool WorkerPool::stop() {
  std::vector<RunPointer> deaf;
  {
    std::unique_lock lock(mutex_);
    stopping_ = true;
    for (const RunPointer& run : runs_) run->stop_because(Run::Reason::stopping);
    work_to_do_.notify_all();
    pause_over_.notify_all();
    changed_.wait_for(lock, milliseconds(options_.stop_grace_ms), [this] { return runs_.empty(); });
    deaf = runs_;
  }
  for (const RunPointer& run : deaf) {
    try {
      store_.release(run->claim);
    } catch (const Error& error) {
      spdlog::error("job {} can't go back to the queue before its lease ends: {}", run->claim.id,
                    error.what());
    }
  }
  {
    const std::lock_guard guard(mutex_);
    stopped_ = true;
  }
  wake_waiters();
  return deaf.empty();
}

// ---- workers

void WorkerPool::work(bool attached_only) {
  for (;;) {
    std::unique_lock lock(mutex_);
    if (stopping_) return;
    const std::uint64_t seen = submitted_;
    lock.unlock();
    if (claim_and_run(attached_only)) continue;
    lock.lock();
    work_to_do_.wait_for(lock, milliseconds(options_.claim_every_ms),
                         [&] { return stopping_ || submitted_ != seen; });
  }
}

bool WorkerPool::claim_and_run(bool attached_only) {
  std::optional<Claim> claim;
  try {
    claim = store_.claim(options_.name, attached_only);
  } catch (const std::exception& error) {  // also when the request doesn't fit into memory
    spdlog::error("no job can be claimed: {}", error.what());
    return false;
  }
  if (!claim) return false;
  notify();  // where there was one job there may be another one: let the next idle worker look
  execute(begin(std::move(*claim)));
  return true;
}

WorkerPool::RunPointer WorkerPool::begin(Claim claim) {
  auto run = std::make_shared<Run>(std::move(claim), options_.threads_per_job);
  if (run->claim.spec.attached && options_.attached_limit_ms < options_.job_limit_ms) {
    run->set_deadline(
        Clock::now() + milliseconds(options_.attached_limit_ms),
        "this takes longer than a synchronous answer may, and longer than was estimated; send the header "
        "Prefer: respond-async and fetch the result later");
  } else {
    run->set_deadline(Clock::now() + milliseconds(options_.job_limit_ms));
  }
  {
    const std::lock_guard guard(mutex_);
    runs_.push_back(run);
    if (stopping_) run->stop_because(Run::Reason::stopping);
  }
  try {
    // A cancel between the claim and now found no run to stop.
    if (const auto job = store_.find(run->claim.id); job && job->cancel_requested) {
      run->stop_because(Run::Reason::dismissed);
    }
  } catch (const Error& error) {
    spdlog::warn("job {} starts without a look at its cancel flag: {}", run->claim.id, error.what());
  }
  return run;
}

void WorkerPool::execute(const RunPointer& run) {
  on_event_();
  const Clock::time_point started = Clock::now();
  Outcome outcome = compute(*run);
  if (write_ending(*run, outcome) && is_terminal(outcome.status)) {
    const std::chrono::duration<double> time = Clock::now() - started;
    const Claim& claim = run->claim;
    on_finished_({claim.id, claim.spec.operation, claim.spec.trace, outcome.status, time.count()});
  }
  finish(run);
  on_event_();
}

WorkerPool::Outcome WorkerPool::compute(Run& run) {
  Outcome outcome;
  std::optional<std::string> defect;
  try {
    run.check();
    outcome = {JobStatus::successful, run_(run.claim, run)};
  } catch (const Error& error) {
    const bool back = error.code() == ErrorCode::cancelled && run.reason() == Run::Reason::stopping;
    outcome = back ? Outcome{JobStatus::accepted, ""} : Outcome{JobStatus::failed, problem_for(error)};
  } catch (const std::exception& error) {
    defect = error.what();
  } catch (...) {
    defect = "an exception of unknown type";
  }
  if (defect) {
    spdlog::error("job {} failed by a defect of the program: {}", run.claim.id, *defect);
    outcome = {JobStatus::failed,
               problem_for(Error(ErrorCode::internal, "the job failed by a defect of the program"))};
  }
  if (run.reason() == Run::Reason::dismissed) return {JobStatus::dismissed, ""};
  return outcome;
}

bool WorkerPool::write_ending(const Run& run, Outcome& outcome) {
  for (int tries = 1; run.reason() != Run::Reason::lost; ++tries) {
    try {
      return write_ending_once(run.claim, outcome);
    } catch (const Error& error) {
      spdlog::error("the end of job {} can't be written: {}", run.claim.id, error.what());
      if (error.code() == ErrorCode::storage_full && outcome.status == JobStatus::successful) {
        outcome = {JobStatus::failed, problem_for(error)};  // smaller than the result
      } else if (tries >= kEndingTries || !pause(kRetryAfter)) {
        return false;  // its lease runs out, and it's computed again
      }
    }
  }
  return false;
}

bool WorkerPool::write_ending_once(const Claim& claim, const Outcome& outcome) {
  switch (outcome.status) {
    case JobStatus::successful:
      return store_.complete(claim, outcome.bytes);
    case JobStatus::failed:
      return store_.fail(claim, outcome.bytes);
    case JobStatus::dismissed:
      return store_.dismiss(claim);
    case JobStatus::accepted:
    case JobStatus::running:
      break;
  }
  return store_.release(claim);
}

void WorkerPool::finish(const RunPointer& run) {
  {
    const std::lock_guard guard(mutex_);
    runs_.erase(std::remove(runs_.begin(), runs_.end(), run), runs_.end());
  }
  wake_waiters();
}

// ---- heartbeats, progress, expiry

std::vector<WorkerPool::RunPointer> WorkerPool::runs() {
  const std::lock_guard guard(mutex_);
  return runs_;
}

// False: the pool is stopping.
bool WorkerPool::pause(milliseconds time) {
  std::unique_lock lock(mutex_);
  return !pause_over_.wait_for(lock, time, [this] { return stopping_; });
}

void WorkerPool::tend() {
  // A heartbeat comes late by a tick at most: after half of a lease.
  const milliseconds tick(
      std::max<std::int64_t>(1, std::min(options_.progress_every_ms, options_.lease_ms / 6)));
  while (pause(tick)) {
    for (const RunPointer& run : runs()) {
      try {
        tend_run(*run);
      } catch (const Error& error) {
        spdlog::error("no heartbeat for job {}: {}", run->claim.id, error.what());
      }
    }
  }
}

void WorkerPool::tend_run(Run& run) {
  const Clock::time_point now = Clock::now();
  if (const auto progress = run.take_progress()) {
    run.latest = *progress;
    run.event_due = run.heartbeat_due = true;
  }
  const milliseconds third(options_.lease_ms / 3);
  const milliseconds pulse = run.heartbeat_due ? std::min(third, kHeartbeatWithProgressEvery) : third;
  const bool tells = run.event_due && now >= run.next_event;
  if (tells || now - run.last_heartbeat >= pulse) {  // what is stored is never behind what was told
    const Heartbeat answer = store_.heartbeat(run.claim, run.latest.fraction, message_for(run.latest));
    run.last_heartbeat = now;
    run.heartbeat_due = false;
    if (!answer.still_ours) return run.stop_because(Run::Reason::lost);
    if (answer.cancel) run.stop_because(Run::Reason::dismissed);
  }
  if (tells) {
    store_.append_event(run.claim, "progress", event_for(run.latest));
    run.next_event = now + milliseconds(options_.progress_every_ms);
    run.event_due = false;
    on_event_();
  }
}

// On a thread of its own: dropping a day's results may take longer than a heartbeat can wait.
void WorkerPool::clean() {
  do {
    try {
      store_.expire();
    } catch (const Error& error) {
      spdlog::error("expired results can't be dropped: {}", error.what());
    }
  } while (pause(milliseconds(options_.expire_every_ms)));
}

}  // namespace wellspaced
