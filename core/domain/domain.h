#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/rng.h"
#include "core/vec.h"

namespace wellspaced {

/// n.u <= c in the tangent chart at a point: the side of a bisector that is nearer to that point.
struct HalfPlane {
  Vec2 n;
  double c = 0;
};

/// Sample `id` (or one of its periodic images) as seen from a base point: offset in ambient coordinates.
struct Neighbor {
  static constexpr std::uint32_t no_hint = ~0u;

  Vec3 offset;
  std::uint32_t id = 0;
  std::uint32_t hint = no_hint;  ///< the domain's for the sample
};

/// An axis-aligned box around a domain, with the axes along which it repeats.
struct Box {
  Vec3 low, size;
  std::array<bool, 3> periodic{};
};

/// Convex polygons in a chart, one after the other, each counter-clockwise.
struct ChartPieces {
  std::vector<Vec2> corners;
  std::vector<std::size_t> ends;  ///< of each polygon in `corners`

  void clear() {
    corners.clear();
    ends.clear();
  }
  void close() { ends.push_back(corners.size()); }  ///< the corners since the last one are a polygon
  std::span<const Vec2> operator[](std::size_t k) const {
    const std::size_t begin = k == 0 ? 0 : ends[k - 1];
    return {corners.data() + begin, ends[k] - begin};
  }
};

/// Where a chart shows twice what lies behind a sharp vertex: between the half-lines from `at` that are
/// turned by `half_angle` to both sides of `axis`, a unit vector that leads on from the chart's origin, there
/// is what one also sees, and no farther, on the other side.
struct Seam {
  Vec2 at, axis;
  double half_angle = 0;
};

/// How a point may move: over the domain; along the boundary curve that it lies on; not at all, as corners.
struct Freedom {
  int dimensions = 2;
  Vec2 along{};  ///< unit tangent of the curve, where dimensions == 1
};

/// A curve of the boundary between two corners, which are fixed, or a closed one without any.
struct BoundaryCurve {
  double length = 0;
  bool closed = false;
};

/// A place on the boundary: that way along a curve.
struct BoundarySpot {
  std::size_t curve = 0;
  double along = 0;
};

/// A flat (on a sphere: spherical) triangle of a domain, counter-clockwise.
using DomainTriangle = std::array<Vec3, 3>;

/// Integrals over a polygon in a chart: of 1, of the way there from the origin, and of its square.
struct PolygonMoments {
  double area = 0;
  Vec2 first;
  double second = 0;

  PolygonMoments& operator+=(const PolygonMoments& other) {
    area += other.area;
    first = first + other.first;
    second += other.second;
    return *this;
  }
};

/// Where points live. Everything that generators, optimizers and analyses need to know of a shape is asked
/// here, so that each of them is written once.
///
/// The tangent chart at p is a plane with origin p in which bisectors to near samples are straight lines and
/// distance from p grows with |u|; `chart_to_distance` is that monotone map. Torus, box and polygon: the
/// identity, exact. Sphere: gnomonic, exact. Surface mesh: geodesic polar coordinates, right to second order.
///
/// Domains with a boundary are closed. Points on it are told from the others by their coordinates alone: see
/// `freedom`. They keep to their curve, and its corners stay.
///
/// Thread safety: immutable after construction.
class Domain {
 public:
  virtual ~Domain() = default;

  virtual std::string_view type() const = 0;  ///< its name in requests: "torus"
  virtual int dimension() const = 0;          ///< coordinates a point: 2 or 3
  virtual double area() const = 0;
  virtual double boundary_length() const { return 0; }
  virtual int euler_characteristic() const = 0;  ///< of a triangulation: vertices - edges + faces
  virtual Box box() const = 0;
  /// No place is farther from the nearest image of another one of its part; on meshes about so, unproven.
  virtual double farthest() const {
    const Box b = box();
    return norm(Vec3{b.size.x / (b.periodic[0] ? 2 : 1), b.size.y / (b.periodic[1] ? 2 : 1), b.size.z});
  }
  /// Parts between which there is no way, numbered from 0; which one p is in; some place of it.
  virtual std::size_t parts() const { return 1; }
  virtual std::size_t part_of(Vec3) const { return 0; }
  virtual Vec3 place_in(std::size_t part) const {
    (void)part;
    return triangles().front()[0];
  }
  /// The chart of every point is the plane that the domain lies in, moved there.
  virtual bool is_flat() const { return true; }
  /// Cells that are cut in charts are exact; else their corners are only about where they should be.
  virtual bool has_exact_cells() const { return true; }

  /// Length of the shortest way; on planar domains the straight one, whatever lies between.
  virtual double distance(Vec3 p, Vec3 q) const = 0;

  /// Why the (finite) point p is not in the domain, for a person; nothing if it is.
  virtual std::optional<std::string> why_outside(Vec3 p) const = 0;

  /// Uniform by area.
  virtual Vec3 random_point(Rng& rng) const = 0;

  /// How p, a point of the domain, may move.
  virtual Freedom freedom(Vec3) const { return {}; }

  /// As much of the move u of p as its freedom and the boundary let it make: a part of u for points inside,
  /// that stay there; the part along its curve, up to the corners, for a point on the boundary.
  virtual Vec2 possible(Vec3, Vec2 u) const { return u; }

