#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "server/jobs/job_store.h"

namespace wellspaced {

/// What only tests and the curious change; `open_sqlite_store(path, limits)` uses the defaults.
struct SqliteOptions {
  int busy_timeout_ms = 10'000;  ///< for another process's write lock
  std::int64_t max_pages = 0;    ///< size limit of the file in pages of 4 KiB; 0: the disk's
  std::shared_ptr<const std::atomic<std::int64_t>> clock_shift_ms;  ///< added to the database's clock
};

/// The store of job_store.h in one SQLite file, with "<path>-wal", "<path>-shm" and "<path>.lock" beside it.
///
/// Several processes may share the file. The first one to open it knows from the lock that every worker of
/// before is dead: running jobs go back to the queue at once (counting the crash) instead of after their
/// lease, and attached jobs, whose clients went with their connections, become dismissed.
///
/// Cost: a write is one fsync of the log; reads have a connection of their own and don't wait for writes.
std::unique_ptr<JobStore> open_sqlite_store(const std::string& path, const JobLimits& limits,
                                            const SqliteOptions& options);

}  // namespace wellspaced
