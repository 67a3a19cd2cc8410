#include "core/analyze/local_measures.h"

#include <numeric>

#include "core/analyze/bond_order.h"
#include "core/analyze/spacing_star.h"
#include "core/math.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
std::vector<double> measure_locally(const PointSet& points, LocalMeasure what, const Control& control) {
  if (what == LocalMeasure::psi6) return bond_order(points, control).psi6;
  const double d_hex = hexagonal_spacing(points.domain->area(), points.size());
  const double mean_area = points.domain->area() / static_cast<double>(points.size());
  std::vector<double> values(points.size()), areas(points.size());
  visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
    const StarMeasure star = measure_star(i, spokes);
    areas[i] = star.cell_area;
    switch (what) {
      case LocalMeasure::beta_i:
        values[i] = star.outradius / star.nearest;
        break;
      case LocalMeasure::nearest:
        values[i] = star.nearest / d_hex;
        break;
      case LocalMeasure::area:
        values[i] = star.cell_area / mean_area;
        break;
      case LocalMeasure::valence:
        values[i] = star.valence;
        break;
      case LocalMeasure::angle:
        values[i] = portable_atan2(1, star.cotangent_max) * (180 / pi);
        break;
      case LocalMeasure::psi6:
        break;
    }
  });
  require_whole(std::accumulate(areas.begin(), areas.end(), 0.0), points.domain->area());
  return values;
}

}  // namespace wellspaced
