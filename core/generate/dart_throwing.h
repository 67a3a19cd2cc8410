#pragma once

#include <memory>

#include "core/control.h"
#include "core/domain/torus.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

/// What disk samplings keep: no two points nearer than `conflict`, no place farther than `coverage` from all
/// of them. Requires: 0 < conflict <= coverage <= half the torus's diagonal.
struct DiskRadii {
  double conflict = 0, coverage = 0;
};

/// Darts into a flat quadtree of cells that no single disk covers, until none is left or the cells reach the
/// resolution of their 32-bit indices. So the first guarantee of `poisson_disk` and `two_radii` holds, their
/// second one is not proven yet.
///
/// Order: row by row of the background grid. Errors: cancelled, deadline_exceeded.
PointSet throw_darts(const std::shared_ptr<const Torus>& torus, const DiskRadii& radii, Rng& rng,
                     Control& control);

/// The same; then coverage is proven cell by cell from the Voronoi diagram, and gaps that rounding left are
/// filled.
PointSet throw_darts_and_prove(const std::shared_ptr<const Torus>& torus, const DiskRadii& radii, Rng& rng,
                               Control& control);

}  // namespace wellspaced
