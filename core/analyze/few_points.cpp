#include "core/analyze/few_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/voronoi/corner_settler.h"
#include "core/voronoi/far_places.h"

namespace wellspaced {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t few = 64, places_wanted = 512;
constexpr double most_work = 2e5;  ///< points times triangles

bool are_few(const PointSet& points) {
  if (points.domain->has_exact_cells() || points.size() > few) return false;
  return static_cast<double>(points.size() * points.domain->triangles().size()) <= most_work;
}

}  // namespace

void see_far_places(const PointSet& points, const Control& control, std::vector<PointLook>& looks) {
  if (!are_few(points)) return;
  const Domain& domain = *points.domain;
  FarPlaces far(domain, places_wanted);
  std::vector<double> depths(far.places().size(), infinity);
  for (std::size_t i = 0; i < points.size(); ++i) {
    control.check();
    far.see_from(points[i], infinity, [&](std::size_t k, double d) { depths[k] = std::min(depths[k], d); });
  }
  const NeighborGrid grid(points, hexagonal_spacing(domain, points.size()));
  CornerSettler settler(points, grid);
  std::vector<Neighbor> all(points.size());
  std::vector<double> ways;
  for (const std::size_t k : far.summits(depths)) {
    control.check();
    const Vec3 place = far.places()[k];
    const bool on_boundary = domain.freedom(place).dimensions < 2;
    const Vec3 corner = settler.settle(place, depths[k], on_boundary).at;
    for (std::uint32_t i = 0; i < points.size(); ++i) all[i] = {points[i] - corner, i};
    domain.distances(corner, infinity, all, ways);
    const double depth = *std::min_element(ways.begin(), ways.end());
    for (std::size_t i = 0; i < points.size(); ++i)
      if (ways[i] <= depth * (1 + 1e-9)) looks[i].outradius = std::max(looks[i].outradius, depth);
  }
}

}  // namespace wellspaced
