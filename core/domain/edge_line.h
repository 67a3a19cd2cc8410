#pragma once

#include <cmath>

#include "core/domain/polygon_rings.h"

namespace wellspaced {

/// The edge's axis along which it is longer: points on it are told by this coordinate.
inline double Vec2::*long_axis(const PolygonEdge& e) {
  return std::abs(e.to.x - e.from.x) >= std::abs(e.to.y - e.from.y) ? &Vec2::x : &Vec2::y;
}

/// The point of the edge with that coordinate along its long axis, brought strictly between the ends, and the
/// other one rounded: less than a unit in the last place away from the edge. Exact.
/// `from` if no double is between the ends.
Vec2 point_on_edge(const PolygonEdge& e, double coordinate);

}  // namespace wellspaced
