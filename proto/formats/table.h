#pragma once

#include <cstddef>
#include <vector>

namespace wellspaced {

/// Rows of coordinates as a file or a request brings them, before any domain has looked at them.
///
/// Shapes and units: `values` is row-major and holds rows * columns doubles; the units are the file's. A
/// reader returns 2 or 3 columns; 0 where there is no row to tell. NaN and infinity may occur where the
/// format can write them (npy, csv): domains refuse them.
struct Table {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;
};

}  // namespace wellspaced
