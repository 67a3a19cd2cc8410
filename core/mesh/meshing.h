#pragma once

#include "core/control.h"
#include "core/mesh/mesh.h"
#include "core/point_set.h"

namespace wellspaced {

/// The Delaunay triangles of a point set, on any domain: see planar_delaunay and delaunay_by_stars.
Mesh delaunay_mesh(const PointSet& points, const Control& control);

/// Its Voronoi cells, clipped to the domain: see planar_voronoi and voronoi_by_stars.
Mesh voronoi_mesh(const PointSet& points, const Control& control);

}  // namespace wellspaced
