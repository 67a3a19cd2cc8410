#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// How well spaced a point set is. Lengths are domain lengths, angles degrees, ratios pure numbers.
struct Spacing {
  std::size_t n = 0;
  double r_f = 0;       ///< conflict radius: smallest distance between two samples
  double r_f_free = 0;  ///< the same without pairs of two corners of the domain, which can't move
  double r_c = 0;   ///< coverage radius: largest distance from a point of the domain to its nearest sample
  double beta = 0;  ///< r_c / r_f_free, the global ratio; at least 1/sqrt(3) in the plane
  double beta_i_max = 0,
         beta_i_mean = 0;  ///< of beta_i = r_c^i / r_f^i, the local ratios; beta_i_max <= beta
  double rho = 0;       ///< r_f_free / d_hex, d_hex = sqrt(2 A / (sqrt(3) n)); 1 for the triangular lattice
  double coverage = 0;  ///< r_c / d_hex
  double packing_density = 0;  ///< n pi r_f^2 / (4 A)
  double nearest_mean = 0;     ///< mean distance to the nearest sample / d_hex
  double cell_area_sd = 0;     ///< standard deviation of the Voronoi cells' areas / their mean
  double angle_min_deg = 0, angle_max_deg = 0;  ///< of the Delaunay triangles
  double edge_min = 0, edge_max = 0;            ///< of the Delaunay edges, in units of r_f
  std::map<int, std::size_t> valence;           ///< how many samples have that many Delaunay neighbors
};

/// Spacing together with each sample's local ratio, for pictures and distributions.
struct LocalSpacing {
  Spacing global;
  std::vector<double> beta_i;
};

/// Measures a point set on any domain.
///
/// On domains with a boundary cells end there; neighbors, and with them valences, angles and edges, are
/// points whose cells touch inside the domain, which at the boundary may be fewer than the Delaunay
/// neighbors. Where the set has a sizing function, r_f, r_c and r_f_free are in units of r(x), taken at the
/// sample (for a distance: the smaller one), and all else in the units of MovingSet instead of d_hex.
///
/// Guarantees
/// 1. r_f, r_c, beta and each beta_i are those of the exact Delaunay triangulation of the points up to 1e-12
/// relative, of points that nearly coincide to 1e-15 sides / distance (valences of those, where there is a
/// boundary, may leave out edges of cells shorter than 1e-12 sides^2 / distance); on surface meshes, whose
/// charts are right to second order only, to what docs/domains.md says.
/// 2. For beta: angles lie in [asin(1/(2 beta)), 180 - 2 asin(1/(2 beta))], edges in [1, 2 beta].
/// Errors: those of require_usable; degenerate_input as for visit_stars; cancelled, deadline_exceeded. Cost:
/// O(n log n), about 0.45 us a point and thread for even sets. Determinism: the same bits on any number of
/// threads. Reference: Ebeida et al. 2013, sections 2 and 6; Lagae and Dutre 2008 (rho).
Spacing measure_spacing(const PointSet& points, const Control& control);
LocalSpacing measure_local_spacing(const PointSet& points, const Control& control);

/// What a stop test needs.
struct GlobalRatio {
  double r_f = 0, r_c = 0;
  double beta() const { return r_c / r_f; }  ///< infinite where two samples coincide
};

/// r_f and r_c alone, for a point set already known to be usable and spread out, between the sweeps of an
/// optimizer. The same values as measure_spacing's. Cost: O(n) for even sets, without its checks.
GlobalRatio measure_ratio(const PointSet& points, const Control& control);

}  // namespace wellspaced
