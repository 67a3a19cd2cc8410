#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/domain/domain.h"
#include "core/domain/polygon_locator.h"

namespace wellspaced {

/// Convex pieces of a polygon near a place, from tables: squares of a few sizes, each with its pieces.
///
/// Guarantees: the pieces of squares of one size are the polygon and don't overlap, but for rounding; no two
/// corners of a piece that follow each other are the same. Errors of the constructor: degenerate_input if
/// edges go in all directions beside each other so often that cutting the squares takes too long. Cost: a
/// query O(edges within about twice the reach), whatever the reach, as long as there are squares as large;
/// their size ends where tables would become too large.
class PolygonPieces {
 public:
  PolygonPieces(const PolygonRings& rings, const PolygonLocator& locator);

  /// Fills `out` with all pieces of squares within `reach` of p, relative to p.
  void near(Vec2 p, double reach, ChartPieces& out) const;

 private:
  struct Level {
    double side = 0;
    int columns = 0, rows = 0;
    double work = 0;  ///< that making it took, in crossings of edges and slabs
    std::vector<bool> full;
    std::vector<std::uint32_t> first;  ///< piece of each square
    ChartPieces pieces;                ///< of squares that aren't full
  };

  /// Nothing if that is more work than `most`.
  static std::optional<Level> make_level(const PolygonRings& rings, const PolygonLocator& locator,
                                         const EdgeGrid& grid, double most);
  const Level& level_for(double reach) const;

  Vec2 low_, size_;
  std::vector<Level> levels_;  ///< from small squares to large ones
};

}  // namespace wellspaced
