#include "core/mesh/border_sides.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/mesh/border_chains.h"

namespace wellspaced {

BorderSides::BorderSides(const PointSet& points) : points_(&points) {
  for (const BorderChain& chain : border_chains(points)) {
    const std::size_t count = chain.links.size();
    for (std::size_t k = 0; k + (chain.closed ? 0 : 1) < count; ++k) {
      const BorderChain::Link &a = chain.links[k], &b = chain.links[(k + 1) % count];
      if (a.point == BorderChain::none || b.point == BorderChain::none) continue;
      const double end = k + 1 == count ? b.along + chain.length : b.along;
      sides_[{a.point, b.point}] = {points[a.point], points[b.point], false, chain.curve, a.along, end,
                                    chain.length};
    }
  }
}

BorderSides::Side BorderSides::between(std::uint32_t p, std::uint32_t q) const {
  const auto found = sides_.find({p, q});
  if (found != sides_.end()) return found->second;
  Side side;
  side.from = (*points_)[p];
  side.to = (*points_)[q];
  return side;
}

Vec3 BorderSides::place(const Side& side, double part) const {
  if (side.is_straight) return side.from + part * (side.to - side.from);
  double along = side.begin + part * (side.end - side.begin);
  if (along > side.length) along -= side.length;
  return points_->domain->boundary_point(side.curve, along);
}

/// The squares' difference is linear along a straight line, so that the rule of false position is at the end
/// at once there.
double BorderSides::meeting(const Side& side, std::uint32_t a, std::uint32_t b) const {
  constexpr int most_steps = 40;
  constexpr double near = 1e-15;
  const std::array<std::uint32_t, 2> both = {a, b};
  const auto surplus = [&](double part) {
    const std::vector<double> d = distances_from(place(side, part), *points_, both);
    return (d[0] - d[1]) * (d[0] + d[1]);
  };
  double low = 0, high = 1, at_low = surplus(low), at_high = surplus(high), part = 0.5;
  if (!(at_low > 0 && at_high < 0)) return at_low <= 0 ? low : high;
  for (int step = 0; step < most_steps && high - low > near; ++step) {
    part = low + (high - low) * (at_low / (at_low - at_high));
    const double here = surplus(part);
    if (here == 0) return part;
    const bool is_low = here > 0;
    const double before = is_low ? at_low : at_high;
    // Where the same end stays in place, the other one counts half: the Illinois variant.
    (is_low ? low : high) = part;
    (is_low ? at_low : at_high) = here;
    (is_low ? at_high : at_low) *= 0.5;
    if (std::fabs(here) < near * std::fabs(before)) break;
  }
  return part;
}

std::vector<double> distances_from(Vec3 place, const PointSet& points, std::span<const std::uint32_t> ids) {
  std::vector<Neighbor> neighbors;
  double reach = 0;
  for (const std::uint32_t i : ids) {
    neighbors.push_back({points[i] - place, i});
    reach = std::max(reach, 1.5 * norm(neighbors.back().offset));
  }
  const double farthest = 1e3 * norm(points.domain->box().size);
  std::vector<double> distances;
  for (;; reach *= 2) {
    points.domain->distances(place, reach, neighbors, distances);
    const bool all =
        std::all_of(distances.begin(), distances.end(), [](double d) { return std::isfinite(d); });
    if (all || reach > farthest) return distances;
  }
}

}  // namespace wellspaced
