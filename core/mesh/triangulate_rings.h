#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace wellspaced {

/// Cuts what is inside of the first ring and outside of the others into triangles of their vertices, all in
/// the plane; exact, by CGAL. Requires: rings don't cross; they may touch.
std::vector<std::vector<std::uint32_t>> triangulate_rings(
    const std::vector<Vec3>& vertices, const std::vector<std::vector<std::uint32_t>>& rings);

}  // namespace wellspaced
