#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/domain/triangle_mesh.h"

namespace wellspaced {

/// Two faces, the lower one first, that have more in common than a vertex or an edge of both; nothing if
/// there are none. Of several pairs the first one; of more than 100000, one of them.
///
/// Requires: indices in range, no edge of three faces, neighbors of one orientation, no face without area.
/// Cost: O(n log n + pairs of faces whose boxes meet), about 1 us a face; exact.
std::optional<std::array<std::uint32_t, 2>> first_crossing(const Triangles& mesh);

}  // namespace wellspaced
