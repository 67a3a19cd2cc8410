#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace wellspaced {

/// A text of lines of words, as OFF, OBJ and ASCII PLY are: skips blank lines, CR before LF, and comments,
/// which begin with '#' and go on to the end of the line.
class MeshText {
 public:
  enum class Comments { skip, none };

  /// `what` it is, for messages: "OFF file". A UTF-8 byte order mark is skipped. Errors: malformed_request
  /// for UTF-16.
  MeshText(std::string_view text, std::string what, Comments comments = Comments::skip);

  /// Goes to the next line that has a word; false if there is none.
  bool next_line();
  /// The next word of the line; empty at its end.
  std::string_view next_word();
  /// Goes to the next line if there is no word left on this one; false at the end of the text.
  bool skip_to_word() { return !line_.empty() || next_line(); }
  /// The next word, on whichever line it is; empty at the end of the text.
  std::string_view next_word_anywhere();

  /// The number that a word is. Errors: malformed_request naming line and word, and what it should have been.
  double number(std::string_view word, std::string_view expected) const;
  std::int64_t integer(std::string_view word, std::string_view expected) const;

  [[noreturn]] void malformed(const std::string& problem) const;
  /// "line 12 of the OFF file"
  std::string place() const;

  std::size_t bytes_left() const { return line_.size() + rest_.size(); }
  std::string_view rest() const { return rest_; }  ///< after this line
  std::size_t line_number() const { return line_number_; }

 private:
  std::string_view line_, rest_;
  std::string what_;
  Comments comments_;
  std::size_t line_number_ = 0;
};

}  // namespace wellspaced
