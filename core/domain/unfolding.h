#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/domain/triangle_mesh.h"
#include "core/vec.h"

namespace wellspaced {

/// A point of a mesh: its face, and its weights of the face's corners, which add up to 1.
struct MeshPlace {
  std::uint32_t face = 0;
  std::array<double, 3> weights{};
};

/// Two unit vectors along a face.
struct Frame {
  Vec3 x, y;
};

/// A triangle of the mesh as it lies in some plane, seen through its half-edge `half_edge`: from `right` to
/// `left`, with the third corner at `tip`.
struct FlatFace {
  std::uint32_t half_edge = 0;
  Vec2 right, left, tip;
};

/// The faces of a mesh laid out in planes, one beside the other.
///
/// Each face has a chart: its first edge lies along x, from the corner 0 at the origin, and the face is
/// above. Cost: 5 ns to unfold a face; 100 bytes a face. Thread safety: immutable after construction.
class Unfolding {
 public:
  /// Requires: mesh outlives it.
  explicit Unfolding(const TriangleMesh& mesh);

  const TriangleMesh& mesh() const { return *mesh_; }

  /// Corners of the face in its chart, moved so that `origin` is at 0.
  std::array<Vec2, 3> corners_around(const MeshPlace& origin) const;
  Frame frame(std::uint32_t face) const;
  Vec3 position(const MeshPlace& place) const;
  /// Of a point, in the plane of the face, in the layout `corners` of it.
  std::array<double, 3> weights(const std::array<Vec2, 3>& corners, Vec2 p) const;

  /// Where the tip of the face left of h is if h leads from a to b.
  Vec2 tip(std::uint32_t h, Vec2 a, Vec2 b) const {
    const Vec2 e = b - a, shape = shapes_[h];
    return {a.x + shape.x * e.x - shape.y * e.y, a.y + shape.x * e.y + shape.y * e.x};
  }

  /// Sum of the angles of the faces at a vertex, in radians.
  double angle_around(std::uint32_t vertex) const { return angle_around_[vertex]; }
  /// From the vertex's first half-edge counter-clockwise to h, one out of the same vertex.
  double angle_to(std::uint32_t h) const { return angle_to_[h]; }
  /// Of the face of h at the origin of h.
  double angle_at(std::uint32_t h) const { return angle_at_[h]; }
  /// How much less than a whole turn is around the vertex; 0 at the border, without faces, and where there
  /// is more.
  double missing_angle(std::uint32_t vertex) const;
  /// Shortest ways may run through the vertex, because there is more around it than a straight line needs.
  bool bends_ways(std::uint32_t vertex) const { return bends_ways_[vertex]; }

 private:
  const TriangleMesh* mesh_;
  std::vector<Vec2> shapes_;  ///< the tip over each half-edge, where that leads from (0, 0) to (1, 0)
  std::vector<double> angle_around_, angle_to_, angle_at_;
  std::vector<bool> bends_ways_;
};

}  // namespace wellspaced
