#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "proto/formats/table.h"

namespace wellspaced {

/// Reads a point set from text: one point a line, 2 or 3 numbers, the same count on every line.
///
/// Cells are separated by semicolons, commas, tabs or runs of blanks: the first of these, in this order, that
/// the first data line contains, and then only that one; blanks around a cell don't count. May be there: a
/// UTF-8 byte order mark, a header "x,y" or "x,y,z" (any case, quoted or not), lines that begin with '#',
/// blank lines, CRLF. Numbers are decimal, with a point, an optional sign and an optional exponent; nan and
/// inf are read as such.
///
/// Errors, each with the line (from 1) and the cell that is to blame, cut to 40 printable bytes, and "/row"
/// or
/// "/row/column" (from 0, data lines only): invalid_parameters for a cell that is not a number or is outside
/// the range of a double, for 1 or more than 3 cells on a line, and for another count than before; too_large
/// for more than `row_limit` rows; malformed_request for UTF-16.
/// No line but blanks, comments and header: a table without rows, with the header's columns if there is one.
/// Cost: linear.
Table read_csv(std::string_view text, std::size_t row_limit);

/// "x,y" or "x,y,z", then one line a row with the shortest numbers that read back as the same doubles; '\n'.
/// Requires: 2 or 3 columns.
std::string write_csv(const double* values, std::size_t rows, std::size_t columns);

}  // namespace wellspaced