  /// p moved by the tangent vector u (the exponential map); the result is in the domain, and has the freedom
  /// of p. Requires: u == possible(p, u), but for rounding.
  virtual Vec3 step(Vec3 p, Vec2 u) const = 0;

  /// The place that the tangent vector u at p leads to, whatever the freedom of p. Requires: it is in the
  /// domain, but for rounding.
  virtual Vec3 place_at(Vec3 p, Vec2 u) const { return step(p, u); }

  /// Whether there is a place of the domain at the tangent vector u at p.
  virtual bool holds(Vec3, Vec2) const { return true; }

  /// Something about where a point is that spares `localize` a search, if a neighbor has it. Whether domains
  /// have hints at all.
  virtual bool has_hints() const { return false; }
  virtual std::uint32_t hint(Vec3) const { return Neighbor::no_hint; }

  /// Turns offsets from base, as a search in ambient space found them, into what `bisectors` takes, and drops
  /// neighbors that are farther than `reach` on the domain. One neighbor may be seen in several places then.
  virtual void localize(Vec3, double, std::vector<Neighbor>&) const {}

  /// Whether a neighbor, not yet localized, is nearer to base than that.
  virtual bool is_nearer(Vec3 base, const Neighbor& neighbor, double distance) const {
    return norm(way_to(base, neighbor)) < distance;
  }

  /// Lengths of the ways to neighbors, not yet localized; infinite for those that are farther than `reach`.
  virtual void distances(Vec3 base, double reach, std::span<const Neighbor> neighbors,
                         std::vector<double>& out) const;

  /// The bisectors between the candidate step(base, u) and its neighbors, in the candidate's chart.
  /// Requires: out.size() == neighbors.size(); neighbors relative to `base`, localized.
  virtual void bisectors(Vec3 base, Vec2 u, std::span<const Neighbor> neighbors,
                         std::span<HalfPlane> out) const = 0;

  /// Distance on the domain of a chart vector of length u from the chart's origin.
  virtual double chart_to_distance(double u) const = 0;
  /// The other way round, for distances that the chart has room for; the greatest length it has for others.
  virtual double distance_to_chart(double distance) const { return distance; }

  /// How far charts reach, where a cell may go on beyond: a sphere's, a quarter turn. What is there, the
  /// chart at the opposite place shows: the way there leads through it, and what is `u` here is -u there, so
  /// the half-plane n.u <= c is n.u <= -c.
  virtual double horizon() const { return HUGE_VAL; }

  /// The tangent vector at base that leads straight to a neighbor, localized, as long as the way is.
  virtual Vec2 way_to(Vec3, const Neighbor& neighbor) const { return {neighbor.offset.x, neighbor.offset.y}; }

  /// Of a polygon in a chart, counter-clockwise; on the domain, not in the chart.
  virtual PolygonMoments moments(std::span<const Vec2> polygon) const;

  /// Where the domain doesn't go on for `reach` around base in all directions: fills `out` with convex
  /// polygons in the chart at base that don't overlap and that together are all of the domain within reach
  /// (they may go on beyond), and returns true. False: it goes on.
  virtual bool pieces(Vec3 base, double reach, ChartPieces& out) const {
    (void)base, (void)reach, (void)out;
    return false;
  }

  /// Adds the seams of the chart at base that begin within reach.
  virtual void seams(Vec3 base, double reach, std::vector<Seam>& out) const {
    (void)base, (void)reach, (void)out;
  }

  /// The curves that the boundary is made of.
  virtual std::vector<BoundaryCurve> boundary() const { return {}; }
  /// The point of a curve at that way along it, in [0, length]: both ends are the corners, bit for bit; all
  /// others have one degree of freedom.
  virtual Vec3 boundary_point(std::size_t curve, double along) const {
    (void)curve, (void)along;
    return {};
  }

  /// Where on its curve a point with one degree of freedom is, to rounding; nothing for others.
  virtual std::optional<BoundarySpot> boundary_spot(Vec3) const { return {}; }

  /// The point of the boundary that is nearest to p, a place on it to within rounding: free along its curve,
  /// or a corner. Nothing where p is not on it.
  virtual std::optional<Vec3> boundary_point_at(Vec3) const { return {}; }

  /// Triangles that are the domain together and overlap in edges only.
  virtual std::vector<DomainTriangle> triangles() const = 0;
  /// The middle of an edge of such a triangle, or of a part of one.
  virtual Vec3 middle(Vec3 p, Vec3 q) const { return 0.5 * (p + q); }
  /// Of such a triangle, or of a part of one.
  virtual double area_of(const DomainTriangle& triangle) const;
  /// Uniform by area in such a triangle, or a part of one.
  virtual Vec3 random_point_in(const DomainTriangle& triangle, Rng& rng) const;
};

/// `bisectors` of a flat domain.
void flat_bisectors(Vec2 u, std::span<const Neighbor> neighbors, std::span<HalfPlane> out);

/// Spacing of the triangular lattice of n points on a domain; on one with a boundary, where points on it have
/// half a cell inside, of n points that cover it up to there: n = 2 A / (sqrt(3) d^2) + L / (2 d).
double hexagonal_spacing(const Domain& domain, std::size_t n);

}  // namespace wellspaced
