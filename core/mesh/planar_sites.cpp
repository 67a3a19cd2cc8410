#include "core/mesh/planar_sites.h"

#include <cmath>

namespace wellspaced {
namespace {

/// To a multiple of the last place of 12 periods.
double rounded(double x, double period) {
  const double large = std::ldexp(1.5, std::ilogb(period) + 3);
  return (x + large) - large;
}

}  // namespace

PlanarSites::PlanarSites(const PointSet& points) {
  const Box box = points.domain->box();
  if (box.periodic[0] || box.periodic[1]) {
    axis = box.periodic[0] ? 0 : 1;
    const double side = axis == 0 ? box.size.x : box.size.y;
    period = rounded(side, side);
  }
  places = static_cast<std::uint32_t>(points.size());
  for (const int copy : {0, -1, 1}) {
    for (std::uint32_t i = 0; i < places; ++i) add({points[i].x, points[i].y}, i, copy);
    if (period == 0) return;
  }
}

void PlanarSites::add(Vec2 place, std::uint32_t of, int copy) {
  if (period != 0) {
    double& along = axis == 0 ? place.x : place.y;
    along = rounded(along, period) + copy * period;
  }
  at.push_back(place);
  number.push_back(of);
  turn.push_back(copy);
}

void PlanarSites::add_place(Vec2 place) {
  for (const int copy : {0, -1, 1})
    if (copy == 0 || period != 0) add(place, places, copy);
  ++places;
}

}  // namespace wellspaced
