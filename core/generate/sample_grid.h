#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/control.h"
#include "core/domain/torus.h"
#include "core/large_vector.h"
#include "core/vec.h"

namespace wellspaced {

/// What disk samplings keep: no two points nearer than `conflict`, no place farther than `coverage` from all
/// of them. Requires: 0 < conflict <= coverage; conflict <= half the torus's diagonal.
struct DiskRadii {
  double conflict = 0, coverage = 0;
};

/// A rectangle of a background grid whose cells hold a sample each, or NaN.
struct CellWindow {
  const double *x, *y;  ///< of its first cell; readable for `readable_beyond` cells past its last one
  std::size_t stride;   ///< from a row to the next one
  std::size_t columns, rows;

  static constexpr std::size_t readable_beyond = 8;
};

/// One axis of the background grid: `cells` base cells and `reach` ghost cells on either side, within which
/// everything lies that can cover a part of a cell, and within `near` what can conflict with a point of it.
struct GridAxis {
  double period, side;
  std::int64_t cells, near, reach, stride;

  GridAxis(double length, const DiskRadii& radii);
};

/// Base cells with at most one sample each. Ghost cells hold images shifted by whole periods, so a query
/// never wraps; an empty cell holds NaN, which fails every comparison, so a query never branches on it.
///
/// Thread safety: cells whose distance is more than `reach` along an axis may be written and asked about at
/// the same time.
class SampleGrid {
 public:
  /// Errors: cancelled, deadline_exceeded.
  SampleGrid(const Torus& torus, const DiskRadii& radii, const Control& control);

  const GridAxis x, y;

  bool taken(std::int64_t i, std::int64_t j) const {
    const double found = table_x_[index(i, j)];
    return found == found;
  }
  Vec2 sample(std::int64_t i, std::int64_t j) const { return {table_x_[index(i, j)], table_y_[index(i, j)]}; }
  void put(std::int64_t i, std::int64_t j, Vec2 p) {
    const bool inside = i >= x.reach && i < x.cells - x.reach && j >= y.reach && j < y.cells - y.reach;
    inside ? put_image(index(i, j), p) : put_all_images(i, j, p);
  }

  /// What can conflict with a point of base cell (i, j), and what can cover a part of it.
  CellWindow window_near(std::int64_t i, std::int64_t j) const { return window(i, j, x.near, y.near); }
  CellWindow window(std::int64_t i, std::int64_t j) const { return window(i, j, x.reach, y.reach); }

  /// The radii's squares, widened by what rounding can hide of images.
  double conflict2() const { return conflict2_; }
  double coverage2() const { return coverage2_; }

  /// Has what a query around base cell (i, j) reads on its way into the cache.
  void prefetch(std::int64_t i, std::int64_t j) const;

  std::pair<std::int64_t, std::int64_t> cell_of(Vec2 p) const;

 private:
  std::size_t index(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>((j + y.reach) * x.stride + i + x.reach);
  }
  CellWindow window(std::int64_t i, std::int64_t j, std::int64_t reach_x, std::int64_t reach_y) const {
    const std::size_t first = index(i - reach_x, j - reach_y);
    return {&table_x_[first], &table_y_[first], static_cast<std::size_t>(x.stride),
            static_cast<std::size_t>(2 * reach_x + 1), static_cast<std::size_t>(2 * reach_y + 1)};
  }
  void put_all_images(std::int64_t i, std::int64_t j, Vec2 p);
  void put_image(std::size_t at, Vec2 p) {
    table_x_[at] = p.x;
    table_y_[at] = p.y;
  }

  LargeVector<double> table_x_, table_y_;
  double conflict2_, coverage2_;
};

}  // namespace wellspaced
