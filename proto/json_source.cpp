#include "proto/json_source.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace wellspaced {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// " at line 3, column 7 (byte offset 41)"; a column is a character, so UTF-8's continuation bytes don't
/// count.
std::string position(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  const std::string_view last = before.substr(before.rfind('\n') + 1);
  const auto column = std::count_if(last.begin(), last.end(), [](char c) { return (c & 0xc0) != 0x80; }) + 1;
  return " at line " + std::to_string(line) + ", column " + std::to_string(column) + " (byte offset " +
         std::to_string(offset) + ")";
}

/// Length of the JSON number at the beginning of `text`, 0 if there is none. from_chars alone takes ".5",
/// "1." and "01".
std::size_t number_length(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t first = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at != first;
  };
  const auto accept = [&](char a, char b) {
    const bool found = at < text.size() && (text[at] == a || text[at] == b);
    at += found ? 1 : 0;
    return found;
  };
  accept('-', '-');
  if (!accept('0', '0') && !digits()) return 0;
  if (accept('.', '.') && !digits()) return 0;
  if (accept('e', 'E')) {
    accept('+', '-');
    if (!digits()) return 0;
  }
  return at;
}

/// The word of letters, digits and signs around `offset`, such as "-Infinity"; empty inside anything longer.
std::string_view word_around(std::string_view text, std::size_t offset) {
  const auto in_word = [&](std::size_t i) {
    const char c = text[i];
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '+' ||
           c == '.';
  };
  constexpr std::size_t longest = 12;
  if (offset >= text.size() || !in_word(offset)) return {};
  std::size_t first = offset, last = offset;
  while (first > 0 && offset - first < longest && in_word(first - 1)) --first;
  while (last < text.size() && last - offset < longest && in_word(last)) ++last;
  return text.substr(first, last - first);
}

/// What a person needs to hear where the library says "invalid literal"; empty if its own words will do.
std::string hint(std::string_view text, std::size_t offset) {
  const std::string_view word = word_around(text, offset);
  std::string lower(word);
  std::transform(word.begin(), word.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const std::string_view bare = std::string_view(lower).substr(lower[0] == '-' || lower[0] == '+' ? 1 : 0);
  if (bare == "nan" || bare == "infinity" || bare == "inf") {
    return "NaN and Infinity are not JSON; every number must be finite";
  }
  const bool capital = (lower == "true" || lower == "false" || lower == "null") && lower != word;
  if (capital || lower == "none" || lower == "undefined") {
    return "this is not a JSON literal; write true, false or null";
  }
  const char c = text[offset];
  if (c == '/' || c == '#') return "JSON has no comments; remove them";
  if (c == '\'') return "strings are written in double quotes";
  if ((c == ']' || c == '}') && offset > 0) {
    const std::size_t before = text.find_last_not_of(" \t\r\n", offset - 1);
    const bool comma = before != std::string_view::npos && text[before] == ',';
    if (comma) return "remove the comma before the closing bracket";
  }
  return "";
}

}  // namespace

Error malformed_json(std::string_view text, std::size_t offset, std::string_view reason) {
  return {ErrorCode::malformed_request,
          "the JSON text is malformed" + position(text, offset) + ": " + std::string(reason)};
}

// The library's message is
// "... syntax error while parsing X - <reason>[; last read: '<bytes of the text>'][; expected Y]".
std::string reason_for(std::string_view text, std::size_t offset, std::string_view message) {
  const std::size_t start = message.find(" - ", std::min(message.find("syntax error"), message.size()));
  const bool known = start != std::string_view::npos;
  std::string_view reason = known ? message.substr(start + 3) : "it can't be read";
  reason = reason.substr(0, reason.find("; last read: "));
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return "it is empty; send a JSON value";
  if (offset >= text.size()) return "the text ends too early (" + std::string(reason) + ")";
  if (reason.find("expected end of input") != std::string_view::npos) {
    return "there is more text after the end of the value";
  }
  if (reason.substr(0, 14) == "invalid string") return std::string(reason);
  const std::string better = hint(text, offset);
  return better.empty() ? std::string(reason) : better;
}

std::size_t skim_row(std::string_view text, std::size_t columns, std::array<double, 3>& row) {
  std::size_t at = 0;
  const auto skip_to = [&](char c) {
    while (at < text.size() && is_blank(text[at])) ++at;
    return at < text.size() && text[at++] == c;
  };
  for (std::size_t column = 0; column < columns; ++column) {
    while (at < text.size() && is_blank(text[at])) ++at;
    const char* first = text.data() + at;
    const char* last = first + number_length(text.substr(at));
    const auto [end, error] = std::from_chars(first, last, row[column]);
    if (error != std::errc() || end != last) return 0;
    at += static_cast<std::size_t>(last - first);
    if (!skip_to(column + 1 < columns ? ',' : ']')) return 0;
  }
  return skip_to(',') && skip_to('[') ? at : 0;
}

void Source::refuse_token() const {
  throw Error(ErrorCode::too_large, "the JSON text has a string or number of more than 1 MiB" +
                                        position(text_, static_cast<std::size_t>(at_ - text_.data()) - 1) +
                                        "; send large data as a file of its own");
}

}  // namespace wellspaced
