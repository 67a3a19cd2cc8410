#include "core/mesh/mesh.h"

#include <numeric>
#include <utility>

namespace wellspaced {
namespace {

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t v) {
  while (parents[v] != v) v = parents[v] = parents[parents[v]];
  return v;
}

/// The lower number wins, so that the outcome doesn't depend on the order.
void join(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b) {
  a = root_of(parents, a);
  b = root_of(parents, b);
  if (a < b) std::swap(a, b);
  parents[a] = b;
}

/// Renumbers vertices so that those are left which faces use, in their order.
void drop_unused(Mesh& mesh) {
  std::vector<std::uint32_t> numbers(mesh.vertices.size(), Mesh::no_point);
  for (const std::uint32_t v : mesh.corners) numbers[v] = 0;
  std::uint32_t used = 0;
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    if (numbers[v] == Mesh::no_point) continue;
    mesh.vertices[used] = mesh.vertices[v];
    numbers[v] = used++;
  }
  mesh.vertices.resize(used);
  for (std::uint32_t& v : mesh.corners) v = numbers[v];
}

}  // namespace

Vec3 area_vector(const Mesh& mesh, std::size_t face) {
  const std::span<const std::uint32_t> corners = mesh[face];
  const Vec3 base = mesh.vertices[corners[0]];
  Vec3 sum;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum = sum + cross(mesh.vertices[corners[k]] - base, mesh.vertices[corners[k + 1]] - base);
  return 0.5 * sum;
}

void collapse_short_edges(Mesh& mesh, double length) {
  std::vector<std::uint32_t> parents(mesh.vertices.size());
  std::iota(parents.begin(), parents.end(), 0u);
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const std::span<const std::uint32_t> face = mesh[f];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t a = face[k], b = face[k + 1 == face.size() ? 0 : k + 1];
      if (norm(mesh.vertices[a] - mesh.vertices[b]) <= length) join(parents, a, b);
    }
  }
  Mesh kept;
  kept.vertices = std::move(mesh.vertices);
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const std::size_t first = kept.corners.size();
    for (const std::uint32_t corner : mesh[f]) {
      const std::uint32_t v = root_of(parents, corner);
      if (kept.corners.size() == first || kept.corners.back() != v) kept.corners.push_back(v);
    }
    while (kept.corners.size() > first + 1 && kept.corners.back() == kept.corners[first])
      kept.corners.pop_back();
    if (kept.corners.size() < first + 3) {
      kept.corners.resize(first);
      continue;
    }
    kept.close();
    kept.face_points.push_back(mesh.face_points[f]);
  }
  mesh = std::move(kept);
  drop_unused(mesh);
}

}  // namespace wellspaced
