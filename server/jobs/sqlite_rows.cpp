#include "server/jobs/sqlite_rows.h"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace wellspaced::rows {
namespace {

constexpr std::size_t kBlobRowBytes = std::size_t{1} << 20;

// The list of columns that read_job reads, in its order.
#define WELLSPACED_JOB_COLUMNS                                                                             \
  "id, operation, owner, trace, state, cancel, attached, progress, message, attempt, created, updated, "   \
  "started, "                                                                                              \
  "finished, expires, problem, result_bytes, CASE WHEN state = 'accepted' THEN (SELECT count(*) FROM job " \
  "AS q "                                                                                                  \
  "WHERE q.state = 'accepted' AND q.id <= job.id) ELSE 0 END"

Job read_job(const sqlite::Query& row) {
  Job job;
  job.id = row.text(0);
  job.operation = row.text(1);
  job.owner = row.text(2);
  job.trace = row.text(3);
  job.status = job_status_from(row.text(4));
  job.cancel_requested = row.integer(5) != 0;
  job.attached = row.integer(6) != 0;
  job.progress = row.real(7);
  job.message = row.text(8);
  job.attempt = static_cast<int>(row.integer(9));
  job.created_ms = row.integer(10);
  job.updated_ms = row.integer(11);
  job.started_ms = row.optional_integer(12);
  job.finished_ms = row.optional_integer(13);
  job.expires_ms = row.optional_integer(14);
  job.problem = row.text(15);
  job.result_bytes = row.integer(16);
  job.queue_position = row.integer(17);
  return job;
}

std::vector<std::string> ids_of(sqlite::Query row) {
  std::vector<std::string> ids;
  while (row.step()) ids.push_back(row.text(0));
  return ids;
}

}  // namespace

std::optional<Job> find(sqlite::Connection& connection, const std::string& id) {
  sqlite::Query row = connection.query("SELECT " WELLSPACED_JOB_COLUMNS " FROM job WHERE id = ?1", id);
  if (!row.step()) return std::nullopt;
  return read_job(row);
}

std::vector<Job> list(sqlite::Connection& connection, const JobFilter& filter) {
  const std::string before = filter.cursor.empty() ? "~" : filter.cursor;  // '~' is above every id
  sqlite::Query row = connection.query(
      "SELECT " WELLSPACED_JOB_COLUMNS
      " FROM job WHERE owner = ?1 AND id < ?2 AND (?3 = '' OR state = ?3) AND (?4 = '' OR operation = ?4)"
      " ORDER BY id DESC LIMIT ?5",
      filter.owner, before, filter.status ? to_string(*filter.status) : "", filter.operation,
      std::max(filter.limit, 0));  // a negative LIMIT means none
  std::vector<Job> jobs;
  while (row.step()) jobs.push_back(read_job(row));
  return jobs;
}

void insert(sqlite::Connection& connection, const std::string& id, const JobSpec& spec, std::int64_t now_ms) {
  connection.run(
      "INSERT INTO job (id, operation, owner, content_type, query, trace, attached, request_bytes, needs, "
      "state, created, updated) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, 'accepted', ?10, ?10)",
      id, spec.operation, spec.owner, spec.content_type, spec.query, spec.trace, spec.attached,
      static_cast<std::int64_t>(spec.request.size()), spec.needs, now_ms);
  write_blob(connection, id, 0, spec.request);
  for (const std::string& domain : spec.domains)
    connection.run("INSERT OR IGNORE INTO job_domain (job, owner, domain) VALUES (?1, ?2, ?3)", id,
                   spec.owner, domain);
}

JobSpec spec_of(sqlite::Connection& connection, const std::string& id) {
  sqlite::Query row = connection.query(
      "SELECT operation, owner, content_type, query, trace, attached, request_bytes, needs FROM job WHERE id "
      "= ?1",
      id);
  if (!row.step()) throw Error(ErrorCode::no_such_job, "there is no job \"" + id + "\" any more");
  JobSpec spec;
  spec.operation = row.text(0);
  spec.owner = row.text(1);
  spec.content_type = row.text(2);
  spec.query = row.text(3);
  spec.trace = row.text(4);
  spec.attached = row.integer(5) != 0;
  spec.needs = row.text(7);
  spec.request = read_blob(connection, id, 0, row.integer(6));
  return spec;
}

void write_blob(sqlite::Connection& connection, const std::string& id, int attempt,
                const std::string& bytes) {
  const std::string_view all = bytes;
  std::int64_t row = 0;
  for (std::size_t at = 0; at < all.size(); at += kBlobRowBytes) {
    connection.run("INSERT INTO blob (job, attempt, seq, data) VALUES (?1, ?2, ?3, ?4)", id, attempt, row++,
                   sqlite::Blob{all.substr(at, kBlobRowBytes)});
  }
}

