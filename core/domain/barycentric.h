#pragma once

#include <array>
#include <cstddef>

#include "core/vec.h"

namespace wellspaced {

/// Weights of a triangle's corners, which add up to 1, at the projection of p into its plane; negative beyond
/// the opposite edges.
///
/// Along the longest edge and across it, one after the other: areas would lose the place along a needle, a
/// triangle far longer than high, to rounding. The place that the weights give is right to about 1e-16 of the
/// longest edge, whatever the height. Requires: the triangle has an area. Vec: Vec2 or Vec3.
template <class Vec>
std::array<double, 3> barycentric_weights(const std::array<Vec, 3>& corners, Vec p) {
  std::size_t base = 0;  // the edge from this corner to the next one
  double longest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length2 = norm2(corners[(k + 1) % 3] - corners[k]);
    if (length2 > longest) longest = length2, base = k;
  }
  const std::size_t end = (base + 1) % 3, tip = (base + 2) % 3;
  const Vec edge = corners[end] - corners[base], to_tip = corners[tip] - corners[base],
            to_p = p - corners[base];
  const double tip_along = dot(to_tip, edge) / longest, p_along = dot(to_p, edge) / longest;
  const Vec height = to_tip - tip_along * edge;
  std::array<double, 3> weights{};
  weights[tip] = dot(to_p - p_along * edge, height) / norm2(height);
  weights[end] = p_along - weights[tip] * tip_along;
  weights[base] = 1 - weights[tip] - weights[end];
  return weights;
}

}  // namespace wellspaced
