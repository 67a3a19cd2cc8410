#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace wellspaced {

/// Polygons with common corners, as plain arrays: a Delaunay or Voronoi mesh of a point set.
///
/// Shapes and units: coordinates are the domain's, z = 0 on planar ones. Face f has the corners
/// `corners[begin(f)]` up to `corners[ends[f]]`, counter-clockwise; on surfaces, as seen from where their own
/// faces are. A mesh of a periodic domain lies unwrapped: what reaches across a seam goes on there, with
/// vertices of its own, so that every face is as it is and all areas are right.
struct Mesh {
  static constexpr std::uint32_t no_point = ~0u;

  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> ends;  ///< of each face in `corners`
  /// Of a Delaunay mesh: the point that each vertex is, or is an image of; no_point for a corner of the
  /// domain that is none. Vertex i < n is point i.
  std::vector<std::uint32_t> vertex_points;
  /// Of a Delaunay mesh of a periodic domain: the vertex that each is an image of, or itself. Empty: itself.
  std::vector<std::uint32_t> originals;
  /// Of a Voronoi mesh: the point whose cell, or part of it, each face is.
  std::vector<std::uint32_t> face_points;

  std::size_t faces() const { return ends.size(); }
  std::uint32_t begin(std::size_t f) const { return f == 0 ? 0 : ends[f - 1]; }
  std::span<const std::uint32_t> operator[](std::size_t f) const {
    return {corners.data() + begin(f), ends[f] - begin(f)};
  }
  void close() { ends.push_back(static_cast<std::uint32_t>(corners.size())); }
};

/// Half the cross products around a polygon that need not be flat: its area times its normal.
Vec3 area_vector(const Mesh& mesh, std::size_t face);

/// Makes one vertex of those that edges up to that length join, as corners of cells that are one but for
/// rounding are; faces that lose all but two of their corners go. Unused vertices go, too. For meshes without
/// vertex_points. Cost: O(n).
void collapse_short_edges(Mesh& mesh, double length);

}  // namespace wellspaced
