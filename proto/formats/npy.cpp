#include "proto/formats/npy.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "proto/formats/excerpt.h"

namespace wellspaced {
namespace {

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t max_header_bytes = 64u << 10;
constexpr std::size_t max_dimensions = 32;  // as in NumPy
constexpr std::size_t alignment = 64;

[[noreturn]] void malformed(const std::string& problem) {
  throw Error(ErrorCode::malformed_request,
              "the npy header " + problem + "; write the file with np.save(\"points.npy\", points)");
}

/// The fields of the header's dictionary, as written.
struct Fields {
  std::string_view descr;
  bool fortran_order = false;
  std::vector<std::size_t> shape;
};

/// Parses the one Python literal that a header is. Strict: what NumPy never writes is an error, but for the L
/// that Python 2 put behind long integers.
class HeaderParser {
 public:
  explicit HeaderParser(std::string_view text) : text_(text) {}

  Fields parse() {
    expect('{');
    while (!accept('}')) {
      read_entry();
      if (accept('}')) break;
      expect(',');
    }
    skip_blanks();
    if (at_ != text_.size()) malformed("has text after its dictionary" + position());
    if (!(has_descr_ && has_order_ && has_shape_))
      malformed("lacks one of the keys descr, fortran_order and shape");
    return fields_;
  }

 private:
  void read_entry() {
    const std::string_view key = read_string();
    expect(':');
    if (key == "descr") {
      once(has_descr_, key);
      fields_.descr = read_dtype();
    } else if (key == "fortran_order") {
      once(has_order_, key);
      fields_.fortran_order = read_bool();
    } else if (key == "shape") {
      once(has_shape_, key);
      fields_.shape = read_shape();
    } else {
      malformed("has the unknown key " + excerpt(key));
    }
  }

  void once(bool& seen, std::string_view key) const {
    if (seen) malformed("has the key " + excerpt(key) + " twice");
    seen = true;
  }

  std::string_view read_dtype() {
    skip_blanks();
    if (at_ < text_.size() && (text_[at_] == '[' || text_[at_] == '(' || text_[at_] == '{')) {
      throw Error(
          ErrorCode::invalid_parameters,
          "the npy file holds a structured array, which is not a point set; stack its fields into one: "
          "np.save(\"points.npy\", np.column_stack([a[\"x\"], a[\"y\"]]).astype(\"<f8\"))");
    }
    return read_string();
  }

  std::string_view read_string() {
    skip_blanks();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    if (quote != '\'' && quote != '"') malformed("lacks a quoted string" + position());
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) malformed("has a string without its closing quote" + position());
    const std::string_view body = text_.substr(at_ + 1, end - at_ - 1);
    if (body.find_first_of("\\\n") != std::string_view::npos)
      malformed("has an escape in a string" + position());
    at_ = end + 1;
    return body;
  }

  bool read_bool() {
    skip_blanks();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (text_.substr(at_, word.size()) != word) continue;
      at_ += word.size();
      return value;
    }
    malformed("has a fortran_order that is neither True nor False" + position());
  }

  std::vector<std::size_t> read_shape() {
    std::vector<std::size_t> shape;
    bool comma = false;
    expect('(');
    while (!accept(')')) {
      if (!shape.empty() && !comma) malformed("lacks a comma in its shape" + position());
      if (shape.size() == max_dimensions) malformed("has a shape of more than 32 dimensions");
      shape.push_back(read_size());
      comma = accept(',');
    }
    // (5) is a number in Python, (5,) a tuple.
    if (shape.size() == 1 && !comma) malformed("has a number in place of a shape" + position());
    return shape;
  }

  std::size_t read_size() {
    skip_blanks();
    const std::size_t start = at_;
    std::size_t value = 0;
    for (; at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9'; ++at_) {
      const auto digit = static_cast<std::size_t>(text_[at_] - '0');
      if (value > (std::numeric_limits<std::size_t>::max() - digit) / 10)
        malformed("has a shape beyond any memory");
      value = 10 * value + digit;
    }
    if (at_ == start) malformed("has a shape that is not made of whole numbers" + position());
    if (text_[start] == '0' && at_ > start + 1) malformed("has a number with leading zeros" + position());
    if (at_ < text_.size() && text_[at_] == 'L') ++at_;
    return value;
  }

