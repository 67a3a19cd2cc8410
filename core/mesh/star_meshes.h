#pragma once

#include "core/control.h"
#include "core/mesh/mesh.h"
#include "core/point_set.h"

namespace wellspaced {

/// The Delaunay triangles of a set on the torus, the sphere or a surface mesh, by their stars.
///
/// Guarantees: on the torus and the sphere, Delaunay to rounding; on surfaces, triangles whose corners see
/// each other as neighbors of their cells. A surface of the domain's topology in which no edge occurs twice;
/// on the torus unwrapped. Errors: those of StarMap; infeasible, too, where two points would be joined twice.
/// Cost: about 4 us a point on the torus, 10 to 20 elsewhere, most of it on all threads.
Mesh delaunay_by_stars(const PointSet& points, const Control& control);

/// Their Voronoi cells: the dual of the map that the stars make. At the border of a surface, cells end in
/// straight lines between the places where their edges meet it.
Mesh voronoi_by_stars(const PointSet& points, const Control& control);

}  // namespace wellspaced
