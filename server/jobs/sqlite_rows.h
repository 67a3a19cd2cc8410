#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/jobs/job.h"
#include "server/jobs/job_store.h"
#include "server/jobs/sqlite.h"

/// Jobs, blobs and events as rows: what the store's operations are made of. Each function runs inside its
/// caller's transaction and takes the store's time from it.
namespace wellspaced::rows {

std::optional<Job> find(sqlite::Connection& connection, const std::string& id);
std::vector<Job> list(sqlite::Connection& connection, const JobFilter& filter);

void insert(sqlite::Connection& connection, const std::string& id, const JobSpec& spec, std::int64_t now_ms);
/// The spec with its request's bytes. Requires: the job is live.
JobSpec spec_of(sqlite::Connection& connection, const std::string& id);

/// Blobs are kept in rows of 1 MiB; `attempt` 0 is the request.
void write_blob(sqlite::Connection& connection, const std::string& id, int attempt, const std::string& bytes);
/// Errors: storage_unavailable if the rows don't add up to `size`.
std::string read_blob(sqlite::Connection& connection, const std::string& id, int attempt, std::int64_t size);

/// The id of an accepted or running job that takes its points from the result of job `id`, if there is one.
std::optional<std::string> live_job_that_needs(sqlite::Connection& connection, const std::string& id);

/// A run whose worker is gone.
struct LostRun {
  std::string id;
  int crashes = 0;  ///< with this one
  bool attached = false, cancelled = false;
};

/// Running jobs whose worker's lease ended at `time_ms` or before.
std::vector<LostRun> with_lease_until(sqlite::Connection& connection, std::int64_t time_ms);

/// Keeps the newest `cap` events.
void append_event(sqlite::Connection& connection, const std::string& id, const std::string& type,
                  const std::string& json, int cap);
/// An event of `type` with the job's state: {"id","status","progress","attempt"}.
void announce(sqlite::Connection& connection, const std::string& id, const std::string& type, int cap);
std::vector<JobEvent> events_after(sqlite::Connection& connection, const std::string& id,
                                   std::int64_t sequence);

/// Deletes the job and all that belongs to it.
void erase(sqlite::Connection& connection, const std::string& id);

/// Drop at most `limit`: the results whose time is over and that no live job needs; the jobs without a kept
/// result whose `expires` is not after `time_ms`. Return how many that were.
int drop_results(sqlite::Connection& connection, std::int64_t time_ms, int limit);
int drop_jobs(sqlite::Connection& connection, std::int64_t time_ms, int limit);

}  // namespace wellspaced::rows