  void skip_blanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
      ++at_;
  }

  bool accept(char c) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  void expect(char c) {
    if (!accept(c)) malformed(std::string("lacks a '") + c + "'" + position());
  }

  std::string position() const { return " at its byte " + std::to_string(at_); }

  std::string_view text_;
  std::size_t at_ = 0;
  Fields fields_;
  bool has_descr_ = false, has_order_ = false, has_shape_ = false;
};

[[noreturn]] void refuse_dtype(std::string_view descr) {
  throw Error(
      ErrorCode::invalid_parameters,
      "the npy file has dtype " + excerpt(descr) +
          "; accepted are f4, f8, i1 to i8 and u1 to u8: np.save(\"points.npy\", points.astype(\"<f8\"))");
}

/// descr = byte order, kind, size: "<f8". Without a byte order it is the machine's, which here is
/// little-endian.
void read_descr(std::string_view descr, NpyHeader& header) {
  std::string_view rest = descr;
  if (!rest.empty() && std::string_view("<>=|").find(rest[0]) != std::string_view::npos) {
    header.big_endian = rest[0] == '>';
    rest.remove_prefix(1);
  }
  if (rest.size() != 2) refuse_dtype(descr);
  const bool known = rest[0] == 'f'   ? rest[1] == '4' || rest[1] == '8'
                     : rest[0] == 'i' ? std::string_view("1248").find(rest[1]) != std::string_view::npos
                     : rest[0] == 'u' ? std::string_view("1248").find(rest[1]) != std::string_view::npos
                                      : false;
  if (!known) refuse_dtype(descr);
  header.kind = rest[0];
  header.item_bytes = static_cast<std::size_t>(rest[1] - '0');
}

static_assert(std::endian::native == std::endian::little, "items are copied as they are");

/// The bits of one item, in the low end of the result.
std::uint64_t load(const char* item, std::size_t item_bytes, bool big_endian) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, item, item_bytes);
  return big_endian ? __builtin_bswap64(bits) >> (64 - 8 * item_bytes) : bits;
}

std::size_t product_bytes(const NpyHeader& header) {
  // A zero makes the product 0 but forgives no overflow of the others.
  std::size_t nonzero = header.item_bytes;
  bool empty = false;
  for (const std::size_t n : header.shape) {
    empty = empty || n == 0;
    if (n != 0 && nonzero > std::numeric_limits<std::size_t>::max() / n)
      malformed("has a shape beyond any memory");
    nonzero *= n == 0 ? 1 : n;
  }
  return empty ? 0 : nonzero;
}

std::string to_text(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

void check_point_set(const NpyHeader& header, std::size_t row_limit) {
  const auto& shape = header.shape;
  if (shape.size() != 2 || (shape[1] != 2 && shape[1] != 3)) {
    throw Error(
        ErrorCode::invalid_parameters,
        "the npy array has shape " + to_text(shape) +
            "; a point set has shape (n, 2) or (n, 3), one row a point: use " +
            (shape.size() == 2 && (shape[0] == 2 || shape[0] == 3) ? "points.T" : "points.reshape(-1, 2)"));
  }
  if (shape[0] > row_limit) {
    throw Error(ErrorCode::too_large, "the npy array has " + std::to_string(shape[0]) +
                                          " points; the limit is " + std::to_string(row_limit));
  }
}

void check_byte_count(const NpyHeader& header, std::size_t got) {
  if (got == header.data_bytes) return;
  throw Error(ErrorCode::malformed_request,
              "the npy file should have " + std::to_string(header.data_bytes) +
                  " bytes after its header, for shape " + to_text(header.shape) + ", but has " +
                  std::to_string(got) + ": it is " +
                  (got < header.data_bytes ? "truncated" : "followed by other bytes") +
                  "; send the whole file and no more");
}

double decode(const NpyHeader& header, std::uint64_t bits) {
  if (header.kind == 'f') {
    return header.item_bytes == 8
               ? std::bit_cast<double>(bits)
               : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  }
  if (header.kind == 'u') return static_cast<double>(bits);
  const auto shift = static_cast<unsigned>(64 - 8 * header.item_bytes);
  return static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
}

/// Integers beyond 2^53 round to something at or beyond 2^53, so testing the double finds them, but for 2^53
/// + 1.
bool is_exact(const NpyHeader& header, std::uint64_t bits, double value) {
  constexpr double limit = 9007199254740992.0;
  if (header.kind == 'f' || std::abs(value) < limit) return true;
  const auto magnitude = header.kind == 'i' && value < 0 ? std::uint64_t{0} - bits : bits;
  return magnitude == std::uint64_t{1} << 53;
}

[[noreturn]] void refuse_integer(std::size_t row, std::size_t column) {
  throw Error(ErrorCode::invalid_parameters,
              "the npy array has an integer beyond 2^53, which a double can't hold exactly; scale the "
              "coordinates down",
              "/" + std::to_string(row) + "/" + std::to_string(column));
}

}  // namespace

