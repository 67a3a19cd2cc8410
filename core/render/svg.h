#pragma once

#include <string>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

enum class Picture {
  voronoi,   ///< Voronoi cells filled by beta_i, with their samples
  delaunay,  ///< Delaunay edges colored by the larger beta_i of their ends, with their samples
  points,    ///< the samples alone, colored by beta_i
};

struct SvgOptions {
  Picture picture = Picture::voronoi;
  double size_px = 900;  ///< of the domain's longer side; a legend is put below
};

/// A picture of a point set on a torus as SVG text: samples, cells or edges colored by the local ratio
/// beta_i, the domain's border, and a legend with the color scale and the numbers beta, r_f, r_c and rho.
///
/// Colors: a scale of even lightness steps from dark blue (1/sqrt(3), as good as can be) to amber (1 and
/// above), which color-blind readers can follow and which shows on white. What crosses the border is drawn on
/// both sides.
/// Errors: those of measure_spacing; cancelled, deadline_exceeded. Cost: O(n log n), about 200 bytes a point.
/// Determinism: the same bytes on any number of threads.
std::string render_svg(const PointSet& points, const SvgOptions& options, const Control& control);

}  // namespace wellspaced
