#include "core/mesh/split_polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wellspaced {
namespace {

/// Grows with the smallest angle of a triangle, below zero if it turns away from `up`: the squared sine over
/// the two longest sides.
double quality(Vec3 a, Vec3 b, Vec3 c, Vec3 up) {
  const double ab = norm2(b - a), bc = norm2(c - b), ca = norm2(a - c);
  const double two_longest = ab * bc * ca / std::min({ab, bc, ca});
  const Vec3 area = cross(b - a, c - a);
  const double squared_sine = two_longest > 0 ? norm2(area) / two_longest : 0;
  return dot(area, up) > 0 ? squared_sine : squared_sine - 2;
}

Vec3 normal_of(std::span<const Vec3> corners) {
  Vec3 sum;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum = sum + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
  return sum;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> split_polygon(
    std::span<const Vec3> corners, const std::function<bool(std::uint32_t, std::uint32_t)>& joined) {
  std::vector<std::uint32_t> left(corners.size());
  std::iota(left.begin(), left.end(), 0u);
  const Vec3 up = normal_of(corners);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (left.size() > 3) {
    std::size_t best = 0;
    double most = -HUGE_VAL;
    const auto ear = [&](std::size_t k) {
      return std::array<std::uint32_t, 3>{left[k == 0 ? left.size() - 1 : k - 1], left[k],
                                          left[k + 1 == left.size() ? 0 : k + 1]};
    };
    for (std::size_t k = 0; k < left.size(); ++k) {
      const auto [a, b, c] = ear(k);
      const double q = quality(corners[a], corners[b], corners[c], up) - (joined(a, c) ? 8 : 0);
      if (q <= most) continue;
      most = q;
      best = k;
    }
    triangles.push_back(ear(best));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace wellspaced
