#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include "tests/support/geodesic_oracle.h"

namespace wellspaced::testing {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using ShortestPath =
    CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Surface>>;

}  // namespace

struct GeodesicOracle::Parts {
  const TriangleMesh* mesh = nullptr;
  Surface surface;
  std::unique_ptr<ShortestPath> search;

  /// CGAL's weights belong to the vertices from the source of the face's halfedge on.
  std::pair<Surface::Face_index, ShortestPath::Barycentric_coordinates> to_cgal(
      const MeshPlace& place) const {
    const Surface::Face_index face(place.face);
    const std::uint32_t source = surface.source(surface.halfedge(face));
    std::size_t k = 0;
    while (mesh->faces()[place.face][k] != source) ++k;
    const auto& w = place.weights;
    return {face, {w[k], w[(k + 1) % 3], w[(k + 2) % 3]}};
  }
};

GeodesicOracle::GeodesicOracle(const TriangleMesh& mesh) : parts_(std::make_unique<Parts>()) {
  parts_->mesh = &mesh;
  for (const Vec3 p : mesh.vertices()) parts_->surface.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : mesh.faces())
    parts_->surface.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c));
  parts_->search = std::make_unique<ShortestPath>(parts_->surface);
}

GeodesicOracle::~GeodesicOracle() = default;

std::vector<double> GeodesicOracle::distances(const MeshPlace& from, const std::vector<MeshPlace>& to) {
  parts_->search->remove_all_source_points();
  const auto source = parts_->to_cgal(from);
  parts_->search->add_source_point(source.first, source.second);
  std::vector<double> all;
  for (const MeshPlace& place : to) {
    const auto target = parts_->to_cgal(place);
    all.push_back(parts_->search->shortest_distance_to_source_points(target.first, target.second).first);
  }
  return all;
}

}  // namespace wellspaced::testing
