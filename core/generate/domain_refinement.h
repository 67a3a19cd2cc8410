#pragma once

#include <cstdint>
#include <memory>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// Delaunay refinement of any domain but the torus, which has delaunay_refinement of its own: the deepest
/// place of all becomes a point, again and again, from a few points that are always the same, the corners of
/// the boundary among them. Where the deepest place is on the boundary the point slides along it from then
/// on. On surface meshes from a sampling with twice the distance.
///
/// Guarantees of `refine_domain`: r_c <= radius (1 + 1e-9), r_f >= radius (1 - 1e-9) but between corners. Of
/// `refine_domain_to_count`: exactly `count` points; beta <= 1 + 1e-9, but for corners. On surface meshes as
/// far as cells are right.
/// Order: row by row of the background grid. Errors: infeasible at /count for fewer points than corners;
/// cancelled, deadline_exceeded. Cost: O(n log n), about 20 us a point in the plane.
PointSet refine_domain(const std::shared_ptr<const Domain>& domain, double radius, Control& control);
PointSet refine_domain_to_count(const std::shared_ptr<const Domain>& domain, std::uint64_t count,
                                Control& control);

}  // namespace wellspaced
