#pragma once

#include <cstddef>
#include <cstdint>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// How many cells of a conflict radius's background grid a side of that length has: so many that two points
/// of one cell (their sides at most radius/sqrt(2)) are never farther from each other than the radius.
std::int64_t background_cells(double length, double radius);

/// Brings points into the order of generated sets: row by row of the background grid, left to right; the
/// present order within a cell. Requires: a planar domain; the first `sorted` points are in that order.
/// Errors: cancelled, deadline_exceeded (the points are then as they were). Cost: O(n + k log k) for k
/// unsorted ones.
void bring_into_rows(PointSet& points, std::size_t sorted, double radius, const Control& control);

/// The same on any domain, for points in any order: in space, layer by layer of the grid.
/// Errors: cancelled, deadline_exceeded. Cost: O(n log n).
void sort_into_rows(PointSet& points, double radius, const Control& control);

}  // namespace wellspaced
