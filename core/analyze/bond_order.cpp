#include "core/analyze/bond_order.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "core/analyze/point_look.h"
#include "core/large_vector.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

Vec2 complex_product(Vec2 a, Vec2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }

/// exp(6 i theta) of a direction that is not 0.
Vec2 sixfold(Vec2 direction) {
  const Vec2 twice = (1 / norm2(direction)) * complex_product(direction, direction);
  return complex_product(twice, complex_product(twice, twice));
}

struct StarOrder {
  Vec2 psi6;
  double edges;      ///< absolute value of the sum over its edges
  double triangles;  ///< how many of these
};

StarOrder order_of(std::span<const Spoke> spokes) {
  Vec2 to_neighbors, between;
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    const Vec2 here = spokes[k].offset, next = spokes[k + 1 == spokes.size() ? 0 : k + 1].offset;
    to_neighbors = to_neighbors + sixfold(here);
    between = between + sixfold(next - here);
  }
  const auto valence = static_cast<double>(spokes.size());
  return {(1 / valence) * to_neighbors, norm(between), valence};
}

/// The same of a star that need not go all around.
StarOrder order_of(std::span<const DomainStar::Spoke> spokes) {
  Vec2 to_neighbors, between;
  double triangles = 0;
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    const Vec2 here = spokes[k].way, next = spokes[k + 1 == spokes.size() ? 0 : k + 1].way;
    to_neighbors = to_neighbors + sixfold(here);
    if (!spokes[k].closes) continue;
    between = between + sixfold(next - here);
    ++triangles;
  }
  const double valence = std::max(1.0, static_cast<double>(spokes.size()));
  return {(1 / valence) * to_neighbors, norm(between), triangles};
}

}  // namespace

BondOrder bond_order(const PointSet& points, const Control& control) {
  constexpr std::size_t between_checks = 1 << 16;
  require_usable(points, control);
  LargeVector<StarOrder> stars(points.size());
  if (is_plain_torus(points)) {
    visit_stars(points, control,
                [&](std::size_t i, std::span<const Spoke> spokes) { stars[i] = order_of(spokes); });
  } else {
    const MovingSet set(points, control);
    for_each_look(set, control, [&](std::size_t i, const PointLook&, const DomainStar& star) {
      stars[i] = order_of(star.spokes());
    });
  }
  const auto n = static_cast<double>(points.size());
  BondOrder result;
  result.psi6.reserve(points.size());
  Vec2 sum;
  double terms = 0;
  for (const StarOrder& star : stars) {  // in the points' order: the sums must not depend on threads
    if (result.psi6.size() % between_checks == 0) control.check();
    result.psi6.push_back(norm(star.psi6));
    sum = sum + star.psi6;
    result.psi6_local += result.psi6.back();
    result.psi6_edges += star.edges;
    terms += star.triangles;
  }
  result.psi6_global = points.domain->is_flat() ? norm(sum) / n : std::numeric_limits<double>::quiet_NaN();
  result.psi6_local /= n;
  result.psi6_edges /= terms;
  return result;
}

}  // namespace wellspaced
