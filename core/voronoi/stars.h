#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "core/control.h"
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

/// Visits the Delaunay star of every point of a torus, by whichever of the two ways below suits the point
/// set: the kernel for even sets, CGAL for clustered ones, where looking around on a uniform grid would take
/// quadratic time.
///
/// Guarantees: consecutive spokes and the center make a Delaunay triangle; periodic images count, own ones
/// included. Among cocircular neighbors, ones that share no Voronoi edge may be left out. Requires:
/// require_usable(points). Errors: degenerate_input for clusters so extreme on so thin a torus that the
/// images needed exceed a hundred million. Cost: O(n log n).
/// Determinism: the same stars on any number of threads.
void visit_stars(const PointSet& points, const Control& control, const StarVisitor& visit);

void visit_stars_by_kernel(const PointSet& points, const Control& control, const StarVisitor& visit);

/// The same where the coverage radius is about known, in domain lengths: cheaper, and right for any.
void visit_stars_of_coverage(const PointSet& points, double coverage, const Control& control,
                             const StarVisitor& visit);

/// Through CGAL's Delaunay triangulation of the points and as many of their images as prove to be needed.
/// Sequential construction; also the oracle that the kernel is tested against.
void visit_stars_by_cgal(const PointSet& points, const Control& control, const StarVisitor& visit);

/// Whether a uniform grid serves these points: no cell overfull, none empty, at about 24 points a cell.
bool is_even(const PointSet& points);

}  // namespace wellspaced
