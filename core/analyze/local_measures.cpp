#include "core/analyze/local_measures.h"

#include <cmath>

#include "core/analyze/spacing_star.h"
#include "core/math.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

/// (x + i y)^6 / |x + i y|^6
Vec2 sixth_power_of_direction(Vec2 v) {
  const auto times = [](Vec2 a, Vec2 b) { return Vec2{a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; };
  const Vec2 unit = (1 / norm(v)) * v, square = times(unit, unit);
  return times(square, times(square, square));
}

double psi6(std::span<const Spoke> spokes) {
  Vec2 sum{0, 0};
  for (const Spoke& spoke : spokes) sum = sum + sixth_power_of_direction(spoke.offset);
  return norm(sum) / static_cast<double>(spokes.size());
}

}  // namespace

std::vector<double> measure_locally(const PointSet& points, LocalMeasure what, const Control& control) {
  const double d_hex = hexagonal_spacing(points.domain->area(), points.size());
  const double mean_area = points.domain->area() / static_cast<double>(points.size());
  std::vector<double> values(points.size());
  visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
    const StarMeasure star = measure_star(i, spokes);
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
        values[i] = psi6(spokes);
        break;
    }
  });
  return values;
}

}  // namespace wellspaced
