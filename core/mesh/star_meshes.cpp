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
#include "core/mesh/border_sides.h"
#include "core/mesh/split_polygon.h"
#include "core/mesh/star_map.h"
#include "core/mesh/too_coarse.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/corner_settler.h"
#include "core/voronoi/moving_set.h"

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

/// Flat faces between points of a surface that lie too far apart leave most of it out.
void require_area(const Mesh& mesh, const PointSet& points, const Control& control) {
  constexpr double least = 0.25;
  if (points.domain->has_exact_cells()) return;
  double area = 0;
  for (std::size_t f = 0; f < mesh.faces(); ++f) area += norm(area_vector(mesh, f));
  if (area < least * points.domain->area()) throw too_coarse(points, control);
}

class CellMaker {
 public:
  CellMaker(const PointSet& points, const Control& control)
      : points_(points), control_(control), map_(points, control) {}

  Mesh run() {
    find_centers();
    find_centers_around_sharp_vertices();
    find_border_middles();
    Unwrapped places(*points_.domain, centers_);
    for (std::uint32_t& middle : middles_)
      if (middle != StarMap::none) middle = places.add(middle_places_[middle]);
    add_ends(places);
    add_edge_middles(places);
    Mesh mesh;
    for (std::size_t i = 0; i < points_.size(); ++i) add_cell(i, places, mesh);
    mesh.vertices = places.take_vertices();
    collapse_short_edges(mesh, 1e-12 * hexagonal_spacing(*points_.domain, points_.size()));
    if (mesh.faces() < points_.size()) throw too_coarse(points_, control_);
    require_area(mesh, points_, control_);
    return mesh;
  }

 private:
  /// Of a face beside the border that has its center outside: the cells of all of its corners end at the
  /// border, one after the other.
  struct CutFace {
    std::uint32_t border_spoke = StarMap::none;  ///< from p to q, with the face on its left
    std::vector<Vec3> places;                    ///< where cells meet on the border, from q to p
    std::uint32_t first_vertex = 0;              ///< of these
  };

  std::uint32_t first_point(std::size_t f) const { return map_.origin(map_.face(f).front()); }

  /// A place that goes far has settled in the center of another face.
  static Vec3 settled(CornerSettler& settler, Vec3 place, double claimed) {
    constexpr double far = 0.1;
    const Vec3 at = settler.settle(place, claimed, false).at;
    return norm(at - place) > far * claimed ? place : at;
  }

  Vec3 center(std::size_t f, CornerSettler* settler) const {
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
    const Vec3 place = domain.place_at(p, c);
    return domain.holds(p, c) && settler != nullptr ? settled(*settler, place, norm(c)) : place;
  }

  void find_centers() {
    const double spacing = hexagonal_spacing(*points_.domain, points_.size());
    const bool settles = !points_.domain->has_exact_cells();
    std::optional<NeighborGrid> grid;
    if (settles) grid.emplace(points_, spacing);
    centers_.resize(map_.faces());
    parallel_blocks(map_.faces(), 1024, control_, [&](std::size_t begin, std::size_t end) {
      std::optional<CornerSettler> settler;
      if (settles) settler.emplace(points_, *grid);
      for (std::size_t f = begin; f < end; ++f) centers_[f] = center(f, settler ? &*settler : nullptr);
    });
  }

  /// In a sharp vertex of a surface a point may have two neighbors only.
  bool has_two_neighbors(std::size_t i) const {
    return map_.end(i) - map_.begin(i) == 2 && points_.domain->freedom(points_[i]).dimensions == 2;
  }

  /// Both faces of a point with two neighbors have the same corners; its cell tells their centers apart.
  void find_centers_around_sharp_vertices() {
    if (points_.domain->has_exact_cells()) return;
    std::vector<std::uint32_t> sharp;
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      if (has_two_neighbors(i)) sharp.push_back(i);
    if (sharp.empty()) return;
    const MovingSet set(points_, control_);
    const NeighborGrid grid(points_, set.spacing());
    CellFinder cells = set.finder(control_);
    CornerSettler settler(points_, grid);
    for (const std::uint32_t i : sharp) {
      set.find_cell(i, cells);
      for (const Cell& part : cells.parts()) take_centers(i, part, cells, settler);
    }
  }

