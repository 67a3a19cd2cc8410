#pragma once

#include <string>

#include "server/jobs/sqlite.h"

namespace wellspaced {

/// Makes the file ready for this program: WAL, synchronous=FULL, and the tables of the newest version. An
/// older version is brought up to date; the version is in `PRAGMA user_version`.
///
/// Requires: nobody else has the file open (ProcessLock::alone).
/// Errors: storage_unavailable, saying what to do, for a file with a newer schema and for another program's
/// database.
void prepare_schema(sqlite::Connection& connection);

/// The same beside processes that already use the file: changes nothing in it.
/// Errors: storage_unavailable also for an older version, as the others can't follow to a newer one.
void join_schema(sqlite::Connection& connection);

}  // namespace wellspaced
