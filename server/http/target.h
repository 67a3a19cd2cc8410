#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "server/problem.h"

namespace wellspaced::http {

/// A request target, taken apart and then percent-decoded, once.
struct Target {
  std::string text;                   ///< origin form as sent: path and query, not decoded
  std::string path;                   ///< decoded, for people
  std::vector<std::string> segments;  ///< "/a/b%2Fc" -> "a", "b/c"; "/" -> one empty segment
  std::vector<std::pair<std::string, std::string>> query;  ///< in order, duplicates kept; '+' is a space
};

/// Takes origin form ("/a?b=c"), absolute form ("http://host/a?b=c") and "*".
/// Errors: 400 for any other form, an incomplete or non-hexadecimal escape, and %00.
std::variant<Target, Problem> parse_target(std::string_view text);

}  // namespace wellspaced::http
