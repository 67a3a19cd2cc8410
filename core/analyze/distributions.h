#pragma once

#include <span>

#include "core/analyze/histogram.h"
#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// How what measure_spacing sums up is distributed over samples, Delaunay edges and Delaunay triangles. Bins
/// lie on fixed grids, so that sets can be pooled: their origin and width are given here.
struct Distributions {
  Histogram beta_i;     ///< local ratios r_c^i / r_f^i; .5, .01
  Histogram valence;    ///< Delaunay neighbors of a sample; -.5, 1: bin k is centered at a whole number
  Histogram angle_deg;  ///< of triangles, all three of each; 0, 1; 180 belongs to the last bin, [179, 180]
  Histogram edge;       ///< lengths of edges, each once, / d_hex; 0, .02
  Histogram nearest;    ///< distance to the nearest other sample / d_hex; 0, .02
  Histogram cell_area;  ///< area of the Voronoi cell / mean area; 0, .02
};

/// Measures a point set in one pass over its stars: on other domains than the plain torus those of clipped
/// cells, angles and edges of triangles inside, each as its corner sees it (three
/// points at a boundary need not all see each other), lengths in the units of MovingSet (d_hex, or with a
/// sizing function what stands for it there; of an edge the smaller one).
///
/// Guarantees, on the torus: n samples, 3 n edges and 6 n angles, those of the exact Delaunay triangulation
/// up to 1e-12 relative; triangles between periodic images count, once each. Where neighbors are cocircular,
/// as in the square lattice, the triangulation is not unique, and edges and angles may be fewer. Requires: a
/// set for which measure_spacing does not refuse the result, as it does nearly collinear ones. Errors: those
/// of require_usable; degenerate_input as for visit_stars; cancelled, deadline_exceeded. Cost: O(n log n),
/// about 0.5 us a point for even sets; 100 bytes a point, besides the stars. Determinism: the same bits on
/// any number of threads. Reference: Ebeida et al. 2013, section 6, for the measures.
Distributions distributions(const PointSet& points, const Control& control);

/// Of all sets together, lengths and areas relative to each set's own. Requires: at least one.
Distributions pool(std::span<const Distributions> sets);

}  // namespace wellspaced
