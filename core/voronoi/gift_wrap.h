#pragma once

#include <cstddef>
#include <optional>

#include "core/control.h"
#include "core/large_vector.h"
#include "core/voronoi/grid_order.h"
#include "core/voronoi/star.h"

namespace wellspaced {

/// The Delaunay triangulation of an evenly spread point set on a torus as one star a point: places of `order`
/// in, places out. Each star is wrapped neighbor by neighbor around its point; what an earlier star already
/// knows is taken from there.
///
/// Guarantees: stars are mutual (if c follows b around a, then a follows c around b), triangles are
/// counter-clockwise and their circumcircles hold no other point to within rounding (1e-12 of d_hex). Nothing
/// is returned, after little work, for what this way does not suit: cells of more than 64 points, holes of
/// more than a few cells, more than 15 neighbors, edges that reach half around the torus, cocircular points
/// whose stars disagree; see visit_stars for any set.
/// Requires: `order` with cells of about 1.6 d_hex; no two points the same.
/// Errors: cancelled, deadline_exceeded. Cost: O(n), about 0.15 us a point. Determinism: the same stars on
/// any number of threads and any vector width.
std::optional<LargeVector<Star>> wrap_stars(const GridOrder& order, const Control& control);

/// The cell side that suits it, in units of d_hex.
constexpr double wrap_cell = 1.62;

}  // namespace wellspaced
