#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/domain/domain.h"
#include "core/vec.h"

namespace wellspaced {

/// The one kernel: half-planes in, the convex cell around the chart's origin out.
///
/// Guarantees: the cell is the intersection of a square of half-side `reach`, or another polygon, with all
/// half-planes clipped so far; it is empty where they leave nothing; corners are counter-clockwise; a
/// half-plane that only touches a corner (within 1e-12 of the cell's size) leaves no edge, so cocircular
/// neighbors give no slivers. The order of clipping changes corners by rounding only. Cost: O(corners) a
/// half-plane that cuts, O(1) for one that is out of range; no allocation once warm.
class Cell {
 public:
  struct Corner {
    Vec2 at;
    std::int32_t label;  ///< whose bisector the edge from this corner to the next one lies on; -1: what it
                         ///< started from
  };

  void reset(double reach);
  /// Starts from a convex polygon instead of a square, counter-clockwise.
  void reset(std::span<const Vec2> polygon);
  void clip(const HalfPlane& half_plane, std::int32_t label);

  std::span<const Corner> corners() const { return corners_; }
  /// Whether the corner number k lies on an edge of what the cell started from.
  bool is_outer(std::size_t k) const {
    return corners_[k].label < 0 || corners_[k == 0 ? corners_.size() - 1 : k - 1].label < 0;
  }
  /// Squared distance from the origin to the farthest corner, in the chart.
  double outradius2() const { return outradius2_; }
  /// No edge of the starting square is left.
  bool closed() const;

 private:
  std::vector<Corner> corners_, scratch_;
  std::vector<double> side_;
  double outradius2_ = 0;
};

/// Circumcentre of the triangle (0, a, b), a to b counter-clockwise. Not finite if they are collinear.
Vec2 circumcenter(Vec2 a, Vec2 b);

}  // namespace wellspaced
