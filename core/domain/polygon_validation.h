#pragma once

#include "core/domain/edge_grid.h"
#include "core/domain/polygon_rings.h"

namespace wellspaced {

/// Refuses rings that cross or touch themselves or each other, in a point or along an edge, and holes that
/// aren't inside the outer ring or are inside one another. Where rings touch, even in a single point, the
/// polygon is no surface with a boundary there, so that is refused too. Exact.
///
/// Errors: degenerate_input at /rings/k or /rings/k/i. Cost: the grid's pairs.
void require_no_contact(const PolygonRings& rings, const EdgeGrid& grid);
/// Requires: what require_no_contact refuses is refused. `winding(p)`: how often the rings wind around the
/// places just to the left of p.
template <class Winding>
void require_nesting(const PolygonRings& rings, const Winding& winding);

/// The first corner of ring k by x, then by y.
std::uint32_t leftmost_corner(const PolygonRings& rings, std::size_t k);
[[noreturn]] void refuse_hole(const PolygonRings& rings, std::size_t k);

template <class Winding>
void require_nesting(const PolygonRings& rings, const Winding& winding) {
  for (std::size_t k = 1; k < rings.rings(); ++k)
    if (winding(rings.edges()[leftmost_corner(rings, k)].from) != 1) refuse_hole(rings, k);
}

}  // namespace wellspaced
