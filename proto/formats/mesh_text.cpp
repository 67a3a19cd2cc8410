#include "proto/formats/mesh_text.h"

#include <charconv>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "proto/formats/excerpt.h"

namespace wellspaced {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

template <class Number>
bool parse(std::string_view word, Number& value, std::errc& error) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  error = result.ec;
  return error == std::errc() && result.ptr == word.data() + word.size();
}

}  // namespace

MeshText::MeshText(std::string_view text, std::string what, Comments comments)
    : rest_(text), what_(std::move(what)), comments_(comments) {
  if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  if (rest_.starts_with("\xff\xfe") || rest_.starts_with("\xfe\xff"))
    throw Error(ErrorCode::malformed_request, "the " + what_ + " is UTF-16; save it as UTF-8");
}

bool MeshText::next_line() {
  while (!rest_.empty()) {
    ++line_number_;
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (comments_ == Comments::skip) line_ = line_.substr(0, line_.find('#'));
    while (!line_.empty() && is_blank(line_.front())) line_.remove_prefix(1);
    if (!line_.empty()) return true;
  }
  line_ = {};
  return false;
}

std::string_view MeshText::next_word() {
  std::size_t end = 0;
  while (end < line_.size() && !is_blank(line_[end])) ++end;
  const std::string_view word = line_.substr(0, end);
  while (end < line_.size() && is_blank(line_[end])) ++end;
  line_.remove_prefix(end);
  return word;
}

std::string_view MeshText::next_word_anywhere() {
  skip_to_word();
  return next_word();
}

double MeshText::number(std::string_view word, std::string_view expected) const {
  double value = 0;
  std::errc error{};
  if (parse(word, value, error)) return value;
  if (word.empty()) malformed("ends where " + std::string(expected) + " should be");
  malformed("has " + excerpt(word) + " for " + std::string(expected) +
            (error == std::errc::result_out_of_range ? ", which is outside the range of a double"
                                                     : ", which is not a number"));
}

std::int64_t MeshText::integer(std::string_view word, std::string_view expected) const {
  std::int64_t value = 0;
  std::errc error{};
  if (parse(word, value, error)) return value;
  if (word.empty()) malformed("ends where " + std::string(expected) + " should be");
  malformed("has " + excerpt(word) + " for " + std::string(expected) + ", which is not a whole number" +
            (error == std::errc::result_out_of_range ? " below 2^63" : ""));
}

void MeshText::malformed(const std::string& problem) const {
  throw Error(ErrorCode::malformed_request, place() + " " + problem);
}

std::string MeshText::place() const { return "line " + std::to_string(line_number_) + " of the " + what_; }

}  // namespace wellspaced
