#pragma once

#include "core/control.h"
#include "core/optimize/push_pull_sweep.h"
#include "core/voronoi/moving_set.h"

namespace wellspaced {

/// push_pull_sweep on any domain: visits every marked point once, its mark taken away; if it violates a
/// target, moves it away from neighbors that are too near and towards corners of its cell that are too far,
/// as its freedom and the boundary allow, and marks it and the ends of what still violates. Corners where
/// the cell meets the boundary count like any other.
///
/// A step is at most 0.2 of the point's unit long. Errors: cancelled, deadline_exceeded; the set is then
/// between two states. Cost: about 1 us a visit on the plane, twice that where the point moves. Determinism:
/// sequential, in the points' order.
SweepCounts push_pull_sweep(MovingSet& set, const PushPull& targets, const Control& control);

}  // namespace wellspaced
