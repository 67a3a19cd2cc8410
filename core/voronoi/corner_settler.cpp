#include "core/voronoi/corner_settler.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/voronoi/cell.h"

namespace wellspaced {

CornerSettler::Corner CornerSettler::settle(Vec3 place, double claimed, bool on_boundary) {
  constexpr int most_steps = 4;
  constexpr double near = 1e-9, longest = 0.25;  // of what is claimed
  Corner best{place, look(place, claimed)};
  for (int steps = 0; steps < most_steps && !on_boundary && neighbors_.size() >= 3; ++steps) {
    const Vec2 way = way_to_corner();
    const double length = norm(way);
    if (!(length > near * claimed) || !std::isfinite(length)) break;
    place = points_->domain->place_at(place, std::min(1.0, longest * claimed / length) * way);
    const double distance = look(place, claimed);
    if (distance > best.distance) best = {place, distance};
  }
  return best;
}

/// The three nearest come first then. Distance of the nearest one.
double CornerSettler::look(Vec3 place, double claimed) {
  constexpr std::uint32_t nobody = ~0u;
  for (const double looks : {1.1, 1.8, 2.7, 4.0}) {
    const double reach = looks * claimed;
    neighbors_.clear();
    grid_->gather(place, nobody, reach, neighbors_);
    points_->domain->localize(place, reach, neighbors_);
    if (neighbors_.size() >= 3) break;
  }
  const auto nearer = [](const Neighbor& a, const Neighbor& b) {
    const double a2 = norm2(a.offset), b2 = norm2(b.offset);
    return a2 != b2 ? a2 < b2 : a.id < b.id;
  };
  const std::size_t three = std::min<std::size_t>(3, neighbors_.size());
  std::partial_sort(neighbors_.begin(), neighbors_.begin() + static_cast<std::ptrdiff_t>(three),
                    neighbors_.end(), nearer);
  return neighbors_.empty() ? claimed : norm(points_->domain->way_to(place, neighbors_.front()));
}

/// To the place that is as far from all three as from each other, as the chart here has it.
Vec2 CornerSettler::way_to_corner() const {
  const auto way = [&](std::size_t k) { return Vec2{neighbors_[k].offset.x, neighbors_[k].offset.y}; };
  const Vec2 a = way(1) - way(0), b = way(2) - way(0);
  return way(0) + (cross(a, b) > 0 ? circumcenter(a, b) : circumcenter(b, a));
}

}  // namespace wellspaced
