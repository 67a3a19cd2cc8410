#pragma once

#include "core/vec.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {

/// The Voronoi cell of a point of a StarMesh, seen from the point, in units of d_hex.
///
/// Corner k is the circumcenter of the triangle between spokes k and k + 1; the edge on the bisector of spoke
/// k runs from corner k - 1 to corner k. Requires: the mesh is Delaunay around the point.
struct StarCell {
  StarCell(const StarMesh& mesh, std::size_t i);

  int before(int k) const { return k == 0 ? degree - 1 : k - 1; }

  int degree;
  Vec2 spoke[Star::most], corner[Star::most];
};

/// What sums and extremes over a cell are needed for centroids and their energy, all in one go.
struct CellMoments {
  double area = 0;
  Vec2 centroid;
  double energy = 0;  ///< integral over the cell of the squared distance to the point
  double shortest2 = 0, outermost2 = 0;
};

CellMoments moments(const StarCell& cell);
double area(const StarCell& cell);

}  // namespace wellspaced
