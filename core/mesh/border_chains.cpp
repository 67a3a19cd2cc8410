#include "core/mesh/border_chains.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace wellspaced {
namespace {

using Coordinates = std::array<double, 3>;

Coordinates coordinates(Vec3 p) { return {p.x, p.y, p.z}; }

}  // namespace

std::vector<BorderChain> border_chains(const PointSet& points) {
  const Domain& domain = *points.domain;
  std::vector<BorderChain> chains;
  for (const BoundaryCurve& curve : domain.boundary())
    chains.push_back({chains.size(), curve.length, curve.closed, {}});
  if (chains.empty()) return chains;
  std::map<Coordinates, std::uint32_t> in_corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Freedom freedom = domain.freedom(points[i]);
    if (freedom.dimensions == 2) continue;
    const auto number = static_cast<std::uint32_t>(i);
    if (freedom.dimensions == 0) in_corners[coordinates(points[i])] = number;
    if (freedom.dimensions == 0) continue;
    const std::optional<BoundarySpot> spot = domain.boundary_spot(points[i]);
    if (spot) chains[spot->curve].links.push_back({spot->along, number});
  }
  for (BorderChain& chain : chains) {
    const auto before = [](const BorderChain::Link& a, const BorderChain::Link& b) {
      return a.along != b.along ? a.along < b.along : a.point < b.point;
    };
    if (!chain.closed)
      for (const double along : {0.0, chain.length}) {
        const auto found = in_corners.find(coordinates(domain.boundary_point(chain.curve, along)));
        chain.links.push_back({along, found == in_corners.end() ? BorderChain::none : found->second});
      }
    std::sort(chain.links.begin(), chain.links.end(), before);
  }
  return chains;
}

}  // namespace wellspaced
