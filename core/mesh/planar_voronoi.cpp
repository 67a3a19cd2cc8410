// Voronoi cells clipped to planar domains: cells near the boundary are faces of an exact arrangement, by
// CGAL.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "core/domain/cgal_triangulation.h"
#include "core/domain/polygon.h"
#include "core/mesh/planar_meshes.h"
#include "core/mesh/planar_sites.h"
#include "core/mesh/triangulate_rings.h"
#include "core/voronoi/cell.h"

namespace wellspaced {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<std::uint32_t, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

/// What an edge of the arrangement lies on: a Voronoi edge, by its number; a ring.
constexpr int on_ring = -1;
using Traits = CGAL::Arr_consolidated_curve_data_traits_2<CGAL::Arr_segment_traits_2<Exact>, int>;
using Arrangement = CGAL::Arrangement_2<Traits>;

/// Coordinates of less than 1e-100 of the domain's size become 0: their products are below what a double can
/// hold, where filters of exact arithmetic fail.
class Underflow {
 public:
  explicit Underflow(const Domain& domain)
      : least_(1e-100 * std::max(domain.box().size.x, domain.box().size.y)) {}
  Vec2 removed(Vec2 p) const { return {removed(p.x), removed(p.y)}; }

 private:
  double removed(double x) const { return std::fabs(x) < least_ ? 0 : x; }

