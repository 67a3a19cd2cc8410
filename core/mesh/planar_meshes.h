#pragma once

#include "core/control.h"
#include "core/mesh/mesh.h"
#include "core/point_set.h"

namespace wellspaced {

/// The constrained Delaunay triangles of a set on a box, strip or polygon, exact, by CGAL: those of the
/// points inside the domain, whose boundary is made of edges. Corners of the domain that are no points are
/// vertices, too; on a side of a strip without points, one place is. A strip lies unwrapped.
///
/// Guarantees: the triangles cover the domain, each place once; no point sees into the circumcircle of a
/// triangle. Errors: those of require_usable; degenerate_input where edges of the boundary would cross, as
/// rounding may have it in spikes. Cost: O(n log n), about 3 us a point, on one thread.
Mesh planar_delaunay(const PointSet& points, const Control& control);

/// Their Voronoi cells, clipped to the domain: cells near the boundary by exact arithmetic, so that the parts
/// of two cells fit together. A cell may have several parts, as faces; one around a hole is cut into
/// triangles.
///
/// Guarantees: areas add up to the domain's to rounding. Errors: as above. Cost: O(n log n), about 3 us a
/// point, and .1 ms a point whose cell the boundary may cut, on one thread.
Mesh planar_voronoi(const PointSet& points, const Control& control);

}  // namespace wellspaced
