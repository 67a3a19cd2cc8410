#include "core/mesh/triangulate_rings.h"

#include <map>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "core/domain/cgal_triangulation.h"

namespace wellspaced {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<signed char, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

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
