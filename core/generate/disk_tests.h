#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/vec.h"

namespace wellspaced {

/// A rectangle of a background grid whose cells hold a sample each, or NaN.
struct CellWindow {
  const double *x, *y;  ///< of its first cell; readable for `readable_beyond` cells past its last one
  std::size_t stride;   ///< from a row to the next one
  std::size_t columns, rows;

  static constexpr std::size_t readable_beyond = 8;
};

/// Whether any sample is nearer to p than the radius. Cells next to the window may be looked at, too.
bool any_within(const CellWindow& window, Vec2 p, double radius2);

/// Four (or two, or one, if centers repeat) rectangles of the same size.
struct Quarters {
  std::array<double, 2> center_x, center_y;
  Vec2 half;
};

/// Which of them are covered, whole, by the disk of a single sample: bit 2 b + a for that at center_x[a],
/// center_y[b].
std::uint32_t covered_quarters(const CellWindow& window, const Quarters& quarters, double radius2);

}  // namespace wellspaced
