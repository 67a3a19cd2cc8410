// Constrained Delaunay triangulations of planar point sets, by CGAL.
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/domain/cgal_triangulation.h"
#include "core/mesh/border_chains.h"
#include "core/mesh/planar_meshes.h"
#include "core/mesh/planar_sites.h"

namespace wellspaced {
namespace {

using Kernel = InexactKernel;
using Triangulation = ConstrainedTriangulation;

Vec2 planar(Vec3 p) { return {p.x, p.y}; }

class PlanarDelaunay {
 public:
  PlanarDelaunay(const PointSet& points, const Control& control)
      : points_(points), control_(control), sites_(points), chains_(border_chains(points)) {}

  Mesh run() {
    add_corners();
    vertices_ = insert_places(triangulation_, sites_.at, control_);
    const bool is_strip = sites_.period != 0;  // of which all is inside
    if (!is_strip) {
      constrain();
      tell_inside(triangulation_);
    }
    Mesh mesh;
    begin(mesh);
    std::size_t count = 0;
    for (const auto face : triangulation_.finite_face_handles()) {
      if (++count % 4096 == 0) control_.check();
      if (is_strip || face->info() == is_inside) add(face, mesh);
    }
    require_all_used(mesh);
    return mesh;
  }

 private:
  /// Corners that are no points; a place on each closed curve that has none.
  void add_corners() {
    std::map<std::pair<double, double>, std::uint32_t> known;
    for (BorderChain& chain : chains_) {
      if (chain.closed && chain.links.empty()) chain.links.push_back({0, BorderChain::none});
      for (BorderChain::Link& link : chain.links) {
        if (link.point != BorderChain::none) continue;
        const Vec2 at = planar(points_.domain->boundary_point(chain.curve, link.along));
        const auto [found, is_new] = known.try_emplace({at.x, at.y}, sites_.places);
        if (is_new) sites_.add_place(at);
        link.point = found->second;
      }
    }
  }

  /// Sites of bounded domains are numbered as their places are.
  void constrain() {
    try {
      for (const BorderChain& chain : chains_)
        for (std::size_t k = 0; k + 1 < chain.links.size(); ++k)
          triangulation_.insert_constraint(vertices_[chain.links[k].point],
                                           vertices_[chain.links[k + 1].point]);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      throw Error(ErrorCode::degenerate_input,
                  "points on the boundary are so near to another edge of it that the edges between them "
                  "cross; move them apart, or take the point out");
    }
  }

  void begin(Mesh& mesh) {
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
      mesh.vertices.push_back(points_[k]);
      mesh.vertex_points.push_back(k);
    }
    for (std::uint32_t k = 0; k < sites_.at.size(); ++k) {
      if (sites_.turn[k] != 0 || sites_.number[k] < points_.size()) continue;
      mesh.vertices.push_back({sites_.at[k].x, sites_.at[k].y, 0});
      mesh.vertex_points.push_back(Mesh::no_point);
    }
    mesh.originals.resize(mesh.vertices.size());
    std::iota(mesh.originals.begin(), mesh.originals.end(), 0u);
  }

  /// Of images vertices are made as triangles need them.
  std::uint32_t vertex_of(std::uint32_t site, Mesh& mesh) {
    const std::uint32_t number = sites_.number[site];
    const int turn = sites_.turn[site];
    if (turn == 0) return number;
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [found, is_new] = images_.try_emplace({number, turn}, next);
    if (!is_new) return found->second;
    Vec3 at = mesh.vertices[number];
    const Vec3 size = points_.domain->box().size;
    if (sites_.axis == 0)
      at.x += turn * size.x;
    else
      at.y += turn * size.y;
    mesh.vertices.push_back(at);
    mesh.vertex_points.push_back(mesh.vertex_points[number]);
    mesh.originals.push_back(number);
    return next;
  }

  /// Of a triangle's images the one in which the place with the lowest number is at home; if that has two
  /// images in it, the one on the left.
  bool is_at_home(const std::array<std::uint32_t, 3>& corners) const {
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(sites_.number[a], sites_.turn[a]) < std::pair(sites_.number[b], sites_.turn[b]);
    };
    return sites_.turn[*std::min_element(corners.begin(), corners.end(), before)] == 0;
  }

  void add(Triangulation::Face_handle face, Mesh& mesh) {
    const std::array<std::uint32_t, 3> sites{face->vertex(0)->info(), face->vertex(1)->info(),
                                             face->vertex(2)->info()};
    if (!is_at_home(sites)) return;
    for (const std::uint32_t site : sites) mesh.corners.push_back(vertex_of(site, mesh));
    mesh.close();
  }

  void require_all_used(const Mesh& mesh) const {
    std::vector<bool> used(points_.size(), false);
    for (const std::uint32_t v : mesh.corners)
      if (mesh.vertex_points[v] != Mesh::no_point) used[mesh.vertex_points[v]] = true;
    const auto unused = std::find(used.begin(), used.end(), false);
    if (unused == used.end()) return;
    throw Error(
        ErrorCode::degenerate_input,
        "the point is so near to an edge of the boundary that no triangle has room between them; move "
        "it onto the boundary, or away",
        "/" + std::to_string(unused - used.begin()));
  }

  const PointSet& points_;
  const Control& control_;
  PlanarSites sites_;
  std::vector<BorderChain> chains_;
  Triangulation triangulation_;
  std::vector<Triangulation::Vertex_handle> vertices_;
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> images_;
};

}  // namespace

Mesh planar_delaunay(const PointSet& points, const Control& control) {
  require_usable(points, control);
  return PlanarDelaunay(points, control).run();
}

}  // namespace wellspaced
