#pragma once

#include "core/analyze/ranked_points.h"
#include "core/control.h"

namespace wellspaced {

/// Which boxes: those that hold too little at worst leave their far sides out, those that hold too much have
/// them.
enum class BoxSides { open, closed };

/// open: the largest x y - share of samples in [0, x) x [0, y); closed: the largest share in [0, x] x [0, y]
/// - x y. The larger one of them is the star discrepancy.
///
/// Guarantees: exact up to 1e-15. Requires: at least one point. Errors: cancelled, deadline_exceeded. Cost:
/// O(n log^3 n) at worst, about .8 us and 64 bytes a point at a million. Determinism: sequential.
/// Reference: a kinetic tournament (Basch, Guibas, Hershberger, "Data Structures for Mobile Data", 1999) over
/// the lines x -> x y - share, y being the samples'; x sweeps.
double star_discrepancy(const RankedPoints& points, BoxSides sides, const Control& control);

}  // namespace wellspaced
