#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/domain/polygon_rings.h"

namespace wellspaced {

/// The constrained Delaunay triangulation of a polygon: triangles of corners of its rings, counter-clockwise.
/// Requires: the rings are simple and apart, holes inside the outer one and not inside each other.
/// Cost: O(n log n).
std::vector<std::array<std::uint32_t, 3>> triangulate(const PolygonRings& rings);

}  // namespace wellspaced
