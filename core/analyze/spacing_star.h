#pragma once

#include <cstddef>
#include <span>

#include "core/voronoi/stars.h"

namespace wellspaced {

/// What one point's Delaunay star says of how well spaced it is.
struct StarMeasure {
  double nearest;    ///< distance to the nearest other sample; infinite if there are own images only
  double outradius;  ///< of the Voronoi cell
  double cell_area;
  double edge_max;  ///< longest spoke
  /// Of the angles of the star's triangles. Cotangents fall as angles grow.
  double cotangent_max, cotangent_min;
  int valence;
};

/// Requires: a star of visit_stars, that of point i. Cost: about 40 ns. Determinism: the same bits on any
/// vector width.
StarMeasure measure_star(std::size_t i, std::span<const Spoke> spokes);

/// Cells are all of the domain: stars whose cells don't add up to its area must not be believed.
/// Errors: hidden_triangles if the sum differs by more than 1e-5.
void require_whole(double cell_areas, double area);

}  // namespace wellspaced
