#include "core/analyze/domain_spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analyze/few_points.h"
#include "core/analyze/point_look.h"
#include "core/analyze/spacing_star.h"
#include "core/error.h"
#include "core/math.h"
#include "core/voronoi/moving_set.h"

namespace wellspaced {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double angle_deg(double cotangent) { return portable_atan2(1, cotangent) * (180 / pi); }

Spacing sum_up(const MovingSet& set, const std::vector<PointLook>& locals, std::vector<double>& beta_i) {
  const auto n = static_cast<double>(set.size());
  const double unit = set.spacing();
  Spacing s;
  s.n = set.size();
  double r_f = infinity, r_f_free = infinity, r_c = 0, area = 0, squares = 0, edge_max = 0, disks = 0;
  double most = -infinity, least = infinity, whole = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    area += locals[i].area;
    whole += locals[i].area * set.unit(i) * set.unit(i);
  }
  if (set.domain().is_flat()) require_whole(whole, set.domain().area());
  const double mean_area = area / n;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const PointLook& local = locals[i];
    r_f = std::min(r_f, local.r_f);
    r_f_free = std::min(r_f_free, local.r_f_free);
    r_c = std::max(r_c, local.outradius / set.unit(i));
    beta_i.push_back(local.outradius / local.nearest);
    s.beta_i_max = std::max(s.beta_i_max, beta_i.back());
    s.beta_i_mean += beta_i.back() / n;
    s.nearest_mean += local.nearest / set.unit(i) / n;
    squares += (local.area - mean_area) * (local.area - mean_area);
    edge_max = std::max(edge_max, local.edge_max);
    disks += set.unit(i) * set.unit(i);
    most = std::max(most, local.cotangent_max);
    least = std::min(least, local.cotangent_min);
    ++s.valence[local.valence];
  }
  s.r_f = r_f * unit;
  s.r_f_free = r_f_free * unit;
  s.r_c = r_c * unit;
  s.beta = r_c / r_f_free;
  if (!std::isfinite(s.beta)) throw hidden_triangles();
  s.rho = r_f_free;
  s.coverage = r_c;
  s.packing_density = disks * pi * r_f * r_f / (4 * set.domain().area());
  s.cell_area_sd = std::sqrt(squares / n) / mean_area;
  s.angle_min_deg = angle_deg(most);
  s.angle_max_deg = angle_deg(least);
  s.edge_min = 1;
  s.edge_max = edge_max / r_f;
  return s;
}

}  // namespace

LocalSpacing measure_domain_spacing(const PointSet& points, const Control& control) {
  const MovingSet set(points, control);
  std::vector<PointLook> locals(set.size());
  for_each_look(set, control,
                [&](std::size_t i, const PointLook& look, const DomainStar&) { locals[i] = look; });
  see_far_places(points, control, locals);
  LocalSpacing result;
  result.beta_i.reserve(set.size());
  result.global = sum_up(set, locals, result.beta_i);
  return result;
}

}  // namespace wellspaced
