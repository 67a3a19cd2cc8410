#include "core/domain/face_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wellspaced {
namespace {

constexpr std::size_t leaf_size = 3;
constexpr std::size_t most_levels = 64;

double outside(double x, double low, double high) { return x < low ? low - x : x > high ? x - high : 0; }

Vec3 lower(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 upper(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

}  // namespace

// Of a place outside the nearest one is on an edge that it lies beyond; of any place, where there is no area.
std::array<double, 3> FaceTree::Triangle::nearest_weights(Vec3 p) const {
  const std::array<double, 3> inside = weights(p);
  const std::array<Vec3, 3> corners = {a, b, c};
  constexpr double nearly_all = 1 - 1e-9;
  for (std::size_t k = 0; k < 3; ++k)
    if (inside[k] > nearly_all && corners[k] == p)
      return {k == 0 ? 1.0 : 0, k == 1 ? 1.0 : 0, k == 2 ? 1.0 : 0};
  if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0) return inside;
  std::array<double, 3> best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    if (inside[k] >= 0) continue;
    const std::size_t from = (k + 1) % 3, to = (k + 2) % 3;
    const Vec3 edge = corners[to] - corners[from];
    const double t = std::clamp(dot(p - corners[from], edge) / norm2(edge), 0.0, 1.0);
    const double away2 = norm2((1 - t) * (corners[from] - p) + t * (corners[to] - p));
    if (!(away2 < least)) continue;
    least = away2;
    best[k] = 0;
    best[from] = 1 - t;
    best[to] = t;
  }
  return best;
}

std::array<double, 3> FaceTree::nearest_in(std::uint32_t face, Vec3 p) const {
  return triangles_[at_[face]].nearest_weights(p);
}

FaceTree::FaceTree(std::span<const std::array<Vec3, 3>> triangles) {
  triangles_.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const Vec3 normal = cross(b - a, c - a);
    const double length = norm(normal);
    triangles_.push_back({a, b, c, length > 0 ? (1 / length) * normal : Vec3{},
                          static_cast<std::uint32_t>(triangles_.size()), Barycentric<Vec3>({a, b, c})});
  }
  nodes_.emplace_back();
  build(0, 0, triangles_.size());
  at_.resize(triangles_.size());
  for (std::uint32_t k = 0; k < triangles_.size(); ++k) at_[triangles_[k].face] = k;
}

FaceTree::Bounds FaceTree::bounds_of(const Triangle& t) {
  return {lower(t.a, lower(t.b, t.c)), upper(t.a, upper(t.b, t.c))};
}

FaceTree::Bounds FaceTree::bounds_of(std::size_t begin, std::size_t end) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Bounds all{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (std::size_t k = begin; k < end; ++k) {
    const Bounds one = bounds_of(triangles_[k]);
    all = {lower(all.low, one.low), upper(all.high, one.high)};
  }
  return all;
}

void FaceTree::build(std::size_t node, std::size_t begin, std::size_t end) {
  const Bounds all = bounds_of(begin, end);
  const Vec3 size = all.high - all.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto at = [&](std::size_t k) { return triangles_.begin() + static_cast<std::ptrdiff_t>(k); };
  const std::size_t middle = begin + (end - begin + 1) / 2;
  std::nth_element(at(begin), at(middle), at(end), [axis](const Triangle& s, const Triangle& t) {
    const double x = along(s.a + s.b + s.c, axis), y = along(t.a + t.b + t.c, axis);
    return x != y ? x < y : s.face < t.face;
  });
  const std::size_t ends[3] = {begin, middle, end};
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t from = ends[side], to = ends[side + 1];
    nodes_[node].boxes[side] = bounds_of(from, to);
    if (to - from <= leaf_size) {
      nodes_[node].first[side] = static_cast<std::uint32_t>(from);
      nodes_[node].count[side] = static_cast<std::uint32_t>(to - from);
      continue;
    }
    nodes_[node].first[side] = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    build(nodes_.size() - 1, from, to);
  }
}

double FaceTree::distance2(const Bounds& box, Vec3 p) {
  const double x = outside(p.x, box.low.x, box.high.x), y = outside(p.y, box.low.y, box.high.y),
               z = outside(p.z, box.low.z, box.high.z);
  return x * x + y * y + z * z;
}

