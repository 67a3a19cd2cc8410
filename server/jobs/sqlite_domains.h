#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/jobs/domain_record.h"
#include "server/jobs/sqlite.h"

/// Uploaded domains as rows; as sqlite_rows.h. A domain whose time is over and that nothing lies on is not
/// there, whether it was dropped yet or not.
namespace wellspaced::rows {

std::pair<DomainRecord, bool> add_domain(sqlite::Connection& connection, const DomainSpec& spec,
                                         const std::string& bytes, std::int64_t now_ms,
                                         std::int64_t expires_ms);
std::optional<DomainRecord> find_domain(sqlite::Connection& connection, const std::string& owner,
                                        const std::string& id, std::int64_t now_ms);
/// Errors: no_such_domain.
DomainRecord domain(sqlite::Connection& connection, const std::string& owner, const std::string& id,
                    std::int64_t now_ms);
std::vector<DomainRecord> list_domains(sqlite::Connection& connection, const std::string& owner,
                                       const std::string& cursor, int limit, std::int64_t now_ms);
std::string domain_bytes(sqlite::Connection& connection, const DomainRecord& record);
/// Errors: conflict.
bool delete_domain(sqlite::Connection& connection, const std::string& owner, const std::string& id,
                   std::int64_t now_ms);
/// Drops at most `limit` domains that are over: how many.
int drop_domains(sqlite::Connection& connection, std::int64_t now_ms, int limit);

}  // namespace wellspaced::rows
