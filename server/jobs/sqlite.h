#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

struct sqlite3;
struct sqlite3_stmt;

/// A thin, exception-safe layer over SQLite's C interface: nothing here knows what a job is.
///
/// Errors of every call: storage_full (no room on the disk, in the quota, or within max_page_count) and
/// storage_unavailable (everything else). The text never holds a path: it may reach clients.
/// Thread safety: none; one thread at a time per connection.
namespace wellspaced::sqlite {

/// Bytes to bind as a BLOB without a copy; must outlive the query.
struct Blob {
  std::string_view bytes;
};

class Connection;

/// One run of a prepared statement. Columns and parameters count from 0 and 1, as in SQLite.
class Query {
 public:
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;
  /// Returns the statement to its connection.
  ~Query();

  /// To the next row; false when there is none.
  bool step();

  bool is_null(int column) const;
  std::int64_t integer(int column) const;
  std::optional<std::int64_t> optional_integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;       ///< also the bytes of a BLOB
  std::string_view view(int column) const;  ///< until the next step

 private:
  friend class Connection;
  struct Prepare {};
  template <class... Arguments>
  Query(Connection& connection, std::string_view sql, const Arguments&... arguments)
      : Query(connection, sql, Prepare()) {
    int index = 0;
    (bind(++index, arguments), ...);
  }
  Query(Connection& connection, std::string_view sql, Prepare);
  void bind(int index, std::int64_t value);
  void bind(int index, int value) { bind(index, std::int64_t{value}); }
  void bind(int index, bool value) { bind(index, std::int64_t{value ? 1 : 0}); }
  void bind(int index, double value);
  void bind(int index, std::string_view value);  // copies
  void bind(int index, const std::string& value) { bind(index, std::string_view(value)); }
  void bind(int index, const char* value) { bind(index, std::string_view(value)); }
  void bind(int index, Blob value);

  Connection& connection_;
  std::string_view sql_;
  sqlite3_stmt* statement_ = nullptr;
};

class Connection {
 public:
  enum class Mode { read_write_create, read_only };

  /// Waits up to `busy_timeout_ms` for a lock that another process holds.
  Connection(const std::string& path, Mode mode, int busy_timeout_ms);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Statements are prepared once and kept: `sql` must be a literal (or live as long as the connection).
  template <class... Arguments>
  Query query(std::string_view sql, const Arguments&... arguments) {
    return {*this, sql, arguments...};
  }

  /// Runs to the end; the number of rows that an INSERT, UPDATE or DELETE touched.
  template <class... Arguments>
  int run(std::string_view sql, const Arguments&... arguments) {
    Query once(*this, sql, arguments...);
    while (once.step()) {
    }
    return changes();
  }

  /// Several statements without parameters or rows (schema, pragmas).
  void execute(const std::string& script);
  /// The first column of the first row, 0 if there is none.
  std::int64_t integer(std::string_view sql);

  bool in_transaction() const;

 private:
  friend class Query;
  [[noreturn]] void raise(int code) const;
  int changes() const;

  sqlite3* handle_ = nullptr;
  std::unordered_map<std::string_view, sqlite3_stmt*> idle_;  // prepared statements that no query uses now
};

/// Rolls back unless committed.
class Transaction {
 public:
  enum class Kind {
    read,
    write
  };  ///< write takes the write lock at once, so it can't fail half-way for want of it
  Transaction(Connection& connection, Kind kind);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Connection& connection_;
};

}  // namespace wellspaced::sqlite
