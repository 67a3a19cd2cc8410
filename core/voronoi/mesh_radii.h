#pragma once

#include <algorithm>
#include <limits>

namespace wellspaced {

/// Smallest distance of two points and largest distance of a place to its nearest point, in the units of what
/// tells of them.
struct MeshRadii {
  double shortest = 0, outermost = 0;

  void include(MeshRadii other) {
    shortest = std::min(shortest, other.shortest);
    outermost = std::max(outermost, other.outermost);
  }
};

/// Of no points at all.
inline constexpr MeshRadii no_radii{std::numeric_limits<double>::infinity(), 0};

}  // namespace wellspaced
