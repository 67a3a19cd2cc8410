#include "core/voronoi/far_places.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace wellspaced {
namespace {

std::vector<DomainTriangle> quarters(const Domain& domain, const std::vector<DomainTriangle>& whole) {
  std::vector<DomainTriangle> parts;
  parts.reserve(4 * whole.size());
  for (const auto& [a, b, c] : whole) {
    const Vec3 ab = domain.middle(a, b), bc = domain.middle(b, c), ca = domain.middle(c, a);
    for (const DomainTriangle& part : {DomainTriangle{a, ab, ca}, DomainTriangle{ab, b, bc},
                                       DomainTriangle{ca, bc, c}, DomainTriangle{ab, bc, ca}})
      parts.push_back(part);
  }
  return parts;
}

}  // namespace

FarPlaces::FarPlaces(const Domain& domain, std::size_t at_least) : domain_(domain) {
  std::vector<DomainTriangle> triangles = domain.triangles();
  while (triangles.size() < 2 * at_least) triangles = quarters(domain, triangles);
  for (const DomainTriangle& t : triangles) {
    places_.insert(places_.end(), t.begin(), t.end());
    gap_ = std::max({gap_, norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
  }
  const auto before = [](Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::sort(places_.begin(), places_.end(), before);
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
}

std::vector<std::size_t> FarPlaces::summits(std::span<const double> depths) const {
  constexpr std::size_t most = 24;
  std::vector<std::size_t> order(depths.size()), chosen;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return depths[a] != depths[b] ? depths[a] > depths[b] : a < b;
  });
  for (const std::size_t k : order) {
    const auto is_near = [&](std::size_t c) { return norm(places_[c] - places_[k]) < 1.5 * gap_; };
    if (std::none_of(chosen.begin(), chosen.end(), is_near)) chosen.push_back(k);
    if (chosen.size() == most) break;
  }
  return chosen;
}

}  // namespace wellspaced
