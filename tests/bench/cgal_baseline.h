#pragma once

#include "core/point_set.h"

namespace wellspaced::bench {

/// What a program that leaves everything to CGAL would do: the Delaunay triangulation of the points in the
/// plane, and the largest circumradius. Returns its square.
double cgal_delaunay(const PointSet& points);

/// One iteration of Lloyd's method whose cells all come from CGAL's triangulation of the points and their
/// images. Returns the mean squared move.
double cgal_lloyd(const PointSet& points);

}  // namespace wellspaced::bench
