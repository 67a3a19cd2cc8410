#include "core/analyze/point_look.h"

#include <algorithm>
#include <span>

namespace wellspaced {
namespace {

/// Cotangents of the angles of the triangle (0, a, b), from the lengths of its sides.
void see_angles(Vec2 a, Vec2 b, PointLook& local) {
  const double twice = cross(a, b);
  const Vec2 e = b - a;
  for (const double product : {dot(a, b), -dot(a, e), dot(b, e)}) {
    local.cotangent_max = std::max(local.cotangent_max, product / twice);
    local.cotangent_min = std::min(local.cotangent_min, product / twice);
  }
}

}  // namespace

PointLook look_at_point(const MovingSet& set, std::size_t i, CellFinder& cells, DomainStar& star) {
  star.load(set, i, cells);
  PointLook local;
  const double unit = set.unit(i);
  local.outradius = cells.outradius();
  local.area = cells.area() / (unit * unit);
  for (const Neighbor& neighbor : cells.neighbors()) {
    if (neighbor.id == i) continue;
    const double distance = norm(set.domain().way_to(set[i], neighbor));
    const double in_units = distance / std::min(unit, set.unit(neighbor.id));
    local.nearest = std::min(local.nearest, distance);
    local.r_f = std::min(local.r_f, in_units);
    if (!set.both_fixed(i, neighbor.id)) local.r_f_free = std::min(local.r_f_free, in_units);
  }
  const std::span<const DomainStar::Spoke> spokes = star.spokes();
  local.valence = static_cast<int>(spokes.size());
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    local.edge_max = std::max(local.edge_max, norm(spokes[k].way) / unit);
    if (!spokes[k].closes) continue;
    const Vec2 way = spokes[k].way, next = spokes[k + 1 == spokes.size() ? 0 : k + 1].way;
    see_angles(way, next, local);
    local.own_cotangent_max = std::max(local.own_cotangent_max, dot(way, next) / cross(way, next));
  }
  return local;
}

}  // namespace wellspaced
