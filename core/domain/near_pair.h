#pragma once

#include <cstdint>
#include <optional>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// Two samples that are too near to each other.
struct NearPair {
  std::uint32_t later, earlier;  ///< indices in the set
  double distance;
};

/// Two samples less than `limit` apart on the domain, periodic images of other samples included.
///
/// Guarantees: if there are any such pairs, one is found; of those that are, the one whose later sample comes
/// first. Requires: limit > 0; less than half of each period; points in their domain. Errors: cancelled,
/// deadline_exceeded. Cost: O(n) for even sets on a torus, O(n log n) for any, crowds included.
/// Determinism: a function of the points.
std::optional<NearPair> find_near_pair(const PointSet& points, double limit, const Control& control);

}  // namespace wellspaced
