#pragma once

#include <vector>

#include "core/point_set.h"
#include "core/voronoi/neighbors.h"

namespace wellspaced {

/// Finds corners of cells on domains whose charts say only about where these are: where a mesh is curved, the
/// bisector of two points is not straight in a third one's chart. Distances at a place itself are exact, so
/// Newton's method leads to where three of them are equal.
///
/// Guarantees: `distance` is that of `at` to its nearest point; and so no place of the domain is taken for
/// farther from all points than it is. Cost: 1 to 5 searches for neighbors, 1 if the place was right.
/// Thread safety: one settler a thread.
class CornerSettler {
 public:
  /// Requires: points and grid outlive it.
  CornerSettler(const PointSet& points, const NeighborGrid& grid) : points_(&points), grid_(&grid) {}

  struct Corner {
    Vec3 at;
    double distance = 0;
  };
  /// From a place of which some cell says that it is a corner as far as `claimed` from its nearest points.
  /// One on the boundary stays where it is.
  Corner settle(Vec3 place, double claimed, bool on_boundary);

 private:
  double look(Vec3 place, double claimed);
  Vec2 way_to_corner() const;

  const PointSet* points_;
  const NeighborGrid* grid_;
  std::vector<Neighbor> neighbors_;
};

}  // namespace wellspaced
