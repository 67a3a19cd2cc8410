#include "core/analyze/local_measures.h"

#include <numeric>

#include "core/analyze/bond_order.h"
#include "core/analyze/point_look.h"
#include "core/analyze/spacing_star.h"
#include "core/math.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

double angle_deg(double cotangent) { return portable_atan2(1, cotangent) * (180 / pi); }

double value_of(const PointLook& look, LocalMeasure what, double unit) {
  switch (what) {
    case LocalMeasure::beta_i:
      return look.outradius / look.nearest;
    case LocalMeasure::nearest:
      return look.nearest / unit;
    case LocalMeasure::area:
      return look.area;
    case LocalMeasure::valence:
      return look.valence;
    case LocalMeasure::angle:
      return angle_deg(look.cotangent_max);
    case LocalMeasure::psi6:
      break;
  }
  return 0;
}

std::vector<double> measure_elsewhere(const PointSet& points, LocalMeasure what, const Control& control) {
  const MovingSet set(points, control);
  std::vector<double> values(set.size());
  for_each_look(set, control, [&](std::size_t i, const PointLook& look, const DomainStar&) {
    values[i] = value_of(look, what, set.unit(i));
  });
  if (what != LocalMeasure::area) return values;
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  for (double& value : values) value /= mean;
  return values;
}

}  // namespace

std::vector<double> measure_locally(const PointSet& points, LocalMeasure what, const Control& control) {
  if (what == LocalMeasure::psi6) return bond_order(points, control).psi6;
  if (!is_plain_torus(points)) return measure_elsewhere(points, what, control);
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
        values[i] = angle_deg(star.cotangent_max);
        break;
      case LocalMeasure::psi6:
        break;
    }
  });
  require_whole(std::accumulate(areas.begin(), areas.end(), 0.0), points.domain->area());
  return values;
}

}  // namespace wellspaced
