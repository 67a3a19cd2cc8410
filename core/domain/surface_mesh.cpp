#include "core/domain/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/domain/geodesic_search.h"
#include "core/domain/mesh_extent.h"
#include "core/domain/star_region.h"
#include "core/domain/straight_way.h"
#include "core/math.h"

namespace wellspaced {
namespace {

constexpr double most = 0.75;              ///< of the way to the border in one move
constexpr double far_from_surface = 1e-9;  ///< of the box's diagonal
constexpr std::size_t most_seams = 32;
constexpr double sharp = 3 * pi / 180;  ///< angle missing around a vertex: less doesn't matter for cells

Box box_around(const TriangleMesh& mesh) {
  Vec3 low = mesh.corner(0, 0), high = low;
  for (std::uint32_t f = 0; f < mesh.faces().size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh.corner(f, k);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  return {low, high - low, {}};
}

/// What coordinates lose in steps and by being written and read.
double rounding_in(const Box& box) {
  const Vec3 high = box.low + box.size;
  double largest = 0;
  for (const double c : {box.low.x, box.low.y, box.low.z, high.x, high.y, high.z})
    largest = std::max(largest, std::fabs(c));
  return 1e-12 * norm(box.size) + 1e-14 * largest;
}

std::vector<DomainTriangle> faces_of(const TriangleMesh& mesh) {
  std::vector<DomainTriangle> all;
  all.reserve(mesh.faces().size());
  for (std::uint32_t f = 0; f < mesh.faces().size(); ++f)
    all.push_back({mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)});
  return all;
}

}  // namespace

SurfaceMesh::SurfaceMesh(TriangleMesh mesh)
    : mesh_(std::move(mesh)),
      box_(box_around(mesh_)),
      rounding_(rounding_in(box_)),
      unfolding_(mesh_),
      tree_(faces_of(mesh_)),
      border_(unfolding_, rounding_) {
  double sum = 0;
  for (const DomainTriangle& face : faces_of(mesh_)) areas_up_to_.push_back(sum += area_of(face));
  for (std::uint32_t v = 0; v < mesh_.vertices().size() && !has_sharp_vertices_; ++v)
    has_sharp_vertices_ = unfolding_.missing_angle(v) > sharp;
}

const SmallestFeature& SurfaceMesh::smallest_feature() const {
  std::call_once(looked_for_feature_,
                 [this] { smallest_feature_ = wellspaced::smallest_feature(mesh_, tree_); });
  return smallest_feature_;
}

double SurfaceMesh::farthest() const {
  std::call_once(looked_for_farthest_, [this] { farthest_ = mesh_extent(mesh_); });
  return farthest_;
}

/// To look `times` the longest shortest way far shows all that there is to see.
double SurfaceMesh::seen_within(double reach, double times) const {
  return reach > norm(box_.size) ? std::min(reach, times * farthest()) : reach;
}

Vec3 SurfaceMesh::place_in(std::size_t part) const {
  const std::vector<std::uint32_t>& components = mesh_.component_of_face();
  const auto face = std::find(components.begin(), components.end(), part) - components.begin();
  return mesh_.corner(static_cast<std::uint32_t>(face), 0);
}

MeshPlace SurfaceMesh::locate(Vec3 p) const { return spot(p).place; }

SurfaceMesh::Spot SurfaceMesh::spot(Vec3 p) const {
  auto found = tree_.find(p, rounding_ / 16);
  if (!found) found = tree_.nearest(p);
  return spot_in({found->face, found->weights}, p);
}

SurfaceMesh::Spot SurfaceMesh::spot_in(const MeshPlace& place, Vec3 p) const {
  Spot spot{place, {}};
  if (border_.curves().empty()) return spot;
  spot.border = border_.spot(p, place.face);
  if (spot.border) spot.place = border_.place(*spot.border);
  return spot;
}

MeshPlace SurfaceMesh::locate(Vec3 p, std::uint32_t face) const {
  if (face == Neighbor::no_hint) return locate(p);
  return spot_in({face, tree_.nearest_in(face, p)}, p).place;
}

Vec3 SurfaceMesh::nearest(Vec3 p) const { return position(locate(p)); }

std::optional<Vec2> SurfaceMesh::logarithm(Vec3 p, Vec3 q, double reach) const {
  GeodesicSearch search(unfolding_, locate(p), reach);
  search.add(locate(q));
  search.run();
  const auto& target = search.targets().front();
  if (target.distance == GeodesicSearch::unreached) return {};
  return target.vector;
}

double SurfaceMesh::distance(Vec3 p, Vec3 q) const {
  const MeshPlace from = locate(p), to = locate(q);
  if (mesh_.component_of_face()[from.face] != mesh_.component_of_face()[to.face])
    return GeodesicSearch::unreached;
  // Most ways are hardly longer than the straight line; then the search stays small.
  for (const double reach : {1.2 * norm(q - p), GeodesicSearch::unreached}) {
    GeodesicSearch search(unfolding_, from, reach);
    search.add(to);
    search.run();
    if (search.targets().front().distance < GeodesicSearch::unreached)
      return search.targets().front().distance;
  }
  return GeodesicSearch::unreached;
}

std::optional<std::string> SurfaceMesh::why_outside(Vec3 p) const {
  const double away = norm(nearest(p) - p), diagonal = norm(box_.size);
  if (away <= far_from_surface * diagonal + rounding_) return {};
  std::ostringstream text;
  text.precision(17);
  text << "point (" << p.x << ", " << p.y << ", " << p.z << ") is ";
  text.precision(3);
  text << away << " away from the surface, and at most " << far_from_surface
       << " of its box's diagonal is allowed; move it to the nearest point of the surface";
  return text.str();
}

Vec3 SurfaceMesh::random_point(Rng& rng) const {
  for (;;) {
    const double area = rng.uniform() * areas_up_to_.back();
    const auto after = std::upper_bound(areas_up_to_.begin(), areas_up_to_.end() - 1, area);
    const auto face = static_cast<std::uint32_t>(after - areas_up_to_.begin());
    const Vec3 p =
        random_point_in({mesh_.corner(face, 0), mesh_.corner(face, 1), mesh_.corner(face, 2)}, rng);
    if (border_.curves().empty() || !spot(p).border) return p;
  }
}

Freedom SurfaceMesh::freedom(Vec3 p) const {
  if (border_.curves().empty()) return {};
  const Spot at = spot(p);
  if (!at.border) return {};
  if (at.border->is_corner) return {0};
  return {1, border_.tangent(*at.border)};
}

bool SurfaceMesh::is_on_border(const MeshPlace& place) const {
  return border_.spot(position(place), place.face).has_value();
}

Vec2 SurfaceMesh::possible(Vec3 p, Vec2 u) const {
  if (border_.curves().empty()) return u;
  const Spot at = spot(p);
  if (at.border) {
    if (at.border->is_corner) return {};
    const Vec2 along = border_.tangent(*at.border);
    return border_.possible(*at.border, dot(u, along)) * along;
  }
  if (!border_.may_be_near(at.place, p, norm(u) / most)) return u;
  Vec2 v = go_straight(unfolding_, at.place, (1 / most) * u).part * u;
  // Past a corner of the border one may end beside its edge.
  for (int halved = 0; is_on_border(go_straight(unfolding_, at.place, v).end); v = 0.5 * v)
    if (++halved == 8) return {};
  return v;
}

Vec3 SurfaceMesh::step(Vec3 p, Vec2 u) const {
  if (u == Vec2{}) return p;
  const Spot at = spot(p);
  if (!at.border) {
    const Vec3 end = position(go_straight(unfolding_, at.place, u).end);
    return border_.curves().empty() || !spot(end).border ? end : p;
  }
  if (at.border->is_corner) return p;
  return border_.step(*at.border, dot(u, border_.tangent(*at.border)));
}

Vec3 SurfaceMesh::place_at(Vec3 p, Vec2 u) const {
  return u == Vec2{} ? p : position(go_straight(unfolding_, spot(p).place, u).end);
}

bool SurfaceMesh::holds(Vec3 p, Vec2 u) const { return go_straight(unfolding_, spot(p).place, u).part >= 1; }

std::optional<BoundarySpot> SurfaceMesh::boundary_spot(Vec3 p) const {
  if (border_.curves().empty()) return {};
  const Spot at = spot(p);
  if (!at.border || at.border->is_corner) return {};
  return border_.on_curve(*at.border);
}

std::optional<Vec3> SurfaceMesh::boundary_point_at(Vec3 p) const {
  if (border_.curves().empty()) return {};
  const Spot at = spot(p);
  return at.border ? std::optional(position(at.place)) : std::nullopt;
}

/// Others cut a cell as far as twice its radius.
void SurfaceMesh::localize(Vec3 base, double reach, std::vector<Neighbor>& neighbors) const {
  reach = seen_within(reach, 2);
  GeodesicSearch search(unfolding_, locate(base), reach);
  for (const Neighbor& neighbor : neighbors) search.add(locate(base + neighbor.offset, neighbor.hint));
  search.run(GeodesicSearch::Border::ignore, GeodesicSearch::enough_windows, GeodesicSearch::Images::collect);
  std::vector<GeodesicSearch::Image> images = search.images();
  std::vector<double> nearest(neighbors.size(), GeodesicSearch::unreached);
  for (const auto& [target, vector, earlier] : images)
    nearest[target] = std::min(nearest[target], norm(vector));
  for (std::uint32_t k = 0; k < neighbors.size(); ++k) {
    const GeodesicSearch::Target& target = search.targets()[k];
    if (target.distance <= reach && target.distance < nearest[k]) images.push_back({k, target.vector});
  }
  std::sort(images.begin(), images.end(), [](const auto& a, const auto& b) {
    return a.target != b.target ? a.target < b.target : norm2(a.vector) < norm2(b.vector);
  });
  std::vector<Neighbor> localized;
  localized.reserve(images.size());
  for (const auto& [target, vector, earlier] : images)
    localized.push_back({{vector.x, vector.y, 0}, neighbors[target].id, neighbors[target].hint});
  neighbors.swap(localized);
}

bool SurfaceMesh::is_nearer(Vec3 base, const Neighbor& neighbor, double distance) const {
  if (norm(neighbor.offset) >= distance) return false;
  distance = seen_within(distance, 1.01);
  const MeshPlace from = locate(base), to = locate(base + neighbor.offset, neighbor.hint);
  if (from.face == to.face) return true;
  if (const auto way = aim(unfolding_, from, to); way && way->length < distance) return true;
  GeodesicSearch search(unfolding_, from, distance);
  search.add(to);
  search.run();
  return search.targets().front().distance < distance;
}

void SurfaceMesh::distances(Vec3 base, double reach, std::span<const Neighbor> neighbors,
                            std::vector<double>& out) const {
  GeodesicSearch search(unfolding_, locate(base), seen_within(reach, 1.01));
  for (const Neighbor& neighbor : neighbors) search.add(locate(base + neighbor.offset, neighbor.hint));
  search.run();
  out.clear();
  for (const GeodesicSearch::Target& target : search.targets()) out.push_back(target.distance);
}

void SurfaceMesh::bisectors(Vec3, Vec2 u, std::span<const Neighbor> neighbors,
                            std::span<HalfPlane> out) const {
  flat_bisectors(u, neighbors, out);
}

bool SurfaceMesh::pieces(Vec3 base, double reach, ChartPieces& out) const {
  const MeshPlace place = locate(base);
  reach = seen_within(reach, 1.01);
  if (!border_.may_be_near(place, base, reach)) return false;
  GeodesicSearch search(unfolding_, place, reach);
  search.run(GeodesicSearch::Border::look);
  if (search.border_views().empty()) return false;
  out = star_region(search.apex(), search.border_views(), reach);
  return true;
}

/// Where there are very many, only the nearest: such cells are coarse in any case.
void SurfaceMesh::seams(Vec3 base, double reach, std::vector<Seam>& out) const {
  if (!has_sharp_vertices_) return;
  GeodesicSearch search(unfolding_, locate(base), seen_within(reach, 1.01));
  for (const auto& [vertex, at] : search.sharp_vertices(sharp)) {
    const Vec2 way = at - search.apex();
    if (norm2(way) > 0) out.push_back({at, (1 / norm(way)) * way, unfolding_.missing_angle(vertex) / 2});
  }
  if (out.size() <= most_seams) return;
  const auto nearer = [](const Seam& a, const Seam& b) { return norm2(a.at) < norm2(b.at); };
  std::stable_sort(out.begin(), out.end(), nearer);
  out.resize(most_seams);
}

std::vector<DomainTriangle> SurfaceMesh::triangles() const { return faces_of(mesh_); }

}  // namespace wellspaced
