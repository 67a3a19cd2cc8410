#include "core/mesh/star_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/domain/sphere.h"
#include "core/domain/torus.h"
#include "core/mesh/border_chains.h"
#include "core/mesh/split_polygon.h"
#include "core/mesh/star_map.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/corner_settler.h"

namespace wellspaced {
namespace {

/// Whole periods along x and y.
struct Turns {
  int x = 0, y = 0;
  friend Turns operator+(Turns a, Turns b) { return {a.x + b.x, a.y + b.y}; }
  friend Turns operator-(Turns a, Turns b) { return {a.x - b.x, a.y - b.y}; }
  friend auto operator<=>(const Turns&, const Turns&) = default;
};

/// Vertices that occur once for each period in which some face needs them.
class Unwrapped {
 public:
  Unwrapped(const Domain& domain, std::vector<Vec3> places)
      : size_(is_torus(domain) ? domain.box().size : Vec3{}), vertices_(std::move(places)) {
    for (std::size_t v = 0; v < vertices_.size(); ++v) originals_.push_back(static_cast<std::uint32_t>(v));
  }

  std::uint32_t vertex(std::uint32_t original, Turns turns) {
    if (turns == Turns{}) return original;
    const auto next = static_cast<std::uint32_t>(vertices_.size());
    const auto [found, is_new] = images_.try_emplace({original, turns}, next);
    if (is_new) {
      vertices_.push_back(vertices_[original] + Vec3{turns.x * size_.x, turns.y * size_.y, 0});
      originals_.push_back(original);
    }
    return found->second;
  }

  std::uint32_t add(Vec3 place) {
    vertices_.push_back(place);
    originals_.push_back(static_cast<std::uint32_t>(vertices_.size() - 1));
    return originals_.back();
  }

  std::vector<Vec3> take_vertices() { return std::move(vertices_); }
  std::vector<std::uint32_t> take_originals() { return std::move(originals_); }

 private:
  Vec3 size_;
  std::vector<Vec3> vertices_;
  std::vector<std::uint32_t> originals_;
  std::map<std::pair<std::uint32_t, Turns>, std::uint32_t> images_;
};

Turns turns_of(const StarMap::Spoke& spoke) { return {spoke.turns_x, spoke.turns_y}; }

std::vector<Vec3> places_of(const PointSet& points) {
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < points.size(); ++i) places.push_back(points[i]);
  return places;
}

/// Of edges that lead the same way between the same vertices.
void require_simple(const Mesh& mesh) {
  std::vector<std::uint64_t> edges;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh[f];
    for (std::size_t k = 0; k < face.size(); ++k)
      edges.push_back((std::uint64_t{face[k]} << 32) | face[k + 1 == face.size() ? 0 : k + 1]);
  }
  std::sort(edges.begin(), edges.end());
  const auto twice = std::adjacent_find(edges.begin(), edges.end());
  if (twice == edges.end()) return;
  throw Error(ErrorCode::infeasible,
              "the points are too few to follow the domain: points " + std::to_string(*twice >> 32) +
                  " and " + std::to_string(*twice & 0xffffffffu) +
                  " are neighbors in two ways, around a narrow part of it; with half the distance between "
                  "points, or less, there is a mesh");
}

class CellMaker {
 public:
  CellMaker(const PointSet& points, const Control& control)
      : points_(points), control_(control), map_(points, control) {}

  Mesh run() {
    find_centers();
    find_border_middles();
    Unwrapped places(*points_.domain, centers_);
    for (std::uint32_t& middle : middles_)
      if (middle != StarMap::none) middle = places.add(middle_places_[middle]);
    add_ends(places);
    Mesh mesh;
    for (std::size_t i = 0; i < points_.size(); ++i) add_cell(i, places, mesh);
    mesh.vertices = places.take_vertices();
    collapse_short_edges(mesh, 1e-12 * hexagonal_spacing(*points_.domain, points_.size()));
    return mesh;
  }

 private:
  /// Where a triangle that lies across the border has its center outside, the cell of the third point ends
  /// in an edge between two places of the border.
  struct CutFace {
    std::uint32_t border_spoke = StarMap::none;  ///< from p to q, with the face on its left
    std::uint32_t near_p = 0, near_q = 0;        ///< vertices
    Vec3 at_p, at_q;
  };

