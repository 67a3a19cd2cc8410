#pragma once

#include <cstdint>
#include <vector>

#include "core/point_set.h"

namespace wellspaced {

/// The points of a set on one curve of the domain's boundary, in their order along it.
struct BorderChain {
  struct Link {
    double along = 0;
    std::uint32_t point = none;  ///< none: a corner of the domain that is no point
  };
  static constexpr std::uint32_t none = ~0u;

  std::size_t curve = 0;
  double length = 0;
  bool closed = false;      ///< the last one is followed by the first
  std::vector<Link> links;  ///< with both ends, unless the curve is closed
};

/// One chain for each curve of the boundary. Cost: O(n log n).
std::vector<BorderChain> border_chains(const PointSet& points);

}  // namespace wellspaced
