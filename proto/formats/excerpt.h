#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace wellspaced {

/// A piece of a client's bytes that is fit for an error message, quotes included: printable ASCII stays,
/// every other byte and the quote itself become '?', and what is longer than `limit` bytes is cut and ends in
/// "...".
inline std::string excerpt(std::string_view bytes, std::size_t limit = 40) {
  std::string out = "'";
  for (const char c : bytes.substr(0, limit)) out += c >= ' ' && c <= '~' && c != '\'' ? c : '?';
  out += bytes.size() > limit ? "...'" : "'";
  return out;
}

}  // namespace wellspaced