  std::uint32_t first_point(std::size_t f) const { return map_.origin(map_.face(f).front()); }

  Vec3 center(std::size_t f, CornerSettler* settler, bool& inside) const {
    const Domain& domain = *points_.domain;
    const auto face = map_.face(f);
    const Vec3 p = points_[first_point(f)];
    const auto third = face.size() / 3, second = 2 * face.size() / 3;
    if (const auto* const ball = dynamic_cast<const Sphere*>(&domain)) {
      const Vec3 a = points_[map_.origin(face[third])] - p, b = points_[map_.origin(face[second])] - p;
      const Vec3 normal = cross(a, b);
      return (ball->radius() / norm(normal)) * normal;
    }
    const Vec2 c = circumcenter(map_[face.front()].way, map_[map_.next(face.front())].way);
    if (is_torus(domain)) return {p.x + c.x, p.y + c.y, 0};
    inside = domain.holds(p, c);
    const Vec3 place = domain.place_at(p, c);
    return inside && settler != nullptr ? settler->settle(place, norm(c), false).at : place;
  }

  void find_centers() {
    const double spacing = hexagonal_spacing(*points_.domain, points_.size());
    const bool settles = !points_.domain->has_exact_cells();
    std::optional<NeighborGrid> grid;
    if (settles) grid.emplace(points_, spacing);
    centers_.resize(map_.faces());
    std::vector<std::uint8_t> inside(map_.faces(), 1);
    parallel_blocks(map_.faces(), 1024, control_, [&](std::size_t begin, std::size_t end) {
      std::optional<CornerSettler> settler;
      if (settles) settler.emplace(points_, *grid);
      for (std::size_t f = begin; f < end; ++f) {
        bool is_inside = true;
        centers_[f] = center(f, settler ? &*settler : nullptr, is_inside);
        inside[f] = is_inside;
      }
    });
    for (std::size_t f = 0; f < inside.size(); ++f)
      if (inside[f] == 0) cut(f);
  }

  void cut(std::size_t f) {
    const auto face = map_.face(f);
    if (face.size() != 3) return;
    for (const std::uint32_t s : face) {
      if (!leads_along_border(s)) continue;
      const std::uint32_t p = map_.origin(s), q = map_[s].id;
      const std::uint32_t to_third = map_.next(s), back = map_[s].twin, third_from_q = map_.previous(back);
      CutFace cut;
      cut.border_spoke = s;
      cut.at_p = crossing(p, s, to_third);
      cut.at_q = crossing(q, back, third_from_q);
      cuts_[f] = cut;
      return;
    }
  }

  /// A face is to the left of the spoke, the outside to its right.
  bool leads_along_border(std::uint32_t s) const {
    return map_[s].face != StarMap::none && map_[map_.previous(s)].face == StarMap::none;
  }

  /// Where the bisector with the third point meets the border edge, from p.
  Vec3 crossing(std::uint32_t p, std::uint32_t along, std::uint32_t third) const {
    const Vec2 edge = map_[along].way, way = map_[third].way;
    const double part = std::clamp(0.5 * norm2(way) / dot(way, edge), 0.0, 1.0);
    return points_[p] + part * (points_[map_[along].id] - points_[p]);
  }

  /// Where two neighbors on the border are equally far.
  void find_border_middles() {
    const bool has_border = points_.domain->boundary_length() > 0;
    middles_.assign(has_border ? map_.end(points_.size() - 1) : 0, StarMap::none);
    if (!has_border) return;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> between;
    for (const BorderChain& chain : border_chains(points_)) {
      const std::size_t count = chain.links.size();
      for (std::size_t k = 0; k + (chain.closed ? 0 : 1) < count; ++k) {
        const BorderChain::Link &a = chain.links[k], &b = chain.links[(k + 1) % count];
        const double end = k + 1 == count ? b.along + chain.length : b.along;
        between[{a.point, b.point}] = points_.domain->boundary_point(chain.curve, (a.along + end) / 2);
      }
    }
    for (std::uint32_t s = 0; s < middles_.size(); ++s) {
      if (!leads_along_border(s)) continue;
      const auto found = between.find({map_.origin(s), map_[s].id});
      const Vec3 p = points_[map_.origin(s)], q = points_[map_[s].id];
      middles_[s] = static_cast<std::uint32_t>(middle_places_.size());
      middle_places_.push_back(found == between.end() ? 0.5 * (p + q) : found->second);
    }
  }

