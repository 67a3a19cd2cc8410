#include "server/jobs/sqlite.h"

#include <cerrno>

#include <sqlite3.h>

#include "core/error.h"

namespace wellspaced::sqlite {
namespace {

// SQLite itself says SQLITE_FULL only for ENOSPC; a quota or a file size limit comes as an I/O error.
bool means_full(int code, int system_error) {
  if ((code & 0xff) == SQLITE_FULL) return true;
  return (code & 0xff) == SQLITE_IOERR &&
         (system_error == ENOSPC || system_error == EDQUOT || system_error == EFBIG);
}

Error error_for(int code, int system_error, const std::string& detail) {
  if (means_full(code, system_error)) {
    return {ErrorCode::storage_full,
            "the job store has no room left; delete finished jobs or give its disk more space"};
  }
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {ErrorCode::storage_unavailable, "the job store is locked by another process; try again"};
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return {ErrorCode::storage_unavailable,
              "the job store's file is damaged or no SQLite database; restore it from a backup, or move it "
              "away and "
              "start with a new one"};
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return {ErrorCode::storage_unavailable, "the job store's file can't be written; check its permissions"};
    default:
      return {ErrorCode::storage_unavailable, "the job store can't be used (" + detail + "); check its disk"};
  }
}

}  // namespace

Connection::Connection(const std::string& path, Mode mode, int busy_timeout_ms) {
  const int flags =
      mode == Mode::read_only ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(path.c_str(), &handle_, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  if (code != SQLITE_OK) {
    const int system_error = handle_ == nullptr ? 0 : sqlite3_system_errno(handle_);
    sqlite3_close(handle_);
    throw error_for(code, system_error, sqlite3_errstr(code));
  }
  sqlite3_extended_result_codes(handle_, 1);
  sqlite3_busy_timeout(handle_, busy_timeout_ms);
}

Connection::~Connection() {
  for (const auto& [sql, statement] : idle_) sqlite3_finalize(statement);
  sqlite3_close_v2(handle_);
}

void Connection::raise(int code) const {
  throw error_for(code, sqlite3_system_errno(handle_), sqlite3_errmsg(handle_));
}

int Connection::changes() const { return sqlite3_changes(handle_); }

bool Connection::in_transaction() const { return sqlite3_get_autocommit(handle_) == 0; }

void Connection::execute(const std::string& script) {
  const int code = sqlite3_exec(handle_, script.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) raise(code);
}

std::int64_t Connection::integer(std::string_view sql) {
  Query once(*this, sql);
  return once.step() ? once.integer(0) : 0;
}

Query::Query(Connection& connection, std::string_view sql, Prepare) : connection_(connection), sql_(sql) {
  if (const auto found = connection.idle_.find(sql); found != connection.idle_.end()) {
    statement_ = found->second;
    connection.idle_.erase(found);
    return;
  }
  const int code = sqlite3_prepare_v3(connection.handle_, sql.data(), static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &statement_, nullptr);
  if (code != SQLITE_OK) connection.raise(code);
}

Query::~Query() {
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
  if (!connection_.idle_.emplace(sql_, statement_).second) sqlite3_finalize(statement_);
}

bool Query::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) connection_.raise(code);
  return false;
}

bool Query::is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }

std::int64_t Query::integer(int column) const { return sqlite3_column_int64(statement_, column); }

std::optional<std::int64_t> Query::optional_integer(int column) const {
  if (is_null(column)) return std::nullopt;
  return integer(column);
}

double Query::real(int column) const { return sqlite3_column_double(statement_, column); }

std::string Query::text(int column) const { return std::string(view(column)); }

std::string_view Query::view(int column) const {
  const void* data = sqlite3_column_blob(statement_, column);  // null for zero bytes
  const int size = sqlite3_column_bytes(statement_, column);
  return data == nullptr ? std::string_view()
                         : std::string_view(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

void Query::bind(int index, std::int64_t value) {
  const int code = sqlite3_bind_int64(statement_, index, value);
  if (code != SQLITE_OK) connection_.raise(code);
}

void Query::bind(int index, double value) {
  const int code = sqlite3_bind_double(statement_, index, value);
  if (code != SQLITE_OK) connection_.raise(code);
}

void Query::bind(int index, std::string_view value) {
  const char* data = value.empty() ? "" : value.data();  // a null pointer would bind NULL
  const int code = sqlite3_bind_text64(statement_, index, data, value.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  if (code != SQLITE_OK) connection_.raise(code);
}

void Query::bind(int index, Blob value) {
  const char* data = value.bytes.empty() ? "" : value.bytes.data();
  const int code = sqlite3_bind_blob64(statement_, index, data, value.bytes.size(), SQLITE_STATIC);
  if (code != SQLITE_OK) connection_.raise(code);
}

Transaction::Transaction(Connection& connection, Kind kind) : connection_(connection) {
  connection_.run(kind == Kind::write ? "BEGIN IMMEDIATE" : "BEGIN");
}

Transaction::~Transaction() {
  // Some errors (a full disk) roll back by themselves; then there is nothing left to do.
  if (!connection_.in_transaction()) return;
  try {
    connection_.run("ROLLBACK");
  } catch (const Error&) {
    // The rollback of a broken disk: SQLite undoes the transaction when the file is opened again.
  }
}

void Transaction::commit() { connection_.run("COMMIT"); }

}  // namespace wellspaced::sqlite
