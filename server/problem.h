#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "server/http/message.h"

namespace wellspaced {

/// An RFC 9457 problem document: the only form in which this service reports an error.
struct Problem {
  int status = 500;
  std::string type;    ///< last path segment, e.g. "invalid-parameters"
  std::string title;   ///< fixed per type
  std::string detail;  ///< this occurrence, for a person: what is wrong and the way out
  std::vector<std::pair<std::string, std::string>> errors;   ///< (JSON pointer, detail)
  std::vector<std::pair<std::string, std::string>> headers;  ///< to send along: Retry-After, Allow, ...
};

/// The one map from errors to HTTP. `internal` never tells more than the request id.
Problem to_problem(const Error& error);

/// For what has no Error: 404 route, 405, 406, 408, 411, 414, 415, 431 and the like.
/// Type and title follow from the status.
Problem http_problem(int status, std::string detail);

/// The document's JSON text; invalid UTF-8 in it is replaced.
std::string to_json(const Problem& problem, const std::string& request_id);

/// The reverse, for problems that a job keeps; what is missing keeps its default.
Problem problem_from_json(const std::string& text);

/// `application/problem+json`, `Cache-Control: no-store`, the problem's own headers.
http::Response to_response(const Problem& problem, const std::string& request_id);

}  // namespace wellspaced
