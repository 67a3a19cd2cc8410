#include "core/mesh/meshing.h"

#include "core/domain/torus.h"
#include "core/mesh/planar_meshes.h"
#include "core/mesh/star_meshes.h"

namespace wellspaced {
namespace {

/// There is a plane that holds all of it, once.
bool is_planar(const Domain& domain) { return domain.is_flat() && !is_torus(domain); }

}  // namespace

Mesh delaunay_mesh(const PointSet& points, const Control& control) {
  return is_planar(*points.domain) ? planar_delaunay(points, control) : delaunay_by_stars(points, control);
}

Mesh voronoi_mesh(const PointSet& points, const Control& control) {
  return is_planar(*points.domain) ? planar_voronoi(points, control) : voronoi_by_stars(points, control);
}

}  // namespace wellspaced
