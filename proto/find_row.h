#pragma once

#include <span>
#include <string>

#include "core/error.h"

namespace wellspaced {

/// The names of a registry's rows: "a, b, c".
template <class Row>
std::string names_of(std::span<const Row> rows) {
  std::string names;
  for (const Row& row : rows) names += (names.empty() ? "" : ", ") + row.name;
  return names;
}

/// The row of that name. Errors: invalid_parameters at `where`, listing them all.
template <class Row>
const Row& find_row(std::span<const Row> rows, const std::string& name, const std::string& where) {
  for (const Row& row : rows)
    if (row.name == name) return row;
  throw Error(ErrorCode::invalid_parameters, "unknown name; there are: " + names_of(rows), where);
}

}  // namespace wellspaced
