#include "proto/json_reader.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/error.h"
#include "proto/json_source.h"

namespace wellspaced {
namespace {

using Json = nlohmann::json;
using Row = std::array<double, 3>;

/// Splits an RFC 6901 pointer that holds no escapes (ours never do).
std::vector<std::string> split(std::string_view pointer) {
  std::vector<std::string> keys;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);
    keys.emplace_back(pointer.substr(0, pointer.find('/')));
    pointer.remove_prefix(keys.back().size());
  }
  return keys;
}

/// The text's first `limit` bytes, less if that would cut a UTF-8 character, and "..." if it is longer.
std::string cut(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return std::string(text);
  while (limit > 0 && (text[limit] & 0xc0) == 0x80) --limit;
  return std::string(text.substr(0, limit)) + "...";
}

/// "/" and the key, escaped for a pointer and made fit for an error.
std::string pointer_segment(std::string_view key) {
  std::string segment = "/";
  for (const char c : cut(key, JsonLimits::pointer_key_bytes)) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    segment += c == '~' ? "~0" : c == '/' ? "~1" : control ? "?" : std::string(1, c);
  }
  return segment;
}

/// Hears the parser's events and builds the document: the tree as usual, the table without a tree.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  Builder(Source& source, std::span<const std::string_view> table_places, std::size_t row_limit,
          std::size_t value_limit)
      : source_(source), row_limit_(row_limit), value_limit_(value_limit) {
    for (const std::string_view place : table_places) places_.push_back(split(place));
  }

  JsonDocument take() { return std::move(document_); }

  bool null() override { return scalar(nullptr, "null"); }
  bool boolean(bool value) override { return scalar(value, "a boolean"); }
  bool string(std::string& value) override { return scalar(std::move(value), "a string"); }
  // The library makes an integer of "-0", which has no sign; only a number with a minus comes here.
  bool number_integer(std::int64_t value) override {
    return in_row_ ? coordinate(value == 0 ? -0.0 : static_cast<double>(value)) : scalar(value, "a number");
  }
  bool number_unsigned(std::uint64_t value) override {
    return in_row_ ? coordinate(static_cast<double>(value)) : scalar(value, "a number");
  }
  bool number_float(double value, const std::string&) override {
    return in_row_ ? coordinate(value) : scalar(value, "a number");
  }
  bool binary(Json::binary_t&) override { return false; }  // only binary formats have it

  bool start_object(std::size_t) override {
    if (in_table_) refuse_in_table("an object");
    open(Json::object());
    return true;
  }

  bool key(std::string& key) override {
    Level& level = levels_.back();
    level.key = std::move(key);
    if (level.node->contains(level.key)) refuse("this key is in its object twice; keep one");
    return true;
  }

  bool end_object() override {
    levels_.pop_back();
    return true;
  }

  bool start_array(std::size_t) override {
    if (in_row_) refuse_in_table("an array");
    if (in_table_) {
      start_row();
    } else if (at_table()) {
      start_table();
    } else {
      open(Json::array());
    }
    return true;
  }

  bool end_array() override {
    if (in_row_) {
      end_row();
    } else if (in_table_) {
      in_table_ = false;
    } else {
      levels_.pop_back();
    }
    return true;
  }

  bool parse_error(std::size_t read, const std::string&, const nlohmann::detail::exception& error) override {
    constexpr int number_overflow = 406;
    if (error.id == number_overflow)
      refuse("this number is outside the range of a double; send a finite one");
    const std::size_t offset = source_.offset(read);
    throw malformed_json(source_.text(), offset, reason_for(source_.text(), offset, error.what()));
  }

 private:
  /// An array or object that is open, outside the table.
  struct Level {
    Json* node;
    std::string key;  ///< of the member that is being read
  };

  /// Where the parser is: at a value that is not in the tree yet, below containers that are.
  std::string pointer() const {
    std::string pointer;
    for (const Level& level : levels_) {
      const std::size_t index = level.node->size() - (&level == &levels_.back() ? 0 : 1);
      pointer += level.node->is_array() ? "/" + std::to_string(index) : pointer_segment(level.key);
    }
    if (in_table_) pointer += "/" + std::to_string(table().rows);
    if (in_row_) pointer += "/" + std::to_string(row_size_);
    return pointer;
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw Error(ErrorCode::invalid_parameters, problem, pointer());
  }

  [[noreturn]] void refuse_in_table(const std::string& found) const {
    refuse((in_row_ ? "expected a number, found " : "expected a point, [x, y] or [x, y, z], found ") + found);
  }

  /// Puts a value where the parser is; its address is good while it is open.
  Json* add(Json value) {
    if (++values_ > value_limit_) {
      refuse("the document has more than " + std::to_string(value_limit_) +
             " values besides its points; send fewer, or large data as a file of its own");
    }
    if (levels_.empty()) return &(document_.root = std::move(value));
    Level& level = levels_.back();
    if (level.node->is_array()) return &level.node->emplace_back(std::move(value));
    return &*level.node->emplace(level.key, std::move(value)).first;
  }

  bool scalar(Json value, const char* name) {
    if (in_table_) refuse_in_table(name);
    add(std::move(value));
    return true;
  }

  void open(Json container) {
    if (levels_.size() == JsonLimits::depth) {
      throw Error(
          ErrorCode::malformed_request,
          "the JSON text nests deeper than " + std::to_string(JsonLimits::depth) + " levels; flatten it",
          cut(pointer(), JsonLimits::pointer_key_bytes));
    }
    Json* node = add(std::move(container));
    levels_.push_back({node, ""});
  }

  static bool fits(const std::string& key, const Level& level) {
    return key == "*" ? level.node->is_array() : level.node->is_object() && level.key == key;
  }

  bool at_table() const {
    return std::any_of(places_.begin(), places_.end(), [&](const std::vector<std::string>& keys) {
      const bool anywhere = !keys.empty() && keys.front() == "**";
      const auto key = keys.begin() + (anywhere ? 1 : 0);
      const auto count = keys.end() - key, levels = static_cast<std::ptrdiff_t>(levels_.size());
      return (anywhere ? levels >= count : levels == count) &&
             std::equal(key, keys.end(), levels_.end() - count, fits);
    });
  }

  void start_table() {
    const std::string where = pointer();
    add(Json::array());
    rows_before_ += document_.tables.empty() ? 0 : table().rows;
    document_.tables.push_back({where, {}});
    in_table_ = true;
  }

  Table& table() { return document_.tables.back().table; }
  const Table& table() const { return document_.tables.back().table; }
  std::size_t rows_left() const { return row_limit_ - rows_before_ - table().rows; }

  void start_row() {
    if (rows_left() == 0) {
      throw Error(ErrorCode::too_large,
                  "there are more points than the limit of " + std::to_string(row_limit_) + "; send fewer",
                  document_.tables.back().pointer);
    }
    in_row_ = true;
    row_size_ = 0;
    skim_rows();
  }

  /// Takes the plain rows past the lexer, which is slow. Begins and ends behind the bracket of a row, so the
  /// parser, which has seen one bracket, doesn't notice; a row that isn't plain and the last one are left to
  /// it.
  void skim_rows() {
    Row row;
    while (table().columns != 0 && rows_left() > 1) {
      const std::size_t bytes = skim_row(source_.rest(), table().columns, row);
      if (bytes == 0) return;
      source_.jump(bytes);
      append(row);
    }
  }

  bool coordinate(double value) {
    if (row_size_ == row_.size()) {
      in_row_ = false;  // the whole row is to blame
      refuse("a point has 2 or 3 coordinates, this one has more");
    }
    row_[row_size_++] = value;
    return true;
  }

  void end_row() {
    in_row_ = false;
    if (row_size_ < 2) {
      refuse("a point has 2 or 3 coordinates, this one has " + std::to_string(row_size_));
    }
    if (table().columns != 0 && row_size_ != table().columns) {
      refuse("this point has " + std::to_string(row_size_) + " coordinates, the ones before have " +
             std::to_string(table().columns) + "; send points of one dimension");
    }
    if (table().columns == 0) {
      table().columns = row_size_;
      reserve();
    }
    append(row_);
  }

  /// The brackets left tell how many rows there can be, and no row is shorter than "[0,0],".
  void reserve() {
    const std::string_view rest = source_.rest();
    const auto brackets = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '['));
    table().values.reserve(std::min({brackets + 1, rest.size() / 6 + 2, rows_left()}) * table().columns);
  }

  void append(const Row& row) {
    table().values.insert(table().values.end(), row.begin(),
                          row.begin() + static_cast<std::ptrdiff_t>(table().columns));
    ++table().rows;
  }

  Source& source_;
  std::vector<std::vector<std::string>> places_;
  std::size_t row_limit_, value_limit_;
  std::size_t rows_before_ = 0;  ///< of the tables before this one
  JsonDocument document_;
  std::vector<Level> levels_;
  std::size_t values_ = 0;
  bool in_table_ = false, in_row_ = false;
  Row row_{};
  std::size_t row_size_ = 0;
};

}  // namespace

JsonDocument read_json(std::string_view text, std::span<const std::string_view> table_places,
                       std::size_t row_limit, std::size_t value_limit) {
  // To the library a NUL is the end of the text, whatever follows.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    throw malformed_json(text, nul, "there is a NUL byte; write \\u0000 if it belongs to a string");
  }
  Source source(text);
  Builder builder(source, table_places, row_limit, value_limit);
  Json::sax_parse(SourceIterator(source), SourceIterator(), &builder);
  return builder.take();
}

}  // namespace wellspaced
