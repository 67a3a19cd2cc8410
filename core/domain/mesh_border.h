#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/domain/domain.h"
#include "core/domain/face_tree.h"
#include "core/domain/unfolding.h"

namespace wellspaced {

/// The border of a mesh as curves between its corners: vertices where it turns by more than 45 degrees, on
/// the unfolded faces.
///
/// Thread safety: immutable after construction.
class MeshBorder {
 public:
  /// A point of the border: on `half_edge`, that way from its origin; at 0: that vertex itself.
  struct Spot {
    std::uint32_t half_edge = 0;
    double along = 0;
    bool is_corner = false;
  };

  /// What is nearer than `tolerance` to the border is on it. Requires: the unfolding outlives it.
  MeshBorder(const Unfolding& unfolding, double tolerance);

  double length() const { return length_; }
  const std::vector<BoundaryCurve>& curves() const { return curves_; }
  /// The point of a curve at that way along it: see Domain::boundary_point.
  Vec3 point(std::size_t curve, double along) const;

  /// Of a point of that face, if it is on the border.
  std::optional<Spot> spot(Vec3 p, std::uint32_t face) const;
  /// Where on its curve a spot is; a corner: at the start of the curve that begins there.
  BoundarySpot on_curve(const Spot& spot) const;
  /// In the face of the spot's edge; for a vertex in the one in the middle between its border edges.
  MeshPlace place(const Spot& spot) const;
  /// Unit tangent, as the faces lead, in the chart of that face; at a vertex it halves the turn.
  Vec2 tangent(const Spot& spot) const;
  /// Which part of the move s along the border's tangent leaves the spot well between corners.
  double possible(const Spot& spot, double s) const;
  /// The spot moved by s.
  Vec3 step(const Spot& spot, double s) const;

  /// Whether some border edge may be so near, in space. Never wrongly no.
  bool may_be_near(const MeshPlace& place, Vec3 p, double reach) const;

 private:
  struct Curve {
    std::vector<std::uint32_t> half_edges;
    std::vector<double> starts;  ///< of each of them, and the end of the last
  };
  struct Position {
    std::uint32_t curve, index;
  };

  double length_of(std::uint32_t h) const;
  bool is_corner(std::uint32_t vertex) const;
  void cut(const std::vector<std::uint32_t>& loop);
  void add(std::vector<std::uint32_t> half_edges, bool closed);
  void measure_distances();
  std::uint32_t middle_of_fan(std::uint32_t vertex) const;

  const Unfolding* unfolding_;
  const TriangleMesh* mesh_;
  double tolerance_, length_ = 0;
  std::vector<Curve> lines_;
  std::vector<BoundaryCurve> curves_;
  std::unordered_map<std::uint32_t, Position> position_of_;  ///< of border half-edges
  std::vector<double> vertex_distance_;                      ///< of each vertex to the border, in space
  std::unique_ptr<FaceTree> tree_;                           ///< of border edges
};

}  // namespace wellspaced
