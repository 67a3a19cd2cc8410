#pragma once

#include <cstddef>
#include <string>

namespace wellspaced {

/// Appends the shortest JSON number that reads back as the same double ("0.1", "1", "1e+22", "-0"); "null"
/// for NaN and infinity, which JSON can't write. Independent of the locale.
void append_number(std::string& out, double value);

/// "[[x,y],[x,y],...]" of rows * columns row-major doubles, numbers as by `append_number`, no blanks; "[]"
/// without rows.
/// Cost: linear; reserves address space for the longest possible text (25 bytes a number), touches what it
/// writes.
std::string rows_to_json(const double* values, std::size_t rows, std::size_t columns);

}  // namespace wellspaced
