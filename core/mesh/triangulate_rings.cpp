#include "core/mesh/triangulate_rings.h"

#include <map>

#include "core/domain/cgal_triangulation.h"

namespace wellspaced {
namespace {

using Kernel = InexactKernel;
using Triangulation = ConstrainedTriangulation;

}  // namespace

std::vector<std::vector<std::uint32_t>> triangulate_rings(
    const std::vector<Vec3>& vertices, const std::vector<std::vector<std::uint32_t>>& rings) {
  Triangulation triangulation;
  std::map<std::uint32_t, Triangulation::Vertex_handle> handles;
  for (const auto& ring : rings)
    for (const std::uint32_t v : ring) {
      if (handles.count(v) != 0) continue;
      handles[v] = triangulation.insert(Kernel::Point_2(vertices[v].x, vertices[v].y));
      handles[v]->info() = v;
    }
  for (const auto& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k)
      triangulation.insert_constraint(handles[ring[k]], handles[ring[k + 1 == ring.size() ? 0 : k + 1]]);
  tell_inside(triangulation);
  std::vector<std::vector<std::uint32_t>> triangles;
  for (const auto face : triangulation.finite_face_handles())
    if (face->info() == is_inside)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

}  // namespace wellspaced
