#include "proto/json_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace wellspaced {
namespace {

constexpr std::size_t longest_number = 24;  // -1.7976931348623157e+308

char* write_number(char* to, double value) {
  if (std::isfinite(value)) return std::to_chars(to, to + longest_number, value).ptr;
  return std::copy_n("null", 4, to);
}

}  // namespace

void append_number(std::string& out, double value) {
  std::array<char, longest_number> buffer;
  out.append(buffer.data(), write_number(buffer.data(), value));
}

std::string rows_to_json(const double* values, std::size_t rows, std::size_t columns) {
  std::string out;
  out.reserve(2 + rows * (columns * (longest_number + 1) + 3));
  out += '[';
  std::array<char, longest_number + 1> buffer;
  for (std::size_t row = 0; row < rows; ++row) {
    out += row == 0 ? "[" : ",[";
    for (std::size_t column = 0; column < columns; ++column) {
      char* end = write_number(buffer.data(), values[row * columns + column]);
      *end++ = column + 1 < columns ? ',' : ']';
      out.append(buffer.data(), end);
    }
  }
  out += ']';
  return out;
}

}  // namespace wellspaced
