#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// What can be said of one sample by its Voronoi cell and Delaunay star.
enum class LocalMeasure {
  beta_i,   ///< r_c^i / r_f^i
  nearest,  ///< distance to the nearest sample / d_hex
  area,     ///< of the Voronoi cell / mean
  valence,  ///< number of Delaunay neighbors
  angle,    ///< smallest angle of the Delaunay triangles around it, degrees
  psi6,     ///< |mean over its neighbors of exp(6 i theta)|
};

/// In the order of the enumeration.
inline constexpr std::array<std::string_view, 6> local_measure_names = {"beta_i",  "nearest", "area",
                                                                        "valence", "angle",   "psi6"};

/// In the points' order. Requires: require_usable(points). Errors and cost: those of visit_stars.
/// Determinism: the same bits on any number of threads.
std::vector<double> measure_locally(const PointSet& points, LocalMeasure what, const Control& control);

}  // namespace wellspaced
