#pragma once

#include <span>
#include <vector>

#include "core/voronoi/moving_set.h"

namespace wellspaced {

/// The Delaunay star of a point on any domain, as its clipped cell tells of it: the neighbors with whom it
/// shares an edge of its cell inside the domain, counter-clockwise.
///
/// Two that follow each other make a triangle with the point; not where the outside of the domain lies
/// between them. Reused from point to point; not for several threads.
class DomainStar {
 public:
  struct Spoke {
    Vec2 way;  ///< to the neighbor, in the chart at the point, domain lengths
    std::uint32_t id = 0;
    bool closes = true;  ///< it makes a triangle with the next one
  };

  /// Turns to point i. Requires: a finder of the set. Errors: those of the finder.
  void load(const MovingSet& set, std::size_t i, CellFinder& cells);

  std::span<const Spoke> spokes() const { return spokes_; }

 private:
  void merge_images(bool is_inside);
  void open_outside(const MovingSet& set, std::size_t i);

  std::vector<Spoke> spokes_;
  std::vector<std::int32_t> labels_;
};

}  // namespace wellspaced