std::string read_blob(sqlite::Connection& connection, const std::string& id, int attempt, std::int64_t size) {
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(size));
  sqlite::Query row =
      connection.query("SELECT data FROM blob WHERE job = ?1 AND attempt = ?2 ORDER BY seq", id, attempt);
  while (row.step()) bytes += row.view(0);
  if (bytes.size() != static_cast<std::size_t>(size)) {
    throw Error(ErrorCode::storage_unavailable, "the job store has lost bytes of job \"" + id +
                                                    "\": its file is damaged; submit the job again");
  }
  return bytes;
}

std::optional<std::string> live_job_that_needs(sqlite::Connection& connection, const std::string& id) {
  sqlite::Query row = connection.query(
      "SELECT id FROM job WHERE needs = ?1 AND needs <> '' AND state IN ('accepted', 'running') LIMIT 1", id);
  if (!row.step()) return std::nullopt;
  return row.text(0);
}

std::vector<LostRun> with_lease_until(sqlite::Connection& connection, std::int64_t time_ms) {
  sqlite::Query row = connection.query(
      "SELECT id, crashes + 1, attached, cancel FROM job WHERE state = 'running' AND lease_until <= ?1 ORDER "
      "BY id",
      time_ms);
  std::vector<LostRun> runs;
  while (row.step()) {
    runs.push_back({row.text(0), static_cast<int>(row.integer(1)), row.integer(2) != 0, row.integer(3) != 0});
  }
  return runs;
}

void append_event(sqlite::Connection& connection, const std::string& id, const std::string& type,
                  const std::string& json, int cap) {
  std::int64_t sequence = 0;
  {
    sqlite::Query next =
        connection.query("UPDATE job SET last_event = last_event + 1 WHERE id = ?1 RETURNING last_event", id);
    while (next.step()) sequence = next.integer(0);
  }
  connection.run("INSERT INTO event (job, seq, type, json) VALUES (?1, ?2, ?3, ?4)", id, sequence, type,
                 json);
  connection.run("DELETE FROM event WHERE job = ?1 AND seq <= ?2", id, sequence - cap);
}

void announce(sqlite::Connection& connection, const std::string& id, const std::string& type, int cap) {
  nlohmann::ordered_json state;
  {
    sqlite::Query row = connection.query("SELECT state, progress, attempt FROM job WHERE id = ?1", id);
    if (!row.step()) return;
    state = {{"id", id}, {"status", row.text(0)}, {"progress", row.real(1)}, {"attempt", row.integer(2)}};
  }
  append_event(connection, id, type, state.dump(), cap);
}

std::vector<JobEvent> events_after(sqlite::Connection& connection, const std::string& id,
                                   std::int64_t sequence) {
  sqlite::Query row = connection.query(
      "SELECT seq, type, json FROM event WHERE job = ?1 AND seq > ?2 ORDER BY seq", id, sequence);
  std::vector<JobEvent> events;
  while (row.step()) events.push_back({row.integer(0), row.text(1), row.text(2)});
  return events;
}

void erase(sqlite::Connection& connection, const std::string& id) {
  connection.run("DELETE FROM event WHERE job = ?1", id);
  connection.run("DELETE FROM blob WHERE job = ?1", id);
  connection.run("DELETE FROM job_domain WHERE job = ?1", id);
  connection.run("DELETE FROM job WHERE id = ?1", id);
}

int drop_results(sqlite::Connection& connection, std::int64_t time_ms, int limit) {
  const std::vector<std::string> ids = ids_of(connection.query(
      "SELECT id FROM job WHERE result_kept = 1 AND expires <= ?1 AND NOT EXISTS (SELECT 1 FROM job AS user"
      " WHERE user.needs = job.id AND user.needs <> '' AND user.state IN ('accepted', 'running')) LIMIT ?2",
      time_ms, limit));
  for (const std::string& id : ids) {
    connection.run("DELETE FROM blob WHERE job = ?1", id);
    connection.run("DELETE FROM job_domain WHERE job = ?1", id);
    connection.run("UPDATE job SET result_kept = 0, updated = ?2 WHERE id = ?1", id, time_ms);
  }
  return static_cast<int>(ids.size());
}

int drop_jobs(sqlite::Connection& connection, std::int64_t time_ms, int limit) {
  const std::vector<std::string> ids = ids_of(connection.query(
      "SELECT id FROM job WHERE expires <= ?1 AND result_kept = 0 LIMIT ?2", time_ms, limit));
  for (const std::string& id : ids) erase(connection, id);
  return static_cast<int>(ids.size());
}

}  // namespace wellspaced::rows
