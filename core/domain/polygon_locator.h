#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/domain/edge_grid.h"
#include "core/domain/exact.h"
#include "core/domain/polygon_rings.h"

namespace wellspaced {

enum class Place : std::uint8_t { outside, inside, edge, corner };

struct Located {
  Place place = Place::outside;
  std::uint32_t edge = 0;  ///< or the corner that it begins in
};

/// Tells where points of a polygon are.
///
/// A point is in a corner if it has its coordinates; on the first edge that a real point of lies within one
/// unit in the last place of it along both axes; inside or outside otherwise. Exact.
///
/// Errors of the constructor: those of require_no_contact and require_nesting.
/// Requires: `rings` outlives it. Cost: that of EdgeGrid; a query O(1), O(edges near) beside the boundary.
class PolygonLocator {
 public:
  explicit PolygonLocator(const PolygonRings& rings);

  Located locate(Vec2 p) const;
  bool is_inside(Vec2 p) const { return locate(p).place == Place::inside; }
  /// The places just above and to the left of p, which may be on an edge, are inside. Exact.
  bool is_just_inside(Vec2 p) const;

  /// All places up to `reach` from p are well inside. May be false though they are.
  bool surrounds(Vec2 p, double reach) const;
  /// The part of the way from p, which is inside, to p + u at which it meets the boundary; 1 if it doesn't.
  /// Rounded down.
  double free_part(Vec2 p, Vec2 u) const;

  const EdgeGrid& grid() const { return grid_; }

 private:
  bool has_edges(std::size_t square) const { return (states_[square] & 2) != 0; }
  bool is_full(std::size_t square) const { return states_[square] == 1; }
  std::vector<std::int32_t> windings_of_middles() const;
  /// How often the rings wind around the place beside p more than around that beside q, the square's middle.
  int winding_from_middle(Vec2 p, int column, int row) const;
  void count_full();
  bool all_full(Vec2 low, Vec2 high) const;

  const PolygonRings& rings_;
  EdgeGrid grid_;
  std::vector<std::uint8_t> states_;        ///< of squares; bit 0: its middle is inside; bit 1: it has edges
  std::vector<std::uint32_t> full_before_;  ///< full squares below and to the left of each corner of squares
};

}  // namespace wellspaced
