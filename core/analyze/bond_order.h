#pragma once

#include <vector>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// How nearly the neighbors of samples stand as in the triangular lattice, by sixfold angles. Three measures
/// that go by the same name and differ; each is in [0, 1] and 1 for the triangular lattice.
struct BondOrder {
  /// |mean over samples of psi6_i|, psi6_i = mean over Delaunay neighbors of exp(6 i theta), theta being the
  /// direction to the neighbor: whether the set has one orientation. About 1/sqrt(n) where it has none. NaN
  /// on curved domains, where directions at two points can't be compared.
  double psi6_global = 0;
  /// Mean over samples of |psi6_i|: whether each sample's neighbors are a hexagon, however turned.
  double psi6_local = 0;
  /// The variant of the tool PSA: for each sample the sum of exp(6 i theta) over the edges of its star from
  /// one neighbor to the next, theta being the edge's direction; absolute values added up over samples,
  /// divided by the number of all edges so counted.
  double psi6_edges = 0;
  std::vector<double> psi6;  ///< |psi6_i| of each sample, in the points' order, for pictures
};

/// Measures a point set: on the plain torus by its stars, elsewhere by those of its clipped cells.
///
/// Guarantees: sums over the stars of visit_stars, periodic images included. Lattices with cocircular
/// neighbors, such as the square one, have no unique triangulation and so no unique bond order.
/// Requires: a set for which measure_spacing does not refuse the result, as it does nearly collinear ones.
/// Errors: those of require_usable; degenerate_input as for visit_stars; cancelled, deadline_exceeded. Cost:
/// O(n log n), about 0.25 us a point for even sets; 40 bytes a point, besides the stars. Determinism: the
/// same bits on any number of threads; powers of directions in plain arithmetic, no angles. Reference:
/// Halperin and Nelson, "Theory of Two-Dimensional Melting", 1978 (psi6); Schloemer and Heck's tool PSA, 2012
/// (psi6_edges).
BondOrder bond_order(const PointSet& points, const Control& control);

}  // namespace wellspaced
