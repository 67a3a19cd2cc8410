#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/generate/sample_grid.h"
#include "core/vec.h"

namespace wellspaced {

/// Whether any sample is nearer to p than the radius. Cells next to the window may be looked at, too.
bool any_within(const CellWindow& window, Vec2 p, double radius2);

/// A place in base cell (i, j).
struct Dart {
  std::int64_t i, j;
  Vec2 at;
};

/// Darts in their order: each that no sample covers becomes one.
void throw_darts(SampleGrid& grid, std::span<const Dart> darts);

/// A base cell or a part of one, in units of its level's side.
template <class Index>
struct PartCell {
  Index i, j;
};
using ActiveCell = PartCell<std::uint32_t>;
using DeepCell = PartCell<std::uint64_t>;

/// How base cells are cut up: 2^x by 2^y parts of this size.
struct Level {
  int x = 0, y = 0;
  Vec2 side;
};

/// Adds to `next` the parts at level `to` of the cells at level `from` that no single sample covers whole, by
/// the square of this coverage radius. Requires: `to` halves at least one axis, and none more than once.
void halve(const SampleGrid& grid, std::span<const ActiveCell> cells, const Level& from, const Level& to,
           double coverage2, std::vector<ActiveCell>& next);
void halve(const SampleGrid& grid, std::span<const DeepCell> cells, const Level& from, const Level& to,
           double coverage2, std::vector<DeepCell>& next);

}  // namespace wellspaced
