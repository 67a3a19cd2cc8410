#pragma once

namespace wellspaced {

/// Smallest distance of two points and largest distance of a place to its nearest point, in the units of what
/// tells of them.
struct MeshRadii {
  double shortest = 0, outermost = 0;
};

}  // namespace wellspaced