void FaceTree::improve(std::uint32_t first, std::uint32_t count, Vec3 p, Nearest& best) const {
  for (std::uint32_t k = first; k < first + count; ++k) {
    const Triangle& t = triangles_[k];
    const auto w = t.nearest_weights(p);
    // From differences: a point on the mesh is then at no distance, wherever the origin is.
    const double d2 = norm2(w[0] * (t.a - p) + w[1] * (t.b - p) + w[2] * (t.c - p));
    if (d2 < best.distance2) best = {t.face, w, d2};
  }
}

std::optional<FaceTree::Nearest> FaceTree::find(Vec3 p, double distance) const {
  std::uint32_t open[most_levels];
  std::size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[open[--count]];
    for (std::size_t side = 0; side < 2; ++side) {
      if (!node.boxes[side].holds(p, distance)) continue;
      if (node.count[side] == 0) open[count++] = node.first[side];
      for (std::uint32_t k = node.first[side]; k < node.first[side] + node.count[side]; ++k) {
        // Most faces near p are not in its plane.
        if (std::fabs(dot(triangles_[k].normal, p - triangles_[k].a)) > distance) continue;
        Nearest found;
        found.distance2 = std::numeric_limits<double>::infinity();
        improve(k, 1, p, found);
        if (found.distance2 <= distance * distance) return found;
      }
    }
  }
  return {};
}

FaceTree::Nearest FaceTree::nearest(Vec3 p) const {
  Nearest best;
  best.distance2 = std::numeric_limits<double>::infinity();
  struct Open {
    std::uint32_t node;
    double distance2;
  };
  Open open[most_levels];
  std::size_t count = 0;
  open[count++] = {0, 0};
  while (count > 0) {
    const Open at = open[--count];
    if (at.distance2 >= best.distance2) continue;
    const Node& node = nodes_[at.node];
    const double d2[2] = {distance2(node.boxes[0], p), distance2(node.boxes[1], p)};
    const std::size_t near = d2[0] <= d2[1] ? 0 : 1;
    for (const std::size_t side : {near, 1 - near})
      if (node.count[side] > 0 && d2[side] < best.distance2)
        improve(node.first[side], node.count[side], p, best);
    for (const std::size_t side : {1 - near, near})
      if (node.count[side] == 0 && d2[side] < best.distance2) open[count++] = {node.first[side], d2[side]};
  }
  return best;
}

bool FaceTree::meets(const Bounds& box, Vec3 from, Vec3 direction, double most) {
  double begin = 0, end = most;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = along(box.low, axis) - along(from, axis),
                 high = along(box.high, axis) - along(from, axis);
    const double d = along(direction, axis);
    if (d == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    begin = std::max(begin, std::min(low / d, high / d));
    end = std::min(end, std::max(low / d, high / d));
  }
  return begin <= end;
}

std::optional<FaceTree::Hit> FaceTree::hit(Vec3 from, Vec3 direction, double least, double most) const {
  std::optional<Hit> first;
  std::uint32_t open[most_levels];
  std::size_t count = 0;
  open[count++] = 0;
  const auto try_triangle = [&](const Triangle& t) {
    // Moeller and Trumbore 1997.
    const Vec3 ab = t.b - t.a, ac = t.c - t.a, across = cross(direction, ac);
    const double det = dot(ab, across);
    if (det == 0) return;
    const Vec3 to = from - t.a, up = cross(to, ab);
    const double v = dot(to, across) / det, w = dot(direction, up) / det, distance = dot(ac, up) / det;
    if (v < 0 || w < 0 || v + w > 1 || distance < least || distance > most) return;
    first = {t.face, distance};
    most = distance;
  };
  while (count > 0) {
    const Node& node = nodes_[open[--count]];
    for (std::size_t side = 0; side < 2; ++side) {
      if (!meets(node.boxes[side], from, direction, most)) continue;
      if (node.count[side] == 0) open[count++] = node.first[side];
      for (std::uint32_t k = node.first[side]; k < node.first[side] + node.count[side]; ++k)
        try_triangle(triangles_[k]);
    }
  }
  return first;
}

}  // namespace wellspaced
