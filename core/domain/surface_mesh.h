#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/domain/domain.h"
#include "core/domain/face_tree.h"
#include "core/domain/mesh_border.h"
#include "core/domain/smallest_feature.h"
#include "core/domain/triangle_mesh.h"
#include "core/domain/unfolding.h"

namespace wellspaced {

/// The surface of a triangle mesh, with or without border; distances are lengths of the shortest ways over
/// its faces.
///
/// The chart at p is geodesic polar coordinates: the unfolded faces as seen from p. Its axes are those of p's
/// face: x along the first edge, y into the face. Points on an edge belong to one of its faces, always the
/// same. Neighbors behind a vertex with more than a whole turn around it appear in the direction of that
/// vertex.
///
/// Points within 1e-12 of the box's diagonal from the border are on it; its curves end at corners, where it
/// turns by more than 45 degrees on the unfolded faces.
///
/// What lies behind a vertex with less than a whole turn around it is seen twice, past its left and its
/// right: `localize` gives every image of a neighbor that a straight way leads to, in the order of the
/// neighbors, the nearest one first, and before them the shortest way if that bends at a vertex. Behind
/// vertices with more than 3 degrees missing there are `seams`.
///
/// Guarantees: `step` ends on the surface, to rounding; `distance` and `localize` are exact but for rounding.
/// step(p, log q) is q again, but where the shortest way runs through a vertex.
/// Cost: to find a point .1 us, among 10^5 faces .2; a step .2 us, and 10 ns a face on the way;
/// `localize`, a neighbor, .6 us at half a face a neighbor, 4 us at 9 faces, 20 us at 45; `distance` 5 to 15
/// ms across 10^4 faces, seconds across 10^6. Thread safety: immutable after construction.
class SurfaceMesh : public Domain {
 public:
  explicit SurfaceMesh(TriangleMesh mesh);
  SurfaceMesh(const SurfaceMesh&) = delete;  // its parts point to each other
  SurfaceMesh& operator=(const SurfaceMesh&) = delete;

  const TriangleMesh& mesh() const { return mesh_; }

  /// The face that a point of the surface is in. For any other point: of the nearest point on the surface.
  MeshPlace locate(Vec3 p) const;
  /// The point of the surface nearest to p.
  Vec3 nearest(Vec3 p) const;
  Vec3 position(const MeshPlace& place) const { return unfolding_.position(place); }
  /// The axes of the chart at each point of a face.
  Frame frame(std::uint32_t face) const { return unfolding_.frame(face); }
  /// The vector of the shortest way from p to q in the chart at p; nothing if that is longer than `reach`.
  std::optional<Vec2> logarithm(Vec3 p, Vec3 q, double reach) const;

  /// See core/domain/smallest_feature.h. Looked for once.
  const SmallestFeature& smallest_feature() const;

  std::string_view type() const override { return "mesh"; }
  int dimension() const override { return 3; }
  double area() const override { return mesh_.facts().area; }
  double boundary_length() const override { return border_.length(); }
  int euler_characteristic() const override { return mesh_.facts().euler_characteristic; }
  Box box() const override { return box_; }
  /// See mesh_extent. Cost: that of a few shortest ways to all vertices, the first time.
  double farthest() const override;
  std::size_t parts() const override { return mesh_.facts().components; }
  std::size_t part_of(Vec3 p) const override { return mesh_.component_of_face()[spot(p).place.face]; }
  Vec3 place_in(std::size_t part) const override;
  bool is_flat() const override { return false; }
  bool has_exact_cells() const override { return false; }
  /// Infinite between components.
  double distance(Vec3 p, Vec3 q) const override;
  std::optional<std::string> why_outside(Vec3 p) const override;
  Vec3 random_point(Rng& rng) const override;
  Freedom freedom(Vec3 p) const override;
  Vec2 possible(Vec3 p, Vec2 u) const override;
  Vec3 step(Vec3 p, Vec2 u) const override;
  Vec3 place_at(Vec3 p, Vec2 u) const override;
  bool holds(Vec3 p, Vec2 u) const override;
  std::optional<BoundarySpot> boundary_spot(Vec3 p) const override;
  std::optional<Vec3> boundary_point_at(Vec3 p) const override;
  bool has_hints() const override { return true; }
  std::uint32_t hint(Vec3 p) const override { return spot(p).place.face; }
  void localize(Vec3 base, double reach, std::vector<Neighbor>& neighbors) const override;
  bool is_nearer(Vec3 base, const Neighbor& neighbor, double distance) const override;
  void distances(Vec3 base, double reach, std::span<const Neighbor> neighbors,
                 std::vector<double>& out) const override;
  void bisectors(Vec3 base, Vec2 u, std::span<const Neighbor> neighbors,
                 std::span<HalfPlane> out) const override;
  double chart_to_distance(double u) const override { return u; }
  bool pieces(Vec3 base, double reach, ChartPieces& out) const override;
  void seams(Vec3 base, double reach, std::vector<Seam>& out) const override;
  std::vector<BoundaryCurve> boundary() const override { return border_.curves(); }
  Vec3 boundary_point(std::size_t curve, double along) const override { return border_.point(curve, along); }
  std::vector<DomainTriangle> triangles() const override;

 private:
  /// Where a point is, and, if it is on the border, where there.
  struct Spot {
    MeshPlace place;
    std::optional<MeshBorder::Spot> border;
  };

  Spot spot(Vec3 p) const;
  Spot spot_in(const MeshPlace& place, Vec3 p) const;
  MeshPlace locate(Vec3 p, std::uint32_t face) const;
  bool is_on_border(const MeshPlace& place) const;
  double seen_within(double reach, double times) const;

  TriangleMesh mesh_;
  Box box_;
  double rounding_;  ///< of points of the surface
  Unfolding unfolding_;
  FaceTree tree_;
  MeshBorder border_;
  bool has_sharp_vertices_ = false;
  std::vector<double> areas_up_to_;  ///< of each face and all before it
  mutable std::once_flag looked_for_feature_, looked_for_farthest_;
  mutable SmallestFeature smallest_feature_;
  mutable double farthest_ = 0;
};

}  // namespace wellspaced
