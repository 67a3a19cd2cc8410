#include "core/generate/domain_refinement.h"

#include <algorithm>
#include <cmath>

#include "core/generate/domain_darts.h"
#include "core/generate/expected_points.h"
#include "core/generate/hole_filler.h"
#include "core/generate/row_order.h"

namespace wellspaced {
namespace {

constexpr std::uint64_t fixed_seed = 0xde1a;  // the method takes none
constexpr std::size_t enough_to_start = 8;

/// A coarse sampling with beta <= 1, no finer than `radius`, of at most `most` points. Where cells tell only
/// about where the holes are, not so coarse that they are far from there.
PointSet start(const std::shared_ptr<const Domain>& domain, double radius, std::size_t most,
               Control& control) {
  DiskRule rule;
  const double coarse = std::sqrt(domain->area() / enough_to_start);
  rule.scale = std::max(radius, domain->has_exact_cells() ? coarse : std::min(coarse, 2 * radius));
  for (;;) {
    Rng rng(fixed_seed);
    PointSet points = throw_darts_over(domain, rule, rng, control);
    if (points.size() <= most) return points;
    rule.scale *= 1.5;
  }
}

PointSet refined(PointSet points, double scale, std::size_t expected, std::uint64_t count, Control& control) {
  DiskRule rule;
  rule.scale = scale;
  NeighborGrid grid(points, scale, expected);
  HoleFiller filler(points, grid, rule, control, HoleFiller::Search::wide);
  if (count == 0)
    filler.fill();
  else
    filler.fill_to(count);
  sort_into_rows(points, scale, control);
  return points;
}

}  // namespace

PointSet refine_domain(const std::shared_ptr<const Domain>& domain, double radius, Control& control) {
  DiskRule rule;
  rule.scale = radius;
  const auto expected = static_cast<std::size_t>(expected_points(*domain, rule));
  return refined(start(domain, radius, ~std::size_t{0}, control), radius, expected, 0, control);
}

PointSet refine_domain_to_count(const std::shared_ptr<const Domain>& domain, std::uint64_t count,
                                Control& control) {
  if (count <= 2 * enough_to_start) {
    Rng rng(fixed_seed);
    return throw_darts_over_to_count(domain, count, {}, rng, control);
  }
  require_corners(*domain, count);
  const double scale = scale_for_count(*domain, {}, static_cast<double>(count));
  return refined(start(domain, scale, count, control), scale, count, count, control);
}

}  // namespace wellspaced
