#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace wellspaced {

/// Everything that can go wrong below HTTP. server/problem.cpp holds the one map to status codes.
enum class ErrorCode {
  malformed_request,   ///< the bytes can't be read (truncated npy, bad JSON)
  invalid_parameters,  ///< a field has the wrong type, value, or name
  infeasible,          ///< well formed, but geometry forbids it (beta below 1/sqrt(3))
  degenerate_input,    ///< point sets that the method can't work on (duplicates, fewer than 3 points)
  too_large,           ///< above a limit that the operator set; refused before the work starts
  payload_too_large,   ///< the bytes themselves are above the limit
  unsupported_media_type,
  not_acceptable,
  not_found,
  no_such_job,
  no_such_domain,
  result_not_ready,
  result_expired,
  conflict,
  too_large_for_sync,
  too_many_jobs,
  overloaded,
  draining,
  storage_unavailable,
  storage_full,
  deadline_exceeded,
  cancelled,
  worker_crashed,
  internal,
};

/// The one exception of this project.
///
/// Guarantee: a function that throws it has changed nothing.
/// `where` is the JSON pointer (RFC 6901) of the offending field, relative to what the thrower was given;
/// callers that know the rest put it in front with `within`. Empty: no single field is to blame.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, std::string where = "")
      : std::runtime_error(message), code_(code), where_(std::move(where)) {}

  ErrorCode code() const { return code_; }
  const std::string& where() const { return where_; }

  /// The same error seen from one level further out.
  Error within(const std::string& prefix) const { return {code_, what(), prefix + where_}; }

 private:
  ErrorCode code_;
  std::string where_;
};

}  // namespace wellspaced
