#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "proto/formats/media.h"
#include "server/context.h"
#include "server/http/message.h"
#include "server/jobs/job.h"

namespace wellspaced {

/// In which form a client wants a result.
struct Wanted {
  Format format = Format::json;
  nlohmann::json picture;                         ///< null: as the request says, or the default one
  std::shared_ptr<const std::atomic<bool>> gone;  ///< true once the client is, and wants nothing any more
};

/// What `Prefer` says; unknown preferences are ignored (RFC 7240).
struct Preference {
  bool respond_async = false;
  std::optional<int> wait_seconds;  ///< capped at 60
};

/// Errors: not_acceptable, invalid_parameters at /picture.
Wanted read_wanted(const http::Request& request, const std::string& operation);
Preference read_preference(const http::Request& request);

/// The first value of a query parameter, or empty.
std::string query_value(const http::Request& request, const std::string& name);

/// The finished job's result in the wanted form, or its problem. Errors: result_not_ready, result_expired,
/// cancelled.
http::Response result_response(Context& context, const Job& job, const Wanted& wanted,
                               const std::string& request_id);

/// A job's status as JSON, with links.
std::string job_to_json(const Job& job);
/// 2026-01-31T12:00:00.000Z
std::string timestamp(std::int64_t ms);
/// Whose jobs and domains a request is about: "" while there is no authentication.
std::string owner_of(const http::Request& request);
http::Response json_response(std::string text, int status = 200);

}  // namespace wellspaced
