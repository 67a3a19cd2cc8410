#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/control.h"
#include "core/generate/disk_rule.h"
#include "core/point_set.h"
#include "core/rng.h"
#include "core/voronoi/neighbors.h"

namespace wellspaced {

/// Maximal Poisson-disk sampling of any domain: Simple MPS with triangles for cells. Corners of the boundary
/// first, which are all taken; then its curves, each until it is covered by points on it or near it; then
/// darts over the whole domain; then into the parts of the domain's triangles that no single disk covers,
/// which are halved until none is left.
///
/// Guarantees
/// 1. No point has less room than the rule says from any earlier one, but corners from corners.
/// 2. Every place is covered, to within 1e-9; on surface meshes as far as cells are right.
/// 3. Unbiased inside: each dart is uniform over what the earlier ones leave free. The curves are filled
/// first.
/// 4. Order: row by row of the background grid.
/// Errors: cancelled, deadline_exceeded. Cost: O(n), about 3 us a point on the plane. Determinism: depends on
/// the arguments only; sequential. Reference: Ebeida, Mitchell, Patney, Davidson, Owens, "A Simple Algorithm
/// for Maximal Poisson-Disk Sampling in High Dimensions", 2012.
PointSet throw_darts_over(const std::shared_ptr<const Domain>& domain, const DiskRule& rule, Rng& rng,
                          Control& control);

/// The same with exactly `count` points, for the scale that is found: a sampling of somewhat fewer points, to
/// which farthest-point insertion adds those that are missing. rule.scale is not looked at.
///
/// Guarantees: exactly `count` points; 2. above for the radius of the result, so that beta is at most
/// rule.coverage (1 + 1e-9) without a sizing function. Errors: infeasible at /count for fewer points than the
/// domain has corners; cancelled, deadline_exceeded.
PointSet throw_darts_over_to_count(const std::shared_ptr<const Domain>& domain, std::uint64_t count,
                                   const DiskRule& rule, Rng& rng, Control& control);

/// Errors: infeasible at /count for fewer points than the domain has corners.
void require_corners(const Domain& domain, std::uint64_t count);

/// That corners are as far apart as points must be. Errors: infeasible at /domain, naming two that are not.
void require_corners_apart(const std::shared_ptr<const Domain>& domain);

}  // namespace wellspaced
