#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/control.h"
#include "core/large_vector.h"
#include "core/point_set.h"

namespace wellspaced {

/// Samples of a torus scaled to [0, 1) x [0, 1), by rising x, with where each stands among all y.
struct RankedPoints {
  LargeVector<double> x, y;
  LargeVector<std::uint32_t> level;  ///< of each sample: levels[level] == y
  LargeVector<double> levels;        ///< the different y, rising
  LargeVector<double> sorted_y;

  std::size_t size() const { return x.size(); }
};

/// Samples of equal x follow by y. Errors: cancelled, deadline_exceeded. Cost: O(n log n).
RankedPoints rank_points(const PointSet& points, const Control& control);

/// So many elements of that value. Errors: cancelled, deadline_exceeded.
template <class T>
LargeVector<T> filled(std::size_t count, const T& value, const Control& control) {
  constexpr std::size_t step = 1 << 15;
  LargeVector<T> elements;
  elements.reserve(count);
  while (elements.size() < count) {
    control.check();
    elements.resize(std::min(count, elements.size() + step), value);
  }
  return elements;
}

}  // namespace wellspaced
