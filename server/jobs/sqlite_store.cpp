#include "server/jobs/sqlite_store.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/stat.h>

#include "core/error.h"
#include "server/jobs/job_id.h"
#include "server/jobs/process_lock.h"
#include "server/jobs/sqlite.h"
#include "server/jobs/sqlite_domains.h"
#include "server/jobs/sqlite_rows.h"
#include "server/jobs/sqlite_schema.h"
#include "server/problem.h"

namespace wellspaced {
namespace {

using Connection = sqlite::Connection;
using Transaction = sqlite::Transaction;

/// How a job ends.
struct Ending {
  JobStatus status = JobStatus::dismissed;
  std::string message;
  std::string problem = "";
};

std::string crash_problem(int crashes) {
  const std::string detail = "the worker of this job died " + std::to_string(crashes) +
                             " times; make the job smaller, or report it together with its request";
  return to_json(to_problem(Error(ErrorCode::worker_crashed, detail)), "");
}

/// Which file a path leads to now.
std::pair<dev_t, ino_t> identity(const std::string& path) {
  struct stat facts {};
  if (stat(path.c_str(), &facts) != 0) return {0, 0};
  return {facts.st_dev, facts.st_ino};
}

class SqliteStore final : public JobStore {
 public:
  SqliteStore(const std::string& path, const JobLimits& limits, const SqliteOptions& options);

  Job submit(const JobSpec& spec) override;
  std::optional<Claim> claim(const std::string& worker, bool attached_only) override;
  Heartbeat heartbeat(const Claim& claim, double progress, const std::string& message) override;
  bool complete(const Claim& claim, const std::string& result) override;
  bool fail(const Claim& claim, const std::string& problem_json) override;
  bool dismiss(const Claim& claim) override;
  bool release(const Claim& claim) override;
  std::optional<Job> find(const std::string& id) override;
  std::vector<Job> list(const JobFilter& filter) override;
  CancelOutcome cancel(const std::string& id) override;
  bool purge(const std::string& id) override;
  std::string result(const std::string& id) override;
  std::pair<DomainRecord, bool> add_domain(const DomainSpec& spec, const std::string& bytes) override;
  std::optional<DomainRecord> find_domain(const std::string& owner, const std::string& id) override;
  std::vector<DomainRecord> list_domains(const std::string& owner, const std::string& cursor,
                                         int limit) override;
  std::string domain_bytes(const std::string& owner, const std::string& id) override;
  bool delete_domain(const std::string& owner, const std::string& id) override;
  bool append_event(const Claim& claim, const std::string& type, const std::string& json) override;
  std::vector<JobEvent> events_after(const std::string& id, std::int64_t sequence) override;
  int expire() override;
  JobCounts counts() override;
  void ping() override;

 private:
  std::int64_t now(Connection& connection) const;

  /// Runs `body(now)` in one transaction of the writer, on disk when this returns; if it throws, nothing has
  /// happened.
  template <class Body>
  auto write(Body body) {
    const std::lock_guard guard(writer_mutex_);
    Transaction transaction(writer_, Transaction::Kind::write);
    auto answer = body(now(writer_));
    transaction.commit();
    return answer;
  }

  /// Runs `body(connection)` on one snapshot.
  template <class Body>
  auto read(Body body) {
    const std::lock_guard guard(reader_mutex_);
    Transaction transaction(*reader_, Transaction::Kind::read);
    return body(*reader_);
  }

  // All of these run inside a `write`.
  void check_room_for(const JobSpec& spec);
  void check_result(Connection& connection, const std::string& id);
  std::string next_id(std::int64_t now_ms);
  bool holds(const Claim& claim);
  void end(const std::string& id, const Ending& ending, std::int64_t now_ms);
  void requeue(const std::string& id, std::int64_t now_ms);
  void settle(const rows::LostRun& run, std::int64_t now_ms);
  void recover();

