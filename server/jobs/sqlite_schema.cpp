#include "server/jobs/sqlite_schema.h"

#include <array>

#include "core/error.h"

namespace wellspaced {
namespace {

constexpr std::int64_t kApplicationId = 0x77656c6c;  // "well", so that `file` and we can tell our files

// Step i brings version i to version i + 1. A step that was released is never changed; add another one.
//
// job.attempt: number of claims, the fencing token. job.crashes: claims that ended with their worker's death.
// blob.attempt: 0 = the request, else the result of that attempt, in rows of 1 MiB.
constexpr std::array kSteps = {R"sql(
CREATE TABLE job (
  id TEXT PRIMARY KEY NOT NULL,
  operation TEXT NOT NULL, owner TEXT NOT NULL, content_type TEXT NOT NULL, query TEXT NOT NULL, trace TEXT NOT NULL,
  attached INTEGER NOT NULL, request_bytes INTEGER NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
  cancel INTEGER NOT NULL DEFAULT 0,
  attempt INTEGER NOT NULL DEFAULT 0,
  crashes INTEGER NOT NULL DEFAULT 0,
  worker TEXT NOT NULL DEFAULT '',
  lease_until INTEGER,
  progress REAL NOT NULL DEFAULT 0,
  message TEXT NOT NULL DEFAULT '',
  problem TEXT NOT NULL DEFAULT '',
  result_bytes INTEGER NOT NULL DEFAULT 0,
  result_kept INTEGER NOT NULL DEFAULT 0,
  last_event INTEGER NOT NULL DEFAULT 0,
  created INTEGER NOT NULL, updated INTEGER NOT NULL, started INTEGER, finished INTEGER, expires INTEGER
) WITHOUT ROWID;
CREATE INDEX job_by_state ON job (state, id);
CREATE INDEX job_by_owner ON job (owner, id);
CREATE INDEX job_live_by_owner ON job (owner) WHERE state IN ('accepted', 'running');
CREATE INDEX job_by_expiry ON job (expires) WHERE expires IS NOT NULL;
CREATE INDEX job_by_result_expiry ON job (expires) WHERE result_kept = 1;

CREATE TABLE blob (
  job TEXT NOT NULL, attempt INTEGER NOT NULL, seq INTEGER NOT NULL, data BLOB NOT NULL,
  PRIMARY KEY (job, attempt, seq)
);

CREATE TABLE event (
  job TEXT NOT NULL, seq INTEGER NOT NULL, type TEXT NOT NULL, json TEXT NOT NULL,
  PRIMARY KEY (job, seq)
) WITHOUT ROWID;
)sql",
                               // needs: the job whose result the request takes its points from, or ''.
                               R"sql(
ALTER TABLE job ADD COLUMN needs TEXT NOT NULL DEFAULT '';
CREATE INDEX job_live_by_needs ON job (needs) WHERE needs <> '' AND state IN ('accepted', 'running');
)sql",
                               // job_domain: the domains that a live job's request or a kept result lies on.
                               R"sql(
CREATE TABLE domain (
  owner TEXT NOT NULL, id TEXT NOT NULL, format TEXT NOT NULL, allow_self_intersections INTEGER NOT NULL,
  facts TEXT NOT NULL, bytes INTEGER NOT NULL, created INTEGER NOT NULL, expires INTEGER NOT NULL,
  PRIMARY KEY (owner, id)
) WITHOUT ROWID;
CREATE INDEX domain_by_expiry ON domain (expires);
CREATE TABLE domain_blob (
  owner TEXT NOT NULL, domain TEXT NOT NULL, seq INTEGER NOT NULL, data BLOB NOT NULL,
  PRIMARY KEY (owner, domain, seq)
);
CREATE TABLE job_domain (
  job TEXT NOT NULL, owner TEXT NOT NULL, domain TEXT NOT NULL,
  PRIMARY KEY (job, domain)
) WITHOUT ROWID;
CREATE INDEX job_domain_by_domain ON job_domain (owner, domain);
)sql"};

constexpr auto kNewest = static_cast<std::int64_t>(kSteps.size());

std::int64_t check_version(sqlite::Connection& connection) {
  const std::int64_t version = connection.integer("PRAGMA user_version");
  const bool empty = connection.integer("SELECT count(*) FROM sqlite_master") == 0;
  if (!empty && connection.integer("PRAGMA application_id") != kApplicationId) {
    throw Error(ErrorCode::storage_unavailable,
                "this is another program's database; choose another path for the job store");
  }
  if (version > kNewest) {
    throw Error(ErrorCode::storage_unavailable,
                "its schema has version " + std::to_string(version) + ", this program knows versions up to " +
                    std::to_string(kNewest) +
                    "; run the newer program or choose another path for the job store");
  }
  return version;
}

void configure(sqlite::Connection& connection) {
  if (sqlite::Query mode = connection.query("PRAGMA journal_mode = WAL");
      !mode.step() || mode.view(0) != "wal") {
    throw Error(ErrorCode::storage_unavailable,
                "its file system can't keep a write-ahead log; choose a path on a local disk");
  }
  connection.execute(
      "PRAGMA synchronous = FULL; PRAGMA journal_size_limit = 67108864;"
      // Debian's SQLite overwrites deleted rows with zeros, which makes dropping a big result as dear as
      // writing it.
      "PRAGMA secure_delete = FAST;");
}

}  // namespace

void prepare_schema(sqlite::Connection& connection) {
  check_version(connection);  // before anything is written to a file that may not be ours
  configure(connection);
  sqlite::Transaction transaction(connection, sqlite::Transaction::Kind::write);
  for (std::int64_t version = check_version(connection); version < kNewest; ++version) {
    connection.execute(kSteps[static_cast<std::size_t>(version)]);
  }
  connection.execute("PRAGMA application_id = " + std::to_string(kApplicationId) +
                     "; PRAGMA user_version = " + std::to_string(kNewest));
  transaction.commit();
}

void join_schema(sqlite::Connection& connection) {
  if (check_version(connection) < kNewest) {
    throw Error(
        ErrorCode::storage_unavailable,
        "an older program still uses it; stop that one first, so that the schema can be brought up to date");
  }
  configure(connection);
}

}  // namespace wellspaced
