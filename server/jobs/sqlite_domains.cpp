#include "server/jobs/sqlite_domains.h"

#include <algorithm>
#include <string_view>

#include "core/error.h"

namespace wellspaced::rows {
namespace {

constexpr std::size_t kRowBytes = std::size_t{1} << 20;

// The list of columns that read_record reads, in its order.
#define WELLSPACED_DOMAIN_COLUMNS \
  "owner, id, format, allow_self_intersections, facts, bytes, created, expires"
#define WELLSPACED_DOMAIN_IS_USED \
  "EXISTS (SELECT 1 FROM job_domain AS d WHERE d.owner = domain.owner AND d.domain = domain.id)"

DomainRecord read_record(const sqlite::Query& row) {
  DomainRecord record;
  record.spec = {row.text(0), row.text(1), row.text(2), row.integer(3) != 0, row.text(4)};
  record.bytes = row.integer(5);
  record.created_ms = row.integer(6);
  record.expires_ms = row.integer(7);
  return record;
}

void erase(sqlite::Connection& connection, const std::string& owner, const std::string& id) {
  connection.run("DELETE FROM domain_blob WHERE owner = ?1 AND domain = ?2", owner, id);
  connection.run("DELETE FROM domain WHERE owner = ?1 AND id = ?2", owner, id);
}

}  // namespace

std::pair<DomainRecord, bool> add_domain(sqlite::Connection& connection, const DomainSpec& spec,
                                         const std::string& bytes, std::int64_t now_ms,
                                         std::int64_t expires_ms) {
  const bool is_new = !find_domain(connection, spec.owner, spec.id, now_ms);
  if (is_new) {
    erase(connection, spec.owner, spec.id);  // an old one that is over, but not dropped yet
    connection.run("INSERT INTO domain (" WELLSPACED_DOMAIN_COLUMNS
                   ") VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)",
                   spec.owner, spec.id, spec.format, spec.allow_self_intersections, spec.facts,
                   static_cast<std::int64_t>(bytes.size()), now_ms, expires_ms);
    std::int64_t row = 0;
    for (std::size_t at = 0; at < bytes.size(); at += kRowBytes)
      connection.run("INSERT INTO domain_blob (owner, domain, seq, data) VALUES (?1, ?2, ?3, ?4)", spec.owner,
                     spec.id, row++, sqlite::Blob{std::string_view(bytes).substr(at, kRowBytes)});
  } else {
    connection.run("UPDATE domain SET expires = max(expires, ?3) WHERE owner = ?1 AND id = ?2", spec.owner,
                   spec.id, expires_ms);
  }
  return {domain(connection, spec.owner, spec.id, now_ms), is_new};
}

std::optional<DomainRecord> find_domain(sqlite::Connection& connection, const std::string& owner,
                                        const std::string& id, std::int64_t now_ms) {
  sqlite::Query row = connection.query("SELECT " WELLSPACED_DOMAIN_COLUMNS
                                       " FROM domain WHERE owner = ?1 AND id = ?2 AND (expires > ?3 "
                                       "OR " WELLSPACED_DOMAIN_IS_USED ")",
                                       owner, id, now_ms);
  if (!row.step()) return std::nullopt;
  return read_record(row);
}

DomainRecord domain(sqlite::Connection& connection, const std::string& owner, const std::string& id,
                    std::int64_t now_ms) {
  if (auto record = find_domain(connection, owner, id, now_ms)) return *std::move(record);
  throw Error(ErrorCode::no_such_domain,
              "there is no such domain; its time may be over, or its id is mistyped: upload it again");
}

std::vector<DomainRecord> list_domains(sqlite::Connection& connection, const std::string& owner,
                                       const std::string& cursor, int limit, std::int64_t now_ms) {
  sqlite::Query row = connection.query("SELECT " WELLSPACED_DOMAIN_COLUMNS
                                       " FROM domain WHERE owner = ?1 AND id > ?2 AND (expires > ?3 "
                                       "OR " WELLSPACED_DOMAIN_IS_USED ") ORDER BY id LIMIT ?4",
                                       owner, cursor, now_ms, std::max(limit, 0));
  std::vector<DomainRecord> records;
  while (row.step()) records.push_back(read_record(row));
  return records;
}

std::string domain_bytes(sqlite::Connection& connection, const DomainRecord& record) {
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(record.bytes));
  sqlite::Query row =
      connection.query("SELECT data FROM domain_blob WHERE owner = ?1 AND domain = ?2 ORDER BY seq",
                       record.spec.owner, record.spec.id);
  while (row.step()) bytes += row.view(0);
  if (bytes.size() == static_cast<std::size_t>(record.bytes)) return bytes;
  throw Error(ErrorCode::storage_unavailable,
              "the job store has lost bytes of a domain: its file is damaged; delete and upload it again");
}

bool delete_domain(sqlite::Connection& connection, const std::string& owner, const std::string& id,
                   std::int64_t now_ms) {
  if (!find_domain(connection, owner, id, now_ms)) return false;
  {
    sqlite::Query user = connection.query(
        "SELECT job FROM job_domain WHERE owner = ?1 AND domain = ?2 ORDER BY job LIMIT 1", owner, id);
    if (user.step())
      throw Error(ErrorCode::conflict, "job " + user.text(0) +
                                           " or its result lies on this domain; wait until its time is "
                                           "over, or cancel it and purge its result first");
  }
  erase(connection, owner, id);
  return true;
}

int drop_domains(sqlite::Connection& connection, std::int64_t now_ms, int limit) {
  std::vector<std::pair<std::string, std::string>> over;
  {
    sqlite::Query row = connection.query(
        "SELECT owner, id FROM domain WHERE expires <= ?1 AND NOT " WELLSPACED_DOMAIN_IS_USED " LIMIT ?2",
        now_ms, limit);
    while (row.step()) over.emplace_back(row.text(0), row.text(1));
  }
  for (const auto& [owner, id] : over) erase(connection, owner, id);
  return static_cast<int>(over.size());
}

}  // namespace wellspaced::rows
