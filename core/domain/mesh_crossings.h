#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/domain/triangle_mesh.h"

namespace wellspaced {

/// The first two faces, the lower one first, that have more in common than a vertex or an edge of both;
/// nothing if there are none.
///
/// Requires: indices in range, no edge of three faces, neighbors of one orientation, no face without area.
/// Errors: too_large at "/faces" if more than 60 pairs a face and 2 10^6 in all have boxes that meet. Cost:
/// about 1 us a face and .2 us a pair of faces whose boxes meet; exact.
std::optional<std::array<std::uint32_t, 2>> first_crossing(const Triangles& mesh);

}  // namespace wellspaced