NpyHeader read_npy_header(std::string_view bytes) {
  if (bytes.substr(0, magic.size()) != magic || bytes.size() < magic.size() + 2) {
    throw Error(ErrorCode::malformed_request,
                "this is not an npy file (it does not begin with \\x93NUMPY); write it with "
                "np.save(\"points.npy\", points)");
  }
  NpyHeader header;
  header.version = static_cast<unsigned char>(bytes[6]);
  if (header.version < 1 || header.version > 3 || bytes[7] != 0) {
    malformed("has version " + std::to_string(header.version) + "." +
              std::to_string(static_cast<unsigned char>(bytes[7])) + ", not 1.0, 2.0 or 3.0");
  }
  const std::size_t length_bytes = header.version == 1 ? 2 : 4;
  if (bytes.size() < 8 + length_bytes) malformed("is cut off before its length");
  const std::size_t length = load(bytes.data() + 8, length_bytes, false);
  if (length > max_header_bytes) malformed("is longer than 64 KiB");
  header.data_offset = 8 + length_bytes + length;
  if (bytes.size() < header.data_offset) {
    malformed("should end at byte " + std::to_string(header.data_offset) + ", but the file has only " +
              std::to_string(bytes.size()));
  }
  const Fields fields = HeaderParser(bytes.substr(8 + length_bytes, length)).parse();
  read_descr(fields.descr, header);
  header.fortran_order = fields.fortran_order;
  header.shape = fields.shape;
  header.data_bytes = product_bytes(header);
  return header;
}

Table read_npy(std::string_view bytes, std::size_t row_limit) {
  const NpyHeader header = read_npy_header(bytes);
  check_point_set(header, row_limit);
  check_byte_count(header, bytes.size() - header.data_offset);
  Table table{header.shape[0], header.shape[1], {}};
  table.values.resize(table.rows * table.columns);
  const char* data = bytes.data() + header.data_offset;
  for (std::size_t row = 0; row < table.rows; ++row) {
    for (std::size_t column = 0; column < table.columns; ++column) {
      const std::size_t item =
          header.fortran_order ? column * table.rows + row : row * table.columns + column;
      const std::uint64_t bits = load(data + item * header.item_bytes, header.item_bytes, header.big_endian);
      const double value = decode(header, bits);
      if (!is_exact(header, bits, value)) refuse_integer(row, column);
      table.values[row * table.columns + column] = value;
    }
  }
  return table;
}

std::string write_npy(const double* values, std::size_t rows, std::size_t columns) {
  std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(rows) +
                           ", " + std::to_string(columns) + "), }";
  // NumPy leaves room to let the first dimension grow to 21 digits in place, and then always pads by at least
  // one byte.
  dictionary.append(21 - std::to_string(rows).size(), ' ');
  const std::size_t unpadded = magic.size() + 4 + dictionary.size() + 1;
  dictionary.append(alignment - unpadded % alignment, ' ');
  dictionary += '\n';

  std::string out;
  out.reserve(magic.size() + 4 + dictionary.size() + rows * columns * sizeof(double));
  out += magic;
  out += '\x01';
  out += '\0';
  out += static_cast<char>(dictionary.size() & 0xff);
  out += static_cast<char>(dictionary.size() >> 8);
  out += dictionary;
  if (rows * columns != 0) out.append(reinterpret_cast<const char*>(values), rows * columns * sizeof(double));
  return out;
}

}  // namespace wellspaced
