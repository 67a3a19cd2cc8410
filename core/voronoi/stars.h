#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "core/control.h"
#include "core/error.h"
#include "core/point_set.h"

namespace wellspaced {

/// One edge of the Delaunay triangulation as seen from its star's center.
struct Spoke {
  Vec2 offset;  ///< to the neighbor (the image that is meant), in the tangent chart of the center
  std::uint32_t id = 0;
};

/// Called with a point's index and its Delaunay neighbors, counter-clockwise; concurrently for different
/// points.
using StarVisitor = std::function<void(std::size_t, std::span<const Spoke>)>;

/// Visits the Delaunay star of every point of a torus, by whichever way suits the point set: wrap_stars or
/// the kernel for even sets, CGAL for clustered ones, where looking around on a uniform grid would take
/// quadratic time, and for points that nearly coincide.
///
/// Guarantees: consecutive spokes and the center make a Delaunay triangle; periodic images count, own ones
/// included. Among cocircular neighbors, ones that share no Voronoi edge may be left out. At least three
/// spokes. Requires: require_usable(points). Errors: hidden_triangles; cancelled, deadline_exceeded. Cost:
/// O(n log n).
/// Determinism: the same stars on any number of threads.
void visit_stars(const PointSet& points, const Control& control, const StarVisitor& visit);

/// By wrap_stars. False, and nothing was visited: that does not suit the point set.
bool visit_stars_by_wrapping(const PointSet& points, const Control& control, const StarVisitor& visit);

void visit_stars_by_kernel(const PointSet& points, const Control& control, const StarVisitor& visit);

/// Through CGAL's Delaunay triangulation of the points and those of their images that prove to be needed, by
/// exact predicates: however near to each other points are, on whichever sides of the seams, they are
/// triangulated as they are. Images farther than a quarter of a period have rounded places.
/// Sequential construction; also the oracle that the kernel is tested against.
void visit_stars_by_cgal(const PointSet& points, const Control& control, const StarVisitor& visit);

/// What to say where rounding leaves no triangulation to be believed: degenerate_input.
Error hidden_triangles();

/// Whether a uniform grid serves these points: no cell overfull, none empty, at about 24 points a cell.
bool is_even(const PointSet& points);

}  // namespace wellspaced
