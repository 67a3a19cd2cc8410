#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/domain/domain.h"

namespace wellspaced {

/// What a polygon has that is narrow.
struct PolygonFeature {
  double length = 0;
  std::string description;  ///< "the passage between edge 12 and vertex 3 of ring 0 is 0.0031 wide"
};

/// A polygon with holes, not necessarily convex. Euclidean distance, whatever lies between.
///
/// A point with the coordinates of a corner is in that corner. A point is on an edge if some real point of
/// the edge is within one unit in the last place of it along both axes (on the first one, if there are
/// several). It is inside or outside otherwise, exactly. Boundary curves are the edges in order: the outer
/// ring counter-clockwise, then the holes clockwise, each from the first vertex on.
///
/// Errors of the constructor, exact, each at /rings, /rings/k or /rings/k/i of what it was given:
/// invalid_parameters for coordinates that aren't finite, no rings, and an outer ring whose box has sides
/// that aren't within [Torus::min_side, Torus::max_side] or a ratio above Torus::max_aspect;
/// degenerate_input for rings with fewer than 3 vertices, repeated vertices, spikes or no area, that cross or
/// touch themselves or each other (in a single point, too), holes outside the outer ring or in each other,
/// edges that double precision can't tell from each other, and so many edges beside each other that grids of
/// squares don't help.
/// Cost: O(n log n) for n edges; a query O(1), or of the edges near.
class Polygon : public Domain {
 public:
  /// The outer ring, then the holes; of either orientation. The last vertex of a ring may repeat the first.
  explicit Polygon(const std::vector<std::vector<Vec2>>& rings);
  ~Polygon() override;

  /// As they are used: the outer one counter-clockwise, holes clockwise, no vertex repeated.
  std::vector<std::vector<Vec2>> rings() const;

  /// The least of these: the distance of a corner from an edge of another ring, or of the same one where it
  /// is less than a third of the way along the boundary in both directions; the longer side of the box of a
  /// ring. Points closer to each other than that can follow the boundary. Cost: O(n log n) or so.
  const PolygonFeature& smallest_feature() const;

  std::string_view type() const override { return "polygon"; }
  int dimension() const override { return 2; }
  double area() const override;
  double boundary_length() const override;
  int euler_characteristic() const override;
  Box box() const override;
  double distance(Vec3 p, Vec3 q) const override;
  std::optional<std::string> why_outside(Vec3 p) const override;
  Vec3 random_point(Rng& rng) const override;
  Freedom freedom(Vec3 p) const override;
  Vec2 possible(Vec3 p, Vec2 u) const override;
  Vec3 step(Vec3 p, Vec2 u) const override;
  Vec3 place_at(Vec3 p, Vec2 u) const override { return {p.x + u.x, p.y + u.y, 0}; }
  bool holds(Vec3 p, Vec2 u) const override;
  void bisectors(Vec3 base, Vec2 u, std::span<const Neighbor> neighbors,
                 std::span<HalfPlane> out) const override;
  double chart_to_distance(double u) const override { return u; }
  bool pieces(Vec3 base, double reach, ChartPieces& out) const override;
  std::vector<BoundaryCurve> boundary() const override;
  Vec3 boundary_point(std::size_t curve, double along) const override;
  std::optional<BoundarySpot> boundary_spot(Vec3 p) const override;
  std::optional<Vec3> boundary_point_at(Vec3 p) const override;
  std::vector<DomainTriangle> triangles() const override;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace wellspaced
