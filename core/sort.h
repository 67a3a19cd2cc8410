#pragma once

#include <algorithm>
#include <cstdint>

#include "core/control.h"

namespace wellspaced {

/// std::sort that asks `control` every few milliseconds.
///
/// Guarantees: the order of std::sort. If it throws, [first, last) holds the same elements in some order.
/// Errors: cancelled, deadline_exceeded.
template <class Iterator, class Less>
void sort(Iterator first, Iterator last, const Control& control, const Less& less) {
  std::uint32_t comparisons = 0;
  std::sort(first, last, [&](const auto& a, const auto& b) {
    if (++comparisons % 65536 == 0) control.check();
    return less(a, b);
  });
}

}  // namespace wellspaced
