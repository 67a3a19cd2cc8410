#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace wellspaced::testing {

/// The attributes of a start tag, or nothing if they aren't name="value" pairs with different names.
inline bool attributes_are_sound(std::string_view text) {
  std::set<std::string> names;
  while (!text.empty()) {
    if (text.front() != ' ') return false;
    text.remove_prefix(1);
    const auto equals = text.find("=\"");
    if (equals == std::string_view::npos || equals == 0) return false;
    const auto end = text.find('"', equals + 2);
    if (end == std::string_view::npos) return false;
    if (!names.insert(std::string(text.substr(0, equals))).second) return false;
    if (text.substr(0, end).find('<') != std::string_view::npos) return false;
    text.remove_prefix(end + 1);
  }
  return true;
}

/// Why a text is not well-formed XML of the simple kind that pictures are; empty if it is.
inline std::string why_malformed(std::string_view text) {
  std::vector<std::string> open;
  bool seen_root = false;
  while (!text.empty()) {
    const auto tag = text.find('<');
    if (open.empty() && text.find_first_not_of('\n') < tag) return "text outside the root";
    if (tag == std::string_view::npos) break;
    text.remove_prefix(tag + 1);
    const auto end = text.find('>');
    if (end == std::string_view::npos) return "a tag without an end";
    std::string_view inside = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (inside.starts_with('/')) {
      if (open.empty() || open.back() != inside.substr(1)) return "closes " + std::string(inside);
      open.pop_back();
      continue;
    }
    if (open.empty() && seen_root) return "two roots";
    seen_root = true;
    const bool empty = inside.ends_with('/');
    if (empty) inside.remove_suffix(1);
    const std::string name(inside.substr(0, inside.find(' ')));
    if (!attributes_are_sound(inside.substr(name.size())))
      return "attributes of <" + std::string(inside) + ">";
    if (!empty) open.push_back(name);
  }
  return open.empty() && seen_root ? "" : "not closed";
}

inline std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

inline std::string from_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0, bits = 0;
  for (const char c : text.substr(0, text.find('='))) {
    word = word << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(word >> bits & 255u);
  }
  return bytes;
}

/// Without the whole picture in the message.
inline void expect_part(const std::string& text, const std::string& part) {
  EXPECT_TRUE(text.find(part) != std::string::npos) << "no " << part;
}

}  // namespace wellspaced::testing
