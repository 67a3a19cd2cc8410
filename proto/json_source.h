#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

#include "core/error.h"

namespace wellspaced {

// Between a JSON text and nlohmann's lexer. Only json_reader.cpp needs it.

/// Error{malformed_request} with line, column (in characters), byte offset and the reason.
Error malformed_json(std::string_view text, std::size_t offset, std::string_view reason);

/// Why the text is malformed at `offset`, without a byte of it, from the message of nlohmann's exception.
std::string reason_for(std::string_view text, std::size_t offset, std::string_view message);

/// Reads a point and the way to the next one, "0.5, 0.5], [", from behind the point's bracket to behind the
/// next point's. Returns the bytes read; 0 for anything else, which is then the lexer's to judge.
std::size_t skim_row(std::string_view text, std::size_t columns, std::array<double, 3>& row);

/// The text as nlohmann's lexer gets to see it, one byte at a time.
///
/// The lexer keeps the bytes it has read since the last string or number, blanks included, and on an error
/// copies them several times, with up to eight bytes for one. A run of blanks is therefore shown as its first
/// byte only, and the length of a token is limited: hostile text then costs no memory beyond its own.
class Source {
 public:
  static constexpr std::size_t token_limit_bytes = 1u << 20;

  explicit Source(std::string_view text) : text_(text), at_(text.data()), end_(text.data() + text.size()) {}

  bool done() {
    for (; after_blank_ && at_ != end_ && is_blank(*at_); ++at_) ++hidden_;
    after_blank_ = false;
    return at_ == end_;
  }
  char peek() const { return *at_; }
  void advance() {
    const char c = *at_++;
    if (in_string_) {
      in_string_ = escaped_ || c != '"';
      escaped_ = !escaped_ && c == '\\';
    } else if (is_blank(c) || is_structural(c)) {
      after_blank_ = is_blank(c);
      token_bytes_ = 0;
      return;
    } else {
      in_string_ = c == '"';
    }
    if (++token_bytes_ > token_limit_bytes) refuse_token();
  }

  /// Everything from here on. The lexer never reads beyond a bracket before the handler has heard of it, so
  /// inside `start_array` this begins right behind the bracket, and `jump` may take the lexer to behind a
  /// later one.
  std::string_view rest() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }
  void jump(std::size_t bytes) {
    at_ += bytes;
    hidden_ += bytes;
  }

  std::string_view text() const { return text_; }
  /// Offset in the text of the last of the `count` bytes that the lexer has read; the text's size at its end.
  std::size_t offset(std::size_t count) const {
    return std::min(text_.size(), count + hidden_ - (count != 0 ? 1 : 0));
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  static bool is_structural(char c) {
    return c == '[' || c == ']' || c == '{' || c == '}' || c == ',' || c == ':';
  }
  [[noreturn]] void refuse_token() const;

  std::string_view text_;
  const char* at_;
  const char* end_;
  bool in_string_ = false, escaped_ = false, after_blank_ = false;
  std::size_t token_bytes_ = 0;
  std::size_t hidden_ = 0;  ///< bytes passed that the lexer hasn't seen
};

/// The iterator over a Source that nlohmann asks for; the default one is the end.
class SourceIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  SourceIterator() = default;
  explicit SourceIterator(Source& source) : source_(&source) {}
  char operator*() const { return source_->peek(); }
  SourceIterator& operator++() {
    source_->advance();
    return *this;
  }
  /// Only ever compared with the end.
  friend bool operator==(const SourceIterator& a, const SourceIterator&) { return a.source_->done(); }

 private:
  Source* source_ = nullptr;
};

}  // namespace wellspaced
