#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <boost/multiprecision/cpp_int.hpp>

#include "tests/support/polygons.h"

namespace wellspaced::testing {

using Rational = boost::multiprecision::cpp_rational;

/// The part [begin, end] of a segment within low <= coordinate <= high.
inline bool clip(Rational a, Rational b, Rational low, Rational high, Rational& begin, Rational& end) {
  if (a == b) return low <= a && a <= high;
  Rational enter = (low - a) / (b - a), leave = (high - a) / (b - a);
  if (enter > leave) std::swap(enter, leave);
  begin = std::max(begin, enter);
  end = std::min(end, leave);
  return begin <= end;
}

/// Some real point of the segment is within a unit in the last place of p, by rational arithmetic.
inline bool exact_on_edge(Vec2 a, Vec2 b, Vec2 p) {
  const auto next = [](double x, int way) { return Rational(std::nextafter(x, way * HUGE_VAL)); };
  Rational begin = 0, end = 1;
  return clip(a.x, b.x, next(p.x, -1), next(p.x, 1), begin, end) &&
         clip(a.y, b.y, next(p.y, -1), next(p.y, 1), begin, end);
}

/// "corner", "edge", "inside" or "outside", by rational arithmetic and a ray.
inline std::string exact_place(const Rings& rings, Vec2 p) {
  bool inside = false, on_edge = false;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      if (a == p) return "corner";
      const double far = 1e-6 * (1 + std::abs(p.x) + std::abs(p.y));
      if (std::min(a.x, b.x) <= p.x + far && std::max(a.x, b.x) >= p.x - far &&
          std::min(a.y, b.y) <= p.y + far && std::max(a.y, b.y) >= p.y - far)
        on_edge = on_edge || exact_on_edge(a, b, p);
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if (std::max(a.x, b.x) < p.x) continue;
      const Rational x =
          Rational(a.x) + (Rational(p.y) - a.y) * (Rational(b.x) - a.x) / (Rational(b.y) - a.y);
      if (x > p.x) inside = !inside;
    }
  return on_edge ? "edge" : inside ? "inside" : "outside";
}

}  // namespace wellspaced::testing
