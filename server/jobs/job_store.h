#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/jobs/domain_record.h"
#include "server/jobs/job.h"

namespace wellspaced {

struct JobLimits {
  int queue = 1000;         ///< accepted jobs over all owners; above: Error{overloaded}
  int live_per_owner = 16;  ///< accepted or running, not attached; above: Error{too_many_jobs}
  std::int64_t lease_ms = 30'000;
  std::int64_t keep_result_ms = 24ll * 3600 * 1000;
  int max_attempts = 10;     ///< deaths of its worker, whatever the cause; then failed with worker_crashed
  int events_per_job = 256;  ///< the oldest are dropped first
};

struct JobFilter {
  std::string owner;
  std::optional<JobStatus> status;
  std::string operation;  ///< empty: any
  std::string cursor;     ///< id of the last job of the page before; empty: from the newest
  int limit = 50;
};

/// What a worker learns when it says that it is alive.
struct Heartbeat {
  bool still_ours = false;  ///< false: the lease was lost or the job is over; stop and write nothing
  bool cancel = false;
};

struct JobCounts {
  std::int64_t accepted = 0, running = 0;
  std::int64_t oldest_accepted_ms = 0;  ///< age of the oldest accepted job
};

enum class CancelOutcome { requested, already_over, unknown };

/// Jobs, their results and their events, and uploaded domains, durable.
///
/// Guarantees
/// 1. `submit` returns after the job is on disk: nothing acknowledged is lost by a crash at any time.
/// 2. A job's result is written once: complete, fail, release and heartbeat count only while (id, attempt)
/// holds the job.
/// 3. Only the store's clock decides about leases and expiry.
/// 4. An accepted job whose cancel is requested becomes dismissed at once; a running one when its worker says
/// so.
/// 5. Every change of status appends an event "status", the last one also "done", with
/// {"id","status","progress","attempt"}.
/// 6. A result that a live job needs is kept until that job is over, even past its time; it can't be purged.
/// 7. Ids ascend in the order of submission; each claim of a job has a greater attempt than the one before.
/// 8. A domain that a live job or a kept result lies on is kept, even past its time; it can't be deleted.
///
/// Errors of every call: storage_unavailable, storage_full. Thread safety: all calls from any thread.
class JobStore {
 public:
  virtual ~JobStore() = default;

  /// Errors: overloaded, too_many_jobs; those of `result` if the result that the job needs is not there;
  /// no_such_domain.
  virtual Job submit(const JobSpec& spec) = 0;

  /// The oldest accepted job, or one whose lease ran out (attempt + 1), or nothing. Jobs that ran out of
  /// attempts become failed (worker_crashed), attached ones whose lease ran out become dismissed.
  /// `attached_only`: only a job whose client waits for it.
  virtual std::optional<Claim> claim(const std::string& worker, bool attached_only = false) = 0;
  virtual Heartbeat heartbeat(const Claim& claim, double progress, const std::string& message) = 0;
  /// Each returns false, and changes nothing, if the claim no longer holds the job. A job whose cancel is
  /// requested may still be completed or failed: what reaches the store first counts.
  virtual bool complete(const Claim& claim, const std::string& result) = 0;
  virtual bool fail(const Claim& claim, const std::string& problem_json) = 0;
  virtual bool dismiss(const Claim& claim) = 0;  ///< the worker has stopped a cancelled job
  /// Back to the queue at its old place, not counted as a crash (shutdown). A cancelled or attached job
  /// becomes dismissed.
  virtual bool release(const Claim& claim) = 0;

  virtual std::optional<Job> find(const std::string& id) = 0;
  /// Newest first, at most `limit`; a full page means that there may be more.
  virtual std::vector<Job> list(const JobFilter& filter) = 0;
  virtual CancelOutcome cancel(const std::string& id) = 0;
  /// Deletes a finished job with its result. False if there is none such or it is live. Errors: conflict if a
  /// live job needs the result.
  virtual bool purge(const std::string& id) = 0;

  /// The result's bytes. Errors: no_such_job, result_not_ready, result_expired, conflict (failed or
  /// dismissed).
  virtual std::string result(const std::string& id) = 0;

  /// Keeps a domain, and says whether it is new to its owner; one that is there only gets its time anew.
  /// What is returned is on disk.
  virtual std::pair<DomainRecord, bool> add_domain(const DomainSpec& spec, const std::string& bytes) = 0;
  virtual std::optional<DomainRecord> find_domain(const std::string& owner, const std::string& id) = 0;
  /// In the order of their ids, at most `limit`, those after the id `cursor`.
  virtual std::vector<DomainRecord> list_domains(const std::string& owner, const std::string& cursor,
                                                 int limit) = 0;
  /// As they were uploaded. Errors: no_such_domain.
  virtual std::string domain_bytes(const std::string& owner, const std::string& id) = 0;
  /// False if there is none such. Errors: conflict naming a job, while one or its result lies on it.
  virtual bool delete_domain(const std::string& owner, const std::string& id) = 0;

  /// Appends an event (attempt-fenced); false if the claim no longer holds the job.
  virtual bool append_event(const Claim& claim, const std::string& type, const std::string& json) = 0;
  virtual std::vector<JobEvent> events_after(const std::string& id, std::int64_t sequence) = 0;

  /// Drops results whose time is over (the job row stays, expired, for as long again), then the rows, then
  /// domains. Number of rows touched.
  virtual int expire() = 0;
  virtual JobCounts counts() = 0;
  /// Throws if the store can't be used (readyz).
  virtual void ping() = 0;
};

/// The embedded default: one SQLite file (WAL, synchronous=FULL, one writer), created when absent.
/// Errors: storage_unavailable naming the path and the reason.
std::unique_ptr<JobStore> open_sqlite_store(const std::string& path, const JobLimits& limits);

}  // namespace wellspaced