  const std::string path_;
  const JobLimits limits_;
  const std::shared_ptr<const std::atomic<std::int64_t>> clock_shift_ms_;
  ProcessLock lock_;
  std::mutex writer_mutex_, reader_mutex_;  // never held together
  Connection writer_;
  std::optional<Connection>
      reader_;  // declared last, closed first: the writer's close folds the log into the file
  std::pair<dev_t, ino_t> identity_;
};

SqliteStore::SqliteStore(const std::string& path, const JobLimits& limits, const SqliteOptions& options)
    : path_(path),
      limits_(limits),
      clock_shift_ms_(options.clock_shift_ms),
      lock_(path + ".lock"),
      writer_(path, Connection::Mode::read_write_create, options.busy_timeout_ms) {
  if (lock_.alone()) {
    prepare_schema(writer_);
    recover();
    lock_.share();
  } else {
    join_schema(writer_);
  }
  if (options.max_pages > 0) writer_.execute("PRAGMA max_page_count = " + std::to_string(options.max_pages));
  reader_.emplace(path, Connection::Mode::read_only, options.busy_timeout_ms);
  identity_ = identity(path);
}

std::int64_t SqliteStore::now(Connection& connection) const {
  const std::int64_t shift = clock_shift_ms_ ? clock_shift_ms_->load() : 0;
  return shift + connection.integer("SELECT CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER)");
}

// ---- into the queue

Job SqliteStore::submit(const JobSpec& spec) {
  return write([&](std::int64_t now_ms) {
    check_room_for(spec);
    if (!spec.needs.empty()) check_result(writer_, spec.needs);
    for (const std::string& domain : spec.domains) rows::domain(writer_, spec.owner, domain, now_ms);
    const std::string id = next_id(now_ms);
    rows::insert(writer_, id, spec, now_ms);
    rows::announce(writer_, id, "status", limits_.events_per_job);
    return rows::find(writer_, id).value();
  });
}

void SqliteStore::check_room_for(const JobSpec& spec) {
  if (writer_.integer("SELECT count(*) FROM job WHERE state = 'accepted'") >= limits_.queue) {
    throw Error(ErrorCode::overloaded, "the queue is full (" + std::to_string(limits_.queue) +
                                           " jobs are waiting); try again later");
  }
  if (spec.attached) return;
  sqlite::Query live = writer_.query(
      "SELECT count(*) FROM job WHERE state IN ('accepted', 'running') AND owner = ?1 AND attached = 0",
      spec.owner);
  live.step();
  if (live.integer(0) >= limits_.live_per_owner) {
    throw Error(ErrorCode::too_many_jobs,
                std::to_string(live.integer(0)) +
                    " of your jobs are waiting or running, which is the limit; wait for one "
                    "to finish or cancel one");
  }
}

// Strictly increasing, even within a millisecond and after the clock was set back: the order of ids is the
// order of submission, which the queue and the pages of a list rely on.
std::string SqliteStore::next_id(std::int64_t now_ms) {
  sqlite::Query newest = writer_.query("SELECT id FROM job ORDER BY id DESC LIMIT 1");
  const std::int64_t last_ms = newest.step() ? job_id_time_ms(newest.view(0)) : 0;
  return make_job_id(std::max(now_ms, last_ms + 1));
}

// ---- a worker's calls

std::optional<Claim> SqliteStore::claim(const std::string& worker, bool attached_only) {
  return write([&](std::int64_t now_ms) -> std::optional<Claim> {
    for (const rows::LostRun& run : rows::with_lease_until(writer_, now_ms)) settle(run, now_ms);
    Claim claim;
    {
      sqlite::Query taken = writer_.query(
          "UPDATE job SET state = 'running', attempt = attempt + 1, worker = ?1, lease_until = ?2, progress "
          "= 0,"
          " message = '', started = ?3, updated = ?3"
          " WHERE id = (SELECT id FROM job WHERE state = 'accepted' AND attached >= ?4 ORDER BY id"
          " LIMIT 1) RETURNING id, attempt",
          worker, now_ms + limits_.lease_ms, now_ms, attached_only);
      if (!taken.step()) return std::nullopt;
      claim.id = taken.text(0);
      claim.attempt = static_cast<int>(taken.integer(1));
    }
    rows::announce(writer_, claim.id, "status", limits_.events_per_job);
    claim.spec = rows::spec_of(writer_, claim.id);
    return claim;
  });
}

void SqliteStore::settle(const rows::LostRun& run, std::int64_t now_ms) {
  writer_.run("UPDATE job SET crashes = ?2 WHERE id = ?1", run.id, run.crashes);
  if (run.cancelled) {
    end(run.id, {JobStatus::dismissed, "cancelled"}, now_ms);
  } else if (run.attached) {
    end(run.id, {JobStatus::dismissed, "its worker died while a client was waiting; not tried again"},
        now_ms);
  } else if (run.crashes >= limits_.max_attempts) {
    end(run.id, {JobStatus::failed, "its worker died too often", crash_problem(run.crashes)}, now_ms);
  } else {
    requeue(run.id, now_ms);
  }
}

// Nobody else lives who could run or wait for anything in this file (see ProcessLock).
void SqliteStore::recover() {
  write([&](std::int64_t now_ms) {
    constexpr std::int64_t end_of_time = std::numeric_limits<std::int64_t>::max();
    for (const rows::LostRun& run : rows::with_lease_until(writer_, end_of_time)) settle(run, now_ms);
    std::vector<std::string> orphans;
    for (sqlite::Query row = writer_.query("SELECT id FROM job WHERE state = 'accepted' AND attached = 1");
         row.step();) {
      orphans.push_back(row.text(0));
    }
    for (const std::string& id : orphans) end(id, {JobStatus::dismissed, "its client is gone"}, now_ms);
    return true;
  });
}

bool SqliteStore::holds(const Claim& claim) {
  return writer_
      .query("SELECT 1 FROM job WHERE id = ?1 AND attempt = ?2 AND state = 'running'", claim.id,
             claim.attempt)
      .step();
}

Heartbeat SqliteStore::heartbeat(const Claim& claim, double progress, const std::string& message) {
  const double sane = progress > 0 ? std::min(progress, 1.0) : 0.0;  // NaN becomes 0
  return write([&](std::int64_t now_ms) {
    Heartbeat answer;
    sqlite::Query row = writer_.query(
        "UPDATE job SET lease_until = ?3, progress = max(progress, ?4), message = ?5, updated = ?6"
        " WHERE id = ?1 AND attempt = ?2 AND state = 'running' RETURNING cancel",
        claim.id, claim.attempt, now_ms + limits_.lease_ms, sane, message, now_ms);
    answer.still_ours = row.step();
    answer.cancel = answer.still_ours && row.integer(0) != 0;
    return answer;
  });
}

bool SqliteStore::complete(const Claim& claim, const std::string& result) {
  return write([&](std::int64_t now_ms) {
    const int held = writer_.run(
        "UPDATE job SET progress = 1, result_bytes = ?3, result_kept = 1"
        " WHERE id = ?1 AND attempt = ?2 AND state = 'running'",
        claim.id, claim.attempt, static_cast<std::int64_t>(result.size()));
    if (held == 0) return false;
    rows::write_blob(writer_, claim.id, claim.attempt, result);
    end(claim.id, {JobStatus::successful, ""}, now_ms);
    return true;
  });
}

bool SqliteStore::fail(const Claim& claim, const std::string& problem_json) {
  return write([&](std::int64_t now_ms) {
    const bool held = holds(claim);
    if (held) end(claim.id, {JobStatus::failed, "", problem_json}, now_ms);
    return held;
  });
}

bool SqliteStore::dismiss(const Claim& claim) {
  return write([&](std::int64_t now_ms) {
    const bool held = holds(claim);
    if (held) end(claim.id, {JobStatus::dismissed, "cancelled"}, now_ms);
    return held;
  });
}

bool SqliteStore::release(const Claim& claim) {
  return write([&](std::int64_t now_ms) {
    const auto job = rows::find(writer_, claim.id);
    if (!job || !holds(claim)) return false;
    if (job->cancel_requested || job->attached) {
      end(claim.id, {JobStatus::dismissed, job->cancel_requested ? "cancelled" : "the server is stopping"},
          now_ms);
    } else {
      requeue(claim.id, now_ms);
    }
    return true;
  });
}

// The attempt stays, so the old token is dead: the job isn't running now, and its next claim has the next
// number.
void SqliteStore::requeue(const std::string& id, std::int64_t now_ms) {
  writer_.run(
      "UPDATE job SET state = 'accepted', worker = '', lease_until = NULL, progress = 0, message = '', "
      "started = NULL,"
      " updated = ?2 WHERE id = ?1",
      id, now_ms);
  rows::announce(writer_, id, "status", limits_.events_per_job);
}

void SqliteStore::end(const std::string& id, const Ending& ending, std::int64_t now_ms) {
  writer_.run(
      "UPDATE job SET state = ?2, message = CASE WHEN ?3 = '' THEN message ELSE ?3 END, problem = ?4,"
      " lease_until = NULL, updated = ?5, finished = ?5, expires = ?6 WHERE id = ?1",
      id, to_string(ending.status), ending.message, ending.problem, now_ms, now_ms + limits_.keep_result_ms);
  writer_.run("DELETE FROM blob WHERE job = ?1 AND attempt = 0", id);
  if (ending.status != JobStatus::successful) writer_.run("DELETE FROM job_domain WHERE job = ?1", id);
  rows::announce(writer_, id, "status", limits_.events_per_job);
  rows::announce(writer_, id, "done", limits_.events_per_job);
}

// ---- everybody's calls

std::optional<Job> SqliteStore::find(const std::string& id) {
  return read([&](Connection& connection) { return rows::find(connection, id); });
}

std::vector<Job> SqliteStore::list(const JobFilter& filter) {
  return read([&](Connection& connection) { return rows::list(connection, filter); });
}

CancelOutcome SqliteStore::cancel(const std::string& id) {
  return write([&](std::int64_t now_ms) {
    const auto job = rows::find(writer_, id);
    if (!job) return CancelOutcome::unknown;
    if (is_terminal(job->status)) return CancelOutcome::already_over;
    writer_.run("UPDATE job SET cancel = 1, updated = ?2 WHERE id = ?1", id, now_ms);
    if (job->status == JobStatus::accepted) end(id, {JobStatus::dismissed, "cancelled"}, now_ms);
    return CancelOutcome::requested;
  });
}

bool SqliteStore::purge(const std::string& id) {
  return write([&](std::int64_t) {
    const auto job = rows::find(writer_, id);
    const bool over = job && is_terminal(job->status);
    if (const auto user = over ? rows::live_job_that_needs(writer_, id) : std::nullopt) {
      throw Error(ErrorCode::conflict, "job " + *user +
                                           " has yet to take its points from this result; wait " +
                                           "until it is over, or cancel it first");
    }
    if (over) rows::erase(writer_, id);
    return over;
  });
}

std::string SqliteStore::result(const std::string& id) {
  return read([&](Connection& connection) {
    check_result(connection, id);
    const auto job = rows::find(connection, id);
    return rows::read_blob(connection, id, job->attempt, job->result_bytes);
  });
}

void SqliteStore::check_result(Connection& connection, const std::string& id) {
  sqlite::Query row = connection.query("SELECT result_kept FROM job WHERE id = ?1", id);
  const auto job = rows::find(connection, id);
  if (!job || !row.step()) {
    throw Error(ErrorCode::no_such_job,
                "there is no such job; it may have been purged, or its id is mistyped");
  }
  if (!is_terminal(job->status)) {
    throw Error(ErrorCode::result_not_ready, std::string("the job is ") + to_string(job->status) +
                                                 "; ask again when its status is successful");
  }
  if (job->status != JobStatus::successful) {
    throw Error(ErrorCode::conflict,
                std::string("the job is ") + to_string(job->status) + " and has no result; see its status");
  }
  // The clock decides, not how often `expire` happens to run.
  const bool over = job->expires_ms.value() <= now(connection);
  if (row.integer(0) == 0 || (over && !rows::live_job_that_needs(connection, id))) {
    throw Error(ErrorCode::result_expired, "the result's time is over; submit the job again");
  }
}

bool SqliteStore::append_event(const Claim& claim, const std::string& type, const std::string& json) {
  return write([&](std::int64_t) {
    const bool held = holds(claim);
    if (held) rows::append_event(writer_, claim.id, type, json, limits_.events_per_job);
    return held;
  });
}

std::vector<JobEvent> SqliteStore::events_after(const std::string& id, std::int64_t sequence) {
  return read([&](Connection& connection) { return rows::events_after(connection, id, sequence); });
}

// Few jobs a transaction, so that a day's worth of big results doesn't keep the others waiting.
constexpr int kDropBatch = 16;

int SqliteStore::expire() {
  int total = 0;
  const auto drop_all = [&](auto drop, std::int64_t age_ms) {
    int dropped = kDropBatch;
    while (dropped == kDropBatch) {
      if (total > 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));  // a mutex isn't fair: let others in
      dropped = write([&](std::int64_t now_ms) { return drop(writer_, now_ms - age_ms, kDropBatch); });
      total += dropped;
    }
  };
  drop_all(&rows::drop_results, 0);
  drop_all(&rows::drop_jobs, limits_.keep_result_ms);
  drop_all(&rows::drop_domains, 0);
  return total;
}

// ---- domains

std::pair<DomainRecord, bool> SqliteStore::add_domain(const DomainSpec& spec, const std::string& bytes) {
  return write([&](std::int64_t now_ms) {
    return rows::add_domain(writer_, spec, bytes, now_ms, now_ms + limits_.keep_result_ms);
  });
}

std::optional<DomainRecord> SqliteStore::find_domain(const std::string& owner, const std::string& id) {
  return read([&](Connection& c) { return rows::find_domain(c, owner, id, now(c)); });
}

std::vector<DomainRecord> SqliteStore::list_domains(const std::string& owner, const std::string& cursor,
                                                    int limit) {
  return read([&](Connection& c) { return rows::list_domains(c, owner, cursor, limit, now(c)); });
}

std::string SqliteStore::domain_bytes(const std::string& owner, const std::string& id) {
  return read([&](Connection& c) { return rows::domain_bytes(c, rows::domain(c, owner, id, now(c))); });
}

bool SqliteStore::delete_domain(const std::string& owner, const std::string& id) {
  return write([&](std::int64_t now_ms) { return rows::delete_domain(writer_, owner, id, now_ms); });
}

JobCounts SqliteStore::counts() {
  return read([&](Connection& connection) {
    JobCounts counts;
    sqlite::Query row = connection.query(
        "SELECT (SELECT count(*) FROM job WHERE state = 'accepted'), (SELECT count(*) FROM job WHERE state = "
        "'running'),"
        " (SELECT min(created) FROM job WHERE state = 'accepted')");
    row.step();
    counts.accepted = row.integer(0);
    counts.running = row.integer(1);
    if (!row.is_null(2))
      counts.oldest_accepted_ms = std::max<std::int64_t>(0, now(connection) - row.integer(2));
    return counts;
  });
}

void SqliteStore::ping() {
  read([](Connection& connection) { return connection.integer("SELECT count(*) FROM job WHERE id = ''"); });
  // A deleted file goes on working for those who have it open, and then everything in it is gone.
  if (identity(path_) != identity_) {
    throw Error(ErrorCode::storage_unavailable,
                "the job store's file was moved or deleted while in use; put it back and restart");
  }
}

}  // namespace

std::unique_ptr<JobStore> open_sqlite_store(const std::string& path, const JobLimits& limits) {
  return open_sqlite_store(path, limits, SqliteOptions());
}

std::unique_ptr<JobStore> open_sqlite_store(const std::string& path, const JobLimits& limits,
                                            const SqliteOptions& options) {
  if (path.empty())
    throw Error(ErrorCode::storage_unavailable, "the job store needs a path; give it a file name");
  try {
    // Absolute, so that SQLite's names for special databases (":memory:") are files like any other.
    return std::make_unique<SqliteStore>(std::filesystem::absolute(path).string(), limits, options);
  } catch (const Error& error) {
    throw Error(error.code(), "can't open the job store \"" + path + "\": " + error.what());
  }
}

}  // namespace wellspaced
