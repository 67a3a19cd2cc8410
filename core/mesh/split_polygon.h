#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/vec.h"

namespace wellspaced {

/// Cuts a polygon that is about convex and flat, such as the points around an empty circle, into triangles of
/// its corners: off goes always the one whose smallest angle is the largest. Counter-clockwise as it is.
/// `joined`: whether two corners have an edge elsewhere, so that there should be no other between them.
/// Cost: O(k^2).
std::vector<std::array<std::uint32_t, 3>> split_polygon(
    std::span<const Vec3> corners, const std::function<bool(std::uint32_t, std::uint32_t)>& joined);

}  // namespace wellspaced
