#include "core/domain/straight_way.h"

#include <algorithm>

#include "core/domain/barycentric.h"

namespace wellspaced {
namespace {

constexpr double nudge = 1e-9;  ///< how far, as weights, the way starts from edges
constexpr int most_faces = 1000000;
constexpr int most_tries = 4;
constexpr double steepest = 0.1;  ///< part of a straight line that lies along the first face
constexpr double longest = 3;     ///< times the straight line
constexpr double hit = 1e-12;     ///< of the straight line: how near is hit

/// A way that ends at p in the face of h; `corners` of that face from the origin of h on.
StraightWay end_at(const Unfolding& unfolding, std::uint32_t h, const std::array<Vec2, 3>& corners, Vec2 p) {
  const auto w = unfolding.weights(corners, p);
  StraightWay way;
  way.end.face = TriangleMesh::face_of(h);
  for (std::size_t k = 0; k < 3; ++k) {
    way.end.weights[(h + k) % 3] = w[k];
    way.corners[(h + k) % 3] = corners[k];
  }
  return way;
}

/// Where p, projected into the plane of a face, lies in a layout of that.
Vec2 unfold(const TriangleMesh& mesh, std::uint32_t face, const std::array<Vec2, 3>& corners, Vec3 p) {
  const auto w = Barycentric<Vec3>({mesh.corner(face, 0), mesh.corner(face, 1), mesh.corner(face, 2)})(p);
  return corners[0] + w[1] * (corners[1] - corners[0]) + w[2] * (corners[2] - corners[0]);
}

/// What came of trying to hit q.
struct Tries {
  std::optional<Vec2> vector;
  MeshPlace nearest;  ///< where a try ended that came nearest
  double length = 0;  ///< of that
};

Tries try_straight(const Unfolding& unfolding, const MeshPlace& from, Vec3 q) {
  const Vec3 way_there = q - unfolding.position(from);
  const Frame frame = unfolding.frame(from.face);
  Vec2 u{dot(way_there, frame.x), dot(way_there, frame.y)};
  const double chord = norm(way_there), flat = norm(u);
  Tries tries{{}, from, 0};
  double nearest = chord;
  if (!(flat > steepest * chord)) return tries;
  u = (chord / flat) * u;
  for (int count = 0; count < most_tries && norm(u) < longest * chord; ++count) {
    const StraightWay way = go_straight(unfolding, from, u);
    const double away = norm(unfolding.position(way.end) - q);
    if (way.part == 1 && away <= hit * chord) {
      tries.vector = u;
      return tries;
    }
    if (away < nearest) tries = {{}, way.end, way.part * norm(u)};
    nearest = std::min(nearest, away);
    u = unfold(unfolding.mesh(), way.end.face, way.corners, q);
  }
  return tries;
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
      StraightWay made = end_at(unfolding, h, corners, end);
      made.part = part;
      return made;
    }
    h = over;
    corners = {left, right, unfolding.tip(h, left, right)};
    out = cross(way, corners[2] - start) > 0 ? 1 : 2;
  }
  return end_at(unfolding, h, corners, (1.0 / 3) * (corners[0] + corners[1] + corners[2]));
}

std::optional<AimedWay> aim(const Unfolding& unfolding, const MeshPlace& from, const MeshPlace& to) {
  const Vec3 q = unfolding.position(to);
  const Tries first = try_straight(unfolding, from, q);
  if (first.vector) return AimedWay{norm(*first.vector), first.vector};
  const Tries second = try_straight(unfolding, first.nearest, q);
  if (!second.vector) return {};
  return AimedWay{first.length + norm(*second.vector), {}};
}

}  // namespace wellspaced
