#include "core/domain/polygon.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <sstream>
#include <utility>

#include "core/domain/edge_line.h"
#include "core/domain/polygon_feature.h"
#include "core/domain/polygon_locator.h"
#include "core/domain/polygon_pieces.h"
#include "core/domain/polygon_triangles.h"
#include "core/error.h"

namespace wellspaced {
namespace {

constexpr double most_of_the_way = 0.75;  ///< to the boundary or a corner in one move
constexpr int most_halvings = 64;         ///< then a move is lost in rounding

Vec2 planar(Vec3 p) { return {p.x, p.y}; }
Vec3 spatial(Vec2 p) { return {p.x, p.y, 0}; }

DomainTriangle corners_of(const PolygonRings& rings, const std::array<std::uint32_t, 3>& triangle) {
  return {spatial(rings.edges()[triangle[0]].from), spatial(rings.edges()[triangle[1]].from),
          spatial(rings.edges()[triangle[2]].from)};
}

double length(const PolygonEdge& e) { return norm(e.to - e.from); }

}  // namespace

/// In the order in which they are made: each takes what is above it to be right.
struct Polygon::Parts {
  mutable std::once_flag looked_for_feature;
  mutable PolygonFeature feature;

  explicit Parts(const std::vector<std::vector<Vec2>>& given)
      : rings(given), locator(rings), pieces(rings, locator), triangles(triangulate(rings)) {
    for (const PolygonEdge& e : rings.edges()) boundary_length += length(e);
    for (const auto& triangle : triangles) {
      const DomainTriangle t = corners_of(rings, triangle);
      area += 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
      area_up_to.push_back(area);
    }
    require_room();
  }

  /// Everything else relies on it that there are points inside, and on each edge.
  void require_room() const {
    constexpr double thinnest = 64;  // units in the last place
    if (!(area > thinnest * rings.ulp() * boundary_length))
      throw Error(ErrorCode::degenerate_input,
                  "the polygon is so thin that double precision has hardly any points inside it; move it "
                  "nearer to the origin",
                  "/rings");
    for (std::uint32_t e = 0; e < rings.edges().size(); ++e)
      if (!owns(e, on_edge(e, 0.5)))
        throw Error(ErrorCode::degenerate_input,
                    "edge " + std::to_string(rings.given_edge(e)) +
                        ", which begins or ends in this vertex, is so short, or so close to another one, "
                        "that double precision can't tell points on it; move the polygon nearer to the "
                        "origin, or leave the vertex out",
                    rings.where_corner(e));
  }

  bool owns(std::uint32_t edge, Vec2 p) const {
    const Located at = locator.locate(p);
    return at.place == Place::edge && at.edge == edge;
  }
  Vec2 on_edge(std::uint32_t edge, double part) const {
    const PolygonEdge& e = rings.edges()[edge];
    double Vec2::*const axis = long_axis(e);
    const bool near_from = part < 0.5;
    const double way = e.to.*axis - e.from.*axis;
    return point_on_edge(e, near_from ? e.from.*axis + part * way : e.to.*axis - (1 - part) * way);
  }
  /// As much of u as leads along the edge, and not too near to its ends.
  Vec2 along(std::uint32_t edge, Vec2 p, Vec2 u) const {
    const PolygonEdge& e = rings.edges()[edge];
    const Vec2 tangent = (1 / length(e)) * (e.to - e.from);
    const double way =
        std::clamp(dot(u, tangent), -most_of_the_way * norm(p - e.from), most_of_the_way * norm(e.to - p));
    return way * tangent;
  }
  Vec2 step_along(std::uint32_t edge, Vec2 p, Vec2 u) const {
    const PolygonEdge& e = rings.edges()[edge];
    double Vec2::*const axis = long_axis(e);
    Vec2 move = along(edge, p, u);
    for (int k = 0; k < most_halvings && p.*axis + move.*axis != p.*axis; ++k, move = 0.5 * move) {
      const Vec2 to = point_on_edge(e, p.*axis + move.*axis);
      if (owns(edge, to)) return to;
    }
    return p;
  }