  void add_ends(Unwrapped& places) {
    for (auto& [f, cut] : cuts_) {
      cut.near_p = places.add(cut.at_p);
      cut.near_q = places.add(cut.at_q);
    }
  }

  /// How many periods the face's first point is away from where point i, a corner of it, sees it; the spoke
  /// is the one along which the face goes on from i.
  Turns turns_to_first(std::size_t f, std::uint32_t spoke) const {
    Turns turns;
    for (std::uint32_t s : map_.face(f)) {
      if (s == spoke) return Turns{} - turns;
      turns = turns + turns_of(map_[s]);
    }
    return {};
  }

  void add_corner(std::uint32_t s, Unwrapped& places, Mesh& mesh) const {
    const std::uint32_t f = map_[s].face;
    const auto cut = cuts_.find(f);
    if (cut == cuts_.end()) {
      if (!middles_.empty() && leads_along_border(s)) mesh.corners.push_back(middles_[s]);
      mesh.corners.push_back(places.vertex(f, turns_to_first(f, s)));
      // The spoke after the face, seen from its other end, has the face on its left.
      const std::uint32_t back = map_[map_.next(s)].twin;
      if (!middles_.empty() && leads_along_border(back)) mesh.corners.push_back(middles_[back]);
      return;
    }
    const std::uint32_t border = cut->second.border_spoke;
    if (s == border) {
      mesh.corners.push_back(cut->second.near_p);
    } else if (s == map_.previous(map_[border].twin)) {
      mesh.corners.push_back(cut->second.near_q);
    } else {
      mesh.corners.push_back(cut->second.near_p);
      mesh.corners.push_back(cut->second.near_q);
    }
  }

  void add_cell(std::size_t i, Unwrapped& places, Mesh& mesh) const {
    if (i % 4096 == 0) control_.check();
    // From the outside on, if there is one.
    std::uint32_t first = map_.begin(i);
    for (std::uint32_t s = first; s < map_.end(i); ++s)
      if (map_[s].face == StarMap::none) first = map_.next(s);
    std::uint32_t s = first;
    do {
      if (map_[s].face != StarMap::none)
        add_corner(s, places, mesh);
      else
        mesh.corners.push_back(places.add(points_[i]));
      s = map_.next(s);
    } while (s != first);
    mesh.close();
    mesh.face_points.push_back(static_cast<std::uint32_t>(i));
  }

  const PointSet& points_;
  const Control& control_;
  StarMap map_;
  std::vector<Vec3> centers_, middle_places_;
  std::vector<std::uint32_t> middles_;  ///< of spokes along the border: the vertex in the middle
  std::map<std::size_t, CutFace> cuts_;
};

}  // namespace

Mesh delaunay_by_stars(const PointSet& points, const Control& control) {
  const StarMap map(points, control);
  Unwrapped places(*points.domain, places_of(points));
  Mesh mesh;
  const bool wraps = is_torus(*points.domain);
  const Vec3 size = wraps ? points.domain->box().size : Vec3{};
  std::vector<std::uint32_t> corners;
  std::vector<Vec3> at;
  for (std::size_t f = 0; f < map.faces(); ++f) {
    if (f % 4096 == 0) control.check();
    corners.clear();
    at.clear();
    Turns turns;
    for (const std::uint32_t s : map.face(f)) {
      corners.push_back(places.vertex(map.origin(s), turns));
      at.push_back(points[map.origin(s)] + Vec3{turns.x * size.x, turns.y * size.y, 0});
      turns = turns + turns_of(map[s]);
    }
    const auto joined = [&](std::uint32_t a, std::uint32_t b) {
      return !wraps && map.has_edge(corners[a], corners[b]);
    };
    for (const auto& triangle : split_polygon(at, joined)) {
      for (const std::uint32_t k : triangle) mesh.corners.push_back(corners[k]);
      mesh.close();
    }
  }
  mesh.vertices = places.take_vertices();
  mesh.originals = places.take_originals();
  mesh.vertex_points = mesh.originals;
  require_simple(mesh);
  return mesh;
}

Mesh voronoi_by_stars(const PointSet& points, const Control& control) {
  return CellMaker(points, control).run();
}

}  // namespace wellspaced
