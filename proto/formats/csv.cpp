#include "proto/formats/csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <system_error>

#include "core/error.h"
#include "proto/formats/excerpt.h"

namespace wellspaced {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

char find_separator(std::string_view line) {
  for (const char separator : {';', ',', '\t'}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

/// Takes the first cell off `rest`, which becomes nullopt when that was the last one.
std::string_view next_cell(std::optional<std::string_view>& rest, char separator) {
  const std::string_view line = *rest;
  std::size_t end = 0;
  while (end < line.size() && line[end] != separator && (separator != ' ' || line[end] != '\t')) ++end;
  if (end == line.size()) {
    rest.reset();
  } else if (separator == ' ') {
    rest = trim(line.substr(end));  // a run of blanks is one separator
  } else {
    rest = line.substr(end + 1);
  }
  return trim(line.substr(0, end));
}

/// Number of columns if the line is a header, else 0.
std::size_t header_columns(std::string_view line) {
  const char separator = find_separator(line);
  std::size_t count = 0;
  for (std::optional rest = line; rest; ++count) {
    std::string_view cell = next_cell(rest, separator);
    if (cell.size() == 3 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, 1);
    constexpr std::string_view lower = "xyz", upper = "XYZ";
    if (count == 3 || cell.size() != 1 || (cell[0] != lower[count] && cell[0] != upper[count])) return 0;
  }
  return count < 2 ? 0 : count;
}

class Reader {
 public:
  Reader(std::string_view text, std::size_t row_limit) : text_(text), row_limit_(row_limit) {
    if (text_.substr(0, 3) == "\xef\xbb\xbf") text_.remove_prefix(3);
    if (text_.substr(0, 2) == "\xff\xfe" || text_.substr(0, 2) == "\xfe\xff") {
      throw Error(ErrorCode::malformed_request, "the csv text is UTF-16; save it as UTF-8");
    }
  }

  Table read() {
    while (!text_.empty()) {
      ++line_number_;
      const std::string_view line = trim(next_line());
      if (line.empty() || line[0] == '#') continue;
      if (first_) {
        first_ = false;
        table_.columns = header_columns(line);
        if (table_.columns != 0) continue;
      }
      read_row(line);
    }
    return std::move(table_);
  }

 private:
  std::string_view next_line() {
    const std::size_t end = text_.find('\n');
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  void read_row(std::string_view line) {
    if (separator_ == '\0') separator_ = find_separator(line);
    if (table_.rows == row_limit_) {
      throw Error(ErrorCode::too_large, "the csv text has more points than the limit of " +
                                            std::to_string(row_limit_) + " (line " +
                                            std::to_string(line_number_) + "); send fewer");
    }
    std::array<double, 3> row{};
    std::size_t count = 0;
    for (std::optional rest = line; rest;) {
      const std::string_view cell = next_cell(rest, separator_);
      if (count == row.size()) refuse_count(cell, "more than 3 cells");
      row[count] = read_number(cell, count);
      ++count;
    }
    if (count < 2) refuse_count(line, "only one cell");
    if (table_.columns != 0 && count != table_.columns) {
      refuse_count(line, std::to_string(count) + " cells where there were " + std::to_string(table_.columns) +
                             " before");
    }
    if (table_.rows == 0) {
      table_.columns = count;
      reserve();
    }
    table_.values.insert(table_.values.end(), row.begin(), row.begin() + static_cast<std::ptrdiff_t>(count));
    ++table_.rows;
  }

  /// The lines left tell the size, so the values are never copied to a larger place.
  void reserve() {
    const auto lines = static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '\n')) + 2;
    table_.values.reserve(std::min({lines, row_limit_, text_.size() / 4 + 2}) * table_.columns);
  }

  double read_number(std::string_view cell, std::size_t column) const {
    double value = 0;
    std::string_view digits = cell;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::result_out_of_range)
      refuse_cell(cell, column, "is outside the range of a double");
    if (error != std::errc() || end != digits.data() + digits.size())
      refuse_cell(cell, column, why_not_a_number(cell));
    return value;
  }

  std::string why_not_a_number(std::string_view cell) const {
    if (cell.empty()) return "is empty: write a number";
    if (cell.find(',') != std::string_view::npos) return "is not a number: write decimals with a point";
    if (cell[0] == '"') return "is not a number: write numbers without quotes";
    if (table_.rows == 0) return "is not a number; a header can only be x,y or x,y,z";
    return "is not a number: write decimals with a point, and the same separator on every line";
  }

  std::string row_pointer() const { return "/" + std::to_string(table_.rows); }

  [[noreturn]] void refuse_cell(std::string_view cell, std::size_t column, const std::string& problem) const {
    throw Error(ErrorCode::invalid_parameters,
                "line " + std::to_string(line_number_) + " of the csv text: cell " +
                    std::to_string(column + 1) + ", " + excerpt(cell) + ", " + problem,
                row_pointer() + "/" + std::to_string(column));
  }

  [[noreturn]] void refuse_count(std::string_view cell, const std::string& problem) const {
    throw Error(ErrorCode::invalid_parameters,
                "line " + std::to_string(line_number_) + " of the csv text has " + problem + " (at " +
                    excerpt(cell) + "); write x,y or x,y,z on every line",
                row_pointer());
  }

  std::string_view text_;
  std::size_t row_limit_;
  Table table_;
  std::size_t line_number_ = 0;
  char separator_ = '\0';
  bool first_ = true;
};

}  // namespace

Table read_csv(std::string_view text, std::size_t row_limit) { return Reader(text, row_limit).read(); }

std::string write_csv(const double* values, std::size_t rows, std::size_t columns) {
  std::string out = columns == 3 ? "x,y,z\n" : "x,y\n";
  // A double takes at most 24 characters; memory that is never touched costs nothing.
  out.reserve(out.size() + rows * columns * 25);
  std::array<char, 32> buffer;
  for (std::size_t i = 0; i < rows * columns; ++i) {
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), values[i]).ptr;
    *end = (i + 1) % columns == 0 ? '\n' : ',';
    out.append(buffer.data(), end + 1);
  }
  return out;
}

}  // namespace wellspaced
