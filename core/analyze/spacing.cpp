#include "core/analyze/spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/error.h"
#include "core/math.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What one point's star says.
struct StarMeasure {
  double nearest = infinity, outradius = 0, cell_area = 0;
  double edge_max = 0;
  // Angles by their cotangents, which fall as the angle grows: atan2 is then needed for two of them only.
  double cotangent_max = -infinity, cotangent_min = infinity;
  int valence = 0;

  double beta_i() const { return outradius / nearest; }
};

StarMeasure measure_star(std::size_t i, std::span<const Spoke> spokes) {
  StarMeasure m;
  m.valence = static_cast<int>(spokes.size());
  Vec2 previous = circumcenter(spokes.back().offset, spokes.front().offset);
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    const Vec2 a = spokes[k].offset, b = spokes[k + 1 == spokes.size() ? 0 : k + 1].offset;
    const double length = norm(a);
    if (spokes[k].id != i) m.nearest = std::min(m.nearest, length);
    m.edge_max = std::max(m.edge_max, length);
    const Vec2 center = circumcenter(a, b);
    m.outradius = std::max(m.outradius, norm(center));
    m.cell_area += cross(previous, center) / 2;
    previous = center;
    // All three angles, though a neighbor sees its own: among cocircular points it may see another triangle.
    const double twice_area = cross(a, b), at_center = dot(a, b), at_a = dot(a, a - b), at_b = dot(b, b - a);
    m.cotangent_max =
        std::max({m.cotangent_max, at_center / twice_area, at_a / twice_area, at_b / twice_area});
    m.cotangent_min =
        std::min({m.cotangent_min, at_center / twice_area, at_a / twice_area, at_b / twice_area});
  }
  return m;
}

double angle_deg(double cotangent) { return portable_atan2(1, cotangent) * (180 / pi); }

/// n disks of radius r_c cover the domain, so their areas add up to at least its own: a triangulation that
/// says otherwise is not one, and must not be believed.
void require_possible(const Spacing& s, double area) {
  const double disks = static_cast<double>(s.n) * pi * s.r_c * s.r_c;
  if (std::isfinite(s.beta) && disks >= area * (1 - 1e-9)) return;
  throw Error(
      ErrorCode::degenerate_input,
      "the points are so nearly on one line that rounding hides their triangles; move some of them off it");
}

Spacing summarize(const PointSet& points, const std::vector<StarMeasure>& stars) {
  Spacing s;
  s.n = points.size();
  const auto n = static_cast<double>(s.n);
  const double area = points.domain->area(), spacing = hexagonal_spacing(area, s.n);
  s.r_f = infinity;
  double cotangent_max = -infinity, cotangent_min = infinity, nearest_sum = 0, beta_sum = 0,
         area_square_sum = 0;
  for (const StarMeasure& m : stars) {  // in the points' order: the sums must not depend on threads
    s.r_f = std::min(s.r_f, m.nearest);
    s.r_c = std::max(s.r_c, m.outradius);
    s.beta_i_max = std::max(s.beta_i_max, m.beta_i());
    beta_sum += m.beta_i();
    nearest_sum += m.nearest;
    area_square_sum += (m.cell_area - area / n) * (m.cell_area - area / n);
    s.edge_max = std::max(s.edge_max, m.edge_max);
    cotangent_max = std::max(cotangent_max, m.cotangent_max);
    cotangent_min = std::min(cotangent_min, m.cotangent_min);
    ++s.valence[m.valence];
  }
  s.beta = s.r_c / s.r_f;
  require_possible(s, area);
  s.beta_i_mean = beta_sum / n;
  s.rho = s.r_f / spacing;
  s.coverage = s.r_c / spacing;
  s.packing_density = n * pi * s.r_f * s.r_f / (4 * area);
  s.nearest_mean = nearest_sum / n / spacing;
  s.cell_area_sd = std::sqrt(area_square_sum / n) / (area / n);
  s.angle_min_deg = angle_deg(cotangent_max);
  s.angle_max_deg = angle_deg(cotangent_min);
  s.edge_min = 1;
  s.edge_max /= s.r_f;
  return s;
}

std::vector<StarMeasure> measure_stars(const PointSet& points, const Control& control) {
  require_usable(points, control);
  std::vector<StarMeasure> stars(points.size());
  visit_stars(points, control,
              [&](std::size_t i, std::span<const Spoke> spokes) { stars[i] = measure_star(i, spokes); });
  return stars;
}

}  // namespace

Spacing measure_spacing(const PointSet& points, const Control& control) {
  return summarize(points, measure_stars(points, control));
}

GlobalRatio measure_ratio(const PointSet& points, const Control& control) {
  std::vector<GlobalRatio> locals(points.size());
  visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
    const StarMeasure m = measure_star(i, spokes);
    locals[i] = {m.nearest, m.outradius};
  });
  GlobalRatio ratio{infinity, 0};
  for (const GlobalRatio& local : locals)
    ratio = {std::min(ratio.r_f, local.r_f), std::max(ratio.r_c, local.r_c)};
  return ratio;
}

LocalSpacing measure_local_spacing(const PointSet& points, const Control& control) {
  const std::vector<StarMeasure> stars = measure_stars(points, control);
  LocalSpacing result{summarize(points, stars), {}};
  result.beta_i.reserve(stars.size());
  for (const StarMeasure& m : stars) result.beta_i.push_back(m.beta_i());
  return result;
}

}  // namespace wellspaced
