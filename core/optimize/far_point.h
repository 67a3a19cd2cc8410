#pragma once

#include "core/control.h"
#include "core/optimize/optimize.h"

namespace wellspaced {

struct FarPointOptions {
  int max_sweeps = 100;     ///< at least 1
  double tolerance = 1e-5;  ///< it is over when the mean distance to the nearest point, in units of d_hex,
                            ///< grew by less in a sweep; at least 0
};

/// Farthest-point optimization: each point in turn is taken out and put where the others are farthest, the
/// center of the largest empty circle, if that is farther than where it was (the authors' global variant);
/// over and over, until the mean distance to the nearest point stops growing.
///
/// Guarantees: those of OptimizeResult; `converged` stays empty, since there is no target for beta. r_f never
/// falls from one sweep to the next. `history` holds all sweeps. A point stays where it is if moving it would
/// take edges that reach around the torus, as only very few or very uneven points can have.
/// Errors: those of StarMesh; invalid_parameters at /max_sweeps, /tolerance; cancelled, deadline_exceeded.
/// Cost: 4 us a point and sweep, 5 us at a million; 200 bytes a point.
/// Determinism: sequential; of circles of the same size the first in the mesh's order is taken.
/// Reference: Schloemer, Heck, Deussen, "Farthest-Point Optimized Point Sets with Maximized Minimum
/// Distance", 2011.
OptimizeResult far_point(const PointSet& input, const FarPointOptions& options, Control& control);

}  // namespace wellspaced
