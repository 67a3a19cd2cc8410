#pragma once

#include <cstddef>
#include <limits>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// When farthest-point insertion ends: at whichever comes first.
struct FarthestPointEnd {
  std::size_t count = std::numeric_limits<std::size_t>::max();  ///< so many points
  double coverage = 0;                                          ///< r_c at most this, domain lengths
  /// A guess, for points that are spread out: holes shallower than this won't be needed, much deeper ones are
  /// rare. A bad one costs time, and may decide between equally deep holes.
  double shallowest = 0;
};

/// Farthest-point insertion: point after point goes to the middle of the deepest hole, the largest disk that
/// is empty of samples. The new ones are appended.
///
/// Guarantees
/// 1. Each point is farther from all earlier ones than any other place was, so that depths never rise; one
/// that is inserted at depth d leaves r_f = min(r_f, d) and r_c <= d.
/// 2. Hence a set with beta <= 1 keeps beta <= 1 (1 + 1e-9 for rounding), whatever the number of points, and
/// r_f never falls below the coverage that was asked for.
/// Returns: r_c at the end, or a bound on it from above: end.shallowest where no deeper hole is left.
/// Requires: at least one point, no two of them in the same place.
/// Errors: degenerate_input as for visit_stars; cancelled, deadline_exceeded.
/// Cost: O(n log n) for the holes of n points, 2 to 7 us a new point, the more the larger the set.
/// Determinism: depends on the points and `end` only; of exactly equally deep holes, which are not
/// rare, the lowest comes first, then the leftmost.
/// Reference: Eldar, Lindenbaum, Porat, Zeevi, "The Farthest Point Strategy for Progressive Image Sampling",
/// 1997.
double insert_farthest(PointSet& points, const FarthestPointEnd& end, Control& control);

}  // namespace wellspaced
