#pragma once

#include <cmath>

#include "core/vec.h"

namespace wellspaced {

/// `orientation` where rounding could change the sign; by CGAL.
int orientation_by_cgal(Vec2 a, Vec2 b, Vec2 c);

/// The side of the line from a to b that c is on: 1 left, -1 right, 0 on it. Exact, and 0 if a == b.
///
/// Reference: Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates",
/// 1997, for the bound that tells when plain arithmetic will do.
inline int orientation(Vec2 a, Vec2 b, Vec2 c) {
  constexpr double relative = 3.3306690738754716e-16, least = 1e-280;  // below which products lose digits
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right, size = std::abs(left) + std::abs(right);
  if (size > least && std::abs(determinant) > relative * size) return determinant > 0 ? 1 : -1;
  return orientation_by_cgal(a, b, c);
}

/// By x, then by y.
inline bool lexicographically_less(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// All real points within one unit in the last place of p along each axis.
struct UlpBox {
  explicit UlpBox(Vec2 p)
      : low{std::nextafter(p.x, -HUGE_VAL), std::nextafter(p.y, -HUGE_VAL)},
        high{std::nextafter(p.x, HUGE_VAL), std::nextafter(p.y, HUGE_VAL)} {}

  /// Some real point of the segment from a to b is in it. Exact.
  bool meets(Vec2 a, Vec2 b) const {
    if ((a.x < low.x && b.x < low.x) || (a.x > high.x && b.x > high.x)) return false;
    if ((a.y < low.y && b.y < low.y) || (a.y > high.y && b.y > high.y)) return false;
    const bool rising = (b.x > a.x) == (b.y > a.y);  // the two corners farthest from each other across it
    const Vec2 p = rising ? Vec2{low.x, high.y} : low, q = rising ? Vec2{high.x, low.y} : high;
    return orientation(a, b, p) * orientation(a, b, q) <= 0;
  }

  Vec2 low, high;
};

}  // namespace wellspaced