  PolygonRings rings;
  PolygonLocator locator;
  PolygonPieces pieces;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<double> area_up_to;  ///< and with each triangle
  double area = 0, boundary_length = 0;
};

Polygon::Polygon(const std::vector<std::vector<Vec2>>& rings) : parts_(std::make_unique<Parts>(rings)) {}
Polygon::~Polygon() = default;

std::vector<std::vector<Vec2>> Polygon::rings() const {
  const PolygonRings& rings = parts_->rings;
  std::vector<std::vector<Vec2>> out(rings.rings());
  for (std::size_t k = 0; k < out.size(); ++k)
    for (std::uint32_t e = rings.first(k); e < rings.first(k + 1); ++e)
      out[k].push_back(rings.edges()[e].from);
  return out;
}

const PolygonFeature& Polygon::smallest_feature() const {
  std::call_once(parts_->looked_for_feature,
                 [this] { parts_->feature = find_smallest_feature(parts_->rings, parts_->locator); });
  return parts_->feature;
}

double Polygon::area() const { return parts_->area; }

double Polygon::boundary_length() const { return parts_->boundary_length; }

int Polygon::euler_characteristic() const { return 2 - static_cast<int>(parts_->rings.rings()); }

Box Polygon::box() const { return {spatial(parts_->rings.low()), spatial(parts_->rings.size()), {}}; }

double Polygon::distance(Vec3 p, Vec3 q) const { return norm(planar(q) - planar(p)); }

std::optional<std::string> Polygon::why_outside(Vec3 p) const {
  if (parts_->locator.locate(planar(p)).place != Place::outside) return {};
  std::ostringstream text;
  text.precision(17);
  text << "point (" << p.x << ", " << p.y
       << ") is outside the polygon, or in one of its holes; move it inside";
  return text.str();
}

Vec3 Polygon::random_point(Rng& rng) const {
  const auto& areas = parts_->area_up_to;
  for (;;) {
    const auto found = std::upper_bound(areas.begin(), areas.end(), rng.uniform() * areas.back());
    const auto k = std::min(static_cast<std::size_t>(found - areas.begin()), areas.size() - 1);
    const Vec3 p = random_point_in(corners_of(parts_->rings, parts_->triangles[k]), rng);
    if (parts_->locator.is_inside(planar(p))) return p;
  }
}

Freedom Polygon::freedom(Vec3 p) const {
  const Located at = parts_->locator.locate(planar(p));
  if (at.place == Place::corner) return {0};
  if (at.place != Place::edge) return {};
  const PolygonEdge& e = parts_->rings.edges()[at.edge];
  return {1, (1 / length(e)) * (e.to - e.from)};
}

Vec2 Polygon::possible(Vec3 p, Vec2 u) const {
  const Located at = parts_->locator.locate(planar(p));
  switch (at.place) {
    case Place::inside: {
      const double part = parts_->locator.free_part(planar(p), (1 / most_of_the_way) * u);
      return part < 1 ? part * u : u;
    }
    case Place::edge:
      return parts_->along(at.edge, planar(p), u);
    default:
      return {};
  }
}

Vec3 Polygon::step(Vec3 p, Vec2 u) const {
  const Located at = parts_->locator.locate(planar(p));
  if (at.place == Place::edge) return spatial(parts_->step_along(at.edge, planar(p), u));
  if (at.place != Place::inside) return p;
  for (int k = 0; k < most_halvings; ++k, u = 0.5 * u)
    if (parts_->locator.is_inside(planar(p) + u)) return spatial(planar(p) + u);
  return p;
}

bool Polygon::holds(Vec3 p, Vec2 u) const {
  return parts_->locator.locate(planar(p) + u).place != Place::outside;
}

std::optional<BoundarySpot> Polygon::boundary_spot(Vec3 p) const {
  const Located at = parts_->locator.locate(planar(p));
  if (at.place != Place::edge) return std::nullopt;
  const PolygonEdge& e = parts_->rings.edges()[at.edge];
  return BoundarySpot{at.edge, dot(planar(p) - e.from, e.to - e.from) / length(e)};
}

std::optional<Vec3> Polygon::boundary_point_at(Vec3 p) const {
  const double tolerance = 1e-12 * norm(box().size) + 64 * parts_->rings.ulp();
  const EdgeGrid& grid = parts_->locator.grid();
  const Vec2 at = planar(p), local = at - parts_->rings.low();
  std::optional<Vec3> found;
  double nearest = tolerance;
  for (const std::uint32_t e : grid.edges_in(grid.square(grid.column_of(local.x), grid.row_of(local.y)))) {
    const PolygonEdge& edge = parts_->rings.edges()[e];
    const Vec2 along = edge.to - edge.from;
    const double part = std::clamp(dot(at - edge.from, along) / norm2(along), 0.0, 1.0);
    const double away = norm(edge.from + part * along - at);
    if (away >= nearest) continue;
    nearest = away;
    found = boundary_point(e, part * length(edge) < tolerance         ? 0
                              : (1 - part) * length(edge) < tolerance ? length(edge)
                                                                      : part * length(edge));
  }
  return found;
}

void Polygon::bisectors(Vec3, Vec2 u, std::span<const Neighbor> neighbors, std::span<HalfPlane> out) const {
  flat_bisectors(u, neighbors, out);
}

bool Polygon::pieces(Vec3 base, double reach, ChartPieces& out) const {
  if (parts_->locator.surrounds(planar(base), reach)) return false;
  parts_->pieces.near(planar(base), reach, out);
  return true;
}

std::vector<BoundaryCurve> Polygon::boundary() const {
  std::vector<BoundaryCurve> curves;
  for (const PolygonEdge& e : parts_->rings.edges()) curves.push_back({length(e), false});
  return curves;
}

Vec3 Polygon::boundary_point(std::size_t curve, double along) const {
  const auto edge = static_cast<std::uint32_t>(curve);
  const PolygonEdge& e = parts_->rings.edges()[edge];
  double part = along / length(e);
  if (!(along > 0)) return spatial(e.from);
  if (!(along < length(e))) return spatial(e.to);
  // Beside a sharp corner both edges are within rounding, and places may belong to the other one.
  const bool near_from = part < 0.5;
  for (double off = std::max(near_from ? part : 1 - part, 0x1p-60); off < 0.5; off *= 2) {
    const Vec2 p = parts_->on_edge(edge, near_from ? off : 1 - off);
    if (parts_->owns(edge, p)) return spatial(p);
  }
  return spatial(parts_->on_edge(edge, 0.5));
}

std::vector<DomainTriangle> Polygon::triangles() const {
  std::vector<DomainTriangle> out;
  for (const auto& triangle : parts_->triangles) out.push_back(corners_of(parts_->rings, triangle));
  return out;
}

}  // namespace wellspaced
