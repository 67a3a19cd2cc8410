#pragma once

#include <array>
#include <cstddef>

#include "core/vec.h"

namespace wellspaced {

/// Tells for a place the weights of a triangle's corners, which add up to 1, at its projection into the
/// triangle's plane; negative beyond the opposite edges.
///
/// Along the longest edge and across it, one after the other: areas would lose the place along a needle, a
/// triangle far longer than high, to rounding. The place that the weights give is right to about 1e-16 of the
/// longest edge, whatever the height. Without an area the weights are NaN. Vec: Vec2 or Vec3.
template <class Vec>
class Barycentric {
 public:
  explicit Barycentric(const std::array<Vec, 3>& corners) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec edge = corners[(k + 1) % 3] - corners[k];
      const double length2 = norm2(edge);
      if (k > 0 && !(length2 > norm2(edge_))) continue;
      edge_ = edge;
      base_ = k;
    }
    origin_ = corners[base_];
    per_length2_ = 1 / norm2(edge_);
    const Vec to_tip = corners[(base_ + 2) % 3] - origin_;
    tip_along_ = dot(to_tip, edge_) * per_length2_;
    const Vec height = to_tip - tip_along_ * edge_;
    across_ = (1 / norm2(height)) * height;
  }

  std::array<double, 3> operator()(Vec p) const {
    const Vec to_p = p - origin_;
    const double along = dot(to_p, edge_) * per_length2_, tip = dot(to_p - along * edge_, across_),
                 end = along - tip * tip_along_;
    std::array<double, 3> weights{};
    weights[base_] = 1 - tip - end;
    weights[base_ == 2 ? 0 : base_ + 1] = end;
    weights[base_ == 0 ? 2 : base_ - 1] = tip;
    return weights;
  }

 private:
  Vec origin_, edge_, across_;  ///< across: of length 1 / height
  double per_length2_ = 0, tip_along_ = 0;
  std::size_t base_ = 0;  ///< the corner that the longest edge begins in
};

}  // namespace wellspaced
