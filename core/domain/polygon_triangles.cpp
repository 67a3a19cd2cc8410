// Exact predicates and constrained triangulations, by CGAL.
#include "core/domain/polygon_triangles.h"

#include <utility>
#include <vector>

#include "core/domain/cgal_triangulation.h"
#include "core/domain/exact.h"

namespace wellspaced {
namespace {

using Kernel = InexactKernel;
using Triangulation = ConstrainedTriangulation;

}  // namespace

int orientation_by_cgal(Vec2 a, Vec2 b, Vec2 c) {
  return static_cast<int>(
      CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y), Kernel::Point_2(c.x, c.y)));
}

std::vector<std::array<std::uint32_t, 3>> triangulate(const PolygonRings& rings) {
  const auto count = static_cast<std::uint32_t>(rings.edges().size());
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> corners;
  for (std::uint32_t e = 0; e < count; ++e)
    corners.push_back({Kernel::Point_2(rings.edges()[e].from.x, rings.edges()[e].from.y), e});
  Triangulation triangulation;
  triangulation.insert(corners.begin(), corners.end());
  std::vector<Triangulation::Vertex_handle> vertices(count);
  for (const auto v : triangulation.finite_vertex_handles()) vertices[v->info()] = v;
  for (std::size_t k = 0; k < rings.rings(); ++k)
    for (std::uint32_t e = rings.first(k); e < rings.first(k + 1); ++e)
      triangulation.insert_constraint(vertices[e],
                                      vertices[e + 1 == rings.first(k + 1) ? rings.first(k) : e + 1]);
  tell_inside(triangulation);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto face : triangulation.finite_face_handles())
    if (face->info() == is_inside)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

}  // namespace wellspaced
