#include <charconv>
#include <string>
#include <system_error>

#include "core/error.h"
#include "proto/formats/excerpt.h"
#include "proto/formats/polygon.h"

namespace wellspaced {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

class WktReader {
 public:
  WktReader(std::string_view text, const std::string& pointer) : text_(text), pointer_(pointer) {}

  std::vector<std::vector<Vec2>> read() {
    const bool multiple = read_head();
    if (multiple) expect('(', "'(' before the first polygon");
    read_list([&] { read_ring(); }, "a ring");
    if (multiple) {
      if (next() == ',')
        refuse("the MULTIPOLYGON has several polygons; a domain is one: make a request for each");
      expect(')', "')' after the last polygon");
    }
    if (next() != end) refuse("expected nothing after the polygon");
    return std::move(rings_);
  }

 private:
  static constexpr char end = '\0';

  /// Whether it is a MULTIPOLYGON.
  bool read_head() {
    const std::string word = read_word();
    if (word.empty() && next() == end) refuse("the text is empty; write POLYGON ((x y, ...), (...))");
    const bool multiple = word.starts_with("MULTIPOLYGON");
    if (!multiple && !word.starts_with("POLYGON"))
      refuse(word == "SRID" ? "a SRID says nothing of the plane; leave it out"
                            : "expected POLYGON or MULTIPOLYGON, found " + excerpt(word));
    std::string rest = word.substr(multiple ? 12 : 7);
    if (rest.empty()) rest = read_word();
    if (rest == "Z" || rest == "M" || rest == "ZM")
      refuse("the polygon lies in the plane: write it without " + rest + ", two coordinates a vertex");
    if (rest == "EMPTY") refuse("the polygon is empty");
    if (!rest.empty()) refuse("expected '(', found " + excerpt(rest));
    return multiple;
  }

  template <class ReadItem>
  void read_list(const ReadItem& read_item, const std::string& what) {
    expect('(', "'(' before " + what);
    for (;;) {
      read_item();
      const char c = next();
      if (c != ',' && c != ')') refuse("expected ',' or ')' after " + what);
      ++at_;
      if (c == ')') return;
    }
  }
  void read_ring() {
    rings_.emplace_back();
    read_list([&] { read_vertex(); }, "a vertex");
  }
  void read_vertex() {
    const double x = read_number(), y = read_number();
    if (next() != ',' && next() != ')' && next() != end)
      refuse("a vertex has two coordinates here: the polygon lies in the plane; expected ',' or ')'");
    rings_.back().push_back({x, y});
  }

  double read_number() {
    next();
    std::string_view rest = text_.substr(at_);
    if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error == std::errc::result_out_of_range) refuse("a number is outside the range of a double");
    if (error != std::errc()) refuse("expected a number; a vertex is two, with a blank between");
    at_ = static_cast<std::size_t>(stop - text_.data());
    return value;
  }

  std::string read_word() {
    next();
    std::string word;
    while (at_ < text_.size() && is_letter(text_[at_])) word += upper(text_[at_++]);
    return word;
  }
  /// The next character that is no blank, which stays; `end` after the last one.
  char next() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    return at_ < text_.size() ? text_[at_] : end;
  }
  void expect(char c, const std::string& what) {
    if (next() != c) refuse("expected " + what);
    ++at_;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    std::string message = what + ", at character " + std::to_string(at_ + 1);
    if (at_ < text_.size()) message += " (" + excerpt(text_.substr(at_), 12) + ")";
    if (!rings_.empty())
      message += ", in ring " + std::to_string(rings_.size() - 1) + ", vertex " +
                 std::to_string(rings_.back().size());
    throw Error(ErrorCode::invalid_parameters, message, pointer_);
  }

  std::string_view text_;
  const std::string& pointer_;
  std::size_t at_ = 0;
  std::vector<std::vector<Vec2>> rings_;
};

}  // namespace

PolygonText read_wkt(std::string_view text, const std::string& pointer) {
  return {WktReader(text, pointer).read(), pointer, true};
}

}  // namespace wellspaced
