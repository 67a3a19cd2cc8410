#include "core/analyze/spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "core/analyze/domain_spacing.h"
#include "core/analyze/spacing_star.h"
#include "core/large_vector.h"
#include "core/math.h"
#include "core/voronoi/moving_set.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t between_checks = 1 << 16;

double angle_deg(double cotangent) { return portable_atan2(1, cotangent) * (180 / pi); }

/// n disks of radius r_c cover the domain, so their areas add up to at least its own: a triangulation that
/// says otherwise is not one, and must not be believed.
void require_possible(const Spacing& s, double area) {
  const double disks = static_cast<double>(s.n) * pi * s.r_c * s.r_c;
  if (!std::isfinite(s.beta) || !(disks >= area * (1 - 1e-9))) throw hidden_triangles();
}

/// Sums and extremes of all stars, and what they say together.
class Summary {
 public:
  explicit Summary(const PointSet& points)
      : n_(points.size()), area_(points.domain->area()), mean_area_(area_ / static_cast<double>(n_)) {}

  /// In the points' order: the sums must not depend on threads. Returns the point's beta_i.
  double add(const StarMeasure& m) {
    const double beta_i = m.outradius / m.nearest, excess = m.cell_area - mean_area_;
    r_f_ = std::min(r_f_, m.nearest);
    r_c_ = std::max(r_c_, m.outradius);
    beta_max_ = std::max(beta_max_, beta_i);
    beta_sum_ += beta_i;
    nearest_sum_ += m.nearest;
    cell_area_sum_ += m.cell_area;
    area_square_sum_ += excess * excess;
    edge_max_ = std::max(edge_max_, m.edge_max);
    cotangent_max_ = std::max(cotangent_max_, m.cotangent_max);
    cotangent_min_ = std::min(cotangent_min_, m.cotangent_min);
    if (m.valence < static_cast<int>(few_.size()))
      ++few_[static_cast<std::size_t>(m.valence)];
    else
      ++many_[m.valence];
    return beta_i;
  }

  Spacing result() const {
    const auto n = static_cast<double>(n_);
    const double spacing = hexagonal_spacing(area_, n_);
    Spacing s;
    s.n = n_;
    s.r_f = r_f_;
    s.r_f_free = r_f_;
    s.r_c = r_c_;
    s.beta = r_c_ / r_f_;
    require_possible(s, area_);
    require_whole(cell_area_sum_, area_);
    s.beta_i_max = beta_max_;
    s.beta_i_mean = beta_sum_ / n;
    s.rho = r_f_ / spacing;
    s.coverage = r_c_ / spacing;
    s.packing_density = n * pi * r_f_ * r_f_ / (4 * area_);
    s.nearest_mean = nearest_sum_ / n / spacing;
    s.cell_area_sd = std::sqrt(area_square_sum_ / n) / mean_area_;
    s.angle_min_deg = angle_deg(cotangent_max_);
    s.angle_max_deg = angle_deg(cotangent_min_);
    s.edge_min = 1;
    s.edge_max = edge_max_ / r_f_;
    s.valence = many_;
    for (std::size_t k = 0; k < few_.size(); ++k)
      if (few_[k] > 0) s.valence[static_cast<int>(k)] = few_[k];
    return s;
  }

 private:
  std::size_t n_;
  double area_, mean_area_;
  double r_f_ = infinity, r_c_ = 0, edge_max_ = 0, beta_max_ = 0;
  double beta_sum_ = 0, nearest_sum_ = 0, cell_area_sum_ = 0, area_square_sum_ = 0;
  double cotangent_max_ = -infinity, cotangent_min_ = infinity;
  std::array<std::size_t, 32> few_{};  ///< how many points have so few neighbors
  std::map<int, std::size_t> many_;
};

/// In the points' order.
LargeVector<StarMeasure> measure_stars(const PointSet& points, const Control& control) {
  require_usable(points, control);
  LargeVector<StarMeasure> stars(points.size());
  visit_stars(points, control,
              [&](std::size_t i, std::span<const Spoke> spokes) { stars[i] = measure_star(i, spokes); });
  return stars;
}

}  // namespace

Spacing measure_spacing(const PointSet& points, const Control& control) {
  if (!is_plain_torus(points)) return measure_domain_spacing(points, control).global;
  const auto stars = measure_stars(points, control);
  Summary summary(points);
  for (std::size_t i = 0; i < stars.size(); ++i) {
    if (i % between_checks == 0) control.check();
    summary.add(stars[i]);
  }
  return summary.result();
}

GlobalRatio measure_ratio(const PointSet& points, const Control& control) {
  if (!is_plain_torus(points)) {
    const MovingSet set(points, control);
    const MeshRadii radii = set.measure(control);
    return {radii.shortest * set.spacing(), radii.outermost * set.spacing()};
  }
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
  if (!is_plain_torus(points)) return measure_domain_spacing(points, control);
  const auto stars = measure_stars(points, control);
  Summary summary(points);
  LocalSpacing result;
  result.beta_i.reserve(points.size());
  for (std::size_t i = 0; i < stars.size(); ++i) {
    if (i % between_checks == 0) control.check();
    result.beta_i.push_back(summary.add(stars[i]));
  }
  result.global = summary.result();
  return result;
}

}  // namespace wellspaced
