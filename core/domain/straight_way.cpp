#include "core/domain/straight_way.h"

#include <algorithm>

namespace wellspaced {
namespace {

constexpr double nudge = 1e-9;  ///< how far, as weights, the way starts from edges
constexpr int most_faces = 1000000;

/// `corners` from the origin of h on.
MeshPlace place_in(const Unfolding& unfolding, std::uint32_t h, const std::array<Vec2, 3>& corners, Vec2 p) {
  const auto w = unfolding.weights(corners, p);
  MeshPlace place{TriangleMesh::face_of(h), {}};
  for (std::size_t k = 0; k < 3; ++k) place.weights[(h + k) % 3] = w[k];
  return place;
}

}  // namespace

StraightWay go_straight(const Unfolding& unfolding, const MeshPlace& base, Vec2 u) {
  const TriangleMesh& mesh = unfolding.mesh();
  std::array<Vec2, 3> corners = unfolding.corners_around(base);
  // From just inside the face, so that it is left through the edge that u points to.
  Vec2 start;
  if (*std::min_element(base.weights.begin(), base.weights.end()) < nudge)
    start = nudge * (corners[0] + corners[1] + corners[2]);
  const Vec2 way = u - start;
  std::uint32_t h = 3 * base.face;
  std::size_t out = 0;
  while (out < 2 &&
         !(cross(way, corners[out] - start) <= 0 && cross(way, corners[(out + 1) % 3] - start) > 0))
    ++out;
  for (int count = 0; count < most_faces; ++count) {
    // `corners` belong to the face of h, from the origin of h on; the way leaves it through number `out`.
    for (std::size_t k = 0; k < out; ++k) h = TriangleMesh::next(h);
    const Vec2 right = corners[out], left = corners[(out + 1) % 3], edge = left - right;
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(out), corners.end());
    const double beyond = cross(u - right, edge);
    const std::uint32_t over = mesh.twin(h);
    if (beyond <= 0 || over == TriangleMesh::none) {
      const double part =
          beyond <= 0 ? 1 : std::clamp(cross(right - start, edge) / cross(way, edge), 0.0, 1.0);
      const Vec2 end = beyond <= 0 ? u : start + part * way;
      return {place_in(unfolding, h, corners, end), part};
    }
    h = over;
    corners = {left, right, unfolding.tip(h, left, right)};
    out = cross(way, corners[2] - start) > 0 ? 1 : 2;
  }
  return {place_in(unfolding, h, corners, (1.0 / 3) * (corners[0] + corners[1] + corners[2])), 1};
}

}  // namespace wellspaced
