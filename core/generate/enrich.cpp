#include "core/generate/enrich.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/analyze/spacing.h"
#include "core/domain/torus.h"
#include "core/generate/domain_darts.h"
#include "core/generate/expected_points.h"
#include "core/generate/farthest_point.h"
#include "core/generate/generate.h"
#include "core/generate/hole_filler.h"
#include "core/math.h"
#include "core/voronoi/neighbors.h"

namespace wellspaced {
namespace {

/// Ends at the first such pair, so that crowds cost no more than one look at them.
bool has_pair_nearer_than(const PointSet& points, double distance, const Control& control) {
  const NeighborGrid grid(points, distance);
  std::vector<Neighbor> near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 1024 == 0) control.check();
    const auto self = static_cast<std::uint32_t>(i);
    near.clear();
    grid.gather(points[i], self, distance, near);
    if (std::any_of(near.begin(), near.end(), [&](const Neighbor& n) { return n.id != self; })) return true;
  }
  return false;
}

}  // namespace

PointSet enrich(const PointSet& points, double coverage, Control& control) {
  PointSet enriched = points;
  if (!is_plain_torus(points)) {
    DiskRule rule;
    rule.scale = coverage;
    rule.sizing = points.sizing.get();
    NeighborGrid grid(enriched, rule.least());
    HoleFiller(enriched, grid, rule, control, HoleFiller::Search::wide).fill();
    control.report({1});
    return enriched;
  }
  FarthestPointEnd end;
  end.coverage = coverage;
  insert_farthest(enriched, end, control);
  control.report({1});
  return enriched;
}

double enrichment_coverage(const PointSet& points, const Control& control) {
  if (!is_plain_torus(points)) {
    DiskRule rule;
    rule.sizing = points.sizing.get();
    const double scale = scale_for_count(*points.domain, rule, static_cast<double>(points.size()));
    return std::max(scale, measure_spacing(points, control).r_f);
  }
  const double radius = radius_for_count(*points.domain, static_cast<double>(points.size()));
  if (has_pair_nearer_than(points, radius, control)) return radius;
  return std::max(radius, measure_ratio(points, control).r_f);
}

double most_inserted(const Domain& domain, double spacing) {
  // Disks around points of half that size overlap nowhere, and reach over the boundary by as much. Curved
  // surfaces, and sizing functions, may have room for some more.
  if (!is_torus(domain)) {
    const double half = spacing / 2;
    const double reached = domain.area() + half * domain.boundary_length() + pi * half * half;
    return std::ceil(2 * 2 / std::sqrt(3.0) * reached / (spacing * spacing));
  }
  const Vec3 size = domain.box().size;
  const double shorter = std::min(size.x, size.y), longer = std::max(size.x, size.y);
  if (spacing <= shorter) return std::floor(2 / std::sqrt(3.0) * domain.area() / (spacing * spacing));
  // Points that follow each other along the longer side are at most half the shorter one apart across it.
  const double along = std::sqrt(spacing * spacing - shorter * shorter / 4);
  return std::max(1.0, std::floor(longer / along));
}

}  // namespace wellspaced
