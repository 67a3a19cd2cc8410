#pragma once

#include <functional>
#include <optional>

#include "core/control.h"
#include "core/point_set.h"
#include "core/voronoi/stars.h"

namespace wellspaced {

/// Proven bounds: the true radii of the points, taken as exact numbers, lie within them.
struct Certificate {
  double r_f_lower = 0, r_c_upper = 0;
  double beta_upper = 0;  ///< of the global ratio r_c / r_f
};

/// Something that finds, for each point, neighbors around it.
using StarSource = std::function<void(const PointSet&, const Control&, const StarVisitor&)>;

/// Proves bounds on r_f, r_c and beta of a point set on a torus, with directed roundings throughout. Nothing
/// is taken on trust from who found the neighbors (`source`) or made the points:
///
/// 1. r_c: half-planes towards any neighbors contain the Voronoi cell. If each neighbor of a star lies to the
///    left of the one before it, all around, then the triangles that they make with the center have
///    circumradii of which the largest bounds the cell. Any images of any samples will do, so only the turn
///    to the left and the circumradius are proven, star by star.
/// 2. r_f: all pairs in a sweep over rows of the torus at least as high as the distance looked for.
///
/// Guarantees: as said; for stars that are Delaunay the bounds are those of measure_spacing to 1e-11
/// relative. Nothing, if some star can't be proven to turn around its center (points in a line to within
/// rounding). Requires: require_usable(points). Errors: those of the source; cancelled, deadline_exceeded.
/// Cost: O(n log n), about 0.5 us a point; memory 90 bytes a point. Determinism: the same bits on any number
/// of threads.
std::optional<Certificate> certify(const PointSet& points, const Control& control,
                                   const StarSource& source = visit_stars);

}  // namespace wellspaced