  double least_;
};

std::vector<std::vector<Vec2>> rings_of(const PointSet& points, const PlanarSites& sites) {
  if (const auto* const polygon = dynamic_cast<const Polygon*>(points.domain.get())) return polygon->rings();
  const Vec3 size = points.domain->box().size;
  Vec2 low, high{size.x, size.y};
  // No cell of a strip reaches farther along it.
  double &from = sites.axis == 0 ? low.x : low.y, &to = sites.axis == 0 ? high.x : high.y;
  from -= 2 * sites.period;
  to += 2 * sites.period;
  return {{{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}};
}

class PlanarVoronoi {
 public:
  PlanarVoronoi(const PointSet& points, const Control& control)
      : points_(points), control_(control), underflow_(*points.domain), sites_(points) {
    for (Vec2& site : sites_.at) site = underflow_.removed(site);
  }

  Mesh run() {
    vertices_ = insert_places(triangulation_, sites_.at, control_);
    for (const auto face : triangulation_.all_face_handles()) face->info() = none;
    find_bounded();
    place_centers();
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      if (!is_bounded_[i]) add_inner(i);
    add_bounded();
    collapse_short_edges(mesh_, 1e-12 * hexagonal_spacing(*points_.domain, points_.size()));
    return std::move(mesh_);
  }

 private:
  using Place = std::pair<double, double>;
  /// The two sites that it lies between.
  struct VoronoiEdge {
    std::uint32_t u, v;
  };
  static constexpr std::uint32_t none = ~0u;

  Exact::Point_2 exact(std::uint32_t site) const { return {sites_.at[site].x, sites_.at[site].y}; }

  /// The center of a triangle, as seen from its site with the lowest number, so that it is the same for all.
  Vec2 center(Triangulation::Face_handle face) const {
    std::uint32_t a = face->vertex(0)->info(), b = face->vertex(1)->info(), c = face->vertex(2)->info();
    while (a > b || a > c) std::tie(a, b, c) = std::tuple(b, c, a);
    const Vec2 base = sites_.at[a];
    return base + circumcenter(sites_.at[b] - base, sites_.at[c] - base);
  }

  template <class Use>
  void for_each_face_at(std::uint32_t site, const Use& use) const {
    auto face = triangulation_.incident_faces(vertices_[site]);
    if (face == nullptr) return;
    const auto first = face;
    do use(Triangulation::Face_handle(face));
    while (++face != first);
  }

  /// The points whose cells the boundary may cut.
  void find_bounded() {
    is_bounded_.assign(sites_.at.size(), false);
    ChartPieces pieces;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (i % 4096 == 0) control_.check();
      bool open = triangulation_.dimension() < 2;
      double farthest = 0;
      for_each_face_at(i, [&](Triangulation::Face_handle face) {
        if (triangulation_.is_infinite(face))
          open = true;
        else
          farthest = std::max(farthest, norm(center(face) - sites_.at[i]));
      });
      is_bounded_[i] =
          open || !(farthest < HUGE_VAL) || points_.domain->pieces(points_[i], farthest * (1 + 1e-6), pieces);
    }
  }

  bool touches_bounded(Triangulation::Face_handle face) const {
    for (int k = 0; k < 3; ++k)
      if (is_bounded_[face->vertex(k)->info()]) return true;
    return false;
  }

  /// Rounded from the exact one: what cells on both sides of it agree on.
  Vec2 rounded(const Exact::Point_2& p) const {
    p.exact();
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y())};
  }

  std::uint32_t vertex_at(Vec2 at) {
    const auto [found, is_new] =
        known_.try_emplace({at.x, at.y}, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back({at.x, at.y, 0});
    return found->second;
  }

  const Exact::Point_2& exact_center(Triangulation::Face_handle face) {
    const auto [found, is_new] = exact_centers_.try_emplace(&*face);
    if (is_new)
      found->second = CGAL::circumcenter(exact(face->vertex(0)->info()), exact(face->vertex(1)->info()),
                                         exact(face->vertex(2)->info()));
    return found->second;
  }

  /// A vertex for each triangle whose center is a corner of some cell that nothing cuts.
  void place_centers() {
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (i % 4096 == 0) control_.check();
      if (is_bounded_[i]) continue;
      for_each_face_at(i, [&](Triangulation::Face_handle face) {
        if (face->info() != none) return;
        if (touches_bounded(face)) {
          face->info() = vertex_at(rounded(exact_center(face)));
          return;
        }
        face->info() = static_cast<std::uint32_t>(mesh_.vertices.size());
        const Vec2 at = center(face);
        mesh_.vertices.push_back({at.x, at.y, 0});
      });
    }
  }

  void add_inner(std::uint32_t i) {
    for_each_face_at(i, [&](Triangulation::Face_handle face) { mesh_.corners.push_back(face->info()); });
    mesh_.close();
    mesh_.face_points.push_back(i);
  }

  /// On the bisector of u and v, with u on the left, far outside of everything.
  Exact::Point_2 far_away(const Exact::Point_2& from, std::uint32_t u, std::uint32_t v) const {
    const Exact::Vector_2 across = exact(v) - exact(u);
    const Exact::Vector_2 along(-across.y(), across.x());
    const Vec3 size = points_.domain->box().size;
    const Vec2 d = sites_.at[v] - sites_.at[u];
    const double start = std::fabs(CGAL::to_double(from.x())) + std::fabs(CGAL::to_double(from.y()));
    const double times =
        std::ldexp(1, std::ilogb(16 * (start + norm(size) + 3 * sites_.period) / norm(d)) + 1);
    return from + times * along;
  }

  using Curves = std::vector<Traits::Curve_2>;

  /// The Voronoi edge between u and v.
  void add_edge(const Exact::Point_2& from, const Exact::Point_2& to, std::uint32_t u, std::uint32_t v,
                Curves& curves) {
    if (from == to) return;
    curves.push_back({Exact::Segment_2(from, to), static_cast<int>(edges_.size())});
    edges_.push_back({u, v});
  }

  void add_voronoi_edges(Curves& curves) {
    std::size_t count = 0;
    for (const auto& edge : triangulation_.finite_edges()) {
      if (++count % 4096 == 0) control_.check();
      // The triangle is to the left of the way from u to v.
      const Triangulation::Face_handle left = edge.first;
      const int at = edge.second;
      const std::uint32_t u = left->vertex(triangulation_.ccw(at))->info(),
                          v = left->vertex(triangulation_.cw(at))->info();
      if (!is_bounded_[u] && !is_bounded_[v]) continue;
      if (triangulation_.dimension() < 2) {
        const Exact::Point_2 middle = CGAL::midpoint(exact(u), exact(v));
        add_edge(far_away(middle, v, u), far_away(middle, u, v), u, v, curves);
        continue;
      }
      const Triangulation::Face_handle right = left->neighbor(at);
      const bool on_left = !triangulation_.is_infinite(left), on_right = !triangulation_.is_infinite(right);
      const Exact::Point_2 from = on_right ? exact_center(right) : far_away(exact_center(left), v, u);
      const Exact::Point_2 to = on_left ? exact_center(left) : far_away(from, u, v);
      add_edge(from, to, u, v, curves);
    }
  }

  void add_rings(Curves& curves) const {
    for (const auto& ring : rings_of(points_, sites_))
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2 a = underflow_.removed(ring[k]);
        const Vec2 b = underflow_.removed(ring[k + 1 == ring.size() ? 0 : k + 1]);
        curves.push_back({Exact::Segment_2({a.x, a.y}, {b.x, b.y}), on_ring});
      }
  }

  static bool lies_on_ring(const Arrangement::Halfedge& edge) {
    for (const int what : edge.curve().data())
      if (what == on_ring) return true;
    return false;
  }

  /// The site whose cell the face to the left of the edge is part of, if the edge tells.
  std::optional<std::uint32_t> site_left_of(const Arrangement::Halfedge& edge) const {
    for (const int what : edge.curve().data()) {
      if (what == on_ring) continue;
      const VoronoiEdge& between = edges_[static_cast<std::size_t>(what)];
      const bool u_is_left = CGAL::orientation(edge.source()->point(), edge.target()->point(),
                                               exact(between.u)) == CGAL::LEFT_TURN;
      return u_is_left ? between.u : between.v;
    }
    return std::nullopt;
  }

  template <class Use>
  static void for_each_edge_of(Arrangement::Face_handle face, const Use& use) {
    const auto around = [&](Arrangement::Ccb_halfedge_circulator edge) {
      const auto first = edge;
      do use(*edge);
      while (++edge != first);
    };
    if (face->has_outer_ccb()) around(face->outer_ccb());
    for (auto hole = face->inner_ccbs_begin(); hole != face->inner_ccbs_end(); ++hole) around(*hole);
  }

  /// The faces of the arrangement that are inside the domain: from the unbounded one on, rings lead in or
  /// out.
  std::vector<Arrangement::Face_handle> faces_inside(Arrangement& arrangement) const {
    std::vector<Arrangement::Face_handle> inside, open{arrangement.unbounded_face()};
    std::unordered_map<const void*, bool> is_inside{{&*open.back(), false}};
    while (!open.empty()) {
      const Arrangement::Face_handle face = open.back();
      open.pop_back();
      const bool here = is_inside.at(&*face);
      if (here) inside.push_back(face);
      for_each_edge_of(face, [&](Arrangement::Halfedge& edge) {
        const Arrangement::Face_handle other = edge.twin()->face();
        if (is_inside.try_emplace(&*other, here != lies_on_ring(edge)).second) open.push_back(other);
      });
    }
    return inside;
  }

  std::vector<std::uint32_t> loop(Arrangement::Ccb_halfedge_circulator edge) {
    std::vector<std::uint32_t> vertices;
    const auto first = edge;
    do vertices.push_back(vertex_at(rounded(edge->source()->point())));
    while (++edge != first);
    return vertices;
  }

  void add_part(Arrangement::Face_handle face, std::uint32_t point) {
    std::vector<std::vector<std::uint32_t>> loops{loop(face->outer_ccb())};
    for (auto hole = face->inner_ccbs_begin(); hole != face->inner_ccbs_end(); ++hole)
      loops.push_back(loop(*hole));
    if (loops.size() > 1) loops = triangulate_rings(mesh_.vertices, loops);
    for (const std::vector<std::uint32_t>& part : loops) {
      mesh_.corners.insert(mesh_.corners.end(), part.begin(), part.end());
      mesh_.close();
      mesh_.face_points.push_back(point);
    }
  }

  void add_bounded() {
    if (std::find(is_bounded_.begin(), is_bounded_.end(), true) == is_bounded_.end()) return;
    Curves curves;
    add_voronoi_edges(curves);
    add_rings(curves);
    control_.check();
    Arrangement arrangement;
    CGAL::insert(arrangement, curves.begin(), curves.end());
    control_.check();
    std::vector<std::pair<std::uint32_t, Arrangement::Face_handle>> parts;
    for (const Arrangement::Face_handle face : faces_inside(arrangement)) {
      std::optional<std::uint32_t> site;
      for_each_edge_of(face, [&](const Arrangement::Halfedge& edge) {
        if (!site) site = site_left_of(edge);
      });
      if (site && is_bounded_[*site]) parts.emplace_back(*site, face);
    }
    const auto by_point = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::stable_sort(parts.begin(), parts.end(), by_point);
    for (const auto& [site, face] : parts) add_part(face, site);
  }

  const PointSet& points_;
  const Control& control_;
  Underflow underflow_;
  PlanarSites sites_;
  Triangulation triangulation_;
  std::vector<Triangulation::Vertex_handle> vertices_;
  std::vector<bool> is_bounded_;  ///< of sites; images are not asked for their cells
  std::unordered_map<const void*, Exact::Point_2> exact_centers_;
  std::vector<VoronoiEdge> edges_;
  std::map<Place, std::uint32_t> known_;
  Mesh mesh_;
};

}  // namespace

Mesh planar_voronoi(const PointSet& points, const Control& control) {
  require_usable(points, control);
  return PlanarVoronoi(points, control).run();
}

}  // namespace wellspaced
