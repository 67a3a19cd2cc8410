#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "proto/formats/table.h"

namespace wellspaced {

/// The most that a document may have besides its points.
struct JsonLimits {
  static constexpr std::size_t depth = 16;               ///< arrays and objects within each other
  static constexpr std::size_t values = 100'000;         ///< arrays and objects count, too
  static constexpr std::size_t pointer_key_bytes = 100;  ///< of a key in an error; then it is cut: "abc..."
};

/// A list of points and where it stood. `table` has 2 or 3 columns and finite numbers; no rows and columns
/// for an empty list.
struct JsonTable {
  std::string pointer;
  Table table;
};

/// `root` has an empty array where each list of points was.
struct JsonDocument {
  nlohmann::json root;
  std::vector<JsonTable> tables;  ///< in the text's order
};

/// Reads a JSON text (RFC 8259) whose large parts, lists of points, go straight into doubles.
///
/// An array found at one of `table_places` is read as [[x, y], ...] or [[x, y, z], ...]. Another value there
/// is left to the caller, in `root`. A place is a JSON pointer (RFC 6901, no escapes; "" is the root) in
/// which
/// `*` stands for any index of an array, and a leading `/**` for any way down.
///
/// Guarantees
/// 1. Memory is bounded by the limits above, `row_limit` and a small multiple of the text's length, also for
///    hostile text: depth and limits are checked before anything is stored.
/// 2. Numbers are the doubles nearest to their text; "-0" keeps its sign among the points.
/// 3. Nothing of the text reaches an error but keys, in its pointer: escaped, cut, control characters
///    replaced by '?'.
/// Errors
/// 1. malformed_request: not JSON, with line and column (in characters, from 1), byte offset (from 0) and
///    reason; nesting beyond the limit, with the pointer's beginning.
/// 2. invalid_parameters, with the pointer: a number that overflows a double, a key twice in an object, a
///    point that is not an array of 2 or 3 numbers or has another length than the first, too many values.
/// 3. too_large: more than `row_limit` points in all; a string or number of more than 1 MiB.
/// Cost: linear; points by-pass the library's lexer, which is several times slower.
JsonDocument read_json(std::string_view text, std::span<const std::string_view> table_places,
                       std::size_t row_limit, std::size_t value_limit = JsonLimits::values);

}  // namespace wellspaced
