#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "proto/formats/table.h"

namespace wellspaced {

/// What the header of an npy file says, checked.
struct NpyHeader {
  int version = 1;             ///< major: 1, 2 or 3
  char kind = 'f';             ///< 'f', 'i' or 'u'
  std::size_t item_bytes = 8;  ///< 4 or 8 for 'f'; 1, 2, 4 or 8 for 'i' and 'u'
  bool big_endian = false;
  bool fortran_order = false;
  std::vector<std::size_t> shape;
  std::size_t data_offset = 0;  ///< of the first element, in bytes
  std::size_t data_bytes = 0;   ///< product of the shape, times item_bytes
};

/// Reads the header of an npy file: versions 1.0, 2.0 and 3.0, any number of dimensions.
/// The Python dictionary in it has the keys descr, fortran_order and shape, in any order, and no others.
///
/// Errors: malformed_request if these are not an npy file's first bytes, the header is cut off or longer than
/// 64 KiB, its dictionary is not as above, or its shape has more bytes than a size_t can count;
/// invalid_parameters for a dtype other than f4, f8, i1 to i8 and u1 to u8 (object, structured, bool,
/// complex, text, half and long double among others): the message names it and says what to save instead.
/// Cost: linear in the header's length.
NpyHeader read_npy_header(std::string_view bytes);

/// Reads a point set: an array of shape (n, 2) or (n, 3).
///
/// Guarantees
/// 1. Every value is converted exactly; NaN and infinity pass through.
/// 2. Nothing is allocated before dtype, shape, row limit and byte count are checked.
/// Errors: those of the header; invalid_parameters for another shape, or (with "/row/column") for an integer
/// beyond +-2^53; too_large for more than `row_limit` rows; malformed_request if the bytes after the header
/// are not as many as it says.
Table read_npy(std::string_view bytes, std::size_t row_limit);

/// The bytes that numpy.save writes for a float64 array of shape (rows, columns) in C order: version 1.0,
/// '<f8', data on a 64-byte boundary.
std::string write_npy(const double* values, std::size_t rows, std::size_t columns);

}  // namespace wellspaced