  /// Those between its two neighbors.
  void take_centers(std::uint32_t i, const Cell& part, const CellFinder& cells, CornerSettler& settler) {
    const std::span<const Cell::Corner> corners = part.corners();
    const std::uint32_t s = map_.begin(i);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (part.is_outer(k)) continue;
      const auto id = [&](std::size_t c) {
        return cells.neighbors()[static_cast<std::size_t>(corners[c].label)].id;
      };
      if (id(k) == id(k == 0 ? corners.size() - 1 : k - 1)) continue;
      const Vec2 at = corners[k].at, first = map_[s].way, second = map_[s + 1].way;
      const bool is_left_of_first = cross(first, at) > 0, is_right_of_second = cross(at, second) > 0;
      const bool is_between = cross(first, second) > 0 ? is_left_of_first && is_right_of_second
                                                       : is_left_of_first || is_right_of_second;
      const Vec3 place = points_.domain->place_at(points_[i], at);
      centers_[map_[is_between ? s : s + 1].face] = settled(settler, place, norm(at));
    }
  }

  /// A face is to the left of the spoke, the outside to its right.
  bool leads_along_border(std::uint32_t s) const {
    return map_[s].face != StarMap::none && map_[map_.previous(s)].face == StarMap::none;
  }

  /// Where two neighbors on the border are equally far; and what other cells there are between them.
  void find_border_middles() {
    const bool has_border = points_.domain->boundary_length() > 0;
    middles_.assign(has_border ? map_.end(points_.size() - 1) : 0, StarMap::none);
    if (!has_border) return;
    const BorderSides sides(points_);
    for (std::uint32_t s = 0; s < middles_.size(); ++s) {
      if (!leads_along_border(s)) continue;
      control_.check();
      const BorderSides::Side side = sides.between(map_.origin(s), map_[s].id);
      middles_[s] = static_cast<std::uint32_t>(middle_places_.size());
      middle_places_.push_back(sides.place(side, 0.5));
      if (is_cut(s, middle_places_.back())) cut(s, sides, side);
    }
  }

  /// Some other corner of the face is nearer to where the cells of both ends would meet.
  bool is_cut(std::uint32_t border_spoke, Vec3 middle) const {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t s : map_.face(map_[border_spoke].face)) corners.push_back(map_.origin(s));
    const std::vector<double> distances = distances_from(middle, points_, corners);
    double ends = HUGE_VAL, others = HUGE_VAL;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const bool is_end = corners[k] == map_.origin(border_spoke) || corners[k] == map_[border_spoke].id;
      (is_end ? ends : others) = std::min(is_end ? ends : others, distances[k]);
    }
    return others < ends * (1 - 1e-12);
  }

  void cut(std::uint32_t border_spoke, const BorderSides& sides, const BorderSides::Side& side) {
    CutFace& cut = cuts_[map_[border_spoke].face];
    cut.border_spoke = border_spoke;
    for (std::uint32_t s = map_.around_face(border_spoke); s != border_spoke; s = map_.around_face(s))
      cut.places.push_back(sides.place(side, sides.meeting(side, map_.origin(s), map_[s].id)));
  }

  void add_ends(Unwrapped& places) {
    for (auto& [f, cut] : cuts_) {
      cut.first_vertex = places.add(cut.places.front());
      for (std::size_t k = 1; k < cut.places.size(); ++k) places.add(cut.places[k]);
    }
  }

  /// In a sharp vertex of a surface a point may have two neighbors only. The two edges of its cell get a
  /// corner in their middles, lest they be one.
  void add_edge_middles(Unwrapped& places) {
    if (points_.domain->has_exact_cells()) return;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!has_two_neighbors(i)) continue;
      for (std::uint32_t s = map_.begin(i); s < map_.end(i); ++s) {
        const Vec3 middle = points_.domain->place_at(points_[i], 0.5 * map_[s].way);
        edge_middles_[s] = edge_middles_[map_[s].twin] = places.add(middle);
      }
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

  /// Of the cell of the point whose spoke it is, in the face to the left of that.
  void add_corner(std::uint32_t s, Unwrapped& places, Mesh& mesh) const {
    const std::uint32_t f = map_[s].face;
    const auto cut = cuts_.find(f);
    add_middle(s, f, mesh);
    if (cut == cuts_.end())
      mesh.corners.push_back(places.vertex(f, turns_to_first(f, s)));
    else
      add_ends_at(s, cut->second, mesh);
    // The spoke after the face, seen from its other end, has the face on its left.
    add_middle(map_[map_.next(s)].twin, f, mesh);
  }

  /// Of a border edge, but of one that other cells reach.
  void add_middle(std::uint32_t s, std::uint32_t f, Mesh& mesh) const {
    if (middles_.empty() || !leads_along_border(s)) return;
    const auto cut = cuts_.find(f);
    if (cut == cuts_.end() || cut->second.border_spoke != s) mesh.corners.push_back(middles_[s]);
  }

  /// Where the cell meets the next corner's and the one before; between the ends of the border edge there is
  /// the border.
  void add_ends_at(std::uint32_t s, const CutFace& ends, Mesh& mesh) const {
    const auto count = static_cast<std::uint32_t>(ends.places.size());
    std::uint32_t number = 0;
    for (std::uint32_t at = ends.border_spoke; at != s; at = map_.around_face(at)) ++number;
    if (number > 0) mesh.corners.push_back(ends.first_vertex + number - 1);
    if (number != 1) mesh.corners.push_back(ends.first_vertex + (number == 0 ? count - 1 : number - 2));
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
      if (const auto middle = edge_middles_.find(s); middle != edge_middles_.end())
        mesh.corners.push_back(middle->second);
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
  std::map<std::uint32_t, std::uint32_t>
      edge_middles_;  ///< of spokes whose cells meet in two edges: a vertex
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
  require_area(mesh, points, control);
  return mesh;
}

Mesh voronoi_by_stars(const PointSet& points, const Control& control) {
  return CellMaker(points, control).run();
}

}  // namespace wellspaced
