#pragma once

#include <cstddef>
#include <cstdint>

#include "core/control.h"
#include "core/large_vector.h"
#include "core/point_set.h"

namespace wellspaced {

/// The points of a torus cell by cell of a uniform grid, row after row, so that neighbors are near in memory.
struct GridOrder {
  double width = 0, height = 0;
  std::uint32_t columns = 1, rows = 1;
  LargeVector<std::uint32_t> start;  ///< of each cell in what follows, and the end: columns * rows + 1 places
  LargeVector<std::uint32_t> original;  ///< index in the point set of each place
  LargeVector<double> x, y;             ///< coordinates of each place

  std::size_t size() const { return x.size(); }
  std::uint32_t column_of(double at) const { return cell_of(at, width, columns); }
  std::uint32_t row_of(double at) const { return cell_of(at, height, rows); }
  /// From place i to place j, the short way; exact where that does not cross a side of the torus.
  Vec2 offset(std::size_t i, std::size_t j) const {
    return {around(x[j] - x[i], width), around(y[j] - y[i], height)};
  }
  /// Number of points in the fullest cell.
  std::uint32_t fullest() const;

 private:
  static double around(double d, double period) {
    return d > 0.5 * period ? d - period : d < -0.5 * period ? d + period : d;
  }
  static std::uint32_t cell_of(double at, double side, std::uint32_t cells) {
    const auto cell = static_cast<std::uint32_t>(at * (cells / side));
    return cell < cells ? cell : cells - 1;
  }
};

/// Cells of `side` or a little more. Requires: every point lies in its domain, a torus; side > 0.
/// Guarantees: within a cell, points keep their order. Errors: cancelled, deadline_exceeded. Cost: O(n).
GridOrder grid_order(const PointSet& points, double side, const Control& control);

}  // namespace wellspaced
