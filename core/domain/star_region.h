#pragma once

#include <span>

#include "core/domain/domain.h"

namespace wellspaced {

/// A part of a border edge as it is seen in a chart: from `right` to `left`.
struct BorderView {
  Vec2 right, left;
};

/// What can be seen from a place in a chart up to the border, and beyond `reach` where that is not in the
/// way: triangles with a corner at the apex, which don't overlap.
///
/// Requires: views don't overlap. Cost: O(views log views), about .1 us a view.
ChartPieces star_region(Vec2 apex, std::span<const BorderView> views, double reach);

}  // namespace wellspaced
