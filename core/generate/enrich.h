#pragma once

#include "core/control.h"
#include "core/domain/domain.h"
#include "core/point_set.h"

namespace wellspaced {

/// Fills the holes of a point set: inserts points in the middle of the deepest ones until no place is farther
/// than `coverage` from its nearest sample. On a boundary they are points that slide along it, or its
/// corners.
///
/// Guarantees
/// 1. The first points are the input, bit for bit and in its order; inserted ones come after them.
/// 2. r_c <= coverage (1 + 1e-9).
/// 3. Each inserted point is farther than `coverage` from all others, so there are at most
/// `most_inserted(domain, coverage)`, and none if r_c was small enough already.
/// Requires: require_usable(points); coverage > 0.
/// Errors: degenerate_input as for visit_stars; cancelled, deadline_exceeded.
/// Cost: O(n log n): a million uniform points take 6 s; clustered ones ten times as long.
/// Determinism: depends on the arguments only.
PointSet enrich(const PointSet& points, double coverage, Control& control);

/// What `enrich` is asked for by requests: the radius of a maximal Poisson-disk sampling with as many points,
/// sqrt(0.6966 A / n) but on tori so thin that points follow each other as on a line; or r_f, where that is
/// larger. So r_f never falls, and a set with beta <= 1 is left as it is. With a sizing function both are
/// parts of the radii that it wants.
/// Requires: require_usable(points). Errors: cancelled, deadline_exceeded. Cost: O(n).
double enrichment_coverage(const PointSet& points, const Control& control);

/// How many points that are `spacing` from each other, own images included, have room on a torus at most;
/// elsewhere twice as many as a plane of that size has room for.
/// Reference: Thue's theorem on the packing of disks.
double most_inserted(const Domain& domain, double spacing);

}  // namespace wellspaced
