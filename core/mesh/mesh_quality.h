#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>

#include "core/mesh/mesh.h"

namespace wellspaced {

/// Smallest, mean and largest of some numbers.
struct Spread {
  double least = 0, mean = 0, most = 0;
};

/// What makes a mesh good for computing on, of the mesh as it is: with straight edges and flat corners.
struct MeshQuality {
  static constexpr int angle_bins = 36, aspect_bins = 30;

  std::size_t vertices = 0;  ///< images across seams not counted
  std::size_t faces = 0;
  double area = 0;
  Spread face_area, edge_length;
  Spread angle_deg;  ///< of corners
  /// Of corners, in bins of 5 degrees up to 180; larger ones, of cells at a boundary that is not convex, are
  /// in the last one.
  std::array<std::size_t, angle_bins> angles{};
  /// Of a triangle: circumradius over twice the inradius, which is 1 at best. Of a cell: the longest way
  /// across over the shortest.
  Spread aspect_ratio;
  /// In bins of .1 from 1 on; larger ones are in the last one.
  std::array<std::size_t, aspect_bins> aspect_ratios{};
  /// Of a Delaunay mesh: how many vertices that are not on a boundary have that many edges. Of a Voronoi
  /// mesh: how many faces have that many corners.
  std::map<std::size_t, std::size_t> valence;

  /// Of a Delaunay mesh, with what is joined across seams as one.
  struct Topology {
    std::size_t edges = 0, boundary_edges = 0;
    int euler_characteristic = 0;
    double boundary_length = 0;
  };
  std::optional<Topology> topology;
};

/// Cost: O(n log n), about 1 us a vertex.
MeshQuality measure_quality(const Mesh& mesh);

}  // namespace wellspaced
